// Which points of a person a camera sees.
#include <algorithm>
#include <cmath>

#include "airsim360/sensors/surface_label.h"
#include "airsim360/sim/people/labels.h"

namespace airsim360 {
namespace {

constexpr int kLanes = 16;
constexpr double kDeepest = 1.3;      // own skin in front of a point, in radii of its socket
constexpr double kSkin = 0.01;        // metres: clothes and bent joints
constexpr double kTouching = 0.005;   // metres: what a foot stands on does not hide it

// Decides what the first hit of a ray means.
Sight Judge(const SightTarget& target, double range, double distance, EntityId hit, EntityId own,
            const std::vector<bool>& is_person) {
  if (hit == own) {
    const bool deep = distance < range - kDeepest * target.radius - kSkin;
    return deep ? Sight{KeypointState::kBehindOneself, own} : Sight{};
  }
  if (distance >= range - kTouching) return {};
  return {is_person[hit] ? KeypointState::kBehindPerson : KeypointState::kBehindScene, hit};
}

}  // namespace

std::vector<bool> PersonFlags(const SimPeople& people, size_t entities) {
  std::vector<bool> flags(entities + 1);
  for (const PersonRef& ref : people.refs) {
    if (ref.entity < flags.size()) flags[ref.entity] = true;
  }
  return flags;
}

void TestSight(const RayTracer& tracer, Vec3d p_WC, EntityId entity, const std::vector<bool>& is_person,
               std::span<const SightTarget> targets, std::span<Sight> sights) {
  const FlushDenormals flush;
  const Vec3f origin = VecCast<float>(p_WC);
  for (size_t first = 0; first < targets.size(); first += kLanes) {
    const size_t count = std::min<size_t>(kLanes, targets.size() - first);
    // Idle lanes repeat the first ray of the packet.
    RayHit16 rays{};
    alignas(64) int valid[kLanes];
    double ranges[kLanes];
    for (size_t i = 0; i < kLanes; ++i) {
      const Vec3d way = targets[first + (i < count ? i : 0)].p_W - p_WC;
      ranges[i] = Norm(way);
      const Vec3f d = VecCast<float>(Normalized(way));
      rays.origin_x[i] = origin.x, rays.origin_y[i] = origin.y, rays.origin_z[i] = origin.z;
      rays.direction_x[i] = d.x, rays.direction_y[i] = d.y, rays.direction_z[i] = d.z;
      rays.t_far[i] = static_cast<float>(ranges[i]);
      rays.mask[i] = kMaskAll;
      valid[i] = i < count ? -1 : 0;
    }
    tracer.Intersect16(valid, rays, true);
    for (size_t i = 0; i < count; ++i) {
      if (rays.geometry[i] == kMiss) {
        sights[first + i] = {};
        continue;
      }
      const SurfaceRef surface = tracer.Resolve(rays.geometry[i], rays.instance[i], rays.primitive[i]);
      sights[first + i] = Judge(targets[first + i], ranges[i], rays.t_far[i], LabelOf(tracer, surface).entity,
                                entity, is_person);
    }
  }
}

}  // namespace airsim360

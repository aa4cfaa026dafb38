// Which points of a person a camera sees.
#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/sensors/surface_label.h"
#include "airsim360/sim/people/labels.h"

namespace airsim360 {
namespace {

constexpr size_t kLanes = 16;
constexpr double kDeepest = 1.3;     // own skin in front of a point, in radii of its socket
constexpr double kSkin = 0.01;       // metres: clothes and bent joints
constexpr double kTouching = 0.005;  // metres: what a foot stands on does not hide it
constexpr double kReach = 2.5;       // metres: no part of a body is farther from another

/// Sixteen rays from one place.
class RayPacket {
 public:
  explicit RayPacket(Vec3d p_W) : origin_(VecCast<float>(p_W)) {
    for (size_t i = 0; i < kLanes; ++i) {
      rays_.origin_x[i] = origin_.x, rays_.origin_y[i] = origin_.y, rays_.origin_z[i] = origin_.z;
      rays_.mask[i] = kMaskAll;
    }
  }
  size_t size() const { return count_; }
  bool full() const { return count_ == kLanes; }
  void Add(Vec3f direction, float farthest) {
    rays_.direction_x[count_] = direction.x, rays_.direction_y[count_] = direction.y, rays_.direction_z[count_] = direction.z;
    rays_.t_far[count_] = farthest;
    ++count_;
  }
  /// Traces what was added; hits stay until the next Add after Clear.
  void Trace(const RayTracer& tracer) {
    // Idle lanes repeat the first ray.
    for (size_t i = 0; i < kLanes; ++i) {
      valid_[i] = i < count_ ? -1 : 0;
      if (i < count_) continue;
      rays_.direction_x[i] = rays_.direction_x[0], rays_.direction_y[i] = rays_.direction_y[0], rays_.direction_z[i] = rays_.direction_z[0];
      rays_.t_far[i] = rays_.t_far[0];
    }
    tracer.Intersect16(valid_, rays_, true);
  }
  void Clear() { count_ = 0; }
  float distance(size_t i) const { return rays_.t_far[i]; }
  /// Entity that ray i met; kNoEntity: none.
  EntityId Entity(const RayTracer& tracer, size_t i) const {
    if (rays_.geometry[i] == kMiss) return kNoEntity;
    return LabelOf(tracer, tracer.Resolve(rays_.geometry[i], rays_.instance[i], rays_.primitive[i])).entity;
  }

 private:
  Vec3f origin_;
  RayHit16 rays_{};
  alignas(64) int valid_[kLanes] = {};
  size_t count_ = 0;
};

// How far behind a point its own skin may lie and still show it: coarse levels of detail, bent joints.
double Behind(const SightTarget& target) { return target.radius + kSkin; }

// Decides what the first hit of a ray means.
Sight Judge(const SightTarget& target, double range, double distance, EntityId hit, EntityId own, const std::vector<bool>& is_person) {
  if (hit == kNoEntity) return {};
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
  RayPacket packet(p_WC);
  for (size_t first = 0; first < targets.size(); first += kLanes) {
    const size_t count = std::min(kLanes, targets.size() - first);
    double ranges[kLanes];
    packet.Clear();
    for (size_t i = 0; i < count; ++i) {
      const Vec3d way = targets[first + i].p_W - p_WC;
      ranges[i] = Norm(way);
      packet.Add(VecCast<float>(way / ranges[i]), static_cast<float>(ranges[i] + Behind(targets[first + i])));
    }
    packet.Trace(tracer);
    for (size_t i = 0; i < count; ++i)
      sights[first + i] = Judge(targets[first + i], ranges[i], packet.distance(i), packet.Entity(tracer, i), entity, is_person);
  }
}

void TestPixels(const RayTracer& tracer, const Camera& camera, const RigidTransform& X_WC, EntityId entity,
                std::span<const PixelTarget> targets, std::span<uint8_t> shown) {
  const FlushDenormals flush;
  const int width = Width(camera), height = Height(camera);
  const bool wraps = std::holds_alternative<Equirectangular>(camera);
  std::ranges::fill(shown, uint8_t{0});
  RayPacket packet(X_WC.p);
  std::array<size_t, kLanes> asked;
  const auto ask = [&] {
    if (packet.size() == 0) return;
    packet.Trace(tracer);
    for (size_t i = 0; i < packet.size(); ++i)
      if (packet.Entity(tracer, i) == entity) shown[asked[i]] = 1;
    packet.Clear();
  };
  const auto add = [&](size_t k, int dx, int dy) {
    int x = static_cast<int>(targets[k].pixel.x) + dx;
    const int y = static_cast<int>(targets[k].pixel.y) + dy;
    if (wraps) x = (x + width) % width;
    if (x < 0 || x >= width || y < 0 || y >= height) return;
    const auto ray = PixelToRay(camera, {x + 0.5, y + 0.5});
    if (!ray) return;
    asked[packet.size()] = k;
    packet.Add(VecCast<float>(X_WC.R * *ray), static_cast<float>(targets[k].range + kReach));
    if (packet.full()) ask();
  };
  // Nearly always the pixel itself shows the person; else those around it.
  for (size_t k = 0; k < targets.size(); ++k) add(k, 0, 0);
  ask();
  for (size_t k = 0; k < targets.size(); ++k) {
    if (shown[k]) continue;
    for (int i = 0; i < 9; ++i) {
      if (i != 4) add(k, i % 3 - 1, i / 3 - 1);
    }
    ask();
  }
}

}  // namespace airsim360

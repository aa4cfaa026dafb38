#include "airsim360/rpc/images/detections.h"

#include <algorithm>
#include <map>

#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/rpc/session/vehicle_state.h"

namespace airsim360 {
namespace {

struct Pixels {
  int left = 1 << 30, top = 1 << 30, right = -1, bottom = -1;
  void Add(int x, int y) {
    left = std::min(left, x), right = std::max(right, x);
    top = std::min(top, y), bottom = std::max(bottom, y);
  }
};

// What one object looks like to AirSim's clients: its box in the camera's body-like frame.
airsim::DetectionInfo Describe(const Entity& entity, const std::string& name, const ObjectPlace& place, const Pixels& pixels,
                               const RigidTransform& X_WA, const Snapshot& now) {
  airsim::DetectionInfo info;
  info.name = name;
  info.geo_point = GeoPointOf(now, place.X_WO.p);
  info.box2D.min = {static_cast<float>(pixels.left), static_cast<float>(pixels.top)};
  info.box2D.max = {static_cast<float>(pixels.right + 1), static_cast<float>(pixels.bottom + 1)};
  const RigidTransform X_AO = X_WA.inverse() * place.X_WO;
  Vec3d low{1e30, 1e30, 1e30}, high = -low;
  const Vec3f half = VecCast<float>(VecCast<double>(entity.bounds.size()) * 0.5 * place.scale);
  const Box3f box = place.box_O.value_or(Box3f{-half, half});
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3f p_O{corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y, corner & 4 ? box.max.z : box.min.z};
    const Vec3d p_F = FrdFromBody(X_AO * VecCast<double>(p_O));
    low = Min(low, p_F);
    high = {std::max(high.x, p_F.x), std::max(high.y, p_F.y), std::max(high.z, p_F.z)};
  }
  info.box3D.min = airsim::ToVector(low);
  info.box3D.max = airsim::ToVector(high);
  info.relative_pose = {airsim::ToVector(FrdFromBody(X_AO.p)), airsim::ToQuaternionr(NedRotation(X_WA.R).transpose() * NedAttitude(place))};
  return info;
}

}  // namespace

std::vector<airsim::DetectionInfo> DetectionsIn(const ImageService::View& view, const Snapshot& now, const ObjectIndex& objects,
                                                const DetectionFilter& filter) {
  std::map<EntityId, Pixels> seen;
  const Image<EntityId>& entities = view.frame->entity;
  for (int y = 0; y < entities.height(); ++y) {
    for (int x = 0; x < entities.width(); ++x) {
      if (entities(x, y) != kNoEntity) seen[entities(x, y)].Add(x, y);
    }
  }
  const RigidTransform X_WA = view.X_WC * CameraInBody().inverse();
  std::vector<PatternMatcher> matchers;
  for (const auto& pattern : filter.patterns) matchers.emplace_back(*pattern);
  std::vector<airsim::DetectionInfo> detections;
  for (const auto& [id, pixels] : seen) {
    const Entity& entity = objects.scene().entity(id);
    const std::string& name = objects.NameOf(id, now.world->names);
    const bool wanted = std::ranges::any_of(matchers, [&](PatternMatcher& matcher) { return matcher.Matches(name); });
    if (!wanted || id == objects.scene().sky_entity) continue;
    const ObjectPlace place = PlaceNow(now, objects, id);
    if (Norm(place.X_WO.p - X_WA.p) > filter.radius) continue;
    detections.push_back(Describe(entity, name, place, pixels, X_WA, now));
  }
  return detections;
}

}  // namespace airsim360

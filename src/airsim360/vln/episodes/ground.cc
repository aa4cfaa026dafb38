#include "airsim360/vln/episodes/ground.h"

#include <algorithm>

#include "airsim360/routes/roadmap.h"
#include "airsim360/trace/surface_entity.h"

namespace airsim360::internal {
namespace {

constexpr float kRoomHeight = 5;  // metres below the lowest ceiling that rooms reach down

}  // namespace

VlnGround::VlnGround(std::shared_ptr<const RayTracer> tracer)
    : tracer_(std::move(tracer)),
      box_(FlightBox(*tracer_)),
      top_(scene().sky_entity == kNoEntity ? box_.max.z - 0.01 : scene().bounds.max.z + 10.0),
      rooms_(scene().sky_entity == kNoEntity || BeginsUnderACeiling(scene())) {
  inhabited_ = box_;
  if (!rooms_ || scene().sky_entity == kNoEntity) return;
  Box3f rooms;
  for (const Entity& entity : scene().entities)
    if (Is(entity.id, "construction/ceiling")) rooms.Add(entity.bounds);
  rooms.min.z -= kRoomHeight;
  inhabited_ = {Max(box_.min, VecCast<double>(rooms.min)), Min(box_.max, VecCast<double>(rooms.max))};
}

std::optional<GroundHit> VlnGround::Below(Vec3d p) const {
  const auto hit = tracer_->Intersect(VecCast<float>(p), {0, 0, -1});
  if (!hit) return std::nullopt;
  return GroundHit{p.z - hit->distance, EntityAt(scene(), hit->surface)};
}

bool VlnGround::Is(EntityId entity, const char* category) const {
  return entity != kNoEntity && scene().tree[scene().entity(entity).category].path.starts_with(category);
}

bool VlnGround::IsFree(Vec3d p, double radius) const {
  const bool free = box_.Contains(p) && tracer_->Clearance(VecCast<float>(p), static_cast<float>(radius)) >= static_cast<float>(radius);
  return free && (!rooms_ || IsCovered(p));
}

EntityId VlnGround::Meets(Vec3d from, Vec3d to) const {
  const auto hit = tracer_->Intersect(VecCast<float>(from), VecCast<float>(to - from), 1);
  return hit ? EntityAt(scene(), hit->surface) : kNoEntity;
}

}  // namespace airsim360::internal

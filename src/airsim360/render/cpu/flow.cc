#include "airsim360/render/cpu/flow.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/render/shared/shading_constants.h"

namespace airsim360::internal {
namespace {

enum : uint8_t { kStays = 0, kMoves = 1, kVanishes = 2 };

const MovedInstance* FindMoved(const RayTracer& tracer, uint32_t instance) {
  const auto found = std::ranges::lower_bound(tracer.moved(), instance, {}, &MovedInstance::instance);
  return found != tracer.moved().end() && found->instance == instance ? &*found : nullptr;
}

Vec3d Carry(const AffineTransform& X, Vec3d p) {
  Vec3d out = VecCast<double>(X.p);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out[i] += static_cast<double>(X.A.m[i][j]) * p[j];
  }
  return out;
}

}  // namespace

void FlowTracer::Update(const RenderRequest& request, const CameraRays& rays, std::shared_ptr<const RayTracer> now,
                        std::shared_ptr<const RayTracer> next) {
  if (!request.X_WC_next) throw InputError("flow needs the pose of the next frame (X_WC_next)");
  const RigidTransform& X = *request.X_WC_next;
  if (!std::isfinite(X.p.x + X.p.y + X.p.z)) throw InputError("next camera pose is not finite");
  camera_ = request.camera;
  next_rays_.Update(camera_, X.R);
  const int width = rays.field().width;
  column_turn_ = ((rays.column_shift() - next_rays_.column_shift()) % width + width) % width;
  eye_ = VecCast<double>(VecCast<float>(X.p));
  now_ = std::move(now);
  next_ = std::move(next);

  for (uint32_t i : marked_) moves_[i] = kStays;
  marked_.clear();
  moves_.resize(now_->scene().instances.size());
  MarkMoves(*now_, *next_);
  MarkMoves(*next_, *now_);
}

void FlowTracer::MarkMoves(const RayTracer& a, const RayTracer& b) {
  for (const MovedInstance& m : a.moved()) {
    const MeshId mesh = a.scene().instances[m.instance].mesh;
    const MovedInstance* then = FindMoved(*next_, m.instance);
    uint8_t& kind = moves_[m.instance];
    if (kind != kStays) continue;
    if (then != nullptr && then->hidden) {
      kind = kVanishes;
    } else if (!(m.X_WM == b.Place(m.instance)) || a.Positions(mesh).data() != b.Positions(mesh).data()) {
      kind = kMoves;
    }
    if (kind != kStays) marked_.push_back(m.instance);
  }
}

Vec3d FlowTracer::Motion(uint32_t instance, uint32_t triangle, float u, float v) const {
  const MeshId mesh = now_->scene().instances[instance].mesh;
  const Vec3u t = now_->scene().meshes[mesh].triangles[triangle];
  const auto point = [&](const RayTracer& tracer) {
    const std::span<const Vec3f> p = tracer.Positions(mesh);
    const double a = u, b = v;
    return Carry(tracer.Place(instance), VecCast<double>(p[t.x]) * (1 - a - b) + VecCast<double>(p[t.y]) * a + VecCast<double>(p[t.z]) * b);
  };
  return point(*next_) - point(*now_);
}

FlowTracer::Lane FlowTracer::Follow(const HitBatch& hits, int i, TilePixel pixel, const TileTarget& target) const {
  Lane lane{};
  const Vec3d direction{hits.direction_x[i], hits.direction_y[i], hits.direction_z[i]};
  lane.to_point = direction;
  if (hits.instance[i] != kMiss) {
    const uint8_t kind = moves_[hits.instance[i]];
    const Vec3d motion = kind == kMoves ? Motion(hits.instance[i], hits.triangle[i], hits.u[i], hits.v[i]) : Vec3d{};
    lane.to_point = VecCast<double>(hits.origin) + direction * static_cast<double>(hits.distance[i]) + motion - eye_;
    lane.flow.range = static_cast<float>(Norm(lane.to_point));
    lane.flow.motion = VecCast<float>(motion);
    if (kind == kVanishes) lane.flow.occluded = 1;
  }

  // Through the canonical columns of both cameras, so that turning both rolls the result exactly.
  const double* R = next_rays_.field().R;
  const Vec3d& d = lane.to_point;
  const Vec3d to_point_C{R[0] * d.x + R[3] * d.y + R[6] * d.z, R[1] * d.x + R[4] * d.y + R[7] * d.z, R[2] * d.x + R[5] * d.y + R[8] * d.z};
  const std::optional<Vec2d> there = RayToPixel(camera_, to_point_C);
  lane.in_picture = there.has_value();
  if (!there) {
    lane.flow.occluded = 1;
    return lane;
  }
  double dx = there->x - (target.column + pixel.x + 0.5);
  if (next_rays_.field().separable) {
    dx += column_turn_;
    dx -= target.width * std::floor(dx / target.width + 0.5);
  }
  lane.flow.dx = static_cast<float>(dx);
  lane.flow.dy = static_cast<float>(there->y - (target.row + pixel.y + 0.5));
  return lane;
}

void FlowTracer::Occlude(const HitBatch& hits, int first, const int* valid, Lane* lanes) const {
  RayHit16 rays;
  for (int k = 0; k < 16; ++k) {
    const Vec3d d = valid[k] != 0 ? Normalized(lanes[k].to_point) : Vec3d{0, 0, 1};
    rays.origin_x[k] = static_cast<float>(eye_.x);
    rays.origin_y[k] = static_cast<float>(eye_.y);
    rays.origin_z[k] = static_cast<float>(eye_.z);
    rays.direction_x[k] = static_cast<float>(d.x);
    rays.direction_y[k] = static_cast<float>(d.y);
    rays.direction_z[k] = static_cast<float>(d.z);
    rays.t_near[k] = rays.time[k] = 0;
    rays.t_far[k] = std::numeric_limits<float>::infinity();
    rays.mask[k] = ~0u;
    rays.id[k] = rays.flags[k] = 0;
    rays.geometry[k] = rays.instance[k] = kMiss;
    rays.primitive[k] = 0;
  }
  next_->Intersect16(valid, rays, true);
  for (int k = 0; k < 16; ++k) {
    if (valid[k] == 0 || rays.geometry[k] == kMiss) continue;
    FlowPixel& flow = lanes[k].flow;
    if (hits.instance[first + k] == kMiss) {
      flow.occluded = 1;
      continue;
    }
    const SurfaceRef seen = next_->Resolve(rays.geometry[k], rays.instance[k], rays.primitive[k]);
    const bool itself = seen.instance == hits.instance[first + k] && seen.triangle == hits.triangle[first + k];
    if (!itself && rays.t_far[k] < flow.range * (1 - kFlowRelative) - kFlowMetres) flow.occluded = 1;
  }
}

void FlowTracer::Fill(const HitBatch& hits, const LabelTile& labels, const TileTarget& target, Image<FlowPixel>& out) const {
  for (int first = 0; first < kTilePixels; first += 16) {
    alignas(64) int valid[16];
    Lane lanes[16];
    int64_t index[16];
    bool any = false;
    for (int k = 0; k < 16; ++k) {
      const TilePixel pixel = PixelOfPacketIndex(target.shape, first + k);
      index[k] = ImageIndex(target, pixel);
      // A pixel without a ray, or whose ray met nothing in a closed room, leads nowhere.
      const bool has_point = index[k] >= 0 && labels.entity[first + k] != kNoEntity;
      lanes[k] = has_point ? Follow(hits, first + k, pixel, target) : Lane{{}, {0, 0, 0, 1, {}}, false};
      valid[k] = has_point && lanes[k].in_picture && lanes[k].flow.occluded == 0 ? -1 : 0;
      any |= valid[k] != 0;
    }
    if (any) Occlude(hits, first, valid, lanes);
    for (int k = 0; k < 16; ++k) {
      if (index[k] >= 0) out.pixels()[static_cast<size_t>(index[k])] = lanes[k].flow;
    }
  }
}

}  // namespace airsim360::internal

#include "airsim360/render/shading/roof_map.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/render/indoor/ray_packet.h"
#include "airsim360/render/shading/probe_rays.h"
#include "airsim360/render/shared/roofs_scalar.h"
#include "airsim360/scene/material.h"

namespace airsim360::internal {
namespace {

constexpr float kFinest = 0.25f, kOpenGround = -1e30f;
// Metres about the spawn that are looked at: texels are 0.8 m then.
constexpr float kRoofsReach = 400;
// A ray that met a leaf looks on this many metres below it, so often at the most.
constexpr float kLeafStep = 1;
constexpr int kMostLeaves = 12;

// The least or the greatest of each texel and its `reach` neighbours each way along a row.
template <class Choose>
void AlongRows(int size, int reach, const Choose& choose, const TableVector<float>& from, TableVector<float>& to, bool columns) {
  ParallelFor(size, [&](int64_t line) {
    for (int i = 0; i < size; ++i) {
      const auto at = [&](int k) {
        const auto along = static_cast<size_t>(std::clamp(k, 0, size - 1)), across = static_cast<size_t>(line);
        return columns ? along * static_cast<size_t>(size) + across : across * static_cast<size_t>(size) + along;
      };
      float chosen = from[at(i)];
      for (int k = i - reach; k <= i + reach; ++k) chosen = choose(chosen, from[at(k)]);
      to[at(i)] = chosen;
    }
  });
}

bool IsLeaf(const RayTracer& tracer, const SurfaceTables& tables, const RayHit16& rays, int lane) {
  const SurfaceRef ref = tracer.Resolve(rays.geometry[lane], rays.instance[lane], rays.primitive[lane]);
  const TriangleRecord& triangle = tables.triangles[tables.instances[ref.instance].first_triangle + ref.triangle];
  return tables.materials[triangle.material & ~kMirroredUv].kind == static_cast<float>(SurfaceKind::kFoliage);
}

}  // namespace

RoofMap::RoofMap(const RayTracer& tracer, const SurfaceTables& tables, int size) {
  const Box3f box = DetailAround(tracer.scene(), kRoofsReach);
  if (box.empty()) return;
  // What falls onto a high roof would meet z = 0 elsewhere.
  const float low = std::min(box.min.z, 0.0f), high = std::max(box.max.z, 0.0f);
  left_ = box.min.x - high * kRainLean, near_ = box.min.y;
  const float extent = std::max(box.max.x - low * kRainLean - left_, box.max.y - near_);
  size_ = std::clamp(static_cast<int>(extent / kFinest) / 4 * 4 + 4, 8, size);
  texel_ = extent / static_cast<float>(size_);
  heights_.assign(static_cast<size_t>(size_) * static_cast<size_t>(size_), kOpenGround);
  Bake(tracer, tables, tracer.scene().bounds.max.z + 1);
  LeaveThinThings();
}

// Rays from above everything, in blocks of 4 x 4 texels.
void RoofMap::Bake(const RayTracer& tracer, const SurfaceTables& tables, float top) {
  const Vec3f down = Normalized(Vec3f{-kRainLean, 0, -1});
  ParallelFor(size_ / 4, [&](int64_t block_row) {
    const FlushDenormals flush;
    const int y = static_cast<int>(block_row) * 4;
    for (int x = 0; x < size_; x += 4) {
      RayPacket packet(kMaskAll);
      for (int i = 0; i < 16; ++i) {
        const float at_x = left_ + (static_cast<float>(x + (i & 3)) + 0.5f) * texel_,
                    at_y = near_ + (static_cast<float>(y + (i >> 2)) + 0.5f) * texel_;
        packet.Set(i, {at_x + top * kRainLean, at_y, top}, down, INFINITY);
      }
      for (int step = 0; step < kMostLeaves; ++step) {
        tracer.Intersect16(packet.valid, packet.rays, true);
        bool leaves = false;
        for (int i = 0; i < 16; ++i) {
          if (packet.valid[i] == 0) continue;
          packet.valid[i] = 0;
          if (packet.rays.geometry[i] == kMiss) continue;
          const Vec3f p = packet.Origin(i) + down * packet.rays.t_far[i];
          if (IsLeaf(tracer, tables, packet.rays, i)) {
            packet.Set(i, p + down * kLeafStep, down, INFINITY);
            leaves = true;
          } else {
            heights_[static_cast<size_t>(y + (i >> 2)) * static_cast<size_t>(size_) + static_cast<size_t>(x + (i & 3))] = p.z;
          }
        }
        if (!leaves) break;
      }
    }
  });
}

void RoofMap::LeaveThinThings() {
  const auto lower = [](float a, float b) { return std::min(a, b); };
  const auto higher = [](float a, float b) { return std::max(a, b); };
  TableVector<float> between(heights_.size());
  AlongRows(size_, 1, lower, heights_, between, false);
  AlongRows(size_, 1, lower, between, heights_, true);
  AlongRows(size_, 2, higher, heights_, between, false);
  AlongRows(size_, 2, higher, between, heights_, true);
}

RoofView RoofMap::view() const {
  if (heights_.empty()) return {};
  return {heights_.data(), size_, left_, near_, 1 / texel_, kRainLean};
}

bool RoofMap::Hides(Vec3f p) const { return scalar::roof_hides(view(), p); }

}  // namespace airsim360::internal

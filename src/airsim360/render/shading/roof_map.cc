#include "airsim360/render/shading/roof_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/render/indoor/ray_packet.h"
#include "airsim360/render/shading/probe_rays.h"
#include "airsim360/render/shared/precipitation_scalar.h"
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
  return tables.materials[triangle.material & ~kMirroredUv].kind == kFoliage;
}

struct FallingRay {
  size_t texel;
  Vec3f origin;
};

// Sends rays down and keeps the height of what they meet; those that met a leaf are left, to go on below it.
void FollowRain(const RayTracer& tracer, const SurfaceTables& tables, std::vector<FallingRay>& falling, TableVector<float>& heights) {
  const Vec3f down = Normalized(Vec3f{-kRainLean, 0, -1});
  size_t left = 0;
  for (size_t first = 0; first < falling.size(); first += 16) {
    RayPacket packet(kMaskAll);
    const int count = static_cast<int>(std::min<size_t>(16, falling.size() - first));
    for (int i = 0; i < count; ++i) packet.Set(i, falling[first + static_cast<size_t>(i)].origin, down, INFINITY);
    tracer.Intersect16(packet.valid, packet.rays, true);
    for (int i = 0; i < count; ++i) {
      const size_t texel = falling[first + static_cast<size_t>(i)].texel;
      const Vec3f p = packet.Origin(i) + down * packet.rays.t_far[i];
      const bool hit = packet.Hit(i), leaf = hit && IsLeaf(tracer, tables, packet.rays, i);
      heights[texel] = hit && !leaf ? p.z : kOpenGround;
      if (leaf) falling[left++] = {texel, p + down * kLeafStep};
    }
  }
  falling.resize(left);
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

// Rays from above everything onto one texel of 2 x 2, and onto the others where heights differ about it, except under leaves, where
// branches would differ everywhere: what is narrower than three texels does not count.
void RoofMap::Bake(const RayTracer& tracer, const SurfaceTables& tables, float top) {
  const auto size = static_cast<size_t>(size_);
  std::vector<uint8_t> under_leaves(heights_.size());
  const auto first_of_four = [](int i) { return i / 2 * 2; };
  const auto at = [&](int x, int y) { return static_cast<size_t>(y) * size + static_cast<size_t>(x); };
  // Of a strip of four rows, those that are wanted.
  const auto look = [&](int64_t strip, const auto& wanted) {
    const FlushDenormals flush;
    std::vector<FallingRay> falling;
    for (int i = 0; i < 4 * size_; ++i) {
      const int x = i / 16 * 4 + i % 4, y = static_cast<int>(strip) * 4 + i % 16 / 4;  // in blocks of 4 x 4
      if (!wanted(x, y)) continue;
      const float at_x = left_ + (static_cast<float>(x) + 0.5f) * texel_ + top * kRainLean;
      const float at_y = near_ + (static_cast<float>(y) + 0.5f) * texel_;
      falling.push_back({at(x, y), {at_x, at_y, top}});
    }
    for (int step = 0; step < kMostLeaves && !falling.empty(); ++step) {
      FollowRain(tracer, tables, falling, heights_);
      for (const FallingRay& ray : falling) under_leaves[ray.texel] = 1;
    }
  };
  ParallelFor(size_ / 4, [&](int64_t strip) { look(strip, [&](int x, int y) { return x == first_of_four(x) && y == first_of_four(y); }); });
  ParallelFor(size_ / 4, [&](int64_t strip) {
    look(strip, [&](int x, int y) {
      const int first_x = first_of_four(x), first_y = first_of_four(y);
      if (x == first_x && y == first_y) return false;
      const size_t first = at(first_x, first_y);
      float least = heights_[first], most = least;
      for (int i = 0; i < 9; ++i) {
        const size_t near = at(std::clamp(first_x + 2 * (i % 3 - 1), 0, size_ - 2), std::clamp(first_y + 2 * (i / 3 - 1), 0, size_ - 2));
        if (under_leaves[near] != 0) continue;
        least = std::min(least, heights_[near]), most = std::max(most, heights_[near]);
      }
      heights_[at(x, y)] = heights_[first];
      return under_leaves[first] == 0 && most - least > ROOF_ABOVE;
    });
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

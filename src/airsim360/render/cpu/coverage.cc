#include "airsim360/render/cpu/coverage.h"

#include <algorithm>
#include <atomic>

#include "airsim360/base/parallel.h"
#include "airsim360/render/frame/antialias.h"

namespace airsim360::internal {
namespace {

// The entities that the rays of up to 256 pixels met, the rays going 16 at a time.
class EntitySamples {
 public:
  EntitySamples(const CoverageTask& task, const TileKernels& kernels) : task_(task), kernels_(kernels) {
    kernels.init(task.origin.x, task.origin.y, task.origin.z, packet_);
  }

  void Add(int pixel, EntityId entity) {
    if (entity != kNoEntity) seen_[pixel][count_[pixel]++] = entity;
  }
  void AddRay(int pixel, Vec3d direction) {
    packet_.direction_x[lanes_] = static_cast<float>(direction.x);
    packet_.direction_y[lanes_] = static_cast<float>(direction.y);
    packet_.direction_z[lanes_] = static_cast<float>(direction.z);
    owner_[lanes_] = pixel;
    if (++lanes_ == 16) Finish();
  }

  void Finish() {
    if (lanes_ == 0) return;
    alignas(64) int valid[16];
    TraceLanes(*task_.tracer, task_.labels.sky_entity != kNoEntity, lanes_, valid, packet_);
    kernels_.resolve(task_.labels, packet_, valid, 0, false, labels_);
    for (int i = 0; i < lanes_; ++i) Add(owner_[i], labels_.entity[i]);
    lanes_ = 0;
  }

  // The largest shares; of equal ones the lower id first.
  CoveragePixel Tally(int pixel) {
    CoveragePixel out;
    EntityId* begin = seen_[pixel];
    EntityId* end = begin + count_[pixel];
    std::sort(begin, end);
    for (EntityId* run = begin; run != end;) {
      EntityId* next = std::upper_bound(run, end, *run);
      Insert(*run, static_cast<float>(next - run) / static_cast<float>(count_[pixel]), out);
      run = next;
    }
    return out;
  }

 private:
  static void Insert(EntityId entity, float share, CoveragePixel& out) {
    int place = CoveragePixel::kEntities;
    while (place > 0 && out.share[place - 1] < share) --place;
    for (int k = CoveragePixel::kEntities - 1; k > place; --k) {
      out.entity[k] = out.entity[k - 1];
      out.share[k] = out.share[k - 1];
    }
    if (place == CoveragePixel::kEntities) return;
    out.entity[place] = entity;
    out.share[place] = share;
  }

  const CoverageTask& task_;
  const TileKernels& kernels_;
  RayHit16 packet_;
  LabelTile labels_;
  int lanes_ = 0;
  int owner_[16];
  EntityId seen_[kTilePixels][kMaxEdgeSamples];
  int count_[kTilePixels] = {};
};

bool OnSilhouette(const Image<EntityId>& entity, int x, int y, bool wraps) {
  const int w = entity.width(), h = entity.height();
  const EntityId here = entity(x, y);
  const int left = x > 0 ? x - 1 : wraps ? w - 1 : x, right = x < w - 1 ? x + 1 : wraps ? 0 : x;
  return entity(left, y) != here || entity(right, y) != here || entity(x, std::max(y - 1, 0)) != here ||
         entity(x, std::min(y + 1, h - 1)) != here;
}

}  // namespace

int64_t CoveragePass::Run(const CoverageTask& task, Image<CoveragePixel>& out) {
  MakeSampleOffsets(*task.rays, task.samples, offsets_);
  const RayField& field = task.rays->field();
  const int across = (field.width + kTileSize - 1) / kTileSize, down = (field.height + kTileSize - 1) / kTileSize;
  std::atomic<int64_t> ray_count = 0;
  ParallelFor(int64_t{across} * down, [&](int64_t tile) {
    ray_count += RunTile(task, static_cast<int>(tile % across) * kTileSize, static_cast<int>(tile / across) * kTileSize, out);
  });
  return ray_count;
}

int CoveragePass::RunTile(const CoverageTask& task, int column, int row, Image<CoveragePixel>& out) const {
  const RayField& field = task.rays->field();
  const FlushDenormals flush_denormals;
  EntitySamples samples(task, kernels_);
  struct EdgePixel {
    int x, y;  // of the image
  } edges[kTilePixels];
  int edge_count = 0, ray_count = 0;
  for (int i = 0; i < kTilePixels; ++i) {
    const int c = column + (i & 15), y = row + (i >> 4);
    if (c >= field.width || y >= field.height) continue;
    const int x = c - task.rays->column_shift() + (c < task.rays->column_shift() ? field.width : 0);
    const EntityId center = (*task.entity)(x, y);
    out(x, y) = {{center}, {center != kNoEntity ? 1.0f : 0.0f}};
    if (center == kNoEntity || task.samples < 2 || !OnSilhouette(*task.entity, x, y, field.separable)) continue;

    const int pixel = edge_count++;
    edges[pixel] = {x, y};
    samples.Add(pixel, center);
    const PixelOffset* offsets = SampleOffsets(offsets_, PixelKey(c, y, field.width), task.samples);
    for (int s = 1; s < task.samples; ++s) {
      Vec3d direction;
      if (!task.rays->Direction(c, y, offsets[s - 1], direction)) continue;
      samples.AddRay(pixel, direction);
      ++ray_count;
    }
  }
  samples.Finish();
  for (int i = 0; i < edge_count; ++i) out(edges[i].x, edges[i].y) = samples.Tally(i);
  return ray_count;
}

}  // namespace airsim360::internal

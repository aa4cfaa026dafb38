#include "airsim360/render/high/high_edges.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/render/frame/antialias.h"
#include "airsim360/render/frame/edge_rays.h"
#include "airsim360/render/shared/shading_constants.h"

namespace airsim360::internal {
namespace {

constexpr float kMostlyWhite = 0.35f;  // of what is nearly white: more light makes such a pixel hardly brighter

// In rooms: light of an edge pixel above what shows as nearly white.
struct AboveWhite {
  int x, y;
  Rgb32f light;
};

Rgb32f& RadianceOf(const HighEdgeTask& task, int x, int y) {
  const int width = task.rays->field().width, column = x - task.rays->column_shift();
  return (*task.radiance)(column < 0 ? column + width : column, y);
}

float Luminance(Rgb32f c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

bool IsWhite(const HighEdgeTask& task, Rgb32f c) { return Luminance(c) * task.exposure >= kMostlyWhite * kNearWhite; }

// Gives it to white pixels beside, or to the pixel itself if it is one: edges stay smooth, and what lamps and highlights send to the
// eye is all there. What is alone stays dim, or it would sparkle.
void GiveAway(const HighEdgeTask& task, const AboveWhite& above) {
  const RayField& field = task.rays->field();
  Rgb32f* white[9];
  int count = 0;
  if (Rgb32f& own = RadianceOf(task, above.x, above.y); IsWhite(task, own)) {
    white[count++] = &own;
  } else {
    for (int k = 0; k < 9; ++k) {
      int u = above.x + k % 3 - 1;
      const int v = above.y + k / 3 - 1;
      if (v < 0 || v >= field.height || (!field.separable && (u < 0 || u >= field.width))) continue;
      u = (u + field.width) % field.width;
      if (Rgb32f& other = RadianceOf(task, u, v); IsWhite(task, other)) white[count++] = &other;
    }
  }
  for (Rgb32f* c : std::span(white, static_cast<size_t>(count))) {
    const float share = 1 / static_cast<float>(count);
    c->r += above.light.r * share, c->g += above.light.g * share, c->b += above.light.b * share;
  }
}

// One tile's edge pixels.
class EdgeTile : public EdgeRays {
 public:
  EdgeTile(const HighEdgeTask& task, const TileKernels& kernels, HighBuffers& buffers, int column, int row)
      : EdgeRays(task, kernels), task_(task), buffers_(buffers), column_(column), row_(row) {}

  void AddPixel(int x, int y) {
    x_[pixel_count_] = static_cast<uint8_t>(x), y_[pixel_count_] = static_cast<uint8_t>(y);
    AddColor(pixel_count_, Radiance(pixel_count_));
    ++pixel_count_;
  }
  int x(int pixel) const { return column_ + x_[pixel]; }
  int y(int pixel) const { return row_ + y_[pixel]; }

  void StoreMeans(std::vector<AboveWhite>& above) {
    for (int i = 0; i < pixel_count_; ++i) {
      const float scale = 1 / static_cast<float>(count_[i]);
      Radiance(i) = {r_[i] * scale, g_[i] * scale, b_[i] * scale};
      const Rgb32f rest = above_[i];
      if (task_.gloss && Luminance(rest) > 0) above.push_back({x(i), y(i), {rest.r * scale, rest.g * scale, rest.b * scale}});
    }
  }

 private:
  Rgb32f& Radiance(int pixel) const { return RadianceOf(task_, x(pixel), y(pixel)); }

  void AddColor(int pixel, Rgb32f c) {
    const float exposed = Luminance(c) * task_.exposure, w = kNearWhite / std::max(exposed, kNearWhite);
    r_[pixel] += c.r * w, g_[pixel] += c.g * w, b_[pixel] += c.b * w;
    above_[pixel].r += c.r * (1 - w), above_[pixel].g += c.g * (1 - w), above_[pixel].b += c.b * (1 - w);
    ++count_[pixel];
  }

  void Traced(const int* valid, int packet) override { kernels_.resolve(task_.labels, packet_, valid, packet, true, labels_); }

  // The pixel around whose surface is most like what sample i met, and how unlike that is; -1 = none.
  int64_t MostAlike(int i, float& best_cost) const {
    const int cx = x(owner_[i]), cy = y(owner_[i]), width = buffers_.range.width();
    const bool wraps = task_.rays->field().separable;
    const Vec3f n{labels_.normal_x[i], labels_.normal_y[i], labels_.normal_z[i]};
    const float range = labels_.range[i];
    int64_t best = -1;
    best_cost = INFINITY;
    for (int v = std::max(0, cy - 1); v <= std::min(buffers_.range.height() - 1, cy + 1); ++v) {
      for (int dx = -1; dx <= 1; ++dx) {
        int u = cx + dx;
        if (!wraps && (u < 0 || u >= width)) continue;
        u = u < 0 ? u + width : u >= width ? u - width : u;
        if (buffers_.range(u, v) == 0) continue;
        const float cost = (buffers_.entity(u, v) == labels_.entity[i] ? 0.0f : 1.0f) + 1 - Dot(n, buffers_.normal(u, v)) +
                           std::fabs(buffers_.range(u, v) - range) / (range + kEdgeRange) +
                           (buffers_.light_samples(u, v) == 0 ? 0.5f : 0.0f) +
                           kEdgePlace * static_cast<float>(dx * dx + (v - cy) * (v - cy));
        if (cost < best_cost) best_cost = cost, best = int64_t{v} * width + u;
      }
    }
    return best;
  }

  // Light of the pixels around; the sun too, where the surface is the same, for there it is known better than
  // by one ray.
  void Shade() override {
    Rgb32f around[HitBatch::kCapacity];
    int64_t pixel_of[HitBatch::kCapacity];
    alignas(64) float sun_known[HitBatch::kCapacity];
    for (int i = 0; i < hits_.count; ++i) {
      sun_known[i] = -1, pixel_of[i] = -1;
      if (hits_.instance[i] == kMiss) continue;
      float cost;
      const int64_t pixel = pixel_of[i] = MostAlike(i, cost);
      if (pixel < 0) continue;
      around[i] = buffers_.light.pixels()[static_cast<size_t>(pixel)];
      if (cost < kSameSurfaceCost) sun_known[i] = buffers_.Sun(pixel);
    }
    std::optional<GlossPixels> gloss;
    if (task_.gloss) gloss.emplace();
    ShadeHigh(*task_.shader, task_.sun_map, hits_, nullptr, sun_known, terms_, shaded_, gloss ? &*gloss : nullptr);
    if (gloss && gloss->any) AddGloss(*gloss, pixel_of);
    const LightTerms& t = terms_;
    for (int i = 0; i < hits_.count; ++i) {
      const float sun = shaded_.sun_seen[i];
      AddColor(owner_[i], {t.ambient_r[i] * around[i].r + t.sun_r[i] * sun + t.rest_r[i],
                           t.ambient_g[i] * around[i].g + t.sun_g[i] * sun + t.rest_g[i],
                           t.ambient_b[i] * around[i].b + t.sun_b[i] * sun + t.rest_b[i]});
    }
  }

  // What the pixel around mirrors, if it does, is known better than by the sample alone.
  void AddGloss(const GlossPixels& gloss, const int64_t* pixel_of) {
    for (int i = 0; i < hits_.count; ++i) {
      if (gloss.blur_x[i] == 0) continue;
      Vec3f light = gloss.light[i];
      const auto pixel = static_cast<size_t>(pixel_of[i]);
      if (pixel_of[i] >= 0 && buffers_.gloss.blur_x.pixels()[pixel] > 0) {
        const Rgb32f known = buffers_.gloss.light.pixels()[pixel];
        light = {known.r, known.g, known.b};
      }
      terms_.rest_r[i] += gloss.skin[i].x * light.x, terms_.rest_g[i] += gloss.skin[i].y * light.y,
          terms_.rest_b[i] += gloss.skin[i].z * light.z;
    }
  }

  const HighEdgeTask& task_;
  HighBuffers& buffers_;
  int column_, row_;
  uint8_t x_[kTilePixels], y_[kTilePixels];
  float r_[kTilePixels] = {}, g_[kTilePixels] = {}, b_[kTilePixels] = {};
  Rgb32f above_[kTilePixels] = {};
  int count_[kTilePixels] = {};
  LabelTile labels_;
  LightTerms terms_;
  HighTile shaded_;
};

int RefineTile(const HighEdgeTask& task, const TileKernels& kernels, const std::vector<PixelOffset>& offsets, HighBuffers& buffers,
               int column, int row, std::vector<AboveWhite>& above) {
  const RayField& field = task.rays->field();
  bool any = false;
  const int columns = std::min(kTileSize, field.width - column), rows = std::min(kTileSize, field.height - row);
  for (int y = 0; y < rows; ++y) {
    const uint8_t* edges = &buffers.edges(column, row + y);
    for (int x = 0; x < columns; ++x) any |= edges[x] != 0;
  }
  if (!any) return 0;

  // Edge pixels, block by block so that neighbours stay together.
  const FlushDenormals flush;
  EdgeTile tile(task, kernels, buffers, column, row);
  for (int i = 0; i < kTilePixels; ++i) {
    const int x = ((i >> 4) & 3) * 4 + (i & 3), y = (i >> 6) * 4 + ((i >> 2) & 3);
    if (x >= columns || y >= rows) continue;
    if (buffers.edges(column + x, row + y) != 0) tile.AddPixel(x, y);
  }

  // Everything random depends on the canonical pixel alone.
  for (int i = 0; i < tile.pixel_count(); ++i) {
    const uint64_t key = MixBits(static_cast<uint64_t>(tile.y(i)) * static_cast<uint64_t>(field.width) + static_cast<uint64_t>(tile.x(i)) +
                                 (task.seed << 40));
    const PixelOffset* of_pixel = SampleOffsets(offsets, key, task.samples);
    for (int s = 1; s < task.samples; ++s) {
      Vec3d direction;
      if (!task.rays->Direction(tile.x(i), tile.y(i), of_pixel[s - 1], direction)) continue;
      tile.AddRay(i, direction, static_cast<uint32_t>(MixBits(key + static_cast<uint64_t>(s))) | 1u);
    }
  }
  tile.Finish();
  tile.StoreMeans(above);
  return tile.ray_count();
}

}  // namespace

int64_t RefineEdges(const HighEdgeTask& task, const std::vector<PixelOffset>& offsets, HighBuffers& buffers) {
  const TileKernels kernels;
  const int across = buffers.across();
  std::atomic<int64_t> ray_count = 0;
  std::vector<std::vector<AboveWhite>> above(static_cast<size_t>(across * buffers.down()));
  ParallelFor(int64_t{across} * buffers.down(), [&](int64_t tile) {
    ray_count += RefineTile(task, kernels, offsets, buffers, static_cast<int>(tile % across) * kTileSize,
                            static_cast<int>(tile / across) * kTileSize, above[static_cast<size_t>(tile)]);
  });
  for (const std::vector<AboveWhite>& of_tile : above)
    for (const AboveWhite& one : of_tile) GiveAway(task, one);
  return ray_count;
}

}  // namespace airsim360::internal

#include "airsim360/render/high/gloss_filter.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/render/frame/tile_kernel.h"
#include "airsim360/render/high/fit_image.h"

namespace airsim360::internal {
namespace {

constexpr float kFirst = 1.2247f;  // pixels, standard deviation of the first pass
constexpr float kLeast = 0.35f;    // below, an axis is left as it is
constexpr float kOnePlane = 0.9f;  // least cosine between normals
constexpr float kBeside = 0.3f;    // of the range, most difference
constexpr int kMostTaps = 3;       // each way
constexpr float kReach = 2.4f;     // deviations that its taps reach
constexpr int kPasses = 4;
constexpr float kLongest = 1.5f;    // steps of a pass, of the deviation that it finds
constexpr float kMostStretch = 24;  // of columns towards the poles

// Weights of 2 taps + 1 pixels `step` apart.
struct Axis {
  int taps = 0, step = 1;
  float weight[2 * kMostTaps + 1] = {1};

  // The first pass takes as much of every phase of four neighbours, so that their pattern (TileLayout) does not show.
  static Axis First(float deviation) {
    Axis axis;
    if (deviation < kLeast) return axis;
    axis.taps = 2;
    for (int k = 0; k < 5; ++k) axis.weight[k] = k % 4 == 0 ? 0.5f : 1.0f;
    return axis;
  }
  // Pass `pass` of 1 … kPasses - 1 makes up for what those before do not reach. But for the last one no pass takes
  // long steps: with them, images of a lamp that rays of different phases show beside each other would stay apart, as dots.
  static Axis Later(float whole, int pass) {
    float found = kFirst;
    Axis axis;
    for (int k = 1; k <= pass; ++k) {
      const float most = kLongest * found * kMostTaps / kReach;
      const float wanted = std::sqrt(std::max(0.0f, whole * whole - found * found));
      const float deviation = k + 1 == kPasses ? wanted : std::min(wanted, most);
      axis = deviation < kLeast ? Axis() : Spread(deviation);
      found = std::sqrt(found * found + deviation * deviation);
    }
    return axis;
  }

 private:
  // (1 - t^2 / 7 s^2)^2 has the standard deviation s.
  static Axis Spread(float deviation) {
    Axis axis;
    axis.taps = kMostTaps;
    axis.step = std::max(1, static_cast<int>(std::lround(kReach * deviation / kMostTaps)));
    for (int k = -axis.taps; k <= axis.taps; ++k) {
      const float t = static_cast<float>(k * axis.step) / deviation, w = std::max(0.0f, 1 - t * t / 7);
      axis.weight[k + axis.taps] = w * w;
    }
    return axis;
  }
};

class Pass {
 public:
  Pass(const Image<float>& range, const Image<EntityId>& entity, const Image<Vec3f>& normal, bool panorama, int pass,
       const GlossPlanes& gloss)
      : range_(range), entity_(entity), normal_(normal), panorama_(panorama), pass_(pass), gloss_(gloss) {}

  Rgb32f At(const Image<Rgb32f>& from, int x, int y, float stretch) const {
    const auto axis = [this](float deviation) { return pass_ == 0 ? Axis::First(deviation) : Axis::Later(deviation, pass_); };
    const Axis across = axis(gloss_.blur_x(x, y) * stretch), along = axis(gloss_.blur_y(x, y));
    Rgb32f sum{};
    float whole = 0;
    for (int j = -along.taps; j <= along.taps; ++j) {
      const int v = y + j * along.step;
      if (v < 0 || v >= range_.height()) continue;
      for (int i = -across.taps; i <= across.taps; ++i) {
        int u = x + i * across.step;
        if (panorama_) u = (u + range_.width()) % range_.width();
        if (u < 0 || u >= range_.width() || !Alike(x, y, u, v)) continue;
        const float w = across.weight[i + across.taps] * along.weight[j + along.taps];
        const Rgb32f& c = from(u, v);
        sum.r += w * c.r, sum.g += w * c.g, sum.b += w * c.b;
        whole += w;
      }
    }
    return {sum.r / whole, sum.g / whole, sum.b / whole};
  }

 private:
  bool Alike(int x, int y, int u, int v) const {
    return gloss_.blur_x(u, v) > 0 && entity_(u, v) == entity_(x, y) && std::fabs(range_(u, v) - range_(x, y)) < kBeside * range_(x, y) &&
           Dot(normal_(u, v), normal_(x, y)) > kOnePlane;
  }

  const Image<float>& range_;
  const Image<EntityId>& entity_;
  const Image<Vec3f>& normal_;
  bool panorama_;
  int pass_;
  const GlossPlanes& gloss_;
};

template <class Body>
void ForTile(const TileLayout& layout, int column, int row, const Image<float>& blur, const Body& body) {
  for (int slot = 0; slot < 256; ++slot) {
    const int x = column + layout.pixel_of[slot] % kTileSize, y = row + layout.pixel_of[slot] / kTileSize;
    if (x < blur.width() && y < blur.height()) body(slot, x, y);
  }
}

}  // namespace

void GlossPlanes::Resize(int width, int height) {
  Fit(light, width, height), Fit(skin, width, height), Fit(scratch, width, height);
  Fit(blur_x, width, height), Fit(blur_y, width, height);
}

void GlossPlanes::Put(const GlossPixels& pixels, const TileLayout& layout, int column, int row) {
  ForTile(layout, column, row, blur_x, [&](int slot, int x, int y) {
    blur_x(x, y) = pixels.blur_x[slot], blur_y(x, y) = pixels.blur_y[slot];
    if (pixels.blur_x[slot] == 0) return;
    const Vec3f l = pixels.light[slot], s = pixels.skin[slot];
    light(x, y) = {l.x, l.y, l.z}, skin(x, y) = {s.x, s.y, s.z};
  });
}

void GlossPlanes::AddTo(LightTerms& terms, const TileLayout& layout, int column, int row) const {
  ForTile(layout, column, row, blur_x, [&](int slot, int x, int y) {
    if (blur_x(x, y) == 0) return;
    const Rgb32f l = light(x, y), s = skin(x, y);
    terms.rest_r[slot] += s.r * l.r, terms.rest_g[slot] += s.g * l.g, terms.rest_b[slot] += s.b * l.b;
  });
}

void FilterGloss(const Image<float>& range, const Image<EntityId>& entity, const Image<Vec3f>& normal, bool panorama, GlossPlanes& gloss) {
  for (int k = 0; k < kPasses; ++k) {
    const Pass pass(range, entity, normal, panorama, k, gloss);
    ParallelFor(range.height(), [&](int64_t row) {
      const int y = static_cast<int>(row);
      const float latitude = (0.5f - (static_cast<float>(y) + 0.5f) / static_cast<float>(range.height())) * 3.14159265f;
      const float stretch = panorama ? std::min(1 / std::cos(latitude), kMostStretch) : 1;
      for (int x = 0; x < range.width(); ++x)
        if (gloss.blur_x(x, y) > 0) gloss.scratch(x, y) = pass.At(gloss.light, x, y, stretch);
    });
    std::swap(gloss.light, gloss.scratch);
  }
}

}  // namespace airsim360::internal

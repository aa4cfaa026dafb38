#include "airsim360/render/cpu/high_buffers.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

template <class Pixel>
void Fit(Image<Pixel>& image, int width, int height) {
  if (image.width() != width || image.height() != height) image = Image<Pixel>(width, height);
}

int Wrapped(int x, int width) { return x < 0 ? x + width : x >= width ? x - width : x; }

}  // namespace

void HighBuffers::Resize(int width, int height) {
  Fit(range, width, height);
  Fit(entity, width, height);
  Fit(normal, width, height);
  Fit(light, width, height);
  Fit(light_samples, width, height);
  Fit(sun_seen, width, height);
  Fit(sun_smooth, width, height);
  Fit(penumbra, width, height);
  Fit(luma, width, height);
  Fit(edges, width, height);
  terms.resize(static_cast<size_t>(across()) * down());
  smooth.resize(terms.size());
}

namespace {

// How far light is mixed (a normal distribution's deviation, in pixels), by a penumbra's width: where the sum of
// blur and of the noise left of eight rays is least, in shadows of leaves 3 to 8 pixels wide.
constexpr float kOfPenumbra = 0.13f, kLeastSpread = 0.45f, kMostSpread = 2.5f;
constexpr int kMostColumns = 40;

// What the pixels around a pixel are compared with.
class SunNeighbourhood {
 public:
  SunNeighbourhood(const HighBuffers& buffers, const RayField& field, int x, int y)
      : buffers_(buffers),
        field_(field),
        x_(x),
        y_(y),
        entity_(buffers.entity(x, y)),
        normal_(buffers.normal(x, y)),
        range_(buffers.range(x, y)),
        place_(PixelDirection(field, x, y) * range_) {}

  /// Calls visit(u, v, squared distance) for pixels of about the same plane, at most so many rows and columns away.
  template <class Visit>
  void ForPixels(int rows, int columns, int step, const Visit& visit) const {
    for (int v = std::max(0, y_ - rows); v <= std::min(field_.height - 1, y_ + rows); ++v) {
      for (int dx = -columns; dx <= columns; dx += step) {
        int u = x_ + dx;
        if (!field_.separable && (u < 0 || u >= field_.width)) continue;
        u = Wrapped(u, field_.width);
        if (buffers_.entity(u, v) != entity_ || Dot(normal_, buffers_.normal(u, v)) < 0.9f) continue;
        const Vec3f away = PixelDirection(field_, u, v) * buffers_.range(u, v) - place_;
        if (std::fabs(Dot(normal_, away)) < 0.02f + 0.01f * range_) visit(u, v, Dot(away, away));
      }
    }
  }
  float range() const { return range_; }

 private:
  const HighBuffers& buffers_;
  const RayField& field_;
  int x_, y_;
  EntityId entity_;
  Vec3f normal_;
  float range_;
  Vec3f place_;
};

}  // namespace

float SmoothSun(const HighBuffers& buffers, const RayField& field, float cone_angle, int x, int y) {
  const SunNeighbourhood around(buffers, field, x, y);
  // Columns as wide as a row is high.
  const float across =
      field.separable ? static_cast<float>(std::min(1 / field.row_scale[y], field.width / 8.0)) : 1.0f;

  // Width of the penumbra here, for rays that all saw the sun do not know it.
  int sum = 0, count = 0;
  const int square = std::max(1, static_cast<int>(across + 0.5f));
  around.ForPixels(2, 2 * square, square, [&](int u, int v, float) {
    const int code = buffers.penumbra(u, v);
    if (code > 1) sum += code - 2, ++count;
  });
  if (count == 0) return buffers.sun_seen(x, y);
  const float width = static_cast<float>(sum) / (kPenumbraSteps * static_cast<float>(count));

  // A mean by distance along the surface, whatever that is in pixels.
  const float spread = std::min(kLeastSpread + kOfPenumbra * width, kMostSpread);
  const float metres = spread * cone_angle * around.range(), sharpness = 1 / (8 * metres * metres);
  const int rows = static_cast<int>(std::ceil(2 * spread));
  const int columns = std::min(kMostColumns, static_cast<int>(std::ceil(2 * spread * across)));
  float light = 0, weight = 0;
  around.ForPixels(rows, columns, 1, [&](int u, int v, float distance2) {
    float w = std::max(0.0f, 1 - distance2 * sharpness);
    w *= w, w *= w;
    light += buffers.sun_seen(u, v) * w;
    weight += w;
  });
  return weight > 0 ? light / weight : buffers.sun_seen(x, y);
}

}  // namespace airsim360::internal

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
  Fit(penumbra, width, height);
  Fit(radiance, width, height);
  Fit(luma, width, height);
  Fit(edges, width, height);
  terms.resize(static_cast<size_t>(across()) * down());
  smooth.resize(terms.size());
}

bool SameSurface(const HighBuffers& buffers, const RayField& field, int x, int y, int u, int v) {
  if (buffers.entity(u, v) != buffers.entity(x, y)) return false;
  const Vec3f n = buffers.normal(x, y);
  if (Dot(n, buffers.normal(u, v)) < 0.9f) return false;
  // The other point's distance from this one's plane.
  const float range = buffers.range(x, y);
  const float apart =
      Dot(n, PixelDirection(field, u, v)) * buffers.range(u, v) - Dot(n, PixelDirection(field, x, y)) * range;
  return std::fabs(apart) < 0.02f + 0.01f * range;
}

float SmoothSun(const HighBuffers& buffers, const RayField& field, int x, int y) {
  const int radius = buffers.penumbra(x, y), width = field.width, height = field.height;
  float sum = 0, weight = 0;
  for (int v = std::max(0, y - radius); v <= std::min(height - 1, y + radius); ++v) {
    for (int dx = -radius; dx <= radius; ++dx) {
      int u = x + dx;
      if (!field.separable && (u < 0 || u >= width)) continue;
      u = Wrapped(u, width);
      if (!SameSurface(buffers, field, x, y, u, v)) continue;
      sum += buffers.sun_seen(u, v);
      weight += 1;
    }
  }
  return weight > 0 ? sum / weight : buffers.sun_seen(x, y);
}

}  // namespace airsim360::internal

#include "airsim360/render/cpu/high_buffers.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"

namespace airsim360::internal {
namespace {

constexpr int kRowsPerTask = 8;

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
  const float apart = Dot(n, PixelDirection(field, u, v)) * buffers.range(u, v) -
                      Dot(n, PixelDirection(field, x, y)) * range;
  return std::fabs(apart) < 0.02f + 0.01f * range;
}

void MeanOverPhases(const HighBuffers& buffers, const RayField& field, Image<Rgb32f>& out) {
  const int width = buffers.range.width(), height = buffers.range.height();
  if (out.width() != width || out.height() != height) out = Image<Rgb32f>(width, height);
  ParallelFor((height + kRowsPerTask - 1) / kRowsPerTask, [&](int64_t task) {
    const int first = static_cast<int>(task) * kRowsPerTask;
    for (int y = first; y < std::min(first + kRowsPerTask, height); ++y) {
      for (int x = 0; x < width; ++x) {
        float r = 0, g = 0, b = 0, weight = 0;
        if (buffers.light_samples(x, y) != 0) {
          for (int dy = -2; dy <= 2; ++dy) {
            const int v = y + dy;
            if (v < 0 || v >= height) continue;
            for (int dx = -2; dx <= 2; ++dx) {
              int u = x + dx;
              if (!field.separable && (u < 0 || u >= width)) continue;
              u = Wrapped(u, width);
              if (buffers.light_samples(u, v) == 0 || !SameSurface(buffers, field, x, y, u, v)) continue;
              const float w = static_cast<float>(buffers.light_samples(u, v)) * (std::abs(dx) == 2 ? 0.5f : 1) *
                              (std::abs(dy) == 2 ? 0.5f : 1);
              const Rgb32f c = buffers.light(u, v);
              r += c.r * w, g += c.g * w, b += c.b * w, weight += w;
            }
          }
        }
        const float scale = weight > 0 ? 1 / weight : 0;
        out(x, y) = {r * scale, g * scale, b * scale};
      }
    }
  });
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

#include "airsim360/render/shading/sun_pixels.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

constexpr float kScale = 32767;
constexpr int kLeastPixels = 3;  // fewer are no surface but a detail

int16_t Packed(float x) { return static_cast<int16_t>(std::lrint(x * kScale)); }

}  // namespace

void KeepSun(const RaySet& rays, const SurfaceSet& s, const bool* asked, SunPixel* out) {
  for (int i = 0; i < rays.count; ++i) {
    const float offset = s.gx[i] * (s.px[i] - rays.ox[i]) + s.gy[i] * (s.py[i] - rays.oy[i]) +
                         s.gz[i] * (s.pz[i] - rays.oz[i]);
    const int16_t state = !asked[i]          ? SunPixel::kUnknown
                          : s.sunlit[i] == 0 ? SunPixel::kDark
                          : s.sunlit[i] == 1 ? SunPixel::kLit
                                             : SunPixel::kUnknown;
    out[rays.slot[i]] = {Packed(s.gx[i]), Packed(s.gy[i]), Packed(s.gz[i]), state, offset};
  }
}

float GuessSun(const SunNeighbours& around, const RaySet& rays, const SurfaceSet& s, int i) {
  constexpr float kSameNormal = 0.98f * kScale;
  const float x = s.px[i] - rays.ox[i], y = s.py[i] - rays.oy[i], z = s.pz[i] - rays.oz[i];
  const float thickness = 0.005f + 0.001f * rays.distance[i];
  const int column = around.x[rays.slot[i]], row = around.y[rays.slot[i]];
  int alike[3] = {};  // by state
  for (int v = std::max(0, row - 1); v <= std::min(around.height - 1, row + 1); ++v) {
    for (int dx = -1; dx <= 1; ++dx) {
      int u = column + dx;
      if (u < 0 || u >= around.width) {
        if (!around.wraps) continue;
        u = u < 0 ? u + around.width : u - around.width;
      }
      const SunPixel& pixel = around.pixels[static_cast<int64_t>(v) * around.width + u];
      const float nx = pixel.nx, ny = pixel.ny, nz = pixel.nz;
      if (nx * s.gx[i] + ny * s.gy[i] + nz * s.gz[i] < kSameNormal) continue;
      const float apart = (nx * x + ny * y + nz * z) * (1 / kScale) - pixel.offset;
      if (std::fabs(apart) < thickness) ++alike[pixel.state];
    }
  }
  const int dark = alike[SunPixel::kDark], lit = alike[SunPixel::kLit];
  if (alike[SunPixel::kUnknown] > 0 || (dark > 0 && lit > 0) || dark + lit < kLeastPixels) return -1;
  return lit > 0 ? 1.0f : 0.0f;
}

}  // namespace airsim360::internal

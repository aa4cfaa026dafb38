#include "airsim360/render/filter/tone_map.h"

#include <algorithm>

#include "airsim360/base/parallel.h"
#include "airsim360/render/shared/shading_kernels.h"

namespace airsim360 {

void ToneMapImage(const Image<Rgb32f>& light, float exposure, ToneCurve tone, Image<Rgb8>& out) {
  const int width = light.width(), height = light.height();
  if (out.width() != width || out.height() != height) out = Image<Rgb8>(width, height);
  const auto map = AIRSIM360_SELECT_KERNEL(ToneMapRow);
  ParallelFor(height, [&](int64_t row) {
    const int y = static_cast<int>(row);
    constexpr int kPart = 256;
    alignas(64) float r[kPart], g[kPart], b[kPart];
    for (int first = 0; first < width; first += kPart) {
      const int count = std::min(kPart, width - first);
      for (int i = 0; i < count; ++i) {
        const Rgb32f c = light(first + i, y);
        r[i] = c.r, g[i] = c.g, b[i] = c.b;
      }
      map(r, g, b, count, exposure, static_cast<int>(tone), &out(first, y));
    }
  });
}

}  // namespace airsim360

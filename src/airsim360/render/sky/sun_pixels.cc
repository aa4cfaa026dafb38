#include "airsim360/render/sky/sun_pixels.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace airsim360::internal {
namespace {

constexpr float kScale = 32767;
constexpr int kLeastPixels = 3;  // fewer are no surface but a detail
constexpr float kAlike = 1.25f;  // brightest to darkest of reflections that stand for one another
constexpr float kLeafReach = 8;  // how far apart leaves may be that share the sun: widths of an edge sample's ray

constexpr int kLeastExponent = -23;  // of packed light

float PowerOf2(int n) { return std::bit_cast<float>(static_cast<uint32_t>(n + 127) << 23); }

// Rounded; std::lrint is a call.
int16_t Packed(float x) { return static_cast<int16_t>(static_cast<int>(x * kScale + (x < 0 ? -0.5f : 0.5f))); }

SunPixel::State StateOf(bool asked, float sunlit, bool leaf) {
  if (!asked || (sunlit != 0 && sunlit != 1)) return SunPixel::kUnknown;
  if (leaf) return sunlit == 0 ? SunPixel::kDarkLeaf : SunPixel::kLitLeaf;
  return sunlit == 0 ? SunPixel::kDark : SunPixel::kLit;
}

// Calls visit(pixel) for the nine pixels around a hit until it returns false.
template <class Visit>
void ForPixelsAround(const SunNeighbours& around, uint32_t slot, Visit&& visit) {
  const int column = around.x[slot], row = around.y[slot];
  int columns[3], count = 0;
  for (int u = column - 1; u <= column + 1; ++u) {
    if (u >= 0 && u < around.width)
      columns[count++] = u;
    else if (around.wraps)
      columns[count++] = u < 0 ? u + around.width : u - around.width;
  }
  for (int v = std::max(0, row - 1); v <= std::min(around.height - 1, row + 1); ++v) {
    const SunPixel* pixels = around.pixels + static_cast<int64_t>(v) * around.width;
    for (int k = 0; k < count; ++k) {
      if (!visit(pixels[columns[k]])) return;
    }
  }
}

// The plane under a hit, seen from the camera.
class PlaneOf {
 public:
  PlaneOf(const RaySet& rays, const SurfaceSet& s, int i)
      : g_{s.gx[i], s.gy[i], s.gz[i]},
        p_{s.px[i] - rays.ox[i], s.py[i] - rays.oy[i], s.pz[i] - rays.oz[i]},
        thickness_(0.005f + 0.001f * rays.distance[i]) {}
  bool Holds(const SunPixel& pixel) const {
    constexpr float kSameNormal = 0.98f * kScale;
    const Vec3f n{static_cast<float>(pixel.nx), static_cast<float>(pixel.ny), static_cast<float>(pixel.nz)};
    if (Dot(n, g_) < kSameNormal) return false;
    return std::fabs(Dot(n, p_) * (1 / kScale) - pixel.offset) < thickness_;
  }

 private:
  Vec3f g_, p_;
  float thickness_;
};

float GuessLeafSun(const SunNeighbours& around, const RaySet& rays, int i) {
  const float reach = kLeafReach * rays.width[i];
  int dark = 0, lit = 0;
  ForPixelsAround(around, rays.slot[i], [&](const SunPixel& pixel) {
    if (std::fabs(pixel.offset - rays.distance[i]) < reach)
      dark += pixel.state == SunPixel::kDarkLeaf, lit += pixel.state == SunPixel::kLitLeaf;
    return true;
  });
  if (dark + lit < kLeastPixels) return -1;
  const auto chance = static_cast<int>(rays.key[i] >> 8) % (dark + lit);
  return chance < lit ? 1.0f : 0.0f;
}

}  // namespace

void KeepSun(const RaySet& rays, const SurfaceSet& s, const bool* asked, SunPixel* out) {
  for (int i = 0; i < rays.count; ++i) {
    const float offset = s.gx[i] * (s.px[i] - rays.ox[i]) + s.gy[i] * (s.py[i] - rays.oy[i]) + s.gz[i] * (s.pz[i] - rays.oz[i]);
    const SunPixel::State state = StateOf(asked[i], s.sunlit[i], s.kind[i] == kFoliage);
    const bool leaf = state == SunPixel::kDarkLeaf || state == SunPixel::kLitLeaf;
    out[rays.slot[i]] = {Packed(s.gx[i]), Packed(s.gy[i]), Packed(s.gz[i]), state, leaf ? rays.distance[i] : offset, 0};
  }
}

float GuessSun(const SunNeighbours& around, const RaySet& rays, const SurfaceSet& s, int i) {
  if (s.kind[i] == kFoliage) return GuessLeafSun(around, rays, i);
  const PlaneOf plane(rays, s, i);
  int dark = 0, lit = 0;
  bool unknown = false;
  ForPixelsAround(around, rays.slot[i], [&](const SunPixel& pixel) {
    if (!plane.Holds(pixel)) return true;
    dark += pixel.state == SunPixel::kDark, lit += pixel.state == SunPixel::kLit;
    unknown |= pixel.state == SunPixel::kUnknown;
    return !unknown && (dark == 0 || lit == 0);
  });
  if (unknown || (dark > 0 && lit > 0) || dark + lit < kLeastPixels) return -1;
  return lit > 0 ? 1.0f : 0.0f;
}

void KeepReflections(const RaySet& rays, const SurfaceSet& s, SunPixel* out) {
  for (int i = 0; i < rays.count; ++i) {
    if (s.traced[i] == 0 || s.kind[i] != kGlass) continue;
    out[rays.slot[i]].reflected = PackLight({s.reflected_r[i], s.reflected_g[i], s.reflected_b[i]});
  }
}

void GuessReflections(const SunNeighbours& around, const RaySet& rays, SurfaceSet& s) {
  for (int i = 0; i < rays.count; ++i) {
    if (s.mirror[i] == 0 || s.kind[i] != kGlass) continue;
    const PlaneOf plane(rays, s, i);
    Vec3f sum;
    float low = INFINITY, high = 0;
    int count = 0;
    ForPixelsAround(around, rays.slot[i], [&](const SunPixel& pixel) {
      if (pixel.reflected == 0 || !plane.Holds(pixel)) return true;
      const Vec3f light = UnpackLight(pixel.reflected);
      sum += light, ++count;
      low = std::min(low, light.x + light.y + light.z), high = std::max(high, light.x + light.y + light.z);
      return high <= kAlike * low;
    });
    if (count < kLeastPixels || high > kAlike * low) continue;
    sum = sum * (1.0f / static_cast<float>(count));
    s.reflected_r[i] = sum.x, s.reflected_g[i] = sum.y, s.reflected_b[i] = sum.z;
    s.traced[i] = 1, s.mirror[i] = 0;
  }
}

uint32_t PackLight(Vec3f light) {
  const auto limited = [](float x) { return x > 0 ? std::min(x, 65000.0f) : 0.0f; };
  const Vec3f c{limited(light.x), limited(light.y), limited(light.z)};
  // The largest is in [256, 512) of its unit, or below where the exponent ends.
  const float most = std::max({c.x, c.y, c.z, 1e-6f});
  const int exponent = std::max(static_cast<int>(std::bit_cast<uint32_t>(most) >> 23) - 127 - 8, kLeastExponent);
  const float scale = PowerOf2(-exponent);
  const auto part = [&](float x) { return std::min(511u, static_cast<uint32_t>(x * scale + 0.5f)); };
  return part(c.x) | part(c.y) << 9 | part(c.z) << 18 | static_cast<uint32_t>(exponent - kLeastExponent + 1) << 27;
}

Vec3f UnpackLight(uint32_t packed) {
  const float scale = PowerOf2(static_cast<int>(packed >> 27) - 1 + kLeastExponent);
  const auto part = [&](int shift) { return static_cast<float>((packed >> shift) & 511u) * scale; };
  return {part(0), part(9), part(18)};
}

}  // namespace airsim360::internal

#include "airsim360/trace/alpha_filter.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

// Texel index of an unwrapped one.
int WrapTexel(int i, int size, Wrap wrap) {
  switch (wrap) {
    case Wrap::kClamp:
      return std::clamp(i, 0, size - 1);
    case Wrap::kRepeat: {
      const int m = i % size;
      return m < 0 ? m + size : m;
    }
    case Wrap::kMirror: {
      const int period = 2 * size;
      int m = i % period;
      if (m < 0) m += period;
      return m < size ? m : period - 1 - m;
    }
  }
  return 0;
}

// Keeps texel arithmetic within int for absurd coordinates; NaN gives 0.
float Limited(float x) { return x > -1e6f ? (x < 1e6f ? x : 1e6f) : -1e6f; }

float BilinearAlpha(const Texture& texture, Vec2f uv) {
  const Image<Rgba8>& image = texture.levels[0];
  const float x = Limited(uv.x) * static_cast<float>(image.width()) - 0.5f;
  const float y = Limited(uv.y) * static_cast<float>(image.height()) - 0.5f;
  const float fx = std::floor(Limited(x)), fy = std::floor(Limited(y));
  const int x0 = WrapTexel(static_cast<int>(fx), image.width(), texture.wrap_u);
  const int x1 = WrapTexel(static_cast<int>(fx) + 1, image.width(), texture.wrap_u);
  const int y0 = WrapTexel(static_cast<int>(fy), image.height(), texture.wrap_v);
  const int y1 = WrapTexel(static_cast<int>(fy) + 1, image.height(), texture.wrap_v);
  const auto row = [&](int y) {
    const float a = image(x0, y).a, b = image(x1, y).a;
    return a + (b - a) * (x - fx);
  };
  const float top = row(y0), bottom = row(y1);
  return (top + (bottom - top) * (y - fy)) * (1.0f / 255.0f);
}

}  // namespace

AlphaTest::AlphaTest(const Material& material, std::span<const Texture> textures)
    : texture_(nullptr),
      transform_(material),
      scale_(material.base_alpha),
      cutoff_(material.alpha_mode == AlphaMode::kMask ? material.alpha_cutoff : 0) {
  if (material.base_color_texture == kNoTexture) return;
  const Texture& texture = textures[static_cast<size_t>(material.base_color_texture)];
  if (!texture.levels.empty() && !texture.levels[0].empty()) texture_ = &texture;
}

bool AlphaTest::Solid(Vec2f uv) const {
  const float alpha = texture_ != nullptr ? BilinearAlpha(*texture_, transform_ * uv) : 1.0f;
  return scale_ * alpha >= cutoff_;
}

bool NeedsAlphaTest(const Material& material) {
  return material.alpha_mode == AlphaMode::kMask &&
         (material.base_color_texture != kNoTexture || material.base_alpha < material.alpha_cutoff);
}

void FilterAlpha(const RTCFilterFunctionNArguments* args) {
  const auto& geometry = *static_cast<const AlphaGeometry*>(args->geometryUserPtr);
  const Mesh& mesh = *geometry.mesh;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const unsigned primitive = RTCHitN_primID(args->hit, args->N, i);
    Vec2f uv;
    if (!mesh.uvs.empty()) {
      const Vec3u triangle =
          mesh.triangles[geometry.triangles.empty() ? primitive : geometry.triangles[primitive]];
      const float u = RTCHitN_u(args->hit, args->N, i), v = RTCHitN_v(args->hit, args->N, i);
      uv = (1 - u - v) * mesh.uvs[triangle.x] + u * mesh.uvs[triangle.y] + v * mesh.uvs[triangle.z];
    }
    if (!geometry.tests[geometry.primitive_test[primitive]].Solid(uv)) args->valid[i] = 0;
  }
}

}  // namespace airsim360::internal

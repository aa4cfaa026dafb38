#include "airsim360/trace/alpha_filter.h"

#include <algorithm>
#include <cmath>
#include <tuple>

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

float Coverage(VertexColor c) { return static_cast<float>(c.a) * (1.0f / 65535.0f); }

// Exact where all corners are alike; corner_mix of the shaders.
float CoverageAt(const Mesh& mesh, Vec3u t, float u, float v) {
  const float a = Coverage(mesh.colors[t.x]), b = Coverage(mesh.colors[t.y]), c = Coverage(mesh.colors[t.z]);
  return a + ((b - a) * u + (c - a) * v);
}

constexpr float kMaxRepeats = 1000;     // of a texture under one triangle
constexpr int64_t kMaxCells = 1 << 16;  // looked at for one triangle
constexpr float kAlphaMargin = 0.01f;   // of 255: more than bilinear weights lose by rounding

struct AlphaRange {
  int lowest = 255, highest = 0;
};

// Alpha of all texels that a bilinear look-up at any point of a triangle reads, its corners in texels counted
// from the centre of the first; false if they are too many.
// `reach`: the largest number, in texels, that takes part in computing them.
bool AlphaUnder(const Texture& texture, const Vec2d (&corners)[3], double reach, AlphaRange& out) {
  const Image<Rgba8>& image = texture.levels[0];
  const double low_y = std::min({corners[0].y, corners[1].y, corners[2].y}), high_y = std::max({corners[0].y, corners[1].y, corners[2].y});
  // Interpolated coordinates are off by some units in the last place.
  const double margin = 1e-3 + 2e-6 * reach;
  int64_t cells = 0;
  for (auto y = static_cast<int>(std::floor(low_y - margin)); y <= high_y + margin; ++y) {
    // The part of the triangle within this row of cells: its corners there and the cuts of its edges.
    double left = 1e30, right = -1e30;
    const double bottom = y - margin, top = y + 1 + margin;
    for (int i = 0; i < 3; ++i) {
      const Vec2d a = corners[i], b = corners[(i + 1) % 3];
      if (a.y >= bottom && a.y <= top) left = std::min(left, a.x), right = std::max(right, a.x);
      for (const double cut : {bottom, top}) {
        if ((a.y < cut) == (b.y < cut)) continue;
        const double x = a.x + (b.x - a.x) * ((cut - a.y) / (b.y - a.y));
        left = std::min(left, x), right = std::max(right, x);
      }
    }
    if (left > right) continue;
    const auto first = static_cast<int>(std::floor(left - margin)), last = static_cast<int>(std::floor(right + margin));
    cells += last - first + 1;
    if (cells > kMaxCells) return false;
    for (const int row : {y, y + 1}) {
      const int wrapped = WrapTexel(row, image.height(), texture.wrap_v);
      for (int x = first; x <= last + 1; ++x) {
        const int alpha = image(WrapTexel(x, image.width(), texture.wrap_u), wrapped).a;
        out.lowest = std::min(out.lowest, alpha);
        out.highest = std::max(out.highest, alpha);
      }
    }
  }
  return true;
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

bool AlphaTest::Solid(Vec2f uv, float coverage) const {
  const float alpha = texture_ != nullptr ? BilinearAlpha(*texture_, transform_ * uv) : 1.0f;
  return scale_ * (alpha * coverage) >= cutoff_;
}

Opacity AlphaTest::Classify(const Mesh& mesh, uint32_t triangle) const {
  AlphaRange range;
  if (texture_ == nullptr) {
    range = {255, 255};
  } else {
    const Vec3u t = mesh.triangles[triangle];
    const bool plain = mesh.uvs.empty();
    const Vec2f uv[3] = {plain ? Vec2f{} : mesh.uvs[t.x], plain ? Vec2f{} : mesh.uvs[t.y], plain ? Vec2f{} : mesh.uvs[t.z]};
    Vec2d corners[3];
    float reach = 0;
    const Image<Rgba8>& image = texture_->levels[0];
    for (int i = 0; i < 3; ++i) {
      const Vec2f p = transform_ * uv[i];
      // Beyond this, coordinates are cut off, or have too few bits to know the texel.
      const UvTransform& m = transform_;
      const float sum = std::fabs(m.m00 * uv[i].x) + std::fabs(m.m01 * uv[i].y) + std::fabs(m.t.x) + std::fabs(m.m10 * uv[i].x) +
                        std::fabs(m.m11 * uv[i].y) + std::fabs(m.t.y);
      if (!(sum < kMaxRepeats)) return Opacity::kMixed;
      reach = std::max(reach, sum);
      corners[i] = {static_cast<double>(p.x) * image.width() - 0.5, static_cast<double>(p.y) * image.height() - 0.5};
    }
    const double texels = std::max(image.width(), image.height());
    if (!AlphaUnder(*texture_, corners, static_cast<double>(reach) * texels, range)) return Opacity::kMixed;
  }
  float lowest = 1, highest = 1;
  if (!mesh.colors.empty()) {
    const Vec3u t = mesh.triangles[triangle];
    std::tie(lowest, highest) = std::minmax({Coverage(mesh.colors[t.x]), Coverage(mesh.colors[t.y]), Coverage(mesh.colors[t.z])});
  }
  const auto solid = [&](float alpha) { return scale_ * (alpha * (1.0f / 255.0f)) >= cutoff_; };
  if (solid(static_cast<float>(range.lowest) * lowest - kAlphaMargin)) return Opacity::kOpaque;
  if (!solid(static_cast<float>(range.highest) * highest + kAlphaMargin)) return Opacity::kClear;
  return Opacity::kMixed;
}

bool NeedsAlphaTest(const Material& material, const Mesh& mesh) {
  return material.alpha_mode == AlphaMode::kMask &&
         (material.base_color_texture != kNoTexture || material.base_alpha < material.alpha_cutoff || !mesh.colors.empty());
}

void FilterAlpha(const RTCFilterFunctionNArguments* args) {
  const auto& geometry = *static_cast<const AlphaGeometry*>(args->geometryUserPtr);
  const Mesh& mesh = *geometry.mesh;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const unsigned primitive = RTCHitN_primID(args->hit, args->N, i);
    const Vec3u triangle = mesh.triangles[geometry.triangles.empty() ? primitive : geometry.triangles[primitive]];
    const float u = RTCHitN_u(args->hit, args->N, i), v = RTCHitN_v(args->hit, args->N, i);
    Vec2f uv;
    if (!mesh.uvs.empty()) uv = (1 - u - v) * mesh.uvs[triangle.x] + u * mesh.uvs[triangle.y] + v * mesh.uvs[triangle.z];
    const float coverage = mesh.colors.empty() ? 1.0f : CoverageAt(mesh, triangle, u, v);
    if (!geometry.tests[geometry.primitive_test[primitive]].Solid(uv, coverage)) args->valid[i] = 0;
  }
}

}  // namespace airsim360::internal

#include "airsim360/worlds/props/drawing.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/image/color.h"
#include "airsim360/worlds/texture/sign_lettering.h"
#include "airsim360/worlds/texture/srgb_codes.h"

namespace airsim360::internal {
namespace {

float Lattice(int x, int y, uint64_t seed) {
  const uint64_t key = MixBits(seed ^ (static_cast<uint64_t>(static_cast<uint32_t>(x)) << 32 | static_cast<uint32_t>(y)));
  return static_cast<float>(key >> 40) * 0x1p-24f;
}

int Wrapped(int i, int period) { return i >= 0 && i < period ? i : ((i % period) + period) % period; }

// As std::floor, which is a call of a function where a processor of any age is asked for.
int FloorToInt(float x) {
  const int toward_zero = static_cast<int>(x);
  return toward_zero - (static_cast<float>(toward_zero) > x);
}

Rgba8 Encode(Vec3f c) {
  static const SrgbCodes code;
  return {code(c.x), code(c.y), code(c.z), 255};
}

}  // namespace

float TileNoise(float x, float y, int period_x, int period_y, uint64_t seed) {
  const int ix = FloorToInt(x), iy = FloorToInt(y);
  const auto ease = [](float t) { return t * t * (3 - 2 * t); };
  const float s = ease(x - static_cast<float>(ix)), t = ease(y - static_cast<float>(iy));
  const int x0 = Wrapped(ix, period_x), x1 = Wrapped(ix + 1, period_x), y0 = Wrapped(iy, period_y), y1 = Wrapped(iy + 1, period_y);
  const float a0 = Lattice(x0, y0, seed), b0 = Lattice(x0, y1, seed);
  const float a = a0 + (Lattice(x1, y0, seed) - a0) * s, b = b0 + (Lattice(x1, y1, seed) - b0) * s;
  return a + (b - a) * t;
}

float TileFractal(float u, float v, int cells_x, int cells_y, int octaves, uint64_t seed) {
  float sum = 0, weight = 0, gain = 1;
  for (int i = 0; i < octaves; ++i) {
    const int nx = cells_x << i, ny = cells_y << i;
    sum += gain * TileNoise(u * static_cast<float>(nx), v * static_cast<float>(ny), nx, ny, seed + static_cast<uint64_t>(i));
    weight += gain;
    gain *= 0.5f;
  }
  return sum / weight;
}

Image<Rgba8> Shade(int width, int height, const std::function<Vec3f(float, float)>& color) {
  Image<Rgba8> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y) = Encode(
          color((static_cast<float>(x) + 0.5f) / static_cast<float>(width), (static_cast<float>(y) + 0.5f) / static_cast<float>(height)));
    }
  }
  return image;
}

Texture NormalsFromHeight(std::string name, int width, int height, float aspect, const std::function<float(float, float)>& height_at) {
  std::vector<float> field(static_cast<size_t>(width) * height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      field[static_cast<size_t>(y) * width + x] = height_at((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                                            (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
    }
  }
  const auto at = [&](int x, int y) { return field[static_cast<size_t>(Wrapped(y, height)) * width + Wrapped(x, width)]; };
  const auto encode = [](float v) { return static_cast<uint8_t>((v * 0.5f + 0.5f) * 255 + 0.5f); };
  Image<Rgba8> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      // +X of the tangent frame is +u, +Y is up in the picture: -v.
      const float du = (at(x + 1, y) - at(x - 1, y)) * 0.5f * static_cast<float>(width);
      const float dv = (at(x, y + 1) - at(x, y - 1)) * 0.5f * static_cast<float>(height) * aspect;
      const Vec3f n = Normalized(Vec3f{-du, dv, 1});
      image(x, y) = {encode(n.x), encode(n.y), encode(n.z), 255};
    }
  }
  return Texture::FromImage(std::move(name), std::move(image), false);
}

Canvas::Canvas(int width, int height, Vec3f background)
    : width_(static_cast<float>(width)), height_(static_cast<float>(height)), image_(width, height, Encode(background)) {}

template <class Hits>
void Canvas::ForPixels(Vec2f min_px, Vec2f max_px, const Hits& hits_of, Vec3f color) {
  const int x0 = std::max(0, static_cast<int>(std::floor(min_px.x))), x1 = std::min(image_.width(), static_cast<int>(std::ceil(max_px.x)));
  const int y0 = std::max(0, static_cast<int>(std::floor(min_px.y))), y1 = std::min(image_.height(), static_cast<int>(std::ceil(max_px.y)));
  const Rgba8 whole = Encode(color);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const int hits = hits_of(x, y);
      if (hits == 0) continue;
      Rgba8& pixel = image_(x, y);
      if (hits == 16) {
        pixel = whole;
        continue;
      }
      const float f = static_cast<float>(hits) / 16;
      const Vec3f under{SrgbToLinear(pixel.r), SrgbToLinear(pixel.g), SrgbToLinear(pixel.b)};
      pixel = Encode(under * (1 - f) + color * f);
    }
  }
}

void Canvas::Fill(Vec2f min_px, Vec2f max_px, const std::function<bool(float, float)>& inside, Vec3f color) {
  ForPixels(
      min_px, max_px,
      [&](int x, int y) {
        int hits = 0;
        for (int k = 0; k < 16; ++k) {
          hits += inside(static_cast<float>(x) + (static_cast<float>(k % 4) + 0.5f) / 4,
                         static_cast<float>(y) + (static_cast<float>(k / 4) + 0.5f) / 4);
        }
        return hits;
      },
      color);
}

void Canvas::Rectangle(Vec2f min, Vec2f max, Vec3f color) {
  const Vec2f lo{min.x * width_, min.y * height_}, hi{max.x * width_, max.y * height_};
  // Of a pixel's 4x4 samples those inside are so many columns times so many rows.
  const auto samples = [](int pixel, float from, float to) {
    int inside = 0;
    for (int k = 0; k < 4; ++k) {
      const float at = static_cast<float>(pixel) + (static_cast<float>(k) + 0.5f) / 4;
      inside += at >= from && at < to;
    }
    return inside;
  };
  ForPixels(
      lo, hi, [&](int x, int y) { return samples(x, lo.x, hi.x) * samples(y, lo.y, hi.y); }, color);
}

void Canvas::Disc(Vec2f center, float r, Vec3f color) {
  const Vec2f c{center.x * width_, center.y * height_};
  const float radius = r * height_;
  Fill(
      c - Vec2f{radius, radius}, c + Vec2f{radius, radius}, [&](float x, float y) { return std::hypot(x - c.x, y - c.y) < radius; }, color);
}

void Canvas::Line(Vec2f a, Vec2f b, float thickness, Vec3f color) {
  const Vec2f p{a.x * width_, a.y * height_}, q{b.x * width_, b.y * height_}, d = q - p;
  const float half = thickness * height_ / 2, length2 = std::max(1e-6f, d.x * d.x + d.y * d.y);
  const Vec2f lo{std::min(p.x, q.x) - half, std::min(p.y, q.y) - half}, hi{std::max(p.x, q.x) + half, std::max(p.y, q.y) + half};
  Fill(
      lo, hi,
      [&](float x, float y) {
        const float t = std::clamp(((x - p.x) * d.x + (y - p.y) * d.y) / length2, 0.0f, 1.0f);
        return std::hypot(x - p.x - t * d.x, y - p.y - t * d.y) < half;
      },
      color);
}

void Canvas::RegularPolygon(Vec2f center, float r, int sides, float turn, Vec3f color) {
  const Vec2f c{center.x * width_, center.y * height_};
  const float radius = r * height_, step = 2 * std::numbers::pi_v<float> / static_cast<float>(sides), apothem = radius * std::cos(step / 2);
  Fill(
      c - Vec2f{radius, radius}, c + Vec2f{radius, radius},
      [&](float x, float y) {
        const float from_corner = std::remainder(std::atan2(c.y - y, x - c.x) - turn - step / 2, step);
        return std::hypot(x - c.x, y - c.y) * std::cos(from_corner) < apothem;
      },
      color);
}

void Canvas::Letters(std::string_view text, Vec2f center, float size, Vec3f color, float stretch) {
  // As wide as cells of six by seven would be, as far as that does not distort the letters.
  const SignLettering line(text);
  const float high = size * height_, cells = 6 * static_cast<float>(text.size()) - 1;
  const float wide = high * std::clamp(cells / 7 * stretch / std::max(0.1f, line.width()), 0.6f, 1.15f);
  const float x0 = center.x * width_ - line.width() * wide / 2, y0 = center.y * height_ - high / 2;
  Fill(
      {x0, y0}, {x0 + line.width() * wide, y0 + high}, [&](float x, float y) { return line.Inked((x - x0) / wide, (y - y0) / high); },
      color);
}

Canvas::Columns::Columns(const Canvas& canvas, const std::function<float(float)>& value) : width_(canvas.width_) {
  for (int x = 0; x < canvas.image_.width(); ++x) values_.push_back(value((static_cast<float>(x) + 0.5f) / width_));
}

void Canvas::Paint(const std::function<Vec3f(float, float, Vec3f)>& color) {
  ParallelFor(image_.height(), [&](int64_t y) {
    for (int x = 0; x < image_.width(); ++x) {
      Rgba8& pixel = image_(x, static_cast<int>(y));
      const Vec3f old{SrgbToLinear(pixel.r), SrgbToLinear(pixel.g), SrgbToLinear(pixel.b)};
      pixel = Encode(color((static_cast<float>(x) + 0.5f) / width_, (static_cast<float>(y) + 0.5f) / height_, old));
    }
  });
}

Texture Canvas::Finish(std::string name) { return Texture::FromImage(std::move(name), std::exchange(image_, Image<Rgba8>{}), true); }

}  // namespace airsim360::internal

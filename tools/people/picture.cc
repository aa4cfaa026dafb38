#include "picture.h"

#include <algorithm>
#include <cmath>

#include "airsim360/image/color.h"

namespace airsim360::bake {
namespace {

double Light(const Rgba8& p) { return 0.3 * p.r + 0.59 * p.g + 0.11 * p.b; }

}  // namespace

void MakeTintable(double spread, Image<Rgba8>& image) {
  constexpr double kMean = 188, kDarkest = 4;
  double sum = 0, logs = 0, squares = 0;
  int count = 0;
  for (const Rgba8& p : image.pixels()) {
    if (p.a < 128) continue;
    const double light = std::max(kDarkest, Light(p));
    sum += light;
    logs += std::log(light);
    squares += std::log(light) * std::log(light);
    ++count;
  }
  if (count == 0) return;
  const double middle = logs / count, deviation = std::sqrt(std::max(0.0, squares / count - middle * middle));
  const double power = deviation > spread ? spread / deviation : 1;
  // Pressed about the geometric mean; the mean after that is `pressed`.
  double pressed = power < 1 ? 0 : std::max(20.0, sum / count);
  const auto curve = [&](double light) { return power < 1 ? std::exp(power * (std::log(std::max(kDarkest, light)) - middle)) : light; };
  if (power < 1) {
    for (const Rgba8& p : image.pixels()) {
      if (p.a >= 128) pressed += curve(Light(p)) / count;
    }
  }
  for (Rgba8& p : image.pixels()) {
    const auto v = static_cast<uint8_t>(std::clamp(curve(Light(p)) * kMean / pressed, 0.0, 255.0));
    p = {v, v, v, p.a};
  }
}

void MakePlain(double most, Image<Rgba8>& image) {
  constexpr double kMean = 188;
  for (Rgba8& p : image.pixels()) {
    const double ratio = std::log(std::max(1.0, Light(p)) / kMean);
    const auto v = static_cast<uint8_t>(std::clamp(kMean * std::exp(most * std::tanh(0.5 * ratio / most)), 0.0, 255.0));
    p = {v, v, v, p.a};
  }
}

namespace {

struct Sum {
  float r = 0, g = 0, b = 0, weight = 0;
};

// Whether the middle of each pixel lies in a triangle.
Image<uint8_t> Covered(const std::vector<std::array<Vec2f, 3>>& uvs, int width, int height) {
  Image<uint8_t> covered(width, height);
  for (const auto& t : uvs) {
    std::array<Vec2f, 3> p;
    for (size_t k = 0; k < 3; ++k) p[k] = {t[k].x * static_cast<float>(width) - 0.5f, t[k].y * static_cast<float>(height) - 0.5f};
    const auto [x0, x1] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [y0, y1] = std::minmax({p[0].y, p[1].y, p[2].y});
    const auto side = [](Vec2f a, Vec2f b, float x, float y) { return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x); };
    for (int y = std::max(0, static_cast<int>(std::ceil(y0))); y <= std::min(height - 1, static_cast<int>(y1)); ++y) {
      for (int x = std::max(0, static_cast<int>(std::ceil(x0))); x <= std::min(width - 1, static_cast<int>(x1)); ++x) {
        const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
        const float a = side(p[0], p[1], fx, fy), b = side(p[1], p[2], fx, fy), c = side(p[2], p[0], fx, fy);
        if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) covered(x, y) = 1;
      }
    }
  }
  return covered;
}

// Halves a picture of sums.
Image<Sum> Halved(const Image<Sum>& fine) {
  Image<Sum> half((fine.width() + 1) / 2, (fine.height() + 1) / 2);
  for (int y = 0; y < fine.height(); ++y) {
    for (int x = 0; x < fine.width(); ++x) {
      const Sum& f = fine(x, y);
      Sum& h = half(x / 2, y / 2);
      h.r += f.r, h.g += f.g, h.b += f.b, h.weight += f.weight;
    }
  }
  // As a mean again, so that every level counts alike.
  for (Sum& h : half.pixels()) {
    if (h.weight > 0) h = {h.r / h.weight, h.g / h.weight, h.b / h.weight, 1};
  }
  return half;
}

}  // namespace

void MakeSkin(Vec3f albedo, const std::vector<std::array<Vec2f, 3>>& uvs, Image<Rgba8>& image) {
  const Image<uint8_t> covered = Covered(uvs, image.width(), image.height());
  uint8_t Rgba8::*const channels[] = {&Rgba8::r, &Rgba8::g, &Rgba8::b};
  const float wanted[] = {albedo.x, albedo.y, albedo.z};
  for (size_t k = 0; k < 3; ++k) {
    std::vector<uint8_t> values;
    for (size_t i = 0; i < image.pixels().size(); ++i) {
      if (covered.pixels()[i]) values.push_back(image.pixels()[i].*channels[k]);
    }
    if (values.empty()) return;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    const float scale = wanted[k] / std::max(1e-3f, SrgbToLinear(*middle));
    for (Rgba8& p : image.pixels()) p.*channels[k] = LinearToSrgb8(SrgbToLinear(p.*channels[k]) * scale);
  }
}

void FillAround(const std::vector<std::array<Vec2f, 3>>& uvs, Image<Rgba8>& image) {
  const Image<uint8_t> covered = Covered(uvs, image.width(), image.height());
  std::vector<Image<Sum>> levels(1, Image<Sum>(image.width(), image.height()));
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Rgba8& p = image(x, y);
      if (covered(x, y)) levels[0](x, y) = {static_cast<float>(p.r), static_cast<float>(p.g), static_cast<float>(p.b), 1};
    }
  }
  while (levels.back().width() > 1 || levels.back().height() > 1) levels.push_back(Halved(levels.back()));
  if (levels.back()(0, 0).weight == 0) return;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (covered(x, y)) continue;
      size_t k = 1;
      while (levels[k](x >> k, y >> k).weight == 0) ++k;
      const Sum& s = levels[k](x >> k, y >> k);
      image(x, y) = {static_cast<uint8_t>(s.r), static_cast<uint8_t>(s.g), static_cast<uint8_t>(s.b), image(x, y).a};
    }
  }
}

}  // namespace airsim360::bake

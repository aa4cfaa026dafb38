#include "airsim360/render/sky/cloud_shapes.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360::internal {
namespace {

constexpr int kShapeCells = CloudLayer::kCells, kShapeMask = kShapeCells - 1;

using Columns = std::vector<CloudLayer::Column>;

float Pow(float x, float y) { return scalar::pow_approx(x, y); }
float Sin(float x) { return scalar::sin_approx(x); }
float Cos(float x) { return scalar::cos_approx(x); }

// Nearly normal with deviation 1, within ±3.5 and without a library's logarithm.
float Normal(RngStream& random) {
  double sum = -2;
  for (int i = 0; i < 4; ++i) sum += random.Uniform();
  return static_cast<float>(sum * 1.7320508);
}
float Between(RngStream& random, float low, float high) { return static_cast<float>(random.Uniform(low, high)); }

// A sky's cumulus as they are thrown.
class CumulusField {
 public:
  CumulusField(const CumulusForm& form, float cover, Vec2f wind, float cell, uint32_t seed)
      : form_(form),
        cover_(cover),
        cell_(cell),
        seed_(static_cast<int>(seed & 0xffffff)),
        random_(seed, "cumulus"),
        columns_(kShapeCells * kShapeCells) {
    street_[0] = std::round(-wind.y * 9), street_[1] = std::round(wind.x * 9);
    strength_ = Between(random_, 0.1f, 0.5f);
    cluster_ = Between(random_, 0.7f, 1.1f) * (1 - 0.8f * cover);
    // Wear takes more than a third of what the domes cover.
    const auto wanted = static_cast<int64_t>((1 - Pow(1 - std::min(cover, 0.9f), 1.7f)) * kShapeCells * kShapeCells);
    for (int k = 0; covered_ < wanted && k < 60000; ++k) Throw();
    LiftBases();
  }
  Columns Take() { return std::move(columns_); }

 private:
  // How well clouds grow over a place, coordinates in tiles.
  float Grows(float x, float y) const {
    return cluster_ * GradientNoise(x * 3, y * 3, 3, seed_) + 0.55f * FractalNoise(x * 8, y * 8, 8, 2, seed_ + 9) +
           0.5f * strength_ * Sin(kTauF * (x * street_[0] + y * street_[1]) + 3 * FractalNoise(x * 4, y * 4, 4, 2, seed_ + 31));
  }

  void Throw() {
    const float x = Between(random_, 0, 1), y = Between(random_, 0, 1), grows = Grows(x, y);
    if (random_.Uniform() > SmoothStep(-0.05f - 0.6f * cover_, 0.5f - 0.4f * cover_, grows)) return;
    const float vigour = SmoothStep(0, 0.6f, grows);
    const float size = std::min(form_.size * scalar::exp_approx(0.62f * Normal(random_)) * (0.6f + 0.9f * vigour), 3.6f * form_.size);
    Grow(x * kShapeCells * cell_, y * kShapeCells * cell_, size);
  }

  // One cloud: domes within an ellipse, the higher the nearer to its middle; large clouds have more and relatively smaller ones.
  void Grow(float x, float y, float size) {
    const float shape = Between(random_, 0.45f, 1), angle = Between(random_, 0, kTauF);
    const float c = Cos(angle), s = Sin(angle);
    const float height =
        0.42f * size * form_.growth * scalar::exp_approx(0.35f * Normal(random_)) * (0.5f + 0.7f * std::min(size / form_.size, 1.6f));
    const int domes = std::min(8 + static_cast<int>(size / 60), 220);
    for (int k = 0; k < domes; ++k) {
      const float a = Normal(random_) * 0.24f * size, b = Normal(random_) * 0.24f * size * shape;
      const float e = std::sqrt(a * a + b * b / (shape * shape)) / (0.62f * size);
      const float largest = std::min(0.34f * size, 330 + 0.05f * size);  // a larger dome would look like a ball
      const float radius = largest * Between(random_, 0.4f, 1) * std::max(0.45f, 1 - 0.45f * e);
      const float envelope = height * Pow(std::max(0.03f, 1 - e * e), 0.65f) * Between(random_, 0.6f, 1.08f);
      // Nothing beyond the envelope: it would hang there as a ball of its own.
      if (e <= 0.95f) AddDome(x + a * c - b * s, y + a * s + b * c, radius, std::min(envelope, 2.6f * radius) + 30);
    }
  }

  void AddDome(float x, float y, float radius, float height) {
    const float power = height > 1.5f * radius ? 0.36f : 0.55f;
    const int x0 = FloorToInt((x - radius) / cell_), x1 = FloorToInt((x + radius) / cell_) + 1;
    const int y0 = FloorToInt((y - radius) / cell_), y1 = FloorToInt((y + radius) / cell_) + 1;
    for (int j = y0; j <= y1; ++j) {
      for (int i = x0; i <= x1; ++i) {
        const float dx = static_cast<float>(i) * cell_ - x, dy = static_cast<float>(j) * cell_ - y;
        const float q = (dx * dx + dy * dy) / (radius * radius);
        if (q >= 1) continue;
        float& top = columns_[static_cast<size_t>(j & kShapeMask) * kShapeCells + (i & kShapeMask)].top;
        if (top >= 1.001f * height) continue;  // most domes stand in others: no power of a number below 1 raises this one
        const float here = height * Pow(1 - q, power);
        covered_ += top <= 60 && here > 60;
        top = std::max(top, here);
      }
    }
  }

  // Air rises to clouds from other heights: bases vary slowly by a tenth and from cloud to cloud by some tens of metres.
  void LiftBases() {
    ParallelFor(kShapeCells, [&](int64_t j) {
      const float y = static_cast<float>(j) / kShapeCells;
      const FractalRow slow(y * 5, 5, 2, seed_ + 3), fast(y * 26, 26, 2, seed_ + 5);
      for (int i = 0; i < kShapeCells; ++i) {
        const float x = static_cast<float>(i) / kShapeCells;
        columns_[static_cast<size_t>(j) * kShapeCells + i].base = 0.14f * form_.base * slow.At(x * 5) + 110 * fast.At(x * 26);
      }
    });
  }

  CumulusForm form_;
  float cover_, cell_;
  int seed_;
  RngStream random_;
  float street_[2], strength_, cluster_;
  int64_t covered_ = 0;
  Columns columns_;
};

}  // namespace

CloudLayer CumulusLayer(const CumulusForm& form, float cover, Vec2f wind, uint32_t seed) {
  CloudLayer::Form layer;
  layer.base = form.base;
  layer.extinction = 0.065f;
  layer.erosion = std::min(340.0f, 0.20f * form.size + 60), layer.base_erosion = 130 + 0.05f * form.size;
  layer.edge = std::min(150.0f, 70 + form.size * 0.03f);
  layer.billow = std::min(2600.0f, 700 + 0.75f * form.size), layer.detail = 340;
  layer.wind = wind, layer.shear = 0.45f, layer.stretch = 1.25f;
  return {layer, CumulusField(form, cover, wind, layer.cell, seed).Take()};
}

CloudLayer SheetLayer(const SheetForm& form, float cover, Vec2f wind, uint32_t seed) {
  const int s = static_cast<int>(seed & 0xffffff);
  const float extent = form.cell * kShapeCells;
  const int elements = std::max(4, static_cast<int>(extent / form.element));
  // Little cloud stands in a few banks: spread evenly it would be the tips of heaps alone, round crumbs all over.
  const float banks = 0.7f + 2.3f * (1 - SmoothStep(0.05f, 0.4f, cover));
  Columns columns(kShapeCells * kShapeCells);
  std::vector<float> field(columns.size());
  ParallelFor(kShapeCells, [&](int64_t j) {
    const float y = static_cast<float>(j) / kShapeCells;
    const FractalRow bend_x(y * 9, 9, 3, s + 40), bend_y(y * 9, 9, 3, s + 50), wide(y * 5, 5, 4, s + 60), bases(y * 20, 20, 2, s + 80);
    for (int i = 0; i < kShapeCells; ++i) {
      const float x = static_cast<float>(i) / kShapeCells;
      const float wx = x + 0.035f * bend_x.At(x * 9), wy = y + 0.035f * bend_y.At(x * 9);
      const auto count = static_cast<float>(elements), twice = static_cast<float>(2 * elements + 1);
      const float heaps = 1 - PointDistance(wx * count, wy * count, elements, s),
                  small = 1 - PointDistance(wx * twice, wy * twice, 2 * elements + 1, s + 1);
      const float fields = wide.At(x * 5), groups = FractalNoise(wx * 14, wy * 14, 14, 3, s + 70);
      const size_t k = static_cast<size_t>(j) * kShapeCells + i;
      field[k] = 0.55f * heaps + 0.2f * small + banks * fields + 0.5f * groups;
      columns[k].base = 0.25f * form.thickness * bases.At(x * 20);
    }
  });
  // The threshold that leaves as much as asked, and what wear takes from the edges besides.
  const float wanted = 1 - Pow(1 - std::clamp(cover, 0.0f, 0.999f), 1.5f);
  std::vector<float> sorted;
  for (size_t k = 0; k < field.size(); k += 37) sorted.push_back(field[k]);
  std::sort(sorted.begin(), sorted.end());
  const float threshold = sorted[static_cast<size_t>((1 - wanted) * static_cast<float>(sorted.size() - 1))];
  for (size_t k = 0; k < field.size(); ++k) {
    const float above = field[k] - threshold;
    columns[k].top = above <= 0 ? 0 : form.thickness * std::min(1.4f, 0.34f + Pow(above / 0.45f, 0.7f));
  }
  CloudLayer::Form layer;
  layer.base = form.base, layer.cell = form.cell, layer.extinction = form.extinction;
  layer.erosion = 0.36f * form.thickness, layer.least_erosion = 10, layer.base_erosion = 0.3f * form.thickness;
  layer.edge = 0.32f * form.thickness;
  layer.billow = 1.7f * form.element, layer.detail = 0.45f * form.element;
  layer.wind = wind, layer.shear = 0.3f, layer.stretch = 1.3f;
  return {layer, std::move(columns)};
}

}  // namespace airsim360::internal

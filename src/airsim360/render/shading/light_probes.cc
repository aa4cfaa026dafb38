#include "airsim360/render/shading/light_probes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/lights/lit_places.h"
#include "airsim360/render/shading/probe_rays.h"
#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

constexpr int kDirections = 64;
constexpr float kInvalidWeight = 1e-4f;
constexpr int kFloats = 16;
constexpr int kPasses = 2, kPassesOfSmall = 6;
constexpr size_t kSmall = 4000;  // probes of a coarse pass

// Spherical Fibonacci points: even and the same for all probes, so that neighbours differ only by what they
// see.
std::array<Vec3f, kDirections> EvenDirections() {
  std::array<Vec3f, kDirections> directions;
  for (int i = 0; i < kDirections; ++i) {
    const float z = 1 - (2 * static_cast<float>(i) + 1) / kDirections, angle = static_cast<float>(i) * 2.39996323f;
    const float s = std::sqrt(1 - z * z);
    directions[i] = {s * std::cos(angle), s * std::sin(angle), z};
  }
  return directions;
}

constexpr Vec3f kAxes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

// Irradiance on the six sides of a small cube.
using Cube = std::array<Vec3f, 6>;

// How much of each side's irradiance one direction brings; uniform light gives pi on every side exactly.
std::array<std::array<float, 6>, kDirections> CubeWeights(const std::array<Vec3f, kDirections>& directions) {
  std::array<std::array<float, 6>, kDirections> weights{};
  for (int k = 0; k < 6; ++k) {
    float sum = 0;
    for (const Vec3f d : directions) sum += std::max(0.0f, Dot(d, kAxes[k]));
    for (int i = 0; i < kDirections; ++i) weights[i][k] = std::max(0.0f, Dot(directions[i], kAxes[k])) * kPiF / sum;
  }
  return weights;
}

// Terms of irradiance over normals, see ProbeView.
void StoreTerms(const Cube& e, float weight, float* probe) {
  const Vec3f level = (e[0] + e[1] + e[2] + e[3]) * 0.25f;
  const Vec3f square = (e[4] + e[5]) * 0.5f - level;
  const Vec3f rows[4] = {level, (e[0] - e[1]) * 0.5f, (e[2] - e[3]) * 0.5f, (e[4] - e[5]) * 0.5f};
  for (int k = 0; k < 4; ++k) {
    for (int c = 0; c < 3; ++c) probe[4 * k + c] = rows[k][c] * weight;
    probe[4 * k + 3] = k == 0 ? weight : square[k - 1] * weight;
  }
}

}  // namespace

LightProbes::LightProbes(const ProbeLight& world, const Options& options) {
  ProbeLight light = world;
  light.earlier = nullptr;
  // Every pass adds a bounce. Small scenes, rooms above all, have more that matter, and time for them.
  std::unique_ptr<LightProbes> coarse;
  for (int pass = 0; pass < (coarse && coarse->size() < kSmall ? kPassesOfSmall : kPasses); ++pass) {
    auto next = std::unique_ptr<LightProbes>(new LightProbes);
    next->Place(world.tracer.scene(), {options.max_probes / 8, options.cell * 2});
    next->Bake(light);
    coarse = std::move(next);
    light.earlier = coarse.get();
  }
  Place(world.tracer.scene(), options);
  Bake(light);
}

void LightProbes::Bake(const ProbeLight& world) {
  probes_.assign(static_cast<size_t>(nx_) * ny_ * nz_ * kFloats, 0.0f);
  valid_.assign(static_cast<size_t>(nx_) * ny_ * nz_, 0);
  ParallelFor(static_cast<int64_t>(ny_) * nz_, [&](int64_t row) {
    const FlushDenormals flush;
    BakeRow(world, static_cast<int>(row % ny_), static_cast<int>(row / ny_));
  });
  FillInvalid();
}

void LightProbes::Place(const Scene& scene, const Options& options) {
  Box3f box = DetailBounds(scene);
  if (box.empty()) box.Add(Vec3f{});
  // Layers: 1.2 m apart at the bottom, growing to 6 m.
  float z = box.min.z + 0.3f, step = 1.2f;
  const float top = std::max(box.max.z + 2.0f, z + 2.5f);
  for (; z < top || layers_.size() < 2; z += step, step = std::min(step * 1.16f, std::max(6.0f, (top - box.min.z) / 16)))
    layers_.push_back(z);
  nz_ = static_cast<int>(layers_.size());
  const Vec3f size = Max(box.size(), Vec3f{2, 2, 2});
  const float wanted = std::clamp(std::max(size.x, size.y) / 24, 0.4f, options.cell);
  cell_ = std::max(wanted, std::sqrt(size.x * size.y * static_cast<float>(nz_) / static_cast<float>(options.max_probes)));
  nx_ = std::max(2, static_cast<int>(std::ceil(size.x / cell_)) + 1);
  ny_ = std::max(2, static_cast<int>(std::ceil(size.y / cell_)) + 1);
  origin_ = {box.min.x + 0.5f * (size.x - cell_ * static_cast<float>(nx_ - 1)),
             box.min.y + 0.5f * (size.y - cell_ * static_cast<float>(ny_ - 1)), layers_[0]};

  height_step_ = std::max(height_step_, (layers_.back() - layers_[0]) / 8192);
  const int heights = static_cast<int>((layers_.back() - layers_[0]) / height_step_) + 2;
  for (int i = 0, k = 0; i < heights; ++i) {
    const float h = std::min(layers_[0] + static_cast<float>(i) * height_step_, layers_.back());
    while (k + 2 < nz_ && h > layers_[k + 1]) ++k;
    layer_of_height_.push_back(
        std::min(static_cast<float>(k) + (h - layers_[k]) / (layers_[k + 1] - layers_[k]), static_cast<float>(nz_) - 1.0001f));
  }
}

Vec3f LightProbes::Position(int x, int y, int z) const {
  return {origin_.x + cell_ * static_cast<float>(x), origin_.y + cell_ * static_cast<float>(y), layers_[z]};
}

// Sixteen neighbours look the same way at the same time; metres apart, so not as a coherent packet.
void LightProbes::BakeRow(const ProbeLight& world, int y, int z) {
  static const std::array<Vec3f, kDirections> directions = EvenDirections();
  static const auto weights = CubeWeights(directions);
  for (int first = 0; first < nx_; first += 16) {
    const int count = std::min(16, nx_ - first);
    // Light that is certain, and light of surfaces that they got from a sky as open as here.
    std::array<Cube, 16> certain{}, guessed{};
    std::array<int, 16> behind{}, open{};
    std::array<Vec3f, 16> points;
    for (int i = 0; i < count; ++i) points[i] = Position(first + i, y, z);
    for (int k = 0; k < kDirections; ++k) {
      const Seen seen = LookAlong(world, {points.data(), static_cast<size_t>(count)}, directions[k]);
      for (int i = 0; i < count; ++i) {
        behind[i] += seen.behind[i];
        open[i] += seen.open[i] && directions[k].z > 0;
        for (int side = 0; side < 6; ++side) {
          certain[i][side] += seen.light[i] * weights[k][side];
          guessed[i][side] += seen.guess[i] * weights[k][side];
        }
      }
    }
    for (int i = 0; i < count; ++i) {
      const size_t index = (static_cast<size_t>(z) * ny_ + y) * nx_ + first + i;
      valid_[index] = behind[i] * 5 < kDirections;
      const float openness = std::min(1.0f, static_cast<float>(open[i]) * (3.2f / kDirections));
      for (int side = 0; side < 6; ++side) certain[i][side] += guessed[i][side] * openness;
      StoreTerms(certain[i], valid_[index] ? 1.0f : kInvalidWeight, &probes_[index * kFloats]);
    }
  }
}

// Probes inside solids take the mean of their valid neighbours, for places where all eight are inside.
void LightProbes::FillInvalid() {
  const TableVector<float> baked = probes_;
  const int steps[6] = {1, -1, nx_, -nx_, nx_ * ny_, -nx_ * ny_};
  ParallelFor(nz_, [&](int64_t z) {
    for (int64_t k = z * nx_ * ny_; k < (z + 1) * nx_ * ny_; ++k) {
      if (valid_[k]) continue;
      float sum[kFloats] = {};
      for (int step : steps) {
        const int64_t neighbour = k + step;
        if (neighbour < 0 || neighbour >= static_cast<int64_t>(valid_.size()) || !valid_[neighbour]) continue;
        for (int c = 0; c < kFloats; ++c) sum[c] += baked[neighbour * kFloats + c];
      }
      if (sum[3] == 0) continue;
      for (int c = 0; c < kFloats; ++c) probes_[k * kFloats + c] = sum[c] / sum[3] * kInvalidWeight;
    }
  });
}

ProbeView LightProbes::view() const {
  ProbeView view{};
  view.probes = probes_.data();
  view.origin_x = origin_.x, view.origin_y = origin_.y;
  view.cells_per_metre = 1 / cell_;
  view.max_x = static_cast<float>(nx_ - 2), view.max_y = static_cast<float>(ny_ - 2), view.max_z = static_cast<float>(nz_ - 2);
  view.stride_y = nx_, view.stride_z = nx_ * ny_;
  view.layer_of_height = layer_of_height_.data();
  view.height_origin = layers_[0];
  view.height_scale = 1 / height_step_;
  view.height_last = static_cast<float>(layer_of_height_.size() - 1);
  return view;
}

Vec3f LightProbes::Irradiance(Vec3f p, Vec3f n) const {
  const float x = std::clamp((p.x - origin_.x) / cell_, 0.0f, static_cast<float>(nx_) - 1.0001f);
  const float y = std::clamp((p.y - origin_.y) / cell_, 0.0f, static_cast<float>(ny_) - 1.0001f);
  const float h = std::clamp((p.z - origin_.z) / height_step_, 0.0f, static_cast<float>(layer_of_height_.size() - 1));
  const float z = layer_of_height_[static_cast<size_t>(h + 0.5f)];
  const int ix = static_cast<int>(x), iy = static_cast<int>(y), iz = static_cast<int>(z);
  float sum[kFloats] = {};
  for (int k = 0; k < 8; ++k) {
    const int dx = k & 1, dy = k >> 1 & 1, dz = k >> 2;
    const float weight = (dx ? x - ix : 1 - (x - ix)) * (dy ? y - iy : 1 - (y - iy)) * (dz ? z - iz : 1 - (z - iz));
    const float* probe = &probes_[((static_cast<size_t>(iz + dz) * ny_ + iy + dy) * nx_ + ix + dx) * kFloats];
    for (int c = 0; c < kFloats; ++c) sum[c] += probe[c] * weight;
  }
  Vec3f e;
  for (int c = 0; c < 3; ++c)
    e[c] = std::max(0.0f, (sum[c] + sum[4 + c] * n.x + sum[8 + c] * n.y + sum[12 + c] * n.z + sum[4 * c + 7] * n.z * n.z) / sum[3]);
  return e;
}

float LightProbes::TypicalLight() const {
  std::vector<float> light;
  for (size_t k = 0; k < valid_.size(); ++k) {
    if (!valid_[k]) continue;
    const float* t = &probes_[k * kFloats];
    Vec3f e;
    for (int c = 0; c < 3; ++c) e[c] = std::max(0.0f, (t[c] + t[12 + c] + t[4 * c + 7]) / t[3]);
    light.push_back(Luminance(e));
  }
  return LightOfLitPlaces(std::move(light));
}

bool LightProbes::Covers(Vec3f p) const {
  const Vec3f q = (p - origin_) / cell_;
  return q.x >= -1 && q.y >= -1 && q.x <= static_cast<float>(nx_) && q.y <= static_cast<float>(ny_) && p.z < layers_.back() + cell_;
}

Vec3f LightProbes::NearIrradiance(Vec3f p, Vec3f n) const {
  const Vec3f q = (p + n * (0.45f * cell_) - origin_) / cell_;
  const int x = std::clamp(static_cast<int>(q.x + 0.5f), 0, nx_ - 1), y = std::clamp(static_cast<int>(q.y + 0.5f), 0, ny_ - 1);
  const float h = std::clamp(q.z * cell_ / height_step_, 0.0f, static_cast<float>(layer_of_height_.size() - 1));
  const int z = static_cast<int>(layer_of_height_[static_cast<size_t>(h + 0.5f)] + 0.5f);
  const float* t = &probes_[((static_cast<size_t>(z) * ny_ + y) * nx_ + x) * kFloats];
  Vec3f e;
  for (int c = 0; c < 3; ++c)
    e[c] = std::max(0.0f, (t[c] + t[4 + c] * n.x + t[8 + c] * n.y + t[12 + c] * n.z + t[4 * c + 7] * n.z * n.z) / t[3]);
  return e;
}

}  // namespace airsim360::internal

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/worlds/props/car_shape.h"
#include "airsim360/worlds/props/finishes.h"

namespace airsim360::internal {
namespace {

constexpr size_t kPoints = 11;

// Right half of the cross-section at y, from the sill to the middle of the roof.
std::array<Vec3f, kPoints> Section(const CarShape& s, float y) {
  const float w = Lookup(s.width, y), zt = Lookup(s.top, y), zb = std::min(Lookup(s.belt, y), zt - 0.02f);
  // The sill rises over the wheels.
  float sill = 0.20f;
  for (float axle : {s.front_axle, s.rear_axle}) {
    const float r = s.wheel_radius + 0.055f, d = y - axle;
    if (std::abs(d) < r) sill = std::max(sill, s.wheel_radius + std::sqrt(r * r - d * d) * 0.96f);
  }
  sill = std::min(sill, zb - 0.08f);
  const float cabin = std::clamp((zt - zb) / 0.40f, 0.0f, 1.0f),
              wt = w * 0.90f * (1 - cabin) + std::min(w * 0.93f, s.roof_half_width) * cabin;
  const float edge = zt - 0.025f - 0.045f * cabin;
  const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
  return {{{w * 0.80f, y, sill - 0.02f},
           {w * 0.975f, y, sill},
           {w, y, mix(sill, zb, 0.40f)},
           {w * 0.995f, y, mix(sill, zb, 0.72f)},
           {w * 0.975f, y, mix(sill, zb, 0.93f)},
           {w * 0.95f, y, zb},
           {mix(w * 0.95f, wt, 0.55f), y, mix(zb, edge, 0.5f)},
           {wt, y, edge},
           {wt * 0.90f, y, zt - 0.008f - 0.01f * cabin},
           {wt * 0.5f, y, zt + 0.008f},
           {0, y, zt + 0.012f}}};
}

constexpr float kSeam = 0.004f;  // half the width of the gap between doors

std::vector<float> DoorSeams(const CarShape& s) {
  std::vector<float> seams = {s.side_glass.from - 0.02f};
  for (const CarRange& pillar : s.pillars) seams.push_back((pillar.from + pillar.to) / 2);
  return seams;
}

// Stations every 7 cm and at every change of material.
std::vector<float> Stations(const CarShape& s) {
  std::vector<float> ys;
  const float from = s.top.front().x, to = s.top.back().x;
  for (int i = 0; i <= 64; ++i) ys.push_back(from + (to - from) * static_cast<float>(i) / 64);
  std::vector<CarRange> edges = s.pillars;
  edges.insert(edges.end(), {s.windscreen, s.rear_window, s.side_glass});
  for (float seam : DoorSeams(s)) edges.push_back({seam - kSeam, seam + kSeam});
  for (const CarRange& r : edges) {
    for (float y : {r.from, r.to}) {
      if (y > from && y < to) ys.push_back(y);
    }
  }
  std::sort(ys.begin(), ys.end());
  ys.erase(std::unique(ys.begin(), ys.end(), [](float a, float b) { return b - a < 0.002f; }), ys.end());
  return ys;
}

enum class Skin { kPaint, kGlass, kBlack, kRoof, kSweep };

Skin SkinAt(const CarShape& s, float y, size_t row, float cabin_height, CarRange swept) {
  const bool pillar = std::any_of(s.pillars.begin(), s.pillars.end(), [&](const CarRange& r) { return r.Holds(y); });
  if ((row == 5 || (row == 6 && !s.half_glass)) && s.side_glass.Holds(y) && cabin_height > 0.10f)
    return pillar ? Skin::kBlack : Skin::kGlass;
  if (row >= 8 && (s.windscreen.Holds(y) || s.rear_window.Holds(y))) return Skin::kGlass;
  const auto seams = DoorSeams(s);
  const bool seam = std::any_of(seams.begin(), seams.end(), [&](float at) { return std::abs(y - at) < kSeam; });
  if (row == 0 || (seam && row >= 1 && row <= 4)) return Skin::kBlack;
  if (row >= 5 && cabin_height > 0.2f) return Skin::kRoof;
  return row == 2 && swept.Holds(y) ? Skin::kSweep : Skin::kPaint;
}

}  // namespace

void AddCarBody(PropBuilder& b, const CarShape& s, const CarCoats& coats) {
  const std::vector<float> ys = Stations(s);
  std::vector<std::array<Vec3f, kPoints>> grid;
  for (float y : ys) grid.push_back(Section(s, y));
  // Smooth normals of the right half from differences along both directions of the grid.
  const auto normal = [&](size_t i, size_t k) {
    const Vec3f along = grid[std::min(i + 1, grid.size() - 1)][k] - grid[i > 0 ? i - 1 : 0][k];
    Vec3f up = grid[i][std::min(k + 1, kPoints - 1)] - grid[i][k > 0 ? k - 1 : 0];
    if (k + 1 == kPoints) up = {-1, 0, 0};
    return Normalized(Cross(along, up));
  };
  for (size_t i = 0; i + 1 < grid.size(); ++i) {
    for (size_t k = 0; k + 1 < kPoints; ++k) {
      const float y = (ys[i] + ys[i + 1]) / 2;
      const Skin skin = SkinAt(s, y, k, Lookup(s.top, y) - Lookup(s.belt, y), coats.swept);
      b.Use(skin == Skin::kGlass   ? Glass({0.012f, 0.014f, 0.016f})
            : skin == Skin::kBlack ? Plastic({0.012f, 0.012f, 0.013f}, 0.5f)
            : skin == Skin::kRoof  ? coats.roof
            : skin == Skin::kSweep ? coats.sweep
                                   : coats.body);
      for (float side : {1.0f, -1.0f}) {
        const auto p = [&](size_t a, size_t c) { return Vec3f{grid[a][c].x * side, grid[a][c].y, grid[a][c].z}; };
        const auto n = [&](size_t a, size_t c) {
          const Vec3f v = normal(a, c);
          return Vec3f{v.x * side, v.y, v.z};
        };
        const size_t j = i + 1, l = k + 1;
        if (side > 0) {
          b.mesh().SmoothTriangle({p(i, k), p(j, k), p(j, l)}, {n(i, k), n(j, k), n(j, l)}, {});
          b.mesh().SmoothTriangle({p(i, k), p(j, l), p(i, l)}, {n(i, k), n(j, l), n(i, l)}, {});
        } else {
          b.mesh().SmoothTriangle({p(i, k), p(j, l), p(j, k)}, {n(i, k), n(j, l), n(j, k)}, {});
          b.mesh().SmoothTriangle({p(i, k), p(i, l), p(j, l)}, {n(i, k), n(i, l), n(j, l)}, {});
        }
      }
    }
  }
  // Close nose and tail.
  b.Use(coats.body);
  for (bool tail : {false, true}) {
    const auto& ring = tail ? grid.back() : grid.front();
    const Vec3f c{0, ring[0].y, (ring[0].z + ring[kPoints - 1].z) / 2};
    const auto at = [&](size_t k) {
      return k < kPoints ? ring[k] : Vec3f{-ring[2 * kPoints - 1 - k].x, ring[0].y, ring[2 * kPoints - 1 - k].z};
    };
    for (size_t k = 0; k < 2 * kPoints; ++k) {
      const Vec3f p = at(k), q = at((k + 1) % (2 * kPoints));
      if (p == q) continue;
      if (tail)
        b.mesh().Triangle(c, q, p);
      else
        b.mesh().Triangle(c, p, q);
    }
  }
}

}  // namespace airsim360::internal

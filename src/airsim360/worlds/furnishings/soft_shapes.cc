#include "airsim360/worlds/furnishings/soft_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/finishes.h"

namespace airsim360::internal {
namespace {

// Position 0..1 along an edge of `length` from grid parameter t: two cells at either end lie on the rounding.
float Spread(float t, int cells, float round, float length) {
  const float r = std::min(round / length, 0.4f), k = 2.0f / static_cast<float>(cells);
  if (t < k) return r * t / k;
  if (t > 1 - k) return 1 - r * (1 - t) / k;
  return r + (1 - 2 * r) * (t - k) / (1 - 2 * k);
}

// Slow wrinkles over space, about -1 to 1; the same for the same place.
float Wrinkle(Vec3f p, uint64_t seed) {
  const float a = static_cast<float>(seed % 97) * 0.31f;
  return 0.5f * std::sin(17 * p.x + 9 * p.z + a) * std::cos(13 * p.y - 7 * p.x + 2 * a) +
         0.5f * std::sin(29 * p.y + 23 * p.z - 3 * a + 2 * std::sin(11 * p.x + a));
}

struct Puff {
  Vec3f center, half;
  const Soft& soft;

  Vec3f At(Vec3f cube) const {
    const float r = std::min({soft.round, half.x, half.y, half.z});
    Vec3f inner, p;
    for (int i = 0; i < 3; ++i) {
      p[i] = cube[i] * half[i];
      inner[i] = std::clamp(p[i], -(half[i] - r), half[i] - r);
    }
    const Vec3f out = p - inner;
    const float far = Norm(out);
    const Vec3f n = far > 0 ? out / far : Vec3f{0, 0, 1};
    // The face that is nearest bulges: nothing at its rim.
    float bulge = 0;
    for (int i = 0; i < 3; ++i) {
      const float j = cube[(i + 1) % 3], k = cube[(i + 2) % 3];
      bulge += std::abs(n[i]) * (1 - j * j) * (1 - k * k);
    }
    return center + inner + n * (r + soft.crown * bulge + soft.fold * Wrinkle(p, soft.seed) * std::min(1.0f, 2 * bulge));
  }
};

}  // namespace

Vec3f Around(int i, int n, float offset) {
  const float a = 2 * kPiF * static_cast<float>(i) / static_cast<float>(n) + offset;
  return {std::cos(a), std::sin(a), 0};
}

void SoftBox(PropBuilder& b, Vec3f lo, Vec3f hi, const Soft& soft) {
  const Puff puff{(lo + hi) * 0.5f, (hi - lo) * 0.5f, soft};
  constexpr std::array<unsigned, 6> kFaces = {MeshBuilder::kLeft, MeshBuilder::kRight,  MeshBuilder::kFront,
                                              MeshBuilder::kBack, MeshBuilder::kBottom, MeshBuilder::kTop};
  for (int f = 0; f < 6; ++f) {
    if (!(soft.faces & kFaces[static_cast<size_t>(f)])) continue;
    const int axis = f / 2;
    const float sign = f % 2 ? 1.0f : -1.0f;
    // Texture upright on the sides: u horizontal, v vertical; u x v = the outward normal.
    const int u_axis = axis == 0 ? 1 : 0, v_axis = axis == 2 ? 1 : 2;
    const float turn = (axis == 1 ? -1.0f : 1.0f) * sign;  // of u, so that the front faces outwards
    const Vec3f size = (hi - lo);
    const auto at = [&](float u, float v) {
      Vec3f cube;
      cube[axis] = sign;
      cube[u_axis] = turn * (2 * Spread(u, soft.cells, soft.round, size[u_axis]) - 1);
      cube[v_axis] = 2 * Spread(v, soft.cells, soft.round, size[v_axis]) - 1;
      return puff.At(cube);
    };
    b.Sheet(soft.cells, soft.cells, at, {size[u_axis], size[v_axis]});
  }
}

void Pillow(PropBuilder& b, const AffineTransform& X, Vec2f size, float thickness, uint64_t seed, int cells) {
  b.Place(X);
  for (float side : {1.0f, -1.0f}) {
    const auto at = [&](float u, float v) {
      const float x = (2 * u - 1) * side, y = 2 * v - 1;
      // The seam is drawn in between the tips; the filling is thickest in the middle.
      const float in_x = 1 - 0.09f * (1 - y * y), in_y = 1 - 0.09f * (1 - x * x);
      const float full = std::pow(std::max(0.0f, (1 - x * x) * (1 - y * y)), 0.42f);
      const Vec3f p{x * in_x * size.x / 2, y * in_y * size.y / 2, 0};
      const float crease = 0.10f * Wrinkle(p * 1.3f, seed) * full * (1 - 0.6f * full);
      return p + Vec3f{0, 0, side * thickness / 2 * (full + crease)};
    };
    b.Sheet(cells, cells, at, size);
  }
  b.Place({});
}

void Bedspread(PropBuilder& b, float half, float y0, float y1, float top, float drop, float fold, uint64_t seed) {
  constexpr float kRound = 0.06f;
  const float flat = half - kRound, arc = kRound * kPiF / 2, hang = std::max(0.0f, drop - kRound);
  const float total = 2 * (flat + arc + hang);
  const auto at = [&](float u, float v) {
    const float s = (u - 0.5f) * total, side = s < 0 ? -1.0f : 1.0f, d = std::abs(s);
    const float y = y0 + (y1 - y0) * v;
    Vec3f p, n{0, 0, 1};
    float loose = 0;
    if (d <= flat) {
      p = {s, y, top};
      loose = 0.6f;
    } else if (d <= flat + arc) {
      const float a = (d - flat) / kRound;
      n = {side * std::sin(a), 0, std::cos(a)};
      p = {side * (flat + kRound * n.x * side), y, top - kRound * (1 - n.z)};
      loose = 0.5f;
    } else {
      n = {side, 0, 0};
      p = {side * half, y, top - kRound - (d - flat - arc)};
      loose = 0.6f + 1.6f * (d - flat - arc) / std::max(hang, 0.01f);
    }
    const float pleat = std::sin(14 * y + 3 * std::sin(5 * y + static_cast<float>(seed % 13)));
    const float wave = d > flat + arc ? 0.5f + 0.5f * pleat : Wrinkle(p, seed);
    return p + n * (fold * loose * wave);
  };
  b.Sheet(40, 20, at, {total, y1 - y0});
}

void Hanging(PropBuilder& b, float x0, float x1, float top, float depth, int folds, uint64_t seed) {
  const float shift = static_cast<float>(seed % 89);
  const auto at = [&](float u, float v) {
    // Tight pleats at the tape, wider and uneven ones below.
    const float loose = 1 - v, sway = 0.25f * std::sin(7 * u + shift) * loose;
    const float phase = 2 * kPiF * (static_cast<float>(folds) * u + sway);
    const float y = depth * (0.55f + 0.45f * loose) * std::sin(phase) + 0.2f * depth * loose * std::sin(2.3f * phase + shift);
    return Vec3f{x0 + (x1 - x0) * u + 0.25f * depth * std::sin(2 * phase) * loose, y, top * v};
  };
  b.Sheet(folds * 8, 6, at, {(x1 - x0) * 1.9f, top});
}

void RoundedBoard(PropBuilder& b, Vec2f lo, Vec2f hi, float corner, float z0, float z1, float edge) {
  const int steps = std::clamp(static_cast<int>(corner * 40), 4, 16);
  const auto ring = [&](float inset) {
    return RoundedRectangle(lo + Vec2f{inset, inset}, hi - Vec2f{inset, inset}, std::max(corner - inset, 0.001f), steps);
  };
  const std::vector<Vec2f> outer = ring(0);
  const size_t n = outer.size();
  b.mesh().Walls(outer, z0, z1 - edge);
  b.mesh().Polygon(outer, z0, false);
  constexpr int kSteps = 3;
  for (int k = 0; k < kSteps; ++k) {
    const float a0 = kPiF / 2 * static_cast<float>(k) / kSteps, a1 = kPiF / 2 * static_cast<float>(k + 1) / kSteps;
    const auto lower = ring(edge * (1 - std::cos(a0))), upper = ring(edge * (1 - std::cos(a1)));
    const float za = z1 - edge + edge * std::sin(a0), zb = z1 - edge + edge * std::sin(a1);
    for (size_t i = 0; i < n; ++i) {
      const size_t j = (i + 1) % n;
      const auto out = [&](size_t v, float a) {
        const Vec2f before = outer[(v + n - 1) % n], after = outer[(v + 1) % n];
        const Vec3f side = Normalized(Vec3f{after.y - before.y, before.x - after.x, 0});
        return Normalized(side * std::cos(a) + Vec3f{0, 0, std::sin(a)});
      };
      const Vec3f p[4] = {
          {lower[i].x, lower[i].y, za}, {lower[j].x, lower[j].y, za}, {upper[j].x, upper[j].y, zb}, {upper[i].x, upper[i].y, zb}};
      const auto uv = [](Vec3f q) { return Vec2f{q.x, -q.y}; };
      b.mesh().SmoothTriangle({p[0], p[1], p[2]}, {out(i, a0), out(j, a0), out(j, a1)}, {uv(p[0]), uv(p[1]), uv(p[2])});
      b.mesh().SmoothTriangle({p[0], p[2], p[3]}, {out(i, a0), out(j, a1), out(i, a1)}, {uv(p[0]), uv(p[2]), uv(p[3])});
    }
  }
  b.mesh().Polygon(ring(edge), z1, true);
}

void BowHandle(PropBuilder& b, Vec2f from, Vec2f to, float y, float radius) {
  const Vec2f d = (to - from) * 0.06f;
  const Vec3f path[] = {{from.x, y, from.y},
                        {from.x, y - 0.022f, from.y},
                        {from.x + d.x, y - 0.03f, from.y + d.y},
                        {to.x - d.x, y - 0.03f, to.y - d.y},
                        {to.x, y - 0.022f, to.y},
                        {to.x, y, to.y}};
  b.Bar(path, radius, 8);
}

void BroadLeaf(PropBuilder& b, const AffineTransform& X, float length, float width, float droop, bool lobed) {
  b.Place(X);
  const auto at = [&](float u, float v) {
    const float s = 2 * v - 1;  // across
    const float body = std::pow(std::max(0.0f, std::sin(kPiF * std::pow(u, 0.75f))), 0.8f);
    const float lobe = lobed ? 1 - 0.45f * std::abs(s) * (0.5f + 0.5f * std::sin(u * 26)) : 1.0f;
    const float w = width / 2 * std::max(body, 0.03f) * lobe;
    const float bend = droop * length * u * u;
    return Vec3f{length * (u - 0.15f * droop * u * u), s * w, 0.22f * std::abs(s) * w - bend};
  };
  b.Sheet(lobed ? 14 : 6, 2, at, {1, 1});
  b.Place({});
}

void Castor(PropBuilder& b, Vec3f p) {
  const float r = p.z * 0.42f;
  b.Use(Plastic({0.02f, 0.02f, 0.022f}, 0.4f));
  b.mesh().Tube({p.x, p.y, r}, {p.x, p.y, p.z}, 0.006f, 0.006f, 6, false, false);
  for (float side : {-1.0f, 1.0f})
    b.mesh().Tube({p.x + side * 0.008f, p.y + 0.012f, r}, {p.x + side * 0.024f, p.y + 0.012f, r}, r, r * 0.92f, 14);
  b.BevelBox({p.x - 0.012f, p.y - 0.012f, r}, {p.x + 0.012f, p.y + 0.03f, 2 * r + 0.004f}, 0.004f);
}

}  // namespace airsim360::internal

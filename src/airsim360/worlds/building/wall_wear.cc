#include "airsim360/worlds/building/wall_wear.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

using S = Surface;

// Render, brick and stone weather; panels and cast walls do so evenly.
bool Weathers(S s) { return IsBrick(s) || (s >= S::kLimestone && s <= S::kStuccoBlue) || s == S::kBrownstone; }

bool IsFree(const std::vector<Kept>& kept, float x0, float x1, float z0, float z1) {
  return std::ranges::none_of(kept, [&](const Kept& k) { return x0 < k.x1 && x1 > k.x0 && z0 < k.z1 && z1 > k.z0; });
}

// What a place was mended with, or what shows under it.
S MendOf(S wall, RngStream& rng) {
  static constexpr S kOnBrick[] = {S::kConcrete, S::kBrickBrown, S::kBrickRed, S::kConcreteWarm, S::kBrickYellow},
                     kOnRender[] = {S::kConcrete, S::kConcreteWarm, S::kBrickBrown, S::kConcreteWarm, S::kConcrete};
  for (;;) {
    const S pick = (IsBrick(wall) ? kOnBrick : kOnRender)[rng.Index(5)];
    if (pick != wall) return pick;
  }
}

void HangGrille(FacadePen& pen, float x, float z, RngStream& rng) {
  const float half = rng.Chance(0.6) ? 0.09f : 0.16f;
  if (rng.Chance(0.35)) {  // the flue of a boiler
    pen.Use(rng.Chance(0.5) ? S::kFrameWhite : S::kMetal);
    pen.Bar(x - 0.05f, x + 0.05f, z - 0.05f, z + 0.05f, -0.22f, 0);
    return;
  }
  pen.Use(rng.Chance(0.5) ? S::kFrameWhite : S::kMetal);
  pen.Bar(x - half - 0.02f, x + half + 0.02f, z - half - 0.02f, z + half + 0.02f, -0.015f, 0);
  pen.Use(S::kTrimDark);
  for (int i = 0; i < 4; ++i) {
    const float s = z - half + half * (0.1f + 0.5f * static_cast<float>(i));
    pen.Front(x - half, x + half, s, s + 0.25f * half, -0.017f);
  }
}

// From `from` to below `top` beside the openings, with clips.
void RunPipe(FacadePen& pen, float x, float from, float top, RngStream& rng) {
  const auto r = static_cast<float>(rng.Uniform(0.016, 0.055));
  pen.Use(rng.Chance(0.4) ? S::kMetal : rng.Chance(0.5) ? S::kIronBlack : S::kDoorBrown);
  pen.Bar(x - r, x + r, from, top, -0.03f - 2 * r, -0.03f, true, true);
  for (float z = from + 0.7f; z < top - 0.2f; z += 2.4f) pen.Bar(x - r - 0.012f, x + r + 0.012f, z, z + 0.03f, -0.036f - 2 * r, 0);
}

// Clipped to the wall every few metres and slack between.
void HangCable(FacadePen& pen, float z, RngStream& rng) {
  const float L = pen.length(), r = rng.Chance(0.5) ? 0.008f : 0.013f, y = -0.03f * pen.reach() - r;
  pen.Use(rng.Chance(0.7) ? S::kIronBlack : S::kDoorGrey);
  const auto spans = static_cast<int>(std::max(1.0f, L / 3.2f));
  const float w = L / static_cast<float>(spans);
  float at = z;
  for (int i = 0; i < spans; ++i) {
    const float x0 = w * static_cast<float>(i), next = z + static_cast<float>(rng.Uniform(-0.04, 0.04)),
                low = (at + next) / 2 - static_cast<float>(rng.Uniform(0.01, 0.12));
    pen.mesh().Tube({x0, y, at}, {x0 + w / 2, y, low}, r, r, 4, false, false);
    pen.mesh().Tube({x0 + w / 2, y, low}, {x0 + w, y, next}, r, r, 4, false, false);
    at = next;
  }
}

// A place for something of half size (hx, hz) off everything kept; false: none found in a few tries.
bool FindPlace(const FacadePen& pen, const std::vector<Kept>& kept, float from, float top, float hx, float hz, RngStream& rng, Vec2f& at) {
  if (pen.length() < 2 * hx + 0.3f || top - from < 2 * hz + 0.3f) return false;
  for (int i = 0; i < 8; ++i) {
    at = {static_cast<float>(rng.Uniform(static_cast<double>(hx) + 0.1, static_cast<double>(pen.length() - hx) - 0.1)),
          static_cast<float>(rng.Uniform(static_cast<double>(from + hz) + 0.1, static_cast<double>(top - hz) - 0.1))};
    if (IsFree(kept, at.x - hx, at.x + hx, at.y - hz, at.y + hz)) return true;
  }
  return false;
}

}  // namespace

void RoughPatch(FacadePen& pen, Vec2f at, Vec2f half, float proud, RngStream& rng) {
  constexpr int kCorners = 17;
  const float y = -proud * pen.reach();
  Vec3f rim[kCorners];
  // Two slow waves and a fast one about an oval that leans to a box.
  const double a = rng.Uniform(0, kTauF), b = rng.Uniform(0, kTauF);
  for (int i = 0; i < kCorners; ++i) {
    const double t = kTauF * (i + 0.5 * rng.Uniform()) / kCorners, c = std::cos(t), s = std::sin(t);
    const double square = 1 / std::max(std::pow(std::pow(std::abs(c), 3.0) + std::pow(std::abs(s), 3.0), 1 / 3.0), 0.5);
    const double out =
        std::clamp(square * (0.66 + 0.17 * std::sin(2 * t + a) + 0.13 * std::sin(3 * t + b) + 0.13 * rng.Uniform(-1, 1)), 0.25, 1.0);
    rim[i] = {at.x + half.x * static_cast<float>(out * c), y, at.y + half.y * static_cast<float>(out * s)};
  }
  const Vec3f middle{at.x, y, at.y};
  const auto uv = [](Vec3f p) { return Vec2f{p.x, -p.z}; };
  for (int i = 0; i < kCorners; ++i) {
    const Vec3f p = rim[i], q = rim[(i + 1) % kCorners];
    pen.mesh().Triangle(middle, p, q, uv(middle), uv(p), uv(q));
  }
}

void DampFoot(FacadePen& pen, const Dress& dress, float x0, float x1, float ground, float top, RngStream& rng) {
  if (!Weathers(dress.wall) || top < ground + 0.1f) return;
  pen.Use(MendOf(dress.wall, rng));
  const int pieces = std::max(2, static_cast<int>((x1 - x0) / 0.3f));
  const float w = (x1 - x0) / static_cast<float>(pieces), y = -0.008f * pen.reach();
  const auto height = [&] { return ground + (top - ground) * static_cast<float>(0.62 + 0.38 * rng.Uniform() * rng.Uniform()); };
  float z = height();
  for (int i = 0; i < pieces; ++i) {
    const float a = x0 + w * static_cast<float>(i), b = a + w, next = height();
    pen.mesh().QuadUv({a, y, 0}, {b, y, 0}, {b, y, next}, {a, y, z}, {a, 0}, {b, 0}, {b, -next}, {a, -z});
    z = next;
  }
}

void WearWall(FacadePen& pen, const Dress& dress, float from, float top, const std::vector<Kept>& kept, float amount, RngStream& rng) {
  const float area = pen.length() * (top - from);
  if (area < 6 || top - from < 2) return;
  const auto uniform = [&](double a, double b) { return static_cast<float>(rng.Uniform(a, b)); };
  const auto count = [&](float each) { return static_cast<int>(amount * area / each + uniform(0, 1)); };
  Vec2f at;
  if (Weathers(dress.wall)) {
    for (int i = 0, n = std::min(count(6), 26); i < n; ++i) {
      // Most are small, and those between windows as small as they must be.
      const float size = uniform(0.3, 1.0) * uniform(0.3, 1.0), tall = uniform(0.7, 1.4);
      Vec2f half{0.15f + 1.1f * size, (0.15f + 1.0f * size) * tall};
      bool found = FindPlace(pen, kept, from, top, half.x, half.y, rng, at);
      for (int k = 0; k < 3 && !found; ++k) found = FindPlace(pen, kept, from, top, (half.x *= 0.6f), (half.y *= 0.75f), rng, at);
      if (!found) continue;
      pen.Use(MendOf(dress.wall, rng));
      RoughPatch(pen, at, half, 0.006f + 0.0003f * static_cast<float>(i), rng);
    }
  }
  for (int i = 0, n = std::min(count(20), 8); i < n; ++i)
    if (FindPlace(pen, kept, from, top, 0.2f, 0.2f, rng, at)) HangGrille(pen, at.x, at.y, rng);
  for (int i = 0, n = std::min(count(45), 4); i < n; ++i) {
    const float foot = from + uniform(0, 0.2) * (top - from), head = top - uniform(0.05, 0.5) * (top - from);
    const float x = uniform(0.3, static_cast<double>(pen.length()) - 0.3);
    if (head - foot > 1.5f && IsFree(kept, x - 0.09f, x + 0.09f, foot, head)) RunPipe(pen, x, foot, head, rng);
  }
  if (pen.length() < 3 || !rng.Chance(0.3 + 0.4 * static_cast<double>(amount))) return;
  for (int i = 0; i < 6; ++i) {
    const float z = from + uniform(0, 0.5) * (top - from);
    if (IsFree(kept, 0, pen.length(), z - 0.14f, z + 0.05f)) return HangCable(pen, z, rng);
  }
}

}  // namespace airsim360::internal

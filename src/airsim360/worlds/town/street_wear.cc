#include "airsim360/worlds/town/street_wear.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

// Heights over the asphalt, each layer above those that it may cover; markings lie two millimetres above all of them.
constexpr float kStainLift = 0.0008f, kPatchLift = 0.0012f, kSealLift = 0.0018f;

// Less would be a sliver at the edge that a stain is cut to: twice its area, square metres.
constexpr float kLeastArea = 2e-5f;

// A point of what is worn at (s, d), metres.
using Place = std::function<Vec3f(float s, float d, float lift)>;

float Uniform(RngStream& rng, float a, float b) { return static_cast<float>(rng.Uniform(a, b)); }

// A spot of ragged outline, longer along s by `stretch`.
void LaySpot(Ground& ground, const Place& at, float s, float d, float radius, float stretch, float lift, int corners, RngStream& rng) {
  const auto uv = [](Vec3f p) { return Vec2f{p.x, -p.y}; };
  const Vec3f middle = at(s, d, lift);
  Vec3f first, last;
  const float turn = Uniform(rng, 0, 6.283f);
  for (int k = 0; k <= corners; ++k) {
    const float a = turn + 6.2831853f * static_cast<float>(k) / static_cast<float>(corners), r = radius * Uniform(rng, 0.65f, 1.25f);
    const Vec3f p = k == corners ? first : at(s + stretch * r * std::cos(a), d + r * std::sin(a), lift);
    const float side = k == 0 ? 0.0f : Cross(last - middle, p - middle).z;
    if (k == 0) first = p;
    if (side > kLeastArea) ground.mesh().Triangle(middle, last, p, uv(middle), uv(last), uv(p));
    if (side < -kLeastArea) ground.mesh().Triangle(middle, p, last, uv(middle), uv(p), uv(last));
    last = p;
  }
}

// A band between two points with its own width at each end.
void LayBand(Ground& ground, const Place& at, Vec2f a, Vec2f b, float wa, float wb, float lift) {
  const Vec2f v = b - a;
  const float l = std::max(1e-3f, std::hypot(v.x, v.y));
  const Vec2f n{-v.y / l, v.x / l};
  const auto p = [&](Vec2f q, float w) { return at(q.x + n.x * w, q.y + n.y * w, lift); };
  Vec3f corners[4] = {p(a, -wa), p(b, -wb), p(b, wb), p(a, wa)};
  const float side = Cross(corners[1] - corners[0], corners[2] - corners[0]).z;
  if (std::abs(side) < kLeastArea) return;
  if (side < 0) std::swap(corners[1], corners[3]);
  ground.Quad(corners[0], corners[1], corners[2], corners[3]);
}

// A flat scrap of `size` metres, turned at random: a leaf (pointed) or paper.
void LayScrap(Ground& ground, const Place& at, float s, float d, float size, bool leaf, float lift, RngStream& rng) {
  const float a = Uniform(rng, 0, 6.283f), narrow = leaf ? Uniform(rng, 0.3f, 0.5f) : Uniform(rng, 0.25f, 0.75f);
  const Vec2f along{size / 2 * std::cos(a), size / 2 * std::sin(a)}, across{-narrow * along.y, narrow * along.x};
  const auto p = [&](float x, float y) { return at(s + x * along.x + y * across.x, d + x * along.y + y * across.y, lift); };
  Vec3f corners[4] = {p(-1, -1), p(1, -0.9f), p(0.9f, 1), p(-1, 0.8f)};
  if (leaf) corners[0] = p(-1, 0), corners[1] = p(0.1f, -1), corners[2] = p(1, 0), corners[3] = p(0.1f, 1);
  const float side = Cross(corners[1] - corners[0], corners[2] - corners[0]).z;
  if (std::abs(side) < kLeastArea) return;
  if (side < 0) std::swap(corners[1], corners[3]);
  ground.Quad(corners[0], corners[1], corners[2], corners[3]);
}

// Leaves of last autumn, and now and then a butt, a ticket, a scrap of packing.
void DropScrap(Ground& ground, const Place& at, float s, float d, float lift, RngStream& rng) {
  static constexpr Surface kLeaves[] = {Surface::kDirt, Surface::kDoorWood, Surface::kSandstone, Surface::kFrameWood};
  static constexpr Surface kRubbish[] = {Surface::kFrameWhite, Surface::kTrimWhite, Surface::kStuccoRose, Surface::kShutterBlue};
  const bool leaf = rng.Chance(0.68), butt = !leaf && rng.Chance(0.6);
  ground.Use(leaf ? kLeaves[rng.Index(4)] : butt ? Surface::kTrimWhite : kRubbish[rng.Index(4)]);
  LayScrap(ground, at, s, d, leaf ? Uniform(rng, 0.035f, 0.085f) : butt ? 0.028f : Uniform(rng, 0.04f, 0.12f), leaf, lift, rng);
}

// A wandering sealed crack of `steps` pieces from (s, d) towards `heading`, kept within |d - middle| <= half.
void LayCrack(Ground& ground, const Place& at, Vec2f p, float heading, int steps, float half, RngStream& rng) {
  // Each piece bends in four; the sealer is poured thick and thin, and thins out at both ends.
  float bend = 0, width = 0.004f;
  for (int k = 0; k < 4 * steps; ++k) {
    if (k % 4 == 0) bend = Uniform(rng, -0.22f, 0.22f);
    heading += bend + Uniform(rng, -0.16f, 0.16f);
    const float step = Uniform(rng, 0.07f, 0.2f), ends = 0.25f * static_cast<float>(std::min(k + 1, 4 * steps - k - 1));
    const float next_width = std::min(Uniform(rng, 0.004f, 0.019f), 0.002f + 0.012f * ends);
    const Vec2f next{p.x + step * std::cos(heading), std::clamp(p.y + step * std::sin(heading), -half, half)};
    LayBand(ground, at, p, next, width, next_width, kSealLift);
    p = next, width = next_width;
  }
}

// A repair with a tarred edge, in asphalt of another age or in concrete.
void LayRepair(Ground& ground, const StreetStretch& street, float s, float length, float d0, float d1, RngStream& rng) {
  static constexpr Surface kFills[] = {Surface::kAsphaltPatch, Surface::kAsphaltPatch, Surface::kAsphaltOld, Surface::kAsphaltPale,
                                       Surface::kGutter};
  ground.Use(Surface::kTar);
  StreetRect(ground, street, s - 0.03f, s + length + 0.03f, d0 - 0.03f, d1 + 0.03f, kPatchLift);
  ground.Use(kFills[rng.Index(5)]);
  StreetRect(ground, street, s, s + length, d0, d1, kPatchLift + 0.0006f);
}

void LayRepairs(Ground& ground, const StreetStretch& street, float hw, RngStream& rng) {
  const float length = street.s1 - street.s0;
  // Patches: one every ten metres of a wide street.
  const int patches = static_cast<int>(length * hw / 75);
  for (int i = 0; i < patches; ++i) {
    const float wide = Uniform(rng, 0.6f, 1.9f), s = Uniform(rng, street.s0 + 6, street.s1 - 8), d = Uniform(rng, 0.3f, hw - wide - 0.2f),
                d0 = rng.Chance(0.5) ? d : -d - wide;
    LayRepair(ground, street, s, Uniform(rng, 0.7f, 4.5f), d0, d0 + wide, rng);
  }
  // Trenches from the middle to a kerb.
  for (int i = 0; i < 1 + static_cast<int>(length / 45); ++i) {
    const float s = Uniform(rng, street.s0 + 7, street.s1 - 8), from = Uniform(rng, 0.3f, 1.5f), side = rng.Chance(0.5) ? 1.0f : -1.0f;
    LayRepair(ground, street, s, Uniform(rng, 0.5f, 0.9f), side > 0 ? from : -hw, side > 0 ? hw : -from, rng);
  }
}

// Seams between the strips that the paver laid.
void LaySeams(Ground& ground, const StreetStretch& street, const Place& at, float hw, RngStream& rng) {
  ground.Use(Surface::kTar);
  for (float d = Uniform(rng, 2.8f, 3.6f); d < hw - 0.5f; d += Uniform(rng, 3.2f, 3.9f)) {
    for (float side : {-1.0f, 1.0f}) {
      Vec2f p{street.s0 + 1, side * d};
      while (p.x < street.s1 - 3) {
        const Vec2f next{p.x + Uniform(rng, 1.5f, 3.5f), side * (d + Uniform(rng, -0.03f, 0.03f))};
        if (rng.Chance(0.7)) LayBand(ground, at, p, next, Uniform(rng, 0.006f, 0.02f), Uniform(rng, 0.006f, 0.02f), kSealLift);
        p = next;
      }
    }
  }
}

// Oil where cars stand, and the marks of tyres that braked or turned out.
void LayOilAndTyres(Ground& ground, const StreetStretch& street, const Place& at, float hw, RngStream& rng) {
  for (float s = street.s0 + 6; s < street.s1 - 6; s += Uniform(rng, 6, 17)) {
    const bool bay = rng.Chance(0.5);
    const float side = rng.Chance(0.5) ? 1.0f : -1.0f, d = side * (bay ? hw - Uniform(rng, 0.4f, 1.2f) : Uniform(rng, 0.8f, hw - 1.5f));
    ground.Use(rng.Chance(0.7) ? Surface::kAsphaltPatch : Surface::kTar);
    LaySpot(ground, at, s, d, Uniform(rng, 0.03f, 0.13f), Uniform(rng, 1, 2), kStainLift, 14, rng);
  }
  ground.Use(Surface::kAsphaltPatch);
  for (int i = 0; i < static_cast<int>((street.s1 - street.s0) / 9); ++i) {
    const float side = rng.Chance(0.5) ? 1.0f : -1.0f, s = Uniform(rng, street.s0 + 3, street.s1 - 12);
    Vec2f p{s, side * Uniform(rng, 0.8f, hw - 2)};
    float drift = Uniform(rng, -0.06f, 0.06f);
    const float run = Uniform(rng, 2.5f, 8), w = Uniform(rng, 0.05f, 0.09f);
    for (int k = 0; k < 5; ++k) {
      const Vec2f next{p.x + run / 5, p.y + drift * run / 5};
      const auto width = [&](int j) { return w * (j == 0 ? 0.25f : j == 5 ? 0.1f : 1.0f); };
      LayBand(ground, at, p, next, width(k), width(k + 1), kStainLift + 0.0003f);
      LayBand(ground, at, {p.x, p.y + side * 1.5f}, {next.x, next.y + side * 1.5f}, width(k), width(k + 1), kStainLift + 0.0003f);
      p = next;
      drift += Uniform(rng, -0.03f, 0.03f);
    }
  }
}

// What rain and brooms leave along the kerb: silt in long tongues, leaves and litter, in drifts with bare lengths between.
void LayGutterDirt(Ground& ground, const StreetStretch& street, RngStream& rng) {
  const float hw = street.line.half_width;
  for (float side : {-1.0f, 1.0f}) {
    const Place at = [&](float s, float d, float lift) {
      return street.At(std::clamp(s, street.s0, street.s1), side * std::clamp(d, hw - 0.34f, hw - 0.005f), lift);
    };
    float much = 0.5f;
    for (float s = street.s0 + 0.5f; s < street.s1 - 0.5f; s += Uniform(rng, 0.3f, 1.1f)) {
      much = std::clamp(much + Uniform(rng, -0.25f, 0.25f), 0.0f, 1.0f);
      if (rng.Chance(0.15 + 0.6 * much)) {
        ground.Use(rng.Chance(0.6) ? Surface::kDirt : Surface::kAsphaltPatch);
        LaySpot(ground, at, s, hw - Uniform(rng, 0.01f, 0.09f), Uniform(rng, 0.03f, 0.05f + 0.10f * much), Uniform(rng, 2, 7), kStainLift,
                9, rng);
      }
      const int scraps = static_cast<int>(Uniform(rng, 0, 0.4f + 4.5f * much * much));
      for (int i = 0; i < scraps; ++i)
        DropScrap(ground, at, s + Uniform(rng, -0.5f, 0.5f), hw - 0.03f - 0.28f * Uniform(rng, 0, 1) * Uniform(rng, 0, 1), kSealLift, rng);
    }
  }
}

// Lines and arrows sprayed by who looks for pipes.
void LaySprayedMarks(Ground& ground, const StreetStretch& street, const Place& at, float hw, RngStream& rng) {
  for (int i = 0; i < 3; ++i) {
    ground.Use(rng.Chance(0.5) ? Surface::kPaintWhite : Surface::kPaintYellow);
    const Vec2f p{Uniform(rng, street.s0 + 4, street.s1 - 6), (rng.Chance(0.5) ? 1.0f : -1.0f) * Uniform(rng, 0.8f, hw - 1)};
    const float a = Uniform(rng, 0, 6.283f), l = Uniform(rng, 0.4f, 1.3f);
    const Vec2f tip{p.x + l * std::cos(a), p.y + l * std::sin(a)};
    LayBand(ground, at, p, tip, 0.02f, 0.015f, kSealLift);
    for (float barb : {2.6f, -2.6f})
      LayBand(ground, at, tip, {tip.x + 0.2f * std::cos(a + barb), tip.y + 0.2f * std::sin(a + barb)}, 0.018f, 0.012f, kSealLift);
  }
}

}  // namespace

void LayWear(Ground& ground, const StreetStretch& street, RngStream& rng) {
  const float hw = street.line.half_width - 0.6f;
  // Across the crown in one piece would cut its ridge by some millimetres: what is narrow may.
  const Place at = [&](float s, float d, float lift) { return street.At(s, std::clamp(d, -hw, hw), lift); };
  LayOilAndTyres(ground, street, at, hw, rng);
  LayRepairs(ground, street, hw, rng);
  LaySeams(ground, street, at, hw, rng);
  for (int i = 0; i < static_cast<int>((street.s1 - street.s0) * hw / 55); ++i) {
    const Vec2f p{Uniform(rng, street.s0 + 1, street.s1 - 9), Uniform(rng, -hw, hw)};
    const bool along = rng.Chance(0.7);
    LayCrack(ground, at, p, along ? 0 : 1.57f, along ? 14 : 8, hw, rng);
  }
  LaySprayedMarks(ground, street, at, hw, rng);
  LayGutterDirt(ground, street, rng);
}

void LayJunctionWear(Ground& ground, const Fan& fan, RngStream& rng) {
  const float reach = 8.5f;
  const Place on = [&](float x, float y, float lift) {
    const Vec2f p{fan.middle.x + std::clamp(x, -10.5f, 10.5f), fan.middle.y + std::clamp(y, -10.5f, 10.5f)};
    return Vec3f{p.x, p.y, fan.Height(p) + lift};
  };
  for (int i = 0; i < 8; ++i) {
    ground.Use(rng.Chance(0.7) ? Surface::kAsphaltPatch : Surface::kTar);
    LaySpot(ground, on, Uniform(rng, -reach, reach), Uniform(rng, -reach, reach), Uniform(rng, 0.03f, 0.13f), 1.3f, 0.003f, 14, rng);
  }
  // Lanes resurfaced across, and repairs: in small squares, which follow the fan.
  static constexpr Surface kLanes[] = {Surface::kAsphaltPale, Surface::kAsphaltPatch, Surface::kAsphaltOld};
  for (int i = 0; i < 2; ++i) {
    ground.Use(kLanes[rng.Index(3)]);
    const float x0 = (i == 0 ? -1.0f : 1.0f) * Uniform(rng, 1.2f, 4) - 1.6f, from = Uniform(rng, -reach, -3),
                lift = 0.0035f + 0.0002f * static_cast<float>(i);
    for (int k = 0; k < 4 * 20; ++k) {
      const float x = x0 + 0.8f * static_cast<float>(k % 4), y = from + 0.8f * static_cast<float>(k / 4);
      if (y > reach || std::hypot(x + 0.4f, y + 0.4f) < 1.3f) continue;
      ground.Quad(on(x, y, lift), on(x + 0.8f, y, lift), on(x + 0.8f, y + 0.8f, lift), on(x, y + 0.8f, lift));
    }
  }
  static constexpr Surface kFills[] = {Surface::kAsphaltPatch, Surface::kAsphaltOld, Surface::kAsphaltPale, Surface::kAsphaltPatch};
  for (int i = 0; i < 9; ++i) {
    const float x0 = Uniform(rng, -reach, reach - 3), y0 = Uniform(rng, -reach, reach - 3);
    const int nx = 3 + static_cast<int>(rng.Index(9)), ny = 2 + static_cast<int>(rng.Index(6));
    ground.Use(kFills[rng.Index(4)]);
    const float lift = 0.005f + 0.0002f * static_cast<float>(i);
    for (int k = 0; k < nx * ny; ++k) {
      const float x = x0 + 0.4f * static_cast<float>(k % nx), y = y0 + 0.4f * static_cast<float>(k / nx);
      if (std::hypot(x + 0.2f, y + 0.2f) < 0.9f) continue;  // the cover in the middle
      ground.Quad(on(x, y, lift), on(x + 0.4f, y, lift), on(x + 0.4f, y + 0.4f, lift), on(x, y + 0.4f, lift));
    }
  }
  // Arcs of tyres that turned.
  ground.Use(Surface::kAsphaltPatch);
  for (int i = 0; i < 8; ++i) {
    const float r = Uniform(rng, 7, 12), a0 = Uniform(rng, 0, 6.283f), run = Uniform(rng, 0.3f, 0.8f);
    const Vec2f c{(rng.Chance(0.5) ? 1.0f : -1.0f) * Uniform(rng, 6, 11), (rng.Chance(0.5) ? 1.0f : -1.0f) * Uniform(rng, 6, 11)};
    for (int k = 0; k < 8; ++k) {
      for (float side : {0.0f, 1.5f}) {
        const auto p = [&](int j) {
          const float a = a0 + run * static_cast<float>(j) / 8;
          return Vec2f{c.x + (r + side) * std::cos(a), c.y + (r + side) * std::sin(a)};
        };
        const Vec2f q = p(k);
        if (std::max(std::abs(q.x), std::abs(q.y)) > reach + 1) continue;
        LayBand(ground, on, q, p(k + 1), 0.07f, 0.07f, 0.0035f);
      }
    }
  }
  ground.Use(Surface::kTar);
  for (int i = 0; i < 15; ++i)
    LayCrack(
        ground, [&](float x, float y, float) { return on(x, y, 0.009f); }, {Uniform(rng, -reach, reach), Uniform(rng, -reach, reach)},
        Uniform(rng, 0, 6.283f), 12, reach + 1, rng);
}

void LayPavementWear(Ground& ground, const PavementPoint& at, float s0, float s1, float d0, float d1, Surface slabs, RngStream& rng) {
  const float area = (s1 - s0) * (d1 - d0);
  const auto lift = [](float l) { return l + 0.0005f; };
  // Slabs replaced by others, or filled up with asphalt.
  for (int i = 0; i < static_cast<int>(area / 22 + Uniform(rng, 0, 1)); ++i) {
    const float w = 0.6f * static_cast<float>(1 + rng.Index(2)), l = 0.6f * static_cast<float>(1 + rng.Index(3));
    if (s1 - s0 < l + 0.2f || d1 - d0 < w + 0.2f) continue;
    const float s = Uniform(rng, s0 + 0.1f, s1 - l - 0.1f), d = Uniform(rng, d0 + 0.1f, d1 - w - 0.1f);
    const bool brick = slabs == Surface::kPlazaBrick || slabs == Surface::kPlazaBrickDark;
    const Surface other = slabs == Surface::kPlazaBrick ? Surface::kPlazaBrickDark : Surface::kPlazaBrick;
    ground.Use(rng.Chance(brick ? 0.15 : 0.35) ? Surface::kAsphaltPatch
               : brick                         ? other
               : rng.Chance(0.5)               ? Surface::kGutter
                                               : Surface::kKerb);
    ground.Quad(at(s, d, lift(0.0008f)), at(s + l, d, lift(0.0008f)), at(s + l, d + w, lift(0.0008f)), at(s, d + w, lift(0.0008f)));
  }
  for (int i = 0; i < static_cast<int>(area * 0.015f + Uniform(rng, 0, 1)); ++i) {
    ground.Use(rng.Chance(0.6) ? Surface::kAsphaltOld : Surface::kAsphaltPatch);
    LaySpot(ground, at, Uniform(rng, s0 + 0.3f, s1 - 0.3f), Uniform(rng, d0 + 0.3f, d1 - 0.3f), Uniform(rng, 0.03f, 0.10f), 1.3f,
            lift(0.0010f), 13, rng);
  }
  // Litter, more of it at the walls than where people walk. (Gum is the shader's: render/shared/shading_marks.h.)
  for (int i = 0; i < static_cast<int>(area * 0.45f + Uniform(rng, 0, 1)); ++i) {
    const float edge = Uniform(rng, 0, 1);
    DropScrap(ground, at, Uniform(rng, s0 + 0.07f, s1 - 0.07f), d1 - 0.07f - (d1 - d0 - 0.14f) * edge * edge, lift(0.0014f), rng);
  }
  ground.Use(slabs);
}

}  // namespace airsim360::internal

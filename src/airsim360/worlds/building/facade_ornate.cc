// Bays of the ornate towers of the 1910s to 1930s: terracotta under copper, glazed brick between piers.
#include <algorithm>
#include <utility>

#include "airsim360/worlds/building/facade_bays.h"

namespace airsim360::internal {
namespace {

constexpr int kBaseStoreys = 2;  // of cut stone

// A lozenge with half axes a and h, standing proud of the wall by `out`.
void Lozenge(FacadePen& pen, float x, float z, float a, float h, float out) {
  const float y = -out * pen.reach();
  pen.mesh().Quad({x - a, y, z}, {x, y, z - h}, {x + a, y, z}, {x, y, z + h});
}

// Half a pier at each end of a bay: courses of stone with joints between them below, brick with quoins above.
void TerracottaPiers(FacadePen& pen, const Dress& dress, const Bay& b, bool stone) {
  constexpr float kPier = 0.42f, kCourse = 0.475f, kJoint = 0.045f;
  for (const float x0 : {b.x0, b.x1 - kPier}) {
    if (!stone) {
      pen.Use(dress.wall);
      pen.Bar(x0, x0 + kPier, b.z0, b.z1, -0.10f, 0, true, false);
      pen.Use(dress.trim);
      for (float z = b.z0 + 0.1f; z + 0.3f < b.z1; z += 0.76f) pen.Bar(x0 + 0.06f, x0 + kPier - 0.06f, z, z + 0.3f, -0.13f, -0.10f);
      continue;
    }
    pen.Use(dress.base);
    for (float z = b.z0; z + 0.1f < b.z1; z += kCourse) pen.Bar(x0, x0 + kPier, z, std::min(z + kCourse, b.z1) - kJoint, -0.15f, 0);
  }
}

// A wide window of three sashes between mullions.
void ThreeSashes(FacadePen& pen, const Dress& dress, const Opening& o, RngStream& rng) {
  constexpr float kMullion = 0.16f, kSide = 0.26f;  // metres, and share of the width of each side light
  const float w = o.x1 - o.x0, a = o.x0 + kSide * w, c = o.x1 - kSide * w, half = kMullion / 2;
  const float lights[3][2] = {{o.x0, a - half}, {a + half, c - half}, {c + half, o.x1}};
  for (const auto& [x0, x1] : lights) {
    FacadePen::Sash sash{.t = 0.055f, .nx = 0, .nz = 1, .frame = dress.frame, .glass = dress.glass};
    Furnish(sash, rng);
    pen.Window(x0, x1, o.z0, o.z1, o.depth, sash);
  }
  pen.Use(dress.trim);
  for (const float x : {a, c}) pen.Bar(x - half, x + half, o.z0, o.z1, 0.04f, o.depth, true, false);
}

// Over the windows of the top storey: a flat arch of voussoirs and a medallion on each side.
void TerracottaArch(FacadePen& pen, const Bay& b, const Opening& o) {
  constexpr int kStones = 9;
  const float x0 = o.x0 - 0.18f, x1 = o.x1 + 0.18f, rise = 0.42f, y = -0.09f * pen.reach();
  const auto at = [&](int i) {
    const float t = static_cast<float>(i) / kStones;
    return Vec3f{x0 + (x1 - x0) * t, y, o.z1 + 0.12f + rise * 4 * t * (1 - t)};
  };
  for (int i = 0; i < kStones; ++i) pen.mesh().Beam(at(i), at(i + 1), 0.2f);
  for (const float x : {b.x0 + 0.21f, b.x1 - 0.21f}) Lozenge(pen, x, b.z1 - 0.45f, 0.17f, 0.26f, 0.16f);
}

// Three rows of chevrons, one above the other, between two fillets.
void Chevrons(FacadePen& pen, const Dress& dress, float x0, float x1, float z0, float z1) {
  const float m = (x0 + x1) / 2, h = (z1 - z0 - 0.2f) / 3;
  pen.Use(dress.trim);
  for (const float z : {z0, z1 - 0.07f}) pen.Bar(x0, x1, z, z + 0.07f, -0.05f, 0);
  pen.Use(dress.wall);
  const float y = -0.035f * pen.reach(), t = 0.45f * h;
  for (int i = 0; i < 3; ++i) {
    const float z = z0 + 0.1f + h * static_cast<float>(i);
    pen.mesh().Quad({x0, y, z}, {m, y, z + h - t}, {m, y, z + h}, {x0, y, z + t});
    pen.mesh().Quad({m, y, z + h - t}, {x1, y, z}, {x1, y, z + t}, {m, y, z + h});
  }
}

}  // namespace

void BuildTerracottaBay(FacadePen& pen, const Dress& dress, const Bay& b, const Opening& o, RngStream& rng) {
  const bool stone = b.floor < kBaseStoreys && b.floors > kBaseStoreys + 1, top = b.floor + 1 == b.floors;
  pen.Use(stone ? dress.base : dress.wall);
  pen.WallAround(b.x0, b.x1, b.z0, b.z1, o.x0, o.x1, o.z0, o.z1);
  pen.Reveal(o.x0, o.x1, o.z0, o.z1, 0, o.depth);
  ThreeSashes(pen, dress, o, rng);
  TerracottaPiers(pen, dress, b, stone);
  pen.Use(stone ? dress.base : dress.trim);
  pen.Bar(o.x0 - 0.18f, o.x1 + 0.18f, o.z0 - 0.14f, o.z0, -0.13f, 0.2f);
  pen.Bar(o.x0 - 0.16f, o.x0, o.z0, o.z1, -0.06f, 0, true, false);
  pen.Bar(o.x1, o.x1 + 0.16f, o.z0, o.z1, -0.06f, 0, true, false);
  pen.Bar(o.x0 - 0.16f, o.x1 + 0.16f, o.z1, o.z1 + 0.2f, -0.08f, 0);
  if (stone) return;
  // A panel of lozenges under the sill; a course where the stone ends and below the top storey.
  pen.Bar(o.x0, o.x1, b.z0 + 0.1f, o.z0 - 0.2f, -0.04f, 0);
  for (int i = 0; i < 3; ++i) Lozenge(pen, o.x0 + (o.x1 - o.x0) * (static_cast<float>(i) + 0.5f) / 3, b.z0 + 0.375f, 0.3f, 0.22f, 0.07f);
  if (b.floor == kBaseStoreys || top) pen.Bar(b.x0, b.x1, b.z0 - 0.22f, b.z0 + 0.08f, -0.24f, 0, false, true);
  if (top) TerracottaArch(pen, b, o);
}

void BuildGlazedDecoBay(FacadePen& pen, const Dress& dress, const Bay& b, const Opening& o, RngStream& rng) {
  constexpr float kPier = 0.26f, kStep = 0.12f, kProud = 0.30f, kCrown = 1.5f;
  const bool top = b.floor + 1 == b.floors, second = b.floor == 0;
  const float w0 = b.x0 + kPier + kStep, w1 = b.x1 - kPier - kStep;
  // Piers in two steps, without a break from the shops up.
  pen.Use(dress.wall);
  pen.Bar(b.x0, b.x0 + kPier, b.z0, b.z1, -kProud, 0, true, false);
  pen.Bar(b.x1 - kPier, b.x1, b.z0, b.z1, -kProud, 0, true, false);
  pen.Bar(b.x0 + kPier, w0, b.z0, b.z1, -0.13f, 0, true, false);
  pen.Bar(w1, b.x1 - kPier, b.z0, b.z1, -0.13f, 0, true, false);
  // Windows and spandrels lie back between them, as one strip.
  pen.Use(dress.trim);
  pen.WallAround(w0, w1, b.z0, b.z1, o.x0, o.x1, o.z0, o.z1);
  pen.Reveal(o.x0, o.x1, o.z0, o.z1, 0, o.depth);
  FacadePen::Sash sash{.t = 0.05f, .nx = 0, .nz = 1, .frame = dress.frame, .glass = dress.glass};
  Furnish(sash, rng);
  pen.Window(o.x0, o.x1, o.z0, o.z1, o.depth, sash);
  Chevrons(pen, dress, w0, w1, b.z0 + 0.08f, o.z0 - 0.1f);
  pen.Use(dress.trim);
  pen.Bar(w0, w1, o.z0 - 0.09f, o.z0, -0.06f, 0.2f);
  if (second) pen.Bar(b.x0, b.x1, b.z0 - 0.05f, b.z0 + 0.22f, -kProud - 0.05f, -kProud + 0.02f, false, true);
  if (!top) return;
  // Flutes over the last windows, and the piers as steps above the parapet.
  const float w = (w1 - w0) / 5;
  for (int i = 0; i < 5; i += 2)
    pen.Bar(w0 + w * static_cast<float>(i), w0 + w * static_cast<float>(i + 1), o.z1 + 0.1f, b.z1 + 0.9f, -0.08f, 0);
  pen.Use(dress.wall);
  const float y = -kProud * pen.reach();
  for (const auto& [x0, x1] : {std::pair{b.x0, b.x0 + kPier}, std::pair{b.x1 - kPier, b.x1}}) {
    pen.mesh().Box({x0, y, b.z1}, {x1, 0.22f, b.z1 + kCrown});
  }
}

}  // namespace airsim360::internal

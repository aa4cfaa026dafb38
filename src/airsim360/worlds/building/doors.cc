#include "airsim360/worlds/building/doors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace airsim360::internal {
namespace {

using S = Surface;

constexpr float kLevel = 0.2f;                      // metres that the ground may lie below a floor without steps
constexpr float kFrame = 0.06f, kLeafBack = 0.02f;  // metres: width of the frame, how far the leaf stands before the opening's back

constexpr float kStile = 0.11f, kProud = 0.032f;  // metres: width of stiles, how far they stand before the panels

// Where the leaf hangs: its face, and what is screwed on it.
struct HungLeaf {
  float x0, x1, z0, z1, y;
  float middle() const { return (x0 + x1) / 2; }
};

// Lever on its plate, at the side away from the hinges.
void FixLever(FacadePen& pen, const HungLeaf& leaf) {
  pen.Use(S::kMetal);
  const float x = leaf.x1 - 0.10f, z = leaf.z0 + 1.0f;
  pen.Bar(x - 0.025f, x + 0.025f, z - 0.12f, z + 0.10f, leaf.y - 0.008f, leaf.y);
  pen.Bar(x - 0.12f, x + 0.015f, z, z + 0.022f, leaf.y - 0.055f, leaf.y - 0.035f);
  pen.Bar(x - 0.01f, x + 0.015f, z, z + 0.022f, leaf.y - 0.035f, leaf.y - 0.008f, true, true);
}

void BuildFlush(FacadePen& pen, S face, const HungLeaf& leaf) {
  pen.Use(face);
  pen.Front(leaf.x0, leaf.x1, leaf.z0, leaf.z1, leaf.y);
  pen.Use(S::kMetal);
  pen.Bar(leaf.x0 + 0.02f, leaf.x1 - 0.02f, leaf.z0 + 0.03f, leaf.z0 + 0.27f, leaf.y - 0.004f, leaf.y);
  for (float z : {leaf.z0 + 0.25f, leaf.z0 + 1.05f, leaf.z1 - 0.3f})
    pen.Bar(leaf.x0 - 0.012f, leaf.x0 + 0.012f, z, z + 0.11f, leaf.y - 0.02f, leaf.y);
  pen.Use(S::kTrimDark);
  pen.Bar(leaf.x0 + 0.10f, leaf.x0 + 0.36f, leaf.z1 - 0.10f, leaf.z1 - 0.04f, leaf.y - 0.06f, leaf.y);
  FixLever(pen, leaf);
}

// Stiles and rails around rows of two panels of these heights (0 = no row), up to `top`.
void BuildPanels(FacadePen& pen, S face, const HungLeaf& leaf, float top, std::array<float, 2> heights) {
  const float m = leaf.middle();
  pen.Use(face);
  pen.Front(leaf.x0, leaf.x1, leaf.z0, top, leaf.y);
  for (float x : {leaf.x0, m - kStile / 2, leaf.x1 - kStile}) pen.Bar(x, x + kStile, leaf.z0, top, leaf.y - kProud, leaf.y, true, false);
  float z = leaf.z0;
  pen.Bar(leaf.x0 + kStile, leaf.x1 - kStile, z, z + 0.2f, leaf.y - kProud, leaf.y, false, false);
  z += 0.2f;
  for (float height : heights) {
    if (height <= 0) continue;
    for (float x : {leaf.x0 + kStile, m + kStile / 2}) {
      const float w = (leaf.x1 - leaf.x0 - 3 * kStile) / 2;
      pen.Bar(x + 0.04f, x + w - 0.04f, z + 0.04f, z + height - 0.04f, leaf.y - 0.018f, leaf.y);
    }
    z += height;
    pen.Bar(leaf.x0 + kStile, leaf.x1 - kStile, z, z + 0.13f, leaf.y - kProud, leaf.y, false, true);
    z += 0.13f;
  }
}

void BuildPanelled(FacadePen& pen, S face, const HungLeaf& leaf) {
  const float panels = leaf.z1 - leaf.z0 - 0.2f - 2 * 0.13f, low = 0.40f * panels;
  BuildPanels(pen, face, leaf, leaf.z1, {low, panels - low});
  const HungLeaf proud{leaf.x0, leaf.x1, leaf.z0, leaf.z1, leaf.y - kProud};
  pen.Use(S::kBronze);
  const float slot = leaf.z0 + 0.2f + low + 0.03f;
  pen.Bar(leaf.middle() - 0.14f, leaf.middle() + 0.14f, slot, slot + 0.06f, proud.y - 0.008f, proud.y);
  FixLever(pen, proud);
}

void BuildHalfGlazed(FacadePen& pen, S face, const HungLeaf& leaf) {
  const float rail = leaf.z0 + 1.0f, m = leaf.middle();
  BuildPanels(pen, face, leaf, rail, {rail - leaf.z0 - 0.2f - 0.13f, 0});
  pen.Use(face);
  for (float x : {leaf.x0, leaf.x1 - kStile}) pen.Bar(x, x + kStile, rail, leaf.z1, leaf.y - kProud, leaf.y, true, false);
  pen.Bar(leaf.x0 + kStile, leaf.x1 - kStile, leaf.z1 - 0.12f, leaf.z1, leaf.y - kProud, leaf.y, false, true);
  pen.Bar(m - 0.014f, m + 0.014f, rail, leaf.z1 - 0.12f, leaf.y - 0.024f, leaf.y, true, false);
  const float bar = (rail + leaf.z1 - 0.12f) / 2;
  pen.Bar(leaf.x0 + kStile, leaf.x1 - kStile, bar - 0.014f, bar + 0.014f, leaf.y - 0.024f, leaf.y, false, true);
  pen.Use(S::kGlassDark);
  pen.Front(leaf.x0 + kStile, leaf.x1 - kStile, rail, leaf.z1 - 0.12f, leaf.y - 0.004f);
  FixLever(pen, {leaf.x0, leaf.x1, leaf.z0, leaf.z1, leaf.y - kProud});
}

void BuildBoarded(FacadePen& pen, S face, const HungLeaf& leaf) {
  pen.Use(S::kTrimDark);
  pen.Front(leaf.x0, leaf.x1, leaf.z0, leaf.z1, leaf.y);
  pen.Use(face);
  constexpr int kBoards = 7;
  const float w = (leaf.x1 - leaf.x0) / kBoards;
  for (int i = 0; i < kBoards; ++i) {
    const float x = leaf.x0 + w * static_cast<float>(i);
    pen.Bar(x + 0.004f, x + w - 0.004f, leaf.z0 + 0.02f, leaf.z1 - 0.01f, leaf.y - 0.018f, leaf.y, true, true);
  }
  pen.Use(S::kIronBlack);
  for (float z : {leaf.z0 + 0.3f, leaf.z1 - 0.4f}) pen.Bar(leaf.x0, leaf.x0 + 0.6f, z, z + 0.045f, leaf.y - 0.024f, leaf.y - 0.018f);
  FixLever(pen, {leaf.x0, leaf.x1, leaf.z0, leaf.z1, leaf.y - 0.018f});
}

void BuildShutter(FacadePen& pen, S face, float x0, float x1, float z0, float z1, float y) {
  constexpr float kGuide = 0.08f, kSlat = 0.095f, kDrum = 0.32f;
  pen.Use(face);
  const float top = z1 - kDrum;
  pen.Front(x0 + kGuide, x1 - kGuide, z0, top, y);
  const int slats = static_cast<int>((top - z0) / kSlat);
  for (int i = 0; i < slats; ++i) {
    const float z = z0 + kSlat * static_cast<float>(i);
    pen.Bar(x0 + kGuide, x1 - kGuide, z + 0.012f, z + kSlat - 0.004f, y - 0.018f, y, false, true);
  }
  pen.Bar(x0, x1, top, z1, y - kDoorRelief, y);
  pen.Use(S::kMetal);
  for (float x : {x0, x1 - kGuide}) pen.Bar(x, x + kGuide, z0, top, y - 0.05f, y, true, false);
  pen.Use(S::kTrimDark);
  pen.Bar(x0 + kGuide, x1 - kGuide, z0, z0 + 0.07f, y - 0.03f, y);
}

}  // namespace

void HangDoor(FacadePen& pen, DoorMake make, Surface face, Surface frame, float x0, float x1, float z0, float z1, float y) {
  if (make == DoorMake::kRollerShutter) return BuildShutter(pen, face, x0, x1, z0, z1, y);
  pen.Use(frame);
  for (float x : {x0, x1 - kFrame}) pen.Bar(x, x + kFrame, z0, z1, y - 0.06f, y, true, false);
  pen.Bar(x0 + kFrame, x1 - kFrame, z1 - kFrame, z1, y - 0.06f, y, false, true);
  HungLeaf leaf{x0 + kFrame, x1 - kFrame, z0, z1 - kFrame, y - kLeafBack};
  // A pane over what is higher than a leaf.
  if (leaf.z1 - leaf.z0 > 2.3f) {
    const float head = leaf.z0 + 2.08f;
    pen.Bar(leaf.x0, leaf.x1, head, head + kFrame, y - 0.06f, y, false, true);
    pen.Use(S::kGlassDark);
    pen.Front(leaf.x0, leaf.x1, head + kFrame, leaf.z1, y - 0.01f);
    leaf.z1 = head;
  }
  pen.Use(S::kTrimStone);
  pen.Bar(leaf.x0, leaf.x1, z0, z0 + 0.02f, y - 0.06f, y, false, false);
  leaf.z0 += 0.02f;
  switch (make) {
    case DoorMake::kPanelled:
      return BuildPanelled(pen, face, leaf);
    case DoorMake::kHalfGlazed:
      return BuildHalfGlazed(pen, face, leaf);
    case DoorMake::kBoarded:
      return BuildBoarded(pen, face, leaf);
    default:
      return BuildFlush(pen, face, leaf);
  }
}

namespace {

bool IsModern(FacadeStyle style) {
  return style == FacadeStyle::kCurtainWall || style == FacadeStyle::kBracedGlass || style == FacadeStyle::kRibbon ||
         style == FacadeStyle::kConcreteGrid;
}

DoorMake MakeOf(const BuildingPlan& plan, bool wide, RngStream& rng) {
  const double pick = rng.Uniform();
  const bool home = plan.floors < 3 && !plan.shops;
  if (wide && !home && pick < (IsModern(plan.style) ? 0.35 : 0.22)) return DoorMake::kRollerShutter;
  if (home) return pick < 0.45 ? DoorMake::kPanelled : pick < 0.85 ? DoorMake::kHalfGlazed : DoorMake::kBoarded;
  if (IsModern(plan.style)) return pick < 0.85 ? DoorMake::kFlush : DoorMake::kHalfGlazed;
  return pick < 0.52 ? DoorMake::kFlush : pick < 0.74 ? DoorMake::kPanelled : pick < 0.92 ? DoorMake::kHalfGlazed : DoorMake::kBoarded;
}

Surface FaceOf(DoorMake make, RngStream& rng) {
  static constexpr S kSteel[] = {S::kDoorGrey, S::kDoorGrey, S::kDoorBrown, S::kShutterGreen, S::kShutterBlue, S::kTrimDark},
                     kWood[] = {S::kDoorBrown, S::kDoorBrown, S::kDoorGreen, S::kDoorRed, S::kFrameDark, S::kFrameWhite, S::kDoorGrey},
                     kShutter[] = {S::kMetal, S::kDoorGrey, S::kDoorGrey, S::kShutterGreen};
  if (make == DoorMake::kBoarded) return rng.Chance(0.5) ? S::kFrameWood : S::kDoorBrown;
  if (make == DoorMake::kRollerShutter) return kShutter[rng.Index(4)];
  return make == DoorMake::kFlush ? kSteel[rng.Index(6)] : kWood[rng.Index(7)];
}

// Over the opening: a lamp, a slab, a sheet on two arms, or nothing.
void BuildHood(FacadePen& pen, const Dress& dress, float a, float b, float head, RngStream& rng) {
  // Buildings of maps keep within their outline.
  const float out = pen.reach() < 1 ? 0.25f : static_cast<float>(rng.Uniform(0.55, 0.95)), m = (a + b) / 2;
  const double pick = rng.Uniform();
  if (pick < 0.25) {
    pen.Use(dress.trim);
    pen.Bar(a - 0.3f, b + 0.3f, head + 0.2f, head + 0.3f, -out, 0);
  } else if (pick < 0.45) {
    pen.Use(S::kMetal);
    pen.Bar(a - 0.25f, b + 0.25f, head + 0.28f, head + 0.3f, -out, 0);
    pen.Use(S::kIronBlack);
    for (float x : {a - 0.15f, b + 0.12f}) {
      pen.Bar(x, x + 0.03f, head + 0.25f, head + 0.28f, -out + 0.03f, 0);
      pen.Bar(x, x + 0.03f, head + 0.02f, head + 0.25f, -0.03f, 0);
    }
  } else {
    // A lintel, or a course of bricks on edge.
    pen.Use(rng.Chance(0.5) ? dress.trim : S::kConcrete);
    pen.Bar(a - 0.12f, b + 0.12f, head, head + 0.18f, -0.015f, 0);
  }
  if (rng.Chance(0.6)) {
    pen.Use(S::kTrimDark);
    pen.Bar(m - 0.13f, m + 0.13f, head + 0.42f, head + 0.56f, -0.13f, 0);
    pen.Use(S::kFrameWhite);
    pen.Bar(m - 0.11f, m + 0.11f, head + 0.40f, head + 0.42f, -0.12f, -0.01f);
  }
}

// A cupboard of meters, a grille, a bell with a number plate, a pipe: on the wall between `x0` and `x1`.
void HangServices(FacadePen& pen, float x0, float x1, float top, RngStream& rng) {
  if (x1 - x0 < 0.6f) return;
  const float m = (x0 + x1) / 2;
  const double pick = rng.Uniform();
  if (pick < 0.3) {
    const float w = static_cast<float>(rng.Uniform(0.2, 0.28)), z = static_cast<float>(rng.Uniform(0.5, 1.0)),
                h = static_cast<float>(rng.Uniform(0.45, 0.8));
    pen.Use(rng.Chance(0.5) ? S::kMetal : S::kDoorGrey);
    pen.Bar(m - w, m + w, z, z + h, -0.2f, 0);
    pen.Use(S::kTrimDark);
    pen.Bar(m - 0.004f, m + 0.004f, z + 0.03f, z + h - 0.03f, -0.202f, -0.2f);
    pen.Use(S::kMetal);
    pen.Bar(m + 0.06f, m + 0.10f, z + h, top, -0.05f, -0.01f, true, false);
  } else if (pick < 0.5) {
    const float z = static_cast<float>(rng.Uniform(1.6, 2.3));
    pen.Use(S::kTrimDark);
    pen.Bar(m - 0.28f, m + 0.28f, z, z + 0.4f, -0.02f, 0);
    pen.Use(S::kMetal);
    for (int i = 0; i < 6; ++i) {
      const float s = z + 0.02f + 0.062f * static_cast<float>(i);
      pen.Bar(m - 0.27f, m + 0.27f, s, s + 0.03f, -0.05f, -0.02f);
    }
  } else if (pick < 0.7) {
    pen.Use(S::kMetal);
    pen.Bar(x0 + 0.12f, x0 + 0.24f, 1.25f, 1.55f, -0.03f, 0);
    pen.Use(S::kFrameWhite);
    pen.Bar(x0 + 0.10f, x0 + 0.30f, 1.75f, 1.87f, -0.012f, 0);
  } else if (pick < 0.82) {
    pen.Use(S::kMetal);
    pen.Bar(m - 0.055f, m + 0.055f, 0.15f, top, -0.14f, -0.03f, true, false);
    for (float z : {0.6f, 2.1f}) pen.Bar(m - 0.075f, m + 0.075f, z, z + 0.04f, -0.15f, 0);
  }
}

constexpr float kRise = 0.17f, kTread = 0.28f, kLanding = 1.1f, kDoorFoot = 0.12f, kDoorHalf = 0.55f;

int StepsDown(float fall) { return static_cast<int>(std::ceil((fall + kDoorFoot) / kRise)) - 1; }
float RunOf(float fall) { return kDoorHalf + 0.2f + kTread * static_cast<float>(StepsDown(fall)); }

// A landing before the door and steps down along the wall, with a handrail.
void BuildSteps(FacadePen& pen, const Dress& dress, float middle, float fall) {
  const float side = middle + RunOf(fall) < pen.length() ? 1.0f : -1.0f;
  const int steps = StepsDown(fall);
  const float rise = (fall + kDoorFoot) / static_cast<float>(steps + 1), half = kDoorHalf + 0.2f, end = middle + side * half,
              deep = -fall - 0.4f;
  const auto bar = [&](float x0, float x1, float z0, float z1, float y0, float y1) {
    pen.Bar(std::min(x0, x1), std::max(x0, x1), z0, z1, y0, y1, true, false);
  };
  pen.Use(dress.trim);
  bar(middle - half, middle + half, deep, kDoorFoot, -kLanding, 0);
  for (int i = 0; i < steps; ++i) {
    const float x = end + side * kTread * static_cast<float>(i);
    bar(x, x + side * kTread, deep, kDoorFoot - rise * static_cast<float>(i + 1), -kLanding, 0);
  }
  pen.Use(S::kIronBlack);
  constexpr float y = -kLanding + 0.08f, kRail = 0.95f;
  const float low = kDoorFoot - rise * static_cast<float>(steps), foot = end + side * kTread * static_cast<float>(steps),
              back = middle - side * half;
  const auto post = [&](float x, float z) { bar(x - 0.015f, x + 0.015f, z, z + kRail, y - 0.015f, y + 0.015f); };
  post(back + side * 0.06f, kDoorFoot);
  post(end, kDoorFoot);
  bar(back + side * 0.04f, end, kDoorFoot + kRail, kDoorFoot + kRail + 0.04f, y - 0.02f, y + 0.02f);
  post(foot - side * 0.1f, low);
  pen.mesh().Beam({end, y, kDoorFoot + kRail + 0.02f}, {foot - side * 0.08f, y, low + kRail + 0.02f}, 0.04f);
}

}  // namespace

bool TakesDoor(const FacadePen& pen, const Bay& bay, float fall) {
  if (bay.x1 - bay.x0 < 2 * kDoorHalf + 0.5f || bay.z1 < 2.8f) return false;
  if (fall <= kLevel) return fall > -0.1f;
  // Buildings of maps keep within their outline: no landing fits there.
  if (pen.reach() < 1 || fall > 1.7f) return false;
  return bay.middle() + RunOf(fall) < pen.length() || bay.middle() - RunOf(fall) > 0;
}

void BuildBackDoor(FacadePen& pen, const BuildingPlan& plan, const Dress& dress, const Bay& bay, float fall, RngStream& rng) {
  const float middle = bay.middle(), height = bay.z1;
  const bool level = fall <= kLevel, wide = level && bay.x1 - bay.x0 > 3.0f && height > 3.2f;
  const DoorMake make = MakeOf(plan, wide, rng);
  const bool shutter = make == DoorMake::kRollerShutter;
  const float half = shutter ? 1.3f : kDoorHalf, foot = shutter ? 0.03f : kDoorFoot,
              head = shutter            ? 2.95f
                     : rng.Chance(0.35) ? 2.65f
                                        : 2.25f,
              depth = 0.18f;
  const float a = middle - half, b = middle + half;
  pen.Use(dress.wall);
  pen.WallAround(bay.x0, bay.x1, 0, height, a, b, foot, head);
  pen.Reveal(a, b, foot, head, 0, depth);
  const Surface face = FaceOf(make, rng);
  HangDoor(pen, make, face, make == DoorMake::kFlush ? face : dress.frame, a, b, foot, head, depth);
  if (!level) {
    BuildSteps(pen, dress, middle, fall);
  } else if (!shutter) {
    pen.Use(dress.trim);
    pen.Bar(a - 0.2f, b + 0.2f, 0, kDoorFoot, pen.reach() < 1 ? -0.25f : -0.4f, 0);
  }
  BuildHood(pen, dress, a, b, head, rng);
  HangServices(pen, bay.x0 + 0.1f, a - 0.15f, height - 0.1f, rng);
  HangServices(pen, b + 0.15f, bay.x1 - 0.1f, height - 0.1f, rng);
}

}  // namespace airsim360::internal

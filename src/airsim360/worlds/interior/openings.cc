// Doors with frames and leaves as far open as they stand; windows with panes.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/worlds/interior/interior.h"

namespace airsim360::internal {
namespace {

constexpr float kLeaf = 0.042f, kFrame = 0.045f;

// Coordinates of an opening: `along` from its first side, `across` from the middle of the wall towards larger coordinates.
struct Place {
  bool along_x;
  float at, from, to, z;
  float width() const { return to - from; }
  Vec3f operator()(float along, float across, float height) const {
    return along_x ? Vec3f{from + along, at + across, z + height} : Vec3f{at + across, from + along, z + height};
  }
};
Place PlaceOf(const InteriorPlan& plan, const PlanWall& wall, const PlanOpening& o) {
  return {wall.along_x, wall.at, wall.from + o.from, wall.from + o.to, plan.StoreyZ(wall.storey)};
}

void BoxAt(InteriorPen& pen, const Place& place, float s0, float s1, float a0, float a1, float z0, float z1) {
  pen.WallBox(place.along_x, place.from + s0, place.from + s1, place.at + a0, place.at + a1, place.z + z0, place.z + z1);
}

// A leaf with handles hung at `hinge` (along), reaching `width` towards `dir` (±1), swung by `angle` to the side `swing` (±1 across).
void HangLeaf(InteriorPen& pen, const Place& place, float hinge, float dir, float width, float height, float angle, float swing,
              Finish face, bool glazed) {
  const float c = std::cos(angle), s = std::sin(angle);
  const Vec3f origin = place(hinge, swing * kHalfWall * 0.4f, 0.01f);
  const Vec3f u = place(hinge + dir * c, swing * (kHalfWall * 0.4f + s), 0.01f) - origin;
  Vec3f v{-u.y, u.x, 0};
  AffineTransform X;
  X.A = Mat3f::FromColumns(u, v, {0, 0, 1});
  X.p = origin;
  pen.mesh().SetTransform(X);
  const float t = kLeaf / 2;
  pen.Use(face);
  if (glazed) {
    const float r = 0.11f;
    pen.Box({0, -t, 0}, {r, t, height});
    pen.Box({width - r, -t, 0}, {width, t, height});
    pen.Box({r, -t, 0}, {width - r, t, 0.2f});
    pen.Box({r, -t, height - r}, {width - r, t, height});
    pen.Use(Finish::kGlassTinted);
    pen.Upright(true, 0, r, width - r, 0.2f, height - r, true);
  } else {
    pen.Box({0, -t, 0}, {width, t, height});
  }
  pen.Use(Finish::kChrome);
  for (const float side : {-1.0f, 1.0f}) {
    pen.mesh().Tube({width - 0.07f, side * t, 1.03f}, {width - 0.07f, side * (t + 0.05f), 1.03f}, 0.011f, 0.011f, 8);
    pen.mesh().Tube({width - 0.06f, side * (t + 0.05f), 1.03f}, {width - 0.19f, side * (t + 0.05f), 1.03f}, 0.010f, 0.010f, 8);
    pen.Box({width - 0.095f, side > 0 ? t : -t - 0.006f, 0.93f}, {width - 0.045f, side > 0 ? t + 0.006f : -t, 1.12f});
  }
  pen.mesh().SetTransform({});
}

Finish LeafOf(const InteriorPlan& plan, const PlanOpening& o) {
  if (o.outer) return plan.spec.use == BuildingUse::kApartment ? Finish::kDoorGrey : Finish::kDoorSteel;
  switch (plan.spec.use) {
    case BuildingUse::kApartment:
      return plan.seed % 2 == 0 ? Finish::kDoorWhite : Finish::kDoorOak;
    case BuildingUse::kOffice:
    case BuildingUse::kLibrary:
      return Finish::kDoorOak;
    default:
      return Finish::kDoorGrey;
  }
}

void BuildFrame(InteriorPen& pen, const Place& place, const PlanOpening& o, float depth, Finish finish) {
  pen.Use(finish);
  const float w = place.width();
  BoxAt(pen, place, 0, kFrame, -depth, depth, 0, o.head);
  BoxAt(pen, place, w - kFrame, w, -depth, depth, 0, o.head);
  BoxAt(pen, place, kFrame, w - kFrame, -depth, depth, o.head - kFrame, o.head);
}

void BuildHinged(const InteriorPlan& plan, const PlanWall& wall, const Place& place, const PlanOpening& o, InteriorPen& pen) {
  const bool glass =
      wall.kind == WallKind::kGlassPartition || (o.kind == OpeningKind::kDoubleDoor && plan.spec.use != BuildingUse::kApartment);
  const Finish face = wall.kind == WallKind::kGlassPartition ? Finish::kFrameDark : LeafOf(plan, o);
  BuildFrame(pen, place, o, kHalfWall + 0.012f,
             wall.kind == WallKind::kGlassPartition ? Finish::kFrameDark
             : o.outer                              ? Finish::kFrameDark
                                                    : Finish::kSkirting);
  const float w = place.width() - 2 * kFrame, height = o.head - kFrame - 0.015f, swing = o.swings_left ? -1.0f : 1.0f;
  const float angle = o.open * 94 * std::numbers::pi_v<float> / 180;
  if (o.kind == OpeningKind::kDoubleDoor) {
    HangLeaf(pen, place, kFrame, 1, w / 2 - 0.003f, height, angle, swing, face, glass);
    HangLeaf(pen, place, place.width() - kFrame, -1, w / 2 - 0.003f, height, angle, swing, face, glass);
  } else if (o.hinge_at_to) {
    HangLeaf(pen, place, place.width() - kFrame, -1, w, height, angle, swing, face, glass);
  } else {
    HangLeaf(pen, place, kFrame, 1, w, height, angle, swing, face, glass);
  }
}

// Two leaves of glass that slide along the inside of the wall.
void BuildSliding(const PlanWall& wall, const Place& place, const PlanOpening& o, InteriorPen& pen) {
  const float inside = wall.low < 0 ? 1.0f : -1.0f, w = place.width(), half = w / 2;
  pen.Use(Finish::kFrameDark);
  const float a = inside * (kHalfWall + 0.03f), t = 0.02f;
  BoxAt(pen, place, -half * o.open, w + half * o.open, inside * kHalfWall, inside * (kHalfWall + 0.1f), o.head, o.head + 0.14f);
  for (const float side : {0.0f, 1.0f}) {
    const float shift = (side > 0 ? 1.0f : -1.0f) * half * o.open, s0 = side * half + shift, s1 = s0 + half;
    pen.Use(Finish::kFrameDark);
    BoxAt(pen, place, s0, s0 + 0.05f, a - t, a + t, 0.01f, o.head);
    BoxAt(pen, place, s1 - 0.05f, s1, a - t, a + t, 0.01f, o.head);
    BoxAt(pen, place, s0 + 0.05f, s1 - 0.05f, a - t, a + t, 0.01f, 0.1f);
    BoxAt(pen, place, s0 + 0.05f, s1 - 0.05f, a - t, a + t, o.head - 0.06f, o.head);
    pen.Use(Finish::kGlass);
    pen.Pane(place.along_x, place.at + a, place.from + s0 + 0.05f, place.from + s1 - 0.05f, place.z + 0.1f, place.z + o.head - 0.06f);
  }
}

// A sectional door: panels in front of the opening, or rolled in below the roof; a dock leveller and bumpers.
void BuildDock(const PlanWall& wall, const Place& place, const PlanOpening& o, InteriorPen& pen) {
  const float inside = wall.low < 0 ? 1.0f : -1.0f, w = place.width(), a = inside * (kHalfWall + 0.05f), panel = 0.55f;
  pen.Use(Finish::kPaintYellow);
  for (const float s : {-0.14f, w + 0.02f}) BoxAt(pen, place, s, s + 0.12f, a - 0.04f, a + 0.04f, 0, o.head + 0.3f);
  pen.Use(Finish::kRibbedWhite);
  const int panels = static_cast<int>(std::ceil(o.head / panel));
  for (int i = 0; i < panels; ++i) {
    const float z = panel * static_cast<float>(i);
    if (o.open > 0.5f)
      BoxAt(pen, place, 0, w, inside * (0.25f + z), inside * (0.25f + z + panel - 0.015f), o.head + 0.25f, o.head + 0.29f);
    else
      BoxAt(pen, place, 0, w, a - 0.02f, a + 0.02f, z + 0.005f, std::min(z + panel - 0.01f, o.head + 0.1f));
  }
  pen.Use(Finish::kFrameSteel);
  for (const float s : {-0.06f, w + 0.02f})
    BoxAt(pen, place, s, s + 0.04f, inside * 0.2f, inside * (0.25f + o.head), o.head + 0.2f, o.head + 0.24f);
  pen.Use(Finish::kRubber);
  for (const float s : {-0.25f, w + 0.05f}) BoxAt(pen, place, s, s + 0.2f, -inside * 0.24f, -inside * 0.36f, 0.1f, 0.6f);
}

void BuildLift(const PlanWall& wall, const Place& place, const PlanOpening& o, InteriorPen& pen) {
  const float w = place.width();
  BuildFrame(pen, place, o, kHalfWall + 0.02f, Finish::kDoorSteel);
  BoxAt(pen, place, kFrame, w / 2 - 0.002f, -0.02f, 0.02f, 0, o.head - kFrame);
  BoxAt(pen, place, w / 2 + 0.002f, w - kFrame, -0.02f, 0.02f, 0, o.head - kFrame);
  // Call buttons beside it, on both faces: one of them is the lobby's.
  pen.Use(Finish::kChrome);
  if (wall.length() > place.to - wall.from + 0.4f)
    for (const float side : {-1.0f, 1.0f})
      BoxAt(pen, place, w + 0.15f, w + 0.24f, side * kHalfWall, side * (kHalfWall + 0.012f), 1.0f, 1.2f);
}

}  // namespace

void BuildDoor(const InteriorPlan& plan, const PlanWall& wall, const PlanOpening& opening, InteriorPen& pen) {
  const Place place = PlaceOf(plan, wall, opening);
  pen.Start("door " + std::to_string(opening.lock) + (opening.open > 0.5f ? " open" : " closed"), "construction/door");
  switch (opening.kind) {
    case OpeningKind::kSlidingDoor:
      return BuildSliding(wall, place, opening, pen);
    case OpeningKind::kDockDoor:
      return BuildDock(wall, place, opening, pen);
    case OpeningKind::kLiftDoor:
      return BuildLift(wall, place, opening, pen);
    default:
      BuildHinged(plan, wall, place, opening, pen);
  }
}

void BuildWindow(const InteriorPlan& plan, const PlanWall& wall, const PlanOpening& o, InteriorPen& pen) {
  const Place place = PlaceOf(plan, wall, o);
  const bool outer = wall.low < 0 || wall.high < 0, home = plan.spec.use == BuildingUse::kApartment;
  const float out = wall.low < 0 ? -1.0f : 1.0f, middle = outer ? out * 0.1f : 0.0f, t = 0.03f, f = home ? 0.065f : 0.05f,
              w = place.width();
  pen.Start(outer ? "window" : "shop window", "construction/window");
  pen.Use(home ? Finish::kFrameWhite : Finish::kFrameDark);
  BoxAt(pen, place, 0, w, middle - t, middle + t, o.sill, o.sill + f);
  BoxAt(pen, place, 0, w, middle - t, middle + t, o.head - f, o.head);
  const int panes = std::max(1, static_cast<int>(std::lround(w / (o.kind == OpeningKind::kGlazing ? 1.6f : home ? 0.8f : 1.1f))));
  for (int i = 0; i <= panes; ++i) {
    const float s = (w - f) * static_cast<float>(i) / static_cast<float>(panes);
    BoxAt(pen, place, s, s + f, middle - t, middle + t, o.sill + f, o.head - f);
  }
  if (outer && o.sill > 0.5f) {
    pen.Use(Finish::kSill);
    BoxAt(pen, place, -0.03f, w + 0.03f, -out * kHalfWall, -out * (kHalfWall + 0.14f), o.sill - 0.03f, o.sill);
    BoxAt(pen, place, 0, w, middle, -out * kHalfWall, o.sill - 0.03f, o.sill + 0.002f);
    BoxAt(pen, place, -0.04f, w + 0.04f, middle, out * (kOuterWall - kHalfWall + 0.05f), o.sill - 0.03f, o.sill);
  }
  // Bathrooms are not looked into.
  const int room = std::max(wall.low, wall.high);
  const RoomType type = plan.rooms[static_cast<size_t>(room)].type;
  pen.Use(outer && (type == RoomType::kBathroom || type == RoomType::kToilet) ? Finish::kFrosted : Finish::kGlass);
  pen.Pane(place.along_x, place.at + middle, place.from + f / 2, place.to - f / 2, place.z + o.sill + f / 2, place.z + o.head - f / 2);
}

}  // namespace airsim360::internal

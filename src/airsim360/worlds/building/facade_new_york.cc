// Bays and walls of the New York styles: deco piers, brownstones, braces, fire escapes.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/building/doors.h"

namespace airsim360 {
namespace internal {

using S = Surface;

void BuildDecoBay(FacadePen& pen, const Dress& dress, const Bay& b, RngStream& rng) {
  constexpr float kPier = 0.40f, kProud = 0.28f;
  // Half a pier at both ends of the bay, a slender one between the two windows.
  pen.Use(dress.wall);
  pen.Bar(b.x0, b.x0 + kPier, b.z0, b.z1, -kProud, 0, true, false);
  pen.Bar(b.x1 - kPier, b.x1, b.z0, b.z1, -kProud, 0, true, false);
  const float m = b.middle();
  pen.Bar(m - 0.12f, m + 0.12f, b.z0, b.z1, -0.12f, 0, true, false);
  for (const float x : {b.x0 + kPier, m + 0.12f}) {
    const float w0 = x, w1 = x + (m - 0.12f - b.x0 - kPier), o0 = w0 + 0.07f, o1 = w1 - 0.07f;
    const float z0 = b.z0 + 1.05f, z1 = b.z0 + 3.15f;
    pen.Use(dress.wall);
    pen.WallAround(w0, w1, b.z0, b.z1, o0, o1, z0, z1);
    pen.Reveal(o0, o1, z0, z1, 0, 0.24f);
    FacadePen::Sash sash{.t = 0.055f, .nx = 0, .nz = 1, .frame = dress.frame, .glass = dress.glass};
    Furnish(sash, rng);
    pen.Window(o0, o1, z0, z1, 0.24f, sash);
    // Sill and a spandrel panel with a raised middle.
    pen.Use(dress.trim);
    pen.Bar(o0 - 0.05f, o1 + 0.05f, z0 - 0.10f, z0, -0.07f, 0.2f);
    pen.Bar(w0 + 0.08f, w1 - 0.08f, b.z0 + 0.12f, b.z0 + 0.78f, -0.035f, 0);
    pen.Bar((w0 + w1) / 2 - 0.16f, (w0 + w1) / 2 + 0.16f, b.z0 + 0.2f, b.z0 + 0.7f, -0.07f, -0.035f);
  }
  // Courses close to the base and below the top, heads on the piers there.
  if (b.floor == 2 || b.floor == b.floors - 2)
    pen.Bar(b.x0, b.x1, b.z1 - 0.3f, b.z1 - 0.02f, -kProud - 0.12f, -kProud + 0.02f, false, true);
}

void BuildBrownstoneBay(FacadePen& pen, const Dress& dress, const Opening& o, RngStream& rng) {
  FacadePen::Sash sash{.t = 0.06f, .nx = 0, .nz = 1, .frame = dress.frame, .glass = dress.glass};
  Furnish(sash, rng);
  pen.Window(o.x0, o.x1, o.z0, o.z1, o.depth, sash);
  pen.Use(dress.trim);
  pen.Bar(o.x0 - 0.14f, o.x1 + 0.14f, o.z0 - 0.13f, o.z0, -0.12f, 0.12f);
  pen.Bar(o.x0 - 0.15f, o.x0, o.z0, o.z1, -0.05f, 0, true, false);
  pen.Bar(o.x1, o.x1 + 0.15f, o.z0, o.z1, -0.05f, 0, true, false);
  pen.Bar(o.x0 - 0.22f, o.x1 + 0.22f, o.z1, o.z1 + 0.22f, -0.16f, 0);
  for (float x : {o.x0 - 0.16f, o.x1 + 0.04f}) pen.Bar(x, x + 0.12f, o.z1 - 0.22f, o.z1, -0.12f, 0);
}

namespace {

constexpr float kParlourSill = 1.25f;  // metres above the pavement: the floor behind a stoop

// Double door under a hood on brackets.
void BuildParlourDoor(FacadePen& pen, const Dress& dress, float x0, float x1, float height, RngStream& rng) {
  const float m = (x0 + x1) / 2, sill = kParlourSill;
  pen.WallAround(x0, x1, 0, height, m - 0.62f, m + 0.62f, sill, sill + 2.45f);
  pen.Reveal(m - 0.62f, m + 0.62f, sill, sill + 2.45f, 0, 0.35f);
  static constexpr S kLeaves[] = {S::kDoorBrown, S::kFrameDark, S::kDoorGreen, S::kDoorRed};
  const S leaf = kLeaves[rng.Index(4)];
  for (float x : {m - 0.62f, m}) HangDoor(pen, DoorMake::kPanelled, leaf, leaf, x, x + 0.62f, sill, sill + 2.45f, 0.35f);
  pen.Use(dress.trim);
  for (float x : {m - 0.95f, m + 0.67f}) pen.Bar(x, x + 0.28f, sill, sill + 2.5f, -0.10f, 0, true, false);
  pen.Bar(m - 1.05f, m + 1.05f, sill + 2.5f, sill + 2.85f, -0.45f, 0);
}

void BuildParlourWindow(FacadePen& pen, const Dress& dress, float x0, float x1, float height, RngStream& rng) {
  const float m = (x0 + x1) / 2, sill = kParlourSill;
  FacadePen::Sash sash{.t = 0.06f, .nx = 0, .nz = 1, .frame = dress.frame, .glass = dress.glass};
  Furnish(sash, rng);
  pen.WallAround(x0, x1, 1.15f, height, m - 0.55f, m + 0.55f, sill + 0.35f, sill + 2.6f);
  pen.Reveal(m - 0.55f, m + 0.55f, sill + 0.35f, sill + 2.6f, 0, 0.2f);
  pen.Window(m - 0.55f, m + 0.55f, sill + 0.35f, sill + 2.6f, 0.2f, sash);
  pen.Use(dress.trim);
  pen.Bar(m - 0.75f, m + 0.75f, sill + 0.2f, sill + 0.35f, -0.12f, 0.1f);
  pen.Bar(m - 0.75f, m + 0.75f, sill + 2.6f, sill + 2.82f, -0.15f, 0);
}

// Behind bars.
void BuildCellarWindow(FacadePen& pen, const Dress& dress, float x0, float x1) {
  const float m = (x0 + x1) / 2;
  pen.Use(dress.wall);
  pen.WallAround(x0, x1, 0, 1.15f, m - 0.5f, m + 0.5f, 0.25f, 0.95f);
  pen.Reveal(m - 0.5f, m + 0.5f, 0.25f, 0.95f, 0, 0.2f);
  pen.Use(S::kGlassDark);
  pen.Front(m - 0.5f, m + 0.5f, 0.25f, 0.95f, 0.2f);
  pen.Use(S::kIronBlack);
  for (int k = 0; k < 6; ++k) {
    const float x = m - 0.45f + 0.17f * static_cast<float>(k);
    pen.Bar(x, x + 0.02f, 0.25f, 0.95f, 0.05f, 0.07f, true, false);
  }
}

// Seven steps between cheek walls with iron handrails.
void BuildStoop(FacadePen& pen, const Dress& dress, float door) {
  const float sill = kParlourSill;
  pen.Use(dress.trim);
  constexpr int kSteps = 7;
  for (int i = 0; i < kSteps; ++i) {
    const float z = sill * static_cast<float>(i + 1) / kSteps, y = -1.9f + 1.9f * static_cast<float>(i) / kSteps;
    pen.Bar(door - 0.75f, door + 0.75f, 0, z, y, i + 1 == kSteps ? 0.35f : y + 0.29f, false, false);
  }
  for (float side : {-1.0f, 1.0f}) {
    const float x = door + side * 0.86f;
    for (int i = 0; i < kSteps; ++i) {
      const float z = sill * static_cast<float>(i + 1) / kSteps + 0.12f, y = -1.9f + 1.9f * static_cast<float>(i) / kSteps;
      pen.Use(dress.trim);
      pen.Bar(x - 0.11f, x + 0.11f, 0, z, y, y + 1.9f / kSteps, true, false);
      pen.Use(S::kIronBlack);
      pen.Bar(x - 0.012f, x + 0.012f, z, z + 0.85f, y + 0.12f, y + 0.145f, true, false);
    }
    pen.Use(S::kIronBlack);
    const float y0 = -1.78f * pen.reach(), y1 = -0.15f * pen.reach();
    pen.mesh().Beam({x, y0, sill / kSteps + 0.97f}, {x, y1, sill + 0.97f}, 0.05f);
  }
}

}  // namespace

void BuildParlourFloor(FacadePen& pen, const Dress& dress, float height, RngStream& rng) {
  const float L = pen.length(), door = StoopMiddle(L);
  const int bays = std::max(2, static_cast<int>(std::lround(L / 2.3f)));
  const float w = L / static_cast<float>(bays);
  for (int i = 0; i < bays; ++i) {
    const float x0 = w * static_cast<float>(i), x1 = x0 + w, m = (x0 + x1) / 2;
    pen.Use(dress.wall);
    if (std::abs(m - door) < w / 2) {
      BuildParlourDoor(pen, dress, x0, x1, height, rng);
    } else {
      BuildParlourWindow(pen, dress, x0, x1, height, rng);
      BuildCellarWindow(pen, dress, x0, x1);
    }
  }
  BuildStoop(pen, dress, door);
}

namespace {

// Down pipes from the gutter to the shops' fascia, with brackets; some walls have a second, or a cable beside it.
void BuildDownPipes(FacadePen& pen, const BuildingPlan& plan, RngStream& rng) {
  const bool old = plan.style == FacadeStyle::kBrickWalkUp || plan.style == FacadeStyle::kBrickLoft ||
                   plan.style == FacadeStyle::kBrownstone || plan.style == FacadeStyle::kStuccoShutters ||
                   plan.style == FacadeStyle::kClassicStone;
  if (!old || plan.base > 0 || pen.length() < 6 || !rng.Chance(0.7)) return;
  static constexpr S kPipes[] = {S::kTrimDark, S::kMetal, S::kFrameGreen, S::kBronze};
  const float from = plan.first_storey() + 0.05f, to = plan.height() - 0.35f;
  const S pipe = kPipes[rng.Index(4)];
  const bool left = rng.Chance(0.5), both = rng.Chance(0.3);
  for (bool at_left : {true, false}) {
    if (!both && at_left != left) continue;
    const float x = at_left ? 0.17f : pen.length() - 0.27f;
    pen.Use(pipe);
    pen.Bar(x, x + 0.10f, from, to, -0.21f, -0.11f);
    for (float z = from + 0.6f; z < to; z += 2.4f) pen.Bar(x - 0.03f, x + 0.13f, z, z + 0.05f, -0.22f, 0);
    pen.Use(S::kFrameDark);
    if (rng.Chance(0.5)) pen.Bar(at_left ? x + 0.22f : x - 0.15f, at_left ? x + 0.24f : x - 0.13f, from, to, -0.025f, 0, true, false);
  }
}

}  // namespace

void BuildWallExtras(FacadeContext& context, FacadePen& pen, const BuildingPlan& plan, RngStream& rng) {
  BuildDownPipes(pen, plan, rng);
  const StyleMetrics& metrics = MetricsOf(plan.style);
  const float L = pen.length();
  if (plan.style == FacadeStyle::kBracedGlass) {
    // Diagonals over panels about as high as wide, posts between.
    pen.Use(S::kPanelDark);
    const int n = std::max(1, static_cast<int>(std::lround(L / 11)));
    const float w = L / static_cast<float>(n), foot = plan.first_storey(), top = plan.height() + 0.4f;
    const int rows = std::max(1, static_cast<int>(std::lround((top - foot) / w)));
    const float h = (top - foot) / static_cast<float>(rows), y = -0.42f * pen.reach();
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < n; ++i) {
        const float x0 = w * static_cast<float>(i), z0 = foot + h * static_cast<float>(j);
        const bool rising = (i + j) % 2 == 0;
        pen.mesh().Beam({rising ? x0 : x0 + w, y, z0}, {rising ? x0 + w : x0, y, z0 + h}, 0.5f);
        if (j == 0) pen.Bar(x0 - 0.2f, x0 + 0.2f, foot, top, -0.45f, -0.1f, true, true);
      }
    }
    return;
  }
  if (plan.style != FacadeStyle::kBrickWalkUp || !plan.fire_escapes || !context.fire_escape || L < context.escape_wall || !rng.Chance(0.7))
    return;
  // A stack of landings; the lowest hangs over the shops.
  const float x = L * static_cast<float>(rng.Uniform(0.3, 0.7));
  for (int f = 0; f < plan.floors; ++f) {
    AffineTransform X{{}, {std::clamp(x, 2.4f, L - 2.4f), 0, plan.first_storey() + metrics.floor_height * static_cast<float>(f)}};
    X.A.m[2][2] = metrics.floor_height / 3.2f;
    context.builder.AddInstance({(*context.fire_escape)[static_cast<size_t>(f % 2)], context.Place(pen.X_WF() * X), context.building});
  }
}

void HangRedCurtains(FacadeContext& context, FacadePen& pen, FacadeStyle style, const Bay& bay) {
  const Opening o = OpeningOf(style, bay);
  pen.UseEntity(context.builder.AddEntity("red curtains", context.builder.tree().At("furniture/curtain")));
  pen.Use(S::kGlassRedCurtain);
  const float w = (o.x1 - o.x0) * 0.36f, y = o.depth - 0.012f;
  pen.Front(o.x0 + 0.06f, o.x0 + w, o.z0 + 0.06f, o.z1 - 0.06f, y);
  pen.Front(o.x1 - w, o.x1 - 0.06f, o.z0 + 0.06f, o.z1 - 0.06f, y);
  pen.Front(o.x0 + w, o.x1 - w, o.z1 - 0.5f, o.z1 - 0.06f, y);
  pen.UseEntity(context.building);
}

}  // namespace internal

float StoopMiddle(float wall_length) {
  const int bays = std::max(2, static_cast<int>(std::lround(wall_length / 2.3f)));
  return wall_length / static_cast<float>(bays) * 0.5f;
}

MeshId AddFireEscapeMesh(SceneBuilder& builder, const Surfaces& surfaces, bool mirrored) {
  // Wall at y = 0, storey from z = 0 to 3.2 m, x in [-2.2, 2.2].
  MeshBuilder mesh;
  FacadePen pen(mesh, surfaces);
  AffineTransform mirror;
  if (mirrored) mirror.A.m[0][0] = -1;
  mesh.SetTransform(mirror);
  pen.Use(Surface::kIronBlack);
  constexpr float kFloor = 0.45f, kOut = -1.05f;
  // Grating: bars along the wall, a frame around them; a gap where the flight arrives.
  for (int i = 0; i < 9; ++i) {
    const float y = kOut + 0.115f * static_cast<float>(i);
    pen.Bar(-2.2f, 2.2f, kFloor - 0.03f, kFloor, y, y + 0.06f, true, true);
  }
  for (float x : {-2.2f, -0.75f, 0.75f, 2.14f}) {
    pen.Bar(x, x + 0.06f, kFloor - 0.08f, kFloor - 0.03f, kOut, 0);
    mesh.Beam({x + 0.03f, kOut + 0.1f, kFloor - 0.05f}, {x + 0.03f, -0.02f, kFloor - 0.85f}, 0.04f);
  }
  // Railing on three sides.
  for (float z : {0.5f, 0.95f}) {
    pen.Bar(-2.2f, 2.2f, kFloor + z - 0.03f, kFloor + z, kOut, kOut + 0.03f);
    for (float x : {-2.2f, 2.17f}) pen.Bar(x, x + 0.03f, kFloor + z - 0.03f, kFloor + z, kOut, 0);
  }
  for (int i = 0; i <= 22; ++i) {
    const float x = -2.2f + 0.2f * static_cast<float>(i) - 0.01f;
    pen.Bar(x, x + 0.02f, kFloor, kFloor + 0.93f, kOut + 0.005f, kOut + 0.025f, true, false);
  }
  // The flight: two stringers and treads.
  for (float y : {-0.98f, -0.48f}) mesh.Beam({-1.5f, y, kFloor}, {1.3f, y, kFloor + 3.2f}, 0.06f);
  for (int i = 1; i < 13; ++i) {
    const float t = static_cast<float>(i) / 13, x = -1.5f + 2.8f * t, z = kFloor + 3.2f * t;
    pen.Bar(x - 0.1f, x + 0.1f, z - 0.02f, z, -0.98f, -0.48f);
  }
  mesh.Beam({-1.5f, -1.0f, kFloor + 0.85f}, {1.3f, -1.0f, kFloor + 4.05f}, 0.03f);
  return builder.AddMesh(mesh.Finish("fire escape"));
}

}  // namespace airsim360

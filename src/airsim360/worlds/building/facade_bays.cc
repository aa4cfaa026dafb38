#include "airsim360/worlds/building/facade_bays.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace airsim360::internal {
namespace {

using S = Surface;

// Palettes by style; the palette index picks the row.
struct Palette {
  FacadeStyle style;
  Surface wall, trim, frame, shutter;
};
constexpr Palette kPalettes[] = {
    {FacadeStyle::kBrickWalkUp, S::kBrickRed, S::kTrimStone, S::kFrameWhite, S::kShutterGreen},
    {FacadeStyle::kBrickWalkUp, S::kBrickBrown, S::kTrimStone, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kBrickWalkUp, S::kBrickYellow, S::kTrimWhite, S::kFrameGreen, S::kShutterGreen},
    {FacadeStyle::kBrickWalkUp, S::kBrickWhite, S::kTrimWhite, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kClassicStone, S::kLimestone, S::kTrimStone, S::kFrameWhite, S::kShutterGreen},
    {FacadeStyle::kClassicStone, S::kSandstone, S::kTrimStone, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kClassicStone, S::kStuccoWhite, S::kTrimStone, S::kFrameWood, S::kShutterGreen},
    {FacadeStyle::kStuccoShutters, S::kStuccoOchre, S::kTrimWhite, S::kFrameWhite, S::kShutterGreen},
    {FacadeStyle::kStuccoShutters, S::kStuccoRose, S::kTrimWhite, S::kFrameWhite, S::kShutterGreen},
    {FacadeStyle::kStuccoShutters, S::kStuccoWhite, S::kTrimStone, S::kFrameWood, S::kShutterBlue},
    {FacadeStyle::kStuccoShutters, S::kStuccoBlue, S::kTrimWhite, S::kFrameWhite, S::kShutterBlue},
    {FacadeStyle::kConcreteGrid, S::kConcrete, S::kConcrete, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kConcreteGrid, S::kConcreteWarm, S::kConcreteWarm, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kConcreteGrid, S::kPanelWhite, S::kPanelWhite, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kCurtainWall, S::kPanelDark, S::kTrimDark, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kCurtainWall, S::kConcrete, S::kMetal, S::kMetal, S::kShutterGreen},
    {FacadeStyle::kBrickLoft, S::kBrickRed, S::kTrimStone, S::kFrameGreen, S::kShutterGreen},
    {FacadeStyle::kBrickLoft, S::kBrickYellow, S::kTrimStone, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kBrickLoft, S::kBrickBrown, S::kTrimDark, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kRibbon, S::kPanelWhite, S::kMetal, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kRibbon, S::kConcreteWarm, S::kTrimDark, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kDeco, S::kLimestone, S::kTrimStone, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kDeco, S::kSandstone, S::kTrimStone, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kDeco, S::kBrickBrown, S::kBronze, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kDeco, S::kBrickYellow, S::kTrimStone, S::kFrameGreen, S::kShutterGreen},
    {FacadeStyle::kBrownstone, S::kBrownstone, S::kBrownstoneTrim, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kBrownstone, S::kBrickRed, S::kBrownstoneTrim, S::kFrameWhite, S::kShutterGreen},
    {FacadeStyle::kBrownstone, S::kBrickBrown, S::kTrimStone, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kBracedGlass, S::kPanelDark, S::kTrimDark, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kTerracotta, S::kBrickYellow, S::kStuccoOchre, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kTerracotta, S::kBrickRed, S::kStuccoOchre, S::kFrameGreen, S::kShutterGreen},
    {FacadeStyle::kTerracotta, S::kBrickBrown, S::kStuccoOchre, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kGlazedDeco, S::kStuccoBlue, S::kShutterBlue, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kGlazedDeco, S::kStuccoRose, S::kBronze, S::kFrameDark, S::kShutterGreen},
    {FacadeStyle::kGlazedDeco, S::kBrickYellow, S::kStuccoOchre, S::kFrameGreen, S::kShutterGreen},
};

// Shutters and frames of rendered houses, which their owners paint as they like: dark greens, browns and greys above all.
constexpr S kOwnShutters[] = {S::kShutterGreen, S::kDoorBrown, S::kDoorGrey,   S::kFrameGreen, S::kFrameWood,    S::kShutterBlue,
                              S::kTrimDark,     S::kDoorBrown, S::kFrameWhite, S::kFrameWood,  S::kConcreteWarm, S::kDoorGrey};
constexpr S kOwnFrames[] = {S::kFrameWhite, S::kFrameWood, S::kFrameWhite, S::kDoorBrown, S::kFrameWhite, S::kFrameGreen, S::kFrameDark};

}  // namespace

bool IsBrick(Surface s) { return s >= S::kBrickRed && s <= S::kBrickWhite; }

void Furnish(FacadePen::Sash& sash, RngStream& rng) {
  const double pick = rng.Uniform();
  if (pick < 0.38) {
    sash.blind = static_cast<float>(rng.Uniform(0.12, 0.8));
    sash.cover = S::kGlassBlind;
  } else if (pick < 0.52) {
    sash.blind = 1;
    sash.cover = S::kGlassCurtain;
  } else if (pick < 0.58) {
    sash.blind = 1;
    sash.cover = S::kGlassLit;
  }
  // Sashes that slide stand open here and there.
  if (sash.nz == 1 && rng.Chance(0.13)) sash.open = static_cast<float>(rng.Uniform(0.06, 0.45));
}

Opening OpeningOf(FacadeStyle style, const Bay& b) {
  const float m = b.middle();
  switch (style) {
    case FacadeStyle::kBrickWalkUp:
      return {m - 0.58f, m + 0.58f, b.z0 + 0.80f, b.z0 + 2.60f, 0.18f};
    case FacadeStyle::kClassicStone:
      return {m - 0.68f, m + 0.68f, b.z0 + 0.60f, b.z0 + 2.85f, 0.25f};
    case FacadeStyle::kStuccoShutters:
      return {m - 0.60f, m + 0.60f, b.z0 + 0.20f, b.z0 + 2.55f, 0.20f};
    case FacadeStyle::kConcreteGrid:
      return {b.x0 + 0.22f, b.x1 - 0.22f, b.z0 + 0.45f, b.z1 - 0.28f, 0.40f};
    case FacadeStyle::kCurtainWall:
      return {b.x0 + 0.03f, b.x1 - 0.03f, b.z0 + 1.0f, b.z1 - 0.05f, 0.10f};
    case FacadeStyle::kBrickLoft:
      return {b.x0 + 0.60f, b.x1 - 0.60f, b.z0 + 0.90f, b.z1 - 0.50f, 0.22f};
    case FacadeStyle::kDeco:
      return {b.x0 + 0.45f, b.x1 - 0.45f, b.z0 + 1.05f, b.z0 + 3.1f, 0.20f};
    case FacadeStyle::kBrownstone:
      return {m - 0.52f, m + 0.52f, b.z0 + 0.65f, b.z0 + 2.65f, 0.18f};
    case FacadeStyle::kBracedGlass:
      return {b.x0 + 0.03f, b.x1 - 0.03f, b.z0 + 0.9f, b.z1 - 0.05f, 0.10f};
    case FacadeStyle::kTerracotta:
      return {b.x0 + 0.66f, b.x1 - 0.66f, b.z0 + 0.85f, b.z0 + 2.80f, 0.26f};
    case FacadeStyle::kGlazedDeco:
      return {b.x0 + 0.46f, b.x1 - 0.46f, b.z0 + 1.00f, b.z0 + 3.00f, 0.26f};
    default:
      return {b.x0, b.x1, b.z0 + 1.10f, b.z1 - 0.45f, 0.20f};
  }
}

void HangCooler(FacadeContext& context, FacadePen& pen, const Opening& o, double share, RngStream& rng) {
  if (!rng.Chance(share)) return;
  const float slack = (o.x1 - o.x0) / 2 - 0.42f, x = (o.x0 + o.x1) / 2 + (slack > 0 ? slack * static_cast<float>(rng.Uniform(-1, 1)) : 0);
  context.builder.AddInstance(
      {context.window_box, context.Place(pen.X_WF() * AffineTransform{{}, {x, 0.42f * (1 - context.reach), o.z0}}), context.building});
}

namespace {

void Wall(FacadePen& pen, const Dress& dress, const Bay& b, const Opening& o) {
  pen.Use(dress.wall);
  pen.WallAround(b.x0, b.x1, b.z0, b.z1, o.x0, o.x1, o.z0, o.z1);
  pen.Reveal(o.x0, o.x1, o.z0, o.z1, 0, o.depth);
}

void BrickBay(FacadeContext& context, FacadePen& pen, const Dress& dress, const Bay& b, const Opening& o, RngStream& rng) {
  FacadePen::Sash sash{.t = 0.07f, .nx = 0, .nz = 1, .frame = dress.frame, .glass = dress.glass};
  Furnish(sash, rng);
  pen.Window(o.x0, o.x1, o.z0, o.z1, o.depth, sash);
  pen.Use(dress.trim);
  pen.Bar(o.x0 - 0.10f, o.x1 + 0.10f, o.z0 - 0.11f, o.z0, -0.08f, 0.12f);
  pen.Bar(o.x0 - 0.16f, o.x1 + 0.16f, o.z1, o.z1 + 0.24f, -0.03f, 0);
  pen.Bar(b.middle() - 0.10f, b.middle() + 0.10f, o.z1 - 0.02f, o.z1 + 0.30f, -0.07f, 0);
  HangCooler(context, pen, o, 0.14, rng);
}

void ClassicBay(FacadeContext& context, FacadePen& pen, const Dress& dress, const Bay& b, const Opening& o, RngStream& rng) {
  FacadePen::Sash sash{.t = 0.07f, .nx = 1, .nz = 1, .frame = dress.frame, .glass = dress.glass};
  Furnish(sash, rng);
  pen.Window(o.x0, o.x1, o.z0, o.z1, o.depth, sash);
  pen.Use(dress.trim);
  // Architrave, sill on consoles, hood.
  pen.Bar(o.x0 - 0.17f, o.x0, o.z0, o.z1, -0.06f, 0, true, false);
  pen.Bar(o.x1, o.x1 + 0.17f, o.z0, o.z1, -0.06f, 0, true, false);
  pen.Bar(o.x0 - 0.17f, o.x1 + 0.17f, o.z1, o.z1 + 0.18f, -0.06f, 0);
  pen.Bar(o.x0 - 0.25f, o.x1 + 0.25f, o.z0 - 0.14f, o.z0, -0.14f, 0.15f);
  pen.Bar(o.x0 - 0.28f, o.x1 + 0.28f, o.z1 + 0.24f, o.z1 + 0.36f, -0.22f, 0);
  for (float x : {o.x0 - 0.14f, o.x1 + 0.02f}) pen.Bar(x, x + 0.12f, o.z0 - 0.40f, o.z0 - 0.14f, -0.10f, 0);
  if (b.floor == 0) {
    // Pediment over the first-floor windows.
    const float z = o.z1 + 0.36f, x0 = o.x0 - 0.28f, x1 = o.x1 + 0.28f, m = b.middle();
    const float y = -0.20f * pen.reach(), eave = -0.23f * pen.reach();
    MeshBuilder& mesh = pen.mesh();
    mesh.Triangle({x0, y, z}, {x1, y, z}, {m, y, z + 0.38f}, {x0, -z}, {x1, -z}, {m, -z - 0.38f});
    mesh.Quad({x0, eave, z}, {m, eave, z + 0.42f}, {m, 0, z + 0.42f}, {x0, 0, z});
    mesh.Quad({m, eave, z + 0.42f}, {x1, eave, z}, {x1, 0, z}, {m, 0, z + 0.42f});
  }
  // Pilasters between the bays, a course under every third storey.
  pen.Use(dress.wall);
  pen.Bar(b.x0 - 0.16f, b.x0 + 0.16f, b.z0, b.z1, -0.10f, 0, true, false);
  pen.Use(dress.trim);
  if (b.floor > 0 && b.floor % 3 == 1) pen.Bar(b.x0 - 0.01f, b.x1 + 0.01f, b.z0 - 0.06f, b.z0 + 0.16f, -0.18f, 0);
  HangCooler(context, pen, o, 0.05, rng);
}

void StuccoBay(FacadeContext& context, FacadePen& pen, const Dress& dress, const Bay& b, const Opening& o, RngStream& rng) {
  FacadePen::Sash sash{.t = 0.07f, .nx = 1, .nz = 2, .frame = dress.frame, .glass = dress.glass};
  Furnish(sash, rng);
  pen.Window(o.x0, o.x1, o.z0, o.z1, o.depth, sash);
  pen.Use(dress.trim);
  pen.Bar(o.x0 - 0.12f, o.x1 + 0.12f, o.z1, o.z1 + 0.16f, -0.05f, 0);
  pen.Bar(o.x0 - 0.12f, o.x1 + 0.12f, o.z0 - 0.10f, o.z0, -0.09f, 0.1f);
  // Shutters with a few slats, most of them open; some leaves are closed.
  const Vec3f at = pen.X_WF() * Vec3f{b.x0, 0, b.z0};
  RngStream own(MixBits(static_cast<uint64_t>(std::llround(100 * at.x))) ^ static_cast<uint64_t>(std::llround(100 * at.y)), "leaves",
                static_cast<uint64_t>(b.floor));
  const double pick = own.Uniform();
  const bool left = pick<0.22, right = pick> 0.1 && pick < 0.3;
  pen.Use(dress.shutter);
  for (float x : {left ? o.x0 : o.x0 - 0.68f, right ? o.x1 - 0.61f : o.x1 + 0.06f}) {
    pen.Bar(x, x + 0.62f, o.z0, o.z1, -0.05f, -0.01f);
    for (int i = 1; i < 9; ++i) {
      const float z = o.z0 + (o.z1 - o.z0) * static_cast<float>(i) / 9;
      pen.Bar(x + 0.06f, x + 0.56f, z - 0.05f, z + 0.03f, -0.065f, -0.05f, false, true);
    }
  }
  if (!rng.Chance(b.floor == 0 ? 0.8 : 0.45)) return;
  AffineTransform X{{}, {b.middle(), 0, o.z0 - 0.02f}};
  X.A.m[0][0] = 1.75f;
  const EntityId entity = context.builder.AddEntity("balcony", context.builder.tree().At("construction/balcony"));
  context.builder.AddInstance({context.balcony, context.Place(pen.X_WF() * X), entity});
}

void GridBay(FacadePen& pen, const Dress& dress, const Bay& b, const Opening& o, RngStream& rng) {
  FacadePen::Sash sash{.t = 0.07f, .nx = 1, .nz = 0, .frame = dress.frame, .glass = dress.glass};
  Furnish(sash, rng);
  pen.Window(o.x0, o.x1, o.z0, o.z1, o.depth, sash);
  pen.Use(dress.trim);
  pen.Bar(b.x0 - 0.16f, b.x0 + 0.16f, b.z0, b.z1, -0.25f, 0, true, false);
  pen.Bar(b.x0, b.x1, b.z1 - 0.24f, b.z1, -0.12f, 0, false, true);
}

void CurtainBay(FacadePen& pen, const Dress& dress, const Bay& b, const Opening& o, RngStream& rng) {
  pen.Use(dress.wall);
  pen.Front(b.x0, b.x1, b.z0, o.z0, 0.02f);
  const bool blind = rng.Chance(0.14);
  const float edge = blind ? o.z1 - static_cast<float>(rng.Uniform(0.3, 1.8)) : b.z1;
  pen.Use(dress.glass);
  pen.Front(b.x0, b.x1, o.z0, edge, 0.03f);
  if (blind) {
    pen.Use(S::kGlassBlind);
    pen.Front(b.x0, b.x1, edge, b.z1, 0.03f);
  }
  pen.Use(dress.frame);
  pen.Bar(b.x0 - 0.03f, b.x0 + 0.03f, b.z0, b.z1, -0.14f, 0.03f, true, false);
  for (float z : {b.z0 - 0.03f, o.z0 - 0.03f}) pen.Bar(b.x0, b.x1, z, z + 0.06f, -0.07f, 0.03f, false, true);
}

void LoftBay(FacadePen& pen, const Dress& dress, const Bay& b, const Opening& o, RngStream& rng) {
  FacadePen::Sash sash{.t = 0.06f, .nx = 3, .nz = 2, .frame = dress.frame, .glass = dress.glass};
  Furnish(sash, rng);
  pen.Window(o.x0, o.x1, o.z0, o.z1, o.depth, sash);
  pen.Use(dress.wall);
  pen.Bar(b.x0 - 0.38f, b.x0 + 0.38f, b.z0, b.z1, -0.14f, 0, true, false);
  pen.Use(dress.trim);
  pen.Bar(o.x0 - 0.06f, o.x1 + 0.06f, o.z0 - 0.14f, o.z0, -0.08f, 0.15f);
  pen.Bar(o.x0 - 0.06f, o.x1 + 0.06f, o.z1, o.z1 + 0.2f, -0.04f, 0);
  pen.Bar(o.x0 + 0.3f, o.x1 - 0.3f, b.z0 + 0.2f, o.z0 - 0.28f, -0.03f, 0);
}

void RibbonBay(FacadePen& pen, const Dress& dress, const Bay& b, const Opening& o, RngStream& rng) {
  FacadePen::Sash sash{.t = 0.05f, .nx = 1, .nz = 0, .frame = dress.frame, .glass = dress.glass};
  Furnish(sash, rng);
  pen.Window(o.x0, o.x1, o.z0, o.z1, o.depth, sash);
  pen.Use(dress.wall);
  pen.Bar(b.x0 + 0.012f, b.x1 - 0.012f, b.z0 - 0.42f, o.z0 - 0.02f, -0.10f, 0);
  pen.Use(dress.trim);
  pen.Bar(b.x0, b.x1, o.z0 - 0.02f, o.z0 + 0.04f, -0.16f, 0.1f, false, true);
}

}  // namespace

Dress DressOf(const BuildingPlan& plan) {
  int index = plan.palette;
  const Palette* row = kPalettes;
  for (const Palette& palette : kPalettes) {
    if (palette.style == plan.style && index-- == 0) row = &palette;
  }
  const bool modern = plan.style == FacadeStyle::kCurtainWall || plan.style == FacadeStyle::kRibbon ||
                      plan.style == FacadeStyle::kConcreteGrid || plan.style == FacadeStyle::kBracedGlass;
  Dress dress{row->wall, row->trim, row->frame, row->shutter, S::kGlassDark, S::kBrickBrown, S::kFarWalls1, 0};
  if (plan.style == FacadeStyle::kCurtainWall || (modern && plan.seed % 2 == 0)) dress.glass = S::kGlassBlue;
  dress.party = modern ? S::kConcrete : IsBrick(row->wall) ? row->wall : plan.seed % 3 == 0 ? S::kBrickBrown : row->wall;
  dress.far = modern ? S::kFarWalls2 : IsBrick(row->wall) ? S::kFarWalls0 : S::kFarWalls1;
  if (plan.style == FacadeStyle::kClassicStone) dress.cornice = 1.35f;
  if (plan.style == FacadeStyle::kBrickWalkUp || plan.style == FacadeStyle::kBrickLoft || plan.style == FacadeStyle::kBrownstone)
    dress.cornice = 0.9f;
  if (plan.style == FacadeStyle::kDeco) dress.cornice = plan.palette < 2 ? 1.2f : 0.7f;
  if (plan.style == FacadeStyle::kBracedGlass) dress.glass = S::kGlassBlack;
  if (plan.style == FacadeStyle::kStuccoShutters) {
    dress.cornice = 0.75f;
    RngStream own(plan.seed, "shutters");
    dress.shutter = kOwnShutters[own.Index(std::size(kOwnShutters))];
    dress.frame = kOwnFrames[own.Index(std::size(kOwnFrames))];
  }
  if (plan.style == FacadeStyle::kTerracotta) {
    dress.cornice = 1.3f;
    dress.crown = row->shutter;
    dress.base = plan.base > 0 ? row->wall : plan.palette == 1 ? S::kSandstone : S::kLimestone;
  }
  if (plan.style == FacadeStyle::kGlazedDeco) {
    // Glaze is for the street.
    dress.party = plan.palette == 1 ? S::kBrickBrown : S::kBrickYellow;
    dress.far = plan.palette == 1 ? S::kFarPiers1 : S::kFarPiers0;
  }
  return dress;
}

void SimpleOpening(FacadePen& pen, const Dress& dress, float x0, float x1, float z0, float z1, float ox0, float ox1, float oz0, float oz1,
                   float depth, RngStream& rng) {
  pen.Use(dress.wall);
  pen.WallAround(x0, x1, z0, z1, ox0, ox1, oz0, oz1);
  pen.Reveal(ox0, ox1, oz0, oz1, 0, depth);
  const double pick = rng.Uniform();
  const float split = pick < 0.35 ? oz1 - (oz1 - oz0) * static_cast<float>(rng.Uniform(0.2, 0.8)) : oz1;
  pen.Use(dress.glass);
  pen.Front(ox0, ox1, oz0, split, depth);
  pen.Use(S::kGlassBlind);
  if (split < oz1) pen.Front(ox0, ox1, split, oz1, depth);
  // A cross of frame, proud of the pane.
  pen.Use(dress.frame);
  const float m = (ox0 + ox1) / 2, n = (oz0 + oz1) / 2;
  pen.Front(m - 0.04f, m + 0.04f, oz0, oz1, depth - 0.04f);
  pen.Front(ox0, ox1, n - 0.04f, n + 0.04f, depth - 0.035f);
}

void BuildSimpleBay(FacadePen& pen, FacadeStyle style, const Dress& dress, const Bay& bay, RngStream& rng) {
  const Opening o = OpeningOf(style, bay);
  SimpleOpening(pen, dress, bay.x0, bay.x1, bay.z0, bay.z1, o.x0, o.x1, o.z0, o.z1, o.depth, rng);
}

void BuildBay(FacadeContext& context, FacadePen& pen, FacadeStyle style, const Dress& dress, const Bay& bay, RngStream& rng) {
  const Opening o = OpeningOf(style, bay);
  if (style == FacadeStyle::kCurtainWall || style == FacadeStyle::kBracedGlass) return CurtainBay(pen, dress, bay, o, rng);
  if (style == FacadeStyle::kDeco) return BuildDecoBay(pen, dress, bay, rng);
  if (style == FacadeStyle::kTerracotta) return BuildTerracottaBay(pen, dress, bay, o, rng);
  if (style == FacadeStyle::kGlazedDeco) return BuildGlazedDecoBay(pen, dress, bay, o, rng);
  Wall(pen, dress, bay, o);
  switch (style) {
    case FacadeStyle::kBrickWalkUp:
      return BrickBay(context, pen, dress, bay, o, rng);
    case FacadeStyle::kClassicStone:
      return ClassicBay(context, pen, dress, bay, o, rng);
    case FacadeStyle::kStuccoShutters:
      return StuccoBay(context, pen, dress, bay, o, rng);
    case FacadeStyle::kConcreteGrid:
      return GridBay(pen, dress, bay, o, rng);
    case FacadeStyle::kBrickLoft:
      return LoftBay(pen, dress, bay, o, rng);
    case FacadeStyle::kBrownstone:
      return BuildBrownstoneBay(pen, dress, o, rng);
    default:
      return RibbonBay(pen, dress, bay, o, rng);
  }
}

}  // namespace airsim360::internal

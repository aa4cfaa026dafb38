#include "airsim360/worlds/building/facade.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/building/doors.h"
#include "airsim360/worlds/building/facade_bays.h"
#include "airsim360/worlds/building/shopfront.h"
#include "airsim360/worlds/building/wall_wear.h"

namespace airsim360 {
namespace {

using internal::Bay;
using internal::Dress;
using internal::DressOf;
using internal::Kept;

// Frames, sills, hoods and open shutters reach beyond an opening.
constexpr float kFrameX = 0.22f, kFrameZ = 0.3f;
Kept Around(float x0, float x1, float z0, float z1) { return {x0 - kFrameX, x1 + kFrameX, z0 - kFrameZ, z1 + kFrameZ}; }

// Bays of equal width along a wall: at least one.
int CountBays(float length, float bay) { return std::max(1, static_cast<int>(std::lround(length / bay))); }

// A window of the ground floor in its frame over a sill, where there is room for one.
void BuildRearWindow(FacadePen& pen, const Dress& dress, const Bay& bay, float ground, float damp, RngStream& rng, RngStream& wear) {
  constexpr float kBelowSill = 0.97f;
  internal::DampFoot(pen, dress, bay.x0, bay.x1, ground, std::min(ground + damp, kBelowSill), wear);
  if (bay.x1 - bay.x0 < 1 || bay.z1 < 2.8f) {
    pen.Use(dress.wall);
    pen.Front(bay.x0, bay.x1, bay.z0, bay.z1, 0);
    return;
  }
  const float half = std::min(0.75f, (bay.x1 - bay.x0) / 2 - 0.2f), a = bay.middle() - half, b = bay.middle() + half, z0 = 1.1f,
              z1 = bay.z1 - 1.1f;
  pen.Use(dress.wall);
  pen.WallAround(bay.x0, bay.x1, bay.z0, bay.z1, a, b, z0, z1);
  pen.Reveal(a, b, z0, z1, 0, 0.15f);
  FacadePen::Sash sash{.t = 0.055f, .nx = 1, .nz = 1, .frame = dress.frame, .glass = dress.glass};
  internal::Furnish(sash, rng);
  pen.Window(a, b, z0, z1, 0.15f, sash);
  pen.Use(dress.trim);
  pen.Bar(a - 0.08f, b + 0.08f, z0 - 0.09f, z0, -0.07f, 0.12f);
}

void BuildGroundFloor(FacadeContext& context, FacadePen& pen, const BuildingPlan& plan, const Dress& dress, EntityId entity, EdgeKind kind,
                      RngStream& rng, RngStream& wear) {
  const float height = MetricsOf(plan.style).ground_height, length = pen.length();
  pen.UseEntity(entity);
  if (kind == EdgeKind::kStreet && plan.style == FacadeStyle::kBrownstone) {
    internal::BuildParlourFloor(pen, dress, height, rng);
    return;
  }
  if (kind == EdgeKind::kStreet && plan.shops && length > 2.6f) {
    const internal::GroundFloor floor{plan, entity, height, dress.base, dress.trim, dress.frame};
    const bool office = plan.style == FacadeStyle::kCurtainWall || plan.style == FacadeStyle::kRibbon ||
                        plan.style == FacadeStyle::kConcreteGrid || plan.style == FacadeStyle::kClassicStone ||
                        plan.style == FacadeStyle::kDeco || plan.style == FacadeStyle::kBracedGlass ||
                        plan.style == FacadeStyle::kTerracotta || plan.style == FacadeStyle::kGlazedDeco;
    const int shops = CountBays(length, 4.9f), lobby = office && plan.canopies && length > 9 && rng.Chance(0.6) ? shops / 2 : -1;
    for (int i = 0; i < shops; ++i) {
      const float w = length / static_cast<float>(shops), x0 = w * static_cast<float>(i);
      if (i == lobby) {
        internal::BuildLobby(pen, floor, x0, x0 + w);
      } else {
        internal::BuildShop(context, pen, floor, x0, x0 + w, rng);
      }
    }
    return;
  }
  // Rear: windows, and a door here and there. Most walls are damp at the foot, each to its own height below the sills.
  const float damp = wear.Chance(0.8) ? static_cast<float>(wear.Uniform(0.3, 0.95)) : 0.0f;
  const int bays = CountBays(length, 3.4f);
  for (int i = 0; i < bays; ++i) {
    const float w = length / static_cast<float>(bays), x0 = w * static_cast<float>(i), middle = x0 + w / 2;
    const Bay bay{x0, x0 + w, 0, height, 0, plan.floors};
    const Vec3f at = pen.X_WF() * Vec3f{middle, 0, 0};
    const float fall = context.fall ? context.fall({at.x, at.y}) : 0;
    if ((i == bays / 2 || (i % 3 == 1 && rng.Chance(0.5))) && internal::TakesDoor(pen, bay, fall)) {
      internal::BuildBackDoor(pen, plan, dress, bay, fall, rng);
    } else {
      BuildRearWindow(pen, dress, bay, std::max(0.0f, -fall), damp, rng, wear);
    }
  }
  pen.Use(dress.trim);
  pen.Bar(0, length, height - 0.08f, height + 0.1f, -0.06f, 0, false, true);
  // A downpipe at the end of the wall.
  pen.Use(Surface::kMetal);
  pen.mesh().Tube({0.25f, -0.09f, 0}, {0.25f, -0.09f, plan.height() + 0.2f}, 0.055f, 0.055f, 7, false, true);
}

// Bands that run along the whole wall: string course, cornice with brackets, parapet.
void BuildBands(FacadePen& pen, const BuildingPlan& plan, const Dress& dress, EdgeKind kind) {
  const float ground = MetricsOf(plan.style).ground_height, top = plan.height(), L = pen.length();
  // Ends meet the fronts of the next wall's bands.
  const float parapet = ParapetHeight(plan), out = pen.reach();
  pen.Use(dress.wall);
  if (parapet > 0) pen.Front(0, L, top, top + parapet, 0);
  if (kind != EdgeKind::kStreet) return;
  pen.Use(dress.trim);
  if (plan.base == 0) pen.Bar(-0.14f * out, L + 0.14f * out, ground - 0.10f, ground + 0.14f, -0.14f, 0);
  const float s = dress.cornice * plan.cornice;
  if (s <= 0) return;
  pen.Use(dress.crown);
  pen.Bar(-0.16f * s * out, L + 0.16f * s * out, top - 0.62f * s, top - 0.34f * s, -0.16f * s, 0);
  pen.Bar(-0.40f * s * out, L + 0.40f * s * out, top - 0.34f * s, top - 0.12f * s, -0.40f * s, 0);
  pen.Bar(-0.58f * s * out, L + 0.58f * s * out, top - 0.12f * s, top + 0.05f * s, -0.58f * s, 0);
  const int brackets = static_cast<int>(L / 0.75f);
  for (int i = 0; i < brackets; ++i) {
    const float x = L * (static_cast<float>(i) + 0.5f) / static_cast<float>(brackets);
    pen.Bar(x - 0.09f, x + 0.09f, top - 0.75f * s, top - 0.34f * s, -0.33f * s, -0.02f);
  }
}

void BuildStoreys(FacadeContext& context, FacadePen& pen, const BuildingPlan& plan, const Dress& dress, EdgeKind kind, FacadeDetail detail,
                  RngStream& rng, RngStream& wear, std::vector<Kept>& kept) {
  const StyleMetrics& metrics = MetricsOf(plan.style);
  const int bays = CountBays(pen.length(), metrics.bay);
  const float w = pen.length() / static_cast<float>(bays);
  for (int f = 0; f < plan.floors; ++f) {
    const float z0 = plan.first_storey() + metrics.floor_height * static_cast<float>(f);
    for (int i = 0; i < bays; ++i) {
      const float x0 = w * static_cast<float>(i);
      const Bay bay{x0, x0 + w, z0, z0 + metrics.floor_height, f, plan.floors};
      if (f == plan.curtain_floor) internal::HangRedCurtains(context, pen, plan.style, bay);
      const internal::Opening o = internal::OpeningOf(plan.style, bay);
      kept.push_back(Around(o.x0, o.x1, o.z0, o.z1));
      if (detail == FacadeDetail::kSimple || kind != EdgeKind::kStreet) {
        internal::BuildSimpleBay(pen, plan.style, dress, bay, rng);
        // Windows of homes towards yards.
        if (kind == EdgeKind::kRear && (plan.style == FacadeStyle::kBrickWalkUp || plan.style == FacadeStyle::kStuccoShutters))
          internal::HangCooler(context, pen, o, 0.1, wear);
      } else {
        internal::BuildBay(context, pen, plan.style, dress, bay, rng);
      }
    }
  }
}

// What years leave on a bare wall: flashing over the neighbour's roof, pipes, repairs in render and other bricks, a chimney.
void WearPartyWall(FacadePen& pen, const std::vector<float>& closed, float w, float from, float top, RngStream& rng) {
  using S = Surface;
  const float L = pen.length();
  const auto uniform = [&](float a, float b) { return static_cast<float>(rng.Uniform(a, b)); };
  if (top - from < 2.5f || L < 4) return;
  pen.Use(S::kTar);
  pen.Front(0, L, from, std::min(top, from + uniform(0.2f, 0.45f)), -0.012f);
  for (float m : closed) {
    if (m < 0 || w < 1.5f) continue;
    const float half = w / 2 - 0.35f;
    // Repairs lie a centimetre proud, each at its own height.
    float z = from + uniform(0.6f, 3.0f);
    while (z < top - 2.2f && rng.Chance(0.75)) {
      static constexpr S kRepairs[] = {S::kConcrete, S::kBrickBrown, S::kBrickRed, S::kConcrete};
      const float wide = uniform(0.35f, 1.0f) * half, tall = std::min(uniform(0.7f, 2.6f), top - 0.6f - z),
                  at = m + uniform(-1, 1) * (half - wide);
      pen.Use(kRepairs[rng.Index(4)]);
      pen.Front(at - wide, at + wide, z, z + tall, -0.010f);
      z += tall + uniform(1.5f, 6.0f);
    }
    if (rng.Chance(0.45)) {
      const float x = m + w / 2 - 0.2f, r = uniform(0.05f, 0.09f);
      pen.Use(rng.Chance(0.5) ? S::kMetal : S::kIronBlack);
      pen.Bar(x - r, x + r, from + 0.1f, top - uniform(0.2f, 1.2f), -0.06f - 2 * r, -0.06f);
      for (float b = from + 1.2f; b < top - 1.5f; b += 2.8f) pen.Bar(x - r - 0.02f, x + r + 0.02f, b, b + 0.05f, -0.08f - 2 * r, 0);
    } else if (rng.Chance(0.3)) {
      const float x = m + uniform(-0.2f, 0.2f);
      pen.Use(S::kBrickBrown);
      pen.Bar(x - 0.45f, x + 0.45f, from, top + uniform(0.4f, 1.2f), -0.22f, 0);
    }
  }
}

// The wall above a lower neighbour: bare, with a few columns of small windows where it is high.
void BuildPartyWall(FacadePen& pen, const BuildingPlan& plan, const Dress& dress, float from, bool windows, bool chimneys, bool near,
                    RngStream& rng, RngStream& wear) {
  const StyleMetrics& metrics = MetricsOf(plan.style);
  const float top = plan.height() + ParapetHeight(plan), L = pen.length();
  if (from >= top) return;
  Dress bare = dress;
  bare.wall = dress.party;
  const int first = std::clamp(static_cast<int>(std::ceil((from + 0.4f - plan.first_storey()) / metrics.floor_height)), 0, plan.floors);
  const float start = std::max(from, plan.first_storey() + metrics.floor_height * static_cast<float>(first));
  pen.Use(bare.wall);
  pen.Front(0, L, from, start, 0);
  const int bays = CountBays(L, 4.1f);
  const float w = L / static_cast<float>(bays);
  std::vector<float> closed;  // middles of bays without windows
  std::vector<Kept> kept;
  for (int i = 0; i < bays; ++i) {
    const float x0 = w * static_cast<float>(i), m = x0 + w / 2;
    const bool open = rng.Chance(0.55) && windows;
    closed.push_back(open ? -1.0f : m);
    for (int f = first; f < plan.floors; ++f) {
      const float z0 = plan.first_storey() + metrics.floor_height * static_cast<float>(f), z1 = z0 + metrics.floor_height;
      if (open) {
        kept.push_back(Around(m - 0.5f, m + 0.5f, z0 + 1.0f, z0 + 2.4f));
        internal::SimpleOpening(pen, bare, x0, x0 + w, z0, z1, m - 0.5f, m + 0.5f, z0 + 1.0f, z0 + 2.4f, 0.15f, rng);
      } else if (f == first) {
        pen.Use(bare.wall);
        pen.Front(x0, x0 + w, z0, plan.height(), 0);
      }
    }
  }
  pen.Use(bare.wall);
  pen.Front(0, L, plan.height(), top, 0);
  if (!windows) return;  // a painted picture
  // Pipes and chimneys stand out farther than maps allow.
  if (chimneys) {
    WearPartyWall(pen, closed, w, from, top, rng);
    for (float m : closed)
      if (m >= 0) kept.push_back({m - w / 2, m + w / 2, from, top});
  }
  if (near) internal::WearWall(pen, bare, from + 0.45f, top - 0.3f, kept, 1, wear);
}

}  // namespace

void BuildFacades(FacadeContext& context, const BuildingPlan& plan, EntityId entity, const std::vector<FacadeDetail>& detail) {
  FacadePen pen(context.mesh, context.surfaces);
  pen.SetScale(context.base, context.stretch, context.reach);
  const Dress dress = DressOf(plan);
  context.building = entity;
  for (size_t e = 0; e < plan.edges.size(); ++e) {
    RngStream rng(plan.seed, "facade", e), wear(plan.seed, "wear", e);
    pen.SetWall(plan.outline[e], plan.outline[(e + 1) % plan.outline.size()]);
    pen.UseEntity(entity);
    if (plan.edges[e] == EdgeKind::kParty) {
      BuildPartyWall(pen, plan, dress, std::max(plan.base, plan.party_height[e]), static_cast<int>(e) != plan.mural_edge,
                     context.reach >= 1, detail[e] != FacadeDetail::kFlat, rng, wear);
    } else if (detail[e] == FacadeDetail::kFlat) {
      pen.Use(dress.far);
      pen.Front(0, pen.length(), plan.base, plan.height() + ParapetHeight(plan), 0);
    } else {
      std::vector<Kept> kept;
      if (plan.base == 0) BuildGroundFloor(context, pen, plan, dress, entity, plan.edges[e], rng, wear);
      pen.UseEntity(entity);
      BuildStoreys(context, pen, plan, dress, plan.edges[e], detail[e], rng, wear, kept);
      pen.UseEntity(entity);
      BuildBands(pen, plan, dress, plan.edges[e]);
      // Fronts with pilasters and braces have no room for marks; those towards streets are better kept.
      if (plan.style == FacadeStyle::kBrickWalkUp || plan.style == FacadeStyle::kStuccoShutters || plan.edges[e] == EdgeKind::kRear)
        internal::WearWall(pen, dress, plan.first_storey() + 0.3f, plan.height() - dress.cornice, kept,
                           plan.edges[e] == EdgeKind::kRear ? 1.0f : 0.35f, wear);
      if (plan.edges[e] == EdgeKind::kStreet && detail[e] == FacadeDetail::kFull) internal::BuildWallExtras(context, pen, plan, rng);
    }
  }
  context.mesh.SetTransform({});
}

Surface WallSurfaceOf(const BuildingPlan& building) { return DressOf(building).wall; }

float ParapetHeight(const BuildingPlan& building) {
  return building.roof == RoofKind::kFlatGravel || building.roof == RoofKind::kFlatBitumen ? 0.95f : 0.0f;
}

MeshId AddBalconyMesh(SceneBuilder& builder, const Surfaces& surfaces) {
  // One metre wide, x in [-0.5, 0.5], wall at y = 0, floor at z = 0.
  MeshBuilder mesh;
  FacadePen pen(mesh, surfaces);
  pen.Use(Surface::kTrimStone);
  pen.Bar(-0.5f, 0.5f, -0.12f, 0, -0.55f, 0);
  pen.Use(Surface::kFrameDark);
  pen.Bar(-0.5f, 0.5f, 0.92f, 0.96f, -0.54f, -0.50f);
  pen.Bar(-0.5f, 0.5f, 0.08f, 0.11f, -0.53f, -0.51f);
  for (int i = 0; i <= 10; ++i) {
    const float x = -0.49f + 0.098f * static_cast<float>(i);
    pen.Bar(x - 0.008f, x + 0.008f, 0, 0.92f, -0.528f, -0.512f, true, false);
  }
  for (float x : {-0.49f, 0.47f}) {
    pen.Bar(x, x + 0.02f, 0.92f, 0.96f, -0.5f, 0);
    for (float y : {-0.38f, -0.25f, -0.12f}) pen.Bar(x, x + 0.016f, 0, 0.92f, y, y + 0.016f, true, false);
  }
  return builder.AddMesh(mesh.Finish("balcony"));
}

MeshId AddWindowBoxMesh(SceneBuilder& builder, const Surfaces& surfaces, bool cooler) {
  MeshBuilder mesh;
  FacadePen pen(mesh, surfaces);
  if (!cooler) {
    // A box of planks before the sash, what grows in it a low bank.
    pen.Use(Surface::kDoorGreen);
    pen.Bar(-0.42f, 0.42f, 0, 0.17f, -0.27f, -0.06f);
    pen.Use(Surface::kLawn);
    pen.Bar(-0.39f, 0.39f, 0.17f, 0.27f, -0.25f, -0.08f);
    pen.Use(Surface::kDoorRed);
    for (int i = 0; i < 7; ++i) {
      const float x = -0.36f + 0.11f * static_cast<float>(i);
      pen.Bar(x, x + 0.06f, 0.24f, 0.31f, -0.26f + 0.05f * static_cast<float>(i % 3), -0.20f + 0.05f * static_cast<float>(i % 3));
    }
    return builder.AddMesh(mesh.Finish("window flowers"));
  }
  pen.Use(Surface::kMetal);
  pen.Bar(-0.33f, 0.33f, 0, 0.42f, -0.32f, 0.15f);
  pen.Use(Surface::kFrameDark);
  for (int i = 0; i < 6; ++i) {
    const float z = 0.06f + 0.055f * static_cast<float>(i);
    pen.Front(-0.28f, 0.28f, z, z + 0.02f, -0.324f);
  }
  return builder.AddMesh(mesh.Finish("window air conditioner"));
}

}  // namespace airsim360

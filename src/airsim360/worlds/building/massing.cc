#include "airsim360/worlds/building/massing.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/choice.h"
#include "airsim360/base/random.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

constexpr float kDepth = 14.5f;  // of the perimeter buildings
constexpr float kAlley = 3.4f;

// A stretch of one side of a block: from `from` to `to` along the side, counted from its start.
struct Parcel {
  float from, to;
  bool corner = false;
  bool alley_before = false;
};

// Parcels of a side of length L between two corner parcels of kDepth.
std::vector<Parcel> Subdivide(float length, bool corners, bool backdrop, RngStream& rng) {
  std::vector<Parcel> parcels;
  const float begin = kDepth, end = length - kDepth;
  if (corners) parcels.push_back({0, kDepth, true});
  float at = begin;
  while (at < end - 1) {
    // The core's lots are as wide as those of an old town (data/osm/distributions.csv), the backdrop's wider.
    const float least = backdrop ? 11.5f : 4.7f;
    float width = backdrop ? static_cast<float>(rng.Uniform(11.5, 23))
                           : std::clamp(static_cast<float>(8.0 * std::exp(0.45 * rng.Normal())), least, 24.0f);
    if (end - at - width < least) width = end - at > 2.2f * least ? (end - at) / 2 : end - at;
    const bool alley = at > begin + 1 && width > (backdrop ? 15.0f : 10.5f) && rng.Chance(backdrop ? 0.16 : 0.12);
    parcels.push_back({at + (alley ? kAlley : 0), at + width, false, alley});
    at += width;
  }
  if (corners) parcels.push_back({end, length, true});
  return parcels;
}

FacadeStyle PickStyle(int floors, FacadeStyle before, RngStream& rng) {
  constexpr auto kStyles = static_cast<uint32_t>(FacadeStyle::kRibbon) + 1;  // the rest is New York's
  for (;;) {
    const auto style = static_cast<FacadeStyle>(rng.Index(kStyles));
    const bool modern = style == FacadeStyle::kCurtainWall || style == FacadeStyle::kRibbon || style == FacadeStyle::kConcreteGrid;
    if (style == before) continue;
    if (floors <= 4 && modern && !rng.Chance(0.15)) continue;
    if (floors >= 10 && (style == FacadeStyle::kStuccoShutters || style == FacadeStyle::kBrickWalkUp)) continue;
    return style;
  }
}

int PickFloors(const Block& block, bool corner, RngStream& rng) {
  // Low around the plaza, higher towards the east and in the ring.
  const bool backdrop = block.kind == BlockKind::kBackdrop;
  const double mean = backdrop ? 7.5 : block.column == 3 ? 3.5 : 2.7;
  double floors = mean + (backdrop ? 2.1 : 1.25) * rng.Normal() + (corner ? 1.3 : 0);
  if (rng.Chance(backdrop ? 0.10 : 0.05)) floors += rng.Uniform(4, 7);
  return std::clamp(static_cast<int>(std::lround(floors)), 2, backdrop ? 17 : 12);
}

RoofKind PickRoof(const BuildingPlan& building, RngStream& rng) {
  const bool pitched = building.floors <= 5 && building.outline.size() == 4 &&
                       (building.style == FacadeStyle::kStuccoShutters || building.style == FacadeStyle::kBrickWalkUp);
  if (pitched && rng.Chance(0.75)) {
    return building.style == FacadeStyle::kStuccoShutters ? RoofKind::kHipTile : RoofKind::kHipSlate;
  }
  return rng.Chance(0.6) ? RoofKind::kFlatGravel : RoofKind::kFlatBitumen;
}

// Outline of a parcel of side `side`; edge 0 is the street edge (at the building line), edge 2 the rear.
std::vector<Vec2f> ParcelOutline(const GroundRect& inner, int side, const Parcel& parcel) {
  const auto add = [](Vec2f origin, Vec2f u, float a, Vec2f v, float b) { return origin + u * a + v * b; };
  const Vec2f origins[] = {{inner.x0, inner.y0}, {inner.x1, inner.y0}, {inner.x1, inner.y1}, {inner.x0, inner.y1}};
  const Vec2f along[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}}, inward[] = {{0, 1}, {-1, 0}, {0, -1}, {1, 0}};
  const auto at = [&](float s, float d) { return add(origins[side], along[side], s, inward[side], d); };
  return {at(parcel.from, 0), at(parcel.to, 0), at(parcel.to, kDepth), at(parcel.from, kDepth)};
}

// Cuts the street corner between edges `first` and `second` (consecutive) off a rectangular plan.
void Chamfer(BuildingPlan& building, size_t corner, float cut) {
  auto& outline = building.outline;
  const size_t n = outline.size();
  const Vec2f before = outline[(corner + n - 1) % n], at = outline[corner], after = outline[(corner + 1) % n];
  const auto towards = [cut, at](Vec2f p) {
    const Vec2f v = p - at;
    return at + v * (cut / std::hypot(v.x, v.y));
  };
  outline[corner] = towards(before);
  const auto next = static_cast<std::ptrdiff_t>(corner + 1);
  outline.insert(outline.begin() + next, towards(after));
  building.edges.insert(building.edges.begin() + static_cast<std::ptrdiff_t>(corner), EdgeKind::kStreet);
  building.party_height.insert(building.party_height.begin() + static_cast<std::ptrdiff_t>(corner), 0.0f);
}

void PlanBlock(const StreetPlan& plan, size_t index, uint64_t seed, std::vector<BuildingPlan>& out) {
  const Block& block = plan.blocks[index];
  RngStream rng(seed, "massing", index);
  const GroundRect inner = block.inner();
  const size_t first = out.size();
  FacadeStyle before = FacadeStyle::kCount;
  for (int side = 0; side < 4; ++side) {
    // South and north own the corners.
    const bool corners = side % 2 == 0;
    const float length = side % 2 == 0 ? inner.width() : inner.depth();
    const std::vector<Parcel> parcels = Subdivide(length, corners, block.kind == BlockKind::kBackdrop, rng);
    for (size_t i = 0; i < parcels.size(); ++i) {
      const Parcel& parcel = parcels[i];
      BuildingPlan building;
      building.block = index;
      building.outline = ParcelOutline(inner, side, parcel);
      building.party_height.assign(4, 0);
      const bool alley_after = i + 1 < parcels.size() && parcels[i + 1].alley_before;
      building.edges = {EdgeKind::kStreet, alley_after ? EdgeKind::kRear : EdgeKind::kParty, EdgeKind::kRear,
                        parcel.alley_before ? EdgeKind::kRear : EdgeKind::kParty};
      building.floors = PickFloors(block, parcel.corner, rng);
      building.style = before = PickStyle(building.floors, before, rng);
      building.palette = static_cast<int>(rng.Index(static_cast<uint32_t>(MetricsOf(building.style).palettes)));
      building.seed = rng.Bits();
      if (parcel.corner) {
        // The outer side edge is a street too; the rear is shared with the column behind.
        const bool at_start = i == 0;
        building.edges[at_start ? 3 : 1] = EdgeKind::kStreet;
        building.edges[2] = EdgeKind::kParty;
        if (rng.Chance(0.55)) Chamfer(building, at_start ? 0 : 1, static_cast<float>(rng.Uniform(2.2, 4)));
      }
      building.roof = PickRoof(building, rng);
      out.push_back(std::move(building));
    }
  }
  HidePartyWalls(out, first);
}

}  // namespace

void HidePartyWalls(std::vector<BuildingPlan>& out, size_t first) {
  for (size_t i = first; i < out.size(); ++i) {
    for (size_t e = 0; e < out[i].edges.size(); ++e) {
      if (out[i].edges[e] != EdgeKind::kParty) continue;
      const Vec2f a = out[i].outline[e], b = out[i].outline[(e + 1) % out[i].outline.size()];
      const Vec2f direction = (b - a) * (1 / std::hypot(b.x - a.x, b.y - a.y));
      const Vec2f probe = (a + b) * 0.5f + Vec2f{direction.y, -direction.x} * 0.5f;
      for (size_t k = first; k < out.size(); ++k) {
        if (k != i && out[k].base == 0 && out[k].bounds().Contains(probe)) out[i].party_height[e] = out[k].height();
      }
    }
  }
}

const std::vector<std::string>& FacadeStyleNames() {
  static const std::vector<std::string> names = {"brick_walk_up", "classic_stone", "stucco_shutters", "concrete_grid",
                                                 "curtain_wall",  "brick_loft",    "ribbon",          "deco",
                                                 "brownstone",    "braced_glass",  "terracotta",      "glazed_deco"};
  return names;
}

std::vector<FacadeStyle> StylesOf(const std::vector<std::string>& names) {
  std::vector<FacadeStyle> styles;
  for (const std::string& name : names) {
    styles.push_back(static_cast<FacadeStyle>(ParseChoice("facade style", name, FacadeStyleNames())));
  }
  return styles;
}

const StyleMetrics& MetricsOf(FacadeStyle style) {
  static constexpr StyleMetrics kMetrics[] = {
      {4.2f, 3.2f, 2.8f, 4},   // brick walk-up
      {5.0f, 3.7f, 3.2f, 3},   // classic stone
      {4.3f, 3.3f, 3.0f, 4},   // stucco with shutters
      {4.8f, 3.5f, 3.6f, 3},   // concrete grid
      {5.0f, 3.8f, 1.55f, 2},  // curtain wall
      {4.8f, 3.9f, 4.4f, 3},   // loft
      {4.6f, 3.5f, 3.3f, 2},   // ribbon
      {5.2f, 3.7f, 3.6f, 4},   // deco piers
      {4.4f, 3.3f, 2.3f, 3},   // brownstone
      {5.0f, 3.8f, 1.6f, 1},   // braced glass
      {5.2f, 3.8f, 4.0f, 3},   // terracotta
      {5.2f, 3.6f, 2.0f, 3},   // glazed deco
  };
  return kMetrics[static_cast<size_t>(style)];
}

float BuildingPlan::first_storey() const { return base > 0 ? base : MetricsOf(style).ground_height; }

float BuildingPlan::height() const { return first_storey() + static_cast<float>(floors) * MetricsOf(style).floor_height; }

GroundRect BuildingPlan::bounds() const {
  GroundRect box{outline[0].x, outline[0].y, outline[0].x, outline[0].y};
  for (Vec2f p : outline) {
    box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x), std::max(box.y1, p.y)};
  }
  return box;
}

std::vector<BuildingPlan> PlanBuildings(const StreetPlan& plan, uint64_t seed) {
  std::vector<BuildingPlan> buildings;
  for (size_t i = 0; i < plan.blocks.size(); ++i) {
    const BlockKind kind = plan.blocks[i].kind;
    if (kind == BlockKind::kBuilt || kind == BlockKind::kBackdrop) PlanBlock(plan, i, seed, buildings);
  }
  return buildings;
}

GroundRect CourtyardOf(const Block& block) { return block.inner().Inset(kDepth); }

std::vector<Vec2f> OffsetConvex(const std::vector<Vec2f>& outline, float d) {
  const size_t n = outline.size();
  std::vector<Vec2f> moved(n);
  for (size_t i = 0; i < n; ++i) {
    const Vec2f a = outline[(i + n - 1) % n], b = outline[i], c = outline[(i + 1) % n];
    const auto inward = [](Vec2f from, Vec2f to) {
      const Vec2f v = to - from;
      const float length = std::hypot(v.x, v.y);
      return Vec2f{-v.y / length, v.x / length};
    };
    // The corner moves along the bisector so that both edges move by d.
    const Vec2f n0 = inward(a, b), n1 = inward(b, c), m = n0 + n1;
    moved[i] = b + m * (2 * d / (m.x * m.x + m.y * m.y));
  }
  return moved;
}

double FreeGroundArea(const StreetPlan& plan, const std::vector<BuildingPlan>& buildings) {
  const GroundRect reach = plan.reach();
  double area = reach.area();
  for (const BuildingPlan& building : buildings) {
    if (building.base > 0 || !reach.Contains(building.bounds().center())) continue;
    double twice = 0;
    for (size_t i = 0; i < building.outline.size(); ++i) {
      const Vec2f a = building.outline[i], b = building.outline[(i + 1) % building.outline.size()];
      twice += static_cast<double>(a.x) * b.y - static_cast<double>(b.x) * a.y;
    }
    area -= twice / 2;
  }
  return area;
}

}  // namespace airsim360

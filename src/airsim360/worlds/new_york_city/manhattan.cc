#include "airsim360/worlds/new_york_city/manhattan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/worlds/new_york_city/period.h"

namespace airsim360::internal {
namespace {

constexpr float kRearYard = 3;

using Style = FacadeStyle;

const Role* RoleOf(const Period& period, const Block& block, int row, int index, int count) {
  for (const Role& role : period.roles) {
    const int at = role.index < 0 ? count - 1 : role.index;
    if (role.column == block.column && role.block_row == block.row && role.row == row && at == index) return &role;
  }
  return nullptr;
}

// What is built on a lot.
struct Design {
  FacadeStyle style;
  int palette;
  float height;
  int tiers;
  bool houses = false;
};

// A tower, or the low style of a row of houses. Half of the corners and two thirds of the other lots are houses: with several
// on a lot, seven buildings in ten have no more than six storeys, as in the real city.
Design DrawDesign(const Lot& lot, bool core, float scale, const Period& period, RngStream& rng) {
  Design d{};
  const bool corner = lot.corner();
  d.houses = rng.Chance(corner ? 0.52 : 0.68);
  if (d.houses) {
    d.style = core && !corner && rng.Chance(0.45) ? Style::kBrownstone : Style::kBrickWalkUp;
    d.tiers = 1;
    d.height = 16;
  } else if (corner) {
    d.style = period.corner_towers[rng.Index(9)];
    d.height = static_cast<float>(34 + 75 * rng.Uniform() * rng.Uniform() + 32 * rng.Uniform()) * scale;
    const double pick = rng.Uniform();
    d.tiers = pick < 0.4 ? 3 : pick < 0.75 ? 2 : 1;
  } else if (rng.Chance(0.3)) {
    d.style = Style::kBrickLoft;
    d.height = static_cast<float>(rng.Uniform(18, 34));
    d.tiers = 1;
  } else {
    d.style = period.other_towers[rng.Index(6)];
    d.height = static_cast<float>(30 + 50 * rng.Uniform()) * scale;
    d.tiers = rng.Chance(0.5) ? 3 : 2;
  }
  // Low ones have no tiers; classic stone stays below its natural height.
  if (d.style == Style::kClassicStone) d.height = std::min(d.height, 48.0f);
  if (d.height < 33) d.tiers = 1;
  d.palette = static_cast<int>(rng.Index(static_cast<uint32_t>(MetricsOf(d.style).palettes)));
  return d;
}

// The lot's outline; the "deco corner" has a round one.
std::vector<Vec2f> LotOutline(const Lot& lot, const GroundRect& r) {
  if (lot.role != "deco corner") return r.Outline();
  constexpr float kRadius = 9;
  std::vector<Vec2f> outline;
  for (int k = 0; k <= 5; ++k) {
    const float a = std::numbers::pi_v<float> * (1 + 0.1f * static_cast<float>(k));
    outline.push_back({r.x0 + kRadius + kRadius * std::cos(a), r.y0 + kRadius + kRadius * std::sin(a)});
  }
  outline.push_back({r.x1, r.y0});
  outline.push_back({r.x1, r.y1});
  outline.push_back({r.x0, r.y1});
  return outline;
}

// Which way an edge of an outline looks: 0 south, 1 east, 2 north, 3 west, 4 between south and west.
int Facing(Vec2f a, Vec2f b) {
  const Vec2f v = b - a;
  if (std::abs(v.y) < 0.01f) return v.x > 0 ? 0 : 2;
  if (std::abs(v.x) < 0.01f) return v.y > 0 ? 1 : 3;
  return 4;
}

EdgeKind KindOf(const Lot& lot, int facing) {
  if (facing == 4) return EdgeKind::kStreet;
  const int front = lot.row == 0 ? 0 : 2;
  if (facing == front) return EdgeKind::kStreet;
  if (facing == 1) return lot.index + 1 == lot.count ? EdgeKind::kStreet : EdgeKind::kParty;
  if (facing == 3) return lot.index == 0 ? EdgeKind::kStreet : EdgeKind::kParty;
  return lot.corner() ? EdgeKind::kParty : EdgeKind::kRear;
}

// What of a shared wall reaches beyond its neighbour looks into a yard: an edge of its own there, with windows in large
// buildings.
void SplitAtYards(std::vector<BuildingPlan>& plans, size_t first) {
  for (size_t i = first; i < plans.size(); ++i) {
    BuildingPlan& plan = plans[i];
    for (size_t e = 0; plan.base == 0 && e < plan.edges.size(); ++e) {
      if (plan.edges[e] != EdgeKind::kParty) continue;
      const Vec2f a = plan.outline[e], b = plan.outline[(e + 1) % plan.outline.size()];
      const bool along_y = std::abs(a.x - b.x) < 0.01f;
      const float t0 = along_y ? std::min(a.y, b.y) : std::min(a.x, b.x), t1 = along_y ? std::max(a.y, b.y) : std::max(a.x, b.x);
      const float beyond = along_y ? a.x + (b.y > a.y ? 0.5f : -0.5f) : a.y + (b.x > a.x ? -0.5f : 0.5f);
      // What the neighbour covers of it.
      float low = t1, high = t0;
      for (size_t k = first; k < plans.size(); ++k) {
        const GroundRect r = plans[k].bounds();
        const float r0 = along_y ? r.y0 : r.x0, r1 = along_y ? r.y1 : r.x1;
        const bool there = along_y ? beyond > r.x0 && beyond < r.x1 : beyond > r.y0 && beyond < r.y1;
        if (k == i || plans[k].base > 0 || !there || r1 < t0 + 0.05f || r0 > t1 - 0.05f) continue;
        low = std::min(low, std::max(t0, r0));
        high = std::max(high, std::min(t1, r1));
      }
      const EdgeKind open = plan.height() > 30 ? EdgeKind::kRear : EdgeKind::kParty;
      const bool covered_low = low - t0 < t1 - high;  // nearer to its lower end
      const float at = covered_low ? high : low;
      if (high <= low) {
        plan.edges[e] = open;
      } else if (at - t0 > 1 && t1 - at > 1) {
        const auto next = static_cast<std::ptrdiff_t>(e + 1);
        const bool rising = along_y ? b.y > a.y : b.x > a.x, covered_first = rising == covered_low;
        plan.outline.insert(plan.outline.begin() + next, along_y ? Vec2f{a.x, at} : Vec2f{at, a.y});
        plan.edges.insert(plan.edges.begin() + next, covered_first ? open : EdgeKind::kParty);
        plan.edges[e] = covered_first ? EdgeKind::kParty : open;
        ++e;  // the new edge is done
      }
    }
    plan.party_height.assign(plan.outline.size(), 0);
  }
}

// Walls whose neighbour falls short by less than what is worth an edge are built whole: what is behind it, nobody sees.
void ShowUncoveredWalls(std::vector<BuildingPlan>& plans, size_t first) {
  for (size_t i = first; i < plans.size(); ++i) {
    BuildingPlan& plan = plans[i];
    for (size_t e = 0; e < plan.edges.size(); ++e) {
      if (plan.party_height[e] <= 0) continue;
      const Vec2f a = plan.outline[e], v = plan.outline[(e + 1) % plan.outline.size()] - a;
      const Vec2f out = Vec2f{v.y, -v.x} * (0.5f / std::hypot(v.x, v.y));
      for (float t : {0.01f, 0.99f}) {
        const Vec2f p = a + v * t + out;
        const bool covered = std::any_of(plans.begin() + static_cast<std::ptrdiff_t>(first), plans.end(), [&](const BuildingPlan& other) {
          return other.base == 0 && other.bounds().Contains(p) && other.height() >= plan.party_height[e] - 0.01f;
        });
        if (!covered) plan.party_height[e] = 0;
      }
    }
  }
}

// The tiers of one building, lowest first.
void AddTiers(const Lot& lot, const Design& design, uint64_t seed, std::vector<BuildingPlan>& out) {
  const StyleMetrics& metrics = MetricsOf(design.style);
  const auto storeys = [&](float h) { return std::max(1, static_cast<int>(std::lround(h / metrics.floor_height))); };
  RngStream rng(seed, "tiers");
  // Shares of the height, and how far each tier stands back from the one below.
  std::vector<float> tops{design.height};
  const float base = std::min(design.height * 0.45f, static_cast<float>(rng.Uniform(17, 27)));
  if (design.tiers == 2) tops = {base, design.height};
  if (design.tiers == 3) tops = {base + 5, design.height * static_cast<float>(rng.Uniform(0.68, 0.8)), design.height};
  GroundRect r = lot.rect;
  float foot = 0;
  for (size_t i = 0; i < tops.size(); ++i) {
    BuildingPlan plan;
    plan.block = lot.block;
    plan.style = design.style;
    plan.palette = design.palette;
    plan.seed = seed + i * 7919;
    plan.base = foot;
    plan.outline = LotOutline(lot, r);
    for (size_t e = 0; e < plan.outline.size(); ++e) {
      const int facing = Facing(plan.outline[e], plan.outline[(e + 1) % plan.outline.size()]);
      plan.edges.push_back(i == 0 ? KindOf(lot, facing) : EdgeKind::kStreet);
    }
    plan.party_height.assign(plan.outline.size(), 0);
    plan.floors = storeys(tops[i] - (i == 0 ? metrics.ground_height : foot));
    plan.roof = rng.Chance(0.5) ? RoofKind::kFlatGravel : RoofKind::kFlatBitumen;
    plan.name = lot.name;
    foot = plan.height();
    // The next tier: well back from neighbours, a little from the streets.
    const float street =
        i == 0 && design.tiers == 2 ? static_cast<float>(rng.Uniform(0.6, 3.0)) : static_cast<float>(rng.Uniform(2.2, 4.0));
    const auto inset = [&](int facing) { return KindOf(lot, facing) == EdgeKind::kStreet || i > 0 ? street : std::max(street, 3.2f); };
    GroundRect next{r.x0 + inset(3), r.y0 + inset(0), r.x1 - inset(1), r.y1 - inset(2)};
    const bool last = i + 1 == tops.size() || std::min(next.width(), next.depth()) < (lot.role == "deco corner" ? 19.0f : 9.0f);
    if (!last) plan.upper = LotOutline(lot, next);
    out.push_back(std::move(plan));
    if (last) break;
    r = next;
  }
}

// Lots of one row: wide ones at the ends, on the avenues; these are as wide as those of the other row.
std::vector<Lot> CutRow(const Block& block, size_t index, int row, float first, float last, RngStream& rng) {
  const GroundRect inner = block.inner();
  const int count = block.column == 3 && block.row == 1 ? 5 : 4 + static_cast<int>(rng.Index(3));
  std::vector<float> widths;
  float sum = 0;
  for (int i = 0; i < count; ++i) {
    const bool end = i == 0 || i + 1 == count;
    widths.push_back(static_cast<float>(rng.Uniform(0.65, 1.35)));
    if (!end) sum += widths.back();
  }
  const float middle = inner.center().y;
  float x = inner.x0;
  std::vector<Lot> lots;
  for (int i = 0; i < count; ++i) {
    Lot lot;
    lot.block = index;
    lot.row = row;
    lot.index = i;
    lot.count = count;
    const float w = i == 0 ? first : i + 1 == count ? last : widths[static_cast<size_t>(i)] / sum * (inner.width() - first - last);
    lot.rect = {x, row == 0 ? inner.y0 : middle, x + w, row == 0 ? middle : inner.y1};
    if (i + 1 == count) lot.rect.x1 = inner.x1;
    // Mid-block lots keep a yard behind them.
    if (!lot.corner()) (row == 0 ? lot.rect.y1 : lot.rect.y0) += row == 0 ? -kRearYard : kRearYard;
    lots.push_back(lot);
    x += w;
  }
  return lots;
}

// Houses of 18 to 25 feet side by side on one lot: brownstones alike in a row, walk-ups each of its own height and depth.
// At a corner the outermost reaches back along the avenue.
void AddHouses(const Lot& lot, const Design& design, uint64_t seed, Manhattan& city) {
  RngStream rng(seed, "houses");
  const bool row = design.style == Style::kBrownstone;
  const auto count = std::max(1, static_cast<int>(std::lround(lot.rect.width() / (row ? rng.Uniform(5.6, 6.8) : rng.Uniform(5.9, 7.6)))));
  const float w = lot.rect.width() / static_cast<float>(count), floor = MetricsOf(design.style).floor_height,
              ground = MetricsOf(design.style).ground_height;
  const auto row_depth = static_cast<float>(rng.Uniform(12.5, 16));
  const int row_floors = 2 + static_cast<int>(rng.Index(2));
  for (int i = 0; i < count; ++i) {
    Lot house = lot;
    house.rect.x0 = lot.rect.x0 + w * static_cast<float>(i);
    house.rect.x1 = house.rect.x0 + w;
    const bool outer = lot.corner() && i == (lot.index == 0 ? 0 : count - 1);
    float depth =
        row ? row_depth + static_cast<float>(rng.Chance(0.25) ? rng.Uniform(1.5, 4) : 0) : static_cast<float>(rng.Uniform(12.5, 21));
    if (outer) {
      depth = lot.rect.depth();
    } else {
      house.index = 1;  // not at a corner: walls shared on both sides
      house.count = 3;
    }
    const GroundRect whole = house.rect;
    (lot.row == 0 ? house.rect.y1 : house.rect.y0) = lot.row == 0 ? whole.y0 + depth : whole.y1 - depth;
    const double pick = rng.Uniform();
    const int floors = outer         ? 3 + (pick < 0.65) + (pick < 0.25)
                       : row         ? row_floors + (pick < 0.15)
                       : pick < 0.16 ? 2
                       : pick < 0.50 ? 3
                       : pick < 0.84 ? 4
                                     : 5;
    const int palette = row ? (design.palette + i / 3) % 3 : static_cast<int>(rng.Index(4));
    AddTiers(house, {design.style, palette, ground + floor * static_cast<float>(floors), 1}, seed + static_cast<uint64_t>(i),
             city.buildings);
    if (!outer && whole.depth() - depth > 4) {
      const GroundRect yard =
          lot.row == 0 ? GroundRect{whole.x0, house.rect.y1, whole.x1, whole.y1} : GroundRect{whole.x0, whole.y0, whole.x1, house.rect.y0};
      city.yards.push_back({lot.block, yard, lot.row == 0 ? 1.0f : -1.0f});
    }
  }
}

}  // namespace

Manhattan PlanManhattan(const StreetPlan& plan, const ManhattanOptions& options) {
  const Period& period = PeriodOf(options.style);
  Manhattan city;
  for (size_t i = 0; i < plan.blocks.size(); ++i) {
    const Block& block = plan.blocks[i];
    if (block.kind != BlockKind::kBuilt && block.kind != BlockKind::kBackdrop) continue;
    const bool core = block.kind == BlockKind::kBuilt;
    RngStream rng(options.seed, "manhattan", i);
    const size_t first = city.buildings.size();
    const auto west = static_cast<float>(rng.Uniform(19, 26)), east = static_cast<float>(rng.Uniform(19, 26));
    for (int row = 0; row < 2; ++row) {
      for (Lot& lot : CutRow(block, i, row, west, east, rng)) {
        Design design = DrawDesign(lot, core, options.height_scale, period, rng);
        const uint64_t seed = rng.Bits();
        if (!options.styles.empty() && std::find(options.styles.begin(), options.styles.end(), design.style) == options.styles.end()) {
          design.style = options.styles[rng.Index(static_cast<uint32_t>(options.styles.size()))];
          design.palette = static_cast<int>(rng.Index(static_cast<uint32_t>(MetricsOf(design.style).palettes)));
          if (design.style == FacadeStyle::kBrownstone && (lot.corner() || design.height > 20)) design.style = FacadeStyle::kBrickWalkUp;
          design.houses = design.houses && (design.style == FacadeStyle::kBrownstone || design.style == FacadeStyle::kBrickWalkUp);
        }
        if (const Role* role = RoleOf(period, block, row, lot.index, lot.count)) {
          lot.role = role->name;
          lot.name = *role->called ? role->called : role->name;
          lot.use = role->use;
          design = {role->style, role->palette, role->height, role->tiers};
        }
        lot.style = design.style;
        lot.houses = design.houses;
        if (lot.use == LotUse::kBuilding) {
          const size_t from = city.buildings.size();
          if (lot.houses) {
            AddHouses(lot, design, seed, city);
          } else {
            AddTiers(lot, design, seed, city.buildings);
          }
          lot.podium = city.buildings[from].height();
          lot.height = city.buildings.back().height();
          if (!lot.corner() && lot.role.empty() && !lot.houses && rng.Chance(0.25)) city.buildings[from].awnings = false;
          if (lot.role == "grid tower") city.buildings.back().curtain_floor = 3;
        }
        city.lots.push_back(lot);
      }
    }
    SplitAtYards(city.buildings, first);
    HidePartyWalls(city.buildings, first);
    ShowUncoveredWalls(city.buildings, first);
  }
  return city;
}

const Lot& LotOf(const Manhattan& city, std::string_view role) {
  for (const Lot& lot : city.lots)
    if (lot.role == role) return lot;
  throw InputError("new_york_city has no lot '" + std::string(role) + "'");
}

}  // namespace airsim360::internal

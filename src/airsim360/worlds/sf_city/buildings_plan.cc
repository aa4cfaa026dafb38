// Lots and what stands on them: row houses that step up the hills, shops on the level streets, towers downtown.
#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/sf_city/city.h"

namespace airsim360::internal {
namespace {

using Style = FacadeStyle;

// Depth of the strips of houses at the ends of a block, and of what the corner houses take of its short sides.
constexpr float kEndDepth = 24, kCornerDepth = 19;

struct Range {
  float low = 1e9f, high = -1e9f;
  void Add(float x) { low = std::min(low, x), high = std::max(high, x); }
};

// Lowest and highest ground under a rectangle's rim.
Range GroundUnder(const Hills& hills, const GroundRect& r) {
  Range range;
  for (int i = 0; i <= 4; ++i) {
    const float t = static_cast<float>(i) / 4, x = r.x0 + r.width() * t, y = r.y0 + r.depth() * t;
    for (Vec2f p : {Vec2f{x, r.y0}, Vec2f{x, r.y1}, Vec2f{r.x0, y}, Vec2f{r.x1, y}}) range.Add(hills.Height(p));
  }
  return range;
}

class Planner {
 public:
  Planner(const StreetPlan& plan, const Hills& hills, uint64_t seed) : plan_(plan), hills_(hills), seed_(seed) {}

  SfPlan Plan() {
    for (size_t i = 0; i < plan_.blocks.size(); ++i) {
      const Block& block = plan_.blocks[i];
      const size_t first = city_.buildings.size();
      switch (QuarterOf(block)) {
        case Quarter::kHouses:
          PlanHouses(i);
          break;
        case Quarter::kShops:
          PlanShops(i);
          break;
        case Quarter::kTowers:
          PlanTowers(i);
          break;
        default:
          break;
      }
      HideSteppedWalls(first);
    }
    return std::move(city_);
  }

 private:
  // Rows along all four sides: south and north own the corners, the ends fill the rest.
  void PlanHouses(size_t index) {
    const GroundRect inner = plan_.blocks[index].inner();
    const Vec2f c = inner.center();
    const GroundRect garden{inner.x0 + kEndDepth, inner.y0, inner.x1 - kEndDepth, inner.y1};
    for (int side = 0; side < 4; ++side) {
      const size_t first = city_.houses.size();
      const float skip = side % 2 ? kCornerDepth : 0;
      PlanRow(index, side, skip);
      for (size_t i = first; i < city_.houses.size(); ++i) {
        const RowHouse& house = city_.houses[i];
        const float a = house.At(0, 0).x, b = house.At(house.shape.width, 0).x;
        const GroundRect behind{std::max(std::min(a, b), garden.x0), std::min(house.At(0, house.shape.depth).y, c.y),
                                std::min(std::max(a, b), garden.x1), std::max(house.At(0, house.shape.depth).y, c.y)};
        if (side % 2 == 0 && behind.width() > 2) city_.yards.push_back({index, behind, side == 0 ? 1.0f : -1.0f});
      }
    }
  }

  void PlanRow(size_t index, int side, float skip) {
    const GroundRect inner = plan_.blocks[index].inner();
    const float length = side % 2 == 0 ? inner.width() : inner.depth();
    RngStream rng(seed_, "row houses", index * 4 + static_cast<size_t>(side));
    // Runs of houses of one builder share kind, width and floors.
    float s = skip;
    const float end = length - skip;
    const size_t first = city_.houses.size();
    BayHouse run;
    int left_in_run = 0, scheme = 0;
    while (s < end - 0.1f) {
      if (left_in_run-- <= 0) {
        left_in_run = 1 + static_cast<int>(rng.Index(4));
        const double pick = rng.Uniform();
        run.kind = pick < 0.42 ? BayHouse::Kind::kItalianate : pick < 0.72 ? BayHouse::Kind::kGabled : BayHouse::Kind::kStucco;
        run.width = static_cast<float>(rng.Uniform(6.9, 8.4));
        run.floors = run.kind == BayHouse::Kind::kStucco ? (rng.Chance(0.75) ? 1 : 2) : rng.Chance(0.72) ? 2 : rng.Chance(0.5) ? 3 : 1;
        run.depth = static_cast<float>(rng.Uniform(13.5, 16.0));
      }
      BayHouse house = run;
      if (end - s < 1.75f * house.width) house.width = end - s > 10 ? (end - s) / 2 : end - s;
      scheme = (scheme + 1 + static_cast<int>(rng.Index(9))) % 11;
      house.seed = rng.Bits();
      AddHouse(index, side, s, house, scheme, inner, s<skip + 0.1f, s + house.width> end - 0.1f);
      s += house.width;
    }
    HideNeighbours(first);
  }

  void AddHouse(size_t block, int side, float s, BayHouse shape, int scheme, const GroundRect& inner, bool first, bool last) {
    static constexpr Vec2f kAlong[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}}, kInward[] = {{0, 1}, {-1, 0}, {0, -1}, {1, 0}};
    const Vec2f corners[] = {{inner.x0, inner.y0}, {inner.x1, inner.y0}, {inner.x1, inner.y1}, {inner.x0, inner.y1}};
    RowHouse house;
    house.block = block;
    house.along = kAlong[side];
    house.inward = kInward[side];
    house.origin = corners[side] + house.along * s + house.inward * kSetback;
    house.scheme = scheme;
    const float left = hills_.Height(house.At(0, 0)), right = hills_.Height(house.At(shape.width, 0)),
                rear_left = hills_.Height(house.At(0, shape.depth)), rear_right = hills_.Height(house.At(shape.width, shape.depth));
    house.ground = std::max(left, right);
    house.rear = std::max(rear_left, rear_right) - house.ground;
    shape.fall_left = house.ground - left;
    shape.fall_right = house.ground - right;
    shape.foot = house.ground - std::min({left, right, rear_left, rear_right}) + 0.7f;
    shape.rear_ground = house.rear;
    shape.door_right = std::abs(left - right) < 0.15f ? shape.seed % 2 == 0 : right > left;
    // The ends of the long rows look at a street.
    shape.open_left = first && side % 2 == 0;
    shape.open_right = last && side % 2 == 0;
    shape.flat = plan_.blocks[block].kind == BlockKind::kBackdrop;
    house.shape = shape;
    city_.houses.push_back(house);
  }

  // Houses of a row hide each other's sides up to the lower roof.
  void HideNeighbours(size_t first) {
    for (size_t i = first; i < city_.houses.size(); ++i) {
      RowHouse& house = city_.houses[i];
      const auto hidden = [&](const RowHouse& next) {
        return next.shape.depth + 0.05f < house.shape.depth ? -house.shape.foot : next.ground + next.shape.height() - house.ground;
      };
      house.shape.hidden_left = i > first ? hidden(city_.houses[i - 1]) : -house.shape.foot;
      house.shape.hidden_right = i + 1 < city_.houses.size() ? hidden(city_.houses[i + 1]) : -house.shape.foot;
    }
  }

  void AddBuilding(BuildingPlan plan, const GroundRect& r) {
    const Range range = GroundUnder(hills_, r);
    city_.buildings.push_back({std::move(plan), range.high, range.high - range.low + 0.6f});
  }

  void PlanShops(size_t index) {
    const Block& block = plan_.blocks[index];
    const GroundRect inner = block.inner();
    static constexpr std::array kStyles = {Style::kBrickWalkUp, Style::kClassicStone,   Style::kStuccoShutters, Style::kBrickLoft,
                                           Style::kDeco,        Style::kStuccoShutters, Style::kRibbon};
    for (int row = 0; row < 2; ++row) {
      RngStream rng(seed_, "shops", index * 2 + static_cast<size_t>(row));
      float x = inner.x0;
      Style before = Style::kCount;
      while (x < inner.x1 - 0.1f) {
        float w = static_cast<float>(rng.Uniform(8, 16));
        if (inner.x1 - x - w < 8) w = inner.x1 - x > 24 ? (inner.x1 - x) / 2 : inner.x1 - x;
        const auto depth = static_cast<float>(rng.Uniform(17, 24));
        const GroundRect r = row == 0 ? GroundRect{x, inner.y0, x + w, inner.y0 + depth} : GroundRect{x, inner.y1 - depth, x + w, inner.y1};
        const bool west = x<inner.x0 + 0.1f, east = x + w> inner.x1 - 0.1f;
        BuildingPlan plan;
        do plan.style = kStyles[rng.Index(kStyles.size())];
        while (plan.style == before);
        before = plan.style;
        Fill(plan, index, r, rng);
        plan.edges = row == 0 ? std::vector{EdgeKind::kStreet, east ? EdgeKind::kStreet : EdgeKind::kParty, EdgeKind::kRear,
                                            west ? EdgeKind::kStreet : EdgeKind::kParty}
                              : std::vector{EdgeKind::kRear, east ? EdgeKind::kStreet : EdgeKind::kParty, EdgeKind::kStreet,
                                            west ? EdgeKind::kStreet : EdgeKind::kParty};
        plan.floors = 1 + static_cast<int>(rng.Index(4)) + (west || east ? 1 : 0);
        plan.fire_escapes = rng.Chance(0.5);
        AddBuilding(std::move(plan), r);
        x += w;
      }
    }
  }

  void Fill(BuildingPlan& plan, size_t block, const GroundRect& r, RngStream& rng) {
    plan.outline = r.Outline();
    plan.party_height.assign(4, 0);
    plan.palette = static_cast<int>(rng.Index(static_cast<uint32_t>(MetricsOf(plan.style).palettes)));
    plan.roof = rng.Chance(0.6) ? RoofKind::kFlatGravel : RoofKind::kFlatBitumen;
    plan.seed = rng.Bits();
    plan.block = block;
  }

  // Two rows of two or three lots; each tower keeps off its neighbours.
  void PlanTowers(size_t index) {
    const Block& block = plan_.blocks[index];
    const GroundRect inner = block.inner();
    const Vec2f c = inner.center();
    const float core = std::exp(-((c.x - 130) * (c.x - 130) + (c.y + 130) * (c.y + 130)) / (2 * 190.0f * 190.0f));
    for (int row = 0; row < 2; ++row) {
      RngStream rng(seed_, "towers", index * 2 + static_cast<size_t>(row));
      const int lots = 2 + static_cast<int>(rng.Index(2));
      const float w = inner.width() / static_cast<float>(lots);
      for (int i = 0; i < lots; ++i) {
        const float x0 = inner.x0 + w * static_cast<float>(i), half = inner.depth() / 2;
        const GroundRect lot{x0 + (i ? 2.0f : 0.0f), row == 0 ? inner.y0 : inner.y0 + half + 3.2f, x0 + w - (i + 1 < lots ? 2.0f : 0.0f),
                             row == 0 ? inner.y0 + half - 3.2f : inner.y1};
        if (block.kind == BlockKind::kBuilt && rng.Chance(0.09)) {
          city_.plazas.push_back(lot);
          continue;
        }
        AddTower(index, lot, core, rng);
      }
    }
  }

  void AddTower(size_t index, const GroundRect& lot, float core, RngStream& rng) {
    static constexpr std::array kStyles = {Style::kCurtainWall,  Style::kDeco,        Style::kConcreteGrid,
                                           Style::kRibbon,       Style::kCurtainWall, Style::kBracedGlass,
                                           Style::kClassicStone, Style::kBrickLoft,   Style::kConcreteGrid};
    BuildingPlan base;
    base.style = kStyles[rng.Index(kStyles.size())];
    float height = static_cast<float>(18 + 26 * rng.Uniform() + core * (20 + 95 * rng.Uniform() * rng.Uniform() + 30 * rng.Uniform()));
    if (base.style == Style::kClassicStone || base.style == Style::kBrickLoft) height = std::min(height, 44.0f);
    const int tiers = height > 62 ? 2 + static_cast<int>(rng.Index(2)) : height > 36 && rng.Chance(0.45) ? 2 : 1;
    const StyleMetrics& metrics = MetricsOf(base.style);
    Fill(base, index, lot, rng);
    base.edges.assign(4, EdgeKind::kStreet);
    base.shops = rng.Chance(0.75);
    base.awnings = rng.Chance(0.4);
    const Block& block = plan_.blocks[index];
    const GroundRect inner = block.inner();
    // Alleys inside the block get plain rear walls.
    if (lot.y0 > inner.y0 + 1) base.edges[0] = EdgeKind::kRear;
    if (lot.x1 < inner.x1 - 1) base.edges[1] = EdgeKind::kRear;
    if (lot.y1 < inner.y1 - 1) base.edges[2] = EdgeKind::kRear;
    if (lot.x0 > inner.x0 + 1) base.edges[3] = EdgeKind::kRear;
    GroundRect r = lot;
    float z = 0, top = tiers == 1 ? height : static_cast<float>(rng.Uniform(14, 24));
    const Range range = GroundUnder(hills_, lot);
    for (int tier = 0; tier < tiers; ++tier) {
      BuildingPlan plan = base;
      plan.outline = r.Outline();
      if (tier > 0) {
        plan.base = z;
        plan.edges.assign(4, EdgeKind::kStreet);
        plan.seed = rng.Bits();
      }
      const float first = tier == 0 ? metrics.ground_height : z;
      plan.floors = std::max(1, static_cast<int>(std::lround((top - first) / metrics.floor_height)));
      z = plan.height();
      const GroundRect next = r.Inset(std::min(r.width(), r.depth()) * static_cast<float>(rng.Uniform(0.09, 0.17)));
      if (tier + 1 < tiers) plan.upper = next.Outline();
      city_.buildings.push_back({plan, range.high, range.high - range.low + 0.6f});
      r = next;
      top = tier + 2 == tiers ? height : z + (height - z) * static_cast<float>(rng.Uniform(0.45, 0.65));
    }
  }

  // As HidePartyWalls, for neighbours that stand on other ground.
  void HideSteppedWalls(size_t first) {
    auto& all = city_.buildings;
    for (size_t i = first; i < all.size(); ++i) {
      BuildingPlan& plan = all[i].plan;
      for (size_t e = 0; e < plan.edges.size(); ++e) {
        if (plan.edges[e] != EdgeKind::kParty) continue;
        const Vec2f a = plan.outline[e], b = plan.outline[(e + 1) % plan.outline.size()],
                    u = (b - a) * (1 / std::hypot(b.x - a.x, b.y - a.y));
        const Vec2f out = Vec2f{u.y, -u.x} * 0.5f;
        float hidden = 1e9f;
        for (float t : {0.1f, 0.5f, 0.9f}) {
          float here = 0;
          for (size_t k = first; k < all.size(); ++k)
            if (k != i && all[k].plan.bounds().Contains(a + (b - a) * t + out))
              here = std::max(here, all[k].ground + all[k].plan.height() - all[i].ground);
          hidden = std::min(hidden, here);
        }
        plan.party_height[e] = std::max(0.0f, hidden);
      }
    }
  }

  const StreetPlan& plan_;
  const Hills& hills_;
  uint64_t seed_;
  SfPlan city_;
};

}  // namespace

SfPlan PlanSfBuildings(const StreetPlan& plan, const Hills& hills, uint64_t seed) { return Planner(plan, hills, seed).Plan(); }

double FreeSfGround(const StreetPlan& plan, const SfPlan& city) {
  const GroundRect reach = plan.reach();
  double area = reach.area();
  for (const RowHouse& house : city.houses)
    if (reach.Contains(house.At(house.shape.width / 2, house.shape.depth / 2))) area -= house.shape.width * house.shape.depth;
  for (const PlacedBuilding& building : city.buildings)
    if (building.plan.base == 0 && reach.Contains(building.plan.bounds().center())) area -= building.plan.bounds().area();
  return area;
}

}  // namespace airsim360::internal

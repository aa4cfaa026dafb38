#include "airsim360/worlds/town_maker/town_drawer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "airsim360/worlds/town_maker/town_relief.h"

namespace airsim360::internal {
namespace {

constexpr double kWaterside = 9;  // metres between water and what is built

OsmTags TagsOf(const TagList& list) {
  OsmTags tags;
  for (const auto& tag : list) tags.Add(tag.first, tag.second);
  return tags;
}

// Points along a line, about `step` metres apart, its corners included.
std::vector<Vec2d> Dense(const std::vector<Vec2d>& line, double step) {
  std::vector<Vec2d> points{line[0]};
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const int n = std::max(1, static_cast<int>(Length(line[i + 1] - line[i]) / step));
    for (int k = 1; k <= n; ++k) points.push_back(line[i] + (line[i + 1] - line[i]) * (static_cast<double>(k) / n));
  }
  return points;
}

// Without the corners that bend little.
std::vector<Vec2d> Thinned(const std::vector<Vec2d>& line) {
  std::vector<Vec2d> thin{line[0]};
  for (size_t i = 1; i + 1 < line.size(); ++i) {
    const Vec2d a = line[i] - thin.back(), b = line[i + 1] - line[i];
    if (std::abs(a.x * b.y - a.y * b.x) > 0.01 * Length(a) * Length(b)) thin.push_back(line[i]);
  }
  thin.push_back(line.back());
  return thin;
}

Vec2d MiddleOf(const Patch& patch) {
  const Bounds2d box = BoundsOf(patch.outer);
  return (box.min + box.max) * 0.5;
}

Patches SquareAbout(Vec2d m, double half) {
  return {{{{m.x - half, m.y - half}, {m.x + half, m.y - half}, {m.x + half, m.y + half}, {m.x - half, m.y + half}}, {}}};
}

}  // namespace

std::string Metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

TownMap TownDrawer::Draw() {
  x1_ = spec_.width / 2;
  y1_ = spec_.depth / 2;
  x0_ = -x1_;
  y0_ = -y1_;
  // Somewhere in Europe, so that roads are painted as there; high-rise cities are painted as in America.
  map_.data.origin = spec_.style == TownStyle::kModern || spec_.style == TownStyle::kBrick || spec_.style == TownStyle::kSuburban
                         ? GeoPoint{40.7, -74, 0}
                         : GeoPoint{41.9, 12.5, 0};
  map_.data.extent = {x0_, y0_, x1_, y1_};
  LayWaters();
  LayStreets();
  FurnishWaters();
  blocks_ = FreeGround();
  LayOpenPlaces();
  BuildLandmarks();
  BuildHouses();
  DressStreets();
  PlantWoods();
  map_.houses = houses_;
  map_.heights = ReliefOf(spec_, seed_, map_);
  auto& nodes = map_.data.nodes;
  std::stable_sort(nodes.begin(), nodes.end(), [](const OsmNode& a, const OsmNode& b) { return a.id < b.id; });
  return std::move(map_);
}

bool TownDrawer::Inside_(Vec2d p, double margin) const { return map_.data.extent.Contains(p, -margin); }

// Half the carriageway, and each pavement.
std::pair<double, double> TownDrawer::WidthsOf(int rank) const {
  const double between = spec_.street * (rank == 0 ? 1.35 : rank == 2 ? 0.6 : 1);
  if (rank == 2) return {between / 2, 0};
  if (spec_.paving == TownPaving::kDirt) return {std::clamp(between * 0.2, 1.6, 3.0), 0};
  const double pavement = std::clamp(0.18 * between, 0.9, 4.5), lanes = rank == 0 && spec_.cycle_lanes ? 4.3 : between > 9.4 ? 3.7 : 0.0;
  return {std::max({1.6, between / 2 - pavement, lanes}), pavement};
}

void TownDrawer::LayStreets() {
  const StreetNet net = PlanStreets(spec_, rng_);
  // Junctions keep their numbers; a node is an OSM node where signals stand.
  std::map<size_t, int> arms;
  int number = 0;
  for (const StreetEdge& edge : net.edges) {
    const std::vector<Vec2d> line = net.LineOf(edge);
    bool near = false;
    for (Vec2d p : Dense(line, 8)) near = near || map_.data.extent.Contains(p, 40);
    if (!near) continue;
    const int64_t ends[2] = {static_cast<int64_t>(edge.a) + 1, static_cast<int64_t>(edge.b) + 1};
    const std::vector<Vec2d> points = Dense(line, 3);
    std::vector<bool> wet;
    for (Vec2d p : points) wet.push_back(IsWet(p, kWaterside));
    ++number;
    if (std::find(wet.begin(), wet.end(), true) == wet.end()) {
      AddStreet(line, edge.rank, {ends[0], ends[1]}, false);
      ++arms[edge.a];
      ++arms[edge.b];
      continue;
    }
    // Over the water where both banks are near; else streets end before it.
    const bool both = !wet.front() && !wet.back() && !spec_.at_sea() && (edge.rank == 0 || number % 3 == 0);
    for (size_t i = 0; i < points.size();) {
      size_t k = i;
      while (k < points.size() && wet[k] == wet[i]) ++k;
      if (!wet[i] && k - i > 4) {
        const std::vector<Vec2d> part(points.begin() + static_cast<std::ptrdiff_t>(i), points.begin() + static_cast<std::ptrdiff_t>(k));
        AddStreet(Thinned(part), edge.rank, {i == 0 ? ends[0] : next_node_++, k == points.size() ? ends[1] : next_node_++}, false);
      } else if (wet[i] && both && i > 0) {
        const std::vector<Vec2d> part(points.begin() + static_cast<std::ptrdiff_t>(i) - 1,
                                      points.begin() + static_cast<std::ptrdiff_t>(std::min(k + 1, points.size())));
        AddStreet(Thinned(part), edge.rank, {next_node_++, next_node_++}, true);
      }
      i = k;
    }
  }
  // Signals where main streets cross in towns with traffic.
  if (spec_.traffic < 0.6 || spec_.paving == TownPaving::kDirt || spec_.street < 9) return;
  for (const auto& [node, count] : arms)
    if (count >= 4 && Inside_(net.nodes[node], -20) && rng_.Chance(0.7))
      map_.data.nodes.push_back({static_cast<int64_t>(node) + 1, net.nodes[node], TagsOf({{"highway", "traffic_signals"}})});
}

void TownDrawer::AddStreet(const std::vector<Vec2d>& line, int rank, std::vector<int64_t> ends, bool bridge) {
  const auto [half, pavement] = WidthsOf(rank);
  static constexpr const char* kKinds[] = {"tertiary", "residential", "pedestrian", "pedestrian"};
  const char* kind = kKinds[rank];
  const bool dirt = spec_.paving == TownPaving::kDirt;
  if (dirt && rank != 0) kind = "service";
  if (!dirt && rank == 1 && half < 2.6) kind = "living_street";
  TagList tags{{"highway", kind}, {"width", Metres(2 * half)}, {"name", "Street " + std::to_string(map_.streets.size() + 1)}};
  static constexpr const char* kSurfaces[] = {"asphalt", "sett", "sett", "compacted"};
  tags.emplace_back("surface", kSurfaces[static_cast<int>(spec_.paving)]);
  if (pavement == 0) tags.emplace_back("sidewalk", "no");
  if (spec_.cycle_lanes && rank == 0) {
    constexpr double kFourLanes = 10;  // metres from the middle to the kerb: four lanes, two for bicycles, bays
    tags.emplace_back("cycleway", "lane");
    if (half > kFourLanes) tags.emplace_back("lanes", "4");
  }
  if (bridge) tags.emplace_back("bridge", "yes");
  OsmWay way;
  way.id = next_way_++;
  way.tags = TagsOf(tags);
  way.line = line;
  for (size_t i = 0; i < line.size(); ++i) way.nodes.push_back(i == 0 ? ends[0] : i + 1 == line.size() ? ends[1] : next_node_++);
  map_.data.ways.push_back(std::move(way));
  map_.streets.push_back({line, rank, half, pavement, bridge});
}

// What neither streets nor waters need.
Patches TownDrawer::FreeGround() const {
  std::vector<Patch> taken = map_.wet;
  const auto take = [&](const Patches& patches) { taken.insert(taken.end(), patches.begin(), patches.end()); };
  for (const TownStreet& street : map_.streets) take(Band(street.line, street.half + street.pavement, street.half + street.pavement));
  if (!coast_.empty()) take(Band(coast_, kWaterside + 6, 60));
  for (const Patch& patch : map_.wet) {
    std::vector<Vec2d> ring = patch.outer;
    ring.push_back(ring[0]);
    if (!spec_.at_sea()) take(Band(ring, kWaterside, kWaterside));
  }
  const Patches whole{{{{x0_, y0_}, {x1_, y0_}, {x1_, y1_}, {x0_, y1_}}, {}}};
  return Subtract(whole, taken);
}

// Blocks that are large enough, from the middle outwards.
std::vector<size_t> TownDrawer::BlocksForOpenPlaces() const {
  std::vector<std::pair<double, size_t>> order;
  for (size_t i = 0; i < blocks_.size(); ++i)
    if (Area(blocks_[i]) > 700) order.emplace_back(Length(MiddleOf(blocks_[i])), i);
  std::sort(order.begin(), order.end());
  std::vector<size_t> blocks;
  for (const auto& [distance, block] : order) blocks.push_back(block);
  return blocks;
}

// What is left of the blocks takes their place.
void TownDrawer::LayOpenPlaces() {
  const std::vector<size_t> order = BlocksForOpenPlaces();
  OpenPlaces places{std::vector<bool>(blocks_.size(), false), {}};
  size_t at = 0;
  // The terrace's house has the block in the middle.
  if (spec_.terrace && !order.empty()) {
    places.open[order[0]] = true;
    taken_.push_back(blocks_[order[0]]);
    ++at;
  }
  const size_t squares = std::min<size_t>(spec_.squares, order.size()), skip = 3;
  for (size_t n = 0; n < squares && at < order.size(); ++n, at += skip) LaySquareIn(places, order[at], n);
  LayParks(places, order, at);
  std::vector<Patch> left;
  for (size_t i = 0; i < blocks_.size(); ++i)
    if (!places.open[i]) left.push_back(blocks_[i]);
  left.insert(left.end(), places.rest.begin(), places.rest.end());
  blocks_ = std::move(left);
}

void TownDrawer::LaySquareIn(OpenPlaces& places, size_t number_of_block, size_t number) {
  constexpr double kHalfSquare = 31;
  const Patch& block = blocks_[number_of_block];
  places.open[number_of_block] = true;
  const bool whole = Area(block) < 5600;
  const Patches inside = whole ? Patches{block} : Intersect(Patches{block}, SquareAbout(MiddleOf(block), kHalfSquare));
  if (inside.empty()) return;
  const auto largest = std::max_element(inside.begin(), inside.end(), [](const Patch& a, const Patch& b) { return Area(a) < Area(b); });
  LaySquare(*largest, number);
  if (!whole)
    for (const Patch& patch : Subtract(Patches{block}, inside)) places.rest.push_back(patch);
}

// Here and there, off the middle: beyond the first `at` + 1 blocks of `order`.
void TownDrawer::LayParks(OpenPlaces& places, const std::vector<size_t>& order, size_t at) {
  const size_t from = std::min(order.size(), at + 1), left = order.size() - from;
  for (uint64_t n = 0; n < spec_.parks; ++n) {
    if (left == 0) break;
    size_t pick = from + (left * static_cast<size_t>(n) * 2 / (2 * static_cast<size_t>(spec_.parks)) + n) % left;
    for (size_t tries = 0; tries < left && places.open[order[pick]]; ++tries) pick = from + (pick + 1 - from) % left;
    if (places.open[order[pick]]) break;
    places.open[order[pick]] = true;
    const Patch& block = blocks_[order[pick]];
    if (Area(block) < 14000) {
      LayPark(block, static_cast<size_t>(n));
      continue;
    }
    const Patches inside = Intersect(Patches{block}, SquareAbout(MiddleOf(block), spec_.plan == TownPlan::kScattered ? 19 : 50));
    if (inside.empty()) continue;
    LayPark(inside[0], static_cast<size_t>(n));
    for (const Patch& patch : Subtract(Patches{block}, inside)) places.rest.push_back(patch);
  }
}

void TownDrawer::LaySquare(const Patch& patch, size_t number) {
  AddArea(patch.outer, {{"place", "square"}, {"name", "Square " + std::to_string(number + 1)}});
  map_.squares.push_back(patch);
  const Bounds2d box = BoundsOf(patch.outer);
  const Vec2d m = (box.min + box.max) * 0.5;
  // Trees, benches and lamps around the edge.
  const Ring& ring = patch.outer;
  double s = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vec2d a = ring[i], v = ring[(i + 1) % ring.size()] - a;
    const double length = Length(v);
    const Vec2d t = v * (1 / std::max(length, 1e-9)), in{-t.y, t.x};
    for (; s < length; s += 9) {
      const Vec2d p = a + t * s + in * 4.5;
      if (!Inside(patch, p) || DistanceToRing(ring, p) < 3.5) continue;
      if (rng_.Chance(0.75 * spec_.trees)) AddTree(p, 6, 9);
      if (rng_.Chance(0.45)) AddBench(p + in * 2.2 + t * 3.0, in);
      if (rng_.Chance(0.12)) AddNode(p - in * 1.5 + t * 4.0, {{"amenity", "waste_basket"}});
    }
    s -= length;
  }
  if (number == 0 && spec_.fountain)
    AddNode(m, {{"amenity", "fountain"}});
  else if (spec_.style != TownStyle::kTimber)
    AddNode(m, {{"historic", "monument"}, {"name", "Monument"}});
  // Benches around it, and two rows of trees where the square is large.
  for (int k = 0; k < 6; ++k) {
    const double a = 6.283185 * (k + 0.5) / 6;
    const Vec2d out{std::cos(a), std::sin(a)};
    AddBench(m + out * 7.0, k % 2 ? out : out * -1.0);
  }
  for (double y : {-15.0, 15.0})
    for (double x = -18; x <= 18; x += 9)
      if (const Vec2d p = m + Vec2d{x, y}; Inside(patch, p) && DistanceToRing(patch.outer, p) > 8 && rng_.Chance(0.8 * spec_.trees))
        AddTree(p, 6, 8);
  if (spec_.market && number == 0) AddSpot("market", m, {0, 1}, std::min(box.max.x - box.min.x, box.max.y - box.min.y) / 2 - 9);
  if (spec_.cafes) AddSpot("terrace", m, {1, 0}, std::min(box.max.x - box.min.x, box.max.y - box.min.y) / 2 - 6);
}

void TownDrawer::LayPark(const Patch& patch, size_t number) {
  const Bounds2d box = BoundsOf(patch.outer);
  const Vec2d m = (box.min + box.max) * 0.5;
  TagList tags{{"leisure", "park"}, {"name", "Park " + std::to_string(number + 1)}};
  // Else parks without mapped trees are planted.
  if (spec_.trees == 0) tags.emplace_back("trees", "none");
  AddArea(patch.outer, tags);
  const double rx = (box.max.x - box.min.x) / 2, ry = (box.max.y - box.min.y) / 2;
  // A walk across, one around, a pond in the larger ones.
  std::vector<Vec2d> across, around;
  for (int i = 0; i <= 14; ++i) across.push_back({box.min.x + 2 * rx * i / 14, m.y + 0.22 * ry * std::sin(i * 0.55)});
  AddLine(across, {{"highway", "footway"}, {"width", "2.6"}, {"surface", "fine_gravel"}});
  for (int i = 0; i <= 24; ++i) {
    const double a = 6.283185 * i / 24;
    around.push_back({m.x + 0.68 * rx * std::cos(a), m.y + 0.68 * ry * std::sin(a)});
  }
  AddLine(around, {{"highway", "footway"}, {"width", "2.2"}, {"surface", "fine_gravel"}});
  if (spec_.playground && number == 0) {
    const Vec2d c{m.x + 0.3 * rx, m.y + 0.36 * ry};
    AddArea({{c.x - 9, c.y - 6}, {c.x + 9, c.y - 6}, {c.x + 9, c.y + 6}, {c.x - 9, c.y + 6}}, {{"leisure", "playground"}});
  } else if (std::min(rx, ry) > 26) {
    Ring pond;
    for (int i = 0; i < 18; ++i) {
      const double a = 6.283185 * i / 18, r = 1 + 0.14 * std::sin(3 * a + static_cast<double>(number));
      pond.push_back({m.x - 0.3 * rx + 0.2 * rx * r * std::cos(a), m.y + 0.38 * ry + 0.16 * ry * r * std::sin(a)});
    }
    AddArea(pond, {{"natural", "water"}});
  }
  for (int i = 0; i < 24; i += 2)
    if (Inside(patch, around[static_cast<size_t>(i)])) {
      const Vec2d out = (around[static_cast<size_t>(i)] - m) * (1 / std::max(Length(around[static_cast<size_t>(i)] - m), 1e-9));
      AddNode(around[static_cast<size_t>(i)] + out * 2.3, {{"amenity", i % 6 == 0 ? "waste_basket" : "bench"}});
    }
  // Trees between the walks.
  const int count = static_cast<int>(Area(patch) / 110 * spec_.trees);
  for (int tries = 0, made = 0; tries < 6 * count && made < count; ++tries) {
    const Vec2d p{rng_.Uniform(box.min.x, box.max.x), rng_.Uniform(box.min.y, box.max.y)};
    if (!Inside(patch, p) || DistanceToRing(patch.outer, p) < 2.5 || DistanceToLine(across, p) < 3.2 || DistanceToLine(around, p) < 3)
      continue;
    if (spec_.playground && number == 0 && std::abs(p.x - m.x - 0.3 * rx) < 11 && std::abs(p.y - m.y - 0.36 * ry) < 8) continue;
    const double u = (p.x - m.x + 0.3 * rx) / (0.26 * rx), v = (p.y - m.y - 0.38 * ry) / (0.22 * ry);
    if (u * u + v * v < 1) continue;
    AddTree(p, 7, 13);
    ++made;
  }
}

OsmWay& TownDrawer::AddArea(const Ring& ring, const TagList& tags) {
  OsmWay way;
  way.id = next_way_++;
  way.tags = TagsOf(tags);
  way.line = ring;
  way.line.push_back(ring[0]);
  for (size_t i = 0; i < ring.size(); ++i) way.nodes.push_back(next_node_++);
  way.nodes.push_back(way.nodes.front());
  map_.data.ways.push_back(std::move(way));
  return map_.data.ways.back();
}

OsmWay& TownDrawer::AddLine(const std::vector<Vec2d>& line, const TagList& tags) {
  OsmWay way;
  way.id = next_way_++;
  way.tags = TagsOf(tags);
  way.line = line;
  for (size_t i = 0; i < line.size(); ++i) way.nodes.push_back(next_node_++);
  map_.data.ways.push_back(std::move(way));
  return map_.data.ways.back();
}

void TownDrawer::AddNode(Vec2d p, const TagList& tags) { map_.data.nodes.push_back({next_node_++, p, TagsOf(tags)}); }

// A bench that looks to `front`, whatever path is near.
void TownDrawer::AddBench(Vec2d p, Vec2d front) {
  const double compass = std::atan2(front.x, front.y) * 360 / kTau;
  AddNode(p, {{"amenity", "bench"}, {"direction", std::to_string(std::lround(compass < 0 ? compass + 360 : compass))}});
}

void TownDrawer::AddTree(Vec2d p, double least, double most, bool needles) {
  if (spec_.palms || spec_.style == TownStyle::kOchre) {
    // Species that maps' builders do not grow.
    AddSpot(spec_.palms ? "palm" : rng_.Chance(0.55) ? "umbrella_pine" : "cypress", p, {1, 0}, rng_.Uniform(least, most) * 1.25);
    return;
  }
  TagList tags{{"natural", "tree"}, {"height", Metres(rng_.Uniform(least, most))}};
  if (needles) tags.emplace_back("leaf_type", "needleleaved");
  AddNode(p, tags);
}

TownMap DrawTown(const TownSpec& spec, uint64_t seed) { return TownDrawer(spec, seed).Draw(); }

}  // namespace airsim360::internal

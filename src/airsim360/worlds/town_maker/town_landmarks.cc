// Churches, castles, towers; the house with the terrace; what stands along the streets; woods.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/osm/osm_streets.h"
#include "airsim360/worlds/town_maker/town_drawer.h"

namespace airsim360::internal {
namespace {

Ring BoxAt(Vec2d c, Vec2d along, double half_length, double half_width) {
  const Vec2d side{-along.y, along.x};
  return {c - along * half_length - side * half_width, c + along * half_length - side * half_width,
          c + along * half_length + side * half_width, c - along * half_length + side * half_width};
}

Ring Around(Vec2d c, double radius, int corners) {
  Ring ring;
  for (int i = 0; i < corners; ++i)
    ring.push_back({c.x + radius * std::cos(6.283185 * i / corners), c.y + radius * std::sin(6.283185 * i / corners)});
  return ring;
}

}  // namespace

void TownDrawer::BuildLandmarks() {
  if (spec_.terrace) BuildTerraceHouse();
  // The nearest block that is large enough, seen from a square or the middle; taken out of the blocks.
  const auto plot = [&](Vec2d from, double half, Vec2d& c) {
    double best = 1e9;
    for (const Patch& block : blocks_) {
      const Bounds2d box = BoundsOf(block.outer);
      for (double y = box.min.y; y <= box.max.y; y += 4)
        for (double x = box.min.x; x <= box.max.x; x += 4) {
          const Vec2d p{x, y};
          const double far = Length(p - from);
          if (far >= best || !Inside(block, p) || DistanceToRing(block.outer, p) < half || !Inside_(p, half)) continue;
          bool free = true;
          for (const Patch& patch : taken_) free = free && !Inside(patch, p) && DistanceToRing(patch.outer, p) > half;
          if (!free) continue;
          best = far;
          c = p;
        }
    }
    return best < 1e8;
  };
  const auto square = [&](size_t i) {
    if (i >= map_.squares.size()) return Vec2d{0, 0};
    const Bounds2d box = BoundsOf(map_.squares[i].outer);
    return (box.min + box.max) * 0.5;
  };
  Vec2d p{};
  if (spec_.castle && plot({-0.06 * spec_.width, 0.175 * spec_.depth}, 24.5, p)) BuildCastle(p);
  if (spec_.church) {
    const bool small = spec_.plan == TownPlan::kScattered || spec_.width < 250, large = !small && plot(square(0), 14, p);
    if (large || plot(square(0), 11.2, p)) {
      const Vec2d to = square(0) - p;
      BuildChurch(p, Length(to) > 1 ? to * (1 / Length(to)) : Vec2d{1, 0}, !large);
    }
  }
  if (spec_.clock_tower) {
    const Vec2d at = square(0) + Vec2d{9, 13};
    BuildTower(at, 2.6, 24, {{"building:material", "stone"}, {"building:colour", "#c8b99a"}, {"name", "Clock tower"}}, "pyramidal", 5);
  }
  if (spec_.windmill && plot({0.4 * spec_.width, 0.4 * spec_.depth}, 9, p)) {
    taken_.push_back({Around(p, 8, 12), {}});
    AddSpot("windmill", p, {0, -1}, 11);
  }
  if (spec_.ruins)
    for (int i = 0; i < 2; ++i)
      if (plot(i == 0 ? Vec2d{0.2 * spec_.width, 0.12 * spec_.depth} : Vec2d{-0.3 * spec_.width, -0.2 * spec_.depth}, i == 0 ? 16 : 13,
               p)) {
        const double half = i == 0 ? 16 : 13;
        const Ring ring = BoxAt(p, {1, 0}, half, half);
        taken_.push_back({ring, {}});
        AddArea(ring, {{"landuse", "grass"}, {"name", "Ruins"}});
        AddSpot("ruin", p, {0, 1}, half - 3);
      }
}

// A nave and a steeple before it; p is the middle of both.
void TownDrawer::BuildChurch(Vec2d p, Vec2d front, bool small) {
  const double half = small ? 8 : 10.5, wide = small ? 4 : 5.2, wall = small ? 6 : 9;
  std::string colour = "#cfc6b2", roof = "#7a4a38", material = "stone";
  if (spec_.style == TownStyle::kWhitewashed) colour = "#f6f4ee", roof = "#3d6f9e", material = "plaster";
  if (spec_.style == TownStyle::kTimber) colour = "#e9e6dc", roof = "#3f4348", material = "timber";
  if (spec_.style == TownStyle::kAzulejo || spec_.style == TownStyle::kOchre) colour = "#eee4cf", roof = "#a9583a", material = "plaster";
  const Ring nave = BoxAt(p - front * 2.2, front, half, wide), tower = BoxAt(p + front * half, front, 2.2, 2.2),
             whole = BoxAt(p, front, half + 4, wide + 2);
  taken_.push_back({whole, {}});
  // One building of two parts.
  const TagList look{{"building:material", material}, {"building:colour", colour}, {"roof:colour", roof}};
  TagList tags{
      {"building", "church"}, {"name", "Church"}, {"height", Metres(wall + 5.5)}, {"roof:shape", "gabled"}, {"roof:height", "5.5"}};
  tags.insert(tags.end(), look.begin(), look.end());
  AddArea(nave, tags);
  TagList spire{{"building", "church"},
                {"name", "Steeple"},
                {"height", Metres(wall * 2 + 9.0)},
                {"roof:shape", spec_.style == TownStyle::kWhitewashed ? "dome" : "pyramidal"},
                {"roof:height", spec_.style == TownStyle::kWhitewashed ? "2.5" : "8"}};
  spire.insert(spire.end(), look.begin(), look.end());
  AddArea(tower, spire);
  bodies_.emplace_back(p, half + 3);
  bodies_.emplace_back(p + front * half, 5.0);
}

void TownDrawer::BuildTower(Vec2d p, double side, double height, const TagList& tags, const char* roof, double roof_height) {
  TagList all{{"building", "tower"}, {"height", Metres(height)}, {"roof:shape", roof}, {"roof:height", Metres(roof_height)}};
  all.insert(all.end(), tags.begin(), tags.end());
  const Ring ring = BoxAt(p, {1, 0}, side, side);
  AddArea(ring, all);
  taken_.push_back({ring, {}});
  bodies_.emplace_back(p, 1.5 * side);
}

// A keep, a wall around its court, round towers at the corners.
void TownDrawer::BuildCastle(Vec2d p) {
  const double half = 14;
  const TagList stone{{"building:material", "stone"}, {"building:colour", "#b5a98f"}};
  taken_.push_back({BoxAt(p, {1, 0}, half + 3.4, half + 3.4), {}});
  const auto add = [&](const Ring& ring, double height, const char* name, const char* roof, double roof_height) {
    TagList tags{{"building", "castle"}, {"historic", "castle"},    {"name", name}, {"height", Metres(height + roof_height)},
                 {"roof:shape", roof},   {"roof:material", "slate"}};
    if (roof_height > 0) tags.emplace_back("roof:height", Metres(roof_height));
    tags.insert(tags.end(), stone.begin(), stone.end());
    AddArea(ring, tags);
  };
  add(BoxAt(p + Vec2d{0, 5}, {1, 0}, 7, 5), 15, "Keep", "hipped", 4);
  // Walls with a gate in the south.
  add(BoxAt(p + Vec2d{0, half}, {1, 0}, half - 3.3, 1), 8, "Castle wall north", "flat", 0);
  for (int side : {1, -1}) {
    add(BoxAt(p + Vec2d{side * half, 0}, {0, 1}, half - 3.3, 1), 8, side > 0 ? "Castle wall east" : "Castle wall west", "flat", 0);
    add(BoxAt(p + Vec2d{side * 7.3, -half}, {1, 0}, 3.4, 1), 8, side > 0 ? "Castle wall south-east" : "Castle wall south-west", "flat", 0);
    for (int up : {1, -1}) add(Around(p + Vec2d{side * half, up * half}, 3.2, 14), 12, "Castle tower", "cone", up > 0 ? 5 : 4);
  }
  bodies_.emplace_back(p, half + 5);
}

// A building with a deck instead of machines on its roof, as high as half of the others.
void TownDrawer::BuildTerraceHouse() {
  if (taken_.empty()) return;
  const Bounds2d box = BoundsOf(taken_[0].outer);
  const Vec2d m = (box.min + box.max) * 0.5;
  const double half_x = std::min(36.0, (box.max.x - box.min.x) / 2 - 1.5), half_y = std::min(30.0, (box.max.y - box.min.y) / 2 - 1.5),
               height = std::round(spec_.most_floors * 0.6) * 3.6;
  const Ring ring = BoxAt(m, {1, 0}, half_x, half_y);
  AddArea(ring, {{"building", "apartments"},
                 {"name", "Terrace house"},
                 {"height", Metres(height)},
                 {"roof:shape", "hipped"},
                 {"roof:height", "0.05"},
                 {"building:material", "brick"},
                 {"building:colour", "#8c4a36"}});
  map_.spots.push_back({"roof_terrace", m, {half_x, half_y}, height});
}

void TownDrawer::DressStreets() {
  // Cafés where streets are not narrow; arches over lanes; signs of life by rule of the map's builders.
  int terraces = 0, arches = 0;
  for (const TownStreet& street : map_.streets) {
    if (street.bridge) continue;
    double length = 0;
    for (size_t i = 0; i + 1 < street.line.size(); ++i) length += Length(street.line[i + 1] - street.line[i]);
    if (length < 24) continue;
    const size_t i = (street.line.size() - 1) / 2;
    const Vec2d a = street.line[i], v = street.line[i + 1] - a;
    const Vec2d along = v * (1 / std::max(Length(v), 1e-9)), side{-along.y, along.x}, p = a + v * 0.5;
    if (!Inside_(p, 6)) continue;
    if (spec_.arches && street.rank == 2 && arches < 14 && rng_.Chance(0.6)) {
      ++arches;
      AddSpot("arch", p, along, 2 * street.half);
    }
    if (spec_.cafes && street.rank != 2 && street.pavement > 1.7 && terraces < 30 && rng_.Chance(0.4)) {
      ++terraces;
      AddSpot("cafe", p + side * (street.half + street.pavement - 1.0), side * -1.0, 8);
    }
    if (spec_.cafes && street.rank == 2 && rng_.Chance(0.3)) AddSpot("cafe", p + side * (street.half - 1.0), side * -1.0, 6);
    if (spec_.palms && street.rank == 0)
      for (double s = 6; s < Length(v); s += 12)
        for (int hand : {1, -1}) AddSpot("palm", a + along * s + side * (hand * (street.half + 0.9)), {1, 0}, rng_.Uniform(6, 9));
  }
  if (spec_.style == TownStyle::kOchre && !spec_.palms && spec_.trees >= 1.2) PlantStreetRows();
  if (spec_.bus_stops) SetBusStops();
}

// What the builders of maps do not grow along streets: cypresses and umbrella pines.
void TownDrawer::PlantStreetRows() {
  for (const TownStreet& street : map_.streets) {
    if (street.bridge || street.rank > 1 || street.pavement < 2) continue;
    const double length = LengthOf(street.line);
    for (double s = 12; s < length - 12; s += 9) {
      const LinePoint at = PointAt(street.line, s);
      for (int hand : {1, -1}) {
        const Vec2d p = at.p + Vec2d{-at.along.y, at.along.x} * (hand * (street.half + 0.9));
        if (Inside_(p, 2)) AddTree(p, 6, 8);
      }
    }
  }
}

// Pairs of stops by the corners of main streets, or of others where no main street has a pavement for one.
void TownDrawer::SetBusStops() {
  constexpr double kFromCorner = 20, kApart = 140, kShortest = 44, kPavement = 1.3;  // metres
  std::vector<Vec2d> stops;
  for (int rank : {0, 1})
    for (const TownStreet& street : map_.streets) {
      if (street.rank != rank || street.bridge || street.pavement < kPavement || (rank == 1 && !stops.empty())) continue;
      const double length = LengthOf(street.line);
      if (length < kShortest) continue;
      const LinePoint at = PointAt(street.line, kFromCorner);
      const Vec2d p = at.p;
      if (!Inside_(p, 12) || std::ranges::any_of(stops, [&](Vec2d stop) { return Length(stop - p) < kApart; })) continue;
      stops.push_back(p);
      for (int hand : {1, -1}) AddNode(p + Vec2d{at.along.y, -at.along.x} * (hand * (street.half + 0.4)), {{"highway", "bus_stop"}});
    }
}

// Conifers and undergrowth wherever neither houses nor tracks nor water are.
void TownDrawer::PlantWoods() {
  if (spec_.country != TownCountry::kForest) return;
  // Dense forests have neither clearings nor wide gaps.
  const bool dense = spec_.trees > 1.1;
  const double cell = dense ? 4.4 : 5.4;
  for (double y = y0_ - 26; y < y1_ + 26; y += cell)
    for (double x = x0_ - 26; x < x1_ + 26; x += cell) {
      const Vec2d p{x + rng_.Uniform(0, cell), y + rng_.Uniform(0, cell)};
      const double keep = rng_.Uniform(), clearing = std::sin(p.x / 31) * std::cos(p.y / 27) + 0.4 * std::sin(p.x / 13 + p.y / 17);
      if (keep > 0.86 * std::min(1.0, spec_.trees) || (!dense && clearing > 1.12) || IsWet(p, 5)) continue;
      bool free = true;
      for (const auto& body : bodies_) free = free && Length(body.first - p) > body.second + 3.2;
      for (const TownStreet& street : map_.streets) free = free && DistanceToLine(street.line, p) > street.half + 2.6;
      for (const Patch& square : map_.squares) free = free && !Inside(square, p) && DistanceToRing(square.outer, p) > 2;
      for (const TownSpot& spot : map_.spots) free = free && Length(spot.p - p) > 6;
      if (!free) continue;
      TagList tags{{"natural", "tree"}, {"height", Metres(rng_.Uniform(8, 19))}};
      if (rng_.Chance(0.84)) tags.emplace_back("leaf_type", "needleleaved");
      AddNode(p, tags);
      if (rng_.Chance(0.10)) AddNode(p + Vec2d{2.4, 1.1}, {{"natural", "stone"}});
      if (rng_.Chance(0.22)) AddSpot("undergrowth", p + Vec2d{rng_.Uniform(-3, 3), rng_.Uniform(1, 3)}, {1, 0}, 1);
    }
}

}  // namespace airsim360::internal

// Lots and houses: wall to wall along the edges of blocks, apart in gardens, or scattered along tracks.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/town_maker/town_drawer.h"

namespace airsim360::internal {
namespace {

constexpr double kLeastHouse = 20;  // m^2

// The corners of a ring that lie more than `off` metres from the line between their neighbours (Douglas and Peucker).
void Simplify(const Ring& ring, size_t a, size_t b, double off, Ring& out) {
  double farthest = off;
  size_t split = a;
  for (size_t i = a + 1; i < b; ++i) {
    const Vec2d line[] = {ring[a], ring[b % ring.size()]};
    const double d = DistanceToLine(line, ring[i]);
    if (d > farthest) farthest = d, split = i;
  }
  if (split == a) {
    out.push_back(ring[a]);
    return;
  }
  Simplify(ring, a, split, off, out);
  Simplify(ring, split, b, off, out);
}

Ring Simplified(const Ring& ring) {
  if (ring.size() < 4) return ring;
  size_t far = 1;
  for (size_t i = 1; i < ring.size(); ++i)
    if (Length(ring[i] - ring[0]) > Length(ring[far] - ring[0])) far = i;
  Ring out;
  Simplify(ring, 0, far, 0.7, out);
  Simplify(ring, far, ring.size(), 0.7, out);
  return out;
}

Ring Box(Vec2d a, Vec2d along, Vec2d in, double front, double depth) {
  return {a, a + along * front, a + along * front + in * depth, a + in * depth};
}

// Shortest extent of a polygon over its edges' directions.
double Narrowest(const Ring& ring) {
  double narrow = 1e9;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vec2d v = ring[(i + 1) % ring.size()] - ring[i];
    const double length = Length(v);
    if (length < 1) continue;
    double low = 1e9, high = -1e9;
    for (Vec2d p : ring) {
      const double d = (v.x * p.y - v.y * p.x) / length;
      low = std::min(low, d);
      high = std::max(high, d);
    }
    narrow = std::min(narrow, high - low);
  }
  return narrow;
}

}  // namespace

double TownDrawer::Floors() {
  if (spec_.towers && rng_.Chance(0.14))
    return std::round(rng_.Uniform(std::max(14.0, spec_.most_floors), std::max(26.0, 1.6 * spec_.most_floors)));
  // Low ones are more frequent.
  const double u = rng_.Uniform();
  return std::round(spec_.least_floors + (spec_.most_floors - spec_.least_floors) * std::pow(u, 1.4));
}

void TownDrawer::BuildHouses() {
  if (spec_.plan == TownPlan::kScattered) return Scatter();
  // From the middle outwards, where the number of houses is limited.
  std::stable_sort(blocks_.begin(), blocks_.end(), [](const Patch& a, const Patch& b) {
    const auto far = [](const Patch& patch) {
      const Bounds2d box = BoundsOf(patch.outer);
      return Length((box.min + box.max) * 0.5);
    };
    return far(a) < far(b);
  });
  for (const Patch& block : blocks_) {
    if (Full()) return;
    if (Area(block) < 60) continue;
    std::vector<Patch> built = taken_;
    if (spec_.setback > 0)
      Detached(block, built);
    else
      Row(block, built);
  }
}

void TownDrawer::Row(const Patch& block, std::vector<Patch>& built) {
  const HouseStyle& style = StyleOf(spec_.style);
  const Ring ring = Simplified(block.outer);
  const double room = Narrowest(ring), depth0 = room < 1.6 * style.depth ? room : std::min(style.depth, 0.46 * room);
  // Fronts from the longest edge on: short ones get what is left.
  std::vector<size_t> order(ring.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto edge = [&](size_t i) { return ring[(i + 1) % ring.size()] - ring[i]; };
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return Length(edge(a)) > Length(edge(b)); });
  for (size_t i : order) {
    const Vec2d v = edge(i);
    const double length = Length(v);
    if (length < 4) continue;
    const Vec2d along = v * (1 / length), in{-along.y, along.x};
    for (double s = 0; s < length - 1;) {
      double w = rng_.Uniform(style.least_front, style.most_front);
      const double left = length - s;
      if (left < w + 0.6 * style.least_front) w = left;
      const double depth = depth0 * (room < 1.6 * style.depth ? 1 : rng_.Uniform(0.82, 1.1));
      const bool gap = !rng_.Chance(spec_.built);
      if (!gap && !Full()) HouseIn(Box(ring[i] + along * s, along, in, w, depth), block, built);
      s += w;
    }
  }
}

bool TownDrawer::HouseIn(const Ring& ring, const Patch& block, std::vector<Patch>& built) {
  Patches free = Intersect(Patches{block}, Patches{{ring, {}}});
  const Bounds2d box = BoundsOf(ring);
  std::vector<Patch> near;
  for (const Patch& patch : built)
    if (BoundsOf(patch.outer).Overlaps(box)) near.push_back(patch);
  if (!near.empty() && !free.empty()) free = Subtract(free, near);
  if (free.empty()) return false;
  const auto largest = std::max_element(free.begin(), free.end(), [](const Patch& a, const Patch& b) { return Area(a) < Area(b); });
  if (Area(*largest) < kLeastHouse || !largest->holes.empty() || Narrowest(largest->outer) < 3) return false;
  built.push_back(*largest);
  AddHouse(largest->outer);
  return true;
}

void TownDrawer::Detached(const Patch& block, std::vector<Patch>& built) {
  const HouseStyle& style = StyleOf(spec_.style);
  const Ring ring = Simplified(block.outer);
  for (size_t i = 0; i < ring.size() && !Full(); ++i) {
    const Vec2d v = ring[(i + 1) % ring.size()] - ring[i];
    const double length = Length(v);
    if (length < 12) continue;
    const Vec2d along = v * (1 / length), in{-along.y, along.x};
    const double gap = std::clamp(spec_.setback, 2.5, 9.0);
    for (double s = gap; s < length - style.least_front;) {
      const double w = rng_.Uniform(style.least_front, style.most_front), d = style.depth * rng_.Uniform(0.85, 1.2);
      const double back = spec_.setback * rng_.Uniform(0.8, 1.3);
      const Ring house = Box(ring[i] + along * s + in * back, along, in, w, d),
                 around = Box(ring[i] + along * (s - 1.5) + in * (back - 1.5), along, in, w + 3, d + 3);
      s += w + gap * rng_.Uniform(1, 2);
      if (s - gap > length || !rng_.Chance(spec_.built) || Full()) continue;
      const Patches inside = Intersect(Patches{block}, Patches{{house, {}}});
      if (std::abs(Area(inside) - w * d) > 0.5 || !Intersect(built, Patches{{around, {}}}).empty()) continue;
      built.push_back({house, {}});
      AddHouse(house);
      // A hedge or a fence before the garden, a tree in it.
      const Vec2d a = ring[i] + along * (s - w - gap), b = a + along * (w * 0.62);
      if (spec_.setback > 2.5 && rng_.Chance(0.6))
        AddLine({a + in * 0.5, b + in * 0.5}, {{"barrier", rng_.Chance(0.5) ? "hedge" : "fence"}, {"fence_type", "wood"}});
      if (rng_.Chance(0.5 * spec_.trees) && back > 4) AddTree(a + in * (back * 0.45) + along * (w * 0.8), 5, 8);
    }
  }
}

// Whether a house about `c` stands in a street or on its pavement: halls may be deeper than their front is wide.
bool TownDrawer::InStreet(Vec2d c, const Ring& ring) const {
  double reach = 0;
  for (Vec2d p : ring) reach = std::max(reach, Length(p - c));
  return std::ranges::any_of(map_.streets, [&](const TownStreet& street) {
    const double half = street.half + street.pavement;
    return DistanceToLine(street.line, c) < half + reach && !Intersect(Band(street.line, half, half), Patches{{ring, {}}}).empty();
  });
}

// Houses beside tracks, each turned as it likes.
void TownDrawer::Scatter() {
  const HouseStyle& style = StyleOf(spec_.style);
  std::vector<Patch> built = taken_;
  const uint64_t most = spec_.houses > 0 ? spec_.houses : static_cast<uint64_t>(spec_.width * spec_.depth / 2600 * spec_.built);
  for (int tries = 0; tries < 4000 && houses_ < most; ++tries) {
    if (map_.streets.empty()) return;
    const TownStreet& street = map_.streets[rng_.Index(static_cast<uint32_t>(map_.streets.size()))];
    const size_t i = rng_.Index(static_cast<uint32_t>(street.line.size() - 1));
    const Vec2d v = street.line[i + 1] - street.line[i];
    const double length = std::max(Length(v), 1e-6), hand = rng_.Chance(0.5) ? 1 : -1, turn = rng_.Uniform(-0.35, 0.35);
    const Vec2d along = v * (1 / length), out = Vec2d{-along.y, along.x} * hand;
    const Vec2d c = street.line[i] + along * rng_.Uniform(0, length) + out * (street.half + rng_.Uniform(9, 24));
    const Vec2d u{along.x * std::cos(turn) - along.y * std::sin(turn), along.x * std::sin(turn) + along.y * std::cos(turn)},
        n = out.x * -u.y + out.y * u.x > 0 ? Vec2d{-u.y, u.x} : Vec2d{u.y, -u.x};
    const double w = rng_.Uniform(style.least_front, style.most_front), d = style.depth * rng_.Uniform(0.85, 1.15);
    if (!Inside_(c, 0.75 * w) || IsWet(c, 0.75 * w + 5)) continue;
    bool free = true;
    for (const auto& body : bodies_) free = free && Length(body.first - c) > body.second + w * 0.9 + 7;
    for (const TownStreet& other : map_.streets) free = free && DistanceToLine(other.line, c) > other.half + 0.6 * w + 1.5;
    for (const Patch& square : map_.squares) free = free && !Inside(square, c) && DistanceToRing(square.outer, c) > w;
    for (const OsmWay& way : map_.data.ways)
      if (way.tags.Is("leisure", "park")) {
        Ring park = way.line;
        park.pop_back();
        free = free && !Inside({park, {}}, c) && DistanceToRing(park, c) > w;
      }
    if (!free) continue;
    const Vec2d corner = c - u * (w / 2) - n * (d / 2);
    Ring ring = {corner, corner + u * w, corner + u * w + n * d, corner + n * d};
    if (u.x * n.y - u.y * n.x < 0) std::reverse(ring.begin(), ring.end());
    if (!Intersect(built, Patches{{ring, {}}}).empty() || InStreet(c, ring)) continue;
    built.push_back({ring, {}});
    AddHouse(ring);
    AddSpot("porch", c - n * (d / 2), n * -1.0, w);
    // A path to the track.
    const Vec2d door = c - n * (d / 2 + 2.2);
    AddLine({door, c - out * (Length(c - street.line[i]) > 0 ? DistanceToLine(street.line, c) : 0)},
            {{"highway", "path"}, {"width", "1.6"}, {"surface", "ground"}});
  }
}

void TownDrawer::AddHouse(const Ring& ring) {
  const HouseStyle& style = StyleOf(spec_.style);
  const auto pick = [&](std::span<const std::string_view> names) {
    return std::string(names[rng_.Index(static_cast<uint32_t>(names.size()))]);
  };
  ++houses_;
  Vec2d middle{};
  for (Vec2d p : ring) middle = middle + p * (1.0 / static_cast<double>(ring.size()));
  double reach = 0;
  for (Vec2d p : ring) reach = std::max(reach, Length(p - middle));
  bodies_.emplace_back(middle, reach);
  const double floors = Floors(), span = Narrowest(ring);
  const bool tall = floors > 9;
  std::string material = pick(style.materials), roof = tall ? "flat" : pick(style.roofs);
  if (spec_.roofs != TownRoofs::kStyle && !tall) roof = spec_.roofs == TownRoofs::kFlat ? "flat" : rng_.Chance(0.5) ? "hipped" : "gabled";
  // Outlines that are cut have plain roofs.
  if (ring.size() > 6 && roof != "flat") roof = "hipped";
  const double roof_height = roof == "flat"   ? 0
                             : roof == "dome" ? std::min(2.6, 0.35 * span)
                                              : std::min(std::min(span, 16.0) * std::max(style.pitch, 0.22), 6.5);
  TagList tags{{"building", std::string(tall && style.kind != "office" ? "apartments" : style.kind)}};
  tags.emplace_back("height", Metres(floors * (style.kind == "house" ? 2.85 : 3.3) + (style.kind == "house" ? 0.3 : 1.0) + roof_height));
  if (roof == "dome") {  // a house of cubes with a small dome is rare: its walls end level
    tags.emplace_back("roof:shape", "flat");
  } else {
    tags.emplace_back("roof:shape", roof);
  }
  if (roof_height > 0 && roof != "dome") tags.emplace_back("roof:height", Metres(roof_height));
  if (roof == "gabled" && style.kind == "house" && rng_.Chance(0.35)) tags.emplace_back("roof:orientation", "across");
  static constexpr std::string_view kMaterials[] = {"", "roof_tiles", "slate", ""}, kColours[] = {"", "", "#55585c", ""};
  const auto roofs = static_cast<size_t>(spec_.roofs);
  const std::string cover(roofs == 0 ? style.roof_material : kMaterials[roofs]),
      roof_colour = roofs == 0 ? pick(style.roof_colours) : std::string(kColours[roofs]);
  if (!cover.empty() && roof != "flat") tags.emplace_back("roof:material", cover);
  if (!roof_colour.empty() && (roof != "flat" || spec_.style == TownStyle::kWhitewashed)) tags.emplace_back("roof:colour", roof_colour);
  if (tall && spec_.style != TownStyle::kModern) material = rng_.Chance(0.5) ? "concrete" : "glass";
  tags.emplace_back("building:material", material);
  const std::string colour = pick(ColoursOf(spec_.colours).empty() ? style.colours : ColoursOf(spec_.colours));
  const bool own = (material.starts_with("azulejo") && spec_.colours == TownColours::kStyle) || material == "glass" || colour.empty();
  if (!own) tags.emplace_back("building:colour", colour);
  AddArea(ring, tags);
  if (tall && spec_.style == TownStyle::kModern && Area(Patch{ring, {}}) > 500 && ring.size() <= 6 && rng_.Chance(0.75))
    AddTower(ring, middle, floors, material, own ? "" : colour);
}

// Of the house that was added last, a tower on its podium.
void TownDrawer::AddTower(const Ring& ring, Vec2d middle, double floors, const std::string& material, const std::string& colour) {
  OsmTags& base = map_.data.ways.back().tags;
  OsmTags low;
  for (const auto& tag : base.all()) low.Add(tag.first, tag.first == "height" ? Metres(std::round(rng_.Uniform(3, 7)) * 3.6) : tag.second);
  Ring upper;
  const double inset = rng_.Uniform(0.12, 0.24);
  for (Vec2d p : ring) upper.push_back(p + (middle - p) * inset);
  TagList part{
      {"building:part", "yes"}, {"height", std::string(base.Get("height"))}, {"roof:shape", "flat"}, {"building:material", material}};
  if (!colour.empty()) part.emplace_back("building:colour", colour);
  TagList podium{{"building:part", "yes"},
                 {"height", std::string(low.Get("height"))},
                 {"roof:shape", "flat"},
                 {"building:material", rng_.Chance(0.5) ? "stone" : material}};
  AddArea(ring, podium);
  AddArea(upper, part);
  if (floors > 22 && rng_.Chance(0.5)) {
    Ring top;
    for (Vec2d p : ring) top.push_back(p + (middle - p) * (inset + 0.24));
    part[1].second = Metres(floors * 3.3 * rng_.Uniform(1.1, 1.25));
    AddArea(top, part);
  }
}

}  // namespace airsim360::internal

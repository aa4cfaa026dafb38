#include "airsim360/worlds/osm/buildings/osm_building_plans.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "airsim360/base/random.h"
#include "airsim360/worlds/osm/data/line_index.h"

namespace airsim360::internal {
namespace {

constexpr double kStorey = 3.2, kHighest = 1000;

struct RoofName {
  std::string_view name;
  OsmRoof roof;
};
constexpr RoofName kRoofs[] = {
    {"flat", OsmRoof::kFlat},
    {"gabled", OsmRoof::kGabled},
    {"hipped", OsmRoof::kHipped},
    {"half-hipped", OsmRoof::kHalfHipped},
    {"half_hipped", OsmRoof::kHalfHipped},
    {"gambrel", OsmRoof::kGambrel},
    {"mansard", OsmRoof::kMansard},
    {"pyramidal", OsmRoof::kPyramidal},
    {"pyramid", OsmRoof::kPyramidal},
    {"cone", OsmRoof::kCone},
    {"conical", OsmRoof::kCone},
    {"dome", OsmRoof::kDome},
    {"onion", OsmRoof::kOnion},
    {"round", OsmRoof::kRound},
    {"skillion", OsmRoof::kSkillion},
    {"lean_to", OsmRoof::kSkillion},
    {"saltbox", OsmRoof::kSaltbox},
    {"sawtooth", OsmRoof::kSawtooth},
    {"spherical", OsmRoof::kDome},
    {"double_saltbox", OsmRoof::kSaltbox},
    {"quadruple_saltbox", OsmRoof::kMansard},
    {"crosspitched", OsmRoof::kHipped},
};

OsmRoof RoofOf(const OsmTags& tags) {
  const std::string_view name = tags.Get("roof:shape");
  for (const RoofName& row : kRoofs)
    if (row.name == name) return row.roof;
  return OsmRoof::kFlat;
}

// Smallest extent of the outline, roughly: what a roof spans.
double SpanOf(const Patches& patches) {
  double span = 1e9;
  for (const Patch& patch : patches) {
    double longest = 0;
    Vec2d along{1, 0};
    for (size_t i = 0; i < patch.outer.size(); ++i) {
      const Vec2d v = patch.outer[(i + 1) % patch.outer.size()] - patch.outer[i];
      const double length = std::hypot(v.x, v.y);
      if (length > longest) {
        longest = length;
        along = v * (1 / length);
      }
    }
    double low[2] = {1e18, 1e18}, high[2] = {-1e18, -1e18};
    for (Vec2d p : patch.outer) {
      const double c[2] = {p.x * along.x + p.y * along.y, p.y * along.x - p.x * along.y};
      for (int k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], c[k]);
        high[k] = std::max(high[k], c[k]);
      }
    }
    span = std::min({span, high[0] - low[0], high[1] - low[1]});
  }
  return span > 1e8 ? 8 : span;
}

struct Heights {
  std::optional<double> top, bottom;
  HeightSource source = HeightSource::kGuess;
};

double RoofHeightOf(const OsmTags& tags, OsmRoof roof, const Patches& footprint) {
  if (roof == OsmRoof::kFlat) return 0;
  if (const auto tagged = ParseOsmLength(tags.Get("roof:height"), kHighest)) return *tagged;
  const double span = SpanOf(footprint);
  if (const auto angle = ParseOsmNumber(tags.Get("roof:angle"), 1, 85))
    return std::tan(*angle * M_PI / 180) * span * (roof == OsmRoof::kSkillion ? 1 : 0.5);
  if (const auto levels = ParseOsmNumber(tags.Get("roof:levels"), 0.3, 20)) return *levels * 2.8;
  switch (roof) {
    case OsmRoof::kDome:
    case OsmRoof::kRound:
      return span * 0.5;
    case OsmRoof::kOnion:
    case OsmRoof::kCone:
      return span * 0.9;
    case OsmRoof::kSkillion:
    case OsmRoof::kSawtooth:
      return std::min(2.5, span * 0.2);
    default:
      return std::min(6.0, span * 0.32);
  }
}

// Heights as the tags say them.
Heights HeightsOf(const OsmTags& tags, OsmRoof roof, const Patches& footprint) {
  Heights heights;
  for (const char* key : {"height", "building:height", "est_height"}) {
    if (heights.top) break;
    if ((heights.top = ParseOsmLength(tags.Get(key), kHighest))) heights.source = HeightSource::kTag;
  }
  if (!heights.top) {
    if (const auto levels = ParseOsmNumber(tags.Get("building:levels"), 0.3, 250)) {
      heights.top = *levels * kStorey + RoofHeightOf(tags, roof, footprint);
      heights.source = HeightSource::kLevels;
    }
  }
  heights.bottom = ParseOsmLength(tags.Get("min_height"), kHighest);
  if (!heights.bottom)
    if (const auto levels = ParseOsmNumber(tags.Get("building:min_level"), 0.3, 250)) heights.bottom = *levels * kStorey;
  return heights;
}

// Without tags: by what it is used for and by its size.
double GuessHeight(const OsmTags& tags, const std::string& id, double area, double median) {
  static const std::map<std::string_view, double> kTypical = {
      {"garage", 2.8},    {"garages", 2.8},  {"shed", 2.6},        {"hut", 2.8},      {"roof", 4.5},        {"carport", 2.7},
      {"kiosk", 3.2},     {"bungalow", 4.5}, {"house", 7.5},       {"detached", 7.5}, {"terrace", 8.5},     {"residential", 10},
      {"apartments", 16}, {"church", 16},    {"cathedral", 28},    {"chapel", 9},     {"school", 10},       {"industrial", 8},
      {"warehouse", 9},   {"retail", 6},     {"supermarket", 6.5}, {"office", 18},    {"commercial", 14},   {"hotel", 20},
      {"greenhouse", 3},  {"barn", 7},       {"stable", 4},        {"toilets", 3},    {"train_station", 11}};
  const auto it = kTypical.find(tags.Get("building"));
  RngStream rng(0, id);
  const double vary = rng.Uniform(0.9, 1.1);
  if (it != kTypical.end()) return it->second * (it->second > 4 ? vary : 1);
  if (area < 22) return 2.8;
  if (median > 0) return median * vary;
  return (area < 260 ? 7.0 : 9.5) * vary;
}

OsmVolume VolumeOf(const std::string& id, const OsmTags& tags, Patches footprint, double top, double bottom) {
  OsmVolume volume{id, &tags, std::move(footprint), bottom, top, 0, RoofOf(tags), false};
  // A volume has a height, whatever the tags say.
  volume.bottom = std::clamp(volume.bottom, 0.0, kHighest);
  if (volume.top < volume.bottom + 0.05) volume.top = volume.bottom + 0.05;
  volume.roof_height = std::clamp(RoofHeightOf(tags, volume.roof, volume.footprint), 0.0, volume.top - volume.bottom);
  const std::string_view kind = tags.Get(tags.Has("building:part") ? "building:part" : "building");
  volume.canopy = kind == "roof" || kind == "carport" || kind == "canopy";
  return volume;
}

double MedianHeight(const std::vector<OsmBuilding>& buildings) {
  std::vector<double> known;
  for (const OsmBuilding& building : buildings)
    if (building.source != HeightSource::kGuess && Area(building.outline) > 30) known.push_back(building.height);
  if (known.size() < 5) return 0;
  std::nth_element(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2), known.end());
  return known[known.size() / 2];
}

// A square around a building that is only a point on the map.
Patches AroundNode(Vec2d p) { return {{{{p.x - 4, p.y - 4}, {p.x + 4, p.y - 4}, {p.x + 4, p.y + 4}, {p.x - 4, p.y + 4}}, {}}}; }

std::vector<OsmBuilding> ListBuildings(const OsmData& data, const std::vector<OsmArea>& areas) {
  std::vector<OsmBuilding> buildings;
  const auto add = [&](const std::string& id, const OsmTags& tags, Patches outline) {
    OsmBuilding building{id, std::string(tags.Get("name")), &tags, false, std::move(outline), {}, 0, {}};
    buildings.push_back(std::move(building));
  };
  // Outlines of multipolygons that are buildings: their ways add nothing of their own.
  std::set<int64_t> outlines;
  for (const OsmRelation& relation : data.relations) {
    if (!relation.tags.Has("building") || relation.tags.Is("type", "building")) continue;
    for (const OsmMember& member : relation.members)
      if (member.type == 'w') outlines.insert(member.id);
  }
  BoxIndex boxes;
  std::vector<const OsmArea*> known;
  for (const OsmArea& area : areas) {
    if (!area.tags->Has("building")) continue;
    const bool again = !area.relation && outlines.contains(area.number);
    add(area.id, *area.tags, again ? Patches() : area.patches);
    boxes.Add(area.bounds, static_cast<uint32_t>(known.size()));
    known.push_back(&area);
  }
  // Lines that do not close, relations without a shape, and points.
  std::set<std::string> listed;
  for (const OsmBuilding& building : buildings) listed.insert(building.id);
  for (const OsmWay& way : data.ways)
    if (way.tags.Has("building") && !listed.contains(OsmId("way", way.id))) {
      Ring ring = way.line;
      Patches outline;
      if (ring.size() >= 3) outline = Unite(Patches{{ring, {}}});
      add(OsmId("way", way.id), way.tags, std::move(outline));
    }
  for (const OsmRelation& relation : data.relations)
    if (relation.tags.Has("building") && !listed.contains(OsmId("relation", relation.id)))
      add(OsmId("relation", relation.id), relation.tags, {});
  for (const OsmNode& node : data.nodes) {
    if (!node.tags.Has("building")) continue;
    bool inside = false;
    for (uint32_t i : boxes.Find(node.p))
      for (const Patch& patch : known[i]->patches) inside = inside || Inside(patch, node.p);
    add(OsmId("node", node.id), node.tags, inside ? Patches() : AroundNode(node.p));
  }
  return buildings;
}

Vec2d InnerPoint(const Patch& patch) {
  // The middle of the largest triangle.
  Vec2d best = patch.outer[0];
  double largest = -1;
  std::vector<Vec2d> points = patch.outer;
  for (const Ring& hole : patch.holes) points.insert(points.end(), hole.begin(), hole.end());
  const std::vector<uint32_t> triangles = Triangulate(patch);
  for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const Vec2d a = points[triangles[i]], b = points[triangles[i + 1]], c = points[triangles[i + 2]];
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area > largest) {
      largest = area;
      best = (a + b + c) * (1.0 / 3);
    }
  }
  return best;
}

using PartsOf = std::map<size_t, std::vector<const OsmArea*>>;

// Each part's building: the smallest that holds its middle.
PartsOf AssignParts(const std::vector<OsmArea>& areas, const std::vector<OsmBuilding>& buildings, std::vector<const OsmArea*>& orphans) {
  BoxIndex boxes;
  for (size_t i = 0; i < buildings.size(); ++i) {
    Bounds2d box;
    for (const Patch& patch : buildings[i].outline)
      for (Vec2d p : patch.outer) box.Add(p);
    if (!buildings[i].outline.empty()) boxes.Add(box, static_cast<uint32_t>(i));
  }
  PartsOf parts;
  for (const OsmArea& area : areas) {
    if (!area.tags->Has("building:part") || area.patches.empty()) continue;
    if (area.tags->Has("building")) continue;  // drawn as that building's own
    const Vec2d middle = InnerPoint(area.patches[0]);
    size_t owner = buildings.size();
    double smallest = 1e18;
    for (uint32_t i : boxes.Find(middle)) {
      const double size = Area(buildings[i].outline);
      const bool inside =
          std::any_of(buildings[i].outline.begin(), buildings[i].outline.end(), [&](const Patch& patch) { return Inside(patch, middle); });
      if (inside && size < smallest) {
        smallest = size;
        owner = i;
      }
    }
    if (owner < buildings.size())
      parts[owner].push_back(&area);
    else
      orphans.push_back(&area);
  }
  return parts;
}

// The volumes of a building: its parts, and the outline where no part stands near the ground.
void AddVolumes(OsmBuilding& building, const std::vector<const OsmArea*>& parts, double guess) {
  const OsmTags& tags = *building.tags;
  const Heights own = HeightsOf(tags, RoofOf(tags), building.outline);
  const double top = own.top.value_or(guess), bottom = own.bottom.value_or(0);
  building.source = own.source;
  Patches low;
  double lowest_top = top, first_bottom = 1e18;
  for (const OsmArea* part : parts) {
    const Heights heights = HeightsOf(*part->tags, RoofOf(*part->tags), part->patches);
    const double part_bottom = heights.bottom.value_or(0), part_top = heights.top.value_or(std::max(top, part_bottom + 3));
    building.volumes.push_back(VolumeOf(part->id, *part->tags, part->patches, part_top, part_bottom));
    first_bottom = std::min(first_bottom, part_bottom);
    if (part_bottom < 0.5 * top) {
      low.insert(low.end(), part->patches.begin(), part->patches.end());
      lowest_top = std::min(lowest_top, part_top);
    }
  }
  Patches rest = low.empty() ? building.outline : Subtract(building.outline, low);
  if (parts.empty() || Area(rest) > 0.02 * Area(building.outline)) {
    // An outline that is a part itself stands as tagged among the others.
    const bool itself = parts.empty() || tags.Has("building:part");
    const double rest_top = itself ? top : low.empty() ? std::min(top, std::max(first_bottom, bottom + 0.1)) : lowest_top;
    if (!rest.empty()) {
      OsmVolume volume = VolumeOf(building.id, tags, std::move(rest), rest_top, std::min(bottom, rest_top - 0.05));
      if (!itself) {
        volume.roof = OsmRoof::kFlat;
        volume.roof_height = 0;
      }
      building.volumes.push_back(std::move(volume));
    }
  }
  for (const OsmVolume& volume : building.volumes) building.height = std::max(building.height, volume.top);
  if (building.volumes.empty()) building.height = top;
}

}  // namespace

std::vector<OsmBuilding> PlanOsmBuildings(const OsmData& data, const std::vector<OsmArea>& areas) {
  std::vector<OsmBuilding> buildings = ListBuildings(data, areas);
  std::vector<const OsmArea*> orphans;
  const PartsOf parts = AssignParts(areas, buildings, orphans);
  // Those whose height the map tells first: the others are about as high.
  for (OsmBuilding& building : buildings) {
    const Heights own = HeightsOf(*building.tags, RoofOf(*building.tags), building.outline);
    building.source = own.source;
    building.height = own.top.value_or(0);
  }
  const double median = MedianHeight(buildings);
  for (size_t i = 0; i < buildings.size(); ++i) {
    OsmBuilding& building = buildings[i];
    building.height = 0;
    const auto own = parts.find(i);
    AddVolumes(building, own == parts.end() ? std::vector<const OsmArea*>() : own->second,
               GuessHeight(*building.tags, building.id, Area(building.outline), median));
  }
  for (const OsmArea* part : orphans) {
    OsmBuilding building{part->id, std::string(part->tags->Get("name")), part->tags, true, part->patches, {}, 0, {}};
    AddVolumes(building, {}, 6);
    buildings.push_back(std::move(building));
  }
  return buildings;
}

}  // namespace airsim360::internal

// Whether a town has what its words asked for: it is drawn and looked at.
#include <algorithm>
#include <cmath>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/worlds/town_maker/town_map.h"
#include "airsim360/worlds/town_maker/town_words.h"

namespace airsim360 {
namespace {

using internal::OsmNode;
using internal::OsmWay;
using internal::TownMap;

constexpr double kTowerHeight = 40;  // metres
constexpr double kCastleBlock = 84;  // metres between streets that leave room for a castle, mostly
constexpr double kWidestBlock = 130;
constexpr double kLampPavement = 1.25;  // metres
constexpr int kMostGrowths = 6;

uint64_t Ways(const TownMap& map, const char* key, std::string_view value) {
  return static_cast<uint64_t>(std::ranges::count_if(map.data.ways, [&](const OsmWay& way) { return way.tags.Is(key, value); }));
}

uint64_t Spots(const TownMap& map, std::initializer_list<std::string_view> kinds) {
  return static_cast<uint64_t>(std::ranges::count_if(
      map.spots, [&](const internal::TownSpot& spot) { return std::find(kinds.begin(), kinds.end(), spot.kind) != kinds.end(); }));
}

uint64_t Towers(const TownMap& map) {
  return static_cast<uint64_t>(std::ranges::count_if(map.data.ways, [](const OsmWay& way) {
    return (way.tags.Has("building") || way.tags.Has("building:part")) &&
           std::stod("0" + std::string(way.tags.Get("height"))) > kTowerHeight;
  }));
}

// How many of a setting's things a map has.
uint64_t CountOf(const TownMap& map, const std::string& setting) {
  if (setting == "houses") return map.houses;
  if (setting == "parks") return Ways(map, "leisure", "park");
  if (setting == "squares") return map.squares.size();
  if (setting == "church") return Ways(map, "building", "church");
  if (setting == "castle") return Ways(map, "building", "castle");
  if (setting == "clock_tower") return Ways(map, "building", "tower");
  if (setting == "playground") return Ways(map, "leisure", "playground");
  if (setting == "cycle_lanes")
    return static_cast<uint64_t>(std::ranges::count_if(
        map.data.ways, [](const OsmWay& way) { return way.tags.Is("cycleway", "lane") && !way.tags.Is("surface", "compacted"); }));
  if (setting == "bridge") return Ways(map, "bridge", "yes");
  if (setting == "towers") return Towers(map);
  if (setting == "windmill") return Spots(map, {"windmill"});
  if (setting == "market") return Spots(map, {"market"});
  if (setting == "cafes") return Spots(map, {"cafe", "terrace"});
  if (setting == "ruins") return Spots(map, {"ruin"});
  if (setting == "arches") return Spots(map, {"arch"});
  if (setting == "palms") return Spots(map, {"palm"});
  if (setting == "harbour") return Spots(map, {"jetty"});
  if (setting == "terrace") return Spots(map, {"roof_terrace"});
  if (setting == "wires")
    return static_cast<uint64_t>(
        std::ranges::count_if(map.streets, [](const internal::TownStreet& street) { return street.rank == 0 && !street.bridge; }));
  if (setting == "bus_stops")
    return static_cast<uint64_t>(
        std::ranges::count_if(map.data.nodes, [](const OsmNode& node) { return node.tags.Is("highway", "bus_stop"); }));
  if (setting == "lamps")
    return static_cast<uint64_t>(std::ranges::count_if(map.streets, [](const internal::TownStreet& street) {
      return street.rank < 2 && street.pavement > kLampPavement && street.half > 2.6;
    }));
  if (setting == "fountain")
    return static_cast<uint64_t>(
        std::ranges::count_if(map.data.nodes, [](const OsmNode& node) { return node.tags.Is("amenity", "fountain"); }));
  return 1;
}

// What would make room.
std::string Advice(const std::string& setting) {
  if (setting == "arches") return "arches stand over lanes without cars: say 'old' or 'narrow streets'";
  if (setting == "bridge") return "streets cross rivers, canals and lakes on bridges: say 'river', or take another --seed";
  if (setting == "cycle_lanes" || setting == "cafes") return "tracks of earth have neither pavements nor lanes: say 'town' or 'paved'";
  if (setting == "lamps" || setting == "bus_stops") return "they need pavements: say 'town', 'paved' or 'wide streets'";
  if (setting == "houses" || setting == "parks" || setting == "squares") return "say fewer, or a larger area";
  return "say a larger area, or take another --seed";
}

void SayAlso(TownRequest& request, const std::string& words, const std::string& means) {
  for (UnderstoodWords& row : request.words)
    if (words.ends_with(row.words) && row.as != "filler") {
      row.as += means;
      return;
    }
}

std::string Rounded(double value) { return std::to_string(std::lround(value)); }

}  // namespace

void SettleTown(TownRequest& request, uint64_t seed) {
  if (request.promises.empty()) return;
  TownMap map = internal::DrawTown(request.spec, seed);
  for (const TownPromise& promise : request.promises) {
    TownSpec& spec = request.spec;
    const TownSpec before = spec;
    const auto missing = [&] { return CountOf(map, promise.setting) < promise.count; };
    if (!missing()) continue;
    if (promise.setting == "castle") {
      for (double block = std::max(kCastleBlock, spec.block + 8); missing() && block <= kWidestBlock; block += 12) {
        spec.block = block;
        map = internal::DrawTown(spec, seed);
      }
      if (!missing()) SayAlso(request, promise.words, ", block: " + Rounded(spec.block));
    }
    if (promise.setting == "houses" && !request.sized) {
      for (int i = 0; i < kMostGrowths && missing() && std::min(spec.width, spec.depth) < TownSpec::kMostSide; ++i) {
        const double more =
            std::max(1.06, 1.03 * std::sqrt(static_cast<double>(promise.count) / static_cast<double>(std::max<uint64_t>(1, map.houses))));
        for (double* side : {&spec.width, &spec.depth}) *side = std::min(TownSpec::kMostSide, std::round(*side * more));
        map = internal::DrawTown(spec, seed);
      }
      if (!missing()) SayAlso(request, promise.words, ", width: " + Rounded(spec.width) + ", depth: " + Rounded(spec.depth));
    }
    if (!missing()) continue;
    const uint64_t count = CountOf(map, promise.setting);
    throw InputError("'" + promise.words + "': a town of " + Rounded(before.width) + " x " + Rounded(before.depth) + " m with seed " +
                     std::to_string(seed) + " has " + (count == 0 ? "no place for it" : "room for " + std::to_string(count)) + "; " +
                     Advice(promise.setting));
  }
  // What was found earlier is still there in the last drawing.
  for (const TownPromise& promise : request.promises)
    if (CountOf(map, promise.setting) < promise.count)
      throw InputError("'" + promise.words + "': no room for it beside the others; " + Advice(promise.setting));
}

}  // namespace airsim360

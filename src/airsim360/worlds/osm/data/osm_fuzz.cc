// OpenStreetMap files from arbitrary bytes: the first byte tells the format. Anything but an InputError is a
// finding. What parses is planned (areas, buildings) too; the geometry of a whole world takes too long here.
#include <cstddef>
#include <cstdint>

#include "airsim360/base/error.h"
#include "airsim360/worlds/osm/buildings/osm_building_plans.h"
#include "airsim360/worlds/osm/data/patches.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  using namespace airsim360::internal;
  if (size == 0) return 0;
  OsmLimits limits;
  limits.max_nodes = limits.max_ways = limits.max_way_nodes = limits.max_members = 2000;
  limits.max_relations = 200;
  limits.max_tag_bytes = 1 << 18;
  static constexpr const char* kNames[] = {"fuzz.osm", "fuzz.osm.pbf", "fuzz.osm.gz", "fuzz.osm.bz2"};
  const auto* bytes = reinterpret_cast<const std::byte*>(data);
  // An XML file starts with '<': taken as it is, so that seeds are plain files.
  const bool xml = data[0] == '<';
  try {
    const OsmData map = ReadOsm(kNames[xml ? 0 : data[0] % 4], {bytes + (xml ? 0 : 1), size - (xml ? 0 : 1)}, limits);
    const std::vector<OsmArea> areas = FindAreas(map);
    PlanOsmBuildings(map, areas);
    for (const OsmWay& way : map.ways)
      if (way.line.size() > 1 && way.line.size() < 200) Band(way.line, 3, 2);
  } catch (const InputError&) {
  }
  return 0;
}

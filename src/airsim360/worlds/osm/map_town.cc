#include "airsim360/worlds/built_in.h"
#include "airsim360/worlds/osm/osm_scene.h"
#include "airsim360/worlds/osm/town_map.h"

namespace airsim360::internal {

std::shared_ptr<const Scene> BuildMapTown(const WorldOptions& options) {
  return BuildMapScene("map_town", DrawTownMap(options.seed), {.seed = options.seed, .models = options.models}, "");
}

WorldInfo MapTownInfo() {
  const OsmData map = DrawTownMap(0);
  double free = map.extent.width() * map.extent.depth();
  for (const OsmArea& area : FindAreas(map))
    if (area.tags->Has("building")) free -= area.area;
  return {"map_town",
          "outdoor",
          free,
          {"construction/building",
           "construction/building/roof",
           "furniture/lighting/street_light",
           "furniture/mail/post_box",
           "furniture/seating/bench/wood",
           "furniture/utility/fire_hydrant",
           "furniture/waste/trash_can",
           "ground/bike_lane",
           "ground/crosswalk",
           "ground/kerb",
           "ground/lane_marking",
           "ground/manhole",
           "ground/path/park_walkway",
           "ground/pavement/modular",
           "ground/road",
           "ground/sidewalk",
           "ground/terrain/landscape",
           "sky",
           "traffic/control/traffic_light",
           "vegetation/tree/broadleaf/generic",
           "vehicle/bicycle",
           "vehicle/car"},
          "Streets of wall-to-wall houses around a garden, drawn as a map whose lots, heights, trees and lamps measure "
          "as those of real towns; built as maps are"};
}

}  // namespace airsim360::internal

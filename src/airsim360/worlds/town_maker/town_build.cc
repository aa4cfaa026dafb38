#include "airsim360/worlds/town_maker/town_build.h"

#include "airsim360/worlds/osm/osm_scene.h"
#include "airsim360/worlds/town_maker/town_finisher.h"
#include "airsim360/worlds/town_maker/town_surfaces.h"

namespace airsim360::internal {

std::shared_ptr<const Scene> BuildTownScene(const std::string& name, const TownSpec& spec, const WorldOptions& options) {
  spec.Check("town: ");
  const TownMap map = DrawTown(spec, options.seed);
  MapDress dress;
  dress.trees = spec.palms || spec.style == TownStyle::kOchre || spec.country == TownCountry::kForest ? 0 : spec.trees;
  dress.traffic = spec.paving == TownPaving::kDirt ? 0 : spec.traffic;
  dress.yard_trees = spec.trees > 0;
  dress.yard_cars = spec.traffic > 0;
  const bool old = spec.style == TownStyle::kAzulejo || spec.style == TownStyle::kOchre || spec.style == TownStyle::kStone ||
                   spec.style == TownStyle::kWhitewashed;
  if (old) dress.lamp = "lamp_post";
  if (!spec.lamps) dress.lamp = nullptr;
  dress.town_around = spec.country == TownCountry::kCity;
  dress.paint = [&](SceneBuilder& builder, Surfaces& surfaces, MapDress& own) { PaintTown(spec, builder, surfaces, own); };
  dress.finish = [&](OsmScene& scene, const std::vector<OsmBuilding>&, const Neighbours& near) {
    TownFinisher(spec, map, scene).Run(near);
  };
  OsmOptions osm{.seed = options.seed, .models = options.models};
  if (!map.heights.heights.empty()) osm.heights = [&](const GeoBox&) { return map.heights; };
  return BuildMapScene(name, map.data, osm, "", nullptr, &dress);
}

}  // namespace airsim360::internal

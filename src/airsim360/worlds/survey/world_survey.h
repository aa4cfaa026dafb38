// The structural counts of a world: what makes a place believable, counted on the scene itself.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "airsim360/scene/scene.h"

namespace airsim360 {

/// Counts over a scene of the procedural cities. "Inside" is the box around all crosswalks, 20 m wider
/// (without crosswalks: around the mesh "ground"); backdrop is what lies outside of it within 600 m of its
/// middle.
struct WorldSurvey {
  SceneCounts counts;
  double ground_area_m2 = 0;  ///< of the box that is inside
  int buildings_inside = 0, buildings_backdrop = 0;
  int lamp_posts = 0, cars = 0, manholes = 0;        ///< inside
  int trees = 0, tree_species = 0, tree_meshes = 0;  ///< trees inside; species and individual meshes used
  double road_m = 0, pavement_m = 0;                 ///< longest sides of road segments, pavement fields inside
  std::map<std::string, int> categories;             ///< entities by category path
};
WorldSurvey SurveyWorld(const Scene& scene);

}  // namespace airsim360

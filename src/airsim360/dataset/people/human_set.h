// Omni360-Human: many small sets of people in areas of several worlds, after the paper's table of subsets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "airsim360/people/navigation/navmesh.h"
#include "airsim360/sim/fly_route.h"
#include "airsim360/sim/people/people.h"

namespace airsim360 {

/// One row of the table: subsets of one scene, areas and crowds from the smallest to the largest.
struct HumanScene {
  std::string scene;  ///< the paper's name
  std::string world;  ///< of this program: a name or a path; subsets of worlds that do not exist are left out
  uint64_t subsets = 1;
  double least_width = 12, least_depth = 12, most_width = 30, most_depth = 30;  ///< metres
  uint64_t least_people = 8, most_people = 30;
  uint64_t frames = 1000;  ///< of all its subsets together
};

/// A recipe: the table, and how frames are taken.
struct HumanRecipe {
  std::vector<HumanScene> scenes;
  std::vector<std::string> pitches_deg = {"0", "20", "45"};  ///< camera pitch below the horizon, by turns
  double interval = 0.5;                                     ///< seconds between frames
  double lowest = 1.6, highest = 8;                          ///< metres of the camera above the ground
  uint64_t frames_a_view = 20;                               ///< before the camera goes elsewhere
  double moving = 0;                                         ///< share of the views during which the camera flies, 0.5 to 2 m/s
  std::string cameras = {};  ///< file of a rig (docs/reference/cameras.md) instead of one camera; empty = one
};

/// The paper's table (appendix, Omni360-Human): 61 subsets, 100,700 frames, six scenes.
HumanRecipe PaperHumanRecipe();
/// From YAML with the fields above; InputError file:line for what is wrong.
HumanRecipe ReadHumanRecipe(const std::filesystem::path& file);

/// One set of frames.
struct HumanSubset {
  std::string world, name;  ///< name: "new_york_city/03"
  double width = 12, depth = 12;
  uint64_t people = 8;
  double pitch_deg = 0;
  int64_t frames = 100;
  std::string split = "train";  ///< "train", "val" or "test"
};
/// All subsets of a recipe: sizes and numbers grow evenly from the least to the most, pitches by turns. Of ten subsets of a scene two
/// are of split test and one is of split val, spread over the sizes and pitches.
std::vector<HumanSubset> SubsetsOf(const HumanRecipe& recipe);

/// Where a subset is: an upright rectangle, corners counter-clockwise.
struct HumanArea {
  Vec2d low, high;
  double ground = 0;  ///< height of the mesh in its middle
};
/// The liveliest of 96 rectangles of the subset's size: of those of which at least 60 % as much can be walked on as on the most
/// open one, the one with the most kinds of everyday things in and around it, as its streets look. Nothing of it
/// is within kSplitGap of `apart`. A pure function of its arguments. InputError if there is no place for the people (2 m^2 each).
HumanArea PickArea(const Scene& scene, const NavMesh& mesh, const HumanSubset& subset, uint64_t seed,
                   std::span<const HumanArea> apart = {});

/// Metres between areas of different splits: cameras stand up to 4 m beside their own.
inline constexpr double kSplitGap = 8;

/// people.yaml of an area and a number of people.
std::string PeopleFileOf(const HumanArea& area, uint64_t people);

/// Frames of a subset: the camera hovers over or beside the area, at least 1 m from every surface of `world`
/// (the scene without people), where it sees people best of 32 places, and looks a little downwards; the people go on living
/// and notice it. In the share `moving` of the views, spread evenly, it flies straight on as far as the way is free.
Flight FilmSubset(const HumanRecipe& recipe, const HumanSubset& subset, const HumanArea& area, const SimPeople& people,
                  const RayTracer& world, uint64_t seed);

}  // namespace airsim360

// What a dataset is to hold: rows of worlds, how many frames of each, where from, under which skies.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "airsim360/base/config.h"
#include "airsim360/dataset/people/human_set.h"
#include "airsim360/dataset/record/spec.h"
#include "airsim360/routes/roadmap.h"

namespace airsim360 {

/// How the cameras of a row are placed.
enum class Sampler {
  kViewpoints,  ///< low-discrepancy places over the ground and the logarithm of the height
  kFlights,     ///< flights of the waypoint generator, cut at equal parallax
  kPeople,      ///< beside an area full of people, as Omni360-Human
};
inline constexpr const char* kSamplerNames[] = {"viewpoints", "flights", "people"};

/// A number of the environment, or the exposure, drawn evenly from a range.
struct SettingRange {
  std::string setting;  ///< of EnvironmentFields(), or kExposureSetting: stops on top of those of the picture
  double low = 0, high = 0;
};

inline constexpr char kExposureSetting[] = "exposure";

/// One kind of sky of a mixture.
struct SkyChoice {
  double weight = 1;
  std::string weather;                 ///< a preset; empty: the world's own environment
  bool climate = false;                ///< instead: date, hour, clouds and weather by lot, SampleEnvironment of…
  double latitude_deg = 45;            ///< … this latitude
  double least_sun_elevation_deg = 2;  ///< … and with the sun so high
  std::vector<SettingRange> settings;  ///< drawn over it
};

/// Skies by lot. Consecutive frames share one, because a sky takes seconds to prepare.
struct SkyMixture {
  std::string name;
  uint64_t frames = 64;  ///< that share one sky
  std::vector<SkyChoice> choices;
};

/// One row: frames of one world.
struct RecipeRow {
  std::string name;   ///< unique; seeds everything random of the row
  std::string world;  ///< name or file
  uint64_t world_seed = 0;
  uint64_t frames = 0;
  std::string sampler = "viewpoints";
  std::string skies = "varied";                 ///< name of a mixture
  std::vector<std::string> area;                ///< [x0, y0, x1, y1] metres; empty: where the things of the world are
  double lowest = 1.6, highest = 120;           ///< metres above the ground
  double clearance = 1;                         ///< metres to every surface
  double tilt_deg = 0;                          ///< of the body: pitch and roll are drawn from ± this
  uint64_t flight_frames = 20;                  ///< flights: frames of each
  double least_length = 50, most_length = 150;  ///< flights: metres
  uint64_t people = 0;                          ///< in the world; sampler people: in the area
  double width = 20, depth = 20;                ///< people: of the area, metres
  double pitch_deg = 0;                         ///< people: of the camera, below the horizon
  double interval = 0.5;                        ///< people: seconds between frames
  uint64_t view_frames = 20;                    ///< people: before the camera goes elsewhere
};

/// What a frame is: the fields of DatasetSpec::Visit, the size of the panorama and further products.
struct RecipePicture {
  DatasetSpec settings = {};
  std::string size = "2048x1024";
  std::vector<std::string> products = {};
};
/// Names its fields.
void VisitPicture(ConfigVisitor& v, RecipePicture& picture);
/// Its fields and their values as a JSON object.
std::string PictureJson(RecipePicture picture);

struct Recipe {
  std::string name;
  std::string about;
  RecipePicture picture;
  std::vector<SkyMixture> skies;
  std::vector<RecipeRow> rows;

  int64_t frames() const;
};

/// Names the fields of a recipe: of users' files, and of the plan that keeps it.
void VisitRecipe(ConfigVisitor& v, Recipe& recipe);
/// InputError naming `where` (a file), the row and the value for what makes no sense.
void CheckRecipe(const Recipe& recipe, const std::string& where);
/// InputError after `where` if skies draw the exposure of pictures that find their own.
void CheckExposures(const Recipe& recipe, const PictureSettings& picture, const std::string& where);

/// The rectangle of a row's `area`; InputError beginning with `where` if it is none.
Box2d AreaOf(const RecipeRow& row, const std::string& where);

/// A built-in recipe, or a YAML file. InputError naming the nearest name, or file:line.
Recipe FindRecipe(const std::string& name_or_file);
std::vector<std::string> RecipeNames();

/// Only the rows of these worlds. InputError naming the nearest if the recipe has none of one.
Recipe WithWorlds(Recipe recipe, const std::vector<std::string>& worlds);
/// All rows scaled to `frames` in total, each in proportion, what is left over to the largest remainders. InputError if there
/// are fewer frames than rows.
Recipe Scaled(Recipe recipe, int64_t frames);

/// Largest number of frames of a recipe.
inline constexpr int64_t kMostPlanFrames = 10'000'000;

}  // namespace airsim360

#include "airsim360/app/flags/world_flags.h"

#include <cmath>
#include <cstdio>
#include <optional>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/dataset/record/spec.h"
#include "airsim360/math/geodesy.h"
#include "airsim360/math/place_text.h"

namespace airsim360 {
namespace {

constexpr double kFarthest = 100'000;  // metres of a place from the origin

bool HasCut(const GlobalOptions& globals) { return !globals.bbox.empty() || !globals.centre.empty() || globals.radius != 0; }

}  // namespace

void AddBoxFlag(CLI::App& command, GlobalOptions& globals) {
  command.add_option("--bbox", globals.bbox,
                     "maps: only this piece, SOUTH,WEST,NORTH,EAST in degrees (also in OpenStreetMap's order WEST,SOUTH,EAST,NORTH)");
}

void AddWorldFlags(CLI::App& command, GlobalOptions& globals) {
  command.add_option("--labels", globals.labels, "label file: categories by name patterns (docs/guide/labels.md)")
      ->check(CLI::ExistingFile);
  AddBoxFlag(command, globals);
  command.add_option("--centre", globals.centre, "maps: only a square around LAT,LON in degrees, --radius metres to each side");
  command.add_option("--radius", globals.radius, "maps: of --centre, 10 … 30000 metres");
}

WorldRequest RequestOf(const std::string& world, const GlobalOptions& globals) {
  WorldRequest request{.world = world, .seed = globals.seed, .labels = globals.labels};
  request.cut = MapCutOf("--", globals.bbox, globals.centre, globals.radius);
  return request;
}

std::string DescribeWorld(const std::string& world, const GlobalOptions& globals) {
  if (!HasCut(globals)) return world;
  return world + " " + MapCutOf("--", globals.bbox, globals.centre, globals.radius)->text;
}

void DescribeRun(const char* command, const std::string& world, const GlobalOptions& globals, DatasetSpec& spec) {
  spec.command = command;
  spec.world = DescribeWorld(world, globals);
  spec.seed = globals.seed;
  spec.labels = DescribeLabels(globals);
}

std::string WithPlace(const char* flag, const std::string& text, const WorldRequest& request) {
  const size_t comma = text.find(','), next = comma == std::string::npos ? comma : text.find(',', comma + 1);
  if (comma == std::string::npos) return text;
  const std::string place = text.substr(0, next);
  const auto on_earth =
      ParseLatitudeLongitude(text.substr(0, comma), text.substr(comma + 1, next == std::string::npos ? next : next - comma - 1),
                             std::string(flag) + ": '" + place + "'");
  if (!on_earth) return text;
  const std::optional<GeoPoint> origin = OriginOfWorld(request);
  if (!origin)
    throw InputError(std::string(flag) + ": '" + place + "': the world '" + request.world +
                     "' has no place on the Earth (maps have); give x,y in metres");
  const Vec3d p = GeoFrame({origin->latitude_deg, origin->longitude_deg, 0}).ToWorld(*on_earth);
  char numbers[160];
  if (!(std::hypot(p.x, p.y) <= kFarthest) || p.z < -kFarthest) {
    std::snprintf(numbers, sizeof(numbers), "' lies more than %.0f km from the middle of the map, %.6f,%.6f", kFarthest / 1000,
                  origin->latitude_deg, origin->longitude_deg);
    throw InputError(std::string(flag) + ": '" + place + numbers);
  }
  std::snprintf(numbers, sizeof(numbers), "%.4f,%.4f", p.x, p.y);
  return numbers + (next == std::string::npos ? "" : text.substr(next));
}

}  // namespace airsim360

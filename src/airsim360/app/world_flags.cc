#include "airsim360/app/world_flags.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>

#include "airsim360/base/error.h"
#include "airsim360/math/geodesy.h"

namespace airsim360 {
namespace {

constexpr double kFarthest = 100'000;  // metres of a place from the origin

// Degrees of "60.1708N": positive north and east; `axis` becomes 'N' or 'E'.
std::optional<double> Degrees(std::string text, char& axis) {
  while (!text.empty() && text.front() == ' ') text.erase(text.begin());
  while (!text.empty() && text.back() == ' ') text.pop_back();
  if (text.size() < 2) return std::nullopt;
  const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(text.back())));
  if (letter != 'N' && letter != 'S' && letter != 'E' && letter != 'W') return std::nullopt;
  double value = 0;
  const char* const end = text.data() + text.size() - 1;
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  axis = letter == 'N' || letter == 'S' ? 'N' : 'E';
  return letter == 'S' || letter == 'W' ? -value : value;
}

bool HasCut(const GlobalOptions& globals) { return !globals.bbox.empty() || !globals.centre.empty() || globals.radius != 0; }

}  // namespace

void AddBoxFlag(CLI::App& command, GlobalOptions& globals) {
  command.add_option("--bbox", globals.bbox, "maps: only this piece, SOUTH,WEST,NORTH,EAST in degrees (also in OpenStreetMap's order WEST,SOUTH,EAST,NORTH)");
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

std::string WithPlace(const char* flag, const std::string& text, const WorldRequest& request) {
  const size_t comma = text.find(','), next = comma == std::string::npos ? comma : text.find(',', comma + 1);
  if (comma == std::string::npos) return text;
  char axis[2] = {};
  const auto one = Degrees(text.substr(0, comma), axis[0]);
  const auto two = Degrees(text.substr(comma + 1, next == std::string::npos ? next : next - comma - 1), axis[1]);
  if (!one && !two) return text;
  const std::string place = text.substr(0, next);
  const double latitude = axis[0] == 'N' ? one.value_or(0) : two.value_or(0), longitude = axis[0] == 'N' ? two.value_or(0) : one.value_or(0);
  if (!one || !two || axis[0] == axis[1] || std::abs(latitude) > 90 || std::abs(longitude) > 180)
    throw InputError(std::string(flag) + ": '" + place + "' is not a latitude and a longitude in degrees, for example 60.1708N,24.9375E");
  const std::optional<GeoPoint> origin = OriginOfWorld(request);
  if (!origin)
    throw InputError(std::string(flag) + ": '" + place + "': the world '" + request.world + "' has no place on the Earth (maps have); give x,y in metres");
  const Vec3d p = GeoFrame({origin->latitude_deg, origin->longitude_deg, 0}).ToWorld({latitude, longitude, 0});
  char numbers[160];
  if (!(std::hypot(p.x, p.y) <= kFarthest) || p.z < -kFarthest) {
    std::snprintf(numbers, sizeof(numbers), "' lies more than %.0f km from the middle of the map, %.6f,%.6f", kFarthest / 1000, origin->latitude_deg, origin->longitude_deg);
    throw InputError(std::string(flag) + ": '" + place + numbers);
  }
  std::snprintf(numbers, sizeof(numbers), "%.4f,%.4f", p.x, p.y);
  return numbers + (next == std::string::npos ? "" : text.substr(next));
}

}  // namespace airsim360

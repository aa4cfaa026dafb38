#include "airsim360/dataset/waypoint_part.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "airsim360/planning/export/npz.h"
#include "airsim360/planning/number_text.h"

namespace airsim360::internal {
namespace {

void Append(std::vector<double>& out, Vec3d v) { out.insert(out.end(), {v.x, v.y, v.z}); }

}  // namespace

std::string EncodePart(std::span<const WaypointRoute> routes, const PartName& part) {
  std::vector<double> waypoints, durations, coefficients, samples;
  std::vector<int64_t> waypoint_offset = {0}, segment_offset = {0}, sample_offset = {0};
  const double interval = KinematicSets()[part.set].interval;
  size_t powers = 8;
  for (const WaypointRoute& route : routes) {
    const CertifiedFlight& flight = route.flights[part.set];
    const PolynomialTrajectory& path = flight.flight.trajectory;
    powers = static_cast<size_t>(path.degree()) + 1;
    for (const Vec3d p : flight.waypoints) Append(waypoints, p);
    durations.insert(durations.end(), path.durations().begin(), path.durations().end());
    coefficients.insert(coefficients.end(), path.coefficients().begin(), path.coefficients().end());
    for (const double t : SampleTimes(path.duration(), interval)) {
      const TrajectoryPoint point = path.At(t);
      samples.push_back(t);
      for (const Vec3d v : {point.p, point.v, point.a}) Append(samples, v);
    }
    waypoint_offset.push_back(static_cast<int64_t>(waypoints.size() / 3));
    segment_offset.push_back(static_cast<int64_t>(durations.size()));
    sample_offset.push_back(static_cast<int64_t>(samples.size() / 10));
  }
  NpzWriter npz;
  npz.Add("waypoints", waypoints, {waypoints.size() / 3, 3});
  npz.Add("waypoint_offset", waypoint_offset, {waypoint_offset.size()});
  npz.Add("durations", durations, {durations.size()});
  npz.Add("segment_offset", segment_offset, {segment_offset.size()});
  npz.Add("coefficients", coefficients, {durations.size(), 3, powers});
  npz.Add("samples", samples, {samples.size() / 10, 10});
  npz.Add("sample_offset", sample_offset, {sample_offset.size()});
  return npz.Finish();
}

std::string PartRows(std::span<const WaypointRoute> routes, const PartName& part) {
  std::string out;
  const KinematicSet& set = KinematicSets()[part.set];
  for (size_t row = 0; row < routes.size(); ++row) {
    const CertifiedFlight& flight = routes[row].flights[part.set];
    const PolynomialTrajectory& path = flight.flight.trajectory;
    const int64_t route = part.first_route + static_cast<int64_t>(row);
    const size_t samples = SampleTimes(path.duration(), set.interval).size();
    for (const std::string& word : {part.world.name + "/" + set.name + "/" + std::to_string(route), part.world.name, set.name,
                                    std::to_string(route), std::to_string(part.number), std::to_string(row)})
      out += word + ",";
    const Vec3d a = path.At(0).p, b = path.At(path.duration()).p;
    const double values[] = {routes[row].lengths[part.set],
                             path.duration(),
                             static_cast<double>(path.segments()),
                             static_cast<double>(samples),
                             flight.flight.peaks.speed.value,
                             flight.flight.peaks.acceleration.value,
                             flight.certificate.least_clearance,
                             flight.flight.lower_bound,
                             a.x,
                             a.y,
                             a.z,
                             b.x,
                             b.y,
                             b.z};
    AppendNumbers(out, values, ",");
    out += '\n';
  }
  return out;
}

namespace {

// Least, mean, greatest and a histogram of twelve bins of one column.
struct Column {
  std::vector<double> values;
  nlohmann::ordered_json ToJson() const {
    constexpr int kBins = 12;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    double sum = 0;
    std::vector<int64_t> bins(kBins);
    for (const double v : values) {
      sum += v;
      const double part = *high > *low ? (v - *low) / (*high - *low) : 0;
      ++bins[static_cast<size_t>(std::min(kBins - 1.0, part * kBins))];
    }
    return {{"min", *low}, {"mean", sum / static_cast<double>(values.size())}, {"max", *high}, {"histogram", bins}};
  }
};

}  // namespace

std::string Statistics(std::string_view index) {
  constexpr const char* kColumns[] = {"length_m", "duration_s", "segments", "samples", "max_speed", "max_acceleration", "least_clearance"};
  std::map<std::string, std::vector<Column>> groups;
  int64_t flights = 0, samples = 0;
  for (size_t at = index.find('\n') + 1; at < index.size();) {
    const size_t end = std::min(index.find('\n', at), index.size());
    const std::string line(index.substr(at, end - at));
    at = end + 1;
    // id is WORLD/SET/ROUTE; the numbers begin with the seventh column.
    const std::string group = line.substr(0, line.find('/', line.find('/') + 1));
    size_t from = 0;
    for (int skip = 0; skip < 6; ++skip) from = line.find(',', from) + 1;
    auto& columns = groups.try_emplace(group, std::size(kColumns)).first->second;
    for (size_t i = 0; i < std::size(kColumns); ++i) {
      columns[i].values.push_back(std::strtod(line.c_str() + from, nullptr));
      from = line.find(',', from) + 1;
    }
    ++flights;
    samples += static_cast<int64_t>(columns[3].values.back());
  }
  nlohmann::ordered_json json = {{"flights", flights}, {"samples", samples}};
  for (const auto& [group, columns] : groups) {
    nlohmann::ordered_json entry = {{"flights", columns[0].values.size()}};
    for (size_t i = 0; i < std::size(kColumns); ++i) entry[kColumns[i]] = columns[i].ToJson();
    json[group] = entry;
  }
  return json.dump(2) + "\n";
}

std::string WaypointReadme(const WaypointSetOptions& options, std::string_view statistics) {
  const auto json = nlohmann::ordered_json::parse(statistics);
  std::string out =
      "# Omni360-WayPoint\n\nRandom flights of a drone through worlds of AirSim360: minimum snap (degree 7), "
      "at rest at both ends,\n"
      "certified maxima of speed and acceleration within the limits, and a continuous proof that a ball of "
      "radius " +
      std::to_string(options.radius).substr(0, 5) + " m touches\nnothing. Seed " + std::to_string(options.seed) +
      ".\n\n| world and set | flights | length m | duration s | top speed m/s | least clearance m "
      "|\n|---|---|---|---|---|---|\n";
  char row[256];
  for (const auto& [name, group] : json.items()) {
    if (!group.is_object()) continue;
    std::snprintf(row, sizeof(row), "| %s | %lld | %.1f … %.1f | %.1f … %.1f | %.2f | %.3f |\n", name.c_str(),
                  static_cast<long long>(group["flights"]), double(group["length_m"]["min"]), double(group["length_m"]["max"]),
                  double(group["duration_s"]["min"]), double(group["duration_s"]["max"]), double(group["max_speed"]["max"]),
                  double(group["least_clearance"]["min"]));
    out += row;
  }
  out +=
      "\nA set `a3_v16_t0.5` has at most 3 m/s² and 16 m/s and a sample every 0.5 s.\n\n"
      "`index.csv` has a row a flight; its arrays are row `row` of `WORLD/SET/part-NNNN.npz` (numpy.load):\n"
      "`waypoints[waypoint_offset[row]:waypoint_offset[row + 1]]`, likewise `durations` and `coefficients` "
      "(segment, axis,\n"
      "ascending power of local time) with `segment_offset`, and `samples` (t, p, v, a) with "
      "`sample_offset`.\n"
      "Metres, seconds, x east, y north, z up. `WORLD/routes.svg` shows the first routes.\n";
  return out;
}

}  // namespace airsim360::internal

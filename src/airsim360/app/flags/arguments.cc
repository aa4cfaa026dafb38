#include "airsim360/app/flags/arguments.h"

#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/text.h"
#include "airsim360/flight/drones/catalog.h"
#include "airsim360/flight/prompt/drone_file.h"
#include "airsim360/math/coordinate_limit.h"

namespace airsim360 {
namespace {

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  size_t begin = 0;
  while (true) {
    const size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    if (end == text.size()) return parts;
    begin = end + 1;
  }
}

// The whole of `text` as a number; false if it is anything else.
template <class Number>
bool ParseNumber(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

PoseArgument ParsePose(const std::string& text) {
  const std::vector<std::string> parts = Split(text, ',');
  double values[6] = {};
  bool good = parts.size() >= 3 && parts.size() <= 6;
  for (size_t i = 0; good && i < parts.size(); ++i) {
    good = ParseNumber(std::string(Trimmed(parts[i], " \t")), values[i]) && std::isfinite(values[i]);
  }
  if (!good) {
    throw InputError("--pose: '" + text + "' is not x,y,z[,yaw_deg[,pitch_deg[,roll_deg]]] in metres and degrees");
  }
  for (const double value : values) {
    if (std::fabs(value) > kCoordinateLimit) throw InputError("--pose: '" + text + "': " + BeyondLimitText(value));
  }
  return {{values[0], values[1], values[2]}, values[3], values[4], values[5]};
}

std::vector<std::string> ParseList(std::string_view flag, const std::string& text, const std::vector<std::string>& choices) {
  std::vector<std::string> parts = Split(text, ',');
  for (const std::string& part : parts) ParseChoice("value", part, choices, flag);
  return parts;
}

Shard ParseShard(const std::string& text) {
  Shard shard;
  const std::vector<std::string> parts = Split(text, '/');
  if (parts.size() != 2 || !ParseNumber(parts[0], shard.index) || !ParseNumber(parts[1], shard.count) || shard.index < 0 ||
      shard.count < 1 || shard.index >= shard.count)
    throw InputError("--shard: '" + text + "' is not I/N with I from 0 to N - 1, for example 0/4");
  return shard;
}

double CheckPositive(const char* flag, double value) {
  if (value > 0 && std::isfinite(value)) return value;
  if (value == 0) throw InputError(std::string(flag) + ": missing or 0; give a number above zero");
  char text[96];
  std::snprintf(text, sizeof(text), "%s: %g is not a number above zero", flag, value);
  throw InputError(text);
}

std::vector<double> ParseNumbers(const char* flag, const std::string& text, size_t count, const char* form) {
  std::vector<double> values;
  const char* p = text.data();
  const char* const end = p + text.size();
  while (p < end) {
    double value;
    const auto [stop, error] = std::from_chars(p, end, value);
    if (error != std::errc() || !std::isfinite(value) || (stop != end && *stop != ',')) break;
    if (std::fabs(value) > kCoordinateLimit) throw InputError(std::string(flag) + ": '" + text + "': " + BeyondLimitText(value));
    values.push_back(value);
    p = stop == end ? end : stop + 1;
    if (stop != end && p == end) p = nullptr;  // a comma at the end
    if (p == nullptr) break;
  }
  if (p != end || values.size() != count) throw InputError(std::string(flag) + ": '" + text + "' is not " + form);
  return values;
}

DroneModel FindDrone(const std::string& text) {
  for (const CatalogDrone& drone : DroneCatalog()) {
    if (drone.name == text) return CatalogModel(text);
  }
  if (text.ends_with(".yaml") || text.ends_with(".yml")) return ReadDroneFile(text).model;
  // One word that is no name is a misspelt one.
  if (text.find(' ') == std::string::npos && !NamesRealDrone(text)) return CatalogModel(text);
  return DroneFromPrompt(text).model;
}

std::string DescribeLabels(const GlobalOptions& globals) {
  return globals.labels.empty() ? "" : "sha256:" + Sha256HexOfFile(globals.labels);
}

void PrintJson(const nlohmann::ordered_json& value) {
  std::puts(value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

double PeakRssMib() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts in KiB
}

}  // namespace airsim360

#include "airsim360/routes/route_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/text.h"
#include "airsim360/math/coordinate_limit.h"

namespace airsim360 {
namespace {

constexpr uint64_t kMaxFileSize = uint64_t{64} << 20;
constexpr size_t kMaxWaypoints = 1'000'000;

const std::vector<std::string> kColumns = {"x", "y", "z", "yaw_deg", "t"};

struct Field {
  std::string_view text;
  size_t column;  // 1-based, of its first character
};

// Where an error is, for its message.
struct Place {
  std::string_view name;
  size_t line;
};

[[noreturn]] void Fail(Place place, size_t column, const std::string& what) {
  throw InputError(std::string(place.name) + ":" + std::to_string(place.line) + ":" + std::to_string(column) + ": " + what);
}

std::vector<Field> SplitFields(std::string_view line) {
  std::vector<Field> fields;
  for (size_t begin = 0; begin <= line.size();) {
    const size_t end = std::min(line.find(',', begin), line.size());
    fields.push_back({Trimmed(line.substr(begin, end - begin)), begin + 1});
    begin = end + 1;
  }
  return fields;
}

bool ParseNumber(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

// Index into kColumns of every column of the header.
std::vector<size_t> ParseHeader(const std::vector<Field>& fields, Place place) {
  std::vector<size_t> columns;
  for (const Field& field : fields) {
    const auto found = std::find(kColumns.begin(), kColumns.end(), field.text);
    if (found == kColumns.end()) Fail(place, field.column, UnknownChoiceMessage("column", field.text, kColumns));
    const auto index = static_cast<size_t>(found - kColumns.begin());
    if (std::find(columns.begin(), columns.end(), index) != columns.end()) {
      Fail(place, field.column, "column '" + *found + "' is there twice");
    }
    columns.push_back(index);
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    if (std::find(columns.begin(), columns.end(), axis) == columns.end()) {
      Fail(place, 1, "column '" + kColumns[axis] + "' is missing from the header");
    }
  }
  return columns;
}

Waypoint ParseRow(const std::vector<Field>& fields, const std::vector<size_t>& columns, Place place) {
  if (fields.size() != columns.size()) {
    Fail(place, 1, std::to_string(fields.size()) + " values for " + std::to_string(columns.size()) + " columns");
  }
  std::array<double, 5> values{};
  Waypoint waypoint;
  for (size_t i = 0; i < fields.size(); ++i) {
    if (!ParseNumber(fields[i].text, values[columns[i]])) {
      Fail(place, fields[i].column, std::string(fields[i].text.substr(0, 64)) + ": not a finite number");
    }
    if (columns[i] < 3 && std::abs(values[columns[i]]) > kCoordinateLimit)
      Fail(place, fields[i].column, BeyondLimitText(values[columns[i]]) + " metres");
    waypoint.has_yaw |= columns[i] == 3;
    waypoint.has_time |= columns[i] == 4;
  }
  waypoint.p = {values[0], values[1], values[2]};
  waypoint.yaw = values[3] * std::numbers::pi / 180;
  waypoint.t = values[4];
  return waypoint;
}

}  // namespace

std::string TimeDoesNotGrow(double before, double t) {
  char text[80];
  std::snprintf(text, sizeof(text), "t does not grow: %.9g s after %.9g s", t, before);
  return text;
}

std::vector<Waypoint> ParseRouteCsv(std::string_view text, std::string_view name) {
  std::vector<Waypoint> waypoints;
  std::vector<size_t> columns;
  Place place{name, 0};
  // Spreadsheets begin a CSV file with a byte order mark.
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = Trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++place.line;
    if (line.empty() || line.front() == '#') continue;

    // The first line that counts is the header, unless it starts with a number.
    const std::vector<Field> fields = SplitFields(line);
    double number;
    if (columns.empty() && !ParseNumber(fields[0].text, number)) {
      columns = ParseHeader(fields, place);
      continue;
    }
    if (columns.empty()) columns = fields.size() == 4 ? std::vector<size_t>{0, 1, 2, 4} : std::vector<size_t>{0, 1, 2};
    waypoints.push_back(ParseRow(fields, columns, place));
    waypoints.back().line = place.line;
    if (waypoints.size() > kMaxWaypoints) Fail(place, 1, "more than " + std::to_string(kMaxWaypoints) + " points");
    if (waypoints.size() > 1 && waypoints.back().has_time && waypoints.back().t <= waypoints[waypoints.size() - 2].t) {
      Fail(place, 1, TimeDoesNotGrow(waypoints[waypoints.size() - 2].t, waypoints.back().t));
    }
  }
  if (waypoints.empty()) throw InputError(std::string(name) + ": no points");
  return waypoints;
}

std::vector<Waypoint> ReadRouteFile(const std::filesystem::path& path, const std::optional<GeoPoint>& origin) {
  std::string extension = path.extension();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::string text = ReadTextFile(path, kMaxFileSize), name = path.string();
  if (extension == ".yaml" || extension == ".yml" || extension == ".json") return ParseRouteYaml(text, name);
  if (extension == ".gpx" || extension == ".kml") return ParseRouteXml(text, name, origin);
  return ParseRouteCsv(text, name);
}

}  // namespace airsim360

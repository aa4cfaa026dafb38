#include "airsim360/sim/pose_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/text.h"
#include "airsim360/routes/route_file.h"

namespace airsim360 {
namespace {

using Json = nlohmann::json;

constexpr uint64_t kMaxFileSize = uint64_t{1} << 30;
constexpr size_t kMaxPoses = 1'000'000;
constexpr double kMostSeconds = 1e9, kMostMetres = 1e7;

enum Column { kX, kY, kZ, kYaw, kPitch, kRoll, kQw, kQx, kQy, kQz, kT, kColumnCount };
const std::vector<std::string> kNames = {"x", "y", "z", "yaw_deg", "pitch_deg", "roll_deg", "qw", "qx", "qy", "qz", "t"};

// One line of a file: what it holds of each column.
using Row = std::array<std::optional<double>, kColumnCount>;

// A pose and the second it is at, if the file says so.
struct ParsedPose {
  Kinematics body;
  std::optional<double> t;
};

// Fields between commas, or where there are none between blanks.
std::vector<std::string_view> Fields(std::string_view line) {
  std::vector<std::string_view> fields;
  const bool commas = line.find(',') != std::string_view::npos;
  while (!line.empty()) {
    const size_t end = std::min(line.find_first_of(commas ? "," : " \t"), line.size());
    fields.push_back(Trimmed(line.substr(0, end)));
    const bool last = end == line.size();
    line.remove_prefix(std::min(end + 1, line.size()));
    if (!commas) line = Trimmed(line);
    if (commas && line.empty() && !last) fields.push_back({});
  }
  return fields;
}

double Number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw InputError("'" + std::string(text.substr(0, 64)) + "' is not a finite number");
  return value;
}

std::vector<Column> ParseHeader(const std::vector<std::string_view>& fields) {
  std::vector<Column> columns;
  for (const std::string_view field : fields) {
    const auto column = static_cast<Column>(ParseChoice("column", field, kNames));
    if (std::ranges::count(columns, column) > 0) throw InputError("column '" + std::string(field) + "' is there twice");
    columns.push_back(column);
  }
  return columns;
}

// Columns of a file without a header, by its first line.
std::vector<Column> ColumnsOf(std::string_view line, size_t count) {
  if (line.find(',') == std::string_view::npos && count == 8) return {kT, kX, kY, kZ, kQx, kQy, kQz, kQw};
  if (line.find(',') == std::string_view::npos || count < 3 || count > 6) {
    throw InputError(std::to_string(count) + " values are neither x,y,z[,yaw_deg[,pitch_deg[,roll_deg]]] nor TUM's t x y z qx qy qz qw");
  }
  const std::vector<Column> all = {kX, kY, kZ, kYaw, kPitch, kRoll};
  return {all.begin(), all.begin() + static_cast<ptrdiff_t>(count)};
}

Mat3d CheckedRotation(Quaternion q) {
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (!(std::abs(length - 1) <= 1e-3)) throw InputError("the quaternion's length is " + std::to_string(length) + ", not 1");
  return ToMatrix({q.w / length, q.x / length, q.y / length, q.z / length});
}

Vec3d CheckedPlace(Vec3d p) {
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(p[i]) <= kMostMetres)) throw InputError("a place farther than 10,000 km from the origin");
  }
  return p;
}

ParsedPose PoseOf(const Row& row) {
  const auto all = [&](std::initializer_list<Column> columns) {
    return std::ranges::all_of(columns, [&](Column c) { return row[c].has_value(); });
  };
  const auto any = [&](std::initializer_list<Column> columns) {
    return std::ranges::any_of(columns, [&](Column c) { return row[c].has_value(); });
  };
  if (!all({kX, kY, kZ})) throw InputError("x, y and z are needed");
  const bool turned = any({kQw, kQx, kQy, kQz});
  if (turned && !all({kQw, kQx, kQy, kQz})) throw InputError("a quaternion has qw, qx, qy and qz");
  if (turned && any({kYaw, kPitch, kRoll})) throw InputError("give angles or a quaternion, not both");
  const Vec3d p = CheckedPlace({*row[kX], *row[kY], *row[kZ]});
  ParsedPose pose{.body = {}, .t = row[kT]};
  if (turned) {
    const Mat3d R_WC = CheckedRotation({*row[kQw], *row[kQx], *row[kQy], *row[kQz]});
    pose.body.X_WB = {R_WC * CameraInBody().R.transpose(), p};
    return pose;
  }
  const auto radians = [&](Column c) { return row[c].value_or(0) * std::numbers::pi / 180; };
  pose.body.X_WB = BodyPose(p, radians(kYaw), radians(kPitch), radians(kRoll));
  return pose;
}

double JsonNumber(const Json& value, const std::string& key) {
  if (!value.is_number() || !std::isfinite(value.get<double>())) throw InputError("'" + key + "' is not a finite number");
  return value.get<double>();
}

template <size_t kSize>
std::array<double, kSize> JsonNumbers(const Json& object, const std::string& key) {
  std::array<double, kSize> values{};
  if (!object.contains(key) || !object[key].is_array() || object[key].size() != kSize)
    throw InputError("'" + key + "' is not a list of " + std::to_string(kSize) + " numbers");
  for (size_t i = 0; i < kSize; ++i) values[i] = JsonNumber(object[key][i], key);
  return values;
}

RigidTransform JsonTransform(const Json& json, const char* key) {
  if (!json[key].is_object()) throw InputError(std::string("'") + key + "' is not {\"p\": …, \"q_wxyz\": …}");
  const auto p = JsonNumbers<3>(json[key], "p");
  const auto q = JsonNumbers<4>(json[key], "q_wxyz");
  return {CheckedRotation({q[0], q[1], q[2], q[3]}), CheckedPlace({p[0], p[1], p[2]})};
}

// A line of frames.jsonl, or an object with the names of columns.
ParsedPose PoseOfJson(std::string_view line) {
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object()) throw InputError("not a JSON object");
  if (!json.contains("X_WC") && !json.contains("X_WB")) {
    Row row;
    for (const auto& [key, value] : json.items()) {
      const auto found = std::ranges::find(kNames, key);
      if (found == kNames.end()) throw InputError(UnknownChoiceMessage("key", key, kNames));
      row[static_cast<size_t>(found - kNames.begin())] = JsonNumber(value, key);
    }
    return PoseOf(row);
  }
  ParsedPose pose;
  pose.body.X_WB = json.contains("X_WB") ? JsonTransform(json, "X_WB") : JsonTransform(json, "X_WC") * CameraInBody().inverse();
  if (json.contains("t_ns")) pose.t = JsonNumber(json["t_ns"], "t_ns") * 1e-9;
  const auto vector = [&](const char* key) {
    if (!json.contains(key)) return Vec3d{};
    const auto v = JsonNumbers<3>(json, key);
    return Vec3d{v[0], v[1], v[2]};
  };
  pose.body.v_WB = vector("v_WB");
  pose.body.w_WB_B = vector("w_WB_B");
  return pose;
}

/// Reads lines; which format they are in is the first one's.
class PoseLines {
 public:
  void Add(std::string_view line) {
    if (line.front() == '{') return Append(PoseOfJson(line));
    const std::vector<std::string_view> fields = Fields(line);
    if (columns_.empty() && poses_.empty()) {
      const char c = line.front();
      const bool header = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
      columns_ = header ? ParseHeader(fields) : ColumnsOf(line, fields.size());
      if (header) return;
    }
    if (fields.size() != columns_.size())
      throw InputError(std::to_string(fields.size()) + " values for " + std::to_string(columns_.size()) + " columns");
    Row row;
    for (size_t i = 0; i < fields.size(); ++i) row[columns_[i]] = Number(fields[i]);
    Append(PoseOf(row));
  }
  std::vector<TimedPose> Take() { return std::move(poses_); }

 private:
  void Append(const ParsedPose& pose) {
    if (poses_.size() == kMaxPoses) throw InputError("more than " + std::to_string(kMaxPoses) + " poses");
    if (poses_.empty()) first_ = pose.t;
    if (first_.has_value() != pose.t.has_value()) throw InputError("some poses have a time and some have none");
    const double t = pose.t ? *pose.t - *first_ : static_cast<double>(poses_.size());
    if (!(t <= kMostSeconds)) throw InputError("more than 1e9 s after the first pose");
    const int64_t t_ns = std::llround(t * 1e9);
    if (!poses_.empty() && t_ns <= poses_.back().t_ns) throw InputError(TimeDoesNotGrow(last_, pose.t.value_or(t)));
    last_ = pose.t.value_or(t);
    poses_.push_back({t_ns, pose.body});
  }

  std::vector<Column> columns_;
  std::vector<TimedPose> poses_;
  std::optional<double> first_;
  double last_ = 0;
};

}  // namespace

std::vector<TimedPose> ParsePoses(std::string_view text, std::string_view name) {
  PoseLines lines;
  size_t number = 0;
  // Spreadsheets begin a CSV file with a byte order mark.
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = Trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    if (line.empty() || line.front() == '#') continue;
    try {
      lines.Add(line);
    } catch (const InputError& error) {
      throw InputError(std::string(name) + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  std::vector<TimedPose> poses = lines.Take();
  if (poses.empty()) throw InputError(std::string(name) + ": no poses");
  return poses;
}

std::vector<TimedPose> ReadPoseFile(const std::filesystem::path& path) {
  return ParsePoses(ReadTextFile(path, kMaxFileSize), path.string());
}

}  // namespace airsim360

#include "airsim360/mpde/sources.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/random.h"
#include "airsim360/mpde/safe_json.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr uint64_t kLargestJson = uint64_t{4} << 30;
constexpr double kClosest = 0.05;  // metres ahead of the camera: nearer points have no place in the picture
constexpr double kLargestNumber = 1e6;

// Finite numbers of an array of a known size.
std::vector<double> Numbers(const Json& json, size_t count, const std::string& where) {
  if (!json.is_array() || json.size() != count) throw InputError(where + ": must be " + std::to_string(count) + " numbers");
  std::vector<double> values;
  for (const Json& entry : json) {
    if (!entry.is_number() || !(std::abs(entry.get<double>()) < kLargestNumber))
      throw InputError(where + ": '" + entry.dump().substr(0, 40) + "' is no number in range");
    values.push_back(entry);
  }
  return values;
}

const Json& Member(const Json& json, const char* key, const std::string& where) {
  if (!json.is_object() || !json.contains(key)) throw InputError(where + ": key '" + key + "' is missing");
  return json[key];
}

double NumberOf(const Json& json, const char* key, const std::string& where) {
  const Json& value = Member(json, key, where);
  if (!value.is_number() || !(std::abs(value.get<double>()) < 1e15))
    throw InputError(where + ": " + key + ": '" + value.dump().substr(0, 40) + "' is no number in range");
  return value;
}

Vec3d Point(const Json& json, const std::string& where) {
  const std::vector<double> p = Numbers(json, 3, where);
  return {p[0], p[1], p[2]};
}

// The y of MonoLoco's layout: theta, psi, z, r, h, w, l, sin, cos, yaw.
constexpr size_t kMonolocoTargets = 10;

}  // namespace

std::vector<MpdeSample> ReadMonolocoFile(const fs::path& file, const std::string& split) {
  const Json json = ParseBoundedJson(ReadTextFile(file, kLargestJson), file.string());
  const std::string name = file.string();
  if (!json.is_object() || !json.contains("train")) throw InputError(name + ": has no 'train': it is not in MonoLoco's layout");
  const Json& part = Member(json, split.c_str(), name);
  const Json &X = Member(part, "X", name + ": " + split), &Y = Member(part, "Y", name + ": " + split);
  if (!X.is_array() || !Y.is_array() || X.size() != Y.size())
    throw InputError(name + ": " + split + ": X and Y must be lists of one length");
  constexpr double kPlane = 10;
  const Json names = part.value("names", Json());
  std::vector<MpdeSample> samples;
  for (size_t i = 0; i < X.size(); ++i) {
    const std::string where = name + ": " + split + ": entry " + std::to_string(i);
    const std::vector<double> x = Numbers(X[i], std::size(KeypointRays{}), where + ": X"),
                              y = Numbers(Y[i], kMonolocoTargets, where + ": Y");
    if (!(y[3] > 0)) throw InputError(where + ": Y: a distance of " + std::to_string(y[3]) + " m is not above 0");
    MpdeSample sample;
    std::ranges::transform(x, sample.rays.begin(), [](double v) { return static_cast<float>(v / kPlane); });
    sample.truth = {y[3], std::atan2(y[7], y[8])};
    sample.person = HashName(names.is_array() && names.size() == X.size() ? names[i].dump() : std::string());
    for (const size_t same : {2, 4, 5, 6}) sample.person = MixBits(sample.person ^ std::bit_cast<uint64_t>(y[same]));
    samples.push_back(sample);
  }
  return samples;
}

namespace {

// One picture of people.jsonl.
struct Picture {
  std::string where;
  uint64_t place = 0;  // which dataset: track ids repeat
  double pitch_deg = 0;
  bool pinhole = false;
  double fx = 0, fy = 0, cx = 0, cy = 0;
};

Picture PictureOf(const Json& line, uint64_t place, const std::string& where) {
  const Json& camera = Member(line, "camera", where);
  Picture picture{where, place};
  picture.pitch_deg = -Numbers(Member(camera, "yaw_pitch_roll_deg", where), 3, where + ": yaw_pitch_roll_deg")[1];
  if (!camera.contains("K")) return picture;
  const Json& K = camera["K"];
  if (!K.is_array() || K.size() != 3) throw InputError(where + ": K: must be 3 rows");
  const std::vector<double> first = Numbers(K[0], 3, where + ": K"), second = Numbers(K[1], 3, where + ": K");
  if (!(first[0] > 0 && second[1] > 0)) throw InputError(where + ": K: focal lengths must be above 0");
  picture.pinhole = true;
  picture.fx = first[0], picture.cx = first[2], picture.fy = second[1], picture.cy = second[2];
  return picture;
}

PersonShape ShapeOf(const Json& person, const Picture& picture) {
  const Json& keypoints = Member(person, "keypoints_world", picture.where);
  if (!keypoints.is_array() || keypoints.size() < kMpdeKeypoints)
    throw InputError(picture.where + ": keypoints_world: must have at least 17 points");
  const Json& box = Member(person, "box3d_world", picture.where);
  const Vec3d ground = Point(Member(person, "position_world", picture.where), picture.where + ": position_world");
  PersonShape shape;
  for (size_t i = 0; i < shape.keypoints.size(); ++i)
    shape.keypoints[i] = Point(keypoints[i], picture.where + ": keypoints_world") - ground;
  shape.center = Point(Member(box, "center", picture.where), picture.where + ": box3d_world") - ground;
  shape.yaw = NumberOf(box, "yaw", picture.where);
  shape.person = MixBits(picture.place) + static_cast<uint64_t>(NumberOf(person, "track_id", picture.where));
  return shape;
}

// As the picture's camera sees the person: the pixels of the keypoints where there are some, else where they would be.
bool SampleOf(const Json& person, const Picture& picture, const PersonShape& shape, const PeopleFilter& filter, MpdeSample& sample) {
  const std::vector<double> pixels =
      Numbers(Member(person, "keypoints", picture.where), 3 * static_cast<size_t>(kMpdeKeypoints), picture.where + ": keypoints");
  const Json& in_camera = Member(person, "keypoints_cam", picture.where);
  if (!in_camera.is_array() || in_camera.size() < kMpdeKeypoints)
    throw InputError(picture.where + ": keypoints_cam: must have at least 17 points");
  int visible = 0;
  for (size_t i = 0; i < kMpdeKeypoints; ++i) {
    if (pixels[3 * i + 2] > 0) {
      visible += pixels[3 * i + 2] == 2;
      sample.rays[2 * i] = static_cast<float>((pixels[3 * i] - picture.cx) / picture.fx);
      sample.rays[2 * i + 1] = static_cast<float>((pixels[3 * i + 1] - picture.cy) / picture.fy);
      continue;
    }
    const Vec3d p = Point(in_camera[i], picture.where + ": keypoints_cam");
    if (p.z < kClosest) return false;
    sample.rays[2 * i] = static_cast<float>(p.x / p.z), sample.rays[2 * i + 1] = static_cast<float>(p.y / p.z);
  }
  const Json& box = Member(person, "box3d_cam", picture.where);
  const Vec3d center = Point(Member(box, "center", picture.where), picture.where + ": box3d_cam");
  sample.truth = {Norm(center), WrapAngle(NumberOf(box, "rotation_y", picture.where) - std::atan2(center.x, center.z))};
  sample.person = shape.person;
  return visible >= filter.least_keypoints && NumberOf(person, "truncation", picture.where) <= filter.most_truncated &&
         sample.truth.distance >= filter.nearest && sample.truth.distance <= filter.farthest;
}

void ReadPeopleFile(const fs::path& file, uint64_t place, const PeopleFilter& filter, PeopleData& data) {
  std::ifstream stream(file);
  if (!stream) throw InputError(file.string() + ": cannot be read; datasets with people have it");
  std::set<std::pair<int64_t, uint64_t>> seen;  // moment and person: a rig has many pictures of one moment
  std::string text;
  for (int64_t number = 1; std::getline(stream, text); ++number) {
    const std::string where = file.string() + ":" + std::to_string(number);
    const Json line = ParseBoundedJson(text, where);
    const Picture picture = PictureOf(line, place, where);
    if (picture.pitch_deg < filter.pitch_low_deg || picture.pitch_deg > filter.pitch_high_deg) continue;
    const auto index = static_cast<int64_t>(NumberOf(line, "index", where));
    const Json& persons = Member(line, "persons", where);
    if (!persons.is_array()) throw InputError(where + ": persons: must be a list");
    for (const Json& person : persons) {
      const PersonShape shape = ShapeOf(person, picture);
      if (seen.emplace(index, shape.person).second) data.shapes.push_back(shape);
      MpdeSample sample;
      if (picture.pinhole && NumberOf(person, "visible_fraction", where) >= filter.least_visible &&
          SampleOf(person, picture, shape, filter, sample))
        data.samples.push_back(sample);
    }
  }
}

}  // namespace

PeopleData ReadPeopleFolder(const fs::path& folder, const std::string& split, const PeopleFilter& filter) {
  PeopleData data;
  const fs::path list = folder / "subsets.json";
  if (!fs::exists(list)) {
    if (!split.empty()) throw InputError(folder.string() + ": has no subsets.json, so no split '" + split + "'; give the folder alone");
    ReadPeopleFile(folder / "people.jsonl", HashName(folder.string()), filter, data);
    return data;
  }
  const Json subsets = ParseBoundedJson(ReadTextFile(list), list.string());
  if (!subsets.is_array()) throw InputError(list.string() + ": must be a list");
  for (const Json& subset : subsets) {
    const Json& name = Member(subset, "subset", list.string());
    if (!name.is_string() || name.get<std::string>().find("..") != std::string::npos)
      throw InputError(list.string() + ": subset: must be a name");
    const fs::path file = folder / name.get<std::string>() / "people.jsonl";
    if (!split.empty() && Member(subset, "split", list.string()) != split) continue;
    if (fs::exists(file)) ReadPeopleFile(file, HashName(name.get<std::string>()), filter, data);
  }
  return data;
}

}  // namespace airsim360

#include "airsim360/eval/files/person_file.h"

#include <cmath>
#include <unordered_map>

#include "airsim360/base/error.h"
#include "airsim360/eval/files/json_cursor.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

using internal::JsonCursor;
using internal::JsonFile;

PersonPose Person(const JsonCursor& value) {
  PersonPose pose;
  std::vector<double> xyz;
  if (value.Has("xyz")) xyz = value["xyz"].Numbers(3);
  pose.distance = value.Has("distance") || xyz.empty() ? value["distance"].Number() : std::hypot(xyz[0], xyz[1], xyz[2]);
  if (pose.distance < 0) value.Fail("a distance is not below 0");
  if (value.Has("yaw_deg") && !value.Has("angle_deg")) {
    if (xyz.empty()) value.Fail("yaw_deg needs xyz, from which the line of sight follows; or give angle_deg");
    pose.angle = value["yaw_deg"].Number() * kDegree - std::atan2(xyz[0], xyz[2]);
  } else {
    pose.angle = value["angle_deg"].Number() * kDegree;
  }
  return pose;
}

JsonCursor ListOf(const JsonFile& file) { return file.top().is_object() ? file.top()["persons"] : file.top(); }

PersonPairs JoinPersons(const JsonFile& prediction, const JsonFile& truth) {
  std::unordered_map<std::string, PersonPose> predictions;
  const JsonCursor list = ListOf(prediction), truths = ListOf(truth);
  for (size_t i = 0; i < list.size(); ++i) {
    if (!predictions.emplace(list[i]["id"].IdText(), Person(list[i])).second)
      list[i].Fail("the id '" + list[i]["id"].IdText() + "' occurs twice");
  }
  PersonPairs pairs;
  std::unordered_map<std::string, size_t> seen;
  size_t missing = 0;
  std::string first;
  for (size_t i = 0; i < truths.size(); ++i) {
    const std::string id = truths[i]["id"].IdText();
    if (!seen.emplace(id, i).second) truths[i].Fail("the id '" + id + "' occurs twice");
    const auto found = predictions.find(id);
    if (found == predictions.end()) {
      if (missing++ == 0) first = id;
      continue;
    }
    pairs.ids.push_back(id);
    pairs.prediction.push_back(found->second);
    pairs.truth.push_back(Person(truths[i]));
  }
  if (truths.size() == 0) truths.Fail("no persons");
  for (size_t i = list.size(); i-- > 0;) {
    const std::string id = list[i]["id"].IdText();
    if (!seen.contains(id)) ++pairs.extra, pairs.first_extra = id;
  }
  if (missing > 0)
    list.Fail("no prediction for " + std::to_string(missing) + " of " + std::to_string(truths.size()) + " persons, '" + first + "' first");
  return pairs;
}

}  // namespace

PersonPairs ReadPersonFiles(const std::filesystem::path& prediction, const std::filesystem::path& truth) {
  return JoinPersons(JsonFile::Read(prediction), JsonFile::Read(truth));
}

PersonPairs ParsePersonFiles(std::string_view prediction, std::string_view truth, bool lines) {
  return JoinPersons(JsonFile::Parse(prediction, "prediction", lines), JsonFile::Parse(truth, "truth", lines));
}

}  // namespace airsim360

#include "airsim360/assets/gltf/written_world.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "airsim360/assets/gltf/gltf_json_internal.h"
#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

using nlohmann::ordered_json;

constexpr uint64_t kMostUnseen = uint64_t{1} << 22;

ordered_json ToJson(Vec3f v) { return {v.x, v.y, v.z}; }

Vec3f ToVector(const std::vector<double>& v) { return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])}; }

Environment ReadEnvironment(const std::string& where, const JsonRef& json) {
  Environment environment;
  for (const EnvironmentField& field : EnvironmentFields()) environment.*field.value = json.NumberOr(field.name, environment.*field.value);
  const std::string lamps = json.TextOr("lamps", "auto");
  const auto* found = std::find(std::begin(kLampsNames), std::end(kLampsNames), lamps);
  if (found == std::end(kLampsNames)) json.At("lamps").Fail("auto, on or off expected");
  environment.lamps = static_cast<Lamps>(found - std::begin(kLampsNames));
  const std::string type = json.TextOr("cloud_type", "auto");
  const auto* named = std::find(std::begin(kCloudTypeNames), std::end(kCloudTypeNames), type);
  if (named == std::end(kCloudTypeNames)) json.At("cloud_type").Fail("not a type of cloud");
  environment.cloud_type = static_cast<CloudType>(named - std::begin(kCloudTypeNames));
  ValidateEnvironment(environment, where);
  return environment;
}

}  // namespace

std::string WriteWorld(const Scene& scene, const std::vector<bool>& seen) {
  ordered_json environment = ordered_json::object();
  for (const EnvironmentField& field : EnvironmentFields()) environment[field.name] = scene.environment.*field.value;
  environment["cloud_type"] = kCloudTypeNames[static_cast<int>(scene.environment.cloud_type)];
  environment["lamps"] = kLampsNames[static_cast<int>(scene.environment.lamps)];
  ordered_json unseen = ordered_json::array();
  for (const Entity& entity : scene.entities) {
    if (seen[entity.id]) continue;
    unseen.push_back({{"id", entity.id}, {"name", entity.name}, {"category", scene.tree[entity.category].path}});
    if (entity.id == scene.sky_entity) unseen.back()["sky"] = true;
  }
  ordered_json json = {{"environment", environment},
                       {"spawn_yaw_deg", scene.spawn_yaw_deg},
                       {"interior_light", ToJson(scene.interior_light)},
                       {"attributions", scene.attributions},
                       {"unseen", unseen}};
  if (scene.spawn) json["spawn"] = ToJson(*scene.spawn);
  return json.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
}

WrittenWorld ReadWrittenWorld(const std::string& file, const std::string& text) {
  const std::string where = file + ": airsim360_world";
  const nlohmann::json document = ParseJson(where, text);
  const JsonRef json(where, document);
  if (!json.IsObject()) json.Fail("an object expected");
  WrittenWorld out;
  if (const auto environment = json.Find("environment")) out.environment = ReadEnvironment(where, *environment);
  if (const auto spawn = json.Find("spawn")) out.spawn = ToVector(spawn->Numbers(3));
  out.spawn_yaw_deg = static_cast<float>(std::clamp(json.NumberOr("spawn_yaw_deg", 0), -360.0, 360.0));
  for (double v : json.NumbersOr("interior_light", {0, 0, 0})) {
    if (v < 0 || v > 1e6) json.At("interior_light").Fail("values of 0 … 1e6 expected");
  }
  out.interior_light = ToVector(json.NumbersOr("interior_light", {0, 0, 0}));
  const auto lines = json.Find("attributions");
  for (size_t i = 0; lines && i < std::min<size_t>(lines->size(), 10000); ++i)
    out.attributions.push_back((*lines)[i].Text().substr(0, 1000));
  const auto unseen = json.Find("unseen");
  for (size_t i = 0; unseen && i < unseen->size(); ++i) {
    const JsonRef entity = (*unseen)[i];
    const bool sky = entity.BoolOr("sky", false);
    if (sky && std::any_of(out.unseen.begin(), out.unseen.end(), [](const auto& u) { return u.sky; })) entity.Fail("a second sky");
    out.unseen.push_back({entity.At("id").Uint(kMostUnseen), CleanName(entity.At("name").Text()), entity.At("category").Text(), sky});
  }
  std::stable_sort(out.unseen.begin(), out.unseen.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return out;
}

}  // namespace airsim360::internal

#include "airsim360/dataset/people/nuscenes_tables.h"

#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"

namespace airsim360::internal {
namespace {

// 32 hex digits that stand for a thing.
std::string Token(const std::string& of) { return Sha256Hex(AsBytes("airsim360 " + of)).substr(0, 32); }

std::string NameOfTrack(const std::pair<std::string, int64_t>& track) {
  return (track.first.empty() ? "" : track.first + " ") + std::to_string(track.second);
}

}  // namespace

NuScenesTables::NuScenesTables(const DatasetSpec& spec, const std::vector<std::string>& categories,
                               const std::vector<std::string>& attributes)
    : spec_(spec) {
  for (const std::string& name : categories) Name("category", name);
  for (const std::string& name : attributes) Name("attribute", name);
  const char* levels[] = {"v0-40", "v40-60", "v60-80", "v80-100"};
  for (int i = 0; i < 4; ++i) {
    Add("visibility", {{"token", std::to_string(i + 1)}, {"level", levels[i]}, {"description", ""}});
  }
  Add("sensor", {{"token", Token("sensor")}, {"channel", "CAM_PANORAMA"}, {"modality", "camera"}});
  Add("log", {{"token", Token("log")}, {"logfile", ""}, {"vehicle", "airsim360"}, {"date_captured", ""}, {"location", spec.world}});
  Add("map", {{"token", Token("map")}, {"log_tokens", {Token("log")}}, {"category", "none"}, {"filename", ""}});
}

nlohmann::ordered_json& NuScenesTables::Table(const std::string& name) { return tables_[name]; }

void NuScenesTables::Name(const char* table, const std::string& name) {
  if (named_.emplace(table, name).second) Add(table, {{"token", Token(name)}, {"name", name}, {"description", ""}});
}

void NuScenesTables::AddFrame(const std::string& stem, int64_t t_ns, const Json& camera, const std::string& picture) {
  const int64_t micros = t_ns / 1000;
  stem_ = stem;
  sample_ = Token("sample " + stem);
  Add("sample", {{"token", sample_}, {"timestamp", micros}, {"prev", ""}, {"next", ""}, {"scene_token", Token("scene")}});
  Add("ego_pose", {{"token", Token("pose " + stem)},
                   {"timestamp", micros},
                   {"rotation", camera.at("X_WC").at("q_wxyz")},
                   {"translation", camera.at("X_WC").at("p")}});
  Add("calibrated_sensor", {{"token", Token("calibrated " + stem)},
                            {"sensor_token", Token("sensor")},
                            {"translation", {0, 0, 0}},
                            {"rotation", {1, 0, 0, 0}},
                            {"camera_intrinsic", camera.contains("K") ? camera["K"] : Json::array()}});
  Add("sample_data", {{"token", Token("data " + stem)},
                      {"sample_token", sample_},
                      {"ego_pose_token", Token("pose " + stem)},
                      {"calibrated_sensor_token", Token("calibrated " + stem)},
                      {"timestamp", micros},
                      {"fileformat", spec_.rgb_format == RgbFormat::kJpeg ? "jpg" : "png"},
                      {"is_key_frame", true},
                      {"height", spec_.height},
                      {"width", spec_.width},
                      {"filename", picture},
                      {"prev", ""},
                      {"next", ""}});
}

void NuScenesTables::AddBox(const NuScenesBox& box) {
  const Track track{box.kind, box.track};
  Name("category", box.category);
  Name("attribute", box.attribute);
  of_instance_[track].push_back(Table("sample_annotation").size());
  category_[track] = box.category;
  Json row = {{"token", Token("annotation " + stem_ + " " + NameOfTrack(track))},
              {"sample_token", sample_},
              {"instance_token", Token("instance " + NameOfTrack(track))},
              {"visibility_token", box.visibility},
              {"attribute_tokens", {Token(box.attribute)}},
              {"translation", box.translation},
              {"size", box.size},
              {"rotation", box.rotation},
              {"num_lidar_pts", 0},
              {"num_radar_pts", 0},
              {"prev", ""},
              {"next", ""}};
  if (!box.velocity.is_null()) row["velocity"] = box.velocity;
  Add("sample_annotation", std::move(row));
  ++boxes_;
}

std::vector<ExportedFile> NuScenesTables::Finish(const std::string& folder) {
  Link("sample");
  Link("sample_data");
  const Json& samples = Table("sample");
  const bool any = !samples.empty();
  Add("scene", {{"token", Token("scene")},
                {"log_token", Token("log")},
                {"nbr_samples", samples.size()},
                {"first_sample_token", any ? samples.front()["token"] : Json("")},
                {"last_sample_token", any ? samples.back()["token"] : Json("")},
                {"name", "scene-0001"},
                {"description", spec_.world}});
  for (const auto& [track, rows] : of_instance_) FinishInstance(track, rows);
  std::vector<ExportedFile> files;
  for (const char* name : {"category", "attribute", "visibility", "instance", "sensor", "calibrated_sensor", "ego_pose", "log", "scene",
                           "sample", "sample_data", "sample_annotation", "map"}) {
    const Json& table = Table(name);
    const Json rows = table.is_null() ? Json::array() : table;
    files.push_back({folder + "/" + name + ".json", rows.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"});
  }
  return files;
}

// Each row of a table knows the one before and the one after it.
void NuScenesTables::Link(const std::string& table) {
  Json& rows = Table(table);
  for (size_t i = 0; i + 1 < rows.size(); ++i) {
    rows[i]["next"] = rows[i + 1]["token"];
    rows[i + 1]["prev"] = rows[i]["token"];
  }
}

void NuScenesTables::FinishInstance(const Track& track, const std::vector<size_t>& rows) {
  Json& annotations = Table("sample_annotation");
  for (size_t i = 0; i + 1 < rows.size(); ++i) {
    annotations[rows[i]]["next"] = annotations[rows[i + 1]]["token"];
    annotations[rows[i + 1]]["prev"] = annotations[rows[i]]["token"];
  }
  Add("instance", {{"token", Token("instance " + NameOfTrack(track))},
                   {"category_token", Token(category_.at(track))},
                   {"nbr_annotations", rows.size()},
                   {"first_annotation_token", annotations[rows.front()]["token"]},
                   {"last_annotation_token", annotations[rows.back()]["token"]}});
}

}  // namespace airsim360::internal

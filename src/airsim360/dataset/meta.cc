// meta.json: what a dataset is, for people and programs.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "airsim360/dataset/record/config_json.h"
#include "airsim360/dataset/record/intrinsics.h"
#include "airsim360/dataset/record/spec.h"
#include "airsim360/dataset/record/version.h"
#include "airsim360/math/angles.h"
#include "airsim360/scene/category_colors.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

Json PoseJson(const RigidTransform& X) {
  const Quaternion q = ToQuaternion(X.R);
  return {{"p", {X.p.x, X.p.y, X.p.z}}, {"q_wxyz", {q.w, q.x, q.y, q.z}}};
}

Json GimbalJson(const GimbalMount& gimbal) {
  Json json;
  AddConfig([spec = gimbal.spec](ConfigVisitor& v) mutable { spec.Visit(v); }, json);
  json.erase("max_rate_deg");
  json["yaw_deg"] = gimbal.command.yaw * kRadian;
  json["pitch_deg"] = gimbal.command.pitch * kRadian;
  json["roll_deg"] = gimbal.command.roll * kRadian;
  return json;
}

Json RigJson(const DatasetSpec& spec) {
  Json list = Json::array();
  for (const RigCamera& camera : spec.cameras) {
    Json json = {{"name", camera.name},
                 {"projection", kProjectionNames[static_cast<int>(camera.projection)]},
                 {"width", camera.width},
                 {"height", camera.height},
                 {"p_B", {camera.p_B.x, camera.p_B.y, camera.p_B.z}},
                 {"yaw_deg", camera.yaw_deg},
                 {"pitch_deg", camera.pitch_deg},
                 {"roll_deg", camera.roll_deg}};
    if (camera.lens) {
      json["K"] = IntrinsicsJson(*camera.lens);
      if (const auto* fisheye = std::get_if<Fisheye>(&*camera.lens)) json["max_theta"] = fisheye->max_theta;
      json["X_IC"] = PoseJson(camera.X_IC);
    } else if (camera.projection == Projection::kPinhole || camera.projection == Projection::kFisheye) {
      json["fov_deg"] = camera.fov_deg;
    }
    if (camera.gimbal) json["gimbal"] = GimbalJson(*camera.gimbal);
    list.push_back(json);
  }
  return list;
}

// Name, place on the body and intrinsics of every view that has them.
Json CamerasJson(const DatasetSpec& spec) {
  Json list = Json::array();
  for (const View& view : Views(spec)) {
    const Json K = IntrinsicsJson(view.camera);
    if (K.is_null() && spec.cameras.empty()) continue;
    Json json = {{"name", view.name},
                 {"suffix", view.suffix},
                 {"projection", kProjectionNames[static_cast<int>(view.projection)]},
                 {view.gimbal ? "X_GC" : "X_BC", PoseJson(view.X_BC)}};
    if (!K.is_null()) json["K"] = K;
    list.push_back(json);
  }
  return list;
}

Json ParametersJson(const DatasetSpec& spec) {
  Json json = {{"command", spec.command}};
  if (!spec.plan.empty()) {
    json["plan"] = spec.plan;
    json["picture"] = spec.picture;
  }
  json.update({{"world", spec.world},
               {"seed", spec.seed},
               {"projection", kProjectionNames[static_cast<int>(spec.projection)]},
               {"width", spec.width},
               {"height", spec.height},
               {"frames", spec.frames},
               {"shard", spec.shard},
               {"shards", spec.shards},
               {"route", spec.route},
               {"environment", spec.environment}});
  Json products = Json::array();
  for (const ProductFolder& folder : ProductFolders(spec)) products.push_back(folder.name);
  json["products"] = products;
  const bool has_fov = spec.projection == Projection::kPinhole || spec.projection == Projection::kFisheye;
  if (spec.cameras.empty() && has_fov) json["fov_deg"] = spec.fov_deg;
  if (!spec.cameras.empty()) json["cameras"] = RigJson(spec);
  if (!spec.labels.empty()) json["labels"] = spec.labels;
  AddConfig([picture = spec](ConfigVisitor& v) mutable { picture.Visit(v); }, json);
  if (spec.look != Look::kPhoto) json.erase("camera_look");
  if (spec.video) json["video"] = "libx264, crf 18";
  if (!spec.traffic.empty()) json["traffic"] = spec.traffic;
  if (!spec.people.empty()) {
    json["people"] = spec.people;
    json["crops"] = spec.crops;
    json["overlay"] = spec.overlay;
    json["people_formats"] = spec.people_formats;
  }
  return json;
}

Json ConventionsJson() {
  return {{"world", "W: right-handed, +X east, +Y north, +Z up; metres, radians, seconds"},
          {"body", "B: +X forward, +Y left, +Z up"},
          {"camera",
           "C: +X right, +Y down, +Z forward (OpenCV, COLMAP); the image centre looks along the body's forward "
           "axis"},
          {"pose", "X_WC maps camera to world: p_W = R(q_wxyz) p_C + p; Hamilton quaternions w, x, y, z"},
          {"velocities", "v_WB in W, m/s; w_WB_B in B, rad/s"},
          {"equirectangular",
           "COLMAP EQUIRECTANGULAR, W = 2H: theta = 2 pi ((x + 0.5) / W - 0.5), phi = pi (0.5 - (y + 0.5) / H), "
           "ray = (cos phi sin theta, -sin phi, cos phi cos theta)"},
          {"K",
           "of pinhole (COLMAP PINHOLE) and fisheye pictures (OPENCV_FISHEYE, angle in radians = radius / f): x = fx X / Z + cx "
           "in pixels, the centre of the first pixel at (0.5, 0.5); of lenses the model's own formula (docs/reference/cameras.md)"},
          {"pano_frame", "body: the panorama turns with the body; level: only with its heading, up is world up"},
          {"cube",
           "faces STEM_+x, -x, +y, -y, +z, -z: 90 degree pinholes along the axes of C, +z forward, -y up; the "
           "top of -y is "
           "back, the top of +y is front"}};
}

Json EncodingsJson(const DatasetSpec& spec, const Scene& scene) {
  Json json;
  for (const ProductFolder& folder : ProductFolders(spec)) {
    const auto info = std::ranges::find(kProducts, folder.name, &ProductInfo::name);
    json[folder.name] = info->encoding;
  }
  if (json.contains("rgb") && spec.rgb_format == RgbFormat::kJpeg) json["rgb"] = "8-bit sRGB JPEG 4:4:4";
  if (NeedsWideSemantics(scene))
    json["semantic"] =
        "16-bit gray PNG, category id of `categories` (custom ones are 256 and above); 0 = void, never "
        "written";
  return json;
}

Json CategoriesJson(const SemanticTree& tree) {
  Json list = Json::array();
  for (const auto& [id, category] : tree.categories()) {
    if (id == kVoid) continue;
    const Rgb8 color = CategoryColor(tree, id);
    list.push_back({{"id", id},
                    {"path", category.path},
                    {"color", {color.r, color.g, color.b}},
                    {"parent", category.parent},
                    {"kind", category.thing ? "thing" : "stuff"},
                    {"ade20k", category.ade20k},
                    {"cityscapes", category.cityscapes},
                    {"coco", category.coco}});
  }
  return list;
}

}  // namespace

std::string MetaJson(const DatasetSpec& spec, const Scene& scene) {
  const SceneCounts counts = scene.Count();
  Json json = {{"format", "airsim360-native-1"},
               {"generator", std::string("airsim360 ") + kVersion},
               {"command", spec.command},
               {"world", spec.world},
               {"seed", spec.seed},
               {"size", {spec.width, spec.height}},
               {"tier", kTierNames[static_cast<int>(spec.tier)]},
               {"parameters", ParametersJson(spec)},
               {"scene", {{"name", scene.name}, {"triangles", counts.instanced_triangles}, {"entities", counts.entities}}},
               {"attributions", scene.attributions},
               {"conventions", ConventionsJson()},
               {"encodings", EncodingsJson(spec, scene)},
               {"categories", CategoriesJson(scene.tree)}};
  // Of a plan the scene is the names of several worlds; plan.json has what they hold.
  if (!spec.plan.empty()) json["scene"] = {{"name", scene.name}};
  if (const Json cameras = CamerasJson(spec); !cameras.empty()) json["cameras"] = cameras;
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string DescribeMetaDifference(const std::string& on_disk, const std::string& wanted) {
  if (on_disk == wanted) return {};
  const Json a = Json::parse(on_disk, nullptr, false), b = Json::parse(wanted);
  if (!a.is_object()) return "its description is damaged";
  const auto text = [](const Json& json, const std::string& key) {
    return json.is_object() && json.contains(key) ? json[key].dump() : std::string("nothing");
  };
  const Json parameters = a.value("parameters", Json::object());
  // What follows from another parameter is told last: the products from the tier, `picture` from the flags of a plan.
  const auto follows = [](const std::string& key) { return key == "products" || key == "picture"; };
  for (const bool last : {false, true}) {
    for (const auto& [key, value] : b["parameters"].items()) {
      if (follows(key) == last && text(parameters, key) != value.dump())
        return key + " is " + text(parameters, key) + " there, " + value.dump() + " here";
    }
  }
  for (const auto& [key, value] : b.items()) {
    if (key == "parameters" || text(a, key) == value.dump()) continue;
    const bool brief = text(a, key).size() < 200 && value.dump().size() < 200;
    return key + (brief ? " is " + text(a, key) + " there, " + value.dump() + " here" : std::string(" differs"));
  }
  return "its description differs";
}

}  // namespace airsim360

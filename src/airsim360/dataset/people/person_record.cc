#include "airsim360/dataset/people/person_record.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

// To 1 / `steps`; never -0.
double Rounded(double value, double steps) { return std::round(value * steps) / steps + 0.0; }
double Length(double v) { return Rounded(v, 1e5); }
double Pixels(double v) { return Rounded(v, 1e3); }
double Angle(double v) { return Rounded(v, 1e6); }
double Share(double v) { return Rounded(v, 1e4); }

Json Point(Vec3d p) { return {Length(p.x), Length(p.y), Length(p.z)}; }
Json RotationJson(const Mat3d& R) {
  const Quaternion q = ToQuaternion(R);
  return {Angle(q.w), Angle(q.x), Angle(q.y), Angle(q.z)};
}

// The boxes that ordinary tools can read: one, or two where the box crosses the seam.
Json Parts(const PictureBox& box, int width) {
  if (box.x + box.w <= width) return Json::array({{box.x, box.y, box.w, box.h}});
  const int right = width - box.x;
  return Json::array({{box.x, box.y, right, box.h}, {0, box.y, box.w - right, box.h}});
}

void AddBox(const char* name, const PictureBox& box, int width, Json& json) {
  const std::string key = name;
  json[key] = {box.x, box.y, box.w, box.h};
  json[key + "_wrap"] = box.x + box.w > width;
  json[key + "_parts"] = Parts(box, width);
}

// nuScenes' bins of the visible share: 1 up to 40 %, 2 up to 60 %, 3 up to 80 %, 4 above.
int VisibilityToken(double fraction) { return fraction <= 0.4 ? 1 : fraction <= 0.6 ? 2 : fraction <= 0.8 ? 3 : 4; }

void AddIdentity(const LabelledPicture& picture, const PersonLabel& label, Json& json) {
  const PersonState& state = label.state;
  const Body& body = *picture.people.cast[label.person].body;
  json["entity_id"] = label.entity;
  json["track_id"] = label.person + 1;
  json["name"] = picture.people.cast[label.person].name;
  json["character"] = body.character;
  json["outfit"] = body.outfit;
  json["stature_m"] = Length(body.spec.stature);
  json["age"] = Rounded(body.spec.age, 10);
  json["sex"] = body.spec.sex == Sex::kFemale ? "female" : "male";
  json["behaviour"] = BehaviourName(state.upper);
  json["locomotion"] = BehaviourName(state.lower);
  json["group_id"] = state.group;
  json["speaking"] = state.speaking;
  json["partner_track_id"] = state.partner == kNoPerson ? 0 : state.partner + 1;
  json["position_world"] = Point(state.p_WP);
  json["yaw"] = Angle(state.yaw);
  json["velocity_world"] = Point(state.v_WP);
}

void AddKeypoints(const PersonLabel& label, Json& json) {
  Json coco = Json::array(), world = Json::array(), cam = Json::array(), sphere = Json::array(), pixels = Json::array(),
       states = Json::array(), occluders = Json::array();
  int labelled = 0;
  for (size_t i = 0; i < label.keypoints.size(); ++i) {
    const KeypointLabel& k = label.keypoints[i];
    const int v = k.state == KeypointState::kAbsent ? 0 : k.state == KeypointState::kVisible ? 2 : 1;
    if (i < kCocoSocketCount) {
      coco.push_back(Pixels(k.pixel.x));
      coco.push_back(Pixels(k.pixel.y));
      coco.push_back(v);
      labelled += v > 0;
    }
    world.push_back(Point(k.p_W));
    cam.push_back(Point(k.p_C));
    sphere.push_back({Angle(k.lon), Angle(k.lat), Length(k.range)});
    pixels.push_back({Pixels(k.pixel.x), Pixels(k.pixel.y)});
    states.push_back(static_cast<int>(k.state));
    occluders.push_back(k.occluder);
  }
  json["keypoints"] = std::move(coco);
  json["num_keypoints"] = labelled;
  json["keypoints_px"] = std::move(pixels);
  json["keypoints_world"] = std::move(world);
  json["keypoints_cam"] = std::move(cam);
  json["keypoints_sph"] = std::move(sphere);
  json["keypoint_state"] = std::move(states);
  json["keypoint_occluder"] = std::move(occluders);
}

void AddSkeleton(const PersonLabel& label, const Mat3d& R_CW, Json& json) {
  Json places = Json::array(), world = Json::array(), cam = Json::array();
  for (const RigidTransform& X_WJ : label.pose.X_WJ) {
    places.push_back(Point(X_WJ.p));
    world.push_back(RotationJson(X_WJ.R));
    cam.push_back(RotationJson(R_CW * X_WJ.R));
  }
  json["joints_world"] = std::move(places);
  json["joint_q_wxyz_world"] = std::move(world);
  json["joint_q_wxyz_cam"] = std::move(cam);
}

Json ViewJson(const FieldOfView& view, bool rotated) {
  Json json = {Angle(view.lon), Angle(view.lat), Angle(view.width), Angle(view.height)};
  if (rotated) json.push_back(Angle(view.gamma));
  return json;
}

void AddBoxes(const LabelledPicture& picture, const PersonLabel& label, const Segment* seen, Json& json) {
  const int width = Width(picture.camera);
  const int64_t area = seen != nullptr ? seen->area : 0;
  const double fraction = VisibleFraction(label, area);
  if (seen != nullptr) {
    const PixelBox& box = seen->box_wrap;
    AddBox("bbox", {box.x, box.y, box.w, box.h}, width, json);
    json["segmentation"] = {{"size", {picture.entity.height(), picture.entity.width()}},
                            {"counts", CocoRle(picture.entity, label.entity, box)}};
  } else {
    json["bbox"] = nullptr;
  }
  json["area"] = area;
  json["iscrowd"] = 0;
  if (label.amodal.box) {
    AddBox("box2d_amodal", *label.amodal.box, width, json);
  } else {
    json["box2d_amodal"] = nullptr;
  }
  json["amodal_area"] = label.amodal.pixels;
  json["visible_fraction"] = Share(fraction);
  json["visibility_token"] = VisibilityToken(fraction);
  json["truncation"] = Share(label.amodal.truncation);
  json["bfov"] = ViewJson(label.amodal.bfov, false);
  json["rbfov"] = ViewJson(label.amodal.rbfov, true);
  const PersonBox3d& box = label.box3d;
  const Json lwh = {Length(box.length), Length(box.width), Length(box.height)};
  json["box3d_world"] = {{"center", Point(box.center_W)}, {"lwh", lwh}, {"yaw", Angle(box.yaw)}};
  json["box3d_cam"] = {
      {"center", Point(box.center_C)}, {"bottom", Point(box.bottom_C)}, {"lwh", lwh}, {"rotation_y", Angle(box.rotation_y)}};
  json["alpha"] = Angle(box.alpha);
  json["distance"] = Length(Norm(box.center_C));
}

void AddCrop(const PersonLabel& label, Json& json) {
  const PersonCrop crop = CropOf(label);
  Json keypoints = Json::array();
  for (size_t i = 0; i < std::min<size_t>(kCocoSocketCount, label.keypoints.size()); ++i) {
    const KeypointLabel& k = label.keypoints[i];
    const auto pixel = RayToPixel(crop.camera, crop.R_CK.transpose() * k.p_C);
    const bool inside = pixel && k.state != KeypointState::kAbsent;
    keypoints.push_back(inside ? Pixels(pixel->x) : 0.0);
    keypoints.push_back(inside ? Pixels(pixel->y) : 0.0);
    keypoints.push_back(!inside ? 0 : k.state == KeypointState::kVisible ? 2 : 1);
  }
  json["crop"] = {
      {"size", kCropSize}, {"f", Pixels(crop.camera.fx)}, {"q_wxyz_cam", RotationJson(crop.R_CK)}, {"keypoints", std::move(keypoints)}};
}

}  // namespace

std::vector<PersonRow> PersonRows(const LabelledPicture& picture, std::span<const PersonLabel> labels) {
  std::vector<PersonRow> rows;
  for (const PersonLabel& label : labels) {
    const auto found = std::ranges::lower_bound(picture.segments, label.entity, {}, &Segment::entity);
    const Segment* seen = found != picture.segments.end() && found->entity == label.entity ? &*found : nullptr;
    Json json;
    AddIdentity(picture, label, json);
    AddBoxes(picture, label, seen, json);
    AddKeypoints(label, json);
    AddSkeleton(label, label.R_CW, json);
    AddCrop(label, json);
    rows.push_back({.entity = label.entity,
                    .track = static_cast<int64_t>(label.person) + 1,
                    .behaviour = BehaviourName(label.state.upper),
                    .range = Norm(label.box3d.center_C),
                    .pixels = seen != nullptr ? seen->area : 0,
                    .visible_fraction = VisibleFraction(label, seen != nullptr ? seen->area : 0),
                    .json = json.dump(-1, ' ', false, Json::error_handler_t::replace)});
  }
  return rows;
}

std::string PeopleLine(const std::string& frame_line, const DatasetSpec& spec, const View& view, std::span<const std::string> persons) {
  const Json frame = Json::parse(frame_line);
  const Json& X_WC = spec.cameras.empty() ? frame["X_WC"] : frame["cameras"][view.name]["X_WC"];
  Json camera = {{"X_WC", X_WC}};
  const Json& q = X_WC["q_wxyz"];
  const Mat3d R_WC = ToMatrix({q[0], q[1], q[2], q[3]});
  // The body whose forward axis is the image centre.
  const Mat3d R_WB = R_WC * CameraInBody().R.transpose();
  const double yaw = std::atan2(R_WB.m[1][0], R_WB.m[0][0]), pitch = std::asin(std::clamp(R_WB.m[2][0], -1.0, 1.0)),
               roll = std::atan2(R_WB.m[2][1], R_WB.m[2][2]);
  camera["yaw_pitch_roll_deg"] = {Angle(yaw * kRadian), Angle(pitch * kRadian), Angle(roll * kRadian)};
  camera["width"] = Width(view.camera);
  camera["height"] = Height(view.camera);
  camera["projection"] = kProjectionNames[static_cast<int>(view.projection)];
  if (const auto* pinhole = std::get_if<Pinhole>(&view.camera))
    camera["K"] = {{pinhole->fx, 0, pinhole->cx}, {0, pinhole->fy, pinhole->cy}, {0, 0, 1}};
  Json line = {
      {"index", frame["index"]}, {"stem", frame["stem"].get<std::string>() + view.suffix}, {"t_ns", frame["t_ns"]}, {"camera", camera}};
  std::string text = line.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.back() = ',';  // the persons are texts already
  text += "\"persons\":[";
  for (size_t i = 0; i < persons.size(); ++i) text += (i > 0 ? "," : "") + persons[i];
  return text + "]}";
}

std::string CocoRle(const Image<EntityId>& entity, EntityId id, const PixelBox& box) {
  const int width = entity.width(), height = entity.height();
  // Run lengths over the columns in order, beginning with pixels that are not the entity's.
  std::vector<int64_t> runs = {0};
  bool inside = false;
  const auto skip = [&](int64_t count) {
    if (count == 0) return;
    if (inside) runs.push_back(0), inside = false;
    runs.back() += count;
  };
  const auto in_box = [&](int x) { return x - box.x >= 0 ? x - box.x < box.w : x + width - box.x < box.w; };
  for (int x = 0; x < width; ++x) {
    if (!in_box(x)) {
      skip(height);
      continue;
    }
    skip(box.y);
    for (int y = box.y; y < box.y + box.h; ++y) {
      const bool hit = entity(x, y) == id;
      if (hit != inside) runs.push_back(0), inside = hit;
      ++runs.back();
    }
    skip(height - box.y - box.h);
  }
  std::string text;
  for (size_t i = 0; i < runs.size(); ++i) {
    int64_t x = i > 2 ? runs[i] - runs[i - 2] : runs[i];
    for (bool more = true; more;) {
      auto letter = static_cast<int>(x & 31);
      x >>= 5;
      more = (letter & 16) != 0 ? x != -1 : x != 0;
      text += static_cast<char>((more ? letter | 32 : letter) + 48);
    }
  }
  return text;
}

}  // namespace airsim360

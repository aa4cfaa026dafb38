#include "airsim360/sensors/sensor_set.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

template <class Spec>
void VisitList(ConfigVisitor& v, std::string_view name, std::string_view help, std::vector<Named<Spec>>& list) {
  v.List(name, help, list, [](ConfigVisitor& e, Named<Spec>& sensor) {
    e.Field("name", "unique among its kind", sensor.name);
    sensor.spec.Visit(e);
  });
}

template <class Spec>
void CheckNames(std::string_view where, std::string_view kind, const std::vector<Named<Spec>>& list) {
  std::set<std::string> names;
  for (const auto& sensor : list) {
    if (sensor.name.empty() || !names.insert(sensor.name).second) {
      throw InputError(std::string(where) + ": " + std::string(kind) + ": the name '" + sensor.name +
                       (sensor.name.empty() ? "' is empty" : "' is given twice"));
    }
  }
}

template <class Spec>
void CheckGimbals(std::string_view where, size_t gimbals, const std::vector<Named<Spec>>& list) {
  for (const auto& sensor : list) {
    if (sensor.spec.gimbal > gimbals) {
      throw InputError(std::string(where) + ": '" + sensor.name + "' is on gimbal " + std::to_string(sensor.spec.gimbal) + " of " +
                       std::to_string(gimbals));
    }
  }
}

std::string ParseWord(std::string_view what, const std::string& word, std::vector<std::string> choices) {
  ParseChoice(what, word, choices);
  return word;
}

Camera MakeCamera(const CameraSpec& spec) {
  constexpr uint64_t kLargest = 16384;
  if (spec.width < 1 || spec.height < 1 || spec.width > kLargest || spec.height > kLargest) {
    throw InputError("camera of " + std::to_string(spec.width) + "x" + std::to_string(spec.height) + " pixels: sides must be in 1 … " +
                     std::to_string(kLargest));
  }
  const int width = static_cast<int>(spec.width), height = static_cast<int>(spec.height);
  const double fov = spec.fov_deg * std::numbers::pi / 180;
  if (spec.projection == "erp") return Equirectangular{width, height};
  if (spec.projection == "fisheye") return Fisheye::Equidistant(width, height, fov);
  ParseWord("projection", spec.projection, {"erp", "pinhole", "fisheye"});
  const double f = width / 2.0 / std::tan(fov / 2);
  return Pinhole{width, height, f, f, width / 2.0, height / 2.0};
}

}  // namespace

void CameraSpec::Visit(ConfigVisitor& v) {
  v.Field("projection", "erp, pinhole or fisheye", projection);
  v.Group("mount", "place and direction", [&](ConfigVisitor& g) { mount.Visit(g); });
  v.Field("gimbal", "0 = fixed to the body, n = on the n-th gimbal", gimbal);
  v.Field("width", "pixels", width);
  v.Field("height", "pixels", height);
  v.Field("fov_deg", "pinhole: across the width; fisheye: across the shorter side", fov_deg, 1, 360);
  v.Field("rate_hz", "pictures a second", rate_hz, 0.01, 1000);
  PictureSettings::Visit(v);
}

PanoramicRig CameraSpec::Rig() const {
  PanoramicRig rig{*this, MakeCamera(*this), mount.pose() * CameraInBody()};
  CheckCamera(rig.camera);
  CheckPictureSettings(rig, rig.camera);
  return rig;
}

SensorSet SensorSet::Standard() {
  SensorSet set;
  set.imus = {{"imu", {}}};
  set.gnss = {{"gnss", {}}};
  set.barometers = {{"barometer", {}}};
  set.magnetometers = {{"magnetometer", {}}};
  set.cameras = {{"panorama", {}}};
  return set;
}

void SensorSet::Visit(ConfigVisitor& v) {
  VisitList(v, "gimbals", "mounts with steady axes", gimbals);
  VisitList(v, "imus", "inertial measurement units", imus);
  VisitList(v, "gnss", "satellite receivers", gnss);
  VisitList(v, "barometers", "static pressure", barometers);
  VisitList(v, "magnetometers", "the Earth's field", magnetometers);
  VisitList(v, "range_finders", "distance in a narrow beam", range_finders);
  VisitList(v, "lidars", "3D scanners", lidars);
  VisitList(v, "cameras", "panoramic and ordinary cameras", cameras);
}

void SensorSet::Check(std::string_view where) const {
  CheckNames(where, "gimbals", gimbals);
  CheckNames(where, "imus", imus);
  CheckNames(where, "gnss", gnss);
  CheckNames(where, "barometers", barometers);
  CheckNames(where, "magnetometers", magnetometers);
  CheckNames(where, "range_finders", range_finders);
  CheckNames(where, "lidars", lidars);
  CheckNames(where, "cameras", cameras);
  CheckGimbals(where, gimbals.size(), range_finders);
  CheckGimbals(where, gimbals.size(), lidars);
  CheckGimbals(where, gimbals.size(), cameras);
  try {
    for (const auto& lidar : lidars) lidar.spec.Check();
    for (const auto& camera : cameras) camera.spec.Rig();
  } catch (const InputError& error) {
    throw InputError(std::string(where) + ": " + error.what());
  }
}

SensorSet ReadSensorSet(const std::filesystem::path& file, SensorSet set) {
  ReadYamlFile(file, [&](ConfigVisitor& v) { set.Visit(v); });
  set.Check(file.string());
  return set;
}

RigidTransform MountPose(const SensorSet& set, const SensorStates& states, const RigidTransform& X_BS, uint64_t gimbal) {
  if (gimbal == 0) return X_BS;
  return GimbalPose(set.gimbals.at(gimbal - 1).spec, states.gimbals.at(gimbal - 1)) * X_BS;
}

}  // namespace airsim360

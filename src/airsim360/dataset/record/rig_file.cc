#include "airsim360/dataset/record/rig_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <span>

#include "airsim360/base/choice.h"
#include "airsim360/base/config.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/dataset/record/camera_choice.h"
#include "airsim360/math/angles.h"
#include "airsim360/projection/calibration_file.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDefaultSizes[] = {"2048x1024", "512x512", "1024x768", "1024x1024"};
// Projections that a name alone makes; a calibrated lens needs numbers.
constexpr size_t kNamedProjections = std::size(kDefaultSizes);

Projection ParseProjection(const std::string& text) {
  const std::span<const char* const> names(kProjectionNames, kNamedProjections);
  return static_cast<Projection>(ParseChoice("projection", text, names, "--projection"));
}

// A place on the body, or on a gimbal.
struct Mount {
  double x = 0, y = 0, z = 0, yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
};

void VisitMount(ConfigVisitor& v, Mount& m) {
  v.Field("x", "forward of the body's origin, metres", m.x, -100, 100);
  v.Field("y", "to the left, metres", m.y, -100, 100);
  v.Field("z", "up, metres", m.z, -100, 100);
  v.Field("yaw_deg", "to the left of forward", m.yaw_deg, -360, 360);
  v.Field("pitch_deg", "up", m.pitch_deg, -90, 90);
  v.Field("roll_deg", "right side down", m.roll_deg, -360, 360);
}

constexpr double kNotGiven = std::numeric_limits<double>::quiet_NaN();

// An entry of `cameras` as it is read.
struct CameraEntry {
  std::string name, projection, size, model, calibration, camera, gimbal;
  std::vector<std::string> parameters;
  double fov_deg = kNotGiven;
  Mount mount;
  size_t line = 0;
};

void VisitCamera(ConfigVisitor& v, CameraEntry& c) {
  c.line = v.line();
  v.Field("name", "in file names: letters, digits and _", c.name);
  v.Field("projection", "erp, cube, pinhole or fisheye", c.projection);
  v.Field("size", "WxH", c.size);
  v.Field("fov_deg", "of pinhole (90) and fisheye (180). Of a lens: nothing beyond is seen", c.fov_deg, 0.001, 360);
  v.Field("model", "instead of projection: a camera model, as OPENCV", c.model);
  v.Field("parameters", "of the model, in its order", c.parameters);
  v.Field("calibration", "instead of projection: a file of Kalibr, COLMAP, OpenCV or ROS", c.calibration);
  v.Field("camera", "of that file, where it has several", c.camera);
  v.Field("gimbal", "name of the one it hangs on", c.gimbal);
  VisitMount(v, c.mount);
}

// An entry of `gimbals`. A rig has no time before its trigger: its gimbals stand where they want to be, whatever their rate.
struct GimbalEntry {
  std::string name;
  Mount mount;
  GimbalSpec spec;
  size_t line = 0;
};

void VisitGimbal(ConfigVisitor& v, GimbalEntry& g) {
  g.line = v.line();
  v.Field("name", "that cameras call it by", g.name);
  VisitMount(v, g.mount);
  v.Field("stabilise_yaw", "keeps its heading", g.spec.stabilise_yaw);
  v.Field("stabilise_pitch", "keeps its pitch over the horizon", g.spec.stabilise_pitch);
  v.Field("stabilise_roll", "keeps the horizon level", g.spec.stabilise_roll);
  v.Field("yaw_limit_deg", "of the joint, either way", g.spec.yaw_limit_deg, 0, 180);
  v.Field("pitch_low_deg", "lowest joint angle", g.spec.pitch_low_deg, -90, 90);
  v.Field("pitch_high_deg", "highest joint angle", g.spec.pitch_high_deg, -90, 90);
  v.Field("roll_limit_deg", "of the joint, either way", g.spec.roll_limit_deg, 0, 180);
}

void CheckGimbal(const GimbalEntry& g) {
  if (g.spec.pitch_low_deg > g.spec.pitch_high_deg) throw InputError("pitch_low_deg: it is above pitch_high_deg");
}

bool IsName(const std::string& name) {
  return !name.empty() && name.size() <= 32 &&
         std::ranges::all_of(name, [](unsigned char c) { return std::islower(c) || std::isdigit(c) || c == '_'; });
}

void CheckName(const std::string& name, std::set<std::string>& names, const char* kind) {
  if (!IsName(name)) throw InputError("name: '" + name + "' is not 1 to 32 of a-z, 0-9 and _, for example 'front'");
  if (!names.insert(name).second) throw InputError("name: there are two " + std::string(kind) + " '" + name + "'");
}

// Sides of a picture from "WxH".
void SetSize(const std::string& text, RigCamera& camera) {
  const ImageSize size = ParseSize(text);
  camera.width = size.width;
  camera.height = size.height;
}

std::vector<double> ParseParameters(const std::vector<std::string>& texts) {
  std::vector<double> values;
  for (const std::string& text : texts) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      throw InputError("parameters: '" + text + "' is not a number");
    values.push_back(value);
  }
  return values;
}

Projection ProjectionOf(const Camera& camera) {
  return std::holds_alternative<Pinhole>(camera)   ? Projection::kPinhole
         : std::holds_alternative<Fisheye>(camera) ? Projection::kFisheye
                                                   : Projection::kLens;
}

// A camera of a calibration, in pictures of `size` if that is not empty.
RigCamera FromCalibration(const Calibration& calibration, const std::string& size, std::optional<double> fov_deg) {
  const Camera lens = MakeCamera(calibration, fov_deg);
  RigCamera camera{.name = calibration.name, .width = calibration.width, .height = calibration.height, .p_B = {}};
  if (!size.empty()) SetSize(size, camera);
  camera.lens = Resized(lens, camera.width, camera.height);
  camera.projection = ProjectionOf(*camera.lens);
  return camera;
}

// The one that an entry means of its calibration file.
Calibration FindCalibration(const CameraEntry& entry, const fs::path& rig) {
  const fs::path path = fs::path(entry.calibration).is_absolute() ? fs::path(entry.calibration) : rig.parent_path() / entry.calibration;
  const std::vector<Calibration> found = ReadCalibrations(path);
  if (entry.camera.empty() && found.size() == 1) return found.front();
  std::vector<std::string> names;
  for (const Calibration& calibration : found) names.push_back(calibration.name);
  if (entry.camera.empty()) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    throw InputError("camera: '" + entry.calibration + "' has several: say which of " + list);
  }
  return found[ParseChoice("camera", entry.camera, names, "camera")];
}

// What an entry looks through, without its name and place; X_IC of its calibration goes to `X_IC`.
RigCamera LensOf(const CameraEntry& entry, const fs::path& rig, RigidTransform& X_IC) {
  X_IC = CameraInBody();
  const std::optional<double> fov_deg = std::isnan(entry.fov_deg) ? std::nullopt : std::optional(entry.fov_deg);
  const int given = !entry.projection.empty() + !entry.model.empty() + !entry.calibration.empty();
  if (given > 1) throw InputError("give one of projection, model and calibration");
  if (entry.model.empty() && !entry.parameters.empty()) throw InputError("parameters: they are those of a model; add it");
  if (entry.calibration.empty() && !entry.camera.empty()) throw InputError("camera: it is one of a calibration; add the file");
  if (!entry.calibration.empty()) {
    const Calibration calibration = FindCalibration(entry, rig);
    if (calibration.X_IC) X_IC = *calibration.X_IC;
    return FromCalibration(calibration, entry.size, fov_deg);
  }
  if (entry.model.empty()) return MakeRigCamera(entry.projection.empty() ? "pinhole" : entry.projection, entry.size, fov_deg.value_or(0));
  if (entry.size.empty()) throw InputError("size: a model needs the size of its pictures, for example 752x480");
  RigCamera sized;
  SetSize(entry.size, sized);
  return FromCalibration(
      {.model = entry.model, .width = sized.width, .height = sized.height, .parameters = ParseParameters(entry.parameters)}, "", fov_deg);
}

void Place(const Mount& mount, RigCamera& camera) {
  camera.p_B = {mount.x, mount.y, mount.z};
  camera.yaw_deg = mount.yaw_deg;
  camera.pitch_deg = mount.pitch_deg;
  camera.roll_deg = mount.roll_deg;
}

std::optional<GimbalMount> FindGimbal(const std::string& name, const std::vector<GimbalEntry>& gimbals) {
  if (name.empty()) return std::nullopt;
  std::vector<std::string> names;
  for (const GimbalEntry& gimbal : gimbals) names.push_back(gimbal.name);
  if (names.empty()) throw InputError("gimbal: '" + name + "', but the file has no gimbals");
  const GimbalEntry& found = gimbals[ParseChoice("gimbal", name, names, "gimbal")];
  GimbalMount mount{.spec = found.spec, .command = {}};
  mount.spec.p_BG = {found.mount.x, found.mount.y, found.mount.z};
  mount.command = {found.mount.yaw_deg * kDegree, found.mount.pitch_deg * kDegree, found.mount.roll_deg * kDegree};
  return mount;
}

std::vector<RigCamera> ReadOwnRig(const fs::path& file) {
  std::vector<CameraEntry> entries;
  std::vector<GimbalEntry> gimbals;
  ReadYamlFile(file, [&](ConfigVisitor& v) {
    v.List("cameras", "of the rig", entries, VisitCamera);
    v.List("gimbals", "that cameras hang on", gimbals, VisitGimbal);
  });
  if (entries.empty() || entries.size() > kMostRigCameras) {
    throw InputError(file.string() + ": key 'cameras' has " + std::to_string(entries.size()) + " entries, not 1 … " +
                     std::to_string(kMostRigCameras));
  }
  const auto at = [&](size_t line, const std::string& what, const auto& read) {
    try {
      read();
    } catch (const InputError& error) {
      throw InputError(file.string() + ":" + std::to_string(line) + ": " + what + error.what());
    }
  };
  std::set<std::string> names, gimbal_names;
  for (const GimbalEntry& gimbal : gimbals) {
    at(gimbal.line, "", [&] { CheckName(gimbal.name, gimbal_names, "gimbals"), CheckGimbal(gimbal); });
  }
  std::vector<RigCamera> rig;
  for (const CameraEntry& entry : entries) {
    at(entry.line, "", [&] { CheckName(entry.name, names, "cameras"); });
    at(entry.line, "camera '" + entry.name + "': ", [&] {
      RigidTransform X_IC;
      RigCamera camera = LensOf(entry, file, X_IC);
      camera.name = entry.name;
      Place(entry.mount, camera);
      camera.X_IC = X_IC;
      camera.gimbal = FindGimbal(entry.gimbal, gimbals);
      rig.push_back(camera);
    });
  }
  return rig;
}

// Every camera of a calibration, its frame being the body's.
std::vector<RigCamera> RigOfCalibration(const fs::path& file) {
  std::vector<RigCamera> rig;
  std::set<std::string> names;
  for (const Calibration& calibration : ReadCalibrations(file)) {
    try {
      CheckName(calibration.name, names, "cameras");
    } catch (const InputError& error) {
      throw InputError(file.string() + ":" + std::to_string(calibration.line) + ": camera '" + calibration.name + "': " + error.what());
    }
    RigCamera camera = FromCalibration(calibration, "", std::nullopt);
    camera.X_IC = calibration.X_IC.value_or(CameraInBody());
    rig.push_back(camera);
  }
  return rig;
}

}  // namespace

RigCamera MakeRigCamera(const std::string& projection, const std::string& size_text, double fov_deg) {
  RigCamera camera{.name = {}, .projection = ParseProjection(projection), .p_B = {}};
  const bool pinhole = camera.projection == Projection::kPinhole, fisheye = camera.projection == Projection::kFisheye;
  SetSize(size_text.empty() ? kDefaultSizes[static_cast<int>(camera.projection)] : size_text, camera);
  if (camera.projection == Projection::kErp) CheckPanoramaSize({camera.width, camera.height});
  if (camera.projection == Projection::kCube && camera.width != camera.height) {
    throw InputError("--size: '" + size_text + "': cube faces are square; did you mean '" + std::to_string(camera.width) + "x" +
                     std::to_string(camera.width) + "'?");
  }
  if (fov_deg != 0 && !pinhole && !fisheye)
    throw InputError("--fov: '" + projection + "' has no field of view to choose; use pinhole or fisheye");
  const double limit = pinhole ? 179 : 360;
  camera.fov_deg = fov_deg != 0 ? fov_deg : pinhole ? 90 : 180;
  if (!(camera.fov_deg >= 1 && camera.fov_deg <= limit)) {
    throw InputError("--fov: " + std::to_string(fov_deg) + " degrees is not in 1 … " + std::to_string(static_cast<int>(limit)));
  }
  return camera;
}

std::vector<RigCamera> ReadRigFile(const fs::path& file) {
  return IsCalibration(ReadTextFile(file, kMostRigBytes), file) ? RigOfCalibration(file) : ReadOwnRig(file);
}

}  // namespace airsim360

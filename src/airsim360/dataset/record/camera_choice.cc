#include "airsim360/dataset/record/camera_choice.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <set>
#include <string_view>
#include <vector>

#include "airsim360/base/choice.h"
#include "airsim360/base/config.h"
#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr int kMinSide = 2;
constexpr int kMaxSide = 16384;
constexpr size_t kMostCameras = 64;
constexpr const char* kDefaultSizes[] = {"2048x1024", "512x512", "1024x768", "1024x1024"};

Projection ParseProjection(const std::string& text) {
  return ParseChoice<Projection>("projection", text, kProjectionNames, "--projection");
}

// Projection, size and field of view that fit each other; empty and 0 stand for the projection's own.
RigCamera MakeCamera(const std::string& projection, const std::string& size_text, double fov_deg) {
  RigCamera camera{.name = {}, .projection = ParseProjection(projection), .p_B = {}};
  const bool pinhole = camera.projection == Projection::kPinhole, fisheye = camera.projection == Projection::kFisheye;
  const ImageSize size =
      ParseSize(size_text.empty() ? kDefaultSizes[static_cast<int>(camera.projection)] : size_text);
  if (camera.projection == Projection::kErp) CheckPanoramaSize(size);
  if (camera.projection == Projection::kCube && size.width != size.height) {
    throw InputError("--size: '" + size_text + "': cube faces are square; did you mean '" +
                     std::to_string(size.width) + "x" + std::to_string(size.width) + "'?");
  }
  camera.width = size.width;
  camera.height = size.height;
  if (fov_deg != 0 && !pinhole && !fisheye)
    throw InputError("--fov: '" + projection + "' has no field of view to choose; use pinhole or fisheye");
  const double limit = pinhole ? 179 : 360;
  camera.fov_deg = fov_deg != 0 ? fov_deg : pinhole ? 90 : 180;
  if (!(camera.fov_deg >= 1 && camera.fov_deg <= limit)) {
    throw InputError("--fov: " + std::to_string(fov_deg) + " degrees is not in 1 … " +
                     std::to_string(static_cast<int>(limit)));
  }
  return camera;
}

// An entry of --cameras as it is read.
struct CameraEntry {
  std::string name, projection = "pinhole", size;
  double fov_deg = 0, x = 0, y = 0, z = 0, yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
  size_t line = 0;
};

void VisitCamera(ConfigVisitor& v, CameraEntry& c) {
  c.line = v.line();
  v.Field("name", "in file names: letters, digits and _", c.name);
  v.Field("projection", "erp, cube, pinhole or fisheye", c.projection);
  v.Field("size", "WxH", c.size);
  v.Field("fov_deg", "of pinhole and fisheye; 0: 90 and 180", c.fov_deg, 0, 360);
  v.Field("x", "forward of the body's origin, metres", c.x, -100, 100);
  v.Field("y", "to the left, metres", c.y, -100, 100);
  v.Field("z", "up, metres", c.z, -100, 100);
  v.Field("yaw_deg", "to the left of forward", c.yaw_deg, -360, 360);
  v.Field("pitch_deg", "up", c.pitch_deg, -90, 90);
  v.Field("roll_deg", "right side down", c.roll_deg, -360, 360);
}

bool IsName(const std::string& name) {
  return !name.empty() && name.size() <= 32 && std::ranges::all_of(name, [](unsigned char c) {
    return std::islower(c) || std::isdigit(c) || c == '_';
  });
}

std::vector<RigCamera> ReadRig(const std::string& file) {
  std::vector<CameraEntry> entries;
  ReadYamlFile(file, [&](ConfigVisitor& v) { v.List("cameras", "of the rig", entries, VisitCamera); });
  if (entries.empty() || entries.size() > kMostCameras) {
    throw InputError(file + ": key 'cameras' has " + std::to_string(entries.size()) + " entries, not 1 … " +
                     std::to_string(kMostCameras));
  }
  std::vector<RigCamera> rig;
  std::set<std::string> names;
  for (const CameraEntry& entry : entries) {
    const std::string where = file + ":" + std::to_string(entry.line) + ": ";
    if (!IsName(entry.name))
      throw InputError(where + "name: '" + entry.name + "' is not 1 to 32 of a-z, 0-9 and _, for example 'front'");
    if (!names.insert(entry.name).second) throw InputError(where + "name: there are two cameras '" + entry.name + "'");
    RigCamera camera;
    try {
      camera = MakeCamera(entry.projection, entry.size, entry.fov_deg);
    } catch (const InputError& error) {
      throw InputError(where + "camera '" + entry.name + "': " + error.what());
    }
    camera.name = entry.name;
    camera.p_B = {entry.x, entry.y, entry.z};
    camera.yaw_deg = entry.yaw_deg;
    camera.pitch_deg = entry.pitch_deg;
    camera.roll_deg = entry.roll_deg;
    rig.push_back(camera);
  }
  return rig;
}

// The whole of `text` as a number; false if it is anything else.
bool ParseSide(std::string_view text, int& side) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), side);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

ImageSize ParseSize(const std::string& text) {
  ImageSize size;
  const std::string_view all = text;
  const size_t x = all.find('x');
  if (x == std::string::npos || !ParseSide(all.substr(0, x), size.width) || !ParseSide(all.substr(x + 1), size.height)) {
    throw InputError("--size: '" + text + "' is not WIDTHxHEIGHT, for example 2048x1024");
  }
  for (int side : {size.width, size.height}) {
    if (side < kMinSide || side > kMaxSide) {
      throw InputError("--size: '" + text + "': " + std::to_string(side) + " is not in " +
                       std::to_string(kMinSide) + " … " + std::to_string(kMaxSide));
    }
  }
  return size;
}

void CheckPanoramaSize(ImageSize size) {
  if (size.width == 2 * size.height) return;
  const int height = std::clamp(size.width / 2, kMinSide / 2, kMaxSide / 2);
  throw InputError("--size: '" + std::to_string(size.width) + "x" + std::to_string(size.height) +
                   "' is not twice as wide as high, as an equirectangular panorama is; did you mean '" +
                   std::to_string(2 * height) + "x" + std::to_string(height) + "'?");
}

void CameraChoice::Apply(DatasetSpec& spec) const {
  if (!cameras.empty()) {
    if (projection != "erp" || !size.empty() || fov_deg != 0)
      throw InputError("--cameras: the file has --projection, --size and --fov of every camera; leave them out");
    spec.cameras = ReadRig(cameras);
  }
  const RigCamera first = cameras.empty() ? MakeCamera(projection, size, fov_deg) : spec.cameras.front();
  spec.projection = first.projection;
  spec.width = first.width;
  spec.height = first.height;
  spec.fov_deg = first.fov_deg;
}

}  // namespace airsim360

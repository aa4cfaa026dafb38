#include "airsim360/dataset/record/camera_choice.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "airsim360/base/error.h"
#include "airsim360/dataset/record/rig_file.h"

namespace airsim360 {
namespace {

constexpr int kMinSide = 2;
constexpr int kMaxSide = 16384;

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
      throw InputError("--size: '" + text + "': " + std::to_string(side) + " is not in " + std::to_string(kMinSide) + " … " +
                       std::to_string(kMaxSide));
    }
  }
  return size;
}

void CheckPanoramaSize(ImageSize size) {
  if (size.width == 2 * size.height) return;
  const int height = std::clamp(size.width / 2, kMinSide / 2, kMaxSide / 2);
  throw InputError("--size: '" + std::to_string(size.width) + "x" + std::to_string(size.height) +
                   "' is not twice as wide as high, as an equirectangular panorama is; did you mean '" + std::to_string(2 * height) + "x" +
                   std::to_string(height) + "'?");
}

void CameraChoice::Apply(DatasetSpec& spec) const {
  if (!cameras.empty()) {
    if (projection != "erp" || !size.empty() || fov_deg != 0)
      throw InputError("--cameras: the file has --projection, --size and --fov of every camera; leave them out");
    spec.cameras = ReadRigFile(cameras);
  }
  const RigCamera first = cameras.empty() ? MakeRigCamera(projection, size, fov_deg) : spec.cameras.front();
  spec.projection = first.projection;
  spec.width = first.width;
  spec.height = first.height;
  spec.fov_deg = first.fov_deg;
}

}  // namespace airsim360

// Optical flow in the layouts of others and of our datasets.
#include <cmath>
#include <cstring>
#include <limits>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/file_name.h"
#include "airsim360/eval/files/number_array.h"
#include "airsim360/eval/files/picture_files.h"
#include "airsim360/image/codecs.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Middlebury's: the number 202021.25, width, height, then (dx, dy) a pixel, all little-endian and of 32 bits.
NumberPicture FromFlo(const fs::path& path) {
  constexpr float kMagic = 202021.25f;
  constexpr float kUnknown = 1e9f;
  const Bytes bytes = ReadFile(path);
  float magic = 0;
  int32_t size[2] = {0, 0};
  if (bytes.size() >= 12) {
    std::memcpy(&magic, bytes.data(), 4);
    std::memcpy(size, bytes.data() + 4, 8);
  }
  if (magic != kMagic || size[0] < 1 || size[1] < 1 || size[0] > kMaxPixels / size[1])
    throw InputError(path.string() + ": is no .flo file");
  NumberPicture flow{size[0], size[1], 2, std::vector<double>(2 * static_cast<size_t>(size[0]) * static_cast<size_t>(size[1]))};
  if (bytes.size() < 12 + 4 * flow.values.size()) throw InputError(path.string() + ": ends before its last pixel");
  for (size_t i = 0; i < flow.values.size(); ++i) {
    float v;
    std::memcpy(&v, bytes.data() + 12 + 4 * i, 4);
    flow.values[i] = std::abs(v) < kUnknown ? v : kNan;
  }
  return flow;
}

NumberPicture FromKitti(const fs::path& path) {
  const Bytes bytes = ReadFile(path);
  const PngKind kind = ReadPngKind(bytes, path.string());
  if (kind.channels != 3 || kind.bit_depth != 16)
    throw InputError(path.string() + ": a PNG of " + std::to_string(kind.channels) + (kind.channels == 1 ? " channel" : " channels") +
                     " and " + std::to_string(kind.bit_depth) + " bits; flow in a PNG needs 16-bit colour (KITTI's layout)");
  const Image<Rgb16> image = DecodeRgb16Png(bytes, path.string());
  NumberPicture flow{image.width(), image.height(), 2, {}};
  for (const Rgb16 p : image.pixels()) {
    flow.values.push_back(p.b ? (p.r - 32768.0) / 64 : kNan);
    flow.values.push_back(p.b ? (p.g - 32768.0) / 64 : kNan);
  }
  return flow;
}

NumberPicture FromExr(const fs::path& path, bool visible) {
  const Bytes bytes = ReadFile(path);
  const Image<float> dx = DecodeExrChannel(bytes, path.string(), "dx"), dy = DecodeExrChannel(bytes, path.string(), "dy");
  Image<float> occluded;
  if (visible) occluded = DecodeExrChannel(bytes, path.string(), "occluded");
  NumberPicture flow{dx.width(), dx.height(), 2, {}};
  for (size_t i = 0; i < dx.size(); ++i) {
    const bool known = !visible || occluded.pixels()[i] == 0;
    flow.values.push_back(known ? dx.pixels()[i] : kNan);
    flow.values.push_back(known ? dy.pixels()[i] : kNan);
  }
  return flow;
}

NumberPicture FromNpyFlow(const fs::path& path) {
  NumberArray array = DecodeNpy(ReadFile(path), path.string());
  const auto& s = array.shape;
  if (s.size() == 3 && s[2] == 2) return {static_cast<int>(s[1]), static_cast<int>(s[0]), 2, std::move(array.values)};
  if (s.size() != 3 || s[0] != 2) throw InputError(path.string() + ": flow is an array of (H, W, 2) or (2, H, W)");
  const size_t pixels = array.values.size() / 2;
  NumberPicture flow{static_cast<int>(s[2]), static_cast<int>(s[1]), 2, std::vector<double>(2 * pixels)};
  for (size_t i = 0; i < pixels; ++i) {
    flow.values[2 * i] = array.values[i];
    flow.values[2 * i + 1] = array.values[pixels + i];
  }
  return flow;
}

}  // namespace

NumberPicture ReadFlowPicture(const fs::path& path, bool visible) {
  const std::string ending = LowerCaseExtension(path);
  if (visible && ending != ".exr")
    throw InputError(path.string() +
                     ": --visible needs the channel `occluded` of an .exr; give the truth as one (flow/ of a dataset of ours)");
  if (ending == ".flo") return FromFlo(path);
  if (ending == ".png") return FromKitti(path);
  if (ending == ".exr") return FromExr(path, visible);
  if (ending == ".npy") return FromNpyFlow(path);
  throw InputError(path.string() + ": is no .flo, .npy, .exr or 16-bit .png");
}

}  // namespace airsim360

#include "airsim360/eval/files/picture_files.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/file_name.h"
#include "airsim360/eval/files/hdf5_file.h"
#include "airsim360/eval/files/number_array.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/exr_metadata.h"
#include "airsim360/image/palette_png.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

std::string ShapeText(const NumberArray& array) {
  std::string text;
  for (const int64_t n : array.shape) text += (text.empty() ? "" : ", ") + std::to_string(n);
  return "(" + text + ")";
}

// (H, W), or with ones around it.
NumberPicture OneChannel(NumberArray array, const fs::path& path) {
  std::vector<int64_t> shape;
  for (const int64_t n : array.shape) {
    if (n != 1) shape.push_back(n);
  }
  if (array.shape.size() == 2) shape = array.shape;
  if (shape.size() != 2 || shape[0] > kMaxPixels / shape[1])
    throw InputError(path.string() + ": an array of the shape " + ShapeText(array) + " is no picture (H, W)");
  return {static_cast<int>(shape[1]), static_cast<int>(shape[0]), 1, std::move(array.values)};
}

template <class Pixel>
NumberPicture FromImage(const Image<Pixel>& image, double scale) {
  NumberPicture picture{image.width(), image.height(), 1, {}};
  picture.values.reserve(image.size());
  for (const Pixel p : image.pixels()) picture.values.push_back(static_cast<double>(p) * scale);
  return picture;
}

// The only channel, or the one that is named as depth; Y and Z of positions are none.
std::string DepthChannel(const Bytes& bytes, const fs::path& path) {
  const std::vector<std::string> channels = ExrChannels(bytes, path.string());
  if (channels.size() == 1) return channels[0];
  const auto has = [&](const char* name) { return std::find(channels.begin(), channels.end(), name) != channels.end(); };
  for (const char* name : {"range", "Range", "depth", "Depth", "Z", "Y"}) {
    if (has(name) && !(has("X") && (*name == 'Y' || *name == 'Z'))) return name;
  }
  std::string list;
  for (const std::string& name : channels) list += (list.empty() ? "" : ", ") + name;
  throw InputError(path.string() + ": an EXR of the channels " + list + "; depth needs one channel, or one named range, depth, Z or Y");
}

LabelPicture FromNpy(const fs::path& path) {
  const NumberPicture numbers = OneChannel(DecodeNpy(ReadFile(path), path.string()), path);
  LabelPicture labels{numbers.width, numbers.height, {}};
  labels.ids.reserve(numbers.values.size());
  for (const double v : numbers.values) {
    if (!(v >= 0 && v <= 0xffffffffu && v == std::floor(v)))
      throw InputError(path.string() + ": has the value " + std::to_string(v) + ", which is no id");
    labels.ids.push_back(static_cast<uint32_t>(v));
  }
  return labels;
}

// Ids in the alpha channel, as the AirSim360 release has them beside a colour of each class; no pixels where alpha is transparency or is not there.
LabelPicture FromAlpha(const Image<Rgba8>& image) {
  LabelPicture labels{image.width(), image.height(), {}};
  labels.ids.reserve(image.size());
  std::unordered_map<uint32_t, uint32_t> id_of_color;
  bool opaque = false, between = false;
  for (const Rgba8 p : image.pixels()) {
    opaque |= p.a == 255;
    between |= p.a > 0 && p.a < 255;
    if (id_of_color.emplace(p.r | p.g << 8 | p.b << 16, p.a).first->second != p.a) return {};
    labels.ids.push_back(p.a);
  }
  return opaque && !between ? LabelPicture{} : labels;
}

}  // namespace

NumberPicture ReadDepthPicture(const fs::path& path, const DepthFileOptions& options) {
  const std::string ending = LowerCaseExtension(path);
  if (ending == ".npy") return OneChannel(DecodeNpy(ReadFile(path), path.string()), path);
  if (ending == ".exr") {
    const Bytes bytes = ReadFile(path);
    return FromImage(DecodeExrChannel(bytes, path.string(), DepthChannel(bytes, path)), 1);
  }
  if (ending == ".h5" || ending == ".hdf5") return OneChannel(ReadHdf5(path, options.h5_key), path);
  if (ending == ".png") {
    const Bytes bytes = ReadFile(path);
    const PngKind kind = ReadPngKind(bytes, path.string());
    if (kind.channels != 1 || kind.bit_depth != 16)
      throw InputError(path.string() + ": a PNG of " + std::to_string(kind.channels) + " channels and " + std::to_string(kind.bit_depth) +
                       " bits; depth needs 16-bit gray");
    return FromImage(DecodeGrayPng(bytes, path.string()), options.png_scale);
  }
  throw InputError(path.string() + ": is no .npy, .exr, .h5, .hdf5 or 16-bit .png");
}

LabelPicture ReadLabelPicture(const fs::path& path) {
  if (LowerCaseExtension(path) == ".npy") return FromNpy(path);
  const Bytes bytes = ReadFile(path);
  if (ReadPngKind(bytes, path.string()).channels == 3 && !IsPalettePng(bytes, path.string())) {
    LabelPicture labels = FromAlpha(DecodeRgba8(bytes, path.string()));
    if (!labels.ids.empty()) return labels;
    throw InputError(
        path.string() +
        ": a PNG of colours, not of ids: label pictures are gray or have a palette (of colours an alpha channel may hold the ids)");
  }
  const Image<uint16_t> image = DecodeLabelPng(bytes, path.string());
  return {image.width(), image.height(), {image.pixels().begin(), image.pixels().end()}};
}

LabelPicture ReadIdPicture(const fs::path& path) {
  if (LowerCaseExtension(path) == ".npy") return FromNpy(path);
  const Image<uint32_t> image = DecodeIdPng(ReadFile(path), path.string());
  return {image.width(), image.height(), {image.pixels().begin(), image.pixels().end()}};
}

}  // namespace airsim360

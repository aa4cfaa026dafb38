#include "airsim360/eval/files/picture_files.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/eval/files/hdf5_file.h"
#include "airsim360/eval/files/number_array.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/palette_png.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

std::string Ending(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

std::string ShapeText(const NumberArray& array) {
  std::string text;
  for (const int64_t n : array.shape) text += (text.empty() ? "(" : ", ") + std::to_string(n);
  return text + ")";
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

// Files by their path below the folder, without the ending.
std::map<std::string, fs::path> FilesBelow(const fs::path& folder, const std::vector<std::string>& endings) {
  std::map<std::string, fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || std::find(endings.begin(), endings.end(), Ending(entry.path())) == endings.end()) continue;
    const std::string name = entry.path().lexically_relative(folder).replace_extension().string();
    const auto [at, fresh] = files.emplace(name, entry.path());
    if (!fresh)
      throw InputError(folder.string() + ": two files are named " + name + ": " + at->second.filename().string() + " and " +
                       entry.path().filename().string());
  }
  return files;
}

fs::path ProductFolder(const fs::path& path, const std::string& product) {
  return fs::exists(path / "meta.json") && fs::is_directory(path / product) ? path / product : path;
}

}  // namespace

NumberPicture ReadDepthPicture(const fs::path& path, const DepthFileOptions& options) {
  const std::string ending = Ending(path);
  if (ending == ".npy") return OneChannel(DecodeNpy(ReadFile(path), path.string()), path);
  if (ending == ".exr") return FromImage(DecodeExr(ReadFile(path), path.string()), 1);
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
  if (Ending(path) == ".npy") return FromNpy(path);
  const Image<uint16_t> image = DecodeLabelPng(ReadFile(path), path.string());
  return {image.width(), image.height(), {image.pixels().begin(), image.pixels().end()}};
}

LabelPicture ReadIdPicture(const fs::path& path) {
  if (Ending(path) == ".npy") return FromNpy(path);
  const Image<uint32_t> image = DecodeIdPng(ReadFile(path), path.string());
  return {image.width(), image.height(), {image.pixels().begin(), image.pixels().end()}};
}

FilePairs PairFiles(const fs::path& prediction, const fs::path& truth, const std::vector<std::string>& endings,
                    const std::string& product) {
  for (const fs::path& path : {prediction, truth}) {
    if (!fs::exists(path)) throw InputError(path.string() + ": does not exist");
  }
  if (fs::is_directory(prediction) != fs::is_directory(truth))
    throw InputError((fs::is_directory(prediction) ? truth : prediction).string() + " is a file, " +
                     (fs::is_directory(prediction) ? prediction : truth).string() + " a folder: give two of a kind");
  if (!fs::is_directory(truth)) return {{{truth.stem().string(), prediction, truth}}, {}};
  const auto truths = FilesBelow(ProductFolder(truth, product), endings);
  auto predictions = FilesBelow(ProductFolder(prediction, product), endings);
  if (truths.empty()) {
    std::string list;
    for (const std::string& ending : endings) list += (list.empty() ? "" : ", ") + ending;
    throw InputError(truth.string() + ": has no files " + list);
  }
  FilePairs result;
  std::vector<std::string> missing;
  for (const auto& [name, path] : truths) {
    const auto found = predictions.find(name);
    if (found == predictions.end()) {
      missing.push_back(name);
      continue;
    }
    result.pairs.push_back({name, found->second, path});
    predictions.erase(found);
  }
  if (!missing.empty())
    throw InputError(
        prediction.string() + ": has no prediction for " + std::to_string(missing.size()) + " of " + std::to_string(truths.size()) +
        " pictures, '" + missing[0] + "' first" +
        (predictions.empty() ? "" : "; it has '" + predictions.begin()->first + "', which the truth has not: are files named otherwise?"));
  if (!predictions.empty())
    result.notes.push_back(std::to_string(predictions.size()) + " predictions have no truth and are left out, '" +
                           predictions.begin()->first + "' first");
  return result;
}

}  // namespace airsim360

// airsim360 stitch: six cube faces to one equirectangular picture.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "airsim360/app/cube_folder.h"
#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/file_name.h"
#include "airsim360/base/parallel.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/palette_png.h"
#include "airsim360/projection/resample.h"

namespace airsim360 {
namespace {
namespace fs = std::filesystem;

struct StitchOptions {
  std::string cube, out, size, filter, axes = "camera";
  bool depth_z = false, nearest = false;
};

Image<Rgb8> DecodeRgb8(const Bytes& bytes, const std::string& name) {
  const Image<Rgba8> rgba = DecodeRgba8(bytes, name);
  Image<Rgb8> rgb(rgba.width(), rgba.height());
  std::transform(rgba.pixels().begin(), rgba.pixels().end(), rgb.pixels().begin(), [](Rgba8 p) { return Rgb8{p.r, p.g, p.b}; });
  return rgb;
}

Image<uint8_t> DecodeGray8(const Bytes& bytes, const std::string& name) {
  const Image<uint16_t> wide = DecodeGrayPng(bytes, name);
  Image<uint8_t> gray(wide.width(), wide.height());
  std::transform(wide.pixels().begin(), wide.pixels().end(), gray.pixels().begin(), [](uint16_t v) { return static_cast<uint8_t>(v); });
  return gray;
}

/// What one stitch did, for the report.
struct Result {
  Bytes bytes;
  int face_size = 0;
  Equirectangular target;
  double stitch_ms = 0;
};

/// The size asked for; by default an equatorial pixel is as wide as the mean of a face's texels.
Equirectangular TargetOf(const StitchOptions& options, int face_size) {
  ImageSize size{4 * face_size, 2 * face_size};
  if (!options.size.empty()) size = ParseSize(options.size);
  CheckPanoramaSize(size);
  if (int64_t{size.width} * size.height > kMaxPixels) {
    throw InputError("--size: " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                     " pixels are too many; give a smaller --size");
  }
  return {size.width, size.height};
}

/// Decodes six faces, stitches them and encodes the picture.
template <class Pixel, class Decode, class Stitch, class Encode>
Result Run(const StitchOptions& options, const CubeFolder& folder, const Decode& decode, const Stitch& stitch, const Encode& encode) {
  CubeFaces<Pixel> faces;
  std::array<std::string, 6> names;
  for (size_t f = 0; f < 6; ++f) names[f] = folder.files[f].string();
  ParallelFor(6, [&](int64_t f) { faces[f] = decode(folder.bytes[f], names[f]); });
  Result result;
  result.face_size = CheckFaces(faces, names);
  result.target = TargetOf(options, result.face_size);

  const auto start = std::chrono::steady_clock::now();
  const Image<Pixel> picture = stitch(faces, result.target);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  result.stitch_ms = time.count();
  result.bytes = encode(picture);
  return result;
}

Result StitchFolder(const StitchOptions& options, const CubeFolder& folder, bool nearest) {
  const auto pick = [](const auto& faces, const Equirectangular& target) { return StitchNearest(faces, target); };
  const auto colors = [&](const auto& faces, const Equirectangular& target) {
    return nearest ? StitchNearest(faces, target) : StitchFiltered(faces, target);
  };
  const auto ranges = [&](const CubeFaces<float>& faces, const Equirectangular& target) {
    return options.depth_z ? StitchRangeFromDepth(faces, target) : StitchNearest(faces, target);
  };
  const auto png = [](const auto& picture) { return EncodePng(picture); };
  const auto photograph = [&](const Image<Rgb8>& picture) {
    // A filtered picture is for viewers; labels stay bare.
    const auto gpano = nearest ? std::nullopt : std::optional(GPano{});
    return LowerCaseExtension(options.out) == ".png" ? EncodePng(picture, gpano) : EncodeJpeg(picture, 95, gpano);
  };
  switch (folder.kind) {
    case FaceKind::kGray8:
      return Run<uint8_t>(options, folder, DecodeGray8, pick, png);
    case FaceKind::kPalette: {
      const auto decode = [](const Bytes& bytes, const std::string& name) { return DecodePalettePng(bytes, name).indices; };
      const std::vector<Rgb8> palette = DecodePalettePng(folder.bytes[0], folder.files[0].string()).palette;
      return Run<uint8_t>(options, folder, decode, pick, [&](const auto& picture) { return EncodePalettePng(picture, palette); });
    }
    case FaceKind::kGray16:
      return Run<uint16_t>(options, folder, DecodeGrayPng, pick, png);
    case FaceKind::kColor16:
      return Run<Rgb16>(options, folder, DecodeRgb16Png, colors, png);
    case FaceKind::kRange:
      return Run<float>(options, folder, DecodeExr, ranges, [](const auto& picture) { return EncodeExr(picture); });
    case FaceKind::kColor8:
      break;
  }
  return Run<Rgb8>(options, folder, DecodeRgb8, colors, photograph);
}

/// Whether nearest pixels are taken: as asked, else for everything but colour.
bool UseNearest(const StitchOptions& options, FaceKind kind) {
  const bool color = kind == FaceKind::kColor8 || kind == FaceKind::kColor16;
  if (options.nearest && options.filter == "linear") throw InputError("--nearest contradicts --filter linear");
  if (options.filter == "linear" && !color) {
    throw InputError(std::string("--filter: 'linear' would mix ") + (kind == FaceKind::kRange ? "ranges" : "label ids") +
                     " of neighbours; use 'nearest'");
  }
  return options.nearest || options.filter == "nearest" || !color;
}

void CheckFlags(const StitchOptions& options) {
  const auto check = [](const char* flag, const std::string& value, const std::vector<std::string>& choices) {
    ParseChoice("value", value, choices, flag);
  };
  check("--axes", options.axes, {"camera", "body", "opengl"});
  if (!options.filter.empty()) check("--filter", options.filter, {"linear", "nearest"});
}

/// The extension of --out must be able to hold what the faces hold.
void CheckOut(const StitchOptions& options, FaceKind kind, bool nearest) {
  const std::string extension = LowerCaseExtension(options.out);
  std::vector<std::string> fitting = {".png"};
  if (kind == FaceKind::kRange) fitting = {".exr"};
  if (kind == FaceKind::kColor8 && !nearest) fitting = {".png", ".jpg", ".jpeg"};
  if (std::find(fitting.begin(), fitting.end(), extension) != fitting.end()) return;
  throw InputError("--out: '" + options.out + "': faces of " + kFaceKindNames[static_cast<int>(kind)] + (nearest ? " (nearest)" : "") +
                   " are written as " + fitting.front());
}

void RunStitch(const StitchOptions& options, const GlobalOptions& globals) {
  CheckFlags(options);
  const CubeFolder faces = ReadCubeFolder(options.cube, options.axes);
  const bool nearest = UseNearest(options, faces.kind);
  CheckOut(options, faces.kind, nearest);
  if (options.depth_z && faces.kind != FaceKind::kRange) {
    throw InputError(std::string("--depth-z: the faces are ") + kFaceKindNames[static_cast<int>(faces.kind)] +
                     "; planar depth is read from .exr files");
  }
  const Result result = StitchFolder(options, faces, nearest);
  if (const fs::path parent = fs::path(options.out).parent_path(); !parent.empty()) CreateWritableFolder(parent);
  WriteFileAtomically(options.out, result.bytes);

  // The report.
  if (!globals.json) {
    std::printf("%s: %dx%d from six faces of %d pixels\n", options.out.c_str(), result.target.width, result.target.height,
                result.face_size);
    return;
  }
  nlohmann::ordered_json names;
  for (size_t f = 0; f < 6; ++f) names[kCubeFaceNames[f]] = faces.files[f].string();
  PrintJson({{"out", options.out},
             {"width", result.target.width},
             {"height", result.target.height},
             {"face_size", result.face_size},
             {"kind", kFaceKindNames[static_cast<int>(faces.kind)]},
             {"filter", nearest ? "nearest" : "linear"},
             {"faces", names},
             {"stitch_ms", result.stitch_ms}});
}

}  // namespace

void AddStitchCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("stitch", "six cube faces to one equirectangular picture");
  const auto options = std::make_shared<StitchOptions>();
  command
      ->add_option("--cube", options->cube,
                   "folder of six files whose names end in +x -x +y -y +z -z (or posx negx ..., px nx ...): "
                   "PNG, JPEG or EXR")
      ->required();
  command->add_option("--out", options->out, "picture to write: .png or .jpg, .exr for a range")->required();
  command->add_option("--size", options->size, "WxH of the picture (default: 4 x 2 faces)");
  command->add_flag("--depth-z", options->depth_z, "the .exr faces hold planar depth along each face's axis: write range");
  command->add_flag("--nearest", options->nearest, "take nearest pixels: for labels in colour, as entity ids");
  command->add_option("--filter", options->filter, "linear or nearest (default: linear for colour, else nearest)");
  command->add_option("--axes", options->axes,
                      "frame of the face names: camera (+X right, +Y down, +Z forward; default), body (+X "
                      "forward, +Y left, +Z up) or opengl (+X right, +Y up, +Z forward)");
  command->callback([options, &globals] { RunStitch(*options, globals); });
}

}  // namespace airsim360

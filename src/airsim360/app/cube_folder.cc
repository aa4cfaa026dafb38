#include "airsim360/app/cube_folder.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/file_name.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/palette_png.h"
#include "airsim360/projection/camera.h"

namespace airsim360 {
namespace {
namespace fs = std::filesystem;

std::string LowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// Place among C's faces of the face that is called `name` in `axes`: body +x (forward) is C's +z, and so on.
size_t FaceIndex(std::string_view name, std::string_view axes) {
  static constexpr std::array<const char*, 6> kBodyNames = {"-y", "+y", "-z", "+z", "+x", "-x"};
  static constexpr std::array<const char*, 6> kOpenGlNames = {"+x", "-x", "-y", "+y", "+z", "-z"};
  const auto& names = axes == "body" ? kBodyNames : axes == "opengl" ? kOpenGlNames : kCubeFaceNames;
  return static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Name of the face at the end of a file's stem ("000000_+x", "sky-posx", "nx"), "" if there is none.
std::string FaceNameOf(const std::string& stem) {
  for (const char* name : kCubeFaceNames) {
    const bool positive = name[0] == '+';
    for (const std::string& spelling :
         {std::string(name), std::string(positive ? "pos" : "neg") + name[1], std::string(positive ? "p" : "n") + name[1]}) {
      if (!stem.ends_with(spelling)) continue;
      // A word must stand alone: "512px" is not a face.
      const size_t before = stem.size() - spelling.size();
      if (std::ispunct(spelling[0]) || before == 0 || !std::isalnum(static_cast<unsigned char>(stem[before - 1]))) return name;
    }
  }
  return "";
}

using FaceFiles = std::array<fs::path, 6>;

/// The file of every face, in the order of kCubeFaceNames.
FaceFiles FindFaces(const std::string& folder, const std::string& axes) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw InputError("--cube: '" + folder + "' is not a folder");
  std::vector<fs::path> pictures;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string extension = LowerCaseExtension(entry.path());
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".exr") {
      pictures.push_back(entry.path());
    }
  }
  if (error) throw InputError("--cube: '" + folder + "': " + error.message());
  std::sort(pictures.begin(), pictures.end());

  // Each face must be there once.
  std::map<std::string, fs::path> found;
  for (const fs::path& picture : pictures) {
    const std::string name = FaceNameOf(LowerCase(picture.stem()));
    if (name.empty()) continue;
    const auto [at, fresh] = found.emplace(name, picture);
    if (!fresh) {
      throw InputError("--cube: two files for face " + name + ": " + at->second.filename().string() + " and " +
                       picture.filename().string());
    }
  }
  std::string missing, seen;
  FaceFiles files;
  for (const char* name : kCubeFaceNames) {
    const auto at = found.find(name);
    if (at == found.end()) missing += (missing.empty() ? "" : ", ") + std::string(name);
    if (at != found.end()) files[FaceIndex(name, axes)] = at->second;
  }
  if (missing.empty()) return files;
  for (size_t i = 0; i < std::min<size_t>(pictures.size(), 12); ++i) {
    seen += (seen.empty() ? "" : ", ") + pictures[i].filename().string();
  }
  throw InputError("--cube: '" + folder + "' lacks faces " + missing + " (files whose name ends in the face name, as +x.png); " +
                   (seen.empty() ? "there are no pictures" : "there are: " + seen));
}

FaceKind KindOf(const fs::path& path, const Bytes& bytes) {
  const std::string extension = LowerCaseExtension(path);
  if (extension == ".exr") return FaceKind::kRange;
  if (extension != ".png") return FaceKind::kColor8;
  const PngKind png = ReadPngKind(bytes, path.string());
  if (png.channels == 1) return png.bit_depth == 16 ? FaceKind::kGray16 : FaceKind::kGray8;
  return png.bit_depth == 16 ? FaceKind::kColor16 : FaceKind::kColor8;
}

// Whether six 8-bit pictures are of labels: palette pictures of one palette. Colours that a program has squeezed into
// palettes have one of their own each.
bool ShareAPalette(const CubeFolder& faces) {
  const auto palette_of = [&](size_t f) {
    const std::string name = faces.files[f].string();
    if (LowerCaseExtension(name) != ".png" || !IsPalettePng(faces.bytes[f], name)) return std::vector<Rgb8>{};
    return DecodePalettePng(faces.bytes[f], name).palette;
  };
  const std::vector<Rgb8> first = palette_of(0);
  for (size_t f = 1; f < 6 && !first.empty(); ++f) {
    if (palette_of(f) != first) return false;
  }
  return !first.empty();
}

}  // namespace

CubeFolder ReadCubeFolder(const std::string& folder, const std::string& axes) {
  CubeFolder faces{.files = FindFaces(folder, axes), .bytes = {}};
  for (size_t f = 0; f < 6; ++f) {
    faces.bytes[f] = ReadFile(faces.files[f]);
    const FaceKind kind = KindOf(faces.files[f], faces.bytes[f]);
    if (f == 0) faces.kind = kind;
    if (kind != faces.kind) {
      throw InputError("--cube: " + faces.files[0].filename().string() + " is " + kFaceKindNames[static_cast<int>(faces.kind)] + ", " +
                       faces.files[f].filename().string() + " is " + kFaceKindNames[static_cast<int>(kind)] +
                       "; all faces must be of one kind");
    }
  }
  if (faces.kind == FaceKind::kColor8 && ShareAPalette(faces)) faces.kind = FaceKind::kPalette;
  return faces;
}

}  // namespace airsim360

// Finding and reading the six pictures of a cube in a folder.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "airsim360/base/file.h"

namespace airsim360 {

/// What the pictures of a cube hold, told by their extension and header.
/// kPalette: label ids below 256, all six with one palette.
enum class FaceKind { kColor8, kColor16, kGray8, kGray16, kRange, kPalette };
inline constexpr const char* kFaceKindNames[] = {"8-bit colour", "16-bit colour", "8-bit gray",
                                                 "16-bit gray",  "range",         "labels with a palette"};

/// Six files, in the order of kCubeFaceNames in the camera frame C.
struct CubeFolder {
  std::array<std::filesystem::path, 6> files;
  std::array<Bytes, 6> bytes;
  FaceKind kind = FaceKind::kColor8;
};

/// Reads the six PNG, JPEG or EXR files of `folder` whose stems end in a face name: "+x", or the words "posx"
/// or "px" ("negx", "nx"), in any case. `axes` is the frame of the names: "camera" (C), "body" (+X forward,
/// +Y left, +Z up) or "opengl" (+X right, +Y up, +Z forward). InputError naming --cube and the reason: faces
/// that are missing (and what is there) or there twice, different kinds.
CubeFolder ReadCubeFolder(const std::string& folder, const std::string& axes);

}  // namespace airsim360

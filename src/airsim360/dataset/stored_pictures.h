// The pictures of a frame as readers of its files get them, without files: what a file loses is lost, what it rounds is rounded.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/dataset/record/spec.h"

namespace airsim360 {

/// One picture in memory, top row first, tightly packed.
struct StoredPicture {
  enum class Type : uint8_t { kUint8, kUint16, kUint32, kFloat32 };
  std::string product;
  std::string view;  ///< as in names of files, without the '_' before it: "", "+x", "front"
  Type type = Type::kUint8;
  int width = 0, height = 0;
  int depth = 1;                           ///< values a pixel; colours have 3
  std::vector<std::string> channels = {};  ///< names of the values, where a file names several: flow, coverage, position
  Bytes values = {};
};
/// Bytes of one value.
size_t SizeOf(StoredPicture::Type type);

/// All products of the spec, in the order of its files; one capture for each of `views`. Entity ids are as they are in the files.
/// `sky`: the entity that is the sky; `wide`: NeedsWideSemantics of the dataset.
std::vector<StoredPicture> StoredPictures(const DatasetSpec& spec, std::span<const View> views, std::span<const Capture> captures,
                                          EntityId sky, bool wide);

/// Pictures and a text as bytes for the disk cache; pictures of ids are compressed.
Bytes PackPictures(const std::string& text, const std::vector<StoredPicture>& pictures);
/// What was packed; false where the bytes are not such. Only the program that wrote them can read them.
bool UnpackPictures(std::span<const std::byte> bytes, std::string& text, std::vector<StoredPicture>& pictures);

}  // namespace airsim360

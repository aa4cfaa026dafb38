// Pictures as one binary message: "A360", the length of a JSON header, the header, then the planes that it lists, each at a
// multiple of four bytes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "airsim360/dataset/stored_pictures.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {

/// Collects planes of a message.
class PlaneMessage {
 public:
  /// A JPEG file of the colours.
  void AddPicture(const Image<Rgb8>& rgb);
  /// The same of a file that is one.
  void AddJpeg(std::string_view file, int width, int height);
  /// A product of the frame under its name in datasets: range, semantic, entity, normal (8 bits), albedo, material, position,
  /// flow (dx and dy), coverage (the largest share). False for a name that is none.
  bool AddProduct(const Frame& frame, const std::string& name);
  /// The same of a picture of a dataset in memory, under its product's name.
  void AddStored(const StoredPicture& picture);
  /// `fields`: the rest of the header's object, "\"seq\":1,…".
  std::string Finish(const std::string& fields) const;

 private:
  void Add(const std::string& product, const char* plane, const char* type, int width, int height, const void* data, size_t bytes);

  std::string list_, data_;
};

}  // namespace airsim360

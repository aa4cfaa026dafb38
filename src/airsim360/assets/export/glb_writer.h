// The binary container of a glTF file while it is being filled.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "airsim360/base/file.h"
#include "airsim360/math/vector.h"
#include "airsim360/scene/vertex_color.h"

namespace airsim360::internal {

/// The JSON document and its one buffer.
class GlbWriter {
 public:
  nlohmann::ordered_json json;

  GlbWriter();

  /// Bytes of a picture; returns the index of its view.
  size_t AddView(std::span<const std::byte> bytes);
  /// Accessors of vertices and indices; positions carry their bounds.
  size_t AddPositions(std::span<const Vec3f> positions_G);
  size_t AddVectors(std::span<const Vec3f> vectors_G);
  size_t AddUvs(std::span<const Vec2f> uvs);
  /// Four numbers of 16 bits, normalised.
  size_t AddColors(std::span<const VertexColor> colors);
  size_t AddIndices(std::span<const uint32_t> indices);
  /// Appends to an array member and returns the new element's index.
  size_t Append(const char* array, nlohmann::ordered_json element);
  /// Notes an extension as used.
  void Use(const std::string& extension);

  /// The file. InputError if it is larger than the 4 GiB that its header can say.
  Bytes Finish();

 private:
  size_t AddAccessor(std::span<const std::byte> bytes, int target, int component_type, const char* type, size_t count);

  Bytes binary_;
};

}  // namespace airsim360::internal

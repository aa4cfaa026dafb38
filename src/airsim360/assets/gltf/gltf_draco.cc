#include "airsim360/assets/gltf/gltf_draco.h"

#include <draco/compression/decode.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include <algorithm>
#include <new>
#include <stdexcept>

namespace airsim360::internal {
namespace {

// The sizes that the head of a stream claims, so that they can be refused before the decoder takes memory for
// them. Layout: the Draco bitstream specification, sections 2 and 3 (header, metadata, connectivity).
bool ClaimedSizes(std::span<const std::byte> stream, uint64_t& points, uint64_t& faces) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
  char magic[5];
  uint8_t major = 0, minor = 0, type = 0, method = 0, traversal = 0;
  uint16_t flags = 0;
  const bool header = buffer.Decode(magic, 5) && buffer.Decode(&major) && buffer.Decode(&minor) && buffer.Decode(&type) &&
                      buffer.Decode(&method) && buffer.Decode(&flags);
  if (!header || !std::equal(magic, magic + 5, "DRACO") || type != 1 || method > 1) return false;
  buffer.set_bitstream_version(static_cast<uint16_t>((major << 8) | minor));
  if (major != 2 || minor < 2) return false;
  if ((flags & 0x8000) != 0) {
    draco::GeometryMetadata metadata;
    if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata)) return false;
  }

  // Sequential: faces, points. Edgebreaker: traversal kind, vertices, faces.
  uint32_t first = 0, second = 0;
  if (method == 1 && !buffer.Decode(&traversal)) return false;
  if (!draco::DecodeVarint(&first, &buffer) || !draco::DecodeVarint(&second, &buffer)) return false;
  points = method == 1 ? first : second;
  faces = method == 1 ? second : first;
  return true;
}

std::vector<float> ReadAttribute(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int components, const JsonRef& where) {
  std::vector<float> out(size_t{mesh.num_points()} * static_cast<size_t>(components));
  float value[4] = {};
  for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
    const draco::AttributeValueIndex index = attribute.mapped_index(point);
    if (index.value() >= attribute.size() || !attribute.ConvertValue<float>(index, static_cast<int8_t>(components), value)) {
      where.Fail("damaged Draco attribute");
    }
    std::copy(value, value + components, out.begin() + static_cast<std::ptrdiff_t>(point.value()) * components);
  }
  return out;
}

}  // namespace

DracoMesh DecodeDraco(std::span<const std::byte> stream, const JsonRef& where, const JsonRef& attributes,
                      const std::map<std::string, int>& components, const ImportLimits& limits) {
  uint64_t points = 0, faces = 0;
  if (!ClaimedSizes(stream, points, faces)) where.Fail("not a Draco 2.2 mesh");
  const uint64_t most = std::min({limits.max_triangles, limits.max_vertices, uint64_t{stream.size()} * 1000});
  if (points > most || faces > most) {
    where.Fail("claims " + std::to_string(points) + " points and " + std::to_string(faces) + " faces in " + std::to_string(stream.size()) +
               " bytes");
  }

  std::unique_ptr<draco::Mesh> mesh;
  try {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
    auto result = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!result.ok()) where.Fail(std::string("damaged Draco data: ") + result.status().error_msg());
    mesh = std::move(result).value();
  } catch (const std::bad_alloc&) {
    where.Fail("damaged Draco data: it asks for too much memory");
  } catch (const std::length_error&) {
    where.Fail("damaged Draco data: it asks for too much memory");
  }

  DracoMesh out;
  out.vertices = mesh->num_points();
  if (out.vertices > limits.max_vertices || mesh->num_faces() > limits.max_triangles) where.Fail("too many vertices or faces");
  for (draco::FaceIndex face(0); face < mesh->num_faces(); ++face) {
    for (const draco::PointIndex& point : mesh->face(face)) out.indices.push_back(point.value());
  }
  for (const std::string& name : attributes.Keys()) {
    const auto wanted = components.find(name);
    const JsonRef id = attributes.At(name);
    const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(static_cast<uint32_t>(id.Uint(UINT32_MAX)));
    if (!attribute) id.Fail("the Draco data has no such attribute");
    if (wanted != components.end()) out.attributes[name] = ReadAttribute(*mesh, *attribute, wanted->second, id);
  }
  return out;
}

}  // namespace airsim360::internal

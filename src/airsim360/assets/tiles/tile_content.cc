// Contents of tiles: glTF by itself, in a batched tile, in a composite one.
#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>

#include "airsim360/assets/gltf/gltf.h"
#include "airsim360/assets/gltf/gltf_uri.h"
#include "airsim360/assets/tiles/tiles.h"
#include "airsim360/assets/tiles/tiles_parts.h"
#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

uint32_t LoadU32(std::span<const std::byte> bytes, size_t at) {
  uint32_t value = 0;
  for (size_t k = 0; k < 4; ++k) value |= std::to_integer<uint32_t>(bytes[at + k]) << (8 * k);
  return value;
}

// The glTF of a batched tile (28 bytes of header, then feature and batch tables), and the point that its coordinates
// are relative to.
struct Batched {
  std::span<const std::byte> gltf;
  Vec3d center;
};

Batched OpenBatched(const std::string& name, std::span<const std::byte> bytes) {
  constexpr size_t kHeader = 28;
  const auto fail = [&](const std::string& what) { throw InputError(name + ": " + what); };
  if (bytes.size() < kHeader) fail("a batched tile cut short");
  if (LoadU32(bytes, 4) != 1) fail("a batched tile of version " + std::to_string(LoadU32(bytes, 4)) + ": only 1 is read");
  const uint64_t length = LoadU32(bytes, 8);
  if (length > bytes.size()) fail("the header says " + std::to_string(length) + " bytes, there are " + std::to_string(bytes.size()));
  uint64_t tables = 0;
  for (size_t at : {12, 16, 20, 24}) tables += LoadU32(bytes, at);
  if (length < kHeader || tables > length - kHeader)
    fail("its tables are longer than the tile (headers of before 3D Tiles 1.0 are not read)");
  Batched out{bytes.subspan(kHeader + tables, length - kHeader - tables), {}};
  const std::span<const std::byte> features = bytes.subspan(kHeader, LoadU32(bytes, 12)),
                                   binary = bytes.subspan(kHeader + features.size(), LoadU32(bytes, 16));
  const std::string where = name + ": feature table";
  if (features.empty()) return out;
  const nlohmann::json json = ParseJson(where, AsText(features));
  const auto center = JsonRef(where, json).Find("RTC_CENTER");
  if (!center) return out;
  if (center->IsArray()) {
    const std::vector<double> v = center->Numbers(3);
    out.center = {v[0], v[1], v[2]};
    return out;
  }
  const uint64_t at = center->At("byteOffset").Uint();
  std::array<float, 3> v{};
  if (at > binary.size() || binary.size() - at < sizeof v) center->Fail("beyond the end of the table");
  std::memcpy(v.data(), binary.data() + at, sizeof v);
  out.center = {v[0], v[1], v[2]};
  return out;
}

// The rotation that readers of glTF apply: +Y up to +Z up.
TileTransform Undone(bool up_z) { return up_z ? TileTransform{Mat3d::FromColumns({1, 0, 0}, {0, 0, -1}, {0, 1, 0}), {}} : TileTransform{}; }

void Spend(uint64_t amount, uint64_t& budget) { budget -= std::min(amount, budget); }

}  // namespace

std::string FolderOf(const std::string& uri) {
  return IsDataUri(uri) ? "" : uri.substr(0, uri.find_last_of('/') == std::string::npos ? 0 : uri.find_last_of('/') + 1);
}

void TileGatherer::AddGltf(const std::string& name, const std::string& uri, std::span<const std::byte> bytes, const TileTransform& X,
                           bool up_z) {
  const std::string folder = FolderOf(uri);
  const ResourceLoader load = [&](const std::string& beside) { return load_(folder + beside); };
  ImportedFile tile = ReadGltf(name, bytes, load, limits_);
  const auto textures = static_cast<TextureId>(out_.textures.size());
  const auto materials = static_cast<MaterialId>(out_.materials.size());
  const auto meshes = static_cast<int32_t>(out_.meshes.size()), nodes = static_cast<int32_t>(out_.nodes.size());
  for (Texture& texture : tile.textures) {
    Spend(texture.levels[0].size(), limits_.max_texture_pixels);
    out_.textures.push_back(std::move(texture));
  }
  for (Material& material : tile.materials) {
    for (TextureId* id :
         {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture, &material.emission_texture}) {
      if (*id != kNoTexture) *id += textures;
    }
    out_.materials.push_back(std::move(material));
  }
  for (const MaterialId id : tile.unlit) out_.unlit.push_back(id + materials);
  for (Mesh& mesh : tile.meshes) {
    for (MeshPart& part : mesh.parts) part.material += materials;
    Spend(mesh.positions.size(), limits_.max_vertices);
    Spend(mesh.triangles.size(), limits_.max_triangles);
    out_.meshes.push_back(std::move(mesh));
  }
  const TileTransform Y = X * Undone(up_z);
  for (ImportedNode& node : tile.nodes) {
    Mat3d A;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) A.m[i][j] = node.X_WM.A.m[i][j];
    }
    const Vec3d p = node.p_exact == Vec3d{} ? VecCast<double>(node.X_WM.p) : node.p_exact;
    const TileTransform placed = Y * TileTransform{A, p};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) node.X_WM.A.m[i][j] = static_cast<float>(placed.A.m[i][j]);
    }
    node.X_WM.p = VecCast<float>(placed.p);
    if (node.parent >= 0) node.parent += nodes;
    if (node.mesh >= 0) node.mesh += meshes;
    out_.nodes.push_back(std::move(node));
  }
  if (out_.copyright.empty()) out_.copyright = tile.copyright;
  for (const std::string& warning : tile.warnings) warnings_.Add(warning);
}

void TileGatherer::AddComposite(const std::string& name, const std::string& uri, std::span<const std::byte> bytes, const TileTransform& X,
                                bool up_z, int depth) {
  constexpr size_t kHeader = 16;
  constexpr int kDeepest = 8;
  const auto fail = [&](const std::string& what) { throw InputError(name + ": " + what); };
  if (depth >= kDeepest) fail("composite tiles nested deeper than 8");
  if (bytes.size() < kHeader || LoadU32(bytes, 8) > bytes.size() || LoadU32(bytes, 8) < kHeader) fail("a composite tile cut short");
  std::span<const std::byte> rest = bytes.first(LoadU32(bytes, 8)).subspan(kHeader);
  for (uint32_t i = 0, count = LoadU32(bytes, 12); i < count; ++i) {
    if (rest.size() < 12 || LoadU32(rest, 8) > rest.size() || LoadU32(rest, 8) < 12)
      fail("its tile " + std::to_string(i) + " is cut short");
    const size_t length = LoadU32(rest, 8);
    Add(name, uri, rest.first(length), X, up_z, depth + 1);
    rest = rest.subspan(length);
  }
}

void TileGatherer::Add(const std::string& name, const std::string& uri, std::span<const std::byte> bytes, const TileTransform& X, bool up_z,
                       int depth) {
  const std::string_view magic = AsText(bytes).substr(0, 4);
  if (magic == "b3dm") {
    const Batched tile = OpenBatched(name, bytes);
    AddGltf(name, uri, tile.gltf, X * TileTransform{{}, tile.center}, up_z);
  } else if (magic == "cmpt") {
    AddComposite(name, uri, bytes, X, up_z, depth);
  } else if (magic == "pnts" || magic == "i3dm") {
    warnings_.Add(name + (magic == "pnts" ? ": a point cloud is left out" : ": an instanced tile is left out"));
  } else {
    AddGltf(name, uri, bytes, X, up_z);
  }
}

ImportedFile TileGatherer::Take() {
  out_.warnings = warnings_.Take();
  return std::move(out_);
}

ImportedFile ReadTile(const std::string& file, std::span<const std::byte> bytes, const ResourceLoader& load, const ImportLimits& limits) {
  Warnings warnings;
  TileGatherer gatherer(load, limits, warnings);
  if (AsText(bytes).starts_with("b3dm")) {
    gatherer.Add(file, "", bytes, {{}, -OpenBatched(file, bytes).center}, false);
  } else {
    gatherer.Add(file, "", bytes, {}, false);
  }
  return gatherer.Take();
}

}  // namespace airsim360::internal

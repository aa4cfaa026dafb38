#include "airsim360/assets/tiles/tiles.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <queue>

#include "airsim360/assets/gltf/gltf_uri.h"
#include "airsim360/assets/tiles/tiles_parts.h"
#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/box.h"
#include "airsim360/math/geodesy.h"

namespace airsim360::internal {
namespace {

constexpr size_t kMostTilesets = 4096;
constexpr size_t kMostSeen = size_t{1} << 20;  // tiles looked at
constexpr int kDeepest = 512;

TileTransform ReadTransform(const JsonRef& tile) {
  const auto matrix = tile.Find("transform");
  if (!matrix) return {};
  const std::vector<double> m = matrix->Numbers(16);  // column-major
  for (double v : m) {
    if (!(std::abs(v) <= 1e12)) matrix->Fail("a number beyond 1e12");
  }
  return {Mat3d::FromColumns({m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}), {m[12], m[13], m[14]}};
}

// Middle of a bounding volume; regions are Earth-centred whatever the transform.
Vec3d MiddleOf(const JsonRef& volume, const TileTransform& X) {
  const auto placed = [&](const std::vector<double>& v) { return X.A * Vec3d{v[0], v[1], v[2]} + X.p; };
  if (const auto box = volume.Find("box")) return placed(box->Numbers(12));
  if (const auto sphere = volume.Find("sphere")) return placed(sphere->Numbers(4));
  if (const auto region = volume.Find("region")) {
    const std::vector<double> r = region->Numbers(6);  // west, south, east, north, low, high
    const double east = r[2] < r[0] ? r[2] + 2 * std::numbers::pi : r[2];
    return EcefFromGeodetic({(r[1] + r[3]) / 2 * kRadian, (r[0] + east) / 2 * kRadian, (r[4] + r[5]) / 2});
  }
  volume.Fail("a box, a sphere or a region expected");
}

struct Tileset {
  std::string file, folder;  // for messages; of what it refers to
  nlohmann::json document;
  bool up_z = false;
};

// A tile that may still be refined.
struct OpenTile {
  JsonRef json;
  const Tileset* set = nullptr;
  TileTransform X;  // tile to the first tileset
  double error = 0;
  bool add = false;
  int depth = 0;
  size_t first = 0, count = 0;      // its contents among those shown
  std::vector<std::string> within;  // tilesets that it holds

  size_t order = 0;
  friend bool operator<(const OpenTile& a, const OpenTile& b) { return a.error != b.error ? a.error < b.error : a.order > b.order; }
};

// Refines tiles from the coarsest on.
class Selector {
 public:
  Selector(const std::string& file, const ResourceLoader& load, size_t most_tiles, Warnings& warnings)
      : file_(file), load_(load), most_(most_tiles), warnings_(warnings) {}

  TileSelection Select(std::string_view text) {
    const JsonRef root = Open(file_, "", text);
    TileSelection out;
    const TileTransform X = ReadTransform(root);
    const Vec3d middle = MiddleOf(root.At("boundingVolume"), X);
    if (const double r = Norm(middle); r > 5e6 && r < 8e6) out.earth = middle;
    Push(root, sets_.back().get(), X, false, 0);
    while (!open_.empty()) {
      const OpenTile tile = open_.top();
      open_.pop();
      Refine(tile);
    }
    for (size_t i = 0; i < shown_.size(); ++i) {
      if (alive_[i]) out.tiles.push_back(std::move(shown_[i]));
    }
    if (unrefined_ > 0)
      warnings_.Add(file_ + ": more than " + std::to_string(most_) + " tiles: shown to a geometric error of " + std::to_string(unrefined_) +
                    " m");
    return out;
  }

 private:
  JsonRef Open(const std::string& file, const std::string& folder, std::string_view text) {
    if (sets_.size() >= kMostTilesets)
      throw InputError(file_ + ": more than " + std::to_string(kMostTilesets) + " tilesets within each other");
    sets_.push_back(std::make_unique<Tileset>(Tileset{file, folder, ParseJson(file, text)}));
    Tileset& set = *sets_.back();
    const JsonRef json(set.file, set.document);
    const JsonRef asset = json.At("asset"), version = asset.At("version");
    if (!version.Text().starts_with("1.") && !version.Text().starts_with("0.")) version.Fail("only 3D Tiles 1 is read");
    const std::string up = asset.TextOr("gltfUpAxis", "Y");
    set.up_z = up == "Z" || up == "z";
    return json.At("root");
  }

  // Path below the first tileset's folder of what `set` refers to.
  static std::string PathOf(const Tileset& set, const JsonRef& uri) {
    const std::string text = uri.Text();
    if (IsDataUri(text)) return text;
    const auto plain = DecodePercent(text.substr(0, text.find('?')));
    if (!plain || plain->empty()) uri.Fail("a damaged address");
    if (plain->find("://") != std::string::npos) uri.Fail("only files beside the tileset are read, no addresses");
    return (std::filesystem::path(set.folder) / *plain).lexically_normal().generic_string();
  }

  // The contents of a tile; those of a tileset within it stand for children.
  void Push(const JsonRef& json, const Tileset* set, const TileTransform& X, bool add, int depth) {
    if (order_ >= kMostSeen) json.Fail("more than a million tiles");
    if (depth > kDeepest) json.Fail("tiles nested deeper than " + std::to_string(kDeepest));
    OpenTile tile{.json = json,
                  .set = set,
                  .X = X,
                  .error = json.NumberOr("geometricError", 0),
                  .add = add,
                  .depth = depth,
                  .first = shown_.size(),
                  .within = {},
                  .order = order_++};
    std::string refine = json.TextOr("refine", add ? "ADD" : "REPLACE");
    tile.add = refine == "ADD" || refine == "add";
    if (json.Has("implicitTiling") || GltfExtensionOf(json, "3DTILES_implicit_tiling")) {
      warnings_.Add(set->file + ": " + json.pointer() + ": implicit tiling is not read: left out");
      return;
    }
    std::vector<JsonRef> contents;
    if (const auto content = json.Find("content"); content && content->IsObject()) contents.push_back(*content);
    const auto list = json.Find("contents");
    for (size_t i = 0; list && i < list->size(); ++i) contents.push_back((*list)[i]);
    for (const JsonRef& content : contents) {
      const auto uri = content.Has("uri") ? content.Find("uri") : content.Find("url");
      if (!uri) content.Fail("a content without a uri");
      const std::string path = PathOf(*set, *uri);
      if (path.ends_with(".json")) {
        tile.within.push_back(path);
        continue;
      }
      const std::string stem = IsDataUri(path) ? "tile" : std::filesystem::path(path).stem().string();
      shown_.push_back({path, stem, X, set->up_z, tile.error});
      alive_.push_back(true);
    }
    tile.count = shown_.size() - tile.first;
    live_ += tile.count;
    if (!tile.within.empty() || json.Has("children")) open_.push(std::move(tile));
  }

  static bool GltfExtensionOf(const JsonRef& json, const char* name) {
    const auto extensions = json.Find("extensions");
    return extensions && extensions->Has(name);
  }

  void Refine(const OpenTile& tile) {
    const auto children = tile.json.Find("children");
    const size_t count = (children ? children->size() : 0) + tile.within.size();
    if (count == 0) return;
    if (live_ + count > most_ + (tile.add ? 0 : tile.count)) {
      unrefined_ = std::max(unrefined_, tile.error);
      return;
    }
    if (!tile.add) {
      for (size_t i = 0; i < tile.count; ++i) alive_[tile.first + i] = false;
      live_ -= tile.count;
    }
    for (size_t i = 0; children && i < children->size(); ++i) {
      const JsonRef child = (*children)[i];
      Push(child, tile.set, tile.X * ReadTransform(child), tile.add, tile.depth + 1);
    }
    for (const std::string& path : tile.within) {
      const auto bytes = load_(path);
      if (!bytes) tile.json.Fail("no such file beside the tileset: " + Quoted(path));
      const std::string name = (std::filesystem::path(file_).parent_path() / path).string();
      const JsonRef root = Open(name, FolderOf(path), AsText(*bytes));
      Push(root, sets_.back().get(), tile.X * ReadTransform(root), false, tile.depth + 1);
    }
  }

  const std::string& file_;
  const ResourceLoader& load_;
  size_t most_, live_ = 0, order_ = 0;
  double unrefined_ = 0;
  Warnings& warnings_;
  std::vector<std::unique_ptr<Tileset>> sets_;
  std::priority_queue<OpenTile> open_;
  std::vector<ShownTile> shown_;
  std::vector<bool> alive_;
};

// Earth-centred coordinates to east, north and up at a place.
TileTransform LocalFrame(Vec3d place) {
  const GeoPoint at = GeodeticFromEcef(place);
  const double phi = at.latitude_deg * std::numbers::pi / 180, lambda = at.longitude_deg * std::numbers::pi / 180;
  const Vec3d east{-std::sin(lambda), std::cos(lambda), 0},
      up{std::cos(phi) * std::cos(lambda), std::cos(phi) * std::sin(lambda), std::sin(phi)}, north = Cross(up, east);
  const Mat3d R = Mat3d::FromColumns(east, north, up).transpose();
  return {R, -(R * place)};
}

// Middle to x = y = 0, lowest point to z = 0.
void Centre(ImportedFile& file) {
  Box3f box;
  for (const ImportedNode& node : file.nodes) {
    if (node.mesh < 0) continue;
    for (Vec3f p : file.meshes[static_cast<size_t>(node.mesh)].positions) box.Add(node.X_WM * p);
  }
  if (box.empty()) return;
  for (ImportedNode& node : file.nodes) node.X_WM.p -= Vec3f{box.center().x, box.center().y, box.min.z};
}

}  // namespace

TileSelection SelectTiles(const std::string& file, std::string_view text, const ResourceLoader& load, size_t most_tiles,
                          Warnings& warnings) {
  return Selector(file, load, most_tiles, warnings).Select(text);
}

bool LooksLikeTileset(std::string_view text) {
  return text.find("\"geometricError\"") != std::string_view::npos && text.find("\"root\"") != std::string_view::npos;
}

ImportedFile ReadTileset(const std::string& file, std::string_view text, const ResourceLoader& load, const ImportLimits& limits,
                         size_t most_tiles) {
  Warnings warnings;
  const TileSelection selection = SelectTiles(file, text, load, most_tiles, warnings);
  const TileTransform X_W = selection.earth ? LocalFrame(*selection.earth) : TileTransform{};
  TileGatherer gatherer(load, limits, warnings);
  for (const ShownTile& tile : selection.tiles) {
    const auto bytes = IsDataUri(tile.uri) ? DecodeDataUri(tile.uri) : load(tile.uri);
    const std::string name = IsDataUri(tile.uri) ? file + ": a data URI" : (std::filesystem::path(file).parent_path() / tile.uri).string();
    if (!bytes) throw InputError(file + ": its tile " + Quoted(IsDataUri(tile.uri) ? "data:" : tile.uri) + " is missing or damaged");
    gatherer.Add(name, tile.uri, *bytes, X_W * tile.X, tile.up_z);
  }
  ImportedFile out = gatherer.Take();
  if (selection.earth) Centre(out);
  return out;
}

}  // namespace airsim360::internal

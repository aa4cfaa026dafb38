// What an OpenStreetMap file says, as plain values: tagged nodes, ways with their coordinates, relations. No
// libosmium types. W: east-north-up at the middle of the extract (math/geodesy), metres; z is not known here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "airsim360/math/geodesy.h"
#include "airsim360/math/vector.h"
#include "airsim360/worlds/osm/data/map_cut.h"

namespace airsim360::internal {

/// Keys and values of one object.
class OsmTags {
 public:
  void Add(std::string key, std::string value) { list_.emplace_back(std::move(key), std::move(value)); }
  /// The value of a key, "" if it is not there.
  std::string_view Get(std::string_view key) const;
  /// The key is there and does not say "no".
  bool Has(std::string_view key) const;
  bool Is(std::string_view key, std::string_view value) const { return Get(key) == value; }
  bool empty() const { return list_.empty(); }
  const std::vector<std::pair<std::string, std::string>>& all() const { return list_; }

 private:
  std::vector<std::pair<std::string, std::string>> list_;
};

struct OsmNode {
  int64_t id = 0;
  Vec2d p;
  OsmTags tags;
};

struct OsmWay {
  int64_t id = 0;
  std::vector<int64_t> nodes;  ///< those that the file holds, without repeats in a row
  std::vector<Vec2d> line;     ///< as long as `nodes`
  std::vector<size_t> gaps;    ///< the file lacks nodes before these of `nodes`
  bool whole = true;           ///< it lacks none
  OsmTags tags;
  bool closed() const { return nodes.size() > 3 && nodes.front() == nodes.back(); }
};

struct OsmMember {
  char type = 'w';  ///< n, w or r
  int64_t id = 0;
  std::string role;
};

struct OsmRelation {
  int64_t id = 0;
  std::vector<OsmMember> members;
  OsmTags tags;
};

/// A place on the ground by its corners.
struct OsmBox {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool Contains(Vec2d p, double margin = 0) const {
    return p.x >= x0 - margin && p.x <= x1 + margin && p.y >= y0 - margin && p.y <= y1 + margin;
  }
  double width() const { return x1 - x0; }
  double depth() const { return y1 - y0; }
};

/// Objects sorted by id, each id once.
struct OsmData {
  GeoPoint origin;             ///< of W
  OsmBox extent;               ///< what the extract is about: the box the file names, else that of most of its objects
  std::vector<OsmNode> nodes;  ///< the tagged ones
  std::vector<OsmWay> ways;
  std::vector<OsmRelation> relations;

  const OsmWay* FindWay(int64_t id) const;
  const OsmNode* FindNode(int64_t id) const;  ///< among the tagged ones
};

/// Bounds of what is read from a file.
struct OsmLimits {
  uint64_t max_bytes = uint64_t{1} << 30;
  size_t max_nodes = 8'000'000, max_ways = 1'000'000, max_relations = 100'000;
  size_t max_way_nodes = 20'000'000, max_members = 4'000'000;  ///< of all together
  size_t max_tag_bytes = size_t{512} << 20;                    ///< of all together
  double max_extent = 60'000;                                  ///< metres from side to side
};

/// Reads .osm (XML), .osm.pbf/.pbf, .osm.gz, .osm.bz2 from memory; `name` is the file's, its ending tells the
/// format. InputError naming the file (and line:column in XML) for damage, an empty file, or more than the
/// limits. `cut`: only that piece, with the ways and multipolygons that reach into it whole, and all coastlines;
/// limits but max_bytes then hold for what is kept.
OsmData ReadOsm(const std::string& name, std::span<const std::byte> bytes, const OsmLimits& limits = {},
                const std::optional<MapCut>& cut = {});

/// Is this the name of a file that ReadOsm reads?
bool IsOsmName(std::string_view name);

/// Metres of a length as OSM writes it: "12", "12.5 m", "40 ft", "5'6\"", "1,5"; nullopt for anything else or
/// what is not in (0, limit].
std::optional<double> ParseOsmLength(std::string_view text, double limit);
/// A number in [low, high].
std::optional<double> ParseOsmNumber(std::string_view text, double low, double high);
/// Linear albedo of "#RGB", "#RRGGBB" or a CSS colour name, kept within what real materials have.
std::optional<Vec3f> ParseOsmColour(std::string_view text);

}  // namespace airsim360::internal

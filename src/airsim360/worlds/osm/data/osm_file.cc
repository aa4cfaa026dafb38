// The only file that knows libosmium.
#define OSMIUM_WITH_LZ4
#include <osmium/io/any_compression.hpp>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/xml_input.hpp>
#include <osmium/osm/entity_bits.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <unordered_map>
#include <unordered_set>

#include "airsim360/base/error.h"
#include "airsim360/worlds/osm/data/osm_data.h"
#include "airsim360/worlds/osm/data/osm_unpack.h"

namespace airsim360::internal {
namespace {

struct Place {
  double latitude, longitude;
};

// The objects that a cut keeps. Null: all.
struct Selection {
  std::unordered_set<int64_t> inside;    // nodes in the box
  std::unordered_set<int64_t> ways;      // that touch it
  std::unordered_set<int64_t> outlines;  // other ways of multipolygons that touch it: without their tags
  std::unordered_set<int64_t> corners;   // nodes of all these ways
};

// Everything of the file in its own order and coordinates.
struct Raw {
  std::unordered_map<int64_t, Place> places;  // of all nodes
  OsmData data;
  size_t way_nodes = 0, members = 0, tag_bytes = 0;
};

class Filler {
 public:
  Filler(const std::string& name, const OsmLimits& limits, const Selection* selection)
      : name_(name), limits_(limits), selection_(selection) {}

  void Take(const osmium::OSMEntity& item, Raw& raw) {
    switch (item.type()) {
      case osmium::item_type::node:
        return TakeNode(static_cast<const osmium::Node&>(item), raw);
      case osmium::item_type::way:
        return TakeWay(static_cast<const osmium::Way&>(item), raw);
      case osmium::item_type::relation:
        return TakeRelation(static_cast<const osmium::Relation&>(item), raw);
      default:
        return;
    }
  }

 private:
  void Bound(size_t count, size_t limit, const char* what) const {
    if (count > limit)
      throw InputError(name_ + ": more than " + std::to_string(limit) + " " + what +
                       "; cut a smaller extract, for example with 'osmium extract'");
  }

  OsmTags TagsOf(const osmium::OSMObject& object, Raw& raw) const {
    OsmTags tags;
    for (const osmium::Tag& tag : object.tags()) {
      tags.Add(tag.key(), tag.value());
      raw.tag_bytes += tags.all().back().first.size() + tags.all().back().second.size() + 64;
    }
    Bound(raw.tag_bytes, limits_.max_tag_bytes, "bytes of tags");
    return tags;
  }

  void TakeNode(const osmium::Node& node, Raw& raw) const {
    if (!node.visible() || !node.location().valid()) return;
    const bool inside = !selection_ || selection_->inside.contains(node.id());
    if (!inside && !selection_->corners.contains(node.id())) return;
    raw.places[node.id()] = {node.location().lat(), node.location().lon()};
    Bound(raw.places.size(), limits_.max_nodes, "nodes");
    if (inside && !node.tags().empty()) raw.data.nodes.push_back({node.id(), {}, TagsOf(node, raw)});
  }

  void TakeWay(const osmium::Way& way, Raw& raw) const {
    if (!way.visible()) return;
    const bool outline = selection_ && selection_->outlines.contains(way.id());
    if (selection_ && !outline && !selection_->ways.contains(way.id())) return;
    OsmWay out;
    out.id = way.id();
    for (const osmium::NodeRef& ref : way.nodes())
      if (out.nodes.empty() || out.nodes.back() != ref.ref()) out.nodes.push_back(ref.ref());
    if (!outline) out.tags = TagsOf(way, raw);
    Bound(raw.way_nodes += out.nodes.size(), limits_.max_way_nodes, "nodes of ways");
    raw.data.ways.push_back(std::move(out));
    Bound(raw.data.ways.size(), limits_.max_ways, "ways");
  }

  void TakeRelation(const osmium::Relation& relation, Raw& raw) const {
    if (!relation.visible()) return;
    const auto kept = [&](const osmium::RelationMember& member) {
      return member.type() == osmium::item_type::way && selection_->ways.contains(member.ref());
    };
    if (selection_ && std::none_of(relation.members().begin(), relation.members().end(), kept)) return;
    OsmRelation out;
    out.id = relation.id();
    for (const osmium::RelationMember& member : relation.members())
      out.members.push_back({osmium::item_type_to_char(member.type()), member.ref(), member.role()});
    out.tags = TagsOf(relation, raw);
    Bound(raw.members += out.members.size(), limits_.max_members, "members of relations");
    raw.data.relations.push_back(std::move(out));
    Bound(raw.data.relations.size(), limits_.max_relations, "relations");
  }

  const std::string& name_;
  const OsmLimits& limits_;
  const Selection* selection_;
};

// Sorted by id; of several versions of one object the last counts.
template <class T>
void SortById(std::vector<T>& list) {
  std::stable_sort(list.begin(), list.end(), [](const T& a, const T& b) { return a.id < b.id; });
  std::vector<T> kept;
  for (T& object : list) {
    if (!kept.empty() && kept.back().id == object.id) kept.pop_back();
    kept.push_back(std::move(object));
  }
  list = std::move(kept);
}

struct Degrees {
  double lat0 = 90, lon0 = 180, lat1 = -90, lon1 = -180;
  bool empty() const { return lat0 > lat1 || lon0 > lon1; }
};

// The box that holds most of the tagged ways' nodes: some ways and relations lead far out of an extract.
Degrees MostOf(const Raw& raw) {
  std::vector<double> lat, lon;
  const auto add = [&](int64_t id) {
    const auto it = raw.places.find(id);
    if (it == raw.places.end()) return;
    lat.push_back(it->second.latitude);
    lon.push_back(it->second.longitude);
  };
  for (const OsmWay& way : raw.data.ways) {
    if (!way.tags.Has("building") && !way.tags.Has("highway") && !way.tags.Has("landuse")) continue;
    for (int64_t id : way.nodes) add(id);
  }
  if (lat.empty())
    for (const auto& entry : raw.places) {
      lat.push_back(entry.second.latitude);
      lon.push_back(entry.second.longitude);
    }
  if (lat.empty()) return {};
  std::sort(lat.begin(), lat.end());
  std::sort(lon.begin(), lon.end());
  const size_t cut = lat.size() >= 400 ? lat.size() / 50 : 0, last = lat.size() - 1 - cut;
  return {lat[cut], lon[cut], lat[last], lon[last]};
}

// Coordinates in W, ways without the nodes that the file lacks.
void Project(const std::string& name, Degrees box, const char* source, const OsmLimits& limits, Raw& raw) {
  OsmData& data = raw.data;
  data.origin = {(box.lat0 + box.lat1) / 2, (box.lon0 + box.lon1) / 2, 0};
  const GeoFrame frame(data.origin);
  const auto to_world = [&](const Place& place) {
    const Vec3d p = frame.ToWorld({place.latitude, place.longitude, 0});
    return Vec2d{p.x, p.y};
  };
  const Vec2d low = to_world({box.lat0, box.lon0}), high = to_world({box.lat1, box.lon1});
  data.extent = {std::min(low.x, high.x), std::min(low.y, high.y), std::max(low.x, high.x), std::max(low.y, high.y)};
  if (std::max(data.extent.width(), data.extent.depth()) > limits.max_extent)
    throw InputError(name + ": " + source + " are " + std::to_string(std::lround(data.extent.width() / 1000)) + " x " +
                     std::to_string(std::lround(data.extent.depth() / 1000)) + " km, " +
                     DescribeBox({.west = box.lon0, .south = box.lat0, .east = box.lon1, .north = box.lat1}) + "; at most " +
                     std::to_string(std::lround(limits.max_extent / 1000)) +
                     " km are one world: name a piece with --bbox SOUTH,WEST,NORTH,EAST or --centre LAT,LON --radius METRES "
                     "('bbox', 'centre' and 'radius' in a world file)");
  for (OsmNode& node : data.nodes) node.p = to_world(raw.places.at(node.id));
  for (OsmWay& way : data.ways) {
    std::vector<int64_t> known;
    bool lacks = false;  // since the last known node
    for (int64_t id : way.nodes) {
      const auto it = raw.places.find(id);
      if (it == raw.places.end()) {
        lacks = true;
        way.whole = false;
        continue;
      }
      if (!known.empty() && known.back() == id) continue;
      if (lacks && !known.empty()) way.gaps.push_back(known.size());
      lacks = false;
      known.push_back(id);
      way.line.push_back(to_world(it->second));
    }
    way.nodes = std::move(known);
  }
}

// The format by the ending of the name, as libosmium calls it. Text under the name of a packed file has been unpacked.
std::string FormatOf(const std::string& name, std::span<const std::byte> bytes) {
  std::string lower;
  for (char c : name) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* ending : {"osm.pbf", "pbf", "osm.gz", "osm.bz2", "osm"})
    if (lower.ends_with(std::string(".") + ending)) return !bytes.empty() && bytes[0] == std::byte{'<'} ? "osm" : ending;
  throw InputError(name + ": not a name of an OpenStreetMap file: .osm, .osm.pbf, .osm.gz or .osm.bz2");
}

// Visits every object of the given kinds in the file's order; the box of its header, where there is one.
template <class Visit>
Degrees EachObject(const std::string& name, std::span<const std::byte> bytes, osmium::osm_entity_bits::type kinds, Visit visit) {
  const osmium::io::File file(reinterpret_cast<const char*>(bytes.data()), bytes.size(), FormatOf(name, bytes));
  osmium::io::Reader reader(file, kinds, osmium::io::read_meta::no);
  Degrees header;
  const osmium::Box box = reader.header().joined_boxes();
  if (box.valid()) header = {box.bottom_left().lat(), box.bottom_left().lon(), box.top_right().lat(), box.top_right().lon()};
  while (const osmium::memory::Buffer buffer = reader.read())
    for (const osmium::OSMEntity& item : buffer.select<osmium::OSMEntity>()) visit(item);
  reader.close();
  return header;
}

// The nodes in the box of a cut; `cut.box` is then the one that counts.
std::unordered_set<int64_t> NodesInside(const std::string& name, std::span<const std::byte> bytes, const OsmLimits& limits, MapCut& cut) {
  std::unordered_set<int64_t> inside, otherwise;
  Degrees all;
  EachObject(name, bytes, osmium::osm_entity_bits::node, [&](const osmium::OSMEntity& item) {
    const auto& node = static_cast<const osmium::Node&>(item);
    if (!node.visible() || !node.location().valid()) return;
    const double lat = node.location().lat(), lon = node.location().lon();
    all = {std::min(all.lat0, lat), std::min(all.lon0, lon), std::max(all.lat1, lat), std::max(all.lon1, lon)};
    if (cut.box.Contains(lat, lon)) inside.insert(node.id());
    if (cut.otherwise && cut.otherwise->Contains(lat, lon)) otherwise.insert(node.id());
    if (std::max(inside.size(), otherwise.size()) > limits.max_nodes)
      throw InputError(cut.text + ": more than " + std::to_string(limits.max_nodes) + " nodes of " + name +
                       " lie in it; name a smaller piece");
  });
  if (inside.empty() && !otherwise.empty()) {
    cut.box = *cut.otherwise;
    inside.swap(otherwise);
  }
  if (inside.empty())
    throw InputError(cut.text + ": nothing of " + name + " lies there; its data reach over " +
                     DescribeBox({.west = all.lon0, .south = all.lat0, .east = all.lon1, .north = all.lat1}));
  return inside;
}

Selection SelectIn(const std::string& name, std::span<const std::byte> bytes, const OsmLimits& limits, MapCut& cut) {
  using osmium::osm_entity_bits::relation, osmium::osm_entity_bits::way;
  Selection selection;
  selection.inside = NodesInside(name, bytes, limits, cut);
  std::vector<std::vector<int64_t>> outlines;  // of multipolygons
  EachObject(name, bytes, way | relation, [&](const osmium::OSMEntity& item) {
    if (item.type() == osmium::item_type::way) {
      const auto& object = static_cast<const osmium::Way&>(item);
      const char* natural = object.tags()["natural"];
      const bool coast = natural && std::string_view(natural) == "coastline";
      if (coast || std::any_of(object.nodes().begin(), object.nodes().end(),
                               [&](const osmium::NodeRef& node) { return selection.inside.contains(node.ref()); }))
        selection.ways.insert(object.id());
    } else {
      const auto& object = static_cast<const osmium::Relation&>(item);
      const char* type = object.tags()["type"];
      if (!type || (std::string_view(type) != "multipolygon" && !object.tags()["building"])) return;
      std::vector<int64_t> ways;
      for (const osmium::RelationMember& member : object.members())
        if (member.type() == osmium::item_type::way) ways.push_back(member.ref());
      outlines.push_back(std::move(ways));
    }
  });
  for (const std::vector<int64_t>& ways : outlines) {
    if (std::none_of(ways.begin(), ways.end(), [&](int64_t id) { return selection.ways.contains(id); })) continue;
    for (int64_t id : ways)
      if (!selection.ways.contains(id)) selection.outlines.insert(id);
  }
  EachObject(name, bytes, way, [&](const osmium::OSMEntity& item) {
    const auto& object = static_cast<const osmium::Way&>(item);
    if (!selection.ways.contains(object.id()) && !selection.outlines.contains(object.id())) return;
    for (const osmium::NodeRef& node : object.nodes()) selection.corners.insert(node.ref());
  });
  return selection;
}

Raw ReadAll(const std::string& name, std::span<const std::byte> bytes, const OsmLimits& limits, const Selection* selection,
            Degrees& header) {
  Raw raw;
  Filler filler(name, limits, selection);
  header = EachObject(name, bytes, osmium::osm_entity_bits::nwr, [&](const osmium::OSMEntity& item) { filler.Take(item, raw); });
  return raw;
}

double WidestOf(const Degrees& box) {
  const double middle = (box.lat0 + box.lat1) / 2 * M_PI / 180;
  return 111320 * std::max(box.lat1 - box.lat0, (box.lon1 - box.lon0) * std::cos(middle));
}

// Can the box in the header be what the extract is about? Some programs write any.
bool IsUseful(const Degrees& header, const Degrees& own, const OsmLimits& limits) {
  if (header.empty() || !(header.lat1 - header.lat0 > 1e-7)) return false;
  if (std::abs(header.lat0) > 85 || std::abs(header.lat1) > 85) return false;
  if (own.empty()) return true;
  const Degrees both{std::min(own.lat0, header.lat0), std::min(own.lon0, header.lon0), std::max(own.lat1, header.lat1),
                     std::max(own.lon1, header.lon1)};
  const bool apart = own.lat1 < header.lat0 || own.lat0 > header.lat1 || own.lon1 < header.lon0 || own.lon0 > header.lon1;
  if (apart && WidestOf(both) > 2 * limits.max_extent) return false;
  return WidestOf(header) <= limits.max_extent || WidestOf(own) > limits.max_extent;
}

}  // namespace

OsmData ReadOsm(const std::string& name, std::span<const std::byte> bytes, const OsmLimits& limits, const std::optional<MapCut>& cut) {
  if (bytes.size() > limits.max_bytes) throw InputError(name + ": larger than " + std::to_string(limits.max_bytes >> 20) + " MiB");
  Degrees header;
  Raw raw;
  std::optional<MapCut> piece = cut;
  try {
    const std::optional<std::string> unpacked = UnpackParts(bytes, 4 * limits.max_bytes);
    if (unpacked) bytes = std::as_bytes(std::span(*unpacked));
    Selection selection;
    if (piece) selection = SelectIn(name, bytes, limits, *piece);
    raw = ReadAll(name, bytes, limits, piece ? &selection : nullptr, header);
  } catch (const InputError&) {
    throw;
  } catch (const osmium::xml_error& error) {
    const std::string place = error.line ? ":" + std::to_string(error.line) + ":" + std::to_string(error.column) : "";
    throw InputError(name + place + ": " + error.error_string);
  } catch (const std::exception& error) {
    throw InputError(name + ": damaged OpenStreetMap file: " + error.what());
  }
  SortById(raw.data.nodes);
  SortById(raw.data.ways);
  SortById(raw.data.relations);
  if (raw.places.empty()) throw InputError(name + ": holds no node with a place");
  if (piece) {
    const Degrees box{piece->box.south, piece->box.west, piece->box.north, piece->box.east};
    Project(name, box, piece->text.c_str(), limits, raw);
    return std::move(raw.data);
  }
  const Degrees own = MostOf(raw);
  const bool useful = IsUseful(header, own, limits);
  const Degrees box = useful ? header : own;
  if (std::abs(box.lat0) > 85 || std::abs(box.lat1) > 85)
    throw InputError(name + ": the data lie between latitudes " + std::to_string(box.lat0) + " and " + std::to_string(box.lat1) +
                     "; worlds lie between 85 south and 85 north");
  Project(name, box, useful ? "the bounds in its header" : "its data", limits, raw);
  return std::move(raw.data);
}

}  // namespace airsim360::internal

// The only file that knows libosmium.
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

#include "airsim360/base/error.h"
#include "airsim360/worlds/osm/osm_data.h"

namespace airsim360::internal {
namespace {

struct Place {
  double latitude, longitude;
};

// Everything of the file in its own order and coordinates.
struct Raw {
  std::unordered_map<int64_t, Place> places;  // of all nodes
  OsmData data;
  size_t way_nodes = 0, members = 0, tag_bytes = 0;
};

class Filler {
 public:
  Filler(const std::string& name, const OsmLimits& limits) : name_(name), limits_(limits) {}

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
    raw.places[node.id()] = {node.location().lat(), node.location().lon()};
    Bound(raw.places.size(), limits_.max_nodes, "nodes");
    if (!node.tags().empty()) raw.data.nodes.push_back({node.id(), {}, TagsOf(node, raw)});
  }

  void TakeWay(const osmium::Way& way, Raw& raw) const {
    if (!way.visible()) return;
    OsmWay out;
    out.id = way.id();
    for (const osmium::NodeRef& ref : way.nodes())
      if (out.nodes.empty() || out.nodes.back() != ref.ref()) out.nodes.push_back(ref.ref());
    out.tags = TagsOf(way, raw);
    Bound(raw.way_nodes += out.nodes.size(), limits_.max_way_nodes, "nodes of ways");
    raw.data.ways.push_back(std::move(out));
    Bound(raw.data.ways.size(), limits_.max_ways, "ways");
  }

  void TakeRelation(const osmium::Relation& relation, Raw& raw) const {
    if (!relation.visible()) return;
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
void Project(const std::string& name, Degrees box, const OsmLimits& limits, Raw& raw) {
  OsmData& data = raw.data;
  data.origin = {(box.lat0 + box.lat1) / 2, (box.lon0 + box.lon1) / 2, 0};
  const GeoFrame frame(data.origin);
  const auto to_world = [&](const Place& place) {
    const Vec3d p = frame.ToWorld({place.latitude, place.longitude, 0});
    return Vec2d{p.x, p.y};
  };
  const Vec2d low = to_world({box.lat0, box.lon0}), high = to_world({box.lat1, box.lon1});
  data.extent = {std::min(low.x, high.x), std::min(low.y, high.y), std::max(low.x, high.x),
                 std::max(low.y, high.y)};
  if (data.extent.width() > limits.max_extent || data.extent.depth() > limits.max_extent)
    throw InputError(name + ": the extract is " + std::to_string(std::lround(data.extent.width() / 1000)) +
                     " x " + std::to_string(std::lround(data.extent.depth() / 1000)) +
                     " km; at most " + std::to_string(std::lround(limits.max_extent / 1000)) +
                     " km are one world: cut a smaller one, for example with 'osmium extract'");
  for (OsmNode& node : data.nodes) node.p = to_world(raw.places.at(node.id));
  for (OsmWay& way : data.ways) {
    std::vector<int64_t> known;
    for (int64_t id : way.nodes) {
      const auto it = raw.places.find(id);
      if (it == raw.places.end() || (!known.empty() && known.back() == id)) continue;
      known.push_back(id);
      way.line.push_back(to_world(it->second));
    }
    way.nodes = std::move(known);
  }
}

// The format by the ending of the name, as libosmium calls it.
std::string FormatOf(const std::string& name) {
  std::string lower;
  for (char c : name) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* ending : {"osm.pbf", "pbf", "osm.gz", "osm.bz2", "osm"})
    if (lower.ends_with(std::string(".") + ending)) return ending;
  throw InputError(name + ": not a name of an OpenStreetMap file: .osm, .osm.pbf, .osm.gz or .osm.bz2");
}

Raw ReadAll(const std::string& name, std::span<const std::byte> bytes, const OsmLimits& limits,
            Degrees& header) {
  Raw raw;
  Filler filler(name, limits);
  const osmium::io::File file(reinterpret_cast<const char*>(bytes.data()), bytes.size(), FormatOf(name));
  osmium::io::Reader reader(file, osmium::osm_entity_bits::nwr, osmium::io::read_meta::no);
  const osmium::Box box = reader.header().joined_boxes();
  if (box.valid())
    header = {box.bottom_left().lat(), box.bottom_left().lon(), box.top_right().lat(), box.top_right().lon()};
  while (const osmium::memory::Buffer buffer = reader.read())
    for (const osmium::OSMEntity& item : buffer.select<osmium::OSMEntity>()) filler.Take(item, raw);
  reader.close();
  return raw;
}

}  // namespace

OsmData ReadOsm(const std::string& name, std::span<const std::byte> bytes, const OsmLimits& limits) {
  if (bytes.size() > limits.max_bytes)
    throw InputError(name + ": larger than " + std::to_string(limits.max_bytes >> 20) + " MiB");
  Degrees box;
  Raw raw;
  try {
    raw = ReadAll(name, bytes, limits, box);
  } catch (const InputError&) {
    throw;
  } catch (const osmium::xml_error& error) {
    const std::string place =
        error.line ? ":" + std::to_string(error.line) + ":" + std::to_string(error.column) : "";
    throw InputError(name + place + ": " + error.error_string);
  } catch (const std::exception& error) {
    throw InputError(name + ": damaged OpenStreetMap file: " + error.what());
  }
  SortById(raw.data.nodes);
  SortById(raw.data.ways);
  SortById(raw.data.relations);
  if (raw.places.empty()) throw InputError(name + ": holds no node with a place");
  if (box.empty() || !(box.lat1 - box.lat0 > 1e-7)) box = MostOf(raw);
  if (std::abs(box.lat0) > 85 || std::abs(box.lat1) > 85)
    throw InputError(name + ": the extract lies at latitude " + std::to_string(box.lat0) +
                     "; worlds lie between 85 south and 85 north");
  Project(name, box, limits, raw);
  return std::move(raw.data);
}

}  // namespace airsim360::internal

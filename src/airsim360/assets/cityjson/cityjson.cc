#include "airsim360/assets/cityjson/cityjson.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <utility>

#include "airsim360/assets/cityjson/cityjson_palette.h"
#include "airsim360/assets/gltf/gltf_json_internal.h"
#include "airsim360/assets/normals.h"
#include "airsim360/base/error.h"
#include "airsim360/math/triangulate.h"

namespace airsim360::internal {
namespace {

struct Placement {  // of a geometry template
  std::array<double, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  Vec3d offset;
  Vec3d operator*(Vec3d p) const {
    return Vec3d{m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                 m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]} +
           offset;
  }
};

// Triangles of one node before they are a mesh.
struct Soup {
  std::string name, category;
  std::map<MaterialId, std::vector<Vec3d>> corners;  // three a triangle
  Vec3d low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
};

// The object that a geometry is of.
struct Owner {
  std::string whole, id, type;  // whole: the entity that walls and grounds belong to
};

// What all surfaces of a geometry share.
struct Shown {
  const Owner& owner;
  const std::vector<Vec3d>& vertices;
  const Placement& place;
  std::vector<std::string> surfaces;  // semantic types
  std::optional<JsonRef> colour;      // of all of them
};

class CityReader {
 public:
  CityReader(const std::string& file, const ImportLimits& limits) : file_name_(file), limits_(limits) {}

  // A whole document, or the first line of a stream.
  void ReadHead(JsonRef root) {
    if (root.TextOr("type", "") != "CityJSON") root.Fail("not CityJSON: \"type\" is not \"CityJSON\"");
    const std::string version = root.TextOr("version", "");
    if (!version.starts_with("1.") && !version.starts_with("2.")) root.At("version").Fail("CityJSON 1.0, 1.1 and 2.0 are read");
    if (const auto transform = root.Find("transform")) {
      const std::vector<double> scale = transform->At("scale").Numbers(3), move = transform->At("translate").Numbers(3);
      scale_ = {scale[0], scale[1], scale[2]};
      if (scale_.x == 0 || scale_.y == 0 || scale_.z == 0) transform->At("scale").Fail("no scale may be 0");
      translate_ = {move[0], move[1], move[2]};
    }
    if (const auto metadata = root.Find("metadata"))
      if (const auto reference = metadata->Find("referenceSystem")) degrees_ = IsInDegrees(reference->Text());
    if (const auto appearance = root.Find("appearance")) palette_.Read(*appearance);
    if (const auto templates = root.Find("geometry-templates")) {
      templates_ = templates->At("templates");
      template_vertices_ = ReadVertices(templates->At("vertices-templates"), {1, 1, 1}, {});
    }
  }

  // City objects of a document or feature over its own vertices.
  void ReadObjects(JsonRef root) {
    vertices_ = ReadVertices(root.At("vertices"), scale_, translate_);
    const JsonRef objects = root.At("CityObjects");
    const std::vector<std::string> ids = objects.Keys();
    if (ids.size() > limits_.max_nodes) objects.Fail("more than " + std::to_string(limits_.max_nodes) + " objects");
    for (const std::string& id : ids) ReadObject(WholeOf(objects, id), CleanName(id), objects.At(id));
  }

  ImportedFile Take() {
    ImportedFile out;
    out.materials = palette_.Take();
    out.warnings = warnings_.Take();
    // The middle of everything at x = y = 0, its lowest point at z = 0.
    Vec3d low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    for (auto& entry : soups_) {
      Soup& soup = entry.second;
      for (const auto& [material, corners] : soup.corners)
        for (Vec3d p : corners) {
          soup.low = Min(soup.low, p);
          soup.high = Max(soup.high, p);
        }
      low = Min(low, soup.low);
      high = Max(high, soup.high);
    }
    Vec3d middle{(low.x + high.x) / 2, (low.y + high.y) / 2, low.z};
    Vec3d metres{1, 1, 1};
    if (degrees_) {
      // Metres a degree at the middle latitude (WGS 84 ellipsoid, first terms).
      const double phi = middle.y * std::numbers::pi / 180;
      metres = {111412.84 * std::cos(phi) - 93.5 * std::cos(3 * phi), 111132.92 - 559.82 * std::cos(2 * phi), 1};
    }
    uint64_t entity = 0;
    for (auto& entry : soups_) {
      Soup& soup = entry.second;
      Mesh mesh;
      mesh.name = soup.name;
      // Each thing stands in its middle, on its lowest point.
      const Vec3d foot{(soup.low.x + soup.high.x) / 2, (soup.low.y + soup.high.y) / 2, soup.low.z};
      for (const auto& [material, corners] : soup.corners) {
        const auto first = static_cast<uint32_t>(mesh.triangles.size());
        for (Vec3d p : corners) mesh.positions.push_back(VecCast<float>((p - foot) * metres));
        for (uint32_t i = 3 * first; i + 2 < mesh.positions.size(); i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
        const auto count = static_cast<uint32_t>(mesh.triangles.size()) - first;
        if (count > 0) mesh.parts.push_back({first, count, material, kNoEntity});
      }
      if (mesh.triangles.empty()) continue;
      FillMissingNormals(mesh, 30);
      ImportedNode node{soup.name, -1, static_cast<int32_t>(out.meshes.size()), {}, soup.category, ++entity};
      node.X_WM.p = VecCast<float>((foot - middle) * metres);
      out.meshes.push_back(std::move(mesh));
      out.nodes.push_back(std::move(node));
    }
    return out;
  }

 private:
  static bool IsInDegrees(const std::string& reference) {
    for (const char* code : {"4326", "4979", "4258", "4937", "CRS84"})
      if (reference.ends_with(code)) return true;
    return false;
  }

  std::vector<Vec3d> ReadVertices(JsonRef list, Vec3d scale, Vec3d translate) {
    const size_t count = list.size();
    if ((vertex_total_ += count) > limits_.max_vertices) list.Fail("more than " + std::to_string(limits_.max_vertices) + " vertices");
    std::vector<Vec3d> vertices;
    vertices.reserve(count);
    for (size_t i = 0; i < count; ++i) {
      const std::vector<double> v = list[i].Numbers(3);
      const Vec3d p = Vec3d{v[0], v[1], v[2]} * scale + translate;
      if (!(std::abs(p.x) < 1e12 && std::abs(p.y) < 1e12 && std::abs(p.z) < 1e9)) list[i].Fail("coordinate out of range");
      vertices.push_back(p);
    }
    return vertices;
  }

  // The thing that a BuildingPart (BridgePart, TunnelPart) belongs to: parts are of one entity with it.
  static std::string WholeOf(const JsonRef& objects, std::string id) {
    for (int level = 0; level < 8; ++level) {
      const JsonRef object = objects.At(id);
      if (!object.At("type").Text().ends_with("Part")) break;
      const auto parents = object.Find("parents");
      if (!parents || parents->size() == 0) break;
      const std::string parent = (*parents)[0].Text();
      if (!objects.Find(parent)) (*parents)[0].Fail("there is no such object");
      id = parent;
    }
    return CleanName(id);
  }

  void ReadObject(const std::string& whole, const std::string& id, JsonRef object) {
    const Owner owner{whole, id, object.At("type").Text()};
    const auto geometry = object.Find("geometry");
    if (!geometry || geometry->size() == 0) return;
    // The highest level of detail; all geometries of that level.
    const auto lod = [this](const JsonRef& shown) {
      const JsonRef g = shown.TextOr("type", "") == "GeometryInstance" ? TemplateOf(shown) : shown;
      const auto member = g.Find("lod");
      if (!member) return 1.0;
      // A text in 1.1 and later, a number before.
      const std::string text = member->IsNumber() ? "" : member->Text();
      double level = member->IsNumber() ? member->Number() : -1;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), level);
      if (end != text.data() + text.size() || !(level >= 0 && level < 10)) member->Fail("not a level of detail such as \"2.2\"");
      return level;
    };
    double best = -1;
    for (size_t i = 0; i < geometry->size(); ++i) {
      const JsonRef g = (*geometry)[i];
      const std::string kind = g.At("type").Text();
      if (kind == "MultiPoint" || kind == "MultiLineString") continue;
      best = std::max(best, lod(g));
    }
    for (size_t i = 0; i < geometry->size(); ++i) {
      const JsonRef g = (*geometry)[i];
      const std::string kind = g.At("type").Text();
      if (kind == "MultiPoint" || kind == "MultiLineString") {
        warnings_.Add(file_name_ + ": points and lines are not shown");
        continue;
      }
      if (lod(g) < best - 1e-9) continue;
      if (kind == "GeometryInstance") {
        ReadInstance(owner, g);
      } else {
        ReadGeometry(owner, g, kind, vertices_, {});
      }
    }
  }

  JsonRef TemplateOf(const JsonRef& g) const {
    if (!templates_) g.Fail("the file has no geometry-templates");
    return (*templates_)[g.At("template").Uint(templates_->size() - (templates_->size() > 0))];
  }

  void ReadInstance(const Owner& owner, JsonRef g) {
    const JsonRef source = TemplateOf(g);
    Placement place;
    if (const auto matrix = g.Find("transformationMatrix")) {
      const std::vector<double> m = matrix->Numbers(16);
      std::copy(m.begin(), m.end(), place.m.begin());
    }
    const JsonRef anchor = g.At("boundaries");
    if (anchor.size() < 1) anchor.Fail("a vertex expected");
    if (vertices_.empty()) anchor.Fail("the file has no vertices");
    place.offset = vertices_[anchor[0].Uint(vertices_.size() - 1)];
    const std::string kind = source.At("type").Text();
    if (kind == "GeometryInstance") source.Fail("a template of templates");
    ReadGeometry(owner, source, kind, template_vertices_, place);
  }

  void ReadGeometry(const Owner& owner, JsonRef g, const std::string& kind, const std::vector<Vec3d>& vertices, const Placement& place) {
    int depth = 0;  // of lists of surfaces
    if (kind == "MultiSurface" || kind == "CompositeSurface") depth = 1;
    if (kind == "Solid") depth = 2;
    if (kind == "MultiSolid" || kind == "CompositeSolid") depth = 3;
    if (depth == 0) g.At("type").Fail("unknown geometry");
    std::optional<JsonRef> values;
    Shown shown{owner, vertices, place, {}, {}};
    if (const auto semantics = g.Find("semantics")) {
      if (const auto list = semantics->Find("surfaces"))
        for (size_t i = 0; i < list->size(); ++i) shown.surfaces.push_back((*list)[i].TextOr("type", ""));
      values = semantics->Find("values");
    }
    const CityPalette::Choice colours = palette_.ChoiceOf(g);
    shown.colour = colours.one;
    Walk(shown, g.At("boundaries"), values, colours.nested, depth);
  }

  // Down the nested lists; at the bottom each element is a surface of rings.
  void Walk(const Shown& shown, JsonRef boundaries, std::optional<JsonRef> values, std::optional<JsonRef> colours, int depth) {
    const auto element = [](const std::optional<JsonRef>& list, size_t i) -> std::optional<JsonRef> {
      if (list && list->IsArray() && i < list->size()) return (*list)[i];
      return std::nullopt;
    };
    for (size_t i = 0; i < boundaries.size(); ++i) {
      const std::optional<JsonRef> value = element(values, i), colour = element(colours, i);
      if (depth > 1) {
        Walk(shown, boundaries[i], value, colour, depth - 1);
        continue;
      }
      std::string_view semantic;
      if (value && !value->IsNull()) {
        const uint64_t index = value->Uint();
        if (index >= shown.surfaces.size()) value->Fail("there are " + std::to_string(shown.surfaces.size()) + " semantic surfaces");
        semantic = shown.surfaces[index];
      }
      const CitySurface* surface = CitySurfaceOf(semantic);
      Soup& soup = SoupFor(shown.owner, surface);
      AddSurface(soup.corners[palette_.Get(shown.owner.type, surface, colour ? colour : shown.colour)], boundaries[i], shown);
    }
  }

  Soup& SoupFor(const Owner& owner, const CitySurface* surface) {
    const std::string name = surface ? owner.id + "/" + std::string(surface->suffix) : owner.whole;
    const auto [it, fresh] = soups_.try_emplace(name);
    if (!fresh) return it->second;
    it->second.name = name;
    it->second.category = surface && !surface->category.empty() ? surface->category : CityTypeOf(owner.type).category;
    return it->second;
  }

  // A polygon with holes in space: flattened along its Newell normal, cut into triangles.
  void AddSurface(std::vector<Vec3d>& corners, JsonRef rings, const Shown& shown) {
    const std::vector<Vec3d>& vertices = shown.vertices;
    std::vector<Vec3d> points;
    std::vector<uint32_t> sizes;
    Vec3d normal;
    for (size_t r = 0; r < rings.size(); ++r) {
      const JsonRef ring = rings[r];
      const size_t first = points.size(), count = ring.size();
      if (count > 100000) ring.Fail("a ring of more than 100000 corners");
      for (size_t i = 0; i < count; ++i) {
        if (vertices.empty()) ring.Fail("the file has no vertices");
        const Vec3d p = shown.place * vertices[ring[i].Uint(vertices.size() - 1)];
        if (points.size() > first && points.back() == p) continue;
        points.push_back(p);
      }
      while (points.size() > first + 1 && points.back() == points[first]) points.pop_back();
      if (points.size() - first < 3) {
        points.resize(first);
        if (r == 0) return;  // nothing to see
        continue;
      }
      if (r == 0) {
        for (size_t i = 0; i < points.size(); ++i) {
          const Vec3d a = points[i] - points[0], b = points[(i + 1) % points.size()] - points[0];
          normal += Cross(a, b);
        }
      }
      sizes.push_back(static_cast<uint32_t>(points.size() - first));
    }
    if (sizes.empty() || !(Norm(normal) > 0)) return;
    const Vec3d n = Normalized(normal);
    const Vec3d u = Normalized(Cross(std::abs(n.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0}, n)), v = Cross(n, u);
    std::vector<Vec2d> flat;
    for (Vec3d p : points) flat.push_back({Dot(p - points[0], u), Dot(p - points[0], v)});
    for (uint32_t index : TriangulateRings(flat, sizes)) corners.push_back(points[index]);
    if ((triangle_total_ += points.size()) > limits_.max_triangles)
      rings.Fail("more than " + std::to_string(limits_.max_triangles) + " triangles");
  }

  const std::string& file_name_;
  const ImportLimits& limits_;
  Vec3d scale_{1, 1, 1}, translate_;
  bool degrees_ = false;
  std::vector<Vec3d> vertices_, template_vertices_;
  std::optional<JsonRef> templates_;
  std::map<std::string, Soup> soups_;  // by name: a fixed order
  CityPalette palette_;
  uint64_t vertex_total_ = 0, triangle_total_ = 0;
  Warnings warnings_;
};

// The keys of the outermost object, until its "type" says CityJSON.
class OutermostMembers : public nlohmann::json_sax<nlohmann::json> {
 public:
  std::set<std::string> keys;
  std::string type;
  bool done() const { return type == "CityJSON"; }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t& value) override {
    if (depth_ == 1 && key_ == "type") type = value;
    return !done();
  }
  bool binary(binary_t&) override { return true; }
  bool start_object(size_t) override { return ++depth_, true; }
  bool key(string_t& value) override {
    if (depth_ == 1 && keys.size() < 64) keys.insert(value);
    if (depth_ == 1) key_ = value;
    return true;
  }
  bool end_object() override { return --depth_, depth_ > 0; }  // what follows is another line
  bool start_array(size_t) override { return ++depth_, true; }
  bool end_array() override { return --depth_, true; }
  bool parse_error(size_t, const std::string&, const nlohmann::detail::exception&) override { return damaged = true, false; }
  bool damaged = false;

 private:
  int depth_ = 0;
  std::string key_;
};

}  // namespace

void CheckIsCityJson(const std::string& file, std::string_view text) {
  // A stream's first line is its head.
  const size_t begin = std::min(text.find_first_not_of(" \t\r\n\xEF\xBB\xBF"), text.size());
  OutermostMembers outermost;
  nlohmann::json::sax_parse(text.begin() + static_cast<std::ptrdiff_t>(begin), text.end(), &outermost, nlohmann::json::input_format_t::json,
                            false);
  if (outermost.damaged) return;
  if (outermost.type == "CityJSON") return;
  const auto has = [&](std::string_view key) { return outermost.keys.contains(std::string(key)); };
  if (outermost.type == "CityJSONFeature")
    throw InputError(file + ": a stream of CityJSON features without the line of \"type\": \"CityJSON\" before them");
  const bool features = outermost.type == "Feature" || outermost.type == "FeatureCollection";
  if (features && (has("conformsTo") || has("coordRefSys") || has("featureType") || has("geometryDimension")))
    throw InputError(
        file +
        ": JSON-FG (OGC Features and Geometries) is not read; CityJSON of the same city is (citygml4j's citygml-tools and FME convert)");
  if (features) throw InputError(file + ": GeoJSON is not read; buildings as CityJSON or OpenStreetMap data (.osm, .osm.pbf) are");
  throw InputError(file + ": not CityJSON: " +
                   (outermost.type.empty() ? "its outermost object has no \"type\"" : "\"type\" is \"" + outermost.type + "\""));
}

ImportedFile ReadCityJson(const std::string& file, std::string_view text, const ImportLimits& limits) {
  CityReader reader(file, limits);
  // A stream has one feature a line after the first.
  const size_t line_end = text.find('\n');
  const bool stream = line_end != std::string_view::npos && text.find("\"CityJSONFeature\"") != std::string_view::npos;
  const nlohmann::json head = ParseJson(file, stream ? text.substr(0, line_end) : text);
  reader.ReadHead(JsonRef(file, head));
  if (!stream) {
    reader.ReadObjects(JsonRef(file, head));
    return reader.Take();
  }
  size_t number = 1;
  for (size_t at = line_end + 1; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const std::string where = file + ":" + std::to_string(number);
    const nlohmann::json feature = ParseJson(where, line);
    reader.ReadObjects(JsonRef(where, feature));
  }
  return reader.Take();
}

}  // namespace airsim360::internal

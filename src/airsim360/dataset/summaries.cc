#include "airsim360/dataset/summaries.h"

#include <nlohmann/json.hpp>
#include <set>

#include "airsim360/dataset/people/person_record.h"
#include "airsim360/scene/category_colors.h"
#include "airsim360/scene/parts.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

std::string Dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

// The first part of a path: "vegetation" of "vegetation/tree/elm".
std::string Root(const std::string& path) { return path.substr(0, path.find('/')); }

Json CategoryJson(const SemanticTree& tree, CategoryId id) {
  const Category& category = tree[id];
  const Rgb8 color = CategoryColor(tree, id);
  return {{"id", category.id},
          {"name", category.path},
          {"supercategory", Root(category.path)},
          {"isthing", category.thing ? 1 : 0},
          {"color", {color.r, color.g, color.b}}};
}

Json SegmentJson(const Segment& segment) {
  const PixelBox& b = segment.box;
  const PixelBox& w = segment.box_wrap;
  return {{"id", segment.entity},
          {"category_id", segment.category},
          {"area", segment.area},
          {"bbox", {b.x, b.y, b.w, b.h}},
          {"iscrowd", 0},
          {"bbox_wrap", {w.x, w.y, w.w, w.h}},
          {"solid_angle", segment.solid_angle}};
}

}  // namespace

std::string PeopleJsonl(const DatasetIndex& index, const DatasetSpec& spec) {
  std::string text;
  for (const int64_t frame : index.Frames()) {
    const std::string line = index.FrameLine(frame);
    for (const View& view : Views(spec)) text += PeopleLine(line, spec, view, index.Persons(frame, view.suffix)) + "\n";
  }
  return text;
}

std::string FramesJsonl(const DatasetIndex& index) {
  std::string text;
  for (int64_t frame : index.Frames()) text += index.FrameLine(frame) + "\n";
  return text;
}

std::string EntitiesJson(const DatasetIndex& index, const Scene& scene) {
  std::string text = "{";
  for (const SeenEntity& seen : index.SeenEntities()) {
    const Entity& entity = scene.entity(seen.entity);
    const Category& category = scene.tree[entity.category];
    const Json json = {{"name", entity.name},
                       {"category", entity.category},
                       {"category_path", category.path},
                       {"kind", category.thing ? "thing" : "stuff"},
                       {"first_frame", seen.first_frame}};
    text += (text.size() > 1 ? ",\n\"" : "\n\"") + std::to_string(seen.entity) + "\": " + Dump(json);
  }
  return text + "\n}\n";
}

std::string MaterialsJson(const Scene& scene) {
  static constexpr const char* kKinds[] = {"standard", "foliage", "glass", "water"};
  std::string text = "{";
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    const Json json = {{"name", m.name},
                       {"kind", kKinds[static_cast<int>(m.kind)]},
                       {"base_color", {m.base_color.x, m.base_color.y, m.base_color.z}},
                       {"metallic", m.metallic},
                       {"roughness", m.roughness}};
    text += (i > 0 ? ",\n\"" : "\n\"") + std::to_string(i + 1) + "\": " + Dump(json);
  }
  return text + "\n}\n";
}

std::string PartsJson() {
  Json json = Json::object();
  for (size_t i = 1; i < std::size(kPartNames); ++i) json[std::to_string(i)] = {{"name", kPartNames[i]}};
  return json.dump(1) + "\n";
}

std::string PanopticJson(const DatasetIndex& index, const DatasetSpec& spec, const Scene& scene) {
  const std::vector<View> views = Views(spec);
  const std::string extension = ProductFolders(spec).front().name == "rgb" ? ProductFolders(spec).front().extension : ".png";
  std::string images, annotations;
  for (int64_t frame : index.Frames()) {
    for (size_t v = 0; v < views.size(); ++v) {
      const int64_t id = frame * static_cast<int64_t>(views.size()) + static_cast<int64_t>(v);
      const std::string stem = Stem(frame) + views[v].suffix;
      const Json image = {
          {"id", id}, {"file_name", stem + extension}, {"width", Width(views[v].camera)}, {"height", Height(views[v].camera)}};
      images += (images.empty() ? "\n" : ",\n") + Dump(image);
      std::string segments;
      for (const Segment& segment : index.Segments(frame, views[v].suffix)) {
        segments += (segments.empty() ? "" : ",\n ") + Dump(SegmentJson(segment));
      }
      annotations += (annotations.empty() ? "\n" : ",\n") + std::string("{\"image_id\":") + std::to_string(id) + ",\"file_name\":\"" +
                     stem + ".png\",\"segments_info\":[\n " + segments + "]}";
    }
  }
  // Every category that the world uses, seen or not: the list is the same for all shards.
  std::set<CategoryId> used;
  for (const Entity& entity : scene.entities) used.insert(entity.category);
  std::string categories;
  for (CategoryId id : used) categories += (categories.empty() ? "\n" : ",\n") + Dump(CategoryJson(scene.tree, id));
  return "{\"images\":[" + images + "],\n\"annotations\":[" + annotations + "],\n\"categories\":[" + categories + "]}\n";
}

}  // namespace airsim360

#include "airsim360/assets/importing/import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <utility>

#include "airsim360/assets/baked_light.h"
#include "airsim360/assets/cityjson/cityjson.h"
#include "airsim360/assets/gltf/gltf.h"
#include "airsim360/assets/imported.h"
#include "airsim360/assets/importing/convert_model.h"
#include "airsim360/assets/importing/foreign_format.h"
#include "airsim360/assets/importing/place_model.h"
#include "airsim360/assets/importing/scene_assembly.h"
#include "airsim360/assets/labels/label_rules.h"
#include "airsim360/assets/labels/labelling.h"
#include "airsim360/assets/labels/labels.h"
#include "airsim360/assets/merge.h"
#include "airsim360/assets/obj/obj.h"
#include "airsim360/assets/ply/ply.h"
#include "airsim360/assets/tiles/tiles.h"
#include "airsim360/base/error.h"
#include "airsim360/base/log.h"

namespace airsim360 {
namespace internal {
namespace {

namespace fs = std::filesystem;

// What a reader made of a file.
struct ReadModel {
  ImportedFile file;
  std::string up = "y";  // axis of the file that the reader turned to +Z
  bool metres = false;   // the format itself says what a unit is
};

ReadModel ReadByExtension(const fs::path& path, const std::string& extension) {
  if (const ForeignFormat* foreign = FindForeignFormat(extension)) {
    if (foreign->blender.empty() && !foreign->assimp) throw InputError(UnreadMessage(path));
    const ConvertedModel model = ConvertModel(path, *foreign);
    ReadModel out{.file = ReadGltf(path.string(), model.glb, SearchingLoader(path))};
    // Rotations of the converter go before those of the user: from here on the model is as glTF has it.
    TurnUp(model.up_z ? "z" : "", "y", model.scale, out.file);
    if (model.up_z) out.up = "z";
    out.metres = model.scale != 1;
    return out;
  }
  const Bytes bytes = ReadFile(path);
  const ResourceLoader load = FolderLoader(path.string(), path.parent_path());
  if (extension == ".json" || extension == ".jsonl") {
    if (extension == ".json" && LooksLikeTileset(AsText(bytes)))
      return {.file = ReadTileset(path.string(), AsText(bytes), load), .up = "z", .metres = true};
    CheckIsCityJson(path.string(), AsText(bytes));
    return {.file = ReadCityJson(path.string(), AsText(bytes)), .up = "z", .metres = true};
  }
  if (extension == ".ply") return {.file = ReadPly(path.string(), bytes, load), .up = "z"};
  if (extension == ".b3dm" || extension == ".cmpt") return {.file = ReadTile(path.string(), bytes, load)};
  if (extension == ".obj") return {.file = ReadObj(path.string(), AsText(bytes), load)};
  if (extension == ".glb" || extension == ".gltf") return {.file = ReadGltf(path.string(), bytes, load)};
  throw InputError(UnreadMessage(path));
}

ReadModel ReadModelFile(const fs::path& path, const ModelPlacement& placement) {
  ValidatePlacement(placement, path.string() + ": ");
  std::error_code error;
  if (!fs::exists(path, error)) throw InputError(path.string() + ": no such file");
  ReadModel model = ReadByExtension(path, LowerExtension(path));
  for (const std::string& warning : model.file.warnings) LogWarning(warning);
  PlaceModel(placement, model.up, model.file);
  return model;
}

// The rules that the user names, or those beside the model.
LabelRules FindRules(const fs::path& file, const ImportOptions& options) {
  fs::path path = options.labels;
  if (path.empty()) {
    for (const char* ending : {".labels.yaml", ".labels.yml", ".labels.json"}) {
      fs::path beside = file;
      beside.replace_extension(ending);
      if (fs::is_regular_file(beside)) path = beside;
      beside = file.string() + ending;
      if (fs::is_regular_file(beside)) path = beside;
      if (!path.empty()) break;
    }
  }
  return path.empty() ? LabelRules() : ParseLabelRules(path.string(), ReadTextFile(path, uint64_t{4} << 20));
}

// What the file is about: its name, or its folder's where the file is just called "model".
std::string TitleOf(const fs::path& file) {
  static const std::array<std::string, 9> kGeneric = {"model", "scene",  "mesh",   "object", "untitled",
                                                      "index", "export", "source", "tileset"};
  const std::string stem = file.stem().string();
  const bool generic = std::find(kGeneric.begin(), kGeneric.end(), stem) != kGeneric.end();
  return CleanName(generic ? fs::absolute(file).parent_path().filename().string() : stem);
}

// Longest sides of kinds of things, metres, by the nearest path above.
double UsualSize(std::string path) {
  static const std::map<std::string, double> kUsual = {
      {"vehicle/car", 4.5},          {"vehicle/van", 5},         {"vehicle/bus", 11},        {"vehicle/truck", 8},
      {"vehicle/bicycle", 1.8},      {"human/person", 1.75},     {"vegetation/tree", 9},     {"construction/house", 12},
      {"construction/building", 25}, {"construction/door", 2.1}, {"furniture/seating", 1.1}, {"furniture/sofa", 2},
      {"furniture/table", 1.5},      {"furniture/desk", 1.5},    {"furniture/bed", 2},       {"furniture/seating/bench", 1.7}};
  for (;;) {
    if (const auto it = kUsual.find(path); it != kUsual.end()) return it->second;
    const size_t slash = path.rfind('/');
    if (slash == std::string::npos) return 0;
    path.resize(slash);
  }
}

// Says aloud what units a file is likely in, where they are not metres.
void TellUnits(const Scene& scene, const std::string& file) {
  const auto longest = [](const Box3f& box) { return static_cast<double>(std::max({box.size().x, box.size().y, box.size().z})); };
  std::vector<KnownSize> sizes;
  for (const Entity& entity : scene.entities) {
    const std::string& path = scene.tree[entity.category].path;
    if (const double usual = UsualSize(path); usual > 0 && !entity.bounds.empty())
      sizes.push_back({entity.name, path, longest(entity.bounds), usual});
  }
  const std::string guess = GuessUnits(sizes, longest(scene.bounds));
  if (!guess.empty()) LogWarning(file + ": " + guess + " (in a world file; world import --scale … --out writes one)");
}

// Places are kept in single precision: far from the origin, as in coordinates of a country's survey, little is left of them.
void TellFarAway(const Scene& scene, const std::string& file) {
  constexpr double kCoarse = 0.01;  // metres
  const Vec3d middle = VecCast<double>(scene.bounds.center());
  const double farthest = std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z)});
  const double step = farthest * std::numeric_limits<float>::epsilon();
  if (step < kCoarse) return;
  char text[200];
  std::snprintf(text, sizeof text,
                "lies around (%.0f, %.0f, %.0f), where places are kept to %.2g m: move it to the origin before it is saved", middle.x,
                middle.y, middle.z, step);
  LogWarning(file + ": " + text);
}

}  // namespace
}  // namespace internal

std::shared_ptr<const Scene> ImportScene(const std::filesystem::path& file, const ImportOptions& options) {
  // The rules first: their mistakes are found before a large model is read.
  const internal::LabelRules rules = internal::FindRules(file, options);
  internal::ReadModel model = internal::ReadModelFile(file, options.placement);
  const bool guess = !model.metres && !options.placement.scale;
  const std::string up = options.placement.up.empty() && !model.metres ? internal::GuessUp(model.file, model.up) : "";
  auto scene = internal::AssembleScene(std::move(model.file), rules, internal::TitleOf(file), file.string(), options.placement.baked);
  if (!up.empty()) LogWarning(file.string() + ": " + up + " (in a world file; world import --up … --out writes one)");
  if (guess) internal::TellUnits(*scene, file.string());
  internal::TellFarAway(*scene, file.string());
  return scene;
}

Model ImportModel(const std::filesystem::path& file) {
  internal::ImportedFile imported = internal::ReadModelFile(file, {}).file;
  const std::string copyright = imported.copyright;
  Model model = internal::MergeNodes(std::move(imported), internal::TitleOf(file), internal::ImportLimits().max_triangles);
  if (model.mesh.triangles.empty()) throw InputError(file.string() + ": has no triangles");
  internal::StandOnGround(model);
  model.attribution = copyright;
  return model;
}

}  // namespace airsim360

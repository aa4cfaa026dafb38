#include "airsim360/assets/import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "airsim360/assets/cityjson.h"
#include "airsim360/assets/gltf.h"
#include "airsim360/assets/imported.h"
#include "airsim360/assets/label_rules.h"
#include "airsim360/assets/labelling.h"
#include "airsim360/assets/labels.h"
#include "airsim360/assets/merge.h"
#include "airsim360/assets/obj.h"
#include "airsim360/assets/scene_assembly.h"
#include "airsim360/base/error.h"
#include "airsim360/base/log.h"

namespace airsim360 {
namespace internal {
namespace {

namespace fs = std::filesystem;

ImportedFile ReadModelFile(const fs::path& path) {
  static const std::array<std::string, 6> kChoices = {".glb", ".gltf", ".obj", ".city.json", ".json", ".jsonl"};
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (std::find(kChoices.begin(), kChoices.end(), extension) == kChoices.end()) {
    throw InputError(path.string() + ": " + UnknownChoiceMessage("model format", extension, kChoices));
  }
  const Bytes bytes = ReadFile(path);
  const ResourceLoader load = FolderLoader(path.string(), path.parent_path());
  const bool city = extension == ".json" || extension == ".jsonl";
  if (city) CheckIsCityJson(path.string(), AsText(bytes));
  ImportedFile file = city                  ? ReadCityJson(path.string(), AsText(bytes))
                      : extension == ".obj" ? ReadObj(path.string(), AsText(bytes), load)
                                            : ReadGltf(path.string(), bytes, load);
  for (const std::string& warning : file.warnings) LogWarning(warning);
  return file;
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
  static const std::array<std::string, 8> kGeneric = {"model",    "scene", "mesh",   "object",
                                                      "untitled", "index", "export", "source"};
  const std::string stem = file.stem().string();
  const bool generic = std::find(kGeneric.begin(), kGeneric.end(), stem) != kGeneric.end();
  return CleanName(generic ? fs::absolute(file).parent_path().filename().string() : stem);
}

}  // namespace
}  // namespace internal

std::shared_ptr<const Scene> ImportScene(const std::filesystem::path& file, const ImportOptions& options) {
  // The rules first: their mistakes are found before a large model is read.
  const internal::LabelRules rules = internal::FindRules(file, options);
  return internal::AssembleScene(internal::ReadModelFile(file), rules, internal::TitleOf(file),
                                 file.string());
}

Model ImportModel(const std::filesystem::path& file) {
  internal::ImportedFile imported = internal::ReadModelFile(file);
  const std::string copyright = imported.copyright;
  Model model = internal::MergeNodes(std::move(imported), internal::TitleOf(file),
                                     internal::ImportLimits().max_triangles);
  if (model.mesh.triangles.empty()) throw InputError(file.string() + ": has no triangles");
  internal::StandOnGround(model);
  model.attribution = copyright;
  return model;
}

}  // namespace airsim360

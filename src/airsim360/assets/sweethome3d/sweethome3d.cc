#include "airsim360/assets/sweethome3d/sweethome3d.h"

#include <algorithm>
#include <map>
#include <utility>

#include "airsim360/assets/axes.h"
#include "airsim360/assets/importing/import.h"
#include "airsim360/assets/labels/words.h"
#include "airsim360/assets/merge.h"
#include "airsim360/assets/obj/obj.h"
#include "airsim360/assets/zip_archive.h"
#include "airsim360/base/error.h"
#include "airsim360/base/log.h"

namespace airsim360 {
namespace internal {
namespace {

namespace fs = std::filesystem;

// Files beside the OBJ. Names that come from the maker's disk ("C:/…/wood.jpg") are looked up by their last
// part.
ResourceLoader ZipLoader(const ZipArchive& zip, const std::string& model_path) {
  const fs::path folder = fs::path(model_path).parent_path();
  return [&zip, folder](const std::string& name) -> std::optional<Bytes> {
    if (auto bytes = zip.Read((folder / name).lexically_normal().string())) return bytes;
    return zip.Read((folder / fs::path(name).filename()).string());
  };
}

MtlContext ContextOf(const CatalogueModel& entry) {
  const std::vector<std::string> words = SplitWords(entry.title + " " + entry.tags + " " + entry.stem + " " + entry.category);
  return {.vehicle = HasWord(words, {"vehicle"}),
          .plant = HasWord(
              words, {"tree",  "plant",  "bush",    "hedge", "flower",  "cactus", "bamboo", "palm",    "pine",       "poplar", "maple",
                      "beech", "acacia", "cypress", "ficus", "coconut", "peach",  "lily",   "palmeto", "vegetation", "ivy",    "grass"})};
}

// Rotates, scales each axis to the catalogue's size and stands the model on the ground.
void FitToCatalogue(Model& model, const CatalogueModel& entry) {
  TransformMesh(model.mesh, FromG(TransformG{entry.rotation_G, {}}));
  const Vec3f size = model.mesh.Bounds().size();
  AffineTransform fit;
  for (int i = 0; i < 3; ++i) {
    if (size[i] > 1e-9f * Norm(size)) fit.A.m[i][i] = entry.size[i] / size[i];
  }
  TransformMesh(model.mesh, fit);
  StandOnGround(model);
}

class SweetHomeModels : public ModelSource {
 public:
  explicit SweetHomeModels(const fs::path& folder) {
    // Libraries in order of name: of equal stems the first is the plain one, all are known as "library/stem"
    // too.
    std::vector<fs::path> files;
    std::error_code error;
    for (const auto& file : fs::directory_iterator(folder, error)) {
      if (file.path().extension() == ".sh3f") files.push_back(file.path());
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) AddLibrary(file);
  }

  bool empty() const { return entries_.empty(); }

  std::optional<Model> Load(std::string_view name) const override {
    const auto it = entries_.find(name);
    if (it == entries_.end()) return std::nullopt;
    try {
      return Read(*it->second);
    } catch (const InputError& error) {
      LogWarning("model '" + std::string(name) + "' cannot be used: " + error.what());
      return std::nullopt;
    }
  }

 private:
  struct Entry {
    fs::path zip;
    CatalogueModel model;
  };

  void AddLibrary(const fs::path& file) {
    try {
      const std::string properties = "PluginFurnitureCatalog.properties";
      const std::optional<Bytes> text = ZipArchive(file).Read(properties);
      if (!text) return;
      for (CatalogueModel& model : ParseCatalogue(file.string() + "/" + properties, AsText(*text))) {
        const auto entry = std::make_shared<const Entry>(Entry{file, std::move(model)});
        entries_.try_emplace(entry->model.stem, entry);
        entries_.try_emplace(file.stem().string() + "/" + entry->model.stem, entry);
      }
    } catch (const InputError& error) {
      LogWarning(std::string("furniture library left out: ") + error.what());
    }
  }

  static Model Read(const Entry& entry) {
    const ZipArchive zip(entry.zip);
    const std::string& path = entry.model.path;
    const std::optional<Bytes> obj = zip.Read(path);
    if (!obj) throw InputError(entry.zip.string() + ": has no '" + path + "'");
    const ImportLimits limits;
    const ResourceLoader load = ZipLoader(zip, path);
    ImportedFile file = ReadObj(entry.zip.string() + "/" + path, AsText(*obj), load, limits, ContextOf(entry.model));
    Model model = MergeNodes(std::move(file), entry.model.stem, limits.max_triangles);
    if (model.mesh.triangles.empty()) throw InputError(path + ": no triangles");
    FitToCatalogue(model, entry.model);
    model.attribution = entry.model.title + ", " + entry.model.creator + ", " + entry.model.licence;
    return model;
  }

  std::map<std::string, std::shared_ptr<const Entry>, std::less<>> entries_;
};

}  // namespace
}  // namespace internal

std::unique_ptr<ModelSource> OpenSweetHomeModels(const std::filesystem::path& folder) {
  auto models = std::make_unique<internal::SweetHomeModels>(folder);
  if (models->empty()) return nullptr;
  return models;
}

}  // namespace airsim360

#include "airsim360/sim/world_loader.h"

#include <cctype>
#include <utility>

#include "airsim360/assets/import.h"
#include "airsim360/base/config.h"
#include "airsim360/base/error.h"
#include "airsim360/sim/world_environment.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

std::string LowerExtension(const fs::path& path) {
  std::string extension = path.extension();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

bool IsModelFile(const fs::path& path) {
  const std::string extension = LowerExtension(path);
  return extension == ".glb" || extension == ".gltf" || extension == ".obj";
}

bool IsWorldFile(const fs::path& path) {
  const std::string extension = LowerExtension(path);
  return extension == ".yaml" || extension == ".yml";
}

// The fields of a world YAML, filled into `request` and, over its values, `environment`.
WorldRequest ReadWorldFile(const fs::path& file, WorldRequest request, Environment& environment) {
  std::string world, labels;
  ReadYamlFile(file, [&](ConfigVisitor& v) {
    v.Field("world", "name of a built-in world, or a .glb, .gltf or .obj file", world);
    v.Field("seed", "seed of the world", request.seed);
    v.Field("labels", "label override file for imports", labels);
    v.Field("use_models", "use the models of sweethome3d-furniture where installed", request.use_models);
    v.Group("environment", "sun, sky and weather",
            [&](ConfigVisitor& group) { VisitEnvironment(group, file.parent_path(), environment); });
  });
  if (world.empty()) throw InputError(file.string() + ": key 'world' is missing");
  if (IsWorldFile(world)) throw InputError(file.string() + ": world: '" + world + "' is a world file itself");
  request.world = IsModelFile(world) ? (file.parent_path() / world).string() : world;
  if (!labels.empty()) request.labels = file.parent_path() / labels;
  return request;
}

}  // namespace

std::shared_ptr<const Scene> LoadWorld(const WorldRequest& request) {
  const fs::path path = request.world;
  if (IsWorldFile(path)) {
    // Read once for the world (and to find mistakes early), once more over the environment that it has.
    Environment environment;
    auto scene = LoadWorld(ReadWorldFile(path, request, environment));
    environment = scene->environment;
    ReadWorldFile(path, request, environment);
    return WithEnvironment(std::move(scene), environment);
  }
  if (IsModelFile(path)) return ImportScene(path, {.labels = request.labels});
  const auto models = request.use_models ? OpenSweetHomeModels() : nullptr;
  return BuildWorld(request.world, {.seed = request.seed, .models = models.get()});
}

}  // namespace airsim360

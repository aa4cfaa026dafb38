#include "airsim360/opening/world_loader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "airsim360/assets/importing/import.h"
#include "airsim360/base/config.h"
#include "airsim360/base/disk_cache.h"
#include "airsim360/base/error.h"
#include "airsim360/base/freed_memory.h"
#include "airsim360/opening/height_file.h"
#include "airsim360/opening/world_environment.h"
#include "airsim360/opening/world_file.h"
#include "airsim360/scene/scene_archive.h"
#include "airsim360/worlds/osm/buildings/city_facades.h"
#include "airsim360/worlds/osm/osm_world.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

// Names of built-in worlds have neither a folder nor an extension.
bool IsPath(const fs::path& path) { return path.has_parent_path() || path.has_extension(); }

bool IsCityFile(const fs::path& path) {
  std::string extension = path.extension();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".json" || extension == ".jsonl";
}

bool IsWorldFile(const fs::path& path) {
  const std::string extension = path.extension();
  return extension == ".yaml" || extension == ".yml";
}

// How a model lies in W.
void VisitPlacement(ConfigVisitor& v, ModelPlacement& placement) {
  double scale = placement.scale.value_or(std::nan(""));
  v.Field("scale", "models: metres a unit of the file", scale, ModelPlacement::kLeastScale, ModelPlacement::kMostScale);
  if (!std::isnan(scale)) placement.scale = scale;
  v.Field("up", "models: axis of the file that points up (x, y, z, -x, -y, -z)", placement.up);
  enum class Light { kGuessed, kBaked, kLit } light = Light::kGuessed;
  static constexpr const char* kLights[] = {"guessed", "baked", "lit"};
  if (placement.baked) light = *placement.baked ? Light::kBaked : Light::kLit;
  v.Field("light", "models: baked into the colours of scanned rooms, or from sun, sky and lamps (lit)", light, kLights);
  if (light != Light::kGuessed) placement.baked = light == Light::kBaked;
  v.Field("ground", "models: stands on a plain at z = 0", placement.ground);
  v.Group("offset", "models: moved by so much in W, metres", [&](ConfigVisitor& group) {
    for (const auto& [name, value] : {std::pair{"x", &placement.offset.x}, {"y", &placement.offset.y}, {"z", &placement.offset.z}})
      group.Field(name, "metres", *value, -ModelPlacement::kMostOffset, ModelPlacement::kMostOffset);
  });
}

void VisitLamp(ConfigVisitor& v, PlacedLamp& lamp) {
  v.Field("name", "of the entity", lamp.name);
  v.Field("x", "metres east", lamp.x, -100000, 100000);
  v.Field("y", "metres north", lamp.y, -100000, 100000);
  v.Field("z", "metres up", lamp.z, -10000, 10000);
  v.Field("lumens", "light to all sides", lamp.lumens, 1, 500000);
  v.Field("kelvin", "its white", lamp.kelvin, 2000, 9000);
  v.Field("radius", "of the ball, metres", lamp.radius, 0.01, 2);
  v.Field("always", "by day too; else while the lamps of the world burn", lamp.always);
}

// The fields of a world YAML, filled into `request` and `environment`, and `lamps:`.
WorldRequest ReadWorldFile(const fs::path& file, WorldRequest request, EnvironmentWords& environment,
                           std::vector<PlacedLamp>* added = nullptr) {
  std::string world, labels, heights, bbox, centre;
  std::vector<PlacedLamp> lamps;
  double radius = 0;
  ReadYamlFile(file, [&](ConfigVisitor& v) {
    v.Field("world", "name of a built-in world, or a model or map file", world);
    v.Field("seed", "seed of the world", request.seed);
    v.Field("labels", "label override file", labels);
    v.Field("heights", "maps: GeoTIFF of the ground's heights", heights);
    VisitPlacement(v, request.placement);
    v.Field("bbox", "maps: only this piece, south,west,north,east in degrees", bbox);
    v.Field("centre", "maps: only a square around latitude,longitude in degrees", centre);
    v.Field("radius", "maps: of centre, metres to each side", radius, 10, 30000);
    v.Field("fill", "maps: add parked cars, lamps and trees where the map has none; CityJSON: add facades", request.fill);
    v.Field("use_models", "use the models of sweethome3d-furniture where installed", request.use_models);
    request.additions.Visit(v);
    v.List("lamps", "lamps of your own", lamps, [](ConfigVisitor& entry, PlacedLamp& lamp) { VisitLamp(entry, lamp); });
    v.Group("environment", "sun, sky and weather", [&](ConfigVisitor& group) { environment.Visit(group, file.parent_path()); });
  });
  // Mistakes in words of the sky are found before a world is loaded.
  try {
    environment.Over({});
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.what());
  }
  if (world.empty()) throw InputError(file.string() + ": key 'world' is missing");
  if (IsWorldFile(world)) throw InputError(file.string() + ": world: '" + world + "' is a world file itself");
  if (added) *added = std::move(lamps);
  request.world = IsPath(world) ? (file.parent_path() / world).string() : world;
  request.additions.Resolve(file);
  ValidatePlacement(request.placement, file.string() + ": ");
  // The flags count before the file.
  const std::optional<MapCut> cut = MapCutOf(file.string() + ": ", bbox, centre, radius);
  if (!request.cut) request.cut = cut;
  if (!labels.empty() && request.labels.empty()) request.labels = file.parent_path() / labels;
  if (!heights.empty()) request.heights = file.parent_path() / heights;
  return request;
}

// Everything that a world that we build depends on.
CacheKey KeyOf(const WorldRequest& request) {
  CacheKey key("scene", 1);
  // A map is the same by whatever name of its path.
  std::error_code error;
  const auto place = [&](const fs::path& path) { return fs::weakly_canonical(path, error).string(); };
  const bool map = IsOsmFile(request.world);
  key.AddProgram().Add(map ? place(request.world) : request.world).Add(request.seed).Add(request.use_models);
  if (map) {
    key.AddFile(request.world).Add(request.fill).Add(request.heights.empty() ? "" : place(request.heights));
    if (!request.heights.empty()) key.AddFile(request.heights);
    if (request.cut)
      for (double degrees : {request.cut->box.west, request.cut->box.south, request.cut->box.east, request.cut->box.north})
        key.Add(degrees);
  }
  request.additions.AddTo(key);
  if (!request.use_models) return key;
  std::vector<fs::path> libraries;
  for (const auto& file : fs::recursive_directory_iterator(kSweetHomeFolder, error)) libraries.push_back(file.path());
  std::sort(libraries.begin(), libraries.end());
  for (const fs::path& library : libraries) key.AddFile(library);
  return key;
}

std::shared_ptr<const Scene> BuildAnew(const WorldRequest& request, OsmReport* report = nullptr) {
  const auto models = request.use_models ? OpenSweetHomeModels() : nullptr;
  if (!IsOsmFile(request.world)) {
    return BuildWorld(request.world, {.seed = request.seed,
                                      .models = models.get(),
                                      .city = request.additions.city,
                                      .props = request.additions.LoadModels(),
                                      .town = request.additions.town,
                                      .building = request.additions.building});
  }
  OsmOptions options{.seed = request.seed, .models = models.get(), .cut = request.cut, .fill = request.fill};
  if (!request.heights.empty()) options.heights = [&](const GeoBox& area) { return ReadHeights(request.heights, area); };
  return BuildOsmWorld(fs::path(request.world), options, report);
}

// Built, or as built by an earlier run.
std::shared_ptr<const Scene> LoadBuilt(const WorldRequest& request) {
  const CacheKey key = KeyOf(request);
  const DiskCache cache = DiskCache::OfUser();
  if (const std::optional<CacheContent> kept = cache.Load(key)) {
    if (std::optional<Scene> scene = SceneFromArchive(kept->bytes())) {
      scene->cache_key = key.Name();
      return std::make_shared<Scene>(std::move(*scene));
    }
  }
  auto built = BuildAnew(request);
  if (!cache.folder().empty()) cache.Store(key, ArchiveScene(*built));
  ReturnFreedMemory();
  return WithCacheKey(std::move(built), key.Name());
}

// Clouds that nobody chose are the world's own, and stay so when it is exported.
std::shared_ptr<const Scene> WithOwnSky(std::shared_ptr<const Scene> scene, uint64_t seed) {
  if (scene->environment.sky_seed != 0) return scene;
  Environment environment = scene->environment;
  environment.sky_seed = SkySeedOf(scene->name, seed);
  return WithEnvironment(std::move(scene), std::move(environment));
}

// What a world file adds goes with few worlds.
void CheckAdditions(const WorldRequest& request) {
  const bool new_york = request.world == "new_york_city" || request.world == "new_york_city_1950s",
             props = !request.additions.props.empty();
  if ((!request.additions.no_city() && !new_york) || (props && !new_york && request.world != "downtown_west"))
    throw InputError("'" + request.world + "': 'city' is for new_york_city and new_york_city_1950s, 'props' for them and downtown_west");
  if (!request.additions.no_town() && request.world != "town") throw InputError("'" + request.world + "': 'town' is for the world town");
  if (!request.additions.no_building() && request.world != "building")
    throw InputError("'" + request.world + "': 'building' is for the world building");
}

std::shared_ptr<const Scene> LoadScene(const WorldRequest& request) {
  const fs::path path = request.world;
  CheckAdditions(request);
  if (request.cut && !IsOsmFile(path)) throw InputError(request.cut->text + ": it cuts maps (.osm, .osm.pbf), not '" + request.world + "'");
  if (!request.fill && !IsOsmFile(path) && !IsCityFile(path))
    throw InputError("fill: it is for maps (.osm, .osm.pbf) and CityJSON, not for '" + request.world + "'");
  const bool model = IsPath(path) && !IsOsmFile(path);
  if (model && request.heights.empty()) {
    auto scene = ImportScene(path, {.labels = request.labels, .placement = request.placement});
    return request.fill && IsCityFile(path) ? WithFacades(std::move(scene), request.seed) : scene;
  }
  if (!request.placement.empty()) throw InputError("'" + request.world + "': scale, up, light, offset and ground are for model files");
  if (!request.heights.empty() && !IsOsmFile(path))
    throw InputError(request.heights.string() + ": heights are for maps (.osm, .osm.pbf), not for '" + request.world + "'");
  return Relabelled(LoadBuilt(request), request.labels);
}

}  // namespace

std::vector<PlacedLamp> LampsOfWorldFile(const fs::path& file) {
  EnvironmentWords environment;
  std::vector<PlacedLamp> lamps;
  ReadWorldFile(file, {}, environment, &lamps);
  return lamps;
}

std::shared_ptr<const Scene> LoadMap(const WorldRequest& request, OsmReport* report) {
  auto built = BuildAnew(request, report);
  const CacheKey key = KeyOf(request);
  const DiskCache cache = DiskCache::OfUser();
  if (!cache.folder().empty()) cache.Store(key, ArchiveScene(*built));
  return WithOwnSky(Relabelled(WithCacheKey(std::move(built), key.Name()), request.labels), request.seed);
}

std::optional<GeoPoint> OriginOfWorld(const WorldRequest& request) {
  if (IsWorldFile(request.world)) {
    EnvironmentWords environment;
    return OriginOfWorld(ReadWorldFile(request.world, request, environment));
  }
  if (!IsOsmFile(request.world)) return std::nullopt;
  return OriginOfOsmWorld(request.world, request.cut);
}

std::optional<BuildingRooms> RoomsOf(const WorldRequest& request) {
  if (IsWorldFile(request.world)) {
    EnvironmentWords environment;
    return RoomsOf(ReadWorldFile(request.world, request, environment));
  }
  CheckAdditions(request);
  return RoomsOfWorld(request.world, {.seed = request.seed, .building = request.additions.building});
}

std::shared_ptr<const Scene> LoadWorld(const WorldRequest& request) {
  if (IsWorldFile(request.world)) {
    EnvironmentWords words;
    std::vector<PlacedLamp> lamps;
    const WorldRequest inner = ReadWorldFile(request.world, request, words, &lamps);
    auto scene = WithLamps(LoadWorld(inner), lamps);
    Environment environment = words.Over(scene->environment);
    return WithOwnSky(WithEnvironment(std::move(scene), std::move(environment)), inner.seed);
  }
  return WithOwnSky(LoadScene(request), request.seed);
}

}  // namespace airsim360

#include "airsim360/rpc/session/scene_extras.h"

#include <cmath>
#include <numbers>

#include "airsim360/rpc/session/airsim_drone.h"
#include "airsim360/scene/viewpoint.h"

namespace airsim360 {
namespace {

constexpr float kHalf = 0.5f;  // metres: all shapes fit a cube of 1 m, standing on z = 0
constexpr int kRound = 32;     // sides of what is round
constexpr const char* kShapeCategory = "object";

SpawnAsset Finish(const char* name, Mesh mesh) {
  SpawnAsset asset{name, kShapeCategory, {}};
  mesh.name = name;
  mesh.parts = {{0, static_cast<uint32_t>(mesh.triangles.size()), 0}};
  asset.model.materials = {{.name = "spawned", .base_color = {0.45f, 0.45f, 0.47f}, .roughness = 0.7f}};
  asset.model.mesh = std::move(mesh);
  return asset;
}

void AddQuad(Mesh& mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

Mesh Cube() {
  Mesh mesh;
  // Each side has corners of its own: edges stay sharp.
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-kHalf, kHalf}) {
      const auto first = static_cast<uint32_t>(mesh.positions.size());
      for (const auto& [u, v] : {std::pair{-kHalf, -kHalf}, {kHalf, -kHalf}, {kHalf, kHalf}, {-kHalf, kHalf}}) {
        Vec3f p{};
        p[axis] = side;
        p[(axis + 1) % 3] = side > 0 ? u : v;
        p[(axis + 2) % 3] = side > 0 ? v : u;
        mesh.positions.push_back(p + Vec3f{0, 0, kHalf});
      }
      AddQuad(mesh, first, first + 1, first + 2, first + 3);
    }
  }
  return mesh;
}

// A body of revolution about the z axis: (radius, height) from bottom to top.
Mesh Turned(const std::vector<Vec2f>& profile) {
  Mesh mesh;
  for (const Vec2f& ring : profile) {
    for (int k = 0; k < kRound; ++k) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / kRound;
      mesh.positions.push_back({ring.x * std::cos(angle), ring.x * std::sin(angle), ring.y});
    }
  }
  for (uint32_t ring = 0; ring + 1 < profile.size(); ++ring) {
    for (uint32_t k = 0; k < kRound; ++k) {
      const uint32_t next = (k + 1) % kRound, a = ring * kRound, b = a + kRound;
      // Rings without a radius are points: one triangle less.
      if (profile[ring].x > 0) mesh.triangles.push_back({a + k, a + next, b + next});
      if (profile[ring + 1].x > 0) mesh.triangles.push_back({a + k, b + next, b + k});
    }
  }
  return mesh;
}

Mesh Sphere() {
  std::vector<Vec2f> profile;
  for (int i = 0; i <= kRound / 2; ++i) {
    const float angle = std::numbers::pi_v<float> * static_cast<float>(i) / (kRound / 2);
    const bool pole = i == 0 || i == kRound / 2;
    profile.push_back({pole ? 0 : kHalf * std::sin(angle), kHalf - kHalf * std::cos(angle)});
  }
  return Turned(profile);
}

// Adds one body and then copies of it, each with a name of its own; their refs are the last `count`.
void AddCopies(const std::string& name, const std::string& category, const Model& model, Vec3d somewhere, size_t count,
               std::vector<DroneBodySpec>& bodies) {
  const size_t first = bodies.size();
  for (size_t i = 0; i < count; ++i) {
    DroneBodySpec body{
        .name = i == 0 ? name : name + " " + std::to_string(i + 1), .model = {}, .X_WB = {{}, somewhere}, .category = category};
    i == 0 ? (void)(body.model = model) : (void)(body.same_as = first);
    bodies.push_back(std::move(body));
  }
}

}  // namespace

std::vector<SpawnAsset> ShapeAssets() {
  std::vector<SpawnAsset> assets;
  assets.push_back(Finish("Cube", Cube()));
  assets.push_back(Finish("Sphere", Sphere()));
  assets.push_back(Finish("Cylinder", Turned({{0, 0}, {kHalf, 0}, {kHalf, 1}, {0, 1}})));
  assets.push_back(Finish("Cone", Turned({{0, 0}, {kHalf, 0}, {0, 1}})));
  return assets;
}

size_t CopiesOf(const SpawnAsset& asset) {
  constexpr size_t kCubes = 512, kShapes = 128, kProps = 16;
  if (asset.name == "Cube") return kCubes;
  return asset.category == kShapeCategory ? kShapes : kProps;
}

std::vector<DroneBodySpec> ExtraBodies(const Scene& scene, const AirSimSettings& settings, const std::vector<SpawnAsset>& assets) {
  const Vec3d somewhere = VecCast<double>(FirstViewpoint(scene));
  std::vector<DroneBodySpec> bodies;
  const Model drone = DroneBodyModel(AirSimQuad());
  for (const auto& [name, vehicle] : settings.vehicles) {
    if (!vehicle.auto_create || vehicle.type == "ComputerVision") continue;
    AddCopies(name, "uav/other", drone, somewhere, 1, bodies);
  }
  AddCopies("unused drone", "uav/other", drone, somewhere, kSpareDrones, bodies);
  for (const SpawnAsset& asset : assets) AddCopies("unused " + asset.name, asset.category, asset.model, somewhere, CopiesOf(asset), bodies);
  return bodies;
}

SceneExtras SortExtras(std::span<const DroneBodyRef> bodies, const std::vector<SpawnAsset>& assets) {
  size_t held = 0;
  for (const SpawnAsset& asset : assets) held += CopiesOf(asset);
  SceneExtras extras;
  auto first = bodies.end() - static_cast<ptrdiff_t>(held);
  extras.drones.assign(bodies.begin(), first);
  for (const SpawnAsset& asset : assets) {
    const auto end = first + static_cast<ptrdiff_t>(CopiesOf(asset));
    extras.stock.push_back({asset.name, {first, end}});
    first = end;
  }
  return extras;
}

}  // namespace airsim360

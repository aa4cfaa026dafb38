// Gravel paths, the lake and its paved landings.
#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/city_park/noise.h"
#include "airsim360/worlds/city_park/park.h"
#include "airsim360/worlds/kit/mesh_builder.h"

namespace airsim360::internal::park {
namespace {

constexpr int kAcross = 5;

// Cross-section i of a path: points from right to left, on the ground, its borders uneven.
std::array<Vec3f, kAcross + 1> Section(const Layout& layout, const Curve& path, float s, float lift) {
  std::array<Vec3f, kAcross + 1> row;
  for (int k = 0; k <= kAcross; ++k) {
    const float t = 2 * static_cast<float>(k) / kAcross - 1;
    const float half = kPathHalf + 0.16f * (Noise(s / 1.7f, t < 0 ? 0.0f : 9.5f, 71) - 0.5f);
    const Vec2f p = path.At(s, t * half);
    // A slight crown; the borders meet the lawn.
    row[static_cast<size_t>(k)] = {p.x, p.y, layout.Ground(p) + lift + 0.02f * (1 - t * t)};
  }
  return row;
}

void LayPath(Park& park, MeshBuilder& mesh, const Curve& path, float lift) {
  mesh.SetMaterial(park.materials.gravel);
  constexpr float kStep = 0.8f, kStretch = 60;
  const auto uv = [](Vec3f p) { return Vec2f{p.x, -p.y}; };
  int stretch = -1;
  for (float s = 0; s + kStep <= path.length(); s += kStep) {
    // Paths begin behind the pavement.
    if (park.layout.BeyondRoad(path.At(s + kStep / 2)) < -0.1f) continue;
    if (static_cast<int>(s / kStretch) != stretch) {
      stretch = static_cast<int>(s / kStretch);
      mesh.SetEntity(park.AddEntity("gravel path", "ground/path/park_walkway"));
    }
    const auto a = Section(park.layout, path, s, lift), b = Section(park.layout, path, s + kStep, lift);
    for (size_t k = 0; k < kAcross; ++k) mesh.QuadUv(a[k], b[k], b[k + 1], a[k + 1], uv(a[k]), uv(b[k]), uv(b[k + 1]), uv(a[k + 1]));
  }
}

// Point of the plane where Lake() is `level`, in the direction `a` from the lake's middle.
Vec2f LakeRim(const Layout& layout, float a, float level) {
  const Vec2f d{std::cos(a), std::sin(a)};
  const float per_metre = layout.Lake(kLakeCenter + d * 10.0f) / 10;
  return kLakeCenter + d * (level / per_metre);
}

void FillLake(Park& park, MeshBuilder& mesh) {
  mesh.SetMaterial(park.surfaces[Surface::kWater]);
  mesh.SetEntity(park.AddEntity("lake", "water/water_plane"));
  constexpr int kRim = 120;
  const auto at = [&](int i, float level) {
    const Vec2f p = LakeRim(park.layout, kTauF * static_cast<float>(i % kRim) / kRim, level);
    return Vec3f{p.x, p.y, kLakeZ};
  };
  const auto uv = [](Vec3f p) { return Vec2f{p.x, -p.y}; };
  const Vec3f c{kLakeCenter.x, kLakeCenter.y, kLakeZ};
  for (int i = 0; i < kRim; ++i) {
    const Vec3f a = at(i, 0.6f), b = at(i + 1, 0.6f), e = at(i, 1.25f), f = at(i + 1, 1.25f);
    mesh.Triangle(c, a, b, uv(c), uv(a), uv(b));
    mesh.QuadUv(a, e, f, b, uv(a), uv(e), uv(f), uv(b));
  }
}

// A terrace of slabs at the shore with a stone wall to the water.
void BuildLanding(Park& park, MeshBuilder& mesh, float a) {
  const Vec2f middle = LakeRim(park.layout, a, 1.10f), out = middle - kLakeCenter;
  const float yaw = std::atan2(out.y, out.x) - kTauF / 4;
  constexpr float kHalfX = 4.5f, kHalfY = 2.6f;
  float top = kLakeZ + 0.35f;
  for (float x : {-kHalfX, 0.0f, kHalfX}) {
    for (float y : {-kHalfY, 0.0f, kHalfY}) {
      const Vec2f p{middle.x + x * std::cos(yaw) - y * std::sin(yaw), middle.y + x * std::sin(yaw) + y * std::cos(yaw)};
      top = std::max(top, park.layout.Ground(p) + 0.22f);
    }
  }
  mesh.SetTransform(PlaceUpright({middle.x, middle.y, top}, yaw));
  mesh.SetEntity(park.AddEntity("lake landing", "ground/sidewalk/pool_edge"));
  mesh.SetMaterial(park.surfaces[Surface::kSlabsWarm]);
  mesh.Quad({-kHalfX, -kHalfY, 0}, {kHalfX, -kHalfY, 0}, {kHalfX, kHalfY, 0}, {-kHalfX, kHalfY, 0});
  mesh.SetMaterial(park.surfaces[Surface::kKerb]);
  mesh.Box({-kHalfX, -kHalfY, -2.2f}, {kHalfX, kHalfY, -0.0f},
           MeshBuilder::kLeft | MeshBuilder::kRight | MeshBuilder::kFront | MeshBuilder::kBack);
  mesh.SetTransform({});
  park.placer.Reserve({middle, {kHalfX + 0.3f, kHalfY + 0.3f}, yaw});
  for (float x : {-2.4f, 2.4f}) {
    const Vec2f p{middle.x + x * std::cos(yaw) - 1.6f * std::sin(yaw), middle.y + x * std::sin(yaw) + 1.6f * std::cos(yaw)};
    const EntityId bench = park.AddEntity("bench", "furniture/seating/bench");
    park.placer.shelf().PlaceAs(bench, "bench_wood", PlaceUpright({p.x, p.y, top}, yaw), 1);
  }
}

}  // namespace

void LayPathsAndWater(Park& park) {
  MeshBuilder mesh;
  float lift = 0.02f;
  for (const Curve& path : park.layout.paths()) {
    LayPath(park, mesh, path, lift);
    lift += 0.005f;  // where they cross, one lies on top
  }
  FillLake(park, mesh);
  for (float a : {-0.95f, 0.55f, 3.4f}) BuildLanding(park, mesh, a);
  park.builder.AddInstance({park.builder.AddMesh(mesh.Finish("paths and water")), {}, kNoEntity});
}

}  // namespace airsim360::internal::park

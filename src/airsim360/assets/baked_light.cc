#include "airsim360/assets/baked_light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

constexpr double kLeastFloor = 4;        // square metres
constexpr double kCeilingOfFloor = 0.4;  // least share of the one in the other
constexpr double kHeadroom = 1.2;        // metres from the mean floor to the mean ceiling, at least
constexpr float kLuxOfRooms = 300;
constexpr uint64_t kMostMeasured = uint64_t{1} << 27;  // triangles of all nodes: a file may show one mesh a million times

/// Areas in square metres of what a file shows.
struct Surfaces {
  double all = 0, unlit = 0, plain = 0;
  double up = 0, down = 0;                // level, facing up and down
  double height_up = 0, height_down = 0;  // sums of area times height
  bool shines = false;
  Box3f box;
};

// The file's own: a plain that was added says nothing of it.
bool IsShown(const ImportedNode& node) { return node.mesh >= 0 && !node.added; }

bool IsTooMuch(const ImportedFile& file) {
  uint64_t seen = 0;
  for (const ImportedNode& node : file.nodes) {
    if (IsShown(node)) seen += file.meshes[static_cast<size_t>(node.mesh)].triangles.size();
    if (seen > kMostMeasured) return true;
  }
  return false;
}

std::vector<bool> UnlitByMaterial(const ImportedFile& file) {
  std::vector<bool> unlit(file.materials.size());
  for (const MaterialId id : file.unlit) unlit[id] = true;
  return unlit;
}

Surfaces MeasureSurfaces(const ImportedFile& file) {
  const std::vector<bool> is_unlit = UnlitByMaterial(file);
  Surfaces s;
  for (const ImportedNode& node : file.nodes) {
    if (!IsShown(node)) continue;
    const Mesh& mesh = file.meshes[static_cast<size_t>(node.mesh)];
    for (const MeshPart& part : mesh.parts) {
      const Material& material = file.materials[part.material];
      const bool unlit = is_unlit[part.material];
      const bool colored = material.base_color_texture != kNoTexture || !mesh.colors.empty();
      s.shines |= material.emission != Vec3f{} || material.kind == SurfaceKind::kGlass;
      for (uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
        Vec3d p[3];
        for (int k = 0; k < 3; ++k) {
          const Vec3f corner = node.X_WM * mesh.positions[mesh.triangles[t][k]];
          s.box.Add(corner);
          p[k] = VecCast<double>(corner);
        }
        const Vec3d normal = Cross(p[1] - p[0], p[2] - p[0]);
        const double area = 0.5 * Norm(normal), height = (p[0].z + p[1].z + p[2].z) / 3;
        s.all += area;
        if (unlit) s.unlit += area;
        if (!colored) s.plain += area;
        if (normal.z > 0.9 * 2 * area) s.up += area, s.height_up += area * height;
        if (normal.z < -0.9 * 2 * area) s.down += area, s.height_down += area * height;
      }
    }
  }
  return s;
}

bool HasRooms(const Surfaces& s) {
  const double less = std::min(s.up, s.down), more = std::max(s.up, s.down);
  return more > kLeastFloor && less >= kCeilingOfFloor * more && s.height_down / s.down - s.height_up / s.up > kHeadroom;
}

}  // namespace

std::string WhyBaked(const ImportedFile& file, bool named) {
  const bool could = !file.unlit.empty() || !named;
  if (!could || IsTooMuch(file)) return "";
  const Surfaces s = MeasureSurfaces(file);
  if (!HasRooms(s)) return "";
  if (s.unlit >= 0.5 * s.all) return "rooms of unlit materials";
  if (!named && !s.shines && s.plain <= 0.02 * s.all) return "a scan of rooms without lamps";
  return "";
}

Vec3f LightOfBakedRooms() {
  constexpr float kRadiance = kLuxOfRooms * kNit / static_cast<float>(kPi);
  return {kRadiance, kRadiance, kRadiance};
}

std::string GuessUp(const ImportedFile& file, const std::string& as_read) {
  constexpr float kLowest = 1.8f, kHighest = 15, kFlat = 0.6f;  // metres of a building's height, and its share of the width
  // Only of files that are read with y up: their z, which many scans take for up, has come to lie along -y.
  if (as_read != "y" || IsTooMuch(file)) return "";
  const Surfaces s = MeasureSurfaces(file);
  if (s.box.empty() || s.shines || s.plain > 0.02 * s.all || !HasRooms(s)) return "";
  const Vec3f size = s.box.size();
  if (size.y < kLowest || size.y > kHighest || size.y > kFlat * size.x || size.y > kFlat * size.z) return "";
  return "looks as if it lay on its side: use up: z";
}

}  // namespace airsim360::internal

#include "airsim360/sim/traffic/vehicle_lamps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "airsim360/base/random.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

// cd on the axis of one lamp: UN Regulation 148 asks for 60 to 260 of a brake lamp (S1), 50 to 500 of a rear indicator (2a) and 175 to
// 1000 of a front one (1). How bright a glass is follows from its area.
constexpr float kBrakeCandela = 100, kRearIndicatorCandela = 100, kFrontIndicatorCandela = 250;
constexpr float kLeastArea = 0.005f;  // m^2 of one glass
// The regulation's red (x + y > 0.99, y < 0.335) is beyond the red of sRGB: no green and no blue, so that it stays red however long it
// is exposed. Amber is that of x = 0.60, y = 0.395.
constexpr Vec3f kRed{1, 0, 0}, kAmber{1, 0.12f, 0};
constexpr float kBrakeOut = 0.006f, kIndicatorOut = 0.009f;  // metres in front of the glasses
constexpr float kAwayScale = 1e-4f, kAwayHeight = -1000;     // of lamps where they are made
constexpr int64_t kBlinkNs = 666'666'667;

enum class Glass { kTail, kLeft, kRight };

// +Y of a mesh is backwards and +X its left (PlaceOf in traffic.cc).
bool IsOf(Glass glass, const Material& material, float x) {
  if (glass == Glass::kTail) return material.beam < 0;
  return glass == Glass::kLeft ? x > 0 : x < 0;
}

// Whether a triangle shows red glass of its texture: library models paint bodies and lamps into one picture.
bool ShowsRed(const Mesh& mesh, uint32_t triangle, const Material& material, const Scene& scene) {
  if (material.base_color_texture == kNoTexture || mesh.uvs.empty()) return true;
  const Vec3u t = mesh.triangles[triangle];
  const Vec2f uv = UvTransform(material) * ((mesh.uvs[t.x] + mesh.uvs[t.y] + mesh.uvs[t.z]) * (1.0f / 3));
  const Image<Rgba8>& picture = scene.textures[static_cast<size_t>(material.base_color_texture)].levels.front();
  const auto texel = [](float x, int size) { return std::min(size - 1, static_cast<int>((x - std::floor(x)) * static_cast<float>(size))); };
  const Rgba8 p = picture(texel(uv.x, picture.width()), texel(uv.y, picture.height()));
  return p.r > 50 && 2 * p.r > 3 * p.g && 2 * p.r > 3 * p.b;
}

// The material of a glass when it is lit: what it looks like otherwise stays.
Material Lit(const Material& glass, const char* name, bool red, float nits) {
  const Vec3f color = red ? kRed : kAmber;
  Material lit = glass;
  lit.name = name;
  lit.lamp = false;
  lit.beam = 0;
  if (!red && glass.beam < 0) lit.emission_texture = kNoTexture;
  lit.emission = color / Luminance(color) * (nits * kNit);
  return lit;
}

struct Piece {
  MaterialId material = 0;
  std::vector<uint32_t> triangles;
};

std::vector<Piece> PiecesOf(const Mesh& mesh, const Scene& scene, Glass glass) {
  std::vector<Piece> pieces;
  for (const MeshPart& part : mesh.parts) {
    const Material& material = scene.materials[part.material];
    if (!material.lamp || std::abs(material.beam) < 1) continue;  // windows of buses shine, too, but throw no beam
    Piece piece;
    piece.material = part.material;
    for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
      const Vec3u t = mesh.triangles[k];
      if (!IsOf(glass, material, mesh.positions[t.x].x + mesh.positions[t.y].x + mesh.positions[t.z].x)) continue;
      piece.triangles.push_back(k);
    }
    // An indicator is amber through red glass, but not through a painted body.
    if (glass != Glass::kTail && material.beam < 0)
      std::erase_if(piece.triangles, [&](uint32_t triangle) { return !ShowsRed(mesh, triangle, material, scene); });
    if (!piece.triangles.empty()) pieces.push_back(std::move(piece));
  }
  return pieces;
}

// What the glasses of one end of the vehicle show to somebody behind it, or before it, in squares of the mesh's unit.
float AreaSeen(const Mesh& mesh, const std::vector<Piece>& pieces, const Scene& scene, bool rear) {
  float area = 0;
  for (const Piece& piece : pieces) {
    if ((scene.materials[piece.material].beam < 0) != rear) continue;
    for (const uint32_t k : piece.triangles) {
      const Vec3u t = mesh.triangles[k];
      const Vec3f a = mesh.positions[t.x], n = Cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a) * 0.5f;
      area += std::max(0.0f, rear ? n.y : -n.y);
    }
  }
  return area;
}

std::optional<MeshId> AddGlass(MeshId vehicle, float scale, Glass glass, Scene& scene) {
  const Mesh& mesh = scene.meshes[vehicle];
  const std::vector<Piece> pieces = PiecesOf(mesh, scene, glass);
  if (pieces.empty()) return std::nullopt;
  const bool tail = glass == Glass::kTail;
  const char* name = tail ? "brake lamp" : "indicator";
  const float lamps = tail ? 2 : 1;  // that share the glasses
  const auto nits = [&](bool rear) {
    const float candela = tail ? kBrakeCandela : rear ? kRearIndicatorCandela : kFrontIndicatorCandela;
    return candela / std::max(AreaSeen(mesh, pieces, scene, rear) * scale * scale / lamps, kLeastArea);
  };
  const float nits_rear = nits(true), nits_front = nits(false);
  Mesh lit;
  lit.name = mesh.name + " " + name;
  for (const Piece& piece : pieces) {
    const Material& material = scene.materials[piece.material];
    const float out = (tail ? kBrakeOut : kIndicatorOut) * (material.beam < 0 ? 1.0f : -1.0f) / scale;
    lit.parts.push_back({static_cast<uint32_t>(lit.triangles.size()), static_cast<uint32_t>(piece.triangles.size()),
                         static_cast<MaterialId>(scene.materials.size()), kNoEntity});
    for (const uint32_t k : piece.triangles) {
      const auto first = static_cast<uint32_t>(lit.positions.size());
      const Vec3u t = mesh.triangles[k];
      for (const uint32_t corner : {t.x, t.y, t.z}) {
        lit.positions.push_back(mesh.positions[corner] + Vec3f{0, out, 0});
        if (!mesh.normals.empty()) lit.normals.push_back(mesh.normals[corner]);
        if (!mesh.uvs.empty()) lit.uvs.push_back(mesh.uvs[corner]);
        if (!mesh.colors.empty()) lit.colors.push_back(mesh.colors[corner]);
      }
      lit.triangles.push_back({first, first + 1, first + 2});
    }
    scene.materials.push_back(Lit(material, name, tail, material.beam < 0 ? nits_rear : nits_front));
  }
  scene.meshes.push_back(std::move(lit));
  return static_cast<MeshId>(scene.meshes.size() - 1);
}

uint32_t AddLamp(const std::optional<MeshId>& mesh, EntityId entity, Scene& scene) {
  if (!mesh) return kNoLamp;
  Instance lamp{.mesh = *mesh, .X_WM = {}, .entity = entity};
  lamp.X_WM.A = Mat3f::FromColumns({kAwayScale, 0, 0}, {0, kAwayScale, 0}, {0, 0, kAwayScale});
  lamp.X_WM.p = {0, 0, kAwayHeight};
  scene.instances.push_back(lamp);
  return static_cast<uint32_t>(scene.instances.size() - 1);
}

}  // namespace

LampMeshes AddLampMeshes(MeshId vehicle, float scale, Scene& scene) {
  return {AddGlass(vehicle, scale, Glass::kTail, scene), AddGlass(vehicle, scale, Glass::kLeft, scene),
          AddGlass(vehicle, scale, Glass::kRight, scene)};
}

VehicleLamps AddLamps(const LampMeshes& meshes, EntityId entity, Scene& scene) {
  return {AddLamp(meshes.brake, entity, scene), AddLamp(meshes.left, entity, scene), AddLamp(meshes.right, entity, scene)};
}

bool BlinksAt(size_t vehicle, int64_t t_ns) {
  const auto beat = static_cast<int64_t>(MixBits(vehicle) % static_cast<uint64_t>(kBlinkNs));
  return ((t_ns + beat) % kBlinkNs + kBlinkNs) % kBlinkNs < kBlinkNs / 2;
}

}  // namespace airsim360::internal

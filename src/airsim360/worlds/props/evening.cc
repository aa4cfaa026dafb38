#include "airsim360/worlds/props/evening.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/image/color.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

constexpr float kLowBeamCandela = 5000, kTailCandela = 6;
constexpr float kLowBeamSharpness = 30, kTailSharpness = 3;
constexpr float kInsideNits = 35;    // of the windows of a bus: 150 lx on seats and walls behind tinted glass
constexpr float kAllAround = 0.01f;  // a beam that is none: the panes of a vehicle shine alike, those of houses do not
constexpr Vec3f kTailRed{1, 0.02f, 0.01f};

// Uniform in [0, 1) by a cell of the ground.
float HashCell(Vec3f p, float cell, uint64_t salt) {
  const auto x = static_cast<int64_t>(std::floor(p.x / cell)), y = static_cast<int64_t>(std::floor(p.y / cell));
  const uint64_t bits = MixBits(MixBits(static_cast<uint64_t>(x) + (salt << 48)) ^ static_cast<uint64_t>(y));
  return static_cast<float>(bits >> 40) * 0x1p-24f;
}

constexpr float kOwn = 0.25f;  // metres: a cell for each prop

// Where a lamp sits on a vehicle.
enum class Lens { kNone, kHead, kTail };

bool HasAny(const std::string& name, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return name.find(word) != std::string::npos; });
}

// What a material could be a lens of, by its name or its look: library models paint their lamps into a texture or name the
// glass, ours are bright or red glass.
struct Looks {
  bool head, tail;
};
Looks LooksOf(const Material& m) {
  std::string name = m.name;
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (m.emission != Vec3f{}) return {};
  const bool glass = m.kind == SurfaceKind::kGlass && m.transmission == 0, textured = HasAny(name, {"textured"});
  const bool bright = glass && m.base_color_texture == kNoTexture && Luminance(m.base_color) > 0.2f;
  const bool red = m.base_color.x > 0.15f && m.base_color.y < 0.1f * m.base_color.x && glass;
  return {textured || bright || HasAny(name, {"headlight", "front-light", "focus", "faros_blanc", "grey-light"}),
          textured || red || HasAny(name, {"back-light", "rear-light", "brake", "redlight", "faros_rojo", "parking_light"})};
}

Lens LensAt(const Looks& looks, const Box3f& box, Vec3f a, Vec3f b, Vec3f c) {
  const Vec3f p = (a + b + c) / 3.0f, n = Normalized(Cross(b - a, c - a));
  const float along = (p.y - box.min.y) / box.size().y;
  const bool beside = std::fabs(p.x) > 0.4f * std::max(-box.min.x, box.max.x);
  if (!beside || p.z < 0.35f || p.z > 1.45f) return Lens::kNone;
  if (looks.head && along < 0.2f && n.y < -0.3f && p.z < 1.15f) return Lens::kHead;
  if (looks.tail && along > 0.88f && n.y > 0.3f) return Lens::kTail;
  return Lens::kNone;
}

// Mean luminance of what a lens shows of its texture; 1 without.
float MeanOf(const Material& m, const Model& model) {
  if (m.base_color_texture == kNoTexture) return 1;
  const Rgba8 p = model.textures[static_cast<size_t>(m.base_color_texture)].levels.back()(0, 0);
  return std::max(0.05f, Luminance({SrgbToLinear(p.r), SrgbToLinear(p.g), SrgbToLinear(p.b)}));
}

}  // namespace

Vec3f LampWhite(float kelvin) {
  const float mired = 1e6f / kelvin;
  const float r = 1.0f + 0.0045f * (mired - 154.0f), b = std::max(0.985f - 0.0040f * (mired - 154.0f), 0.01f);
  return {r, (1.0f - 0.2126f * r - 0.0722f * b) / 0.7152f, b};
}

Vec3f EveningGlow(std::string_view kind, std::string_view category, Vec3f p, Engine engine) {
  const float own = HashCell(p, kOwn, 1), other = HashCell(p, kOwn, 2);
  if (category.starts_with("vehicle/")) {
    const bool burns = engine == Engine::kOn ? own < 0.97f : own < 0.04f;
    if (burns && kind.ends_with("_1950s")) return LampWhite(2900.0f + 300.0f * other);  // sealed beams
    return burns ? LampWhite(other < 0.45f ? 3200.0f : 5500.0f) : Vec3f{};
  }
  constexpr float kNeighbourhood = 130, kFails = 0.02f;
  const float strength = own < kFails ? 0.0f : 0.85f + 0.3f * own;
  if (kind == "street_light") {
    const float pick = HashCell(p, kNeighbourhood, 3);
    return LampWhite(pick < 0.15f ? 2200.0f : pick < 0.6f ? 3000.0f : 4000.0f) * strength;
  }
  if (kind == "street_light_1950s") return LampWhite(2600) * strength;
  if (kind == "lamp_post" || kind == "crook_lamp") return LampWhite(HashCell(p, kNeighbourhood, 4) < 0.5f ? 3000.0f : 3500.0f) * strength;
  if (kind == "bollard_lamp") return LampWhite(3000) * strength;
  return {1, 1, 1};
}

void AddVehicleLamps(Model& model, bool lit_inside) {
  Mesh& mesh = model.mesh;
  const Box3f box = mesh.Bounds();
  if (!(box.size().y > 0)) return;
  if (mesh.parts.empty() && !model.materials.empty()) mesh.parts.push_back({0, static_cast<uint32_t>(mesh.triangles.size()), 0, kNoEntity});

  // Which triangles are lenses, and how large they look from straight ahead or behind.
  std::vector<Lens> lens(mesh.triangles.size(), Lens::kNone);
  std::array<float, 3> area{};
  for (const MeshPart& part : mesh.parts) {
    const Looks looks = LooksOf(model.materials[part.material]);
    if (!looks.head && !looks.tail) continue;
    for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
      const Vec3u t = mesh.triangles[k];
      const Vec3f a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
      lens[k] = LensAt(looks, box, a, b, c);
      area[static_cast<size_t>(lens[k])] += 0.5f * std::fabs(Cross(b - a, c - a).y);
    }
  }

  // Each part falls into its body and its lenses, which keep all but what they send out.
  std::vector<Vec3u> triangles;
  std::vector<MeshPart> parts;
  for (const MeshPart& part : mesh.parts) {
    for (const Lens side : {Lens::kNone, Lens::kHead, Lens::kTail}) {
      MeshPart piece = part;
      piece.first_triangle = static_cast<uint32_t>(triangles.size());
      for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k)
        if (lens[k] == side) triangles.push_back(mesh.triangles[k]);
      piece.triangle_count = static_cast<uint32_t>(triangles.size()) - piece.first_triangle;
      if (piece.triangle_count == 0) continue;
      if (side != Lens::kNone) {
        Material lit = model.materials[part.material];
        const bool head = side == Lens::kHead;
        const float nits =
            2 * (head ? kLowBeamCandela : kTailCandela) / std::max(area[static_cast<size_t>(side)], 0.01f) / MeanOf(lit, model);
        lit.emission = (head ? Vec3f{1, 1, 1} : kTailRed / Luminance(kTailRed)) * (nits * kNit);
        lit.emission_texture = lit.base_color_texture;
        lit.beam = head ? kLowBeamSharpness : -kTailSharpness;
        lit.lamp = true;
        piece.material = static_cast<MaterialId>(model.materials.size());
        model.materials.push_back(std::move(lit));
      }
      parts.push_back(piece);
    }
  }
  mesh.triangles = std::move(triangles);
  mesh.parts = std::move(parts);
  for (Material& m : model.materials) {
    if (!lit_inside || m.kind != SurfaceKind::kGlass || m.transmission > 0 || m.emission != Vec3f{}) continue;
    m.emission = Vec3f{1, 1, 1} * (kInsideNits * kNit);
    m.lamp = true;
    m.beam = kAllAround;
  }
}

}  // namespace airsim360::internal

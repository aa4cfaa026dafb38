#include <algorithm>
#include <cmath>

#include "airsim360/assets/gltf/gltf_extras.h"
#include "airsim360/assets/gltf/gltf_parts.h"
#include "airsim360/assets/labels/words.h"

namespace airsim360::internal {
namespace {

Vec3f ToColor(const std::vector<double>& c) {
  const auto channel = [](double v) { return static_cast<float>(std::clamp(v, 0.0, 1e6)); };
  return {channel(c[0]), channel(c[1]), channel(c[2])};
}

float Unit(double v) { return static_cast<float>(std::clamp(v, 0.0, 1.0)); }

// Metallic share that gives a specular colour, KhronosGroup's published conversion of specular-glossiness:
// solves for m in specular = 0.04 (1 - m) + base m, with perceived brightness of both colours.
float SolveMetallic(float diffuse, float specular, float one_minus_specular) {
  constexpr float kDielectric = 0.04f;
  if (specular < kDielectric) return 0;
  const float a = kDielectric;
  const float b = diffuse * one_minus_specular / (1 - kDielectric) + specular - 2 * kDielectric;
  const float c = kDielectric - specular;
  return std::clamp((-b + std::sqrt(std::max(b * b - 4 * a * c, 0.0f))) / (2 * a), 0.0f, 1.0f);
}

float Brightness(Vec3f c) { return std::sqrt(0.299f * c.x * c.x + 0.587f * c.y * c.y + 0.114f * c.z * c.z); }

// Kinds that glTF does not know, from the name.
void GuessKind(Material& m) {
  const std::vector<std::string> words = SplitWords(m.name);
  if (m.kind != SurfaceKind::kStandard || m.metallic > 0.5f) return;
  if (HasWord(words, {"leaf", "foliage", "needle", "hedge", "ivy", "bush"}) && !HasWord(words, {"trunk", "bark", "branch", "wood"})) {
    m.kind = SurfaceKind::kFoliage;
    m.transmission = 0.3f;
  } else if (HasWord(words, {"water", "lake", "ocean", "sea", "river", "pond"}) && m.base_color_texture == kNoTexture) {
    m.kind = SurfaceKind::kWater;
  }
}

// What `world export` wrote beyond glTF wins over guesses.
void ReadExtras(const JsonRef& json, GltfMaterial& out) {
  Material& m = out.material;
  const auto extras = json.Find("extras");
  if (!extras || !extras->IsObject()) return;
  if (const auto kind = extras->Find(kExtraKind)) {
    const std::string name = kind->Text();
    const auto* found = std::find(std::begin(kSurfaceKindNames), std::end(kSurfaceKindNames), name);
    if (found == std::end(kSurfaceKindNames)) kind->Fail("standard, foliage, glass or water expected");
    m.kind = static_cast<SurfaceKind>(found - std::begin(kSurfaceKindNames));
    m.transmission = Unit(extras->NumberOr(kExtraTransmission, 0));
    // Our own materials move texture coordinates themselves: the mesh keeps its.
    const auto single = [](double v) { return static_cast<float>(v); };
    m.uv_scale = {single(out.uv.scale[0]), single(out.uv.scale[1])};
    m.uv_offset = {single(out.uv.offset[0]), single(out.uv.offset[1])};
    m.uv_rotation = single(out.uv.rotation);
    out.uv = {.set = out.uv.set};
  }
  if (const auto ground = extras->Find(kExtraGround)) {
    const std::string name = ground->Text();
    const auto* found = std::find(std::begin(kGroundWearNames), std::end(kGroundWearNames), name);
    if (found == std::end(kGroundWearNames)) ground->Fail("an unknown kind of ground");
    m.ground = static_cast<GroundWear>(found - std::begin(kGroundWearNames));
  }
  m.blend_tiles = extras->BoolOr(kExtraBlendTiles, false);
  const std::vector<double> units = extras->NumbersOr(kExtraUnits, {0, 0});
  m.units = {static_cast<float>(std::clamp(units[0], 0.0, 1e4)), static_cast<float>(std::clamp(units[1], 0.0, 1e4))};
  const std::vector<double> gain = extras->NumbersOr(kExtraBaseGain, {1, 1, 1});
  for (int i = 0; i < 3; ++i) m.base_color[i] *= static_cast<float>(std::clamp(gain[static_cast<size_t>(i)], 0.0, 100.0));
  m.macro_variation = Unit(extras->NumberOr(kExtraMacroVariation, 0));
  m.interior = extras->BoolOr(kExtraInterior, false);
  m.lamp = extras->BoolOr(kExtraLamp, false);
  m.beam = static_cast<float>(std::clamp(extras->NumberOr(kExtraBeam, 0), -1e3, 1e3));
}

}  // namespace

void GltfMaterials::ReadMetallicRoughness(const JsonRef& json, GltfMaterial& out) {
  Material& m = out.material;
  m.base_color = {1, 1, 1};
  m.metallic = 1;
  m.roughness = 1;
  const auto pbr = json.Find("pbrMetallicRoughness");
  if (!pbr) return;
  const std::vector<double> base = pbr->NumbersOr("baseColorFactor", {1, 1, 1, 1});
  m.base_color = ToColor(base);
  m.base_alpha = Unit(base[3]);
  m.metallic = Unit(pbr->NumberOr("metallicFactor", 1));
  m.roughness = Unit(pbr->NumberOr("roughnessFactor", 1));
  if (const auto info = pbr->Find("metallicRoughnessTexture")) m.metallic_roughness_texture = ReadTexture(*info, false, &out.uv);
  if (const auto info = pbr->Find("baseColorTexture")) m.base_color_texture = ReadTexture(*info, true, &out.uv);
}

void GltfMaterials::ReadSpecularGlossiness(const JsonRef& json, GltfMaterial& out) {
  Material& m = out.material;
  const std::vector<double> diffuse = json.NumbersOr("diffuseFactor", {1, 1, 1, 1});
  const Vec3f specular = ToColor(json.NumbersOr("specularFactor", {1, 1, 1}));
  m.base_alpha = Unit(diffuse[3]);
  m.metallic_roughness_texture = kNoTexture;
  if (const auto info = json.Find("diffuseTexture")) m.base_color_texture = ReadTexture(*info, true, &out.uv);
  m.roughness = 1 - Unit(json.NumberOr("glossinessFactor", 1));

  // With pictures the factors do not say what the surface is: keep the diffuse colour.
  const float strongest = std::max({specular.x, specular.y, specular.z});
  const bool pictures = m.base_color_texture != kNoTexture || json.Has("specularGlossinessTexture");
  m.metallic = pictures ? 0 : SolveMetallic(Brightness(ToColor(diffuse)), Brightness(specular), 1 - std::min(strongest, 1.0f));
  const Vec3f from_diffuse = ToColor(diffuse) * ((1 - std::min(strongest, 1.0f)) / 0.96f / std::max(1 - m.metallic, 1e-4f));
  const Vec3f from_specular = specular * (1 / std::max(m.metallic, 1e-4f));
  const float share = m.metallic * m.metallic;
  m.base_color = pictures ? ToColor(diffuse) : Min(from_diffuse * (1 - share) + from_specular * share, Vec3f{1, 1, 1});
  if (json.Has("specularGlossinessTexture")) m.roughness = std::max(m.roughness, 0.6f);
}

void MakePane(Material& m, double alpha) {
  m.kind = SurfaceKind::kGlass;
  m.transmission = static_cast<float>(1 - alpha);
  m.base_color *= static_cast<float>(0.15 + 0.85 * alpha * alpha);
}

void GltfMaterials::ReadAlpha(const JsonRef& json, GltfMaterial& out) {
  Material& m = out.material;
  const std::string mode = json.TextOr("alphaMode", "OPAQUE");
  if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND") json.At("alphaMode").Fail("OPAQUE, MASK or BLEND expected");
  m.alpha_cutoff = static_cast<float>(std::clamp(json.NumberOr("alphaCutoff", 0.5), 0.0, 1e3));
  if (mode == "MASK") m.alpha_mode = AlphaMode::kMask;
  if (mode != "BLEND") return;

  // Blending: a see-through surface is a pane, pictures with holes are cut out at one half.
  m.alpha_cutoff = 0.5f;
  const bool holes = textures_.HasHoles(m.base_color_texture);
  const double alpha = m.base_alpha;
  if (alpha < kOpaqueFrom && !(holes && alpha >= 0.5)) {
    MakePane(m, alpha);
  } else if (holes) {
    m.alpha_mode = AlphaMode::kMask;
  } else {
    out.blends = true;
  }
}

GltfMaterial GltfMaterials::Read(const JsonRef& json) {
  GltfMaterial out;
  Material& m = out.material;
  m.name = CleanName(json.TextOr("name", ""));
  ReadMetallicRoughness(json, out);
  if (const auto glossy = GltfExtension(json, "KHR_materials_pbrSpecularGlossiness")) ReadSpecularGlossiness(*glossy, out);
  UvUse* const uv_if_first = m.base_color_texture == kNoTexture && m.metallic_roughness_texture == kNoTexture ? &out.uv : nullptr;
  if (const auto normal = json.Find("normalTexture")) {
    m.normal_texture = ReadTexture(*normal, false, uv_if_first);
    m.normal_scale = static_cast<float>(std::clamp(normal->NumberOr("scale", 1), -10.0, 10.0));
  }

  // Emission; the strength extension goes beyond 1.
  m.emission = ToColor(json.NumbersOr("emissiveFactor", {0, 0, 0}));
  if (const auto strength = GltfExtension(json, "KHR_materials_emissive_strength")) {
    m.emission *= static_cast<float>(std::clamp(strength->NumberOr("emissiveStrength", 1), 0.0, 1e6));
  }
  if (const auto emissive = json.Find("emissiveTexture"))
    m.emission_texture = ReadTexture(*emissive, true, m.normal_texture == kNoTexture ? uv_if_first : nullptr);

  ReadAlpha(json, out);
  if (const auto transmission = GltfExtension(json, "KHR_materials_transmission")) {
    const float share = Unit(transmission->NumberOr("transmissionFactor", 0));
    if (share > 0.3f) {
      m.kind = SurfaceKind::kGlass;
      m.transmission = share;
    }
  }
  if (const auto coat = GltfExtension(json, "KHR_materials_clearcoat")) {
    m.clear_coat = Unit(coat->NumberOr("clearcoatFactor", 0));
    m.clear_coat_roughness = Unit(coat->NumberOr("clearcoatRoughnessFactor", 0));
  }
  if (GltfExtension(json, "KHR_materials_unlit")) {
    m.metallic = 0;
    m.roughness = 1;
    out.unlit = true;
  }
  static_cast<void>(json.BoolOr("doubleSided", false));  // every surface is seen from both sides here; still must be a bool
  GuessKind(m);
  ReadExtras(json, out);
  return out;
}

}  // namespace airsim360::internal

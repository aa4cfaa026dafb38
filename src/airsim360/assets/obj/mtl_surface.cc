// Which physical surface a Phong material of an MTL file most likely is.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "airsim360/assets/labels/words.h"
#include "airsim360/assets/obj/mtl.h"

namespace airsim360::internal {
namespace {

float MaxOf(Vec3f c) { return std::max({c.x, c.y, c.z}); }

bool IsLeaf(const MtlMaterial& m, const MtlContext& context, const std::vector<std::string>& words,
            const std::vector<std::string>& texture_words) {
  const auto any = [&](std::initializer_list<std::string_view> w) { return HasWord(words, w) || HasWord(texture_words, w); };
  if (HasWord(words, {"trunk", "bark",    "branch", "stem", "tronc", "wood",  "pot",     "vase",  "soil",  "terra", "ground",
                      "stone", "granite", "gravel", "box",  "rock",  "metal", "plastic", "table", "floor", "dirt",  "sand"})) {
    return false;
  }
  if (any({"leaf", "foliage", "hedge", "needle", "grass", "feuille", "feuillage", "ivy", "frond", "hoja", "blatt", "palme"})) {
    return true;
  }
  // In a plant, whatever is greener than grey is a leaf, and so are petals and pictures.
  const bool green = m.diffuse.y > 1.15f * m.diffuse.x && m.diffuse.y > 1.15f * m.diffuse.z;
  return context.plant && (green || !m.map_diffuse.empty() || HasWord(words, {"flower", "petal", "blume", "blossom"}));
}

// Metals by name, with their colour if the file leaves them dark; also mirrors and highlights without a body
// colour.
bool MakeMetal(const MtlMaterial& m, const std::vector<std::string>& words, Material& out) {
  const bool mirror = HasWord(words, {"mirror", "espejo"});
  const bool polished = HasWord(words, {"chrome", "chromed", "crome", "inox", "polis"});
  const bool named = HasWord(words, {"metal", "metall", "metalic", "metallic", "steel", "stainless", "aluminum", "aluminium", "alu", "iron",
                                     "brass", "gold", "silver", "copper", "bronze", "zinc", "tin"});
  const bool bare = MaxOf(m.specular) >= 0.9f && MaxOf(m.diffuse) <= 0.25f && m.shininess >= 50 && m.map_diffuse.empty();
  if (!mirror && !polished && !named && !bare) return false;
  if (HasWord(words, {"paint", "painted"}) || !m.map_diffuse.empty()) return false;

  // Dark "metal" is lacquered: half metallic keeps its colour.
  const bool dark = MaxOf(m.diffuse) < 0.12f && !bare;
  out.metallic = mirror || polished || bare ? 1.0f : dark ? 0.3f : 0.9f;
  if (bare || polished) out.base_color = Max(m.diffuse, m.specular * 0.7f);
  if (mirror) out.base_color = {0.9f, 0.9f, 0.9f};
  out.roughness = mirror ? 0.03f : std::clamp(out.roughness, polished ? 0.08f : 0.2f, polished ? 0.3f : 0.55f);
  return true;
}

bool IsCarPaint(const MtlMaterial& m, const MtlContext& context, const std::vector<std::string>& words) {
  if (HasWord(words, {"carpaint", "carrosserie", "bodywork"}) || (HasWord(words, {"car"}) && HasWord(words, {"paint"}))) return true;
  const bool glossy = MaxOf(m.specular) >= 0.15f && m.shininess >= 35;
  return context.vehicle && glossy &&
         !HasWord(words,
                  {"rubber", "tire", "tyre", "wheel", "plastic", "interior", "seat", "leather", "fabric", "black", "matte", "light"});
}

// Stand-in for a picture that is missing, from the words of its name; nullopt if they say nothing.
std::optional<Vec3f> ColorFromWords(const std::vector<std::string>& words) {
  static const std::pair<std::string_view, Vec3f> kColors[] = {
      {"rooftile", {0.36f, 0.15f, 0.10f}}, {"tile", {0.36f, 0.15f, 0.10f}},   {"brick", {0.40f, 0.18f, 0.12f}},
      {"wood", {0.30f, 0.19f, 0.11f}},     {"plank", {0.30f, 0.19f, 0.11f}},  {"bark", {0.22f, 0.16f, 0.11f}},
      {"grass", {0.13f, 0.24f, 0.06f}},    {"leaf", {0.12f, 0.26f, 0.05f}},   {"stone", {0.42f, 0.40f, 0.36f}},
      {"rock", {0.42f, 0.40f, 0.36f}},     {"concrete", {0.5f, 0.5f, 0.48f}}, {"asphalt", {0.09f, 0.09f, 0.09f}},
      {"black", {0.03f, 0.03f, 0.03f}},    {"white", {0.8f, 0.8f, 0.8f}},     {"red", {0.5f, 0.05f, 0.04f}},
      {"green", {0.1f, 0.35f, 0.08f}},     {"blue", {0.06f, 0.14f, 0.45f}},   {"yellow", {0.7f, 0.52f, 0.08f}}};
  for (const auto& [word, color] : kColors) {
    if (HasWord(words, {word})) return color;
  }
  return std::nullopt;
}

}  // namespace

Material ToMaterial(const MtlMaterial& m, const MtlContext& context, TextureStore& textures, const ResourceLoader& load) {
  Material out;
  out.name = m.name;
  out.base_color = m.diffuse;
  out.emission = m.emission;

  // Beckmann-like width of a Blinn-Phong lobe, alpha = sqrt(2 / (Ns + 2)) (Walter 2007), roughness =
  // sqrt(alpha); without a highlight the surface is matte.
  const float lobe = std::pow(2 / (m.shininess + 2), 0.25f);
  const float strength = std::clamp(MaxOf(m.specular) / 0.08f, 0.0f, 1.0f);
  out.roughness = m.roughness >= 0 ? m.roughness : std::clamp(0.95f + (lobe - 0.95f) * strength, 0.05f, 1.0f);
  if (m.metallic >= 0) out.metallic = m.metallic;

  // Pictures: colour (with opacity), emission, normals.
  if (!m.map_diffuse.empty()) {
    out.base_color_texture = textures.Get(m.map_diffuse, {.alpha_file = m.map_opacity}, load);
    if (textures.HasHoles(out.base_color_texture)) out.alpha_mode = AlphaMode::kMask;
    // A picture replaces Kd, as in the modellers that write these files: pictures are not made to be
    // darkened.
    if (out.base_color_texture != kNoTexture) {
      out.base_color = {1, 1, 1};
    } else if (m.diffuse.x == m.diffuse.y && m.diffuse.y == m.diffuse.z) {
      out.base_color = ColorFromWords(SplitWords(m.map_diffuse)).value_or(m.diffuse);
    }
  }
  if (!m.map_emission.empty()) out.emission_texture = textures.Get(m.map_emission, {}, load);
  if (!m.map_normal.empty()) {
    out.normal_texture = textures.Get(m.map_normal, {.srgb = false, .alpha_file = {}}, load);
    out.normal_scale = m.bump_scale;
  }

  // The surface kind: glass first, since everything else is opaque.
  const std::vector<std::string> words = SplitWords(m.name);
  if (m.opacity < 0.95f && m.map_opacity.empty() && out.alpha_mode == AlphaMode::kOpaque) {
    // Seen from outside a pane is dark: what it lets through comes back little from behind.
    out.kind = HasWord(words, {"water"}) ? SurfaceKind::kWater : SurfaceKind::kGlass;
    out.base_color = m.diffuse * (0.08f + 0.7f * m.opacity * m.opacity);
    out.base_alpha = m.opacity;
    out.transmission = 1 - m.opacity;
    out.roughness = HasWord(words, {"frosted"}) ? 0.4f : 0.04f;
  } else if (HasWord(words, {"glas", "glass"}) && HasWord(words, {"dark", "window", "windshield"})) {
    out.kind = SurfaceKind::kGlass;
    out.roughness = 0.04f;
  } else if (IsLeaf(m, context, words, SplitWords(m.map_diffuse))) {
    out.kind = SurfaceKind::kFoliage;
    out.transmission = 0.3f;
    out.roughness = std::max(out.roughness, 0.5f);
  } else if (m.metallic < 0 && !MakeMetal(m, words, out) && IsCarPaint(m, context, words)) {
    out.roughness = 0.5f;  // of the colour under the lacquer
    out.clear_coat = 1;
    out.clear_coat_roughness = 0.04f;
  }
  return out;
}

}  // namespace airsim360::internal

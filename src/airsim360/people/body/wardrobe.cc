#include "airsim360/people/body/wardrobe.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "airsim360/base/random.h"

namespace airsim360::internal {
namespace {

// Colours as sRGB hex, the way clothes are chosen.
constexpr uint32_t kSkins[] = {0xe8b998, 0xd9a074, 0xf0c8ac, 0xb57b50, 0x8d5a3a, 0x5b3826, 0xcf9873, 0xe2ac86};
constexpr uint32_t kHairs[] = {0x1b1512, 0x2e2018, 0x4a3222, 0x6b4a2c, 0x8d6a3c, 0xb58d55, 0x5a2c18};
constexpr uint32_t kTops[] = {0x29415f, 0x8f2d2b, 0xe4e2dc, 0x34383d, 0x4b6a4a, 0xb9a77c, 0x6d7f96, 0xc9873a,
                              0x5c3b5e, 0xd8c9b0, 0x1d2024, 0x6fa3b8, 0xa9474f, 0x8a8f92, 0x2f5a57, 0xdcb93f};
constexpr uint32_t kTrousers[] = {0x25282d, 0x4a4136, 0x7b7360, 0x3c4a5c, 0x5b5e60, 0x8c8069, 0x33302c};
constexpr uint32_t kJeans[] = {0x2c4466, 0x47658c, 0x1e2d45, 0x6d87a3};
constexpr uint32_t kSkirts[] = {0x272a30, 0x7a2f3a, 0x3d4d6b, 0x8b7a5e, 0x4d6150, 0xa04c5a};
constexpr uint32_t kJackets[] = {0x26292e, 0x3a4150, 0x5a4a38, 0x6f6a5e, 0x2f3b33, 0x1f2a3d, 0x7a6242};
constexpr uint32_t kShoes[] = {0x1c1a19, 0x4a3324, 0xd9d7d2, 0x33373c, 0x7a2622, 0x2b3d5a};

float Linear(int byte) {
  const float c = static_cast<float>(byte) / 255;
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}
uint8_t Encode(float c) {
  c = std::clamp(c, 0.0f, 1.0f);
  return static_cast<uint8_t>(std::lround(255 * (c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f)));
}
Vec3f FromHex(uint32_t hex) { return {Linear(hex >> 16 & 255), Linear(hex >> 8 & 255), Linear(hex & 255)}; }
template <size_t N>
Vec3f Pick(const uint32_t (&list)[N], RngStream& rng) {
  const Vec3f color = FromHex(list[rng.Index(N)]);
  return color * static_cast<float>(rng.Uniform(0.85, 1.15));
}

// Value noise of a cell, in [-1, 1].
float Grain(uint64_t seed, int x, int y) {
  const uint64_t bits = MixBits(seed + static_cast<uint64_t>(x) * 0x1f123bb5u + (static_cast<uint64_t>(y) << 32));
  return static_cast<float>(bits >> 40) * 0x1p-23f - 1;
}

using Painter = std::function<Vec3f(float u, float v, int x, int y)>;

std::shared_ptr<const Texture> Paint(std::string name, int size, const Painter& color) {
  Image<Rgba8> image(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec3f c =
          color((static_cast<float>(x) + 0.5f) / static_cast<float>(size), (static_cast<float>(y) + 0.5f) / static_cast<float>(size), x, y);
      image(x, y) = {Encode(c.x), Encode(c.y), Encode(c.z), 255};
    }
  }
  return std::make_shared<Texture>(Texture::FromImage(std::move(name), std::move(image), true));
}

Vec3f Blend(Vec3f a, Vec3f b, float t) { return a + (b - a) * std::clamp(t, 0.0f, 1.0f); }

// Inside an ellipse: 1, with an edge of about `soft` of its radius.
float Spot(float x, float y, float cx, float cy, float rx, float ry, float soft = 0.25f) {
  const float d = std::hypot((x - cx) / rx, (y - cy) / ry);
  return std::clamp((1 - d) / soft + 0.5f, 0.0f, 1.0f);
}

// The face on the head's loft: u around (0.5 in front), v = 0 at the chin, 1 on top.
std::shared_ptr<const Texture> PaintFace(const Wardrobe& w, const BodySpec& spec) {
  const uint64_t seed = MixBits(spec.look ^ 0xface);
  const Vec3f lips = Blend(w.skin * 0.75f, {0.32f, 0.07f, 0.06f}, spec.sex == Sex::kFemale ? 0.55f : 0.25f);
  const Vec3f iris = seed % 3 == 0 ? Vec3f{0.06f, 0.10f, 0.16f} : Vec3f{0.05f, 0.025f, 0.012f};
  const bool stubble = spec.sex == Sex::kMale && spec.age > 17;
  return Paint("face", 128, [&, lips, iris, stubble](float u, float v, int x, int y) {
    const float a = std::abs(u - 0.5f);  // both halves are alike
    Vec3f c = w.skin * (1 + 0.03f * Grain(seed, x / 2, y / 2));
    c = Blend(c, c * Vec3f{1.12f, 0.80f, 0.76f}, 0.55f * Spot(a, v, 0.085f, 0.33f, 0.05f, 0.09f, 1));
    if (stubble) {
      const float jaw = Spot(a, v, 0.0f, 0.06f, 0.20f, 0.26f, 0.5f) * (1 - Spot(a, v, 0, 0.52f, 0.2f, 0.2f, 0.5f));
      c = Blend(c, w.beard ? w.hair_color : w.skin * 0.62f, jaw * (w.beard ? 0.9f : 0.25f));
    }
    c = Blend(c, w.skin * 0.62f, 0.5f * Spot(a, v, 0.074f, 0.505f, 0.046f, 0.055f, 0.8f));
    c = Blend(c, {0.75f, 0.74f, 0.72f}, Spot(a, v, 0.074f, 0.497f, 0.026f, 0.018f, 0.4f));
    c = Blend(c, iris, Spot(a, v, 0.073f, 0.498f, 0.0105f, 0.019f, 0.4f));
    c = Blend(c, {0.02f, 0.015f, 0.012f}, 0.8f * Spot(a, v, 0.074f, 0.516f, 0.029f, 0.006f, 0.8f));
    c = Blend(c, w.hair_color * 0.8f, 0.85f * Spot(a, v, 0.074f, 0.566f + 0.10f * (0.074f - a), 0.036f, 0.011f, 0.6f));
    c = Blend(c, w.skin * 0.55f, 0.6f * Spot(a, v, 0.016f, 0.318f, 0.011f, 0.012f, 0.8f));
    c = Blend(c, lips, 0.9f * Spot(a, v, 0, 0.203f, 0.052f, 0.026f, 0.5f));
    c = Blend(c, lips * 0.3f, 0.8f * Spot(a, v, 0, 0.206f, 0.046f, 0.005f, 0.8f));
    return c;
  });
}

std::shared_ptr<const Texture> PaintTop(const Wardrobe& w, uint64_t seed) {
  return Paint("top", 64, [&, seed](float u, float v, int x, int y) {
    Vec3f c = w.top_color;
    const auto wave = [](float t, float n) { return std::fmod(t * n, 1.0f) < 0.5f; };
    if (w.pattern == 1 && wave(v, 4)) c = w.second_color;
    if (w.pattern == 2) c = Blend(c, w.second_color, 0.4f * wave(u, 4) + 0.4f * wave(v, 4));
    if (w.pattern == 3 && std::fmod(u * 8, 1.0f) < 0.25f) c = w.second_color;
    if (w.pattern == 4 && v > 0.5f) c = w.second_color;
    return c * (1 + 0.06f * Grain(seed, x, y) + 0.04f * Grain(seed, x / 4, y / 4));
  });
}

std::shared_ptr<const Texture> PaintBottom(const Wardrobe& w, uint64_t seed) {
  const float grain = w.bottom == Bottom::kJeans ? 0.16f : 0.05f;
  return Paint("bottom", 64, [&, seed, grain](float u, float, int x, int y) {
    Vec3f c = w.bottom_color * (1 + grain * Grain(seed, x, y) + 0.5f * grain * Grain(seed, x / 8, y / 8));
    // Jeans are worn in front.
    if (w.bottom == Bottom::kJeans) c = c * (0.9f + 0.35f * Spot(u, 0, 0.5f, 0, 0.25f, 1, 1));
    return c;
  });
}

constexpr std::string_view kTopNames[] = {"t-shirt", "shirt", "pullover", "jacket", "vest"};
constexpr std::string_view kBottomNames[] = {"trousers", "jeans", "shorts", "skirt", "dress"};

}  // namespace

Wardrobe DrawWardrobe(const BodySpec& spec) {
  RngStream rng(spec.look, "wardrobe");
  Wardrobe w;
  const bool female = spec.sex == Sex::kFemale, child = spec.age<16, old = spec.age> 58;
  w.skin = FromHex(kSkins[rng.Index(std::size(kSkins))]);
  w.hair_color = Pick(kHairs, rng);
  if (rng.Chance(std::clamp((spec.age - 40) / 35, 0.0, 1.0))) w.hair_color = Vec3f{0.42f, 0.41f, 0.40f};

  // Cut.
  const double t = rng.Uniform();
  w.top = child      ? (t < 0.6 ? Top::kTShirt : Top::kPullover)
          : t < 0.30 ? Top::kTShirt
          : t < 0.55 ? Top::kShirt
          : t < 0.75 ? Top::kPullover
          : t < 0.95 ? Top::kJacket
                     : Top::kVest;
  const double b = rng.Uniform();
  if (female)
    w.bottom = b < 0.22   ? Bottom::kTrousers
               : b < 0.55 ? Bottom::kJeans
               : b < 0.65 ? Bottom::kShorts
               : b < 0.85 ? Bottom::kSkirt
                          : Bottom::kDress;
  else
    w.bottom = b < 0.40 ? Bottom::kTrousers : b < 0.80 || old ? Bottom::kJeans : Bottom::kShorts;
  if (child && rng.Chance(0.3)) w.bottom = Bottom::kShorts;
  w.coat = w.top == Top::kJacket && rng.Chance(0.3);
  const double h = rng.Uniform();
  if (female)
    w.hair = h < 0.42 ? Hair::kLong : h < 0.72 ? Hair::kBob : h < 0.9 ? Hair::kBun : Hair::kShort;
  else
    w.hair = h < 0.55                      ? Hair::kShort
             : h < 0.82                    ? Hair::kCropped
             : h < 0.92                    ? Hair::kCap
             : old || (h > 0.96 && !child) ? Hair::kBald
                                           : Hair::kShort;
  w.beard = !female && !child && rng.Chance(0.22);

  // Colours.
  w.top_color = w.top == Top::kJacket ? Pick(kJackets, rng) : Pick(kTops, rng);
  w.second_color = Pick(kTops, rng);
  w.pattern = w.top == Top::kJacket ? 0 : static_cast<int>(rng.Index(8));
  if (w.pattern > 4) w.pattern = 0;
  w.bottom_color = w.bottom == Bottom::kJeans ? Pick(kJeans, rng) : w.bottom == Bottom::kSkirt ? Pick(kSkirts, rng) : Pick(kTrousers, rng);
  if (w.bottom == Bottom::kDress) {
    w.top = Top::kTShirt;
    w.bottom_color = w.top_color;
  }
  w.shoe_color = Pick(kShoes, rng);
  w.name = std::string(kTopNames[static_cast<size_t>(w.top)]) + ", " + std::string(kBottomNames[static_cast<size_t>(w.bottom)]);
  if (w.bottom == Bottom::kDress) w.name = "dress";
  if (w.coat) w.name = w.bottom == Bottom::kDress ? "coat, dress" : "coat" + w.name.substr(std::string("jacket").size());
  return w;
}

void PaintBody(const Wardrobe& w, const BodySpec& spec, Body& body) {
  body.textures = {PaintFace(w, spec), PaintTop(w, spec.look), PaintBottom(w, spec.look + 1)};
  body.materials.resize(kBodyMaterialCount);
  const auto set = [&](BodyMaterial index, std::string name, Vec3f color, float roughness, TextureId texture = kNoTexture) {
    Material& m = body.materials[index];
    m.name = "person " + name;
    m.base_color = color;
    m.roughness = roughness;
    m.base_color_texture = texture;
  };
  RngStream rng(spec.look, "props");
  set(kFaceMaterial, "face", {1, 1, 1}, 0.55f, 0);
  set(kSkinMaterial, "skin", w.skin, 0.55f);
  set(kHairMaterial, "hair", w.hair == Hair::kCap ? w.second_color : w.hair_color, 0.6f);
  set(kTopMaterial, "top", {1, 1, 1}, 0.9f, 1);
  set(kBottomMaterial, "bottom", {1, 1, 1}, 0.9f, w.bottom == Bottom::kDress ? 1 : 2);
  set(kShoeMaterial, "shoe", w.shoe_color, 0.5f);
  set(kSoleMaterial, "sole", w.shoe_color * 0.3f + Vec3f{0.02f, 0.02f, 0.02f}, 0.8f);
  set(kPropDark, "prop dark", {0.015f, 0.016f, 0.018f}, 0.35f);
  set(kPropLight, "prop metal", {0.45f, 0.46f, 0.48f}, 0.4f);
  set(kPropColor, "prop colour", Pick(kTops, rng), 0.7f);
}

}  // namespace airsim360::internal

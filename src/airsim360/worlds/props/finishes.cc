#include "airsim360/worlds/props/finishes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

// Height of bark in [0, 1]: plates between dark furrows that run along v and wander.
float BarkHeight(float u, float v) {
  const float wander = 0.10f * (TileFractal(u, v, 3, 4, 3, 11) - 0.5f);
  const float ridges = std::abs(2 * TileFractal(u + wander, v, 14, 3, 2, 12) - 1);
  const float cracks = std::abs(2 * TileFractal(u, v + wander, 7, 16, 2, 13) - 1);
  const float plate = std::min(1.0f, 2.8f * ridges) * std::min(1.0f, 0.45f + 3.0f * cracks);
  return plate * (0.75f + 0.25f * TileFractal(u, v, 32, 48, 2, 14));
}

}  // namespace

Material MakeFinish(const char* name, Vec3f color, float roughness, float metallic) {
  Material m;
  m.name = name;
  m.base_color = color;
  m.roughness = roughness;
  m.metallic = metallic;
  return m;
}

Material Paint(Vec3f color, float roughness) { return MakeFinish("paint", color, roughness); }
Material CarPaint(Vec3f color, float metallic) {
  // Flakes lie a few degrees off flat: a broad, soft highlight of the paint's own colour under the sharp one of the
  // lacquer. They are far too small to be seen one by one.
  Material m = MakeFinish("car paint", color, metallic > 0 ? 0.42f : 0.55f, metallic);
  m.clear_coat = 1;
  m.clear_coat_roughness = 0.04f;
  return m;
}

Material Chrome() { return MakeFinish("chrome", {0.56f, 0.565f, 0.57f}, 0.06f, 1); }

Material Metal(Vec3f color, float roughness) { return MakeFinish("metal", color, roughness, 1); }
Material CastIron() { return MakeFinish("cast iron", {0.045f, 0.046f, 0.048f}, 0.5f, 0.4f); }
Material Plastic(Vec3f color, float roughness) { return MakeFinish("plastic", color, roughness); }
Material Rubber() { return MakeFinish("rubber", {0.025f, 0.025f, 0.026f}, 0.85f); }
Material Stone(Vec3f color, float roughness) { return MakeFinish("stone", color, roughness); }

Material Fabric(Vec3f color) {
  Material m = MakeFinish("fabric", color, 0.9f);
  m.kind = SurfaceKind::kFoliage;
  m.transmission = 0.25f;
  return m;
}

Material Glass(Vec3f color) {
  Material m = MakeFinish("glass", color, 0.05f);
  m.kind = SurfaceKind::kGlass;
  return m;
}

Material Glow(Vec3f color, float nits, Burns burns) {
  Material m = MakeFinish(burns == Burns::kAtNight ? "lamp" : "signal lamp", color, 0.3f);
  m.emission = color * (nits * kNit);
  m.lamp = burns == Burns::kAtNight;
  return m;
}

Material WhiteGlow(Vec3f color, float nits) {
  Material m = Glow(color, nits);
  m.emission = Vec3f{1, 1, 1} * (nits * kNit);
  return m;
}

Material Leaf(Vec3f color, float transmission) {
  Material m = MakeFinish("leaf", color, 0.52f);
  m.kind = SurfaceKind::kFoliage;
  m.transmission = transmission;
  return m;
}

void UseWood(PropBuilder& b, Vec3f tint, Grain grain) {
  Material m = MakeFinish(grain == Grain::kAlongX ? "timber along x" : "timber", tint, 0.6f);
  // The texture has its grain along v: a quarter turn takes it to u.
  if (grain == Grain::kAlongX) m.uv_rotation = std::numbers::pi_v<float> / 2;
  b.Use(m, WoodTexture(), grain == Grain::kAlongX ? Vec2f{1, 0.25f} : Vec2f{0.25f, 1});
}

const Texture& WoodTexture() {
  static const Texture texture = Texture::FromImage("wood",
                                                    Shade(128, 512,
                                                          [](float u, float v) {
                                                            const float bend = 0.06f * TileFractal(u, v, 2, 2, 2, 21);
                                                            const float rings = TileFractal(u + bend, v, 10, 1, 3, 22),
                                                                        fibre = TileFractal(u, v, 48, 4, 2, 23);
                                                            const float tone = 0.62f + 0.55f * rings + 0.22f * (fibre - 0.5f);
                                                            return Vec3f{0.30f, 0.175f, 0.088f} * tone;
                                                          }),
                                                    true);
  return texture;
}

const Texture& ConcreteTexture() {
  static const Texture texture = Texture::FromImage("concrete",
                                                    Shade(256, 256,
                                                          [](float u, float v) {
                                                            const float tone = 0.70f + 0.25f * TileFractal(u, v, 3, 3, 4, 31) +
                                                                               0.10f * TileNoise(u * 128, v * 128, 128, 128, 32);
                                                            return Vec3f{1.0f, 0.985f, 0.96f} * std::min(1.0f, tone);
                                                          }),
                                                    true);
  return texture;
}

const Texture& BarkTexture() {
  static const Texture texture =
      Texture::FromImage("bark",
                         Shade(256, 512,
                               [](float u, float v) {
                                 const float h = BarkHeight(u, v), patch = TileFractal(u, v, 2, 3, 3, 15);
                                 return (Vec3f{0.16f, 0.135f, 0.115f} * (1 - h) + Vec3f{1.0f, 0.97f, 0.92f} * h) * (0.75f + 0.4f * patch);
                               }),
                         true);
  return texture;
}

const Texture& BarkNormals() {
  static const Texture texture =
      NormalsFromHeight("bark normals", 256, 512, 0.5f, [](float u, float v) { return 0.020f * BarkHeight(u, v); });
  return texture;
}

const Texture& ScratchedTexture() {
  static const Texture texture =
      Texture::FromImage("scratched",
                         Shade(256, 256,
                               [](float u, float v) {
                                 const float stains = TileFractal(u, v, 4, 3, 4, 41), streaks = TileFractal(u, v, 32, 2, 2, 42);
                                 return Vec3f{1, 1, 1} * std::min(1.0f, 0.72f + 0.26f * stains + 0.12f * streaks);
                               }),
                         true);
  return texture;
}

}  // namespace airsim360::internal

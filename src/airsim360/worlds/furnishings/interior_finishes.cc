#include "airsim360/worlds/furnishings/interior_finishes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/evening.h"
#include "airsim360/worlds/texture/texture_field.h"

namespace airsim360::internal {
namespace {

Vec3f Blend(Vec3f a, Vec3f b, float t) { return a + (b - a) * std::clamp(t, 0.0f, 1.0f); }

// Colours of wood between early and late growth, its share of figure, and how much its pores show. Albedos from
// reflectance spectra of planed boards: oak about 0.30, beech 0.40, walnut 0.13, pine 0.42, wenge 0.05.
struct WoodLook {
  const char* name;
  Vec3f early, late;
  float rings, pores;
  uint64_t seed;
};
constexpr std::array<WoodLook, 5> kWoods = {{
    {"oak", {0.43f, 0.285f, 0.155f}, {0.29f, 0.175f, 0.085f}, 9, 0.30f, 501},
    {"beech", {0.52f, 0.365f, 0.225f}, {0.44f, 0.29f, 0.165f}, 7, 0.10f, 511},
    {"walnut", {0.19f, 0.105f, 0.058f}, {0.085f, 0.045f, 0.026f}, 8, 0.18f, 521},
    {"pine", {0.60f, 0.42f, 0.22f}, {0.42f, 0.245f, 0.095f}, 11, 0.04f, 531},
    {"wenge", {0.070f, 0.045f, 0.030f}, {0.028f, 0.019f, 0.014f}, 16, 0.22f, 541},
}};

// Contours of a shallow valley along the board: arches in the middle, straight lines at the sides.
Vec3f WoodColor(const WoodLook& wood, float u, float v) {
  const float wander = 0.16f * (TileFractal(u, v, 2, 2, 3, wood.seed) - 0.5f);
  const float across = std::cos(2 * kPiF * (u + 0.35f * wander));
  const float along = 0.30f * std::sin(2 * kPiF * v) + 0.17f * std::sin(4 * kPiF * v + 1) + 2.2f * wander;
  const float ring = wood.rings * (0.55f * across + along);
  const float growth = ring - std::floor(ring);
  const float late = growth < 0.8f ? std::pow(growth / 0.8f, 1.6f) : (1 - growth) / 0.2f;
  const float fibre = TileFractal(u, v, 64, 3, 3, wood.seed + 1), pore = TileFractal(u, v, 160, 10, 2, wood.seed + 2);
  const float dark = std::clamp((pore - 0.60f) * 6, 0.0f, 1.0f) * wood.pores;
  return Blend(wood.early, wood.late, 0.75f * late + 0.35f * (fibre - 0.5f)) * ((0.90f + 0.2f * fibre) * (1 - dark));
}

const Texture& TimberTexture(Timber timber) {
  static const std::array<Texture, 5> textures = [] {
    std::array<Texture, 5> all;
    for (size_t i = 0; i < all.size(); ++i) {
      const WoodLook& wood = kWoods[i];
      all[i] = Texture::FromImage(std::string("timber ") + wood.name,
                                  Shade(256, 512, [&](float u, float v) { return WoodColor(wood, u, v); }), true);
    }
    return all;
  }();
  return textures[static_cast<size_t>(timber)];
}

// Plain weave of n by n threads: which way the upper thread runs, and how high it lies.
struct Thread {
  float height, id;
};
Thread WeaveAt(float u, float v, int n, uint64_t seed) {
  const float x = u * static_cast<float>(n), y = v * static_cast<float>(n);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const float s = x - static_cast<float>(i) - 0.5f, t = y - static_cast<float>(j) - 0.5f;
  const bool warp = (i + j) % 2 == 0;
  const float across = warp ? s : t, along = warp ? t : s;
  const float height = std::sqrt(std::max(0.0f, 1 - 3.2f * across * across)) * (0.55f + 0.45f * std::cos(kPiF * along));
  const int line = warp ? i : j + n;
  return {height, TileNoise(static_cast<float>(line) + 0.5f, (warp ? v : u) * 6, 4 * n, 6, seed)};
}

const Texture& WeaveTexture() {
  static const Texture texture = Texture::FromImage(
      "weave",
      Shade(256, 256,
            [](float u, float v) {
              const Thread t = WeaveAt(u, v, 32, 601);
              const float tone = (0.62f + 0.38f * t.height) * (0.74f + 0.26f * t.id);
              return Vec3f{1, 1, 1} * std::min(1.0f, tone * (0.97f + 0.12f * (TileFractal(u, v, 3, 3, 3, 602) - 0.5f)) * 1.12f);
            }),
      true);
  return texture;
}
const Texture& WeaveNormals() {
  static const Texture texture =
      NormalsFromHeight("weave normals", 256, 256, 1, [](float u, float v) { return 0.006f * WeaveAt(u, v, 32, 601).height; });
  return texture;
}

float CreaseHeight(float u, float v) {
  return 0.010f * std::abs(TileFractal(u, v, 4, 4, 3, 611) - 0.5f) + 0.0009f * TileFractal(u, v, 90, 90, 2, 612);
}
const Texture& LinenTexture() {
  static const Texture texture = Texture::FromImage(
      "linen",
      Shade(256, 256,
            [](float u, float v) {
              const float slub = TileFractal(u, v, 6, 100, 2, 613) + TileFractal(u, v, 100, 6, 2, 614);
              return Vec3f{1, 1, 1} * std::min(1.0f, 0.88f + 0.08f * slub - 2.0f * std::max(0.0f, 0.012f - CreaseHeight(u, v)));
            }),
      true);
  return texture;
}
const Texture& LinenNormals() {
  static const Texture texture = NormalsFromHeight("linen normals", 256, 256, 1, CreaseHeight);
  return texture;
}

float GrainHeight(float u, float v) {
  static const CellPattern cells(64, 64, 0.9f, 621);
  const CellPattern::Cell cell = cells.At(u, v);
  return 0.0022f * std::min(1.0f, 3.5f * cell.edge) + 0.004f * TileFractal(u, v, 5, 5, 2, 622);
}
const Texture& LeatherTexture() {
  static const Texture texture = Texture::FromImage(
      "leather",
      Shade(256, 256,
            [](float u, float v) {
              static const CellPattern cells(64, 64, 0.9f, 621);
              const float groove = std::min(1.0f, 3.5f * cells.At(u, v).edge);
              return Vec3f{1, 1, 1} * std::min(1.0f, 0.66f + 0.16f * groove + 0.28f * (TileFractal(u, v, 3, 3, 4, 623) - 0.35f));
            }),
      true);
  return texture;
}
const Texture& LeatherNormals() {
  static const Texture texture = NormalsFromHeight("leather normals", 256, 256, 1, GrainHeight);
  return texture;
}

float PileHeight(float u, float v) { return 0.012f * TileFractal(u, v, 60, 60, 2, 631) + 0.012f * TileFractal(u, v, 6, 6, 3, 632); }
const Texture& PileTexture() {
  static const Texture texture =
      Texture::FromImage("pile",
                         Shade(256, 256,
                               [](float u, float v) {
                                 const float tuft = TileFractal(u, v, 60, 60, 2, 631), soft = TileFractal(u, v, 5, 5, 3, 632);
                                 return Vec3f{1, 1, 1} * std::min(1.0f, 0.52f + 0.48f * tuft + 0.24f * (soft - 0.3f));
                               }),
                         true);
  return texture;
}
const Texture& PileNormals() {
  static const Texture texture = NormalsFromHeight("pile normals", 256, 256, 1, PileHeight);
  return texture;
}

const Texture& BrushedTexture() {
  static const Texture texture =
      Texture::FromImage("brushed",
                         Shade(128, 256,
                               [](float u, float v) {
                                 return Vec3f{1, 1, 1} * std::min(1.0f, 0.80f + 0.16f * TileFractal(u, v, 1, 128, 2, 641) +
                                                                            0.08f * TileFractal(u, v, 2, 3, 2, 642));
                               }),
                         true);
  return texture;
}

const Texture& GraniteTexture() {
  static const Texture texture = Texture::FromImage("granite",
                                                    Shade(256, 256,
                                                          [](float u, float v) {
                                                            const float fine = TileFractal(u, v, 90, 90, 2, 651),
                                                                        blot = TileFractal(u, v, 24, 24, 3, 652);
                                                            const float crystal = fine > 0.60f ? 1.0f : fine < 0.40f ? 0.42f : 0.74f;
                                                            return Vec3f{1, 1, 1} * (crystal * (0.72f + 0.42f * blot));
                                                          }),
                                                    true);
  return texture;
}

const Texture& CardboardTexture() {
  static const Texture texture = Texture::FromImage(
      "cardboard",
      Shade(256, 256,
            [](float u, float v) {
              const float flute = 0.5f + 0.5f * std::cos(2 * kPiF * 56 * u), fleck = TileFractal(u, v, 80, 80, 2, 661);
              const float tone = 0.88f + 0.03f * flute + 0.10f * (TileFractal(u, v, 3, 3, 4, 662) - 0.5f) - (fleck > 0.72f ? 0.10f : 0.0f);
              return Vec3f{0.46f, 0.30f, 0.165f} * tone;
            }),
      true);
  return texture;
}

const Texture& RoughBoardTexture() {
  static const Texture texture = Texture::FromImage(
      "rough boards",
      Shade(128, 512,
            [](float u, float v) {
              const float fibre = TileFractal(u, v, 40, 3, 3, 671), soft = TileFractal(u, v, 3, 2, 3, 672);
              const float saw = 0.5f + 0.5f * std::sin(2 * kPiF * 90 * v + 4 * fibre), stain = TileFractal(u, v, 5, 6, 3, 673);
              const Vec3f fresh{0.46f, 0.32f, 0.19f}, grey{0.28f, 0.25f, 0.22f};
              return Blend(fresh, grey, 1.5f * (soft - 0.25f)) *
                     ((0.72f + 0.45f * fibre) * (0.97f + 0.05f * saw) * (stain > 0.66f ? 0.72f : 1.0f));
            }),
      true);
  return texture;
}

const Texture& ScuffedTexture() {
  static const Texture texture = Texture::FromImage(
      "scuffed",
      Shade(256, 256,
            [](float u, float v) {
              const float scuff = TileFractal(u, v, 40, 5, 3, 681), dirt = TileFractal(u, v, 3, 4, 4, 682);
              return Vec3f{1, 1, 1} * std::clamp(0.93f + 0.10f * (dirt - 0.5f) - (scuff > 0.74f ? 0.14f : 0.0f), 0.0f, 1.0f);
            }),
      true);
  return texture;
}

const Texture& SatinTexture() {
  static const Texture texture = Texture::FromImage(
      "satin",
      Shade(128, 128,
            [](float u, float v) {
              return Vec3f{1, 1, 1} * (0.965f + 0.03f * TileFractal(u, v, 3, 3, 4, 685) + 0.01f * TileFractal(u, v, 40, 40, 1, 686));
            }),
      true);
  return texture;
}

const Texture& SpangleTexture() {
  static const Texture texture = Texture::FromImage("spangle",
                                                    Shade(256, 256,
                                                          [](float u, float v) {
                                                            static const CellPattern cells(16, 16, 0.9f, 691);
                                                            const CellPattern::Cell cell = cells.At(u, v);
                                                            const float tone = static_cast<float>(cell.id % 17) / 17;
                                                            return Vec3f{0.97f, 0.99f, 1.0f} * (0.78f + 0.20f * tone);
                                                          }),
                                                    true);
  return texture;
}

}  // namespace

void UseTimber(PropBuilder& b, Timber timber, Grain grain) {
  const bool along = grain == Grain::kAlongX;
  Material m = MakeFinish(along ? "lacquered along x" : "lacquered", {0.9f, 0.9f, 0.9f}, 0.42f);
  if (along) m.uv_rotation = kPiF / 2;
  b.Use(m, TimberTexture(timber), along ? Vec2f{1.5f, 0.36f} : Vec2f{0.36f, 1.5f});
}

void UseLacquer(PropBuilder& b, Vec3f color, float roughness) {
  b.Use(MakeFinish("lacquer", color, roughness), SatinTexture(), {0.9f, 0.9f});
}

void UseWeave(PropBuilder& b, Vec3f color) {
  b.Use(MakeFinish("upholstery", color, 0.95f), WeaveTexture(), {0.10f, 0.10f}, &WeaveNormals());
}

void UseLinen(PropBuilder& b, Vec3f color) { b.Use(MakeFinish("linen", color, 0.9f), LinenTexture(), {0.55f, 0.55f}, &LinenNormals()); }

void UseLeather(PropBuilder& b, Vec3f color) {
  b.Use(MakeFinish("leather", color, 0.38f), LeatherTexture(), {0.16f, 0.16f}, &LeatherNormals());
}

void UsePile(PropBuilder& b, Vec3f color) { b.Use(MakeFinish("pile", color, 0.98f), PileTexture(), {0.30f, 0.30f}, &PileNormals()); }

void UseLinedCloth(PropBuilder& b, Vec3f color) {
  Material m = Fabric(color);
  m.name = "lined cloth";
  m.transmission = 0.05f;
  b.Use(m, LinenTexture(), {0.3f, 0.3f});
}

void UseSheerCloth(PropBuilder& b, Vec3f color, float open) {
  Material m = MakeFinish("sheer cloth", color, 0.7f);
  m.kind = SurfaceKind::kGlass;
  m.transmission = open;
  b.Use(m);
}

void UseCeramic(PropBuilder& b, Vec3f color) { b.Use(MakeFinish("ceramic", color, 0.07f)); }

void UseBrushedSteel(PropBuilder& b, float roughness) {
  b.Use(MakeFinish("brushed steel", {0.64f, 0.64f, 0.63f}, roughness, 1), BrushedTexture(), {0.4f, 0.2f});
}

void UseStoneTop(PropBuilder& b, Vec3f color) { b.Use(MakeFinish("stone top", color, 0.14f), GraniteTexture(), {0.6f, 0.6f}); }

void UseCardboard(PropBuilder& b, float shade) {
  b.Use(MakeFinish("cardboard", Vec3f{0.9f, 0.9f, 0.9f} * shade, 0.85f), CardboardTexture(), {0.4f, 0.4f});
}

void UseRoughBoards(PropBuilder& b, Grain grain) {
  const bool along = grain == Grain::kAlongX;
  Material m = MakeFinish(along ? "rough along x" : "rough", {0.9f, 0.9f, 0.9f}, 0.85f);
  if (along) m.uv_rotation = kPiF / 2;
  b.Use(m, RoughBoardTexture(), along ? Vec2f{1.2f, 0.25f} : Vec2f{0.25f, 1.2f});
}

void UseCoatedSteel(PropBuilder& b, Vec3f color, float roughness) {
  b.Use(MakeFinish("coated steel", color, roughness), ScuffedTexture(), {0.7f, 0.7f});
}

void UseGalvanised(PropBuilder& b) { b.Use(MakeFinish("galvanised", {0.60f, 0.61f, 0.62f}, 0.38f, 0.9f), SpangleTexture(), {0.5f, 0.5f}); }

Material ClearGlass(Vec3f tint) {
  Material m = MakeFinish("clear glass", tint, 0.03f);
  m.kind = SurfaceKind::kGlass;
  m.transmission = 0.95f;
  return m;
}

Material Mirror() { return MakeFinish("mirror", {0.88f, 0.89f, 0.88f}, 0.02f, 1); }

Material LampSurface(float lumens, float square_metres, float kelvin, Burns burns) {
  Material m = MakeFinish(burns == Burns::kAlways ? "lit surface" : "evening surface", {0.85f, 0.85f, 0.83f}, 0.4f);
  m.emission = LampWhite(kelvin) * (lumens / (kPiF * square_metres) * kNit);
  m.lamp = burns == Burns::kAtNight;
  return m;
}

Material Screen(float nits) {
  Material m = MakeFinish("screen", {0.03f, 0.03f, 0.03f}, 0.25f);
  m.emission = Vec3f{1, 1, 1} * (nits * kNit);
  return m;
}

}  // namespace airsim360::internal

#include "airsim360/worlds/city_park/materials.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/image/color.h"
#include "airsim360/worlds/city_park/noise.h"
#include "airsim360/worlds/texture/texture_synth.h"

namespace airsim360::internal::park {
namespace {

// sRGB by table: the pictures have tens of millions of texels.
Rgba8 Encode(Vec3f c) {
  static const std::vector<uint8_t> table = [] {
    std::vector<uint8_t> codes(8192);
    for (size_t i = 0; i < codes.size(); ++i) codes[i] = LinearToSrgb8((static_cast<float>(i) + 0.5f) / 8192);
    return codes;
  }();
  const auto code = [&](float x) { return table[static_cast<size_t>(std::clamp(x, 0.0f, 0.9999f) * 8192)]; };
  return {code(c.x), code(c.y), code(c.z), 255};
}

// A picture of color(u, v), u and v in [0, 1), v downwards; rows in parallel.
Texture Paint(std::string name, int width, int height, const std::function<Vec3f(float, float)>& color) {
  Image<Rgba8> image(width, height);
  ParallelFor(height, [&](int64_t y) {
    const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
    for (int x = 0; x < width; ++x)
      image(x, static_cast<int>(y)) = Encode(color((static_cast<float>(x) + 0.5f) / static_cast<float>(width), v));
  });
  return Texture::FromImage(std::move(name), std::move(image), true);
}

// Patches of newer asphalt, cut in as rectangles: 0 none, 1 inside, 2 on the sealed seam.
int PatchAt(float s, float d) {
  const int place = static_cast<int>(std::floor(s / 17));
  const uint32_t h = HashCell(place, d > 0, 401);
  if (Unit(h) > 0.42f) return 0;
  const float along = s - static_cast<float>(place) * 17 - 2, length = 3 + 7 * Unit(Scramble(h));
  const float middle = 1 + 3.4f * Unit(Scramble(h + 9)), half = 0.6f + Unit(Scramble(h + 4));
  const float inside = std::min({along, length - along, half - std::abs(std::abs(d) - middle)});
  return inside <= 0 ? 0 : inside < 0.04f ? 2 : 1;
}

// Worn asphalt at s metres along and d to the left of the middle: aggregate, wheel tracks, dust, oil,
// patches, tar-sealed cracks. Albedo of dry aged asphalt 0.16 to 0.2.
Vec3f RoadColor(float s, float d, float half) {
  const float mottle = Fractal(s / 6, d / 6, 4, 11), fine = Noise(s * 38, d * 38, 1), coarse = Noise(s * 11, d * 11, 2);
  Vec3f c = Vec3f{0.205f, 0.198f, 0.188f} * (0.74f + 0.26f * mottle + 0.20f * (fine - 0.5f) + 0.14f * (coarse - 0.5f));
  // Two dark bands a lane where wheels run.
  const float across = std::abs(d);
  for (float wheel : {-0.8f, 0.8f}) {
    for (int k = 0; k < 2; ++k) {
      const float q = (across - 2.15f - 2.86f * static_cast<float>(k) - wheel) / 0.32f;
      if (q * q < 8) c = c * (1 - 0.17f * std::exp(-q * q) * (0.6f + 0.4f * Noise(s / 9, static_cast<float>(k), 3)));
    }
  }
  const float stone = Voronoi(s * 40, d * 40, 59).first;
  c = c * (0.84f + 0.36f * stone) * (0.88f + 0.24f * Fractal(s / 0.9f, d / 0.9f, 3, 62));
  // Dust blown in from the beds, more of it at the edges.
  float dust = Ramp(0.50f, 0.70f, Fractal(s / 14 + 4, d / 4, 4, 13));
  if (dust > 0) dust *= 0.55f + 0.9f * Fractal(s / 1.3f, d / 1.3f, 3, 54);
  const float edge = Ramp(half - 1.1f, half, across) * 0.5f;
  c = Mix(c, Vec3f{0.200f, 0.152f, 0.100f} * (0.75f + 0.4f * mottle + 0.2f * (fine - 0.5f)), std::min(0.8f, 0.62f * dust + edge));
  const float oil = Ramp(0.66f, 0.78f, Fractal(s / 3.2f + 60, d / 1.4f, 3, 15));
  c = c * (1 - 0.6f * oil);
  if (const int patch = PatchAt(s, d)) c = c * (patch == 2 ? 0.45f : 0.74f);
  // Cracks along the borders of wandering cells, only in places.
  const float cracked = Ramp(0.42f, 0.56f, Fractal(s / 11, d / 11, 2, 19));
  if (cracked > 0) {
    const float wx = 0.56f * Fractal(s * 0.7f, d * 0.7f, 3, 16), wy = 0.56f * Fractal(s * 0.7f + 8, d * 0.7f, 3, 17);
    const Cells cell = Voronoi(s * 0.21f + wx, d * 0.21f + wy, 18);
    c = c * (1 - 0.62f * cracked * Ramp(0.0095f, 0.002f, cell.second - cell.first));
  }
  return c;
}

Texture RoadPicture(std::string name, float half) {
  Texture texture =
      Paint(std::move(name), 6144, 512, [=](float u, float v) { return RoadColor(u * kRoadPictureLength, (1 - 2 * v) * half, half); });
  texture.wrap_u = Wrap::kMirror;
  texture.wrap_v = Wrap::kClamp;
  return texture;
}

// The chip on top at (u, v), of a layer of `cells` chips a tile: flat splinters thrown at random.
struct Chip {
  float height = 0;  // 0 = none here
  float edge = 0;    // 0 on its border … 1 in the middle
  uint32_t id = 0;
};
Chip ChipAt(float u, float v, int cells, int seed) {
  const float x = u * static_cast<float>(cells), y = v * static_cast<float>(cells);
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  Chip top;
  for (int b = j - 1; b <= j + 1; ++b) {
    for (int a = i - 1; a <= i + 1; ++a) {
      const uint32_t h = HashCell((a + cells) % cells, (b + cells) % cells, seed);
      const float height = 0.05f + 0.95f * Unit(Scramble(h + 7));
      if (height < top.height) continue;
      const float dx = x - static_cast<float>(a) - Unit(h), dy = y - static_cast<float>(b) - Unit(Scramble(h + 1));
      const float turn = 6.2832f * Unit(Scramble(h + 2)), c = std::cos(turn), s = std::sin(turn);
      const float length = 0.45f + 0.45f * Unit(Scramble(h + 3)), width = 0.14f + 0.20f * Unit(Scramble(h + 4));
      const float inside = std::min(1 - std::abs(dx * c + dy * s) / length, 1 - std::abs(dy * c - dx * s) / width);
      if (inside > 0) top = {height, inside, h};
    }
  }
  return top;
}

// Bark mulch: splinters of two sizes over dark crumbs.
Texel Mulch(float u, float v) {
  Chip chip = ChipAt(u, v, 30, 501);
  const bool large = chip.height > 0.25f;
  if (!large) chip = ChipAt(u, v, 64, 502);
  if (chip.height <= 0) return {Vec3f{0.045f, 0.030f, 0.022f}, 0, 0.95f};
  const float r = Unit(Scramble(chip.id + 11));
  Vec3f c = Mix(Vec3f{0.13f, 0.068f, 0.040f}, Vec3f{0.42f, 0.29f, 0.20f}, r * r);
  c = c * ((0.45f + 0.65f * chip.height) * (0.72f + 0.28f * Ramp(0.0f, 0.25f, chip.edge)) * (1 + 0.22f * TilingFbm(503, u, v, 4, 4)));
  return {c, (large ? 0.010f : 0.004f) * chip.height + 0.003f * Ramp(0.0f, 0.2f, chip.edge), 0.9f};
}

// Cast slabs of 1.5 x 0.95 m, u along the pavement: joints, stains, gum, dirt.
Texel Slab(float u, float v) {
  const float x = u * 6, y = v * 5.7f;
  const int i = static_cast<int>(x / 1.5f), j = static_cast<int>(y / 0.95f);
  const float jx = x - static_cast<float>(i) * 1.5f, jy = y - static_cast<float>(j) * 0.95f;
  const float tone = Unit(HashCell(i, j, 511)), edge = std::min({jx, 1.5f - jx, jy, 0.95f - jy});
  const float grain = TilingNoise(512, u * 220, v * 220, 220), soft = TilingFbm(513, u, v, 3, 5);
  const float stain = Ramp(0.0f, 0.40f, TilingFbm(514, u, v, 4, 4));
  const WorleyResult gum = TilingWorley(515, u, v, 36);
  float y0 = 0.265f * (0.76f + 0.22f * tone + 0.24f * soft + 0.12f * grain);
  y0 *= (1 - 0.6f * Ramp(0.014f, 0.006f, edge)) * (1 - 0.14f * Ramp(0.09f, 0.0f, edge));
  if (HashUnit(gum.cell, 1) < 0.06f && gum.first < 0.09f) y0 *= 0.55f;
  const Vec3f c = Mix(Vec3f{1.0f, 0.955f, 0.87f} * y0, {0.12f, 0.10f, 0.08f}, 0.55f * stain);
  return {c, -0.004f * Ramp(0.012f, 0.004f, edge) + 0.0006f * grain, 0.72f};
}

// Fine crushed stone, trodden.
Texel Gravel(float u, float v) {
  const WorleyResult stone = TilingWorley(521, u, v, 110), fine = TilingWorley(522, u, v, 230);
  const float soft = TilingFbm(523, u, v, 3, 5), tone = HashUnit(stone.cell, 1);
  const Vec3f c = Vec3f{0.27f, 0.235f, 0.185f} *
                  ((0.72f + 0.5f * tone) * (1.1f - 0.35f * stone.first) * (0.9f + 0.2f * HashUnit(fine.cell, 2)) * (1 + 0.22f * soft));
  return {c, 0.006f * (1 - stone.first) * (0.5f + tone), 0.88f};
}

MaterialId AddTiling(SceneBuilder& builder, const TextureRecipe& recipe, int size, float macro) {
  TextureSet set = SynthesizeTextures(recipe, size);
  Material m;
  m.name = recipe.name;
  m.base_color = {1, 1, 1};
  m.roughness = 1;
  m.macro_variation = macro;
  m.base_color_texture = builder.AddTexture(std::move(set.color));
  m.normal_texture = builder.AddTexture(std::move(set.normal));
  m.metallic_roughness_texture = builder.AddTexture(std::move(set.roughness));
  m.uv_scale = {1 / recipe.tile, 1 / recipe.tile};
  return builder.AddMaterial(std::move(m));
}

MaterialId AddPicture(SceneBuilder& builder, Texture texture, float roughness, float macro) {
  Material m;
  m.name = texture.name;
  m.base_color = {1, 1, 1};
  m.roughness = roughness;
  m.macro_variation = macro;
  m.base_color_texture = builder.AddTexture(std::move(texture));
  return builder.AddMaterial(std::move(m));
}

}  // namespace

Vec3f GroundColor(const Layout& layout, Vec2f p, int level) {
  // Lawn between its blades is darker than seen from above with them.
  const float fine = level == 0 ? Fractal(p.x * 9, p.y * 9, 2, 31) : 0.5f;
  const float grain = level == 0 ? Noise(p.x * 31, p.y * 31, 32) : 0.5f;
  Vec3f c = (level < 2 ? layout.Lawn(p) : layout.LawnCoarse(p)) * 0.92f;
  c = c * (0.68f + 0.40f * fine + 0.26f * grain);
  const Vec3f soil = Vec3f{0.115f, 0.085f, 0.055f} * (0.6f + 0.8f * fine);
  if (level == 0) c = Mix(c, soil, 0.22f);
  // Under trees: old leaves and bare earth.
  const float forest = layout.Forest(p);
  if (forest > 0) {
    const Vec3f litter = Mix(Vec3f{0.12f, 0.085f, 0.045f}, Vec3f{0.20f, 0.14f, 0.07f}, grain) * (0.6f + 0.7f * fine);
    c = Mix(c, litter, 0.75f * forest * Ramp(0.35f, 0.65f, Fractal(p.x / 3, p.y / 3, 3, 34)));
  }
  if (level == 2) return c;
  // Trodden beside paths, wet and dark at the water.
  const float trod = 0.5f * Ramp(3.2f, 1.0f, layout.PathDistance(p, 4));
  const float lake = layout.Lake(p), bank = Ramp(1.35f, 1.02f, lake) * 0.9f;
  const float bare = std::max(trod, bank) * Ramp(0.3f, 0.6f, 0.5f * fine + 0.5f * Noise(p.x, p.y, 35));
  c = Mix(c, soil * 0.8f, 0.8f * bare);
  if (lake < 1.5f) {
    const float above = layout.Ground(p) - kLakeZ;
    c = Mix(c * 0.45f, c, Ramp(0.04f, 0.35f, above));
  }
  return c;
}

ParkMaterials AddParkMaterials(SceneBuilder& builder, const Layout& layout) {
  ParkMaterials m;
  for (int level = 0; level < 3; ++level) {
    const float half = kGroundSquares[static_cast<size_t>(level)];
    Texture texture = Paint("park ground " + std::to_string(level), 2048, 2048, [&](float u, float v) {
      return GroundColor(layout, {(2 * u - 1) * half, (1 - 2 * v) * half}, level);
    });
    texture.wrap_u = texture.wrap_v = Wrap::kClamp;
    m.ground[static_cast<size_t>(level)] = AddPicture(builder, std::move(texture), 0.95f, level == 2 ? 0.10f : 0.0f);
  }
  m.main_road = AddPicture(builder, RoadPicture("main road", kMainHalf), 0.82f, 0.10f);
  m.side_road = AddPicture(builder, RoadPicture("side road", kSideHalf), 0.82f, 0.12f);
  const TextureRecipe recipes[3] = {
      {"bark mulch", 2, 0.120f, Mulch}, {"pavement slabs", 6, 0.185f, Slab}, {"crushed stone", 3, 0.215f, Gravel}};
  m.mulch = AddTiling(builder, recipes[0], 1024, 0.12f);
  m.pavement = AddTiling(builder, recipes[1], 1024, 0.18f);
  m.gravel = AddTiling(builder, recipes[2], 1024, 0.12f);
  return m;
}

}  // namespace airsim360::internal::park

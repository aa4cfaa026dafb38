// Pots and planters with plants in them.
#include <algorithm>
#include <cmath>
#include <utility>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"
#include "airsim360/worlds/vegetation/plant_mesh.h"

namespace airsim360::internal {
namespace {

const Texture& PotLeaves() {
  static const Vec3f tones[] = {{0.052f, 0.092f, 0.024f}, {0.070f, 0.110f, 0.030f}, {0.045f, 0.078f, 0.026f}};
  static const Texture atlas = LeafAtlas("leaves pot", tones);
  return atlas;
}

// Adds the parts of `plant` to `model`.
void Merge(Model& model, Model plant) {
  const auto vertices = static_cast<uint32_t>(model.mesh.positions.size()), triangles = static_cast<uint32_t>(model.mesh.triangles.size());
  const auto materials = static_cast<MaterialId>(model.materials.size());
  const auto textures = static_cast<TextureId>(model.textures.size());
  const auto append = [](auto& to, auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(model.mesh.positions, plant.mesh.positions);
  append(model.mesh.normals, plant.mesh.normals);
  append(model.mesh.uvs, plant.mesh.uvs);
  append(model.textures, plant.textures);
  for (Vec3u t : plant.mesh.triangles) model.mesh.triangles.push_back({t.x + vertices, t.y + vertices, t.z + vertices});
  for (MeshPart part : plant.mesh.parts)
    model.mesh.parts.push_back({part.first_triangle + triangles, part.triangle_count, part.material + materials, kNoEntity});
  for (Material& m : plant.materials) {
    for (TextureId* id : {&m.base_color_texture, &m.normal_texture}) {
      if (*id != kNoTexture) *id += textures;
    }
    model.materials.push_back(std::move(m));
  }
}

// What grows in a vessel: leaves in a ball of radius r about `c`, or arching strap leaves from the soil at `c`. `size` of leaves.
struct Growth {
  bool straps;
  Vec3f c;
  float r;
  int leaves;
  float size = 0.068f;
};

void Grow(std::vector<PlantLayer>& layers, const Growth& g, RngStream& random) {
  for (int i = 0; i < g.leaves; ++i) {
    const Vec3f d = RandomDirection(random);
    if (g.straps) {
      const Vec3f lean = Normalized(Vec3f{d.x, d.y, 0.001f}) * static_cast<float>(random.Uniform(0.2, 1.0));
      const Vec3f foot = g.c + Vec3f{d.x, d.y, 0} * (0.25f * g.r);
      AddBlade(layers[random.Chance(0.4) ? 2 : 3], foot, g.r * static_cast<float>(random.Uniform(1.4, 2.4)), 0.035f, lean,
               std::atan2(lean.y, lean.x) + kTauF / 4, static_cast<int>(random.Index(kLeafCells - 1)));
      continue;
    }
    const float shell = std::cbrt(static_cast<float>(random.Uniform(0.04, 1.0))) * (0.85f + 0.3f * Noise(d * 2.0f + g.c * 3.0f, 5));
    const Vec3f p = g.c + Vec3f{d.x, d.y, d.z * 0.9f} * (g.r * shell);
    const float size = g.size * static_cast<float>(random.Uniform(0.6, 1.35));
    // A few of them are yellow.
    AddLeaf(LeavesAt(layers, 1.7f * shell - 0.75f + 0.3f * d.z), p, Normalized(d + RandomDirection(random) * 0.8f),
            d * 0.8f + Vec3f{0, 0, 0.7f} + RandomDirection(random) * 0.5f, {size, size * 0.58f, 0.14f, 0.2f},
            static_cast<int>(random.Index(random.Chance(0.15) ? kLeafCells : kLeafCells - 1)), d * 0.4f);
  }
}

Model Foliage(const Growth& growth, RngStream& random) {
  std::vector<PlantLayer> layers = PlantLayers({}, PotLeaves());
  Grow(layers, growth, random);
  return JoinLayers("foliage", layers);
}

// Nobody's pots hold the same: a shrub in its prime, one of a few uneven clumps with gaps, straps, or what is left of last year's.
// `soil` is the middle of the earth, `r` what a full ball has, `most` leaves that it takes.
Model OwnFoliage(Vec3f soil, float r, int most, RngStream& random) {
  const auto uniform = [&](double a, double b) { return static_cast<float>(random.Uniform(a, b)); };
  const auto share = [&](float part) { return static_cast<int>(part * static_cast<float>(most)); };
  const double pick = random.Uniform();
  if (pick < 0.22) return Foliage({true, soil, r * uniform(0.75, 1.05), static_cast<int>(random.Uniform(38, 85))}, random);
  std::vector<PlantLayer> layers = PlantLayers({}, PotLeaves());
  if (pick < 0.40) {
    const float own = r * uniform(0.8, 1.0);
    Grow(layers, {false, soil + Vec3f{0, 0, own * 0.75f}, own, share(uniform(0.7, 1.0)), uniform(0.05, 0.08)}, random);
    return JoinLayers("foliage", layers);
  }
  const bool thin = pick > 0.85;
  const int clumps = 2 + static_cast<int>(random.Index(4));
  const float size = uniform(0.042, 0.085), leaves = (thin ? 0.22f : uniform(0.55, 0.95)) / static_cast<float>(clumps);
  for (int i = 0; i < clumps; ++i) {
    const float angle = kTauF * (static_cast<float>(i) + uniform(0, 0.8)) / static_cast<float>(clumps), out = r * uniform(0.15, 0.5),
                own = r * uniform(0.4, 0.72);
    const Vec3f c = soil + Vec3f{out * std::cos(angle), out * std::sin(angle), own * uniform(0.6, 1.0) + (i == 0 ? 0.5f * r : 0.0f)};
    Grow(layers, {false, c, own, share(leaves), size}, random);
  }
  return JoinLayers("foliage", layers);
}

constexpr int kPots = 12, kGreenPots = 9, kPlanters = 9;

// Outlines from the axis outwards and back over the rim, (radius, height) in metres.
const std::vector<Vec2f> kPotProfiles[4] = {
    {{0, 0},
     {0.19f, 0},
     {0.20f, 0.01f},
     {0.275f, 0.40f},
     {0.30f, 0.41f},
     {0.305f, 0.48f},
     {0.295f, 0.49f},
     {0.265f, 0.49f},
     {0.255f, 0.42f},
     {0, 0.42f}},
    {{0, 0},
     {0.15f, 0},
     {0.24f, 0.12f},
     {0.29f, 0.28f},
     {0.27f, 0.44f},
     {0.22f, 0.52f},
     {0.24f, 0.56f},
     {0.23f, 0.57f},
     {0.20f, 0.53f},
     {0.20f, 0.49f},
     {0, 0.49f}},
    {{0, 0}, {0.22f, 0}, {0.22f, 0.05f}, {0.40f, 0.22f}, {0.46f, 0.36f}, {0.46f, 0.40f}, {0.42f, 0.41f}, {0.40f, 0.35f}, {0, 0.35f}},
    {{0, 0}, {0.15f, 0}, {0.155f, 0.01f}, {0.24f, 0.72f}, {0.245f, 0.75f}, {0.22f, 0.755f}, {0.21f, 0.69f}, {0, 0.69f}}};

// Turned pots of four shapes: of new and limed terracotta, glazed, of concrete, zinc and plastic.
Model MakePot(uint32_t variant, uint64_t seed) {
  RngStream random(seed, "pot");
  PropBuilder b("pot");
  struct Make {
    Vec3f tone;
    float roughness;
  };
  static constexpr Make kMakes[kPots] = {
      {{0.34f, 0.165f, 0.095f}, 0.85f}, {{0.035f, 0.06f, 0.09f}, 0.18f}, {{0.40f, 0.385f, 0.36f}, 0.85f}, {{0.055f, 0.056f, 0.06f}, 0.7f},
      {{0.30f, 0.19f, 0.135f}, 0.9f},   {{0.27f, 0.26f, 0.22f}, 0.3f},   {{0.30f, 0.145f, 0.10f}, 0.85f}, {{0.24f, 0.245f, 0.25f}, 0.55f},
      {{0.42f, 0.30f, 0.23f}, 0.9f},    {{0.10f, 0.075f, 0.06f}, 0.6f},  {{0.47f, 0.455f, 0.42f}, 0.85f}, {{0.20f, 0.115f, 0.08f}, 0.85f}};
  b.Use(Stone(kMakes[variant].tone, kMakes[variant].roughness), ConcreteTexture());
  const uint32_t shape = variant % 4;
  const std::vector<Vec2f>& profile = kPotProfiles[shape];
  b.Lathe(profile, 32);
  const float soil = profile.back().y;
  b.Use(Stone({0.045f, 0.032f, 0.022f}, 0.95f));
  const float r = profile[profile.size() - 2].x;
  const Vec2f earth[] = {{r, soil + 0.005f}, {r * 0.5f, soil + 0.03f}, {0, soil + 0.035f}};
  b.Lathe(earth, 24);
  Model model = b.Finish();
  Merge(model, OwnFoliage({0, 0, soil}, shape == 2 ? 0.40f : 0.30f, shape == 2 ? 2600 : 1900, random));
  return model;
}

// Long planter box (1.6 m along X) of timber, concrete or steel with mixed planting.
Model MakePlanter(uint32_t number, uint64_t seed) {
  RngStream random(seed, "planter");
  PropBuilder b("planter");
  const uint32_t variant = number % 3, age = number / 3;
  constexpr Vec3f kTimbers[] = {{0.85f, 0.80f, 0.75f}, {1.0f, 1.25f, 1.5f}, {0.55f, 0.5f, 0.48f}},  // fresh, silvered, stained
      kConcretes[] = {{0.42f, 0.40f, 0.37f}, {0.31f, 0.30f, 0.275f}, {0.50f, 0.475f, 0.43f}},
                  kSteels[] = {{0.16f, 0.085f, 0.05f}, {0.07f, 0.072f, 0.075f}, {0.22f, 0.215f, 0.20f}};
  const float w = 0.8f, d = 0.32f, h = 0.58f;
  if (variant == 0) {
    UseWood(b, kTimbers[age], Grain::kAlongX);
    for (int i = 0; i < 4; ++i) {
      const float z = 0.04f + 0.135f * static_cast<float>(i);
      for (float y : {-1.0f, 1.0f}) b.BevelBox({-w, y > 0 ? d - 0.03f : -d, z}, {w, y > 0 ? d : -d + 0.03f, z + 0.128f}, 0.005f);
      for (float x : {-1.0f, 1.0f})
        b.BevelBox({x > 0 ? w - 0.03f : -w, -d + 0.03f, z}, {x > 0 ? w : -w + 0.03f, d - 0.03f, z + 0.128f}, 0.005f);
    }
    b.Use(CastIron());
    for (float x : {-w + 0.06f, w - 0.06f}) {
      for (float y : {-d + 0.06f, d - 0.06f}) b.BevelBox({x - 0.03f, y - 0.03f, 0}, {x + 0.03f, y + 0.03f, h - 0.04f}, 0.004f);
    }
  } else {
    b.Use(variant == 1 ? Stone(kConcretes[age]) : Metal(kSteels[age], 0.75f), variant == 1 ? ConcreteTexture() : ScratchedTexture());
    const auto wall = [&](Vec3f lo, Vec3f hi) { b.BevelBox(lo, hi, variant == 1 ? 0.02f : 0.005f); };
    const float t = variant == 1 ? 0.06f : 0.025f;
    wall({-w, -d, 0}, {w, -d + t, h});
    wall({-w, d - t, 0}, {w, d, h});
    wall({-w, -d, 0}, {-w + t, d, h});
    wall({w - t, -d, 0}, {w, d, h});
  }
  b.Use(Stone({0.045f, 0.032f, 0.022f}, 0.95f));
  b.mesh().Box({-w + 0.02f, -d + 0.02f, 0.3f}, {w - 0.02f, d - 0.02f, h - 0.06f}, MeshBuilder::kTop);
  Model model = b.Finish();
  // Clumps stand where they were planted, and some have died.
  const int places = 3 + static_cast<int>(random.Index(3));
  for (int i = 0; i < places; ++i) {
    if (i > 0 && random.Chance(0.12)) continue;
    const float x =
        -0.57f + 1.14f * (static_cast<float>(i) + 0.3f * static_cast<float>(random.Uniform(-1, 1))) / static_cast<float>(places - 1);
    const Vec3f soil{std::clamp(x, -0.6f, 0.6f), 0.04f * static_cast<float>(random.Normal()), h - 0.06f};
    Merge(model, OwnFoliage(soil, static_cast<float>(random.Uniform(0.2, 0.3)), 1250, random));
  }
  return model;
}

// A green tub of painted steel of three sizes, its paint fresh, faded or dark, with a bush or strap leaves.
Model MakeGreenPot(uint32_t variant, uint64_t seed) {
  RngStream random(seed, "green pot");
  PropBuilder b("green_pot");
  constexpr float kRadius[] = {0.42f, 0.36f, 0.33f}, kHeight[] = {0.62f, 0.78f, 0.56f};
  constexpr Vec3f kPaints[] = {{0.025f, 0.085f, 0.05f}, {0.06f, 0.105f, 0.075f}, {0.03f, 0.055f, 0.035f}};
  const float r = kRadius[variant % 3], h = kHeight[variant % 3];
  b.Use(Paint(kPaints[variant / 3], 0.5f), ScratchedTexture());
  const Vec2f tub[] = {{0, 0},         {r * 0.78f, 0}, {r * 0.8f, 0.02f},     {r * 0.97f, h - 0.09f}, {r * 1.04f, h - 0.08f},
                       {r * 1.04f, h}, {r * 0.93f, h}, {r * 0.9f, h - 0.09f}, {0, h - 0.09f}};
  b.Lathe(tub, 28);
  b.Use(Stone({0.045f, 0.032f, 0.022f}, 0.95f));
  b.mesh().Tube({0, 0, h - 0.085f}, {0, 0, h - 0.06f}, r * 0.88f, r * 0.86f, 20, false);
  Model model = b.Finish();
  Merge(model, OwnFoliage({0, 0, h - 0.08f}, r * 1.0f, 2100, random));
  return model;
}

// A plant growing from the ground, without a vessel.
Model MakePlant(uint32_t variant, uint64_t seed) {
  RngStream random(seed, "plant");
  PropBuilder b("plant");
  b.Use(Stone({0.045f, 0.032f, 0.022f}, 0.95f));
  b.mesh().Tube({0, 0, -0.05f}, {0, 0, 0.015f}, 0.2f, 0.12f, 12, false);
  Model model = b.Finish();
  const float r = 0.28f + 0.05f * static_cast<float>(variant);
  const bool straps = variant % 2 == 1;
  Merge(model, Foliage({straps, {0, 0, straps ? 0.0f : r * 0.8f}, r, straps ? 90 : 1700}, random));
  return model;
}

}  // namespace

std::vector<PropKind> PlanterKinds() {
  return {
      {"green_pot", "furniture/planter/green_pot", kGreenPots, MakeGreenPot, 0.5f, 0.6f, 2.2f, 9000},
      {"plant", "vegetation/plant", 4, MakePlant, 0.4f, 0.2f, 1.4f, 7000},
      {"pot", "furniture/planter/pot", kPots, MakePot, 0.5f, 0.6f, 1.6f, 7000},
      {"planter", "furniture/planter/pot", kPlanters, MakePlanter, 0.95f, 0.75f, 1.4f, 12000},
  };
}

}  // namespace airsim360::internal

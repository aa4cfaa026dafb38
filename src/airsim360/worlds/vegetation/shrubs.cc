// Shrubs and clipped hedges.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/vegetation/plant_mesh.h"

namespace airsim360::internal {
namespace {

const Texture& ShrubLeaves() {
  static const Vec3f tones[] = {{0.067f, 0.098f, 0.023f}, {0.082f, 0.112f, 0.028f}, {0.055f, 0.082f, 0.022f}, {0.094f, 0.118f, 0.032f}};
  static const Texture atlas = LeafAtlas("leaves shrub", tones);
  return atlas;
}

// A leaf at a point, its face turned out of the plant.
void AddShrubLeaf(PlantLayer& layer, Vec3f p, Vec3f out, float size, RngStream& random) {
  const Vec3f direction = Normalized(RandomDirection(random) + out * 0.7f + Vec3f{0, 0, 0.25f});
  const Vec3f up = out * 0.8f + Vec3f{0, 0, 0.8f} + RandomDirection(random) * 0.6f;
  const float s = size * static_cast<float>(random.Uniform(0.7, 1.25));
  const int cell = random.Chance(0.02) ? kLeafCells - 1 : static_cast<int>(random.Index(kLeafCells - 1));
  AddLeaf(layer, p, direction, up, {s, s * 0.55f, 0.14f, 0.15f}, cell, out * 0.4f);
}

struct ShrubBuild {
  float height, radius, leaf;  // metres
  int leaves;
};
constexpr ShrubBuild kShrubs[4] = {
    {1.3f, 0.80f, 0.062f, 9000}, {1.0f, 0.85f, 0.055f, 9000}, {1.9f, 0.95f, 0.075f, 10000}, {0.8f, 0.6f, 0.050f, 6500}};

using Lobes = std::vector<std::pair<Vec3f, float>>;  // centre, radius

// The outer ones alternate between low and middle heights, so that the plant is clothed to the ground.
Lobes ShrubLobes(const ShrubBuild& b, RngStream& random) {
  Lobes lobes;
  for (int i = 0; i < 16; ++i) {
    const float a = 2.39996f * static_cast<float>(i), r = b.radius * 0.68f * std::sqrt((static_cast<float>(i) + 0.5f) / 16);
    const float z = b.height * (i % 2 ? 0.28f : 0.78f - 0.40f * r / b.radius) * static_cast<float>(random.Uniform(0.8, 1.1));
    lobes.push_back({{r * std::cos(a), r * std::sin(a), z}, b.radius * static_cast<float>(random.Uniform(0.26, 0.44))});
  }
  return lobes;
}

// Stems from one root into the lobes.
std::vector<BranchNode> GrowShrub(const ShrubBuild& b, const Lobes& lobes, RngStream& random) {
  const auto inside = [&](Vec3f p) {
    for (const auto& [c, r] : lobes) {
      const Vec3f d = p - c;
      if (d.x * d.x + d.y * d.y + d.z * d.z * 1.7f < r * r) return true;
    }
    return false;
  };
  const auto attractors =
      ScatterInside({-b.radius * 1.3f, -b.radius * 1.3f, 0.08f}, {b.radius * 1.3f, b.radius * 1.3f, b.height * 1.1f}, 2200, inside, random);
  std::vector<BranchNode> nodes;
  AddStem(nodes, -1, {0, 0, -0.12f}, {0, 0, 0}, 0.06f, 0, random);
  const int root = static_cast<int>(nodes.size()) - 1;
  for (int i = 0; i < 6; ++i) {
    const float a = 1.0472f * static_cast<float>(i) + static_cast<float>(random.Uniform(-0.3, 0.3));
    AddStem(nodes, root, {0, 0, 0}, Vec3f{0.40f * b.radius * std::cos(a), 0.40f * b.radius * std::sin(a), b.height * 0.4f}, 0.07f, 0.4f,
            random);
  }
  Colonise(nodes, attractors, {.step = 0.07f, .influence = 0.55f, .kill = 0.13f, .tropism = {0, 0, 0.2f}, .max_nodes = 4000}, random);
  Thicken(nodes, 0.045f, 0.003f);
  return nodes;
}

// Thin twigs above the ground, where leaves grow.
std::vector<Vec3f> LeafSites(const std::vector<BranchNode>& nodes) {
  std::vector<Vec3f> sites;
  for (const BranchNode& node : nodes)
    if (node.tips <= 5 && node.p.z > 0.06f) sites.push_back(node.p);
  return sites;
}

Vec3f AnyOf(const std::vector<Vec3f>& sites, RngStream& random) { return sites[random.Index(static_cast<uint32_t>(sites.size()))]; }

void ClotheShrub(std::vector<PlantLayer>& layers, const ShrubBuild& b, const std::vector<Vec3f>& sites, Vec3f middle, RngStream& random) {
  for (int k = 0; k < b.leaves; ++k) {
    const Vec3f p = AnyOf(sites, random), d = p - middle;
    const float depth = Norm(Vec3f{d.x / b.radius, d.y / b.radius, d.z / (0.65f * b.height)});
    const float openness = 0.05f + 0.65f * depth + 0.35f * d.z / b.height + 0.12f * static_cast<float>(random.Normal());
    AddShrubLeaf(LeavesAt(layers, openness), p + RandomDirection(random) * (0.07f * static_cast<float>(random.Uniform())),
                 Normalized(p - middle), b.leaf, random);
  }
}

// Shoots of this year: leaves along a free stem.
void AddShoots(std::vector<PlantLayer>& layers, const ShrubBuild& b, const std::vector<Vec3f>& sites, Vec3f middle, RngStream& random) {
  for (int i = 0; i < 28; ++i) {
    const Vec3f p = AnyOf(sites, random), out = Normalized(p - middle);
    const Vec3f d = Normalized(out + Vec3f{0, 0, 1.1f} + RandomDirection(random) * 0.3f);
    const float length = 0.22f * static_cast<float>(random.Uniform(0.6, 1.3));
    AddNeedle(layers[0], p, p + d * length, Normalized(Cross(d, Vec3f{0.3f, 0.5f, 0.1f})), 0.006f, out, 0);
    for (int k = 0; k < 14; ++k) AddShrubLeaf(layers[3], p + d * (length * static_cast<float>(k + 1) / 14), d, b.leaf * 0.8f, random);
  }
}

// Several stems from the ground that fill flat, overlapping lobes; single shoots stand out.
Model MakeShrub(uint32_t variant, uint64_t seed) {
  const ShrubBuild& b = kShrubs[variant];
  RngStream random(seed, "shrub");
  const Lobes lobes = ShrubLobes(b, random);
  const std::vector<BranchNode> nodes = GrowShrub(b, lobes, random);
  std::vector<PlantLayer> layers = PlantLayers({0.15f, 0.12f, 0.09f}, ShrubLeaves());
  AddBark(layers[0], nodes, 0.004f, 0);
  const std::vector<Vec3f> sites = LeafSites(nodes);
  const Vec3f middle{0, 0, b.height * 0.35f};
  ClotheShrub(layers, b, sites, middle, random);
  AddShoots(layers, b, sites, middle, random);
  return JoinLayers("shrub", layers);
}

// One metre of clipped hedge along X, 0.6 m deep: a shell of leaves around a dark core with stems below.
Model MakeHedge(uint32_t variant, uint64_t seed) {
  RngStream random(seed, "hedge");
  const float top = 1.05f, half_depth = 0.28f;
  std::vector<PlantLayer> layers = PlantLayers({0.15f, 0.12f, 0.09f}, ShrubLeaves());
  layers.push_back(LeafLayer(ShrubLeaves(), 0));
  layers[4].material.base_color = {0.30f, 0.30f, 0.30f};
  layers[4].material.name = "hedge core";
  for (int i = 0; i < 5; ++i) {
    std::vector<BranchNode> stem;
    const float x = -0.4f + 0.2f * static_cast<float>(i) + 0.05f * static_cast<float>(random.Normal());
    AddStem(stem, -1, {x, 0.05f * static_cast<float>(random.Normal()), -0.1f}, {x, 0, 0.6f}, 0.12f, 0.4f, random);
    Thicken(stem, 0.022f, 0.015f);
    AddBark(layers[0], stem, 0.001f, 0);
  }
  // The core keeps light from passing through; its faces are leaf-coloured and dark.
  const auto core = [&](Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
    const Vec3f n = Normalized(Cross(b - a, c - a));
    const uint32_t i = layers[4].Add(a, n, {0.02f, 0.9f});
    layers[4].Add(b, n, {0.10f, 0.9f});
    layers[4].Add(c, n, {0.10f, 0.1f});
    layers[4].Add(d, n, {0.02f, 0.1f});
    layers[4].triangles.insert(layers[4].triangles.end(), {{i, i + 1, i + 2}, {i, i + 2, i + 3}});
  };
  const float y = half_depth - 0.09f, z0 = 0.16f, z1 = top - 0.09f;
  core({-0.5f, -y, z0}, {0.5f, -y, z0}, {0.5f, -y, z1}, {-0.5f, -y, z1});
  core({0.5f, y, z0}, {-0.5f, y, z0}, {-0.5f, y, z1}, {0.5f, y, z1});
  core({-0.5f, -y, z1}, {0.5f, -y, z1}, {0.5f, y, z1}, {-0.5f, y, z1});
  core({0.48f, -y, z0}, {0.48f, y, z0}, {0.48f, y, z1}, {0.48f, -y, z1});
  core({-0.48f, y, z0}, {-0.48f, -y, z0}, {-0.48f, -y, z1}, {-0.48f, y, z1});
  // Leaves near the surface, uneven by a few centimetres; sparser low down.
  for (int k = 0; k < 9000; ++k) {
    const float x = static_cast<float>(random.Uniform(-0.5, 0.5)), s = static_cast<float>(random.Uniform(0, 2 * top + 2 * half_depth));
    Vec3f p, out;
    if (s < 2 * top) {
      const float hand = s < top ? -1.0f : 1.0f, z = s < top ? s : s - top;
      if (z < 0.30f && random.Chance(1 - z / 0.30f)) continue;
      p = {x, hand * half_depth, z};
      out = {0, hand, 0};
    } else {
      p = {x, s - 2 * top - half_depth, top};
      out = {0, 0, 1};
    }
    const float sunk = static_cast<float>(random.Uniform() * random.Uniform());
    const float swell = 0.10f * (Noise(p * 4.0f, seed) - 0.6f) - 0.07f * sunk;
    const float openness = (1 - 0.8f * sunk) * std::min(1.0f, 0.35f + p.z) + (s < 2 * top ? -0.1f : 0.1f);
    AddShrubLeaf(LeavesAt(layers, openness), p + out * swell, Normalized(out + RandomDirection(random) * 0.3f),
                 variant == 1 ? 0.045f : 0.055f, random);
  }
  // A thinner cover for the ends, which are seen only where a run of hedge stops.
  for (int k = 0; k < 1300; ++k) {
    const float hand = k % 2 ? 1.0f : -1.0f;
    const Vec3f p{0.47f * hand, static_cast<float>(random.Uniform(-0.27, 0.27)), static_cast<float>(random.Uniform(0.12, top))};
    AddShrubLeaf(layers[2], p, Normalized(Vec3f{hand, 0, 0} + RandomDirection(random) * 0.3f), 0.055f, random);
  }
  return JoinLayers("hedge", layers);
}

}  // namespace

std::vector<PropKind> ShrubKinds() {
  return {
      {"shrub", "vegetation/shrub/bush", 4, MakeShrub, 0.9f, 0.7f, 2.6f, 40000},
      {"hedge", "vegetation/hedge", 3, MakeHedge, 0.55f, 0.95f, 1.3f, 20000},
  };
}

}  // namespace airsim360::internal

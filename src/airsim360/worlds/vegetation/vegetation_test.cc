#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "airsim360/worlds/props/props.h"
#include "airsim360/worlds/vegetation/broadleaf_growth.h"
#include "airsim360/worlds/vegetation/plant_mesh.h"

namespace airsim360::internal {
namespace {

std::vector<Vec3f> BallOfAttractors(RngStream& random) {
  return ScatterInside(
      {-2, -2, 2}, {2, 2, 6}, 1500,
      [](Vec3f p) {
        return Norm(p - Vec3f{0, 0, 4}) < 2;
      },
      random);
}

std::vector<BranchNode> GrownTree(uint64_t seed) {
  RngStream random(seed, "test");
  const auto attractors = BallOfAttractors(random);
  std::vector<BranchNode> nodes;
  AddStem(nodes, -1, {0, 0, 0}, {0, 0, 3}, 0.2f, 0.1f, random);
  Colonise(nodes, attractors, {}, random);
  Thicken(nodes, 0.2f, 0.006f);
  return nodes;
}

TEST(ScatterInside, ReturnsPointsOfTheShapeOnly) {
  RngStream random(1, "scatter");
  const auto points = BallOfAttractors(random);
  EXPECT_EQ(points.size(), 1500u);
  for (Vec3f p : points) EXPECT_LT(Norm(p - Vec3f{0, 0, 4}), 2);
}

TEST(Colonise, ComesCloseToEveryAttractor) {
  RngStream random(1, "test");
  const auto attractors = BallOfAttractors(random);
  std::vector<BranchNode> nodes;
  AddStem(nodes, -1, {0, 0, 0}, {0, 0, 3}, 0.2f, 0.1f, random);
  const GrowthOptions options;
  Colonise(nodes, attractors, options, random);
  for (Vec3f a : attractors) {
    float nearest = 1e9f;
    for (const BranchNode& node : nodes) nearest = std::min(nearest, Norm(a - node.p));
    // Smoothing moves joints a little after they have been reached.
    EXPECT_LT(nearest, options.kill + options.step);
  }
}

TEST(Colonise, PutsParentsBeforeTheirChildrenAndKeepsSteps) {
  const auto nodes = GrownTree(2);
  for (size_t i = 1; i < nodes.size(); ++i) {
    ASSERT_GE(nodes[i].parent, 0);
    ASSERT_LT(nodes[i].parent, static_cast<int>(i));
    ASSERT_LT(Norm(nodes[i].p - nodes[static_cast<size_t>(nodes[i].parent)].p), 0.4f);
  }
}

TEST(Thicken, FollowsThePipeModel) {
  const auto nodes = GrownTree(3);
  EXPECT_NEAR(nodes[0].radius, 0.2f, 1e-4);
  // Tips add up, radii fall towards the tips, and r^n is conserved at every fork for the n that Thicken
  // chose.
  const double n = std::log(static_cast<double>(nodes[0].tips)) / std::log(0.2 / 0.006);
  EXPECT_GT(n, 1.1);
  EXPECT_LT(n, 2.6);
  std::vector<int> tips(nodes.size(), 0);
  std::vector<double> powers(nodes.size(), 0);
  for (size_t i = nodes.size(); i-- > 1;) {
    const auto parent = static_cast<size_t>(nodes[i].parent);
    ASSERT_LE(nodes[i].radius, nodes[parent].radius);
    tips[parent] += nodes[i].tips;
    powers[parent] += std::pow(nodes[i].radius, n);
  }
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (tips[i] == 0) {
      EXPECT_EQ(nodes[i].tips, 1);
      EXPECT_EQ(nodes[i].main, -1);
      continue;
    }
    EXPECT_EQ(nodes[i].tips, tips[i]);
    EXPECT_NEAR(std::pow(nodes[i].radius, n) / powers[i], 1, 1e-3);
  }
}

TEST(Noise, IsBetweenZeroAndOneAndContinuous) {
  for (int i = 0; i < 500; ++i) {
    const Vec3f p = Vec3f{0.173f, -0.291f, 0.117f} * static_cast<float>(i);
    const float a = Noise(p, 4), b = Noise(p + Vec3f{1e-3f, 1e-3f, -1e-3f}, 4);
    EXPECT_GE(a, 0);
    EXPECT_LE(a, 1);
    EXPECT_NEAR(a, b, 0.02);
  }
}

// Renderers of exported worlds take the side that corners turn around for the one that shading normals belong to.
TEST(AddBlade, CornersTurnAroundTheSideOfItsNormals) {
  RngStream random(5, "blades");
  PlantLayer layer;
  for (int i = 0; i < 200; ++i) {
    const Vec3f lean{static_cast<float>(random.Uniform(-0.8, 0.8)), static_cast<float>(random.Uniform(-0.8, 0.8)), 0};
    AddBlade(layer, {0, 0, 0}, 0.3f, 0.02f, lean, static_cast<float>(random.Uniform(0, 6.28)), i % 4);
  }
  ASSERT_EQ(layer.triangles.size(), 600u);
  for (const Vec3u t : layer.triangles) {
    const Vec3f a = layer.positions[t.x], facet = Cross(layer.positions[t.y] - a, layer.positions[t.z] - a);
    EXPECT_GT(layer.shading_normals[t.x].z, 0);
    EXPECT_GT(Dot(facet, layer.shading_normals[t.x]), 0);
  }
}

TEST(AddLeaf, LiesAlongItsDirectionWithItsFaceUp) {
  PlantLayer layer;
  AddLeaf(layer, {1, 2, 3}, {1, 0, 0}, {0, 0, 1}, {0.2f, 0.1f, 0, 0}, 0);
  ASSERT_EQ(layer.positions.size(), 4u);
  ASSERT_EQ(layer.triangles.size(), 2u);
  EXPECT_NEAR(layer.positions[2].x, 1.2, 1e-6);
  for (Vec3f n : layer.shading_normals) EXPECT_NEAR(n.z, 1, 1e-6);
  double area = 0;
  for (Vec3u t : layer.triangles) {
    const Vec3f n = Cross(layer.positions[t.y] - layer.positions[t.x], layer.positions[t.z] - layer.positions[t.x]);
    EXPECT_GT(n.z, 0);
    area += Norm(n) / 2;
  }
  EXPECT_NEAR(area, 0.5 * 0.2 * 0.1, 1e-6);
}

// Triangles of foliage of a tree, and the box around them.
std::pair<size_t, Box3f> Foliage(const Model& model) {
  size_t triangles = 0;
  Box3f box;
  for (const MeshPart& part : model.mesh.parts) {
    if (model.materials[part.material].kind != SurfaceKind::kFoliage) continue;
    triangles += part.triangle_count;
    for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
      const Vec3u t = model.mesh.triangles[k];
      for (uint32_t i : {t.x, t.y, t.z}) box.Add(model.mesh.positions[i]);
    }
  }
  return {triangles, box};
}

// Hue in degrees of the mean colour of a picture of leaves, as a screen shows it.
double HueOf(const Texture& leaves) {
  Vec3d sum;
  for (const Rgba8 c : leaves.levels[0].pixels())
    sum = sum + Vec3d{static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)};
  EXPECT_GT(sum.y, sum.x);
  EXPECT_GT(sum.x, sum.z);
  return 120 - 60 * (sum.x - sum.z) / (sum.y - sum.z);
}

// On photographs of a park and of a forest the hues of leaves by day have medians of 69 to 73 degrees and quartiles from 60
// to 81 (distant crowns in side light, backlit broadleaves, shrubs). Pictures of ours that were 80 to 87 looked too green.
TEST(LeafColors, LieAmongThoseOfPhotographs) {
  for (const char* name : {"tree_generic", "tree_narrowleaf", "shrub"}) {
    const PropKind& kind = FindPropKind(name);
    for (int v = 0; v < 2; ++v) {
      const Model plant = MakeProp(kind, static_cast<uint32_t>(v), 1, nullptr);
      int pictures = 0;
      for (const Texture& t : plant.textures) {
        if (!t.name.starts_with("leaves")) continue;
        ++pictures;
        EXPECT_GT(HueOf(t), 60) << t.name;
        EXPECT_LT(HueOf(t), 81) << t.name;
      }
      EXPECT_EQ(pictures, 1) << name;
    }
  }
}

// Most leaves of street trees are 4 to 12 cm long, and no two neighbours alike.
TEST(LeafSizes, AreThoseOfStreetTrees) {
  for (const char* name : {"tree_generic", "tree_narrowleaf"}) {
    const Model tree = MakeProp(FindPropKind(name), 0, 1, nullptr);
    std::vector<double> lengths;
    for (const MeshPart& part : tree.mesh.parts) {
      if (tree.materials[part.material].kind != SurfaceKind::kFoliage) continue;
      // Two triangles a leaf, both from its base to its tip.
      for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; k += 2) {
        const Vec3u t = tree.mesh.triangles[k];
        lengths.push_back(Norm(tree.mesh.positions[t.z] - tree.mesh.positions[t.x]));
      }
    }
    ASSERT_GT(lengths.size(), 20000u) << name;
    std::ranges::sort(lengths);
    const auto at = [&](double share) { return lengths[static_cast<size_t>(share * static_cast<double>(lengths.size()))]; };
    EXPECT_GT(at(0.05), 0.04) << name;
    EXPECT_LT(at(0.95), 0.135) << name;
    EXPECT_GT(at(0.95) / at(0.05), 1.7) << name;
  }
}

// A crown is not a closed egg: limbs carry masses of leaves with sky between, each light above and dark below.
TEST(Crown, IsMadeOfMassesWithGapsBetween) {
  const BroadleafSpecies s{.name = "test",
                           .height = 10,
                           .clear_trunk = 2.5f,
                           .crown_radius = 4,
                           .trunk_radius = 0.2f,
                           .leader = 0.5f,
                           .lobes = 17,
                           .lobe_radius = 0.30f,
                           .attractors = 1,
                           .growth = {},
                           .leaf = {},
                           .leaves = 1,
                           .clumping = 0,
                           .bark = {}};
  for (uint64_t seed : {1, 2, 3}) {
    RngStream random(seed, "crown");
    const Crown crown(s, random);
    int inside = 0, all = 0, dips = 0;
    for (int i = 0; i < 40000; ++i) {
      const Vec3f d = RandomDirection(random) * std::cbrt(static_cast<float>(random.Uniform()));
      const Vec3f p = crown.center() + Vec3f{4 * d.x, 4 * d.y, 3.75f * d.z};
      ++all;
      inside += crown.Contains(p);
      // Openness falls somewhere on the way up: from the top of one mass to the bottom of the next.
      dips += d.z > 0 && crown.Openness(p + Vec3f{0, 0, 0.4f}) < crown.Openness(p) - 0.1f;
    }
    EXPECT_GT(inside, 0.25 * all) << seed;
    EXPECT_LT(inside, 0.65 * all) << seed;
    EXPECT_GT(dips, 0.01 * all) << seed;
  }
}

struct Proportions {
  const char* kind;
  double min_slender, max_slender;  // height of the tree over the width of its crown
  size_t min_foliage;
};

void PrintTo(const Proportions& proportions, std::ostream* out) { *out << proportions.kind; }

class Trees : public testing::TestWithParam<Proportions> {};

INSTANTIATE_TEST_SUITE_P(Species, Trees,
                         testing::Values(Proportions{"tree_generic", 0.9, 1.8, 20000}, Proportions{"tree_narrowleaf", 1.8, 3.6, 40000},
                                         Proportions{"tree_pine", 1.6, 3.6, 60000}),
                         [](const auto& info) { return std::string(info.param.kind); });

TEST_P(Trees, HaveTheProportionsOfTheirSpecies) {
  const PropKind& kind = FindPropKind(GetParam().kind);
  EXPECT_GE(kind.variants, 4);
  for (uint64_t seed : {1, 2}) {
    for (int v = 0; v < kind.variants; ++v) {
      const Model tree = MakeProp(kind, static_cast<uint32_t>(v), seed, nullptr);
      const auto [leaves, crown] = Foliage(tree);
      EXPECT_GE(leaves, GetParam().min_foliage) << "variant " << v;
      const double width = 0.5 * (crown.size().x + crown.size().y), slender = crown.max.z / width;
      EXPECT_GE(slender, GetParam().min_slender) << "variant " << v;
      EXPECT_LE(slender, GetParam().max_slender) << "variant " << v;
      // The crown stands over the trunk, and there is a trunk below it.
      EXPECT_LT(std::hypot(crown.center().x, crown.center().y), 0.2 * width) << "variant " << v;
      EXPECT_GT(crown.min.z, 0.2) << "variant " << v;
    }
  }
}

}  // namespace
}  // namespace airsim360::internal

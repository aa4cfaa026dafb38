// Vertex colours, and what they cover, are the CPU's in every tier.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "airsim360/render/frame/test_colors.h"
#include "color_compare.h"

namespace airsim360 {
namespace {

using namespace test;

TEST(GpuVertexColors, AreTheCpusInEveryTier) {
  AIRSIM360_NEEDS_GPU();
  const auto scene = MakeColoredSquare();
  for (const Tier tier : {Tier::kFast, Tier::kHigh, Tier::kReference}) {
    Pair pair(scene, scene->environment, tier);
    RenderRequest request = ColorRequest(*scene, 64);
    request.tier = tier;
    request.samples = tier == Tier::kReference ? 4 : 0;
    request.edge_samples = 1;
    request.products.position = true;
    Frame cpu, gpu;
    pair.cpu->Render(request, cpu);
    pair.gpu->Render(request, gpu);
    const ColorDifference d = Difference(cpu, gpu);
    std::printf("tier %d: mean %.3f of 255, %.2f %% of pixels off by more than 3\n", static_cast<int>(tier), d.mean, 100 * d.off);
    EXPECT_LE(d.mean, tier == Tier::kFast ? 0.1 : 1);
    EXPECT_LE(d.off, tier == Tier::kFast ? 0.005 : 0.05);
    int checked = 0, covered = 0;
    for (size_t i = 0; i < gpu.entity.size(); ++i) {
      const EntityId entity = gpu.entity.pixels()[i];
      if (entity == scene->sky_entity || entity != cpu.entity.pixels()[i]) continue;
      const Rgb32f a = cpu.albedo.pixels()[i], b = gpu.albedo.pixels()[i];
      EXPECT_NEAR(a.r, b.r, 2e-4);
      EXPECT_NEAR(a.g, b.g, 2e-4);
      EXPECT_NEAR(a.b, b.b, 2e-4);
      const Material& material = scene->materials[scene->meshes[scene->instances[entity - 1].mesh].parts[0].material];
      covered += material.alpha_mode == AlphaMode::kMask;
      if (material.kind == SurfaceKind::kGlass) continue;
      const auto truth = ColorAt(*scene, entity - 1, VecCast<double>(gpu.position.pixels()[i]));
      ASSERT_TRUE(truth);
      EXPECT_NEAR(b.g, truth->y, 5e-4);
      ++checked;
    }
    EXPECT_GT(checked, 700);
    EXPECT_GT(covered, 5);
    int labels = 0;
    for (size_t i = 0; i < gpu.entity.size(); ++i) labels += gpu.entity.pixels()[i] != cpu.entity.pixels()[i];
    EXPECT_LE(labels, 6);  // instances that share a mesh lie in one place, where a ray may meet either
    for (const std::string& message : pair.gpu->messages()) ADD_FAILURE() << message;
  }
}

}  // namespace
}  // namespace airsim360

// Vertex colours in every tier, against the closed form and against the same colours as materials.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "airsim360/render/frame/test_colors.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

using namespace test;

Frame Rendered(const std::shared_ptr<const Scene>& scene, Tier tier, int width, int samples = 1) {
  const auto renderer = MakeCpuRenderer(std::make_shared<const RayTracer>(scene), {.tier = tier});
  RenderRequest request;
  request.camera = Equirectangular{width, width / 2};
  request.X_WC = BodyPose({0.1, 0.2, 2.1}, 0.4, -0.1, 0.05) * CameraInBody();
  request.tier = tier;
  request.products = {.rgb = tier != Tier::kLabels, .entity = true, .position = true, .albedo = true, .radiance = tier != Tier::kLabels};
  request.samples = samples;
  Frame frame;
  renderer->Render(request, frame);
  return frame;
}

TEST(VertexColors, AlbedoIsTheMixOfTheCornersInEveryTier) {
  const auto scene = MakeColoredSquare();
  for (const Tier tier : {Tier::kLabels, Tier::kFast, Tier::kHigh, Tier::kReference}) {
    const Frame frame = Rendered(scene, tier, 128);
    int checked[2] = {}, kinds[2] = {};
    for (size_t i = 0; i < frame.entity.size(); ++i) {
      const EntityId entity = frame.entity.pixels()[i];
      if (entity == scene->sky_entity) continue;
      const Mesh& mesh = scene->meshes[scene->instances[entity - 1].mesh];
      const Material& material = scene->materials[mesh.parts[0].material];
      if (material.kind == SurfaceKind::kGlass) continue;  // with blinds
      const auto truth = ColorAt(*scene, entity - 1, VecCast<double>(frame.position.pixels()[i]));
      ASSERT_TRUE(truth) << entity;
      const Rgb32f seen = frame.albedo.pixels()[i];
      const bool picture = material.base_color_texture != kNoTexture;
      const double tolerance = picture ? 5e-4 : 2e-5;  // of the approximate decoding of pictures; of the position
      EXPECT_NEAR(seen.r, truth->x, tolerance) << entity;
      EXPECT_NEAR(seen.g, truth->y, tolerance) << entity;
      EXPECT_NEAR(seen.b, truth->z, tolerance) << entity;
      ++checked[picture ? 1 : 0];
      ++kinds[mesh.colors.empty() ? 1 : 0];
    }
    EXPECT_GT(std::min({checked[0], checked[1], kinds[0], kinds[1]}), 150);
  }
}

// Red, green and blue corners of one triangle that fills half the view, to 1/255 in sRGB's linear light.
TEST(VertexColors, OfATriangleRunFromCornerToCorner) {
  SceneBuilder builder("triangle");
  Material white;
  white.base_color = {1, 1, 1};
  Mesh mesh{"triangle", {{-4, -3, 0}, {4, -3, 0}, {0, 4, 0}}, {}, {}, {{0, 1, 2}}, {}};
  mesh.parts = {{0, 1, builder.AddMaterial(white), kNoEntity}};
  mesh.colors = {{65535, 0, 0}, {0, 65535, 0}, {0, 0, 65535}};
  builder.AddInstance({builder.AddMesh(mesh), {}, builder.AddEntity("t", builder.tree().At("furniture"))});
  builder.SetInteriorLight({1, 1, 1});
  const auto scene = builder.Build();
  for (const Tier tier : {Tier::kLabels, Tier::kFast, Tier::kHigh, Tier::kReference}) {
    const Frame frame = Rendered(scene, tier, 64);
    int count = 0;
    for (size_t i = 0; i < frame.entity.size(); ++i) {
      if (frame.entity.pixels()[i] == kNoEntity) continue;
      const Vec3f p = frame.position.pixels()[i];
      const float blue = (p.y + 3) / 7, green = (p.x + 4 * (1 - blue)) / 8;
      const Rgb32f seen = frame.albedo.pixels()[i];
      EXPECT_NEAR(seen.r, 1 - blue - green, 1e-5);
      EXPECT_NEAR(seen.g, green, 1e-5);
      EXPECT_NEAR(seen.b, blue, 1e-5);
      ++count;
    }
    EXPECT_GT(count, 300);
  }
}

// The scene with all colours of its vertices replaced.
std::shared_ptr<const Scene> Painted(const Scene& scene, std::optional<VertexColor> color) {
  auto painted = std::make_shared<Scene>(scene);
  for (Mesh& mesh : painted->meshes) {
    if (color) {
      mesh.colors.assign(mesh.positions.size(), *color);
    } else {
      mesh.colors.clear();
    }
  }
  return painted;
}

// In even light a surface shows what its skin reflects plus its colour times what its body gives back.
TEST(VertexColors, LightGivenBackEvenlyGrowsInProportion) {
  auto lit = std::make_shared<Scene>(*MakeColoredSquare());
  lit->sky_entity = kNoEntity;
  lit->interior_light = {1, 0.9f, 0.8f};
  for (Material& material : lit->materials) {
    material.kind = SurfaceKind::kStandard;
    material.alpha_mode = AlphaMode::kOpaque;
    material.base_color = {1, 1, 1};
    material.base_color_texture = kNoTexture;
  }
  for (Instance& instance : lit->instances) instance.tint = {1, 1, 1};
  const Frame black = Rendered(Painted(*lit, VertexColor{0, 0, 0}), Tier::kFast, 96),
              white = Rendered(Painted(*lit, VertexColor{}), Tier::kFast, 96), seen = Rendered(lit, Tier::kFast, 96);
  int count = 0;
  for (size_t i = 0; i < seen.entity.size(); ++i) {
    if (seen.entity.pixels()[i] == kNoEntity) continue;
    const Rgb32f a = seen.albedo.pixels()[i], l = seen.radiance.pixels()[i], low = black.radiance.pixels()[i],
                 high = white.radiance.pixels()[i];
    EXPECT_NEAR(l.r, low.r + a.r * (high.r - low.r), 2e-4);
    EXPECT_NEAR(l.g, low.g + a.g * (high.g - low.g), 2e-4);
    EXPECT_NEAR(l.b, low.b + a.b * (high.b - low.b), 2e-4);
    EXPECT_GT(high.g - low.g, 0.2);
    ++count;
  }
  EXPECT_GT(count, 2000);
}

// Rooms that glow by themselves are as bright with a sky, which is a label alone.
TEST(VertexColors, AreLitTheSameWhereTheSkyIsANameAlone) {
  auto closed = std::make_shared<Scene>(*MakeColoredSquare());
  const EntityId sky = closed->sky_entity;
  closed->interior_light = {0.02f, 0.02f, 0.02f};
  const auto open = std::make_shared<Scene>(*closed);
  closed->sky_entity = kNoEntity;
  for (const Tier tier : {Tier::kFast, Tier::kHigh, Tier::kReference}) {
    const Frame a = Rendered(closed, tier, 64), b = Rendered(open, tier, 64);
    int seen = 0, holes = 0;
    for (size_t i = 0; i < a.entity.size(); ++i) {
      if (a.entity.pixels()[i] == kNoEntity) {
        EXPECT_EQ(b.entity.pixels()[i], sky);
        ++holes;
      } else {
        EXPECT_EQ(a.radiance.pixels()[i].g, b.radiance.pixels()[i].g);
        ++seen;
      }
    }
    EXPECT_GT(seen, 1000);
    EXPECT_GT(holes, 100);
  }
}

TEST(VertexColors, ThatAreWhiteChangeNoByte) {
  const auto scene = MakeColoredSquare();
  const Frame none = Rendered(Painted(*scene, std::nullopt), Tier::kFast, 96),
              white = Rendered(Painted(*scene, VertexColor{}), Tier::kFast, 96);
  EXPECT_EQ(none.rgb, white.rgb);
  EXPECT_EQ(none.albedo, white.albedo);
  EXPECT_NE(none.albedo, Rendered(scene, Tier::kFast, 96).albedo);
}

// One colour at all vertices is that colour in the material: in direct light, in what bounces (probes, ambient rays,
// paths) and in what panes let through.
TEST(VertexColors, ThatAreAllAlikeAreTheMaterials) {
  const VertexColor color{50000, 20000, 9000};
  const auto scene = MakeColoredSquare();
  const auto vertices = Painted(*scene, color);
  auto materials = std::make_shared<Scene>(*Painted(*scene, std::nullopt));
  for (Material& material : materials->materials) material.base_color = material.base_color * LinearColor(color);
  for (const auto& [tier, samples] : {std::pair(Tier::kFast, 1), std::pair(Tier::kHigh, 2), std::pair(Tier::kReference, 2)}) {
    const Frame a = Rendered(vertices, tier, 96, samples), b = Rendered(materials, tier, 96, samples);
    int off = 0;
    for (size_t i = 0; i < a.rgb.size(); ++i) {
      const Rgb8 p = a.rgb.pixels()[i], q = b.rgb.pixels()[i];
      off += std::max({std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)}) > 1 ? 1 : 0;
    }
    EXPECT_LE(off, 5) << static_cast<int>(tier);  // rounding tips a choice of a ray here and there
  }
}

}  // namespace
}  // namespace airsim360

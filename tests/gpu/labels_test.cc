// Labels of the GPU are those of the CPU, through every camera.
#include <gtest/gtest.h>

#include "airsim360/math/angles.h"
#include "airsim360/render/frame/test_room.h"
#include "airsim360/worlds/worlds.h"
#include "gpu_fixture.h"

namespace airsim360 {
namespace {

using test::Compare;
using test::LabelDifference;

RenderRequest LabelRequest(const Camera& camera, const RigidTransform& X_WC) {
  RenderRequest request;
  request.camera = camera;
  request.X_WC = X_WC;
  request.tier = Tier::kLabels;
  request.products = {.rgb = false, .normal = true, .position = true, .material = true};
  return request;
}

struct LabelPair {
  std::shared_ptr<const RayTracer> tracer;
  std::unique_ptr<Renderer> cpu;
  std::unique_ptr<GpuRenderer> gpu;

  explicit LabelPair(std::shared_ptr<const Scene> scene)
      : tracer(std::make_shared<const RayTracer>(std::move(scene), RayTracerOptions{.isa = "avx2"})),
        cpu(MakeCpuRenderer(tracer)),
        gpu(MakeVulkanRenderer(tracer, {}, {.validate = test::ValidationInstalled()})) {}
};

// 0.02 per cent of the pixels, each within a pixel of an edge; range to 1e-5.
void ExpectSameLabels(const LabelDifference& d, const std::string& what) {
  std::printf("%s: %d of %d labels differ (%d far from edges), range %.2g, normal %.2g over %d pixels\n", what.c_str(), d.different,
              d.pixels, d.far, d.range, d.normal, d.off_edges);
  EXPECT_LE(d.different, std::max(1.0, 2e-4 * d.pixels)) << what;
  EXPECT_EQ(d.far, 0) << what;
  EXPECT_LE(d.range, 1e-5) << what;
  EXPECT_LE(d.normal, 2e-4) << what;
  EXPECT_GT(d.off_edges, d.pixels / 10) << what;
}

TEST(GpuLabels, AreTheCpusThroughEveryCamera) {
  AIRSIM360_NEEDS_GPU();
  LabelPair pair(test::MakeRoom());
  RngStream rng(3, "gpu");
  std::vector<Camera> cameras{Equirectangular{128, 64},
                              CubeFace{CubeFaceName::kNegX, 64},
                              CubeFace{CubeFaceName::kPosY, 48},
                              Pinhole{100, 60, 70, 65, 51, 29},
                              Fisheye::Equidistant(64, 64, kPi * 1.1),
                              Fisheye{80, 64, 20, 20, 40, 32, {0.01, -0.002, 0, 0}, 1.5}};
  for (const Camera& lens : test::CalibratedLenses()) cameras.push_back(lens);
  for (const Camera& camera : cameras) {
    const RenderRequest request = LabelRequest(camera, test::RandomPose(rng));
    Frame cpu, gpu;
    pair.cpu->Render(request, cpu);
    pair.gpu->Render(request, gpu);
    ExpectSameLabels(Compare(cpu, gpu, camera.index() == 0), "camera " + std::to_string(camera.index()));
    EXPECT_EQ(cpu.rgb.size(), gpu.rgb.size());
    for (size_t i = 0; i < cpu.position.size(); ++i) {
      if (cpu.entity.pixels()[i] != gpu.entity.pixels()[i]) continue;
      ASSERT_LE(Norm(cpu.position.pixels()[i] - gpu.position.pixels()[i]), 1e-3f);
      ASSERT_EQ(cpu.material.pixels()[i], gpu.material.pixels()[i]);
    }
  }
  for (const std::string& message : pair.gpu->messages()) ADD_FAILURE() << message;
}

TEST(GpuLabels, AreTheClosedFormOfTheRoom) {
  AIRSIM360_NEEDS_GPU();
  LabelPair pair(test::MakeRoom());
  RngStream rng(4, "gpu");
  const Equirectangular camera{128, 64};
  const RenderRequest request = LabelRequest(camera, test::RandomPose(rng));
  Frame frame;
  pair.gpu->Render(request, frame);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Vec3d d = request.X_WC.R * *PixelToRay(camera, {x + 0.5, y + 0.5});
      if (!test::FarFromEdges(request.X_WC.p, d)) continue;
      const test::Truth truth = test::Look(request.X_WC.p, d);
      ASSERT_EQ(frame.entity(x, y), truth.entity) << x << ' ' << y;
      ASSERT_NEAR(frame.range(x, y), truth.range, 1e-5 * truth.range);
      ASSERT_LE(Norm(VecCast<double>(frame.normal(x, y)) - truth.normal), 1e-5);
    }
  }
}

// The same rays through pixels on silhouettes; one that hits an edge may fall to either side.
TEST(GpuLabels, SharesOfEntitiesInAPixelAreTheCpusThroughEveryCamera) {
  AIRSIM360_NEEDS_GPU();
  LabelPair pair(test::MakeRoom());
  RngStream rng(5, "gpu");
  std::vector<Camera> cameras{Equirectangular{128, 64}, CubeFace{CubeFaceName::kNegY, 64}, Pinhole{100, 60, 70, 65, 51, 29},
                              Fisheye{80, 64, 20, 20, 40, 32, {0.01, -0.002, 0, 0}, 1.5}};
  for (const Camera& lens : test::CalibratedLenses()) cameras.push_back(lens);
  int edges = 0;
  for (const Camera& camera : cameras) {
    RenderRequest request = LabelRequest(camera, test::RandomPose(rng));
    request.products.coverage = true, request.products.entity = camera.index() % 2 == 0;
    request.edge_samples = 16;
    Frame cpu, gpu;
    pair.cpu->Render(request, cpu);
    pair.gpu->Render(request, gpu);
    ASSERT_EQ(cpu.coverage.size(), gpu.coverage.size());
    EXPECT_EQ(gpu.entity.empty(), !request.products.entity);
    int here = 0, different = 0;
    for (size_t i = 0; i < cpu.coverage.size(); ++i) {
      const CoveragePixel &a = cpu.coverage.pixels()[i], &b = gpu.coverage.pixels()[i];
      here += a.share[1] > 0;
      bool same = true;
      for (int k = 0; k < CoveragePixel::kEntities; ++k)
        same = same && a.entity[k] == b.entity[k] && std::fabs(a.share[k] - b.share[k]) < 1e-6f;
      different += !same;
    }
    std::printf("camera %zu: shares differ in %d pixels, %d show several entities\n", camera.index(), different, here);
    EXPECT_LE(different, std::max(2, here / 50));
    edges += here;
  }
  EXPECT_GT(edges, 300);
  for (const std::string& message : pair.gpu->messages()) ADD_FAILURE() << message;
}

RenderRequest FromSpawn(const Scene& scene) {
  const Vec3f spawn = scene.spawn.value_or(Vec3f{0, 0, 2});
  return LabelRequest(Equirectangular{256, 128}, BodyPose(VecCast<double>(spawn) + Vec3d{0.1, 0.2, 0.3}, 0.4, -0.1, 0.05) * CameraInBody());
}

void ExpectTheCpus(const std::shared_ptr<const Scene>& scene, const RenderRequest& request) {
  LabelPair pair(scene);
  Frame cpu, gpu;
  pair.cpu->Render(request, cpu);
  pair.gpu->Render(request, gpu);
  ExpectSameLabels(Compare(cpu, gpu, true), scene->name);
  for (const std::string& message : pair.gpu->messages()) ADD_FAILURE() << message;
}

TEST(GpuLabels, OfFurnishedRoomsAreTheCpus) {
  AIRSIM360_NEEDS_GPU();
  for (const char* world : {"box_room", "sunlit_room"}) {
    const auto scene = BuildWorld(world, {.seed = 1});
    ExpectTheCpus(scene, FromSpawn(*scene));
  }
}

TEST(GpuLabels, OfWorldsAskedForAreTheCpus) {
  AIRSIM360_NEEDS_GPU();
  const std::vector<std::string> worlds = test::WorldsAskedFor();
  if (worlds.empty()) GTEST_SKIP() << "AIRSIM360_GPU_WORLDS names no world";
  for (const std::string& world : worlds) {
    const auto scene = test::WorldOf(world);
    ExpectTheCpus(scene, FromSpawn(*scene));
  }
}

// Cards of leaves around the camera: triangles that are holes all over, in part, and nowhere, in every wrap mode.
std::shared_ptr<const Scene> MakeLeaves() {
  SceneBuilder builder("leaves");
  const CategoryId plant = builder.tree().At("construction/building");
  RngStream rng(7, "leaves");
  std::vector<MaterialId> materials;
  for (const Wrap wrap : {Wrap::kRepeat, Wrap::kMirror, Wrap::kClamp}) {
    Image<Rgba8> image(37, 22);
    for (int y = 0; y < 22; ++y) {
      for (int x = 0; x < 37; ++x)
        image(x, y).a = static_cast<uint8_t>(std::clamp(128 + 300 * std::sin(0.5 * x) * std::cos(0.7 * y), 0.0, 255.0));
    }
    Texture texture = Texture::FromImage("alpha", image, true);
    texture.wrap_u = wrap, texture.wrap_v = wrap;
    Material material;
    material.alpha_mode = AlphaMode::kMask;
    material.base_color_texture = builder.AddTexture(texture);
    material.uv_scale = {1.5f, 0.8f}, material.uv_rotation = 0.3f;
    materials.push_back(builder.AddMaterial(material));
  }
  materials.push_back(builder.AddMaterial({}));
  Mesh mesh{"leaves", {}, {}, {}, {}, {}};
  for (uint32_t i = 0; i < 400; ++i) {
    const auto at = [&] { return static_cast<float>(rng.Uniform(-6, 6)); };
    const auto side = [&] { return static_cast<float>(rng.Uniform(-1.2, 1.2)); };
    const Vec3f p{at(), at(), at()}, u{side(), side(), side()}, v{side(), side(), side()};
    if (Norm(p) < 2) continue;
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    const float big = static_cast<float>(rng.Uniform(0.1, 3));
    mesh.positions.insert(mesh.positions.end(), {p, p + u, p + v, p + u + v});
    mesh.uvs.insert(mesh.uvs.end(), {{0, 0}, {big, 0}, {0, big}, {big, big}});
    const auto triangle = static_cast<uint32_t>(mesh.triangles.size());
    mesh.triangles.insert(mesh.triangles.end(), {{first, first + 1, first + 2}, {first + 1, first + 3, first + 2}});
    mesh.parts.push_back({triangle, 2, materials[i % materials.size()], builder.AddEntity("leaf", plant)});
  }
  const MeshId id = builder.AddMesh(mesh);
  builder.AddInstance({id, PlaceUpright({0, 0, 0}, 0.5f, 1.1f), kNoEntity});
  builder.AddInstance({id, PlaceUpright({3, 2, 1}, 1.5f, 0.9f), kNoEntity});
  builder.AddSky();
  return builder.Build();
}

TEST(GpuLabels, OfLeavesWithHolesAreTheCpus) {
  AIRSIM360_NEEDS_GPU();
  ExpectTheCpus(MakeLeaves(), LabelRequest(Equirectangular{256, 128}, BodyPose({0, 0, 0}, 0.3, 0.1, 0) * CameraInBody()));
}

TEST(GpuLabels, RollWithACameraTurnedByColumns) {
  AIRSIM360_NEEDS_GPU();
  LabelPair pair(test::MakeOpenSquare());
  const RigidTransform level = BodyPose({0.5, 0.25, 2}, 0.3, 0.2, -0.1) * CameraInBody();
  RenderRequest request = LabelRequest(Equirectangular{64, 32}, level);
  Frame still, turned;
  pair.gpu->Render(request, still);
  request.X_WC.R = level.R * RotationY(5 * 2 * kPi / 64);
  pair.gpu->Render(request, turned);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      ASSERT_EQ(turned.range(x, y), still.range((x + 5) % 64, y));
      ASSERT_EQ(turned.entity(x, y), still.entity((x + 5) % 64, y));
    }
  }
}

}  // namespace
}  // namespace airsim360

// Products beyond labels, against closed forms and second methods.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

using namespace test;

constexpr Products kAll{.rgb = false,
                        .range = true,
                        .semantic = true,
                        .entity = true,
                        .normal = true,
                        .position = true,
                        .albedo = true,
                        .material = true,
                        .coverage = true,
                        .flow = true};

std::unique_ptr<Renderer> CpuRendererOf(std::shared_ptr<const Scene> scene) {
  return MakeCpuRenderer(std::make_shared<const RayTracer>(std::move(scene)));
}

RenderRequest Request(const Camera& camera, const RigidTransform& X_WC, const RigidTransform& X_WC_next) {
  RenderRequest request = MakeRequest(camera, X_WC, Tier::kLabels, kAll);
  request.X_WC_next = X_WC_next;
  return request;
}

Frame Rendered(Renderer& renderer, const RenderRequest& request) {
  Frame frame;
  renderer.Render(request, frame);
  return frame;
}

RigidTransform Pose(Vec3d p, double yaw, double pitch = 0, double roll = 0) { return BodyPose(p, yaw, pitch, roll) * CameraInBody(); }

// Whether the 3 x 3 pixels around show one entity; the panorama wraps.
bool OffEdge(const Image<EntityId>& entity, int x, int y) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int u = (x + dx + entity.width()) % entity.width(), v = std::clamp(y + dy, 0, entity.height() - 1);
      if (entity(u, v) != entity(x, y)) return false;
    }
  }
  return true;
}

// Level ground of slabs of 1.6 m with joints of 10 cm, 200 m to every side.
std::shared_ptr<const Scene> MakePaving() {
  SceneBuilder builder("paving");
  builder.AddSky();
  Image<Rgba8> picture(128, 128);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) picture(x, y) = x < 8 || y < 8 ? Rgba8{60, 60, 60, 255} : Rgba8{190, 190, 190, 255};
  Material slabs;
  slabs.base_color_texture = builder.AddTexture(Texture::FromImage("slabs", std::move(picture), true));
  Mesh mesh;
  mesh.positions = {{-200, -200, 0}, {200, -200, 0}, {200, 200, 0}, {-200, 200, 0}};
  mesh.uvs = {{0, 250}, {250, 250}, {250, 0}, {0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.parts = {{0, 2, builder.AddMaterial(slabs), kNoEntity}};
  builder.AddInstance({builder.AddMesh(std::move(mesh)), AffineTransform(), builder.AddEntity("ground", builder.tree().At("ground"))});
  return builder.Build();
}

// Standard deviation along a row over its mean, of means of blocks of `block` x `block` pixels.
double ContrastOfRow(const Image<Rgb32f>& albedo, int row, int block) {
  const int count = albedo.width() / block;
  double sum = 0, square = 0;
  for (int i = 0; i < count; ++i) {
    double mean = 0;
    for (int y = 0; y < block; ++y)
      for (int x = 0; x < block; ++x) mean += static_cast<double>(albedo(i * block + x, row * block + y).g) / (block * block);
    sum += mean / count, square += mean * mean / count;
  }
  return std::sqrt(std::max(0.0, square - sum * sum)) / sum;
}

// From a person's eyes: what a pixel shows of joints 10 and 30 m away, beside the mean of 16 smaller ones.
TEST(Products, JointsOfPavingKeepTheirContrastInTierHigh) {
  const auto renderer = CpuRendererOf(MakePaving());
  const RigidTransform X_WC = Pose({0.3, 0.2, 1.6}, 0.4);
  constexpr Products kAlbedo{.rgb = false, .albedo = true};
  constexpr int kHeight = 512, kFiner = 4;
  const auto albedo = [&](Tier tier, int finer) {
    return Rendered(*renderer, MakeRequest(Equirectangular{2 * kHeight * finer, kHeight * finer}, X_WC, tier, kAlbedo)).albedo;
  };
  const Image<Rgb32f> high = albedo(Tier::kHigh, 1), once = albedo(Tier::kLabels, 1), truth = albedo(Tier::kLabels, kFiner);
  for (double distance : {10.0, 30.0}) {
    const int row = kHeight / 2 + static_cast<int>(std::atan(1.6 / distance) / std::numbers::pi * kHeight);
    const double should = ContrastOfRow(truth, row, kFiner), now = ContrastOfRow(high, row, 1), before = ContrastOfRow(once, row, 1);
    EXPECT_LT(std::abs(now / should - 1), 0.5 * std::abs(before / should - 1))
        << distance << " m: " << should << ", high " << now << ", other tiers " << before;
    EXPECT_GT(now, (distance < 20 ? 0.85 : 0.5) * should) << distance << " m: " << should << ", other tiers " << before;
  }
}

TEST(Products, PositionIsTheEndOfTheRayAndLiesOnTheSurface) {
  const auto renderer = CpuRendererOf(MakeRoom());
  RngStream rng(1, "products");
  const Equirectangular camera{128, 64};
  for (int i = 0; i < 5; ++i) {
    const RigidTransform X_WC = RandomPose(rng);
    const Frame frame = Rendered(*renderer, Request(camera, X_WC, X_WC));
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 128; ++x) {
        const Vec3d d = X_WC.R * *PixelToRay(camera, {x + 0.5, y + 0.5});
        const Vec3d p = VecCast<double>(frame.position(x, y));
        EXPECT_LT(Norm(p - (X_WC.p + d * static_cast<double>(frame.range(x, y)))), 4e-6) << x << ' ' << y;
        if (frame.entity(x, y) > 6) continue;
        // Walls: one coordinate is that of the wall.
        const int k = static_cast<int>(frame.entity(x, y) - 1) / 2;
        const double wall = (frame.entity(x, y) - 1) % 2 != 0 ? kRoomMax[k] : kRoomMin[k];
        EXPECT_NEAR(p[k], wall, 4e-6);
      }
    }
  }
}

TEST(Products, AlbedoAndMaterialAreThoseOfTheSurfaceInEveryTier) {
  const auto scene = MakeRoom();
  const auto renderer = CpuRendererOf(scene);
  RenderRequest request = Request(Equirectangular{128, 64}, Pose({0, 0, 2}, 0.3), Pose({0, 0, 2}, 0.3));
  const Frame labels = Rendered(*renderer, request);
  for (size_t i = 0; i < labels.entity.size(); ++i) {
    const EntityId entity = labels.entity.pixels()[i];
    // Wall w has material w - 1; cubes have no parts of their own, so material 0.
    const uint16_t material = entity <= 6 ? static_cast<uint16_t>(entity) : 1;
    EXPECT_EQ(labels.material.pixels()[i], material);
    const Vec3f color = scene->materials[material - 1].base_color;
    EXPECT_EQ(labels.albedo.pixels()[i], (Rgb32f{color.x, color.y, color.z}));
  }
  request.tier = Tier::kFast;
  request.products.rgb = true;
  const Frame fast = Rendered(*renderer, request);
  EXPECT_EQ(fast.albedo, labels.albedo);
  EXPECT_EQ(fast.material, labels.material);
  EXPECT_EQ(fast.position, labels.position);
  EXPECT_EQ(fast.coverage, labels.coverage);
  EXPECT_EQ(fast.flow, labels.flow);
}

TEST(Products, TheSkyHasNoSurface) {
  const auto scene = MakeOpenSquare();
  const auto renderer = CpuRendererOf(scene);
  const RigidTransform X = Pose({0, 0, 1.5}, 0.3);
  const Frame frame = Rendered(*renderer, Request(Equirectangular{128, 64}, X, X));
  int sky = 0;
  for (size_t i = 0; i < frame.entity.size(); ++i) {
    if (frame.entity.pixels()[i] != scene->sky_entity) continue;
    ++sky;
    EXPECT_EQ(frame.position.pixels()[i], Vec3f{});
    EXPECT_EQ(frame.albedo.pixels()[i], Rgb32f{});
    EXPECT_EQ(frame.material.pixels()[i], 0);
    EXPECT_EQ(frame.flow.pixels()[i].range, 0);
  }
  EXPECT_GT(sky, 1000);
}

TEST(Coverage, IsWhatAFinerPictureOfTheSamePlaceCounts) {
  const auto scene = MakeOpenSquare();
  const auto renderer = CpuRendererOf(scene);
  const RigidTransform X = Pose({0.2, 0.1, 1.5}, 0.3, 0.2, -0.1);
  constexpr int kFine = 8, kWidth = 128, kHeight = 64;
  RenderRequest request = Request(Equirectangular{kWidth, kHeight}, X, X);
  request.edge_samples = 64;
  const Frame frame = Rendered(*renderer, request);
  const Frame fine = Rendered(*renderer, Request(Equirectangular{kFine * kWidth, kFine * kHeight}, X, X));
  double sum = 0;
  int edges = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const CoveragePixel& pixel = frame.coverage(x, y);
      float total = 0;
      for (int k = 0; k < CoveragePixel::kEntities; ++k) {
        total += pixel.share[k];
        EXPECT_EQ(pixel.entity[k] != kNoEntity, pixel.share[k] > 0);
        if (k > 0) {
          EXPECT_LE(pixel.share[k], pixel.share[k - 1]);
        }
      }
      EXPECT_LE(total, 1 + 1e-6f);
      if (pixel.entity[3] == kNoEntity) {
        EXPECT_NEAR(total, 1, 1e-6f);
      }
      if (OffEdge(frame.entity, x, y)) {
        EXPECT_EQ(pixel, (CoveragePixel{{frame.entity(x, y)}, {1}}));
        continue;
      }
      if (pixel.share[0] == 1) continue;
      ++edges;
      int count = 0;
      for (int i = 0; i < kFine * kFine; ++i) count += fine.entity(kFine * x + i % kFine, kFine * y + i / kFine) == pixel.entity[0];
      sum += std::abs(pixel.share[0] - static_cast<float>(count) / (kFine * kFine));
    }
  }
  EXPECT_GT(edges, 300);
  EXPECT_LT(sum / edges, 0.03);
}

TEST(Flow, OfACameraThatStaysIsNothing) {
  const auto renderer = CpuRendererOf(MakeOpenSquare());
  const RigidTransform X = Pose({0.2, 0.1, 1.5}, 0.3, 0.2, -0.1);
  for (const Camera& camera :
       {Camera(Equirectangular{128, 64}), Camera(Pinhole{80, 60, 50, 50, 40, 30}), Camera(Fisheye::Equidistant(80, 80, 3.2))}) {
    const Frame frame = Rendered(*renderer, Request(camera, X, X));
    for (size_t i = 0; i < frame.flow.size(); ++i) {
      const FlowPixel& flow = frame.flow.pixels()[i];
      if (frame.entity.pixels()[i] == kNoEntity) {
        EXPECT_EQ(flow, (FlowPixel{0, 0, 0, 1, {}}));
        continue;
      }
      EXPECT_LT(std::hypot(flow.dx, flow.dy), 2e-4);
      EXPECT_EQ(flow.occluded, 0);
      EXPECT_EQ(flow.motion, Vec3f{});
      EXPECT_NEAR(flow.range, frame.range.pixels()[i], 1e-5f * (1 + flow.range));
    }
  }
}

TEST(Flow, TurningThePanoramaShiftsEveryPixelTheShortWay) {
  const auto renderer = CpuRendererOf(MakeOpenSquare());
  constexpr int kWidth = 128;
  for (int k : {-40, -3, 5, 63}) {
    const double angle = 2 * std::numbers::pi * k / kWidth;
    const Frame frame =
        Rendered(*renderer, Request(Equirectangular{kWidth, kWidth / 2}, Pose({0, 0, 1.5}, 0.3), Pose({0, 0, 1.5}, 0.3 + angle)));
    for (const FlowPixel& flow : frame.flow.pixels()) {
      EXPECT_NEAR(flow.dx, k, 1e-3);  // yaw to the left moves things to the right
      EXPECT_NEAR(flow.dy, 0, 1e-3);
      EXPECT_EQ(flow.occluded, 0);
    }
  }
}

TEST(Flow, OcclusionIsThatOfTheRoomInClosedForm) {
  const auto renderer = CpuRendererOf(MakeRoom());
  RngStream rng(2, "flow");
  int64_t checked = 0, hidden = 0;
  for (int i = 0; i < 6; ++i) {
    const RigidTransform X = RandomPose(rng), next = RandomPose(rng);
    const Frame frame = Rendered(*renderer, Request(Equirectangular{128, 64}, X, next));
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 128; ++x) {
        const Vec3d p = VecCast<double>(frame.position(x, y));
        const double distance = Norm(p - next.p);
        const Vec3d d = (p - next.p) / distance;
        if (!FarFromEdges(next.p, d) || !OffEdge(frame.entity, x, y)) continue;
        ++checked;
        const bool truth = Look(next.p, d).range < distance - 1e-3;
        EXPECT_EQ(frame.flow(x, y).occluded, truth ? 1 : 0) << i << ' ' << x << ' ' << y;
        EXPECT_NEAR(frame.flow(x, y).range, distance, 1e-5);
        hidden += truth;
      }
    }
  }
  EXPECT_GT(hidden, 200);
  EXPECT_GT(checked, 20000);
}

TEST(Flow, LeavingThePictureCountsAsHidden) {
  const auto renderer = CpuRendererOf(MakeRoom());
  const RigidTransform X = Pose({0, 0, 2}, 0), next = Pose({0, 0, 2}, 0.5);
  const Pinhole camera{80, 60, 60, 60, 40, 30};
  const Frame frame = Rendered(*renderer, Request(camera, X, next));
  int left = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      const Vec3d ray_C = next.R.transpose() * (X.R * *PixelToRay(camera, {x + 0.5, y + 0.5}));
      const auto there = RayToPixel(camera, ray_C);
      EXPECT_EQ(frame.flow(x, y).occluded, there ? 0 : 1);
      left += !there;
      if (!there) continue;
      EXPECT_NEAR(frame.flow(x, y).dx, there->x - x - 0.5, 1e-3);
      EXPECT_NEAR(frame.flow(x, y).dy, there->y - y - 0.5, 1e-3);
    }
  }
  EXPECT_GT(left, 500);
}

// Some cubes of the square move, turn, vanish.
std::shared_ptr<const SceneState> MovedSquare(const Scene& scene, double t, bool with_hidden = false) {
  auto state = std::make_shared<SceneState>();
  for (uint32_t i = 1; i < 20; ++i) {
    AffineTransform X = PlaceUpright({}, static_cast<float>(0.2 * t * (i % 3)));
    X = X * AffineTransform{scene.instances[i].X_WM.A, {}};
    X.p = scene.instances[i].X_WM.p +
          Vec3f{static_cast<float>(0.3 * t * std::sin(i)), static_cast<float>(0.3 * t * std::cos(i)), static_cast<float>(0.05 * t)};
    state->moved.push_back({i, X, with_hidden && i % 7 == 0});
  }
  return state;
}

TEST(Flow, LeadsToTheSameEntityAndRangeInTheNextFrame) {
  const auto scene = MakeOpenSquare();
  const auto renderer = CpuRendererOf(scene);
  constexpr int kWidth = 1024, kHeight = 512;
  RenderRequest now = Request(Equirectangular{kWidth, kHeight}, Pose({0, 0, 1.5}, 0.3), Pose({0.3, -0.2, 1.6}, 0.45, 0.1, 0.05));
  now.state = MovedSquare(*scene, 0);
  now.next_state = MovedSquare(*scene, 1);
  RenderRequest then = Request(now.camera, *now.X_WC_next, *now.X_WC_next);
  then.state = now.next_state;
  const Frame a = Rendered(*renderer, now), b = Rendered(*renderer, then);
  int64_t checked = 0, right = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const FlowPixel& flow = a.flow(x, y);
      EXPECT_LE(std::abs(flow.dx), kWidth / 2);
      if (flow.occluded != 0 || !OffEdge(a.entity, x, y)) continue;
      const double to_x = x + 0.5 + flow.dx, to_y = y + 0.5 + flow.dy;
      const int u = ((static_cast<int>(std::floor(to_x)) % kWidth) + kWidth) % kWidth,
                v = std::clamp(static_cast<int>(std::floor(to_y)), 0, kHeight - 1);
      if (!OffEdge(b.entity, u, v)) continue;
      // The range at the exact place lies between those of the pixels around, but where faces meet.
      float low = 1e30f, high = 0;
      for (int k = 0; k < 9; ++k) {
        const float range = b.range((u + k % 3 - 1 + kWidth) % kWidth, std::clamp(v + k / 3 - 1, 0, kHeight - 1));
        low = std::min(low, range), high = std::max(high, range);
      }
      ++checked;
      const float slack = 1e-3f * (1 + flow.range);
      right += b.entity(u, v) == a.entity(x, y) && flow.range >= low - slack && flow.range <= high + slack;
    }
  }
  EXPECT_GT(checked, kWidth * kHeight / 2);
  EXPECT_GE(static_cast<double>(right), 0.999 * static_cast<double>(checked));
}

TEST(Flow, SceneFlowIsTheDifferenceOfThePlacesOfASurfacePoint) {
  const auto scene = MakeOpenSquare();
  const auto renderer = CpuRendererOf(scene);
  RenderRequest request = Request(Equirectangular{256, 128}, Pose({0, 0, 1.5}, 0.3), Pose({0, 0, 1.5}, 0.3));
  request.state = MovedSquare(*scene, 0.4);
  request.next_state = MovedSquare(*scene, 1);
  const Frame frame = Rendered(*renderer, request);
  int moving = 0;
  for (size_t i = 0; i < frame.flow.size(); ++i) {
    const Vec3f p = frame.position.pixels()[i], motion = frame.flow.pixels()[i].motion;
    const EntityId entity = frame.entity.pixels()[i];
    const auto instance =
        std::find_if(scene->instances.begin(), scene->instances.end(), [&](const Instance& x) { return x.entity == entity; });
    const auto index = static_cast<uint32_t>(instance - scene->instances.begin());
    if (index < 1 || index >= 20) {
      EXPECT_EQ(motion, Vec3f{});
      continue;
    }
    ++moving;
    // Turn by the difference of the angles about the instance's own place, then shift.
    const AffineTransform &A = request.state->moved[index - 1].X_WM, &B = request.next_state->moved[index - 1].X_WM;
    const AffineTransform turn = PlaceUpright({}, static_cast<float>(0.2 * 0.6 * (index % 3)));
    const Vec3f expected = turn.A * (p - A.p) + B.p - p;
    EXPECT_LT(Norm(motion - expected), 2e-5f);
  }
  EXPECT_GT(moving, 500);
}

TEST(SceneStates, GiveTheProductsOfASceneBuiltThatWay) {
  const auto scene = MakeOpenSquare();
  const auto renderer = CpuRendererOf(scene);
  const RigidTransform X = Pose({0, 0, 1.5}, 0.3);
  RenderRequest request = Request(Equirectangular{256, 128}, X, X);
  request.products.coverage = false;
  request.state = MovedSquare(*scene, 1.5, true);
  const Frame moved = Rendered(*renderer, request);

  // The same scene with its instances there, rebuilt by hand.
  SceneBuilder builder("built");
  for (const Material& material : scene->materials) builder.AddMaterial(material);
  for (const Mesh& mesh : scene->meshes) builder.AddMesh(mesh);
  for (size_t i = 0; i + 1 < scene->entities.size(); ++i)
    builder.AddEntity(scene->entities[i].name, builder.tree().At("construction/building"));
  for (uint32_t i = 0; i < scene->instances.size(); ++i) {
    Instance instance = scene->instances[i];
    if (i >= 1 && i < 20) instance.X_WM = request.state->moved[i - 1].X_WM;
    if (i >= 1 && i < 20 && request.state->moved[i - 1].hidden) instance.X_WM.p = {0, 0, -500};
    builder.AddInstance(instance);
  }
  builder.AddSky();
  request.state = nullptr;
  const Frame built = Rendered(*CpuRendererOf(builder.Build()), request);
  EXPECT_EQ(moved.entity, built.entity);
  EXPECT_EQ(moved.semantic, built.semantic);
  EXPECT_EQ(moved.material, built.material);
  EXPECT_EQ(moved.albedo, built.albedo);
  for (size_t i = 0; i < built.range.size(); ++i) {
    EXPECT_NEAR(moved.range.pixels()[i], built.range.pixels()[i], 1e-6f * (1 + built.range.pixels()[i]));
    EXPECT_LT(Norm(moved.normal.pixels()[i] - built.normal.pixels()[i]), 1e-5f);
  }

  // And the renderer goes back to the scene as it was.
  const Frame back = Rendered(*renderer, request), fresh = Rendered(*CpuRendererOf(scene), request);
  EXPECT_EQ(back.entity, fresh.entity);
  EXPECT_EQ(back.range, fresh.range);
  EXPECT_EQ(back.normal, fresh.normal);
  EXPECT_EQ(back.albedo, fresh.albedo);
}

TEST(SceneStates, DeformedMeshesMoveTheirSurfaceAndItsNormals) {
  const auto scene = MakeOpenSquare();
  const auto renderer = CpuRendererOf(scene);
  const RigidTransform X = Pose({0, 0, 1.5}, 0.3);
  RenderRequest request = Request(Equirectangular{256, 128}, X, X);
  // All cubes (mesh 1) grow to twice their height from now to then.
  auto tall = std::make_shared<std::vector<Vec3f>>(scene->meshes[1].positions);
  for (Vec3f& p : *tall) p.z *= 2;
  auto state = std::make_shared<SceneState>();
  state->deformed.push_back({1, tall});
  request.next_state = state;
  const Frame now = Rendered(*renderer, request);
  for (size_t i = 0; i < now.flow.size(); ++i) {
    const bool cube = now.entity.pixels()[i] > 1 && now.entity.pixels()[i] != scene->sky_entity;
    // Cubes stand on z = 0: a point rises by its height.
    const Vec3f expected{0, 0, cube ? now.position.pixels()[i].z : 0};
    EXPECT_LT(Norm(now.flow.pixels()[i].motion - expected), 1e-5f);
  }
  request.state = state;
  request.next_state = nullptr;
  const Frame then = Rendered(*renderer, request);
  float highest_now = 0, highest_then = 0;
  for (Vec3f p : now.position.pixels()) highest_now = std::max(highest_now, p.z);
  for (size_t i = 0; i < then.position.size(); ++i) {
    const Vec3f n = then.normal.pixels()[i];
    highest_then = std::max(highest_then, then.position.pixels()[i].z);
    EXPECT_NEAR(std::abs(n.z) * std::hypot(n.x, n.y), 0, 1e-5f);  // still boxes
  }
  EXPECT_NEAR(highest_then, 2 * highest_now, 0.3f * highest_now);
}

TEST(Products, RollWithThePanoramaByteForByteAndDoNotDependOnThreads) {
  const auto scene = MakeOpenSquare();
  const auto renderer = CpuRendererOf(scene);
  constexpr int kWidth = 200;
  const auto request = [&](int k) {
    const RigidTransform turn{RotationY(2 * std::numbers::pi * k / kWidth), {}};
    RenderRequest r =
        Request(Equirectangular{kWidth, kWidth / 2}, Pose({0, 0, 1.5}, 0.3, 0.2, 0.1) * turn, Pose({0.4, 0.1, 1.6}, 0.5, 0.1, 0.2) * turn);
    r.state = MovedSquare(*scene, 0.5);
    r.next_state = MovedSquare(*scene, 1);
    return r;
  };
  const Frame base = Rendered(*renderer, request(0));
  const auto expect_rolled = [&](const auto& a, const auto& b, int k) {
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < kWidth; ++x) ASSERT_TRUE(b(x, y) == a((x + k) % kWidth, y)) << k << ' ' << x << ' ' << y;
    }
  };
  for (int k : {1, 57, 199}) {
    const Frame turned = Rendered(*renderer, request(k));
    expect_rolled(base.entity, turned.entity, k);
    expect_rolled(base.position, turned.position, k);
    expect_rolled(base.albedo, turned.albedo, k);
    expect_rolled(base.material, turned.material, k);
    expect_rolled(base.flow, turned.flow, k);
    expect_rolled(base.coverage, turned.coverage, k);
  }
  const ThreadLimit limit(1);
  const Frame single = Rendered(*renderer, request(0));
  EXPECT_EQ(single.flow, base.flow);
  EXPECT_EQ(single.coverage, base.coverage);
  EXPECT_EQ(single.albedo, base.albedo);
}

TEST(Flow, WithoutTheNextPoseIsAnInputError) {
  const auto renderer = CpuRendererOf(MakeRoom());
  RenderRequest request = Request(Equirectangular{64, 32}, Pose({0, 0, 2}, 0), {});
  request.X_WC_next.reset();
  Frame frame;
  EXPECT_THROW(renderer->Render(request, frame), InputError);
  request.X_WC_next = RigidTransform{{}, {0, std::nan(""), 0}};
  EXPECT_THROW(renderer->Render(request, frame), InputError);
}

}  // namespace
}  // namespace airsim360

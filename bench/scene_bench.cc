// What moving things and alpha-tested leaves cost the ray tracer. Ratios of one run; compare those, not
// milliseconds.
//
//   moving   downtown_west, tier labels: a frame of the scene as built against a frame of a scene in which
//            200 things move: instances that shift and turn, meshes whose vertices all change. Every tick is
//            a new state.
//   forest   instanced trees of alpha-tested cards (a spray of leaves on each, cut into 1, 4 x 4 or 8 x 8
//            squares): primary rays a second with the triangles sorted by opacity against all of them
//            filtered.
//
// Usage: scene_bench [--width W] [--rounds N] [--only moving|forest]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/render/renderer.h"
#include "median.h"

namespace {

using namespace airsim360;
using Clock = std::chrono::steady_clock;

constexpr Products kLabels{.rgb = false, .normal = true};

const char* Text(int argc, char** argv, const char* name, const char* value) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], name) == 0) value = argv[i + 1];
  }
  return value;
}

double Since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

// 150 instances spread over the scene, and up to 50 of the meshes of a body's size.
struct Cast {
  std::vector<uint32_t> instances;
  std::vector<MeshId> meshes;
};

Cast ChooseCast(const Scene& scene) {
  Cast cast;
  std::vector<int> uses(scene.meshes.size());
  for (const Instance& instance : scene.instances) ++uses[instance.mesh];
  for (MeshId m = 0; m < scene.meshes.size() && cast.meshes.size() < 50; ++m) {
    const size_t triangles = scene.meshes[m].triangles.size();
    if (uses[m] >= 1 && uses[m] <= 8 && triangles >= 500 && triangles <= 20000) cast.meshes.push_back(m);
  }
  const size_t step = scene.instances.size() / 150;
  for (size_t i = 0; i < 150; ++i) {
    const auto index = static_cast<uint32_t>(i * step);
    if (uses[scene.instances[index].mesh] > 8) cast.instances.push_back(index);
  }
  return cast;
}

std::shared_ptr<const SceneState> Tick(const Scene& scene, const Cast& cast, int tick) {
  auto state = std::make_shared<SceneState>();
  const float t = 0.05f * static_cast<float>(tick + 1);
  for (uint32_t i : cast.instances) {
    AffineTransform X = scene.instances[i].X_WM;
    X.p = X.p + Vec3f{std::sin(t + static_cast<float>(i)), std::cos(t), 0.1f};
    state->moved.push_back({i, X, false});
  }
  for (MeshId m : cast.meshes) {
    auto positions = std::make_shared<std::vector<Vec3f>>(scene.meshes[m].positions);
    for (Vec3f& p : *positions) p.x += 0.1f * std::sin(2 * p.z + t);
    state->deformed.push_back({m, std::move(positions)});
  }
  return state;
}

void Moving(int width, int rounds) {
  const auto scene = LoadWorld({.world = "downtown_west"});
  const auto tracer = std::make_shared<const RayTracer>(scene);
  const auto still = MakeCpuRenderer(tracer), moving = MakeCpuRenderer(tracer);
  const Cast cast = ChooseCast(*scene);
  size_t vertices = 0;
  for (MeshId m : cast.meshes) vertices += scene->meshes[m].positions.size();
  RenderRequest request =
      MakeRequest(Equirectangular{width, width / 2},
                  BodyPose(VecCast<double>(scene->spawn.value_or(Vec3f{0, 0, 3})), 0, 0, 0) * CameraInBody(), Tier::kLabels, kLabels);
  Frame frame;
  std::vector<double> ticks, built, moved;
  for (int i = 0; i <= rounds; ++i) {
    request.state = nullptr;
    const double a = still->Render(request, frame).render_ms;
    request.state = Tick(*scene, cast, i);
    const auto start = Clock::now();
    const double b = moving->Render(request, frame).render_ms;
    const double all = Since(start);
    if (i == 0) continue;  // the first tick makes the tables
    built.push_back(a);
    moved.push_back(all);
    ticks.push_back(all - b);
  }
  std::printf("moving: %zu instances and %zu meshes of %zu vertices; medians of %d, %d threads\n", cast.instances.size(),
              cast.meshes.size(), vertices, rounds, ThreadCount());
  std::printf("  frame as built %.1f ms; tick %.2f ms + frame = %.1f ms; ratio %.3f\n", Median(built), Median(ticks), Median(moved),
              Median(moved) / Median(built));
}

// A spray of pointed leaves along a twig, with clear space around.
Texture Spray() {
  constexpr int kSize = 256;
  Image<Rgba8> image(kSize, kSize, {70, 110, 40, 0});
  RngStream rng(1, "spray");
  for (int leaf = 0; leaf < 24; ++leaf) {
    const double cx = 128 + rng.Uniform(-90, 90), cy = 128 + rng.Uniform(-90, 90), turn = rng.Uniform(0, 3.14);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const double u = (x - cx) * std::cos(turn) + (y - cy) * std::sin(turn), v = (y - cy) * std::cos(turn) - (x - cx) * std::sin(turn);
        if (std::abs(u) < 26 && std::abs(v) < 11 * (1 - u * u / 676)) image(x, y).a = 255;
      }
    }
  }
  return Texture::FromImage("spray", std::move(image), true);
}

std::shared_ptr<const Scene> Forest(uint32_t cuts) {
  SceneBuilder builder("forest");
  Material leaf;
  leaf.alpha_mode = AlphaMode::kMask;
  leaf.base_color_texture = builder.AddTexture(Spray());
  const MaterialId leaf_id = builder.AddMaterial(leaf);
  Mesh tree{"tree", {}, {}, {}, {}, {}};
  RngStream rng(2, "tree");
  for (int card = 0; card < 600; ++card) {
    Vec3f c;
    do {
      for (int k = 0; k < 3; ++k) c[k] = static_cast<float>(rng.Uniform(-2.5, 2.5));
    } while (Norm(c) > 2.5f);
    const Vec3f right = PlaceUpright({}, static_cast<float>(rng.Uniform(0, 6))).A.column(0) * 0.8f;
    const Vec3f up{static_cast<float>(rng.Uniform(-0.3, 0.3)), static_cast<float>(rng.Uniform(-0.3, 0.3)), 0.7f};
    const auto first = static_cast<uint32_t>(tree.positions.size());
    for (uint32_t j = 0; j <= cuts; ++j) {
      for (uint32_t i = 0; i <= cuts; ++i) {
        const float u = static_cast<float>(i) / static_cast<float>(cuts), v = static_cast<float>(j) / static_cast<float>(cuts);
        tree.positions.push_back(c + Vec3f{0, 0, 5} + right * (u - 0.5f) + up * (0.5f - v));
        tree.uvs.push_back({u, v});
      }
    }
    for (uint32_t j = 0; j < cuts; ++j) {
      for (uint32_t i = 0; i < cuts; ++i) {
        const uint32_t a = first + j * (cuts + 1) + i;
        tree.triangles.push_back({a, a + cuts + 1, a + 1});
        tree.triangles.push_back({a + 1, a + cuts + 1, a + cuts + 2});
      }
    }
  }
  tree.parts = {{0, static_cast<uint32_t>(tree.triangles.size()), leaf_id, kNoEntity}};
  const MeshId id = builder.AddMesh(std::move(tree));
  const EntityId entity = builder.AddEntity("tree", builder.tree().At("vegetation"));
  for (int i = 0; i < 400; ++i) {
    const auto x = static_cast<float>(rng.Uniform(-60, 60)), y = static_cast<float>(rng.Uniform(-60, 60));
    builder.AddInstance({id, PlaceUpright({x, y, 0}, static_cast<float>(rng.Uniform(0, 6))), entity});
  }
  builder.AddSky();
  return builder.Build();
}

void MeasureForest(uint32_t cuts, int width, int rounds) {
  const auto scene = Forest(cuts);
  const auto sorted = MakeCpuRenderer(std::make_shared<const RayTracer>(scene));
  const auto filtered = MakeCpuRenderer(std::make_shared<const RayTracer>(scene, RayTracerOptions{.isa = {}, .sort_alpha = false}));
  const RenderRequest request =
      MakeRequest(Equirectangular{width, width / 2}, BodyPose({0, 0, 3}, 0, 0, 0) * CameraInBody(), Tier::kLabels, kLabels);
  Frame a, b;
  std::vector<double> with, without;
  for (int i = 0; i <= rounds; ++i) {
    with.push_back(sorted->Render(request, a).render_ms);
    without.push_back(filtered->Render(request, b).render_ms);
  }
  const double rays = static_cast<double>(width) * width / 2 / 1e3;
  std::printf("forest, cards of %u x %u: sorted %.2f Mrays/s, filtered %.2f Mrays/s, ratio %.2f; labels %s\n", cuts, cuts,
              rays / Median(with), rays / Median(without), Median(without) / Median(with),
              a.entity == b.entity && a.range == b.range ? "identical" : "DIFFER");
}

}  // namespace

int main(int argc, char** argv) {
  const int width = std::max(64, std::atoi(Text(argc, argv, "--width", "2048")) / 2 * 2);
  const int rounds = std::max(1, std::atoi(Text(argc, argv, "--rounds", "9")));
  const std::string only = Text(argc, argv, "--only", "");
  if (only != "forest") Moving(width, rounds);
  if (only == "moving") return 0;
  for (uint32_t cuts : {1u, 4u, 8u}) MeasureForest(cuts, width, rounds);
}

// Renders frames on request and says how long each took: our side of comparisons with other renderers
// (bench/cycles). Usage: frame_server WORLD THREADS [TIER [SKY_WORLD [plain]]]; SKY_WORLD lends its sun and weather.
// `plain`: matt opaque surfaces of their base colours (and textures, and holes) under a sky without clouds and without air
// before surfaces, which another renderer can have just so.
// Says {"ready": true, "sun_irradiance": [r, g, b]}, then reads one JSON object a line:
//   {"size": [W, H], "tier": "fast", "X_WC": {"p": [...], "q_wxyz": [...]}, "labels": true, "samples": N,
//    "edge_samples": N, "seed": N, "radiance": FILE.exr or absent}
// and answers each with {"seconds": ..., "rays": ...}.
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "airsim360/base/file.h"
#include "airsim360/base/parallel.h"
#include "airsim360/image/codecs.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/render/renderer.h"
#include "airsim360/render/sky/sky.h"

namespace {

using namespace airsim360;
using nlohmann::json;

std::shared_ptr<const Scene> MakePlain(const Scene& scene) {
  auto plain = std::make_shared<Scene>(scene);
  plain->cache_key.clear();
  for (Material& m : plain->materials) {
    m = {.name = m.name,
         .alpha_mode = m.alpha_mode,
         .alpha_cutoff = m.alpha_cutoff,
         .base_color = Min(m.base_color, {1, 1, 1}),  // more cannot be exported
         .base_alpha = m.base_alpha,
         .roughness = 1,
         .base_color_texture = m.base_color_texture,
         .uv_scale = m.uv_scale,
         .uv_offset = m.uv_offset,
         .uv_rotation = m.uv_rotation};
  }
  return plain;
}

RenderRequest ReadRequest(const json& line) {
  RenderRequest request;
  request.camera = Equirectangular{line.at("size")[0], line.at("size")[1]};
  const json &p = line.at("X_WC").at("p"), &q = line.at("X_WC").at("q_wxyz");
  request.X_WC = {ToMatrix(Quaternion{q[0], q[1], q[2], q[3]}), {p[0], p[1], p[2]}};
  request.tier = ParseTier(line.at("tier").get<std::string>());
  const bool labels = line.value("labels", true);
  request.products = {.rgb = true, .range = labels, .semantic = labels, .entity = labels, .normal = labels};
  request.products.radiance = line.contains("radiance");
  request.samples = line.value("samples", 0);
  request.edge_samples = line.value("edge_samples", request.edge_samples);
  request.seed = line.value("seed", uint64_t{0});
  return request;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: frame_server WORLD THREADS [TIER [SKY_WORLD [plain]]]\n");
    return 2;
  }
  const ThreadLimit limit(std::stoi(argv[2]));
  const bool plain = argc > 5 && std::string(argv[5]) == "plain";
  auto scene = LoadWorld({.world = argv[1]});
  if (plain) scene = MakePlain(*scene);
  const auto tracer = std::make_shared<const RayTracer>(std::move(scene));
  Environment environment = tracer->scene().environment;
  if (argc > 4) environment = LoadWorld({.world = argv[4]})->environment;
  if (plain) environment.cloud_cover = environment.cirrus_cover = environment.haze = 0;
  const auto renderer = MakeCpuRenderer(tracer, {.tier = ParseTier(argc > 3 ? argv[3] : "fast"), .environment = environment});
  const Vec3f sun = internal::Sky(environment).sun_irradiance();
  std::printf("{\"ready\": true, \"sun_irradiance\": [%g, %g, %g]}\n", static_cast<double>(sun.x), static_cast<double>(sun.y),
              static_cast<double>(sun.z));
  std::fflush(stdout);
  Frame frame;
  for (std::string line; std::getline(std::cin, line);) {
    const json request = json::parse(line);
    const RenderStats stats = renderer->Render(ReadRequest(request), frame);
    if (request.contains("radiance")) WriteFileAtomically(request["radiance"].get<std::string>(), EncodeExr(frame.radiance));
    std::printf("{\"seconds\": %.6f, \"rays\": %llu}\n", stats.render_ms / 1000, static_cast<unsigned long long>(stats.rays));
    std::fflush(stdout);
  }
}

// The GPU renderer's rates and ratios on one device, named in the table.
//
// frame/trace: time of a frame over that of its camera rays alone, both by the GPU's clock. in flight: frames a second with three
// of them in flight, their pictures read back to memory of the CPU; read-back: that time over the GPU's own (1 = hidden).
// Usage: gpu_bench [--world NAME] [--gpu N] [--seconds S]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "airsim360/render/vulkan/gpu.h"
#include "airsim360/sim/world_loader.h"

namespace {

using namespace airsim360;

double Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Rates {
  double gpu_ms = 0;   // median by the GPU's clock
  double wall_ms = 0;  // of a frame, three in flight
  int frames = 0;
};

// Frames for about `seconds`, three in flight; the camera turns a little each time.
Rates Run(GpuRenderer& gpu, std::vector<RenderRequest> requests, double seconds) {
  std::vector<uint64_t> flying;
  std::vector<double> times;
  const auto submit = [&] {
    for (RenderRequest& r : requests) r.X_WC.R = r.X_WC.R * RotationY(0.01);
    flying.push_back(gpu.Submit(requests));
  };
  const auto finish = [&] {
    gpu.Wait(flying.front());
    times.push_back(gpu.gpu_ms());
    gpu.Release(flying.front());
    flying.erase(flying.begin());
  };
  for (int i = 0; i < 2; ++i) submit(), finish();  // warm
  times.clear();
  const double start = Now();
  for (int i = 0; i < 3; ++i) submit();
  while (Now() - start < seconds || times.size() < 3) {
    finish();
    submit();
  }
  while (!flying.empty()) finish();
  const double end = Now();
  Rates rates;
  rates.frames = static_cast<int>(times.size());
  std::nth_element(times.begin(), times.begin() + rates.frames / 2, times.end());
  rates.gpu_ms = times[static_cast<size_t>(rates.frames / 2)];
  rates.wall_ms = 1000 * (end - start) / rates.frames;
  return rates;
}

void PrintRow(const char* what, int width, int height, size_t cameras, const Rates& r, double trace_ms) {
  char size[40];
  std::snprintf(size, sizeof size, "%zu x %dx%d", cameras, width, height);
  std::printf("%-28s %-18s %10.2f %12.2f %10.2f %12.1f %10.1f\n", what, size, r.gpu_ms,
              trace_ms > 0 ? r.gpu_ms / trace_ms : 0.0, r.gpu_ms > 0 ? r.wall_ms / r.gpu_ms : 0.0,
              1000.0 * static_cast<double>(cameras) / r.wall_ms,
              1e-3 * static_cast<double>(cameras) * width * height / r.wall_ms);
}

}  // namespace

int main(int argc, char** argv) {
  std::string world;
  GpuOptions options;
  double seconds = 3;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (!std::strcmp(argv[i], "--world")) world = argv[i + 1];
    if (!std::strcmp(argv[i], "--gpu")) options.gpu = std::atoi(argv[i + 1]);
    if (!std::strcmp(argv[i], "--seconds")) seconds = std::atof(argv[i + 1]);
  }
  std::string why = "none";
  bool any = false;
  for (const GpuInfo& gpu : ListGpus(&why)) {
    any |= gpu.missing.empty();
    std::printf("GPU %d: %s, %s%s%s\n", gpu.index, gpu.name.c_str(), gpu.driver.c_str(),
                gpu.software ? ", software" : "", gpu.missing.empty() ? "" : (", lacks: " + gpu.missing).c_str());
  }
  if (!any) {
    std::printf("no GPU here traces rays (%s): nothing measured\n", why.c_str());
    return 0;
  }
  std::vector<GpuInfo> all = ListGpus();
  const bool software =
      options.gpu >= 0 ? all.at(static_cast<size_t>(options.gpu)).software
                       : std::all_of(all.begin(), all.end(), [](const GpuInfo& g) { return g.software || !g.missing.empty(); });
  if (world.empty()) world = software ? "sunlit_room" : "city_park";
  if (software) seconds = std::min(seconds, 1.0);
  const double before = Now();
  const auto scene = LoadWorld({.world = world});
  const auto tracer = std::make_shared<const RayTracer>(scene);
  const double loaded = Now();
  const auto gpu = MakeVulkanRenderer(tracer, {.tier = Tier::kFast}, options);
  std::printf("measured on: %s (%s); world %s, %zu instances; world built in %.1f s, uploaded in %.1f s\n",
              gpu->gpu().name.c_str(), gpu->gpu().driver.c_str(), world.c_str(), scene->instances.size(),
              loaded - before, Now() - loaded);
  std::printf("%-28s %-18s %10s %12s %10s %12s %10s\n", "what", "pictures", "GPU ms", "frame/trace", "read-back",
              "pictures/s", "Mpixel/s");

  const Vec3f spawn = scene->spawn.value_or(Vec3f{0, 0, 2});
  RenderRequest request;
  request.X_WC = BodyPose(VecCast<double>(spawn) + Vec3d{0, 0, 0.3}, 0.3, 0, 0) * CameraInBody();
  request.aa_samples = 1;
  const Products nothing{.rgb = false, .range = false, .semantic = false, .entity = false};
  const Products labels{.rgb = false, .normal = true};
  const Products everything{.rgb = true, .normal = true};
  const std::vector<int> widths = software ? std::vector{128} : std::vector{1024, 2048, 4096};
  for (const int width : widths) {
    request.camera = Equirectangular{width, width / 2};
    const auto row = [&](const char* what, Tier tier, const Products& products, double trace_ms) {
      request.tier = tier, request.products = products;
      const Rates rates = Run(*gpu, {request}, seconds);
      PrintRow(what, width, width / 2, 1, rates, trace_ms > 0 ? trace_ms : rates.gpu_ms);
      return rates.gpu_ms;
    };
    const double trace_ms = row("camera rays alone", Tier::kLabels, nothing, 0);
    row("labels", Tier::kLabels, labels, trace_ms);
    row("fast and labels", Tier::kFast, everything, trace_ms);
    request.aa_samples = 4;
    row("fast, antialiased", Tier::kFast, everything, trace_ms);
    row("high, antialiased", Tier::kHigh, everything, trace_ms);
    request.samples = 8;
    row("reference, 8 paths", Tier::kReference, everything, trace_ms);
    request.samples = 0, request.aa_samples = 1;
  }

  // Training: many small panoramas at once.
  const size_t cameras = software ? 16 : 1024;
  const int width = software ? 64 : 128;
  std::vector<RenderRequest> batch(cameras, request);
  for (size_t i = 0; i < cameras; ++i) {
    batch[i].camera = Equirectangular{width, width / 2};
    batch[i].X_WC.p = batch[i].X_WC.p + Vec3d{0.01 * static_cast<double>(i % 32), 0.01 * static_cast<double>(i / 32), 0};
    batch[i].tier = Tier::kLabels, batch[i].products = labels;
  }
  PrintRow("labels, one dispatch", width, width / 2, cameras, Run(*gpu, batch, seconds), 0);
  for (RenderRequest& r : batch) r.tier = Tier::kFast, r.products = everything;
  PrintRow("fast, one dispatch", width, width / 2, cameras, Run(*gpu, batch, seconds), 0);
}

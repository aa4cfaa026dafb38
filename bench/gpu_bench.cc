// The GPU renderer's rates and ratios on one device, named in the table, and whether they reach the bars.
//
// A frame over its rays alone: time of a `fast` picture with its labels over that of tracing all its rays once more and doing
// nothing else, by the GPU's clock. Read-back: how much fewer frames a second come, three in flight, where pictures are copied
// to memory of the CPU. Pictures a second: three in flight, pictures read back, with all labels (range, category, entity,
// normal, flow). Software gets small pictures; the bars are those of a card for servers without ray-tracing cores.
// Usage: gpu_bench [--world NAME] [--gpu N] [--seconds S] [--list]. Exit status 1 where something failed.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/render/vulkan/gpu.h"
#include "airsim360/worlds/worlds.h"

namespace {

using namespace airsim360;

constexpr int kInFlight = 3;

double Now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

struct Settings {
  std::string world;
  int gpu = -1;
  double seconds = 3;
  bool list = false;
  bool software = false;
};

struct Rates {
  double first_s = 0;  // of the first frame: shaders are compiled then
  double gpu_ms = 0;   // median by the GPU's clock
  double wall_ms = 0;  // of a submission, three in flight
};

class Bench {
 public:
  Bench(const Settings& settings, std::shared_ptr<const Scene> scene)
      : settings_(settings),
        tracer_(std::make_shared<const RayTracer>(std::move(scene))),
        gpu_(MakeVulkanRenderer(tracer_, {.tier = Tier::kFast}, {.gpu = settings.gpu})) {}

  GpuRenderer& gpu() { return *gpu_; }
  int status() const { return status_; }

  // Submissions for about the seconds of the settings, three in flight; the cameras turn a little each time.
  Rates Run(std::vector<RenderRequest> requests) {
    std::vector<uint64_t> flying;
    std::vector<double> times;
    const auto submit = [&] {
      for (RenderRequest& r : requests) {
        r.X_WC.R = r.X_WC.R * RotationY(0.01);
        r.X_WC_next = r.X_WC * RigidTransform{RotationY(0.01), {0.02, 0, 0.02}};
      }
      flying.push_back(gpu_->Submit(requests));
    };
    const auto finish = [&] {
      gpu_->Wait(flying.front());
      times.push_back(gpu_->gpu_ms());
      gpu_->Release(flying.front());
      flying.erase(flying.begin());
    };
    Rates rates;
    const double begin = Now();
    submit(), finish();
    rates.first_s = Now() - begin;
    // Until all slots have their memory.
    for (int i = 0; i < kInFlight; ++i) submit();
    for (int i = 0; i < kInFlight; ++i) finish();
    times.clear();
    const double start = Now();
    for (int i = 0; i < kInFlight; ++i) submit();
    while (Now() - start < settings_.seconds || times.size() < kInFlight) finish(), submit();
    while (!flying.empty()) finish();
    rates.wall_ms = 1000 * (Now() - start) / static_cast<double>(times.size());
    std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
    rates.gpu_ms = times[times.size() / 2];
    return rates;
  }

  // A line of the table; nothing where it failed, which is said.
  std::optional<Rates> Row(const char* what, const std::vector<RenderRequest>& requests) {
    const int width = Width(requests[0].camera), height = Height(requests[0].camera);
    char size[40];
    std::snprintf(size, sizeof size, "%zu x %dx%d", requests.size(), width, height);
    std::printf("%-34s %-16s ", what, size);
    std::fflush(stdout);
    std::optional<Rates> rates;
    Try([&] {
      rates = Run(requests);
      const double pictures = 1000.0 * static_cast<double>(requests.size()) / rates->wall_ms;
      std::printf("%9.2f %10.2f %11.1f %9.1f\n", rates->first_s, rates->gpu_ms, pictures, 1e-6 * pictures * width * height);
    });
    return rates;
  }

  void Try(const std::function<void()>& work) {
    try {
      work();
    } catch (const std::exception& error) {
      std::printf("FAILED: %s\n", error.what());
      status_ = 1;
    }
    std::fflush(stdout);
  }

 private:
  Settings settings_;
  std::shared_ptr<const RayTracer> tracer_;
  std::unique_ptr<GpuRenderer> gpu_;
  int status_ = 0;
};

// A bar: `value` must be at least (or, `most`, at most) `bar`.
void PrintBar(const char* what, double value, const char* unit, double bar, bool most, double stretch, bool software) {
  const bool good = most ? value <= bar : value >= bar;
  std::printf("%-58s %9.2f %-11s %s %g", what, value, unit, most ? "<=" : ">=", bar);
  if (stretch > 0) std::printf(" (stretch %g)", stretch);
  std::printf(": %s\n", software ? "not judged in software, with small pictures" : good ? "pass" : "SHORT");
}

Settings Parse(int argc, char** argv) {
  Settings s;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    if (flag == "--list") {
      s.list = true;
      continue;
    }
    if (i + 1 == argc || (flag != "--world" && flag != "--gpu" && flag != "--seconds")) {
      std::fprintf(stderr, "usage: gpu_bench [--world NAME] [--gpu N] [--seconds S] [--list]\n");
      std::exit(2);
    }
    const char* value = argv[++i];
    if (flag == "--world") s.world = value;
    if (flag == "--gpu") s.gpu = std::atoi(value);
    if (flag == "--seconds") s.seconds = std::atof(value);
  }
  return s;
}

// Prints all devices. Whether one can be measured, and whether that is software.
bool FindDevice(Settings& settings) {
  std::string why = "none";
  const std::vector<GpuInfo> all = ListGpus(&why);
  bool any = false, hardware = false;
  for (const GpuInfo& gpu : all) {
    std::printf("GPU %d: %s, %s%s%s\n", gpu.index, gpu.name.c_str(), gpu.driver.c_str(), gpu.software ? ", software" : "",
                gpu.missing.empty() ? "" : (", lacks: " + gpu.missing).c_str());
    const bool asked = settings.gpu < 0 || settings.gpu == gpu.index;
    any |= asked && gpu.missing.empty();
    hardware |= asked && gpu.missing.empty() && !gpu.software;
  }
  settings.software = !hardware;
  if (!any) std::printf("no GPU here traces rays (%s): nothing measured\n", all.empty() ? why.c_str() : "see above");
  if (settings.software && MachineHasGpu()) std::printf("this machine has a GPU, but no Vulkan driver for it that traces rays was found\n");
  return any;
}

void Measure(Bench& bench, RenderRequest request, const Settings& settings) {
  const bool software = settings.software;
  const Products nothing{.rgb = false, .range = false, .semantic = false, .entity = false};
  const Products labels{.rgb = false, .normal = true, .flow = true};
  const Products everything{.normal = true, .flow = true};
  std::printf("%-34s %-16s %9s %10s %11s %9s\n", "what", "pictures", "first, s", "GPU ms", "pictures/s", "Mpixel/s");
  const auto row = [&](const char* what, int width, Tier tier, const Products& products) {
    request.camera = Equirectangular{width, width / 2};
    request.tier = tier, request.products = products;
    return bench.Row(what, {request});
  };
  const int width = software ? 128 : 2048, large = software ? 128 : 4096;
  row("camera rays alone", width, Tier::kLabels, nothing);
  row("all labels", width, Tier::kLabels, labels);
  request.edge_samples = 1;
  const auto plain = row("fast and labels but flow, 1 sample", width, Tier::kFast, {.normal = true});
  double alone = 0;
  const RenderRequest recorded = request;
  request.edge_samples = 4;
  const auto fast = row("fast, all labels, antialiased", width, Tier::kFast, everything);
  bench.gpu().ReadBack(false);
  const auto unread = row("fast ... not read back", width, Tier::kFast, everything);
  bench.gpu().ReadBack(true);
  const auto high = row("high, all labels, antialiased", large, Tier::kHigh, everything);
  request.samples = 8;
  row("reference, 8 paths, all labels", width, Tier::kReference, everything);
  request.samples = 0, request.edge_samples = 1;

  // Training: many small panoramas at once.
  const size_t cameras = software ? 16 : 1024;
  request.camera = Equirectangular{software ? 64 : 128, software ? 32 : 64};
  std::vector<RenderRequest> batch(cameras, request);
  for (size_t i = 0; i < cameras; ++i) {
    batch[i].X_WC.p = batch[i].X_WC.p + Vec3d{0.01 * static_cast<double>(i % 32), 0.01 * static_cast<double>(i / 32), 0};
    batch[i].tier = Tier::kLabels, batch[i].products = {.rgb = false, .normal = true};
  }
  bench.Row("labels, one dispatch", batch);
  for (RenderRequest& r : batch) r.tier = Tier::kFast, r.products = {.normal = true};
  const auto many = bench.Row("fast and labels, one dispatch", batch);

  std::printf("\n");
  bench.Try([&] { alone = bench.gpu().TraceAloneMs(recorded); });
  if (plain && alone > 0) PrintBar("a fast frame over its rays alone", plain->gpu_ms / alone, "", 1.3, true, 0, software);
  if (fast && unread)
    PrintBar("reading back, of the frames a second", 100 * (1 - unread->wall_ms / fast->wall_ms), "%", 5, true, 0, software);
  if (fast) PrintBar("fast with all labels, 2048x1024", 1000 / fast->wall_ms, "pictures/s", 90, false, 300, software);
  if (high) PrintBar("high with all labels, 4096x2048", 1000 / high->wall_ms, "pictures/s", 18, false, 40, software);
  if (many)
    std::printf("%-58s %9.0f pictures/s: reported\n", "fast and labels, 1,024 panoramas of 128x64 in one dispatch",
                1000.0 * static_cast<double>(cameras) / many->wall_ms);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings = Parse(argc, argv);
  if (!FindDevice(settings) || settings.list) return 0;
  if (settings.world.empty()) settings.world = settings.software ? "sunlit_room" : "city_park";
  if (settings.software) settings.seconds = std::min(settings.seconds, 1.0);
  try {
    const double before = Now();
    const auto scene = BuildWorld(settings.world, {.seed = 1});
    const double built = Now();
    Bench bench(settings, scene);
    std::printf("measured on: %s (%s); world %s, %zu instances; built in %.1f s, sky and light baked and all uploaded in %.1f s\n",
                bench.gpu().gpu().name.c_str(), bench.gpu().gpu().driver.c_str(), settings.world.c_str(), scene->instances.size(),
                built - before, Now() - built);
    const Vec3f spawn = scene->spawn.value_or(Vec3f{0, 0, 2});
    RenderRequest request;
    request.X_WC = BodyPose(VecCast<double>(spawn) + Vec3d{0, 0, 0.3}, 0.3, 0, 0) * CameraInBody();
    Measure(bench, request, settings);
    return bench.status();
  } catch (const std::exception& error) {
    std::printf("FAILED: %s\n", error.what());
    return 1;
  }
}

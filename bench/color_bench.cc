// How close frames in colour come to the limit: bare Embree traversal of exactly their rays.
//
// The rays of one frame are recorded as the frame is rendered (ray_recorder.h): camera rays, sun, contact,
// reflections, ambient. They are then traced again, same packets, same order, same scene objects, same flags,
// with nothing else done; the time to read the records from memory is measured too and taken off. Frame and
// replay take turns; the table shows medians and their ratios, on one thread and on all.
//   fast     antialiasing off
//   fast aa  the same with 4 samples on edges, whose rays are recorded and traced again like all others
//   high     4 ambient rays, antialiasing off
//   high aa  the same with 4 samples on edges
// With --latitude: what fewer rays towards the poles save at equal error (WS-PSNR against 256 rays).
// Compare ratios, not milliseconds. --processor takes processor time of all threads instead of time, for a
// machine that does other work, too. With --profile: frames of one kind (--kind) on one thread and nothing
// else, for a profiler.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/renderer.h"
#include "airsim360/scene/viewpoint.h"
#include "airsim360/sensors/rig.h"
#include "clock.h"
#include "median.h"
#include "ray_recorder.h"
#include "scenes.h"

namespace {

using namespace airsim360;
using Clock = std::chrono::steady_clock;

struct Options {
  int width = 2048, rounds = 7;
  std::string scene;  // one of the names below, or a world; empty = the four
  std::string kind;   // empty = all
  bool latitude = false, json = false, profile = false, processor = false;
};

struct World {
  std::string name;
  std::shared_ptr<const Scene> scene;
  Vec3d eye;
};

World MakeWorld(const std::string& name) {
  if (name == "box") return {name, test::MakeOpenSquare(), {0.3, 0.2, 1.7}};
  if (name == "city") return {name, bench::BuildCity({.triangles = 2'000'000}), {0, 0, 30}};
  if (name == "forest") return {name, bench::BuildForest(1500), {0, 0, 3}};
  if (name == "instances") return {name, bench::BuildCity({.triangles = 2'000'000, .trees = 4000}), {0, 0, 30}};
  const auto scene = LoadWorld({.world = name});
  return {name, scene, VecCast<double>(FirstViewpoint(*scene))};
}

double Now(bool processor) {
  if (!processor) return std::chrono::duration<double, std::milli>(Clock::now().time_since_epoch()).count();
  return 1e3 * SecondsOf(CLOCK_PROCESS_CPUTIME_ID);
}

double Milliseconds(const Options& options, const std::function<void()>& job) {
  const double start = Now(options.processor);
  job();
  return Now(options.processor) - start;
}

RenderRequest MakeRequest(const Options& options, const World& world, Tier tier, int edge_samples) {
  RenderRequest request =
      MakeRequest(Equirectangular{options.width, options.width / 2}, RigidTransform{{}, world.eye} * CameraInBody(), tier);
  request.edge_samples = edge_samples;
  return request;
}

void MeasureRatios(const Options& options, const World& world, Renderer& renderer) {
  struct Kind {
    const char* name;
    Tier tier;
    int edge_samples;
  };
  for (const Kind kind :
       {Kind{"fast", Tier::kFast, 1}, Kind{"fast aa", Tier::kFast, 4}, Kind{"high", Tier::kHigh, 1}, Kind{"high aa", Tier::kHigh, 4}}) {
    if (!options.kind.empty() && options.kind != kind.name) continue;
    const RenderRequest request = MakeRequest(options, world, kind.tier, kind.edge_samples);
    Frame frame;
    renderer.Render(request, frame);  // warms up
    if (options.profile) {
      const ThreadLimit one(1);
      for (int round = 0; round < options.rounds; ++round) renderer.Render(request, frame);
      continue;
    }
    std::vector<bench::RecordedPacket> packets;
    bench::RayCounts rays;
    {
      const ThreadLimit one(1);
      const bench::RayRecorder recorder;
      renderer.Render(request, frame);
      packets = recorder.packets();
      rays = recorder.Count();
    }
    double one_thread = 0;
    for (const int threads : {1, 0}) {
      const ThreadLimit limit(threads);
      std::vector<double> whole, raw, read;
      double sum = 0;
      for (int round = 0; round < options.rounds; ++round) {
        whole.push_back(Milliseconds(options, [&] { renderer.Render(request, frame); }));
        raw.push_back(Milliseconds(options, [&] { sum += bench::Replay(packets, true); }));
        read.push_back(Milliseconds(options, [&] { sum += bench::Replay(packets, false); }));
      }
      const double frame_ms = Median(whole), raw_ms = Median(raw) - Median(read);
      if (threads == 1) one_thread = frame_ms;
      std::printf(options.json ? "{\"scene\": \"%s\", \"kind\": \"%s\", \"threads\": %d, \"frame_ms\": %.2f, "
                                 "\"raw_ms\": %.2f, \"ratio\": %.3f, \"mrays_nearest\": %.3f, "
                                 "\"mrays_occlusion\": %.3f, \"speedup\": %.3f}\n"
                               : "%-14s %-8s %3d  frame %8.1f ms  rays %8.1f ms  ratio %5.2f  nearest %6.2f M, "
                                 "occlusion %6.2f M  x%.2f threads\n",
                  world.name.c_str(), kind.name, ThreadCount(), frame_ms, raw_ms, frame_ms / raw_ms, rays.nearest / 1e6,
                  rays.occlusion / 1e6, one_thread / frame_ms);
      std::fflush(stdout);
      if (!std::isfinite(sum)) std::exit(1);
    }
  }
}

// Mean square error of display values weighted by solid angle.
double WsMse(const Image<Rgb8>& a, const Image<Rgb8>& b) {
  double sum = 0, weights = 0;
  for (int y = 0; y < a.height(); ++y) {
    const double w = std::sin(std::numbers::pi * (y + 0.5) / a.height());
    for (int x = 0; x < a.width(); ++x) {
      const Rgb8 p = a(x, y), q = b(x, y);
      sum += w * ((p.r - q.r) * (p.r - q.r) + (p.g - q.g) * (p.g - q.g) + (p.b - q.b) * (p.b - q.b)) / 3.0;
      weights += w;
    }
  }
  return sum / weights;
}

// The times of ambient rays alone (what the frame takes with one ray, off) and of whole frames, at equal error.
void MeasureLatitude(const Options& options, const World& world, Renderer& renderer) {
  RenderRequest request = MakeRequest(options, world, Tier::kHigh, 1);
  const auto render = [&](int samples, bool latitude, bool denoise, uint64_t seed, Frame& frame) {
    request.samples = samples, request.latitude_sampling = latitude, request.seed = seed;
    request.denoise = denoise;
    renderer.Render(request, frame);
  };
  Frame truth, frame;
  render(256, false, false, 1, truth);
  for (const bool denoise : {false, true}) {
    struct Point {
      double ms = 0, mse = 0;
    };
    // Error against time is about a power law.
    const auto measure = [&](int samples, bool latitude) {
      std::vector<double> times;
      for (int i = 0; i < options.rounds; ++i)
        times.push_back(Milliseconds(options, [&] { render(samples, latitude, denoise, 2, frame); }));
      const Point point{Median(times), WsMse(frame.rgb, truth.rgb)};
      std::printf("%-14s %-10s latitude %-3s %2d rays: %8.1f ms, WS-PSNR %.2f dB\n", world.name.c_str(), denoise ? "denoised" : "as traced",
                  latitude ? "on" : "off", samples, point.ms, 10 * std::log10(255 * 255 / point.mse));
      return point;
    };
    const Point least = measure(1, false), on = measure(12, true), low = measure(8, false), high = measure(12, false);
    const double t = std::log(on.mse / low.mse) / std::log(high.mse / low.mse);
    const auto at_equal_error = [&](double fixed_ms) {
      return (on.ms - fixed_ms) / ((low.ms - fixed_ms) * std::pow((high.ms - fixed_ms) / (low.ms - fixed_ms), t));
    };
    const double ray_ms = (high.ms - least.ms) / 11;
    std::printf("%-14s %-10s latitude on / off at equal WS-PSNR: frame %.3f, ambient rays %.3f\n", world.name.c_str(),
                denoise ? "denoised" : "as traced", at_equal_error(0), at_equal_error(least.ms - ray_ms));
    std::fflush(stdout);
  }
}

Options Parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    if (flag == "--json")
      options.json = true;
    else if (flag == "--latitude")
      options.latitude = true;
    else if (flag == "--processor")
      options.processor = true;
    else if (flag == "--profile")
      options.profile = true;
    else if (flag == "--kind" && i + 1 < argc)
      options.kind = argv[++i];
    else if (flag == "--width" && i + 1 < argc)
      options.width = std::atoi(argv[++i]) / 64 * 64;
    else if (flag == "--rounds" && i + 1 < argc)
      options.rounds = std::atoi(argv[++i]);
    else if (flag == "--scene" && i + 1 < argc)
      options.scene = argv[++i];
    else {
      std::fprintf(stderr,
                   "color_bench [--json] [--latitude] [--scene box|city|forest|instances|WORLD] [--width N] "
                   "[--rounds N] [--kind fast|\"fast aa\"|high|\"high aa\"] [--processor] [--profile]\n");
      std::exit(2);
    }
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = Parse(argc, argv);
  std::vector<std::string> names = {"box", "city", "forest", "instances"};
  if (!options.scene.empty()) names = {options.scene};
  for (const std::string& name : names) {
    const World world = MakeWorld(name);
    const auto renderer = MakeCpuRenderer(std::make_shared<const RayTracer>(world.scene), {.tier = Tier::kHigh});
    if (options.latitude)
      MeasureLatitude(options, world, *renderer);
    else
      MeasureRatios(options, world, *renderer);
  }
  return 0;
}

// The denoiser on one panorama: milliseconds and the ratio to copying an RGB picture, by radius and threads;
// medians of alternating rounds. The scene is a ground plane and a wall with noisy light, every pixel a
// surface. Usage: filter_bench [--width W] [--rounds N]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/render/filter/denoiser.h"
#include "median.h"

namespace {

using namespace airsim360;

int Argument(int argc, char** argv, const char* name, int value) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], name) == 0) value = std::atoi(argv[i + 1]);
  }
  return value;
}

/// A box around the camera: 2 m to the ground, 8 m to the walls and the ceiling.
struct Room {
  explicit Room(int width)
      : camera(Equirectangular{width, width / 2}),
        range(width, width / 2),
        entity(width, width / 2),
        normal(width, width / 2),
        light(width, width / 2) {
    RngStream rng(1, "bench");
    for (int y = 0; y < width / 2; ++y) {
      for (int x = 0; x < width; ++x) {
        const Vec3d d = *PixelToRay(camera, {x + 0.5, y + 0.5});
        double nearest = 1e30;
        for (int k = 0; k < 3; ++k) {
          const double t = (k == 1 && d.y > 0 ? 2 : 8) / std::max(1e-9, std::abs(d[k]));
          if (t >= nearest) continue;
          nearest = t;
          Vec3f n;
          n[k] = d[k] > 0 ? -1.0f : 1.0f;
          normal(x, y) = n;
          entity(x, y) = static_cast<uint32_t>(1 + 2 * k + (d[k] > 0));
        }
        range(x, y) = static_cast<float>(nearest);
        const auto v = static_cast<float>(rng.Index(5)) * 0.25f;
        light(x, y) = {v, v, 1.2f * v};
      }
    }
  }
  internal::FilterGuides guides() const { return {&camera, {}, &range, &entity, &normal, &normal}; }

  Camera camera;
  Image<float> range;
  Image<uint32_t> entity;
  Image<Vec3f> normal;
  Image<Rgb32f> light;
};

double Milliseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int main(int argc, char** argv) {
  const int width = std::max(64, Argument(argc, argv, "--width", 2048)) / 2 * 2;
  const int rounds = std::max(1, Argument(argc, argv, "--rounds", 9));
  const Room room(width);
  Image<Rgb32f> copy = room.light;
  const auto copy_picture = [&] {
    ParallelFor(copy.height(), [&](int64_t y) {
      const auto from = room.light.row(static_cast<int>(y));
      std::copy(from.begin(), from.end(), copy.row(static_cast<int>(y)).begin());
    });
  };

  struct Row {
    const char* what;
    float radius;
    bool temporal;
    int threads;
    internal::Denoiser denoiser;
    std::vector<double> times, copies;
  };
  std::vector<Row> rows;
  for (const int threads : {1, 0}) {
    rows.push_back({"radius 4", 4, false, threads, {}, {}, {}});
    rows.push_back({"radius 16", 16, false, threads, {}, {}, {}});
    rows.push_back({"radius 16, temporal", 16, true, threads, {}, {}, {}});
  }
  // The first round warms up: buffers and history.
  for (int round = 0; round <= rounds; ++round) {
    for (Row& row : rows) {
      const ThreadLimit limit(row.threads);
      row.copies.push_back(Milliseconds(copy_picture));
      copy = room.light;
      row.times.push_back(Milliseconds([&] { row.denoiser.Run(room.guides(), {&copy, nullptr, row.radius}, row.temporal); }));
      if (round == 0) row.times.clear(), row.copies.clear();
    }
  }
  std::printf("%dx%d, %d cores\n%-22s %8s %10s %14s\n", width, width / 2, ThreadCount(), "", "threads", "ms", "/ picture copy");
  for (const Row& row : rows) {
    const double ms = Median(row.times);
    std::printf("%-22s %8s %10.1f %14.1f\n", row.what, row.threads == 1 ? "1" : "all", ms, ms / Median(row.copies));
  }
  return 0;
}

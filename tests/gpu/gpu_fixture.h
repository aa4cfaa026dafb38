// A GPU for tests, and how two frames are compared.
#pragma once

#include <gtest/gtest.h>
#include <vulkan/vulkan.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "airsim360/projection/camera_model_names.h"
#include "airsim360/render/vulkan/gpu.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360::test {

/// Skips the test where no device can trace rays.
#define AIRSIM360_NEEDS_GPU()                                                                                              \
  do {                                                                                                                     \
    std::string why = "no Vulkan device traces rays";                                                                      \
    bool any = false;                                                                                                      \
    for (const GpuInfo& gpu : ListGpus(&why)) any |= gpu.missing.empty();                                                  \
    if (!any) GTEST_SKIP() << why << " (apt-get install -t bookworm-backports mesa-vulkan-drivers brings a software one)"; \
  } while (false)

/// Whether the validation layers are installed (Debian: vulkan-validationlayers): tests run under them then, and else say so.
inline bool ValidationInstalled() {
  static const bool installed = [] {
    uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    for (const VkLayerProperties& layer : layers) {
      if (std::string(layer.layerName) == "VK_LAYER_KHRONOS_validation") return true;
    }
    std::printf("without the validation layers, which are not installed (vulkan-validationlayers)\n");
    return false;
  }();
  return installed;
}

/// Worlds that take longer to build than the other tests together: AIRSIM360_GPU_WORLDS="city_park downtown_west".
inline std::vector<std::string> WorldsAskedFor() {
  const char* names = std::getenv("AIRSIM360_GPU_WORLDS");
  std::istringstream words(names ? names : "");
  return {std::istream_iterator<std::string>(words), {}};
}

/// A calibrated lens of every law, with tangential and prism terms in two.
inline std::vector<Camera> CalibratedLenses() {
  const auto lens = [](const char* model, const std::vector<double>& rest, double f, double fov_deg) {
    std::vector<double> parameters{f, 1.02 * f, 41, 31};
    parameters.insert(parameters.end(), rest.begin(), rest.end());
    return MakeCamera(model, 80, 64, parameters, fov_deg);
  };
  return {lens("OPENCV_THIN_PRISM", {-0.2, 0.05, 0.002, -0.001, 0, 0, 0, 0, 0.004, -0.001, -0.003, 0.002}, 60, 90),
          lens("THIN_PRISM_FISHEYE", {0.02, -0.004, 0.0012, -0.0008, 0.0007, -0.0001, 0.0011, -0.0009}, 24, 170),
          lens("RAD_TAN_THIN_PRISM_FISHEYE", {-0.02, 0.1, -0.06, 0.01, 0.002, -0.0006, 0.0004, -0.0002, 0.0003, 0, 0.0002, 0}, 30, 150),
          lens("FOV", {0.92}, 35, 150),
          lens("EUCM", {0.62, 1.1}, 30, 180),
          lens("DOUBLE_SPHERE", {-0.18, 0.59}, 20, 190),
          lens("OMNI", {1.27, -0.21, 0.13, 0.0006, -0.0004}, 85, 120),
          lens("F_THETA", {28, -0.6, 0.4, -1.5, 0.5, -0.1}, 1, 150)};
}

/// A world, kept until another one is asked for.
inline std::shared_ptr<const Scene> WorldOf(const std::string& name) {
  static std::string last;
  static std::shared_ptr<const Scene> scene;
  if (name != last) scene = nullptr, scene = BuildWorld(name, {.seed = 1}), last = name;
  return scene;
}

/// What differs between two label pictures of one request.
struct LabelDifference {
  int pixels = 0;     ///< with a ray
  int different = 0;  ///< entity or category differ
  int far = 0;        ///< of these, more than a pixel from any edge of the first
  double range = 0;   ///< largest relative error of range where labels agree, off edges
  double normal = 0;  ///< likewise largest distance of normals
  int off_edges = 0;  ///< pixels that the last two are about
};

/// Whether any of the nine pixels around differs from pixel (x, y): another entity, or a step in range or normal.
inline bool NearEdge(const Frame& f, int x, int y, bool wraps) {
  const int w = f.entity.width(), h = f.entity.height();
  const float range = f.range(x, y);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      int i = x + dx;
      const int j = y + dy;
      if (wraps) i = (i + w) % w;
      if (i < 0 || j < 0 || i >= w || j >= h) continue;
      if (f.entity(i, j) != f.entity(x, y)) return true;
      if (Dot(f.normal(i, j), f.normal(x, y)) < 0.999f && f.range(i, j) > 0) return true;
      // Of a plane 1 / range is linear: a step shows against both neighbours of a line, here by its size.
      if (std::fabs(f.range(i, j) - range) > 0.3f * std::min(range, f.range(i, j))) return true;
    }
  }
  return false;
}

inline LabelDifference Compare(const Frame& cpu, const Frame& gpu, bool wraps) {
  LabelDifference out;
  for (int y = 0; y < cpu.entity.height(); ++y) {
    for (int x = 0; x < cpu.entity.width(); ++x) {
      if (cpu.entity(x, y) == 0 && gpu.entity(x, y) == 0) continue;
      ++out.pixels;
      const bool edge = NearEdge(cpu, x, y, wraps);
      if (cpu.entity(x, y) != gpu.entity(x, y) || cpu.semantic(x, y) != gpu.semantic(x, y)) {
        ++out.different;
        out.far += edge ? 0 : 1;
        continue;
      }
      if (edge || cpu.range(x, y) <= 0) continue;
      ++out.off_edges;
      const double error = std::fabs(static_cast<double>(cpu.range(x, y)) - gpu.range(x, y)) / cpu.range(x, y);
      if (!(error <= out.range)) out.range = error;
      const double bent = Norm(cpu.normal(x, y) - gpu.normal(x, y));
      if (!(bent <= out.normal)) out.normal = bent;
    }
  }
  return out;
}

}  // namespace airsim360::test

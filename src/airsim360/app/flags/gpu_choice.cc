#include "airsim360/app/flags/gpu_choice.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "airsim360/base/error.h"
#include "airsim360/render/vulkan/gpu.h"

namespace airsim360 {
namespace {

constexpr int kMostGpus = 255;

std::string Listed(const std::vector<GpuInfo>& gpus, const std::string& why) {
  if (gpus.empty()) return "there is no GPU: " + why;
  std::string list = "GPUs here:";
  for (const GpuInfo& gpu : gpus)
    list += (gpu.index > 0 ? ", " : " ") + std::to_string(gpu.index) + " = " + gpu.name + (gpu.software ? " (software)" : "") +
            (gpu.missing.empty() ? "" : " (cannot trace rays)");
  return list;
}

std::vector<int> AllGpus(const std::vector<GpuInfo>& gpus, const std::string& why) {
  for (const bool software : {false, true}) {
    std::vector<int> usable;
    for (const GpuInfo& gpu : gpus) {
      if (gpu.missing.empty() && gpu.software == software) usable.push_back(gpu.index);
    }
    if (!usable.empty()) return usable;
  }
  throw InputError("--gpu: 'all': none can trace rays; " + Listed(gpus, why));
}

}  // namespace

std::vector<int> ParseGpus(const std::string& text, bool several) {
  const std::string forms = several ? "an index, several (0,1) or all" : "an index from 0";
  std::string why;
  if (several && text == "all") {
    const std::vector<GpuInfo> gpus = ListGpus(&why);
    return AllGpus(gpus, why);
  }
  std::vector<int> wanted;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    int gpu = -1;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), gpu);
    if (error != std::errc() || end != part.data() + part.size() || gpu < 0 || gpu > kMostGpus)
      throw InputError("--gpu: '" + text + "' is not " + forms + " (0 … 255)");
    if (std::ranges::count(wanted, gpu) > 0) throw InputError("--gpu: '" + text + "' names GPU " + part + " twice");
    wanted.push_back(gpu);
  }
  if (wanted.empty() || text.ends_with(',') || (wanted.size() > 1 && !several))
    throw InputError("--gpu: '" + text + "' is not " + forms + " (0 … 255)");
  const std::vector<GpuInfo> gpus = ListGpus(&why);
  for (const int gpu : wanted) {
    if (gpu >= static_cast<int>(gpus.size())) throw InputError("--gpu: there is no GPU " + std::to_string(gpu) + "; " + Listed(gpus, why));
  }
  return wanted;
}

}  // namespace airsim360

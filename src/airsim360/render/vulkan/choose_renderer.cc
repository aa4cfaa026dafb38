#include "airsim360/render/vulkan/choose_renderer.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/base/choice.h"
#include "airsim360/base/log.h"
#include "airsim360/render/indoor/enclosure.h"
#include "airsim360/render/relightable.h"

namespace airsim360 {
namespace {

bool IsLit(Tier tier) { return tier == Tier::kFast || tier == Tier::kHigh; }

// Rooms are lit by surfels that only the CPU looks up.
bool HasRooms(const RayTracer& tracer) { return internal::Enclosure(tracer).any(); }

// A GPU for as long as it can, then the CPU.
class AutoRenderer : public Renderer, public Relightable {
 public:
  AutoRenderer(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options, std::unique_ptr<GpuRenderer> gpu)
      : tracer_(std::move(tracer)), rooms_(HasRooms(*tracer_)), options_(options), gpu_(std::move(gpu)) {}

  RenderStats Render(const RenderRequest& request, Frame& frame) override {
    if (gpu_ && !(rooms_ && IsLit(request.tier))) {
      try {
        return gpu_->Render(request, frame);
      } catch (const RuntimeError& error) {
        LogWarning(std::string("device: going on with the cpu: ") + error.what());
        gpu_.reset();
      }
    }
    if (!cpu_) cpu_ = MakeCpuRenderer(tracer_, options_);
    return cpu_->Render(request, frame);
  }

  bool SetEnvironment(const Environment& environment) override {
    options_.environment = environment;
    auto* cpu = dynamic_cast<Relightable*>(cpu_.get());
    return cpu != nullptr && cpu->SetEnvironment(environment);
  }

 private:
  std::shared_ptr<const RayTracer> tracer_;
  bool rooms_;
  RendererOptions options_;
  std::unique_ptr<GpuRenderer> gpu_;
  std::unique_ptr<Renderer> cpu_;
};

// Why no GPU should be used by itself: in words, or empty where nobody expects one; nothing = one should.
std::optional<std::string> WhyNot(int wanted) {
  if (wanted < 0 && !MachineHasGpu()) return "";
  std::string why = "no GPU";
  bool hardware = wanted >= 0;
  const std::vector<GpuInfo> gpus = ListGpus(&why);
  if (const int count = static_cast<int>(gpus.size()); count > 0 && wanted >= count)
    return "there is no GPU " + std::to_string(wanted) + ", the last is " + std::to_string(count - 1) + ": " + gpus.back().name;
  for (const GpuInfo& gpu : gpus) {
    if (wanted >= 0 && gpu.index != wanted) continue;
    if (gpu.missing.empty() && (!gpu.software || wanted >= 0)) return {};
    if (gpu.software) continue;
    hardware = true;
    why = gpu.name + ": " + gpu.missing;
  }
  // A device file whose Vulkan driver is missing.
  if (!hardware && !gpus.empty())
    why = "this machine has a GPU, but no Vulkan driver for it was found (VK_DRIVER_FILES names one elsewhere; docs/guide/gpu.md)";
  return why;
}

}  // namespace

void CheckDevice(const std::string& flag, const std::string& device) {
  static const std::vector<std::string> kDevices = {"auto", "cpu", "vulkan"};
  ParseChoice("device", device, kDevices, flag);
}

bool ChoosesGpu(const DeviceChoice& choice) { return choice.device != "cpu" && (choice.device == "vulkan" || !WhyNot(choice.gpu)); }

std::unique_ptr<Renderer> MakeRenderer(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options,
                                       const DeviceChoice& choice) {
  CheckDevice("--device", choice.device);
  if (choice.device == "cpu") return MakeCpuRenderer(std::move(tracer), options);
  const GpuOptions gpu_options{.gpu = choice.gpu, .fault = choice.fault};
  if (choice.device == "vulkan" && IsLit(options.tier) && HasRooms(*tracer)) {
    throw InputError("--device vulkan: tier " + std::string(kTierNames[static_cast<int>(options.tier)]) + " of '" + tracer->scene().name +
                     "', which has rooms, needs the light of rooms that only the CPU computes; did you mean --device cpu?");
  }
  if (choice.device == "vulkan") return MakeVulkanRenderer(std::move(tracer), options, gpu_options);
  std::optional<std::string> why = WhyNot(choice.gpu);
  if (!why) {
    try {
      auto gpu = MakeVulkanRenderer(tracer, options, gpu_options);
      LogInfo("device: " + gpu->gpu().name);
      return std::make_unique<AutoRenderer>(std::move(tracer), options, std::move(gpu));
    } catch (const RuntimeError& error) {
      why = error.what();
    }
  }
  if (!why->empty()) LogInfo("device: cpu (" + *why + ")");
  return MakeCpuRenderer(std::move(tracer), options);
}

}  // namespace airsim360

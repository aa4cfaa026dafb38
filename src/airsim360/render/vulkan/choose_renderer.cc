#include "airsim360/render/vulkan/choose_renderer.h"

#include <utility>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/log.h"

namespace airsim360 {
namespace {

// A GPU for as long as it can, then the CPU.
class AutoRenderer : public Renderer {
 public:
  AutoRenderer(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options,
               std::unique_ptr<GpuRenderer> gpu)
      : tracer_(std::move(tracer)), options_(options), gpu_(std::move(gpu)) {}

  RenderStats Render(const RenderRequest& request, Frame& frame) override {
    if (gpu_) {
      const std::string what = GpuCannot(
          request.tier, options_.environment.value_or(tracer_->scene().environment), request.products, request.temporal);
      if (what.empty()) {
        try {
          return gpu_->Render(request, frame);
        } catch (const RuntimeError& error) {
          LogWarning(std::string("device: going on with the cpu: ") + error.what());
          gpu_.reset();
        }
      } else if (!cpu_) {
        LogInfo("device: cpu for " + what + ", which the GPU cannot draw yet");
      }
    }
    if (!cpu_) cpu_ = MakeCpuRenderer(tracer_, options_);
    return cpu_->Render(request, frame);
  }

 private:
  std::shared_ptr<const RayTracer> tracer_;
  RendererOptions options_;
  std::unique_ptr<GpuRenderer> gpu_;
  std::unique_ptr<Renderer> cpu_;
};

// Why no GPU should be used by itself; empty = one should.
std::string WhyNot(int wanted, Tier tier, const Environment& environment) {
  if (const std::string what = GpuCannot(tier, environment); !what.empty())
    return "the GPU cannot draw " + what + " yet";
  std::string why = "no GPU";
  for (const GpuInfo& gpu : ListGpus(&why)) {
    if (wanted >= 0 && gpu.index != wanted) continue;
    if (gpu.missing.empty() && (!gpu.software || wanted >= 0)) return "";
    why = gpu.name + (gpu.missing.empty() ? " is software, slower than the CPU renderer" : ": " + gpu.missing);
  }
  return why;
}

}  // namespace

std::unique_ptr<Renderer> MakeRenderer(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options,
                                       const DeviceChoice& choice) {
  if (choice.device == "cpu") return MakeCpuRenderer(std::move(tracer), options);
  const Environment& environment = options.environment ? *options.environment : tracer->scene().environment;
  if (choice.device == "vulkan") {
    if (const std::string what = GpuCannot(options.tier, environment); !what.empty())
      throw RuntimeError("--device vulkan cannot draw " + what + " yet; use --device cpu");
    return MakeVulkanRenderer(std::move(tracer), options, {.gpu = choice.gpu});
  }
  if (choice.device != "auto") {
    static const std::vector<std::string> kDevices = {"auto", "cpu", "vulkan"};
    throw InputError("--device: " + UnknownChoiceMessage("device", choice.device, kDevices));
  }
  std::string why = WhyNot(choice.gpu, options.tier, environment);
  if (why.empty()) {
    try {
      auto gpu = MakeVulkanRenderer(tracer, options, {.gpu = choice.gpu});
      LogInfo("device: " + gpu->gpu().name);
      return std::make_unique<AutoRenderer>(std::move(tracer), options, std::move(gpu));
    } catch (const RuntimeError& error) {
      why = error.what();
    }
  }
  LogInfo("device: cpu (" + why + ")");
  return MakeCpuRenderer(std::move(tracer), options);
}

}  // namespace airsim360

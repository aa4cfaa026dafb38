#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/render/filter/exposure.h"
#include "airsim360/render/frame/daylight.h"
#include "airsim360/render/shading/shader.h"
#include "airsim360/render/vulkan/gpu.h"
#include "airsim360/render/vulkan/gpu_high.h"
#include "airsim360/render/vulkan/gpu_path.h"
#include "airsim360/render/vulkan/gpu_shade.h"
#include "airsim360/render/vulkan/gpu_shaders.h"
#include "airsim360/render/vulkan/gpu_share.h"
#include "airsim360/render/vulkan/gpu_slot.h"

namespace airsim360 {

namespace {

using namespace internal;

constexpr size_t kMaxMaterials = UINT16_MAX - 1;

template <class Pixel>
void Take(std::span<const Pixel> from, int width, int height, Image<Pixel>& to) {
  if (from.empty()) {
    to = {};
    return;
  }
  if (to.width() != width || to.height() != height) to = Image<Pixel>(width, height);
  std::copy(from.begin(), from.end(), to.pixels().begin());
}

// Pixels as the GPU left them.
void CopyFrame(const GpuFrame& from, Frame& to) {
  const int w = from.width, h = from.height;
  Take(from.rgb, w, h, to.rgb);
  Take(from.range, w, h, to.range);
  Take(from.semantic, w, h, to.semantic);
  Take(from.entity, w, h, to.entity);
  Take(from.normal, w, h, to.normal);
  Take(from.position, w, h, to.position);
  Take(from.albedo, w, h, to.albedo);
  Take(from.material, w, h, to.material);
  Take(from.flow, w, h, to.flow);
  Take(from.radiance, w, h, to.radiance);
  Take(from.coverage, w, h, to.coverage);
}

class VulkanRenderer : public GpuRenderer {
 public:
  VulkanRenderer(std::shared_ptr<const RayTracer> tracer, const RendererOptions& what, const GpuOptions& options)
      : tracer_(std::move(tracer)),
        environment_(what.environment.value_or(tracer_->scene().environment)),
        device_(options),
        scene_(device_, std::shared_ptr<const Scene>(tracer_, &tracer_->scene())),
        cameras_(device_),
        history_(device_),
        labels_(device_, LabelsRaygen()) {
    if (options.frames_in_flight < 1 || options.frames_in_flight > 16)
      throw InputError("frames in flight: " + std::to_string(options.frames_in_flight) + " is not in 1 … 16");
    for (int i = 0; i < options.frames_in_flight; ++i) slots_.push_back(std::make_unique<GpuSlot>(device_, scene_));
    if (what.tier != Tier::kLabels) PrepareColor();
    if (what.tier == Tier::kHigh) PrepareHigh();
  }

  RenderStats Render(const RenderRequest& asked, Frame& frame) override {
    const auto start = std::chrono::steady_clock::now();
    RenderRequest request = asked;
    if (request.auto_exposure && WantsColor(request)) request.exposure_ev += AutoEv(request);
    const uint64_t ticket = Submit({&request, 1});
    CopyFrame(Wait(ticket).front(), frame);
    Release(ticket);
    frame.light = {};
    if (request.light && WantsColor(request)) TakeLight(request, frame);
    frame.exposure = WantsColor(request) ? Exposure(request) : 1;
    RenderStats stats;
    stats.rays = static_cast<uint64_t>(Width(request.camera)) * static_cast<uint64_t>(Height(request.camera));
    stats.render_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return stats;
  }

  uint64_t Submit(std::span<const RenderRequest> requests) override {
    Check(requests);
    if (requests.front().tier == Tier::kHigh && std::ranges::any_of(requests, &WantsColor)) history_.Count(requests.front().temporal);
    return Start(requests);
  }

  std::vector<GpuFrame> Wait(uint64_t ticket) override {
    GpuSlot& slot = SlotOf(ticket);
    slot.Wait();
    gpu_ms_ = slot.gpu_ms();
    return slot.Frames();
  }

  void Release(uint64_t ticket) override {
    GpuSlot& slot = SlotOf(ticket);
    slot.Wait();
    slot.ticket = 0;
  }

  std::unique_ptr<GpuSharedMemory> Share(size_t bytes) override { return MakeSharedBuffer(device_, bytes); }
  size_t PictureBytes(uint64_t ticket) override { return SlotOf(ticket).bytes(); }
  std::vector<GpuFrame> Copy(uint64_t ticket, GpuSharedMemory& to, const std::byte* base) override {
    GpuSlot& slot = SlotOf(ticket);
    slot.Wait();
    gpu_ms_ = slot.gpu_ms();
    CopyToShared(device_, slot.pictures(), slot.bytes(), to);
    return slot.FramesAt(base);
  }
  void ReadBack(bool wanted) override { read_back_ = wanted; }
  double TraceAloneMs(const RenderRequest& request) override {
    if (request.tier != Tier::kFast || !WantsColor(request)) throw InputError("GPU: rays are recorded of tier 'fast' alone");
    Check({&request, 1});
    PrepareColor();
    GpuSlot::Work work{.shade = shade_->address(request.tone), .numbers = kGpuRecordPlanes, .read_back = false};
    work.passes.push_back({Made(record_, RecordRaygen())});
    const auto time = [&] {
      const uint64_t ticket = Start({&request, 1}, work);
      Wait(ticket);
      Release(ticket);
      return gpu_ms_;
    };
    // Recorded and traced once, then recorded and traced three times. The fastest of a few: clocks of a GPU that idled, while
    // shaders were compiled say, take some frames to rise.
    const auto least = [&] {
      double best = time();
      for (int k = 0; k < 8; ++k) best = std::min(best, time());
      return best;
    };
    work.passes.push_back({Made(replay_, ReplayRaygen())});
    const double once = least();
    work.passes.insert(work.passes.end(), 2, {replay_.get()});
    return (least() - once) / 2;
  }
  const GpuInfo& gpu() const override { return device_.info(); }
  double gpu_ms() const override { return gpu_ms_; }
  std::vector<std::string> messages() const override { return device_.messages(); }

 private:
  uint64_t Start(std::span<const RenderRequest> requests) { return Start(requests, WorkFor(requests)); }
  uint64_t Start(std::span<const RenderRequest> requests, const GpuSlot::Work& work) {
    const auto free = std::ranges::find(slots_, 0u, [](const auto& slot) { return slot->ticket; });
    if (free == slots_.end()) throw RuntimeError("GPU: all " + std::to_string(slots_.size()) + " frames in flight are taken; release one");
    const bool idle = std::ranges::all_of(slots_, [](const auto& slot) { return slot->ticket == 0; });
    if (idle) cameras_.Trim();
    (*free)->Submit(requests, cameras_, work);
    return (*free)->ticket = ++last_ticket_;
  }
  GpuSlot::Work WorkFor(std::span<const RenderRequest> requests) {
    const bool shaded = std::ranges::any_of(requests, [](const RenderRequest& r) { return WantsColor(r) || r.products.albedo; });
    if (shaded) PrepareColor();
    GpuSlot::Work work = shaded ? ColorWork(requests) : GpuSlot::Work{.passes = {{&labels_}}};
    work.read_back = read_back_;
    if (std::ranges::any_of(requests, [](const RenderRequest& r) { return r.products.coverage; }))
      work.passes.push_back({Made(coverage_, CoverageRaygen())});
    return work;
  }
  // Stops to add so that the picture is exposed by its own histogram: it is rendered once for that alone.
  double AutoEv(RenderRequest request) {
    request.products = {.rgb = false, .range = false, .semantic = false, .entity = false, .radiance = true};
    Image<Rgb32f> radiance;
    request.temporal = false;
    const uint64_t ticket = Start({&request, 1});
    const GpuFrame frame = Wait(ticket).front();
    Take(frame.radiance, frame.width, frame.height, radiance);
    Release(ticket);
    return AutoExposureEv(radiance, request.camera, shader_->Exposure(), shader_->MostExposure());
  }
  // The radiance that came is the light; that of pixel centres, if wanted too, is rendered again where it differs.
  void TakeLight(RenderRequest request, Frame& frame) {
    frame.light = std::move(frame.radiance);
    frame.radiance = {};
    if (request.products.radiance && request.tier == Tier::kFast) {
      request.products = {.rgb = false, .range = false, .semantic = false, .entity = false, .radiance = true};
      request.light = false;
      const uint64_t ticket = Start({&request, 1});
      const GpuFrame centers = Wait(ticket).front();
      Take(centers.radiance, centers.width, centers.height, frame.radiance);
      Release(ticket);
    } else if (request.products.radiance) {
      frame.radiance = frame.light;
    }
    if (!label_tables_) label_tables_ = std::make_unique<LabelTables>(*tracer_);
    frame.daylight = DaylightAt(*tracer_, *shader_, label_tables_->view(), VecCast<float>(request.X_WC.p));
  }
  static bool WantsColor(const RenderRequest& r) { return r.tier != Tier::kLabels && (r.products.rgb || r.products.radiance || r.light); }
  float Exposure(const RenderRequest& r) const { return shader_->Exposure() * static_cast<float>(std::exp2(r.exposure_ev)); }
  const GpuPipeline* Made(std::unique_ptr<GpuPipeline>& pipeline, std::span<const uint32_t> raygen) {
    if (!pipeline) pipeline = std::make_unique<GpuPipeline>(device_, raygen);
    return pipeline.get();
  }
  // The passes of a colour tier, in their order.
  GpuSlot::Work ColorWork(std::span<const RenderRequest> requests) {
    GpuSlot::Work work{.shade = shade_->address(requests.front().tone), .exposure = shader_->Exposure()};
    const bool antialias = std::ranges::any_of(requests, [](const RenderRequest& r) { return ColorSamples(r) > 1; });
    if (std::ranges::any_of(requests, [](const RenderRequest& r) { return r.products.flow; })) work.passes.push_back({&labels_});
    if (requests.front().tier == Tier::kHigh) {
      PrepareHigh();
      work.high = high_tables_->address();
      work.numbers = kGpuHighPlanes;
      const bool denoise = std::ranges::any_of(requests, &RenderRequest::denoise);
      const bool temporal = requests.front().temporal;
      work.frames = temporal ? history_.frames() : 0;
      work.history = temporal && denoise ? &history_ : nullptr;
      AddHighPasses(denoise, antialias, work);
      return work;
    }
    const bool paths = requests.front().tier == Tier::kReference && std::ranges::any_of(requests, &WantsColor);
    if (paths) {
      // Labels come from the centre rays alone.
      if (work.passes.empty()) work.passes.push_back({&labels_});
      AddPathPasses(requests, work);
    }
    const bool albedo = std::ranges::any_of(requests, [](const RenderRequest& r) { return r.products.albedo; });
    if (!paths || albedo) work.passes.insert(work.passes.begin(), {Made(color_, ColorRaygen())});
    if (antialias) work.passes.push_back({Made(edges_, EdgesRaygen())});
    return work;
  }
  void AddHighPasses(bool denoise, bool antialias, GpuSlot::Work& work) {
    // Numbers as in filter.rgen.
    constexpr int kLoad = 0, kLevel = 5, kLevels = 4, kRemember = 10, kKeep = 11;
    constexpr int kMoreRounds = 2;  // the last of high_light.rgen
    const GpuPipeline* filter = Made(filter_, FilterRaygen());
    work.passes.push_back({Made(high_, HighRaygen())});
    for (int pass = 0; pass <= kMoreRounds; ++pass) work.passes.push_back({Made(high_light_, HighLightRaygen()), pass});
    work.passes.push_back({filter, kLoad});
    if (work.history != nullptr) work.passes.insert(work.passes.end(), {{filter, kRemember}, {filter, kKeep}});
    for (int pass = kLoad + 1; pass < kLevel + kLevels && denoise; ++pass) work.passes.push_back({filter, pass});
    work.passes.push_back({Made(combine_, CombineRaygen())});
    if (antialias) work.passes.push_back({Made(high_edges_, HighEdgesRaygen())});
  }
  void AddPathPasses(std::span<const RenderRequest> requests, GpuSlot::Work& work) {
    if (!path_tables_) path_tables_ = std::make_unique<GpuPathTables>(device_, *shader_, *tracer_);
    work.path = path_tables_->address();
    work.numbers = kGpuPathPlanes;
    int most = 0;
    uint64_t pixels = 0;
    for (const RenderRequest& r : requests) {
      most = std::max(most, PathSamples(r));
      pixels += static_cast<uint64_t>(Width(r.camera)) * static_cast<uint64_t>(Height(r.camera));
    }
    const int paths = GpuPathsOfAPass(pixels);
    for (int first = 0; first < most; first += paths) work.passes.push_back({Made(path_, PathRaygen()), first, paths, first > 0});
  }
  void PrepareHigh() {
    if (!high_tables_) high_tables_ = std::make_unique<GpuHighTables>(device_, *shader_, *tracer_);
  }
  // The CPU's shader bakes sky, probes and lamps; its tables go to the GPU.
  void PrepareColor() {
    if (!shader_) shader_ = std::make_unique<Shader>(tracer_, environment_);
    if (!shade_) shade_ = std::make_unique<GpuShadeTables>(device_, *shader_, tracer_->scene());
  }
  GpuSlot& SlotOf(uint64_t ticket) {
    for (const auto& slot : slots_) {
      if (ticket != 0 && slot->ticket == ticket) return *slot;
    }
    throw InputError("GPU: no submission " + std::to_string(ticket));
  }

  void Check(std::span<const RenderRequest> requests) const {
    if (requests.empty()) throw InputError("GPU: a submission without cameras");
    const RenderRequest& first = requests.front();
    const Scene& scene = tracer_->scene();
    for (const RenderRequest& r : requests) {
      if (r.temporal && requests.size() > 1)
        throw InputError("GPU: light of the last frame is kept for one camera, not for the " + std::to_string(requests.size()) +
                         " of a submission");
      if (r.state != first.state || r.next_state != first.next_state || r.tier != first.tier || r.tone != first.tone)
        throw InputError("GPU: the cameras of a submission must share state, tier and tone curve");
      if (r.products.material && scene.materials.size() > kMaxMaterials)
        throw InputError("material ids have 16 bits, the scene has " + std::to_string(scene.materials.size()) + " materials");
    }
    if (first.state) CheckState(scene, *first.state);
    if (first.next_state) CheckState(scene, *first.next_state);
  }

  std::shared_ptr<const RayTracer> tracer_;
  Environment environment_;
  GpuDevice device_;
  GpuScene scene_;
  GpuCameras cameras_;
  GpuHistory history_;
  GpuPipeline labels_;
  std::unique_ptr<Shader> shader_;  // this and the next two: made when colour is first wanted
  std::unique_ptr<GpuShadeTables> shade_;
  std::unique_ptr<GpuHighTables> high_tables_;
  std::unique_ptr<GpuPathTables> path_tables_;
  std::unique_ptr<LabelTables> label_tables_;  // of the scene as built, for the sun's visibility
  std::unique_ptr<GpuPipeline> color_, edges_, high_, high_light_, filter_, combine_, high_edges_, path_, coverage_, record_, replay_;
  std::vector<std::unique_ptr<GpuSlot>> slots_;
  uint64_t last_ticket_ = 0;
  double gpu_ms_ = 0;  // of the submission waited for last
  bool read_back_ = true;
};

}  // namespace

std::unique_ptr<GpuRenderer> MakeVulkanRenderer(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options,
                                                const GpuOptions& gpu) {
  return std::make_unique<VulkanRenderer>(std::move(tracer), options, gpu);
}

}  // namespace airsim360

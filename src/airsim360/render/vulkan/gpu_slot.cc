#include "airsim360/render/vulkan/gpu_slot.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr size_t kNowhere = SIZE_MAX;
constexpr uint64_t kPatienceNs = uint64_t{300} * 1'000'000'000;

// The products in the order of Place::offset.
enum Product { kRange, kEntity, kSemantic, kNormal, kPosition, kMaterial, kFlowProduct, kAlbedo, kRadiance, kRgb, kCoverage };
constexpr size_t kProducts = GpuSlot::kProducts;
constexpr size_t kPixelBytes[kProducts] = {4, 4, 2, 12, 12, 2, 28, 12, 12, 3, 32};
constexpr uint32_t kWant[kProducts] = {kWantRange, kWantEntity, kWantSemantic, kWantNormal, kWantPosition, kWantMaterial,
                                       kWantFlow,  kWantAlbedo, kWantRadiance, kWantRgb,    kWantCoverage};

std::array<bool, kProducts> Wanted(const RenderRequest& request) {
  const Products& p = request.products;
  const bool color = request.tier != Tier::kLabels;
  return {p.range,        p.entity,  p.semantic, p.normal, p.position, p.material, p.flow, p.albedo, color && (p.radiance || request.light),
          color && p.rgb, p.coverage};
}

VkCommandBuffer NewCommands(VkDevice device, VkCommandPool pool) {
  const VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
  VkCommandBuffer commands;
  CheckVk(vkAllocateCommandBuffers(device, &info, &commands), "making commands");
  return commands;
}

void BeginOnce(VkCommandBuffer commands) {
  const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
                                       nullptr};
  CheckVk(vkBeginCommandBuffer(commands, &begin), "recording");
}

void PutBarrier(VkCommandBuffer commands, VkPipelineStageFlags from, VkAccessFlags wrote, VkPipelineStageFlags to, VkAccessFlags then) {
  const VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, wrote, then};
  vkCmdPipelineBarrier(commands, from, to, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

template <class T>
std::span<const T> SpanAt(const std::byte* base, size_t offset, size_t count) {
  if (base == nullptr || offset == kNowhere) return {};
  return {reinterpret_cast<const T*>(base + offset), count};
}

}  // namespace

GpuSlot::GpuSlot(GpuDevice& device, const GpuScene& scene) : device_(device), scene_(scene), now_(device, scene) {
  const VkDevice d = device.device();
  const VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0, device.queue_family()};
  CheckVk(vkCreateCommandPool(d, &pool, nullptr, &pool_), "making a command pool");
  if (device.discrete()) {
    const VkCommandPoolCreateInfo copies{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0, device.copy_family()};
    CheckVk(vkCreateCommandPool(d, &copies, nullptr, &copy_pool_), "making a command pool");
    copy_ = NewCommands(d, copy_pool_);
    const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, nullptr, 0};
    CheckVk(vkCreateSemaphore(d, &semaphore, nullptr, &traced_), "making a semaphore");
  }
  const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, 0};
  CheckVk(vkCreateFence(d, &fence, nullptr, &fence_), "making a fence");
  if (device.timestamp_period_ns() > 0) {
    VkQueryPoolCreateInfo clock{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, nullptr};
    clock.queryType = VK_QUERY_TYPE_TIMESTAMP;
    clock.queryCount = 2;
    CheckVk(vkCreateQueryPool(d, &clock, nullptr, &clock_), "making a clock");
  }
}

GpuSlot::~GpuSlot() {
  if (!waited_) vkWaitForFences(device_.device(), 1, &fence_, VK_TRUE, kPatienceNs);
  if (clock_ != VK_NULL_HANDLE) vkDestroyQueryPool(device_.device(), clock_, nullptr);
  vkDestroyFence(device_.device(), fence_, nullptr);
  vkDestroySemaphore(device_.device(), traced_, nullptr);
  vkDestroyCommandPool(device_.device(), pool_, nullptr);
  vkDestroyCommandPool(device_.device(), copy_pool_, nullptr);
}

// Where the pictures go, one after another.
void GpuSlot::Arrange(std::span<const RenderRequest> requests, const Work& work) {
  places_.clear();
  bytes_ = 0, width_ = height_ = 0;
  for (const RenderRequest& request : requests) {
    Place place{};
    place.width = Width(request.camera), place.height = Height(request.camera);
    if (place.width <= 0 || place.height <= 0)
      throw InputError("camera of " + std::to_string(place.width) + "x" + std::to_string(place.height) + " pixels");
    const size_t pixels = static_cast<size_t>(place.width) * static_cast<size_t>(place.height);
    const auto wanted = Wanted(request);
    for (size_t k = 0; k < kProducts; ++k) {
      place.offset[k] = wanted[k] ? bytes_ : kNowhere;
      if (wanted[k]) bytes_ += (pixels * kPixelBytes[k] + 63) / 64 * 64;
    }
    width_ = std::max(width_, static_cast<uint32_t>(place.width));
    height_ = std::max(height_, static_cast<uint32_t>(place.height));
    places_.push_back(place);
  }
  const size_t all_bytes = ArrangePasses(requests, work);
  const uint64_t invocations = uint64_t{width_} * height_ * requests.size();
  if (invocations > device_.pipeline_limits().maxRayDispatchInvocationCount)
    throw RuntimeError("GPU: " + std::to_string(invocations) + " rays at once are more than " + device_.info().name + " takes (" +
                       std::to_string(device_.pipeline_limits().maxRayDispatchInvocationCount) +
                       "): render a smaller picture or fewer cameras");

  // Software renders straight to memory that the CPU reads.
  const size_t size = std::max<size_t>(bytes_, 64);
  const size_t all = std::max<size_t>(all_bytes, 64);
  const bool copies = device_.discrete();
  if (copies && pictures_.size() < all) pictures_ = GpuBuffer(device_, all, MemoryKind::kDevice);
  if (read_back_.size() < (copies ? size : all)) read_back_ = GpuBuffer(device_, copies ? size : all, MemoryKind::kReadBack);
}

// Memory behind the pictures for the GPU alone; returns the size of all.
size_t GpuSlot::ArrangePasses(std::span<const RenderRequest> requests, const Work& work) {
  size_t size = bytes_;
  const auto take = [&](size_t bytes) {
    const size_t at = size;
    size += (bytes + 63) / 64 * 64;
    return at;
  };
  // Shaders count these with 31 bits.
  if (work.numbers * width_ * height_ > INT32_MAX)
    throw RuntimeError("GPU: this tier draws at most " + std::to_string(INT32_MAX / work.numbers) + " pixels: render a smaller picture");
  for (size_t i = 0; i < requests.size(); ++i) {
    Place& place = places_[i];
    const size_t words = 4 * static_cast<size_t>(place.width) * static_cast<size_t>(place.height);
    place.entity = place.offset[kEntity], place.centers = kNowhere;
    place.planes = work.numbers > 0 ? take(work.numbers * words) : kNowhere;
    const bool antialias = work.numbers == 0 && ColorSamples(requests[i]) > 1;
    if (antialias) place.centers = take(words);
    if ((antialias || requests[i].products.coverage) && place.entity == kNowhere) place.entity = take(words);
  }
  return size;
}

void GpuSlot::FillParameters(std::span<const RenderRequest> requests, GpuCameras& cameras, const Work& work) {
  size_t size = sizeof(GpuFrameParams) + requests.size() * sizeof(GpuCamera) + 256;
  for (const RenderRequest& request : requests) size += GpuCameras::Size(request);
  if (upload_.size() < size) upload_ = GpuBuffer(device_, size, MemoryKind::kUpload);
  UploadCursor cursor{upload_.mapped(), upload_.address(), 0, upload_.size()};
  auto* params = reinterpret_cast<GpuFrameParams*>(cursor.Take(sizeof(GpuFrameParams), parameters_));
  *params = {};
  auto* list = reinterpret_cast<GpuCamera*>(cursor.Take(requests.size() * sizeof(GpuCamera), params->cameras));
  const VkDeviceAddress base = pictures().address();
  for (size_t i = 0; i < requests.size(); ++i) {
    GpuCamera camera{};
    cameras.Fill(requests[i], work.frames, cursor, camera);
    if (work.history != nullptr) work.history->Fill(requests[i], cameras.field(), camera);
    uint64_t* const to[kProducts] = {&camera.range, &camera.entity, &camera.semantic, &camera.normal, &camera.position, &camera.material,
                                     &camera.flow,  &camera.albedo, &camera.radiance, &camera.rgb,    &camera.coverage};
    for (size_t k = 0; k < kProducts; ++k) {
      if (places_[i].offset[k] == kNowhere) continue;
      *to[k] = base + places_[i].offset[k];
      camera.wanted |= kWant[k];
    }
    if (requests[i].light) camera.wanted |= kWantLight;
    if (places_[i].entity != kNowhere) {
      camera.entity = base + places_[i].entity;
      camera.wanted |= kWantEntity;
    }
    if (places_[i].centers != kNowhere) {
      camera.centers = base + places_[i].centers;
    } else if (places_[i].planes == kNowhere) {
      camera.samples = 0;
    }
    if (places_[i].planes != kNowhere) camera.planes = base + places_[i].planes;
    camera.exposure = work.exposure * static_cast<float>(std::exp2(requests[i].exposure_ev));
    list[i] = camera;
  }
  params->meshes = scene_.meshes();
  params->instances = now_.instances();
  params->next_instances = flows_ ? next_->instances() : now_.instances();
  params->category_of = scene_.categories();
  params->alphas = scene_.alphas();
  params->shade = work.shade, params->high = work.high, params->path = work.path;
  const auto split = [](VkDeviceAddress a) { return uvec2{static_cast<uint32_t>(a), static_cast<uint32_t>(a >> 32)}; };
  params->tlas = split(now_.tlas());
  params->next_tlas = split(flows_ ? next_->tlas() : now_.tlas());
  params->sky_entity = scene_.scene().sky_entity;
}

// The next list of commands, open.
VkCommandBuffer GpuSlot::Begin() {
  if (parts_ == commands_.size()) commands_.push_back(NewCommands(device_.device(), pool_));
  BeginOnce(commands_[parts_]);
  return commands_[parts_++];
}

void GpuSlot::Record(const Work& work) {
  CheckVk(vkResetCommandPool(device_.device(), pool_, 0), "recording");
  parts_ = 0;
  const VkCommandBuffer commands = Begin();
  now_.Record(commands);
  if (flows_) next_->Record(commands);
  if (clock_ != VK_NULL_HANDLE) {
    // After all that came before, other frames included.
    vkCmdResetQueryPool(commands, clock_, 0, 2);
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, clock_, 0);
  }
  RecordPasses(work, commands);
  if (reads_back_ && device_.discrete()) RecordCopy();
}

void GpuSlot::RecordPasses(const Work& work, VkCommandBuffer commands) {
  const auto cameras = static_cast<uint32_t>(places_.size());
  constexpr VkPipelineStageFlags kTracing = VK_PIPELINE_STAGE_RAY_TRACING_SHADER_BIT_KHR;
  for (size_t k = 0; k < work.passes.size(); ++k) {
    const Work::Pass& pass = work.passes[k];
    if (pass.is_long) {
      CheckVk(vkEndCommandBuffer(commands), "recording");
      commands = Begin();
    }
    // The first pass waits for the last frame too where it reads from that.
    if (k > 0 || work.history != nullptr) {
      PutBarrier(commands, kTracing, VK_ACCESS_SHADER_WRITE_BIT, kTracing, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
    }
    pass.pipeline->Trace(commands, {parameters_, pass.number, pass.paths}, width_, height_, cameras);
  }
  if (clock_ != VK_NULL_HANDLE) vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, clock_, 1);
  if (!device_.discrete()) PutBarrier(commands, kTracing, VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
  CheckVk(vkEndCommandBuffer(commands), "recording");
}

// To memory that the CPU reads. The semaphore makes visible what was traced.
void GpuSlot::RecordCopy() {
  CheckVk(vkResetCommandPool(device_.device(), copy_pool_, 0), "recording");
  BeginOnce(copy_);
  const VkBufferCopy copy{0, 0, bytes_};
  vkCmdCopyBuffer(copy_, pictures_.handle(), read_back_.handle(), 1, &copy);
  PutBarrier(copy_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
  CheckVk(vkEndCommandBuffer(copy_), "recording");
}

void GpuSlot::Submit(std::span<const RenderRequest> requests, GpuCameras& cameras, const Work& work) {
  const RenderRequest& first = requests.front();
  flows_ = std::ranges::any_of(requests, [](const RenderRequest& r) { return r.products.flow; });
  Arrange(requests, work);
  reads_back_ = bytes_ > 0 && (work.read_back || !device_.discrete());
  if (flows_ && !next_) next_ = std::make_unique<GpuInstant>(device_, scene_);
  FillParameters(requests, cameras, work);
  now_.Set(first.state);
  if (flows_) next_->Set(first.next_state ? first.next_state : first.state);
  Record(work);
  Start();
  waited_ = false;
}

void GpuSlot::Start() {
  CheckVk(vkResetFences(device_.device(), 1, &fence_), "starting work");
  const bool copies = reads_back_ && device_.discrete();
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO, nullptr};
  submit.commandBufferCount = 1;
  for (size_t i = 0; i < parts_; ++i) {
    submit.pCommandBuffers = &commands_[i];
    const bool last = i + 1 == parts_;
    if (last && copies) submit.signalSemaphoreCount = 1, submit.pSignalSemaphores = &traced_;
    CheckVk(vkQueueSubmit(device_.queue(), 1, &submit, last && !copies ? fence_ : VK_NULL_HANDLE), "starting work");
  }
  if (!copies) return;
  constexpr VkPipelineStageFlags kCopies = VK_PIPELINE_STAGE_TRANSFER_BIT;
  VkSubmitInfo copy{VK_STRUCTURE_TYPE_SUBMIT_INFO, nullptr, 1, &traced_, &kCopies, 1, &copy_};
  CheckVk(vkQueueSubmit(device_.copy_queue(), 1, &copy, fence_), "starting work");
}

void GpuSlot::Wait() {
  if (waited_) return;
  const VkResult result = vkWaitForFences(device_.device(), 1, &fence_, VK_TRUE, kPatienceNs * parts_);
  if (result == VK_TIMEOUT) throw RuntimeError("GPU: no answer in " + std::to_string(kPatienceNs / 60'000'000'000 * parts_) + " minutes");
  CheckVk(device_.fault() == GpuFault::kLost ? VK_ERROR_DEVICE_LOST : result, "rendering");
  waited_ = true;
  read_back_.Invalidate();
  if (clock_ == VK_NULL_HANDLE) return;
  uint64_t stamps[2] = {};
  CheckVk(vkGetQueryPoolResults(device_.device(), clock_, 0, 2, sizeof(stamps), stamps, sizeof(uint64_t),
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "reading the clock");
  gpu_ms_ =
      static_cast<double>((stamps[1] - stamps[0]) & device_.timestamp_mask()) * static_cast<double>(device_.timestamp_period_ns()) * 1e-6;
}

std::vector<GpuFrame> GpuSlot::FramesAt(const std::byte* base) const {
  std::vector<GpuFrame> frames;
  for (const Place& p : places_) {
    const size_t n = static_cast<size_t>(p.width) * static_cast<size_t>(p.height);
    GpuFrame f;
    f.width = p.width, f.height = p.height;
    f.rgb = SpanAt<Rgb8>(base, p.offset[kRgb], n);
    f.range = SpanAt<float>(base, p.offset[kRange], n);
    f.semantic = SpanAt<CategoryId>(base, p.offset[kSemantic], n);
    f.entity = SpanAt<EntityId>(base, p.offset[kEntity], n);
    f.normal = SpanAt<Vec3f>(base, p.offset[kNormal], n);
    f.position = SpanAt<Vec3f>(base, p.offset[kPosition], n);
    f.albedo = SpanAt<Rgb32f>(base, p.offset[kAlbedo], n);
    f.radiance = SpanAt<Rgb32f>(base, p.offset[kRadiance], n);
    f.material = SpanAt<uint16_t>(base, p.offset[kMaterial], n);
    f.flow = SpanAt<FlowPixel>(base, p.offset[kFlowProduct], n);
    f.coverage = SpanAt<CoveragePixel>(base, p.offset[kCoverage], n);
    frames.push_back(f);
  }
  return frames;
}

}  // namespace airsim360::internal

// Rendering on a GPU through Vulkan's ray tracing pipelines.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "airsim360/render/renderer.h"

namespace airsim360 {

/// A Vulkan device of this machine.
struct GpuInfo {
  int index = 0;                   ///< what --gpu takes
  std::string name;                ///< as the driver says
  std::string driver;              ///< name and version of the driver
  bool software = false;           ///< runs on the CPU (Mesa's lavapipe): correct, slower than the CPU renderer
  std::string missing;             ///< what it lacks to render; empty = nothing
  std::array<uint8_t, 16> uuid{};  ///< by which other interfaces (CUDA) know the device
  bool shares_memory = false;      ///< can give memory to them (VK_KHR_external_memory_fd)
};

/// Whether this machine has a device file of a GPU (a DRM render node, NVIDIA's, WSL's): without one Vulkan can only find
/// software, and need not be opened to learn that.
bool MachineHasGpu();

/// All Vulkan devices in the order of the loader. Where there is none, `why` (if given) says why.
std::vector<GpuInfo> ListGpus(std::string* why = nullptr);

/// What tests pretend to go wrong.
enum class GpuFault { kNone, kNoVulkan, kOldDriver, kNoMemory, kNoFrameMemory, kLost };

struct GpuOptions {
  int gpu = -1;           ///< index of GpuInfo; -1 = the best that can render, hardware before software
  bool validate = false;  ///< run under VK_LAYER_KHRONOS_validation with synchronisation checks (tests)
  bool discrete = false;  ///< software too uploads and reads back by copies, as a GPU with memory of its own (tests)
  int frames_in_flight = 3;
  GpuFault fault = GpuFault::kNone;
};

/// Pictures of one camera in memory of the renderer that the CPU reads fast; empty spans were not asked for. Row-major as in
/// Frame; valid until the ticket is released.
struct GpuFrame {
  int width = 0, height = 0;
  std::span<const Rgb8> rgb;
  std::span<const float> range;
  std::span<const CategoryId> semantic;
  std::span<const EntityId> entity;
  std::span<const Vec3f> normal, position;
  std::span<const Rgb32f> albedo, radiance;
  std::span<const uint16_t> material;
  std::span<const FlowPixel> flow;
  std::span<const CoveragePixel> coverage;
};

/// Memory of the GPU that another interface can open.
class GpuSharedMemory {
 public:
  virtual ~GpuSharedMemory() = default;
  virtual size_t size() const = 0;       ///< of the pictures in it, bytes
  virtual size_t allocated() const = 0;  ///< what the driver made of it, bytes
  virtual bool dedicated() const = 0;    ///< whether the memory is of this buffer alone
  /// An opaque file descriptor of it, which the caller owns. RuntimeError where the driver gives none.
  virtual int Open() const = 0;
};

/// A renderer that also works ahead: up to GpuOptions::frames_in_flight submissions at once. Not for several threads at a
/// time.
class GpuRenderer : public Renderer {
 public:
  /// Starts the work of many cameras in one dispatch: all requests share state, tier and the switches of the first; cameras
  /// and poses are their own. Waits first if all slots of the ring are taken. InputError as Render, and for
  /// requests that do not share what they must.
  virtual uint64_t Submit(std::span<const RenderRequest> requests) = 0;
  /// The pictures of a submission, one for each request, in the renderer's memory; nothing is copied.
  virtual std::vector<GpuFrame> Wait(uint64_t ticket) = 0;
  /// Gives the memory back for later submissions.
  virtual void Release(uint64_t ticket) = 0;
  /// Whether later submissions copy their pictures to memory of the CPU (at first they do). Without that Wait gives
  /// frames of empty spans, on devices with memory of their own: what reading back costs.
  virtual void ReadBack(bool wanted) = 0;
  /// Room for the pictures of a submission, to be shared with another interface; it must go before the renderer.
  /// RuntimeError where the driver shares no memory, or has none left.
  virtual std::unique_ptr<GpuSharedMemory> Share(size_t bytes) = 0;
  /// Bytes that Copy takes.
  virtual size_t PictureBytes(uint64_t ticket) = 0;
  /// Waits for a submission, copies its pictures there without leaving the GPU and waits for that. The frames' spans begin at
  /// `base`, where the other interface sees the memory.
  virtual std::vector<GpuFrame> Copy(uint64_t ticket, GpuSharedMemory& to, const std::byte* base) = 0;
  virtual const GpuInfo& gpu() const = 0;
  /// Time of the ray tracing of the last submission waited for, by the GPU's own clock, ms.
  virtual double gpu_ms() const = 0;
  /// Time of tracing once more all rays that a picture of tier `fast` without antialiasing sends, and doing nothing else, by the
  /// GPU's clock, ms: what no renderer can go below. InputError for other tiers.
  virtual double TraceAloneMs(const RenderRequest& request) = 0;
  /// What the validation layers have said (GpuOptions::validate).
  virtual std::vector<std::string> messages() const = 0;
};

/// Opens a device and uploads the scene. RuntimeError saying why where that fails: no Vulkan, no such GPU, an old driver, no
/// memory.
std::unique_ptr<GpuRenderer> MakeVulkanRenderer(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options = {},
                                                const GpuOptions& gpu = {});

}  // namespace airsim360

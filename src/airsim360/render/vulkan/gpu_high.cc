#include "airsim360/render/vulkan/gpu_high.h"

#include <algorithm>

#include "airsim360/render/shading/shader_impl.h"
#include "airsim360/render/vulkan/gpu_records.h"

namespace airsim360::internal {
namespace {

// One bit a triangle of every instance that has lamps of the grid; the first bit of each instance, 0 = it has none.
void PutLampBits(GpuArena& arena, const Shader::Impl& shader, const Scene& scene, GpuHigh& out) {
  std::vector<uint32_t> bits(1), first(scene.instances.size());
  size_t count = 1;
  for (const Lamp& lamp : shader.lights.lamps()) {
    if (first[lamp.instance] != 0) continue;
    const auto triangles = static_cast<uint32_t>(scene.meshes[scene.instances[lamp.instance].mesh].triangles.size());
    bool any = false;
    bits.resize((count + triangles + 31) / 32);
    for (uint32_t t = 0; t < triangles; ++t) {
      const uint32_t id = shader.lights.LampOf(lamp.instance, t);
      if (id == LightTable::kNoLamp || !shader.lamps->Holds(id)) continue;
      const size_t bit = count + t;
      bits[bit / 32] |= 1u << (bit % 32);
      any = true;
    }
    if (!any) continue;
    first[lamp.instance] = static_cast<uint32_t>(count);
    count += triangles;
  }
  out.lamp_bits = arena.Put(bits).address;
  out.lamp_bits_of = arena.Put(first).address;
}

void PutSunMap(GpuArena& arena, const SunMapView& map, GpuHigh& out) {
  const auto size = static_cast<size_t>(map.size);
  out.sun_heights = arena.Put(std::as_bytes(std::span<const float>(map.heights, size * size))).address;
  std::copy_n(map.column, 4, out.sun_axes);
  std::copy_n(map.row, 4, out.sun_axes + 4);
  std::copy_n(map.height, 4, out.sun_axes + 8);
  out.sun_bias = map.bias;
  out.sun_size = static_cast<uint32_t>(map.size);
}

}  // namespace

void GpuHistory::Fill(const RenderRequest& request, const RayField& field, GpuCamera& out) {
  constexpr size_t kPlanes = 11;
  const bool usable = field.width == width_ && field.height == height_ && field.separable == separable_;
  if (!usable) {
    // Frames in flight may read it.
    vkDeviceWaitIdle(device_.device());
    planes_ = GpuBuffer(device_, kPlanes * sizeof(float) * static_cast<size_t>(field.width) * static_cast<size_t>(field.height),
                        MemoryKind::kDevice);
  }
  out.history = planes_.address();
  out.history_use = usable ? 2 : 1;  // as in filter.rgen: only kept, or mixed too
  for (int i = 0; i < 9; ++i) out.history_R[i] = static_cast<float>(R_.m[i / 3][i % 3]);
  for (int i = 0; i < 3; ++i) out.history_offset[i] = static_cast<float>(request.X_WC.p[i] - p_[i]);
  width_ = field.width, height_ = field.height, separable_ = field.separable;
  R_ = FromProjection(request.camera, field), p_ = request.X_WC.p;
}

GpuHighTables::GpuHighTables(GpuDevice& device, const Shader& shader, const RayTracer& tracer) : arena_(device) {
  const Shader::Impl& impl = shader.impl();
  const Scene& scene = tracer.scene();
  GpuHigh high{};
  if (impl.sky && impl.sky->to_sun().z > 0 && !scene.instances.empty()) {
    const SunMap map(tracer, impl.sky->to_sun());
    PutSunMap(arena_, map.view(), high);
  }
  if (impl.view.lamps.lamps != nullptr) {
    high.lamp_sides = arena_.Put(std::as_bytes(impl.lamps->sides())).address;
    PutLampBits(arena_, impl, scene, high);
  }
  record_ = arena_.Put(std::as_bytes(std::span<const GpuHigh>(&high, 1)));
  arena_.EndUploads();
}

}  // namespace airsim360::internal

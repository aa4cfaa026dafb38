#include "airsim360/render/vulkan/gpu_shade.h"

#include <algorithm>
#include <map>

#include "airsim360/render/shading/shader_impl.h"
#include "airsim360/render/vulkan/gpu_records.h"

namespace airsim360::internal {
namespace {

static_assert(sizeof(GpuTriangle) == sizeof(TriangleRecord) && sizeof(GpuShaded) == sizeof(InstanceRecord) &&
              sizeof(GpuMaterial) == sizeof(MaterialRecord) && sizeof(GpuPane) == sizeof(PaneRecord) &&
              sizeof(GpuTriangleColors) == sizeof(TriangleColors) && sizeof(GpuLamp) == sizeof(LampRecord));

template <size_t N>
void Copy(const float (&from)[N], float (&to)[N]) {
  std::copy_n(from, N, to);
}

template <class T>
VkDeviceAddress PutArray(GpuArena& arena, const T* data, size_t count) {
  return arena.Put(std::as_bytes(std::span<const T>(data, count))).address;
}

VkDeviceAddress PutTextures(GpuArena& arena, const std::vector<TextureRecord>& textures) {
  std::vector<GpuTexture> records;
  std::map<const uint32_t*, VkDeviceAddress> levels;
  for (const TextureRecord& t : textures) {
    GpuTexture r{};
    for (int k = 0; k <= static_cast<int>(t.last_level); ++k) {
      const TextureLevel& level = t.levels[k];
      VkDeviceAddress& address = levels[level.texels];
      if (address == 0) address = PutArray(arena, level.texels, static_cast<size_t>(level.width) * static_cast<size_t>(level.height));
      r.texels[k] = address, r.width[k] = level.width, r.height[k] = level.height;
    }
    r.last_level = t.last_level, r.size_log2 = t.size_log2, r.srgb = t.srgb;
    r.wrap_u = t.wrap_u, r.wrap_v = t.wrap_v;
    records.push_back(r);
  }
  return arena.Put(records).address;
}

GpuSky PutSky(GpuArena& arena, const SkyTableView& table) {
  if (table.texels == nullptr) return {};
  const size_t texels = static_cast<size_t>(table.stride) * static_cast<size_t>(table.height);
  return {PutArray(arena, table.texels, 4 * texels), table.width, table.height, table.stride, 0};
}

void PutProbes(GpuArena& arena, const ProbeView& grid, size_t count, GpuShade& out) {
  if (grid.probes == nullptr) return;
  out.has_probes = 1;
  out.probes = PutArray(arena, grid.probes, 16 * count);
  out.layer_of_height = PutArray(arena, grid.layer_of_height, static_cast<size_t>(grid.height_last) + 1);
  out.probe_origin[0] = grid.origin_x, out.probe_origin[1] = grid.origin_y;
  out.probe_cells_per_metre = grid.cells_per_metre;
  out.probe_max[0] = grid.max_x, out.probe_max[1] = grid.max_y, out.probe_max[2] = grid.max_z;
  out.probe_stride_y = grid.stride_y, out.probe_stride_z = grid.stride_z;
  out.height_origin = grid.height_origin, out.height_scale = grid.height_scale;
  out.height_last = grid.height_last;
}

void PutLamps(GpuArena& arena, const LampView& grid, GpuShade& out) {
  if (grid.lamps == nullptr) return;
  // The view does not say how many there are: the highest index does.
  const size_t places = static_cast<size_t>(grid.nx) * static_cast<size_t>(grid.ny) * static_cast<size_t>(grid.nz);
  const uint32_t cells = 1 + *std::max_element(grid.cell_of, grid.cell_of + places);
  uint32_t lamps = 1;
  for (uint32_t i = 1; i < cells; ++i) {
    for (uint32_t k = 0; k < (grid.cells[i].header & 255); ++k) lamps = std::max(lamps, 1 + (grid.cells[i].lamp[k] & 0xffffffu));
  }
  out.has_lamps = 1;
  out.lamps = PutArray(arena, grid.lamps, lamps);
  out.lamp_cells = PutArray(arena, grid.cells, cells);
  out.lamp_cell_of = PutArray(arena, grid.cell_of, places);
  out.lamp_origin[0] = grid.origin_x, out.lamp_origin[1] = grid.origin_y, out.lamp_origin[2] = grid.origin_z;
  out.lamp_cells_per_metre = grid.cells_per_metre;
  out.lamp_n[0] = grid.nx, out.lamp_n[1] = grid.ny, out.lamp_n[2] = grid.nz;
}

void PutAir(const AirView& air, GpuShade& out) {
  Copy(air.rayleigh, out.rayleigh), Copy(air.aerosol, out.aerosol);
  out.weather = air.weather;
  out.rayleigh_height = air.rayleigh_height, out.aerosol_height = air.aerosol_height;
  out.weather_height = air.weather_height, out.base_z = air.base_z;
  for (int k = 0; k < 21; ++k) out.horizon[k] = air.horizon[k / 3][k % 3];
  Copy(air.glow, out.glow), Copy(air.weather_light, out.weather_light);
  Copy(air.weather_glow, out.weather_glow), Copy(air.to_sun, out.air_to_sun);
  out.rain = air.rain, out.snow = air.snow;
  Copy(air.drop_light, out.drop_light);
}

void PutRoofs(GpuArena& arena, const RoofView& map, GpuShade& out) {
  if (map.heights == nullptr) return;
  out.roof_heights = PutArray(arena, map.heights, static_cast<size_t>(map.size) * static_cast<size_t>(map.size));
  out.roof_size = map.size;
  out.roof_origin[0] = map.origin_x, out.roof_origin[1] = map.origin_y;
  out.roof_cells_per_metre = map.cells_per_metre, out.roof_lean = map.lean;
}

void PutClouds(GpuArena& arena, const CloudShadowView& map, GpuShade& out) {
  if (map.texels == nullptr) return;
  out.has_clouds = 1;
  out.cloud_texels = PutArray(arena, map.texels, static_cast<size_t>(map.size) * static_cast<size_t>(map.size));
  out.cloud_size = map.size;
  out.cloud_slant[0] = map.slant_x, out.cloud_slant[1] = map.slant_y;
  out.cloud_origin[0] = map.origin_x, out.cloud_origin[1] = map.origin_y;
  out.cloud_cells_per_metre = map.cells_per_metre, out.cloud_plane_z = map.plane_z;
}

}  // namespace

GpuShadeTables::GpuShadeTables(GpuDevice& device, const Shader& shader, const Scene&) : arena_(device) {
  const Shader::Impl& impl = shader.impl();
  const ShadeView& v = impl.view;
  GpuShade s{};
  s.triangles = arena_.Put(impl.tables.triangles).address;
  s.instances = arena_.Put(impl.tables.instances).address;
  s.materials = arena_.Put(impl.tables.materials).address;
  s.panes = arena_.Put(impl.tables.panes).address;
  s.colors = arena_.Put(impl.tables.colors).address;
  s.mean_colors = arena_.Put(impl.tables.mean_colors).address;
  s.mean_emissions = arena_.Put(impl.tables.mean_emissions).address;
  s.glows = arena_.Put(impl.tables.glows).address;
  s.has_glows = v.glows != nullptr ? 1 : 0;
  s.textures = PutTextures(arena_, impl.tables.textures);
  s.has_sky = v.has_sky > 0.5f ? 1 : 0;
  s.sky = PutSky(arena_, v.sky);
  for (int i = 0; i < 3; ++i) s.blurred[i] = PutSky(arena_, v.blurred[i]);
  s.below = PutSky(arena_, v.sky_below);
  s.has_below = v.sky_below.texels != nullptr ? 1 : 0;
  PutProbes(arena_, v.probes, impl.probes ? impl.probes->size() : 0, s);
  PutLamps(arena_, v.lamps, s);
  PutAir(v.air, s);
  PutClouds(arena_, v.cloud_shadow, s);
  PutRoofs(arena_, v.roofs, s);
  s.has_panes = impl.tracer->has_clear_panes() ? 1 : 0;
  Copy(v.to_sun, s.to_sun), Copy(v.sun_irradiance, s.sun_irradiance), Copy(v.sun_radiance, s.sun_radiance);
  Copy(v.ground, s.ground), Copy(v.sky_irradiance, s.sky_irradiance), Copy(v.mean_ambient, s.mean_ambient);
  s.ground_z = v.ground_z;
  s.wetness = v.wetness, s.lying_snow = v.snow, s.drops = v.rain, s.lit_rooms = v.lit_rooms;
  s.lamplight = v.lamplight, s.open_sky = v.open_sky, s.sun_seen = v.sun_seen, s.evening = v.evening;
  Copy(v.moon_light, s.moon_light), s.moon_gain = v.moon_gain;
  for (uint32_t tone = 0; tone < views_.size(); ++tone) {
    s.tone = tone;
    views_[tone] = arena_.Put(std::as_bytes(std::span<const GpuShade>(&s, 1)));
  }
  arena_.EndUploads();
}

}  // namespace airsim360::internal

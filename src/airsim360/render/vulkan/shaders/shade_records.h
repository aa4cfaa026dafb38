// The shading tables of render/shared/shading_data.h as shaders read them. Included as records.h is.

struct GpuTriangle {
  uint normals[3];
  uint geometric_normal, tangent;
  float uv[6];
  float texels_log2;
  uint material, pane;
  float area;
  uint window;
};

struct GpuShaded {
  float normal_matrix[9], tint[3];
  float texels_log2;
  uint first_triangle, hash, first_color;
};

struct GpuTriangleColors {
  uint corner[6];                   // r g, b a of each
  uint pad[2];
};

struct GpuMaterial {
  float base[3];
  float metallic, roughness;
  float emission[3];
  float transmission, macro_variation, normal_scale, kind;
  uint base_texture, roughness_texture, normal_texture, emission_texture;
  float clear_coat, clear_coat_roughness;
  float mean[3];
  float tile, blend, unit_columns, unit_rows, ground, interior, beam;
  uint pad[4];
};

struct GpuPane {
  float a[3], b[3];
  float half_a, half_b, u_per_a, v_per_b;
  uint right, up, hash;
};

struct GpuTexture {
  ADDRESS(Uints) texels[16];
  float width[16], height[16];
  float last_level, size_log2, srgb;
  uint wrap_u, wrap_v, pad;
};

struct GpuSky {
  ADDRESS(Floats) texels;
  float width, height;
  int stride;
  uint pad;
};

struct GpuLamp {
  float center[3];
  float radius;
  float facing[3];
  float body;
  float color[3];
  float soft, reach, beam[3];
};

struct GpuShade {
  ADDRESS(Triangles) triangles;
  ADDRESS(ShadedInstances) instances;
  ADDRESS(Materials) materials;
  ADDRESS(Textures) textures;
  ADDRESS(Panes) panes;
  ADDRESS(TriangleColors) colors;   // by GpuShaded::first_color
  ADDRESS(Floats) mean_colors, mean_emissions;
  ADDRESS(Floats) glows;            // 3 an instance, where has_glows
  ADDRESS(Floats) probes;           // 16 floats each
  ADDRESS(Floats) layer_of_height;
  ADDRESS(Floats) cloud_texels;
  ADDRESS(Floats) roof_heights;
  ADDRESS(Lamps) lamps;
  ADDRESS(Uints) lamp_cells;        // 16 words each
  ADDRESS(Uints) lamp_cell_of;
  GpuSky sky, blurred[3], below;
  uint has_sky, has_probes, has_clouds, has_below, has_lamps, has_panes, has_glows, pad_glows;
  float probe_origin[2], probe_cells_per_metre, probe_max[3];
  int probe_stride_y, probe_stride_z;
  float height_origin, height_scale, height_last;
  float to_sun[3], sun_irradiance[3], sun_radiance[3], ground[3];
  float ground_z;
  float sky_irradiance[27], mean_ambient[3];
  float lamp_origin[3], lamp_cells_per_metre;
  int lamp_n[3];
  // Air.
  float rayleigh[3], aerosol[3], weather;
  float rayleigh_height, aerosol_height, weather_height, base_z;
  float horizon[21], glow[3], weather_light[3], weather_glow[3], air_to_sun[3];
  float rain, snow, drop_light[3];
  // Cloud shadows.
  int cloud_size;
  float cloud_slant[2], cloud_origin[2], cloud_cells_per_metre, cloud_plane_z;
  // What keeps rain off; size 0 = nothing.
  int roof_size;
  float roof_origin[2], roof_cells_per_metre, roof_lean;
  float wetness, lying_snow, drops, lit_rooms, lamplight, open_sky, evening;
  uint tone;
  float sun_seen, moon_light[3], moon_gain;
};

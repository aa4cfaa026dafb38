// What the shading kernels read and write: plain data only, because kernels are compiled once per instruction
// set.
#pragma once

#include <cstdint>

#include "airsim360/render/shared/shading_constants.h"

namespace airsim360::internal {

/// Everything of one triangle that shading needs, in one cache line. Directions are in the mesh frame, packed
/// as two 16-bit octahedral coordinates.
struct alignas(64) TriangleRecord {
  uint32_t normals[3];
  uint32_t geometric_normal;
  uint32_t tangent;   ///< direction of growing u
  float uv[6];        ///< in texture space, transform applied
  float texels_log2;  ///< log2 of uv units per metre
  uint32_t material;  ///< index; kMirroredUv: green of a normal map points along -(n x t)
  uint32_t pane;      ///< hash, the same for both triangles of a quad
  float area;         ///< m^2, of the quad where it is one
  uint32_t window;    ///< 1 + index of its PaneRecord where a room is seen behind it; 0 = none
};
inline constexpr uint32_t kMirroredUv = 0x80000000u;

/// A triangle of a rectangular pane in front of a room (shading_interior.h): where its corners lie in the
/// pane frame, metres. Both triangles of the rectangle have the same frame, size and hash.
struct PaneRecord {
  float a[3], b[3];        ///< right and up from the centre, seen from outside
  float half_a, half_b;    ///< half the size
  float u_per_a, v_per_b;  ///< texture coordinates per metre, for pictures
  uint32_t right, up;      ///< directions in the mesh frame, packed
  uint32_t hash;
};

/// Of one instance, one cache line.
struct alignas(64) InstanceRecord {
  float normal_matrix[9];  ///< row-major, mesh frame to W, for normals; not normalised
  float tint[3];
  float texels_log2;  ///< minus log2 of its scale
  uint32_t first_triangle;
  uint32_t hash;
  uint32_t first_color;  ///< TriangleColors of the mesh's first triangle; 0 = white
};

/// Vertex colours of one triangle: red, green, blue and coverage of each corner in steps of 1/65535.
struct alignas(32) TriangleColors {
  uint16_t corner[3][4];
};

enum MaterialFlags : uint32_t { kNormalMapped = 1, kRoughnessMapped = 2, kEmissionMapped = 4, kBaseMapped = 8 };

/// Of one material, two cache lines.
struct alignas(64) MaterialRecord {
  float base[3];
  float metallic, roughness;
  float emission[3];
  float transmission, macro_variation, normal_scale;
  float kind;                                                                 ///< SurfaceKind as a number
  int32_t base_texture, roughness_texture, normal_texture, emission_texture;  ///< index; 0 = plain white
  float clear_coat, clear_coat_roughness;
  float mean[3];                  ///< of the base texture, linear
  float tile;                     ///< metres per uv unit
  float blend;                    ///< 1: patches of the texture are mixed (hex tiling)
  float unit_columns, unit_rows;  ///< bricks or slabs per uv unit, tinted one by one; 0 = none
  float ground;                   ///< GroundWear as a number
  float interior;                 ///< 1: rooms behind panes
  float beam;                     ///< Material::beam; kWindowBeam: a lit window without a room
};

/// One level of a mip chain.
struct TextureLevel {
  const uint32_t* texels;  ///< RGBA, R in the low byte
  float width, height;
};

struct TextureRecord {
  static constexpr int kMaxLevels = 16;
  TextureLevel levels[kMaxLevels];
  float last_level;        ///< index of the smallest
  float size_log2;         ///< of level 0: log2 of sqrt(width * height)
  float srgb;              ///< 1 if colour channels are sRGB encoded
  uint8_t wrap_u, wrap_v;  ///< Wrap
};

struct SkyTableView {
  const float* texels;  ///< SkyTable::texels
  float width, height;  ///< height - 1 intervals
  int32_t stride;
};

/// Regular columns of probes; see light_probes.h. 16 floats each, all times the weight: the constant term of
/// r, g, b and the weight itself; the x terms and the z^2 term of r; the y terms and z^2 of g; the z terms
/// and z^2 of b.
struct ProbeView {
  const float* probes;  ///< nullptr = none
  float origin_x, origin_y, cells_per_metre;
  float max_x, max_y, max_z;     ///< highest valid coordinate of the lower corner of a cell
  int32_t stride_y, stride_z;    ///< in probes
  const float* layer_of_height;  ///< table of fractional layers over height
  float height_origin, height_scale, height_last;
};

/// A small lamp, or several close together, as fast shading sees it. It sends `color` times
/// max(0, body + facing . w) (candela per unit of radiance) into direction w.
struct alignas(64) LampRecord {
  float center[3];
  float radius;     ///< about the centre, m
  float facing[3];  ///< m^2
  float body;       ///< m^2
  float color[3];   ///< radiance
  float soft;       ///< m^2 added to squared distances: a disc of that area over pi is then exact on its axis
  float reach;      ///< m; beyond it the lamp is left out, from 3/4 of it on it fades
  float beam[3];    ///< axis times sharpness, see beam_shape; 0 = none
};

/// The strongest lamps of one cell of space: one cache line.
struct alignas(64) LampCell {
  static constexpr int kLamps = 15;
  uint32_t header;        ///< number of lamps; from bit 8 on, which of the eight corners are not inside solids
  uint32_t lamp[kLamps];  ///< index; from bit 24 on, the corners that see it (bit 0 x, 1 y, 2 z of the corner)
};

/// Lamps near every place; see lights/lamp_grid.h.
struct LampView {
  const LampRecord* lamps;  ///< nullptr = none shines
  const LampCell* cells;
  const uint32_t* cell_of;  ///< by place, x fastest; 0 is a cell without lamps
  float origin_x, origin_y, origin_z, cells_per_metre;
  int32_t nx, ny, nz;
};

/// The air over a scene; see shading_air.h. Extinctions are in 1 / m at height `base_z`.
struct AirView {
  float rayleigh[3], aerosol[3], weather;  ///< weather: fog, rain and snow, grey
  float rayleigh_height, aerosol_height, weather_height, base_z;
  float horizon[7][3];                      ///< light of much clear air, as around_horizon, without the glow about the sun
  float glow[3];                            ///< times forward_phase of kAirAsymmetry: what the glow adds to 1
  float weather_light[3], weather_glow[3];  ///< the same of much fog; the glow is added
  float to_sun[3];
  float rain, snow;     ///< drops and flakes in the air, mm/h
  float drop_light[3];  ///< radiance of a drop or flake
};

/// See CloudShadowMap.
struct CloudShadowView {
  const float* texels;  ///< nullptr = no shadows
  int32_t size;
  float slant_x, slant_y, origin_x, origin_y, cells_per_metre, plane_z;
};

/// See RoofMap: the height up to which no rain gets, by where what falls there would meet z = 0.
struct RoofView {
  const float* heights;  ///< nullptr = no roof anywhere; [row * size + column]
  int32_t size;
  float origin_x, origin_y, cells_per_metre;
  float lean;  ///< metres that rain moves along x for each metre that it falls
};

/// The constant part of a scene for the kernels.
struct ShadeView {
  const TriangleRecord* triangles;
  const InstanceRecord* instances;
  const MaterialRecord* materials;
  const TextureRecord* textures;
  int32_t macro_texture;
  float has_sky;
  SkyTableView sky, blurred[3];
  ProbeView probes;
  float to_sun[3], sun_irradiance[3], sun_radiance[3];
  float ground[3];  ///< radiance of the far ground below the horizon
  float ground_z;   ///< where it lies
  float sky_irradiance[27];
  float mean_ambient[3];        ///< radiance where there are no probes
  const float* mean_colors;     ///< of a material: base colour with the mean of its texture, r g b
  const float* mean_emissions;  ///< likewise
  const float* glows;           ///< Instance::glow, r g b; nullptr = white everywhere
  LampView lamps;
  AirView air;
  CloudShadowView cloud_shadow;
  SkyTableView sky_below;  ///< Sky::below; texels nullptr = far ground
  const PaneRecord* panes;
  const TriangleColors* colors;  ///< the first is white; nullptr where no mesh has any
  float wetness, snow, rain;     ///< Environment: 0 … 1, 0 … 1, drops on puddles 0 … 1
  float lit_rooms;               ///< share of rooms whose lamps are on
  float evening;                 ///< 1: rooms have evening_light, 0: day_light
  float lamplight;               ///< radiance of a white surface in a lit room
  float moon_light[3];           ///< from the moon to the sun; matters where moon_gain is not 0
  float moon_gain;               ///< the disc at to_sun is the moon's: moon_face times this has the mean 1; 0 = the sun's
  float sun_seen;                ///< share of the sun's disc that clouds leave to the eye
  float open_sky;                ///< luminance of the irradiance of the whole sky on level ground; 0 = no sky
  RoofView roofs;                ///< known where something falls or fog lies
  LampView moving_lamps;  ///< lamps that are not where the scene was built with them, in columns: one layer; see lights/moving_lamps.h
};

inline constexpr int kBatch = 256;

/// Rays that met a surface (or all the sky), compacted; the last ones are repeated up to a full vector.
struct alignas(64) RaySet {
  float ox[kBatch], oy[kBatch], oz[kBatch];
  float dx[kBatch], dy[kBatch], dz[kBatch];
  float distance[kBatch], width[kBatch];  ///< from the origin; of the ray cone there
  float u[kBatch], v[kBatch];
  uint32_t instance[kBatch], triangle[kBatch];
  uint32_t key[kBatch], slot[kBatch];  ///< sample key; where the answer goes
  int count;                           ///< last, so that all arrays are aligned
};

/// Surfaces under those rays.
struct alignas(64) SurfaceSet {
  float px[kBatch], py[kBatch], pz[kBatch];
  float nx[kBatch], ny[kBatch], nz[kBatch];  ///< shading normal towards the viewer
  float gx[kBatch], gy[kBatch], gz[kBatch];  ///< geometric normal towards the viewer
  float ar[kBatch], ag[kBatch], ab[kBatch];  ///< base colour
  float er[kBatch], eg[kBatch], eb[kBatch];  ///< emission
  float metallic[kBatch], roughness[kBatch], transmission[kBatch], kind[kBatch];
  float rx[kBatch], ry[kBatch], rz[kBatch];  ///< reflected direction
  float mirror[kBatch];                      ///< > 0: reflects sharply enough for a traced ray
  float lx[kBatch], ly[kBatch], lz[kBatch];  ///< towards the sun (a point of its disc)
  float sunlit[kBatch];                      ///< in: 1 if the sun can matter; then 1 if it is seen
  float contact[kBatch];                     ///< share of ambient light that things close above leave
  float traced[kBatch];                      ///< 1 if reflected_* is the radiance along the reflected direction
  float reflected_r[kBatch], reflected_g[kBatch], reflected_b[kBatch];
  float coat[kBatch], coat_roughness[kBatch];  ///< clear coat: share, roughness
  float clear[kBatch];                         ///< 1 if behind_* is the radiance behind a clear pane
  float behind_r[kBatch], behind_g[kBatch], behind_b[kBatch];
  // Only where ShadeView::lamps or moving_lamps has some: irradiance of lamps on the front and on the back, and what the skin
  // reflects of them (radiance).
  float lamp_r[kBatch], lamp_g[kBatch], lamp_b[kBatch];
  float lamp_back_r[kBatch], lamp_back_g[kBatch], lamp_back_b[kBatch];
  float lamp_shine_r[kBatch], lamp_shine_g[kBatch], lamp_shine_b[kBatch];
};

/// Rays from surfaces to their strongest lamps, and what each decides.
struct alignas(64) LampRays {
  static constexpr int kMost = 4;
  struct Ray {
    float dx, dy, dz;                   ///< unit
    float distance;                     ///< to the near side of the lamp; <= 0: inside it
    float share;                        ///< how far the ray replaces what the cell's corners saw; 0 = no ray
    float guess;                        ///< share of corners that see the lamp
    float front[3], back[3], shine[3];  ///< what it brings where it is seen
  };
  Ray ray[kMost][kBatch];
};

/// Radiance in the order of a RaySet, while light that needs neighbours to be known well is not known yet:
/// ambient * (irradiance around) + sun * (share of the sun's disc seen) + rest. Haze is in all of them.
struct alignas(64) LightTerms {
  float ambient_r[kBatch], ambient_g[kBatch], ambient_b[kBatch];
  float sun_r[kBatch], sun_g[kBatch], sun_b[kBatch];
  float rest_r[kBatch], rest_g[kBatch], rest_b[kBatch];
};

/// Sixteen surfaces that ambient rays start from.
struct alignas(64) AmbientOrigins {
  float px[16], py[16], pz[16], nx[16], ny[16], nz[16], gx[16], gy[16], gz[16], distance[16];
};

/// What sixteen ambient rays met.
struct alignas(64) AmbientHits {
  uint32_t instance[16], triangle[16];       ///< kMiss = sky
  float lamp_r[16], lamp_g[16], lamp_b[16];  ///< irradiance by the lamps of ShadeView::lamps
  float shines[16];                          ///< 1, or 0 where the surface is one of those lamps and so is accounted for already
};

/// Heights along the sun's direction of the first surface that the sun meets, on a square lattice.
struct SunMapView {
  const float* heights;  ///< nullptr = no sun; [row * size + column]
  int32_t size;
  float column[4], row[4], height[4];  ///< of p: x p.x + y p.y + z p.z + w; columns and rows in texels
  float bias;                          ///< metres
};

/// Radiance in the order of a RaySet.
struct alignas(64) LightSet {
  float r[kBatch], g[kBatch], b[kBatch];
};

}  // namespace airsim360::internal

// Surface appearance: metallic-roughness as in glTF 2.0, plus what foliage, glass and big tiled grounds need.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "airsim360/image/image.h"
#include "airsim360/math/vector.h"

namespace airsim360 {

/// One cd/m^2 (or one lx of irradiance) in the units of emission and sky: 20 units are 133.3 klx.
inline constexpr float kNit = 20.0f / 133300.0f;

/// Material::beam of lamps that are cut off above the horizon, as low beams are.
inline constexpr float kLowBeam = 10;

using TextureId = int32_t;
inline constexpr TextureId kNoTexture = -1;

enum class Wrap : uint8_t { kRepeat, kMirror, kClamp };

/// An 8-bit RGBA picture with its mip chain: level 0 is full size, each next level half (rounded down, at
/// least 1).
struct Texture {
  std::string name;
  bool srgb = false;  ///< colour channels are sRGB encoded (base colour, emission); alpha never is
  Wrap wrap_u = Wrap::kRepeat, wrap_v = Wrap::kRepeat;
  std::vector<Image<Rgba8>> levels;

  /// Builds the mip chain from level 0: 2x2 box filter in linear light, alpha averaged.
  static Texture FromImage(std::string name, Image<Rgba8> image, bool srgb);
};

enum class AlphaMode : uint8_t { kOpaque, kMask };

/// What the `fast` shader does beyond metallic-roughness.
enum class SurfaceKind : uint8_t {
  kStandard,  ///< metallic-roughness
  kFoliage,   ///< two-sided, transmits light: `transmission` times base colour
  kGlass,     ///< thin pane: reflects by Fresnel; clear where transmission > 0 (IsClearPane), else behind it a
              ///< room (`interior`) or `base_color` as the colour of what lies behind
  kWater,     ///< dielectric with procedural waves
};

/// Which traces of use and weather the shader adds to a ground, in world space, where no texture could
/// repeat. On foliage it names the ground whose blades these are: snow and rain lie on them as on it, nothing else is added.
enum class GroundWear : uint8_t {
  kNone,
  kAsphalt,      ///< stains, cracks, sealed repairs
  kCarriageway,  ///< also wheel tracks; its texture u runs across the street, 0 in the middle
  kPaving,       ///< dirt, spills, walked lines
  kLawn,         ///< mowing lanes, clover, dry patches
  kGravel,       ///< fines, weeds
  kSoil,         ///< damp hollows, weeds
  kRoof,         ///< dried puddles
  kRoofRolls,    ///< also seams of 1 m rolls
};

/// Colours are linear light. The final base colour is base_color * texture * instance tint.
struct Material {
  std::string name;
  SurfaceKind kind = SurfaceKind::kStandard;
  AlphaMode alpha_mode = AlphaMode::kOpaque;
  float alpha_cutoff = 0.5f;  ///< kMask: hit where base alpha * texture alpha >= cutoff
  Vec3f base_color{0.8f, 0.8f, 0.8f};
  float base_alpha = 1;
  float metallic = 0;
  float roughness = 0.9f;
  Vec3f emission{};  ///< W/(m^2 sr) relative to the sky's units, times emission texture; front side only
  float normal_scale = 1;
  float transmission = 0;
  float clear_coat = 0;  ///< 0 … 1: a smooth dielectric layer (n = 1.5) over everything, as on car paint
  float clear_coat_roughness = 0.03f;
  bool interior = false;  ///< kGlass: a furnished room is seen behind each pane (interior mapping)
  bool lamp = false;      ///< emission shines only while Environment::lamps_on(); with kGlass and without `beam` it is that of a
                          ///< window, behind each pane of which something else shines (evening_light of shading_interior.h)
  float beam = 0;  ///< emission is thrown along the front (-Y) of the mesh, for negative values its back: 1 / (1 + |beam| (1 - cos))^2
                   ///< of it at an angle from there; beyond kLowBeam little above the horizon. 0 = the same in all directions
  float macro_variation = 0;                          ///< amplitude of brightness variation over 2..40 m of world, hides tiling of grounds
  TextureId base_color_texture = kNoTexture;          ///< sRGB, alpha = opacity
  TextureId metallic_roughness_texture = kNoTexture;  ///< G roughness, B metallic (glTF)
  TextureId normal_texture = kNoTexture;              ///< tangent space, +Y up in texture space (glTF)
  TextureId emission_texture = kNoTexture;
  Vec2f uv_scale{1, 1}, uv_offset{};  ///< KHR_texture_transform of mesh uv: scale, then rotate, then offset
  float uv_rotation = 0;              ///< radians, counter-clockwise seen with v downwards; see UvTransform
  GroundWear ground = GroundWear::kNone;
  bool blend_tiles = false;  ///< mixes hashed patches of the textures so that no tile repeats (three look-ups)
  Vec2f units{};             ///< bricks or slabs per texture tile in u and v, every second row shifted by half a unit:
                             ///< each gets its own brightness in the world; 0 = none
};

/// A thin clear pane: light passes through it, tinted by base_color and weakened by `transmission`.
inline bool IsClearPane(const Material& material) { return material.kind == SurfaceKind::kGlass && material.transmission > 0; }

/// From mesh uv to texture uv: u' = m00 u + m01 v + t.x, v' = m10 u + m11 v + t.y (KHR_texture_transform).
struct UvTransform {
  float m00 = 1, m01 = 0, m10 = 0, m11 = 1;
  Vec2f t;

  UvTransform() = default;
  explicit UvTransform(const Material& material) : t(material.uv_offset) {
    const float c = std::cos(material.uv_rotation), s = std::sin(material.uv_rotation);
    m00 = c * material.uv_scale.x;
    m01 = s * material.uv_scale.y;
    m10 = -s * material.uv_scale.x;
    m11 = c * material.uv_scale.y;
  }
  Vec2f operator*(Vec2f uv) const { return {m00 * uv.x + m01 * uv.y + t.x, m10 * uv.x + m11 * uv.y + t.y}; }
};

}  // namespace airsim360

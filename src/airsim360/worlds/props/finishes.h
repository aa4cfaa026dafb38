// What props are made of: the common finishes, and the textures drawn for them.
#pragma once

#include "airsim360/scene/material.h"

namespace airsim360::internal {

class PropBuilder;

inline constexpr Vec3f kZinc{0.42f, 0.43f, 0.44f};  ///< of cans and sheets on roofs

/// Linear colours. Names describe the finish, so that equal finishes of different props are shared.
Material MakeFinish(const char* name, Vec3f color, float roughness, float metallic = 0);
Material Paint(Vec3f color, float roughness = 0.4f);  ///< painted or powder-coated metal
/// Lacquered car body: colour coat with aluminium flakes (`metallic`: their share, 0 for plain colours) under clear coat.
Material CarPaint(Vec3f color, float metallic = 0);
Material Chrome();
Material Metal(Vec3f color = {0.56f, 0.57f, 0.58f}, float roughness = 0.35f);  ///< bare metal
Material CastIron();
Material Plastic(Vec3f color, float roughness = 0.45f);
Material Rubber();
Material Fabric(Vec3f color);                          ///< cloth: two-sided, lets some light through
Material Glass(Vec3f color = {0.03f, 0.035f, 0.04f});  ///< pane in front of something dark
/// Lamp glass of that luminance, cd/m^2, in the dark hours or always; by day it is white or tinted glass.
enum class Burns { kAtNight, kAlways };
Material Glow(Vec3f color, float nits, Burns burns = Burns::kAtNight);
/// The same at night, but its light is white of that luminance: Instance::glow colours it.
Material WhiteGlow(Vec3f color, float nits);
Material Stone(Vec3f color, float roughness = 0.85f);  ///< concrete, stone, terracotta, soil: matt
Material Leaf(Vec3f color = {1, 1, 1}, float transmission = 0.8f);

/// Makes the following shapes of `b` wooden boards; the grain runs along the vertical or Y, or along X.
enum class Grain { kUpright, kAlongX };
void UseWood(PropBuilder& b, Vec3f tint = {1, 1, 1}, Grain grain = Grain::kUpright);

/// Tiling textures (albedo where not said otherwise), made once and then shared; tile sizes in metres.
const Texture& WoodTexture();       ///< planed boards, grain along v; tile 0.25 x 1
const Texture& ConcreteTexture();   ///< fine mottling, mean 1; tile 1 x 1
const Texture& BarkTexture();       ///< furrows along v, mean 1; tile 0.5 x 1
const Texture& BarkNormals();       ///< normal map of the same
const Texture& ScratchedTexture();  ///< weathered paint, mean near 1; tile 1 x 1

}  // namespace airsim360::internal

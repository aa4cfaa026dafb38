// What furniture and fittings of interiors are made of. Every Use… makes the following shapes of `b` of that material;
// albedos are linear.
#pragma once

#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {

/// Veneered or solid wood under satin lacquer: flat-sawn figure with pores; uv in metres, grain as UseWood.
enum class Timber { kOak, kBeech, kWalnut, kPine, kWenge };
void UseTimber(PropBuilder& b, Timber timber, Grain grain = Grain::kUpright);
/// Lacquered board: smooth, with the faint unevenness of a sprayed surface.
void UseLacquer(PropBuilder& b, Vec3f color, float roughness = 0.35f);

/// Upholstery cloth of 3 mm threads, uneven in tone as yarn is.
void UseWeave(PropBuilder& b, Vec3f color);
/// Fine bed linen or cotton: matt, faintly creased.
void UseLinen(PropBuilder& b, Vec3f color);
/// Grained leather with soft gloss.
void UseLeather(PropBuilder& b, Vec3f color);
/// Tufted pile: rugs, carpets, towels.
void UsePile(PropBuilder& b, Vec3f color);
/// Curtain cloth, two-sided: lined, which lets little through, or sheer, of whose area `open` (0 … 1) is holes. (What passes
/// a SurfaceKind::kFoliage turns green as in a leaf, so sheer cloth is a matt pane.)
void UseLinedCloth(PropBuilder& b, Vec3f color);
void UseSheerCloth(PropBuilder& b, Vec3f color, float open);

void UseCeramic(PropBuilder& b, Vec3f color = {0.80f, 0.80f, 0.78f});
/// Stainless steel with a brushed finish.
void UseBrushedSteel(PropBuilder& b, float roughness = 0.30f);
/// Polished granite or composite worktop; tile 0.6 m.
void UseStoneTop(PropBuilder& b, Vec3f color);
void UseCardboard(PropBuilder& b, float shade = 1);
/// Rough sawn boards of pallets.
void UseRoughBoards(PropBuilder& b, Grain grain = Grain::kUpright);
/// Powder-coated sheet steel with scuffs.
void UseCoatedSteel(PropBuilder& b, Vec3f color, float roughness = 0.45f);
/// Galvanised sheet of ducts and trays.
void UseGalvanised(PropBuilder& b);

/// Clear glass (shower screens, lamp bulbs, cases) of that tint.
Material ClearGlass(Vec3f tint = {0.95f, 0.98f, 0.97f});
/// Silvered mirror: reflectance 0.88, flat.
Material Mirror();
/// Lamp surface that sends out `lumens` over `square_metres` to all sides of its front (Lambert: flux = pi luminance area),
/// white of `kelvin`, in the dark hours or always.
Material LampSurface(float lumens, float square_metres, float kelvin, Burns burns);
/// A screen that shows its picture at `nits` white, always on.
Material Screen(float nits);

}  // namespace airsim360::internal

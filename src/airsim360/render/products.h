// What pictures a capture can hold: one table, which every front, format and file description follows.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360 {

/// Which images a capture fills. Labels cost nothing beside each other: they come from the same rays.
struct Products {
  bool rgb = true, range = true, semantic = true, entity = true, normal = false;
  bool position = false, albedo = false, material = false, coverage = false;
  bool flow = false;      ///< needs RenderRequest::X_WC_next
  bool radiance = false;  ///< linear light before exposure and tone curve
  bool part = false;      ///< follows from semantic and material (scene/parts.h)
  bool sky = false;       ///< follows from entity
  friend bool operator==(const Products&, const Products&) = default;
};

/// One product: its name in every front, its files, and what is in them.
struct ProductInfo {
  const char* name;
  bool Products::*wanted;
  const char* extension;     ///< of its files in a dataset
  const char* encoding;      ///< of its files, for meta.json; rgb and semantic have others too, see dataset/meta.cc
  bool always = false;       ///< in every dataset, rgb unless the tier is labels
  bool needs_light = false;  ///< tier labels has none
};
inline constexpr ProductInfo kProducts[] = {
    {"rgb", &Products::rgb, ".png", "8-bit sRGB PNG", true, true},
    {"range", &Products::range, ".exr", "OpenEXR float32, channel Y: metres along the ray through the pixel centre, 0 = nothing hit (sky)",
     true},
    {"semantic", &Products::semantic, ".png",
     "8-bit palette PNG: the index stored in a pixel is the category id of `categories`, the palette holds "
     "their colours; PIL's np.asarray(Image.open(f)) gives indices, cv2.imread colours; 0 = void, never written",
     true},
    {"entity", &Products::entity, ".png", "8-bit RGB PNG, entity id = R + 256 G + 65536 B; 0 never appears", true},
    {"normal", &Products::normal, ".png",
     "16-bit RGB PNG, unit world normal towards the camera: n = value / 32767 - 1; (0, 0, 0) = nothing hit"},
    {"position", &Products::position, ".exr", "OpenEXR float32, channels X, Y, Z: the point hit, in W, metres; (0, 0, 0) = nothing hit"},
    {"albedo", &Products::albedo, ".png", "8-bit sRGB PNG: base colour of the surface without any light; black = nothing hit"},
    {"material", &Products::material, ".png", "16-bit PNG: key of materials.json; 0 = nothing hit"},
    {"part", &Products::part, ".png",
     "8-bit PNG: key of parts.json, which part of the pixel's entity this is; 0 = its body, or nothing hit"},
    {"sky", &Products::sky, ".png", "8-bit PNG: 255 = the ray through the pixel centre meets the sky, else 0"},
    {"flow", &Products::flow, ".exr",
     "OpenEXR float32: dx, dy pixels to where the point is in the next frame (X_WC_next of frames.jsonl), "
     "x wraps the short way in panoramas; range metres to it then, 0 = sky; occluded 1 = hidden then or "
     "outside the picture (dx = dy = 0 there); motion.X, motion.Y, motion.Z its own displacement in W. "
     "The last frame leads to the pose extrapolated from its velocities"},
    {"coverage", &Products::coverage, ".exr",
     "OpenEXR float32: id.0 … id.3 entities of the pixel by area, largest first, 0 = no more; share.0 … "
     "share.3 their shares of it"},
    {"radiance", &Products::radiance, ".exr",
     "OpenEXR half float, channels R G B: linear light before exposure and tone curve (sunlight outside "
     "the atmosphere has irradiance 20), at most 65504; ideal lens",
     false, true},
};

/// Nothing at all.
inline constexpr Products kNoProducts{.rgb = false, .range = false, .semantic = false, .entity = false};
/// What every dataset holds.
inline constexpr Products kUsualProducts{};

/// Names of all products, in the order of the table.
std::vector<std::string> ProductNames();
/// `products` and those that are named. InputError, naming the nearest after "WHERE: ", for a name that is none.
Products WithProducts(Products products, std::span<const std::string> names, std::string_view where = {});
/// Names of what is wanted, in the order of the table.
std::vector<std::string> NamesOf(const Products& products);
/// What a renderer has to fill so that `products` can be had.
Products Rendered(Products products);

}  // namespace airsim360

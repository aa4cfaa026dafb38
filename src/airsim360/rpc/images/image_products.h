// From what one rendering gave to the pixels that a client asked for.
#pragma once

#include <string>
#include <vector>

#include "airsim360/render/renderer.h"
#include "airsim360/rpc/session/cameras.h"
#include "airsim360/rpc/wire/airsim_image_types.h"

namespace airsim360 {

/// What images of a camera show for a type: panoramas show their own kind when asked for the scene.
enum class ImageContent {
  kColor,
  kPlanarDepth,
  kRange,
  kDepthShade,
  kDisparity,
  kSegmentation,
  kNormal,
  kInfrared,
  kFlow,
  kFlowShade,
  kEntity,
  kAnnotation,
};
ImageContent ContentOf(const CameraSetup& camera, airsim::ImageType type);
/// The products of the renderer that an image is made of.
void AddProducts(ImageContent content, Products& products);

struct PixelOptions {
  bool half_depth = true;                               ///< depth is rounded to half precision, as AirSim's readback does
  bool centimetres = false;                             ///< 8-bit range is centimetres, held at 255
  bool rgb_order = false;                               ///< bytes of uncompressed pictures are R, G, B
  std::vector<uint32_t> const* segmentation = nullptr;  ///< id by entity
  std::vector<uint32_t> const* annotation = nullptr;
};

/// Depth of what no ray meets: the largest half-precision number, as AirSim's sky.
inline constexpr float kSkyDepth = 65504;

/// Bytes of a picture as it travels without compression: three a pixel, or floats, which take four each in
/// binary and five else.
size_t PixelBytes(ImageContent content, const Camera& camera, bool as_float, bool binary);
/// One float a pixel, two of flow.
std::vector<float> FloatPixelsOf(ImageContent content, const Frame& frame, const Camera& camera, const PixelOptions& options);
/// The same as it is sent; see airsim::FloatPixels.
airsim::FloatPixels FloatBytesOf(ImageContent content, const Frame& frame, const Camera& camera, const PixelOptions& options, bool binary,
                                 const TakeBytes& take);
/// Three bytes a pixel in the order B, G, R, or R, G, B as the options say.
WireBlock BytePixelsOf(ImageContent content, const Frame& frame, const Camera& camera, const PixelOptions& options, const TakeBytes& take);
/// A PNG of the same picture.
std::string PngOf(ImageContent content, const Frame& frame, const Camera& camera, const PixelOptions& options);

/// Rounded to the nearest half-precision number, ties to even; at most 65504.
float RoundToHalf(float value);

}  // namespace airsim360

// How pictures are stored: what becomes of their values, and the files of the products that datasets hold on request.
#pragma once

#include <string>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/render/renderer.h"

namespace airsim360::internal {

/// Class ids below 256.
Image<uint8_t> NarrowSemantic(const Image<CategoryId>& semantic);
/// n in [-1, 1] as round((n + 1) * 32767); nothing hit stays (0, 0, 0), which no unit normal gives.
Image<Rgb16> CodeNormal(const Image<Vec3f>& normal);
/// Linear colours as sRGB.
Image<Rgb8> CodeAlbedo(const Image<Rgb32f>& albedo);

/// Values stored as floats: the channels of an EXR, pixel by pixel.
struct ChannelPicture {
  int width = 0, height = 0;
  std::vector<const char*> channels;
  std::vector<float> values;  ///< width * height * channels.size()
};
/// Of "position", "flow" or "coverage".
ChannelPicture CodeChannels(const std::string& product, const Frame& frame);

/// The file of "normal", "position", "albedo", "material", "part", "sky", "flow" or "coverage", encoded as
/// docs/reference/dataset_format.md says.
Bytes EncodeExtra(const std::string& product, const Frame& frame, const Scene& scene);

}  // namespace airsim360::internal

#include "airsim360/dataset/encode_extra.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/color.h"
#include "airsim360/scene/parts.h"

namespace airsim360::internal {
namespace {

// The same picture with every pixel coded by itself.
template <class Coded, class Pixel, class Code>
Image<Coded> CodePixels(const Image<Pixel>& image, Code code) {
  Image<Coded> coded(image.width(), image.height());
  std::transform(image.pixels().begin(), image.pixels().end(), coded.pixels().begin(), code);
  return coded;
}

// `values(pixel, out)` writes the channels of one pixel.
template <class Pixel, size_t kChannels, class Values>
ChannelPicture Channels(const Image<Pixel>& image, const char* const (&channels)[kChannels], Values values) {
  ChannelPicture picture{image.width(), image.height(), {std::begin(channels), std::end(channels)}, {}};
  picture.values.resize(image.size() * kChannels);
  float* out = picture.values.data();
  for (const Pixel& pixel : image.pixels()) {
    values(pixel, out);
    out += kChannels;
  }
  return picture;
}

ChannelPicture CodePosition(const Image<Vec3f>& position) {
  return Channels(position, {"X", "Y", "Z"}, [](Vec3f p, float* out) {
    for (int i = 0; i < 3; ++i) out[i] = p[i];
  });
}

ChannelPicture CodeFlow(const Image<FlowPixel>& flow) {
  return Channels(flow, {"dx", "dy", "range", "occluded", "motion.X", "motion.Y", "motion.Z"}, [](const FlowPixel& pixel, float* out) {
    out[0] = pixel.dx;
    out[1] = pixel.dy;
    out[2] = pixel.range;
    out[3] = pixel.occluded;
    for (int i = 0; i < 3; ++i) out[4 + i] = pixel.motion[i];
  });
}

// Ids below 2^24, as in the id pictures, are exact in a float.
ChannelPicture CodeCoverage(const Image<CoveragePixel>& coverage) {
  return Channels(coverage, {"id.0", "id.1", "id.2", "id.3", "share.0", "share.1", "share.2", "share.3"},
                  [](const CoveragePixel& pixel, float* out) {
                    for (int i = 0; i < CoveragePixel::kEntities; ++i) {
                      out[i] = static_cast<float>(pixel.entity[i]);
                      out[CoveragePixel::kEntities + i] = pixel.share[i];
                    }
                  });
}

Bytes EncodeChannels(const ChannelPicture& picture) { return EncodeExr(picture.values, picture.width, picture.height, picture.channels); }

}  // namespace

Image<uint8_t> NarrowSemantic(const Image<CategoryId>& semantic) {
  return CodePixels<uint8_t>(semantic, [](CategoryId id) { return static_cast<uint8_t>(id); });
}

Image<Rgb16> CodeNormal(const Image<Vec3f>& normal) {
  return CodePixels<Rgb16>(normal, [](Vec3f n) {
    if (n == Vec3f{}) return Rgb16{};
    const auto code = [](float x) { return static_cast<uint16_t>(std::lround((std::clamp(x, -1.0f, 1.0f) + 1) * 32767.0f)); };
    return Rgb16{code(n.x), code(n.y), code(n.z)};
  });
}

Image<Rgb8> CodeAlbedo(const Image<Rgb32f>& albedo) {
  return CodePixels<Rgb8>(albedo, [](Rgb32f c) { return Rgb8{LinearToSrgb8(c.r), LinearToSrgb8(c.g), LinearToSrgb8(c.b)}; });
}

ChannelPicture CodeChannels(const std::string& product, const Frame& frame) {
  if (product == "position") return CodePosition(frame.position);
  if (product == "flow") return CodeFlow(frame.flow);
  if (product == "coverage") return CodeCoverage(frame.coverage);
  throw RuntimeError("no way to store the product '" + product + "'");
}

Bytes EncodeExtra(const std::string& product, const Frame& frame, const Scene& scene) {
  if (product == "normal") return EncodePng(CodeNormal(frame.normal));
  if (product == "albedo") return EncodePng(CodeAlbedo(frame.albedo));
  if (product == "material") return EncodePng(frame.material);
  if (product == "part") return EncodePng(PartPicture(frame.semantic, frame.material, scene.tree, scene.materials));
  if (product == "sky") return EncodePng(SkyMask(frame.entity, scene.sky_entity));
  return EncodeChannels(CodeChannels(product, frame));
}

}  // namespace airsim360::internal

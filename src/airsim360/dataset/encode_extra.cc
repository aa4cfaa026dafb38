#include "airsim360/dataset/encode_extra.h"

#include <algorithm>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/color.h"
#include "airsim360/scene/parts.h"

namespace airsim360::internal {
namespace {

// `values(pixel, out)` writes the channels of one pixel.
template <class Pixel, size_t kChannels, class Values>
Bytes EncodeChannels(const Image<Pixel>& image, const char* const (&channels)[kChannels], Values values) {
  std::vector<float> floats(image.size() * kChannels);
  float* out = floats.data();
  for (const Pixel& pixel : image.pixels()) {
    values(pixel, out);
    out += kChannels;
  }
  return EncodeExr(floats, image.width(), image.height(), channels);
}

Bytes EncodePosition(const Image<Vec3f>& position) {
  return EncodeChannels(position, {"X", "Y", "Z"}, [](Vec3f p, float* out) {
    for (int i = 0; i < 3; ++i) out[i] = p[i];
  });
}

Bytes EncodeAlbedo(const Image<Rgb32f>& albedo) {
  Image<Rgb8> coded(albedo.width(), albedo.height());
  std::transform(albedo.pixels().begin(), albedo.pixels().end(), coded.pixels().begin(), [](Rgb32f c) {
    return Rgb8{LinearToSrgb8(c.r), LinearToSrgb8(c.g), LinearToSrgb8(c.b)};
  });
  return EncodePng(coded);
}

Bytes EncodeFlow(const Image<FlowPixel>& flow) {
  return EncodeChannels(flow, {"dx", "dy", "range", "occluded", "motion.X", "motion.Y", "motion.Z"},
                        [](const FlowPixel& pixel, float* out) {
                          out[0] = pixel.dx;
                          out[1] = pixel.dy;
                          out[2] = pixel.range;
                          out[3] = pixel.occluded;
                          for (int i = 0; i < 3; ++i) out[4 + i] = pixel.motion[i];
                        });
}

// Ids below 2^24, as in the id pictures, are exact in a float.
Bytes EncodeCoverage(const Image<CoveragePixel>& coverage) {
  return EncodeChannels(coverage,
                        {"id.0", "id.1", "id.2", "id.3", "share.0", "share.1", "share.2", "share.3"},
                        [](const CoveragePixel& pixel, float* out) {
                          for (int i = 0; i < CoveragePixel::kEntities; ++i) {
                            out[i] = static_cast<float>(pixel.entity[i]);
                            out[CoveragePixel::kEntities + i] = pixel.share[i];
                          }
                        });
}

}  // namespace

Bytes EncodeExtra(const std::string& product, const Frame& frame, const Scene& scene) {
  if (product == "position") return EncodePosition(frame.position);
  if (product == "albedo") return EncodeAlbedo(frame.albedo);
  if (product == "material") return EncodePng(frame.material);
  if (product == "part") return EncodePng(PartPicture(frame.semantic, frame.material, scene.tree, scene.materials));
  if (product == "sky") return EncodePng(SkyMask(frame.entity, scene.sky_entity));
  if (product == "flow") return EncodeFlow(frame.flow);
  if (product == "coverage") return EncodeCoverage(frame.coverage);
  throw RuntimeError("no way to encode the product '" + product + "'");
}

}  // namespace airsim360::internal

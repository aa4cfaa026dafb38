#include "airsim360/rpc/images/image_products.h"

#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "airsim360/base/parallel.h"
#include "airsim360/image/codecs.h"
#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/rpc/images/segmentation_palette.h"

namespace airsim360 {
namespace {

constexpr float kShadeRange = 100;     // metres that DepthVis shows
constexpr double kBaseline = 0.25;     // metres between AirSim's stereo cameras
constexpr double kFlowShadeFull = 20;  // pixels of flow shown at full strength

// Row by row on all threads: `make_row(y)` fills what belongs to row y.
template <class MakeRow>
void ForRows(const Camera& camera, const MakeRow& make_row) {
  constexpr int kRowsPerTask = 32;
  const int height = Height(camera);
  ParallelFor((height + kRowsPerTask - 1) / kRowsPerTask, [&](int64_t task) {
    const int first = static_cast<int>(task) * kRowsPerTask;
    for (int y = first; y < std::min(first + kRowsPerTask, height); ++y) make_row(y);
  });
}

// Depth along the axis over range, per pixel of a pinhole; 1 for other cameras.
float AxisShare(const Camera& camera, int x, int y) {
  const auto* pinhole = std::get_if<Pinhole>(&camera);
  if (pinhole == nullptr) return 1;
  const double u = (x + 0.5 - pinhole->cx) / pinhole->fx, v = (y + 0.5 - pinhole->cy) / pinhole->fy;
  return static_cast<float>(1 / std::sqrt(1 + u * u + v * v));
}

float DepthAt(ImageContent content, const Frame& frame, const Camera& camera, int x, int y, bool half) {
  const float range = frame.range(x, y);
  if (range <= 0) return kSkyDepth;
  float depth = content == ImageContent::kRange ? range : range * AxisShare(camera, x, y);
  if (content == ImageContent::kDepthShade) return std::min(depth / kShadeRange, 1.0f);
  if (content == ImageContent::kDisparity) {
    const auto* pinhole = std::get_if<Pinhole>(&camera);
    const double focal = pinhole ? pinhole->fx : Width(camera) / 6.283185307179586;
    return static_cast<float>(std::min(1.0, kBaseline * focal / depth / Width(camera)));
  }
  return half ? RoundToHalf(depth) : std::min(depth, kSkyDepth);
}

uint32_t IdAt(const std::vector<uint32_t>* ids, const Frame& frame, int x, int y) {
  const EntityId entity = frame.entity(x, y);
  return ids != nullptr && entity < ids->size() ? (*ids)[entity] : 0;
}

// Direction as hue, length as strength (the usual colour wheel of flow fields).
Rgb8 FlowColor(const FlowPixel& flow) {
  const double length = std::hypot(flow.dx, flow.dy);
  const double value = std::min(1.0, length / kFlowShadeFull);
  const double hue = (std::atan2(flow.dy, flow.dx) / 6.283185307179586 + 1) * 6;
  const auto channel = [&](double offset) {
    const double k = std::fmod(hue + offset, 6);
    return static_cast<uint8_t>(255 * value * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
  };
  return {channel(5), channel(3), channel(1)};
}

uint8_t UnitByte(float value) { return static_cast<uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f))); }

// World normal as a game engine paints it: north, east, up from -1 … 1 to 0 … 255.
Rgb8 NormalColor(Vec3f n_W) {
  if (n_W == Vec3f{}) return {};
  return {UnitByte(0.5f + 0.5f * n_W.y), UnitByte(0.5f + 0.5f * n_W.x), UnitByte(0.5f + 0.5f * n_W.z)};
}

Rgb8 ColorAt(ImageContent content, const Frame& frame, const Camera& camera, const PixelOptions& options, int x, int y) {
  const auto gray = [](uint8_t v) { return Rgb8{v, v, v}; };
  switch (content) {
    case ImageContent::kColor:
      return frame.rgb(x, y);
    case ImageContent::kSegmentation:
      return SegmentationColor(IdAt(options.segmentation, frame, x, y));
    case ImageContent::kInfrared:
      return gray(static_cast<uint8_t>(std::min<uint32_t>(IdAt(options.segmentation, frame, x, y), 255)));
    case ImageContent::kAnnotation: {
      const uint32_t id = IdAt(options.annotation, frame, x, y);
      return {static_cast<uint8_t>(id), static_cast<uint8_t>(id >> 8), static_cast<uint8_t>(id >> 16)};
    }
    case ImageContent::kEntity: {
      const EntityId id = frame.entity(x, y);
      return {static_cast<uint8_t>(id), static_cast<uint8_t>(id >> 8), static_cast<uint8_t>(id >> 16)};
    }
    case ImageContent::kNormal:
      return NormalColor(frame.normal(x, y));
    case ImageContent::kFlow:
    case ImageContent::kFlowShade:
      return FlowColor(frame.flow(x, y));
    case ImageContent::kDisparity:
      return gray(UnitByte(DepthAt(content, frame, camera, x, y, false)));
    default: {
      const float range = frame.range(x, y);
      if (options.centimetres) return gray(range <= 0 ? 255 : static_cast<uint8_t>(std::min(range * 100, 255.0f)));
      return gray(UnitByte(DepthAt(ImageContent::kDepthShade, frame, camera, x, y, false)));
    }
  }
}

float FloatAt(ImageContent content, const Frame& frame, const Camera& camera, const PixelOptions& options, int x, int y) {
  switch (content) {
    case ImageContent::kEntity:
      return static_cast<float>(frame.entity(x, y));
    case ImageContent::kSegmentation:
    case ImageContent::kInfrared:
      return static_cast<float>(IdAt(options.segmentation, frame, x, y));
    case ImageContent::kAnnotation:
      return static_cast<float>(IdAt(options.annotation, frame, x, y));
    case ImageContent::kColor: {
      const Rgb8 c = frame.rgb(x, y);
      return (0.299f * c.r + 0.587f * c.g + 0.114f * c.b) / 255;
    }
    case ImageContent::kNormal:
      return frame.normal(x, y).z;
    default:
      return DepthAt(content, frame, camera, x, y, options.half_depth);
  }
}

}  // namespace

float RoundToHalf(float value) {
  if (!(std::abs(value) < kSkyDepth)) return std::copysign(kSkyDepth, value);
  // 13 bits fewer in the mantissa; depths are never so small that halves get denormal.
  uint32_t bits = std::bit_cast<uint32_t>(value);
  bits += 0xfff + (bits >> 13 & 1);
  return std::min(std::bit_cast<float>(bits & ~uint32_t{0x1fff}), kSkyDepth);
}

ImageContent ContentOf(const CameraSetup& camera, airsim::ImageType type) {
  using airsim::ImageType;
  constexpr ImageContent kPanoramas[] = {ImageContent::kColor,  ImageContent::kColor,  ImageContent::kRange, ImageContent::kSegmentation,
                                         ImageContent::kEntity, ImageContent::kNormal, ImageContent::kFlow};
  if (type == ImageType::kScene) return kPanoramas[static_cast<int>(camera.panorama)];
  switch (type) {
    case ImageType::kDepthPlanar:
      return ImageContent::kPlanarDepth;
    case ImageType::kDepthPerspective:
      return ImageContent::kRange;
    case ImageType::kDepthVis:
      return ImageContent::kDepthShade;
    case ImageType::kDisparityNormalized:
      return ImageContent::kDisparity;
    case ImageType::kSegmentation:
      return ImageContent::kSegmentation;
    case ImageType::kSurfaceNormals:
      return ImageContent::kNormal;
    case ImageType::kInfrared:
      return ImageContent::kInfrared;
    case ImageType::kOpticalFlow:
      return ImageContent::kFlow;
    case ImageType::kOpticalFlowVis:
      return ImageContent::kFlowShade;
    case ImageType::kAnnotation:
      return ImageContent::kAnnotation;
    default:
      return ImageContent::kColor;  // Cosys' lighting only: no counterpart
  }
}

void AddProducts(ImageContent content, Products& products) {
  products.rgb |= content == ImageContent::kColor;
  products.normal |= content == ImageContent::kNormal;
  products.flow |= content == ImageContent::kFlow || content == ImageContent::kFlowShade;
}

namespace {

// The third, second and first byte of each of `count` values of kStride bytes, without gaps. Sixteen bytes at a time (every
// processor that the kernels run on has SSSE3), the last values by themselves: nothing beyond the row is touched.
template <size_t kStride>
__attribute__((target("ssse3"))) void SwapTriples(const void* from, size_t count, char* out) {
  static_assert(kStride == 3 || kStride == 4);
  constexpr size_t kValues = 16 / kStride;
  const __m128i order = kStride == 3 ? _mm_setr_epi8(2, 1, 0, 5, 4, 3, 8, 7, 6, 11, 10, 9, 14, 13, 12, -1)
                                     : _mm_setr_epi8(2, 1, 0, 6, 5, 4, 10, 9, 8, 14, 13, 12, -1, -1, -1, -1);
  const char* in = static_cast<const char*>(from);
  size_t left = count;
  // Both ends are within the row: what is written too much belongs to the next value.
  for (; left >= kValues + 2; left -= kValues, in += kValues * kStride, out += 3 * kValues) {
    const __m128i values = _mm_loadu_si128(reinterpret_cast<const __m128i*>(in));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_shuffle_epi8(values, order));
  }
  for (; left > 0; --left, in += kStride, out += 3) {
    const char first = in[0], second = in[1], third = in[2];
    out[0] = third, out[1] = second, out[2] = first;
  }
}

// The pictures that are asked for most, without a choice at every pixel. False: another one.
bool CommonRow(ImageContent content, const Frame& frame, int y, bool rgb_order, char* out) {
  static_assert(sizeof(Rgb8) == 3 && sizeof(EntityId) == 4 && std::endian::native == std::endian::little);
  if (content == ImageContent::kColor) {
    const auto row = frame.rgb.row(y);
    rgb_order ? (void)std::memcpy(out, row.data(), row.size_bytes()) : SwapTriples<sizeof(Rgb8)>(row.data(), row.size(), out);
    return true;
  }
  if (content == ImageContent::kEntity && !rgb_order) {
    const auto row = frame.entity.row(y);
    SwapTriples<sizeof(EntityId)>(row.data(), row.size(), out);
    return true;
  }
  return false;
}

bool CommonRow(ImageContent content, const Frame& frame, int y, bool half, float* out) {
  if (content != ImageContent::kRange) return false;
  const auto row = frame.range.row(y);
  if (half) {
    for (const float range : row) *out++ = range <= 0 ? kSkyDepth : RoundToHalf(range);
  } else {
    for (const float range : row) *out++ = range <= 0 ? kSkyDepth : std::min(range, kSkyDepth);
  }
  return true;
}

bool IsFlow(ImageContent content) { return content == ImageContent::kFlow || content == ImageContent::kFlowShade; }

// Row y as floats, one a pixel or two of flow.
void FloatRow(ImageContent content, const Frame& frame, const Camera& camera, const PixelOptions& options, int y, float* out) {
  if (CommonRow(content, frame, y, options.half_depth, out)) return;
  for (int x = 0; x < Width(camera); ++x) {
    if (IsFlow(content)) {
      const FlowPixel& flow = frame.flow(x, y);
      *out++ = flow.dx, *out++ = flow.dy;
    } else {
      *out++ = FloatAt(content, frame, camera, options, x, y);
    }
  }
}

size_t FloatsInRow(ImageContent content, const Camera& camera) { return static_cast<size_t>(Width(camera)) * (IsFlow(content) ? 2 : 1); }

}  // namespace

std::vector<float> FloatPixelsOf(ImageContent content, const Frame& frame, const Camera& camera, const PixelOptions& options) {
  const size_t row = FloatsInRow(content, camera);
  std::vector<float> pixels(row * static_cast<size_t>(Height(camera)));
  ForRows(camera, [&](int y) { FloatRow(content, frame, camera, options, y, pixels.data() + row * static_cast<size_t>(y)); });
  return pixels;
}

size_t PixelBytes(ImageContent content, const Camera& camera, bool as_float, bool binary) {
  const auto rows = static_cast<size_t>(Height(camera));
  if (!as_float) return 3 * static_cast<size_t>(Width(camera)) * rows;
  return FloatsInRow(content, camera) * rows * (binary ? sizeof(float) : kWireFloatBytes);
}

airsim::FloatPixels FloatBytesOf(ImageContent content, const Frame& frame, const Camera& camera, const PixelOptions& options, bool binary,
                                 const TakeBytes& take) {
  const size_t row = FloatsInRow(content, camera), count = row * static_cast<size_t>(Height(camera));
  const size_t size = binary ? sizeof(float) : kWireFloatBytes;
  const std::shared_ptr<char[]> bytes = take(PixelBytes(content, camera, true, binary));
  ForRows(camera, [&](int y) {
    char* out = bytes.get() + size * row * static_cast<size_t>(y);
    if (binary) return FloatRow(content, frame, camera, options, y, reinterpret_cast<float*>(out));
    std::vector<float> values(row);
    FloatRow(content, frame, camera, options, y, values.data());
    StoreWireFloats(values, out);
  });
  return {count, binary, {bytes, count * size}};
}

WireBlock BytePixelsOf(ImageContent content, const Frame& frame, const Camera& camera, const PixelOptions& options, const TakeBytes& take) {
  const int width = Width(camera);
  const size_t size = PixelBytes(content, camera, false, false);
  const std::shared_ptr<char[]> pixels = take(size);
  ForRows(camera, [&](int y) {
    char* out = pixels.get() + 3 * static_cast<size_t>(y) * static_cast<size_t>(width);
    if (CommonRow(content, frame, y, options.rgb_order, out)) return;
    for (int x = 0; x < width; ++x, out += 3) {
      Rgb8 c = ColorAt(content, frame, camera, options, x, y);
      if (!options.rgb_order) std::swap(c.r, c.b);
      std::memcpy(out, &c, sizeof c);
    }
  });
  return {pixels, size};
}

std::string PngOf(ImageContent content, const Frame& frame, const Camera& camera, const PixelOptions& options) {
  Image<Rgb8> image(Width(camera), Height(camera));
  ForRows(camera, [&](int y) {
    for (int x = 0; x < image.width(); ++x) image(x, y) = ColorAt(content, frame, camera, options, x, y);
  });
  return std::string(AsText(EncodePng(image)));
}

}  // namespace airsim360

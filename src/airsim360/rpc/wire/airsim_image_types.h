// Requests for pictures and their answers as they travel (see airsim_types.h).
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "airsim360/rpc/wire/airsim_types.h"

namespace airsim360::airsim {

enum class ImageType : int {
  kScene = 0,
  kDepthPlanar,
  kDepthPerspective,
  kDepthVis,
  kDisparityNormalized,
  kSegmentation,
  kSurfaceNormals,
  kInfrared,
  kOpticalFlow,
  kOpticalFlowVis,
  kLighting,    // Cosys-AirSim
  kAnnotation,  // Cosys-AirSim
  kCount
};

/// Camera names: older scripts send numbers.
struct CameraName {
  std::string text;
};
inline void FromWire(const WireValue& value, CameraName& out) {
  if (value.kind == WireValue::Kind::kInt) {
    out.text = std::to_string(value.integer);
  } else {
    airsim360::FromWire(value, out.text);
  }
}

/// The last argument of camera calls: AirSim's `external`, or Cosys-AirSim's name of an annotation layer.
struct External {
  bool external = false;
  std::string annotation;
};
inline void FromWire(const WireValue& value, External& out) {
  if (value.kind == WireValue::Kind::kBool) {
    out.external = value.flag;
  } else {
    airsim360::FromWire(value, out.annotation);
  }
}

struct ImageRequest {
  CameraName camera_name;
  ImageType image_type = ImageType::kScene;
  bool pixels_as_float = false, compress = true;
  std::string annotation_name;
  bool binary_float = false;  ///< ours: floats come as the bytes of a little-endian array, exact, not halved
  template <class V>
  void Visit(V& v) {
    v("camera_name", camera_name), v("image_type", image_type), v("pixels_as_float", pixels_as_float);
    v("compress", compress), v("annotation_name", annotation_name), v("binary_float", binary_float);
  }
};

/// The requests of one call. More than kMost are refused before memory is taken for them.
struct ImageRequests {
  static constexpr size_t kMost = 64;
  std::vector<ImageRequest> list;
};
inline void FromWire(const WireValue& value, ImageRequests& out) {
  if (value.items.size() > ImageRequests::kMost)
    throw std::invalid_argument("more than " + std::to_string(ImageRequests::kMost) + " images in one call");
  airsim360::FromWire(value, out.list);
}

/// Floats as AirSim sends them, or as the bytes that ImageRequest::binary_float asks for.
struct FloatPixels {
  size_t count = 0;
  bool binary = false;
  WireBlock bytes;  ///< binary: little-endian floats; else StoreWireFloats
};
inline void ToWire(WireWriter& writer, const FloatPixels& pixels) {
  pixels.binary ? writer.BinaryHeader(pixels.bytes.size()) : writer.ArrayHeader(pixels.count);
  writer.Append(pixels.bytes);
}

struct ImageResponse {
  WireBytes image_data_uint8;
  FloatPixels image_data_float;
  Vector3r camera_position;
  std::string camera_name;
  Quaternionr camera_orientation;
  uint64_t time_stamp = 0;
  std::string message;
  bool pixels_as_float = false, compress = true;
  int width = 0, height = 0;
  ImageType image_type = ImageType::kScene;
  std::string annotation_name;
  double exposure_factor = 0;  ///< ours: radiance times this is what the tone curve was given; 0: no colours
  template <class V>
  void Visit(V& v) {
    v("image_data_uint8", image_data_uint8), v("image_data_float", image_data_float);
    v("camera_position", camera_position), v("camera_name", camera_name);
    v("camera_orientation", camera_orientation), v("time_stamp", time_stamp), v("message", message);
    v("pixels_as_float", pixels_as_float), v("compress", compress), v("width", width), v("height", height);
    v("image_type", image_type), v("annotation_name", annotation_name), v("exposure_factor", exposure_factor);
  }
};

/// Ours: pictures of which some lie in memory that the client has lent. The pixels of image i are the `size` bytes at `offset`
/// of that memory; size 0: they are in the image.
struct LentImages {
  std::vector<ImageResponse> images;
  std::vector<std::pair<uint64_t, uint64_t>> places;  ///< offset, size
  uint64_t wanted = 0;                                ///< bytes of a region that holds all of them
  template <class V>
  void Visit(V& v) {
    v("images", images), v("places", places), v("wanted", wanted);
  }
};

}  // namespace airsim360::airsim

// What a network in an ONNX file takes, read without running it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace airsim360::internal {

struct OnnxHeader {
  int64_t opset = 0;          ///< version of the standard operators
  int width = 0, height = 0;  ///< of the picture, pixels; 0: any
};

/// Reads the protobuf messages ModelProto > GraphProto > ValueInfoProto of https://onnx.ai/onnx/repo-docs/IR.html; weights are
/// skipped. `name` stands for the file in messages. InputError for what is not ONNX, or a network that does not take one
/// float32 picture 1 x 3 x height x width of kLeastSide to kMostSide pixels a side.
OnnxHeader ReadOnnxHeader(std::span<const std::byte> model, const std::string& name);
inline constexpr int kLeastSide = 8, kMostSide = 1024;

}  // namespace airsim360::internal

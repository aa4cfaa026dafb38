// Records of TensorFlow: framed messages tf.train.Example (tensorflow/core/lib/io/record_writer.h, tensorflow/core/example/example.proto).
// For the .cc files of this folder.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360::internal {

/// CRC-32C (Castagnoli), RFC 3720 appendix B.4.
uint32_t Crc32c(std::string_view bytes);
/// Length, its masked CRC-32C, the bytes, their masked CRC-32C; all little-endian.
std::string TfRecord(std::string_view bytes);

/// Named lists of numbers or bytes.
class TfExample {
 public:
  void Floats(const std::string& name, std::span<const float> values);
  void Ints(const std::string& name, std::span<const int64_t> values);
  void Bytes(const std::string& name, std::span<const std::string> values);
  /// The message as it is sent, features in order of their names.
  std::string Encode() const;

 private:
  std::map<std::string, std::string> features_;  // encoded
};

}  // namespace airsim360::internal

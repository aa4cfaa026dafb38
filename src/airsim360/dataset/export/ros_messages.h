// ROS 2 messages: their definitions and their bytes (CDR, little-endian, OMG DDS-RTPS 10.2).
#pragma once

#include <cstdint>
#include <string>

#include "airsim360/base/file.h"
#include "airsim360/math/transform.h"

namespace airsim360::internal {

/// Appends values with the alignment of CDR, which counts from behind the header of four bytes.
class Cdr {
 public:
  Cdr() : text_("\0\1\0\0", 4) {}
  template <class T>
  Cdr& N(T value) {
    while ((text_.size() - 4) % sizeof(T) != 0) text_ += '\0';
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  /// Length with the closing zero, text, zero.
  Cdr& Text(const std::string& text) {
    N(static_cast<uint32_t>(text.size() + 1));
    text_.append(text.c_str(), text.size() + 1);
    return *this;
  }
  Cdr& Octets(std::string_view bytes) {
    N(static_cast<uint32_t>(bytes.size()));
    text_ += bytes;
    return *this;
  }
  Cdr& Vector(Vec3d v) { return N(v.x).N(v.y).N(v.z); }
  Cdr& Rotation(const Mat3d& R) {
    const Quaternion q = ToQuaternion(R);
    return N(q.x).N(q.y).N(q.z).N(q.w);
  }
  Cdr& Time(int64_t t_ns) { return N(static_cast<int32_t>(t_ns / 1'000'000'000)).N(static_cast<uint32_t>(t_ns % 1'000'000'000)); }
  Cdr& Header(int64_t t_ns, const std::string& frame) { return Time(t_ns).Text(frame); }
  std::string Take() { return std::move(text_); }

 private:
  std::string text_;
};

struct RosType {
  const char* name;
  std::string definition;
};
const RosType& CompressedImageType();
const RosType& ImageType();
const RosType& OdometryType();
const RosType& TfMessageType();
const RosType& ImuType();
const RosType& MarkerArrayType();

}  // namespace airsim360::internal

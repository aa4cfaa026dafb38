#include "airsim360/app/lidar_ply.h"

#include <bit>
#include <cstddef>
#include <cstring>

namespace airsim360 {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class... Values>
void Append(std::string& bytes, Values... values) {
  const auto one = [&](const auto& value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  (one(values), ...);
}

}  // namespace

std::string LidarPly(const LidarScan& scan) {
  constexpr size_t kPointBytes = 34;
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(scan.points.size());
  for (const char* property :
       {"float x", "float y", "float z", "float range", "float intensity", "float time", "ushort category", "uint entity", "uint shot"})
    bytes += std::string("\nproperty ") + property;
  bytes += "\nend_header\n";
  bytes.reserve(bytes.size() + kPointBytes * scan.points.size());
  for (const LidarPoint& p : scan.points) {
    Append(bytes, p.p_S.x, p.p_S.y, p.p_S.z, p.range, p.intensity, p.time, p.category, p.entity, p.shot);
  }
  return bytes;
}

}  // namespace airsim360

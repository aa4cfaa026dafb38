// Any bytes: the scanner finds the same objects however they are cut, the decoder takes what it finds, and arguments
// of every kind are read from it or refused.
#include <cstdlib>

#include "airsim360/rpc/wire/airsim_image_types.h"
#include "airsim360/rpc/wire/message.h"
#include "airsim360/rpc/wire/wire_value.h"

namespace {

constexpr airsim360::WireLimits kLimits{.bytes = 1 << 16, .values = 4096, .depth = 16};

// Length of the first object when `step` bytes arrive at a time; 0 = none, SIZE_MAX = refused.
size_t FirstLength(const uint8_t* data, size_t size, size_t step) {
  airsim360::WireScanner scanner(kLimits);
  try {
    for (size_t have = step < size ? step : size;; have = have + step < size ? have + step : size) {
      if (const auto length = scanner.Scan({data, have})) return *length;
      if (have == size) return 0;
    }
  } catch (const airsim360::WireError&) {
    return SIZE_MAX;
  }
}

// Reads a value as a T, if it is one.
template <class T>
void Read(const airsim360::WireValue& value) {
  T out{};
  try {
    using airsim360::FromWire;
    FromWire(value, out);
  } catch (const airsim360::BadArgument&) {
  }
}

void ReadAsArgument(const airsim360::WireValue& value) {
  using namespace airsim360::airsim;
  Read<std::vector<ImageRequest>>(value);
  Read<std::vector<Vector3r>>(value);
  Read<std::vector<std::string>>(value);
  Read<KinematicsState>(value);
  Read<RCData>(value);
  Read<YawMode>(value);
  Read<External>(value);
  Read<float>(value);
  Read<uint8_t>(value);
  Read<bool>(value);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const size_t length = FirstLength(data, size, size ? size : 1);
  if (length != FirstLength(data, size, 1)) std::abort();
  if (length == 0 || length == SIZE_MAX) return 0;
  try {
    const airsim360::WireValue value = airsim360::DecodeWire({data, length}, kLimits);
    for (const airsim360::WireValue& argument : airsim360::ParseMessage(value).arguments->items) ReadAsArgument(argument);
  } catch (const airsim360::WireError&) {
  }
  return 0;
}

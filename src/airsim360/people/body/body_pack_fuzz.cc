// Any bytes as a pack of people: an error, or characters whose bodies can be made.
#include <cstdint>
#include <span>

#include "airsim360/base/error.h"
#include "airsim360/people/body/body_pack.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  try {
    const BodyPack pack = DecodeBodyPack(std::as_bytes(std::span(data, size)), "fuzz");
    MakePackBody(pack, {});
  } catch (const std::exception&) {
  }
  return 0;
}

// Any bytes as a recording: an error, or a recording that comes back the same.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/hash.h"
#include "airsim360/sim/recording.h"

namespace {

void TryDecode(std::span<const std::byte> bytes) {
  using namespace airsim360;
  try {
    const Recording recording = DecodeRecording(bytes, "fuzz");
    const Bytes again = EncodeRecording(recording);
    if (!std::ranges::equal(again, bytes)) std::abort();
  } catch (const InputError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  const auto content = std::as_bytes(std::span(data, size));
  TryDecode(content);
  // With the frame of a whole file, so that the fuzzer gets past the checksum.
  const std::string frame = "A360RUN\n" + std::string(AsText(content)) + Sha256Hex(content);
  TryDecode(AsBytes(frame));
  return 0;
}

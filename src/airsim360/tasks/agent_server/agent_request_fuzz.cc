// Whatever a client sends is understood or refused with a RequestError, and takes little time.
#include <string_view>

#include "airsim360/tasks/agent_server/agent_request.h"

namespace {

template <class Decode>
void Try(const Decode& decode, std::string_view text) {
  try {
    decode(text);
  } catch (const airsim360::RequestError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 8) {
    case 0:
      Try(DecodeCreate, text);
      break;
    case 1:
      Try(DecodeReset, text);
      break;
    case 2:
      Try(DecodeStep, text);
      break;
    case 3:
      Try(DecodeObserve, text);
      break;
    case 4:
      Try(DecodeSocketRequest, text);
      break;
    case 5:
      Try(DecodePanoramaQuery, text);
      break;
    case 6:
      Try(DecodeViewQuery, text);
      break;
    default:
      Try(DecodeGridQuery, text);
  }
  return 0;
}

#include "airsim360/rpc/limits.h"

#include <cstdio>
#include <stdexcept>
#include <string>

namespace airsim360 {

void CheckReplyBytes(uint64_t bytes, std::string_view help) {
  if (bytes <= kMostReplyBytes) return;
  constexpr double kMib = 1 << 20;
  char text[160];
  std::snprintf(text, sizeof text, "the answer would take %.1f MiB (%llu bytes) of at most %.0f MiB; ",
                static_cast<double>(bytes) / kMib, static_cast<unsigned long long>(bytes),
                static_cast<double>(kMostReplyBytes) / kMib);
  throw std::invalid_argument(text + std::string(help));
}

}  // namespace airsim360

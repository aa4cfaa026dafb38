// One POST to a server that may do anything. For the .cc files of this folder.
#pragma once

#include <string>

namespace airsim360::internal {

struct HttpAnswer {
  int status = 0;           ///< 0: none came
  std::string body = {};    ///< at most `most_bytes`
  std::string fault = {};   ///< in words; "" where an answer came
  bool again = false;       ///< the same may go well another time: busy, broken line, timeout
  double seconds = 0;       ///< it took
};

/// No redirects, nothing but http and https. Never throws for what the server does.
HttpAnswer PostJson(const std::string& url, const std::string& key, const std::string& body, double seconds, size_t most_bytes);

}  // namespace airsim360::internal

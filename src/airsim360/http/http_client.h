// One request to a server that may do anything. libcurl lives in http_client.cc alone.
#pragma once

#include <string>

namespace airsim360 {

struct HttpAnswer {
  int status = 0;          ///< 0: none came
  std::string body = {};   ///< at most `most_bytes`
  std::string fault = {};  ///< in words; "" where an answer came
  bool again = false;      ///< the same may go well another time: busy, broken line, timeout
  double seconds = 0;      ///< it took
};

// No redirects, nothing but http and https. They never throw for what the server does.

/// `key`: of an Authorization header; "" = none.
HttpAnswer PostJson(const std::string& url, const std::string& key, const std::string& body, double seconds, size_t most_bytes);
HttpAnswer GetHttp(const std::string& url, double seconds, size_t most_bytes);

}  // namespace airsim360

// What `view --connect` is told.
#pragma once

#include <string>

namespace airsim360 {

struct FollowOptions {
  std::string address;  ///< HOST:PORT
  bool lease = false;   ///< takes the drone and flies it from the page
  std::string vehicle;  ///< of an AirSim server; "" = the first
  std::string episode;  ///< of an agent server; "" = the newest
};

}  // namespace airsim360

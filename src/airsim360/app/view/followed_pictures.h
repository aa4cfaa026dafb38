// The newest pictures of a world that is followed, which may still be asked about.
#pragma once

#include <cstdint>
#include <deque>

#include "airsim360/http/http_server.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {

/// Not thread-safe.
class FollowedPictures {
 public:
  void Add(int64_t number, Frame frame);
  /// A plane message with range and entities of a picture. InputError for one that is gone.
  SocketMessage Planes(int64_t number) const;

 private:
  struct Seen {
    int64_t number = 0;
    Frame frame;
  };
  std::deque<Seen> seen_;  // newest last
};

}  // namespace airsim360

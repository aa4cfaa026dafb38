// A world that the page shows as it lives: flown here (live_world.h), or in a server elsewhere.
#pragma once

#include <string>
#include <string_view>

#include "airsim360/http/http_server.h"

namespace airsim360 {

/// Thread-safe.
class LiveSource {
 public:
  virtual ~LiveSource() = default;

  /// For session.json: world, products, categories, weathers, scale of ranges, keeps; "flies": whether the page may fly,
  /// "follows": the world is elsewhere.
  virtual std::string DescriptionJson() const = 0;
  /// As entities.json, with "low" and "high" of the box in W where it is known.
  virtual std::string EntitiesJson() const = 0;
  /// One message of a WebSocket, {"do": …}; docs/guide/viewer.md has them. Those that fly or change anything need
  /// `token` in them. Never throws: what is wrong is answered with {"error": …}.
  virtual SocketMessage Answer(std::string_view message, const std::string& token) = 0;
};

}  // namespace airsim360

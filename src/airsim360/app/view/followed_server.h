// A world that runs in an AirSim server (airsim360 serve), as the page shows it.
#pragma once

#include <memory>
#include <string>

#include "airsim360/app/view/follow_options.h"
#include "airsim360/view/live_source.h"

namespace airsim360 {

/// Whether something that speaks AirSim's protocol answers at HOST:PORT. InputError and RuntimeError as RpcClient.
bool IsAirSimServer(const std::string& address);

/// Pictures, ranges and entities of panoramas of the vehicle; positions are those of the server's global frame, turned to
/// east, north, up. Without a lease nothing in the server is changed.
class FollowedServer : public LiveSource {
 public:
  /// InputError or RuntimeError as RpcClient, and for a server without the vehicle.
  explicit FollowedServer(const FollowOptions& options);
  /// Gives the drone back.
  ~FollowedServer() override;

  std::string DescriptionJson() const override;
  std::string EntitiesJson() const override;
  SocketMessage Answer(std::string_view message, const std::string& token) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360

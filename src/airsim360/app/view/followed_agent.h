// The episodes of an agent server (airsim360 agent), as the page shows them.
#pragma once

#include <memory>
#include <string>

#include "airsim360/app/view/follow_options.h"
#include "airsim360/view/live_source.h"

namespace airsim360 {

/// Whether `airsim360 agent` answers at HOST:PORT.
bool IsAgentServer(const std::string& address);

/// Panoramas, ranges and entities of an episode after each request of its agent, which is neither held up nor refused because
/// of that. Without a lease nothing in the server is changed; with one the page flies the episode, and makes one where there
/// is none.
class FollowedAgent : public LiveSource {
 public:
  /// RuntimeError if the server is not there; InputError for an episode that it has not.
  explicit FollowedAgent(const FollowOptions& options);
  ~FollowedAgent() override;

  std::string DescriptionJson() const override;
  std::string EntitiesJson() const override;
  SocketMessage Answer(std::string_view message, const std::string& token) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360

// What the .cc files of the agent interface share: one episode, the right to use it, answers that are no mistake
// in a field.
#pragma once

#include <atomic>
#include <mutex>
#include <stdexcept>
#include <string>

#include "airsim360/scene/scene_state.h"
#include "airsim360/tasks/agent_server/agent_answers.h"
#include "airsim360/tasks/agent_server/agent_api.h"

namespace airsim360 {
namespace internal {

/// An answer other than 200 that is no mistake in a field.
class StatusError : public std::runtime_error {
 public:
  StatusError(int status, const std::string& what, std::string allow = {})
      : std::runtime_error(what), status_(status), allow_(std::move(allow)) {}
  int status() const { return status_; }
  const std::string& allow() const { return allow_; }

 private:
  int status_;
  std::string allow_;
};

inline AgentResponse JsonResponse(const Answer& answer, int status = 200) { return {status, "application/json", TextOf(answer)}; }

/// Status 405 for other methods. `allow`: what is answered at that path where it is not `method` alone.
inline void RequireMethod(const AgentRequest& request, const std::string& method, const std::string& allow = {}) {
  if (request.method != method)
    throw StatusError(405, request.method.substr(0, 16) + " is not answered here; use " + method,
                      !allow.empty()    ? allow
                      : method == "GET" ? "GET, HEAD"
                                        : method);
}

/// One instant of an episode for those who look on.
struct WatchedMoment {
  int64_t number = 0;
  Answer state = {};  ///< as observations
  RigidTransform X_WB = {};
  std::shared_ptr<const SceneState> moved = {};
  std::shared_ptr<AgentWorld> world = {};
};

}  // namespace internal

/// One episode and who may touch it.
struct AgentApi::Slot {
  std::string id, world, task;       // task: "" = of the request itself
  std::mutex mutex;                  // of the episode
  std::unique_ptr<Episode> episode;  // none: it is being made, or could not be
  double answered = 0;               // when its agent got the last answer
  double latency = 0;                // seconds of thinking charged so far
  std::atomic<double> touched{0};
  std::mutex watched_mutex;  // of what follows
  std::shared_ptr<const internal::WatchedMoment> watched;

  /// After each request of its agent. Those who look on read this and never hold the episode, so that nobody who flies is
  /// told that it is busy.
  void Publish() noexcept;
};

/// The right to use an episode for one request. In real time what has passed since the last answer passes in
/// the episode too.
class AgentApi::Turn {
 public:
  enum class Creates { kNo, kYes };
  Turn(AgentApi& api, Slot& slot, Creates creates = Creates::kNo);
  ~Turn() {
    slot_.Publish();
    slot_.answered = slot_.touched = api_.Now();
  }

 private:
  AgentApi& api_;
  Slot& slot_;
  std::unique_lock<std::mutex> lock_;
};

}  // namespace airsim360

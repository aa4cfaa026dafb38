#include "airsim360/view/coming_world.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace airsim360 {

using Json = nlohmann::ordered_json;

namespace {

constexpr std::chrono::milliseconds kMoment{400};  // that a question about what there is waits: few of them are asked meanwhile

std::string Error(const std::string& name) {
  const Json error{{"error", "'" + name + "' could not be opened"}};
  return error.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

void ComingWorld::Come(std::shared_ptr<LiveSource> world) {
  const std::lock_guard lock(mutex_);
  world_ = std::move(world);
  changed_.notify_all();
}

void ComingWorld::Fail() {
  const std::lock_guard lock(mutex_);
  failed_ = true;
  changed_.notify_all();
}

LiveSource* ComingWorld::Wait() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return world_ || failed_; });
  return world_.get();
}

std::string ComingWorld::DescriptionJson() const {
  {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, kMoment, [&] { return world_ || failed_; })) {
      const Json coming{{"coming", name_}};
      return coming.dump(-1, ' ', false, Json::error_handler_t::replace);
    }
  }
  const LiveSource* world = Wait();
  return world ? world->DescriptionJson() : Error(name_);
}

std::string ComingWorld::EntitiesJson() const {
  const LiveSource* world = Wait();
  return world ? world->EntitiesJson() : Error(name_);
}

SocketMessage ComingWorld::Answer(std::string_view message, const std::string& token) {
  LiveSource* world = Wait();
  return world ? world->Answer(message, token) : SocketMessage{Error(name_)};
}

}  // namespace airsim360

#include "airsim360/rpc/server.h"

#include <mutex>
#include <set>

#include "airsim360/base/log.h"
#include "airsim360/rpc/api/api.h"
#include "airsim360/rpc/recording_writer.h"

namespace airsim360 {
namespace {

// Which connections are open, for work that nobody waits for any more.
class OpenConnections {
 public:
  void Close(ConnectionId id) {
    const std::lock_guard lock(mutex_);
    closed_.insert(id);
    // Ids only grow; those long closed have no work left.
    constexpr size_t kRemembered = 10000;
    if (closed_.size() > kRemembered) closed_.erase(closed_.begin());
  }
  bool IsOpen(ConnectionId id) const {
    const std::lock_guard lock(mutex_);
    return !closed_.contains(id);
  }

 private:
  mutable std::mutex mutex_;
  std::set<ConnectionId> closed_;
};

}  // namespace

// Gone in the opposite order: the session may still hand over to pictures, and both to the socket.
struct AirSimServer::Impl {
  std::shared_ptr<Stage> stage;
  OpenConnections connections;
  std::mutex tcp_mutex;
  std::unique_ptr<TcpServer> tcp;
  MemoryLoans loans;
  std::unique_ptr<ImageService> images;
  std::unique_ptr<Session> session;
  std::unique_ptr<Api> api;

  void OnMessage(ConnectionId id, const std::string& message) {
    const auto* bytes = reinterpret_cast<const uint8_t*>(message.data());
    const WireValue value = DecodeWire({bytes, message.size()});
    const RpcMessage call = ParseMessage(value);
    const Reply reply(
        call.id, std::string(call.method), call.arguments->items.size(),
        [this, id, size = message.size()](WireBlocks answer) {
          answer.empty() ? tcp->Done(id, size) : tcp->Answer(id, size, std::move(answer));
        },
        [this, id] { return connections.IsOpen(id); }, id);
    api->table().Call(call, reply);
  }
};

BodiesOfScene ServedBodies(const ServerOptions& options) {
  return [settings = options.settings, assets = options.assets](const Scene& scene) { return ExtraBodies(scene, settings, assets); };
}

AirSimServer::AirSimServer(std::shared_ptr<Stage> stage, const ServerOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->stage = stage->bodies().empty() ? std::make_shared<Stage>(stage, PeopleRequest{}, ServedBodies(options)) : std::move(stage);
  impl_->session = std::make_unique<Session>(*impl_->stage, SortExtras(impl_->stage->bodies(), options.assets),
                                             SessionOptions{.settings = options.settings, .lockstep = options.lockstep});
  impl_->images = std::make_unique<ImageService>(*impl_->session, *impl_->stage, options.picture);
  WriteRecordings(*impl_->session, *impl_->images);
  impl_->api = std::make_unique<Api>(*impl_->session, *impl_->images, impl_->loans);
  for (const auto add : {AddConnectionCalls, AddVehicleCalls, AddMoveCalls, AddImageCalls, AddCameraCalls, AddDetectionCalls,
                         AddSensorCalls, AddObjectCalls, AddWorldCalls, AddWeatherCalls, AddPeopleCalls, AddTrafficCalls, AddMissionCalls,
                         AddPlotCalls, AddCosysCalls, AddUnavailableCalls}) {
    add(*impl_->api);
  }
  for (const std::string& notice : options.settings.notices) LogInfo(notice);
  // The first message may come before the constructor has returned.
  const std::lock_guard lock(impl_->tcp_mutex);
  impl_->tcp = std::make_unique<TcpServer>(options.address, options.port,
                                           TcpHandlers{.on_message =
                                                           [impl = impl_.get()](ConnectionId id, std::string message) {
                                                             { const std::lock_guard wait(impl->tcp_mutex); }
                                                             impl->OnMessage(id, message);
                                                           },
                                                       .on_close = [impl = impl_.get()](ConnectionId id) { impl->connections.Close(id); }},
                                           options.limits);
  impl_->loans.Listen(impl_->tcp->port());
}

AirSimServer::~AirSimServer() {
  // No more calls, no more pictures; then moves end with False.
  impl_->tcp->Stop();
  impl_->images->Stop();
}

int AirSimServer::port() const { return impl_->tcp->port(); }
std::vector<std::string> AirSimServer::Methods() const { return impl_->api->table().Names(); }

}  // namespace airsim360

// What agents send, decoded: JSON texts and query strings to plain structs. Takes untrusted bytes; everything
// is bounded, and every mistake names its field and the nearest thing that would do.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/tasks/agent_server/episode.h"

namespace airsim360 {

/// A request that cannot be understood: which field, what is wrong, the nearest valid choice ("" = none).
class RequestError : public InputError {
 public:
  RequestError(std::string field, const std::string& message, std::string nearest = "");
  const std::string& field() const { return field_; }
  const std::string& nearest() const { return nearest_; }

 private:
  std::string field_, nearest_;
};

struct PanoramaRequest {
  int width = 1024;  ///< even; the height is half of it
  int quality = 90;  ///< of the JPEG
  PanoFrame frame = PanoFrame::kLevel;
};
struct ViewRequest {
  double azimuth = 0, elevation = 0, fov = 1.5707963267948966;  ///< rad, as AgentWorld::View
  int width = 512, height = 384, quality = 90;
};
struct GridRequest {
  int rows = 8, columns = 16;
};
/// What an answer shows besides the state.
struct ObserveRequest {
  std::optional<PanoramaRequest> panorama;
  std::vector<ViewRequest> views;
  std::optional<GridRequest> grid;
};

struct CreateRequest {
  std::string world;      ///< "" = the server's
  std::string task = {};  ///< AgentTask; everything but `observe` is the task's
  std::optional<uint64_t> world_seed;
  EpisodeSpec spec;
  ObserveRequest observe;
};
struct ResetRequest {
  std::optional<uint64_t> seed;
  ObserveRequest observe;
};
struct StepRequest {
  AgentAction action;
  ObserveRequest observe;
};
/// One message of a WebSocket: a request in a text.
struct SocketRequest {
  std::string id;  ///< JSON, to be repeated in the answer; "null" if there is none
  std::string method = {}, path = {};
  std::string body = {};  ///< JSON; "" if there is none
};

/// Empty texts are empty objects. RequestError for anything else that is not one JSON object of the right
/// fields.
CreateRequest DecodeCreate(std::string_view text);
ResetRequest DecodeReset(std::string_view text);
StepRequest DecodeStep(std::string_view text);
ObserveRequest DecodeObserve(std::string_view text);
SocketRequest DecodeSocketRequest(std::string_view text);

/// A panorama for somebody who looks on.
struct WatchRequest {
  int width = 1024, quality = 90;  ///< as PanoramaRequest
  bool labels = false;             ///< with range and entities
  int64_t since = -1;              ///< number of a moment that is known already: no picture of it
};

/// "width=1024&quality=90" as the fields of the structs.
PanoramaRequest DecodePanoramaQuery(std::string_view query);
WatchRequest DecodeWatchQuery(std::string_view query);
ViewRequest DecodeViewQuery(std::string_view query);
GridRequest DecodeGridQuery(std::string_view query);

}  // namespace airsim360

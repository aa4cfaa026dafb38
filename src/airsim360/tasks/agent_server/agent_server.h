// The agent interface over HTTP/1.1 and WebSocket.
#pragma once

#include <memory>
#include <string>

#include "airsim360/tasks/agent_server/agent_api.h"

namespace airsim360 {

class HttpServer;

struct AgentServerOptions {
  std::string address = "127.0.0.1";  ///< IPv4
  int port = 8361;                    ///< 0 = any free one
  /// Then the one that has waited longest without a whole request makes room, or a further one is closed at once.
  size_t connections = 128;
  size_t body_bytes = size_t{1} << 20;
  int seconds = 60;  ///< for one request to arrive, for one answer to leave; then the connection is closed
  int workers = 4;   ///< requests answered at a time
};

/// Serves from its construction to its end, as HttpServer does.
class AgentServer {
 public:
  /// RuntimeError if the port cannot be had, InputError for an address that is none.
  AgentServer(AgentApi& api, const AgentServerOptions& options);
  ~AgentServer();
  AgentServer(const AgentServer&) = delete;
  AgentServer& operator=(const AgentServer&) = delete;

  int port() const;

 private:
  std::unique_ptr<HttpServer> server_;
};

}  // namespace airsim360

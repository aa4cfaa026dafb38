#include "airsim360/tasks/agent_server/agent_server.h"

#include "airsim360/http/http_server.h"

namespace airsim360 {
namespace {

HttpResponse Respond(AgentApi& api, const HttpRequest& request) {
  AgentResponse response = api.Handle({request.method, request.target, request.body});
  return {.status = response.status,
          .content_type = std::move(response.content_type),
          .body = std::move(response.body),
          .allow = std::move(response.allow)};
}

}  // namespace

AgentServer::AgentServer(AgentApi& api, const AgentServerOptions& options)
    : server_(std::make_unique<HttpServer>(
          HttpHandlers{.request = [&api](const HttpRequest& request) { return Respond(api, request); },
                       .message = [&api](const std::string& text) -> SocketMessage { return {api.HandleMessage(text)}; }},
          HttpServerOptions{.address = options.address,
                            .port = options.port,
                            .connections = options.connections,
                            .body_bytes = options.body_bytes,
                            .seconds = options.seconds,
                            .workers = options.workers,
                            .socket_target = "/v1/ws"})) {}

AgentServer::~AgentServer() = default;

int AgentServer::port() const { return server_->port(); }

}  // namespace airsim360

// HTTP/1.1 and WebSocket on one port, for the servers of this program. Boost.Beast lives in http_server.cc alone.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace airsim360 {

struct HttpRequest {
  std::string method, target;  ///< "POST", "/v1/episodes/e1/step?…"; HEAD comes as GET, and its answer goes without the body
  std::string body = {};
};

struct HttpResponse {
  int status = 200;
  std::string content_type = "application/json";
  std::string body = {};
  std::string allow = {};  ///< of status 405: the methods that are answered
  int file = -1;           ///< open descriptor of a regular file that is sent instead of `body`; the server closes it
};

/// Answer to one message of a WebSocket.
struct SocketMessage {
  std::string bytes;
  bool binary = false;
};

/// Both are called from several threads, one call at a time for each connection. They do not throw.
struct HttpHandlers {
  std::function<HttpResponse(const HttpRequest& request)> request;
  std::function<SocketMessage(const std::string& message)> message = {};
};

struct HttpServerOptions {
  std::string address = "127.0.0.1";  ///< IPv4
  int port = 0;                       ///< 0 = any free one
  /// Then the one that has waited longest without a whole request makes room, or a further one is closed at once.
  size_t connections = 128;
  size_t body_bytes = size_t{1} << 20;
  int seconds = 60;                ///< for one request to arrive, for one answer to leave; then the connection is closed
  int workers = 4;                 ///< requests answered at a time
  std::string socket_target = {};  ///< where the WebSocket is; "" = there is none
  std::vector<std::pair<std::string, std::string>> headers = {};  ///< of every answer
};

/// Serves from its construction to its end. A connection has one request in work at a time, so that no client
/// can take more than its turn; reading, writing and answering are apart, so that a slow one holds up nobody.
/// Requests of web pages from elsewhere are refused by their Origin, and names that only point to this machine by
/// their Host; bodies are JSON and say so.
class HttpServer {
 public:
  /// RuntimeError if the port cannot be had, InputError for an address that is none.
  HttpServer(HttpHandlers handlers, const HttpServerOptions& options);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  int port() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360

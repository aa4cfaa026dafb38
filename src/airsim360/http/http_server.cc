#include "airsim360/http/http_server.h"

#include <array>
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <thread>

#include "airsim360/base/bounded_log.h"
#include "airsim360/base/error.h"
#include "airsim360/base/work_queue.h"

namespace airsim360 {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using Code = boost::system::error_code;

constexpr uint32_t kHeaderBytes = 16384;
constexpr int kLingerSeconds = 5;
constexpr size_t kLingerBytes = size_t{8} << 20;

// Threads that answer requests, apart from the one that reads and writes.
class Workers {
 public:
  explicit Workers(int count) {
    for (int i = 0; i < count; ++i) threads_.emplace_back([this] { Run(); });
  }
  ~Workers() { Stop(); }
  void Post(std::function<void()> job) { jobs_.Post(std::move(job)); }
  void Stop() {
    jobs_.Stop();
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }

 private:
  void Run() {
    while (const auto job = jobs_.Next()) (*job)();
  }
  WorkQueue<std::function<void()>> jobs_;
  std::vector<std::thread> threads_;
};

class HttpSession;

// What all connections share.
struct Shared {
  HttpHandlers handlers;
  HttpServerOptions options;
  Workers workers;
  std::atomic<size_t> open{0};
  bool local = false;  // listens to this machine alone
  int port = 0;
  std::deque<std::weak_ptr<HttpSession>> silent = {};  // in the order of their coming; those that have called since count no more
  BoundedLog log = {};                                 // of what clients can cause at will
};

struct HostPort {
  std::string_view host, port;
};

// Of a Host or an Origin; the port is "" where none is named.
HostPort SplitHost(std::string_view text) {
  if (const size_t scheme = text.find("://"); scheme != std::string_view::npos) text.remove_prefix(scheme + 3);
  text = text.substr(0, text.find('/'));
  const size_t end = text.starts_with('[') ? text.find(']') : 0;
  const size_t colon = end == std::string_view::npos ? end : text.find(':', end);
  return {text.substr(0, colon), colon == std::string_view::npos ? "" : text.substr(colon + 1)};
}

bool IsLocal(std::string_view host) { return host == "127.0.0.1" || host == "localhost" || host == "[::1]"; }

std::string_view View(beast::string_view text) { return {text.data(), text.size()}; }

// Web pages of other sites, and of other servers on this machine, must not fly drones through the browser of whoever
// looks at them: their origin tells them apart, and a name that only points here is no name of this machine.
bool IsForeign(const http::request<http::string_body>& request, const Shared& shared) {
  const auto origin = request.find(http::field::origin);
  if (origin != request.end()) {
    const HostPort from = SplitHost(View(origin->value()));
    const std::string_view port = from.port.empty() ? "80" : from.port;
    if (!IsLocal(from.host) || port != std::to_string(shared.port)) return true;
  }
  const auto host = request.find(http::field::host);
  return shared.local && host != request.end() && !IsLocal(SplitHost(View(host->value())).host);
}

// RFC 9112, 3.2: one Host, and from HTTP/1.1 on not less.
bool HasOneHost(const http::request<http::string_body>& request) {
  const size_t hosts = request.count(http::field::host);
  return hosts == 1 || (hosts == 0 && request.version() < 11);
}

// Whether a Content-Type is JSON's; case and parameters do not count.
bool IsJson(std::string_view type) {
  type = type.substr(0, type.find(';'));
  while (!type.empty() && (type.back() == ' ' || type.back() == '\t')) type.remove_suffix(1);
  return beast::iequals({type.data(), type.size()}, "application/json");
}

std::string ErrorText(const std::string& message) { return "{\"error\":{\"message\":\"" + message + "\"}}"; }

// Counts a connection for as long as it lives.
class Counted {
 public:
  explicit Counted(Shared& shared) : shared_(shared) { ++shared_.open; }
  ~Counted() { --shared_.open; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
  Shared& shared() const { return shared_; }

 private:
  Shared& shared_;
};

// One WebSocket: a message, its answer, the next message.
class SocketSession : public std::enable_shared_from_this<SocketSession>, Counted {
 public:
  SocketSession(tcp::socket socket, Shared& shared) : Counted(shared), stream_(std::move(socket)) {}

  void Run(const http::request<http::string_body>& request) {
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = std::chrono::seconds(shared().options.seconds);
    timeout.idle_timeout = std::chrono::seconds(5 * shared().options.seconds);
    timeout.keep_alive_pings = true;
    stream_.set_option(timeout);
    stream_.read_message_max(shared().options.body_bytes);
    stream_.async_accept(request, [self = shared_from_this()](Code error) {
      if (!error) self->Read();
    });
  }

 private:
  void Read() {
    buffer_.clear();
    stream_.async_read(buffer_, [self = shared_from_this()](Code error, size_t) {
      if (!error) self->Answer();
    });
  }
  void Answer() {
    shared().workers.Post([self = shared_from_this(), text = beast::buffers_to_string(buffer_.data())] {
      SocketMessage answer = self->shared().handlers.message(text);
      asio::post(self->stream_.get_executor(), [self, answer = std::move(answer)]() mutable {
        self->answer_ = std::move(answer.bytes);
        self->stream_.binary(answer.binary);
        self->stream_.async_write(asio::buffer(self->answer_), [self](Code error, size_t) {
          if (!error) self->Read();
        });
      });
    });
  }

  websocket::stream<beast::tcp_stream> stream_;
  beast::flat_buffer buffer_;
  std::string answer_;
};

// One HTTP connection: a request, its answer, the next request.
class HttpSession : public std::enable_shared_from_this<HttpSession>, Counted {
 public:
  HttpSession(tcp::socket socket, Shared& shared) : Counted(shared), stream_(std::move(socket)) {}
  void Run() { Read(); }
  bool has_called() const { return has_called_; }
  /// Makes room for another one.
  void Abandon() { stream_.close(); }

 private:
  void Read() {
    request_ = {};
    parser_.emplace();
    parser_->body_limit(shared().options.body_bytes);
    parser_->header_limit(kHeaderBytes);
    stream_.expires_after(std::chrono::seconds(shared().options.seconds));
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](Code error, size_t) { self->Received(error); });
  }

  void Received(Code error) {
    if (error == http::error::body_limit)
      return Refuse(413, "a request has at most " + std::to_string(shared().options.body_bytes) + " bytes");
    if (error == http::error::header_limit) return Refuse(431, "the header is too large");
    const bool not_http = error.category() == http::make_error_code(http::error::bad_method).category();
    if (error && not_http && error != http::error::end_of_stream) return Refuse(400, "this is not HTTP");
    if (error) return Close();
    request_ = parser_->release();
    has_called_ = true;
    if (!HasOneHost(request_)) return Refuse(400, "a request has one Host header");
    if (IsForeign(request_, shared())) return Refuse(403, "requests of other sites are not answered");
    if (websocket::is_upgrade(request_)) {
      const std::string& target = shared().options.socket_target;
      if (target.empty()) return Refuse(404, "there is no WebSocket here");
      if (View(request_.target()) != target) return Refuse(404, "the WebSocket is at " + target);
      stream_.expires_never();
      std::make_shared<SocketSession>(stream_.release_socket(), shared())->Run(request_);
      return;
    }
    Answer();
  }

  void Answer() {
    // Browsers send other types without asking first.
    const auto type = request_.find(http::field::content_type);
    if (!request_.body().empty() && type != request_.end() && !IsJson(View(type->value())))
      return Refuse(415,
                    "bodies are JSON and say so: add the header Content-Type: application/json (curl -H "
                    "'Content-Type: application/json')");
    stream_.expires_never();
    shared().workers.Post([self = shared_from_this()] {
      const http::request<http::string_body>& request = self->request_;
      HttpResponse response = self->shared().handlers.request(
          {self->AsksForHead() ? "GET" : std::string(View(request.method_string())), std::string(View(request.target())), request.body()});
      asio::post(self->stream_.get_executor(),
                 [self, response = std::move(response)]() mutable { self->Write(std::move(response), self->request_.keep_alive()); });
    });
  }

  bool AsksForHead() const { return request_.method() == http::verb::head; }

  void Refuse(int status, const std::string& message) { Write({status, "application/json", ErrorText(message)}, false); }

  // What both kinds of answers begin with.
  template <class Response>
  void Head(Response& response, const HttpResponse& answer, bool keep_alive) {
    response.result(static_cast<http::status>(answer.status));
    response.version(11);
    response.set(http::field::server, "airsim360");
    response.set(http::field::content_type, answer.content_type);
    response.set(http::field::cache_control, "no-store");
    for (const auto& [name, value] : shared().options.headers) response.set(name, value);
    if (!answer.allow.empty()) response.set(http::field::allow, answer.allow);
    response.keep_alive(keep_alive);
  }

  // The length that a body would have, and no body.
  void WriteHead(const HttpResponse& answer, uint64_t length, bool keep_alive) {
    head_ = {};
    Head(head_, answer, keep_alive);
    head_.content_length(length);
    stream_.expires_after(std::chrono::seconds(shared().options.seconds));
    http::async_write(stream_, head_, [self = shared_from_this(), keep_alive](Code error, size_t) { self->Written(error, keep_alive); });
  }

  void Write(HttpResponse answer, bool keep_alive) {
    if (answer.file >= 0) return WriteFile(answer, keep_alive);
    if (AsksForHead()) return WriteHead(answer, answer.body.size(), keep_alive);
    response_ = {};
    Head(response_, answer, keep_alive);
    response_.body() = std::move(answer.body);
    response_.prepare_payload();
    stream_.expires_after(std::chrono::seconds(shared().options.seconds));
    http::async_write(stream_, response_,
                      [self = shared_from_this(), keep_alive](Code error, size_t) { self->Written(error, keep_alive); });
  }

  // Piece by piece from the disk, whatever its size.
  void WriteFile(const HttpResponse& answer, bool keep_alive) {
    file_ = {};
    Head(file_, answer, keep_alive);
    beast::file file;
    file.native_handle(answer.file);
    Code error;
    file_.body().reset(std::move(file), error);
    if (error) return Refuse(404, "the file cannot be read");
    if (AsksForHead()) {
      const uint64_t length = file_.body().size();
      file_.body().close();
      return WriteHead(answer, length, keep_alive);
    }
    file_.prepare_payload();
    stream_.expires_after(std::chrono::seconds(shared().options.seconds));
    const auto written = [self = shared_from_this(), keep_alive](Code failed, size_t) {
      self->file_.body().close();
      self->Written(failed, keep_alive);
    };
    http::async_write(stream_, file_, written);
  }

  void Written(Code error, bool keep_alive) {
    if (error || !keep_alive) return Close();
    Read();
  }

  // What the client is still sending is read and dropped for a while: closing at once would reset the
  // connection, and the last answer with it.
  void Close() {
    Code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    stream_.expires_after(std::chrono::seconds(kLingerSeconds));
    Drop();
  }
  void Drop() {
    stream_.async_read_some(asio::buffer(dropped_), [self = shared_from_this()](Code error, size_t size) {
      self->dropped_bytes_ += size;
      if (!error && self->dropped_bytes_ < kLingerBytes) self->Drop();
    });
  }

  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{kHeaderBytes + (size_t{1} << 21)};
  std::optional<http::request_parser<http::string_body>> parser_;
  http::request<http::string_body> request_;
  http::response<http::string_body> response_;
  http::response<http::file_body> file_;
  http::response<http::empty_body> head_;
  std::array<char, 4096> dropped_;
  size_t dropped_bytes_ = 0;
  bool has_called_ = false;
};

// Whether one more can be connected: who has sent no whole request, longest connected first, goes for it.
bool MakeRoom(Shared& shared) {
  const auto has_called = [](const std::weak_ptr<HttpSession>& session) {
    const auto held = session.lock();
    return !held || held->has_called();
  };
  std::erase_if(shared.silent, has_called);
  if (shared.open < shared.options.connections) return true;
  if (shared.silent.empty()) return false;
  shared.log.Warn("a client that sent no request was disconnected: " + std::to_string(shared.open) + " are connected");
  if (const auto silent = shared.silent.front().lock()) silent->Abandon();
  shared.silent.pop_front();
  return true;
}

}  // namespace

struct HttpServer::Impl {
  std::unique_ptr<Shared> shared;  // outlives the connections, which io holds
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  std::thread thread;

  void Listen(const HttpServerOptions& options) {
    Code error;
    const auto address = asio::ip::make_address_v4(options.address == "localhost" ? "127.0.0.1" : options.address, error);
    if (error) {
      throw InputError("--host: '" + options.address + "' is not an IPv4 address; did you mean '127.0.0.1'?");
    }
    shared->local = address.is_loopback();
    const tcp::endpoint endpoint(address, static_cast<uint16_t>(options.port));
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
      throw RuntimeError("cannot listen on " + options.address + ":" + std::to_string(options.port) + ": " + error.message());
    }
  }

  void Accept() {
    acceptor.async_accept([this](Code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error && MakeRoom(*shared)) {
        Code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        const auto session = std::make_shared<HttpSession>(std::move(socket), *shared);
        shared->silent.push_back(session);
        session->Run();
      } else if (!error) {
        shared->log.Warn("a client was turned away: " + std::to_string(shared->open) + " are connected already");
      }
      Accept();
    });
  }
};

HttpServer::HttpServer(HttpHandlers handlers, const HttpServerOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->shared.reset(new Shared{std::move(handlers), options, Workers(options.workers)});
  impl_->Listen(options);
  impl_->shared->port = port();
  impl_->Accept();
  impl_->thread = std::thread([impl = impl_.get()] { impl->io.run(); });
}

HttpServer::~HttpServer() {
  // Nothing new is read; what is being answered ends.
  impl_->io.stop();
  impl_->thread.join();
  impl_->shared->workers.Stop();
}

int HttpServer::port() const { return impl_->acceptor.local_endpoint().port(); }

}  // namespace airsim360

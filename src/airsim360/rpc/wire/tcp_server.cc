#include "airsim360/rpc/wire/tcp_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "airsim360/base/bounded_log.h"
#include "airsim360/base/error.h"
#include "airsim360/rpc/wire/connection.h"

namespace airsim360 {
namespace {

using internal::Connection;

constexpr ConnectionId kListenerId = 0, kWakeId = 1, kFirstConnectionId = 2;

// A file descriptor that closes itself.
struct Descriptor {
  int fd = -1;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

[[noreturn]] void Fail(const std::string& address, int port, const char* what) {
  throw RuntimeError("cannot " + std::string(what) + " on " + (address.empty() ? "0.0.0.0" : address) + ":" + std::to_string(port) + ": " +
                     std::strerror(errno));
}

void SetOption(int fd, int level, int option, int value) { ::setsockopt(fd, level, option, &value, sizeof value); }

// A listening socket; `port` becomes the one it has.
int Listen(const std::string& address, int& port) {
  sockaddr_in where{};
  where.sin_family = AF_INET;
  where.sin_port = htons(static_cast<uint16_t>(port));
  where.sin_addr.s_addr = htonl(INADDR_ANY);
  const std::string host = address == "localhost" ? "127.0.0.1" : address;
  if (!host.empty() && ::inet_pton(AF_INET, host.c_str(), &where.sin_addr) != 1) {
    throw InputError("LocalHostIp: '" + address + "' is not an IPv4 address; did you mean '127.0.0.1'?");
  }
  Descriptor socket{::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)};
  if (socket.fd < 0) Fail(address, port, "open a socket");
  // Connections of an earlier process that has crashed do not keep the port.
  SetOption(socket.fd, SOL_SOCKET, SO_REUSEADDR, 1);
  if (::bind(socket.fd, reinterpret_cast<const sockaddr*>(&where), sizeof where) != 0) Fail(address, port, "bind");
  if (::listen(socket.fd, SOMAXCONN) != 0) Fail(address, port, "listen");
  socklen_t size = sizeof where;
  ::getsockname(socket.fd, reinterpret_cast<sockaddr*>(&where), &size);
  port = ntohs(where.sin_port);
  return std::exchange(socket.fd, -1);
}

bool IsOnThisMachine(const sockaddr_in& peer) { return (ntohl(peer.sin_addr.s_addr) >> 24) == IN_LOOPBACKNET; }

// Small answers leave at once; the system finds out about peers that vanished.
void PrepareSocket(int fd, const sockaddr_in& peer) {
  // What waits for a peer on this machine stays in the processor's caches.
  if (IsOnThisMachine(peer)) SetOption(fd, SOL_SOCKET, SO_SNDBUF, 1 << 17);
  SetOption(fd, IPPROTO_TCP, TCP_NODELAY, 1);
  SetOption(fd, SOL_SOCKET, SO_KEEPALIVE, 1);
  SetOption(fd, IPPROTO_TCP, TCP_KEEPIDLE, 30);
  SetOption(fd, IPPROTO_TCP, TCP_KEEPINTVL, 10);
  SetOption(fd, IPPROTO_TCP, TCP_KEEPCNT, 3);
}

}  // namespace

struct TcpServer::Impl {
  TcpHandlers handlers;
  TcpLimits limits;
  int port = 0;
  Descriptor listener, epoll, wake;
  Connection::Totals totals;
  std::atomic<bool> stopping{false};
  BoundedLog log;  // of what clients can cause at will

  mutable std::mutex mutex;  // of what follows, and of every epoll_ctl
  std::map<ConnectionId, std::shared_ptr<Connection>> open;
  ConnectionId next_id = kFirstConnectionId;
  std::thread thread;

  std::shared_ptr<Connection> Find(ConnectionId id) const {
    const std::lock_guard lock(mutex);
    const auto found = open.find(id);
    return found == open.end() ? nullptr : found->second;
  }

  void Watch(int fd, ConnectionId id, uint32_t events, int operation) {
    epoll_event event{};
    event.events = events;
    event.data.u64 = id;
    ::epoll_ctl(epoll.fd, operation, fd, &event);
  }

  // Asks for what the connection needs now: more bytes unless it has too much unanswered, room if output
  // waits.
  void Rearm(Connection& connection) {
    const std::lock_guard lock(mutex);
    uint32_t events = EPOLLRDHUP;
    if (!connection.is_full()) events |= EPOLLIN;
    if (connection.output_waits()) events |= EPOLLOUT;
    if (events == connection.events || !open.contains(connection.id())) return;
    connection.events = events;
    Watch(connection.fd(), connection.id(), events, EPOLL_CTL_MOD);
  }

  void Accept() {
    while (true) {
      sockaddr_in peer{};
      socklen_t size = sizeof peer;
      const int fd = ::accept4(listener.fd, reinterpret_cast<sockaddr*>(&peer), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
      if (fd < 0) return;
      PrepareSocket(fd, peer);
      if (!MakeRoom()) {
        ::close(fd);
        log.Warn("a client was turned away: " + std::to_string(limits.connections) + " are connected already");
        continue;
      }
      const std::lock_guard lock(mutex);
      const auto connection = std::make_shared<Connection>(next_id++, fd, limits, totals);
      open[connection->id()] = connection;
      connection->events = EPOLLIN | EPOLLRDHUP;
      Watch(fd, connection->id(), connection->events, EPOLL_CTL_ADD);
    }
  }

  // Whether one more can be connected: who never called, longest connected first, goes for it.
  bool MakeRoom() {
    std::optional<ConnectionId> idle;
    {
      const std::lock_guard lock(mutex);
      if (open.size() < limits.connections) return true;
      for (const auto& [id, connection] : open) {
        if (!idle && !connection->has_called()) idle = id;
      }
    }
    if (!idle) return false;
    log.Warn("a client that never called was disconnected: " + std::to_string(limits.connections) + " are connected");
    Close(*idle);
    return true;
  }

  // Too much waits in all: those that have read nothing for the longest time go.
  void FreeOutput() {
    while (totals.output > limits.total_output_bytes) {
      std::shared_ptr<Connection> slowest;
      {
        const std::lock_guard lock(mutex);
        for (const auto& [id, connection] : open) {
          if (connection->output_waits() && (!slowest || connection->last_read() < slowest->last_read())) slowest = connection;
        }
      }
      if (!slowest) return;
      log.Warn("a client was disconnected: all together leave more than " + std::to_string(limits.total_output_bytes >> 20) +
               " MiB of answers unread");
      Lose(*slowest);
    }
  }

  // Left to the server's thread, which sees the hang-up.
  void Lose(Connection& connection) {
    connection.Abandon();
    ::shutdown(connection.fd(), SHUT_RDWR);
  }

  void Close(ConnectionId id) {
    {
      const std::lock_guard lock(mutex);
      const auto found = open.find(id);
      if (found == open.end()) return;
      // The socket stays open until its last user has let go; it must not wake this thread till then.
      Watch(found->second->fd(), id, 0, EPOLL_CTL_DEL);
      ::shutdown(found->second->fd(), SHUT_RDWR);
      open.erase(found);
    }
    handlers.on_close(id);
  }

  void Serve(ConnectionId id, uint32_t events) {
    const auto connection = Find(id);
    if (!connection) return;
    try {
      bool ended = (events & (EPOLLERR | EPOLLHUP)) != 0;
      if (!ended && events & EPOLLOUT) ended = !connection->Flush();
      if (!ended && events & (EPOLLIN | EPOLLRDHUP)) {
        ended = connection->ReadSome([&](std::string message) { handlers.on_message(id, std::move(message)); }) == Connection::Read::kEnded;
      }
      if (ended) return Close(id);
      Rearm(*connection);
    } catch (const WireError& error) {
      log.Warn("a client was disconnected: " + std::string(error.what()));
      Close(id);
    }
  }

  void Run() {
    std::array<epoll_event, 64> events;
    while (!stopping) {
      const int count = ::epoll_wait(epoll.fd, events.data(), static_cast<int>(events.size()), -1);
      for (int i = 0; i < count; ++i) {
        const ConnectionId id = events[static_cast<size_t>(i)].data.u64;
        if (id == kListenerId) Accept();
        if (id >= kFirstConnectionId) Serve(id, events[static_cast<size_t>(i)].events);
      }
    }
  }
};

TcpServer::TcpServer(const std::string& address, int port, TcpHandlers handlers, const TcpLimits& limits)
    : impl_(std::make_unique<Impl>()) {
  impl_->handlers = std::move(handlers);
  impl_->limits = limits;
  impl_->port = port;
  impl_->listener.fd = Listen(address, impl_->port);
  impl_->epoll.fd = ::epoll_create1(EPOLL_CLOEXEC);
  impl_->wake.fd = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (impl_->epoll.fd < 0 || impl_->wake.fd < 0) Fail(address, port, "wait for clients");
  impl_->Watch(impl_->listener.fd, kListenerId, EPOLLIN, EPOLL_CTL_ADD);
  impl_->Watch(impl_->wake.fd, kWakeId, EPOLLIN, EPOLL_CTL_ADD);
  impl_->thread = std::thread([this] { impl_->Run(); });
}

TcpServer::~TcpServer() { Stop(); }

void TcpServer::Stop() {
  if (impl_->stopping.exchange(true)) return;
  const uint64_t one = 1;
  [[maybe_unused]] const ssize_t put = ::write(impl_->wake.fd, &one, sizeof one);
  impl_->thread.join();
}

int TcpServer::port() const { return impl_->port; }

void TcpServer::Answer(ConnectionId id, size_t message_bytes, WireBlocks bytes) {
  const auto connection = impl_->Find(id);
  if (!connection) return;
  connection->Settle(message_bytes);
  const Connection::Sent sent = connection->Send(std::move(bytes));
  if (sent == Connection::Sent::kTooSlow) {
    impl_->log.Warn("a client was disconnected: it leaves more than " + std::to_string(impl_->limits.output_bytes >> 20) +
                    " MiB of answers unread");
  }
  if (sent != Connection::Sent::kYes) return impl_->Lose(*connection);
  impl_->FreeOutput();
  impl_->Rearm(*connection);
}

void TcpServer::Done(ConnectionId id, size_t message_bytes) {
  const auto connection = impl_->Find(id);
  if (!connection) return;
  connection->Settle(message_bytes);
  impl_->Rearm(*connection);
}

size_t TcpServer::connections() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->open.size();
}

}  // namespace airsim360

// One client's socket with what has arrived and what waits to be sent.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>
#include <string>

#include "airsim360/rpc/tcp_server.h"

namespace airsim360::internal {

/// Reading belongs to the server's thread, sending to any. The socket lives as long as the object.
class Connection {
 public:
  enum class Read { kOpen, kEnded };

  Connection(ConnectionId id, int fd, const TcpLimits& limits, std::atomic<size_t>& total_output);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  ConnectionId id() const { return id_; }
  int fd() const { return fd_; }

  /// Reads what is there, up to a bound so that others get their turn, and hands over every whole object.
  /// WireError when the client sends what is not msgpack.
  Read ReadSome(const std::function<void(std::string)>& on_message);

  /// Sends or queues an answer. False: the client is too slow, or gone; the connection is then of no use.
  bool Send(WireBlocks bytes);
  /// Sends more of the queue. False as above.
  bool Flush();
  bool output_waits() const { return queued_ > 0; }

  /// Messages handed over and not yet answered.
  std::atomic<size_t> unanswered{0};
  /// Events asked of epoll; only the thread that holds the server's lock changes it.
  uint32_t events = 0;

 private:
  bool FlushLocked(size_t most);

  const ConnectionId id_;
  const int fd_;
  const TcpLimits& limits_;
  std::atomic<size_t>& total_output_;
  WireScanner scanner_;
  std::string input_;

  std::mutex mutex_;  // of what follows
  std::deque<WireBlock> output_;
  size_t sent_ = 0;  // of output_.front()
  std::atomic<size_t> queued_{0};
  bool broken_ = false;
};

}  // namespace airsim360::internal

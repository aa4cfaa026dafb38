// One client's socket with what has arrived and what waits to be sent.
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <mutex>
#include <string>

#include "airsim360/rpc/wire/tcp_server.h"

namespace airsim360::internal {

/// Reading belongs to the server's thread, sending to any. The socket lives as long as the object.
class Connection {
 public:
  enum class Read { kOpen, kEnded };

  /// Counted over all connections.
  struct Totals {
    std::atomic<size_t> output{0}, input{0};
  };

  Connection(ConnectionId id, int fd, const TcpLimits& limits, Totals& totals);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  ConnectionId id() const { return id_; }
  int fd() const { return fd_; }

  /// Reads what is there, up to a bound so that others get their turn, and hands over every whole object.
  /// WireError when the client sends what is not msgpack, or too much for all.
  Read ReadSome(const std::function<void(std::string)>& on_message);

  enum class Sent { kYes, kGone, kTooSlow };  ///< after the others the connection is of no use
  /// Sends or queues an answer.
  Sent Send(WireBlocks bytes);
  /// Sends more of the queue. False: the client has gone.
  bool Flush();
  bool output_waits() const { return queued_ > 0; }
  /// When the client last read something, or had nothing to read.
  std::chrono::steady_clock::time_point last_read() const;
  /// Forgets what waits: the connection is of no use.
  void Abandon();

  /// Whether nothing is to be read from the client before it has got answers.
  bool is_full() const { return unanswered_ >= limits_.unanswered || unanswered_bytes_ >= limits_.unanswered_bytes; }
  /// A message of so many bytes that was handed over is answered.
  void Settle(size_t message_bytes);
  bool has_called() const { return has_called_; }
  /// Events asked of epoll; only the thread that holds the server's lock changes it.
  uint32_t events = 0;

 private:
  bool FlushLocked(size_t most);
  void AbandonLocked();

  const ConnectionId id_;
  const int fd_;
  const TcpLimits& limits_;
  Totals& totals_;
  WireScanner scanner_;
  std::string input_;
  std::atomic<size_t> unanswered_{0}, unanswered_bytes_{0};
  std::atomic<size_t> held_bytes_{0};  // unanswered or not whole yet
  std::atomic<bool> has_called_{false};

  mutable std::mutex mutex_;  // of what follows
  std::deque<WireBlock> output_;
  size_t sent_ = 0;  // of output_.front()
  std::atomic<size_t> queued_{0};
  std::chrono::steady_clock::time_point last_read_{};
  bool broken_ = false;
};

}  // namespace airsim360::internal

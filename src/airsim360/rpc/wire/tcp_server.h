// Many clients on one TCP port, each sending msgpack objects: one thread waits on all of them, nobody can
// make the others wait.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "airsim360/rpc/wire/wire_value.h"

namespace airsim360 {

using ConnectionId = uint64_t;

struct TcpLimits {
  WireLimits message;
  /// Then the one that has waited longest without a call makes room, or a further one is closed at once.
  size_t connections = 256;
  size_t unanswered = 1024;                    ///< messages of a connection: then nothing more is read from it
  size_t unanswered_bytes = size_t{16} << 20;  ///< the same
  /// Unanswered of all clients, half messages included: then who sends on and has more than small_input_bytes is closed.
  size_t total_input_bytes = size_t{256} << 20, small_input_bytes = size_t{1} << 20;
  /// Waiting for a client that does not read when one more answer is there: then it is closed.
  size_t output_bytes = size_t{128} << 20;
  /// The same over all clients: those that have read nothing for the longest time are closed.
  size_t total_output_bytes = size_t{512} << 20;
};

/// What the server tells its owner, always on the server's own thread.
struct TcpHandlers {
  /// One whole msgpack object. Must return soon: everybody waits for it. WireError closes the connection.
  std::function<void(ConnectionId, std::string message)> on_message;
  /// The connection is gone; its id will not come again.
  std::function<void(ConnectionId)> on_close;
};

class TcpServer {
 public:
  /// Listens on `address` ("127.0.0.1"; "" = all interfaces) and `port` (0 = a free one). The port is free
  /// again as soon as the process has ended, however it ended. RuntimeError naming the address and the
  /// reason.
  TcpServer(const std::string& address, int port, TcpHandlers handlers, const TcpLimits& limits = {});
  /// Closes every connection and joins the thread.
  ~TcpServer();
  TcpServer(const TcpServer&) = delete;
  TcpServer& operator=(const TcpServer&) = delete;

  /// Takes no more messages and joins the thread; answers can still be given.
  void Stop();
  int port() const;
  /// Sends the answer to one message of `message_bytes`; from any thread, never waits. Nothing happens if the
  /// connection is gone.
  void Answer(ConnectionId connection, size_t message_bytes, WireBlocks bytes);
  /// One message will get no answer (a notification); counts as unanswered no longer.
  void Done(ConnectionId connection, size_t message_bytes);
  size_t connections() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360

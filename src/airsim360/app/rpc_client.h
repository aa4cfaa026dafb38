// A client of the AirSim server, for commands that look at one that runs elsewhere.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

#include "airsim360/rpc/wire/wire_value.h"

namespace airsim360 {

/// InputError for what is no "HOST:PORT".
void CheckAddress(const std::string& address);

/// One connection; any thread may call, one call at a time. A connection that is lost is made anew by the next call.
class RpcClient {
 public:
  /// Connects at once. RuntimeError if nobody answers at "HOST:PORT"; InputError for another form.
  explicit RpcClient(const std::string& address);
  ~RpcClient();
  RpcClient(const RpcClient&) = delete;
  RpcClient& operator=(const RpcClient&) = delete;

  const std::string& address() const { return address_; }
  /// Calls `method` with `count` arguments that `arguments` writes, and has `read` read the result. RuntimeError with the
  /// server's words, or if it does not answer within ten seconds; answers have at most 512 MiB.
  void Call(std::string_view method, size_t count, const std::function<void(WireWriter&)>& arguments,
            const std::function<void(const WireValue&)>& read);
  /// Calls without waiting for an answer, which the server then does not give.
  void Post(std::string_view method, size_t count, const std::function<void(WireWriter&)>& arguments);

 private:
  void Connect();
  void Close();
  void Send(std::string_view bytes);
  std::string Receive();

  std::string address_, host_, port_;
  std::mutex mutex_;
  int socket_ = -1;
  uint32_t next_ = 0;
};

}  // namespace airsim360

// The answer to one call, to be given once, from any thread, now or later.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "airsim360/rpc/wire/message.h"
#include "airsim360/rpc/wire/wire_convert.h"

namespace airsim360 {

/// Where finished answers go: the bytes, or none for a notification that is done.
using AnswerSink = std::function<void(WireBlocks bytes)>;

/// Copies share one answer; the first wins. A call whose last copy goes without an answer is told so.
class Reply {
 public:
  /// `id` empty: a notification. `alive` says whether somebody still waits. `client`: who has called, a connection's id.
  Reply(std::optional<uint32_t> id, std::string method, size_t argument_count, AnswerSink sink, std::function<bool()> alive,
        uint64_t client = 0);

  template <class T>
  void Result(const T& value) const {
    WireWriter writer;
    if (Begin(writer)) {
      ToWire(writer, value);
      Send(writer.Take());
    }
  }
  void Nil() const;
  /// The error text as it is.
  void Error(std::string_view text) const;
  /// What rpclib's server says of an exception that leaves a function.
  void Exception(std::string_view what) const;
  /// False when the client has gone: then work for it can be left undone.
  bool wanted() const;
  const std::string& method() const;
  uint64_t client() const;

 private:
  struct State;
  bool Begin(WireWriter& writer) const;
  void Send(WireBlocks bytes) const;
  std::shared_ptr<State> state_;
};

}  // namespace airsim360

// msgpack-rpc: what a message from a client is, and how answers look.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "airsim360/rpc/wire/wire_value.h"

namespace airsim360 {

/// [0, id, method, [arguments]], or without an answer [2, method, [arguments]].
struct RpcMessage {
  std::optional<uint32_t> id;  ///< empty: nobody waits for an answer
  std::string_view method;
  const WireValue* arguments = nullptr;  ///< an array
};

/// WireError when the object is no request and no notification.
RpcMessage ParseMessage(const WireValue& value);

/// [1, id, error, nil].
std::string ErrorAnswer(uint32_t id, std::string_view error);
/// The start of [1, id, nil, result]: the result is to be appended.
void BeginAnswer(uint32_t id, WireWriter& writer);

}  // namespace airsim360

#include "airsim360/rpc/wire/message.h"

#include <limits>

#include "airsim360/base/printable.h"

namespace airsim360 {
namespace {

constexpr int kRequest = 0, kAnswer = 1, kNotification = 2;
using Kind = WireValue::Kind;

}  // namespace

RpcMessage ParseMessage(const WireValue& value) {
  if (value.kind != Kind::kArray || value.items.empty() || value.items[0].kind != Kind::kInt) {
    throw WireError("not an array that starts with a message type");
  }
  const int64_t type = value.items[0].integer;
  const size_t parts = type == kRequest ? 4 : 3;
  if ((type != kRequest && type != kNotification) || value.items.size() != parts) {
    throw WireError("neither a request nor a notification");
  }
  RpcMessage message;
  if (type == kRequest) {
    const WireValue& id = value.items[1];
    if (id.kind != Kind::kInt || id.integer < 0 || id.integer > std::numeric_limits<uint32_t>::max()) {
      throw WireError("message id out of range");
    }
    message.id = static_cast<uint32_t>(id.integer);
  }
  const WireValue &method = value.items[parts - 2], &arguments = value.items[parts - 1];
  if (method.kind != Kind::kString) throw WireError("method name is no string");
  if (arguments.kind != Kind::kArray) throw WireError("arguments are no array");
  message.method = method.text;
  message.arguments = &arguments;
  return message;
}

std::string ErrorAnswer(uint32_t id, std::string_view error) {
  WireWriter writer;
  writer.ArrayHeader(4);
  writer.Int(kAnswer);
  writer.Uint(id);
  writer.String(ValidUtf8(error));
  writer.Nil();
  return std::move(writer.bytes());
}

void BeginAnswer(uint32_t id, WireWriter& writer) {
  writer.ArrayHeader(4);
  writer.Int(kAnswer);
  writer.Uint(id);
  writer.Nil();
}

}  // namespace airsim360

#include "airsim360/rpc/wire/method_table.h"

#include <stdexcept>

namespace airsim360 {

void MethodTable::Add(std::string name, size_t most, size_t optional, Handler handler) {
  methods_.emplace(std::move(name), Method{most, optional, std::move(handler)});
}

void MethodTable::Call(const RpcMessage& message, const Reply& reply) const {
  const size_t given = message.arguments->items.size();
  const auto found = methods_.find(message.method);
  if (found == methods_.end()) {
    return reply.Error("rpclib: server could not find function '" + std::string(message.method) + "' with argument count " +
                       std::to_string(given) + ".");
  }
  const Method& method = found->second;
  if (given > method.most || given + method.optional < method.most) {
    return reply.Error("rpclib: Function '" + found->first + "' was called with an invalid number of arguments. " +
                       "Expected: " + std::to_string(method.most) + ", got: " + std::to_string(given));
  }
  try {
    method.handler(message.arguments->items, reply);
  } catch (const std::exception& error) {
    reply.Exception(error.what());
  }
}

std::vector<std::string> MethodTable::Names() const {
  std::vector<std::string> names;
  for (const auto& [name, method] : methods_) names.push_back(name);
  return names;
}

}  // namespace airsim360

#include "airsim360/rpc/api/api.h"

namespace airsim360 {

std::function<void()> Api::WithNothing(const Reply& reply) {
  return [reply] { reply.Nil(); };
}

std::function<void()> Api::WithError(const Reply& reply, const char* what) {
  return [reply, text = std::string(what)] { reply.Exception(text); };
}

}  // namespace airsim360

#include "airsim360/dataset/plan/find_plan.h"

#include <algorithm>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/dataset/plan/frame_source.h"
#include "airsim360/opening/world_exists.h"

namespace airsim360 {
namespace {

constexpr size_t kLeastDigits = 6, kDigits = 64;

// "NAME@HASH" in two. An '@' with something else behind it belongs to the name of a file.
std::pair<std::string, std::string> NameAndHash(const std::string& text) {
  const size_t at = text.rfind('@');
  if (at == std::string::npos || text.find('/', at) != std::string::npos || std::filesystem::exists(text)) return {text, ""};
  const std::string hash = text.substr(at + 1);
  const bool digits = hash.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!digits || hash.size() < kLeastDigits || hash.size() > kDigits) {
    throw InputError("plan: '" + text + "': '" + hash + "' is not the hash of a plan, 64 digits 0-9 and a-f, or its first " +
                     std::to_string(kLeastDigits) + " or more");
  }
  return {text.substr(0, at), hash};
}

DatasetPlan PlanOf(const std::string& name, const PlanRequest& request, const DeviceChoice& device) {
  if (IsPlanFile(name)) {
    if (!request.worlds.empty() || request.frames != 0)
      throw InputError("--world, --frames: '" + name + "' is a plan already; give them with its recipe");
    return ReadPlan(name);
  }
  Recipe recipe = FindRecipe(name);
  if (!request.worlds.empty()) recipe = WithWorlds(std::move(recipe), request.worlds);
  if (request.frames != 0) recipe = Scaled(std::move(recipe), request.frames);
  return MakePlan(recipe, request.seed, WorldExists, WorldOpener(device));
}

}  // namespace

DatasetPlan FindPlan(const PlanRequest& request, const DeviceChoice& device) {
  const auto [name, hash] = NameAndHash(request.name);
  DatasetPlan plan = PlanOf(name, request, device);
  if (!plan.hash.starts_with(hash)) {
    throw InputError("plan: '" + request.name + "': the hash of " + name + " is " + plan.hash +
                     " here; the seed, the number of frames, the worlds, the program or its models are others than those of then");
  }
  return plan;
}

}  // namespace airsim360

#include "airsim360/vln/agents/shared_renderers.h"

namespace airsim360 {

std::unique_ptr<Renderer> SharedRenderers::Make(const std::string& weather, Tier tier) {
  const std::lock_guard lock(making_);
  return weather.empty() ? stage_->NewRenderer(tier) : stage_->NewRenderer(tier, ApplyFlags({.weather = weather}, stage_->environment()));
}

void SharedRenderers::Render(const std::string& weather, const RenderRequest& request, Frame& frame) {
  const std::string sky = request.tier == Tier::kLabels ? "" : weather;
  std::unique_lock lock(mutex_);
  Kind& kind = kinds_[{request.tier, sky}];
  returned_.wait(lock, [&] { return !kind.idle.empty() || kind.made < kAtATime; });
  std::unique_ptr<Renderer> renderer;
  if (!kind.idle.empty()) {
    renderer = std::move(kind.idle.back());
    kind.idle.pop_back();
  } else {
    ++kind.made;
  }
  lock.unlock();
  // A renderer that cannot be made, or fails, makes room for another one.
  try {
    if (!renderer) renderer = Make(sky, request.tier);
    renderer->Render(request, frame);
  } catch (...) {
    lock.lock();
    --kind.made;
    returned_.notify_all();
    throw;
  }
  lock.lock();
  kind.idle.push_back(std::move(renderer));
  returned_.notify_all();
}

}  // namespace airsim360

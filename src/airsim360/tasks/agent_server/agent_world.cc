#include "airsim360/tasks/agent_server/agent_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/routes/roadmap.h"
#include "airsim360/tasks/agent_server/agent_action.h"

namespace airsim360 {
namespace {

constexpr int kGridWidth = 256;     // columns of the panorama behind a range grid
constexpr int kSamplesPerCell = 4;  // at least, along each side of a sector

RigidTransform LevelCamera(const RigidTransform& X_WB) { return BodyPose(X_WB.p, HeadingOfBody(X_WB), 0, 0) * CameraInBody(); }

}  // namespace

AgentWorld::AgentWorld(std::shared_ptr<Stage> stage, const RenderSettings& picture) : stage_(std::move(stage)), picture_(picture) {}

const std::vector<Vec3d>& AgentWorld::places() {
  const std::lock_guard lock(places_mutex_);
  if (!places_.empty()) return places_;
  // Narrow scenes: less room will do.
  for (const double radius : {1.0, 0.5, 0.25}) {
    places_ = FindFreePlaces(*stage_->solid(), {.radius = radius});
    if (!places_.empty()) return places_;
  }
  throw InputError("world '" + name() + "' has no free place for a drone");
}

void AgentWorld::Render(RenderRequest request, std::shared_ptr<const SceneState> moved) {
  request.state = std::move(moved);
  stage_->renderer(request.tier).Render(request, frame_);
}

Image<Rgb8> AgentWorld::Panorama(const RigidTransform& X_WB, int width, PanoFrame frame, std::shared_ptr<const SceneState> moved) {
  RenderRequest request{picture_, Equirectangular{width, width / 2}};
  request.X_WC = frame == PanoFrame::kLevel ? LevelCamera(X_WB) : X_WB * CameraInBody();
  request.products = {.rgb = true, .range = false, .semantic = false, .entity = false};
  const std::lock_guard lock(mutex_);
  Render(request, std::move(moved));
  return frame_.rgb;
}

Frame AgentWorld::Watched(const RigidTransform& X_WB, int width, std::shared_ptr<const SceneState> moved) {
  RenderRequest request{picture_, Equirectangular{width, width / 2}, LevelCamera(X_WB)};
  request.products = {.rgb = true, .range = true, .semantic = false, .entity = true};
  const std::lock_guard lock(mutex_);
  Render(request, std::move(moved));
  return std::exchange(frame_, {});  // one that was moved from is of no use
}

Image<Rgb8> AgentWorld::View(const RigidTransform& X_WB, double azimuth, double elevation, double fov, int width, int height,
                             std::shared_ptr<const SceneState> moved) {
  const double focal = width / (2 * std::tan(fov / 2));
  RenderRequest request{picture_, Pinhole{width, height, focal, focal, width / 2.0, height / 2.0},
                        BodyPose(X_WB.p, HeadingOfBody(X_WB) - azimuth, elevation, 0) * CameraInBody()};
  request.products = {.rgb = true, .range = false, .semantic = false, .entity = false};
  const std::lock_guard lock(mutex_);
  Render(request, std::move(moved));
  return frame_.rgb;
}

RangeGrid AgentWorld::Grid(const RigidTransform& X_WB, int rows, int columns, std::shared_ptr<const SceneState> moved) {
  // As many rays as fit the sectors exactly.
  const int least = std::max({kGridWidth, kSamplesPerCell * columns, 2 * kSamplesPerCell * rows});
  const int width = (least + 1) / 2 * 2;
  RenderRequest request = MakeRequest(Equirectangular{width, width / 2}, LevelCamera(X_WB), Tier::kLabels);
  request.products = {.rgb = false, .range = true, .semantic = false, .entity = false};
  RangeGrid grid{rows, columns, std::vector<float>(static_cast<size_t>(rows) * static_cast<size_t>(columns))};
  const std::lock_guard lock(mutex_);
  Render(request, std::move(moved));
  for (int y = 0; y < width / 2; ++y) {
    const int row = y * rows / (width / 2);
    for (int x = 0; x < width; ++x) {
      const float range = frame_.range(x, y);
      float& nearest = grid.range[static_cast<size_t>(row) * static_cast<size_t>(columns) + static_cast<size_t>(x * columns / width)];
      if (range > 0 && (nearest == 0 || range < nearest)) nearest = range;
    }
  }
  return grid;
}

}  // namespace airsim360

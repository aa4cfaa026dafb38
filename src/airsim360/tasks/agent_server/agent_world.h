// A world as episodes share it: built once, looked at by many.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "airsim360/sensors/rig.h"
#include "airsim360/stage/stage.h"

namespace airsim360 {

/// Nearest surface by direction, of the level frame: row 0 looks highest, column 0 straight behind and then
/// on to the right, as the columns of the level panorama.
struct RangeGrid {
  int rows = 8, columns = 16;
  std::vector<float> range;  ///< metres, row by row; 0 = nothing but sky in this sector
};

/// Thread-safe; pictures are taken one after the other.
class AgentWorld {
 public:
  /// `picture`: how the pictures are made.
  explicit AgentWorld(std::shared_ptr<Stage> stage, const RenderSettings& picture = {});

  Stage& stage() { return *stage_; }
  const std::string& name() const { return stage_->name(); }
  const Scene& scene() const { return stage_->scene(); }
  /// Free places at which an episode can start or end (FindFreePlaces); at least one, or InputError at first
  /// use.
  const std::vector<Vec3d>& places();

  // `moved`: where people are; null: nobody.

  /// The panorama from a pose, levelled (up is world up) and turned by the heading, or as the body is turned.
  Image<Rgb8> Panorama(const RigidTransform& X_WB, int width, PanoFrame frame = PanoFrame::kLevel,
                       std::shared_ptr<const SceneState> moved = nullptr);
  /// An ordinary picture to a direction of the level frame: azimuth to the right, elevation up, field of view
  /// across the width, all in radians; 0 < fov < pi.
  Image<Rgb8> View(const RigidTransform& X_WB, double azimuth, double elevation, double fov, int width, int height,
                   std::shared_ptr<const SceneState> moved = nullptr);
  /// The level panorama with what a person who looks on may ask of it: colours, range and entities.
  Frame Watched(const RigidTransform& X_WB, int width, std::shared_ptr<const SceneState> moved = nullptr);
  /// Looked at in a panorama of 256 x 128 rays or more; every sector holds several.
  RangeGrid Grid(const RigidTransform& X_WB, int rows, int columns, std::shared_ptr<const SceneState> moved = nullptr);

 private:
  void Render(RenderRequest request, std::shared_ptr<const SceneState> moved);

  std::shared_ptr<Stage> stage_;
  RenderSettings picture_;
  std::mutex places_mutex_;
  std::vector<Vec3d> places_;
  std::mutex mutex_;  // of what follows
  Frame frame_;
};

}  // namespace airsim360

// A world as episodes share it: built once, looked at by many.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "airsim360/render/renderer.h"
#include "airsim360/sensors/rig.h"
#include "airsim360/trace/ray_tracer.h"

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
  /// `tier` of the pictures.
  AgentWorld(std::string name, std::shared_ptr<const Scene> scene, Tier tier, const Environment& environment);
  AgentWorld(std::string name, std::shared_ptr<const Scene> scene, Tier tier = Tier::kFast);

  const std::string& name() const { return name_; }
  const Scene& scene() const { return tracer_->scene(); }
  const std::shared_ptr<const RayTracer>& tracer() const { return tracer_; }
  /// Free places at which an episode can start or end (FindFreePlaces); at least one, or InputError at first
  /// use.
  const std::vector<Vec3d>& places();

  /// The panorama from a pose, levelled (up is world up) and turned by the heading, or as the body is turned.
  Image<Rgb8> Panorama(const RigidTransform& X_WB, int width, PanoFrame frame = PanoFrame::kLevel);
  /// An ordinary picture to a direction of the level frame: azimuth to the right, elevation up, field of view
  /// across the width, all in radians; 0 < fov < pi.
  Image<Rgb8> View(const RigidTransform& X_WB, double azimuth, double elevation, double fov, int width,
                   int height);
  /// Looked at in a panorama of 256 x 128 rays or more; every sector holds several.
  RangeGrid Grid(const RigidTransform& X_WB, int rows, int columns);

 private:
  void Render(const RenderRequest& request);

  std::string name_;
  std::shared_ptr<const RayTracer> tracer_;
  Tier tier_;
  std::mutex places_mutex_;
  std::vector<Vec3d> places_;
  std::mutex mutex_;  // of what follows
  std::unique_ptr<Renderer> renderer_;
  Frame frame_;
};

}  // namespace airsim360

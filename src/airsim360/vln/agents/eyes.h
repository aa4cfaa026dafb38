// What an agent sees: everything around it, or what a camera in front of it shows.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "airsim360/vln/agents/shared_renderers.h"
#include "airsim360/vln/episodes/language_episode.h"

namespace airsim360 {

enum class VlnView {
  kErp,    ///< a level panorama
  kFront,  ///< a camera of 90 degrees to the front
  kCube6,  ///< six of them
};
inline constexpr const char* kViewNames[] = {"erp", "front", "cube6"};

/// A picture as a model is given it.
struct VlnPicture {
  std::string name;  ///< "erp", "front", "left", …
  int width = 0, height = 0;
  std::string jpeg;  ///< bytes
};

/// Of one worker; renderers are those of all.
class Eyes {
 public:
  /// `picture`: of Pictures. `width` of a panorama, pixels; a camera's picture is half as wide and as high.
  Eyes(std::shared_ptr<SharedRenderers> renderers, VlnView view, const RenderSettings& picture, int width);
  ~Eyes();

  VlnView view() const { return view_; }
  /// What is seen of entities (ascending) from a pose: a perfect recogniser with this view.
  SeenAtStart Recognise(const RigidTransform& X_WB, const std::vector<EntityId>& entities, const std::shared_ptr<const SceneState>& moved);
  /// Under `weather` ("" = the world's own). Panoramas carry a mark every 30 degrees of azimuth.
  std::vector<VlnPicture> Pictures(const RigidTransform& X_WB, const std::string& weather, const std::shared_ptr<const SceneState>& moved);

 private:
  struct Shot;
  std::vector<Shot> Shots(const RigidTransform& X_WB, int width) const;

  std::shared_ptr<SharedRenderers> renderers_;
  VlnView view_;
  RenderSettings picture_;
  int width_;
  Frame frame_;
};

}  // namespace airsim360

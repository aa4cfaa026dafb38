// The things of a world as words name them. Boxes stand for things: what is decided with them is decided with bounds
// that hold for the true surfaces.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/planning/clearance.h"
#include "airsim360/scene/scene.h"

namespace airsim360 {

/// What a noun of an instruction stands for. An entity matches if its category is one of `categories` or below one, its
/// name is one of `names` (a number at its end does not count; "bike lane*" is any name that begins so), and none of
/// `without`. An empty list asks for nothing.
struct Noun {
  std::string word = {};  ///< for people: "traffic light"
  std::vector<std::string> categories = {}, names = {}, without = {};
  bool whole = false;  ///< all that match are one thing: the windows of a storey, the lanes of a street
};

struct Thing {
  std::string name;
  std::vector<EntityId> entities;  ///< ascending
  Box3d box;                       ///< metres in W

  Vec3d center() const { return (box.min + box.max) * 0.5; }
  Vec3d size() const { return box.max - box.min; }
};

/// Whether `name` is `pattern`, numbered repeats ("lake 2") included, or begins with it where it ends with '*'.
bool NameMatches(std::string_view name, std::string_view pattern);
/// Whether an entity is what a noun stands for. People and the sky never are.
bool Matches(const Scene& scene, const Entity& entity, const Noun& noun);

/// The things of one scene by noun. Remembers what it has found; one thread at a time.
class SceneGraph {
 public:
  explicit SceneGraph(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {}
  const Scene& scene() const { return *scene_; }
  const std::shared_ptr<const Scene>& shared_scene() const { return scene_; }
  /// In order of their entities; empty if nothing matches. Valid as long as this. O(entities) the first time.
  const std::vector<Thing>& Find(const Noun& noun);

 private:
  std::shared_ptr<const Scene> scene_;
  std::map<std::string, std::vector<Thing>> found_;
};

/// Metres seen from above between a point and the surfaces of whatever fills a box: every face of a box touches its
/// thing, so that the distance lies between both.
struct DistanceBounds {
  double least = 0, most = 0;
};
DistanceBounds PlanDistance(Vec3d p_W, const Box3d& box);

}  // namespace airsim360

// The second method: the same questions answered from the triangles themselves, without boxes or shortcuts, and with one
// margin only: what is hardly farther than the nearest competes (NearestMargin). It shares no geometry with decide.cc, so that an
// error of one shows.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "airsim360/vln/predicates/entity_parts.h"
#include "airsim360/vln/predicates/query.h"

namespace airsim360 {

/// Whether a noun names an entity, by text alone.
bool BruteForceNames(const Scene& scene, const Entity& entity, const Noun& noun);

/// Looks at every triangle of whatever the nouns name. Keeps what it has measured; one thread at a time.
class BruteForce {
 public:
  explicit BruteForce(std::shared_ptr<const Scene> scene);
  ~BruteForce();

  /// Entities of all things that answer the query, each list ascending; more than one list: ambiguous.
  std::vector<std::vector<EntityId>> Answers(const Query& query, const Standpoint& standpoint);

  /// Metres seen from above from a place to what the entities are made of.
  double Distance(const std::vector<EntityId>& entities, Vec3d p_W);
  /// Metres by which a place is above all of them, or below; 0 between.
  double HeightApart(const std::vector<EntityId>& entities, Vec3d p_W);
  /// Whether the straight line between two places passes within a metre of them, seen from above.
  bool Passes(const std::vector<EntityId>& entities, Vec3d from_W, Vec3d to_W);

 private:
  struct Shape;
  const Shape& ShapeOf(const std::vector<EntityId>& entities);
  std::vector<const Shape*> All(const Noun& noun);
  std::vector<const Shape*> AllWithRivals(const Query& query);
  std::vector<std::vector<EntityId>> AnswersOf(const Query& query, const Standpoint& standpoint);
  bool Holds(const Predicate& predicate, const Noun& noun, const Shape& shape, const Viewpoint& view);
  bool IsTall(const Shape& shape, const Noun& noun, const Predicate& predicate);
  bool StandsOn(const Shape& shape, const Noun& of);
  bool IsInOneStorey(const Shape& shape, const Noun& of);
  bool IsSurrounded(const Shape& shape, const Predicate& predicate);

  std::shared_ptr<const Scene> scene_;
  std::vector<std::vector<internal::EntityPart>> parts_;  ///< by entity
  std::map<std::vector<EntityId>, std::unique_ptr<Shape>> shapes_;
  std::map<std::string, bool> surrounded_;
};

}  // namespace airsim360

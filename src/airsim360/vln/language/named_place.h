// The things of a place that can be spoken of: which words name them, where they are, how far.
// For the .cc files of this folder.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "airsim360/vln/language/lookout.h"
#include "airsim360/vln/predicates/query_json.h"

namespace airsim360::internal {

inline constexpr size_t kFlight = 1000;  ///< as a picture: the panorama after a flight

/// A name that means one thing of a picture: "the bus", "the bus on your left".
struct Name {
  std::string text;
  uint16_t word = 0;
  std::string where;  ///< "only", "nearest", or a sector
  const Seen* thing = nullptr;
};

/// A place with the names of what is seen there.
class NamedPlace {
 public:
  NamedPlace(const Scene& scene, const Lexicon& lexicon, const Lookout& lookout);

  const Scene& scene() const { return scene_; }
  const Lexicon& lexicon() const { return lexicon_; }
  const Lookout& lookout() const { return lookout_; }
  /// Panorama and cameras, without the panorama after a flight.
  size_t pictures() const { return lookout_.glances.size(); }
  const Glance& glance(size_t picture) const { return picture == kFlight ? *lookout_.later : lookout_.glances[picture]; }
  /// By word; kFlight may be asked for where there is a flight.
  const std::vector<Sighted>& groups(size_t picture) const { return said_.at(std::min(picture, pictures())).groups; }
  /// Names of things of a picture that are sure, in a fixed order.
  const std::vector<Name>& names(size_t picture) const { return said_.at(std::min(picture, pictures())).names; }
  Box3d BoxOf(EntityId entity) const;
  /// Metres between the eye and the thing: what is seen of it is no farther away than `most`, no part is nearer than `least`.
  DistanceBounds Range(const Seen& seen, const Picture& from) const;
  /// Metres between the surfaces of two things.
  DistanceBounds Apart(EntityId a, EntityId b) const;
  /// "front", "right", "behind", "left"; "" where that is no clear case.
  static std::string SectorOf(const Seen& seen);
  /// The one of a word that is surely nearer than all others, doubtful ones too; nullptr: there is none.
  const Seen* NearestOf(const Sighted& sighted, const Picture& from) const;
  /// What a thing of a panorama is called once the heading has turned to the left by so many quarters.
  Name Turned(const Name& name, int quarters) const;

 private:
  struct Said {
    std::vector<Sighted> groups;
    std::vector<Name> names;
  };
  void AddNames(Said& said, bool panorama);
  void AddNearest(Said& said, const Picture& from);
  const Scene& scene_;
  const Lexicon& lexicon_;
  const Lookout& lookout_;
  std::vector<Said> said_;  // of the pictures, and of the panorama after a flight
};

/// {"word": "bus", "where": "only"}.
VlnJson ToJson(const Name& name, const Lexicon& lexicon);
/// What a proof says of a thing: entity, name, pixels, azimuth, range.
VlnJson Figures(const Seen& seen, const Scene& scene);

}  // namespace airsim360::internal

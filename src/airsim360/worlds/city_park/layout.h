// The plan of the park as functions of the plane: roads, paths, lake, heights and the colours of the ground.
// X east, Y north, metres; the spawn stands over the bend of the road at (0, 0).
#pragma once

#include <span>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360::internal::park {

/// Half width of a carriageway, and what lies beside it, measured outwards from the kerb's face.
inline constexpr float kMainHalf = 7.0f, kSideHalf = 4.5f;
inline constexpr float kKerbTop = 0.20f, kBedEnd = 1.75f, kEdgingEnd = 1.90f, kPavementEnd = 3.80f, kVergeEnd = 3.90f;
inline constexpr float kPathHalf = 1.25f;
/// The park that can be walked and flown is the disc of this radius around the spawn.
inline constexpr float kParkRadius = 520;
/// Water level, and the radii of the lake's ellipse.
inline constexpr Vec2f kLakeCenter{-42, 84};
inline constexpr float kLakeZ = -2.2f, kLakeRx = 46, kLakeRy = 30;

/// A smooth line through control points (Catmull-Rom), sampled every metre or so.
class Curve {
 public:
  Curve(std::span<const Vec2f> control, float step);
  explicit Curve(std::vector<Vec2f> points);

  struct Nearest {
    float distance;  ///< to the line
    float s;         ///< along it, metres from its start
    float side;      ///< signed distance, left of the direction of travel positive
  };
  Nearest Find(Vec2f p) const;
  /// Only the distance; may be any value above `limit` where it is larger than that.
  float Distance(Vec2f p, float limit = 1e9f) const;
  /// The point at `s` along and `side` to the left.
  Vec2f At(float s, float side = 0) const;
  /// Unit vector of travel.
  Vec2f Along(float s) const;
  float length() const { return s_.back(); }
  const std::vector<Vec2f>& points() const { return points_; }

 private:
  struct Chunk {
    Vec2f center;
    float radius;
    size_t first, last;
  };
  void Index();
  /// No less than the distance to p, by the circle whose middle is nearest: what lies farther off need not be looked at.
  float Within(Vec2f p) const;
  size_t Segment(float s) const;
  std::vector<Vec2f> points_;
  std::vector<float> s_;
  std::vector<Chunk> chunks_;
  Vec2f low_, high_;  // of all points
};

/// Where a side road meets the main road: main road's arc length, and on which side it leaves.
struct Junction {
  float s;
  bool left;
};

class Layout {
 public:
  Layout();

  const Curve& main() const { return main_; }
  const std::vector<Curve>& side_roads() const { return sides_; }
  const std::vector<Junction>& junctions() const { return junctions_; }
  const std::vector<Curve>& paths() const { return paths_; }

  /// Distance beyond the outer edge of the nearest road's pavement; negative on roads and pavements. From 40
  /// m on any value of at least 40 and at most the distance.
  float BeyondRoad(Vec2f p) const;
  /// Distance to the middle of the nearest path.
  float PathDistance(Vec2f p, float limit = 1e9f) const;
  /// 1 on the shore line, less on the water, growing outwards (roughly, from 2.2 on).
  float Lake(Vec2f p) const;
  /// 1 in the middle of the island, 0 off it.
  float Island(Vec2f p) const;

  /// Height of the carriageways' edges: the ground without hills.
  float Base(Vec2f p) const;
  /// Height of the ground.
  float Ground(Vec2f p) const { return Ground(p, BeyondRoad(p)); }
  float Ground(Vec2f p, float beyond_road) const;
  Vec3f Normal(Vec2f p) const;
  /// How far the ground lies lower under the gravel of paths.
  float PathBed(Vec2f p) const;

  /// How wooded a place is, 0 lawn … 1 forest.
  float Forest(Vec2f p) const;
  /// Share of clover and of dry grass.
  float Clover(Vec2f p) const;
  float Dry(Vec2f p) const;
  /// Albedo of the lawn as seen from above, without (coarse) and with its variation below a metre.
  Vec3f LawnCoarse(Vec2f p) const;
  Vec3f Lawn(Vec2f p) const;
  /// Albedo of the bare ground: between blades, under trees, on the bank.
  Vec3f Soil(Vec2f p, float fine_detail) const;

 private:
  // Distances at the middles of cells, so that most points need no exact search.
  struct FarField {
    static constexpr int kHalf = 128;      // cells
    static constexpr float kCell = 8;      // metres
    static constexpr float kReach = 5.7f;  // a point to the middle of its cell
    std::vector<float> value;
    /// At most the distance at p; 0 outside.
    float LowerBound(Vec2f p) const;
  };
  void Survey();
  float ExactBeyondRoad(Vec2f p) const;
  float ExactPathDistance(Vec2f p, float limit) const;
  float Hills(Vec2f p) const;
  Curve main_;
  std::vector<Curve> sides_, paths_;
  std::vector<Junction> junctions_;
  FarField roads_far_, paths_far_;
};

}  // namespace airsim360::internal::park

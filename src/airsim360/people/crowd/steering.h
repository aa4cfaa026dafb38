// How people move among each other: avoidance with a speed that falls with the density around them, at a fixed
// step. Positions change here and nowhere else.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "airsim360/people/crowd/vehicle_dodging.h"
#include "airsim360/people/navigation/navmesh.h"

namespace airsim360::internal {

/// Discs never overlap by more than rounding once they do not at the start.
inline constexpr double kBodyRadius = 0.2;
/// What people keep around themselves where there is room; walls are NavMeshOptions::person_radius away.
inline constexpr double kSpaceRadius = 0.24;

struct Walker {
  NavPoint at;
  Vec2d v;       ///< m/s over the ground
  Vec2d wanted;  ///< velocity they would like
  double free_speed = 1.34;
  double pressed = 0;   ///< 0 … 1: how much they want through, after standing for a while; they squeeze past others
  double rest = 0;      ///< metres to where they go: who is nearer goes first at doors; 0 = unknown
  double blocked = 0;   ///< seconds that they have stood though they want on
  double waited = 0;    ///< seconds for vehicles, since they last walked for long
  bool waits = false;   ///< for a vehicle to pass
  Vec2d aside;          ///< of the body from `at`, metres: seats are beside the mesh
  bool present = true;  ///< in the world
  bool still = false;   ///< stands or sits and makes no way for others
};

/// Something low that people walk around.
struct SteeringObstacle {
  Vec2d p, v;
  double z = 0, radius = 0.3;
};

/// Speed over density of U. Weidmann, "Transporttechnik der Fussgaenger", 1993, for a free speed of 1.34 m/s;
/// people per square metre.
double WeidmannSpeed(double density);

/// Scratch memory of the steps; holds no state between them.
class Steering {
 public:
  Steering();
  ~Steering();
  Steering(const Steering&);             ///< a new one
  Steering& operator=(const Steering&);  ///< changes nothing
  /// Sorts those who are present by place: first part of a step, and what Near looks at.
  void Sort(std::span<const Walker> walkers);
  /// Calls visit(number, p, z) for all who may be within `range` of p, in a fixed order.
  template <class Visit>
  void Near(Vec2d p, double range, const Visit& visit) const {
    const auto index = [&](double v, double low, int n) {
      const double k = (v - low) / cell_;
      return k < 0 ? 0 : k >= n ? n - 1 : static_cast<int>(k);
    };
    if (seen_.empty()) return;
    const int c0 = index(p.x - range, min_.x, columns_), c1 = index(p.x + range, min_.x, columns_);
    const int r0 = index(p.y - range, min_.y, rows_), r1 = index(p.y + range, min_.y, rows_);
    for (int r = r0; r <= r1; ++r) {
      const size_t base = static_cast<size_t>(r) * static_cast<size_t>(columns_);
      for (uint32_t i = first_[base + static_cast<size_t>(c0)]; i < first_[base + static_cast<size_t>(c1) + 1]; ++i)
        visit(seen_[i].index, seen_[i].p, seen_[i].z);
    }
  }
  /// Advances all by dt seconds from the places that Sort saw. Does not depend on the number of threads.
  void Step(const NavMesh& mesh, std::span<Walker> walkers, std::span<const SteeringObstacle> obstacles, double dt,
            const Vehicles& vehicles = Vehicles({}));

 private:
  struct Seen {
    Vec2d p, v;
    Vec2d forward;  // unit vector to where they want to go; zero: nowhere
    double z, rest, blocked;
    uint32_t index;
    bool still;
  };
  struct Plan;
  struct Company;
  struct Limits;
  /// Who is near number k of seen_; notes in the plan whom the next step may touch.
  Company LookAround(uint32_t k, bool only_close, Plan& plan) const;
  static bool YieldsTo(const Seen& self, const Seen& other, double d2);
  void Choose(const NavMesh& mesh, std::span<const Walker> walkers, std::span<const SteeringObstacle> obstacles, const Vehicles& vehicles,
              uint32_t self, double dt);
  void Advance(const NavMesh& mesh, std::span<Walker> walkers, uint32_t self, double dt);

  Vec2d min_;
  double cell_ = 1.5;
  int columns_ = 1, rows_ = 1;
  std::vector<uint32_t> cell_of_, first_;
  std::vector<Seen> seen_;  // people by cell, then number
  std::vector<Plan> plans_;
};

}  // namespace airsim360::internal

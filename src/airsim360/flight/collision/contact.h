// What happens when a drone touches the world: landing, sliding, bumping, crashing. Surfaces are asked for
// through ContactQuery, which whoever has a scene implements.
#pragma once

#include <cstdint>
#include <optional>

#include "airsim360/flight/drone_model.h"
#include "airsim360/flight/drone_state.h"

namespace airsim360 {

/// A place on a surface.
struct SurfacePoint {
  Vec3d p_W;
  Vec3d normal_W;       ///< unit, on the side that was asked from
  uint32_t entity = 0;  ///< passed through to the report
};

/// Surfaces of the world as they are during one step. Called from many threads.
class ContactQuery {
 public:
  virtual ~ContactQuery() = default;

  /// The first surface on the segment, of either side of a triangle; nothing if it is free.
  virtual std::optional<SurfacePoint> FirstHit(Vec3d from_W, Vec3d to_W) const = 0;

  /// The surface point nearest to p_W within `range` metres (its normal is not used); nothing if there is
  /// none.
  virtual std::optional<SurfacePoint> Nearest(Vec3d p_W, double range) const = 0;
};

/// How a drone touches. The defaults are a plastic frame on hard ground.
struct ContactProperties {
  double restitution = 0.3;  ///< speed after / speed before, along the normal
  double friction = 0.6;     ///< Coulomb
  double crash_speed = 3;    ///< m/s along the normal; an impact above it counts as a crash
};

/// Outlives the step: part of the simulation's state. Plain data. Start anew when the drone is put elsewhere.
struct ContactState {
  double free_distance = 0;  ///< metres that the drone may still move before surfaces must be asked for again
  bool crashed = false;      ///< latched by an impact above crash_speed
};

/// What one step's contacts were.
struct ContactReport {
  bool touching = false;
  bool crashed = false;     ///< in this step
  double impact_speed = 0;  ///< m/s along the normal, of the hardest contact; 0 when not touching
  double penetration = 0;   ///< metres that had to be put right at that contact
  SurfacePoint point;       ///< that contact
};

/// Takes a step from `before` to `after` (of `dt` seconds, worked out without contacts) and changes `after`
/// so that the drone's box is not inside a surface and does not move into one: impulses with restitution and
/// friction at the box's points that reach into a surface. The centre never passes a surface, however fast.
/// Kinetic and potential energy together are never raised. `surface_speed`: how fast surfaces themselves may
/// move, m/s; it only decides how soon they are asked for again.
ContactReport ResolveContacts(const DroneModel& model, const ContactProperties& properties, const ContactQuery& query,
                              const DroneState& before, double dt, double surface_speed, DroneState& after, ContactState& contact);

}  // namespace airsim360

// Where a drone's box reaches into surfaces.
#pragma once

#include <vector>

#include "airsim360/flight/collision/contact.h"

namespace airsim360::internal {

/// One point of the drone that is in a surface.
struct Contact {
  Vec3d arm_W;   ///< from the centre of mass
  double depth;  ///< metres along the normal to where it is free
  SurfacePoint surface;
};

/// Half the thickness of the box along the unit vector n_W.
double BoxReach(const DroneModel& model, const Mat3d& R_WB, Vec3d n_W);

/// Contacts of the box at `state`: at its corners and the middles of its edges and faces, found by rays from
/// the centre, and at `nearest`, the surface point nearest to the centre, if it is inside the box (edges and
/// poles that pass between the rays). Appends to `contacts`.
void FindContacts(const DroneModel& model, const ContactQuery& query, const DroneState& state, const SurfacePoint& nearest,
                  std::vector<Contact>& contacts);

}  // namespace airsim360::internal

// Impulses and shifts that end contacts.
#pragma once

#include <span>

#include "airsim360/flight/collision/contact_points.h"

namespace airsim360::internal {

/// Changes the velocities of `state` so that no contact moves into its surface: sequential impulses (Catto,
/// "Iterative dynamics with temporal coherence", GDC 2005) with Coulomb's cone and Newton's restitution.
/// `acceleration_W` is that of the free step, whose gain in speed within the surface does not bounce.
/// Contacts slower than `rest_speed` do not bounce. Returns the highest speed into a surface, and its index.
struct Impact {
  double speed = 0;
  size_t contact = 0;
};
Impact ApplyImpulses(const DroneModel& model, const ContactProperties& properties, std::span<const Contact> contacts, Vec3d acceleration_W,
                     double rest_speed, DroneState& state);

/// Smallest shift, near enough, that takes every contact out of its surface.
Vec3d ShiftOut(std::span<const Contact> contacts);

/// Kinetic and potential energy, J.
double MechanicalEnergy(const DroneModel& model, const DroneState& state);

/// Slows `state` down, in proportion, and if that is not enough lowers it, so that its energy is `most` at
/// the highest.
void LimitEnergy(const DroneModel& model, double most, DroneState& state);

}  // namespace airsim360::internal

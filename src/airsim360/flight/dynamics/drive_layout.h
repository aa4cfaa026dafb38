// Which drone a copy of the equations is for: what is known at compile time of its rotors and terms.
#pragma once

#include "airsim360/flight/drone_constants.h"

namespace airsim360::internal {

/// kRotors: how many, 0 = known at run time only. kPlain: of DroneConstants::plain drones. The operations
/// that are done, and so the bits, are the same in every layout that fits.
template <int kRotors, bool kPlain>
struct DriveLayout {
  template <class T>
  static constexpr int Rotors(const DroneConstants<T>& c) {
    return kRotors > 0 ? kRotors : c.rotors;
  }
  /// `term` is one of the flags of the constants.
  static constexpr bool Has(bool term) { return !kPlain && term; }
};

using AnyLayout = DriveLayout<0, false>;
using QuadLayout = DriveLayout<4, false>;
using PlainQuadLayout = DriveLayout<4, true>;

}  // namespace airsim360::internal

// Measures of the bicycles of CycleKinds: what those who ride them need to know.
#pragma once

#include <array>
#include <cmath>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// Places in the mesh of a bicycle, metres: front towards -Y, +X to the left of who rides it, wheels on z = 0. The right pedal is the
/// mirror of the left one, half a turn of the cranks on.
struct BicycleMeasures {
  float wheel_radius = 0;  ///< to the outside of the tyre
  Vec3f front_hub, rear_hub;
  Vec3f bracket;          ///< axle of the cranks
  float crank = 0;        ///< from there to the axle of a pedal
  float built_crank = 0;  ///< radians that the cranks of the mesh have turned forwards; at 0 the left pedal is lowest
  float pedal_side = 0;   ///< of the middle of a pedal
  float pedal_half_height = 0;
  Vec3f saddle;  ///< where one sits on it
  Vec3f grip;    ///< the left one

  /// The middle of a pedal in the mesh.
  Vec3f Pedal(bool left) const {
    const float side = left ? 1.0f : -1.0f;
    return {side * pedal_side, bracket.y + side * crank * std::sin(built_crank), bracket.z - side * crank * std::cos(built_crank)};
  }
};

/// The procedural one, upright; and the ready-made one, whose bar is straight and far from its saddle.
inline constexpr std::array<BicycleMeasures, 2> kBicycleMeasures{{
    {0.345f,
     {0, -0.54f, 0.345f},
     {0, 0.52f, 0.345f},
     {0, 0.09f, 0.29f},
     0.17f,
     0,
     0.125f,
     0.012f,
     {0, 0.26f, 0.93f},
     {0.27f, -0.18f, 1.03f}},
    {0.3385f,
     {0, -0.5285f, 0.3385f},
     {0, 0.527f, 0.3385f},
     {0, 0.097f, 0.31f},
     0.1864f,
     -2.7188f,
     0.125f,
     0.013f,
     {0, 0.28f, 0.945f},
     {0.21f, -0.44f, 0.93f}},
}};

}  // namespace airsim360

// The town that crowds are timed in.
#pragma once

#include <memory>

#include "airsim360/people/navigation/test_ground.h"

namespace airsim360 {

/// A town like that of the reference: `edge` metres wide, blocks of 20 m with streets of pavement of 20 m between them.
inline std::shared_ptr<const Scene> Blocks(float edge) {
  constexpr float kPitch = 40;
  internal::TestGround ground("blocks");
  ground.Floor("ground/sidewalk", 0, 0, edge, edge);
  for (float x = kPitch / 4; x + kPitch / 2 < edge; x += kPitch)
    for (float y = kPitch / 4; y + kPitch / 2 < edge; y += kPitch)
      ground.Box("construction/building", {x, y, 0}, {x + kPitch / 2, y + kPitch / 2, 8});
  return ground.Build();
}

}  // namespace airsim360

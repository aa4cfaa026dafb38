// A person of sticks for tests: COCO's keypoints of an upright body that faces +X.
#pragma once

#include "airsim360/mpde/virtual_cameras.h"

namespace airsim360::internal {

inline PersonShape StickPerson(double stature, uint64_t person = 0) {
  const double h = stature;
  PersonShape shape;
  shape.keypoints = {{{0.06 * h, 0, 0.93 * h},
                      {0.05 * h, 0.02 * h, 0.94 * h},
                      {0.05 * h, -0.02 * h, 0.94 * h},
                      {0, 0.04 * h, 0.93 * h},
                      {0, -0.04 * h, 0.93 * h},
                      {0, 0.11 * h, 0.82 * h},
                      {0, -0.11 * h, 0.82 * h},
                      {0, 0.13 * h, 0.64 * h},
                      {0, -0.13 * h, 0.64 * h},
                      {0.03 * h, 0.13 * h, 0.49 * h},
                      {0.03 * h, -0.13 * h, 0.49 * h},
                      {0, 0.05 * h, 0.53 * h},
                      {0, -0.05 * h, 0.53 * h},
                      {0, 0.05 * h, 0.285 * h},
                      {0, -0.05 * h, 0.285 * h},
                      {-0.02 * h, 0.05 * h, 0.04 * h},
                      {-0.02 * h, -0.05 * h, 0.04 * h}}};
  shape.center = {0, 0, 0.5 * h};
  shape.person = person;
  return shape;
}

}  // namespace airsim360::internal

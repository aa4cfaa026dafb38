#include "airsim360/sensors/body_motion.h"

#include "airsim360/math/angles.h"

namespace airsim360 {

RigidTransform Mount::pose() const { return BodyPose(p_BS, yaw_deg * kDegree, pitch_deg * kDegree, roll_deg * kDegree); }

void Mount::Visit(ConfigVisitor& v) {
  constexpr double kFarthest = 100;  // metres: no drone is larger
  v.Field("x", "metres forward of the centre of mass", p_BS.x, -kFarthest, kFarthest);
  v.Field("y", "metres to the left", p_BS.y, -kFarthest, kFarthest);
  v.Field("z", "metres up", p_BS.z, -kFarthest, kFarthest);
  v.Field("yaw_deg", "turn to the left", yaw_deg, -360, 360);
  v.Field("pitch_deg", "nose up", pitch_deg, -90, 90);
  v.Field("roll_deg", "right side down", roll_deg, -180, 180);
}

}  // namespace airsim360

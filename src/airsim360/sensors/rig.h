// The panoramic rig: one trigger, every product, one exact pose and time.
#pragma once

#include <cstdint>

#include "airsim360/render/renderer.h"
#include "airsim360/sensors/lens.h"

namespace airsim360 {

/// Whether the panorama turns with the body or only with its yaw (up is always world up).
enum class PanoFrame { kBody, kLevel };

/// Motion of a vehicle at one instant.
struct Kinematics {
  RigidTransform X_WB;
  Vec3d v_WB;    ///< velocity of B in W, expressed in W, m/s
  Vec3d w_WB_B;  ///< angular velocity of B in W, expressed in B, rad/s
};

struct PanoramicRig {
  Camera camera = Equirectangular{};
  RigidTransform X_BC = CameraInBody();
  PanoFrame pano_frame = PanoFrame::kBody;
  Tier tier = Tier::kFast;
  Products products;
  double exposure_ev = 0;
  ToneCurve tone = ToneCurve::kFilmic;
  bool auto_exposure = false;
  int samples = 0;      ///< as RenderRequest::samples
  bool denoise = true;  ///< as RenderRequest::denoise
  uint64_t seed = 0;    ///< of samples and noise
  /// kReal360: the colour picture of a panorama is that of two stitched fisheyes; everything else stays
  /// ideal.
  LensModel lens = LensModel::kIdeal;
  Real360 real360;
};

/// Everything one trigger gave.
struct Capture {
  int64_t t_ns = 0;
  RigidTransform X_WC;
  Kinematics body;
  PanoFrame pano_frame = PanoFrame::kBody;
  Frame frame;
  RenderStats stats;
};

/// Pose of the rig's camera for a body pose.
RigidTransform CameraPose(const PanoramicRig& rig, const RigidTransform& X_WB);

/// Takes one capture into `capture`, reusing its images.
void CaptureRig(const PanoramicRig& rig, const Kinematics& body, int64_t t_ns, Renderer& renderer,
                Capture& capture);

}  // namespace airsim360

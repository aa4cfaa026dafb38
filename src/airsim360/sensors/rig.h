// The panoramic rig: one trigger, every product, one exact pose and time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "airsim360/render/look/photo.h"
#include "airsim360/render/renderer.h"
#include "airsim360/sensors/gimbal.h"
#include "airsim360/sensors/lens.h"

namespace airsim360 {

/// Whether the panorama turns with the body or only with its yaw (up is always world up).
enum class PanoFrame { kBody, kLevel };
inline constexpr const char* kPanoFrameNames[] = {"body", "level"};

/// Motion of a vehicle at one instant.
struct Kinematics {
  RigidTransform X_WB;
  Vec3d v_WB;    ///< velocity of B in W, expressed in W, m/s
  Vec3d w_WB_B;  ///< angular velocity of B in W, expressed in B, rad/s
};

/// How the pictures of a camera on a body are made.
struct PictureSettings : RenderSettings {
  PanoFrame pano_frame = PanoFrame::kBody;
  /// kPhoto: the colour picture is what `camera_look` makes of the light; exposure_ev is on top of what it meters, tone
  /// and auto_exposure are not used. Everything else stays ideal.
  Look look = Look::kClean;
  CameraLook camera_look = {};
  /// kReal360: the colour picture of a panorama is that of two stitched fisheyes; everything else stays
  /// ideal.
  LensModel lens = LensModel::kIdeal;

  void Visit(ConfigVisitor& v);
};

/// CheckRenderSettings, and: a lens that does not make pictures of this camera, an exposure of its own for each face of
/// a cube.
void CheckPictureSettings(const PictureSettings& settings, const Camera& camera, std::string_view prefix = {});

struct PanoramicRig : PictureSettings {
  Camera camera = Equirectangular{};
  RigidTransform X_BC = CameraInBody();
  Products products = {};
  Real360 real360 = {};
  std::shared_ptr<const SceneState> state = nullptr;  ///< what has moved; nullptr = nothing
  std::optional<GimbalMount> gimbal = {};             ///< what the camera hangs on, X_BC being its pose there; not with kLevel
};

/// The next trigger of a rig, which optical flow leads to.
struct NextTrigger {
  RigidTransform X_WB;                      ///< the body then
  std::shared_ptr<const SceneState> state;  ///< what has moved by then; nullptr = as at the capture
};

/// Everything one trigger gave.
struct Capture {
  int64_t t_ns = 0;
  RigidTransform X_WC;
  Kinematics body;
  PanoFrame pano_frame = PanoFrame::kBody;
  Frame frame;
  RenderStats stats;
  std::optional<RigidTransform> X_WC_next;  ///< pose that the flow leads to, where flow was asked for
  std::optional<PhotoFigures> photo;        ///< of look photo
};

/// Pose of the rig's camera for a body pose.
RigidTransform CameraPose(const PanoramicRig& rig, const RigidTransform& X_WB);

/// Where a body is `dt` seconds later if neither velocity changes (v in W, w in B): p + v dt, R exp(w dt).
RigidTransform Extrapolate(const Kinematics& body, double dt);

/// Takes one capture into `capture`, reusing its images. `next` is needed for the product flow alone.
void CaptureRig(const PanoramicRig& rig, const Kinematics& body, int64_t t_ns, Renderer& renderer, Capture& capture,
                const NextTrigger* next = nullptr);

}  // namespace airsim360

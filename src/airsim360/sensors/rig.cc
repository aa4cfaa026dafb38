#include "airsim360/sensors/rig.h"

#include <cmath>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

// Heading of the body: that of its forward axis, or of its up axis where it points straight up or down.
double Heading(const Mat3d& R_WB) {
  const Vec3d forward = R_WB.column(0);
  if (std::hypot(forward.x, forward.y) > 1e-9) return std::atan2(forward.y, forward.x);
  const Vec3d up = R_WB.column(2) * (forward.z > 0 ? -1.0 : 1.0);
  return std::atan2(up.y, up.x);
}

}  // namespace

RigidTransform CameraPose(const PanoramicRig& rig, const RigidTransform& X_WB) {
  if (rig.pano_frame == PanoFrame::kBody) return X_WB * rig.X_BC;
  // The rig hangs in a gimbal: its place follows the body, its orientation only the body's heading.
  const RigidTransform level = BodyPose(X_WB * rig.X_BC.p, Heading(X_WB.R), 0, 0);
  return {level.R * rig.X_BC.R, level.p};
}

namespace {

// Replaces the colour picture by that of a real camera.
void CaptureLens(const PanoramicRig& rig, const RenderRequest& request, Renderer& renderer,
                 Capture& capture) {
  const auto* target = std::get_if<Equirectangular>(&rig.camera);
  if (target == nullptr) throw InputError("lens real360 makes equirectangular pictures only");
  const Kinematics& body = capture.body;
  const RenderStats stats = RenderReal360(
      rig.real360, request, [&](double t) { return CameraPose(rig, Extrapolate(body, t)); },
      Norm(body.v_WB) > 0 || Norm(body.w_WB_B) > 0, rig.auto_exposure ? capture.frame.exposure : 0,
      static_cast<uint64_t>(capture.t_ns), *target, renderer, capture.frame.rgb);
  capture.stats.rays += stats.rays;
  capture.stats.render_ms += stats.render_ms;
}

}  // namespace

RigidTransform Extrapolate(const Kinematics& body, double dt) {
  // The turn about the axis of w by |w| dt, as a quaternion.
  const double rate = Norm(body.w_WB_B), half = 0.5 * rate * dt;
  const Vec3d axis = rate > 0 ? body.w_WB_B * (std::sin(half) / rate) : Vec3d{};
  const Mat3d turn = ToMatrix({std::cos(half), axis.x, axis.y, axis.z});
  return {body.X_WB.R * turn, body.X_WB.p + body.v_WB * dt};
}

void CaptureRig(const PanoramicRig& rig, const Kinematics& body, int64_t t_ns, Renderer& renderer,
                Capture& capture, const NextTrigger* next) {
  capture.t_ns = t_ns;
  capture.X_WC = CameraPose(rig, body.X_WB);
  capture.body = body;
  capture.pano_frame = rig.pano_frame;
  capture.X_WC_next.reset();
  if (next != nullptr && rig.products.flow) capture.X_WC_next = CameraPose(rig, next->X_WB);
  RenderRequest request{.camera = rig.camera,
                        .X_WC = capture.X_WC,
                        .tier = rig.tier,
                        .products = rig.products,
                        .exposure_ev = rig.exposure_ev,
                        .aa_samples = rig.edge_samples,
                        .samples = rig.samples,
                        .denoise = rig.denoise,
                        .seed = rig.seed,
                        .tone = rig.tone,
                        .auto_exposure = rig.auto_exposure};
  request.state = rig.state;
  request.X_WC_next = capture.X_WC_next;
  if (next != nullptr) request.next_state = next->state;
  const bool lens = rig.lens == LensModel::kReal360 && rig.products.rgb && rig.tier != Tier::kLabels;
  // The ideal colours serve its exposure at most.
  if (lens) request.products.rgb = rig.auto_exposure;
  capture.stats = renderer.Render(request, capture.frame);
  if (lens) CaptureLens(rig, request, renderer, capture);
}

}  // namespace airsim360

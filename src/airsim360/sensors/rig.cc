#include "airsim360/sensors/rig.h"

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/render/filter/tone_map.h"

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

void PictureSettings::Visit(ConfigVisitor& v) {
  RenderSettings::Visit(v);
  v.Field("pano_frame", "body or level: the picture turns with the body or only with its heading", pano_frame, kPanoFrameNames);
  v.Field("lens",
          "ideal, or real360: colour as of two stitched fisheyes with parallax, noise, rolling shutter and JPEG; "
          "labels stay ideal",
          lens, kLensModelNames);
  v.Field("look", "clean, or photo: colour as a consumer camera takes it, with metering, glare, noise and white balance", look, kLookNames);
  v.Group("camera_look", "what look photo does", [this](ConfigVisitor& group) { camera_look.Visit(group); });
}

void CheckPictureSettings(const PictureSettings& settings, const Camera& camera, std::string_view prefix) {
  CheckRenderSettings(settings, prefix);
  const std::string before(prefix);
  if (settings.lens == LensModel::kReal360 && !std::holds_alternative<Equirectangular>(camera))
    throw InputError(before + "lens: 'real360' makes equirectangular pictures; use " + before + "projection erp");
  CheckCameraLook(settings.camera_look, before);
  if (settings.look == Look::kPhoto && std::holds_alternative<CubeFace>(camera))
    throw InputError(before +
                     "look: 'photo' meters and scatters every picture by itself, so that the faces of a cube would "
                     "not fit; use " +
                     before + "projection erp");
  if (settings.auto_exposure && std::holds_alternative<CubeFace>(camera))
    throw InputError(before + "exposure: 'auto' would differ between the faces of a cube; use " + before + "projection erp");
}

RigidTransform CameraPose(const PanoramicRig& rig, const RigidTransform& X_WB) {
  if (rig.gimbal) {
    if (rig.pano_frame == PanoFrame::kLevel) throw InputError("pano_frame: 'level' would turn what a gimbal turns already; use body");
    return X_WB * rig.gimbal->AtRest(X_WB.R) * rig.X_BC;
  }
  if (rig.pano_frame == PanoFrame::kBody) return X_WB * rig.X_BC;
  // The rig hangs in a gimbal: its place follows the body, its orientation only the body's heading.
  const RigidTransform level = BodyPose(X_WB * rig.X_BC.p, Heading(X_WB.R), 0, 0);
  return {level.R * rig.X_BC.R, level.p};
}

namespace {

bool WantsPhoto(const PanoramicRig& rig) { return rig.look == Look::kPhoto && rig.products.rgb && rig.tier != Tier::kLabels; }

PhotoRequest RequestPhoto(const PanoramicRig& rig, const Capture& capture) {
  return {.camera = rig.camera,
          .R_WC = capture.X_WC.R,
          .exposure = capture.frame.exposure,
          .exposure_ev = rig.exposure_ev,
          .daylight = capture.frame.daylight,
          .seed = rig.seed,
          .frame = static_cast<uint64_t>(capture.t_ns)};
}

// The exposure of pictures that are not metered themselves: in a room the picture chooses its own, and both sensors must
// have the same. Where stops are given it is the fixed one, whatever is seen.
float ExposureAt(const RenderRequest& request, Renderer& renderer, RenderStats& stats) {
  const int rows = request.exposure_ev == 0 ? 32 : 4;
  RenderRequest small = request;
  small.camera = Equirectangular{2 * rows, rows};
  small.edge_samples = 1;
  small.products = {.range = false, .semantic = false, .entity = false};
  small.X_WC_next.reset();
  small.next_state.reset();
  Frame frame;
  const RenderStats own = renderer.Render(small, frame);
  stats.rays += own.rays;
  stats.render_ms += own.render_ms;
  return frame.exposure;
}

// Replaces the colour picture by that of a real camera.
void CaptureLens(const PanoramicRig& rig, const RenderRequest& request, Renderer& renderer, Capture& capture) {
  const auto* target = std::get_if<Equirectangular>(&rig.camera);
  if (target == nullptr) throw InputError("lens real360 makes equirectangular pictures only");
  const Kinematics& body = capture.body;
  const bool photo = WantsPhoto(rig);
  const auto develop = [&](Image<Rgb32f>& light, Image<Rgb8>& rgb) {
    if (!photo) return ToneMapImage(light, 1, request.tone, rgb);
    // Its sensors have their own noise.
    CameraLook look = rig.camera_look;
    look.full_well = 0;
    PhotoRequest taken = RequestPhoto(rig, capture);
    for (Rgb32f& c : light.pixels()) c = {c.r / taken.exposure, c.g / taken.exposure, c.b / taken.exposure};
    capture.photo = TakePhoto(look, taken, light, rgb);
  };
  if (!rig.auto_exposure && !photo) capture.frame.exposure = ExposureAt(request, renderer, capture.stats);
  const RenderStats stats = RenderReal360(
      rig.real360, request, [&](double t) { return CameraPose(rig, Extrapolate(body, t)); }, Norm(body.v_WB) > 0 || Norm(body.w_WB_B) > 0,
      capture.frame.exposure, static_cast<uint64_t>(capture.t_ns), *target, renderer, develop, capture.frame.rgb);
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

void CaptureRig(const PanoramicRig& rig, const Kinematics& body, int64_t t_ns, Renderer& renderer, Capture& capture,
                const NextTrigger* next) {
  capture.t_ns = t_ns;
  capture.X_WC = CameraPose(rig, body.X_WB);
  capture.body = body;
  capture.pano_frame = rig.pano_frame;
  capture.X_WC_next.reset();
  if (next != nullptr && rig.products.flow) capture.X_WC_next = CameraPose(rig, next->X_WB);
  RenderRequest request{rig, rig.camera, capture.X_WC, rig.products};
  request.state = rig.state;
  request.X_WC_next = capture.X_WC_next;
  if (next != nullptr) request.next_state = next->state;
  const bool lens = rig.lens == LensModel::kReal360 && rig.products.rgb && rig.tier != Tier::kLabels;
  const bool photo = WantsPhoto(rig);
  // The ideal colours serve its exposure at most.
  if (lens) request.products.rgb = rig.auto_exposure;
  if (photo) {
    request.light = true;
    request.exposure_ev = 0;
    request.auto_exposure = false;
  }
  capture.photo.reset();
  capture.stats = renderer.Render(request, capture.frame);
  request.light = false;
  if (lens) CaptureLens(rig, request, renderer, capture);
  if (photo && !lens) capture.photo = TakePhoto(rig.camera_look, RequestPhoto(rig, capture), capture.frame.light, capture.frame.rgb);
  // So far it is the fixed one, that the photo's stops count from.
  if (capture.photo) capture.frame.exposure *= static_cast<float>(std::exp2(capture.photo->exposure_ev));
}

}  // namespace airsim360

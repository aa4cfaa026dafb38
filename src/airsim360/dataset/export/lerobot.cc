// LeRobot v2.1 (huggingface/lerobot): one episode, its state and actions in Parquet, the panorama as a video.
#include <cmath>
#include <numbers>

#include "airsim360/dataset/export/export_job.h"
#include "airsim360/dataset/export/lerobot_writer.h"

namespace airsim360::internal {
namespace {

constexpr const char* kStateNames[] = {"x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz"};
constexpr const char* kActionNames[] = {"forward", "left", "up", "yaw_rate"};

double YawOf(const RigidTransform& X_WC) {
  const Vec3d forward = X_WC.R.column(2);
  return std::atan2(forward.y, forward.x);
}

std::vector<float> StateOf(const NativeFrame& frame, const View& view) {
  const RigidTransform X = frame.X_WC(view);
  const Quaternion q = ToQuaternion(X.R);
  const Vec3d v = frame.v_WB();
  std::vector<float> state;
  for (const double value : {X.p.x, X.p.y, X.p.z, q.w, q.x, q.y, q.z, v.x, v.y, v.z}) state.push_back(static_cast<float>(value));
  return state;
}

// Mean velocity to the next frame in the axes of the heading, m/s, and yaw rate, rad/s: what was done between the two.
std::vector<float> ActionOf(const NativeFrame& frame, const NativeFrame& next, const View& view) {
  const double dt = 1e-9 * static_cast<double>(next.t_ns - frame.t_ns);
  if (dt <= 0) return {0, 0, 0, 0};
  const RigidTransform a = frame.X_WC(view), b = next.X_WC(view);
  const Vec3d v = (b.p - a.p) / dt;
  const double yaw = YawOf(a), turn = std::remainder(YawOf(b) - yaw, 2 * std::numbers::pi);
  const double c = std::cos(yaw), s = std::sin(yaw);
  return {static_cast<float>(c * v.x + s * v.y), static_cast<float>(-s * v.x + c * v.y), static_cast<float>(v.z),
          static_cast<float>(turn / dt)};
}

// Frames a second; InputError where a frame is more than a tenth of a step from its even time (flights are sampled at whole
// steps of the simulation).
double EvenRate(const ExportJob& job) {
  const size_t count = job.data.size();
  job.Need(count > 1, "two frames or more", "--frames N");
  const int64_t first = job.data.Frame(0).t_ns;
  const double step = static_cast<double>(job.data.Frame(count - 1).t_ns - first) / static_cast<double>(count - 1);
  bool even = step > 0;
  for (size_t i = 1; i < count && even; ++i)
    even = std::abs(static_cast<double>(job.data.Frame(i).t_ns - first) - static_cast<double>(i) * step) <= 0.1 * step;
  job.Need(even, "frames evenly apart in time", "--fps N");
  return 1e9 / step;
}

}  // namespace

void ExportLeRobot(ExportJob& job) {
  job.NeedColour();
  const View& view = job.OneView();
  const double rate = EvenRate(job);
  LeRobotWriter writer(job.out, "",
                       {.rate = rate,
                        .width = Width(view.camera),
                        .height = Height(view.camera),
                        .spherical = view.projection == Projection::kErp,
                        .state_names = {std::begin(kStateNames), std::end(kStateNames)},
                        .action_names = {std::begin(kActionNames), std::end(kActionNames)}});
  writer.Begin("fly through " + job.data.spec().world);
  const int64_t first = job.data.Frame(0).t_ns;
  job.EachFrame([&](const NativeFrame& frame) { return job.data.Rgb(frame, view); },
                [&](const NativeFrame& frame, const Image<Rgb8>& picture) {
                  // After the last frame nothing is done any more.
                  const NativeFrame next = job.data.Frame(std::min(frame.position + 1, job.data.size() - 1));
                  writer.AddRow(StateOf(frame, view), ActionOf(frame, next, view));
                  writer.AddPicture(picture, first + std::llround(1e9 * static_cast<double>(frame.position) / rate));
                });
  writer.End();
  writer.Finish();
}

}  // namespace airsim360::internal

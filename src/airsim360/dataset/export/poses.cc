// Poses and pictures in the layouts of odometry benchmarks: TUM RGB-D, EuRoC/ASL, KITTI odometry.
#include <cstdio>

#include "airsim360/dataset/export/export_job.h"
#include "airsim360/dataset/export/imu_log.h"
#include "airsim360/projection/camera_model_names.h"

namespace airsim360::internal {
namespace {

namespace fs = std::filesystem;

// Seconds with all nine digits of the nanoseconds.
std::string Seconds(int64_t t_ns) {
  char text[40];
  std::snprintf(text, sizeof text, "%lld.%09lld", static_cast<long long>(t_ns / 1'000'000'000),
                static_cast<long long>(t_ns % 1'000'000'000));
  return text;
}

std::string Joined(std::initializer_list<double> values, const char* separator) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : separator) + Number(value);
  return text;
}

std::string EurocImu(const std::vector<ImuRow>& rows) {
  std::string text =
      "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],a_RS_S_x [m s^-2],a_RS_S_y [m "
      "s^-2],a_RS_S_z [m s^-2]\n";
  for (const ImuRow& row : rows) text += std::to_string(row.t_ns) + "," + row.text + "\n";
  return text;
}

std::string MatrixText(const RigidTransform& X) {
  std::string text = "[";
  for (int i = 0; i < 3; ++i) text += Joined({X.R.m[i][0], X.R.m[i][1], X.R.m[i][2], X.p[i]}, ", ") + ",\n         ";
  return text + "0, 0, 0, 1]";
}

// sensor.yaml of the camera: T_BS takes the camera to the body.
std::string EurocCamera(const ExportJob& job, const View& view) {
  std::string text = "sensor_type: camera\ncomment: " + job.data.spec().world +
                     "\nT_BS:\n  cols: 4\n  rows: 4\n  data: " + MatrixText(view.X_BC) + "\nresolution: [" +
                     std::to_string(Width(view.camera)) + ", " + std::to_string(Height(view.camera)) + "]\ncamera_model: ";
  if (const auto* pinhole = std::get_if<Pinhole>(&view.camera)) {
    return text + "pinhole\nintrinsics: [" + Joined({pinhole->fx, pinhole->fy, pinhole->cx - 0.5, pinhole->cy - 0.5}, ", ") +
           "]\ndistortion_model: radial-tangential\ndistortion_coefficients: [0, 0, 0, 0]\n";
  }
  if (std::holds_alternative<Equirectangular>(view.camera)) return text + "equirectangular\n";
  const CameraModel lens = *ModelOf(view.camera);
  std::vector<double> p = lens.parameters;
  p[2] -= 0.5, p[3] -= 0.5;  // pixel centres are whole numbers
  return text + "pinhole\nintrinsics: [" + Joined({p[0], p[1], p[2], p[3]}, ", ") +
         "]\ndistortion_model: " + (lens.name == "OPENCV" ? "radial-tangential" : "equidistant") + "\ndistortion_coefficients: [" +
         Joined({p[4], p[5], p[6], p[7]}, ", ") + "]\n";
}

// Of what EuRoC's sensor.yaml can say.
bool HasEurocModel(const View& view) {
  const std::optional<CameraModel> lens = ModelOf(view.camera);
  return std::holds_alternative<Equirectangular>(view.camera) ||
         (lens && (lens->name == "PINHOLE" || lens->name == "OPENCV" || lens->name == "OPENCV_FISHEYE"));
}

}  // namespace

void ExportTum(ExportJob& job) {
  job.NeedColour();
  const View& view = job.OneView();
  std::string poses =
                  "# ground truth trajectory: camera (right, down, forward) in W (east, north, up)\n"
                  "# timestamp tx ty tz qx qy qz qw\n",
              pictures = "# color images\n# timestamp filename\n";
  job.EachFrame(
      [&](const NativeFrame& frame) {
        const std::string path = "rgb/" + Seconds(frame.t_ns) + job.data.Extension("rgb");
        job.out.Write(path, job.data.Read(frame, view, "rgb"));
        return path;
      },
      [&](const NativeFrame& frame, const std::string& path) {
        const RigidTransform X = frame.X_WC(view);
        const Quaternion q = ToQuaternion(X.R);
        poses += Seconds(frame.t_ns) + " " + Joined({X.p.x, X.p.y, X.p.z, q.x, q.y, q.z, q.w}, " ") + "\n";
        pictures += Seconds(frame.t_ns) + " " + path + "\n";
      });
  job.out.Write("groundtruth.txt", poses);
  job.out.Write("rgb.txt", pictures);
}

void ExportEuroc(ExportJob& job) {
  job.NeedColour();
  const View& view = job.OneView();
  job.Need(HasEurocModel(view), "a panorama, a pinhole, OPENCV or OPENCV_FISHEYE (EuRoC has no other lenses)", "other --cameras");
  job.Need(!view.gimbal, "a camera that is fixed to the body", "--cameras without gimbals");
  std::string pictures = "#timestamp [ns],filename\n";
  std::string states =
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], v_RS_R_x [m "
      "s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], b_w_RS_S_y [rad s^-1], b_w_RS_S_z [rad "
      "s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], b_a_RS_S_z [m s^-2]\n";
  job.EachFrame(
      [&](const NativeFrame& frame) {
        const std::string name = std::to_string(frame.t_ns) + job.data.Extension("rgb");
        job.out.Write("mav0/cam0/data/" + name, job.data.Read(frame, view, "rgb"));
        return name;
      },
      [&](const NativeFrame& frame, const std::string& name) {
        const RigidTransform X = frame.X_WB(view);
        const Quaternion q = ToQuaternion(X.R);
        const Vec3d v = frame.v_WB();
        const std::string t = std::to_string(frame.t_ns);
        pictures += t + "," + name + "\n";
        states += t + "," + Joined({X.p.x, X.p.y, X.p.z, q.w, q.x, q.y, q.z, v.x, v.y, v.z, 0, 0, 0, 0, 0, 0}, ",") + "\n";
      });
  job.out.Write("mav0/cam0/data.csv", pictures);
  job.out.Write("mav0/cam0/sensor.yaml", EurocCamera(job, view));
  job.out.Write("mav0/state_groundtruth_estimate0/data.csv", states);
  job.out.Write("mav0/body.yaml", "comment: body +X forward, +Y left, +Z up; reference +X east, +Y north, +Z up\n");
  const fs::path imu = FindImu(job.data.folder());
  if (!imu.empty()) job.out.Write("mav0/imu0/data.csv", EurocImu(ReadImu(imu)));
  job.notes["imu"] = imu.empty() ? "none: only flights of 'airsim360 fly' have one" : imu.string();
}

void ExportKittiOdometry(ExportJob& job) {
  job.NeedColour();
  const View& view = job.OneView();
  const RigidTransform X_C0W = job.data.Frame(0).X_WC(view).inverse();
  const int64_t t0 = job.data.Frame(0).t_ns;
  std::string poses, times;
  job.EachFrame(
      [&](const NativeFrame& frame) {
        char name[64];
        std::snprintf(name, sizeof name, "sequences/00/image_2/%06zu", frame.position);
        job.out.Write(name + job.data.Extension("rgb"), job.data.Read(frame, view, "rgb"));
        return 0;
      },
      [&](const NativeFrame& frame, int) {
        const RigidTransform X = X_C0W * frame.X_WC(view);
        for (int i = 0; i < 3; ++i) {
          poses += Joined({X.R.m[i][0], X.R.m[i][1], X.R.m[i][2], X.p[i]}, " ");
          poses += i < 2 ? ' ' : '\n';
        }
        times += Seconds(frame.t_ns - t0) + "\n";
      });
  job.out.Write("poses/00.txt", poses);
  job.out.Write("sequences/00/times.txt", times);
  if (const auto* pinhole = std::get_if<Pinhole>(&view.camera)) {
    // KITTI's pixel centres are whole numbers.
    const std::string P = Joined({pinhole->fx, 0, pinhole->cx - 0.5, 0, 0, pinhole->fy, pinhole->cy - 0.5, 0, 0, 0, 1, 0}, " ");
    std::string calib;
    for (const char* camera : {"P0", "P1", "P2", "P3"}) calib += std::string(camera) + ": " + P + "\n";
    job.out.Write("sequences/00/calib.txt", calib);
  } else {
    job.notes["calib"] = "none: the pictures are no pinholes";
  }
}

}  // namespace airsim360::internal

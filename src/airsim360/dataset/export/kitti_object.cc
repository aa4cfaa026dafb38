// KITTI object detection (Geiger et al., CVPR 2012): a line of a label file for every vehicle of traffic and every person that a
// frame shows.
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/dataset/export/export_job.h"
#include "airsim360/dataset/export/vehicle_frames.h"
#include "airsim360/dataset/people/nuscenes_tables.h"
#include "airsim360/projection/camera_model_names.h"

namespace airsim360::internal {
namespace {

constexpr int kUnknownOcclusion = 3;  // KITTI's; how much of a vehicle is hidden is not recorded

// KITTI's eight types have no bus, motorcycle or boat.
const char* TypeOf(const std::string& category) {
  constexpr std::array<std::pair<const char*, const char*>, 7> kTypes{{{"vehicle/car", "Car"},
                                                                       {"vehicle/van", "Van"},
                                                                       {"vehicle/truck", "Truck"},
                                                                       {"vehicle/food_truck", "Truck"},
                                                                       {"vehicle/tram", "Tram"},
                                                                       {"vehicle/train", "Tram"},
                                                                       {"vehicle/bicycle", "Cyclist"}}};
  return WordFor(category, kTypes, "Misc");
}

Vec3d ToVec(const Json& json) { return {json.at(0), json.at(1), json.at(2)}; }

// How much of the rectangle around a box's corners lies outside of the picture; 0 in panoramas, which show every direction.
double Truncation(const Camera& camera, const RigidTransform& X_CB, Vec3d size) {
  if (std::holds_alternative<Equirectangular>(camera)) return 0;
  const auto& pinhole = std::get<Pinhole>(camera);
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p = X_CB * Vec3d{(corner & 1 ? 0.5 : -0.5) * size.x, (corner & 2 ? 0.5 : -0.5) * size.y, corner & 4 ? size.z : 0.0};
    if (p.z <= 0.01) return 1;
    const double x = pinhole.fx * p.x / p.z + pinhole.cx, y = pinhole.fy * p.y / p.z + pinhole.cy;
    x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
  }
  const double inside = std::max(0.0, std::min(x1, 1.0 * Width(camera)) - std::max(x0, 0.0)) *
                        std::max(0.0, std::min(y1, 1.0 * Height(camera)) - std::max(y0, 0.0));
  return 1 - inside / ((x1 - x0) * (y1 - y0));
}

std::string LabelLine(const Segment& segment, const Json& vehicle, const View& view, const RigidTransform& X_CW) {
  const Json& pose = vehicle.at("X_WB");
  const Json& q = pose.at("q_wxyz");
  const RigidTransform X_CB = X_CW * RigidTransform{ToMatrix({q.at(0), q.at(1), q.at(2), q.at(3)}), ToVec(pose.at("p"))};
  const Vec3d size = ToVec(vehicle.at("size")), heading = X_CB.R.column(0);
  const double rotation_y = std::atan2(-heading.z, heading.x);
  const double alpha = std::remainder(rotation_y - std::atan2(X_CB.p.x, X_CB.p.z), 2 * std::numbers::pi);
  const PixelBox& box = segment.box_wrap;
  char line[320];
  std::snprintf(line, sizeof line, "%s %.2f %d %.4f %d.00 %d.00 %d.00 %d.00 %.4f %.4f %.4f %.4f %.4f %.4f %.4f\n",
                TypeOf(vehicle.at("category")), Truncation(view.camera, X_CB, size), kUnknownOcclusion, alpha, box.x, box.y,
                box.x + box.w - 1, box.y + box.h - 1, size.z, size.y, size.x, X_CB.p.x, X_CB.p.y, X_CB.p.z, rotation_y);
  return line;
}

// Of everybody whom the frame shows: vehicles, then people.
std::string LabelsOf(const ExportJob& job, const NativeFrame& frame, const View& view, const std::vector<Json>& vehicles, int64_t& lines) {
  std::string text;
  const RigidTransform X_CW = frame.X_WC(view).inverse();
  if (!vehicles.empty()) {
    for (const SeenVehicle& seen : VehiclesSeen(job, frame, view, vehicles[frame.position])) {
      text += OfVehicles(job, frame, [&] { return LabelLine(seen.segment, *seen.vehicle, view, X_CW); });
      ++lines;
    }
  }
  for (const Json& person : job.data.Persons(frame, view)) {
    if (person.at("area") == 0) continue;
    const std::string line = KittiLine(person);
    text += line, lines += !line.empty();
  }
  return text;
}

std::string Calibration(const Camera& camera) {
  const auto* pinhole = std::get_if<Pinhole>(&camera);
  if (pinhole == nullptr) return {};
  // KITTI counts from the middle of the first pixel.
  return "P2: " + Number(pinhole->fx) + " 0 " + Number(pinhole->cx - 0.5) + " 0 0 " + Number(pinhole->fy) + " " +
         Number(pinhole->cy - 0.5) + " 0 0 0 1 0\n";
}

}  // namespace

void ExportKittiObject(ExportJob& job) {
  const View& view = job.OneView();
  if (!std::holds_alternative<Equirectangular>(view.camera) && !std::holds_alternative<Pinhole>(view.camera))
    throw InputError("--format kitti_object: panoramas and pinhole pictures have such labels, this dataset's camera is neither");
  job.Need(HasVehicles(job) || job.data.HasPeople(), "vehicles of traffic or people", "--traffic N or --people N");
  const std::vector<Json> vehicles = HasVehicles(job) ? ReadVehicles(job) : std::vector<Json>{};
  const std::string calibration = Calibration(view.camera);
  int64_t boxes = 0;
  job.EachFrame(
      [&](const NativeFrame& frame) {
        int64_t lines = 0;
        const std::string text = LabelsOf(job, frame, view, vehicles, lines);
        job.out.Write("label_2/" + frame.stem + ".txt", text);
        if (!calibration.empty()) job.out.Write("calib/" + frame.stem + ".txt", calibration);
        if (job.data.Has("rgb")) job.out.Write("image_2/" + job.data.FileName(frame, view, "rgb"), job.data.Read(frame, view, "rgb"));
        return lines;
      },
      [&](const NativeFrame&, int64_t lines) { boxes += lines; });
  job.notes["boxes"] = boxes;
}

}  // namespace airsim360::internal

// nuScenes (Caesar et al., CVPR 2020): the thirteen tables with the boxes of people and of the vehicles of traffic that frames
// show.
#include <array>

#include "airsim360/dataset/export/export_job.h"
#include "airsim360/dataset/export/vehicle_frames.h"
#include "airsim360/dataset/people/nuscenes_tables.h"

namespace airsim360::internal {
namespace {

constexpr const char* kVersion = "v1.0-airsim360";
constexpr const char* kPictures = "samples/CAM_PANORAMA/";

// nuScenes counts vans among cars; what it has no word for is left to its last category.
const char* NuScenesCategory(const std::string& category) {
  constexpr std::array<std::pair<const char*, const char*>, 6> kCategories{{{"vehicle/car", "vehicle.car"},
                                                                            {"vehicle/van", "vehicle.car"},
                                                                            {"vehicle/truck", "vehicle.truck"},
                                                                            {"vehicle/food_truck", "vehicle.truck"},
                                                                            {"vehicle/bus", "vehicle.bus.rigid"},
                                                                            {"vehicle/bicycle", "vehicle.bicycle"}}};
  return WordFor(category, kCategories, "movable_object.debris");
}

NuScenesBox BoxOf(const Json& vehicle) {
  const Json &pose = vehicle.at("X_WB"), &size = vehicle.at("size"), &q = pose.at("q_wxyz"), &p = pose.at("p");
  // Its middle is half its height away from the ground.
  const Vec3d up = ToMatrix({q.at(0), q.at(1), q.at(2), q.at(3)}).column(2);
  const double half = size.at(2).get<double>() / 2;
  return {.kind = "vehicle",
          .track = vehicle.at("entity"),
          .category = NuScenesCategory(vehicle.at("category")),
          .attribute = vehicle.at("stopped").get<bool>() ? "vehicle.stopped" : "vehicle.moving",
          .visibility = "",
          .translation = {p.at(0).get<double>() + up.x * half, p.at(1).get<double>() + up.y * half, p.at(2).get<double>() + up.z * half},
          .size = {size.at(1), size.at(0), size.at(2)},
          .rotation = q,
          .velocity = vehicle.at("velocity")};
}

Json CameraOf(const NativeFrame& frame, const View& view) {
  const RigidTransform X_WC = frame.X_WC(view);
  const Quaternion q = ToQuaternion(X_WC.R);
  Json camera = {{"X_WC", {{"p", {X_WC.p.x, X_WC.p.y, X_WC.p.z}}, {"q_wxyz", {q.w, q.x, q.y, q.z}}}}};
  if (const auto* pinhole = std::get_if<Pinhole>(&view.camera)) {
    // nuScenes counts from the middle of the first pixel.
    camera["K"] = {{pinhole->fx, 0, pinhole->cx - 0.5}, {0, pinhole->fy, pinhole->cy - 0.5}, {0, 0, 1}};
  }
  return camera;
}

std::vector<NuScenesBox> BoxesOf(const ExportJob& job, const NativeFrame& frame, const View& view, const std::vector<Json>& vehicles) {
  std::vector<NuScenesBox> boxes;
  for (const Json& person : job.data.Persons(frame, view)) boxes.push_back(NuScenesBoxOf(person));
  if (vehicles.empty()) return boxes;
  for (const SeenVehicle& seen : VehiclesSeen(job, frame, view, vehicles[frame.position]))
    boxes.push_back(OfVehicles(job, frame, [&] { return BoxOf(*seen.vehicle); }));
  return boxes;
}

std::vector<std::string> Joined(std::vector<std::string> names, bool more, std::initializer_list<const char*> others) {
  if (more) names.insert(names.end(), others.begin(), others.end());
  return names;
}

}  // namespace

void ExportNuScenes(ExportJob& job) {
  const View& view = job.OneView();
  const bool driving = HasVehicles(job), people = job.data.HasPeople();
  job.Need(driving || people, "people or vehicles of traffic", "--people N or --traffic N");
  const std::vector<Json> vehicles = driving ? ReadVehicles(job) : std::vector<Json>{};
  const auto pedestrians = [&](std::vector<std::string> names) { return people ? std::move(names) : std::vector<std::string>{}; };
  NuScenesTables tables(job.data.spec(),
                        Joined(pedestrians(PedestrianCategories()), driving, {"vehicle.car", "vehicle.truck", "vehicle.bus.rigid"}),
                        Joined(pedestrians(PedestrianAttributes()), driving, {"vehicle.moving", "vehicle.stopped"}));
  job.EachFrame(
      [&](const NativeFrame& frame) {
        if (job.data.Has("rgb")) job.out.Write(kPictures + job.data.FileName(frame, view, "rgb"), job.data.Read(frame, view, "rgb"));
        return BoxesOf(job, frame, view, vehicles);
      },
      [&](const NativeFrame& frame, const std::vector<NuScenesBox>& boxes) {
        const std::string picture = job.data.Has("rgb") ? kPictures + job.data.FileName(frame, view, "rgb") : "";
        tables.AddFrame(frame.stem, frame.t_ns, CameraOf(frame, view), picture);
        for (const NuScenesBox& box : boxes) tables.AddBox(box);
      });
  for (const ExportedFile& file : tables.Finish(kVersion)) job.out.Write(file.path, file.text);
  job.notes["boxes"] = tables.boxes();
}

}  // namespace airsim360::internal

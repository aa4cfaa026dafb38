#include "airsim360/sim/capture.h"

#include "airsim360/base/error.h"

namespace airsim360 {

void internal::ThrowNoSensor(std::string_view kind, std::string_view name, const std::vector<std::string>& names) {
  if (names.empty()) throw InputError("the vehicle has no " + std::string(kind));
  throw InputError(UnknownChoiceMessage(kind, name, names));
}

const SensorSet& SnapshotSensors::SensorsOf(size_t vehicle) const {
  if (vehicle >= model_->drones.size()) {
    throw InputError("vehicle " + std::to_string(vehicle) + " is no drone and has no sensors");
  }
  return model_->drones[vehicle]->setup().sensors;
}

std::shared_ptr<const RayTracer> SnapshotSensors::TracerOf(const SimState& state, size_t vehicle) {
  return dynamic_.At(SceneStateOf(*model_, state, vehicle));
}

RangeReading SnapshotSensors::Range(const SimState& state, size_t vehicle, size_t i) {
  const SensorSet& set = SensorsOf(vehicle);
  const RangeFinderSpec& spec = set.range_finders.at(i).spec;
  const Vehicle& carrier = state.vehicles.at(vehicle);
  const RigidTransform X_BS = MountPose(set, carrier.sensors, spec.mount.pose(), spec.gimbal);
  const SensorKey key = KeyOf(model_->world, static_cast<uint32_t>(vehicle), "range", i);
  return MeasureRange(spec, key, *TracerOf(state, vehicle), carrier.motion.X_WB * X_BS, state.t_ns);
}

void SnapshotSensors::Lidar(const SimState& state, size_t vehicle, size_t i, LidarScan& scan) {
  const SensorSet& set = SensorsOf(vehicle);
  const LidarSpec& spec = set.lidars.at(i).spec;
  const Vehicle& carrier = state.vehicles.at(vehicle);
  const RigidTransform X_BS = MountPose(set, carrier.sensors, spec.mount.pose(), spec.gimbal);
  const SensorKey key = KeyOf(model_->world, static_cast<uint32_t>(vehicle), "lidar", i);
  ScanLidar(spec, key, *TracerOf(state, vehicle), carrier.motion, X_BS, state.t_ns, scan);
}

void SnapshotSensors::Camera(const SimState& state, size_t vehicle, size_t i, const Products& products, Renderer& renderer,
                             Capture& capture) {
  const SensorSet& set = SensorsOf(vehicle);
  const CameraSpec& spec = set.cameras.at(i).spec;
  const Vehicle& carrier = state.vehicles.at(vehicle);
  PanoramicRig rig = spec.Rig();
  rig.X_BC = MountPose(set, carrier.sensors, rig.X_BC, spec.gimbal);
  rig.products = products;
  rig.seed = model_->world.seed;
  rig.state = SceneStateOf(*model_, state, vehicle);
  CaptureRig(rig, carrier.motion, state.t_ns, renderer, capture);
}

}  // namespace airsim360

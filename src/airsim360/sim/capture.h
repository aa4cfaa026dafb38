// Ray sensors and cameras of a vehicle: functions of a snapshot. Taking one changes nothing, so that it may
// be done at any time, as often as wanted, while the loop is elsewhere.
#pragma once

#include <memory>
#include <string_view>

#include "airsim360/sim/drone_bodies.h"

namespace airsim360 {

/// Index of the sensor called `name`; the empty name is the first. InputError naming the nearest.
template <class Spec>
size_t FindSensor(std::string_view kind, std::string_view name, const std::vector<Named<Spec>>& sensors);

/// Sees the world as the vehicles of a snapshot do. One thread at a time.
class SnapshotSensors {
 public:
  /// `base`: the scene with all bodies as built.
  SnapshotSensors(std::shared_ptr<const SimModel> model, std::shared_ptr<const RayTracer> base)
      : model_(std::move(model)), dynamic_(std::move(base)) {}

  /// Reading of range finder `i` of a drone's sensor set, stamped with the snapshot's time.
  RangeReading Range(const SimState& state, size_t vehicle, size_t i);
  void Lidar(const SimState& state, size_t vehicle, size_t i, LidarScan& scan);
  /// One picture of camera `i`, with `products` and the vehicle's own body hidden.
  void Camera(const SimState& state, size_t vehicle, size_t i, const Products& products, Renderer& renderer, Capture& capture);
  /// Tracer of a snapshot as a vehicle sees it.
  std::shared_ptr<const RayTracer> TracerOf(const SimState& state, size_t vehicle);

 private:
  const SensorSet& SensorsOf(size_t vehicle) const;

  std::shared_ptr<const SimModel> model_;
  DynamicTracer dynamic_;
};

namespace internal {
[[noreturn]] void ThrowNoSensor(std::string_view kind, std::string_view name, const std::vector<std::string>& names);
}

template <class Spec>
size_t FindSensor(std::string_view kind, std::string_view name, const std::vector<Named<Spec>>& sensors) {
  std::vector<std::string> names;
  for (size_t i = 0; i < sensors.size(); ++i) {
    if (name.empty() || sensors[i].name == name) return i;
    names.push_back(sensors[i].name);
  }
  internal::ThrowNoSensor(kind, name, names);
}

}  // namespace airsim360

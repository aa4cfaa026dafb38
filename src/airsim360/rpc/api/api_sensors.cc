// Readings of sensors; errors as AirSim's for names that there are not.
#include <algorithm>

#include "airsim360/rpc/api/api.h"
#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/rpc/images/segmentation_palette.h"
#include "airsim360/rpc/session/vehicle_state.h"
#include "airsim360/rpc/wire/airsim_sensor_types.h"
#include "airsim360/rpc/wire/limits.h"

namespace airsim360 {
namespace {

using Text = const std::string&;

// Index of a sensor; "" is the first.
template <class List>
size_t SensorIndex(const List& list, Text name, const char* kind) {
  for (size_t i = 0; i < list.size(); ++i) {
    if (name.empty() || list[i].name == name) return i;
  }
  throw std::runtime_error(std::string("No ") + kind + " with name " + name + " exist on vehicle");
}

struct DroneSensors {
  const SensorSet& set;
  const SensorStates& states;
};

DroneSensors SensorsOf(const Snapshot& now, size_t vehicle, Text name, const char* kind) {
  if (vehicle >= now.model->drones.size()) {
    throw std::runtime_error(std::string("No ") + kind + " with name " + name + " exist on vehicle");
  }
  return {now.model->drones[vehicle]->setup().sensors, now.state.vehicles[vehicle].sensors};
}

uint64_t Stamp(const Snapshot& now, int64_t t_ns) { return now.epoch_ns + static_cast<uint64_t>(t_ns); }

airsim::ImuData Imu(const Snapshot& now, Text name, Text vehicle) {
  const size_t v = now.Find(vehicle);
  const DroneSensors sensors = SensorsOf(now, v, name, "IMU");
  const ImuReading& reading = sensors.states.imus[SensorIndex(sensors.set.imus, name, "IMU")].last;
  airsim::ImuData data;
  data.time_stamp = Stamp(now, reading.t_ns);
  // AirSim gives the true attitude here.
  data.orientation = KinematicsOf(now, v).orientation;
  data.angular_velocity = airsim::ToVector(FrdFromBody(reading.angular_velocity));
  data.linear_acceleration = airsim::ToVector(FrdFromBody(reading.specific_force));
  return data;
}

airsim::BarometerData Barometer(const Snapshot& now, Text name, Text vehicle) {
  const DroneSensors sensors = SensorsOf(now, now.Find(vehicle), name, "barometer");
  const size_t i = SensorIndex(sensors.set.barometers, name, "barometer");
  const BarometerReading& reading = sensors.states.barometers[i].last;
  constexpr double kHectopascal = 0.01;
  return {Stamp(now, reading.t_ns), static_cast<float>(reading.altitude), static_cast<float>(reading.pressure),
          static_cast<float>(sensors.set.barometers[i].spec.qnh * kHectopascal)};
}

airsim::MagnetometerData Magnetometer(const Snapshot& now, Text name, Text vehicle) {
  const DroneSensors sensors = SensorsOf(now, now.Find(vehicle), name, "magnetometer");
  const MagnetometerReading& reading = sensors.states.magnetometers[SensorIndex(sensors.set.magnetometers, name, "magnetometer")].last;
  constexpr double kGauss = 1e4;  // in one tesla
  airsim::MagnetometerData data;
  data.time_stamp = Stamp(now, reading.t_ns);
  data.magnetic_field_body = airsim::ToVector(FrdFromBody(reading.field * kGauss));
  return data;
}

airsim::GpsData Gps(const Snapshot& now, Text name, Text vehicle) {
  const DroneSensors sensors = SensorsOf(now, now.Find(vehicle), name, "gps");
  const GnssReading& reading = sensors.states.gnss[SensorIndex(sensors.set.gnss, name, "gps")].last;
  airsim::GpsData data;
  data.time_stamp = Stamp(now, reading.t_ns);
  data.is_valid = reading.has_fix;
  if (!reading.has_fix) return data;
  constexpr int kFix3d = 3;
  constexpr float kReportedError = 0.1f;  // metres, what AirSim's eph and epv settle at
  data.gnss.geo_point = {reading.place.latitude_deg, reading.place.longitude_deg, static_cast<float>(reading.place.altitude)};
  data.gnss.velocity = airsim::ToVector(NedFromWorld(reading.v_WS));
  data.gnss.eph = data.gnss.epv = kReportedError;
  data.gnss.fix_type = kFix3d;
  data.gnss.time_utc = Stamp(now, reading.measured_ns) / 1000;
  return data;
}

airsim::DistanceSensorData Distance(ImageService& images, const Snapshot& now, Text name, Text vehicle) {
  const size_t v = now.Find(vehicle);
  const auto& sensors = now.world->ray_sensors[v].distances;
  const size_t i = SensorIndex(sensors, name, "distance sensor");
  const RangeFinderSpec& spec = sensors[i].spec;
  const RigidTransform X_BS = spec.mount.pose(), X_WS = now.state.vehicles[v].motion.X_WB * X_BS;
  const SensorKey key{now.model->world.seed, static_cast<uint32_t>(v), static_cast<uint32_t>(i)};
  const RangeReading reading = MeasureRange(spec, key, *images.TracerOf(now, v), X_WS, now.state.t_ns);
  return {now.time_stamp(), static_cast<float>(reading.range), static_cast<float>(spec.min_range), static_cast<float>(spec.max_range),
          airsim::ToMount(X_BS)};
}

constexpr uint64_t kBytesOfPoint = 128;  // from the ray to the wire, at the most

// One scan with its points in the frame that AirSim's DataFrame names.
struct Scan {
  LidarScan scan;
  airsim::Pose pose;
  std::vector<Vec3d> points_F;
};

// Cosys-AirSim's noise of ranges.
void AddNoise(const RaySensors::Lidar& lidar, const SensorKey& key, int64_t t_ns, LidarPoint& point) {
  if (lidar.sigma <= 0 && lidar.far_sigma <= 0) return;
  RngStream random = SampleStream(key, "lidar range", MixBits(static_cast<uint64_t>(t_ns)) + point.shot);
  const double share = point.range / lidar.spec.max_range;
  const double noise = random.Normal() * (lidar.sigma + share * (lidar.far_sigma - lidar.sigma));
  const auto factor = static_cast<float>(1 + noise / point.range);
  point.p_S *= factor;
  point.range *= factor;
}

// Without a name: the first of that kind, or else of the other.
Scan ScanOf(ImageService& images, const Snapshot& now, Text name, size_t v, bool gpu) {
  const auto& lidars = now.world->ray_sensors[v].lidars;
  const auto first = std::ranges::find(lidars, gpu, &RaySensors::Lidar::gpu);
  const size_t i = name.empty() && first != lidars.end() ? static_cast<size_t>(first - lidars.begin()) : SensorIndex(lidars, name, "lidar");
  CheckReplyBytes(lidars[i].spec.channels * lidars[i].spec.columns * kBytesOfPoint,
                  "give the lidar fewer points a turn (NumberOfChannels, PointsPerSecond / RotationsPerSecond)");
  const RigidTransform X_BS = lidars[i].spec.mount.pose();
  const SensorKey key{now.model->world.seed, static_cast<uint32_t>(v), static_cast<uint32_t>(i)};
  Scan out;
  const Kinematics& body = now.state.vehicles[v].motion;
  ScanLidar(lidars[i].spec, key, *images.TracerOf(now, v), body, X_BS, now.state.t_ns, out.scan);
  const Vec3d origin_W = now.vehicles[v].origin_W;
  const RigidTransform X_WS = body.X_WB * X_BS;
  out.pose = airsim::ToPose(X_WS, origin_W);
  for (LidarPoint& point : out.scan.points) {
    AddNoise(lidars[i], key, now.state.t_ns, point);
    const Vec3d p_S = VecCast<double>(point.p_S);
    // VehicleInertialFrame: N, with the vehicle as origin.
    out.points_F.push_back(lidars[i].sensor_local_frame ? FrdFromBody(p_S) : NedFromWorld(X_WS * p_S - body.X_WB.p));
  }
  return out;
}

airsim::LidarData Lidar(ImageService& images, const Snapshot& now, Text name, Text vehicle) {
  const Scan scan = ScanOf(images, now, name, now.Find(vehicle), false);
  airsim::LidarData data;
  data.time_stamp = now.time_stamp();
  data.pose = scan.pose;
  for (size_t i = 0; i < scan.points_F.size(); ++i) {
    const airsim::Vector3r p = airsim::ToVector(scan.points_F[i]);
    data.point_cloud.insert(data.point_cloud.end(), {p.x_val, p.y_val, p.z_val});
    data.segmentation.push_back(static_cast<int>(now.world->segmentation[scan.scan.points[i].entity]));
  }
  return data;
}

airsim::GpuLidarData GpuLidar(ImageService& images, const Snapshot& now, Text name, Text vehicle) {
  const Scan scan = ScanOf(images, now, name, now.Find(vehicle), true);
  airsim::GpuLidarData data;
  data.time_stamp = now.time_stamp();
  data.pose = scan.pose;
  for (size_t i = 0; i < scan.points_F.size(); ++i) {
    const LidarPoint& point = scan.scan.points[i];
    const airsim::Vector3r p = airsim::ToVector(scan.points_F[i]);
    const Rgb8 c = SegmentationColor(now.world->segmentation[point.entity]);
    data.point_cloud.insert(data.point_cloud.end(),
                            {p.x_val, p.y_val, p.z_val, static_cast<float>(c.r << 16 | c.g << 8 | c.b), point.intensity});
  }
  return data;
}

}  // namespace

void AddSensorCalls(Api& api) {
  api.Read("getImuData", [](const Snapshot& now, Text name, Text vehicle) { return Imu(now, name, vehicle); });
  api.Read("getBarometerData", [](const Snapshot& now, Text name, Text vehicle) { return Barometer(now, name, vehicle); });
  api.Read("getMagnetometerData", [](const Snapshot& now, Text name, Text vehicle) { return Magnetometer(now, name, vehicle); });
  api.Read("getGpsData", [](const Snapshot& now, Text name, Text vehicle) { return Gps(now, name, vehicle); });
  // Rays are cast in the thread of the pictures, so that nobody waits for them.
  const auto picture = [&](const char* name, auto reading) {
    api.Picture(name, [reading](ImageService& images, const SnapshotPointer& now, Text sensor, Text vehicle) {
      return reading(images, *now, sensor, vehicle);
    });
  };
  picture("getDistanceSensorData", Distance);
  picture("getLidarData", Lidar);
  picture("getGPULidarData", GpuLidar);
}

}  // namespace airsim360

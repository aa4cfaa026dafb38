#include "airsim360/app/sensor_log.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <limits>
#include <utility>

#include "airsim360/app/lidar_ply.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/file_name.h"
#include "airsim360/image/codecs.h"
#include "airsim360/sensors/sample_clock.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

constexpr char kPoseColumns[] = "px,py,pz,qw,qx,qy,qz\n";

void AddRow(std::string& csv, std::initializer_list<double> values) {
  for (const double value : values) {
    char number[32];
    std::snprintf(number, sizeof(number), "%s%.12g", csv.empty() || csv.back() == '\n' ? "" : ",", value);
    csv += number;
  }
  csv += '\n';
}

// A file of a sensor: when, its number, how many points it has (none: not told), and from where.
void AddFileRow(std::string& csv, int64_t t_ns, int64_t file, std::optional<size_t> points, const RigidTransform& X) {
  const Quaternion q = ToQuaternion(X.R);
  const double t = Seconds(t_ns), number = static_cast<double>(file);
  if (points) {
    AddRow(csv, {t, number, static_cast<double>(*points), X.p.x, X.p.y, X.p.z, q.w, q.x, q.y, q.z});
  } else {
    AddRow(csv, {t, number, X.p.x, X.p.y, X.p.z, q.w, q.x, q.y, q.z});
  }
}

template <class Spec>
void CheckKind(const char* kind, const std::vector<Named<Spec>>& sensors) {
  // The first goes without its name.
  for (size_t i = 1; i < sensors.size(); ++i) CheckFileName(std::string("--sensors: ") + kind, sensors[i].name);
}

// What has state is read by the step, at most once in each.
template <class Spec>
void CheckRates(const char* kind, int64_t dt_ns, const std::vector<Named<Spec>>& sensors) {
  const double most = 1e9 / static_cast<double>(dt_ns);
  for (const auto& sensor : sensors) {
    if (sensor.spec.rate_hz <= most) continue;
    char text[120];
    std::snprintf(text, sizeof text, "': rate_hz %g is more than the %g steps a second of the simulation", sensor.spec.rate_hz, most);
    throw InputError(std::string("--sensors: ") + kind + " '" + sensor.name.substr(0, 80) + text);
  }
}

template <class Spec>
void CheckFiles(const char* kind, double seconds, const std::vector<Named<Spec>>& sensors) {
  for (const auto& sensor : sensors) {
    if (sensor.spec.rate_hz * seconds < static_cast<double>(kMaxSensorFiles)) continue;
    constexpr double kMax = static_cast<double>(kMaxSensorFiles);
    char text[200];
    std::snprintf(text, sizeof text,
                  "': at rate_hz %g it could write %.0f files in the %g s that the flight may take, more than "
                  "%.0f; the nearest rate_hz is %.3g",
                  sensor.spec.rate_hz, sensor.spec.rate_hz * seconds, seconds, kMax, 0.99 * kMax / seconds);
    throw InputError(std::string("--sensors: ") + kind + " '" + sensor.name.substr(0, 80) + text);
  }
}

}  // namespace

void CheckSensorLog(const SensorSet& set, double seconds) {
  const int64_t dt_ns = SimModel{}.dt_ns;
  CheckRates("imu", dt_ns, set.imus);
  CheckRates("gnss", dt_ns, set.gnss);
  CheckRates("barometer", dt_ns, set.barometers);
  CheckRates("magnetometer", dt_ns, set.magnetometers);
  CheckKind("imus", set.imus);
  CheckKind("gnss", set.gnss);
  CheckKind("barometers", set.barometers);
  CheckKind("magnetometers", set.magnetometers);
  CheckKind("range_finders", set.range_finders);
  CheckKind("lidars", set.lidars);
  CheckKind("cameras", set.cameras);
  CheckFiles("lidar", seconds, set.lidars);
  CheckFiles("camera", seconds, set.cameras);
}

template <class Spec>
std::vector<SensorLog::Track> SensorLog::Tracks(const char* kind, const char* columns, const std::vector<Named<Spec>>& sensors) {
  std::vector<Track> tracks;
  for (const auto& sensor : sensors) {
    tracks.push_back({tracks.empty() ? kind : std::string(kind) + "_" + sensor.name, sensor.spec.rate_hz, columns});
  }
  return tracks;
}

SensorLog::SensorLog(std::shared_ptr<const SimModel> model, Stage& stage, fs::path folder)
    : model_(std::move(model)),
      stage_(stage),
      folder_(std::move(folder)),
      set_(model_->drones.at(0)->setup().sensors),
      imus_(Tracks("imu", "t_s,wx,wy,wz,fx,fy,fz\n", set_.imus)),
      gnss_(Tracks("gnss", "t_s,measured_s,latitude_deg,longitude_deg,altitude,vx,vy,vz,fix\n", set_.gnss)),
      barometers_(Tracks("barometer", "t_s,pressure,altitude,temperature\n", set_.barometers)),
      magnetometers_(Tracks("magnetometer", "t_s,bx,by,bz\n", set_.magnetometers)),
      range_finders_(Tracks("range_finder", "t_s,range,valid,entity,category\n", set_.range_finders)),
      lidars_(Tracks("lidar", "t_s,scan,points,", set_.lidars)),
      cameras_(Tracks("camera", "t_s,picture,", set_.cameras)) {
  CreateWritableFolder(folder_);
  for (std::vector<Track>* tracks : {&lidars_, &cameras_}) {
    for (Track& track : *tracks) {
      track.csv += kPoseColumns;
      CreateWritableFolder(folder_ / track.name);
    }
  }
  if (!range_finders_.empty() || !lidars_.empty() || !cameras_.empty()) snapshots_.emplace(model_, stage_.tracer());
  // What cannot be had is found out on the ground.
  for (const auto& camera : set_.cameras) stage_.renderer(camera.spec.tier);
}

int64_t SensorLog::NextDue(int64_t t_ns) const {
  const int64_t dt_ns = model_->dt_ns;
  int64_t next_ns = std::numeric_limits<int64_t>::max();
  for (const auto* tracks : {&imus_, &gnss_, &barometers_, &magnetometers_, &range_finders_, &lidars_, &cameras_}) {
    for (const Track& track : *tracks) {
      // The sensor's next time, then the end of the step in which it lies: as SampleDue has it.
      const int64_t period_ns = std::max<int64_t>(1, std::llround(1e9 / track.rate_hz));
      const int64_t due_ns = (SampleIndex(track.rate_hz, t_ns) + 1) * period_ns;
      next_ns = std::min(next_ns, (due_ns + dt_ns - 1) / dt_ns * dt_ns);
    }
  }
  return next_ns;
}

void SensorLog::Note(const SimState& state) {
  NoteSampled(state.vehicles[0].sensors);
  NoteRays(state);
}

// Those that the step samples say themselves when that was.
void SensorLog::NoteSampled(const SensorStates& states) {
  const auto is_new = [](int64_t t_ns, Track& track) { return std::exchange(track.last_ns, t_ns) != t_ns; };
  for (size_t i = 0; i < imus_.size(); ++i) {
    const auto& [t_ns, w, f] = states.imus[i].last;
    if (is_new(t_ns, imus_[i])) AddRow(imus_[i].csv, {Seconds(t_ns), w.x, w.y, w.z, f.x, f.y, f.z});
  }
  for (size_t i = 0; i < gnss_.size(); ++i) {
    const GnssReading& r = states.gnss[i].last;
    if (!is_new(r.t_ns, gnss_[i])) continue;
    AddRow(gnss_[i].csv, {Seconds(r.t_ns), Seconds(r.measured_ns), r.place.latitude_deg, r.place.longitude_deg, r.place.altitude, r.v_WS.x,
                          r.v_WS.y, r.v_WS.z, r.has_fix ? 1.0 : 0.0});
  }
  for (size_t i = 0; i < barometers_.size(); ++i) {
    const BarometerReading& r = states.barometers[i].last;
    if (is_new(r.t_ns, barometers_[i])) AddRow(barometers_[i].csv, {Seconds(r.t_ns), r.pressure, r.altitude, r.temperature});
  }
  for (size_t i = 0; i < magnetometers_.size(); ++i) {
    const MagnetometerReading& r = states.magnetometers[i].last;
    if (is_new(r.t_ns, magnetometers_[i])) AddRow(magnetometers_[i].csv, {Seconds(r.t_ns), r.field.x, r.field.y, r.field.z});
  }
}

// Those that see by rays have no state; they are due at the same times as the others would be.
void SensorLog::NoteRays(const SimState& state) {
  const auto is_due = [&](Track& track) {
    const int64_t last_ns = std::exchange(track.last_ns, state.t_ns);
    return SampleIndex(track.rate_hz, state.t_ns) != SampleIndex(track.rate_hz, last_ns);
  };
  for (size_t i = 0; i < range_finders_.size(); ++i) {
    if (!is_due(range_finders_[i])) continue;
    const RangeReading r = snapshots_->Range(state, 0, i);
    AddRow(range_finders_[i].csv,
           {Seconds(r.t_ns), r.range, r.valid ? 1.0 : 0.0, static_cast<double>(r.entity), static_cast<double>(r.category)});
  }
  for (size_t i = 0; i < lidars_.size(); ++i)
    if (is_due(lidars_[i])) NoteScan(state, i, lidars_[i]);
  for (size_t i = 0; i < cameras_.size(); ++i)
    if (is_due(cameras_[i])) NotePicture(state, i, cameras_[i]);
}

fs::path SensorLog::NextFile(Track& track, const char* extension) {
  char name[32];
  std::snprintf(name, sizeof name, "%06lld.%s", static_cast<long long>(track.files++), extension);
  return folder_ / track.name / name;
}

void SensorLog::NoteScan(const SimState& state, size_t i, Track& track) {
  snapshots_->Lidar(state, 0, i, scan_);
  AddFileRow(track.csv, scan_.t_ns, track.files, scan_.points.size(), scan_.X_WS);
  WriteFileAtomically(NextFile(track, "ply"), LidarPly(scan_));
}

// Colours; of tier labels, which has none, the categories.
void SensorLog::NotePicture(const SimState& state, size_t i, Track& track) {
  const Tier tier = set_.cameras[i].spec.tier;
  const bool colours = tier != Tier::kLabels;
  const Products products{.rgb = colours, .range = false, .semantic = !colours, .entity = false};
  snapshots_->Camera(state, 0, i, products, stage_.renderer(tier), capture_);
  AddFileRow(track.csv, capture_.t_ns, track.files, std::nullopt, capture_.X_WC);
  WriteFileAtomically(NextFile(track, "png"), colours ? EncodePng(capture_.frame.rgb) : EncodePng(capture_.frame.semantic));
}

void SensorLog::WriteTables() const {
  for (const auto* tracks : {&imus_, &gnss_, &barometers_, &magnetometers_, &range_finders_, &lidars_, &cameras_}) {
    for (const Track& track : *tracks) WriteFileAtomically(folder_ / (track.name + ".csv"), track.csv);
  }
}

}  // namespace airsim360

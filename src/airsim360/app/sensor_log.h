// What the sensors of one drone measure on a flight, each at its own rate, as files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/sim/capture.h"
#include "airsim360/stage/stage.h"

namespace airsim360 {

/// Of nanoseconds, as files of a flight have its times.
inline double Seconds(int64_t t_ns) { return static_cast<double>(t_ns) * 1e-9; }

/// Scans or pictures of one sensor at most: their files are numbered with six digits.
inline constexpr int64_t kMaxSensorFiles = 1'000'000;

/// InputError, naming the sensor, for a set whose names cannot be names of files, or that may give more than
/// kMaxSensorFiles in so many seconds. To be asked before a world is loaded.
void CheckSensorLog(const SensorSet& set, double seconds);

/// Writes every sensor of vehicle 0 into a folder: a table KIND.csv of the first of its kind and
/// KIND_NAME.csv of each other one; the scans of a lidar (PLY) and the pictures of a camera (PNG) lie beside
/// it in a folder of the same name. Gimbals are no sensors. Looking changes nothing of the simulation.
/// docs/reference/sensors.md has the columns.
class SensorLog {
 public:
  /// `stage` gives what rays meet and the renderers; it must outlive this.
  SensorLog(std::shared_ptr<const SimModel> model, Stage& stage, std::filesystem::path folder);
  /// The first end of a step after t_ns at which some sensor has a new reading.
  int64_t NextDue(int64_t t_ns) const;
  /// Notes what is new in a state: to be told of it wherever NextDue says, in order of time.
  void Note(const SimState& state);
  /// Writes the tables; scans and pictures are there already.
  void WriteTables() const;

 private:
  struct Track {
    std::string name;  ///< of its files
    double rate_hz = 0;
    std::string csv;
    int64_t last_ns = 0, files = 0;
  };
  template <class Spec>
  std::vector<Track> Tracks(const char* kind, const char* columns, const std::vector<Named<Spec>>& sensors);
  void NoteSampled(const SensorStates& states);
  void NoteRays(const SimState& state);
  void NoteScan(const SimState& state, size_t i, Track& track);
  void NotePicture(const SimState& state, size_t i, Track& track);
  std::filesystem::path NextFile(Track& track, const char* extension);

  std::shared_ptr<const SimModel> model_;
  Stage& stage_;
  std::filesystem::path folder_;
  const SensorSet& set_;
  std::vector<Track> imus_, gnss_, barometers_, magnetometers_, range_finders_, lidars_, cameras_;
  std::optional<SnapshotSensors> snapshots_;  ///< if anything sees by rays
  LidarScan scan_;
  Capture capture_;
};

}  // namespace airsim360

// AirSim's recording: poses and pictures of a flight in a folder.
#pragma once

#include <functional>

#include "airsim360/rpc/settings.h"
#include "airsim360/rpc/snapshot.h"

namespace airsim360 {

/// Says when a record is due; who owns the pictures writes it. Of the session's thread.
class FlightRecorder {
 public:
  /// Told of a snapshot to be recorded.
  using Sink = std::function<void(const SnapshotPointer&)>;

  explicit FlightRecorder(const RecordingSettings& settings)
      : settings_(settings), running_(settings.enabled) {}
  void SetSink(Sink sink) { sink_ = std::move(sink); }
  void Start() { running_ = true; }
  void Stop() { running_ = false; }
  bool running() const { return running_; }
  void Observe(const SnapshotPointer& snapshot);

 private:
  RecordingSettings settings_;
  Sink sink_;
  bool running_;
  int64_t next_ns_ = 0;
  Vec3d last_p_W_;
};

}  // namespace airsim360

// AirSim's recording: poses and pictures of a flight in a folder.
#pragma once

#include <functional>

#include "airsim360/rpc/session/snapshot.h"
#include "airsim360/rpc/settings/settings.h"

namespace airsim360 {

/// Says when a record is due; who owns the pictures writes it. Of the session's thread.
class FlightRecorder {
 public:
  /// One recording, from its start to its end.
  class Recording {
   public:
    virtual ~Recording() = default;
    /// Takes a snapshot that is due; does not wait until it is written.
    virtual void Record(const SnapshotPointer& snapshot) = 0;
    /// Whether it has ended by itself: it could not be written.
    virtual bool failed() const = 0;
  };
  /// std::exception with the reason where nothing can be written.
  using Open = std::function<std::shared_ptr<Recording>()>;

  explicit FlightRecorder(const RecordingSettings& settings) : settings_(settings) {}
  void SetOpen(Open open) { open_ = std::move(open); }
  /// A new recording, if none is running. Throws as Open.
  void Start();
  void Stop() { recording_.reset(); }
  bool running() const { return recording_ != nullptr && !recording_->failed(); }
  void Observe(const SnapshotPointer& snapshot);

 private:
  RecordingSettings settings_;
  Open open_;
  std::shared_ptr<Recording> recording_;
  int64_t next_ns_ = 0;
  Vec3d last_p_W_;
};

}  // namespace airsim360

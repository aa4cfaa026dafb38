#include "airsim360/rpc/session/recorder.h"

namespace airsim360 {

void FlightRecorder::Start() {
  if (!running() && open_) recording_ = open_();
}

void FlightRecorder::Observe(const SnapshotPointer& snapshot) {
  if (!running() || snapshot->vehicles.empty() || snapshot->state.t_ns < next_ns_) return;
  const Vec3d p_W = snapshot->state.vehicles[0].motion.X_WB.p;
  constexpr double kMoved = 1e-3;  // metres
  if (settings_.record_on_move && next_ns_ > 0 && Norm(p_W - last_p_W_) < kMoved) return;
  last_p_W_ = p_W;
  next_ns_ = snapshot->state.t_ns + static_cast<int64_t>(settings_.interval * 1e9);
  recording_->Record(snapshot);
}

}  // namespace airsim360

// Records every packet that goes to Embree, and sends the same packets again with nothing around them.
//
// The program's own rtcIntersect16 and rtcOccluded16 (ray_recorder.cc) stand before those of the library:
// the linker gives them to our ray tracer, and they pass every call on.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <vector>

namespace airsim360::bench {

struct RecordedPacket {
  alignas(64) float origin[3][16], t_near[16], direction[3][16], t_far[16];
  uint32_t mask[16];
  int valid[16];
  RTCScene scene;
  RTCIntersectContextFlags flags;
  bool occlusion;
};

struct RayCounts {
  double nearest = 0, occlusion = 0;  ///< active rays
};

/// While it lives, packets are recorded; calls must come from one thread only.
class RayRecorder {
 public:
  RayRecorder();
  ~RayRecorder();
  const std::vector<RecordedPacket>& packets() const { return packets_; }
  RayCounts Count() const;

 private:
  std::vector<RecordedPacket> packets_;
};

/// Traces the packets in their order, runs of 64 in parallel. With `trace` false only reads them, which is no
/// part of traversal and is to be subtracted. Returns a sum of hit distances, so that nothing is optimised
/// away.
double Replay(const std::vector<RecordedPacket>& packets, bool trace);

}  // namespace airsim360::bench

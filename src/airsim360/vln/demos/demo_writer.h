// What a demonstration holds, and the layouts that take it. For the .cc files of this folder.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/dataset/export/export_folder.h"
#include "airsim360/image/image.h"
#include "airsim360/sensors/rig.h"
#include "airsim360/vln/episodes/language_episode.h"

namespace airsim360::internal {

inline constexpr double kDemoRate = 10;   // steps a second
inline constexpr size_t kDemoAhead = 10;  // steps that a waypoint lies ahead

/// One tenth of a second: the state at its beginning, and what is done in it.
struct DemoStep {
  int64_t t_ns = 0;
  Kinematics motion;
  std::vector<float> rotor_speeds = {};  ///< rad/s
  std::array<float, 4> velocity{};  ///< mean until the next step: metres a second forward, left, up; yaw rate, rad/s, positive to the left
  std::array<float, 4> waypoint{};  ///< where it is a second later: metres forward, left, up; turn, rad
  std::vector<float> rotor_commands = {};  ///< rad/s asked of the rotors

  /// x, y, z, qw, qx, qy, qz, vx, vy, vz in W; wx, wy, wz in B.
  std::vector<float> State() const;
};
inline constexpr const char* kDemoStateNames[] = {"x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz"};
inline constexpr const char* kDemoActionNames[] = {"forward", "left", "up", "yaw_rate"};

struct DemoShape {
  int width = 0, height = 0, rotors = 0;
};

/// A layout. Calls: Begin, AddPicture for each step, End, and so on; Finish.
class DemoWriter {
 public:
  virtual ~DemoWriter() = default;
  virtual void Begin(const LanguageEpisode& episode) = 0;
  virtual void AddPicture(const Image<Rgb8>& picture, int64_t t_ns) = 0;
  /// `keep` false: as if it had never begun.
  virtual void End(const LanguageEpisode& episode, const std::vector<DemoStep>& steps, bool keep) = 0;
  virtual void Finish() = 0;
};

std::unique_ptr<DemoWriter> MakeJsonlDemos(ExportFolder& folder, const DemoShape& shape);
std::unique_ptr<DemoWriter> MakeRldsDemos(ExportFolder& folder, const DemoShape& shape);
std::unique_ptr<DemoWriter> MakeLeRobotDemos(ExportFolder& folder, const DemoShape& shape);

}  // namespace airsim360::internal

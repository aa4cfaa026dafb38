// Agents that look at nothing.
#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/vln/agents/vln_agent.h"

namespace airsim360 {
namespace {

constexpr double kStraight = 40;  // metres that forward and heuristic fly
constexpr double kMargin = 3;     // metres kept from what is ahead

// Metres free ahead of a pose in a direction, `azimuth` to the right, at most `most`: a range finder.
double FreeAhead(const VlnSituation& s, double azimuth, double elevation, double most) {
  const Viewpoint view = s.Pose();
  const double yaw = view.yaw - azimuth;
  const Vec3f way{static_cast<float>(std::cos(elevation) * std::cos(yaw)), static_cast<float>(std::cos(elevation) * std::sin(yaw)),
                  static_cast<float>(std::sin(elevation))};
  const auto hit = s.solid.Intersect(VecCast<float>(view.p_W), way, static_cast<float>(most + kMargin));
  return hit ? std::max(0.0, hit->distance - kMargin) : most;
}

// One move of `distance` metres, then stop, in whatever way decisions are made. Called again until it says stop.
Decision OneMove(const VlnSituation& s, double azimuth, double distance) {
  if (s.decisions == Decisions::kYomo) {
    if (distance <= 0) return {{.stop = true}};
    return {{RelativeGoalAction{.azimuth = azimuth, .distance = distance}, true}};
  }
  if (s.decisions == Decisions::kWaypoints) {
    if (distance <= 0) return {{.stop = true}};
    return {{WaypointsAction{.points = {{distance * std::cos(azimuth), -distance * std::sin(azimuth), 0}}, .body_frame = true}, true}};
  }
  // Turns, then steps.
  const PresetSizes& sizes = s.flight.spec().presets;
  const auto turns = static_cast<int64_t>(std::lround(std::abs(azimuth) / sizes.turn)),
             steps = static_cast<int64_t>(distance / sizes.forward);
  if (s.step < turns) return {{PresetAction{azimuth > 0 ? Preset::kTurnRight : Preset::kTurnLeft}}};
  if (s.step < turns + steps && FreeAhead(s, 0, 0, sizes.forward) >= sizes.forward - 0.01) return {{PresetAction{Preset::kForward}}};
  return {{.stop = true}};
}

class ForwardAgent : public VlnAgent {
 public:
  Decision Decide(VlnSituation& s) override {
    return OneMove(s, 0, s.decisions == Decisions::kDiscrete ? kStraight : FreeAhead(s, 0, 0, kStraight));
  }
};

class HeuristicAgent : public VlnAgent {
 public:
  Decision Decide(VlnSituation& s) override {
    if (s.step == 0) azimuth_ = AzimuthOfWords(s.episode.instruction);
    return OneMove(s, azimuth_, s.decisions == Decisions::kDiscrete ? kStraight : FreeAhead(s, azimuth_, 0, kStraight));
  }

 private:
  static double AzimuthOfWords(const std::string& text) {
    struct Words {
      const char* text;
      double azimuth;
    };
    // The first that is found counts: longer ones before those that they hold.
    static constexpr Words kWords[] = {{"right rear", 135},
                                       {"left rear", -135},
                                       {"rear right", 135},
                                       {"rear left", -135},
                                       {"behind", 180},
                                       {"ahead and to your left", -45},
                                       {"ahead to your left", -45},
                                       {"ahead and to your right", 45},
                                       {"ahead to your right", 45},
                                       {"on your right", 90},
                                       {"on your left", -90},
                                       {"turn right", 90},
                                       {"left side", -45}};
    for (const Words& words : kWords)
      if (text.find(words.text) != std::string::npos) return words.azimuth * kDegree;
    return 0;
  }
  double azimuth_ = 0;
};

class RandomAgent : public VlnAgent {
 public:
  explicit RandomAgent(uint64_t seed) : random_(seed, "vln random agent") {}
  Decision Decide(VlnSituation& s) override {
    constexpr double kStop = 0.05;  // chance of a stop at each decision
    if (s.decisions == Decisions::kYomo)
      return {{RelativeGoalAction{.azimuth = random_.Uniform(-180, 180) * kDegree,
                                  .elevation = random_.Uniform(-5, 15) * kDegree,
                                  .distance = random_.Uniform(5, 80)},
               true}};
    if (random_.Chance(kStop)) return {{.stop = true}};
    if (s.decisions == Decisions::kWaypoints) {
      const double azimuth = random_.Uniform(-180, 180) * kDegree, distance = random_.Uniform(5, 30);
      return {{WaypointsAction{.points = {{distance * std::cos(azimuth), -distance * std::sin(azimuth), random_.Uniform(-1, 2)}},
                               .body_frame = true}}};
    }
    static constexpr Preset kPresets[] = {Preset::kForward, Preset::kForward, Preset::kForward,  Preset::kLeft,     Preset::kRight,
                                          Preset::kUp,      Preset::kDown,    Preset::kTurnLeft, Preset::kTurnRight};
    return {{PresetAction{kPresets[random_.Index(std::size(kPresets))]}}};
  }

 private:
  RngStream random_;
};

}  // namespace

Viewpoint VlnSituation::Pose() const {
  const RigidTransform& X_WB = flight.vehicle().motion.X_WB;
  return {X_WB.p, HeadingOfBody(X_WB)};
}

std::unique_ptr<VlnAgent> MakeForwardAgent() { return std::make_unique<ForwardAgent>(); }
std::unique_ptr<VlnAgent> MakeHeuristicAgent() { return std::make_unique<HeuristicAgent>(); }
std::unique_ptr<VlnAgent> MakeRandomAgent(uint64_t seed) { return std::make_unique<RandomAgent>(seed); }

}  // namespace airsim360

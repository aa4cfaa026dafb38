#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/routes/roadmap.h"
#include "airsim360/vln/agents/vln_agent.h"

namespace airsim360 {
namespace {

constexpr int64_t kEnough = 6;   // pixels that it recognises a thing by
constexpr double kStandOff = 4;  // metres that it stops before a thing, where the radius of success is no smaller
constexpr double kArrived = 7;   // metres to a thing at which a flight by steps stops
constexpr int kClimbs = 4;       // looks for what is hidden from so many steps higher
constexpr double kBody = 0.45;   // metres free around a straight move
constexpr double kQuarter = 90 * kDegree;

class MaskAgent : public VlnAgent {
 public:
  Decision Decide(VlnSituation& s) override {
    const SeenAtStart seen = s.eyes.Recognise(s.flight.vehicle().motion.X_WB, s.episode.entities, s.moved());
    if (seen.pixels < kEnough) return Search(s);
    turned_ = 0;
    return s.decisions == Decisions::kDiscrete ? StepTowards(s, seen) : MoveTo(s, seen);
  }

 private:
  // Metres free in a direction seen from the heading.
  static double Free(const VlnSituation& s, double azimuth, double elevation, double most) {
    const Viewpoint view = s.Pose();
    const double yaw = view.yaw - azimuth;
    const Vec3d way{std::cos(elevation) * std::cos(yaw), std::cos(elevation) * std::sin(yaw), std::sin(elevation)};
    const auto hit = s.solid.Intersect(VecCast<float>(view.p_W), VecCast<float>(way), static_cast<float>(most));
    return hit ? hit->distance : most;
  }

  // All around first, as far as the view does not show it at once; then from higher up.
  Decision Search(VlnSituation& s) {
    const double full = s.eyes.view() == VlnView::kFront ? 4 * kQuarter : 0;
    const bool discrete = s.decisions == Decisions::kDiscrete;
    const double turn = discrete ? s.flight.spec().presets.turn : kQuarter;
    if (turned_ + turn < full - 1e-6) {
      turned_ += turn;
      if (discrete) return {{PresetAction{Preset::kTurnRight}}};
      return {{RelativeGoalAction{.azimuth = turn}}};
    }
    turned_ = 0;
    const double up = discrete ? s.flight.spec().presets.vertical : 5;
    if (s.decisions == Decisions::kYomo || climbs_ >= kClimbs || Free(s, 0, kQuarter, up + 1) <= up) return {{.stop = true}};
    ++climbs_;
    if (discrete) return {{PresetAction{Preset::kUp}}};
    return {{WaypointsAction{.points = {{0, 0, up}}, .body_frame = true, .face = false}}};
  }

  // Straight towards it, or over what stands in between, as far as a drone fits.
  Decision MoveTo(VlnSituation& s, const SeenAtStart& seen) const {
    const Viewpoint view = s.Pose();
    const double azimuth = seen.azimuth_deg * kDegree, yaw = view.yaw - azimuth,
                 most = std::max(0.0, seen.range - std::min(kStandOff, s.radius));
    double best = 0, elevation = 0;
    for (const double higher : {0.0, 3.0, 6.0, 10.0, 15.0, 20.0}) {
      const double e = std::min(seen.elevation_deg + higher, 80.0) * kDegree;
      const Vec3d way{std::cos(e) * std::cos(yaw), std::cos(e) * std::sin(yaw), std::sin(e)};
      double far = most;
      while (far > 1 && !IsFree(s.solid, view.p_W, view.p_W + way * far, kBody)) far *= 0.8;
      if (far <= 1 || far <= best + 1) continue;
      best = far;
      elevation = e;
    }
    if (best < 0.5) return {{.stop = true}};
    if (s.decisions == Decisions::kYomo) return {{RelativeGoalAction{.azimuth = azimuth, .elevation = elevation, .distance = best}, true}};
    const Vec3d way{std::cos(elevation) * std::cos(azimuth), -std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
    return {{WaypointsAction{.points = {best * way}, .body_frame = true}, best >= most - 1}};
  }

  // A step sideways or backwards keeps the thing in a panorama's sight, but not in a camera's: that one has to face it.
  Decision StepTowards(VlnSituation& s, const SeenAtStart& seen) {
    if (seen.range <= kArrived) return {{.stop = true}};
    const PresetSizes& sizes = s.flight.spec().presets;
    const double azimuth = seen.azimuth_deg * kDegree, rise = seen.range * std::sin(seen.elevation_deg * kDegree);
    if (std::abs(rise) > 2 * sizes.vertical && std::abs(seen.elevation_deg) > 20)
      if (Free(s, 0, rise > 0 ? kQuarter : -kQuarter, sizes.vertical + 1) > sizes.vertical)
        return {{PresetAction{rise > 0 ? Preset::kUp : Preset::kDown}}};
    struct Way {
      double azimuth, step;
      Preset preset;
    };
    const Way ways[] = {{0, sizes.forward, Preset::kForward},
                        {kQuarter, sizes.lateral, Preset::kRight},
                        {-kQuarter, sizes.lateral, Preset::kLeft},
                        {2 * kQuarter, sizes.forward, Preset::kBackward}};
    const size_t usable = s.eyes.view() == VlnView::kFront ? 1 : std::size(ways);
    for (size_t i = 0; i < usable; ++i) {
      const double off = std::abs(std::remainder(azimuth - ways[i].azimuth, 4 * kQuarter));
      const bool near_enough = off <= std::max(0.51 * sizes.turn, seen.range > 25 ? sizes.turn : 0.0);
      if (near_enough && Free(s, ways[i].azimuth, 0, ways[i].step + 1) > ways[i].step) return {{PresetAction{ways[i].preset}}};
      if (near_enough && Free(s, 0, kQuarter, sizes.vertical + 1) > sizes.vertical && climbs_++ < 3 * kClimbs)
        return {{PresetAction{Preset::kUp}}};
      if (near_enough) return {{.stop = true}};
    }
    return {{PresetAction{azimuth > 0 ? Preset::kTurnRight : Preset::kTurnLeft}}};
  }

  double turned_ = 0;  // rad, of a look around
  int climbs_ = 0;
};

}  // namespace

std::unique_ptr<VlnAgent> MakeMaskAgent() { return std::make_unique<MaskAgent>(); }

}  // namespace airsim360

// Scores of vision-and-language navigation: what an agent flew against what its instruction describes. Pure functions, metres.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360 {

inline constexpr double kUsualVlnRadius = 20;  ///< metres of success where files say none

struct VlnEpisode {
  std::vector<Vec3d> reference{}, flown{};  ///< at least one point each
  std::optional<Vec3d> goal{};              ///< else the last point of the reference
  std::vector<Vec3d> places{};              ///< other points that are the goal too; a path is judged by the one nearest to its end
  std::optional<double> radius{};           ///< of success, where the files say one; for those who score many
  std::optional<double> shortest{};         ///< shortest free way from start to goal; else the length of the reference
  bool stopped = true;                      ///< the agent said that it had arrived
  bool collided = false;
};

/// What counts as success differs between benchmarks; the differences are here.
struct VlnProtocol {
  std::string_view name, quirk;  ///< the quirk in one sentence
  bool strict = false;           ///< nearer than the radius, not as near
  bool horizontal = false;       ///< distances to the goal leave the height out
  bool needs_stop = true;
  bool collision_fails = false;
  enum class Spl { kShortest, kStraightUnbounded, kReferenceLessRadius } spl = Spl::kShortest;
};
/// ours, aerialvln, openfly, citynav-mgp, citynav-vlnce, traveluav, uavon.
std::span<const VlnProtocol> VlnProtocols();
/// InputError naming --protocol and the nearest name.
const VlnProtocol& FindVlnProtocol(const std::string& name);

struct VlnScore {
  double success = 0;       ///< 1 if the last point is within the radius of the goal
  double oracle = 0;        ///< 1 if any point is, or is within the radius of another of the goal's places
  double spl = 0;           ///< success x shortest / max(shortest, flown) (Anderson et al., 2018)
  double spl_straight = 0;  ///< the same with the straight line from start to goal
  double error = 0;         ///< distance of the last point from the goal
  double ndtw = 0;          ///< exp(-DTW / (|reference| radius)) (Ilharco et al., 2019), exact, in three dimensions
  double sdtw = 0;          ///< success x ndtw
  double cls = 0;           ///< coverage weighted by length score (Jain et al., "Stay on the Path", ACL 2019)
  double length = 0;        ///< of the flown path
};
/// Names of means of the nine figures, in order, and their values.
inline constexpr std::array<std::string_view, 9> kVlnFigures = {"sr",   "osr",  "spl", "spl_straight", "ne",
                                                                "ndtw", "sdtw", "cls", "path_length"};
std::array<double, kVlnFigures.size()> Figures(const VlnScore& score);

/// InputError for a path without points, numbers that are not finite, a radius that is not above 0 or a shortest way below 0.
VlnScore ScoreVln(const VlnEpisode& episode, double radius, const VlnProtocol& protocol = VlnProtocols()[0]);

/// Coverage of the reference by the path times how well the lengths agree, in [0, 1]; `radius` is the distance at which coverage has
/// fallen to 1 / e.
double CoverageByLength(std::span<const Vec3d> path, std::span<const Vec3d> reference, double radius);

}  // namespace airsim360

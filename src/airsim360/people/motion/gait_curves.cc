#include "airsim360/people/motion/gait_curves.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/math/angles.h"

namespace airsim360::internal {

const double kBoysHip[20] = {42.7, 39.8, 35.8, 30.4, 25.2, 19.9, 15.2, 11.0, 6.6,  2.6,
                             1.1,  4.3,  12.4, 23.2, 34.0, 42.5, 47.9, 49.0, 46.8, 43.3};
const double kBoysHipDeviation[20] = {7.6, 7.3, 7.8, 7.2, 6.9, 6.4, 6.0, 5.9, 6.0, 5.6, 5.2, 5.8, 6.2, 6.6, 6.7, 6.6, 7.1, 7.5, 8.3, 7.9};
const double kBoysKnee[20] = {13.0, 18.5, 22.2, 21.2, 17.9, 14.3, 12.1, 10.9, 10.4, 12.8,
                              19.9, 35.1, 53.4, 68.0, 73.9, 70.5, 58.4, 37.7, 18.2, 11.0};
const double kBoysKneeDeviation[20] = {4.8, 5.6, 6.3, 6.2, 6.2, 5.3, 4.7, 4.7, 4.5, 4.7, 5.7, 7.6, 7.5, 5.5, 4.4, 4.7, 7.3, 9.5, 8.4, 4.9};

namespace {

// The mean of the hip takes 11.5 degrees of pelvic tilt off the recorded one, which matches step lengths best.
// Mean, then cosine and sine coefficients of the harmonics, degrees.
constexpr std::array<double, 13> kWalkHip{15.18, 21.24, -6.61, -4.16, -2.86, -0.39, 1.74, -0.34, 0.08, -0.08, 0.35};
constexpr std::array<double, 13> kWalkKnee{29.44, -1.97, -24.20, -15.81, 6.75, -0.57, 4.69, -1.01, 0.72, 0.23, 0.67, 0.30, -0.02};
constexpr std::array<double, 13> kRunHip{23.82, 24.15, -18.24, -6.52, 3.81, -1.04, -1.16, -0.59, 0.64, -0.79, -0.10};
constexpr std::array<double, 13> kRunKnee{49.46, -8.47, -29.45, -15.88, 12.11, -3.93, -0.03, -0.63, 1.36, -1.07, 0.32, -0.05, 0.39};

// Phase, degrees toe down: heel contact, flat, heel-off (there the leg decides), swing, contact.
constexpr double kWalkPitch[][2] = {{0, -18}, {0.07, 0}, {0.30, 0}, {0.62, 48}, {0.70, 60}, {0.80, 30}, {0.92, -12}, {1, -18}};
constexpr double kRunPitch[][2] = {{0, -4}, {0.05, 0}, {0.25, 0}, {0.38, 50}, {0.50, 75}, {0.65, 80}, {0.85, 25}, {1, -4}};

double Table(const double (&table)[8][2], double phase) {
  for (int i = 0; i < 7; ++i) {
    if (phase > table[i + 1][0]) continue;
    const double t = (phase - table[i][0]) / (table[i + 1][0] - table[i][0]);
    return table[i][1] + (table[i + 1][1] - table[i][1]) * t * t * (3 - 2 * t);
  }
  return table[7][1];
}

}  // namespace

Gait GaitAt(double speed, double leg, double weight, double run) {
  // Speed of an adult with a leg of 0.93 m at the same Froude number.
  const double adult = std::max(speed, 0.05) / std::sqrt(leg / 0.93);
  Gait gait{weight, run, 1, 0.62};
  const double walk = std::pow(std::clamp(adult, 0.2, 2.2) / 1.34, 0.42);
  const double fast = 0.70 + 0.30 * std::clamp((adult - 1.5) / 2.0, 0.0, 1.3);
  gait.amplitude = walk + (fast - walk) * run;
  const double walk_duty = 0.623 - 0.022 * std::clamp(adult - 0.5, 0.0, 1.5);
  const double run_duty = 0.40 - 0.045 * std::clamp(adult - 2.0, 0.0, 2.5);
  gait.duty = walk_duty + (run_duty - walk_duty) * run;
  return gait;
}

LegAngles LegCurves(const Gait& gait, double phase) {
  // All harmonics from one sine and cosine.
  const double c1 = std::cos(kTau * phase), s1 = std::sin(kTau * phase);
  const double w = gait.run;
  const auto mean = [w](const auto& walk, const auto& run) { return walk[0] + (run[0] - walk[0]) * w; };
  double hip = 0, knee = mean(kWalkKnee, kRunKnee);
  double c = 1, s = 0;
  for (size_t k = 1; k <= 6; ++k) {
    const double next = c * c1 - s * s1;
    s = s * c1 + c * s1;
    c = next;
    const size_t i = 2 * k - 1, j = 2 * k;
    hip += (kWalkHip[i] + (kRunHip[i] - kWalkHip[i]) * w) * c + (kWalkHip[j] + (kRunHip[j] - kWalkHip[j]) * w) * s;
    knee += (kWalkKnee[i] + (kRunKnee[i] - kWalkKnee[i]) * w) * c + (kWalkKnee[j] + (kRunKnee[j] - kWalkKnee[j]) * w) * s;
  }
  hip = mean(kWalkHip, kRunHip) + gait.amplitude * hip;
  // The knee of slow walks swings less: 50 degrees at 0.6 m/s, 65 at 1.8 (Koopman 2014).
  const double swing = std::clamp(0.45 + 0.55 * gait.amplitude, 0.6, 1.15);
  if (w < 1 && phase > 0.5) knee = 12 + (knee - 12) * (w + (1 - w) * (1 + (swing - 1) * std::min(1.0, (phase - 0.5) / 0.1)));
  const double pitch = w == 0   ? Table(kWalkPitch, phase)
                       : w == 1 ? Table(kRunPitch, phase)
                                : Table(kWalkPitch, phase) * (1 - w) + Table(kRunPitch, phase) * w;
  // Standing: nearly straight.
  const double g = gait.weight;
  return {kDegree * (1.5 + (hip - 1.5) * g), kDegree * (4 + (knee - 4) * g), kDegree * pitch * g};
}

}  // namespace airsim360::internal

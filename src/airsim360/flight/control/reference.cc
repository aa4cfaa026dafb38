#include "airsim360/flight/control/reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace airsim360 {
namespace {

/// Phase and its derivatives to the fourth.
struct Phase {
  double d[5] = {};
};

/// Integral of the septic smooth step 35 s^4 - 84 s^5 + 70 s^6 - 20 s^7 (its three first derivatives are zero
/// at 0 and 1), scaled to rise from 0 to w over T; the area under it is w T / 2.
Phase RampUp(double t, double T, double w) {
  const double s = std::clamp(t / T, 0.0, 1.0);
  const double s2 = s * s, s3 = s2 * s, s4 = s3 * s;
  Phase phase;
  phase.d[0] = w * T * s4 * s * (7 + s * (-14 + s * (10 - 2.5 * s)));
  phase.d[1] = w * s4 * (35 + s * (-84 + s * (70 - 20 * s)));
  phase.d[2] = w / T * s3 * (140 + s * (-420 + s * (420 - 140 * s)));
  phase.d[3] = w / (T * T) * s2 * (420 + s * (-1680 + s * (2100 - 840 * s)));
  phase.d[4] = w / (T * T * T) * s * (840 + s * (-5040 + s * (8400 - 4200 * s)));
  return phase;
}

/// Derivatives to the fourth of sin(k phi(t)) by Faa di Bruno.
void SineOf(const Phase& phase, double k, double out[5]) {
  const double c = std::cos(k * phase.d[0]), s = std::sin(k * phase.d[0]);
  const double f1 = k * c, f2 = -k * k * s, f3 = -k * k * k * c, f4 = k * k * k * k * s;
  const double a = phase.d[1], b = phase.d[2], d = phase.d[3], e = phase.d[4];
  out[0] = s;
  out[1] = f1 * a;
  out[2] = f2 * a * a + f1 * b;
  out[3] = f3 * a * a * a + 3 * f2 * a * b + f1 * d;
  out[4] = f4 * a * a * a * a + 6 * f3 * a * a * b + f2 * (4 * a * d + 3 * b * b) + f1 * e;
}

}  // namespace

Lemniscate::Lemniscate(Vec3d center, double amplitude, double peak_speed, int loops, double ramp)
    : center_(center), amplitude_(amplitude), w_(peak_speed / (std::numbers::sqrt2 * amplitude)), ramp_(ramp) {
  // Each ramp covers half of what cruising would: together they take one ramp's time off the whole turns.
  const double turns = std::ceil(std::max<double>(loops, 1) + w_ * ramp_ / (2 * std::numbers::pi));
  cruise_ = turns * 2 * std::numbers::pi / w_ - ramp_;
}

double Lemniscate::duration() const { return 2 * ramp_ + cruise_; }

ReferencePoint Lemniscate::At(double t) const {
  Phase phase;
  if (t < ramp_) {
    phase = RampUp(t, ramp_, w_);
  } else if (t <= ramp_ + cruise_) {
    phase.d[0] = w_ * (t - ramp_ / 2);
    phase.d[1] = w_;
  } else {
    // The ramp down is the ramp up run backwards: even derivatives change their sign.
    const Phase up = RampUp(duration() - t, ramp_, w_);
    phase = {{w_ * (ramp_ + cruise_) - up.d[0], up.d[1], -up.d[2], up.d[3], -up.d[4]}};
  }
  double x[5], y[5];
  SineOf(phase, 1, x);
  SineOf(phase, 2, y);
  Vec3d d[5];
  for (int i = 0; i < 5; ++i) d[i] = Vec3d{x[i], y[i] / 2, 0} * amplitude_;
  return {center_ + d[0], d[1], d[2], d[3], d[4], 0, 0};
}

}  // namespace airsim360

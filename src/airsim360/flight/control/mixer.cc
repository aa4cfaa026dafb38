#include "airsim360/flight/control/mixer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace airsim360 {
namespace {

/// Inverts a symmetric matrix of size n <= 4 in place by Gauss-Jordan with diagonal pivots; false when it is
/// singular (a pivot falls below 1e-9 of its diagonal).
bool InvertSymmetric(double (&a)[4][4], int n) {
  double diagonal[4];
  for (int i = 0; i < n; ++i) diagonal[i] = a[i][i];
  for (int k = 0; k < n; ++k) {
    const double pivot = a[k][k];
    if (!(pivot > 1e-9 * diagonal[k])) return false;
    a[k][k] = 1;
    for (int j = 0; j < n; ++j) a[k][j] /= pivot;
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = a[i][k];
      a[i][k] = 0;
      for (int j = 0; j < n; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  return true;
}

}  // namespace

double SpeedForThrust(const RotorModel& rotor, double thrust, double density_ratio) {
  return std::sqrt(std::max(thrust, 0.0) / (rotor.thrust_factor * density_ratio));
}

double ThrustAtSpeed(const RotorModel& rotor, double speed, double density_ratio) {
  return rotor.thrust_factor * density_ratio * speed * speed;
}

double MaxThrust(const DroneModel& model) {
  double sum = 0;
  for (const RotorModel& rotor : model.rotors) sum += ThrustAtSpeed(rotor, rotor.max_speed);
  return sum;
}

Mixer::Mixer(const DroneModel& model, uint64_t failed) : n_(static_cast<int>(model.rotors.size())) {
  for (int i = 0; i < n_; ++i) {
    if (failed >> i & 1) continue;
    const RotorModel& rotor = model.rotors[i];
    const Vec3d torque = Cross(rotor.p_B, rotor.axis_B) + rotor.axis_B * (rotor.direction * rotor.torque_ratio);
    effect_[i] = {torque.x, torque.y, torque.z, rotor.axis_B.z};
    max_[i] = ThrustAtSpeed(rotor, rotor.max_speed);
    min_[i] = max_[i] * kIdleShare * kIdleShare;
  }

  usable_ = Invert(false, loose_);
  has_yaw_ = usable_ && Invert(true, inverse_);
  if (!has_yaw_) inverse_ = loose_;
}

bool Mixer::Invert(bool with_yaw, std::array<Row, kMaxRotors>& inverse) const {
  // Weighted right inverse W B' (B W B')^-1.
  const int rows = with_yaw ? 4 : 3;
  const auto row = [&](int i, int k) {
    const Row& e = effect_[i];
    return k == 0 ? e.roll : k == 1 ? e.pitch : k == 2 ? e.thrust : e.yaw;
  };
  double gram[4][4] = {};
  for (int i = 0; i < n_; ++i) {
    for (int a = 0; a < rows; ++a) {
      for (int b = 0; b < rows; ++b) gram[a][b] += max_[i] * row(i, a) * row(i, b);
    }
  }
  if (!InvertSymmetric(gram, rows)) return false;
  for (int i = 0; i < n_; ++i) {
    double out[4] = {};
    for (int a = 0; a < rows; ++a) {
      for (int b = 0; b < rows; ++b) out[a] += max_[i] * row(i, b) * gram[b][a];
    }
    inverse[i] = {out[0], out[1], out[3], out[2]};
  }
  return true;
}

RotorWrench Mixer::WrenchOf(const RotorValues& thrust) const {
  RotorWrench sum;
  for (int i = 0; i < n_; ++i) {
    const Row& e = effect_[i];
    sum.torque_B += Vec3d{e.roll, e.pitch, e.yaw} * thrust[i];
    sum.thrust += e.thrust * thrust[i];
  }
  return sum;
}

Mixer::Result Mixer::Allocate(const RotorWrench& wanted, double density_ratio) const {
  Result result;
  const Vec3d torque = wanted.torque_B;
  RotorValues low{}, high{};
  bool fits = true;
  for (int i = 0; i < n_; ++i) {
    const Row& c = inverse_[i];
    low[i] = min_[i] * density_ratio;
    high[i] = max_[i] * density_ratio;
    result.thrust[i] = c.roll * torque.x + c.pitch * torque.y + c.thrust * wanted.thrust + c.yaw * torque.z;
    fits &= result.thrust[i] >= low[i] && result.thrust[i] <= high[i];
  }
  if (!fits) result = {TiltAndThrust(wanted, low, high), true};
  if (!fits) AddYaw(torque.z, low, high, result.thrust);
  return result;
}

RotorValues Mixer::TiltAndThrust(const RotorWrench& wanted, const RotorValues& low, const RotorValues& high) const {
  RotorValues tilt{};
  for (int i = 0; i < n_; ++i) {
    tilt[i] = loose_[i].roll * wanted.torque_B.x + loose_[i].pitch * wanted.torque_B.y;
  }
  // The largest share of roll and pitch for which some thrust puts every rotor in range. With the thrust's
  // column c, share s needs (low_i - s t_i) / c_i <= T <= (high_j - s t_j) / c_j for all i and j.
  double share = 1;
  for (int i = 0; i < n_; ++i) {
    for (int j = 0; j < n_; ++j) {
      const double ci = loose_[i].thrust, cj = loose_[j].thrust;
      if (ci <= 0 || cj <= 0) continue;
      const double grows = tilt[j] / cj - tilt[i] / ci;
      if (grows > 0) share = std::min(share, (high[j] / cj - low[i] / ci) / grows);
    }
  }
  share = std::max(share, 0.0);
  // The thrust as near as its interval allows.
  double least = -std::numeric_limits<double>::infinity(), most = -least;
  for (int i = 0; i < n_; ++i) {
    tilt[i] *= share;
    const double c = loose_[i].thrust;
    if (c <= 0) continue;
    least = std::max(least, (low[i] - tilt[i]) / c);
    most = std::min(most, (high[i] - tilt[i]) / c);
  }
  const double thrust = std::max(least, std::min(most, wanted.thrust));
  for (int i = 0; i < n_; ++i) tilt[i] += loose_[i].thrust * thrust;
  return tilt;
}

void Mixer::AddYaw(double yaw_torque, const RotorValues& low, const RotorValues& high, RotorValues& thrust) const {
  // The largest share of what is missing that keeps every rotor in range.
  const double missing = yaw_torque - WrenchOf(thrust).torque_B.z;
  double share = 1;
  for (int i = 0; i < n_; ++i) {
    const double step = inverse_[i].yaw * missing;
    if (step > 0) share = std::min(share, (high[i] - thrust[i]) / step);
    if (step < 0) share = std::min(share, (low[i] - thrust[i]) / step);
  }
  share = std::max(share, 0.0);
  for (int i = 0; i < n_; ++i) {
    thrust[i] = std::clamp(thrust[i] + share * inverse_[i].yaw * missing, low[i], high[i]);
  }
}

}  // namespace airsim360

#include "airsim360/people/motion/posture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/random.h"
#include "airsim360/people/body/anatomy.h"

namespace airsim360::internal {

Mat3d FromRotationVector(Vec3d v) {
  const double angle = Norm(v);
  if (angle < 1e-9) return {};
  const Vec3d a = v / angle;
  const double c = std::cos(angle), s = std::sin(angle), k = 1 - c;
  return {{{{c + a.x * a.x * k, a.x * a.y * k - a.z * s, a.x * a.z * k + a.y * s},
            {a.y * a.x * k + a.z * s, c + a.y * a.y * k, a.y * a.z * k - a.x * s},
            {a.z * a.x * k - a.y * s, a.z * a.y * k + a.x * s, c + a.z * a.z * k}}}};
}

Vec3d ToRotationVector(const Mat3d& R) {
  const Quaternion q = ToQuaternion(R);
  const Vec3d v{q.x, q.y, q.z};
  const double s = Norm(v);
  return s < 1e-9 ? 2 * v : v * (2 * std::atan2(s, q.w) / s);
}

double SmoothStep(double edge0, double edge1, double x) {
  const double t = std::clamp((x - edge0) / (edge1 - edge0), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double Draw(uint64_t seed, int channel, int64_t index) {
  const uint64_t bits = MixBits(seed ^ MixBits(static_cast<uint64_t>(index) * 0x9e3779b97f4a7c15ull + static_cast<uint64_t>(channel)));
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

double Sway(uint64_t seed, int channel, double rate, double t) {
  // Value noise with smooth steps between knots.
  const double x = t * rate * 2, floor = std::floor(x);
  const auto k = static_cast<int64_t>(floor);
  const double a = Draw(seed, channel, k), b = Draw(seed, channel, k + 1);
  return 2 * (a + (b - a) * SmoothStep(0, 1, x - floor)) - 1;
}

void ReachWith(bool left, const Body& body, Vec3d target, Vec3d pole, Posture& posture) {
  // Law of cosines: where the elbow is on the way, then how far aside.
  const double a = body.size.upper_arm, b = body.size.forearm;
  const double reach = std::clamp(Norm(target), std::abs(a - b) + 0.02, 0.998 * (a + b));
  const Vec3d along = Normalized(target);
  Vec3d aside = pole - along * Dot(pole, along);
  aside = Normalized(aside);
  const double x = (a * a - b * b + reach * reach) / (2 * reach), h = std::sqrt(std::max(0.0, a * a - x * x));
  const Vec3d elbow = along * x + aside * h, fore = along * reach - elbow;

  // Axes of the upper arm: -z along it, x where the forearm bends to.
  const Vec3d z = -Normalized(elbow);
  Vec3d bend = fore - z * Dot(fore, z);
  if (Norm(bend) < 1e-6) bend = -aside;
  const Vec3d ax = Normalized(bend), ay = Cross(z, ax);
  const double flex = std::atan2(Dot(fore, ax), -Dot(fore, z));
  const size_t arm = left ? kTLeftArm : kTRightArm;
  // What has been turned at the collar bone is taken back.
  posture.turn[arm + kShoulder] = posture.turn[arm + kClavicle].transpose() * Mat3d::FromColumns(ax, ay, z);
  posture.turn[arm + kElbow] = RotationY(-flex);
}

Posture PostureOf(const PostureInput& in) {
  Posture posture;
  SetTrunk(in, posture);
  SetArms(in, posture);
  return posture;
}

}  // namespace airsim360::internal

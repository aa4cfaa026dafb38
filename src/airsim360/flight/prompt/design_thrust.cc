// Thrust and top speed of a drone being designed.
#include "airsim360/flight/prompt/designer.h"

#include <algorithm>
#include <cmath>

#include "airsim360/flight/control/gains.h"
#include "airsim360/flight/control/mixer.h"
#include "airsim360/flight/prompt/laws.h"
#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {
constexpr double kSpeedOfSound = 340.3;                    // m/s
constexpr double kFastestTip = 0.65 * kSpeedOfSound;       // m/s; the gate ends at Mach 0.7
constexpr double kFastestTipAsked = 0.69 * kSpeedOfSound;  // for a thrust that was said
constexpr double kFastestIdleTip = 700;                    // m/s without load: beyond what any motor and propeller are sold for
constexpr double kLeastRatio = 1.5;                        // thrust to weight that is not gone below unasked
// Speed of a loaded motor over its speed without load, between hard and easy work.
constexpr double kLeastLoaded = 0.5, kMostLoaded = 0.92;
// Drag area over that of the law: from a smooth hull to one with legs, cameras and cables.
constexpr double kLeastDrag = 0.3, kMostDrag = 3;
}  // namespace

void Designer::SetThrust(double ratio, const std::string& law) {
  ratio_ = ratio;
  law_of_thrust_ = law;
  thrust_ = ratio * m_ * kGravity / n_;
  speed_ = std::sqrt(thrust_ / k_f_);
  Law("max_speed", law + Text(": %.2f N a rotor, speed = sqrt(T / k_f)", thrust_));
}

void Designer::ChooseThrust() {
  if (said_.thrust_to_weight) {
    SetThrust(*said_.thrust_to_weight, Said("thrust_to_weight"));
  } else {
    SetThrust(kind_.thrust_to_weight, Text("thrust to weight %.1f (%s)", kind_.thrust_to_weight, out_.drone_class.c_str()));
    // Motors that belong to the propeller rather than to the weight.
    const double matched = kind_.full_disc_loading * kPi * D_ * D_ / 4 * n_ / (m_ * kGravity);
    if (matched > ratio_) SetThrust(matched, Text("motors matched to the propeller, %g N/m^2 at full throttle", kind_.full_disc_loading));
    HoldToMotors();
    if (ratio_ > give_.ratio) {
      SetThrust(give_.ratio, give_.ratio < 14 ? law_of_thrust_ + ", lowered to leave mass for the body" : "thrust to weight at most 14");
    }
  }
  // Tips stay subsonic.
  const double tip = said_.thrust_to_weight ? kFastestTipAsked : kFastestTip;
  const double most = std::pow(2 * tip / D_, 2) * k_f_ * n_ / (m_ * kGravity);
  if (ratio_ > most) {
    if (said_.thrust_to_weight && GiveBlades()) {
      ChoosePropeller();
      return ChooseThrust();
    }
    if (said_.thrust_to_weight || most < kLeastRatio) {
      Refuse(Text("%d propellers of %.0f mm at Mach %.2f of their tips give %.2f times the weight of %.3g kg", n_, D_ * 1000,
                  tip / kSpeedOfSound, most, m_) +
             (said_.thrust_to_weight ? ", not " + Words("thrust_to_weight") : ""));
    }
    SetThrust(most, "as much as tips at Mach 0.65 give");
  }
  // Five rotors hover with thrusts up to 1.25 times their mean, seven with 1.19.
  const double unequal = n_ == 5 ? 1.25 : n_ == 7 ? 1.19 : 1;
  if (unequal > 1 && ratio_ < 1.1 * unequal) {
    Refuse(Text("%d rotors whose torques cancel need a thrust to weight of %.2f, not %.2f", n_, 1.1 * unequal, ratio_));
  }
  most_ratio_ = std::min({most, 14.0, give_.ratio});
  drag_ = 1;
  speed_held_ = false;
  ReachSpeed();
}

/// Said motors turn the propellers between half of their speed without load and nearly all of it.
void Designer::HoldToMotors() {
  if (!said_.motor_kv || !said_.cells) return;
  const double idle = *said_.motor_kv * *said_.cells * kFullCell * 2 * kPi / 60;
  if (said_.propeller && idle * D_ / 2 > kFastestIdleTip) {
    Refuse("'" + Words("motor_kv") + "' on '" + Words("cells") +
           Text("' are made for tips at Mach %.1f with propellers of %.0f mm, where thrust ends below Mach 1",
                idle * D_ / 2 / kSpeedOfSound, D_ * 1000));
  }
  const auto ratio_at = [&](double speed) { return n_ * k_f_ * speed * speed / (m_ * kGravity); };
  const double least = ratio_at(kLeastLoaded * idle), most = ratio_at(kMostLoaded * idle);
  if (most < 1.3) {
    Refuse("'" + Words("motor_kv") + "' on '" + Words("cells") +
           Text("' turn propellers of %.0f mm at most at %.0f rad/s, which lifts %.2f times the weight of %.3g kg", D_ * 1000,
                kMostLoaded * idle, most, m_));
  }
  if (ratio_ < least || ratio_ > most)
    SetThrust(std::clamp(ratio_, least, most), "motors of " + Words("motor_kv") + " on " + Words("cells"));
}

double Designer::LargestLean() const { return std::min(std::acos(std::min(1.0, 1 / (0.95 * ratio_))), 1.3); }

double Designer::LevelSpeed() const { return LevelSpeedAtTilt(Aerodynamics(), LargestLean()); }

void Designer::ReachSpeed() {
  if (!said_.speed && !said_.least_speed) return;
  const char* field = said_.speed ? "speed" : "least_speed";
  const double speed = std::max(said_.speed.value_or(0), said_.least_speed.value_or(0));
  if (said_.speed && speed > *said_.speed) {
    Refuse("'" + Words("speed") + "' contradicts '" + Words("least_speed") + "': a drone is blown away that is slower");
  }
  while (LevelSpeed() < speed && !said_.thrust_to_weight && ratio_ * 1.05 <= most_ratio_)
    SetThrust(ratio_ * 1.05, "raised until level flight reaches " + Words(field));
  drag_ = kLeastDrag;
  if (LevelSpeed() < speed) {
    Refuse("'" + Words(field) + "' contradicts " +
           (said_.thrust_to_weight ? "'" + Words("thrust_to_weight") + "'" : Text("a thrust of %.1f times the weight", ratio_)) +
           Text(": level flight ends at %.1f m/s", LevelSpeed()));
  }
  drag_ = 1;
  if (said_.speed || LevelSpeed() < speed) FitDrag(speed);
}

/// The drag area at which level flight ends at `speed`; where even a bluff body is faster, its lean is held.
void Designer::FitDrag(double speed) {
  drag_ = kMostDrag;
  if (LevelSpeed() > speed) {
    drag_ = 1;
    speed_held_ = LevelSpeed() > speed;
    return;
  }
  double low = kLeastDrag, high = kMostDrag;
  for (int i = 0; i < 50; ++i) {
    drag_ = std::sqrt(low * high);
    (LevelSpeed() > speed ? low : high) = drag_;
  }
}

}  // namespace airsim360::internal

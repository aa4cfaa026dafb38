// Battery, power and times of a drone being designed.
#include "airsim360/flight/prompt/designer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/flight/control/mixer.h"
#include "airsim360/flight/prompt/laws.h"
#include "airsim360/math/standard_atmosphere.h"

namespace airsim360::internal {
namespace {
constexpr double kMostUsable = 0.97;  // of the charge, before better motors are looked for
constexpr double kMostEfficiency = 0.88;
constexpr double kLoaded = 0.72;                    // speed of a motor at full power over that without load
constexpr double kPackLeast = 40, kPackMost = 320;  // W h/kg that batteries have
}  // namespace

double Designer::HoverPower() const {
  const double hover = m_ * kGravity / n_;
  const double shaft = n_ * hover * ratio_km_ * std::sqrt(hover / k_f_);
  return shaft / give_.efficiency + IdlePower();
}

double Designer::IdlePower() const { return 0.3 + 4 * std::min(m_, 2.0); }

double Designer::HoverTimeAsked() const {
  if (said_.hover_time) return *said_.hover_time;
  return said_.flight_time ? *said_.flight_time * kFlightPower : 0;
}

double Designer::EnergySaid() const {
  if (said_.energy_wh) return *said_.energy_wh;
  return said_.capacity_ah && m_ >= 0 ? *said_.capacity_ah * kCellVoltage * Cells() : 0;
}

int Designer::Cells() const {
  if (said_.cells) return static_cast<int>(*said_.cells);
  if (said_.energy_wh && said_.capacity_ah)
    return std::max(1, static_cast<int>(std::lround(*said_.energy_wh / *said_.capacity_ah / kCellVoltage)));
  // Before anything is known of the drone, what is usual for its kind.
  if (thrust_ <= 0) return CellsFor(100 * kind_.mass * std::pow(kind_.thrust_to_weight, 1.5));
  return CellsFor(HoverPower() * std::pow(ratio_, 1.5));
}

void Designer::CheckBatterySaid() const {
  if (said_.energy_wh && said_.capacity_ah) {
    const double charge = *said_.capacity_ah * kCellVoltage * Cells();
    if (std::abs(*said_.energy_wh / charge - 1) > 0.15) {
      Refuse("'" + Words("energy_wh") + "' contradicts '" + Words("capacity_ah") +
             Text("': %d cells of 3.7 V with %.3g Ah hold %.4g Wh", Cells(), *said_.capacity_ah, charge));
    }
  }
  if (!said_.battery_mass) return;
  const double energy = EnergySaid();
  const double specific = energy / *said_.battery_mass;
  if (energy > 0 && (said_.cells || said_.energy_wh) && (specific < kPackLeast || specific > kPackMost)) {
    Refuse("a battery of '" + Words("battery_mass") +
           Text("' with %.4g Wh has %.0f Wh/kg, where batteries have "
                "%.0f to %.0f",
                energy, specific, kPackLeast, kPackMost));
  }
}

bool Designer::MatchEnergy() {
  if (said_.hover_time && said_.flight_time) {
    const double share = *said_.hover_time / *said_.flight_time;
    if (share < 0.55 || share > 1.05) {
      Refuse("'" + Words("hover_time") + "' contradicts '" + Words("flight_time") +
             Text("': hovering lasts about %.2f of flying", kFlightPower));
    }
  }
  const double energy = said_.battery_mass && EnergySaid() <= 0 ? *said_.battery_mass * give_.specific_energy : EnergySaid();
  const double time = HoverTimeAsked();
  if (time <= 0 || energy <= 0) return true;
  // As little as was said is flown of the charge; where it is not enough, good motors and propellers help.
  const auto share = [&] { return HoverPower() * time / 3600 / energy; };
  for (int i = 0; i < 40 && share() > kMostUsable && give_.efficiency < kMostEfficiency; ++i)
    give_.efficiency = std::min(kMostEfficiency, give_.efficiency + 0.005);
  while (share() > kMostUsable && give_.merit > merit_least_) {
    const double better = std::max(merit_least_, give_.merit - 0.01);
    ratio_km_ *= better / give_.merit;
    give_.merit = better;
  }
  give_.usable = share();
  return give_.usable <= 1;
}

void Designer::FillBattery() {
  BatteryModel& battery = out_.model.battery;
  battery.cells = Cells();
  const double said = EnergySaid();
  out_.energy_wh = said > 0 ? said : out_.parts.battery * give_.specific_energy;
  battery.capacity_ah = said_.capacity_ah.value_or(out_.energy_wh / (kCellVoltage * battery.cells));
  battery.resistance = battery.cells * 0.012 / battery.capacity_ah;
  battery.efficiency = give_.efficiency;
  battery.idle_power = IdlePower();
  out_.hover_power = HoverPower();
  const double flown = give_.usable * out_.energy_wh * 3600 / out_.hover_power;
  out_.hover_time = said_.hover_time.value_or(flown);
  out_.flight_time = said_.flight_time.value_or(out_.hover_time / kFlightPower);
  out_.endurance = said_.hover_time ? *said_.hover_time : said_.flight_time.value_or(out_.hover_time);
  const double rpm = speed_ * 60 / (2 * std::numbers::pi);
  out_.motor_kv = said_.motor_kv.value_or(rpm / (kLoaded * kFullCell * battery.cells));
  // The pack must give the hover current without losing more than a quarter of its voltage.
  const double voltage = kCellVoltage * battery.cells;
  if (battery.resistance * out_.hover_power / voltage > 0.25 * voltage) {
    Refuse(Text("a battery of %.2g Ah cannot give the %.3g W of hovering", battery.capacity_ah, out_.hover_power));
  }
}

void Designer::CheckJourney() const {
  if (said_.altitude) {
    constexpr double kHighest = 11000;  // where StandardAir ends
    const double density = StandardAir(std::min(*said_.altitude, kHighest)).density / kSeaLevelAirDensity;
    if (*said_.altitude > kHighest || ratio_ * density < 1) {
      Refuse("at '" + Words("altitude") +
             Text("' the air has %.2g of its density at the sea%s, and with it goes a thrust of %.3g times the weight", density,
                  *said_.altitude > kHighest ? " or less" : "", ratio_));
    }
  }
  // Nobody cruises at top speed for as long as hovering lasts: twice that is beyond any doubt.
  const double reach = 2 * out_.flight_time * out_.level_speed;
  if (said_.range && *said_.range > reach) {
    Refuse("'" + Words("range") +
           Text("' on one charge: %.0f s of flight at %.1f m/s end after %.3g km", out_.flight_time, out_.level_speed, reach / 2000));
  }
}

void Designer::RefuseEnergy() const {
  const char* time = said_.hover_time ? "hover_time" : "flight_time";
  const std::string energy = WordsOr("energy_wh", WordsOr("capacity_ah", WordsOr("battery_mass", "the battery")));
  Refuse("'" + Words(time) + "' contradicts " + energy +
         Text(": hovering takes %.3g W, and the battery's %.4g Wh last %.0f s", HoverPower(),
              HoverPower() * HoverTimeAsked() / 3600 / give_.usable, HoverTimeAsked() / give_.usable));
}

}  // namespace airsim360::internal

#include "airsim360/flight/prompt/known_models.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <unordered_map>

namespace airsim360::internal {
namespace {

std::unordered_map<std::string, const KnownModel*> MakeIndex() {
  std::unordered_map<std::string, const KnownModel*> index;
  for (const auto models : {DjiModels(), OtherModels(), BuilderModels()}) {
    for (const KnownModel& model : models) {
      for (std::string_view rest = model.aliases; !rest.empty();) {
        const size_t bar = std::min(rest.find('|'), rest.size());
        std::string key;
        for (const char c : rest.substr(0, bar)) {
          if (c != ' ') key += c;
        }
        index.emplace(std::move(key), &model);
        rest.remove_prefix(std::min(bar + 1, rest.size()));
      }
    }
  }
  return index;
}

}  // namespace

const KnownModel* FindKnownModel(std::string_view key) {
  static const auto kIndex = MakeIndex();
  const auto found = kIndex.find(std::string(key));
  return found == kIndex.end() ? nullptr : found->second;
}

std::string ModelFacts(const KnownModel& m) {
  char text[64];
  std::string facts;
  const auto add = [&](const char* format, double value) {
    if (value <= 0) return;
    std::snprintf(text, sizeof(text), format, value);
    facts += (facts.empty() ? "" : ", ") + std::string(text);
  };
  add("%.4g kg", m.mass);
  add("%.0f rotors", m.rotors);
  add("diagonal %.4g mm", m.diagonal);
  add("propellers %.3g inch", m.propeller);
  add("%.0fS", m.cells);
  add("%.4g Ah", m.capacity);
  add("%.4g Wh", m.energy);
  add("flies %.3g min", m.flight);
  add("hovers %.3g min", m.hover);
  add("%.3g m/s", m.speed);
  return facts;
}

void ApplyModel(const KnownModel& m, DroneRequest& r) {
  const std::string words(m.title);
  const auto fact = [&](const char* name, auto& field, auto value, bool known) {
    if (!known || field) return;
    field = value;
    r.words[name] = words;
    r.facts.insert(name);
  };
  // A battery, a mass or rotors of the user's own make other flight times and speeds: the laws say which.
  const bool same_battery = !r.capacity_ah && !r.energy_wh && !r.cells && !r.battery_mass;
  const bool same_mass = !r.mass && !r.payload && !r.empty_mass;
  const bool same_rotors = !r.rotors && !r.propeller && !r.layout && !r.arm;
  const bool same_time = !r.flight_time && !r.hover_time;
  fact("drone_class", r.drone_class, std::string(m.drone_class), true);
  const bool loaded = m.drone_class == "agricultural";  // their makers give the mass with a full tank
  if (r.payload && !r.mass && !r.empty_mass && !loaded) {
    fact("mass", r.mass, m.mass + *r.payload, true);
  } else {
    fact("mass", r.mass, m.mass, !r.empty_mass);
  }
  // Much more or less mass is carried by propellers of the same disc loading.
  const double ratio = r.mass ? *r.mass / m.mass : 1;
  const double scale = ratio > 1.35 || ratio < 0.75 ? std::sqrt(ratio) : 1;
  fact("rotors", r.rotors, static_cast<double>(m.rotors), !r.layout);
  const double rotors = r.rotors.value_or(m.rotors);  // of a said layout the number may be open
  if (rotors == m.rotors) fact("layout", r.layout, m.layout, true);
  fact("propeller", r.propeller, scale * m.propeller * 0.0254, m.propeller > 0 && !r.arm);
  const bool said_propeller = r.propeller && !r.facts.count("propeller");
  fact("pitch", r.pitch, scale * m.pitch * 0.0254, m.pitch > 0 && !said_propeller);
  // Larger propellers than the frame has room for stand on longer arms.
  const double arms = r.layout == RotorLayout::kCoaxial ? rotors / 2 : rotors;
  const double room = scale * m.diagonal / 1000 * std::sin(std::numbers::pi / arms);
  fact("arm", r.arm, scale * m.diagonal / 2000, m.diagonal > 0 && rotors == m.rotors && !(said_propeller && *r.propeller * 1.02 > room));
  if (same_battery && scale == 1) fact("cells", r.cells, static_cast<double>(m.cells), m.cells > 0);
  if (same_battery && same_time && scale == 1) {
    fact("capacity_ah", r.capacity_ah, m.capacity, m.capacity > 0);
    fact("energy_wh", r.energy_wh, m.energy, m.energy > 0);
    if (same_mass && same_rotors) {
      fact("flight_time", r.flight_time, m.flight * 60, m.flight > 0);
      fact("hover_time", r.hover_time, m.hover * 60, m.hover > 0);
    }
  }
  if (!r.thrust_to_weight && same_rotors) fact("speed", r.speed, m.speed, m.speed > 0 && !r.least_speed);
}

}  // namespace airsim360::internal

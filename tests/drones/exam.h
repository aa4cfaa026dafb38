// Sentences with what they must lead to, for tests: {"text", "expect": "build" or "refuse", "figures": {...}}; a figure
// is a number, a pair of bounds, or {"min", "max"}.
#pragma once

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/design.h"
#include "airsim360/flight/prompt/gate.h"
#include "airsim360/flight/prompt/known_models.h"

namespace airsim360 {

struct ExamSentence {
  std::string text;
  bool build = true;
  std::map<std::string, std::pair<double, double>> figures;  ///< from, to
};

inline std::vector<ExamSentence> ReadExam(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file + ": cannot be read");
  const nlohmann::json list = nlohmann::json::parse(in);
  std::vector<ExamSentence> sentences;
  for (const auto& entry : list.is_array() ? list : list.at("sentences")) {
    ExamSentence sentence{entry.at("text"), entry.at("expect") == "build", {}};
    const nlohmann::json figures = entry.value("figures", nlohmann::json::object());
    for (const auto& [name, value] : figures.items()) {
      if (value.is_number()) sentence.figures[name] = {value, value};
      if (value.is_array()) sentence.figures[name] = {value.at(0), value.at(1)};
      if (value.is_object()) sentence.figures[name] = {value.value("min", 0.0), value.value("max", 1e9)};
    }
    sentences.push_back(std::move(sentence));
  }
  return sentences;
}

/// A figure of the design by the name that the exam has for it.
inline double ExamFigure(const DroneDesign& design, const std::string& name) {
  const DroneModel& model = design.model;
  if (name == "mass_kg") return model.mass;
  if (name == "rotor_count") return static_cast<double>(model.rotors.size());
  if (name == "rotor_diameter_m") return model.rotors[0].diameter;
  if (name == "wheelbase_m") return design.wheelbase;
  if (name == "payload_kg") return design.parts.payload;
  if (name == "hover_time_s") return design.hover_time;
  if (name == "flight_time_s") return design.flight_time;
  if (name == "endurance_s") return design.endurance;  // hovering or flying, whichever was said
  if (name == "max_speed_m_s") return design.level_speed;
  if (name == "thrust_to_weight") return FiguresOf(model).thrust_to_weight;
  if (name == "battery_cells") return model.battery.cells;
  if (name == "battery_capacity_ah") return model.battery.capacity_ah;
  if (name == "battery_energy_wh") return design.energy_wh;
  if (name == "motor_kv") return design.motor_kv;
  throw InputError("the exam asks for an unknown figure '" + name + "'");
}

/// Empty: built or refused as it must be, every figure within 2 %, through the gate. Else what went wrong.
inline std::string ExamProblem(const ExamSentence& sentence) {
  DroneDesign design;
  try {
    design = DroneFromPrompt(sentence.text);
  } catch (const InputError& error) {
    return sentence.build ? std::string("refused: ") + error.what() : "";
  }
  if (!sentence.build) return "built, but must be refused";
  std::string problems;
  for (const std::string& problem : GateProblems(design.model)) problems += "gate: " + problem + "; ";
  for (const auto& [name, value] : sentence.figures) {
    const double is = ExamFigure(design, name);
    if (!(is >= 0.98 * value.first && is <= 1.02 * value.second)) {
      problems +=
          name + " is " + std::to_string(is) + ", said " + std::to_string(value.first) + " to " + std::to_string(value.second) + "; ";
    }
  }
  return problems;
}

}  // namespace airsim360

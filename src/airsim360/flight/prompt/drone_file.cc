#include "airsim360/flight/prompt/drone_file.h"

#include "airsim360/base/config.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/text.h"

namespace airsim360 {
namespace {

/// Writes the fields that a reader would read.
class YamlWriter : public ConfigVisitor {
 public:
  explicit YamlWriter(int depth = 0) : indent_(2 * depth, ' '), depth_(depth) {}
  void Field(std::string_view name, std::string_view help, bool& value) override { Line(name, value ? "true" : "false", help); }
  void Field(std::string_view name, std::string_view help, uint64_t& value) override { Line(name, std::to_string(value), help); }
  void Field(std::string_view name, std::string_view help, double& value, double, double) override {
    Line(name, ShortestText(value), help);
  }
  void Field(std::string_view name, std::string_view help, std::string& value) override { Line(name, InQuotes(value), help); }
  void Field(std::string_view, std::string_view, std::vector<std::string>&) override {}
  void Count(std::string_view name, std::string_view help, int& value, int) override {
    if (value != 0) Line(name, std::to_string(value), help);
  }
  void NumberOr(std::string_view name, std::string_view help, const char* word, bool& is_word, double& value, double, double) override {
    Line(name, is_word ? std::string(word) : ShortestText(value), help);
  }
  void Choice(std::string_view name, std::string_view help, std::span<const char* const> names, size_t index,
              const std::function<void(size_t)>&) override {
    Line(name, names[index], help);
  }
  void Group(std::string_view name, std::string_view help, const ConfigFields& visit) override {
    Line(name, "", help);
    YamlWriter inner(depth_ + 1);
    visit(inner);
    text_ += inner.text_;
  }
  const std::string& text() const { return text_; }

 private:
  void Line(std::string_view name, std::string_view value, std::string_view help) {
    std::string line = indent_ + std::string(name) + ":" + (value.empty() ? "" : " ") + std::string(value);
    if (!help.empty()) {
      line.append(line.size() < 34 ? 34 - line.size() : 2, ' ');
      line += "# " + std::string(help);
    }
    text_ += line + "\n";
  }
  std::string indent_, text_;
  int depth_;
};

/// Names the fields once, for reading and writing. Help is the unit and the law.
class Fields {
 public:
  explicit Fields(DroneDesign& design) : d_(design), m_(design.model) {}

  void Visit(ConfigVisitor& v) {
    v.Field("name", "", m_.name);
    v.Field("prompt", "the words it was made from", d_.prompt);
    v.Field("class", Help("", "drone_class"), d_.drone_class);
    v.Field("mass", Help("kg", "mass"), m_.mass, 1e-3, 1000);
    v.Group("inertia", Help("kg m^2, about the centre of mass, in B", "inertia"), [&](auto& g) { Inertia(g); });
    v.Group("parts", "kg; for the record, the model above counts", [&](auto& g) { Parts(g); });
    v.Group("propellers", "for the record", [&](auto& g) {
      g.Field("pitch", Help("m", "pitch"), d_.pitch, 0, 10);
      uint64_t blades = static_cast<uint64_t>(d_.blades);
      g.Field("blades", Help("", "blades"), blades);
      d_.blades = static_cast<int>(std::min<uint64_t>(blades, 100));
    });
    v.Group("rotors", Help("", "rotors"), [&](auto& g) { Rotors(g); });
    v.Group("drag", "of the body", [&](auto& g) {
      Vector(g, "linear", Help("N/(m/s)", "linear_drag"), m_.linear_drag_B, 0, 1e4);
      Vector(g, "quadratic", Help("N/(m/s)^2", "quadratic_drag"), m_.quadratic_drag_B, 0, 1e4);
    });
    v.Group("battery", "0 cells = an ideal supply", [&](auto& g) { Battery(g); });
    Vector(v, "half_size", Help("m", "half_size"), m_.half_size_B, 0, 100);
  }

 private:
  std::string_view Help(std::string_view unit, const char* law) {
    const auto found = d_.laws.find(law);
    help_ = std::string(unit);
    if (found != d_.laws.end() && !found->second.empty()) help_ += (help_.empty() ? "" : "; ") + found->second;
    return help_;
  }
  static void Vector(ConfigVisitor& v, std::string_view name, std::string_view help, Vec3d& value, double low, double high) {
    v.Group(name, std::string(help), [&](auto& g) {
      g.Field("x", "", value.x, low, high);
      g.Field("y", "", value.y, low, high);
      g.Field("z", "", value.z, low, high);
    });
  }
  void Inertia(ConfigVisitor& g) {
    auto& J = m_.inertia_B.m;
    g.Field("xx", "", J[0][0], 1e-9, 1e4);
    g.Field("yy", "", J[1][1], 1e-9, 1e4);
    g.Field("zz", "", J[2][2], 1e-9, 1e4);
    g.Field("xy", "", J[0][1], -1e4, 1e4);
    g.Field("xz", "", J[0][2], -1e4, 1e4);
    g.Field("yz", "", J[1][2], -1e4, 1e4);
    J[1][0] = J[0][1];
    J[2][0] = J[0][2];
    J[2][1] = J[1][2];
  }
  void Parts(ConfigVisitor& g) {
    DroneParts& p = d_.parts;
    g.Field("motors", Help("", "motors"), p.motors, 0, 1000);
    g.Field("propellers", Help("", "propellers"), p.propellers, 0, 1000);
    g.Field("guards", Help("", "guards"), p.guards, 0, 1000);
    g.Field("arms", Help("", "arms"), p.arms, 0, 1000);
    g.Field("battery", Help("", "battery"), p.battery, 0, 1000);
    g.Field("body", Help("", "body"), p.body, 0, 1000);
    g.Field("payload", Help("", "payload"), p.payload, 0, 1000);
  }
  void Rotors(ConfigVisitor& g) {
    uint64_t count = m_.rotors.size();
    g.Field("count", "", count);
    if (count < 3 || count > kMaxRotors) {
      throw InputError("rotors: count " + std::to_string(count) + " is not in 3 to " + std::to_string(kMaxRotors));
    }
    m_.rotors.resize(count);
    for (size_t i = 0; i < count; ++i) {
      g.Group("rotor_" + std::to_string(i + 1), "", [&](auto& r) { Rotor(r, m_.rotors[i], i == 0); });
    }
  }
  /// Laws are told with the first rotor only.
  void Rotor(ConfigVisitor& g, RotorModel& r, bool first) {
    const auto help = [&](std::string_view unit, const char* law) { return first ? Help(unit, law) : ""; };
    Vector(g, "position", help("m", "arm"), r.p_B, -100, 100);
    Vector(g, "axis", "", r.axis_B, -1, 1);
    g.Field("direction", first ? "-1: counter-clockwise from above; 1: clockwise" : "", r.direction, -1, 1);
    g.Field("diameter", help("m", "diameter"), r.diameter, 0, 10);
    g.Field("thrust_factor", help("N/(rad/s)^2", "thrust_factor"), r.thrust_factor, 1e-12, 1);
    g.Field("torque_ratio", help("m", "torque_ratio"), r.torque_ratio, 0, 10);
    g.Field("tau_up", help("s", "tau"), r.tau_up, 1e-4, 10);
    g.Field("tau_down", "", r.tau_down, 1e-4, 10);
    g.Field("max_speed", help("rad/s", "max_speed"), r.max_speed, 1, 1e5);
    g.Field("inertia", help("kg m^2", "rotor_inertia"), r.inertia, 0, 10);
    g.Field("in_plane_drag", help("N/(rad/s m/s)", "in_plane_drag"), r.in_plane_drag, 0, 10);
    g.Field("inflow", help("N/(rad/s m/s)", "inflow"), r.inflow, 0, 10);
    g.Field("translational_lift", help("N/(m/s)^2", "translational_lift"), r.translational_lift, 0, 10);
    g.Field("flapping", help("N m/(rad/s m/s)", "flapping"), r.flapping, 0, 10);
  }
  void Battery(ConfigVisitor& g) {
    BatteryModel& b = m_.battery;
    uint64_t cells = static_cast<uint64_t>(b.cells);
    g.Field("cells", Help("", "cells"), cells);
    if (cells > 100) throw InputError("battery: cells " + std::to_string(cells) + " is not in 0 to 100");
    b.cells = static_cast<int>(cells);
    g.Field("capacity_ah", Help("Ah", "capacity_ah"), b.capacity_ah, 0, 1e4);
    g.Field("resistance", Help("ohm", "resistance"), b.resistance, 0, 100);
    g.Field("efficiency", Help("", "efficiency"), b.efficiency, 0.01, 1);
    g.Field("idle_power", Help("W", "idle_power"), b.idle_power, 0, 1e4);
  }

  DroneDesign& d_;
  DroneModel& m_;
  std::string help_;
};

}  // namespace

std::string DroneYaml(const DroneDesign& design) {
  DroneDesign copy = design;
  YamlWriter writer;
  Fields(copy).Visit(writer);
  return "# A drone of airsim360: SI units, body frame +X forward, +Y left, +Z up. What follows a # is the "
         "unit\n"
         "# and the law that the figure came from (docs/internals/drone_laws.md).\n" +
         writer.text();
}

std::string DroneYaml(const DroneModel& model, std::string_view source) {
  DroneDesign design;
  design.model = model;
  if (!source.empty()) design.laws["mass"] = std::string(source);
  return DroneYaml(design);
}

DroneDesign ReadDroneYaml(std::string_view text, std::string_view name) {
  DroneDesign design;
  ReadYaml(text, name, [&](ConfigVisitor& v) { Fields(design).Visit(v); });
  try {
    CheckModel(design.model);
  } catch (const InputError& error) {
    throw InputError(std::string(name) + ": " + error.what());
  }
  return design;
}

DroneDesign ReadDroneFile(const std::filesystem::path& file) { return ReadDroneYaml(ReadTextFile(file, uint64_t{1} << 20), file.string()); }

}  // namespace airsim360

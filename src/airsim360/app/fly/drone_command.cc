// airsim360 drone: a drone from words, from the catalogue or from a file.
#include <cstdio>
#include <memory>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/app/fly/drone_chat.h"
#include "airsim360/app/fly/drone_form.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/flight/control/flight_check.h"
#include "airsim360/flight/drones/catalog.h"
#include "airsim360/flight/prompt/drone_file.h"
#include "airsim360/flight/prompt/gate.h"

namespace airsim360 {
namespace {
namespace fs = std::filesystem;

struct DroneOptions {
  std::string prompt, out, file, real;
  DroneChat chat;
  bool catalog = false, words = false, form = false, check = false;
};

nlohmann::ordered_json VectorJson(Vec3d v) { return {v.x, v.y, v.z}; }

nlohmann::ordered_json RotorJson(const RotorModel& r) {
  return {{"position", VectorJson(r.p_B)},
          {"axis", VectorJson(r.axis_B)},
          {"direction", r.direction},
          {"diameter", r.diameter},
          {"thrust_factor", r.thrust_factor},
          {"torque_ratio", r.torque_ratio},
          {"tau_up", r.tau_up},
          {"tau_down", r.tau_down},
          {"max_speed", r.max_speed},
          {"inertia", r.inertia}};
}

nlohmann::ordered_json DesignJson(const DroneDesign& design) {
  const DroneModel& model = design.model;
  const DroneFigures figures = FiguresOf(model);
  nlohmann::ordered_json rotors, inertia, laws;
  for (const RotorModel& rotor : model.rotors) rotors.push_back(RotorJson(rotor));
  for (const auto& row : model.inertia_B.m) inertia.push_back(row);
  for (const auto& [name, law] : design.laws) laws[name] = law;
  nlohmann::ordered_json json = {{"name", model.name},
                                 {"class", design.drone_class},
                                 {"mass", model.mass},
                                 {"rotors", rotors},
                                 {"inertia", inertia},
                                 {"max_thrust", figures.max_thrust},
                                 {"thrust_to_weight", figures.thrust_to_weight},
                                 {"hover_speed", figures.hover_speed},
                                 {"hover_shaft_power", figures.hover_shaft_power},
                                 {"thrust_coefficient", figures.thrust_coefficient},
                                 {"figure_of_merit", figures.figure_of_merit},
                                 {"tip_mach", figures.tip_mach},
                                 {"half_size", VectorJson(model.half_size_B)},
                                 {"gate", GateProblems(model)}};
  if (design.endurance > 0) {
    json["hover_power"] = design.hover_power;
    json["endurance_s"] = design.endurance;
    json["level_speed"] = design.level_speed;
  }
  if (design.hover_time > 0) {
    json["hover_time_s"] = design.hover_time;
    json["flight_time_s"] = design.flight_time;
    json["wheelbase"] = design.wheelbase;
    json["payload"] = design.parts.payload;
    json["motor_kv"] = design.motor_kv;
    json["battery"] = {{"cells", model.battery.cells}, {"capacity_ah", model.battery.capacity_ah}, {"energy_wh", design.energy_wh}};
  }
  json["unused"] = design.unused;
  json["decided"] = design.decided;
  if (!laws.empty()) json["laws"] = laws;
  return json;
}

nlohmann::ordered_json CheckJson(const FlightCheck& check) {
  return {{"passed", check.passed},          {"amplitude", check.lemniscate.amplitude},
          {"speed", check.lemniscate.speed}, {"rms", check.tracking.rms},
          {"max", check.tracking.max},       {"hover_error", check.hover_error}};
}

void PrintDesign(const DroneDesign& design) {
  const DroneModel& model = design.model;
  const DroneFigures f = FiguresOf(model);
  const auto& J = model.inertia_B.m;
  std::printf("%s\n", model.name.c_str());
  std::printf("  mass            %.4g kg\n", model.mass);
  std::printf("  rotors          %zu, %.0f mm, hover at %.0f rad/s of %.0f\n", model.rotors.size(), model.rotors[0].diameter * 1000,
              f.hover_speed, model.rotors[0].max_speed);
  std::printf("  thrust          %.4g N, %.2f times the weight\n", f.max_thrust, f.thrust_to_weight);
  std::printf("  inertia         %.3g %.3g %.3g kg m^2\n", J[0][0], J[1][1], J[2][2]);
  std::printf("  propellers      C_T %.3f, figure of merit %.2f, tips at Mach %.2f\n", f.thrust_coefficient, f.figure_of_merit, f.tip_mach);
  if (design.endurance > 0) {
    std::printf("  battery         %dS %.3g Ah, hovers %.1f minutes at %.3g W\n", model.battery.cells, model.battery.capacity_ah,
                (design.hover_time > 0 ? design.hover_time : design.endurance) / 60, design.hover_power);
    std::printf("  level speed     %.1f m/s\n", design.level_speed);
  }
  if (design.hover_time > 0) std::printf("  flies           %.1f minutes\n", design.flight_time / 60);
  for (const std::string& sentence : design.decided) std::printf("  decided         %s\n", sentence.c_str());
  std::string unused;
  for (const std::string& word : design.unused) unused += " " + word;
  if (!unused.empty()) std::printf("  not used       %s\n", unused.c_str());
  for (const std::string& problem : GateProblems(model)) std::printf("  implausible     %s\n", problem.c_str());
}

void PrintCatalog(bool json) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CatalogDrone& drone : DroneCatalog()) {
    const DroneModel model = CatalogModel(std::string(drone.name));
    const DroneFigures f = FiguresOf(model);
    if (!json) {
      std::printf("%-20s %7.3f kg  %zu rotors %4.0f mm  T/W %4.1f  %s\n", std::string(drone.name).c_str(), model.mass, model.rotors.size(),
                  model.rotors[0].diameter * 1000, f.thrust_to_weight, std::string(drone.title).c_str());
    }
    list.push_back({{"name", drone.name},
                    {"title", drone.title},
                    {"source", drone.source},
                    {"prompt", drone.prompt},
                    {"mass", model.mass},
                    {"rotors", model.rotors.size()},
                    {"gate", GateProblems(model)}});
  }
  if (json) PrintJson({{"drones", list}});
}

/// The one drone that was asked for.
DroneDesign Chosen(const DroneOptions& options) {
  const int ways = !options.prompt.empty() + !options.file.empty() + !options.real.empty();
  if (ways != 1) {
    throw InputError(
        "drone: give one of a description (\"a 250 g five-inch racing quad\"), --real NAME, --file FILE, "
        "--catalog, --words or --form");
  }
  if (!options.chat.url.empty()) {
    if (options.prompt.empty()) throw InputError("--llm needs a description, which the model reads");
    return DesignDrone(AskForDrone(options.chat, options.prompt));
  }
  if (!options.prompt.empty()) return DroneFromPrompt(options.prompt);
  if (!options.file.empty()) return ReadDroneFile(options.file);
  DroneDesign design;
  design.model = CatalogModel(options.real);
  for (const CatalogDrone& drone : DroneCatalog()) {
    if (drone.name == options.real) design.laws["mass"] = drone.source;
  }
  return design;
}

void RunDrone(const DroneOptions& options, const GlobalOptions& globals) {
  if (options.words) {
    std::printf("%s", PromptHelp().c_str());
    return;
  }
  if (options.form) return PrintJson(DroneFormSchema());
  if (options.catalog) return PrintCatalog(globals.json);
  const DroneDesign design = Chosen(options);
  if (!options.out.empty()) {
    if (const fs::path parent = fs::path(options.out).parent_path(); !parent.empty()) CreateWritableFolder(parent);
    WriteFileAtomically(options.out, DroneYaml(design));
  }

  nlohmann::ordered_json json = DesignJson(design);
  if (!options.out.empty()) json["out"] = options.out;
  if (!globals.json) PrintDesign(design);
  if (options.check) {
    const FlightCheck check = CheckFlight(design.model);
    json["flight"] = CheckJson(check);
    if (!globals.json) {
      std::printf("  flight          lemniscate of %.2f m at %.1f m/s: rms %.2f cm, max %.2f cm: %s\n", check.lemniscate.amplitude,
                  check.lemniscate.speed, check.tracking.rms * 100, check.tracking.max * 100, check.passed ? "passed" : "FAILED");
    }
  }
  if (globals.json) PrintJson(json);
}

}  // namespace

void AddDroneCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("drone", "a drone from words: every parameter with the law it came from");
  const auto options = std::make_shared<DroneOptions>();
  command->add_option("prompt", options->prompt, "description, for example \"a 250 g five-inch racing quad\"");
  command->add_option("--out", options->out, "YAML file to write");
  command->add_option("--real", options->real, "a real drone by its name in the catalogue");
  command->add_option("--file", options->file, "a drone's YAML file to read and report");
  command->add_flag("--catalog", options->catalog, "list the real drones that are known");
  command->add_flag("--words", options->words, "what descriptions may say, and the real drones that are known");
  command->add_flag("--form", options->form, "the form that --llm has filled, as a JSON schema");
  CLI::Option* llm =
      command->add_option("--llm", options->chat.url, "URL of an OpenAI-style chat server whose model reads the description");
  command->add_option("--llm-model", options->chat.model, "name of the model, where the server has several")->needs(llm);
  command->add_option("--llm-key-env", options->chat.key_environment, "name of the environment variable that holds the server's key")
      ->needs(llm);
  command->add_option("--llm-seconds", options->chat.seconds, "seconds that the answer may take (60)")
      ->needs(llm)
      ->check(CLI::Range(1, 3600));
  command->add_flag("--check", options->check, "fly it: hover and the standard lemniscate, untuned");
  command->callback([options, &globals] { RunDrone(*options, globals); });
}

}  // namespace airsim360

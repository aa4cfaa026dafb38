#include "airsim360/app/flags/environment_flags.h"

#include <string>
#include <vector>

namespace airsim360 {

namespace {

std::string Listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

void AddEnvironmentFlags(CLI::App& command, EnvironmentFlags& flags) {
  command.add_option("--weather", flags.weather, "light and weather instead of the world's own: " + Listed(EnvironmentPresetNames()));
  command.add_option("--clouds", flags.clouds, "clouds instead of the world's own: " + Listed(CloudPresetNames()));
  command.add_option("--sky-seed", flags.sky_seed, "draws other clouds of the same kind, 1 … 2^32 - 1 (0: the world's own)");
  command.add_option("--sun", flags.sun, "AZ,EL of the sun: compass and elevation in degrees");
  command.add_option("--time", flags.time, "YYYY-MM-DDTHH:MM[+ZZ:ZZ]: the sun of that time (UTC without an offset), with --place");
  command.add_option("--place", flags.place, "LAT,LON in degrees north and east, with --time");
  command.add_option("--hdri", flags.hdri, "a sky picture (.hdr, .exr) instead of sky, clouds and sun");
  command.add_option("--environment", flags.settings, "name=value,…: single values, for example cloud_cover=0.6,visibility_m=800,lamps=on");
}

std::vector<std::string> EnvironmentFlagNames() {
  CLI::App command;
  command.set_help_flag();
  EnvironmentFlags flags;
  AddEnvironmentFlags(command, flags);
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) names.push_back(option->get_name());
  return names;
}

void AddWindFlag(CLI::App& command, std::string& file) { command.add_option("--wind", file, "wind file (docs/guide/flying.md)"); }

}  // namespace airsim360

#include "airsim360/app/environment_flags.h"

#include <string>

namespace airsim360 {

void AddEnvironmentFlags(CLI::App& command, EnvironmentFlags& flags) {
  std::string presets;
  for (const std::string& name : EnvironmentPresetNames()) presets += (presets.empty() ? "" : ", ") + name;
  command.add_option("--weather", flags.weather, "light and weather instead of the world's own: " + presets);
  command.add_option("--sun", flags.sun, "AZ,EL of the sun: compass and elevation in degrees");
  command.add_option("--time", flags.time,
                     "YYYY-MM-DDTHH:MM[+ZZ:ZZ]: the sun of that time (UTC without an offset), with --place");
  command.add_option("--place", flags.place, "LAT,LON in degrees north and east, with --time");
  command.add_option("--hdri", flags.hdri, "a sky picture (.hdr, .exr) instead of sky, clouds and sun");
  command.add_option("--environment", flags.settings,
                     "name=value,…: single values, for example cloud_cover=0.6,visibility_m=800,lamps=on");
}

void AddWindFlag(CLI::App& command, std::string& file) { command.add_option("--wind", file, "wind file (docs/guide/flying.md)"); }

}  // namespace airsim360

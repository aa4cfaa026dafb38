// airsim360 environments sample: plausible skies and weather, as texts for --environment.
#include <cstdio>
#include <memory>
#include <string>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/scene/environment_sampler.h"

namespace airsim360 {
namespace {

constexpr int kMaxSamples = 1'000'000;

struct Arguments {
  int count = 1;
  bool rural = false;
  Climate climate;
};

void Sample(const Arguments& arguments, const GlobalOptions& globals) {
  if (arguments.count < 1 || arguments.count > kMaxSamples) {
    throw InputError("environments sample: " + std::to_string(arguments.count) + " is not in 1 … " + std::to_string(kMaxSamples));
  }
  Climate climate = arguments.climate;
  climate.urban = !arguments.rural;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (int i = 0; i < arguments.count; ++i) {
    const uint64_t seed = RngStream(globals.seed, "environments", static_cast<uint64_t>(i)).Bits();
    const EnvironmentSample sample = DrawEnvironment(seed, climate);
    const std::string text = DescribeEnvironment(sample.environment);
    if (!globals.json) {
      std::printf("%s\n", text.c_str());
      continue;
    }
    list.push_back({{"environment", text},
                    {"sky", sample.sky},
                    {"season", sample.season},
                    {"month", sample.month},
                    {"day", sample.day},
                    {"solar_hour", sample.solar_hour}});
  }
  if (globals.json) PrintJson(list);
}

}  // namespace

void AddEnvironmentsCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("environments", "skies and weather by climate statistics");
  command->require_subcommand(1);
  CLI::App* sample = command->add_subcommand("sample", "draws plausible environments, one a line: each is a text for --environment");
  auto arguments = std::make_shared<Arguments>();
  sample->add_option("count", arguments->count, "how many (default 1)");
  sample->add_option("--latitude", arguments->climate.latitude_deg, "degrees north, -70 … 70 (default 45)");
  sample->add_option("--min-sun", arguments->climate.least_sun_elevation_deg, "the sun is at least so high, degrees, -90 … 20 (default 2)");
  sample->add_flag("--rural", arguments->rural, "the clearer air of the country");
  sample->callback([arguments, &globals] { Sample(*arguments, globals); });
}

}  // namespace airsim360

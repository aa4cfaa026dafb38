// airsim360 serve: the AirSim-compatible server, until SIGINT or SIGTERM.
#include <cstdio>
#include <memory>
#include <optional>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/app/flags/config_flags.h"
#include "airsim360/app/flags/environment_flags.h"
#include "airsim360/app/flags/people_arguments.h"
#include "airsim360/app/flags/session.h"
#include "airsim360/app/flags/stop_signals.h"
#include "airsim360/app/flags/traffic_arguments.h"
#include "airsim360/app/flags/world_flags.h"
#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/rpc/server.h"
#include "airsim360/worlds/props/props.h"

namespace airsim360 {
namespace {

struct ServeArguments {
  std::string world, settings, host, wind;
  RenderSettings picture;
  std::optional<int> port;
  PeopleArguments people;
  TrafficArguments traffic;
  bool realtime = false, lockstep = false;
  EnvironmentFlags environment;
};

// What can be wrong with the flags.
void Check(const ServeArguments& arguments) {
  if (arguments.realtime && arguments.lockstep) {
    throw InputError("--lockstep: time passes by the wall clock (--realtime) or by calls (--lockstep), not both");
  }
  if (arguments.port && (*arguments.port < 0 || *arguments.port > 65535)) {
    throw InputError("--port: " + std::to_string(*arguments.port) + " is not in 0 (any free one) ... 65535");
  }
}

// Shapes, and props of our worlds that need no pictures: what simSpawnObject can make.
std::vector<SpawnAsset> AssetsOf(uint64_t seed) {
  std::vector<SpawnAsset> assets = ShapeAssets();
  for (const char* name : {"bench_wood", "dining_chair", "dining_table", "fire_hydrant", "mailbox", "trash_can", "traffic_barrel",
                           "road_block", "car", "van"}) {
    const PropKind& kind = FindPropKind(name);
    Model model = MakeProp(kind, 0, seed, nullptr);
    if (model.textures.empty()) assets.push_back({name, std::string(kind.category), std::move(model)});
  }
  return assets;
}

ServerOptions OptionsOf(const ServeArguments& arguments, const GlobalOptions& globals) {
  ServerOptions options;
  if (!arguments.settings.empty()) options.settings = ReadSettings(arguments.settings);
  options.address = arguments.host.empty() ? options.settings.local_host_ip : arguments.host;
  options.port = arguments.port.value_or(options.settings.port);
  options.lockstep = arguments.lockstep;
  CheckRenderSettings(arguments.picture, "--");
  options.picture = arguments.picture;
  options.picture.seed = globals.seed;
  options.assets = AssetsOf(globals.seed);
  return options;
}

void Serve(const ServeArguments& arguments, const GlobalOptions& globals) {
  Check(arguments);
  const ServerOptions options = OptionsOf(arguments, globals);
  StageOptions world = StageOptionsOf(arguments.world, globals, arguments.environment, arguments.people.Request(globals.seed),
                                      arguments.traffic.Request(globals.seed));
  world.wind = ReadWindFile(arguments.wind);
  world.bodies = ServedBodies(options);
  const auto stage = std::make_shared<Stage>(world);
  stage->tracer();

  const AirSimServer server(stage, options);
  // Not before the server is there, which may have rooms to light first: until then Ctrl-C ends the program at once.
  const StopSignals stop;
  LogInfo(arguments.world + ": ready after " + ClockText(stage->load_seconds()));
  if (globals.json) {
    PrintJson({{"address", options.address}, {"port", server.port()}, {"functions", server.Methods()}});
  } else {
    std::printf("listening on %s:%d\n", options.address.empty() ? "0.0.0.0" : options.address.c_str(), server.port());
  }
  std::fflush(stdout);
  stop.Wait();
  EndWithin(kLastJob);
}

}  // namespace

void AddServeCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("serve", "a server that AirSim's clients can fly in (docs/guide/airsim_server.md)");
  auto arguments = std::make_shared<ServeArguments>();
  command->add_option("--world", arguments->world, "name or file of the world")->required();
  command->add_option("--settings", arguments->settings, "AirSim's settings.json: vehicles, cameras, sensors, …");
  command->add_option("--port", arguments->port, "TCP port, 0 = any free one (default: of the settings, 41451)");
  command->add_option("--host", arguments->host, "IPv4 address to listen on (default 127.0.0.1)");
  arguments->people.AddTo(*command);
  arguments->traffic.AddTo(*command);
  AddConfigFlags(*command, [arguments](ConfigVisitor& v) { arguments->picture.Visit(v); });
  command->add_flag("--realtime", arguments->realtime, "time passes with the wall clock (default)");
  command->add_flag("--lockstep", arguments->lockstep,
                    "time passes only in simContinueForTime and simContinueForFrames, as fast as it can");
  AddWindFlag(*command, arguments->wind);
  AddEnvironmentFlags(*command, arguments->environment);
  AddWorldFlags(*command, globals);
  command->callback([arguments, &globals] { Serve(*arguments, globals); });
}

}  // namespace airsim360

// airsim360 view: datasets and worlds in the browser, until SIGINT or SIGTERM; or as files.
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <thread>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/app/flags/config_flags.h"
#include "airsim360/app/flags/environment_flags.h"
#include "airsim360/app/flags/people_arguments.h"
#include "airsim360/app/flags/session.h"
#include "airsim360/app/flags/stop_signals.h"
#include "airsim360/app/flags/traffic_arguments.h"
#include "airsim360/app/flags/world_flags.h"
#include "airsim360/app/view/followed_agent.h"
#include "airsim360/app/view/followed_server.h"
#include "airsim360/app/view/viewed_run.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/base/steady_clock.h"
#include "airsim360/opening/world_exists.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/view/coming_world.h"
#include "airsim360/view/live_world.h"
#include "airsim360/view/view_site.h"
#include "airsim360/view/viewed_plan.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

struct ViewArguments {
  FollowOptions follow;
  std::string what, compare, world, record, drone = "hummingbird", out, wind, episodes;
  RenderSettings picture;
  EnvironmentFlags environment;
  PeopleArguments people;
  TrafficArguments traffic;
  int port = 8360;
  bool is_plan = false, is_run = false;
};

// The next folder of a record that is not there yet: DIR/000, DIR/001, …
fs::path NextFolder(const fs::path& record) {
  for (int i = 0;; ++i) {
    const std::string digits = std::to_string(i);
    const fs::path folder = record / (std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits);
    if (!fs::exists(folder)) return folder;
  }
}

// What was kept in the browser becomes a dataset like any other.
std::string Save(Stage& stage, const ViewArguments& arguments, const GlobalOptions& globals, const Flight& kept,
                 const Environment& environment) {
  DatasetSpec spec;
  static_cast<RenderSettings&>(spec) = arguments.picture;
  DescribeRun("view", arguments.world, globals, spec);
  spec.people = arguments.people.Describe();
  spec.traffic = arguments.traffic.Describe();
  spec.environment = DescribeEnvironment(environment);
  spec.pano_frame = PanoFrame::kLevel;
  spec.frames = static_cast<int64_t>(kept.shots.size());
  spec.route = "flown by hand";
  const fs::path out = NextFolder(arguments.record);
  Collect(InputOf(stage, spec, kept, out), *stage.NewRenderer(spec.tier, environment));
  return out.string();
}

std::shared_ptr<LiveWorld> OpenLive(const std::shared_ptr<const ViewArguments>& arguments, const GlobalOptions& globals) {
  StageOptions wanted = StageOptionsOf(arguments->world, globals, arguments->environment, arguments->people.Request(globals.seed),
                                       arguments->traffic.Request(globals.seed));
  wanted.wind = ReadWindFile(arguments->wind);
  const auto stage = std::make_shared<Stage>(wanted);
  LiveOptions options{.picture = arguments->picture, .drone = arguments->drone, .clock = SteadySeconds};
  const fs::path file = arguments->world;
  options.source = fs::exists(file) ? fs::absolute(file).string() : arguments->world;
  if (file.extension() == ".yaml" || file.extension() == ".yml") options.source_text = ReadTextFile(file);
  if (!arguments->record.empty()) {
    options.save = [stage, arguments, &globals](const Flight& kept, const Environment& environment) {
      return Save(*stage, *arguments, globals, kept, environment);
    };
  }
  return std::make_shared<LiveWorld>(stage, std::move(options));
}

// Flights of language navigation, which need the episodes that were flown.
void UnderstandRun(ViewArguments& arguments) {
  const std::string& file = arguments.what;
  if (arguments.episodes.empty())
    throw InputError("--episodes: '" + file +
                     "' holds flights of 'vln run'; give the episodes.jsonl that was flown (a CityJSON world: --world)");
  for (const auto& [flag, value] :
       {std::pair{"--compare", &arguments.compare}, {"--export", &arguments.out}, {"--record", &arguments.record}})
    if (!value->empty())
      throw InputError(std::string(flag) + ": '" + file + "' holds flights, whose pictures are drawn when they are looked at");
  arguments.is_run = true;
}

// A folder is a dataset; everything else is a world, as for all commands.
void Understand(ViewArguments& arguments) {
  if (arguments.port < 0 || arguments.port > 65535)
    throw InputError("--port: " + std::to_string(arguments.port) + " is not in 0 (any free one) ... 65535");
  if (!arguments.follow.address.empty()) {
    if (!arguments.what.empty() || !arguments.world.empty()) throw InputError("--connect: give a server, or a dataset or world, not both");
    for (const auto& [flag, value] :
         {std::pair{"--compare", &arguments.compare}, {"--export", &arguments.out}, {"--record", &arguments.record}})
      if (!value->empty())
        throw InputError(std::string(flag) + ": the world is in the server at " + arguments.follow.address +
                         "; it cannot be given with --connect");
    return;
  }
  for (const auto& [flag, given] : {std::pair{"--lease", arguments.follow.lease},
                                    {"--vehicle", !arguments.follow.vehicle.empty()},
                                    {"--episode", !arguments.follow.episode.empty()}})
    if (given) throw InputError(std::string(flag) + ": it goes with --connect HOST:PORT");
  if (!arguments.what.empty() && !arguments.world.empty()) throw InputError("--world: give a dataset or a world, not both");
  if (arguments.what.ends_with(".jsonl") && !arguments.what.ends_with(".city.jsonl")) return UnderstandRun(arguments);
  if (!arguments.episodes.empty()) throw InputError("--episodes: it goes with results.jsonl of 'airsim360 vln run'");
  if (arguments.what.ends_with(".json") && !arguments.what.ends_with(".city.json")) {
    if (!arguments.compare.empty()) throw InputError("--compare: compares datasets; '" + arguments.what + "' is a plan");
    if (!arguments.out.empty())
      throw InputError(
          "--export: '" + arguments.what +
          "' is a plan, whose frames are drawn when they are looked at; make a dataset of it with 'airsim360 dataset run' first");
    arguments.is_plan = true;
    return;
  }
  if (!arguments.what.empty() && !fs::is_directory(arguments.what)) std::swap(arguments.what, arguments.world);
  if (arguments.what.empty() && arguments.world.empty())
    throw InputError("view: what? Give the folder of a dataset, a file of a world, or --world W");
  if (arguments.what.empty() && !arguments.compare.empty()) throw InputError("--compare: needs a dataset to compare with");
  if (arguments.what.empty() && !arguments.out.empty())
    throw InputError("--export: '" + arguments.world + "' is no folder of a dataset; worlds need the server");
  if (arguments.world.empty() && !arguments.record.empty()) throw InputError("--record: records a live world; give --world W");
}

// Flags of a world that is opened here are not accepted and ignored beside a dataset or a server.
void CheckBelonging(const CLI::App& command, const ViewArguments& arguments) {
  const bool follows = !arguments.follow.address.empty();
  if (!follows && (arguments.what.empty() || arguments.is_run || arguments.is_plan)) return;
  RenderSettings picture;
  std::vector<std::string> flags = ConfigFlagNames([&picture](ConfigVisitor& v) { picture.Visit(v); });
  std::ranges::copy(EnvironmentFlagNames(), std::back_inserter(flags));
  flags.insert(flags.end(), {"--people", "--traffic", "--wind", "--drone"});
  for (const std::string& flag : flags) {
    if (command.count(flag) == 0) continue;
    throw InputError(flag + ": it is of --world, " +
                     (follows ? "not of --connect" : "and '" + arguments.what + "' is a dataset, whose pictures are there"));
  }
}

std::shared_ptr<LiveSource> Follow(const FollowOptions& options) {
  if (IsAirSimServer(options.address)) {
    if (!options.episode.empty())
      throw InputError("--episode: 'airsim360 serve' answers at " + options.address + ", which has no episodes; give --vehicle");
    return std::make_shared<FollowedServer>(options);
  }
  if (!IsAgentServer(options.address))
    throw RuntimeError("--connect: what answers at " + options.address + " is neither 'airsim360 serve' nor 'airsim360 agent'");
  return std::make_shared<FollowedAgent>(options);
}

ViewSite SiteOf(const std::shared_ptr<ViewArguments>& arguments, const GlobalOptions& globals) {
  if (!arguments->follow.address.empty()) return ViewSite({}, Follow(arguments->follow), NewToken());
  if (arguments->is_plan) return ViewSite(std::make_shared<ViewedPlan>(arguments->what, DeviceChoice{globals.device, globals.gpu}));
  if (arguments->is_run) {
    ViewedRunOptions options{.episodes = arguments->episodes, .picture = arguments->picture};
    options.open = [&globals](const std::string& world, uint64_t seed, int64_t people) {
      GlobalOptions of_seed = globals;
      of_seed.seed = seed;
      return std::make_shared<Stage>(
          StageOptionsOf(world, of_seed, {},
                         PeopleRequest{.count = people > 0 ? std::optional(static_cast<size_t>(people)) : std::nullopt, .seed = seed}));
    };
    return ViewSite(std::make_shared<ViewedRun>(arguments->what, std::move(options)));
  }
  std::vector<std::shared_ptr<ViewedDataset>> datasets{std::make_shared<ViewedDataset>(arguments->what)};
  if (!arguments->compare.empty()) datasets.push_back(std::make_shared<ViewedDataset>(arguments->compare));
  return ViewSite(std::move(datasets));
}

void SayListening(int port, bool json) {
  if (json) {
    PrintJson({{"address", "127.0.0.1"}, {"port", port}});
  } else {
    std::printf("listening on http://127.0.0.1:%d\n", port);
  }
  std::fflush(stdout);
}

// Serves until a signal comes; `open` runs meanwhile, and what it throws ends the server.
void Serve(const ViewSite& site, const HttpServerOptions& options, bool json, const std::function<void()>& open = {}) {
  HttpHandlers handlers{.request = [&site](const HttpRequest& request) { return site.Answer(request); }};
  if (!options.socket_target.empty()) handlers.message = [&site](const std::string& message) { return site.AnswerMessage(message); };
  const StopSignals stop;
  std::exception_ptr error;
  std::atomic<bool> failed = false;
  {
    const HttpServer server(std::move(handlers), options);
    SayListening(server.port(), json);
    std::jthread opening([&] {
      try {
        if (open) open();
      } catch (...) {
        error = std::current_exception();
        failed = true;
        stop.Stop();
      }
    });
    stop.Wait();
    if (!failed) EndWithin(kLastJob);
  }
  if (error) std::rethrow_exception(error);
}

// The page is served while its world is opened, which takes seconds for a town, and a minute the first time.
void ServeWorld(const std::shared_ptr<ViewArguments>& arguments, const GlobalOptions& globals) {
  CheckRenderSettings(arguments->picture, "--");
  if (!WorldExists(arguments->world)) LoadWorld(RequestOf(arguments->world, globals));  // says what there is
  const auto coming = std::make_shared<ComingWorld>(arguments->world);
  const ViewSite site({}, coming, NewToken());
  Serve(site, ViewServerOptions(arguments->port), globals.json, [&] {
    try {
      coming->Come(OpenLive(arguments, globals));
    } catch (...) {
      coming->Fail();
      throw;
    }
  });
}

void RunView(const CLI::App& command, const std::shared_ptr<ViewArguments>& arguments, const GlobalOptions& globals) {
  // Pictures of many sizes come and go for hours: each lies in pages of its own, which go back when it goes. Otherwise malloc
  // raises this limit with the first large ones, and what is left between later ones is never given back.
  ::mallopt(M_MMAP_THRESHOLD, 256 << 10);
  Understand(*arguments);
  CheckBelonging(command, *arguments);
  if (!arguments->world.empty()) return ServeWorld(arguments, globals);
  const ViewSite site = SiteOf(arguments, globals);
  HttpServerOptions options = ViewServerOptions(arguments->port);
  if (arguments->follow.address.empty()) options.socket_target.clear();
  if (arguments->out.empty()) return Serve(site, options, globals.json);
  site.Write(arguments->out);
  if (globals.json)
    PrintJson({{"out", arguments->out}});
  else
    std::printf("%s\n", (fs::path(arguments->out) / "index.html").c_str());
}

}  // namespace

void AddViewCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("view", "datasets and worlds in the browser (docs/guide/viewer.md)");
  auto arguments = std::make_shared<ViewArguments>();
  command->add_option(
      "WHAT", arguments->what,
      "folder of a dataset or of a flight, a plan (.json), flights of 'vln run' (.jsonl), or a file of a world (.glb, .osm, .yaml, …)");
  command->add_option("--compare", arguments->compare, "folder of a second dataset, side by side");
  command->add_option("--world", arguments->world, "name or file of a world to fly in");
  command->add_option("--connect", arguments->follow.address,
                      "HOST:PORT of a running 'airsim360 serve' or 'airsim360 agent', to look at its world");
  command->add_flag("--lease", arguments->follow.lease,
                    "with --connect: take the drone and fly it from the page; an AirSim server gets API control back at the end");
  command->add_option("--vehicle", arguments->follow.vehicle, "with --connect to an AirSim server: whose eyes (default: the first)");
  command->add_option("--episode", arguments->follow.episode,
                      "with --connect to an agent server: which episode, e1 (default: always the newest)");
  command->add_option("--episodes", arguments->episodes, "with results.jsonl of 'vln run': the episodes that were flown");
  command->add_option("--port", arguments->port, "TCP port, 0 = any free one (default 8360)");
  command->add_option("--export", arguments->out, "write the page and the datasets into this new folder, for any server of files, and end");
  command->add_option("--record", arguments->record, "folder into which frames kept in the browser are saved, a dataset each time");
  command->add_option("--drone", arguments->drone, "name of the drone that is flown (default hummingbird)");
  AddConfigFlags(*command, [arguments](ConfigVisitor& v) { arguments->picture.Visit(v); });
  arguments->people.AddTo(*command);
  arguments->traffic.AddTo(*command);
  AddWindFlag(*command, arguments->wind);
  AddEnvironmentFlags(*command, arguments->environment);
  AddWorldFlags(*command, globals);
  command->callback([arguments, command, &globals] { RunView(*command, arguments, globals); });
}

}  // namespace airsim360

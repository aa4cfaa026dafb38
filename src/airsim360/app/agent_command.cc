// airsim360 agent: navigation episodes over HTTP and WebSocket, until SIGINT or SIGTERM.
#include <chrono>
#include <cstdio>
#include <memory>

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
#include "airsim360/base/steady_clock.h"
#include "airsim360/tasks/agent_server/agent_server.h"
#include "airsim360/vln/episodes/language_episode.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

struct AgentArguments {
  std::string world, tasks, host = "127.0.0.1", wind;
  RenderSettings picture;
  int port = 8361, episodes = 64;
  bool realtime = false, tells_goal = false;
  EnvironmentFlags environment;
  PeopleArguments people;
  TrafficArguments traffic;
};

// A world that can be looked at at once. Its renderer says how far the light of rooms is, which takes tens of seconds.
std::shared_ptr<AgentWorld> OpenForAgents(const StageOptions& options, const RenderSettings& picture) {
  const auto stage = std::make_shared<Stage>(options);
  stage->renderer(picture.tier);  // now, and not when the first agent waits for a picture
  LogInfo(options.world.world + ": ready after " + ClockText(stage->load_seconds()));
  return std::make_shared<AgentWorld>(stage, picture);
}

// Episodes of `vln make`, as tasks.
std::vector<AgentTask> TasksOf(const std::string& file, bool tells_goal) {
  std::vector<AgentTask> tasks;
  for (const LanguageEpisode& e : ReadEpisodes(file)) {
    EpisodeSpec spec = SpecOf(e);
    spec.tells_goal = tells_goal;
    tasks.push_back({e.id, {e.world, e.world_seed, e.people, e.weather}, std::move(spec)});
  }
  return tasks;
}

AgentApiOptions OptionsOf(const AgentArguments& arguments, const GlobalOptions& globals) {
  AgentApiOptions api{.world = arguments.world, .world_seed = globals.seed};
  for (const WorldInfo& world : ListWorlds()) api.worlds.push_back(world.name);
  if (!arguments.tasks.empty()) api.tasks = TasksOf(arguments.tasks, arguments.tells_goal);
  if (api.world.empty()) api.world = api.tasks.empty() ? "" : api.tasks.front().world.name;
  if (api.world.empty()) throw InputError("--world: give a world, or --tasks EPISODES.jsonl");
  StageOptions options = StageOptionsOf(api.world, globals, arguments.environment, arguments.people.Request(globals.seed),
                                        arguments.traffic.Request(globals.seed));
  options.wind = ReadWindFile(arguments.wind);
  CheckRenderSettings(arguments.picture, "--");
  api.open = [picture = arguments.picture, options](const AgentWorldKey& key) {
    StageOptions stage = options;
    stage.world.world = key.name;
    stage.world.seed = key.seed;
    if (key.people.value_or(0) > 0 && !stage.people.any()) stage.people = {.count = static_cast<size_t>(*key.people), .seed = key.seed};
    if (!key.weather.empty() && stage.environment.weather.empty()) stage.environment.weather = key.weather;
    return OpenForAgents(stage, picture);
  };
  api.realtime = arguments.realtime;
  api.clock = SteadySeconds;
  api.max_episodes = static_cast<size_t>(arguments.episodes);
  return api;
}

void Serve(const AgentArguments& arguments, const GlobalOptions& globals) {
  if (arguments.port < 0 || arguments.port > 65535)
    throw InputError("--port: " + std::to_string(arguments.port) + " is not in 0 (any free one) ... 65535");
  if (arguments.episodes < 1 || arguments.episodes > 1024)
    throw InputError("--episodes: " + std::to_string(arguments.episodes) + " is not in 1 ... 1024");
  AgentApi api(OptionsOf(arguments, globals));
  // Not before the world is there: until then Ctrl-C ends the program at once.
  const StopSignals stop;
  const AgentServer server(api, {.address = arguments.host, .port = arguments.port});
  if (globals.json) {
    PrintJson({{"address", arguments.host}, {"port", server.port()}});
  } else {
    std::printf("listening on http://%s:%d\n", arguments.host.c_str(), server.port());
  }
  std::fflush(stdout);
  stop.Wait();
  EndWithin(kLastJob);
}

}  // namespace

void AddAgentCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("agent", "navigation episodes for VLA/VLM models over HTTP and WebSocket (docs/guide/agents.md)");
  auto arguments = std::make_shared<AgentArguments>();
  command->add_option("--world", arguments->world, "name or file of the world of episodes that name none");
  command->add_option("--tasks", arguments->tasks,
                      "episodes.jsonl of vln make, which episodes can ask for by name; their goals are not told");
  command->add_flag("--tell-goal", arguments->tells_goal, "tell the goals of tasks, and how far they are");
  command->add_option("--port", arguments->port, "TCP port, 0 = any free one (default 8361)");
  command->add_option("--host", arguments->host, "IPv4 address to listen on (default 127.0.0.1)");
  AddConfigFlags(*command, [arguments](ConfigVisitor& v) { arguments->picture.Visit(v); });
  command->add_option("--episodes", arguments->episodes, "most episodes open at a time (default 64)");
  command->add_flag("--realtime", arguments->realtime,
                    "what an agent takes to think passes in its episode too; else time passes in actions alone");
  arguments->people.AddTo(*command);
  arguments->traffic.AddTo(*command);
  AddWindFlag(*command, arguments->wind);
  AddEnvironmentFlags(*command, arguments->environment);
  AddWorldFlags(*command, globals);
  command->callback([arguments, &globals] { Serve(*arguments, globals); });
}

}  // namespace airsim360

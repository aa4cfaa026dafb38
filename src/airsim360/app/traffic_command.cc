// airsim360 traffic: how the vehicles of a world get on, and who nearly met whom.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/app/flags/people_arguments.h"
#include "airsim360/app/flags/session.h"
#include "airsim360/app/flags/traffic_arguments.h"
#include "airsim360/app/flags/world_flags.h"
#include "airsim360/base/error.h"
#include "airsim360/sim/living_world.h"
#include "airsim360/sim/traffic/traffic.h"
#include "airsim360/sim/traffic_survey.h"

namespace airsim360 {
namespace {

constexpr double kLongestSurvey = 86400;  // simulated seconds

struct SurveyArguments {
  std::string world = "downtown_west";
  double seconds = 600;
  PeopleArguments people;
  TrafficArguments traffic{.count = 100};
};

// How many near misses vehicles had with others of a kind.
int64_t CountWith(const TrafficSurvey& survey, RoadUser::Kind kind) {
  return std::ranges::count_if(survey.near_misses, [&](const NearMiss& miss) { return miss.b.kind == kind; });
}

nlohmann::ordered_json SurveyJson(const SurveyArguments& arguments, const SimModel& model, const TrafficSurvey& survey) {
  nlohmann::ordered_json misses = nlohmann::ordered_json::array();
  for (const NearMiss& miss : survey.near_misses)
    misses.push_back({{"t_s", static_cast<double>(miss.t_ns) * 1e-9},
                      {"first", NameOfRoadUser(model, miss.a)},
                      {"second", NameOfRoadUser(model, miss.b)},
                      {"time_to_collision", miss.seconds},
                      {"braking", miss.braking},
                      {"p", {miss.p.x, miss.p.y, miss.p.z}}});
  return {{"world", arguments.world},
          {"vehicles", model.traffic->bodies.size()},
          {"people", model.people ? model.people->cast.size() : 0},
          {"seconds", survey.seconds},
          {"mean_speed", survey.mean_speed},
          {"standing", survey.standing},
          {"longest_standstill", survey.longest_standstill},
          {"hardest_braking", survey.hardest_braking},
          {"overlaps", survey.overlaps},
          {"people_hit", survey.people_hit},
          {"near_misses_of_vehicles", CountWith(survey, RoadUser::Kind::kVehicle)},
          {"near_misses_with_people", CountWith(survey, RoadUser::Kind::kPerson)},
          {"near_misses", std::move(misses)},
          {"tick_ms", survey.tick_ms},
          {"people_tick_ms", survey.people_ms}};
}

void PrintSurvey(const SurveyArguments& arguments, const SimModel& model, const TrafficSurvey& survey) {
  std::printf("%s: %zu vehicles, %zu people, %.0f s\n", arguments.world.c_str(), model.traffic->bodies.size(),
              model.people ? model.people->cast.size() : 0, survey.seconds);
  std::printf("mean speed          %6.1f m/s, %.0f %% stand\n", survey.mean_speed, 100 * survey.standing);
  std::printf("longest standstill  %6.0f s\n", survey.longest_standstill);
  std::printf("hardest braking     %6.1f m/s2\n", survey.hardest_braking);
  std::printf("overlaps            %6lld of vehicles, %lld of people\n", static_cast<long long>(survey.overlaps),
              static_cast<long long>(survey.people_hit));
  std::printf("near misses         %6lld of vehicles, %lld with people\n",
              static_cast<long long>(CountWith(survey, RoadUser::Kind::kVehicle)),
              static_cast<long long>(CountWith(survey, RoadUser::Kind::kPerson)));
  constexpr size_t kShown = 10;
  for (size_t i = 0; i < std::min(kShown, survey.near_misses.size()); ++i)
    std::printf("  t %8.1f s  %s\n", static_cast<double>(survey.near_misses[i].t_ns) * 1e-9,
                TextOfNearMiss(model, survey.near_misses[i]).c_str());
  if (survey.near_misses.size() > kShown) std::printf("  … all of them with --json\n");
  std::printf("a tick takes        %6.3f ms, of the people %.3f ms\n", survey.tick_ms, survey.people_ms);
}

void RunSurvey(const SurveyArguments& arguments, const GlobalOptions& globals) {
  if (arguments.traffic.count < 1) throw InputError("--traffic: without vehicles there is nothing to survey; give at least 1");
  if (CheckPositive("--seconds", arguments.seconds) > kLongestSurvey)
    throw InputError("--seconds: " + std::to_string(arguments.seconds) + " is more than a day");
  Stage stage(
      StageOptionsOf(arguments.world, globals, {}, arguments.people.Request(globals.seed), arguments.traffic.Request(globals.seed)));
  const SimModel model = stage.Model();
  const TrafficSurvey survey = SurveyTraffic(model, arguments.seconds);
  if (globals.json)
    PrintJson(SurveyJson(arguments, model, survey));
  else
    PrintSurvey(arguments, model, survey);
}

}  // namespace

void AddTrafficCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command =
      app.add_subcommand("traffic", "how the vehicles of a world get on: speeds, standstills, near misses (docs/guide/traffic.md)");
  auto arguments = std::make_shared<SurveyArguments>();
  command->add_option("--world", arguments->world, "name or file of a world (default downtown_west)");
  command->add_option("--seconds", arguments->seconds, "simulated time (default 600)");
  arguments->people.AddTo(*command);
  arguments->traffic.AddTo(*command);
  command->get_option("--traffic")->description("vehicles that drive on the roads of the world (default 100)");
  AddWorldFlags(*command, globals);
  command->callback([arguments, &globals] { RunSurvey(*arguments, globals); });
}

}  // namespace airsim360

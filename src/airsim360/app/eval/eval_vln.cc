// airsim360 eval vln: scores of flown paths.
#include <memory>
#include <optional>
#include <set>

#include "airsim360/app/eval/eval_commands.h"
#include "airsim360/app/eval/eval_views.h"
#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/eval/files/vln_file.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

struct VlnArguments {
  std::string episodes, results, protocol = "ours";
  std::optional<double> radius;
  bool force = false;
  ReportOptions report;
};

std::vector<double> MeanFigures(const std::vector<VlnScore>& scores, std::span<const uint32_t> draws = {}) {
  std::vector<double> sums(kVlnFigures.size(), 0);
  double count = 0;
  for (size_t i = 0; i < scores.size(); ++i) {
    const double times = draws.empty() ? 1 : draws[i];
    const auto figures = Figures(scores[i]);
    for (size_t f = 0; f < sums.size(); ++f) sums[f] += times * figures[f];
    count += times;
  }
  for (double& sum : sums) sum /= count;
  return sums;
}

void WriteTable(const std::string& path, const std::vector<NamedVlnEpisode>& episodes, const std::vector<VlnScore>& scores) {
  std::vector<std::vector<std::string>> rows = {{"id"}};
  for (const auto name : kVlnFigures) rows[0].emplace_back(name);
  for (size_t i = 0; i < scores.size(); ++i) {
    auto& row = rows.emplace_back(std::vector<std::string>{episodes[i].id});
    for (const double value : Figures(scores[i])) row.push_back(NumberText(value));
  }
  WriteCsv(path, rows);
}

void Run(const VlnArguments& a, const GlobalOptions& globals) {
  const VlnProtocol& protocol = FindVlnProtocol(a.protocol);
  if (a.radius) CheckPositive("--radius", *a.radius);
  const std::string results = a.results.empty() ? a.episodes : a.results;
  const auto episodes = ReadVlnFiles(a.episodes, results, a.radius);
  std::set<double> radii;
  size_t elsewhere = 0;
  for (const auto& [id, e] : episodes) {
    radii.insert(*e.radius);
    elsewhere += Norm(e.flown.front() - e.reference.front()) > *e.radius;
  }
  const auto scores = MeasureAll<VlnScore>("eval vln", episodes.size(), [&](size_t i) {
    try {
      return ScoreVln(episodes[i].episode, *episodes[i].episode.radius, protocol);
    } catch (const InputError& error) {
      throw InputError("episode '" + episodes[i].id + "': " + error.what());
    }
  });
  Json json;
  JudgeMistakes({{results, VlnUnitMistake(episodes)}}, a.force, json);
  const std::vector<double> means = MeanFigures(scores);
  const std::vector<std::string> names(kVlnFigures.begin(), kVlnFigures.end());
  for (size_t f = 0; f < names.size(); ++f) json[names[f]] = means[f];
  json["episodes"] = episodes.size();
  json["radius"] = radii.size() == 1 ? Json(*radii.begin()) : Json(std::vector<double>(radii.begin(), radii.end()));
  json["protocol"] = a.protocol;
  double collisions = 0;
  for (const auto& one : episodes) collisions += one.episode.collided;
  json["collision_rate"] = collisions / static_cast<double>(episodes.size());
  AppendIntervals(json, a.report, globals.seed, scores.size(), names,
                  [&](std::span<const uint32_t> draws) { return MeanFigures(scores, draws); });
  json["notes"].push_back(std::string(protocol.name) + ": " + std::string(protocol.quirk));
  if (2 * elsewhere > episodes.size())
    json["warnings"].push_back(
        results + ": " + std::to_string(elsewhere) + " of " + std::to_string(episodes.size()) +
        " flown paths begin farther than the radius from where their reference begins: are they in another frame or of "
        "other episodes?");
  WriteTable(a.report.csv, episodes, scores);
  if (globals.json)
    PrintJson(json);
  else
    PrintFigures(json);
}

}  // namespace

void AddEvalVln(CLI::App& command, GlobalOptions& globals) {
  CLI::App* vln = command.add_subcommand("vln", "scores of navigation by instruction: SR, OSR, SPL, NE, nDTW, sDTW, CLS");
  const auto a = std::make_shared<VlnArguments>();
  vln->add_option("episodes", a->episodes, ".json or .jsonl with the reference path `ref` of every `id`")->required();
  vln->add_option("results", a->results, "the same ids with the flown path `pred` (default: the first file holds both)");
  vln->add_option("--radius", a->radius, "metres from the goal that count as success (default: what the episodes say, or 20)");
  vln->add_option("--protocol", a->protocol, "ours, aerialvln, openfly, citynav-mgp, citynav-vlnce, traveluav or uavon");
  AddForceFlag(*vln, a->force);
  AddReportFlags(*vln, a->report, "a row an episode");
  vln->callback([a, &globals] { Run(*a, globals); });
}

}  // namespace airsim360

// airsim360 mpde: distance and orientation of people from their keypoints, learned.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <numbers>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/app/flags/config_flags.h"
#include "airsim360/app/flags/out_file.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/dataset/people/human_splits.h"
#include "airsim360/mpde/data_name.h"
#include "airsim360/mpde/evaluate.h"
#include "airsim360/mpde/table.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

struct TrainArguments {
  std::vector<std::string> data;
  std::string out, views, convention;
  MpdeTraining training;
};

struct EvalArguments {
  std::vector<std::string> models;
  std::string data, views, convention, out, truth;
  uint64_t count = 4000;
};

struct TableArguments {
  std::vector<std::string> real;
  std::string out;
  MpdeTableOptions options;
};

// JSON has no NaN: a mean over nobody is null.
Json NumberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

void RunTrain(TrainArguments arguments, const GlobalOptions& globals) {
  arguments.training.seed = globals.seed;
  const std::vector<ViewDraw> views = ParseViews(arguments.views, arguments.convention);
  std::vector<MpdeSet> sets;
  Json list = Json::array();
  for (const std::string& text : arguments.data) {
    for (MpdeSet& set : ReadTrainingSets(ParseMpdeData(text), views, globals.seed)) sets.push_back(std::move(set));
    list.push_back(text);
  }
  CheckOutFile(arguments.out);
  const uint64_t every = std::max<uint64_t>(arguments.training.steps / 10, 1);
  double sum = 0, last = 0;
  MpdeModel model = TrainMpde(sets, arguments.training, [&](uint64_t step, double loss) {
    sum += loss;
    if ((step + 1) % every != 0) return;
    last = sum / static_cast<double>(every), sum = 0;
    char line[96];
    std::snprintf(line, sizeof line, "step %llu of %llu: loss %.4f", static_cast<unsigned long long>(step + 1),
                  static_cast<unsigned long long>(arguments.training.steps), last);
    LogInfo(line);
  });
  Json training = {{"data", list},
                   {"views", arguments.views},
                   {"convention", arguments.convention},
                   {"seed", globals.seed},
                   {"steps", arguments.training.steps},
                   {"batch", arguments.training.batch},
                   {"rate", arguments.training.rate}};
  model.training = training.dump(-1, ' ', false, Json::error_handler_t::replace);
  WriteMpdeModel(model, arguments.out);
  size_t numbers = 0;
  for (const Tensor<float>& tensor : model.network.tensors()) numbers += tensor.gradient.size();
  if (globals.json) {
    PrintJson({{"out", arguments.out}, {"parameters", numbers}, {"steps", arguments.training.steps}, {"loss", last}});
    return;
  }
  std::printf("%s: %zu parameters, %llu steps, loss %.4f at the end\n", arguments.out.c_str(), numbers,
              static_cast<unsigned long long>(arguments.training.steps), last);
}

Json ErrorsJson(const MpdeErrors& errors) {
  return {{"count", errors.count},
          {"distance_mae_m", NumberOrNull(errors.distance_mae_m)},
          {"angle_mae_deg", NumberOrNull(errors.angle_mae_deg)},
          {"angle_unwrapped_mae_deg", NumberOrNull(errors.angle_unwrapped_mae_deg)}};
}

// Persons as `eval mpde` reads them.
template <class Entry, class PoseOf>
void WritePersons(const std::vector<Entry>& entries, const PoseOf& pose_of, const std::string& out) {
  if (out.empty()) return;
  Json list = Json::array();
  for (size_t i = 0; i < entries.size(); ++i) {
    const PersonPose& pose = pose_of(entries[i]);
    list.push_back({{"id", i}, {"distance", pose.distance}, {"angle_deg", pose.angle * 180 / std::numbers::pi}});
  }
  WriteFileAtomically(out, list.dump(1) + "\n");
}

void RunEval(const EvalArguments& arguments, const GlobalOptions& globals) {
  const std::vector<MpdeSample> samples =
      ReadTestSamples(ParseMpdeData(arguments.data), ParseViews(arguments.views, arguments.convention), arguments.count, globals.seed);
  std::vector<MpdeModel> models;
  for (const std::string& file : arguments.models) models.push_back(ReadMpdeModel(file));
  const std::vector<MpdePrediction> predictions = PredictTogether(models, samples);
  WritePersons(
      predictions, [](const MpdePrediction& p) -> const PersonPose& { return p.pose; }, arguments.out);
  WritePersons(
      samples, [](const MpdeSample& s) -> const PersonPose& { return s.truth; }, arguments.truth);
  const MpdeReport report = Judge(predictions, samples, globals.seed);
  if (globals.json) {
    Json json = ErrorsJson(report.errors), groups = Json::array();
    for (const MpdeErrors& group : report.groups) groups.push_back(ErrorsJson(group));
    json["distance_interval_m"] = {report.distance_interval.low, report.distance_interval.high};
    json["within_spread"] = report.within_spread;
    json["constant_height_mae_m"] = report.constant_height_mae_m;
    json["constant_trunk_mae_m"] = report.constant_trunk_mae_m;
    json["groups"] = groups;
    PrintJson(json);
    return;
  }
  std::printf("%lld persons: %.3f m (95 %%: %.3f to %.3f), %.1f deg (%.1f deg unwrapped)\n", static_cast<long long>(report.errors.count),
              report.errors.distance_mae_m, report.distance_interval.low, report.distance_interval.high, report.errors.angle_mae_deg,
              report.errors.angle_unwrapped_mae_deg);
  const char* names[] = {"below 10 m", "10 to 20 m", "20 to 30 m", "above 30 m"};
  for (size_t i = 0; i < report.groups.size(); ++i) {
    if (report.groups[i].count > 0)
      std::printf("  %s: %lld persons, %.3f m, %.1f deg\n", names[i], static_cast<long long>(report.groups[i].count),
                  report.groups[i].distance_mae_m, report.groups[i].angle_mae_deg);
  }
  std::printf("without learning: %.3f m by a stature of 1.72 m, %.3f m by a trunk of 0.5 m\n", report.constant_height_mae_m,
              report.constant_trunk_mae_m);
}

Json CellJson(const MpdeCell& cell) {
  const auto pair = [](const Spread& s) { return Json{{"mean", s.mean}, {"deviation", s.deviation}}; };
  return {{"distance_mae_m", pair(cell.distance_m)},
          {"angle_mae_deg", pair(cell.angle_deg)},
          {"angle_unwrapped_mae_deg", pair(cell.angle_unwrapped_deg)}};
}

Json TableJson(const MpdeTable& table) {
  Json tests = Json::array(), rows = Json::array();
  for (size_t i = 0; i < kMpdeTests.size(); ++i) {
    const bool simulated = !kMpdeTests[i].published && !table.test_is_real[i];
    tests.push_back({{"name", kMpdeTests[i].name},
                     {"data", table.test_is_real[i] ? "real"
                              : simulated           ? "simulated"
                                                    : "stand-in"},
                     {"real", table.test_is_real[i] || simulated ? Json(nullptr) : Json("not run")},
                     {"count", table.test_count[i]},
                     {"weight", kMpdeTests[i].weight},
                     {"constant_height_mae_m", table.constant_height_m[i]}});
  }
  for (const MpdeTableRow& row : table.rows) {
    Json json = {{"training", row.training}, {"all", CellJson(row.all)}, {"pub", CellJson(row.pub)}};
    for (size_t i = 0; i < kMpdeTests.size(); ++i) json["tests"][kMpdeTests[i].name] = CellJson(row.cells[i]);
    rows.push_back(json);
  }
  return {{"base", table.base_is_real ? "real" : "stand-in"}, {"tests", tests}, {"rows", rows}};
}

void PrintCell(const MpdeCell& cell) {
  std::printf(" | %5.3f ± %.3f m, %4.1f (%4.1f)°", cell.distance_m.mean, cell.distance_m.deviation, cell.angle_deg.mean,
              cell.angle_unwrapped_deg.mean);
}

// Markdown, to be pasted.
void PrintTable(const MpdeTable& table) {
  std::printf("| trained on");
  for (size_t i = 0; i < kMpdeTests.size(); ++i) {
    const bool stand_in = kMpdeTests[i].published && !table.test_is_real[i];
    std::printf(" | %s%s", kMpdeTests[i].name, stand_in ? " (stand-in; real: not run)" : "");
  }
  std::printf(" | All | Pub |\n|---|---|---|---|---|---|---|\n");
  for (const MpdeTableRow& row : table.rows) {
    std::printf("| %s", row.training.c_str());
    for (const MpdeCell& cell : row.cells) PrintCell(cell);
    PrintCell(row.all);
    PrintCell(row.pub);
    std::printf(" |\n");
  }
  std::printf("| nothing: stature 1.72 m");
  for (const double error : table.constant_height_m) std::printf(" | %5.3f m", error);
  std::printf(" | | |\n");
}

void RunTable(TableArguments arguments, const GlobalOptions& globals) {
  arguments.options.training.seed = globals.seed;
  for (const std::string& text : arguments.real) {
    const size_t at = text.find('=');
    if (at == std::string::npos) throw InputError("--real: '" + text + "' is not NAME=FILE");
    arguments.options.real[text.substr(0, at)] = text.substr(at + 1);
  }
  CheckOutFile(arguments.out);
  const MpdeTable table = MakeMpdeTable(arguments.options, [](const std::string& line) { LogInfo(line); });
  const Json json = TableJson(table);
  if (!arguments.out.empty()) WriteFileAtomically(arguments.out, json.dump(1) + "\n");
  if (globals.json) return PrintJson(json);
  PrintTable(table);
}

void RunSplits(const std::string& folder, const GlobalOptions& globals) {
  const SplitLeaks leaks = FindSplitLeaks(folder);
  if (globals.json) {
    Json splits = Json::array();
    for (const SplitLeaks::Split& split : leaks.splits)
      splits.push_back({{"split", split.name},
                        {"subsets", split.subsets},
                        {"pictures", split.pictures},
                        {"persons", split.persons},
                        {"characters", split.characters}});
    PrintJson({{"splits", splits},
               {"shared_places", leaks.places},
               {"shared_characters", leaks.characters},
               {"shared_seconds", leaks.seconds},
               {"example", leaks.example}});
  } else {
    for (const SplitLeaks::Split& split : leaks.splits) {
      std::printf("%s: %lld subsets, %lld pictures, %lld persons of %lld characters\n", split.name.c_str(),
                  static_cast<long long>(split.subsets), static_cast<long long>(split.pictures), static_cast<long long>(split.persons),
                  static_cast<long long>(split.characters));
    }
    std::printf("shared: %lld places, %lld characters, %lld seconds\n", static_cast<long long>(leaks.places),
                static_cast<long long>(leaks.characters), static_cast<long long>(leaks.seconds));
  }
  if (!leaks.ok()) throw RuntimeError("splits of " + folder + " are not apart: " + leaks.example);
}

void AddViewFlags(CLI::App& command, std::string& views, std::string& convention) {
  command.add_option(
      "--views", views,
      "virtual cameras instead of the pictures' own: of kitti, nuscenes, freeman, drone0, drone20, apart by commas, or a YAML file");
  command.add_option("--convention", convention,
                     "keypoints of virtual cameras: anatomy (the skeleton's joints), or annotators (where people mark them)");
}

void AddTrain(CLI::App& mpde, GlobalOptions& globals) {
  CLI::App* command = mpde.add_subcommand("train", "a network that tells distance and orientation of people by their keypoints");
  auto arguments = std::make_shared<TrainArguments>();
  command
      ->add_option("DATA", arguments->data, "PATH[:SPLIT][#PERSONS][@SHARE]: folders of datasets with people, files in MonoLoco's layout")
      ->required();
  command->add_option("--out", arguments->out, "file of the network, .safetensors")->required();
  AddViewFlags(*command, arguments->views, arguments->convention);
  AddConfigFlags(*command, [arguments](ConfigVisitor& v) { arguments->training.Visit(v); });
  command->callback([arguments, &globals] { RunTrain(*arguments, globals); });
}

void AddEval(CLI::App& mpde, GlobalOptions& globals) {
  CLI::App* command = mpde.add_subcommand("eval", "errors of a network, or of several together");
  auto arguments = std::make_shared<EvalArguments>();
  command->add_option("DATA", arguments->data, "PATH[:SPLIT][#PERSONS] to test on; split test of folders, val of files, unless named")
      ->required();
  command->add_option("--networks", arguments->models, "files of `mpde train`; the mean of several counts")->required();
  AddViewFlags(*command, arguments->views, arguments->convention);
  command->add_option("--views-count", arguments->count, "views to draw, with --views (default 4000)")->check(CLI::Range(1, 10'000'000));
  command->add_option("--out", arguments->out, "predictions as `eval mpde` reads them: JSON, a list of id, distance, angle_deg");
  command->add_option("--truth", arguments->truth, "and what is true of the same persons");
  command->callback([arguments, &globals] { RunEval(*arguments, globals); });
}

void AddTable(CLI::App& mpde, GlobalOptions& globals) {
  CLI::App* command = mpde.add_subcommand("table", "the paper's table: four training sets, four test sets, several seeds");
  auto arguments = std::make_shared<TableArguments>();
  command->add_option("DIR", arguments->options.people, "folder of `collect --recipe`, with subsets.json")->required();
  command->add_option(
      "--real", arguments->real,
      "NAME=FILE[:SPLIT]: real data in MonoLoco's layout as nuscenes, kitti or freeman (split val unless named); stand-ins without");
  command->add_option("--seeds", arguments->options.seeds, "networks of each row (default 3)");
  command->add_option("--our-share", arguments->options.our_share, "of the batches, relative to the base (default 1)")
      ->check(CLI::Range(0.001, 1000.0));
  command->add_option("--views-count", arguments->options.test_samples, "views of each stand-in's test (default 4000)")
      ->check(CLI::Range(1, 10'000'000));
  command->add_option("--out", arguments->out, "the table as JSON");
  AddConfigFlags(*command, [arguments](ConfigVisitor& v) { arguments->options.training.Visit(v); });
  command->callback([arguments, &globals] { RunTable(*arguments, globals); });
}

void AddSplits(CLI::App& mpde, GlobalOptions& globals) {
  CLI::App* command =
      mpde.add_subcommand("splits", "whether train, val and test share a place, a character or a second; exit status 1 if so");
  auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "folder of `collect --recipe`")->required();
  command->callback([folder, &globals] { RunSplits(*folder, globals); });
}

}  // namespace

void AddMpdeCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("mpde", "distance and orientation of people from keypoints: train, evaluate, the paper's table");
  command->require_subcommand(1);
  AddTrain(*command, globals);
  AddEval(*command, globals);
  AddTable(*command, globals);
  AddSplits(*command, globals);
}

}  // namespace airsim360

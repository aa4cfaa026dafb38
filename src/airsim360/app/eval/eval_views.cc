#include "airsim360/app/eval/eval_views.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <set>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/text.h"
#include "airsim360/eval/statistics/bootstrap.h"

namespace airsim360 {
namespace {

constexpr int kMostBands = 1000;

void CheckChoice(const char* flag, const std::string& text, const std::vector<std::string>& choices) {
  if (std::find(choices.begin(), choices.end(), text) == choices.end())
    throw InputError(std::string(flag) + ": " + UnknownChoiceMessage("choice", text, choices));
}

namespace fs = std::filesystem;

bool IsWithin(const fs::path& file, const fs::path& folder) {
  const fs::path from = fs::weakly_canonical(folder), to = fs::weakly_canonical(file);
  return std::mismatch(from.begin(), from.end(), to.begin(), to.end()).first == from.end();
}

// What else is read with a file or folder: the pictures of a COCO panoptic file lie in folders beside it.
std::vector<fs::path> InputsOf(const fs::path& input) {
  std::vector<fs::path> inputs = {input};
  if (input.extension() == ".json") {
    for (const fs::path& folder : {fs::path(input).replace_extension(), input.parent_path() / "entity"})
      if (fs::is_directory(folder)) inputs.push_back(folder);
  }
  return inputs;
}

void CheckOutput(const CLI::App& command, const std::string& flag, const std::string& output) {
  const std::set<std::string> outputs = {"--csv", "--sheet"};
  std::error_code none;  // what cannot be looked at is named when it is read
  for (const CLI::Option* option : command.get_options()) {
    const bool also_written = outputs.contains(option->get_name());
    if (option->get_name() == flag) continue;
    for (const std::string& text : option->results()) {
      // Also the file of "16=FILE".
      const fs::path named = fs::exists(text, none) ? text : text.substr(text.find('=') + 1);
      if (also_written && fs::weakly_canonical(named, none) == fs::weakly_canonical(output, none))
        throw InputError(flag + ": '" + output + "' is also the file of " + option->get_name());
      if (also_written || !fs::exists(named, none)) continue;
      for (const fs::path& input : InputsOf(named)) {
        if (!fs::is_directory(input, none)) {
          if (fs::equivalent(input, output, none))
            throw InputError(flag + ": '" + output + "' is a file that is read here; it would be overwritten: name another");
        } else if (IsWithin(output, input) && (flag != "--csv" || fs::exists(output, none) || fs::exists(input / "meta.json", none))) {
          throw InputError(flag + ": '" + output + "' lies in " + input.string() + ", which is read here: write it elsewhere");
        }
      }
    }
  }
}

}  // namespace

void AddOutputOption(CLI::App& command, const char* name, std::string& file, const std::string& help) {
  // A check of an option runs when all are parsed, before anything is measured.
  command.add_option(name, file, help)
      ->check(CLI::Validator(
          [&command, flag = std::string(name)](const std::string& output) {
            CheckOutput(command, flag, output);
            return std::string();
          },
          ""));
}

void AddForceFlag(CLI::App& command, bool& force) {
  command.add_flag("--force", force,
                   "measure in spite of what surely looks like a mistake (of units, axes, ids, orientation): it is a warning then");
}

void AddReportFlags(CLI::App& command, ReportOptions& options, const char* csv_rows) {
  command.add_option("--bootstrap", options.bootstrap,
                     "95 % intervals from so many draws of the pictures with replacement, by --seed; 0 = none");
  AddOutputOption(command, "--csv", options.csv, std::string("also write a table, ") + csv_rows);
}

void AddViewFlags(CLI::App& command, ViewOptions& options, bool pixels) {
  if (pixels) {
    command.add_option("--weights", options.weights,
                       "what a pixel counts: pixel (1, the default) or solid_angle (its steradians, panoramas)");
    command.add_option("--projection", options.projection,
                       "where pixels are counted: erp (as they are, the default), cube or tangent (the nearest pixels of a panorama)");
  }
  command.add_option("--seam", options.seam, "also within so many columns of the panorama's seam, and apart from it");
  command.add_option("--latitude-bands", options.bands, "also in so many bands of equal latitude");
  command.add_option("--rolled", options.rolled,
                     "COLUMNS=PRED: also predictions made of pictures whose columns were moved so far to the right; several may be given");
  command.add_option(
      "--turned", options.turned,
      "YAW,PITCH,ROLL=PRED: also predictions made of panoramas of a camera that was turned so (degrees: right, up, clockwise); several may be given");
  AddForceFlag(command, options.force);
}

void CheckViewOptions(const ViewOptions& options) {
  const PixelWeight weight = ParsePixelWeight(options.weights);
  CheckChoice("--projection", options.projection, {"erp", "cube", "tangent"});
  if (options.projection != "erp" && weight != PixelWeight::kPixel)
    throw InputError("--weights " + options.weights + " and --projection " + options.projection +
                     " exclude each other: both say what a direction counts");
  if (options.seam < 0) throw InputError("--seam " + std::to_string(options.seam) + ": must be at least 1");
  if (options.bands < 0 || options.bands > kMostBands)
    throw InputError("--latitude-bands " + std::to_string(options.bands) + ": must be 1 to " + std::to_string(kMostBands));
  ParseRolled(options);
}

bool ArePanoramas(const ViewOptions& options, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    // A dataset, a folder of it, or a file in one.
    std::filesystem::path folder = std::filesystem::absolute(input).lexically_normal(), meta;
    for (int level = 0; level < 3 && meta.empty(); ++level, folder = folder.parent_path()) {
      if (std::filesystem::exists(folder / "meta.json") && std::filesystem::exists(folder / "frames.jsonl")) meta = folder / "meta.json";
    }
    if (meta.empty()) continue;
    const auto json = nlohmann::json::parse(ReadTextFile(meta, 16 << 20), nullptr, false);
    if (!json.is_object() || !json.contains("cameras") || !json["cameras"].is_array()) continue;
    for (const auto& camera : json["cameras"]) {
      const std::string projection = camera.is_object() ? camera.value("projection", "erp") : "erp";
      if (projection == "erp") continue;
      const char* flag = options.cos_latitude          ? "this protocol"
                         : options.weights != "pixel"  ? "--weights"
                         : options.projection != "erp" ? "--projection"
                         : options.seam > 0            ? "--seam"
                         : options.bands > 0           ? "--latitude-bands"
                         : !options.rolled.empty()     ? "--rolled"
                         : !options.turned.empty()     ? "--turned"
                                                       : nullptr;
      if (flag)
        throw InputError(std::string(flag) + " is for panoramas; " + meta.string() + " says that a camera's projection is " + projection);
      return false;
    }
  }
  return true;
}

std::shared_ptr<const PictureViews> ViewCache::Of(int width, int height) {
  const std::lock_guard lock(mutex_);
  auto& views = views_[{width, height}];
  if (views) return views;
  const PixelWeight weight = options_.cos_latitude ? PixelWeight::kCosLatitude : ParsePixelWeight(options_.weights);
  auto made = std::make_shared<PictureViews>();
  if (options_.resize_width > 0) {
    made->push_back(ResizedView(width, height, options_.resize_width, options_.resize_height));
  } else if (options_.projection == "cube") {
    made->push_back(CubeView(width, height));
  } else if (options_.projection == "tangent") {
    made->push_back(TangentView(width, height));
  } else {
    made->push_back(WholeView(width, height, weight));
  }
  if (options_.seam > 0) {
    made->push_back(SeamView(width, height, options_.seam, true, weight));
    made->push_back(SeamView(width, height, options_.seam, false, weight));
  }
  for (int band = 0; band < options_.bands; ++band) made->push_back(BandView(width, height, band, options_.bands, weight));
  views = std::move(made);
  return views;
}

std::vector<Rolled> ParseRolled(const ViewOptions& options) {
  std::vector<Rolled> list;
  for (const std::string& text : options.rolled) {
    const size_t equals = text.find('=');
    Rolled one;
    const auto [end, error] = std::from_chars(text.data(), text.data() + std::min(equals, text.size()), one.columns);
    if (equals == std::string::npos || error != std::errc() || end != text.data() + equals || equals + 1 == text.size())
      throw InputError("--rolled: '" + text + "' is not COLUMNS=PRED");
    one.path = text.substr(equals + 1);
    list.push_back(std::move(one));
  }
  for (const std::string& text : options.turned) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals + 1 == text.size()) throw InputError("--turned: '" + text + "' is not YAW,PITCH,ROLL=PRED");
    const std::vector<double> angles = ParseNumbers("--turned", text.substr(0, equals), 3, "YAW,PITCH,ROLL=PRED");
    Rolled one;
    one.turn_deg = Vec3d{angles[0], angles[1], angles[2]};
    one.path = text.substr(equals + 1);
    list.push_back(std::move(one));
  }
  return list;
}

void AppendViews(nlohmann::ordered_json& json, const ViewOptions& options, const std::function<nlohmann::ordered_json(size_t)>& of_view) {
  size_t view = 1;
  if (options.seam > 0) {
    json["seam"] = {{"columns", options.seam}, {"near", of_view(view)}, {"far", of_view(view + 1)}};
    view += 2;
  }
  for (int band = 0; band < options.bands; ++band) {
    nlohmann::ordered_json one = {{"latitude_deg", {90 - 180.0 * band / options.bands, 90 - 180.0 * (band + 1) / options.bands}}};
    one.update(of_view(view + static_cast<size_t>(band)));
    json["latitude_bands"].push_back(std::move(one));
  }
}

void AppendRolled(nlohmann::ordered_json& json, std::span<const Rolled> rolled, const std::vector<std::vector<Figure>>& figures,
                  const std::vector<Figure>& main) {
  if (rolled.empty()) return;
  std::vector<Figure> spread;
  for (size_t f = 0; f < main.size(); ++f) {
    double low = main[f].second, high = low;
    for (const auto& one : figures) low = std::min(low, one[f].second), high = std::max(high, one[f].second);
    spread.emplace_back(main[f].first, high - low);
  }
  for (size_t r = 0; r < rolled.size(); ++r) {
    nlohmann::ordered_json one;
    if (const auto& turn = rolled[r].turn_deg) {
      one["yaw_pitch_roll_deg"] = {turn->x, turn->y, turn->z};
    } else {
      one["columns"] = rolled[r].columns;
    }
    one["pred"] = rolled[r].path;
    one.update(ToJson(figures[r]));
    json[rolled[r].turn_deg ? "turned" : "rolled"].push_back(std::move(one));
  }
  json["spread"] = ToJson(spread);
}

void AppendIntervals(nlohmann::ordered_json& json, const ReportOptions& options, uint64_t seed, size_t items,
                     const std::vector<std::string>& names,
                     const std::function<std::vector<double>(std::span<const uint32_t>)>& statistic) {
  if (options.bootstrap == 0) return;
  const std::vector<Interval> intervals = BootstrapIntervals(items, options.bootstrap, seed, statistic);
  json["bootstrap"] = {{"draws", options.bootstrap}, {"seed", seed}, {"level", 0.95}};
  for (size_t f = 0; f < names.size(); ++f) json["intervals"][names[f]] = {intervals[f].low, intervals[f].high};
}

void JudgeMistakes(const std::vector<std::pair<std::string, LikelyMistake>>& files_and_mistakes, bool force, nlohmann::ordered_json& json) {
  const size_t all = files_and_mistakes.size();
  size_t count = 0, sure = 0, first = 0;
  for (size_t i = all; i-- > 0;) {
    const LikelyMistake& mistake = files_and_mistakes[i].second;
    if (mistake.text.empty()) continue;
    ++count;
    if (mistake.sure || sure == 0) first = i;
    sure += mistake.sure;
  }
  const bool refused = 2 * sure > all;
  if (!refused && sure == 0 && 2 * count <= all) return;
  std::string text = files_and_mistakes[first].first + ": " + files_and_mistakes[first].second.text;
  if (all > 1) text += " (" + std::to_string(refused || 2 * count <= all ? sure : count) + " of " + std::to_string(all) + " pictures)";
  if (refused && !force) throw InputError(text + "; --force measures it as it is");
  json["warnings"].push_back(text);
}

void WarnOfEmptyTruths(nlohmann::ordered_json& json, const std::vector<FilePair>& pairs, const std::function<int64_t(size_t)>& valid) {
  size_t count = 0, first = 0;
  for (size_t i = pairs.size(); i-- > 0;) {
    if (valid(i) == 0) ++count, first = i;
  }
  if (count > 0)
    json["warnings"].push_back(std::to_string(count) + " of " + std::to_string(pairs.size()) +
                               " pictures have no pixel whose truth counts and are in no mean, '" + pairs[first].name +
                               "' first: is it damaged?");
}

nlohmann::ordered_json ToJson(const std::vector<Figure>& figures) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [name, value] : figures) json[name] = value;
  return json;
}

namespace {

// "  near: absrel 0.1, rmse 0.4": the first figures of a part; of groups of figures those of the first group.
void PrintPart(const std::string& name, const nlohmann::ordered_json& part) {
  constexpr int kShown = 4;
  const nlohmann::ordered_json& figures = part.contains("all") ? part["all"] : part;
  std::string text;
  int shown = 0;
  for (const auto& [key, value] : figures.items()) {
    if (!value.is_number_float() || shown++ == kShown) continue;
    char number[40];
    std::snprintf(number, sizeof(number), " %.6g", value.get<double>());
    text += (text.empty() ? " " : ", ") + key + number;
    if (shown == kShown) break;
  }
  std::printf("  %s:%s\n", name.c_str(), text.c_str());
}

void PrintParts(const nlohmann::ordered_json& json) {
  if (json.contains("seam")) {
    PrintPart("near the seam", json["seam"]["near"]);
    PrintPart("away from the seam", json["seam"]["far"]);
  }
  if (json.contains("latitude_bands")) {
    for (const auto& band : json["latitude_bands"]) {
      char name[48];
      std::snprintf(name, sizeof(name), "latitude %.4g to %.4g", band["latitude_deg"][0].get<double>(),
                    band["latitude_deg"][1].get<double>());
      PrintPart(name, band);
    }
  }
  if (json.contains("rolled")) {
    for (const auto& one : json["rolled"]) PrintPart("rolled by " + std::to_string(one["columns"].get<int>()), one);
  }
  if (json.contains("turned")) {
    for (const auto& one : json["turned"]) PrintPart("turned by " + one["yaw_pitch_roll_deg"].dump(), one);
  }
  if (json.contains("spread")) PrintPart("spread", json["spread"]);
  if (json.contains("worst")) {
    for (const auto& one : json["worst"]) PrintPart("worst: " + one["picture"].get<std::string>(), one);
  }
}

}  // namespace

void PrintFigures(const nlohmann::ordered_json& json) {
  for (const auto& [name, value] : json.items()) {
    if (value.is_number_float()) std::printf("%-24s %.6g\n", name.c_str(), value.get<double>());
    if (value.is_number_integer()) std::printf("%-24s %lld\n", name.c_str(), static_cast<long long>(value.get<int64_t>()));
    if (value.is_string()) std::printf("%-24s %s\n", name.c_str(), value.get<std::string>().c_str());
  }
  if (json.contains("intervals")) {
    for (const auto& [name, value] : json["intervals"].items()) {
      if (value[0].is_number()) std::printf("%-24s %.6g to %.6g (95 %%)\n", name.c_str(), value[0].get<double>(), value[1].get<double>());
    }
  }
  PrintParts(json);
  for (const char* list : {"notes", "warnings"}) {
    if (!json.contains(list)) continue;
    for (const auto& text : json[list])
      std::printf("%s %s\n", std::string_view(list) == "notes" ? "note:" : "warning:", text.get<std::string>().c_str());
  }
}

std::string NumberText(double value) { return std::isfinite(value) ? ShortestText(value) : ""; }

void WriteCsv(const std::string& path, const std::vector<std::vector<std::string>>& rows) {
  if (path.empty()) return;
  std::string text;
  for (const auto& row : rows) {
    for (size_t i = 0; i < row.size(); ++i) {
      if (i > 0) text += ',';
      if (row[i].find_first_of(",\"\n") == std::string::npos) {
        text += row[i];
        continue;
      }
      text += '"';
      for (const char c : row[i]) text += c == '"' ? std::string("\"\"") : std::string(1, c);
      text += '"';
    }
    text += '\n';
  }
  WriteFileAtomically(path, std::string_view(text));
}

}  // namespace airsim360

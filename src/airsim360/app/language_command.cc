// airsim360 language: captions, referring expressions and questions with proofs, and their check.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/app/flags/config_flags.h"
#include "airsim360/app/flags/environment_flags.h"
#include "airsim360/app/flags/out_file.h"
#include "airsim360/app/flags/session.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/vln/language/check_language.h"
#include "airsim360/vln/language/layouts.h"
#include "airsim360/vln/language/make_language.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

// Lines of a file that takes its name when all are there: items may be more than memory holds.
class LineFile {
 public:
  explicit LineFile(std::filesystem::path path) : path_(std::move(path)), part_(path_.string() + ".part"), out_(part_, std::ios::binary) {
    if (!out_) throw RuntimeError("--out: " + part_.string() + " cannot be written");
  }
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;
  ~LineFile() {
    out_.close();
    std::error_code none;
    std::filesystem::remove(part_, none);
  }
  void Add(const std::string& line) {
    if (!(out_ << line << '\n')) throw RuntimeError("--out: writing " + part_.string() + " failed: is the disk full?");
  }
  void Finish() {
    out_.close();
    if (!out_) throw RuntimeError("--out: writing " + part_.string() + " failed: is the disk full?");
    std::filesystem::rename(part_, path_);
  }

 private:
  std::filesystem::path path_, part_;
  std::ofstream out_;
};

struct LanguageMakeArguments {
  std::string world, out;
  LanguageOptions options;
  std::vector<std::string> layouts;
  bool pictures = false;
  RenderSettings picture;
  EnvironmentFlags environment;
};

// Flags of pictures are not accepted and ignored.
void CheckBelonging(const CLI::App& command, LanguageMakeArguments& a) {
  std::vector<std::string> flags = ConfigFlagNames([&a](ConfigVisitor& v) { a.picture.Visit(v); });
  std::ranges::copy(EnvironmentFlagNames(), std::back_inserter(flags));
  RefuseWithout(command, flags, "--pictures");
}

void Make(LanguageMakeArguments& a, const GlobalOptions& globals) {
  for (const std::string& layout : a.layouts) CheckLanguageLayout(layout, a.options.kind);
  CheckRenderSettings(a.picture, "--");
  if (a.picture.tier == Tier::kLabels) throw InputError("--tier: labels has no pictures; choices: fast, high, reference");
  CheckLanguageOptions(a.options);
  CheckOutFile(a.out);
  Stage stage(StageOptionsOf(a.world, globals, a.environment));
  LineFile file(a.out);
  const LanguageSummary made = MakeLanguage(stage, a.options, [&](const std::string& line) { file.Add(line); });
  file.Finish();
  const std::filesystem::path out(a.out);
  Json files = {a.out}, types = Json::object();
  for (const std::string& layout : a.layouts)
    for (const auto& written : WriteLanguageLayout(out, layout, std::filesystem::path(out).replace_extension("")))
      files.push_back(written.string());
  if (a.pictures) DrawPictures(stage, PicturesOf(out), a.picture, out.parent_path());
  for (const auto& [type, count] : made.by_type) types[type] = count;
  if (globals.json) {
    PrintJson({{"out", a.out},
               {"items", made.items},
               {"types", types},
               {"pictures", made.pictures},
               {"lookouts", made.lookouts},
               {"files", files}});
    return;
  }
  std::printf("%lld items on %lld pictures in %s\n", static_cast<long long>(made.items), static_cast<long long>(made.pictures),
              a.out.c_str());
  for (const auto& [type, count] : made.by_type) std::printf("%-16s %8lld\n", type.c_str(), static_cast<long long>(count));
}

void AddMake(CLI::App& parent, GlobalOptions& globals) {
  CLI::App* command = parent.add_subcommand("make", "captions, referring expressions or questions about a world, each with its proof");
  const auto a = std::make_shared<LanguageMakeArguments>();
  command->add_option("--world", a->world, "name or file of the world")->required();
  command->add_option("--kind", a->options.kind, "caption, refer or vqa (default vqa)");
  command->add_option("--count", a->options.count, "items (default 1000)");
  command->add_option("--width", a->options.width, "of panoramas, pixels; pictures of cameras are half as wide (default 1024)");
  command->add_option("--layout", a->layouts, "also files of these layouts: vqa, refcoco, llava")->delimiter(',');
  command->add_flag("--pictures", a->pictures, "also draws the pictures, in the folder pictures beside the items");
  AddConfigFlags(*command, [a](ConfigVisitor& v) { a->picture.Visit(v); });
  AddEnvironmentFlags(*command, a->environment);
  command->add_option("--out", a->out, "items.jsonl")->required();
  command->callback([a, command, &globals] {
    CheckBelonging(*command, *a);
    Make(*a, globals);
  });
}

void Check(const std::string& file, const GlobalOptions& globals) {
  const LanguageCheck check = CheckLanguage(file, [&](const std::string& world, uint64_t seed) {
    GlobalOptions of_seed = globals;
    of_seed.seed = seed;
    return std::make_shared<Stage>(StageOptionsOf(world, of_seed));
  });
  Json list = Json::array();
  size_t ambiguous = 0;
  for (const LanguageComplaint& c : check.complaints) {
    ambiguous += c.what.starts_with("not unique");
    list.push_back({{"id", c.id}, {"what", c.what}});
    if (!globals.json) std::printf("%s: %s\n", c.id.c_str(), c.what.c_str());
  }
  if (globals.json)
    PrintJson({{"items", check.items}, {"not_unique", ambiguous}, {"wrong", check.complaints.size()}, {"complaints", list}});
  else
    std::printf("%lld items: %zu not unique, %zu otherwise wrong\n", static_cast<long long>(check.items), ambiguous,
                check.complaints.size() - ambiguous);
  std::fflush(stdout);
  if (!check.complaints.empty()) throw RuntimeError("language check: " + check.complaints[0].id + ": " + check.complaints[0].what);
}

void AddCheck(CLI::App& parent, GlobalOptions& globals) {
  CLI::App* command = parent.add_subcommand("check", "answers items again by a second method; exit status 1 if one is ambiguous or wrong");
  const auto file = std::make_shared<std::string>();
  command->add_option("file", *file, "items.jsonl")->required();
  command->callback([file, &globals] { Check(*file, globals); });
}

}  // namespace

void AddLanguageCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command =
      app.add_subcommand("language", "language data with proofs: captions, referring expressions, questions (docs/guide/language.md)");
  command->require_subcommand(1);
  AddMake(*command, globals);
  AddCheck(*command, globals);
}

}  // namespace airsim360

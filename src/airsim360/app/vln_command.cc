// airsim360 vln: vision-and-language navigation. Episodes with proofs, agents that fly them, scores.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/app/flags/config_flags.h"
#include "airsim360/app/flags/out_file.h"
#include "airsim360/app/flags/session.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/log.h"
#include "airsim360/base/signature.h"
#include "airsim360/dataset/record/version.h"
#include "airsim360/vln/demos/demos.h"
#include "airsim360/vln/episodes/exchange.h"
#include "airsim360/vln/episodes/make_episodes.h"
#include "airsim360/vln/episodes/recipe.h"
#include "airsim360/vln/report/failure_pictures.h"
#include "airsim360/vln/report/submission.h"
#include "airsim360/vln/report/vln_report.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

PeopleRequest PeopleOf(int64_t count, uint64_t seed) {
  PeopleRequest people;
  if (count > 0) people.count = static_cast<size_t>(count);
  people.seed = seed;
  return people;
}

std::shared_ptr<Stage> Open(const GlobalOptions& globals, const std::string& world, uint64_t seed, int64_t people) {
  GlobalOptions of_seed = globals;
  of_seed.seed = seed;
  const auto stage = std::make_shared<Stage>(StageOptionsOf(world, of_seed, {}, PeopleOf(people, seed)));
  LogInfo(world + " of seed " + std::to_string(seed) + ": ready after " + ClockText(stage->load_seconds()));
  return stage;
}

// ------------------------------------------------------------------------------------------------ make

struct VlnMakeArguments {
  VlnMakeOptions options;
  std::string recipe, out;
};

Json UnboundJson(const std::vector<Unbound>& all) {
  Json list = Json::array();
  for (const Unbound& u : all)
    list.push_back({{"template", u.template_id}, {"world", u.world}, {"world_seed", u.world_seed}, {"start", u.start}, {"why", u.why}});
  return list;
}

void PrintUnbound(const char* what, const std::vector<Unbound>& all) {
  for (const Unbound& u : all)
    std::printf("%s: %s, %s of seed %llu, start %d: %s\n", what, u.template_id.c_str(), u.world.c_str(),
                static_cast<unsigned long long>(u.world_seed), u.start, u.why.c_str());
}

void PrintMade(const VlnMade& made, const std::string& out, const GlobalOptions& globals) {
  Json difficulty = {{"easy", 0}, {"medium", 0}, {"hard", 0}};
  for (const LanguageEpisode& e : made.episodes) difficulty[e.difficulty] = difficulty[e.difficulty].get<int>() + 1;
  if (globals.json) {
    PrintJson({{"out", out},
               {"episodes", made.episodes.size()},
               {"difficulty", difficulty},
               {"unbound", UnboundJson(made.unbound)},
               {"hidden", UnboundJson(made.hidden)}});
    return;
  }
  std::printf("%zu episodes in %s (%d easy, %d medium, %d hard)\n", made.episodes.size(), out.c_str(), difficulty["easy"].get<int>(),
              difficulty["medium"].get<int>(), difficulty["hard"].get<int>());
  PrintUnbound("not bound", made.unbound);
  PrintUnbound("begins out of sight", made.hidden);
}

// What a recipe makes, of one world or of all, with the seed, people, weather and limit of the flags.
VlnMade MakeRecipe(const VlnMakeArguments& arguments, const GlobalOptions& globals) {
  std::vector<std::string> known;
  for (const WorldInfo& info : ListWorlds()) known.push_back(info.name);
  VlnMade made;
  std::vector<VlnMakeOptions> parts = VlnRecipe(arguments.recipe, known);
  if (const std::string& world = arguments.options.world; !world.empty()) {
    std::vector<std::string> worlds;
    for (const VlnMakeOptions& part : parts) worlds.push_back(part.world);
    std::erase_if(parts, [&](const VlnMakeOptions& part) { return part.world != world; });
    if (parts.empty()) throw InputError("--world: " + UnknownChoiceMessage("world of the recipe", world, worlds));
  }
  for (VlnMakeOptions& options : parts) {
    options.seed = globals.seed;
    options.people = arguments.options.people;
    options.limit = arguments.options.limit;
    if (!arguments.options.weather.empty()) options.weather = arguments.options.weather;
    options.open = [&](uint64_t seed) { return Open(globals, options.world, seed, 0); };
    VlnMade part = MakeEpisodes(options);
    std::ranges::move(part.episodes, std::back_inserter(made.episodes));
    std::ranges::move(part.unbound, std::back_inserter(made.unbound));
    std::ranges::move(part.hidden, std::back_inserter(made.hidden));
  }
  return made;
}

void Make(VlnMakeArguments& arguments, const GlobalOptions& globals) {
  VlnMakeOptions& options = arguments.options;
  options.seed = globals.seed;
  if (options.world.empty() && arguments.recipe.empty()) throw InputError("--world: give a world or a --recipe");
  if (!options.weather.empty() && options.weather != "mix") ApplyFlags({.weather = options.weather}, {});
  options.open = [&](uint64_t seed) { return Open(globals, options.world, seed, 0); };
  CheckOutFile(arguments.out);
  const VlnMade made = arguments.recipe.empty() ? MakeEpisodes(options) : MakeRecipe(arguments, globals);
  if (made.episodes.empty()) throw RuntimeError("no instruction could be bound to " + options.world + ": " + made.unbound.front().why);
  std::string text;
  for (const LanguageEpisode& e : made.episodes) text += EpisodeLine(e) + "\n";
  WriteFileAtomically(arguments.out, text);
  PrintMade(made, arguments.out, globals);
}

void AddMake(CLI::App& parent, GlobalOptions& globals) {
  CLI::App* command = parent.add_subcommand("make", "episodes: instructions bound to a world, each with the proof that it means one thing");
  const auto a = std::make_shared<VlnMakeArguments>();
  command->add_option("--world", a->options.world, "name or file of the world");
  CLI::Option* recipe = command->add_option(
      "--recipe", a->recipe, "what is made of which worlds: omni360-vln, over 10,000 episodes in all; with --world the part of that world");
  command
      ->add_option("--templates", a->options.templates,
                   "paper37, any (the same style over whatever a world has), or a JSON file (default paper37)")
      ->excludes(recipe);
  command->add_option("--starts", a->options.starts, "starts of each instruction (default 3)")->excludes(recipe);
  command->add_option("--seeds", a->options.seeds, "worlds, of the seeds from --seed on (default 1)")->excludes(recipe);
  command->add_option("--people", a->options.people, "people in the world when episodes are flown (default 0)");
  command->add_option("--weather", a->options.weather, "of pictures, or mix: another one an episode");
  command->add_option("--limit", a->options.limit, "episodes of a seed at most, of all nouns in turn (default all)")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--out", a->out, "episodes.jsonl")->required();
  command->callback([a, &globals] { Make(*a, globals); });
}

// ------------------------------------------------------------------------------------------------ check, templates

void Check(const std::string& file, const GlobalOptions& globals) {
  const std::vector<LanguageEpisode> episodes = ReadEpisodes(file);
  const auto complaints = CheckEpisodes(episodes, [&](const std::string& world, uint64_t seed) { return Open(globals, world, seed, 0); });
  Json list = Json::array();
  size_t ambiguous = 0, unreachable = 0;
  for (const VlnComplaint& c : complaints) {
    list.push_back({{"id", c.id}, {"what", c.what}});
    ambiguous += c.what.starts_with("not unique");
    unreachable += c.what.starts_with("not reachable");
    if (!globals.json) std::printf("%s: %s\n", c.id.c_str(), c.what.c_str());
  }
  if (globals.json)
    PrintJson({{"episodes", episodes.size()},
               {"not_unique", ambiguous},
               {"not_reachable", unreachable},
               {"wrong", complaints.size()},
               {"complaints", list}});
  else
    std::printf("%zu episodes: %zu not unique, %zu not reachable, %zu otherwise wrong\n", episodes.size(), ambiguous, unreachable,
                complaints.size() - ambiguous - unreachable);
  std::fflush(stdout);
  if (!complaints.empty()) throw RuntimeError("vln check: " + complaints[0].id + ": " + complaints[0].what);
}

void AddCheck(CLI::App& parent, GlobalOptions& globals) {
  CLI::App* command =
      parent.add_subcommand("check", "proves episodes again by a second, brute-force method; exit status 1 if one is wrong");
  const auto file = std::make_shared<std::string>();
  command->add_option("file", *file, "episodes.jsonl")->required();
  command->callback([file, &globals] { Check(*file, globals); });
}

void AddTemplates(CLI::App& parent, GlobalOptions& globals) {
  CLI::App* command = parent.add_subcommand("templates", "the instructions of the paper, word for word, and what they ask for");
  command->callback([&globals] {
    if (globals.json) {
      PrintJson(Json::parse(PaperTemplatesText()));
      return;
    }
    for (const InstructionTemplate& t : PaperTemplates()) {
      std::string predicates;
      for (const Predicate& p : t.query.predicates)
        predicates += (predicates.empty() ? "" : ", ") + std::string(kPredicateNames[static_cast<int>(p.kind)]);
      std::printf("%s  %s\n            %s\n", t.id.c_str(), t.text.c_str(), predicates.c_str());
    }
  });
}

// ------------------------------------------------------------------------------------------------ import, export

struct ExchangeArguments {
  std::string file, format, world, out;
};

void Import(const ExchangeArguments& a, const GlobalOptions& globals) {
  const auto episodes = ImportEpisodes(ReadTextFile(a.file, uint64_t{2} << 30), a.file, a.format, a.world);
  std::string text;
  for (const LanguageEpisode& e : episodes) text += EpisodeLine(e) + "\n";
  WriteFileAtomically(a.out, text);
  if (globals.json)
    PrintJson({{"out", a.out}, {"episodes", episodes.size()}});
  else
    std::printf("%zu episodes in %s\n", episodes.size(), a.out.c_str());
}

void Export(const ExchangeArguments& a, const GlobalOptions& globals) {
  const auto episodes = ReadEpisodes(a.file);
  WriteFileAtomically(a.out, ExportEpisodes(episodes, a.format));
  if (globals.json)
    PrintJson({{"out", a.out}, {"episodes", episodes.size()}});
  else
    std::printf("%zu episodes in %s\n", episodes.size(), a.out.c_str());
}

void AddImportAndExport(CLI::App& parent, GlobalOptions& globals) {
  const char* formats = "aerialvln, openfly, citynav, traveluav or uavon";
  CLI::App* import = parent.add_subcommand("import", "episodes of public benchmarks; they can be flown, but nothing is proved of them");
  const auto a = std::make_shared<ExchangeArguments>();
  import->add_option("file", a->file, "JSON of the benchmark")->required();
  import->add_option("--format", a->format, formats)->required();
  import->add_option("--world", a->world, "name or file of the world that they are to be flown in")->required();
  import->add_option("--out", a->out, "episodes.jsonl")->required();
  import->callback([a, &globals] { Import(*a, globals);
});
CLI::App* exported = parent.add_subcommand("export", "episodes in the form of a public benchmark");
const auto b = std::make_shared<ExchangeArguments>();
exported->add_option("file", b->file, "episodes.jsonl")->required();
exported->add_option("--format", b->format, formats)->required();
exported->add_option("--out", b->out, "JSON of the benchmark")->required();
exported->callback([b, &globals] { Export(*b, globals); });
}  // namespace

// ------------------------------------------------------------------------------------------------ run

struct RunArguments {
  std::string file, agent = "oracle", view = "erp", decisions, protocol = "ours", program, out;
  VlnRunOptions options;
};

template <class Kind, size_t kCount>
Kind ChoiceOf(const char* flag, const std::string& text, const char* const (&names)[kCount]) {
  for (size_t i = 0; i < kCount; ++i)
    if (text == names[i]) return static_cast<Kind>(i);
  throw InputError(std::string(flag) + ": " +
                   UnknownChoiceMessage("choice", text, std::vector<std::string>(std::begin(names), std::end(names))));
}

void PrintScores(const std::vector<VlnResult>& results, const std::string& out, const GlobalOptions& globals) {
  Json scores = Json::parse(ScoresJson(results));
  scores["out"] = out;
  if (globals.json) {
    PrintJson(scores);
    return;
  }
  std::printf("%zu episodes, %s, %s, %s, %s\n", results.size(), results[0].agent.c_str(), results[0].view.c_str(),
              results[0].decisions_by.c_str(), results[0].protocol.c_str());
  for (const auto& [name, interval] : scores["intervals"].items())
    if (scores[name].is_number() && interval[0].is_number())
      std::printf("%-20s %10.4f   [%.4f, %.4f]\n", name.c_str(), scores[name].get<double>(), interval[0].get<double>(),
                  interval[1].get<double>());
}

void Run(RunArguments& a, const GlobalOptions& globals) {
  VlnRunOptions& options = a.options;
  ChoiceOf<int>("--agent", a.agent, kAgentNames);
  options.agent = a.agent;
  options.view = ChoiceOf<VlnView>("--view", a.view, kViewNames);
  if (!a.decisions.empty()) options.decisions = ChoiceOf<Decisions>("--decisions", a.decisions, kDecisionNames);
  options.protocol = a.protocol;
  options.out = a.out;
  CheckOutFile(a.out);
  CheckRenderSettings(options.picture, "--");
  if (a.agent == "exec") {
    std::istringstream words(a.program);
    for (std::string word; words >> word;) options.exec.command.push_back(word);
  } else if (!a.program.empty()) {
    throw InputError("--program: only --agent exec runs a program");
  }
  if (a.agent == "openai") {
    const ChatOptions given = options.chat;
    options.chat = ChatOptionsFromEnvironment();
    options.chat.seconds = given.seconds;
    options.chat.tries = given.tries;
    options.chat.first_wait = given.first_wait;
    options.chat.per_minute = given.per_minute;
  }
  options.exec.seconds = options.chat.seconds;
  if (!(options.chat.seconds > 0 && options.chat.seconds <= 3600)) throw InputError("--timeout: is not in 0 … 3600 s");
  if (options.chat.tries < 1 || options.chat.tries > 20)
    throw InputError("--tries: " + std::to_string(options.chat.tries) + " is not in 1 … 20");
  if (!(options.chat.first_wait >= 0 && options.chat.first_wait <= 60)) throw InputError("--retry-wait: is not in 0 … 60 s");
  if (!(options.chat.per_minute >= 0 && options.chat.per_minute <= 1e6)) throw InputError("--per-minute: is not in 0 … 1000000");
  options.open = [&](const std::string& world, uint64_t seed, int64_t people) { return Open(globals, world, seed, people); };
  PrintScores(RunEpisodes(ReadEpisodes(a.file), options), a.out, globals);
}

void AddRun(CLI::App& parent, GlobalOptions& globals) {
  CLI::App* command =
      parent.add_subcommand("run", "flies episodes with an agent and scores it; the same line again goes on after an interruption");
  const auto a = std::make_shared<RunArguments>();
  command->add_option("file", a->file, "episodes.jsonl")->required();
  command->add_option("--agent", a->agent, "oracle, random, forward, heuristic, mask, exec or openai (default oracle)");
  command->add_option("--view", a->view, "erp, front or cube6 (default erp)");
  command->add_option("--decisions", a->decisions, "yomo, discrete or waypoints (default: the protocol's)");
  command->add_option("--protocol", a->protocol, "ours, aerialvln, openfly, citynav, traveluav or uavon (default ours)");
  command->add_option("--program", a->program, "of agent exec: program and arguments, apart by spaces");
  command->add_option("--limit", a->options.limit, "the first N episodes (default all)")->check(CLI::Range(1, 100000000));
  command->add_option("--workers", a->options.workers, "episodes at a time (default 1)");
  command->add_flag("--realtime", a->options.realtime, "what an agent takes to think passes in its episode too");
  command->add_option("--width", a->options.width, "of panoramas, pixels (default 1024)");
  command->add_option("--timeout", a->options.chat.seconds, "seconds for one answer of a program or a server (default 120)");
  command->add_option("--tries", a->options.chat.tries, "of a request where a server is busy (default 4)");
  command->add_option("--retry-wait", a->options.chat.first_wait, "seconds before a request is tried again, doubled each time (default 1)");
  command->add_option("--per-minute", a->options.chat.per_minute, "requests at most (default no limit)");
  AddConfigFlags(*command, [a](ConfigVisitor& v) { a->options.picture.Visit(v); });
  command->add_option("--out", a->out, "results.jsonl")->required();
  command->callback([a, &globals] { Run(*a, globals); });
}

// ------------------------------------------------------------------------------------------------ demos

struct DemoArguments {
  std::string file, out;
  DemoOptions options;
};

void Demos(DemoArguments& a, const GlobalOptions& globals) {
  a.options.out = a.out;
  a.options.open = [&](const std::string& world, uint64_t seed, int64_t people) { return Open(globals, world, seed, people); };
  const DemoSummary made = RecordDemos(ReadEpisodes(a.file), a.options);
  Json left_out = Json::array();
  for (const auto& [id, why] : made.left_out) left_out.push_back({{"id", id}, {"why", why}});
  if (globals.json) {
    PrintJson({{"out", a.out}, {"episodes", made.episodes}, {"steps", made.steps}, {"seconds", made.seconds}, {"left_out", left_out}});
    return;
  }
  std::printf("%lld flights, %lld steps, %s of flight in %s\n", static_cast<long long>(made.episodes), static_cast<long long>(made.steps),
              ClockText(made.seconds).c_str(), a.out.c_str());
  for (const auto& [id, why] : made.left_out) std::printf("left out: %s: %s\n", id.c_str(), why.c_str());
}

void AddDemos(CLI::App& parent, GlobalOptions& globals) {
  CLI::App* command =
      parent.add_subcommand("demos", "flights of the oracle for models that act: panoramas, states and actions ten times a second");
  const auto a = std::make_shared<DemoArguments>();
  command->add_option("file", a->file, "episodes.jsonl")->required();
  command->add_option("--layout", a->options.layouts, "jsonl, rlds or lerobot, or several (default jsonl)")->delimiter(',');
  command->add_option("--limit", a->options.limit, "the first N episodes (default all)")->check(CLI::Range(1, 100000000));
  command->add_option("--width", a->options.width, "of panoramas, pixels (default 512)");
  AddConfigFlags(*command, [a](ConfigVisitor& v) { a->options.picture.Visit(v); });
  command->add_option("--out", a->out, "folder; each layout has one of its name in it")->required();
  command->callback([a, &globals] { Demos(*a, globals); });
}

// ------------------------------------------------------------------------------------------------ report

struct ReportArguments {
  std::vector<std::string> files;
  std::string out, episodes;
  FailurePictureOptions pictures;
};

void Report(ReportArguments& a, const GlobalOptions& globals) {
  CheckOutFile(a.out);
  std::vector<VlnRun> runs;
  for (const std::string& file : a.files) runs.push_back({std::filesystem::path(file).stem().string(), ReadResults(file)});
  FailurePictures pictures;
  if (!a.episodes.empty()) {
    a.pictures.open = [&](const std::string& world, uint64_t seed, int64_t people) { return Open(globals, world, seed, people); };
    pictures = DrawFailures(runs, ReadEpisodes(a.episodes), a.pictures);
  }
  const std::string stem = std::filesystem::path(a.out).replace_extension("").string();
  WriteFileAtomically(stem + ".html", ReportHtml(runs, pictures));
  WriteFileAtomically(stem + ".md", ReportMarkdown(runs));
  if (globals.json)
    PrintJson({{"html", stem + ".html"}, {"markdown", stem + ".md"}, {"runs", runs.size()}, {"panoramas", pictures.size()}});
  else
    std::printf("%s.html\n%s.md\n", stem.c_str(), stem.c_str());
}

void AddReport(CLI::App& parent, GlobalOptions& globals) {
  CLI::App* command = parent.add_subcommand("report", "a page about runs, in HTML and Markdown: scores, decisions, maps, failures");
  const auto a = std::make_shared<ReportArguments>();
  command->add_option("files", a->files, "results.jsonl of one or more runs")->required();
  command->add_option("--episodes", a->episodes, "episodes.jsonl of the runs: failures are shown with their panoramas");
  command->add_option("--width", a->pictures.width, "of these panoramas, pixels (default 1024)");
  AddConfigFlags(*command, [a](ConfigVisitor& v) { a->pictures.picture.Visit(v); });
  command->add_option("--out", a->out, "report.html; report.md lies beside it")->required();
  command->callback([a, &globals] { Report(*a, globals); });
}

// ------------------------------------------------------------------------------------------------ submit, verify

struct SubmitArguments {
  std::string episodes, results, transcript, name, key, out;
};

void Submit(const SubmitArguments& a, const GlobalOptions& globals) {
  SubmissionFacts facts{a.name, std::string(kVersion), Sha256HexOfFile("/proc/self/exe")};
  if (!a.key.empty()) {
    facts.key = ReadTextFile(a.key, 1 << 20);
    try {
      PublicKeyOf(facts.key);
    } catch (const InputError& error) {
      throw InputError("--key: " + a.key + " " + error.what());
    }
  }
  WriteFileAtomically(a.out, PackSubmission(a.episodes, a.results, a.transcript, facts));
  if (globals.json)
    PrintJson({{"out", a.out}});
  else
    std::printf("%s\n", a.out.c_str());
}

void AddSubmit(CLI::App& parent, GlobalOptions& globals) {
  CLI::App* command = parent.add_subcommand("submit", "packs a run into one sealed file for a table of results");
  const auto a = std::make_shared<SubmitArguments>();
  command->add_option("episodes", a->episodes, "episodes.jsonl")->required();
  command->add_option("results", a->results, "results.jsonl")->required();
  command->add_option("--transcript", a->transcript, "RESULTS.transcript.jsonl, whose hash is kept");
  command->add_option("--name", a->name, "of the entry");
  command->add_option("--key", a->key, "PEM of an Ed25519 key (openssl genpkey -algorithm ed25519): signs it");
  command->add_option("--out", a->out, "submission.json")->required();
  command->callback([a, &globals] { Submit(*a, globals); });
}

struct VerifyArguments {
  std::string submission, episodes, signer;
  bool fly = false;
};

// The same flights once more.
std::vector<VlnResult> FlyAgain(const std::vector<LanguageEpisode>& episodes, const VlnResult& like, const GlobalOptions& globals) {
  if (like.agent == "exec" || like.agent == "openai")
    throw InputError("--fly: agent '" + like.agent + "' is not part of the program; its flights are scored again alone");
  VlnRunOptions options;
  options.agent = like.agent;
  options.view = ChoiceOf<VlnView>("view", like.view, kViewNames);
  options.decisions = ChoiceOf<Decisions>("decisions_by", like.decisions_by, kDecisionNames);
  options.protocol = like.protocol;
  options.open = [&](const std::string& world, uint64_t seed, int64_t people) { return Open(globals, world, seed, people); };
  return RunEpisodes(episodes, options);
}

void Verify(const VerifyArguments& a, const GlobalOptions& globals) {
  std::function<std::vector<VlnResult>(const std::vector<LanguageEpisode>&, const VlnResult&)> fly;
  if (a.fly) fly = [&](const std::vector<LanguageEpisode>& episodes, const VlnResult& like) { return FlyAgain(episodes, like, globals); };
  const std::vector<std::string> problems = VerifySubmission(a.submission, a.episodes, a.signer, fly);
  if (globals.json)
    PrintJson({{"submission", a.submission}, {"flown_again", a.fly}, {"problems", problems}});
  else if (problems.empty())
    std::printf("%s: all holds\n", a.submission.c_str());
  for (const std::string& problem : problems)
    if (!globals.json) std::printf("%s\n", problem.c_str());
  std::fflush(stdout);
  if (!problems.empty()) throw RuntimeError("vln verify: " + problems[0]);
}

void AddVerify(CLI::App& parent, GlobalOptions& globals) {
  CLI::App* command = parent.add_subcommand("verify", "scores a submission again, or flies it again; exit status 1 where it does not hold");
  const auto a = std::make_shared<VerifyArguments>();
  command->add_option("submission", a->submission, "submission.json")->required();
  command->add_option("episodes", a->episodes, "episodes.jsonl")->required();
  command->add_option("--signer", a->signer, "public key that it has to be signed with, 64 hexadecimal digits");
  command->add_flag("--fly", a->fly, "also fly again and compare byte for byte");
  command->callback([a, &globals] { Verify(*a, globals); });
}

}  // namespace airsim360

void AddVlnCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("vln", "vision-and-language navigation: episodes with proofs, agents, scores (docs/guide/vln.md)");
  command->require_subcommand(1);
  AddTemplates(*command, globals);
  AddMake(*command, globals);
  AddCheck(*command, globals);
  AddImportAndExport(*command, globals);
  AddRun(*command, globals);
  AddDemos(*command, globals);
  AddReport(*command, globals);
  AddSubmit(*command, globals);
  AddVerify(*command, globals);
}

}  // namespace airsim360

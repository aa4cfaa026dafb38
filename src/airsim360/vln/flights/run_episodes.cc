#include "airsim360/vln/flights/run_episodes.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <fstream>
#include <map>
#include <mutex>
#include <numbers>
#include <sstream>
#include <thread>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/transform.h"
#include "airsim360/vln/agents/observation.h"

namespace airsim360 {
namespace {

constexpr double kSpeed = 5;                                         // m/s
constexpr double kLongestFlight = 1800;                              // simulated seconds
constexpr int64_t kYomoTurns = 8;                                    // decisions of a flight of one move
constexpr size_t kPathStep = kPathEveryNs / Episode::kPathPeriodNs;  // every so many places of a flight are written
constexpr size_t kMostExplained = 3;                                 // faults told in an explanation

// As files hold it.
Vec3d Milli(Vec3d p) { return {std::round(p.x * 1000) / 1000, std::round(p.y * 1000) / 1000, std::round(p.z * 1000) / 1000}; }

double Degrees(double radians) { return std::round(std::remainder(radians, 2 * std::numbers::pi) / kDegree * 1000) / 1000; }

std::unique_ptr<VlnAgent> MakeAgent(const VlnRunOptions& options, const LanguageEpisode& episode, Transcript& transcript) {
  const std::string& name = options.agent;
  if (name == "oracle") return MakeOracleAgent();
  if (name == "random") return MakeRandomAgent(episode.seed);
  if (name == "forward") return MakeForwardAgent();
  if (name == "heuristic") return MakeHeuristicAgent();
  if (name == "mask") return MakeMaskAgent();
  if (name == "exec") return MakeExecAgent(options.exec);
  if (name == "openai") return MakeChatAgent(options.chat, transcript);
  throw InputError("--agent: " +
                   UnknownChoiceMessage("agent", name, std::vector<std::string>(std::begin(kAgentNames), std::end(kAgentNames))));
}

EpisodeSpec SpecOf(const LanguageEpisode& e, const FlightRules& protocol, double radius) {
  EpisodeSpec spec = SpecOf(e);
  spec.success_radius = radius;
  spec.speed = kSpeed;
  spec.presets = {protocol.forward, protocol.lateral, protocol.vertical, protocol.turn_deg * kDegree, 1};
  spec.max_steps = 1'000'000;
  spec.max_seconds = kLongestFlight;
  spec.end_on_collision = protocol.collision_ends;
  return spec;
}

// The protocol's, if it has one; the episode's where that is smaller, for its flight begins within the other, and a step fits into it.
double RadiusOf(const FlightRules& protocol, const LanguageEpisode& e) {
  const bool nearer = e.radius < protocol.radius && e.radius >= protocol.forward;
  return protocol.radius > 0 && !nearer ? protocol.radius : e.radius;
}

// Where the goal is many places: them, and the one that is nearest to the last of the flight.
void SetGoal(const LanguageEpisode& e, VlnResult& r) {
  if (e.places.empty()) return;
  r.places = e.places;
  r.places.insert(r.places.begin(), e.goal);
  r.goal = *std::ranges::min_element(r.places, {}, [&](Vec3d place) { return Norm(place - r.pred.back()); });
}

// A move as a path with points on its legs. An autopilot that is sent to a point climbs and flies level as fast as it can do
// either, so not along the straight line; along a path it does.
AgentAction Straightened(const AgentAction& action, Vec3d p, double yaw) {
  constexpr double kSpacing = 2, kShortest = 1;  // metres
  WaypointsAction way;
  if (const auto* goal = std::get_if<RelativeGoalAction>(&action)) {
    const double heading = yaw - goal->azimuth;
    const Vec3d to{std::cos(goal->elevation) * std::cos(heading), std::cos(goal->elevation) * std::sin(heading), std::sin(goal->elevation)};
    way = {.points = {p + to * goal->distance}, .speed = goal->speed, .face = goal->face};
  } else if (const auto* asked = std::get_if<WaypointsAction>(&action)) {
    way = *asked;
    if (way.body_frame)
      for (Vec3d& point : way.points) point = p + RotationZ(yaw) * point;
    way.body_frame = false;
  } else {
    return action;
  }
  std::vector<Vec3d> points;
  double length = 0;
  Vec3d last = p;
  for (const Vec3d& next : way.points) {
    const double leg = Norm(next - last);
    const int parts = std::max(1, static_cast<int>(std::ceil(leg / kSpacing)));
    for (int k = 1; k <= parts; ++k) points.push_back(last + (next - last) * (static_cast<double>(k) / parts));
    length += leg;
    last = next;
  }
  if (length < kShortest || points.size() < 2) return action;
  way.points = std::move(points);
  return way;
}

// Flies one episode.
class Flight {
 public:
  Flight(const VlnRunOptions& options, const FlightRules& protocol, std::shared_ptr<AgentWorld> world, Eyes& eyes,
         const LanguageEpisode& episode)
      : options_(options),
        protocol_(protocol),
        eyes_(eyes),
        episode_(episode),
        radius_(RadiusOf(protocol, episode)),
        decisions_(options.decisions.value_or(protocol.decisions)),
        solid_(world->stage().solid()),
        flight_(std::move(world), SpecOf(episode, protocol, radius_)) {
    flight_.Watch([this](const Episode& flight) {
      headings_.push_back(HeadingOfBody(flight.vehicle().motion.X_WB));
      if (options_.watch) options_.watch(flight);
    });
  }

  VlnResult Fly(VlnAgent& agent) {
    const int64_t most = decisions_ == Decisions::kYomo ? std::min(kYomoTurns, protocol_.steps) : protocol_.steps;
    std::string end, told;
    double yaw = episode_.start.yaw;
    while (flight_.end() == EpisodeEnd::kRunning && end.empty()) {
      if (result_.decisions >= most) {
        end = "max_steps";
        break;
      }
      VlnSituation situation{episode_, flight_, decisions_, result_.decisions, most - result_.decisions, radius_, *solid_, eyes_, told};
      const auto begun = std::chrono::steady_clock::now();
      Decision decision = agent.Decide(situation);
      if (options_.realtime) flight_.Wait(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
      ++result_.decisions;
      told.clear();
      Log(decision);
      for (std::string& fault : decision.faults) Note(fault);
      if (flight_.end() != EpisodeEnd::kRunning) break;
      if (decision.answer.action) told = Act(*decision.answer.action);
      if (!told.empty()) result_.log.back().told = internal::Tame(told, kLongestSaid);
      const double now = HeadingOfBody(flight_.vehicle().motion.X_WB);
      result_.yaw_turned_deg += std::abs(std::remainder(now - yaw, 2 * std::numbers::pi)) / kDegree;
      yaw = now;
      if (decision.give_up) end = "gave_up";
      if (decision.answer.stop && flight_.end() == EpisodeEnd::kRunning) flight_.Act(PresetAction{Preset::kStop});
    }
    if (end.empty()) end = kEpisodeEndNames[static_cast<int>(flight_.end())];
    Score(end);
    return std::move(result_);
  }

 private:
  // Where the drone is and what was said there; faults of the answer as what it was told.
  void Log(const Decision& decision) {
    const RigidTransform& X_WB = flight_.vehicle().motion.X_WB;
    const std::string said = decision.said.empty() ? AnswerText(decision.answer) : decision.said;
    std::string faults;
    for (const std::string& fault : decision.faults) faults += (faults.empty() ? "" : " | ") + fault;
    result_.log.push_back({flight_.seconds(), Milli(X_WB.p), Degrees(HeadingOfBody(X_WB)), internal::Tame(said, kLongestSaid),
                           internal::Tame(faults, kLongestSaid)});
  }

  void Note(const std::string& fault) {
    ++result_.faults;
    if (faults_.size() < kMostExplained) faults_.push_back(fault);
  }

  // What the drone says to it; "" = flown.
  std::string Act(const AgentAction& action) {
    const Vec3d before = flight_.vehicle().motion.X_WB.p;
    try {
      flight_.Act(Straightened(action, before, HeadingOfBody(flight_.vehicle().motion.X_WB)));
    } catch (const InputError& error) {
      Note(error.what());
      return error.what();
    }
    result_.moves += Norm(flight_.vehicle().motion.X_WB.p - before) > 0.5;
    return "";
  }

  void Score(const std::string& end) {
    VlnResult& r = result_;
    r.id = episode_.id;
    r.template_id = episode_.template_id;
    r.world = episode_.world;
    r.difficulty = episode_.difficulty;
    r.agent = options_.agent;
    r.view = kViewNames[static_cast<int>(options_.view)];
    r.decisions_by = kDecisionNames[static_cast<int>(decisions_)];
    r.protocol = protocol_.name;
    r.end = end;
    r.radius = radius_;
    r.collided = flight_.vehicle().collision.count > 0;
    const auto& path = flight_.path();
    for (size_t i = 0; i < path.size(); i += kPathStep) {
      r.pred.push_back(Milli(path[i]));
      r.heading_deg.push_back(Degrees(headings_[std::min(i, headings_.size() - 1)]));
    }
    r.pred.push_back(Milli(flight_.vehicle().motion.X_WB.p));
    r.heading_deg.push_back(Degrees(HeadingOfBody(flight_.vehicle().motion.X_WB)));
    SetGoal(episode_, r);
    r.ref = episode_.ref;
    for (const EpisodePart& part : episode_.before) r.parts.push_back(Milli(part.goal));
    r.geodesic_length = std::round(episode_.geodesic_length * 1000) / 1000;
    r.straight_length = Norm(episode_.goal - episode_.start.p_W);
    r.stopped = end == "stopped";
    const VlnScore score = ScoreOf(r);
    r.success = score.success > 0;
    r.oracle_success = score.oracle > 0;
    r.distance = score.error;
    r.path_length = score.length;
    r.seconds = flight_.seconds();
    r.explanation = Explanation();
  }

  std::string Explanation() const {
    std::string text = result_.success ? "" : Reason();
    if (result_.faults > 0) {
      text += (text.empty() ? "" : "; ") + std::to_string(result_.faults) + " faults: ";
      for (size_t i = 0; i < faults_.size(); ++i) text += (i ? " | " : "") + faults_[i];
    }
    return text.substr(0, 1500);
  }

  std::string Reason() const {
    char where[160];
    std::snprintf(where, sizeof(where), "%.1f m from the goal (radius %.1f m)", result_.distance, radius_);
    if (result_.end == "collision") return "touched something " + std::string(where);
    if (result_.end == "stopped")
      return result_.collided && FindVlnProtocol(protocol_.scores).collision_fails ? "touched something on the way"
                                                                                   : "stopped " + std::string(where);
    if (result_.end == "gave_up") return "gave up without answers " + std::string(where);
    return "ran out of " + std::string(result_.end == "max_steps" ? "decisions " : "time ") + where;
  }

  const VlnRunOptions& options_;
  const FlightRules& protocol_;
  Eyes& eyes_;
  const LanguageEpisode& episode_;
  double radius_;
  Decisions decisions_;
  std::shared_ptr<const RayTracer> solid_;
  Episode flight_;
  VlnResult result_;
  std::vector<std::string> faults_;
  std::vector<double> headings_;  // at each place of the path
};

VlnResult NotFlown(const LanguageEpisode& e, const VlnRunOptions& options, const FlightRules& rules, const std::string& why) {
  VlnResult r;
  r.id = e.id;
  r.template_id = e.template_id;
  r.world = e.world;
  r.difficulty = e.difficulty;
  r.agent = options.agent;
  r.view = kViewNames[static_cast<int>(options.view)];
  r.decisions_by = kDecisionNames[static_cast<int>(options.decisions.value_or(rules.decisions))];
  r.protocol = rules.name;
  r.radius = RadiusOf(rules, e);
  r.end = "not_flown";
  r.explanation = "the flight cannot begin: " + why;
  r.ref = e.ref;
  r.pred = {Milli(e.start.p_W)};
  SetGoal(e, r);
  r.distance = ScoreOf(r).error;
  return r;
}

// The whole lines that are there already; what was cut off is dropped.
std::vector<VlnResult> Resume(const std::filesystem::path& file) {
  std::vector<VlnResult> done;
  if (file.empty() || !std::filesystem::exists(file)) return done;
  const std::string text = ReadTextFile(file, uint64_t{8} << 30);
  size_t begin = 0, number = 0;
  for (size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    done.push_back(ParseResultLine(text.substr(begin, end - begin), file.string() + ":" + std::to_string(++number)));
  if (begin != text.size()) std::filesystem::resize_file(file, begin);
  return done;
}

void CheckSame(const VlnResult& r, const LanguageEpisode& e, const VlnRunOptions& options, const FlightRules& protocol,
               const std::string& file) {
  const std::string decisions = kDecisionNames[static_cast<int>(options.decisions.value_or(protocol.decisions))];
  if (r.id == e.id && r.agent == options.agent && r.protocol == protocol.name && r.decisions_by == decisions &&
      r.view == kViewNames[static_cast<int>(options.view)])
    return;
  throw InputError("--out: " + file + " holds results of another run (" + r.id + ", " + r.agent + ", " + r.view + ", " + r.decisions_by +
                   ", " + r.protocol + "); give another file");
}

// Workers take episodes in order; lines are written in order too.
class Crew {
 public:
  Crew(const std::vector<LanguageEpisode>& episodes, size_t first, size_t count, const VlnRunOptions& options, const FlightRules& protocol)
      : episodes_(episodes),
        options_(options),
        protocol_(protocol),
        transcript_(TranscriptFile(options)),
        next_(first),
        count_(count),
        written_(first),
        bar_("vln run", static_cast<int64_t>(count)) {
    if (!options.out.empty()) out_.open(options.out, std::ios::app | std::ios::binary);
    if (!options.out.empty() && !out_) throw RuntimeError("cannot write " + options.out.string());
  }

  std::vector<VlnResult> Run() {
    std::vector<std::thread> threads;
    const int workers = std::min<int>(options_.workers, static_cast<int>(std::max<size_t>(1, count_ - written_)));
    for (int i = 1; i < workers; ++i) threads.emplace_back([this] { Work(); });
    Work();
    for (std::thread& thread : threads) thread.join();
    if (error_) std::rethrow_exception(error_);
    return std::move(results_);
  }

 private:
  static std::filesystem::path TranscriptFile(const VlnRunOptions& options) {
    if (options.agent != "openai" || options.out.empty()) return {};
    return std::filesystem::path(options.out).replace_extension("").string() + ".transcript.jsonl";
  }

  // One after the other where the world changes: the stages of one world at a time are kept.
  std::pair<std::shared_ptr<Stage>, std::shared_ptr<SharedRenderers>> StageOf(const LanguageEpisode& e) {
    const std::lock_guard lock(stage_mutex_);
    const std::string key = e.world + "#" + std::to_string(e.world_seed) + "#" + std::to_string(e.people);
    const bool is_new = key != stage_key_;
    if (is_new) {
      stage_ = options_.open(e.world, e.world_seed, e.people);
      stage_->solid();
      renderers_ = std::make_shared<SharedRenderers>(stage_);
      stage_key_ = key;
    }
    if (e.things.count > 0 && (is_new || e.things != things_)) {
      things_ = e.things;
      if (const std::string changed = ThingsDiffer(things_, stage_->scene()); !changed.empty()) LogWarning(e.id + ": " + changed);
    }
    return {stage_, renderers_};
  }

  // An episode that cannot begin here (imported ones may start inside a wall) is a result too.
  VlnResult FlyOne(const std::shared_ptr<AgentWorld>& world, Eyes& eyes, const LanguageEpisode& episode) {
    const auto agent = MakeAgent(options_, episode, transcript_);
    std::optional<Flight> flight;
    try {
      flight.emplace(options_, protocol_, world, eyes, episode);
    } catch (const InputError& error) {
      return NotFlown(episode, options_, protocol_, error.what());
    }
    return flight->Fly(*agent);
  }

  void Work() {
    std::shared_ptr<Stage> stage;
    std::shared_ptr<AgentWorld> world;
    std::unique_ptr<Eyes> eyes;
    try {
      for (size_t i; !failed_ && (i = next_++) < count_;) {
        const LanguageEpisode& episode = episodes_[i];
        if (auto [now, renderers] = StageOf(episode); now != stage) {
          eyes.reset();
          stage = now;
          world = std::make_shared<AgentWorld>(stage, options_.picture);
          eyes = std::make_unique<Eyes>(std::move(renderers), options_.view, options_.picture, options_.width);
        }
        Put(i, FlyOne(world, *eyes, episode));
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
      failed_ = true;
    }
  }

  void Put(size_t i, VlnResult result) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(i, std::move(result));
    for (auto next = waiting_.find(written_); next != waiting_.end(); next = waiting_.find(written_)) {
      const std::string line = ResultLine(next->second);
      if (out_.is_open()) {
        out_ << line << '\n' << std::flush;
        if (!out_) throw RuntimeError("cannot write " + options_.out.string());
      }
      // As it will be read again.
      results_.push_back(ParseResultLine(line, next->second.id));
      waiting_.erase(next);
      bar_.Update(static_cast<int64_t>(++written_));
    }
  }

  const std::vector<LanguageEpisode>& episodes_;
  const VlnRunOptions& options_;
  const FlightRules& protocol_;
  Transcript transcript_;
  std::atomic<size_t> next_;
  size_t count_;
  std::atomic<bool> failed_ = false;
  std::mutex stage_mutex_;
  std::string stage_key_;
  WorldThings things_;  // of the episode before
  std::shared_ptr<Stage> stage_;
  std::shared_ptr<SharedRenderers> renderers_;
  std::mutex mutex_;  // of what follows
  size_t written_;
  std::map<size_t, VlnResult> waiting_;
  std::vector<VlnResult> results_;
  std::ofstream out_;
  std::exception_ptr error_;
  ProgressBar bar_;
};

}  // namespace

VlnScore ScoreOf(const VlnResult& r) {
  // As a file holds them, so that whoever reads it finds the same.
  return ScoreVln({.reference = r.ref,
                   .flown = r.pred,
                   .goal = r.goal,
                   .places = r.places,
                   .shortest = r.geodesic_length > 0 ? std::optional(r.geodesic_length) : std::nullopt,
                   .stopped = r.stopped,
                   .collided = r.collided},
                  r.radius, FindVlnProtocol(FindFlightRules(r.protocol).scores));
}

double ProcessFidelity(const VlnResult& r) {
  size_t done = 0;
  for (const Vec3d& p : r.pred)
    while (done < r.parts.size() && Norm(p - r.parts[done]) <= r.radius) ++done;
  const bool last = done == r.parts.size() && ScoreOf(r).success > 0;
  return static_cast<double>(done + (last ? 1 : 0)) / static_cast<double>(r.parts.size() + 1);
}

std::vector<VlnResult> RunEpisodes(const std::vector<LanguageEpisode>& episodes, const VlnRunOptions& options) {
  const FlightRules& protocol = FindFlightRules(options.protocol);
  if (options.workers < 1 || options.workers > 256)
    throw InputError("--workers: " + std::to_string(options.workers) + " is not in 1 … 256");
  if (options.width < 64 || options.width > 4096 || options.width % 2 != 0)
    throw InputError("--width: " + std::to_string(options.width) + " is no even number in 64 … 4096");
  if (options.limit < 0) throw InputError("--limit: " + std::to_string(options.limit) + " is below 0");
  size_t count = episodes.size();
  if (options.limit > 0) count = std::min(count, static_cast<size_t>(options.limit));
  Transcript nothing("");
  MakeAgent(options, episodes.front(), nothing);  // its mistakes before a world is opened
  std::vector<VlnResult> results = Resume(options.out);
  if (results.size() > count) results.resize(count);
  for (size_t i = 0; i < results.size(); ++i) CheckSame(results[i], episodes[i], options, protocol, options.out.string());
  if (results.size() == count) return results;
  Crew crew(episodes, results.size(), count, options, protocol);
  for (VlnResult& result : crew.Run()) results.push_back(std::move(result));
  return results;
}

}  // namespace airsim360

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/planning/routes/search.h"
#include "airsim360/routes/roadmap.h"
#include "airsim360/vln/episodes/make_episodes.h"
#include "airsim360/vln/episodes/places.h"
#include "airsim360/vln/predicates/brute_force.h"

namespace airsim360 {
namespace {

constexpr double kFree = 0.45;   // metres around the way
constexpr double kTight = 0.02;  // metres less than was planned with, in rooms
constexpr double kSame = 2e-3;   // metres: points of a file are rounded
constexpr double kBeside = 3;    // metres from a thing in a room to places that count as there
constexpr double kAtThing = 12;  // metres from a goal to the thing that it belongs to

std::string NameOf(const Scene& scene, const std::vector<EntityId>& entities) {
  return "'" + scene.entity(entities.front()).name + "' (entity " + std::to_string(entities.front()) + ")";
}

class Checker {
 public:
  explicit Checker(const std::shared_ptr<Stage>& stage)
      : stage_(stage),
        brute_(stage->shared_scene()),
        free_(internal::VlnGround(stage->solid()).rooms() ? internal::kNarrowWay - kTight : kFree) {}

  /// Empty if all is well.
  std::string Problem(const LanguageEpisode& e) {
    const std::string changed = Changed(e.things), what = Proof(e);
    return changed.empty() || what.empty() ? changed + what : what + "; " + changed;
  }

 private:
  // What is new of the world; looked up once for each world that episodes were made in.
  const std::string& Changed(const WorldThings& made_in) {
    const auto [entry, is_new] = changes_.try_emplace({made_in.count, made_in.sha256});
    if (is_new) entry->second = ThingsDiffer(made_in, stage_->scene());
    return entry->second;
  }

  std::string Proof(const LanguageEpisode& e) {
    const Scene& scene = stage_->scene();
    if (!IsBound(e)) return "not unique: it was imported, and no query says what is meant";
    for (const EntityId id : e.entities)
      if (id > scene.entities.size())
        return "entity " + std::to_string(id) + " is not in the world, which has " + std::to_string(scene.entities.size());
    if (!e.before.empty() && !e.turn) return "it has several parts, but 'turn' is missing";
    if (!e.before.empty() && std::ranges::any_of(e.before.front().query.predicates, &Predicate::at_turn))
      return "its first part is seen from a turn";
    for (const EpisodePart& part : e.before)
      for (const EntityId id : part.entities)
        if (id > scene.entities.size())
          return "entity " + std::to_string(id) + " is not in the world, which has " + std::to_string(scene.entities.size());
    for (const Predicate& predicate : e.query.predicates)
      if (predicate.at_turn && !e.turn) return "a predicate is seen from where the instruction turns, but 'turn' is missing";
    std::string what = Uniqueness(e.query, {e.start, e.turn}, e.entities);
    for (size_t i = 0; i < e.before.size() && what.empty(); ++i) what = Part(e, i);
    if (what.empty()) what = Way(e);
    if (what.empty()) what = Places(e);
    return what.empty() ? Place(e.entities, e.goal_kind, e.before.empty() ? e.start.p_W : e.before.back().goal, e.goal) : what;
  }

  std::string Uniqueness(const Query& query, const Standpoint& stands, const std::vector<EntityId>& entities) {
    const auto answers = brute_.Answers(query, stands);
    if (answers.empty()) return "not unique: no " + query.noun.word + " answers the instruction";
    if (answers.size() > 1) {
      std::string names;
      for (size_t i = 0; i < std::min<size_t>(answers.size(), 4); ++i) names += (i ? ", " : "") + NameOf(stage_->scene(), answers[i]);
      return "not unique: " + std::to_string(answers.size()) + " compete: " + names;
    }
    if (answers[0] != entities)
      return "not unique: the instruction means " + NameOf(stage_->scene(), answers[0]) + ", not " + NameOf(stage_->scene(), entities);
    return "";
  }

  // One of several parts: what it means from where the one before ended, that the way leads there, and that it ends at the thing.
  std::string Part(const LanguageEpisode& e, size_t i) {
    const EpisodePart& part = e.before[i];
    const std::string which = "part " + std::to_string(i + 1) + ": ";
    const Vec3d from = i == 0 ? e.start.p_W : e.before[i - 1].goal;
    const Viewpoint& after = i + 1 < e.before.size() ? e.before[i + 1].seen_from : *e.turn;
    const Vec3d flown = part.goal - from;
    if (Norm(part.seen_from.p_W - from) > kSame || Norm(after.p_W - part.goal) > kSame)
      return which + "it is not seen from where the one before ended";
    if (std::abs(std::remainder(after.yaw - std::atan2(flown.y, flown.x), 2 * std::numbers::pi)) > 1e-3)
      return which + "what follows is not seen in the direction of its flight";
    if (std::ranges::none_of(e.ref, [&](Vec3d p) { return Norm(p - part.goal) <= kSame; }))
      return "not reachable: the way does not lead over " + NameOf(stage_->scene(), part.entities);
    std::string what = Uniqueness(part.query, i == 0 ? Standpoint{e.start, {}} : Standpoint{e.start, part.seen_from}, part.entities);
    if (what.empty()) what = Place(part.entities, part.goal_kind, from, part.goal);
    return what;
  }

  std::string Way(const LanguageEpisode& e) const {
    if (Norm(e.ref.front() - e.start.p_W) > kSame) return "not reachable: the way does not begin at the start";
    if (Norm(e.ref.back() - e.goal) > kSame) return "not reachable: the way does not end at the goal";
    for (size_t i = 1; i < e.ref.size(); ++i)
      if (!IsFree(*stage_->solid(), e.ref[i - 1], e.ref[i], free_))
        return "not reachable: leg " + std::to_string(i) + " of the way comes nearer than " + std::to_string(free_).substr(0, 4) +
               " m to a surface";
    if (std::abs(PolylineLength(e.ref) - e.geodesic_length) > 0.01) return "geodesic_length is not the length of the way";
    return "";
  }

  // What counts as the goal too.
  std::string Places(const LanguageEpisode& e) {
    for (size_t i = 0; i < e.places.size(); ++i) {
      const std::string which = "place " + std::to_string(i + 1) + " of the goal ";
      if (const double off = brute_.Distance(e.entities, e.places[i]); off > kBeside)
        return which + "is " + std::to_string(off) + " m from " + NameOf(stage_->scene(), e.entities);
      if (const double off = brute_.HeightApart(e.entities, e.places[i]); off > kBeside)
        return which + "is " + std::to_string(off) + " m above or below " + NameOf(stage_->scene(), e.entities);
      if (!IsFree(*stage_->solid(), e.places[i], e.places[i], free_)) return which + "is not free";
    }
    return "";
  }

  std::string Place(const std::vector<EntityId>& entities, GoalKind kind, Vec3d from, Vec3d goal) {
    const bool beyond =
        kind == GoalKind::kStreetBeyond || kind == GoalKind::kPathBeyond || kind == GoalKind::kFarEnd || kind == GoalKind::kOtherSide;
    if (beyond) return brute_.Passes(entities, from, goal) ? "" : "the goal is not beyond " + NameOf(stage_->scene(), entities);
    const double off = brute_.Distance(entities, goal);
    return off <= kAtThing ? "" : "the goal is " + std::to_string(off) + " m from " + NameOf(stage_->scene(), entities);
  }

  std::shared_ptr<Stage> stage_;
  BruteForce brute_;
  double free_;  // metres around the way
  std::map<std::pair<size_t, std::string>, std::string> changes_;
};

}  // namespace

std::vector<VlnComplaint> CheckEpisodes(const std::vector<LanguageEpisode>& episodes,
                                        const std::function<std::shared_ptr<Stage>(const std::string& world, uint64_t seed)>& open) {
  // One world at a time.
  std::map<std::pair<std::string, uint64_t>, std::vector<size_t>> by_world;
  for (size_t i = 0; i < episodes.size(); ++i) by_world[{episodes[i].world, episodes[i].world_seed}].push_back(i);
  std::map<size_t, VlnComplaint> complaints;
  ProgressBar bar("vln check", static_cast<int64_t>(episodes.size()));
  int64_t done = 0;
  for (const auto& [world, members] : by_world) {
    Checker checker(open(world.first, world.second));
    for (const size_t i : members) {
      std::string what = checker.Problem(episodes[i]);
      if (!what.empty()) complaints[i] = {episodes[i].id, std::move(what)};
      bar.Update(++done);
    }
  }
  std::vector<VlnComplaint> list;
  for (auto& [i, complaint] : complaints) list.push_back(std::move(complaint));
  return list;
}

}  // namespace airsim360

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string_view>

#include "airsim360/base/error.h"
#include "airsim360/vln/predicates/predicate_values.h"
#include "airsim360/vln/predicates/query.h"

namespace airsim360 {
namespace {

using internal::Candidate;

constexpr size_t kMostCompetitors = 4;
constexpr double kApart = 1.5;     // metres at least between one and the next on the way
constexpr double kLopsided = 0.1;  // share of a box's longer side that its middle may be off the middle of a leaning crown
constexpr size_t kMostNamed = 3;

std::string Text(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", value);
  return text;
}

std::string NamesOf(const std::vector<Competitor>& competitors, const std::string& unit) {
  std::string names;
  for (size_t i = 0; i < std::min(competitors.size(), kMostNamed); ++i) {
    const Competitor& c = competitors[i];
    names += (i ? ", " : "") + ("'" + c.name + "' (entity " + std::to_string(c.entity) + ", " + Text(c.value) + " " + unit + ")");
  }
  return names;
}

// The closest calls first.
void Keep(ProofStep& step, std::vector<Competitor> calls) {
  std::ranges::stable_sort(calls, {}, [&](const Competitor& c) { return std::abs(c.value - step.value); });
  calls.resize(std::min(calls.size(), kMostCompetitors));
  step.competitors = std::move(calls);
}

// Drops what does not hold; what is too close to tell stays as a competitor.
ProofStep Filter(std::vector<Candidate>& candidates, const Predicate& predicate, const internal::ValueOf& value_of) {
  ProofStep step{
      kPredicateNames[static_cast<int>(predicate.kind)], value_of.unit, static_cast<int>(candidates.size()), 0, 0, 1e9, value_of.needed};
  std::vector<Competitor> calls;
  std::vector<Candidate> kept;
  for (Candidate& candidate : candidates) {
    const double value = value_of.value(*candidate.thing);
    step.margin = std::min(step.margin, std::abs(value));
    if (value <= -step.needed) {
      calls.push_back({candidate.thing->entities.front(), candidate.thing->name, value});
      continue;
    }
    candidate.sure = candidate.sure && value >= step.needed;
    step.value = value;
    kept.push_back(candidate);
  }
  candidates = std::move(kept);
  step.after = static_cast<int>(candidates.size());
  std::ranges::stable_sort(calls, std::greater<>{}, &Competitor::value);
  calls.resize(std::min(calls.size(), kMostCompetitors));
  step.competitors = std::move(calls);
  return step;
}

// Leaves the nearest: its surfaces are surely nearer than those of any other, by what people can tell.
ProofStep KeepNearest(std::vector<Candidate>& candidates, const Viewpoint& view, std::string& why) {
  ProofStep step{"nearest", "m", static_cast<int>(candidates.size()), 1, 0, 0, 0};
  const auto bounds = [&](const Candidate& c) { return PlanDistance(view.p_W, c.thing->box); };
  size_t best = 0;
  for (size_t i = 1; i < candidates.size(); ++i)
    if (bounds(candidates[i]).most < bounds(candidates[best]).most) best = i;
  step.value = bounds(candidates[best]).most;
  step.needed = NearestMargin(step.value);
  std::vector<Competitor> calls;
  double next = 1e9;
  for (size_t i = 0; i < candidates.size(); ++i) {
    if (i == best) continue;
    const double least = bounds(candidates[i]).least;
    next = std::min(next, least);
    calls.push_back({candidates[i].thing->entities.front(), candidates[i].thing->name, least});
  }
  step.margin = next - step.value;
  Keep(step, std::move(calls));
  if (step.margin < step.needed)
    why = "'" + candidates[best].thing->name + "' (entity " + std::to_string(candidates[best].thing->entities.front()) + ", at most " +
          Text(step.value) + " m) and " + NamesOf(step.competitors, "m at least") + " compete for nearest";
  candidates = {candidates[best]};
  return step;
}

ProofStep KeepOrdinal(std::vector<Candidate>& candidates, const Viewpoint& view, int k, std::string& why) {
  ProofStep step{"ordinal", "m ahead", static_cast<int>(candidates.size()), 1, 0, 1e9, 0};
  std::ranges::stable_sort(candidates, {}, [&](const Candidate& c) { return InHeading(view, c.thing->center()).x; });
  const auto place = static_cast<size_t>(k - 1);
  if (place >= candidates.size()) {
    why = "there are only " + std::to_string(candidates.size()) + " on the way, not " + std::to_string(k);
    candidates.clear();
    step.after = 0;
    return step;
  }
  const auto ahead = [&](size_t i) { return InHeading(view, candidates[i].thing->center()).x; };
  const auto blur = [&](size_t i) { return kLopsided * std::max(candidates[i].thing->size().x, candidates[i].thing->size().y); };
  step.value = ahead(place);
  // Of two on either side of a way nobody sees from afar which comes first.
  step.needed = std::max(kApart, NearestMargin(step.value));
  std::vector<Competitor> calls;
  for (size_t i = 0; i < candidates.size(); ++i) {
    // Also what comes before must be sure and well apart, or the count is not.
    if (i < place + 2 && i > 0) step.margin = std::min(step.margin, ahead(i) - ahead(i - 1) - blur(i) - blur(i - 1));
    if (i < place && !candidates[i].sure) why = "'" + candidates[i].thing->name + "' may or may not be one to count";
    if (i != place) calls.push_back({candidates[i].thing->entities.front(), candidates[i].thing->name, ahead(i)});
  }
  Keep(step, std::move(calls));
  if (step.margin < step.needed) why = NamesOf(step.competitors, "m ahead") + " are too close to each other to be counted";
  candidates = {candidates[place]};
  return step;
}

bool Holds(const std::vector<Thing>& things, const Thing& thing) {
  return std::ranges::any_of(things, [&](const Thing& other) { return other.entities == thing.entities; });
}

// What else people may call the same takes part, and is not to be the answer.
void AddRivals(const std::vector<Thing>& rivals, std::vector<Candidate>& candidates) {
  std::set<EntityId> own;
  for (const Candidate& candidate : candidates) own.insert(candidate.thing->entities.begin(), candidate.thing->entities.end());
  for (const Thing& rival : rivals)
    if (!own.contains(rival.entities.front())) candidates.push_back({&rival, true});
}

void Conclude(Verdict& verdict, std::vector<Candidate> candidates, const Query& query) {
  for (Candidate& candidate : candidates) verdict.answers.push_back(*candidate.thing);
  if (!verdict.why.empty()) return;
  std::vector<Competitor> rest;
  for (const Candidate& c : candidates) rest.push_back({c.thing->entities.front(), c.thing->name, 0});
  if (candidates.empty()) {
    const bool none = verdict.steps.empty() || verdict.steps.front().before == 0;
    verdict.why = none ? "the world has no " + query.noun.word
                       : "no " + query.noun.word + " passes '" + verdict.steps.back().predicate +
                             "'; closest: " + NamesOf(verdict.steps.back().competitors, verdict.steps.back().unit);
  } else if (candidates.size() > 1) {
    verdict.why = std::to_string(candidates.size()) + " compete: " + NamesOf(rest, "");
  } else if (!candidates[0].sure) {
    verdict.why = "'" + candidates[0].thing->name + "' is too close to the limit of a predicate to be sure";
  } else {
    verdict.decided = true;
  }
}

}  // namespace

double AzimuthOf(const Viewpoint& view, Vec3d p) {
  const double angle = view.yaw - std::atan2(p.y - view.p_W.y, p.x - view.p_W.x);
  return std::remainder(angle, 2 * std::numbers::pi) * 180 / std::numbers::pi;
}

Vec2d InHeading(const Viewpoint& view, Vec3d p) {
  const double c = std::cos(view.yaw), s = std::sin(view.yaw);
  const Vec3d d = p - view.p_W;
  return {c * d.x + s * d.y, -s * d.x + c * d.y};
}

Verdict Decide(SceneGraph& graph, const Query& query, const Standpoint& standpoint) {
  Verdict verdict;
  std::vector<Candidate> candidates;
  for (const Thing& thing : graph.Find(query.noun)) candidates.push_back({&thing, true});
  if (!candidates.empty() && Names(query.rivals)) AddRivals(graph.Find(query.rivals), candidates);
  for (const Predicate& predicate : query.predicates) {
    if (predicate.at_turn && !standpoint.turn) throw InputError("the instruction turns nowhere, but a predicate is seen from there");
    const Viewpoint& view = predicate.at_turn ? *standpoint.turn : standpoint.start;
    const bool ranks = predicate.kind == PredicateKind::kNearest || predicate.kind == PredicateKind::kOrdinal;
    if (!ranks) {
      verdict.steps.push_back(Filter(candidates, predicate, internal::ValueOfPredicate(graph, query.noun, predicate, view)));
    } else if (!candidates.empty()) {
      verdict.steps.push_back(predicate.kind == PredicateKind::kNearest ? KeepNearest(candidates, view, verdict.why)
                                                                        : KeepOrdinal(candidates, view, predicate.k, verdict.why));
    }
  }
  Conclude(verdict, std::move(candidates), query);
  if (verdict.decided && !Holds(graph.Find(query.noun), verdict.answers[0])) {
    verdict.decided = false;
    verdict.why = "'" + verdict.answers[0].name + "', which people may call " + query.noun.word + " too, is meant as well";
  }
  return verdict;
}

}  // namespace airsim360

#include "airsim360/sim/people_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/routes/roadmap.h"
#include "airsim360/sim/people/people.h"
#include "airsim360/trace/whereabouts.h"

namespace airsim360 {
namespace {

constexpr double kEyes = 1.5;        // metres of a person's face above the ground
constexpr double kNearest = 2;       // metres to a face: nearer is not safe
constexpr double kFarthest = 15;     // metres at which people no longer count
constexpr double kGood = 4.5;        // metres up to which nearer is no better
constexpr double kTurnSeconds = 1;   // before and after looking
constexpr double kNearSeconds = 40;  // stops farther away are looked for only where nearer ones show nobody
constexpr FlightLimits kCalm = {.speed = 3, .acceleration = 2, .corner = 1};
constexpr size_t kMostCandidates = 1200;
constexpr double kSpacing = 2.5;  // metres between candidates

// Where the people are second by second, as they live without the body.
class Tracks {
 public:
  explicit Tracks(const SimPeople& people) : people_(people), state_(*people.start) { Note(); }
  // Ground points of those who are in the world, by index; nullopt for the others.
  const std::vector<std::optional<Vec3d>>& At(double seconds) {
    const auto second = static_cast<size_t>(std::max(0.0, std::round(seconds)));
    constexpr int kTicks = 1'000'000'000 / kCrowdTickNs;
    while (places_.size() <= second) {
      for (int i = 0; i < kTicks; ++i) TickPeople(people_, {}, state_);
      Note();
    }
    return places_[second];
  }

 private:
  void Note() {
    std::vector<std::optional<Vec3d>> places(state_.crowd.people.size());
    for (size_t i = 0; i < places.size(); ++i) {
      if (state_.crowd.people[i].visible) places[i] = state_.crowd.people[i].p_WP;
    }
    places_.push_back(std::move(places));
  }
  const SimPeople& people_;
  PeopleState state_;
  std::vector<std::vector<std::optional<Vec3d>>> places_;
};

// Free places around where the people are now and a while later.
std::vector<Vec3d> PlacesAround(const RayTracer& tracer, Tracks& tracks, const PeopleSurveyOptions& options, double radius) {
  constexpr double kLater[] = {0, 20, 60};  // seconds
  std::vector<Vec3d> candidates;
  RngStream random(options.seed, "people survey");
  const size_t people = std::max<size_t>(tracks.At(0).size(), 1);
  const size_t each = std::clamp<size_t>(kMostCandidates / people, 1, 30);
  for (const double seconds : kLater) {
    for (const std::optional<Vec3d>& place : tracks.At(seconds)) {
      for (size_t k = 0; place && k < each; ++k) {
        // Low places more often: from above one sees hats.
        const double u = random.Uniform(), angle = random.Uniform(0, 2 * std::numbers::pi);
        const double height = options.min_height + u * u * (options.max_height - options.min_height);
        const double way = random.Uniform(kNearest, 8);
        candidates.push_back(*place + Vec3d{way * std::cos(angle), way * std::sin(angle), height});
      }
    }
  }
  std::vector<uint8_t> free(candidates.size());
  ParallelFor(static_cast<int64_t>(candidates.size()), [&](int64_t i) {
    const Vec3f p = VecCast<float>(candidates[static_cast<size_t>(i)]);
    // Outdoors as indoors there is ground not far below.
    free[static_cast<size_t>(i)] = tracer.Clearance(p, static_cast<float>(radius + 1)) >= radius &&
                                   tracer.Intersect(p, {0, 0, -1}, static_cast<float>(options.max_height + 2));
  });
  std::vector<Vec3d> places;
  for (size_t i = 0; i < candidates.size(); ++i) {
    const auto is_near = [&](Vec3d p) { return Norm(p - candidates[i]) < kSpacing; };
    if (free[i] && places.size() < kMostCandidates && std::ranges::none_of(places, is_near)) places.push_back(candidates[i]);
  }
  return places;
}

using Places = std::span<const std::optional<Vec3d>>;

// Someone whose face is seen: the direction, and the share of a picture that they fill.
struct Seen {
  size_t person;
  double weight;
  Vec3d to;
};

// Everybody seen from a place; nobody where someone would be too near.
std::vector<Seen> SeenFrom(const RayTracer& tracer, Vec3d eye, Places people) {
  std::vector<Seen> seen;
  for (size_t i = 0; i < people.size(); ++i) {
    if (!people[i]) continue;
    const Vec3d face = *people[i] + Vec3d{0, 0, kEyes}, to = face - eye;
    const double distance = Norm(to);
    if (distance < kNearest) return {};
    if (distance > kFarthest || tracer.Occluded(VecCast<float>(eye), VecCast<float>(face))) continue;
    seen.push_back({i, std::min(1.0, kGood * kGood / (distance * distance)), to});
  }
  return seen;
}

// Heading towards people, radians; nullopt where nobody is.
std::optional<double> HeadingTo(const std::vector<Seen>& seen) {
  Vec2d sum;
  for (const Seen& person : seen) {
    const double way = std::max(1e-6, std::hypot(person.to.x, person.to.y));
    sum = sum + Vec2d{person.to.x, person.to.y} * (person.weight / way);
  }
  if (std::hypot(sum.x, sum.y) < 1e-9) return std::nullopt;
  return std::atan2(sum.y, sum.x);
}

/// Flies from stop to stop, at rest at each.
class Tour {
 public:
  explicit Tour(Vec3d start, double yaw) : nodes_{{.t = 0, .p = start, .v = {}, .yaw = yaw}}, stops_{0} {}
  double time() const { return nodes_.back().t; }
  // Along `way` and on to the moment of looking, `yaw` at the end, or as it comes where there is nobody.
  void FlyTo(const std::vector<Vec3d>& way, const Route& leg, std::optional<double> yaw) {
    const double start = time() + kTurnSeconds;
    for (const RouteNode& node : leg.nodes()) nodes_.push_back({start + node.t, node.p, node.v, node.yaw});
    nodes_.push_back({time() + kTurnSeconds, way.back(), {}, yaw.value_or(nodes_.back().yaw)});
    stops_.push_back(time());
  }
  PeopleSurvey Finish() {
    PeopleSurvey survey{Route(std::move(nodes_)), {}};
    for (const double t : stops_) survey.stop_times_ns.push_back(std::llround(t * 1e9));
    return survey;
  }

 private:
  std::vector<RouteNode> nodes_;
  std::vector<double> stops_;
};

// Place with the best view now among those that lead to many others; nullopt if nobody is seen from any.
std::optional<size_t> FirstPlace(const Roadmap& map, const std::vector<double>& gains) {
  constexpr size_t kTries = 40;
  std::vector<size_t> order(gains.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::stable_sort(order, std::greater(), [&](size_t i) { return gains[i]; });
  std::optional<size_t> best;
  size_t most = 0;
  for (size_t k = 0; k < std::min(kTries, order.size()) && gains[order[k]] > 0; ++k) {
    const CheapestWays ways = FindCheapestWays(map, static_cast<int>(order[k]));
    const auto reached = static_cast<size_t>(std::ranges::count_if(ways.cost, [](double c) { return std::isfinite(c); }));
    if (reached > 2 * most) best = order[k], most = reached;
    if (2 * most >= order.size()) break;
  }
  return best;
}

/// Chooses the stops of a tour, one after the other: each shows most for the time that it takes.
class TourPlanner {
 public:
  TourPlanner(const SimModel& model, const PeopleSurveyOptions& options, double clearance)
      : tracer_(*model.tracer),
        options_(options),
        radius_(clearance + 0.2 * std::min(1.0, clearance)),
        tracks_(*model.people),
        seen_before_(model.people->cast.size()) {}

  std::optional<PeopleSurvey> Plan() {
    if (std::ranges::none_of(tracks_.At(0), [](const auto& place) { return place.has_value(); })) return std::nullopt;
    std::vector<Vec3d> places = PlacesAround(tracer_, tracks_, options_, radius_);
    viewpoints_ = places.size();
    // Ways between groups of people lead over other low places.
    const PlaceOptions low{.seed = options_.seed,
                           .radius = radius_,
                           .min_height = options_.min_height,
                           .max_height = options_.max_height,
                           .passages = options_.passages};
    std::ranges::move(FindFreePlaces(tracer_, low), std::back_inserter(places));
    if (viewpoints_ == 0) return std::nullopt;
    map_ = Connect(tracer_, std::move(places), radius_, BeginsUnderACeiling(tracer_.scene()) ? kNeighboursInRooms : kNeighboursInTowns);
    worth_.resize(viewpoints_);
    Rate([&](size_t i) { return Gain(i, tracks_.At(0)); });
    const std::optional<size_t> first = FirstPlace(map_, worth_);
    if (!first) return std::nullopt;
    size_t here = *first;
    Tour tour(map_.places[here], Look(here, tracks_.At(0)).value_or(0));
    for (int stop = 1; stop < options_.viewpoints; ++stop) {
      const CheapestWays ways = FindCheapestWays(map_, static_cast<int>(here));
      const size_t best = NextStop(here, ways, tour.time());
      if (!(worth_[best] > 0)) break;
      const std::vector<Vec3d> way = ShortWay(tracer_, map_, ways, best, radius_);
      std::vector<Vec3d> points = {map_.places[here]};
      points.insert(points.end(), way.begin(), way.end());
      const Route leg = RoundedRoute(points, kCalm);
      tour.FlyTo(way, leg, Look(best, tracks_.At(tour.time() + 2 * kTurnSeconds + leg.duration())));
      here = best;
    }
    return tour.Finish();
  }

 private:
  /// What a place shows, those weighing more who have been seen less.
  double Gain(size_t place, Places people) const {
    double sum = 0;
    for (const Seen& seen : SeenFrom(tracer_, map_.places[place], people)) sum += seen.weight / (1 + 3 * seen_before_[seen.person]);
    return sum;
  }

  /// Looks at people: notes who has been seen, and gives the heading.
  std::optional<double> Look(size_t place, Places people) {
    const std::vector<Seen> seen = SeenFrom(tracer_, map_.places[place], people);
    for (const Seen& person : seen) seen_before_[person.person] += person.weight;
    return HeadingTo(seen);
  }

  template <class Of>
  void Rate(const Of& of) {
    ParallelFor(static_cast<int64_t>(viewpoints_), [&](int64_t i) { worth_[static_cast<size_t>(i)] = of(static_cast<size_t>(i)); });
  }

  /// The stop that shows most for the time that it takes, when the body would be there; its worth is in worth_.
  size_t NextStop(size_t here, const CheapestWays& ways, double now) {
    const auto arrival = [&](size_t i) { return now + 2 * kTurnSeconds + 1 + ways.cost[i] / kCalm.speed; };
    size_t best = here;
    for (const double farthest : {kNearSeconds, std::numeric_limits<double>::infinity()}) {
      const auto in_reach = [&](size_t i) { return i != here && std::isfinite(ways.cost[i]) && arrival(i) - now <= farthest; };
      for (size_t i = 0; i < viewpoints_; ++i) {
        if (in_reach(i)) tracks_.At(arrival(i));  // before several threads ask
      }
      Rate([&](size_t i) { return in_reach(i) ? Gain(i, tracks_.At(arrival(i))) / (arrival(i) - now) : 0.0; });
      best = static_cast<size_t>(std::ranges::max_element(worth_) - worth_.begin());
      if (worth_[best] > 0) break;
    }
    return best;
  }

  const RayTracer& tracer_;
  const PeopleSurveyOptions& options_;
  const double radius_;  // rounded corners leave the legs by what is more than the clearance
  Tracks tracks_;
  size_t viewpoints_ = 0;  // the first of the places
  Roadmap map_;
  std::vector<double> seen_before_, worth_;
};

}  // namespace

std::optional<PeopleSurvey> PlanPeopleSurvey(const SimModel& model, const PeopleSurveyOptions& options) {
  if (!model.people) return std::nullopt;
  const double most = BeginsUnderACeiling(model.tracer->scene()) ? std::min(options.clearance, kClearanceInRooms) : options.clearance;
  for (double clearance = most; clearance > most / 20; clearance /= 2) {
    if (std::optional<PeopleSurvey> survey = TourPlanner(model, options, clearance).Plan()) return survey;
  }
  return std::nullopt;
}

std::optional<double> RatePeopleView(const RayTracer& world, Vec3d p_W, std::span<const std::optional<Vec3d>> people) {
  const auto is_near = [&](const auto& place) { return place && Norm(*place + Vec3d{0, 0, kEyes} - p_W) < kNearest; };
  if (std::ranges::any_of(people, is_near) || FindWhereabouts(world, p_W).kind != Whereabouts::Kind::kOpen) return std::nullopt;
  double sum = 0;
  for (const Seen& seen : SeenFrom(world, p_W, people)) sum += seen.weight;
  return sum;
}

}  // namespace airsim360

#include "airsim360/vln/episodes/make_episodes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/math/angles.h"
#include "airsim360/planning/routes/search.h"
#include "airsim360/vln/episodes/places.h"
#include "airsim360/vln/predicates/query_json.h"

namespace airsim360 {
namespace {

using internal::VlnGround;

constexpr int kDraws = 6000, kWays = 12, kLooks = 60;  // starts drawn for an episode; ways and things in sight looked for
constexpr double kPathSpacing = 2.5;                   // metres between points of the reference path, at most
constexpr double kOpenRadius = 20, kRoomRadius = 1.5;  // metres around the goal that count as there
constexpr double kNearRadius = 6, kNearGoal = 3;       // the same, and metres from the goal to the thing, where flights begin nearer
constexpr double kNearStart[2] = {9, 24};              // metres between start and thing there
constexpr double kLeastWay = 1.25;                     // radii between start and goal
constexpr double kEasy = 50, kHard = 100;              // metres: shorter, longer ways
constexpr double kNearlyStraight = 1.08;               // length of a flight by its straight line, that one can turn from by words

double Milli(double value) { return std::round(value * 1000) / 1000; }
Vec3d Milli(Vec3d p) { return {Milli(p.x), Milli(p.y), Milli(p.z)}; }
Viewpoint Milli(Viewpoint view) { return {Milli(view.p_W), Milli(view.yaw / kDegree) * kDegree}; }

std::vector<Vec3d> MilliOf(std::vector<Vec3d> points) {
  for (Vec3d& p : points) p = Milli(p);
  return points;
}

// With points on its legs too, so that paths can be compared point by point (nDTW counts them).
std::vector<Vec3d> Spaced(const std::vector<Vec3d>& way) {
  std::vector<Vec3d> points = {Milli(way.front())};
  for (size_t i = 1; i < way.size(); ++i) {
    const int parts = std::max(1, static_cast<int>(std::ceil(Norm(way[i] - way[i - 1]) / kPathSpacing)));
    for (int k = 1; k <= parts; ++k) points.push_back(Milli(way[i - 1] + (way[i] - way[i - 1]) * (static_cast<double>(k) / parts)));
  }
  return points;
}

SeenAtStart Look(Stage& stage, const Viewpoint& start, const std::vector<EntityId>& entities) {
  const RigidTransform X_WC = BodyPose(start.p_W, start.yaw, 0, 0) * CameraInBody();
  RenderRequest request = MakeRequest(Equirectangular{kSeenWidth, kSeenWidth / 2}, X_WC, Tier::kLabels,
                                      {.rgb = false, .range = true, .semantic = false, .entity = true});
  Frame frame;
  stage.renderer(Tier::kLabels).Render(request, frame);
  SeenAtStart seen;
  double sine = 0, cosine = 0, elevation = 0;
  for (int y = 0; y < kSeenWidth / 2; ++y) {
    for (int x = 0; x < kSeenWidth; ++x) {
      if (!std::ranges::binary_search(entities, frame.entity(x, y))) continue;
      const double azimuth = 2 * std::numbers::pi * ((x + 0.5) / kSeenWidth - 0.5), range = frame.range(x, y);
      if (range > 0 && (seen.range == 0 || range < seen.range)) seen.range = range;
      sine += std::sin(azimuth);
      cosine += std::cos(azimuth);
      elevation += 180 * (0.5 - 2 * (y + 0.5) / kSeenWidth);
      ++seen.pixels;
    }
  }
  if (seen.pixels == 0) return seen;
  seen.azimuth_deg = std::atan2(sine, cosine) / kDegree;
  seen.elevation_deg = elevation / static_cast<double>(seen.pixels);
  return seen;
}

std::string DifficultyOf(const LanguageEpisode& e) {
  const bool visible = e.seen.pixels >= kInSight;
  if (e.geodesic_length > kHard || (!visible && e.geodesic_length > kEasy)) return "hard";
  return visible && e.geodesic_length <= kEasy ? "easy" : "medium";
}

// The last of several seeds is a town that training has not seen.
std::string SplitOf(const LanguageEpisode& e, const VlnMakeOptions& options) {
  if (!options.split.empty()) return options.split;
  if (options.seeds > 1 && e.world_seed == options.seed + static_cast<uint64_t>(options.seeds) - 1) return "val_unseen";
  return MixBits(HashName(e.id)) % 5 == 0 ? "val_seen" : "train";
}

class Maker {
 public:
  Maker(const VlnMakeOptions& options, uint64_t world_seed)
      : options_(options),
        world_seed_(world_seed),
        stage_(options.open(world_seed)),
        graph_(stage_->shared_scene()),
        ground_(stage_->solid()),
        things_(ThingsOf(stage_->scene())),
        templates_(FindTemplates(options.templates, stage_->scene(), ground_.rooms())) {}

  int64_t count() const {
    const auto all = static_cast<int64_t>(templates_.size()) * options_.starts;
    return options_.limit > 0 ? std::min(all, options_.limit) : all;
  }

  void Make(VlnMade& made, ProgressBar& bar, int64_t& done) {
    std::map<LimitedPlace, LanguageEpisode> bound;
    std::map<LimitedPlace, Unbound> unbound, hidden;
    for (const LimitedPlace& place : InTurn()) {
      if (static_cast<int64_t>(bound.size()) == count()) break;
      const InstructionTemplate& wanted = templates_[place.first];
      std::string why;
      if (auto episode = Bind(wanted, place.second, why)) {
        if (!why.empty()) hidden[place] = {wanted.id, options_.world, world_seed_, place.second, std::move(why)};
        bound.emplace(place, std::move(*episode));
        bar.Update(done + static_cast<int64_t>(bound.size()));
      } else {
        unbound[place] = {wanted.id, options_.world, world_seed_, place.second, std::move(why)};
      }
    }
    done += count();
    bar.Update(done);
    for (auto& [place, episode] : bound) made.episodes.push_back(std::move(episode));
    for (auto& [place, what] : unbound) made.unbound.push_back(std::move(what));
    for (auto& [place, what] : hidden) made.hidden.push_back(std::move(what));
  }

 private:
  using LimitedPlace = std::pair<size_t, int>;  // a template and the number of a start

  // In which order episodes are made: as they are listed; with a limit one of each noun after the other, of each in a mixed order.
  std::vector<LimitedPlace> InTurn() const {
    std::vector<LimitedPlace> all;
    for (size_t t = 0; t < templates_.size(); ++t)
      for (int k = 0; k < options_.starts; ++k) all.emplace_back(t, k);
    if (options_.limit <= 0) return all;
    std::stable_sort(all.begin(), all.end(), [&](const LimitedPlace& a, const LimitedPlace& b) { return MixOf(a) < MixOf(b); });
    std::map<std::string, size_t> of_noun;
    std::vector<std::pair<size_t, LimitedPlace>> turns;
    for (const LimitedPlace& place : all) turns.emplace_back(of_noun[templates_[place.first].query.noun.word]++, place);
    std::ranges::stable_sort(turns, {}, [](const auto& turn) { return turn.first; });
    std::ranges::transform(turns, all.begin(), [](const auto& turn) { return turn.second; });
    return all;
  }

  uint64_t MixOf(const LimitedPlace& place) const {
    return MixBits(HashName(templates_[place.first].id + "/" + std::to_string(place.second)));
  }

  // A start that does not show enough of the thing.
  struct Hidden {
    Standpoint stands;
    Vec3d goal;
    int64_t pixels;
  };

  // What a search for a start has come across.
  struct Search {
    std::map<std::string, int> whys;
    std::vector<Hidden> hidden;
  };

  // Metres around the goal that count as there. Rooms are small.
  double RadiusOf(const InstructionTemplate& wanted) const {
    return wanted.radius > 0 ? wanted.radius : ground_.rooms() ? kRoomRadius : kOpenRadius;
  }

  // Pixels of the thing that a start has to show: that of words that say so, and the first of three.
  static int64_t NeededPixels(const InstructionTemplate& wanted, int k) {
    return wanted.in_sight > 0 ? wanted.in_sight : k % 3 == 0 ? kInSight : 0;
  }

  // A post box has eight pixels from where flights begin elsewhere, so that those to small things begin nearer and end nearer.
  std::optional<InstructionTemplate> Nearer(const InstructionTemplate& wanted) const {
    if (ground_.rooms() || wanted.frame != StartFrame::kAround || wanted.goal != GoalKind::kNear || wanted.radius > 0) return std::nullopt;
    InstructionTemplate nearer = wanted;
    nearer.nearest = kNearStart[0];
    nearer.farthest = std::min(kNearStart[1], wanted.farthest);
    nearer.radius = kNearRadius;
    nearer.distance = std::min(kNearGoal, wanted.distance);
    return nearer;
  }

  // `why`: of an episode that is there, that it shows less of the thing than it should.
  std::optional<LanguageEpisode> Bind(const InstructionTemplate& wanted, int k, std::string& why) {
    RngStream random(world_seed_, "vln " + wanted.id + " " + options_.world, static_cast<uint64_t>(k));
    Search search, closer;
    if (auto episode = Seek(wanted, k, random, search)) return episode;
    const auto nearer = search.hidden.empty() ? std::nullopt : Nearer(wanted);
    if (nearer)
      if (auto episode = Seek(*nearer, k, random, closer)) return episode;
    // What shows the most of a thing comes first.
    std::ranges::stable_sort(search.hidden, std::greater(), &Hidden::pixels);
    for (const Hidden& place : search.hidden) {
      if (wanted.in_sight > 0) break;
      std::string no;
      auto episode = Finish(wanted, k, place.stands, Decide(graph_, wanted.query, place.stands), Milli(place.goal), no);
      if (episode) why = TooLittle(place.pixels, NeededPixels(wanted, k));
      if (episode) return episode;
      ++search.whys[no];
    }
    why = "no start could be drawn: no open place of that kind around a " + wanted.query.noun.word;
    if (graph_.Find(wanted.query.noun).empty()) why = "the world has no " + wanted.query.noun.word;
    const auto most = std::ranges::max_element(search.whys, {}, [](const auto& entry) { return entry.second; });
    if (most != search.whys.end()) why = most->first;
    int64_t pixels = search.hidden.empty() ? 0 : search.hidden.front().pixels;
    for (const Hidden& place : closer.hidden) pixels = std::max(pixels, place.pixels);
    if (wanted.in_sight > 0 && !search.hidden.empty()) why = "no start in sight of it: " + TooLittle(pixels, wanted.in_sight);
    return std::nullopt;
  }

  static std::string TooLittle(int64_t pixels, int64_t needed) {
    return "a panorama of 512 x 256 shows " + std::to_string(pixels) + " pixels of it at most, " + std::to_string(needed) + " are needed";
  }

  std::optional<LanguageEpisode> Seek(const InstructionTemplate& wanted, int k, RngStream& random, Search& search) {
    // The k-th of three starts lies in the k-th third of the distances; what finds no place there may lie anywhere.
    const double ratio = std::cbrt(wanted.farthest / std::max(wanted.nearest, 1.0));
    const double least = wanted.nearest * std::pow(ratio, k % 3);
    const int64_t needed = NeededPixels(wanted, k);
    // Few places at an intersection show what stands around its corner.
    const int most_looks = wanted.frame == StartFrame::kTurn ? 6 * kLooks : kLooks;
    int ways = 0, looks = 0;
    for (int draw = 0; draw < kDraws && ways < kWays && looks < most_looks; ++draw) {
      const bool anywhere = draw > kDraws / 4 || looks > most_looks / 2;
      auto stands =
          DrawStart(ground_, graph_, wanted, anywhere ? wanted.nearest : least, anywhere ? wanted.farthest : least * ratio, random);
      if (!stands) continue;
      stands->start = Milli(stands->start);
      if (stands->turn) stands->turn = Milli(*stands->turn);
      const Verdict verdict = Decide(graph_, wanted.query, *stands);
      const auto goal = verdict.decided ? GoalOf(wanted, verdict, *stands, search) : std::nullopt;
      if (!verdict.decided) ++search.whys[verdict.why];
      if (!goal || Norm(*goal - stands->start.p_W) < kLeastWay * RadiusOf(wanted)) continue;
      // Where no way was found from elsewhere, as into a bathroom whose door is shut, one begins in the same room.
      if (ground_.rooms() && ways >= kWays / 2 && ground_.Meets(stands->start.p_W, *goal) != kNoEntity) continue;
      const Viewpoint& view = stands->turn ? *stands->turn : stands->start;
      const int64_t pixels = needed > 0 ? Look(*stage_, view, verdict.answers[0].entities).pixels : 0;
      if (pixels < needed) {
        ++looks;
        search.hidden.push_back({*stands, *goal, pixels});
        continue;
      }
      if (wanted.then.empty() || draw % 4 == 0) ++ways;  // several parts fail more often
      std::string no;
      if (auto episode = Finish(wanted, k, *stands, verdict, Milli(*goal), no)) return episode;
      ++search.whys[no];
    }
    return std::nullopt;
  }

  std::optional<Vec3d> GoalOf(const InstructionTemplate& wanted, const Verdict& verdict, const Standpoint& stands, Search& search) const {
    const Thing& thing = verdict.answers[0];
    // What was drawn is not always what is meant.
    if (PlanDistance(stands.start.p_W, thing.box).least > wanted.farthest) {
      ++search.whys["'" + thing.name + "' is farther than the instruction allows"];
      return std::nullopt;
    }
    const auto goal = FindGoal(ground_, wanted, thing, stands.start);
    if (!goal) ++search.whys["no free place to stop at '" + thing.name + "'"];
    return goal;
  }

  // What is behind an episode so far: where it has come to and how.
  struct Progress {
    Query query;
    Standpoint stands;
    Thing thing;
    GoalKind goal_kind;
    Vec3d goal;
    std::string proof;
    std::vector<Vec3d> way;
    std::vector<EpisodePart> before = {};
  };

  // The next part of an instruction, seen from where the last one ended. "" = done.
  std::string GoOn(Progress& at, const InstructionTemplate& wanted, const NextPart& part) {
    // Only a nearly straight flight has a direction that words can refer to.
    const Vec3d from = at.before.empty() ? at.stands.start.p_W : at.stands.turn->p_W, flown = at.goal - from;
    if (PolylineLength(at.way) > kNearlyStraight * Norm(flown) + LengthBefore(at))
      return "the way to '" + at.thing.name + "' is not straight enough to turn from";
    at.before.push_back({at.before.empty() ? at.stands.start : *at.stands.turn, at.query, at.thing.entities, at.thing.name, at.goal_kind,
                         at.goal, at.proof});
    at.stands.turn = Milli(Viewpoint{at.goal, std::atan2(flown.y, flown.x)});
    at.query = part.query;
    for (Predicate& predicate : at.query.predicates) predicate.at_turn = true;
    const Verdict verdict = Decide(graph_, at.query, at.stands);
    if (!verdict.decided) return verdict.why;
    at.thing = verdict.answers[0];
    InstructionTemplate like = wanted;
    like.goal = at.goal_kind = part.goal;
    like.distance = part.distance;
    const auto goal = FindGoal(ground_, like, at.thing, *at.stands.turn);
    if (!goal) return "no free place to stop at '" + at.thing.name + "'";
    const double leg = Norm(*goal - at.goal);
    if (leg < kLeastWay * RadiusOf(wanted) || leg > wanted.farthest) return "'" + at.thing.name + "' is too near or too far to go on to";
    const ShortestWay way = internal::FindWay(ground_, at.goal, Milli(*goal));
    if (!way.found) return "no way was found to '" + at.thing.name + "'";
    at.goal = Milli(*goal);
    at.way.insert(at.way.end(), way.points.begin() + 1, way.points.end());
    at.proof = internal::ToJson(verdict).dump();
    return "";
  }

  // Metres of the way that belong to the parts before the last.
  static double LengthBefore(const Progress& at) {
    double length = 0;
    if (at.before.empty()) return 0;
    for (size_t i = 1; i < at.way.size(); ++i) {
      length += Norm(at.way[i] - at.way[i - 1]);
      if (Norm(at.way[i] - at.before.back().goal) < 1e-9) return length;
    }
    return 0;
  }

  std::optional<LanguageEpisode> Finish(const InstructionTemplate& wanted, int k, const Standpoint& stands, const Verdict& verdict,
                                        Vec3d goal, std::string& why) {
    const ShortestWay way = internal::FindWay(ground_, stands.start.p_W, goal);
    if (!way.found) {
      why = "no way was found to '" + verdict.answers[0].name + "'";
      return std::nullopt;
    }
    const auto is_counted = [](const Predicate& p) { return p.clear > 0; };
    if (std::ranges::any_of(wanted.query.predicates, is_counted) &&
        PolylineLength(way.points) > kNearlyStraight * Norm(goal - stands.start.p_W)) {
      why = "the line to '" + verdict.answers[0].name + "' is not free";
      return std::nullopt;
    }
    Progress at{wanted.query, stands, verdict.answers[0], wanted.goal, goal, internal::ToJson(verdict).dump(), way.points};
    for (const NextPart& part : wanted.then)
      if (why = GoOn(at, wanted, part); !why.empty()) return std::nullopt;
    LanguageEpisode e;
    e.id = options_.world.substr(options_.world.rfind('/') + 1) + "/" + std::to_string(world_seed_) + "/" + wanted.id + "/" +
           std::to_string(k);
    e.template_id = wanted.id;
    e.instruction = wanted.text;
    e.world = options_.world;
    e.world_seed = world_seed_;
    e.things = things_;
    e.seed = MixBits(HashName(e.id)) >> 12;
    e.weather = options_.weather == "mix" ? kMixedWeathers[MixBits(e.seed) % std::size(kMixedWeathers)] : options_.weather;
    e.people = options_.people;
    e.start = stands.start;
    e.before = at.before;
    e.turn = at.stands.turn;
    e.query = at.query;
    e.entities = at.thing.entities;
    e.name = at.thing.name;
    e.goal_kind = at.goal_kind;
    e.goal = at.goal;
    e.radius = RadiusOf(wanted);
    if (ground_.rooms() && e.goal_kind == GoalKind::kNear) e.places = MilliOf(FindPlaces(ground_, wanted, at.thing, e.goal));
    e.ref = Spaced(at.way);
    e.geodesic_length = PolylineLength(e.ref);
    e.seen = Look(*stage_, e.start, e.entities);
    e.difficulty = DifficultyOf(e);
    e.split = SplitOf(e, options_);
    e.proof = at.proof;
    return e;
  }

  const VlnMakeOptions& options_;
  uint64_t world_seed_;
  std::shared_ptr<Stage> stage_;
  SceneGraph graph_;
  VlnGround ground_;
  WorldThings things_;
  std::vector<InstructionTemplate> templates_;
};

}  // namespace

VlnMade MakeEpisodes(const VlnMakeOptions& options) {
  const auto in = [](const char* flag, int64_t value, int64_t low, int64_t high) {
    if (value < low || value > high)
      throw InputError(std::string(flag) + ": " + std::to_string(value) + " is not in " + std::to_string(low) + " … " +
                       std::to_string(high));
  };
  in("--starts", options.starts, 1, 1000);
  in("--seeds", options.seeds, 1, 1000);
  in("--people", options.people, 0, 10'000);
  in("--limit", options.limit, 0, 1'000'000);
  if (options.templates == "paper37") PaperTemplates();
  VlnMade made;
  for (int k = 0; k < options.seeds; ++k) {
    Maker maker(options, options.seed + static_cast<uint64_t>(k));
    ProgressBar bar("vln make " + options.world + " seed " + std::to_string(options.seed + static_cast<uint64_t>(k)), maker.count());
    int64_t done = 0;
    maker.Make(made, bar, done);
  }
  return made;
}

}  // namespace airsim360

#include "airsim360/tasks/agent_server/episode.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/eval/navigation/path_metrics.h"
#include "airsim360/flight/drones/catalog.h"
#include "airsim360/routes/roadmap.h"

namespace airsim360 {
namespace {

constexpr double kOpenRadius = 20, kRoomRadius = 1;           // metres: default radius of success
constexpr double kNear = 0.25, kSlow = 0.35, kTurned = 0.04;  // at a target: metres, m/s, rad
constexpr double kSpacing = 1;                                // metres between points compared
constexpr int64_t kLengthPeriodNs = 20'000'000;               // how often the way flown is measured

// Points at even steps of about `spacing` metres along a polyline, its ends among them; at most about a thousand.
std::vector<Vec3d> Spaced(const std::vector<Vec3d>& points, double spacing) {
  constexpr double kMost = 1000;
  const double length = PathLength(points);
  const auto parts = static_cast<int>(std::clamp(std::ceil(length / spacing), 1.0, kMost));
  std::vector<Vec3d> spaced = {points.front()};
  double behind = 0;  // length of the way up to points[i - 1]
  for (size_t i = 1; i < points.size(); ++i) {
    const double step = Norm(points[i] - points[i - 1]);
    // Those that lie on this piece; the last point is added below.
    for (double at = length * static_cast<double>(spaced.size()) / parts; static_cast<int>(spaced.size()) < parts && at <= behind + step;
         at = length * static_cast<double>(spaced.size()) / parts)
      spaced.push_back(points[i - 1] + (points[i] - points[i - 1]) * ((at - behind) / std::max(step, 1e-12)));
    behind += step;
  }
  spaced.push_back(points.back());
  return spaced;
}

// About a thousand places of a path, its ends among them.
std::vector<Vec3d> Thinned(const std::vector<Vec3d>& path) {
  const size_t step = path.size() / 1000 + 1;
  std::vector<Vec3d> thinned;
  for (size_t i = 0; i + 1 < path.size(); i += step) thinned.push_back(path[i]);
  thinned.push_back(path.back());
  return thinned;
}

}  // namespace

Episode::Episode(std::shared_ptr<AgentWorld> world, EpisodeSpec spec) : world_(std::move(world)), spec_(std::move(spec)) {
  Check();
  Reset();
}

void Episode::Check() const {
  if (spec_.reference_path.size() > kMostReferencePoints)
    throw InputError("reference_path: " + std::to_string(spec_.reference_path.size()) + " points are more than " +
                     std::to_string(kMostReferencePoints));
  if (spec_.more_goals.size() > kMostReferencePoints)
    throw InputError("more_goals: " + std::to_string(spec_.more_goals.size()) + " places are more than " +
                     std::to_string(kMostReferencePoints));
}

double Episode::distance_to_goal() const {
  const Vec3d p = vehicle().motion.X_WB.p;
  double nearest = Norm(goal_W_ - p);
  for (const Vec3d& place : spec_.more_goals) nearest = std::min(nearest, Norm(place - p));
  return nearest;
}

void Episode::ChoosePlaces() {
  const bool open = world_->scene().sky_entity != kNoEntity;
  radius_ = spec_.success_radius > 0 ? spec_.success_radius : open ? kOpenRadius : kRoomRadius;
  start_W_ = spec_.start ? *spec_.start : world_->places().front();
  if (spec_.goal) {
    goal_W_ = *spec_.goal;
    return;
  }
  // A free place by the seed, farther away than where success begins; if there is none, the farthest.
  const std::vector<Vec3d>& places = world_->places();
  RngStream random(spec_.seed, "episode goal");
  const auto first = random.Index(static_cast<uint32_t>(places.size()));
  goal_W_ = places[first];
  for (size_t k = 0; k < places.size(); ++k) {
    const Vec3d place = places[(first + k) % places.size()];
    if (Norm(place - start_W_) > 2 * radius_) {
      goal_W_ = place;
      return;
    }
    if (Norm(place - start_W_) > Norm(goal_W_ - start_W_)) goal_W_ = place;
  }
}

void Episode::BuildModel() {
  SimModel model = world_->stage().Model();
  model.world.seed = spec_.seed;
  DroneSetup setup{.name = "agent", .model = CatalogModel(spec_.drone)};
  // What an agent is told is exact: no sensor of the drone needs to be stepped.
  setup.sensors = {};
  setup.X_WB = BodyPose(start_W_, spec_.start_yaw, 0, 0);
  setup.airborne = true;
  const SimDrone drone(setup, model.dt_ns);
  const std::string fault = PlaceFault(*model.tracer, start_W_, drone.radius());
  if (!fault.empty()) {
    const auto& places = world_->places();
    const Vec3d free = *std::ranges::min_element(places, {}, [&](Vec3d p) { return Norm(p - start_W_); });
    char text[240];
    std::snprintf(text, sizeof(text), "start.p: (%.2f, %.2f, %.2f) is not free: it %s; the nearest free place known is (%.2f, %.2f, %.2f)",
                  start_W_.x, start_W_.y, start_W_.z, fault.c_str(), free.x, free.y, free.z);
    throw InputError(text);
  }
  model.drones.push_back(std::make_shared<const SimDrone>(drone));
  loop_ = std::make_unique<SimLoop>(std::make_shared<const SimModel>(std::move(model)));
}

void Episode::Reset(std::optional<uint64_t> seed) {
  if (seed) spec_.seed = *seed;
  ChoosePlaces();
  BuildModel();
  end_ = EpisodeEnd::kRunning;
  steps_ = 0;
  setpoint_ = AgentPose{start_W_, spec_.start_yaw};
  length_ = 0;
  last_p_W_ = vehicle().motion.X_WB.p;
  path_ = {last_p_W_};
  nearest_ = distance_to_goal();
}

void Episode::Note(std::span<const SimEvent> happened) {
  for (const SimEvent& event : happened) {
    if (event.kind != SimEvent::Kind::kCommandRefused) continue;
    refused_ = true;
    refusal_ = event.text;
  }
  // The way flown, and what ends the episode on it.
  const Vec3d p = vehicle().motion.X_WB.p;
  if (state().t_ns % kLengthPeriodNs == 0) {
    length_ += Norm(p - last_p_W_);
    last_p_W_ = p;
    nearest_ = std::min(nearest_, distance_to_goal());
  }
  if (state().t_ns % kPathPeriodNs == 0) {
    path_.push_back(p);
    if (watch_) watch_(*this);
  }
  if (spec_.end_on_collision && vehicle().collision.count > 0) end_ = EpisodeEnd::kCollision;
  if (spec_.success == SuccessRule::kReach && distance_to_goal() <= radius_) end_ = EpisodeEnd::kReached;
  if (end_ == EpisodeEnd::kRunning && seconds() >= spec_.max_seconds) end_ = EpisodeEnd::kMaxSeconds;
}

bool Episode::Fly(int64_t until_ns, const ActionPlan* plan) {
  bool arrived = false;
  const int64_t dt_ns = loop_->model().dt_ns;
  if (end_ != EpisodeEnd::kRunning || until_ns <= state().t_ns) return false;
  loop_->AdvanceWhile((until_ns - state().t_ns + dt_ns - 1) / dt_ns, [&](const SimState&, std::span<const SimEvent> happened) {
    Note(happened);
    arrived = plan != nullptr && Arrived(*plan);
    return end_ == EpisodeEnd::kRunning && !arrived && !refused_;
  });
  return arrived;
}

std::shared_ptr<const SceneState> Episode::moved() const {
  return loop_->model().people ? SceneStateOf(loop_->model(), state(), 0) : nullptr;
}

bool Episode::Arrived(const ActionPlan& plan) const {
  const Kinematics& motion = vehicle().motion;
  if (!plan.target || Norm(motion.X_WB.p - plan.target->p_W) > kNear || Norm(motion.v_WB) > kSlow) return false;
  if (std::isnan(plan.target->yaw)) return true;
  const double turn = std::remainder(plan.target->yaw - HeadingOfBody(motion.X_WB), 2 * std::numbers::pi);
  return std::abs(turn) <= kTurned;
}

// Presets start from where the last one was meant to end, so that 24 turns of 15 degrees are a full one.
AgentPose Episode::Setpoint() const {
  const RigidTransform& X_WB = vehicle().motion.X_WB;
  if (setpoint_ && Norm(setpoint_->p_W - X_WB.p) < 2 * kNear) return *setpoint_;
  return {X_WB.p, HeadingOfBody(X_WB)};
}

void Episode::Act(const AgentAction& action) {
  if (end_ != EpisodeEnd::kRunning)
    throw InputError("action: the episode is over (" + std::string(kEpisodeEndNames[static_cast<int>(end_)]) + "); reset it first");
  const ActionPlan plan = PlanAction(action, Setpoint(), spec_.presets, spec_.speed);
  if (plan.stops) {
    ++steps_;
    end_ = EpisodeEnd::kStopped;
    return;
  }
  const std::string problem = CommandProblem(plan.command, loop_->model().drones[0]->model());
  if (!problem.empty()) throw InputError("action: the drone cannot fly this: " + problem);

  ++steps_;
  refused_ = false;
  loop_->Post({0, FlightCommand{plan.command, plan.timeout_ns}});
  const bool arrived = Fly(state().t_ns + std::llround(1e9 * std::min(plan.seconds, kLongestAction)), &plan);
  setpoint_.reset();
  if (arrived) {
    setpoint_ = plan.target;
    if (std::isnan(setpoint_->yaw)) setpoint_->yaw = HeadingOfBody(vehicle().motion.X_WB);
  }
  if (refused_) throw InputError("action: the drone cannot fly this now: " + refusal_);
  if (end_ == EpisodeEnd::kRunning && steps_ >= spec_.max_steps) end_ = EpisodeEnd::kMaxSteps;
}

void Episode::Watch(std::function<void(const Episode&)> watch) {
  watch_ = std::move(watch);
  watch_(*this);
}

void Episode::Wait(double seconds) {
  refused_ = false;
  Fly(state().t_ns + std::llround(1e9 * std::clamp(seconds, 0.0, kLongestAction)), nullptr);
}

EpisodeScore Episode::Score() const {
  EpisodeScore score;
  score.navigation_error = distance_to_goal();
  score.oracle_success = std::min(nearest_, score.navigation_error) <= radius_;
  const bool ended_well = end_ == EpisodeEnd::kStopped || end_ == EpisodeEnd::kReached;
  score.success = ended_well && score.navigation_error <= radius_;
  score.path_length = length_ + Norm(vehicle().motion.X_WB.p - last_p_W_);
  std::vector<Vec3d> reference = spec_.reference_path;
  if (reference.empty()) {
    const double radius = loop_->model().drones[0]->radius();
    const ShortestWay& way = shortest_way_.Find(loop_->model().tracer, start_W_, goal_W_, radius);
    reference = way.points;
    score.shortest_is_straight = !way.found;
  }
  score.shortest_length = PathLength(reference);
  score.spl = SuccessByLength(score.success, score.shortest_length, score.path_length);
  // Both by way, not by time: an agent that thinks in mid-air loses nothing.
  score.ndtw = NormalizedTimeWarping(Spaced(Thinned(path_), kSpacing), Spaced(reference, kSpacing), radius_);
  return score;
}

}  // namespace airsim360

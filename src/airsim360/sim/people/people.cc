#include "airsim360/sim/people/people.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

constexpr int64_t kPeoplePerTask = 32;

/// The ground of a navigation mesh, as feet need it.
class NavGround : public Ground {
 public:
  explicit NavGround(const NavMesh* mesh) : mesh_(mesh) {}
  GroundPoint At(Vec3d p) const override {
    if (mesh_ == nullptr) return {p.z, {0, 0, 1}};
    constexpr double kStep = 0.08;  // metres: about half a foot
    const double z = mesh_->GroundHeight(p.x, p.y, p.z);
    const double dx = mesh_->GroundHeight(p.x + kStep, p.y, z) - z, dy = mesh_->GroundHeight(p.x, p.y + kStep, z) - z;
    // A kerb is no slope.
    constexpr double kSteepest = 0.06;
    if (std::abs(dx) > kSteepest || std::abs(dy) > kSteepest) return {z, {0, 0, 1}};
    return {z, Normalized(Vec3d{-dx, -dy, kStep})};
  }

 private:
  const NavMesh* mesh_;
};

// Calls body(first, last) for runs of people, on all threads where it is worth it.
template <class Body>
void ForRuns(size_t count, const Body& body) {
  const auto n = static_cast<int64_t>(count);
  const int64_t tasks = (n + kPeoplePerTask - 1) / kPeoplePerTask;
  const auto run = [&](int64_t task) {
    body(static_cast<size_t>(task * kPeoplePerTask), static_cast<size_t>(std::min((task + 1) * kPeoplePerTask, n)));
  };
  if (tasks == 1) {
    run(0);
  } else {
    ParallelFor(tasks, run);
  }
}

// Brings the motion of all people to the time of their states.
void MoveLimbs(const SimPeople& people, std::span<const PersonState> before, std::span<const PersonState> states, int64_t t_ns,
               std::span<MotionState> motions) {
  const NavGround ground(people.crowd->navmesh.get());
  ForRuns(states.size(), [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      if (!states[i].visible) continue;
      const Body& body = *people.cast[i].body;
      const bool appears = !before.empty() && !before[i].visible;
      if (appears) {
        motions[i] = StartMotion(body, states[i], RngStream(people.seed, "motion", i).Bits(), t_ns, &ground);
      } else {
        StepMotion(body, states[i], t_ns, &ground, motions[i]);
      }
    }
  });
}

}  // namespace

std::shared_ptr<const PeopleState> StartPeople(const SimPeople& people) {
  auto state = std::make_shared<PeopleState>();
  state->crowd = StartCrowd(*people.crowd);
  const NavGround ground(people.crowd->navmesh.get());
  state->motions.resize(people.cast.size());
  for (size_t i = 0; i < people.cast.size(); ++i) {
    state->motions[i] =
        StartMotion(*people.cast[i].body, state->crowd.people[i], RngStream(people.seed, "motion", i).Bits(), state->crowd.t_ns, &ground);
  }
  while (state->crowd.t_ns + kCrowdTickNs <= people.epoch_ns) TickPeople(people, {}, *state);
  return state;
}

void TickPeople(const SimPeople& people, std::span<const CrowdDrone> drones, PeopleState& state, std::vector<CrowdEvent>* events,
                std::span<const CrowdVehicle> vehicles) {
  const std::vector<PersonState> before = state.crowd.people;
  StepCrowd(*people.crowd, state.crowd, kCrowdTickNs, drones, events, vehicles);
  MoveLimbs(people, before, state.crowd.people, state.crowd.t_ns, state.motions);
}

uint64_t HashPeople(const PeopleState& state) {
  StateHasher hasher;
  hasher.Add(HashCrowd(state.crowd));
  for (const MotionState& motion : state.motions) HashMotion(motion, hasher);
  return hasher.hash();
}

PeoplePoses PosesAt(const SimPeople& people, const PeopleState& state, int64_t t_ns) {
  PeoplePoses poses;
  poses.t_ns = t_ns;
  std::vector<MotionState> motions = state.motions;
  if (t_ns > state.crowd.t_ns) {
    // Steps shorter than a tick only move people along.
    CrowdState crowd = state.crowd;
    StepCrowd(*people.crowd, crowd, t_ns - crowd.t_ns, {});
    MoveLimbs(people, {}, crowd.people, t_ns, motions);
    poses.states = std::move(crowd.people);
  } else {
    poses.states = state.crowd.people;
  }
  poses.poses.resize(poses.states.size());
  ForRuns(poses.states.size(), [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      if (poses.states[i].visible) poses.poses[i] = PoseOf(*people.cast[i].body, motions[i], poses.states[i]);
    }
  });
  return poses;
}

PeoplePoses PosesLater(const SimPeople& people, const PeopleState& state, int64_t t_ns) {
  if (t_ns <= state.crowd.t_ns + kCrowdTickNs) return PosesAt(people, state, t_ns);
  PeopleState later = state;
  while (t_ns >= later.crowd.t_ns + kCrowdTickNs) TickPeople(people, {}, later);
  return PosesAt(people, later, t_ns);
}

std::vector<uint8_t> LevelsFor(const SimPeople& people, std::span<const PersonState> states, Vec3d p_WC) {
  constexpr double kPixel = std::numbers::pi / 2048;                    // radians
  constexpr double kTall[] = {200 * kPixel, 60 * kPixel, 20 * kPixel};  // of levels 0, 1, 2
  std::vector<uint8_t> levels;
  levels.reserve(states.size());
  for (size_t i = 0; i < states.size(); ++i) {
    const double stature = people.cast[i].body->spec.stature;
    const Vec3d middle = states[i].p_WP + Vec3d{0, 0, 0.5 * stature};
    const double angle = stature / std::max(Norm(middle - p_WC), 0.1);
    uint8_t level = 0;
    while (level < std::size(kTall) && angle < kTall[level]) ++level;
    levels.push_back(level);
  }
  return levels;
}

void ShowPeople(const SimPeople& people, const PeoplePoses& poses, SceneState& scene_state) {
  if (people.refs.empty()) return;
  std::vector<const SkeletonPose*> shown;
  for (size_t i = 0; i < poses.poses.size(); ++i) shown.push_back(poses.states[i].visible ? &poses.poses[i] : nullptr);
  AppendPeople(people.cast, people.refs, shown, poses.levels, scene_state);
}

std::vector<PersonBox> PeopleNear(const SimPeople& people, const PeopleState& state, int64_t t_ns, Vec3d p_W, double reach) {
  std::vector<PersonBox> boxes;
  const double later = static_cast<double>(t_ns - state.crowd.t_ns) * 1e-9;
  for (size_t i = 0; i < state.crowd.people.size(); ++i) {
    const PersonState& person = state.crowd.people[i];
    const Vec3d to = person.p_WP - p_W;
    if (!person.visible || std::abs(to.x) > reach || std::abs(to.y) > reach || std::abs(to.z) > reach + 2.5) continue;
    const Body& body = *people.cast[i].body;
    const bool low = person.lower == Behaviour::kSit || person.lower == Behaviour::kCrouch;
    Vec3d half{body.size.radius, body.size.radius, body.spec.stature * (low ? 0.38 : 0.5)};
    Vec3d center = person.p_WP + person.v_WP * later;
    // Who sits is behind their feet.
    if (person.lower == Behaviour::kSit && person.seating.height > 0) {
      half.x += person.seating.reach / 2;
      center = center - RotationZ(person.yaw).column(0) * (person.seating.reach / 2);
    }
    center.z += half.z;
    boxes.push_back({{RotationZ(person.yaw), center}, half, person.v_WP, people.refs.empty() ? kNoEntity : people.refs[i].entity});
  }
  return boxes;
}

bool IsPerson(const SimPeople& people, EntityId entity) {
  return std::ranges::any_of(people.refs, [&](const PersonRef& ref) { return ref.entity == entity; });
}

std::optional<RigidTransform> PlaceOfPerson(const SimPeople& people, const PeopleState& state, int64_t t_ns, EntityId entity) {
  const auto found = std::ranges::find(people.refs, entity, &PersonRef::entity);
  if (found == people.refs.end()) return std::nullopt;
  const PersonState& person = state.crowd.people[static_cast<size_t>(found - people.refs.begin())];
  if (!person.visible) return std::nullopt;
  const double later = static_cast<double>(t_ns - state.crowd.t_ns) * 1e-9;
  return RigidTransform{RotationZ(person.yaw), person.p_WP + person.v_WP * later};
}

const char* BehaviourName(Behaviour behaviour) {
  static constexpr const char* kNames[] = {"idle",    "walk",       "jog",  "run",     "talk",     "listen",        "phone_call",
                                           "texting", "take_photo", "wave", "sit",     "carry",    "push_stroller", "crouch",
                                           "stretch", "point",      "wait", "look_up", "walk_dog", "umbrella"};
  static_assert(std::size(kNames) == static_cast<size_t>(Behaviour::kCount));
  return kNames[static_cast<size_t>(behaviour)];
}

}  // namespace airsim360

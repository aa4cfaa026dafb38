#include "airsim360/dataset/people/human_set.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "airsim360/base/config.h"
#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/dataset/people/human_splits.h"
#include "airsim360/math/angles.h"
#include "airsim360/sim/people_survey.h"

namespace airsim360 {
namespace {

double PitchOf(const std::string& text, const std::string& file) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(std::abs(value) <= 90))
    throw InputError(file + ": pitches_deg: '" + text.substr(0, 40) + "' is not an angle from -90 to 90");
  return value;
}

void VisitScene(ConfigVisitor& v, HumanScene& s) {
  v.Field("scene", "the paper's name, for people", s.scene);
  v.Field("world", "name or file of the world", s.world);
  v.Field("subsets", "how many", s.subsets);
  v.Field("least_width", "of the smallest area, metres", s.least_width, 4, 500);
  v.Field("least_depth", "of the smallest area, metres", s.least_depth, 4, 500);
  v.Field("most_width", "of the largest area, metres", s.most_width, 4, 500);
  v.Field("most_depth", "of the largest area, metres", s.most_depth, 4, 500);
  v.Field("least_people", "in the smallest area", s.least_people);
  v.Field("most_people", "in the largest area", s.most_people);
  v.Field("frames", "of all its subsets together", s.frames);
}

}  // namespace

HumanRecipe PaperHumanRecipe() {
  HumanRecipe recipe;
  recipe.moving = 0.5;
  recipe.scenes = {{"New York City", "new_york_city", 14, 12, 12, 30, 30, 15, 45, 29000},
                   {"Lisbon Downtown", "lisbon_downtown", 10, 12, 12, 30, 50, 10, 45, 9000},
                   {"Downtown City", "downtown_city", 17, 12, 12, 30, 30, 8, 30, 27000},
                   {"Roof", "roof", 7, 12, 12, 45, 20, 5, 30, 11200},
                   {"Rural Cabins", "rural_cabins", 2, 15, 15, 15, 30, 7, 14, 4000},
                   {"Rome", "rome", 11, 8, 10, 50, 30, 4, 30, 20500}};
  return recipe;
}

HumanRecipe ReadHumanRecipe(const std::filesystem::path& file) {
  HumanRecipe recipe;
  ReadYamlFile(file, [&](ConfigVisitor& v) {
    v.List("scenes", "rows of the table", recipe.scenes, VisitScene);
    v.Field("pitches_deg", "camera pitch below the horizon, by turns", recipe.pitches_deg);
    v.Field("interval", "seconds between frames", recipe.interval, 0.05, 60);
    v.Field("lowest", "metres of the camera above the ground", recipe.lowest, 0.5, 200);
    v.Field("highest", "metres of the camera above the ground", recipe.highest, 0.5, 200);
    v.Field("frames_a_view", "before the camera goes elsewhere", recipe.frames_a_view);
    v.Field("moving", "share of the views during which the camera flies", recipe.moving, 0, 1);
    v.Field("cameras", "file of a rig instead of one camera, beside this file", recipe.cameras);
  });
  const std::string name = file.string();
  if (recipe.scenes.empty()) throw InputError(name + ": key 'scenes' is missing");
  if (recipe.pitches_deg.empty() || recipe.highest < recipe.lowest || recipe.frames_a_view == 0)
    throw InputError(name + ": needs a pitch, highest >= lowest and frames_a_view >= 1");
  for (const std::string& pitch : recipe.pitches_deg) PitchOf(pitch, name);
  if (!recipe.cameras.empty()) recipe.cameras = (file.parent_path() / recipe.cameras).string();
  for (const HumanScene& scene : recipe.scenes) {
    if (scene.world.empty() || scene.subsets == 0 || scene.subsets > 10000 || scene.frames > 10'000'000 || scene.most_people > 20000)
      throw InputError(name + ": scene '" + scene.scene + "': needs a world, 1 to 10000 subsets, at most 20000 people");
  }
  return recipe;
}

std::vector<HumanSubset> SubsetsOf(const HumanRecipe& recipe) {
  std::vector<HumanSubset> subsets;
  for (const HumanScene& scene : recipe.scenes) {
    for (uint64_t k = 0; k < scene.subsets; ++k) {
      const double t = scene.subsets > 1 ? static_cast<double>(k) / static_cast<double>(scene.subsets - 1) : 0;
      const auto between = [&](double least, double most) { return least + (most - least) * t; };
      char name[256];
      const std::string stem = std::filesystem::path(scene.world).stem().string();
      std::snprintf(name, sizeof name, "%s/%02llu", stem.substr(0, 200).c_str(), static_cast<unsigned long long>(k + 1));
      HumanSubset subset{.world = scene.world, .name = name};
      subset.width = between(scene.least_width, scene.most_width);
      subset.depth = between(scene.least_depth, scene.most_depth);
      subset.people =
          static_cast<uint64_t>(std::llround(between(static_cast<double>(scene.least_people), static_cast<double>(scene.most_people))));
      subset.pitch_deg = PitchOf(recipe.pitches_deg[k % recipe.pitches_deg.size()], "recipe");
      subset.split = SplitOf(k);
      // Frames that do not divide evenly go to the first subsets.
      subset.frames = static_cast<int64_t>(scene.frames / scene.subsets + (k < scene.frames % scene.subsets ? 1 : 0));
      subsets.push_back(subset);
    }
  }
  return subsets;
}

namespace {

// How many kinds of everyday things stand in and around a rectangle: kerbside things, signs, cars, doors; a bare block has few.
size_t Liveliness(const Scene& scene, Vec2d low, Vec2d high) {
  constexpr double kAround = 15;       // metres
  constexpr float kEverydaySize = 25;  // metres: larger ones (a district's ground in one piece) tell nothing of a place
  std::set<CategoryId> kinds;
  for (const Entity& entity : scene.entities) {
    const Box3f& box = entity.bounds;
    if (box.empty() || std::max({box.size().x, box.size().y, box.size().z}) > kEverydaySize) continue;
    const Vec3d c = VecCast<double>(box.center());
    if (c.x > low.x - kAround && c.x < high.x + kAround && c.y > low.y - kAround && c.y < high.y + kAround) kinds.insert(entity.category);
  }
  return kinds.size();
}

// Where areas are sought: over all ground that hangs together; around the world's beginning where that lies on ground
// of its own, as on a roof.
NavArea Gathering(const Scene& scene, const NavMesh& mesh) {
  constexpr double kReaches[] = {36, 24, 14}, kLeast = 300;  // metres; m^2
  NavArea everywhere = mesh.AreaOf({}, ~0u);
  if (!scene.spawn) return everywhere;
  const NavPoint start = mesh.Nearest(VecCast<double>(*scene.spawn));
  if (!start.valid() || mesh.Component(start) == everywhere.component) return everywhere;
  const Vec2d c{start.p_W.x, start.p_W.y};
  for (const double reach : kReaches) {
    const Vec2d outline[] = {c + Vec2d{-reach, -reach}, c + Vec2d{reach, -reach}, c + Vec2d{reach, reach}, c + Vec2d{-reach, reach}};
    NavArea part = mesh.AreaOf(outline, ~0u);
    if (part.component == mesh.Component(start) && part.square_metres > kLeast) return part;
  }
  return everywhere;
}

bool AreNear(const HumanArea& a, const HumanArea& b) {
  return a.low.x < b.high.x + kSplitGap && b.low.x < a.high.x + kSplitGap && a.low.y < b.high.y + kSplitGap &&
         b.low.y < a.high.y + kSplitGap;
}

}  // namespace

HumanArea PickArea(const Scene& scene, const NavMesh& mesh, const HumanSubset& subset, uint64_t seed, std::span<const HumanArea> apart) {
  constexpr int kTries = 96;
  constexpr double kRoom = 2;    // m^2 a person
  constexpr double kOpen = 0.6;  // of the most open rectangle's ground
  struct Candidate {
    HumanArea area;
    double square_metres;
  };
  RngStream rng(seed, "omni360_human " + subset.name);
  const NavArea everywhere = Gathering(scene, mesh);
  std::vector<Candidate> candidates;
  double most = 0;
  for (int i = 0; i < kTries; ++i) {
    const NavPoint center = mesh.Pick(everywhere, rng);
    if (!center.valid()) continue;
    const Vec2d half{subset.width / 2, subset.depth / 2}, c{center.p_W.x, center.p_W.y};
    const Vec2d low = c - half, high = c + half;
    if (std::ranges::any_of(apart, [&](const HumanArea& other) { return AreNear({low, high}, other); })) continue;
    const Vec2d outline[] = {low, {high.x, low.y}, high, {low.x, high.y}};
    const NavArea area = mesh.AreaOf(outline, ~0u);
    if (area.component != everywhere.component) continue;  // most of it lies elsewhere, perhaps on the street below
    candidates.push_back({{low, high, center.p_W.z}, area.square_metres});
    most = std::max(most, candidates.back().square_metres);
  }
  if (most < kRoom * static_cast<double>(subset.people)) {
    throw InputError("subset " + subset.name + ": no area of " + std::to_string(subset.width) + " x " + std::to_string(subset.depth) +
                     " m in '" + subset.world + "' has room for " + std::to_string(subset.people) + " people");
  }
  const double least = std::max(kOpen * most, kRoom * static_cast<double>(subset.people));
  std::erase_if(candidates, [&](const Candidate& candidate) { return candidate.square_metres < least; });
  const auto rank = [&](const Candidate& candidate) {
    return std::pair(Liveliness(scene, candidate.area.low, candidate.area.high), candidate.square_metres);
  };
  return std::ranges::max_element(candidates, {}, rank)->area;
}

std::string PeopleFileOf(const HumanArea& area, uint64_t people) {
  char text[512];
  std::snprintf(text, sizeof text,
                "areas:\n  - name: area\n    polygon: [[%.2f, %.2f], [%.2f, %.2f], [%.2f, %.2f], [%.2f, %.2f]]\n    count: %llu\n",
                area.low.x, area.low.y, area.high.x, area.low.y, area.high.x, area.high.y, area.low.x, area.high.y,
                static_cast<unsigned long long>(people));
  return text;
}

namespace {

using PeoplePlaces = std::vector<std::optional<Vec3d>>;

PeoplePlaces PlacesOf(const PeopleState& state) {
  PeoplePlaces places;
  for (const PersonState& person : state.crowd.people) places.push_back(person.visible ? std::optional(person.p_WP) : std::nullopt);
  return places;
}

// A free place for the camera over or beside the area, facing its middle: of several the one that shows people best. Where nothing
// sees the middle, which may be built over, one that sees somebody.
RigidTransform PickView(const HumanRecipe& recipe, const HumanSubset& subset, const HumanArea& area, const RayTracer& world,
                        const PeoplePlaces& people, RngStream& rng) {
  constexpr int kTries = 400, kRated = 32;
  constexpr float kFree = 1;     // metres to every surface
  constexpr double kBeside = 4;  // metres that the camera may stand outside the area
  const Vec2d middle = (area.low + area.high) * 0.5;
  std::optional<RigidTransform> best, aside;
  double most = -1, most_aside = 0;
  for (int i = 0, rated = 0; i < kTries && rated < kRated; ++i) {
    const Vec3d p{rng.Uniform(area.low.x - kBeside, area.high.x + kBeside), rng.Uniform(area.low.y - kBeside, area.high.y + kBeside),
                  area.ground + rng.Uniform(recipe.lowest, recipe.highest)};
    const double yaw = std::atan2(middle.y - p.y, middle.x - p.x) + rng.Uniform(-0.6, 0.6);
    if (world.Clearance(VecCast<float>(p), kFree) < kFree) continue;
    // Seen by those who are in the area: not from behind a wall.
    const bool hidden = world.Occluded(VecCast<float>(p), VecCast<float>(Vec3d{middle.x, middle.y, area.ground + 1}));
    if (hidden && best) continue;
    const std::optional<double> seen = RatePeopleView(world, p, people);
    if (!seen) continue;
    if (!hidden) ++rated;
    double& least = hidden ? most_aside : most;
    if (*seen <= least) continue;
    least = *seen;
    (hidden ? aside : best) = BodyPose(p, yaw, -subset.pitch_deg * kDegree, 0);
  }
  if (best) return *best;
  if (aside) return *aside;
  throw InputError("subset " + subset.name + ": no free place for the camera around its area");
}

// A velocity at which the camera flies straight and level for `seconds` without coming near anything; zero if none is found.
Vec3d PickVelocity(const RayTracer& world, Vec3d from, double seconds, RngStream& rng) {
  constexpr int kTries = 24, kSteps = 12;
  constexpr double kSlowest = 0.5, kFastest = 2;
  constexpr float kFree = 1;
  for (int i = 0; i < kTries; ++i) {
    const double angle = rng.Uniform(0, 2 * std::numbers::pi), speed = rng.Uniform(kSlowest, kFastest);
    const Vec3d velocity{speed * std::cos(angle), speed * std::sin(angle), 0};
    bool free = !world.Occluded(VecCast<float>(from), VecCast<float>(from + velocity * seconds));
    for (int k = 1; free && k <= kSteps; ++k)
      free = world.Clearance(VecCast<float>(from + velocity * (seconds * k / kSteps)), kFree) >= kFree;
    if (free) return velocity;
  }
  return {};
}

}  // namespace

Flight FilmSubset(const HumanRecipe& recipe, const HumanSubset& subset, const HumanArea& area, const SimPeople& people,
                  const RayTracer& world, uint64_t seed) {
  RngStream rng(seed, "omni360_human views " + subset.name);
  Flight flight;
  PeopleState state = *people.start;
  const int64_t interval_ns = std::max<int64_t>(std::llround(recipe.interval * 1e9) / kCrowdTickNs, 1) * kCrowdTickNs;
  Kinematics body;
  for (int64_t i = 0; i < subset.frames; ++i) {
    if (i % static_cast<int64_t>(recipe.frames_a_view) == 0) {
      body.X_WB = PickView(recipe, subset, area, world, PlacesOf(state), rng);
      const auto view = static_cast<double>(i / static_cast<int64_t>(recipe.frames_a_view));
      const bool moves = std::floor((view + 1) * recipe.moving) > std::floor(view * recipe.moving);
      body.v_WB = moves ? PickVelocity(world, body.X_WB.p, static_cast<double>(recipe.frames_a_view) * recipe.interval, rng) : Vec3d{};
    } else {
      body.X_WB.p = body.X_WB.p + body.v_WB * (static_cast<double>(interval_ns) * 1e-9);
    }
    const int64_t t_ns = i * interval_ns;
    flight.shots.push_back({t_ns, body, std::make_shared<const PeopleState>(state)});
    flight.trajectory.push_back({t_ns, body, {}});
    const CrowdDrone drone{body.X_WB.p, body.v_WB};
    for (int64_t t = 0; t < interval_ns; t += kCrowdTickNs) TickPeople(people, {&drone, 1}, state);
  }
  return flight;
}

}  // namespace airsim360

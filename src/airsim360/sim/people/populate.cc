#include "airsim360/sim/people/populate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/people/keypoints/keypoint_orders.h"

namespace airsim360 {
namespace {

constexpr double kMostWarmUp = 3600;  // seconds

// The finest level of detail that a machine can hold for so many people; which one is shown depends on the distance.
int FinestLevelFor(size_t people) { return people <= 100 ? 0 : people <= 500 ? 1 : people <= 3000 ? 2 : 3; }

std::string PersonName(size_t index) {
  char name[32];
  std::snprintf(name, sizeof name, "person/%03zu", index);
  return name;
}

}  // namespace

BodySpec SpecOf(const PersonTraits& traits) {
  RngStream rng(traits.look, "build");
  return {.sex = traits.female ? Sex::kFemale : Sex::kMale,
          .age = traits.age,
          .stature = traits.stature,
          .build = std::clamp(0.4 * rng.Normal(), -1.0, 1.0),
          .look = traits.look};
}

PopulatedScene Populate(std::shared_ptr<const Scene> scene, const PeopleRequest& request) {
  if (!(request.warm_up >= 0 && request.warm_up <= kMostWarmUp))
    throw InputError("people: a warm-up of " + std::to_string(request.warm_up) + " s is not in 0 … 3600");
  auto people = std::make_shared<SimPeople>();
  if (!request.sockets.empty()) people->sockets = ReadSockets(request.sockets);
  if (!request.any()) return {std::move(scene), nullptr};
  people->seed = request.seed;
  people->epoch_ns = std::llround(request.warm_up * 1e9) / kCrowdTickNs * kCrowdTickNs;
  people->crowd =
      BuildCrowd(*scene, request.navmesh, {.file = request.file, .count = request.count, .reserve = request.reserve, .seed = request.seed});

  const std::vector<PersonTraits>& traits = people->crowd->people;
  const int level = request.level >= 0 ? request.level : FinestLevelFor(traits.size());
  people->cast.resize(traits.size());
  ParallelFor(static_cast<int64_t>(traits.size()), [&](int64_t task) {
    const auto i = static_cast<size_t>(task);
    auto body = MakeBody(SpecOf(traits[i]), level);
    const int coarsest = static_cast<int>(body->levels.size()) - 1;
    people->cast[i] = {PersonName(i), std::move(body), std::min(level, coarsest), request.level < 0};
  });
  PopulatedScene populated;
  populated.scene = AddPeople(std::move(scene), people->cast, people->refs);
  people->start = StartPeople(*people);
  populated.people = std::move(people);
  return populated;
}

}  // namespace airsim360

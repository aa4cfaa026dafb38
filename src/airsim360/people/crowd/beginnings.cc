// Where people in rooms are and what they do when a crowd begins.
#include <cmath>
#include <map>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/people/crowd/placement.h"

namespace airsim360::internal {
namespace {

constexpr double kFarthestSeat = 60;  // metres from where somebody would stand to the seat that they begin on

/// How people in rooms begin: those who like to sit on the nearest free seat, customers in the nearest line, and half of
/// those who like to talk in twos.
class Beginnings {
 public:
  Beginnings(const CrowdModel& model, Placement& placement, CrowdPlan& plan) : model_(model), placement_(placement), plan_(plan) {
    plan_.start_seats.assign(model_.people.size(), -1);
    plan_.start_partners.assign(model_.people.size(), kNoPerson);
  }

  /// Of the people from `first` on whose area is one of those in rooms.
  void Plan(PersonIndex first, const std::vector<char>& in_rooms) {
    std::vector<PersonIndex> who;
    for (PersonIndex i = first; i < model_.people.size(); ++i)
      if (plan_.starts[i].valid() && in_rooms[model_.people[i].area]) who.push_back(i);
    for (const PersonIndex i : who) {
      if (TreeOf(i) == "sitter") TakePlace(i, PlaceKind::kBench);
      if (TreeOf(i) == "customer") TakePlace(i, PlaceKind::kQueue);
    }
    // Those who talk stand where the others have left room.
    for (const PersonIndex i : who)
      if (TreeOf(i) == "walker" && plan_.party_of_person[i] == 0 && RngStream(model_.seed, "begins to talk", i).Chance(0.5)) Talk(i);
  }

 private:
  const std::string& TreeOf(PersonIndex i) const { return plan_.trees.trees[plan_.tree_of_person[i]].name; }

  void TakePlace(PersonIndex i, PlaceKind kind) {
    const NavMesh& mesh = *model_.navmesh;
    const NavPoint& start = plan_.starts[i];
    double nearest = kFarthestSeat;
    int32_t& mine = plan_.start_seats[i];
    for (size_t k = 0; k < plan_.places.size(); ++k) {
      const Place& place = plan_.places[k];
      const double distance = Norm(place.p_W - start.p_W);
      const bool free = !taken_[k] && (place.rank == 0 || taken_[k - 1]);
      if (!free || place.kind != kind || distance >= nearest || !Fits(place, model_.people[i].stature) ||
          mesh.Component(place.approach) != mesh.Component(start))
        continue;
      nearest = distance;
      mine = static_cast<int32_t>(k);
    }
    if (mine < 0) return;
    taken_[static_cast<size_t>(mine)] = 1;
    placement_.Leave(start);
    placement_.Take(plan_.places[static_cast<size_t>(mine)].approach);
  }

  // The second of a pair stands a metre before the first, on whichever side there is room.
  void Talk(PersonIndex i) {
    const NavMesh& mesh = *model_.navmesh;
    NavPoint& start = plan_.starts[i];
    const auto [found, is_first] = waiting_.try_emplace(mesh.Component(start), i);
    if (is_first) return;
    const PersonIndex waits = found->second;
    waiting_.erase(found);
    const NavPoint& beside_whom = plan_.starts[waits];
    placement_.Leave(start);
    for (int k = 0; k < 8; ++k) {
      const double angle = k * kPi / 4;
      const NavPoint beside = mesh.Move(beside_whom, {beside_whom.p_W.x + std::cos(angle), beside_whom.p_W.y + std::sin(angle)});
      if (std::abs(Norm(beside.p_W - beside_whom.p_W) - 1) > 0.05 || !placement_.Take(beside)) continue;
      start = beside;
      plan_.start_partners[i] = waits, plan_.start_partners[waits] = i;
      return;
    }
    placement_.Take(start);
  }

  const CrowdModel& model_;
  Placement& placement_;
  CrowdPlan& plan_;
  std::vector<char> taken_ = std::vector<char>(plan_.places.size(), 0);
  std::map<uint32_t, PersonIndex> waiting_;  // for the second of a pair, by the part of the mesh that they live on
};

}  // namespace

void PlanBeginnings(const CrowdModel& model, PersonIndex first, const std::vector<char>& in_rooms, Placement& placement, CrowdPlan& plan) {
  Beginnings(model, placement, plan).Plan(first, in_rooms);
}

}  // namespace airsim360::internal

// Who is out with whom.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "airsim360/math/angles.h"
#include "airsim360/people/behaviour/person_nodes.h"
#include "airsim360/people/crowd/parties.h"
#include "airsim360/people/crowd/people_file.h"

namespace airsim360::internal {
namespace {

constexpr double kGrown = 18;                  // years
constexpr double kLeast = 0.65, kMost = 0.85;  // metres between neighbours, by party
constexpr double kSlowest = 1.1;               // times the speed of the slowest: nobody is asked for more

bool Accompanies(const Tree& tree) {
  return std::ranges::any_of(tree.nodes, [](const TreeNode& node) { return node.node == static_cast<Node>(PersonNode::kAccompany); });
}

size_t DrawSize(RngStream& rng, double share) {
  double u = rng.Uniform();
  for (size_t size = 1; size < kLargestParty; ++size)
    if ((u -= PartySizeChance(size, share)) < 0) return size;
  return kLargestParty;
}

class Former {
 public:
  Former(CrowdModel& model, CrowdPlan& plan, Placement& placement, PersonIndex first)
      : model_(model), plan_(plan), placement_(placement), rng_(model.seed, "parties", first), first_(first) {}

  void Run(double share) {
    for (PersonIndex i = first_; i < model_.people.size(); ++i) {
      if (model_.people[i].age < kGrown) {
        children_.push_back(i);
      } else if (Accompanies(plan_.trees.trees[plan_.tree_of_person[i]])) {
        grown_.push_back(i);
      }
    }
    if (grown_.empty()) return;
    // Joggers and those who sit are alone: of the others more are in parties.
    const double able = static_cast<double>(grown_.size() + children_.size());
    share = std::min(kMostInParties, share * static_cast<double>(model_.people.size() - first_) / able);
    std::vector<size_t> sizes;
    for (size_t left = grown_.size() + children_.size(); left > 0; left -= sizes.back())
      sizes.push_back(std::min(left, DrawSize(rng_, share)));
    for (std::vector<PersonIndex>& party : Members(sizes)) Gather(std::move(party));
  }

 private:
  /// Each party has a grown person first; children are anywhere else.
  std::vector<std::vector<PersonIndex>> Members(const std::vector<size_t>& sizes) {
    std::vector<std::vector<PersonIndex>> parties;
    std::vector<size_t> open;  // a party for each place beside its leader
    for (const size_t size : sizes) {
      if (grown_.size() <= parties.size()) break;
      open.insert(open.end(), size - 1, parties.size());
      parties.push_back({grown_[parties.size()]});
    }
    std::span<const PersonIndex> more = std::span(grown_).subspan(parties.size());
    for (size_t k = open.size(); k > 1; --k) std::swap(open[k - 1], open[rng_.Index(static_cast<uint32_t>(k))]);
    for (size_t k = 0; k < open.size(); ++k) {
      if (k < children_.size()) {
        parties[open[k]].push_back(children_[k]);
      } else if (!more.empty()) {
        parties[open[k]].push_back(more.front());
        more = more.subspan(1);
      }
    }
    return parties;
  }

  /// Brings the members of a party together; who finds no room beside its leader stays alone.
  void Gather(std::vector<PersonIndex> wanted) {
    Party party{.members = {wanted[0]}, .spacing = rng_.Uniform(kLeast, kMost)};
    for (const PersonIndex i : std::span(wanted).subspan(1))
      if (PlaceBeside(party, i)) party.members.push_back(i);
    if (party.members.size() < 2) return;
    double mean = 0, slowest = 1e9;
    for (const PersonIndex i : party.members) {
      mean += model_.people[i].free_speed / static_cast<double>(party.members.size());
      slowest = std::min(slowest, model_.people[i].free_speed);
    }
    for (const PersonIndex i : party.members) {
      model_.people[i].free_speed = std::min(mean, kSlowest * slowest) * PartySpeed(party.members.size());
      if (model_.people[i].age < kGrown) plan_.tree_of_person[i] = plan_.tree_of_person[party.members[0]];
      plan_.party_of_person[i] = static_cast<uint32_t>(plan_.parties.size() + 1);
    }
    plan_.parties.push_back(std::move(party));
  }

  bool PlaceBeside(const Party& party, PersonIndex i) {
    constexpr int kDirections = 16;
    const NavMesh& mesh = *model_.navmesh;
    const NavPoint &leader = plan_.starts[party.members[0]], old = plan_.starts[i];
    placement_.Leave(old);
    const uint32_t turn = rng_.Index(kDirections);
    for (uint32_t k = 0; k < kDirections; ++k) {
      const double angle = (k + turn) * kTau / kDirections;
      const Vec2d p{leader.p_W.x + party.spacing * std::cos(angle), leader.p_W.y + party.spacing * std::sin(angle)};
      if (!mesh.Straight(leader, p)) continue;
      const NavPoint beside = mesh.Move(leader, p);
      if (GroundCost(mesh.Kind(beside)) > GroundCost(mesh.Kind(leader)) || !placement_.Take(beside)) continue;
      plan_.starts[i] = beside;
      return true;
    }
    placement_.Take(old);
    return false;
  }

  CrowdModel& model_;
  CrowdPlan& plan_;
  Placement& placement_;
  RngStream rng_;
  PersonIndex first_;
  std::vector<PersonIndex> grown_, children_;
};

}  // namespace

double PartySizeChance(size_t size, double share) {
  const double mean = -std::log(1 - share);
  if (mean <= 0) return size == 1 ? 1 : 0;
  double chance = 0, sum = 0, term = 1;
  for (size_t k = 1; k <= kLargestParty; ++k) {
    term *= mean / static_cast<double>(k);
    sum += term;
    if (k == size) chance = term;
  }
  return chance / sum;
}

double PartySpeed(size_t size) { return (1.25 - 0.06 * static_cast<double>(size)) / (1.25 - 0.06); }

void FormParties(CrowdModel& model, CrowdPlan& plan, Placement& placement, PersonIndex first, double share) {
  plan.party_of_person.resize(model.people.size());
  if (share > 0) Former(model, plan, placement, first).Run(share);
}

}  // namespace airsim360::internal

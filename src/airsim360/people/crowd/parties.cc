#include "airsim360/people/crowd/parties.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "airsim360/math/angles.h"
#include "airsim360/math/plane.h"
#include "airsim360/people/crowd/mind.h"

namespace airsim360::internal {
namespace {

constexpr double kRow = 0.9;       // metres from one row to the next where not all have room in one
constexpr double kBend = 0.12;     // metres that the outer ones of three or four are ahead, in free ground
constexpr double kBendMore = 0.4;  // and more in a crowd, where they also come closer: the paper's V
constexpr double kCloser = 0.15;   // of the spacing
constexpr double kAround = 3;      // metres
constexpr double kCrowded = 4;     // others within that: bent as far as they bend
constexpr double kGain = 1.1;      // 1/s: how fast somebody gets to their place
constexpr double kHurry = 1.5;     // times their speed, at most, while doing so
constexpr double kBehind = 1.2;    // metres off their place: the leader slows down
constexpr double kFarBehind = 3;   // and waits
constexpr int64_t kPatience = 40 * kSecond;
constexpr double kStandBy = 1.5;  // metres from a leader who stands
constexpr double kBetter = 0.3;   // square metres that others must be better off to change places

bool IsFree(const CrowdTick& tick, PersonIndex i) { return tick.in.walkers[i].present && !tick.in.agents[i].commanded; }

const Party* PartyOf(const CrowdTick& tick, PersonIndex i) {
  const uint32_t id = tick.plan.party_of_person[i];
  return id == 0 ? nullptr : &tick.plan.parties[id - 1];
}

/// From the leader's frame (ahead, left) to the world.
Vec2d Turned(Vec2d heading, Vec2d p) { return heading * p.x + Vec2d{-heading.y, heading.x} * p.y; }

/// How many have room side by side on one side of the leader, `step` metres each.
int RoomBeside(const NavMesh& mesh, const NavPoint& at, Vec2d step, int most) {
  constexpr double kSlack = 0.02;  // metres
  const double cost = GroundCost(mesh.Kind(at));
  NavPoint beside = at;
  for (int room = 0; room < most; ++room) {
    const Vec2d next = Flat(beside.p_W) + step;
    beside = mesh.Along(beside, next);
    if (Norm(Flat(beside.p_W) - next) > kSlack || GroundCost(mesh.Kind(beside)) > 2 * cost) return room;
  }
  return most;
}

/// 0 … 1 by how many strangers are near.
double CrowdAround(const CrowdTick& tick, const Party& party, Vec2d p) {
  int others = 0;
  tick.in.steering.Near(p, kAround, [&](PersonIndex k, Vec2d q, double) {
    others += Norm(q - p) < kAround && std::ranges::find(party.members, k) == party.members.end();
  });
  return std::min(1.0, others / kCrowded);
}

/// Places for `n` beside and behind a leader who has room for `left` and `right`: the first row is filled on both sides, then the
/// rows behind it.
std::vector<Vec2d> PlacesFor(size_t n, int left, int right, double spacing, double bend) {
  const int first = std::min(static_cast<int>(n), left + right);
  const int on_left = std::clamp(first / 2, first - right, left);
  std::vector<double> columns{0};
  for (int k = 1; k <= on_left; ++k) columns.push_back(k * spacing);
  for (int k = 1; k <= first - on_left; ++k) columns.push_back(-k * spacing);
  std::vector<Vec2d> places;
  for (size_t k = 1; k <= n; ++k) {
    const size_t row = k / columns.size();
    const double y = columns[k % columns.size()];
    places.push_back({(row == 0 && first > 1 ? bend * std::abs(y) / spacing : 0) - static_cast<double>(row) * kRow, y});
  }
  return places;
}

/// The best of all ways to share out the places, and what it costs: square metres that they are off, all together.
double ShareOut(const CrowdTick& tick, const std::vector<PersonIndex>& members, Vec2d p, Vec2d heading, std::vector<Vec2d>& places) {
  std::vector<size_t> order(places.size());
  std::iota(order.begin(), order.end(), size_t{0});
  double best = 1e18;
  std::vector<Vec2d> chosen;
  do {
    double cost = 0;
    for (size_t k = 0; k < members.size(); ++k) {
      const Vec2d off = p + Turned(heading, places[order[k]]) - Flat(tick.in.walkers[members[k]].at.p_W);
      cost += Dot(off, off) + kBetter * (Norm(places[order[k]] - tick.in.agents[members[k]].slot) > 0.5);
    }
    if (cost >= best) continue;
    best = cost;
    chosen.clear();
    for (const size_t k : order) chosen.push_back(places[k]);
  } while (std::ranges::next_permutation(order).found);
  places = std::move(chosen);
  return best;
}

/// How fast a leader goes on: 1, less if somebody falls behind, 0 while they wait. Nobody waits on a road.
double PaceFor(CrowdTick& tick, PersonIndex leader, const std::vector<PersonIndex>& members) {
  Agent& agent = tick.in.agents[leader];
  const Walker& walker = tick.in.walkers[leader];
  double behind = 0;
  for (const PersonIndex k : members)
    behind = std::max(behind, FlatDistance(tick.in.walkers[k].at.p_W, walker.at.p_W) - Norm(tick.in.agents[k].slot));
  const GroundKind kind = tick.model.navmesh->Kind(walker.at);
  if (behind < kBehind || kind == GroundKind::kRoad || kind == GroundKind::kCrossing) {
    agent.waits_since_ns = tick.t_ns;
    return 1;
  }
  // Whoever does not come cannot be waited for for ever.
  if (tick.t_ns - agent.waits_since_ns > kPatience) return 1;
  return std::max(0.0, 1 - (behind - kBehind) / (kFarBehind - kBehind));
}

}  // namespace

PersonIndex LeaderOf(const CrowdTick& tick, PersonIndex i) {
  if (const Party* party = PartyOf(tick, i))
    for (const PersonIndex k : party->members)
      if (IsFree(tick, k)) return k;
  return kNoPerson;
}

bool IsInParty(const CrowdTick& tick, PersonIndex i) {
  const Party* party = PartyOf(tick, i);
  return party && IsFree(tick, i) && std::ranges::any_of(party->members, [&](PersonIndex k) { return k != i && IsFree(tick, k); });
}

void ArrangeParty(CrowdTick& tick, PersonIndex leader) {
  const Party* party = PartyOf(tick, leader);
  if (!party) return;
  Agent& agent = tick.in.agents[leader];
  agent.party_pace = 1;
  if (LeaderOf(tick, leader) != leader) return;
  std::vector<PersonIndex> members;
  for (const PersonIndex k : party->members)
    if (k != leader && tick.in.agents[k].accompanies) members.push_back(k);
  agent.party_pace = PaceFor(tick, leader, members);
  // Places are looked for less often, and while they walk.
  constexpr int64_t kAgain = 3;
  const bool again = (tick.t_ns / (kThinkEvery * kCrowdTickNs) + leader) % kAgain == 0;
  if (members.empty() || agent.walk != Walk::kOnTheWay || !again) return;

  const Walker& walker = tick.in.walkers[leader];
  const Vec2d p = Flat(walker.at.p_W);
  const double crowd = CrowdAround(tick, *party, p), spacing = party->spacing * (1 - kCloser * crowd);
  const double bend = kBend + kBendMore * crowd;
  const int most = static_cast<int>(members.size());
  const int left = RoomBeside(*tick.model.navmesh, walker.at, Turned(agent.heading, {0, spacing}), most);
  const int right = RoomBeside(*tick.model.navmesh, walker.at, Turned(agent.heading, {0, -spacing}), most);
  std::vector<Vec2d> best;
  double least = 1e18;
  // Of an odd number one more is on the left or on the right.
  for (const auto& [l, r] :
       {std::pair{left, right}, std::pair{left, std::min(right, most / 2)}, std::pair{std::min(left, most / 2), right}}) {
    if (std::min(most, l + r) < std::min(most, left + right)) continue;
    std::vector<Vec2d> places = PlacesFor(members.size(), l, r, spacing, bend);
    const double cost = ShareOut(tick, members, p, agent.heading, places);
    if (cost >= least) continue;
    least = cost;
    best = std::move(places);
  }
  for (size_t k = 0; k < members.size(); ++k) tick.in.agents[members[k]].slot = best[k];
}

bool WantBeside(CrowdTick& tick, PersonIndex i, PersonIndex leader) {
  Agent& agent = tick.in.agents[i];
  Walker& walker = tick.in.walkers[i];
  const Agent& led_by = tick.in.agents[leader];
  const Walker& other = tick.in.walkers[leader];
  const Vec2d p = Flat(walker.at.p_W), to_leader = Flat(other.at.p_W) - p;
  const bool goes = led_by.walk == Walk::kOnTheWay && !tick.plan.states[led_by.state].stop;
  agent.hold = led_by.hold;
  if (!goes && Norm(to_leader) < kStandBy) {
    // Whoever has come stands by, and looks at the one they came with.
    agent.has_face = true;
    agent.face_yaw = std::atan2(to_leader.y, to_leader.x);
    return false;
  }
  const Vec2d to = to_leader + Turned(led_by.heading, agent.slot);
  agent.has_face = led_by.hold;
  if (led_by.hold) agent.face_yaw = std::atan2(led_by.heading.y, led_by.heading.x);
  const Vec2d wanted = other.v + to * kGain;
  const double speed = Norm(wanted), most = kHurry * walker.free_speed;
  if (speed < 0.1 && led_by.hold) return false;
  if (Norm(to) > kBehind) agent.way_ns = tick.t_ns;  // is on the way, and may be stuck
  if (speed > 1e-6) walker.wanted = wanted * (std::min(speed, most) / speed);
  return true;
}

}  // namespace airsim360::internal

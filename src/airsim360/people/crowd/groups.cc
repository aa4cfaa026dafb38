#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/people/crowd/agent.h"

namespace airsim360::internal {
namespace {

constexpr int64_t kAlone = 4 * kSecond;  // that long a founder waits for the other
constexpr int64_t kSilence = kSecond;    // after that somebody starts to speak

Vec2d PlaceOf(const CrowdTick& tick, PersonIndex i) {
  const Vec3d& p = tick.in.walkers[i].at.p_W;
  return {p.x, p.y};
}

void EndTalk(CrowdTick& tick, PersonIndex i) {
  Agent& agent = tick.in.agents[i];
  agent.group = 0;
  agent.turn_until_ns = 0;
  agent.has_face = false;
  tick.state.people[i].speaking = false;
  agent.social_after_ns = std::max(agent.social_after_ns, tick.t_ns + 20 * kSecond);
}

}  // namespace

Group* FindGroup(CrowdInternals& in, uint32_t id) {
  const auto found = std::find_if(in.groups.begin(), in.groups.end(), [&](const Group& g) { return g.id == id; });
  return found == in.groups.end() ? nullptr : &*found;
}

uint32_t FoundGroup(CrowdTick& tick, PersonIndex a, PersonIndex b) {
  Group group;
  group.id = tick.in.next_group++;
  group.members = {a};
  const Vec2d pa = PlaceOf(tick, a), pb = PlaceOf(tick, b);
  group.centre = (pa + pb) * 0.5;
  group.angle = std::atan2(pa.y - group.centre.y, pa.x - group.centre.x);
  group.since_ns = group.silent_since_ns = group.changed_ns = tick.t_ns;
  group.ends_ns = 0;
  tick.in.groups.push_back(group);
  tick.in.agents[a].group = group.id;
  return group.id;
}

void FoundPartyTalk(CrowdTick& tick, uint32_t party, const std::vector<PersonIndex>& members) {
  Group group;
  group.id = party;
  group.members = members;
  for (const PersonIndex i : members) group.centre = group.centre + PlaceOf(tick, i) * (1 / static_cast<double>(members.size()));
  // Around the centre in the order in which they are there already.
  const auto angle_of = [&](PersonIndex i) {
    const Vec2d d = PlaceOf(tick, i) - group.centre;
    return std::atan2(d.y, d.x);
  };
  std::ranges::sort(group.members, {}, angle_of);
  group.angle = angle_of(group.members[0]);
  group.since_ns = group.silent_since_ns = group.changed_ns = tick.t_ns;
  for (const PersonIndex i : group.members) tick.in.agents[i].group = party;
  tick.in.groups.push_back(std::move(group));
}

bool JoinGroup(CrowdTick& tick, PersonIndex i, uint32_t id) {
  Group* group = FindGroup(tick.in, id);
  if (!group || group->members.size() >= kMaxGroup) return false;
  group->members.push_back(i);
  group->changed_ns = tick.t_ns;
  tick.in.agents[i].group = id;
  return true;
}

void LeaveGroup(CrowdTick& tick, PersonIndex i) {
  Group* group = FindGroup(tick.in, tick.in.agents[i].group);
  EndTalk(tick, i);
  if (!group) return;
  std::erase(group->members, i);
  group->changed_ns = tick.t_ns;
  for (const PersonIndex other : group->members) Post(tick, i, other, kBye);
}

// F-formation: side by side on a circle, everybody looking at its centre; two stand a metre apart.
Vec2d SlotOf(const Group& group, PersonIndex i) {
  const size_t n = std::max<size_t>(2, group.members.size());
  const auto found = std::find(group.members.begin(), group.members.end(), i);
  const double k = static_cast<double>(found - group.members.begin());
  const double radius = n == 2 ? 0.5 : 0.45 / std::sin(kPi / static_cast<double>(n));
  const double angle = group.angle + 2 * kPi * k / static_cast<double>(n);
  return group.centre + Vec2d{std::cos(angle), std::sin(angle)} * radius;
}

void RunGroups(CrowdTick& tick) {
  for (Group& group : tick.in.groups) {
    // The end: the first says bye, the others answer by leaving.
    const bool alone = group.members.size() < 2 && tick.t_ns - group.since_ns > kAlone;
    if (alone || (group.ends_ns > 0 && tick.t_ns >= group.ends_ns)) {
      for (const PersonIndex i : group.members) {
        if (i != group.members[0]) Post(tick, group.members[0], i, kBye);
        EndTalk(tick, i);
      }
      group.members.clear();
      continue;
    }
    if (group.members.size() < 2) continue;

    // Whose turn is over hands it on; where nobody speaks the first begins.
    bool speaks = false;
    for (const PersonIndex i : group.members) {
      Agent& agent = tick.in.agents[i];
      PersonState& person = tick.state.people[i];
      if (TakeMessage(agent, kTurn)) {
        person.speaking = true;
        agent.turn_until_ns = tick.t_ns + static_cast<int64_t>(agent.rng.Uniform(2, 6) * 1e9);
      }
      if (!person.speaking) continue;
      if (speaks || tick.t_ns >= agent.turn_until_ns) {
        person.speaking = false;
        size_t next = agent.rng.Index(static_cast<uint32_t>(group.members.size() - 1));
        const auto self = static_cast<size_t>(std::find(group.members.begin(), group.members.end(), i) - group.members.begin());
        if (next >= self) ++next;
        if (!speaks) Post(tick, i, group.members[next], kTurn);
        continue;
      }
      speaks = true;
    }
    if (speaks) {
      group.silent_since_ns = tick.t_ns;
    } else if (tick.t_ns - group.silent_since_ns > kSilence) {
      Post(tick, group.members[1], group.members[0], kTurn);
      group.silent_since_ns = tick.t_ns;
    }
  }
  std::erase_if(tick.in.groups, [](const Group& group) { return group.members.empty(); });
}

}  // namespace airsim360::internal

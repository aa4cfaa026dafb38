#include <algorithm>

#include "airsim360/people/crowd/agent.h"

namespace airsim360::internal {

bool EnterState(CrowdTick& tick, PersonIndex i, uint8_t to, double min_s, double max_s, const std::string& cause) {
  Agent& agent = tick.in.agents[i];
  const StateDef& def = tick.plan.states[to];
  if (min_s < 0) {
    min_s = def.min_s;
    max_s = def.max_s;
  }
  max_s = std::max(min_s, max_s);
  const double seconds = max_s > 0 ? agent.rng.Uniform(min_s, max_s) : 0;
  const int64_t until = seconds > 0 ? tick.t_ns + static_cast<int64_t>(seconds * 1e9) : 0;
  if (to == agent.state) {
    agent.state_until_ns = until;
    return true;
  }
  const int64_t left = agent.left_ns[to];
  if (left >= 0 && tick.t_ns - left < static_cast<int64_t>(def.cooldown_s * 1e9)) return false;
  if (tick.events) {
    CrowdEvent event{.kind = CrowdEvent::Kind::kTransition, .t_ns = tick.t_ns, .person = i};
    event.from = tick.plan.states[agent.state].name;
    event.to = def.name;
    event.text = cause;
    tick.events->push_back(std::move(event));
  }
  agent.left_ns[agent.state] = tick.t_ns;
  agent.state_before = agent.state;
  agent.cause = cause;
  agent.state = to;
  agent.state_since_ns = tick.t_ns;
  agent.state_until_ns = until;
  return true;
}

void RunStateMachine(CrowdTick& tick, PersonIndex i) {
  Agent& agent = tick.in.agents[i];
  // Its time is over.
  if (agent.state_until_ns > 0 && tick.t_ns >= agent.state_until_ns) EnterState(tick, i, tick.plan.states[agent.state].next, -1, 0, "time");

  // Messages first, then chance; only of the state they were in at the start.
  const uint8_t state = agent.state;
  constexpr double kMinutes = kThinkEvery * static_cast<double>(kCrowdTickNs) * 1e-9 / 60;
  for (const TransitionDef& transition : tick.plan.transitions) {
    if (transition.from != kAnyState && transition.from != state) continue;
    if (transition.to == state) continue;
    std::string cause;
    if (transition.message != kNoMessage) {
      Message message;
      if (!TakeMessage(agent, transition.message, &message)) continue;
      if (!agent.rng.Chance(transition.chance)) continue;
      cause = "message: " + tick.plan.messages[transition.message];
      if (message.from != kNoPerson) cause += " from " + tick.model.people[message.from].name;
    } else {
      if (agent.commanded) continue;  // whoever obeys does nothing by chance
      if (!agent.rng.Chance(transition.rate_per_min * kMinutes)) continue;
      cause = "chance";
    }
    if (EnterState(tick, i, transition.to, -1, 0, cause)) return;
  }
}

}  // namespace airsim360::internal

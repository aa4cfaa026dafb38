#include <algorithm>

#include "airsim360/people/crowd/agent.h"

namespace airsim360::internal {

void Post(CrowdTick& tick, PersonIndex from, PersonIndex to, uint8_t type, uint32_t value) {
  const uint32_t sequence = from == kNoPerson ? 0 : tick.in.agents[from].sequence++;
  tick.in.post.push_back({type, from, to, sequence, value, tick.t_ns});
}

void Deliver(CrowdTick& tick) {
  // By time, sender and number: the order in which people thought does not matter.
  std::vector<Message> post;
  post.swap(tick.in.post);
  std::stable_sort(post.begin(), post.end(), [](const Message& a, const Message& b) {
    if (a.t_ns != b.t_ns) return a.t_ns < b.t_ns;
    return a.from != b.from ? a.from < b.from : a.sequence < b.sequence;
  });
  for (const Message& message : post) {
    Agent& agent = tick.in.agents[message.to];
    if (!tick.in.walkers[message.to].present) continue;
    if (agent.inbox.size() < kMaxInbox) {
      agent.inbox.push_back(message);
      continue;
    }
    ++tick.in.lost_messages;
    AddEvent(tick, {.kind = CrowdEvent::Kind::kMessageLost,
                    .t_ns = tick.t_ns,
                    .person = message.to,
                    .from = {},
                    .to = {},
                    .text = tick.plan.messages[message.type],
                    .other = message.from});
  }
}

bool TakeMessage(Agent& agent, uint8_t type, Message* message) {
  for (size_t k = 0; k < agent.inbox.size(); ++k) {
    if (agent.inbox[k].type != type) continue;
    if (message) *message = agent.inbox[k];
    agent.inbox.erase(agent.inbox.begin() + static_cast<int64_t>(k));
    return true;
  }
  return false;
}

void ForgetOld(Agent& agent, int64_t t_ns) {
  std::erase_if(agent.inbox, [&](const Message& message) { return t_ns - message.t_ns > kLetterLife; });
}

}  // namespace airsim360::internal

#include "airsim360/vln/language/balance.h"

#include <algorithm>

namespace airsim360::internal {
namespace {

constexpr size_t kMostWaiting = 8;   // of one key and answer
constexpr size_t kMostReady = 4096;  // groups of one type
constexpr int64_t kFirst = 3;        // rounds until items are given: by then most types have some
constexpr double kMostShare = 0.25;  // of all items, that one type may be; more where there are few types
constexpr size_t kCounts = 3;        // 0 … kCounts are asked for with every word

template <class List>
void Shuffle(List& list, RngStream& random) {
  for (size_t i = 0; i + 1 < list.size(); ++i) std::swap(list[i], list[i + random.Index(static_cast<uint32_t>(list.size() - i))]);
}

}  // namespace

void Balance::Ready(const std::string& type, std::vector<Placed> group) {
  auto& ready = ready_[type];
  if (ready.size() < kMostReady) ready.push_back(std::move(group));
}

void Balance::Add(Placed placed) {
  Draft& d = placed.draft;
  if (!matched_) {
    std::vector<size_t> order(d.answers.size());
    for (size_t i = 0; i < order.size(); ++i) order[i] = i;
    Shuffle(order, random_);
    for (const size_t i : order) placed.choices.push_back(d.answers[i]);
    placed.right = static_cast<size_t>(std::ranges::find(order, d.answer) - order.begin());
    placed.text = random_.Index(static_cast<uint32_t>(d.texts.size()));
    std::string type = d.type;
    Ready(type, {std::move(placed)});
    return;
  }
  if (d.answer_type == "number") {
    if (d.answer > kCounts) return;
    d.answers.clear();
    for (size_t n = 0; n <= kCounts; ++n) d.answers.push_back(n);
  }
  const std::string key = d.key, type = d.type;
  auto& by_answer = waiting_[key].by_answer;
  by_answer.resize(d.answers.size());
  auto& line = by_answer[d.answer];
  if (line.size() < kMostWaiting) line.push_back(std::move(placed));
  if (std::ranges::any_of(by_answer, [](const auto& q) { return q.empty(); })) return;
  // One text and one order of choices for all of a group.
  std::vector<Placed> group;
  for (auto& q : by_answer) {
    group.push_back(std::move(q.front()));
    q.pop_front();
  }
  std::vector<size_t> order(group.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  Shuffle(order, random_);
  const size_t text = random_.Index(static_cast<uint32_t>(group[0].draft.texts.size()));
  for (Placed& item : group) {
    item.text = text;
    for (const size_t i : order) item.choices.push_back(item.draft.answers[i]);
    item.right = static_cast<size_t>(std::ranges::find(order, item.draft.answer) - order.begin());
  }
  Shuffle(group, random_);
  Ready(type, std::move(group));
}

bool Balance::Lacks(const Draft& draft) const {
  const auto found = waiting_.find(draft.key);
  if (found == waiting_.end() || draft.answer >= found->second.by_answer.size()) return false;
  const auto& by_answer = found->second.by_answer;
  return by_answer[draft.answer].empty() && std::ranges::count_if(by_answer, [](const auto& q) { return q.empty(); }) == 1;
}

std::vector<Placed> Balance::Take() {
  if (++round_ < kFirst) return {};
  return TakeAbout(true);
}

std::vector<Placed> Balance::TakeAbout(bool level) {
  std::vector<Placed> taken;
  int64_t all = 0;
  const double share = std::max(kMostShare, 1.5 / static_cast<double>(std::max<size_t>(1, ready_.size())));
  for (const auto& [type, count] : given_) all += count;
  for (;;) {
    // The type that has given least of those that have something that fits.
    std::deque<std::vector<Placed>>* next = nullptr;
    const std::string* type = nullptr;
    for (auto& [name, groups] : ready_) {
      if (groups.empty() || static_cast<int64_t>(groups.front().size()) > left_) continue;
      if (next == nullptr || given_[name] < given_[*type]) {
        next = &groups;
        type = &name;
      }
    }
    if (next == nullptr || (level && static_cast<double>(given_[*type]) > static_cast<double>(slack_) + share * static_cast<double>(all)))
      return taken;
    for (Placed& item : next->front()) taken.push_back(std::move(item));
    const auto size = static_cast<int64_t>(next->front().size());
    given_[*type] += size;
    all += size;
    left_ -= size;
    next->pop_front();
  }
}

std::vector<Placed> Balance::TakeRest() {
  std::vector<Placed> taken = TakeAbout(false);
  for (auto& [type, groups] : ready_) {
    for (auto& group : groups) {
      for (Placed& item : group) {
        if (left_ == 0) return taken;
        taken.push_back(std::move(item));
        --left_;
      }
    }
  }
  return taken;
}

}  // namespace airsim360::internal

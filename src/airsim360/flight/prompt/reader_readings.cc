// Of several readings of the masses in a description the one that explains all of them and keeps the balance of a
// drone: what it is made of and carries is no more than the whole.
#include <algorithm>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/reader.h"

namespace airsim360::internal {
namespace {

constexpr size_t kMostPairs = 6;                                                       // masses of which two at once are read otherwise
constexpr double kMostLoad = 0.6, kMostBattery = 0.75, kMostBoth = 0.88, kSum = 0.05;  // shares of the whole

/// How often what was read breaks the balance of masses.
int Imbalance(const DroneRequest& r) {
  if (!r.mass) return 0;
  const double m = *r.mass, p = r.payload.value_or(0), k = r.battery_mass.value_or(0);
  int broken = (p > kMostLoad * m) + (k > kMostBattery * m) + (p + k > kMostBoth * m) + (r.empty_mass.value_or(0) > 1.01 * m);
  if (r.bare_mass && r.battery_mass) broken += *r.bare_mass + k + p > (1 + kSum) * m || *r.bare_mass + k + p < (1 - 4 * kSum) * m;
  if (r.empty_mass && r.payload) broken += *r.empty_mass + p > (1 + kSum) * m || *r.empty_mass + p < (1 - kSum) * m;
  return broken;
}

/// One reading: masses by their first tokens, and what each is.
using Roles = std::map<size_t, MassRole>;

struct Candidate {
  Roles roles;
  int cost = 0;
};

std::vector<Candidate> Candidates(const std::vector<std::pair<size_t, std::vector<MassClaim>>>& masses) {
  std::vector<Candidate> candidates;
  Candidate all;
  for (const auto& [token, claims] : masses) {
    if (claims.empty()) continue;
    all.roles[token] = claims[0].role;
    all.cost += claims[0].cost;
  }
  candidates.push_back(all);
  if (masses.size() > kMostMasses) return candidates;
  for (size_t i = 0; i < masses.size(); ++i) {
    for (const MassClaim& claim : masses[i].second) {
      candidates.push_back({{{masses[i].first, claim.role}}, claim.cost + 1});
      Candidate other = all;  // the labels' reading but for one mass
      other.roles[masses[i].first] = claim.role;
      other.cost += claim.cost - masses[i].second[0].cost;
      if (claim.role != masses[i].second[0].role) candidates.push_back(other);
      for (size_t k = i + 1; k < masses.size() && masses.size() <= kMostPairs; ++k) {
        for (const MassClaim& second : masses[k].second)
          candidates.push_back({{{masses[i].first, claim.role}, {masses[k].first, second.role}}, claim.cost + second.cost + 2});
      }
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  return candidates;
}

}  // namespace

DroneRequest ReadPrompt(std::string_view prompt) {
  constexpr int kUnexplained = 10, kUnbalanced = 20;
  const std::vector<Token> tokens = Tokenize(prompt);
  const auto cost_of = [&](const Reader& reader, const DroneRequest& request) {
    return kUnexplained * reader.unexplained() + kUnbalanced * Imbalance(request);
  };
  Reader first(prompt, tokens, {});
  std::optional<DroneRequest> best;
  std::optional<InputError> refusal;
  int least = 1 << 20;
  try {
    best = first.Run();
    least = cost_of(first, *best);
  } catch (const InputError& error) {
    refusal = error;
  }
  if (best && least == 0) return std::move(*best);
  if (!best && !first.contradicted()) throw *refusal;  // a law of nature, however the masses are read
  std::vector<std::pair<size_t, std::vector<MassClaim>>> masses;
  for (const Quantity& mass : first.Masses()) masses.push_back({mass.first, first.ClaimsOf(mass)});
  const std::vector<Candidate> candidates = Candidates(masses);
  for (const Candidate& candidate : candidates) {
    if (candidate.cost >= least) break;
    Reader reader(prompt, tokens, candidate.roles);
    const bool labelled = &candidate == &candidates.front() && candidate.cost == 0 && candidate.roles.size() == masses.size();
    try {
      DroneRequest request = reader.Run();
      const int cost = candidate.cost + cost_of(reader, request);
      // Of two figures that contradict each other none is left out.
      if (cost >= least || (refusal && reader.unexplained() > 0)) continue;
      least = cost;
      best = std::move(request);
    } catch (const InputError&) {
      // All masses have their labels, and these break the law.
      if (labelled && reader.heavy_parts()) throw;
    }
  }
  if (!best) throw *refusal;
  return std::move(*best);
}

}  // namespace airsim360::internal

// People who are out together, "parties": who they are is drawn when a crowd is made; in the step one of them leads and the
// others walk beside. After M. Moussaid, N. Perozo, S. Garnier, D. Helbing, G. Theraulaz, "The walking behaviour of pedestrian
// social groups and its impact on crowd dynamics", PLoS ONE 5(4), 2010.
#pragma once

#include "airsim360/base/random.h"
#include "airsim360/people/crowd/agent.h"
#include "airsim360/people/crowd/placement.h"

namespace airsim360::internal {

inline constexpr double kShareInParties = 0.55;     ///< of the people outdoors, unless a file says otherwise; the paper counts 0.55 to 0.7
inline constexpr size_t kLargestParty = kMaxGroup;  // they talk, all of them

/// Chance of a party of `size` in 1 … kLargestParty where `share` of the people are in parties of two and more: sizes follow a
/// Poisson law without its zero, of mean -ln(1 - share), for then 1 - exp(-mean) of the people are in company.
double PartySizeChance(size_t size, double share);
/// What is left of the speed of somebody alone: 1.25 - 0.06 n m/s for n people, between the paper's two places.
double PartySpeed(size_t size);

/// Makes parties of the people from `first` on whose trees accompany others, about `share` of all of them: children go with
/// grown people, all walk at one speed and begin beside each other.
void FormParties(CrowdModel& model, CrowdPlan& plan, Placement& placement, PersonIndex first, double share);

/// The one who leads a person's party: the first who is here and free to go; kNoPerson for who is in none.
PersonIndex LeaderOf(const CrowdTick& tick, PersonIndex i);
/// Whether somebody is in a party of which one more is here and free.
bool IsInParty(const CrowdTick& tick, PersonIndex i);

/// At 5 Hz, of a leader: who walks where beside them, and whether they wait for somebody.
void ArrangeParty(CrowdTick& tick, PersonIndex leader);
/// The velocity that somebody who accompanies a leader wants; false: they stand by.
bool WantBeside(CrowdTick& tick, PersonIndex i, PersonIndex leader);

}  // namespace airsim360::internal

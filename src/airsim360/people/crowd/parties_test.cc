#include "airsim360/people/crowd/parties.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "airsim360/people/crowd/test_crowd_files.h"

namespace airsim360 {
namespace {

using internal::CrowdFiles;
using internal::Default;
using internal::kLargestParty;
using internal::Party;
using internal::PartySizeChance;
using internal::PartySpeed;
using internal::TestCrowd;
using internal::TestGround;

std::shared_ptr<const Scene> Square(float edge) {
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, edge, edge);
  return ground.Build();
}

/// Metres between the two members of a party who are farthest apart.
double Spread(const TestCrowd& crowd, const Party& party) {
  double spread = 0;
  for (const PersonIndex i : party.members)
    for (const PersonIndex k : party.members) spread = std::max(spread, Norm(crowd[i].p_WP - crowd[k].p_WP));
  return spread;
}

class Parties : public CrowdFiles {
 protected:
  /// A party of `size` that begins in a box and goes to `goal`.
  TestCrowd PartyThatGoes(const std::shared_ptr<const Scene>& scene, size_t size, const std::string& box, const std::string& goal) {
    const std::string tree = R"(<root BTCPP_format="4"><BehaviorTree ID="goes"><Fallback><Accompany/><Sequence><GoTo point=")" + goal +
                             R"("/><Sleep msec="1000000"/></Sequence></Fallback></BehaviorTree></root>)";
    for (int seed = 1; seed < 100; ++seed) {
      TestCrowd crowd(scene, File("trees: [trees.xml]\nseed: " + std::to_string(seed) + "\nareas:\n  - {name: box, polygon: " + box +
                                      ", count: " + std::to_string(size) + ", parties: 0.9, mix: {goes: 1}}\n",
                                  tree));
      if (crowd.model->plan->parties.size() == 1 && crowd.model->plan->parties[0].members.size() == size) return crowd;
    }
    throw InputError("no party of " + std::to_string(size));
  }
};

TEST(PartySizes, AreAPoissonLawWithoutItsZeroAndTheShareIsThatOfPeople) {
  for (const double share : {0.1, 0.3, 0.55, 0.7}) {
    const double mean = -std::log(1 - share);
    double sum = 0, people = 0, in_company = 0;
    for (size_t k = 1; k <= kLargestParty; ++k) {
      const double chance = PartySizeChance(k, share), size = static_cast<double>(k);
      sum += chance;
      people += size * chance;
      if (k > 1) {
        in_company += size * chance;
        EXPECT_NEAR(chance / PartySizeChance(k - 1, share), mean / size, 1e-12);
      }
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(in_company / people, share, 0.03) << "of more than four people there is no party";
  }
  EXPECT_EQ(PartySizeChance(1, 0), 1);
  EXPECT_EQ(PartySizeChance(2, 0), 0);
}

TEST_F(Parties, OfTwoThousandPeopleHaveThoseSizesChildrenAndOneSpeedEach) {
  constexpr double kShare = 0.6;
  const TestCrowd crowd(Square(120), File("areas:\n  - {count: 2000, parties: 0.6, mix: {walker: 1}}\n"));
  const CrowdModel& model = *crowd.model;
  std::array<double, kLargestParty + 1> found{};
  size_t in_company = 0;
  for (const Party& party : model.plan->parties) {
    ASSERT_GE(party.members.size(), 2u);
    ASSERT_LE(party.members.size(), kLargestParty);
    ++found[party.members.size()];
    in_company += party.members.size();
    EXPECT_GE(model.people[party.members[0]].age, 18);
    for (const PersonIndex i : party.members) EXPECT_EQ(model.people[i].free_speed, model.people[party.members[0]].free_speed);
    EXPECT_LT(Spread(crowd, party), 2);
  }
  found[1] = static_cast<double>(model.people.size() - in_company);
  EXPECT_NEAR(static_cast<double>(in_company) / 2000, kShare, 0.06);
  double units = 0, chi2 = 0;
  for (const double n : found) units += n;
  for (size_t k = 1; k <= kLargestParty; ++k) {
    const double expected = units * PartySizeChance(k, kShare);
    chi2 += (found[k] - expected) * (found[k] - expected) / expected;
  }
  EXPECT_LT(chi2, 16.27);  // three degrees of freedom, one in a thousand
  size_t children = 0;
  for (PersonIndex i = 0; i < model.people.size(); ++i) {
    children += model.people[i].age < 18;
    EXPECT_TRUE(model.people[i].age >= 18 || model.plan->party_of_person[i] > 0) << i;
  }
  EXPECT_GT(children, 150u);
}

TEST_F(Parties, WalkSideBySideAtThePlacesOfTheirSpacingAndSlowerTheLargerTheyAre) {
  TestCrowd crowd(Square(90), File("areas:\n  - {count: 260, parties: 0.7, mix: {walker: 1}}\n"));
  std::vector<double> apart;
  size_t beside = 0;
  std::array<double, kLargestParty + 1> speed{}, count{};
  crowd.Run(20);
  for (int k = 0; k < 80; ++k) {
    crowd.Run(1);
    for (const Party& party : crowd.model->plan->parties) {
      const bool walks = std::ranges::all_of(party.members, [&](PersonIndex i) { return Norm(crowd[i].v_WP) > 0.5; });
      EXPECT_LT(Spread(crowd, party), 12);
      if (!walks) continue;
      for (const PersonIndex i : party.members) {
        EXPECT_EQ(crowd[i].group, crowd[party.members[0]].group);
        EXPECT_NE(crowd[i].group, 0u);
        // Of the pace that these people would have alone, so that it does not matter who they are.
        speed[party.members.size()] += Norm(crowd[i].v_WP) / crowd.model->people[i].free_speed * PartySpeed(party.members.size());
        ++count[party.members.size()];
      }
      if (party.members.size() != 2) continue;
      const Vec3d d = crowd[party.members[1]].p_WP - crowd[party.members[0]].p_WP, v = crowd[party.members[0]].v_WP;
      apart.push_back(Norm(d));
      beside += std::abs(Dot(d, v)) < 0.5 * Norm(d) * Norm(v);  // within 30 degrees of abreast
    }
  }
  ASSERT_GT(apart.size(), 1000u);
  std::ranges::sort(apart);
  EXPECT_GT(apart[apart.size() / 2], 0.6);
  EXPECT_LT(apart[apart.size() / 2], 1.0);
  EXPECT_LT(apart[apart.size() * 9 / 10], 1.5);
  EXPECT_GT(beside, apart.size() * 7 / 10);
  for (size_t k = 3; k <= kLargestParty; ++k) EXPECT_LT(speed[k] / count[k], speed[k - 1] / count[k - 1]) << k;
  EXPECT_EQ(crowd.Count(CrowdEvent::Kind::kStuck), 0u);
  EXPECT_GE(crowd.Closest(), 0.4 - 1e-6);
}

TEST_F(Parties, StopToTalkFacingEachOtherOneAtATime) {
  TestCrowd crowd(Square(60), File("areas:\n  - {count: 80, parties: 0.7, mix: {walker: 1}}\n"));
  size_t talks = 0, facing = 0, speakers = 0;
  for (int k = 0; k < 60; ++k) {
    crowd.Run(1);
    for (const Party& party : crowd.model->plan->parties) {
      const auto stands = [&](PersonIndex i) {
        return PersonStateName(*crowd.model, crowd.state, i) == "chatting" &&
               crowd.state.t_ns - LastTransition(*crowd.model, crowd.state, i).t_ns > 6'000'000'000;
      };
      if (!std::ranges::all_of(party.members, stands)) continue;
      ++talks;
      Vec3d centre{};
      for (const PersonIndex i : party.members) centre = centre + crowd[i].p_WP * (1.0 / static_cast<double>(party.members.size()));
      size_t speak = 0, look = 0;
      for (const PersonIndex i : party.members) {
        const Vec3d to = centre - crowd[i].p_WP;
        look += std::cos(crowd[i].yaw) * to.x + std::sin(crowd[i].yaw) * to.y > 0.7 * Norm(to);
        speak += crowd[i].speaking;
      }
      EXPECT_LE(speak, 1u);
      speakers += speak;
      facing += look == party.members.size();
    }
  }
  EXPECT_GT(talks, 100u);
  EXPECT_GT(facing, talks * 8 / 10);
  EXPECT_GT(speakers, talks / 2);
}

TEST_F(Parties, GoRoundACornerAndThroughANarrowWayTogetherAndArriveTogether) {
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, 30, 30);
  ground.Box("construction/building", {3.2f, 0, 0}, {30, 12, 5});      // a lane 3.2 m wide up to the corner,
  ground.Box("construction/building", {3.2f, 13.4f, 0}, {18, 30, 5});  // then one of 1.4 m
  const auto scene = ground.Build();
  for (const size_t size : {2u, 3u, 4u}) {
    TestCrowd crowd = PartyThatGoes(scene, size, "[[0.5, 0.5], [2.7, 0.5], [2.7, 4], [0.5, 4]]", "26;24");
    const Party& party = crowd.model->plan->parties[0];
    std::vector<double> arrived(size, 0);
    double widest = 0, closest = 1e9;
    crowd.Run(90, [&] {
      widest = std::max(widest, Spread(crowd, party));
      closest = std::min(closest, crowd.Closest());
      for (size_t k = 0; k < size; ++k)
        if (arrived[k] == 0 && Norm(crowd[party.members[k]].p_WP - Vec3d{26, 24, 0}) < 3.5)
          arrived[k] = static_cast<double>(crowd.state.t_ns) * 1e-9;
      return false;
    });
    EXPECT_LT(widest, 5.5) << size;
    EXPECT_GE(closest, 0.4 - 1e-6) << size;
    EXPECT_GT(*std::ranges::min_element(arrived), 0) << size;
    EXPECT_LT(std::ranges::max(arrived) - std::ranges::min(arrived), 5) << size;
    EXPECT_EQ(crowd.Count(CrowdEvent::Kind::kStuck), 0u);
  }
}

TEST_F(Parties, CrossOnOneGreenLight) {
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, 30, 8);
  ground.Floor("ground/road", 0, 8, 30, 16, -0.1f);
  ground.Floor("ground/sidewalk", 0, 16, 30, 24);
  ground.Floor("ground/crosswalk", 13, 8, 17, 16, -0.095f);
  ground.Box("traffic/control/traffic_light", {18, 7, 0}, {18.2f, 7.2f, 3});
  const auto scene = ground.Build();
  for (const size_t size : {2u, 3u, 4u}) {
    TestCrowd crowd = PartyThatGoes(scene, size, "[[4, 1], [9, 1], [9, 4], [4, 4]]", "22;22");
    const Party& party = crowd.model->plan->parties[0];
    ASSERT_TRUE(crowd.mesh->crossings()[0].signal);
    std::vector<double> entered(size, 0), left(size, 0);
    crowd.Run(100, [&] {
      for (size_t k = 0; k < size; ++k) {
        const double y = crowd[party.members[k]].p_WP.y, t = static_cast<double>(crowd.state.t_ns) * 1e-9;
        if (y > 8.2 && entered[k] == 0) entered[k] = t;
        if (y > 15.8 && left[k] == 0) left[k] = t;
      }
      return false;
    });
    const double phase = std::fmod(std::ranges::min(entered) + (crowd.mesh->crossings()[0].phase ? 22 : 0), 44);
    EXPECT_LT(phase, 17.5);
    EXPECT_GT(std::ranges::min(left), 0) << size;
    EXPECT_LT(std::ranges::max(entered) - std::ranges::min(entered), 7) << size;  // of 15 s of green
    EXPECT_LT(std::ranges::max(left) - std::ranges::min(left), 4) << size;
  }
}

TEST_F(Parties, WaitForWhoIsLeftBehindAndAreLedByAnotherWhenTheFirstIsSentAway) {
  const auto scene = Square(60);
  TestCrowd crowd = PartyThatGoes(scene, 3, "[[2, 2], [6, 2], [6, 6], [2, 6]]", "55;55");
  const std::vector<PersonIndex> members = crowd.model->plan->parties[0].members;
  crowd.Run(5);
  crowd.Do(members[2], MovePerson{{2, 30, 0}, 0});
  crowd.Run(30);
  EXPECT_LT(Spread(crowd, crowd.model->plan->parties[0]), 3);
  crowd.Do(members[0], SendPerson{{4, 55, 0}, 0});
  crowd.Run(70);
  EXPECT_NEAR(crowd[members[0]].p_WP.x, 4, 1);
  EXPECT_EQ(crowd[members[0]].group, 0u);
  for (const PersonIndex i : {members[1], members[2]}) {
    EXPECT_LT(Norm(crowd[i].p_WP - Vec3d{55, 55, 0}), 3);
    EXPECT_NE(crowd[i].group, 0u);
  }
}

TEST_F(Parties, OfAFileAreAsManyAsItSays) {
  const auto in_parties = [&](const std::string& parties) {
    const TestCrowd crowd(Square(60), File("areas:\n  - {count: 100" + parties + "}\n"));
    return std::ranges::count_if(crowd.model->plan->party_of_person, [](uint32_t party) { return party > 0; });
  };
  EXPECT_EQ(in_parties(", parties: 0"), 0);
  EXPECT_NEAR(static_cast<double>(in_parties("")), 55, 15);
  EXPECT_NEAR(static_cast<double>(in_parties(", parties: 0.2")), 20, 12);
  EXPECT_NE(
      ErrorOf("areas:\n  - {count: 3, parties: 0.95}\n").find("people.yaml:2: parties: expected a number from 0 to 0.9, found '0.95'"),
      std::string::npos);
  EXPECT_NE(ErrorOf("areas:\n  - {count: 3, party: 0.5}\n").find("did you mean 'parties'?"), std::string::npos);
}

}  // namespace
}  // namespace airsim360

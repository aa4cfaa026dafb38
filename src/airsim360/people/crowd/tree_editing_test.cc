#include "airsim360/people/crowd/tree_editing.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "airsim360/base/error.h"
#include "airsim360/people/crowd/test_crowd.h"

namespace airsim360 {
namespace {

using internal::TestCrowd;
using internal::TestGround;

std::shared_ptr<const Scene> Square() {
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, 30, 30);
  return ground.Build();
}

std::string Waving(const std::string& tree) {
  return "<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"" + tree +
         "\"><Sequence><SetState state=\"waving\" min_s=\"5\" max_s=\"5\"/><Sleep msec=\"100000\" name=\"rest\"/></Sequence></BehaviorTree></root>";
}

CrowdRequest Six() {
  CrowdRequest request;
  request.count = 6;
  return request;
}

TEST(TreeEditing, PeopleWhoLiveFollowTheEditedTreeAndOthersAreAsTheyWere) {
  TestCrowd crowd(Square(), Six());
  crowd.Run(3);
  const std::string tree = MindOf(*crowd.model, crowd.state, 0).tree;
  const auto edited = WithTrees(*crowd.model, Waving(tree), "page");
  AdoptTrees(*crowd.model, *edited, crowd.state);
  std::vector<std::vector<int>> before;
  for (PersonIndex i = 0; i < 6; ++i) before.push_back(MindOf(*edited, crowd.state, i).active);
  crowd.model = edited;
  crowd.Run(2);
  for (PersonIndex i = 0; i < 6; ++i) {
    const PersonMind mind = MindOf(*edited, crowd.state, i);
    EXPECT_EQ(PersonStateName(*edited, crowd.state, i) == "waving", mind.tree == tree) << i;
    EXPECT_EQ(before[i].empty(), mind.tree == tree) << i;
  }
  // Sequence is element 2 of the file (root 0, BehaviorTree 1), SetState 3.
  EXPECT_EQ(MindOf(*edited, crowd.state, 0).active, (std::vector<int>{2, 3}));
  crowd.Run(5);
  EXPECT_EQ(MindOf(*edited, crowd.state, 0).labels, (std::vector<std::string>{"Sequence", "rest"}));
  EXPECT_EQ(TreeSource(*edited, tree), Waving(tree));
}

TEST(TreeEditing, AMindTellsItsMessagesAndWhatItsKeysHold) {
  TestCrowd crowd(Square(), Six());
  crowd.Run(1);
  const std::string tree = MindOf(*crowd.model, crowd.state, 0).tree;
  const std::string xml =
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"" + tree +
      R"("><Sequence><SetBlackboard value="7.5" output_key="{count}"/><SubTree ID="rest" mood="waving" point="3;4"/></Sequence></BehaviorTree>
    <BehaviorTree ID="rest"><Sequence><SetBlackboard value="{point}" output_key="{copy}"/><SetState state="{mood}" min_s="30" max_s="30"/><SetBlackboard value="1" output_key="{later}"/></Sequence></BehaviorTree></root>)";
  const auto edited = WithTrees(*crowd.model, xml, "page");
  AdoptTrees(*crowd.model, *edited, crowd.state);
  crowd.model = edited;
  crowd.Run(1);
  crowd.Do(0, MessagePerson{"greet"});
  crowd.Run(0.5);
  const PersonMind mind = MindOf(*edited, crowd.state, 0);
  std::vector<std::string> board;
  for (const auto& [key, value] : mind.board) board.push_back(key + "=" + value);
  std::ranges::sort(board);
  // Keys of a subtree are its own; the choice is told by its name; what no node has written yet is not there.
  EXPECT_EQ(board, (std::vector<std::string>{"count=7.5", "rest/copy=3;4", "rest/mood=waving", "rest/point=3;4"}));
  ASSERT_EQ(mind.inbox.size(), 1u);
  EXPECT_EQ(mind.inbox[0].type, "greet");
  EXPECT_EQ(mind.inbox[0].from, kNoPerson);
  EXPECT_NEAR(1e-9 * static_cast<double>(mind.inbox[0].t_ns), 2, 0.2);
}

TEST(TreeEditing, WhatIsWrongChangesNothing) {
  TestCrowd crowd(Square(), Six());
  EXPECT_THROW(WithTrees(*crowd.model, Waving("x").replace(60, 4, "<Nod"), "page"), InputError);
  try {
    WithTrees(*crowd.model, "<root BTCPP_format=\"4\"><BehaviorTree ID=\"a\">\n<SetState state=\"wavin\"/></BehaviorTree></root>", "page");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("page:2: SetState state: unknown state 'wavin'; did you mean 'waving'"), std::string::npos)
        << error.what();
  }
  EXPECT_THROW(TreeSource(*crowd.model, "walkr"), InputError);
  EXPECT_NE(TreeSource(*crowd.model, "walker").find("walker"), std::string::npos);
  const std::vector<std::string> names = TreeNames(*crowd.model);
  EXPECT_NE(std::ranges::find(names, "walker"), names.end());
}

}  // namespace
}  // namespace airsim360

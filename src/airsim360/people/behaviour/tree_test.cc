#include <gtest/gtest.h>

#include <map>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/behaviour/tree_run.h"
#include "airsim360/behaviour/xml.h"
#include "airsim360/people/behaviour/person_nodes.h"
#include "airsim360/people/behaviour/plan.h"
#include "airsim360/people/behaviour/tree_files.h"

namespace airsim360::internal {
namespace {

/// Leaves that do what a script says: StateIs answers by its number, WaitMessage runs until `done`.
class Script : public Leaves {
 public:
  Status Tick(const Tree& tree, const TreeNode& node, NodeMemory&, TreeRun& run) override {
    log += node.label + " ";
    if (static_cast<PersonNode>(node.node) == PersonNode::kChance)
      return NumberOf(tree, node, run, 0) > 0.5 ? Status::kSuccess : Status::kFailure;
    const auto found = answers.find(node.label);
    return found == answers.end() ? Status::kRunning : found->second;
  }
  void Halt(const Tree&, const TreeNode& node, NodeMemory&, TreeRun&) override { log += "-" + node.label + " "; }
  std::map<std::string, Status> answers;
  std::string log;
};

Value Parse(char kind, const std::string& text) {
  if (kind == 'p') return ParsePoint(text);
  Value value;
  value.kind = Value::Kind::kNumber;
  return value;
}

TreeSet Read(const std::string& body, const std::string& more = "") {
  TreeSet set;
  ReadTrees("<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"main\">\n" + body + "\n</BehaviorTree>\n" + more + "</root>", "test.xml",
            PersonPalette(), Parse, set);
  return set;
}

struct Play {
  explicit Play(const std::string& body, const std::string& more = "") : set(Read(body, more)) { run.Start(set.trees[0]); }
  Status At(double seconds) {
    script.log.clear();
    return TickTree(set.trees[0], run, static_cast<int64_t>(seconds * 1e9), script);
  }
  TreeSet set;
  TreeRun run;
  Script script;
};

const std::string kYes = "<Chance p=\"1\" name=\"yes\"/>", kNo = "<Chance p=\"0\" name=\"no\"/>";
std::string Act(const std::string& name) { return "<WanderTo name=\"" + name + "\"/>"; }

TEST(Tree, SequenceStopsAtTheFirstFailureAndRemembersWhoRuns) {
  Play play("<Sequence>" + kYes + Act("a") + kYes + "</Sequence>");
  EXPECT_EQ(play.At(0), Status::kRunning);
  EXPECT_EQ(play.script.log, "yes a ");
  EXPECT_EQ(play.At(1), Status::kRunning);
  EXPECT_EQ(play.script.log, "a ");  // not from the start
  play.script.answers["a"] = Status::kSuccess;
  EXPECT_EQ(play.At(2), Status::kSuccess);
  EXPECT_EQ(play.script.log, "a yes ");
  play.script.answers["a"] = Status::kFailure;
  EXPECT_EQ(play.At(3), Status::kFailure);
  EXPECT_EQ(play.script.log, "yes a ");
}

TEST(Tree, SequenceWithMemoryTriesTheFailedChildFirst) {
  Play play("<SequenceWithMemory>" + kYes + Act("a") + "</SequenceWithMemory>");
  play.script.answers["a"] = Status::kFailure;
  EXPECT_EQ(play.At(0), Status::kFailure);
  EXPECT_EQ(play.At(1), Status::kFailure);
  EXPECT_EQ(play.script.log, "a ");
}

TEST(Tree, ReactiveNodesStartOverAndHaltWhatRan) {
  Play play("<ReactiveFallback>" + Act("first") + Act("second") + "</ReactiveFallback>");
  play.script.answers["first"] = Status::kFailure;
  EXPECT_EQ(play.At(0), Status::kRunning);
  EXPECT_EQ(play.script.log, "first second ");
  play.script.answers.erase("first");
  EXPECT_EQ(play.At(1), Status::kRunning);
  EXPECT_EQ(play.script.log, "first -second ");
  Play sequence("<ReactiveSequence>" + Act("first") + Act("second") + "</ReactiveSequence>");
  sequence.script.answers["first"] = Status::kSuccess;
  EXPECT_EQ(sequence.At(0), Status::kRunning);
  sequence.script.answers["first"] = Status::kFailure;
  EXPECT_EQ(sequence.At(1), Status::kFailure);
  EXPECT_EQ(sequence.script.log, "first -second ");
}

TEST(Tree, FallbackAndBranchesAndParallels) {
  EXPECT_EQ(Play("<Fallback>" + kNo + kYes + kNo + "</Fallback>").At(0), Status::kSuccess);
  EXPECT_EQ(Play("<Fallback>" + kNo + kNo + "</Fallback>").At(0), Status::kFailure);
  EXPECT_EQ(Play("<IfThenElse>" + kNo + kNo + kYes + "</IfThenElse>").At(0), Status::kSuccess);
  EXPECT_EQ(Play("<IfThenElse>" + kNo + kYes + "</IfThenElse>").At(0), Status::kFailure);
  EXPECT_EQ(Play("<Parallel success_count=\"2\" failure_count=\"2\">" + kYes + kNo + kYes + "</Parallel>").At(0), Status::kSuccess);
  EXPECT_EQ(Play("<Parallel>" + kYes + kNo + "</Parallel>").At(0), Status::kFailure);
  Play all("<ParallelAll>" + Act("a") + kYes + "</ParallelAll>");
  EXPECT_EQ(all.At(0), Status::kRunning);
  all.script.answers["a"] = Status::kSuccess;
  EXPECT_EQ(all.At(1), Status::kSuccess);
  EXPECT_EQ(all.script.log, "a ");  // the other has ended
  Play loop("<WhileDoElse>" + Act("c") + Act("x") + Act("y") + "</WhileDoElse>");
  loop.script.answers["c"] = Status::kSuccess;
  EXPECT_EQ(loop.At(0), Status::kRunning);
  loop.script.answers["c"] = Status::kFailure;
  EXPECT_EQ(loop.At(1), Status::kRunning);
  EXPECT_EQ(loop.script.log, "c -x y ");
}

TEST(Tree, Decorators) {
  EXPECT_EQ(Play("<Inverter>" + kNo + "</Inverter>").At(0), Status::kSuccess);
  EXPECT_EQ(Play("<ForceSuccess>" + kNo + "</ForceSuccess>").At(0), Status::kSuccess);
  EXPECT_EQ(Play("<ForceFailure>" + kYes + "</ForceFailure>").At(0), Status::kFailure);
  Play repeat("<Repeat num_cycles=\"3\">" + kYes + "</Repeat>");
  EXPECT_EQ(repeat.At(0), Status::kRunning);
  EXPECT_EQ(repeat.At(1), Status::kRunning);
  EXPECT_EQ(repeat.At(2), Status::kSuccess);
  Play retry("<RetryUntilSuccessful num_attempts=\"2\">" + kNo + "</RetryUntilSuccessful>");
  EXPECT_EQ(retry.At(0), Status::kRunning);
  EXPECT_EQ(retry.At(1), Status::kFailure);
  Play timeout("<Timeout msec=\"1500\">" + Act("a") + "</Timeout>");
  EXPECT_EQ(timeout.At(0), Status::kRunning);
  EXPECT_EQ(timeout.At(1), Status::kRunning);
  EXPECT_EQ(timeout.At(1.5), Status::kFailure);
  EXPECT_EQ(timeout.script.log, "-a ");
  Play delay("<Delay delay_msec=\"1000\">" + kYes + "</Delay>");
  EXPECT_EQ(delay.At(5), Status::kRunning);
  EXPECT_EQ(delay.At(6), Status::kSuccess);
  Play once("<Sequence><RunOnce>" + kYes + "</RunOnce>" + kYes + "</Sequence>");
  EXPECT_EQ(once.At(0), Status::kSuccess);
  EXPECT_EQ(once.At(1), Status::kSuccess);
  EXPECT_EQ(once.script.log, "yes ");
  Play sleep("<Sleep msec=\"400\"/>");
  EXPECT_EQ(sleep.At(2), Status::kRunning);
  EXPECT_EQ(sleep.At(2.4), Status::kSuccess);
}

TEST(Tree, SubtreesShareKeysOnlyWhereTheyAreTied) {
  const std::string inner = "<BehaviorTree ID=\"inner\"><Chance p=\"{chance}\" name=\"inner\"/></BehaviorTree>";
  // A value, a key of outside, the same names, and nothing at all (the key is empty: 0).
  EXPECT_EQ(Play("<SubTree ID=\"inner\" chance=\"1\"/>", inner).At(0), Status::kSuccess);
  const std::string set = "<SetBlackboard value=\"1\" output_key=\"{x}\"/>", same = "<SetBlackboard value=\"1\" output_key=\"{chance}\"/>";
  EXPECT_EQ(Play("<Sequence>" + set + "<SubTree ID=\"inner\" chance=\"{x}\"/></Sequence>", inner).At(0), Status::kSuccess);
  EXPECT_EQ(Play("<Sequence>" + same + "<SubTree ID=\"inner\"/></Sequence>", inner).At(0), Status::kFailure);
  EXPECT_EQ(Play("<Sequence>" + same + "<SubTree ID=\"inner\" _autoremap=\"true\"/></Sequence>", inner).At(0), Status::kSuccess);
}

std::string ErrorOf(const std::string& body, const std::string& more = "") {
  try {
    Read(body, more);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Tree, ErrorsNameTheLineAndTheNearestChoice) {
  EXPECT_NE(ErrorOf("<Sequense>" + kYes + "</Sequense>").find("test.xml:3: unknown node 'Sequense'; did you mean 'Sequence'?"),
            std::string::npos);
  EXPECT_NE(ErrorOf("<Chance q=\"1\"/>").find("test.xml:3: Chance: unknown attribute 'q' (choices: "), std::string::npos);
  EXPECT_NE(ErrorOf("<Chance/>").find("needs the attribute 'p'"), std::string::npos);
  EXPECT_NE(ErrorOf("<Chance p=\"often\"/>").find("expected a number, found 'often'"), std::string::npos);
  EXPECT_NE(ErrorOf("<Inverter/>").find("has 0 children, not one"), std::string::npos);
  EXPECT_NE(ErrorOf("<SubTree ID=\"mian\"/>").find("did you mean 'main'?"), std::string::npos);
  EXPECT_NE(ErrorOf("<SubTree ID=\"main\"/>").find("contains itself"), std::string::npos);
  EXPECT_NE(ErrorOf("<GoTo point=\"1;b\"/>").find("expected 'x;y' or 'x;y;z'"), std::string::npos);
  EXPECT_NE(ErrorOf("<Sequence>\n<Chance p=\"1\"></Sequence>").find("test.xml:4:"), std::string::npos);
  EXPECT_NE(ErrorOf("<AlwaysSuccess _skipIf=\"x\"/>").find("unknown attribute '_skipIf'"), std::string::npos);
  EXPECT_THROW(ReadXml("<!DOCTYPE a [<!ENTITY b \"c\">]><a>&b;</a>", "x"), InputError);
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += "<Inverter>";
  EXPECT_NE(ErrorOf(deep).find("64 deep"), std::string::npos);
}

TEST(Tree, TheDefaultTreesReadAndTheModelForEditorsIsXml) {
  TreeSet set;
  ReadTrees(DefaultTreesXml(), "default", PersonPalette(), Parse, set);
  for (const bool furnished : {false, true})
    for (const auto& [name, weight] : DefaultMix(furnished))
      EXPECT_TRUE(std::any_of(set.trees.begin(), set.trees.end(), [&](const Tree& t) { return t.name == name; })) << name;
  const XmlElement model = ReadXml(PersonPalette().ModelXml(), "model");
  EXPECT_EQ(model.tag, "TreeNodesModel");
  EXPECT_GT(model.children.size(), 15u);
  // Every leaf has one row, whose number is its own.
  std::set<int> numbers;
  for (const NodeInfo& info : PersonPalette().nodes())
    EXPECT_TRUE(info.node < Node::kFirstLeaf || numbers.insert(static_cast<int>(info.node)).second) << info.name;
  EXPECT_EQ(*numbers.rbegin(), static_cast<int>(PersonNode::kEvery));
  EXPECT_EQ(numbers.size(), static_cast<size_t>(*numbers.rbegin() - *numbers.begin() + 1));
}

TEST(Tree, FilesOfTreesAreCheckedWithTheWordsOfTheCrowd) {
  const std::vector<std::string> names = CheckPeopleTrees(DefaultPeopleTrees(), "default");
  EXPECT_NE(std::find(names.begin(), names.end(), "walker"), names.end());
  EXPECT_EQ(WriteXml(ReadXml(DefaultPeopleTrees(), "x")), DefaultPeopleTrees());
  const auto error = [](const std::string& leaf, const TreeWords& words = {}) -> std::string {
    try {
      CheckPeopleTrees("<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"a\">" + leaf + "</BehaviorTree></root>", "t.xml", words);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(error("<SetState state=\"textin\"/>").substr(0, 71), "t.xml:2: SetState state: unknown state 'textin'; did you mean 'texting'");
  EXPECT_EQ(error("<SetState state=\"cheering\"/>", {.states = {"cheering"}, .messages = {}, .areas = {}}), "");
  EXPECT_NE(error("<GoTo point=\"1;2;3;4\"/>").find("expected 'x;y'"), std::string::npos);
  EXPECT_EQ(error("<GoTo point=\"1;2\"/>"), "");
  EXPECT_EQ(error("<GoToPlace kind=\"bench\"/>"), "");
  EXPECT_NE(error("<GoToPlace kind=\"queue\"/>").find("unknown kind of place 'queue'"), std::string::npos);  // Queue is for that
  EXPECT_NE(error("<WanderTo area=\"plasa\"/>", {.states = {}, .messages = {}, .areas = {"plaza"}, .any_area = false})
                .find("did you mean 'plaza'"),
            std::string::npos);
}

TEST(Tree, IfAndRetryAreOtherNamesOfWhatTheyStandFor) {
  Play branch("<If>" + kNo + Act("a") + Act("b") + "</If>");
  branch.At(0);
  EXPECT_EQ(branch.script.log, "no b ");
  Play again("<Retry num_attempts=\"2\">" + kNo + "</Retry>");
  EXPECT_EQ(again.At(0), Status::kRunning);
  EXPECT_EQ(again.At(1), Status::kFailure);
}

TEST(Tree, WrittenXmlReadsBackAndIsWrittenTheSameWay) {
  const std::string text =
      "<root BTCPP_format=\"4\">\n  <BehaviorTree ID=\"a &amp; b\">\n    <WanderTo area=\"x &lt; &quot;y&quot;&#10;z\"/>\n  </BehaviorTree>\n</root>\n";
  EXPECT_EQ(WriteXml(ReadXml(text, "x")), text);
  // However it was laid out.
  EXPECT_EQ(
      WriteXml(ReadXml(
          "<root BTCPP_format='4'><BehaviorTree\n ID='a &amp; b'><WanderTo area='x &lt; &quot;y&quot;&#10;z'></WanderTo></BehaviorTree></root>",
          "x")),
      text);
}

}  // namespace
}  // namespace airsim360::internal

#include "airsim360/people/behaviour/person_nodes.h"

namespace airsim360::internal {

using enum behaviour::NodeClass;

const behaviour::Palette& PersonPalette() {
  constexpr auto Of = [](PersonNode node) { return static_cast<behaviour::Node>(node); };
  static const behaviour::Palette palette({
      {Of(PersonNode::kWanderTo),
       "WanderTo",
       kAction,
       {{"area", 'a', "", false, "name of an area; empty: their own"}, {"speed", 'n', "0", false, "m/s; 0: as they like"}},
       "walks to a place drawn from an area; taken up again where it was broken off"},
      {Of(PersonNode::kGoTo), "GoTo", kAction, {{"point", 'p', nullptr, false, "x;y or x;y;z"}, {"speed", 'n', "0"}}, "walks to a point"},
      {Of(PersonNode::kGoToPlace),
       "GoToPlace",
       kAction,
       {{"kind", 'k', nullptr, false, "bench, shop, food, sight or stop"}, {"distance", 'n', "60", false, "metres"}},
       "walks to a free place nearby and faces it (a bench: turns its back to it)"},
      {Of(PersonNode::kSetState),
       "SetState",
       kAction,
       {{"state", 's', nullptr}, {"min_s", 'n', "-1"}, {"max_s", 'n', "-1"}, {"wait", 't', "true", false, "until it ends"}},
       "enters a state, if the state machine lets them"},
      {Of(PersonNode::kEndState), "EndState", kAction, {}, "back to the state that follows"},
      {Of(PersonNode::kMeet),
       "Meet",
       kAction,
       {{"distance", 'n', "3"}, {"chance", 'n', "0.3"}, {"cooldown_s", 'n', "60"}, {"person", 'o', "", true}},
       "greets someone free who is near and waits for the answer"},
      {Of(PersonNode::kAnswerGreeting),
       "AnswerGreeting",
       kAction,
       {{"chance", 'n', "0.6"}, {"person", 'o', "", true}},
       "accepts or declines a greeting that waits"},
      {Of(PersonNode::kChat), "Chat", kAction, {{"min_s", 'n', "8"}, {"max_s", 'n', "40"}}, "talks with the group until somebody says bye"},
      {Of(PersonNode::kSend),
       "Send",
       kAction,
       {{"message", 'm', nullptr}, {"to", 't', "radius", false, "person, group or radius"}, {"person", 'p', ""}, {"distance", 'n', "10"}},
       "sends a message"},
      {Of(PersonNode::kWaitMessage),
       "WaitMessage",
       kAction,
       {{"message", 'm', nullptr}, {"timeout_s", 'n', "5"}, {"person", 'o', "", true}},
       "until a message comes"},
      {Of(PersonNode::kFacePerson), "FacePerson", kAction, {{"person", 'p', nullptr}}, "turns towards someone"},
      {Of(PersonNode::kLookAtDrone),
       "LookAtDrone",
       kAction,
       {{"distance", 'n', "12"}, {"min_s", 'n', "3"}, {"max_s", 'n', "8"}},
       "stops, looks up at the nearest drone; some point at it or take a photo"},
      {Of(PersonNode::kStepAway), "StepAway", kAction, {{"distance", 'n', "5"}}, "walks away from the nearest drone until it is that far"},
      {Of(PersonNode::kChance), "Chance", kCondition, {{"p", 'n', nullptr}}, "true with probability p"},
      {Of(PersonNode::kStateIs), "StateIs", kCondition, {{"state", 's', nullptr}}, ""},
      {Of(PersonNode::kDroneWithin), "DroneWithin", kCondition, {{"distance", 'n', nullptr}}, "metres from the head"},
      {Of(PersonNode::kPersonWithin),
       "PersonWithin",
       kCondition,
       {{"distance", 'n', nullptr}, {"person", 'o', "", true}},
       "nearest person"},
      {Of(PersonNode::kMessageWaiting), "MessageWaiting", kCondition, {{"message", 'm', nullptr}}, ""},
      {Of(PersonNode::kEvery),
       "Every",
       kCondition,
       {{"seconds", 'n', nullptr}, {"first_s", 'n', "-1", false, "-1: as seconds"}},
       "true once, then not for that long; the first time within first_s, at random",
       true},
  });
  return palette;
}

}  // namespace airsim360::internal

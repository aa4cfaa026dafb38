#include "airsim360/people/behaviour/plan.h"

namespace airsim360::internal {

const char* const kBehaviourNames[] = {"idle",    "walk",       "jog",  "run",     "talk",     "listen",        "phone_call",
                                       "texting", "take_photo", "wave", "sit",     "carry",    "push_stroller", "crouch",
                                       "stretch", "point",      "wait", "look_up", "walk_dog", "umbrella"};
static_assert(std::size(kBehaviourNames) == static_cast<size_t>(Behaviour::kCount));

std::vector<StateDef> DefaultStates() {
  using enum Behaviour;
  std::vector<StateDef> states(kBuiltInStates);
  const auto set = [&](BuiltInState state, StateDef def) { states[state] = std::move(def); };
  set(kWalking, {.name = "walking", .lower = {}, .upper = {}});
  set(kStanding, {.name = "standing", .lower = {}, .upper = {}, .stop = true, .min_s = 2, .max_s = 15});
  set(kChatting, {.name = "chatting", .lower = {}, .upper = kTalk, .stop = true});
  set(kOnPhoneCall, {.name = "on_phone_call", .lower = {}, .upper = kPhoneCall, .speed = 0.85, .min_s = 10, .max_s = 60, .cooldown_s = 40});
  set(internal::kTexting,
      {.name = "texting", .lower = {}, .upper = Behaviour::kTexting, .speed = 0.75, .min_s = 8, .max_s = 30, .cooldown_s = 20});
  set(kTakingPhoto, {.name = "taking_photo", .lower = {}, .upper = kTakePhoto, .stop = true, .min_s = 3, .max_s = 7});
  set(kWaving, {.name = "waving", .lower = {}, .upper = kWave, .min_s = 2, .max_s = 3.5, .cooldown_s = 10});
  set(kSitting, {.name = "sitting", .lower = kSit, .upper = {}, .stop = true, .min_s = 20, .max_s = 90});
  set(kCarrying, {.name = "carrying", .lower = {}, .upper = kCarry, .speed = 0.95});
  set(kPushingStroller, {.name = "pushing_stroller", .lower = {}, .upper = kPushStroller, .speed = 0.85});
  set(kCrouching, {.name = "crouching", .lower = kCrouch, .upper = {}, .stop = true, .min_s = 4, .max_s = 10, .cooldown_s = 60});
  set(kStretching, {.name = "stretching", .lower = kStretch, .upper = {}, .stop = true, .min_s = 10, .max_s = 25});
  set(kPointing, {.name = "pointing", .lower = {}, .upper = kPoint, .stop = true, .min_s = 2, .max_s = 4});
  set(kWaiting, {.name = "waiting", .lower = kWait, .upper = {}, .stop = true, .min_s = 3, .max_s = 20});
  set(kLookingUp, {.name = "looking_up", .lower = {}, .upper = kLookUp, .stop = true, .min_s = 3, .max_s = 8});
  set(kWithUmbrella, {.name = "with_umbrella", .lower = {}, .upper = kUmbrella});
  set(kWithDog, {.name = "with_dog", .lower = {}, .upper = kWalkDog, .speed = 0.9});
  set(kSittingWithPhone,
      {.name = "sitting_with_phone", .lower = kSit, .upper = Behaviour::kTexting, .stop = true, .min_s = 20, .max_s = 90});
  return states;
}

std::vector<std::string> DefaultMessages() { return {"greet", "accept", "decline", "turn", "bye", "call", "alarm", "drone_near", "hello"}; }

std::vector<TransitionDef> DefaultTransitions() {
  return {{.from = kWalking, .to = kOnPhoneCall, .message = kCall},
          {.from = kWalking, .to = kWaving, .message = kHello, .chance = 0.7},
          {.from = kWalking, .to = kOnPhoneCall, .rate_per_min = 0.3},
          {.from = kWalking, .to = internal::kTexting, .rate_per_min = 0.3}};
}

const std::vector<std::pair<std::string, double>>& DefaultMix(bool furnished) {
  static const std::vector<std::pair<std::string, double>> rooms = {
      {"sitter", 9}, {"walker", 6}, {"shopper", 3}, {"customer", 3}, {"caller", 1}};
  if (furnished) return rooms;
  static const std::vector<std::pair<std::string, double>> mix = {{"walker", 10}, {"shopper", 3}, {"sitter", 3},    {"jogger", 1},
                                                                  {"parent", 1},  {"tourist", 2}, {"athlete", 0.5}, {"caller", 1}};
  return mix;
}

namespace {

constexpr std::string_view kDefaultTrees = R"(<root BTCPP_format="4" main_tree_to_execute="walker">
  <!-- Someone with no particular aim: strolls, meets people, looks up at drones. -->
  <BehaviorTree ID="walker">
    <ReactiveFallback>
      <SubTree ID="notice_drone"/>
      <Accompany/>
      <SubTree ID="socialise"/>
      <SubTree ID="stroll" rest="0.25"/>
    </ReactiveFallback>
  </BehaviorTree>

  <BehaviorTree ID="notice_drone">
    <Fallback>
      <Sequence>
        <DroneWithin distance="3"/>
        <StepAway distance="5"/>
      </Sequence>
      <Sequence>
        <DroneWithin distance="12"/>
        <Every seconds="40" first_s="8"/>
        <Send message="drone_near" to="radius" distance="8"/>
        <LookAtDrone distance="16" min_s="3" max_s="9"/>
      </Sequence>
    </Fallback>
  </BehaviorTree>

  <!-- Walkers who meet stop, face each other, talk in turns and then go on to where they were going. -->
  <BehaviorTree ID="socialise">
    <Sequence>
      <Fallback>
        <AnswerGreeting chance="0.7" person="{other}"/>
        <Meet distance="3" chance="0.25" cooldown_s="90" person="{other}"/>
      </Fallback>
      <Chat min_s="8" max_s="40"/>
    </Sequence>
  </BehaviorTree>

  <BehaviorTree ID="stroll">
    <Sequence>
      <SubTree ID="gather"/>
      <WanderTo/>
      <Fallback>
        <Inverter><Chance p="{rest}"/></Inverter>
        <Sequence><Chance p="0.35"/><SetState state="standing"/></Sequence>
        <Sequence><Chance p="0.4"/><GoToPlace kind="bench"/><SubTree ID="sit"/></Sequence>
        <Sequence><Chance p="0.5"/><GoToPlace kind="shop"/><SetState state="standing" min_s="4" max_s="15"/></Sequence>
        <Sequence><Chance p="0.5"/><SetState state="crouching"/></Sequence>
        <AlwaysSuccess/>
      </Fallback>
    </Sequence>
  </BehaviorTree>

  <!-- Who is out with others sometimes stops to talk with them. -->
  <BehaviorTree ID="gather">
    <Fallback>
      <Sequence><Chance p="0.4"/><Gather min_s="15" max_s="90"/></Sequence>
      <AlwaysSuccess/>
    </Fallback>
  </BehaviorTree>

  <BehaviorTree ID="sit">
    <Fallback>
      <Sequence><Chance p="0.4"/><SetState state="sitting_with_phone"/></Sequence>
      <SetState state="sitting"/>
    </Fallback>
  </BehaviorTree>

  <BehaviorTree ID="shopper">
    <ReactiveFallback>
      <SubTree ID="notice_drone"/>
      <Accompany/>
      <SubTree ID="socialise"/>
      <Sequence>
        <SubTree ID="gather"/>
        <SetState state="carrying" wait="false"/>
        <Fallback>
          <Sequence>
            <GoToPlace kind="shop" distance="80"/>
            <SetState state="standing" min_s="5" max_s="20"/>
          </Sequence>
          <AlwaysSuccess/>
        </Fallback>
        <SetState state="carrying" wait="false"/>
        <WanderTo/>
      </Sequence>
    </ReactiveFallback>
  </BehaviorTree>

  <!-- Fetches something and pays for it; where there is no counter, one more who strolls. -->
  <BehaviorTree ID="customer">
    <ReactiveFallback>
      <SubTree ID="notice_drone"/>
      <Sequence>
        <Fallback>
          <Queue distance="80"/>
          <SetState state="standing"/>
        </Fallback>
        <SetState state="carrying" wait="false"/>
        <WanderTo/>
      </Sequence>
    </ReactiveFallback>
  </BehaviorTree>

  <BehaviorTree ID="sitter">
    <ReactiveFallback>
      <SubTree ID="notice_drone"/>
      <Sequence>
        <Fallback>
          <Sequence><GoToPlace kind="bench" distance="100"/><SubTree ID="sit"/></Sequence>
          <SetState state="standing" min_s="10" max_s="40"/>
        </Fallback>
        <WanderTo/>
      </Sequence>
    </ReactiveFallback>
  </BehaviorTree>

  <BehaviorTree ID="jogger">
    <ReactiveFallback>
      <SubTree ID="notice_drone"/>
      <WanderTo speed="2.7"/>
    </ReactiveFallback>
  </BehaviorTree>

  <BehaviorTree ID="parent">
    <ReactiveFallback>
      <SubTree ID="notice_drone"/>
      <Accompany/>
      <Sequence>
        <SetState state="pushing_stroller" wait="false"/>
        <WanderTo/>
      </Sequence>
    </ReactiveFallback>
  </BehaviorTree>

  <BehaviorTree ID="tourist">
    <ReactiveFallback>
      <SubTree ID="notice_drone"/>
      <Accompany/>
      <SubTree ID="socialise"/>
      <Sequence>
        <SubTree ID="gather"/>
        <Fallback>
          <Sequence><Chance p="0.5"/><GoToPlace kind="sight" distance="120"/></Sequence>
          <WanderTo/>
        </Fallback>
        <Fallback>
          <Sequence><Chance p="0.6"/><SetState state="taking_photo"/></Sequence>
          <Sequence><Chance p="0.5"/><SetState state="pointing"/></Sequence>
          <SetState state="standing"/>
        </Fallback>
      </Sequence>
    </ReactiveFallback>
  </BehaviorTree>

  <BehaviorTree ID="athlete">
    <ReactiveFallback>
      <SubTree ID="notice_drone"/>
      <Sequence>
        <SetState state="stretching"/>
        <WanderTo speed="3.4"/>
        <SetState state="stretching"/>
        <WanderTo speed="2.4"/>
      </Sequence>
    </ReactiveFallback>
  </BehaviorTree>

  <!-- Long calls, walking and standing. -->
  <BehaviorTree ID="caller">
    <ReactiveFallback>
      <SubTree ID="notice_drone"/>
      <Sequence>
        <SetState state="on_phone_call" min_s="30" max_s="90" wait="false"/>
        <WanderTo/>
        <SetState state="standing"/>
        <WanderTo/>
      </Sequence>
    </ReactiveFallback>
  </BehaviorTree>
</root>
)";

}  // namespace

std::string_view DefaultTreesXml() { return kDefaultTrees; }

}  // namespace airsim360::internal

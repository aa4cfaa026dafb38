// People at run time: who is where and does what, and commands to single persons. Positions are in the global
// N frame (metres north, east, down of the origin), as in AirSim's calls about objects.
#include <cmath>
#include <stdexcept>

#include "airsim360/rpc/api/api.h"
#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/sim/people/people.h"

namespace airsim360 {
namespace {

using Text = const std::string&;

/// One person in an answer.
struct PersonInfo {
  std::string name, behaviour, locomotion, state, cause;
  uint32_t entity_id = 0, track_id = 0, group_id = 0;
  bool speaking = false, visible = false;
  airsim::Pose pose;
  airsim::Vector3r velocity;
  template <class V>
  void Visit(V& v) {
    v("name", name), v("behaviour", behaviour), v("locomotion", locomotion), v("state", state), v("cause", cause),
        v("entity_id", entity_id);
    v("track_id", track_id), v("group_id", group_id), v("speaking", speaking), v("visible", visible);
    v("pose", pose), v("velocity", velocity);
  }
};

const SimPeople& PeopleOf(const SimModel& model) {
  if (!model.people) throw std::invalid_argument("there are no people in this world; start the server with --people N");
  return *model.people;
}

// The index of a person by the name of their entity ("person/007") or of the crowd ("person 7").
PersonIndex Find(const SimPeople& people, Text name) {
  for (size_t i = 0; i < people.cast.size(); ++i) {
    if (people.cast[i].name == name) return static_cast<PersonIndex>(i);
  }
  return PersonByName(*people.crowd, name);
}

void CommandPerson(Session& s, Text name, const PersonAction& action) {
  const SimPeople& people = PeopleOf(s.model());
  // Snapshots keep the people that they have.
  auto changed = std::make_shared<PeopleState>(*s.state().people);
  CommandPerson(*people.crowd, changed->crowd, Find(people, name), action);
  s.state().people = std::move(changed);
}

double YawOf(const airsim::Pose& pose, Vec3d origin_W) {
  const Mat3d R = airsim::FromPose(pose, origin_W).R;
  return std::atan2(R.m[1][0], R.m[0][0]);
}

void AddReading(Api& api) {
  api.Read("simListPeople", [](const Snapshot& now) {
    std::vector<std::string> names;
    for (const PersonInScene& person : PeopleOf(*now.model).cast) names.push_back(person.name);
    return names;
  });
  api.Read("simGetPeople", [&api](const Snapshot& now) {
    const SimPeople& people = PeopleOf(*now.model);
    const double later = static_cast<double>(now.state.t_ns + people.epoch_ns - now.state.people->crowd.t_ns) * 1e-9;
    std::vector<PersonInfo> list;
    for (size_t i = 0; i < people.cast.size(); ++i) {
      const PersonState& state = now.state.people->crowd.people[i];
      PersonInfo info;
      info.name = people.cast[i].name;
      info.behaviour = BehaviourName(state.upper);
      info.locomotion = BehaviourName(state.lower);
      const PersonTransition last = LastTransition(*people.crowd, now.state.people->crowd, static_cast<PersonIndex>(i));
      info.state = last.to;
      info.cause = last.cause;
      info.entity_id = people.refs[i].entity;
      info.track_id = static_cast<uint32_t>(i + 1);
      info.group_id = state.group;
      info.speaking = state.speaking;
      info.visible = state.visible;
      info.pose = airsim::ToPose({RotationZ(state.yaw), state.p_WP + state.v_WP * later}, api.session().origin_W());
      info.velocity = airsim::ToVector(NedFromWorld(state.v_WP));
      list.push_back(std::move(info));
    }
    return list;
  });
}

void AddCommands(Api& api) {
  api.Change("simSpawnPerson", [](Session& s, Text name, const airsim::Pose& pose) {
    CommandPerson(s, name, SpawnPerson{airsim::FromPose(pose, s.origin_W()).p, YawOf(pose, s.origin_W())});
  });
  api.Change("simMovePerson", [](Session& s, Text name, const airsim::Pose& pose) {
    CommandPerson(s, name, MovePerson{airsim::FromPose(pose, s.origin_W()).p, YawOf(pose, s.origin_W())});
  });
  api.Change("simRemovePerson", [](Session& s, Text name) { CommandPerson(s, name, RemovePerson{}); });
  api.Change(
      "simSendPerson",
      [](Session& s, Text name, const airsim::Vector3r& goal, double speed) {
        airsim::Pose pose;
        pose.position = goal;
        CommandPerson(s, name, SendPerson{airsim::FromPose(pose, s.origin_W()).p, speed});
      },
      1);
  api.Change(
      "simSetPersonState",
      [](Session& s, Text name, Text state, double seconds) {
        CommandPerson(s, name, SetPersonState{state, seconds});
      },
      1);
  api.Change("simMessagePerson", [](Session& s, Text name, Text type) { CommandPerson(s, name, MessagePerson{type}); });
  api.Change("simReleasePerson", [](Session& s, Text name) { CommandPerson(s, name, ReleasePerson{}); });
}

}  // namespace

void AddPeopleCalls(Api& api) {
  AddReading(api);
  AddCommands(api);
}

}  // namespace airsim360

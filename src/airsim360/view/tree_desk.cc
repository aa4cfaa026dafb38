#include "airsim360/view/tree_desk.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "airsim360/base/error.h"
#include "airsim360/base/nearest_name.h"
#include "airsim360/behaviour/xml.h"
#include "airsim360/math/coordinate_limit.h"
#include "airsim360/mission/mission_nodes.h"
#include "airsim360/people/behaviour/person_nodes.h"
#include "airsim360/people/behaviour/tree_files.h"
#include "airsim360/people/crowd/tree_editing.h"
#include "airsim360/sim/people/people.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kReads[] = {"palette", "trees", "source", "mind", "check", "mission"};
constexpr const char* kChanges[] = {"apply", "fly", "stop", "person"};
constexpr char kPage[] = "the tree";  // name of the file in messages

bool IsIn(std::span<const char* const> names, const std::string& what) { return std::ranges::find(names, what) != names.end(); }

std::string TextOf(const Json& message, const char* key) {
  if (!message.contains(key) || !message[key].is_string()) throw InputError(std::string(key) + ": a text is missing");
  return message[key].get<std::string>();
}

const SimPeople& PeopleOf(const SimModel& model) {
  if (!model.people) throw InputError("there is nobody in this world; start 'airsim360 view' with --people N");
  return *model.people;
}

PersonAction ActionOf(const std::string& action, Vec3d p, bool is_there) {
  if (action == "send") return SendPerson{p};
  if (action == "bring" && is_there) return MovePerson{p};
  if (action == "bring") return SpawnPerson{p};
  if (action == "remove") return RemovePerson{};
  if (action == "release") return ReleasePerson{};
  throw InputError("action: " + UnknownChoiceMessage("action", action, std::vector<std::string>{"send", "bring", "remove", "release"}));
}

Json BoardJson(const std::vector<behaviour::BoardEntry>& board) {
  Json said = Json::array();
  for (const auto& [key, value] : board) said.push_back({{"key", key}, {"value", value}});
  return said;
}

std::string Written(const std::string& xml) { return behaviour::WriteXml(behaviour::ReadXml(xml, kPage)); }

}  // namespace

std::string PaletteJson(const behaviour::Palette& palette) {
  Json nodes = Json::array();
  for (const behaviour::NodeInfo& info : palette.nodes()) {
    Json ports = Json::array();
    for (const behaviour::PortInfo& port : info.ports) {
      Json& said = ports.emplace_back(Json{{"name", port.name}, {"output", port.output}, {"default", nullptr}, {"help", port.help}});
      if (port.fallback) said["default"] = port.fallback;
    }
    nodes.push_back(
        {{"name", info.name}, {"class", behaviour::kNodeClassNames[static_cast<size_t>(info.of)]}, {"ports", ports}, {"help", info.help}});
  }
  return nodes.dump();
}

bool TreeDesk::Handles(const std::string& what) { return IsIn(kReads, what) || IsIn(kChanges, what); }
bool TreeDesk::Changes(const std::string& what) { return IsIn(kChanges, what); }

struct TreeDesk::Impl {
  Json Do(const std::string& what, const Json& message);
  Json Check(const Json& message) const;
  Json Trees() const;
  Json Mind(const Json& message) const;
  Json InboxJson(const PersonMind& mind) const;
  PersonIndex Find(const std::string& name) const;
  Json Person(const Json& message);
  Json Apply(const std::string& xml);
  Json Fly(const std::string& xml);
  Json Progress() const;
  void Stop();

  SimLoop& loop;
  std::shared_ptr<MissionPilot> pilot = nullptr;
  size_t told = 0;  // of its captures
};

Json TreeDesk::Impl::Do(const std::string& what, const Json& message) {
  if (what == "palette")
    return {{"people", Json::parse(PaletteJson(internal::PersonPalette()))}, {"mission", Json::parse(PaletteJson(MissionPalette()))}};
  if (what == "trees") return Trees();
  if (what == "source") return {{"xml", Written(TreeSource(*PeopleOf(loop.model()).crowd, TextOf(message, "tree")))}};
  if (what == "mind") return Mind(message);
  if (what == "apply") return Apply(TextOf(message, "xml"));
  if (what == "fly") return Fly(TextOf(message, "xml"));
  if (what == "mission") return Progress();
  if (what == "person") return Person(message);
  if (what == "stop") {
    Stop();
    return {{"done", "stop"}};
  }
  return Check(message);
}

Json TreeDesk::Impl::Check(const Json& message) const {
  const std::string xml = TextOf(message, "xml");
  if (TextOf(message, "kind") == "mission")
    ReadMission(xml, kPage, {loop.shared_model(), {}});
  else if (loop.model().people)
    WithTrees(*PeopleOf(loop.model()).crowd, xml, kPage);
  else
    CheckPeopleTrees(xml, kPage);
  return {{"xml", Written(xml)}};
}

Json TreeDesk::Impl::Trees() const {
  if (!loop.model().people) return {{"trees", Json::array()}, {"people", Json::array()}};
  const SimPeople& people = *loop.model().people;
  Json said{{"trees", TreeNames(*people.crowd)}, {"people", Json::array()}};
  for (size_t i = 0; i < people.cast.size(); ++i)
    said["people"].push_back(
        {{"name", people.cast[i].name}, {"tree", MindOf(*people.crowd, loop.state().people->crowd, static_cast<PersonIndex>(i)).tree}});
  return said;
}

Json TreeDesk::Impl::Mind(const Json& message) const {
  const SimPeople& people = PeopleOf(loop.model());
  const std::string name = TextOf(message, "person");
  const PersonIndex i = Find(name);
  const CrowdState& crowd = loop.state().people->crowd;
  const PersonMind mind = MindOf(*people.crowd, crowd, i);
  const PersonTransition last = LastTransition(*people.crowd, crowd, i);
  const Vec3d p = crowd.people[i].p_WP;
  return {{"person", name},
          {"p", {p.x, p.y, p.z}},
          {"visible", crowd.people[i].visible},
          {"tree", mind.tree},
          {"active", mind.active},
          {"labels", mind.labels},
          {"state", last.to},
          {"cause", last.cause},
          {"inbox", InboxJson(mind)},
          {"board", BoardJson(mind.board)}};
}

// When each was sent, and by whom, unless it was a command.
Json TreeDesk::Impl::InboxJson(const PersonMind& mind) const {
  const SimPeople& people = PeopleOf(loop.model());
  Json said = Json::array();
  for (const PersonMind::Letter& letter : mind.inbox)
    said.push_back({{"type", letter.type},
                    {"from", letter.from < people.cast.size() ? Json(people.cast[letter.from].name) : Json()},
                    {"sent", 1e-9 * static_cast<double>(letter.t_ns)}});
  return said;
}

PersonIndex TreeDesk::Impl::Find(const std::string& name) const {
  const SimPeople& people = PeopleOf(loop.model());
  const auto found = std::ranges::find(people.cast, name, &PersonInScene::name);
  if (found != people.cast.end()) return static_cast<PersonIndex>(found - people.cast.begin());
  std::vector<std::string> names;
  for (const PersonInScene& person : people.cast) names.push_back(person.name);
  throw InputError("person: nobody is called '" + name.substr(0, 100) + "'" + DidYouMean(name, names));
}

Json TreeDesk::Impl::Person(const Json& message) {
  const PersonIndex person = Find(TextOf(message, "person"));
  const std::string action = TextOf(message, "action");
  Vec3d p;
  if (action == "send" || action == "bring") {
    const Json point = message.value("point", Json());
    const bool fits = point.is_array() && point.size() == 3 && std::ranges::all_of(point, [](const Json& v) { return v.is_number(); });
    if (!fits) throw InputError("point: three numbers, metres of W");
    p = CheckedPlace("point", {point[0].get<double>(), point[1].get<double>(), point[2].get<double>()});
  }
  const bool is_there = loop.state().people->crowd.people[person].visible;
  loop.Post({0, PersonCommand{person, ActionOf(action, p, is_there)}});
  return {{"done", action}};
}

// The trees are read as they are written, so that places in one are places in the other.
Json TreeDesk::Impl::Apply(const std::string& xml) {
  const SimPeople& people = PeopleOf(loop.model());
  WithTrees(*people.crowd, xml, kPage);  // messages name the lines of what was sent
  const std::string written = Written(xml);
  auto changed = std::make_shared<SimPeople>(people);
  changed->crowd = WithTrees(*people.crowd, written, kPage);
  auto now = std::make_shared<PeopleState>(*loop.state().people);
  AdoptTrees(*people.crowd, *changed->crowd, now->crowd);
  auto model = std::make_shared<SimModel>(loop.model());
  model->people = std::move(changed);
  loop.SetModel(std::move(model));
  loop.Edit().people = std::move(now);
  return {{"xml", written}};
}

Json TreeDesk::Impl::Fly(const std::string& xml) {
  ReadMission(xml, kPage, {loop.shared_model(), {}});
  const std::string written = Written(xml);
  const auto mission = ReadMission(written, kPage, {loop.shared_model(), {}});
  Stop();
  told = 0;
  pilot = std::make_shared<MissionPilot>(mission);
  loop.Attach(pilot);
  return {{"xml", written}};
}

Json TreeDesk::Impl::Progress() const {
  if (!pilot) return {{"result", "none"}, {"seconds", 0}, {"active", Json::array()}, {"log", Json::array()}, {"board", Json::array()}};
  const MissionProgress progress = pilot->progress();
  Json active = Json::array();
  for (const auto& node : progress.active) active.push_back(node.order);
  return {{"result", kMissionResultNames[static_cast<size_t>(progress.result)]},
          {"seconds", progress.seconds},
          {"active", active},
          {"log", progress.log},
          {"board", BoardJson(progress.board)}};
}

void TreeDesk::Impl::Stop() {
  if (!pilot) return;
  loop.Detach(pilot.get());
  if (!pilot->done()) loop.Post({0, FlightCommand{HoverCommand{}}});
  pilot.reset();
}

TreeDesk::TreeDesk(SimLoop& loop) : impl_(new Impl{loop}) {}
TreeDesk::~TreeDesk() = default;

std::string TreeDesk::Do(const std::string& what, const std::string& message) {
  return impl_->Do(what, Json::parse(message)).dump(-1, ' ', false, Json::error_handler_t::replace);
}

bool TreeDesk::Flies() const { return impl_->pilot && !impl_->pilot->done(); }

std::vector<MissionCapture> TreeDesk::NewCaptures() {
  if (!impl_->pilot) return {};
  std::vector<MissionCapture> captures = impl_->pilot->CapturesFrom(impl_->told);
  impl_->told += captures.size();
  return captures;
}

}  // namespace airsim360

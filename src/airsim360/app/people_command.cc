// airsim360 people: the nodes and trees by which people behave, for those who write trees.
#include <cstdio>
#include <memory>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/behaviour/xml.h"
#include "airsim360/mission/mission.h"
#include "airsim360/mission/mission_nodes.h"
#include "airsim360/people/behaviour/person_nodes.h"
#include "airsim360/people/behaviour/tree_files.h"
#include "airsim360/view/tree_desk.h"

namespace airsim360 {
namespace {

constexpr uint64_t kMostXml = uint64_t{1} << 21;

struct NodesArguments {
  bool xml = false, mission = false;
};

// "GoTo point [speed=0]".
std::string FormOf(const behaviour::NodeInfo& info) {
  std::string text = info.name;
  for (const behaviour::PortInfo& port : info.ports) {
    text += std::string(" ") + (port.fallback ? "[" : "") + port.name;
    if (port.fallback && *port.fallback) text += std::string("=") + port.fallback;
    if (port.fallback) text += "]";
  }
  return text;
}

void RunNodes(const NodesArguments& arguments, bool json) {
  const behaviour::Palette& palette = arguments.mission ? MissionPalette() : internal::PersonPalette();
  if (arguments.xml) {
    std::fputs(("<root BTCPP_format=\"4\">\n" + palette.ModelXml() + "</root>\n").c_str(), stdout);
    return;
  }
  if (json) return PrintJson({{"nodes", nlohmann::ordered_json::parse(PaletteJson(palette))}});
  for (const behaviour::NodeInfo& info : palette.nodes())
    std::printf("%-10s %-60s %s\n", behaviour::kNodeClassNames[static_cast<size_t>(info.of)], FormOf(info).c_str(), info.help);
}

struct TreesArguments {
  std::string file, out;
  bool mission = false;
};

// The file in the form in which editors and hands agree: a line a node, attributes as they were.
void RunTrees(const TreesArguments& arguments, bool json) {
  if (arguments.mission && arguments.file.empty())
    throw InputError("--mission: give the file of one; docs/guide/missions.md begins with one");
  const std::string text = arguments.file.empty() ? DefaultPeopleTrees() : ReadTextFile(arguments.file, kMostXml);
  std::vector<std::string> names;
  if (arguments.mission)
    CheckMission(text, arguments.file);
  else
    names = CheckPeopleTrees(text, arguments.file.empty() ? "the default trees" : arguments.file);
  const std::string written = behaviour::WriteXml(behaviour::ReadXml(text, arguments.file));
  if (!arguments.out.empty()) WriteFileAtomically(arguments.out, written);
  if (json) return PrintJson({{"trees", names}, {"xml", written}});
  if (arguments.out.empty()) std::fputs(written.c_str(), stdout);
}

}  // namespace

void AddPeopleCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* people =
      app.add_subcommand("people", "nodes and trees by which people behave and missions are flown (docs/guide/people_behaviour.md)");
  people->require_subcommand(1);
  CLI::App* nodes = people->add_subcommand("nodes", "the nodes that trees may have, with their ports");
  auto n = std::make_shared<NodesArguments>();
  nodes->add_flag("--xml", n->xml, "as a <TreeNodesModel>, which Groot2 loads");
  nodes->add_flag("--mission", n->mission, "of missions of drones instead of people");
  nodes->callback([n, &globals] { RunNodes(*n, globals.json); });
  CLI::App* trees = people->add_subcommand("trees", "the trees that people come with; or a file checked and written a line a node");
  auto t = std::make_shared<TreesArguments>();
  trees->add_option("FILE", t->file, "XML of trees; without it those of the default crowd");
  trees->add_option("--out", t->out, "write it there");
  trees->add_flag("--mission", t->mission, "FILE is a mission");
  trees->callback([t, &globals] { RunTrees(*t, globals.json); });
}

}  // namespace airsim360

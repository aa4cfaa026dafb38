// Trees edited in the page of a live world: of its people, and missions of its drone.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "airsim360/behaviour/nodes.h"
#include "airsim360/mission/mission.h"
#include "airsim360/sim/sim_loop.h"

namespace airsim360 {

/// The nodes of a palette with their ports, as a JSON array: name, class, help, ports (name, output, default, help).
std::string PaletteJson(const behaviour::Palette& palette);

/// Answers the messages about trees; the caller holds what keeps the loop to itself.
class TreeDesk {
 public:
  explicit TreeDesk(SimLoop& loop);
  ~TreeDesk();

  /// Whether a message is for the desk, and whether it changes anything.
  static bool Handles(const std::string& what);
  static bool Changes(const std::string& what);
  /// The answer to a message, both JSON objects. palette: {people, mission}. trees: {trees, people: [{name, tree}]}. source
  /// `tree`: {xml}. mind `person`: {p, visible, tree, active, labels, state, cause, inbox: [{type,
  /// from, sent}], board: [{key, value}]}. check `kind`, `xml`: {xml} as
  /// WriteXml has it. apply `xml`: people follow it from now on, {xml}. fly `xml`: the drone flies it, {xml}. mission: {result,
  /// seconds, active, log, board}. stop: the mission ends. person `person`, `action` (send, bring, remove, release), `point`: someone
  /// walks there, is there at once, … InputError for what is wrong.
  std::string Do(const std::string& what, const std::string& message);
  /// Whether a mission has the drone: hands do not steer then.
  bool Flies() const;
  /// What the mission has captured since the last call.
  std::vector<MissionCapture> NewCaptures();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360

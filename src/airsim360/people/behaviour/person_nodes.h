// The leaves by which people act. docs/guide/people_behaviour.md has the table.
#pragma once

#include <cstdint>

#include "airsim360/behaviour/nodes.h"

namespace airsim360::internal {

/// Behind behaviour::Node.
enum class PersonNode : uint8_t {
  // Actions
  kWanderTo = static_cast<uint8_t>(behaviour::Node::kFirstLeaf),
  kGoTo,
  kGoToPlace,
  kSetState,
  kEndState,
  kMeet,
  kAnswerGreeting,
  kChat,
  kSend,
  kWaitMessage,
  kFacePerson,
  kLookAtDrone,
  kStepAway,
  kQueue,
  kAccompany,
  kGather,
  // Conditions
  kChance,
  kStateIs,
  kDroneWithin,
  kPersonWithin,
  kMessageWaiting,
  kEvery,
};

/// Nodes of people's trees. Kinds of their ports: p point or person, s a state, m a message, k kind of place, a area.
const behaviour::Palette& PersonPalette();

}  // namespace airsim360::internal

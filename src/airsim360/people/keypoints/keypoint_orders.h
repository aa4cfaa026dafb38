// The orders in which data sets list the keypoints of a person, over the sockets that every body has.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "airsim360/people/body/body.h"

namespace airsim360 {

/// An order of keypoints.
struct KeypointOrder {
  std::string_view name;
  std::span<const int8_t> sockets;          ///< indices into kSocketNames; -1 = we have none: labelled absent
  std::span<const std::string_view> names;  ///< of the data set itself; empty: those of the sockets
};

/// coco17, coco133, openpose25, h36m17, smpl24, jta22. Of coco133 we have 32 of 133: body, feet, of each hand
/// the root, the middle knuckle and the tips of thumb and middle finger, and the tip of the nose.
std::span<const KeypointOrder> KeypointOrders();
/// By name; InputError naming the nearest.
const KeypointOrder& OrderByName(std::string_view name);

/// Edges of a stick figure over sockets, for pictures.
std::span<const std::pair<int8_t, int8_t>> SocketEdges();

/// Sockets of users, from YAML or JSON: sockets: [{name, joint, offset: {x, y, z}, radius}]. InputError
/// naming the file and the place for an unknown joint (with the nearest), a name that is taken, numbers that
/// make no sense, or more than 256 of them. The offset is in the frame of the joint: +X forward, +Y left, +Z
/// up in the rest pose.
std::vector<Socket> ReadSockets(const std::string& file);
std::vector<Socket> ParseSockets(std::string_view text, std::string_view name);

}  // namespace airsim360

// Sockets that users add.
#include <algorithm>

#include "airsim360/base/config.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/people/keypoints/keypoint_orders.h"

namespace airsim360 {
namespace {

constexpr size_t kMostSockets = 256;
constexpr double kFarthest = 3;  // metres from the joint: something held, not something elsewhere
constexpr uint64_t kLargestFile = uint64_t{1} << 20;

struct SocketEntry {
  std::string name, joint;
  Vec3d offset;
  double radius = 0.05;
};

Socket MakeSocket(const SocketEntry& entry, std::string_view file, std::span<const Socket> before) {
  const std::string where = std::string(file) + ": socket '" + entry.name.substr(0, 100) + "': ";
  if (entry.name.empty() || entry.name.size() > 64) throw InputError(where + "a name has 1 to 64 letters");
  const auto same = [&](const Socket& socket) { return socket.name == entry.name; };
  if (std::ranges::count(kSocketNames, entry.name) > 0 || std::ranges::any_of(before, same)) throw InputError(where + "the name is taken");
  const Joint joint = JointByName(entry.joint);
  if (joint == Joint::kCount) {
    std::vector<std::string> names;
    for (int i = 0; i < kJointCount; ++i) names.emplace_back(JointName(static_cast<Joint>(i)));
    throw InputError(where + UnknownChoiceMessage("joint", entry.joint.substr(0, 100), names));
  }
  return {entry.name, joint, entry.offset, entry.radius};
}

}  // namespace

std::vector<Socket> ParseSockets(std::string_view text, std::string_view name) {
  std::vector<SocketEntry> entries;
  ReadYaml(text, name, [&](ConfigVisitor& v) {
    v.List("sockets", "points fixed to joints", entries, [](ConfigVisitor& entry, SocketEntry& e) {
      entry.Field("name", "of the keypoint", e.name);
      entry.Field("joint", "that it is fixed to, as left_wrist", e.joint);
      entry.Group("offset", "from the joint, in its frame: x forward, y left, z up in the rest pose", [&](ConfigVisitor& offset) {
        offset.Field("x", "metres", e.offset.x, -kFarthest, kFarthest);
        offset.Field("y", "metres", e.offset.y, -kFarthest, kFarthest);
        offset.Field("z", "metres", e.offset.z, -kFarthest, kFarthest);
      });
      entry.Field("radius", "how deep below the skin it may lie, metres", e.radius, 0, 1);
    });
  });
  if (entries.size() > kMostSockets) {
    throw InputError(std::string(name) + ": " + std::to_string(entries.size()) + " sockets, at most " + std::to_string(kMostSockets));
  }
  std::vector<Socket> sockets;
  for (const SocketEntry& entry : entries) sockets.push_back(MakeSocket(entry, name, sockets));
  return sockets;
}

std::vector<Socket> ReadSockets(const std::string& file) { return ParseSockets(ReadTextFile(file, kLargestFile), file); }

}  // namespace airsim360

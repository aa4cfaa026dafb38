#include "airsim360/people/keypoints/keypoint_orders.h"

#include <array>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

// Index of a socket; a name that no body has does not compile: everything below is constexpr.
constexpr int8_t S(std::string_view name) {
  for (int i = 0; i < kSocketCount; ++i) {
    if (kSocketNames[i] == name) return static_cast<int8_t>(i);
  }
  throw "no such socket";
}

constexpr std::array<int8_t, kCocoSocketCount> MakeCoco17() {
  std::array<int8_t, kCocoSocketCount> order{};
  for (int8_t i = 0; i < kCocoSocketCount; ++i) order[static_cast<size_t>(i)] = i;
  return order;
}
constexpr auto kCoco17 = MakeCoco17();
static_assert(kCoco17[5] == S("left_shoulder") && kCoco17[16] == S("right_ankle"));

// COCO-WholeBody: 0-16 body, 17-22 feet, 23-90 face (iBUG's 68 points), 91-111 and 112-132 hands: the root,
// then four points a finger from the thumb on, each from its base to its tip.
constexpr std::array<int8_t, 133> MakeCoco133() {
  std::array<int8_t, 133> order{};
  order.fill(-1);
  for (size_t i = 0; i < kCoco17.size(); ++i) order[i] = kCoco17[i];
  const int8_t feet[] = {S("left_big_toe"), S("left_small_toe"), S("left_heel"), S("right_big_toe"), S("right_small_toe"), S("right_heel")};
  for (size_t i = 0; i < 6; ++i) order[17 + i] = feet[i];
  order[23 + 30] = S("nose");
  const int8_t hands[2][4] = {{S("left_wrist"), S("left_thumb_tip"), S("left_hand"), S("left_finger_tip")},
                              {S("right_wrist"), S("right_thumb_tip"), S("right_hand"), S("right_finger_tip")}};
  const size_t places[4] = {0, 4, 9, 12};  // root, tip of the thumb, base and tip of the middle finger
  for (size_t side = 0; side < 2; ++side) {
    for (size_t i = 0; i < 4; ++i) order[91 + 21 * side + places[i]] = hands[side][i];
  }
  return order;
}
constexpr auto kCoco133 = MakeCoco133();

// One entry: the data set's own name and our socket.
struct OrderEntry {
  std::string_view name;
  int8_t socket;
};
template <size_t N>
struct Columns {
  std::array<int8_t, N> sockets{};
  std::array<std::string_view, N> names{};
};
template <size_t N>
constexpr Columns<N> Split(const OrderEntry (&entries)[N]) {
  Columns<N> columns;
  for (size_t i = 0; i < N; ++i) {
    columns.sockets[i] = entries[i].socket;
    columns.names[i] = entries[i].name;
  }
  return columns;
}

constexpr OrderEntry kOpenPoseEntries[] = {{"Nose", S("nose")},
                                           {"Neck", S("neck")},
                                           {"RShoulder", S("right_shoulder")},
                                           {"RElbow", S("right_elbow")},
                                           {"RWrist", S("right_wrist")},
                                           {"LShoulder", S("left_shoulder")},
                                           {"LElbow", S("left_elbow")},
                                           {"LWrist", S("left_wrist")},
                                           {"MidHip", S("mid_hip")},
                                           {"RHip", S("right_hip")},
                                           {"RKnee", S("right_knee")},
                                           {"RAnkle", S("right_ankle")},
                                           {"LHip", S("left_hip")},
                                           {"LKnee", S("left_knee")},
                                           {"LAnkle", S("left_ankle")},
                                           {"REye", S("right_eye")},
                                           {"LEye", S("left_eye")},
                                           {"REar", S("right_ear")},
                                           {"LEar", S("left_ear")},
                                           {"LBigToe", S("left_big_toe")},
                                           {"LSmallToe", S("left_small_toe")},
                                           {"LHeel", S("left_heel")},
                                           {"RBigToe", S("right_big_toe")},
                                           {"RSmallToe", S("right_small_toe")},
                                           {"RHeel", S("right_heel")}};
constexpr auto kOpenPose25 = Split(kOpenPoseEntries);

constexpr OrderEntry kH36mEntries[] = {{"root", S("pelvis")},
                                       {"right_hip", S("right_hip")},
                                       {"right_knee", S("right_knee")},
                                       {"right_foot", S("right_ankle")},
                                       {"left_hip", S("left_hip")},
                                       {"left_knee", S("left_knee")},
                                       {"left_foot", S("left_ankle")},
                                       {"spine", S("spine2")},
                                       {"thorax", S("spine3")},
                                       {"neck_base", S("neck")},
                                       {"head", S("head_top")},
                                       {"left_shoulder", S("left_shoulder")},
                                       {"left_elbow", S("left_elbow")},
                                       {"left_wrist", S("left_wrist")},
                                       {"right_shoulder", S("right_shoulder")},
                                       {"right_elbow", S("right_elbow")},
                                       {"right_wrist", S("right_wrist")}};
constexpr auto kH36m17 = Split(kH36mEntries);

constexpr OrderEntry kSmplEntries[] = {{"pelvis", S("pelvis")},
                                       {"left_hip", S("left_hip")},
                                       {"right_hip", S("right_hip")},
                                       {"spine1", S("spine1")},
                                       {"left_knee", S("left_knee")},
                                       {"right_knee", S("right_knee")},
                                       {"spine2", S("spine2")},
                                       {"left_ankle", S("left_ankle")},
                                       {"right_ankle", S("right_ankle")},
                                       {"spine3", S("spine3")},
                                       {"left_foot", S("left_foot")},
                                       {"right_foot", S("right_foot")},
                                       {"neck", S("neck")},
                                       {"left_collar", S("left_clavicle")},
                                       {"right_collar", S("right_clavicle")},
                                       {"head", S("head_center")},
                                       {"left_shoulder", S("left_shoulder")},
                                       {"right_shoulder", S("right_shoulder")},
                                       {"left_elbow", S("left_elbow")},
                                       {"right_elbow", S("right_elbow")},
                                       {"left_wrist", S("left_wrist")},
                                       {"right_wrist", S("right_wrist")},
                                       {"left_hand", S("left_hand")},
                                       {"right_hand", S("right_hand")}};
constexpr auto kSmpl24 = Split(kSmplEntries);

constexpr OrderEntry kJtaEntries[] = {{"head_top", S("head_top")},
                                      {"head_center", S("head_center")},
                                      {"neck", S("neck")},
                                      {"right_clavicle", S("right_clavicle")},
                                      {"right_shoulder", S("right_shoulder")},
                                      {"right_elbow", S("right_elbow")},
                                      {"right_wrist", S("right_wrist")},
                                      {"left_clavicle", S("left_clavicle")},
                                      {"left_shoulder", S("left_shoulder")},
                                      {"left_elbow", S("left_elbow")},
                                      {"left_wrist", S("left_wrist")},
                                      {"spine0", -1},
                                      {"spine1", S("spine3")},
                                      {"spine2", S("spine2")},
                                      {"spine3", S("spine1")},
                                      {"spine4", S("pelvis")},
                                      {"right_hip", S("right_hip")},
                                      {"right_knee", S("right_knee")},
                                      {"right_ankle", S("right_ankle")},
                                      {"left_hip", S("left_hip")},
                                      {"left_knee", S("left_knee")},
                                      {"left_ankle", S("left_ankle")}};
constexpr auto kJta22 = Split(kJtaEntries);

static_assert(std::size(kOpenPoseEntries) == 25 && std::size(kH36mEntries) == 17 && std::size(kSmplEntries) == 24 &&
              std::size(kJtaEntries) == 22);

const KeypointOrder kOrders[] = {{"coco17", kCoco17, {}},
                                 {"coco133", kCoco133, {}},
                                 {"openpose25", kOpenPose25.sockets, kOpenPose25.names},
                                 {"h36m17", kH36m17.sockets, kH36m17.names},
                                 {"smpl24", kSmpl24.sockets, kSmpl24.names},
                                 {"jta22", kJta22.sockets, kJta22.names}};

constexpr std::pair<int8_t, int8_t> kEdges[] = {{S("nose"), S("left_eye")},
                                                {S("nose"), S("right_eye")},
                                                {S("left_eye"), S("left_ear")},
                                                {S("right_eye"), S("right_ear")},
                                                {S("neck"), S("head_top")},
                                                {S("left_shoulder"), S("right_shoulder")},
                                                {S("left_shoulder"), S("left_elbow")},
                                                {S("left_elbow"), S("left_wrist")},
                                                {S("right_shoulder"), S("right_elbow")},
                                                {S("right_elbow"), S("right_wrist")},
                                                {S("left_shoulder"), S("left_hip")},
                                                {S("right_shoulder"), S("right_hip")},
                                                {S("left_hip"), S("right_hip")},
                                                {S("left_hip"), S("left_knee")},
                                                {S("left_knee"), S("left_ankle")},
                                                {S("right_hip"), S("right_knee")},
                                                {S("right_knee"), S("right_ankle")},
                                                {S("left_heel"), S("left_big_toe")},
                                                {S("right_heel"), S("right_big_toe")}};

}  // namespace

std::span<const KeypointOrder> KeypointOrders() { return kOrders; }

const KeypointOrder& OrderByName(std::string_view name) {
  std::vector<std::string> names;
  for (const KeypointOrder& order : kOrders) {
    if (order.name == name) return order;
    names.emplace_back(order.name);
  }
  throw InputError(UnknownChoiceMessage("keypoint order", name, names));
}

std::span<const std::pair<int8_t, int8_t>> SocketEdges() { return kEdges; }

}  // namespace airsim360

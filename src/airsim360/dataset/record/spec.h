// What a dataset consists of: the parameters that determine every byte of it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "airsim360/scene/scene.h"
#include "airsim360/sensors/rig.h"

namespace airsim360 {

/// kLens: a calibrated lens that is neither a pinhole nor a fisheye; only rigs have them.
enum class Projection { kErp, kCube, kPinhole, kFisheye, kLens };
inline constexpr const char* kProjectionNames[] = {"erp", "cube", "pinhole", "fisheye", "lens"};

enum class RgbFormat { kPng, kJpeg };
inline constexpr const char* kRgbFormatNames[] = {"png", "jpg"};

/// One camera of a rig: what it sees and where it sits on the body.
struct RigCamera {
  std::string name = {};  ///< in file names and frames.jsonl: 1 to 32 of [a-z0-9_]
  Projection projection = Projection::kPinhole;
  int width = 1024, height = 768;                   ///< of one picture; a cube face for Projection::kCube
  double fov_deg = 90;                              ///< as DatasetSpec::fov_deg
  Vec3d p_B;                                        ///< metres in B
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;  ///< of the forward axis, as BodyPose
  std::optional<Camera> lens = {};                  ///< calibrated, of these sides; `projection` is its kind, fov_deg not used
  RigidTransform X_IC = CameraInBody();             ///< pose of the camera in what p_B and the angles place: of a calibration its frame
  std::optional<GimbalMount> gimbal = {};           ///< p_B and the angles are on it
};

/// Parameters of a dataset. Two runs with equal parameters (and the same program and models) write the same
/// bytes.
struct DatasetSpec : PictureSettings {
  std::string command = "collect";  ///< "collect" or "render"
  std::string world = {};           ///< as given: a name or a path
  Projection projection = Projection::kErp;
  int width = 2048, height = 1024;      ///< of one picture; a cube face for Projection::kCube
  double fov_deg = 90;                  ///< pinhole: across the width; fisheye: across the shorter side
  std::vector<RigCamera> cameras = {};  ///< a rig, in the order of its files; empty: one camera as above, at B
  Products products = {};               ///< colour is left out of tier labels
  RgbFormat rgb_format = RgbFormat::kPng;
  int64_t frames = 1;                               ///< of the whole dataset, all shards together
  int64_t shard = 0, shards = 1;                    ///< this one holds the frames with index % shards == shard
  std::string route = {};                           ///< "auto", or "sha256:…" of the route file, or the pose of `render`
  std::string labels = {};                          ///< "sha256:…" of the label file given beside the world, or ""
  std::string environment = {};                     ///< DescribeEnvironment of what was rendered
  std::string people = {};                          ///< who they are, in words with the SHA-256 of their files; empty = nobody
  std::string traffic = {};                         ///< vehicles that drive, in words; empty = none
  bool crops = false;                               ///< crops/*.png: a pinhole picture of everyone who can be seen
  bool overlay = false;                             ///< overlay/*.png: the colour picture with the labels of people drawn in
  bool video = false;                               ///< video.mp4: the colour pictures at their times
  std::vector<std::string> people_formats = {};     ///< of kPeopleFormats, in that order
  std::string plan = {};                            ///< hash of the plan that the frames are of; empty = none
  std::string row = {};                             ///< of the plan, of the frames at hand
  std::map<std::string, std::string> picture = {};  ///< of a plan: the values of its flags that were given

  /// How its pictures are made and stored.
  void Visit(ConfigVisitor& v);
};

/// Further files made of people.jsonl.
inline constexpr const char* kPeopleFormats[] = {"coco_keypoints", "kitti", "nuscenes", "monoloco"};

/// One picture of a capture. A panorama, pinhole or fisheye capture is one view with an empty suffix, a cube
/// six with "_+x", "_-x", … appended to the stem; a rig has those of each camera, with "_NAME" before.
struct View {
  std::string suffix;
  Camera camera;
  Projection projection = Projection::kErp;
  RigidTransform X_BC = CameraInBody();
  std::string name = {};                   ///< of the rig's camera; "" without a rig
  std::optional<GimbalMount> gimbal = {};  ///< X_BC is on it
};

/// The views of a capture, in the order in which they are written.
std::vector<View> Views(const DatasetSpec& spec);

/// Pose of a view's camera for a pose of the body; with pano_frame level only the place is right.
RigidTransform CameraPose(const View& view, const RigidTransform& X_WB);

/// Whether some pixels of a kind of picture may have no ray.
bool MayLackRays(Projection projection);

/// Whether every picture is an equirectangular panorama.
bool IsPanoramic(const DatasetSpec& spec);

/// What a renderer fills for a capture: no light in tier labels, and what other products follow from.
Products ProductsOf(const DatasetSpec& spec);

/// "000000": the name of a frame's files.
std::string Stem(int64_t index);

/// Folder and file name extension of a product: ("rgb", ".png").
struct ProductFolder {
  std::string name, extension;
};
std::vector<ProductFolder> ProductFolders(const DatasetSpec& spec);

/// True if semantic pictures of this scene need 16 bits: some entity's category is above 255.
bool NeedsWideSemantics(const Scene& scene);

/// meta.json: generator, parameters, conventions in words, encodings, category tree. Ends with a line feed.
std::string MetaJson(const DatasetSpec& spec, const Scene& scene);

/// "" if two meta.json texts are of the same dataset, else one line that names the first difference and both
/// values.
std::string DescribeMetaDifference(const std::string& on_disk, const std::string& wanted);

}  // namespace airsim360

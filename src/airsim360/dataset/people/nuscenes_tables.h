// The thirteen tables of nuScenes (H. Caesar et al., CVPR 2020), filled frame by frame: people and vehicles alike.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/dataset/people/people_export.h"
#include "airsim360/math/transform.h"

namespace airsim360::internal {

/// Something with a box in space, in one frame.
struct NuScenesBox {
  std::string kind;   ///< tells tracks of different things apart; empty: people
  int64_t track = 0;  ///< the same thing in all frames
  std::string category, attribute;
  std::string visibility;                     ///< "1" … "4"; empty: not known
  nlohmann::ordered_json translation, size;   ///< middle, and width, length, height
  nlohmann::ordered_json rotation;            ///< w, x, y, z
  nlohmann::ordered_json velocity = nullptr;  ///< m/s in W, which nuScenes has not; null: left out
};

/// Of an entry of people.jsonl.
NuScenesBox NuScenesBoxOf(const nlohmann::ordered_json& person);
inline std::vector<std::string> PedestrianCategories() { return {"human.pedestrian.adult", "human.pedestrian.child"}; }
inline std::vector<std::string> PedestrianAttributes() {
  return {"pedestrian.moving", "pedestrian.standing", "pedestrian.sitting_lying_down"};
}
/// KITTI's line of an entry of people.jsonl; empty for who is not before the camera.
std::string KittiLine(const nlohmann::ordered_json& person);

class NuScenesTables {
 public:
  /// Categories and attributes that are listed first, used or not; others follow when they are used.
  NuScenesTables(const DatasetSpec& spec, const std::vector<std::string>& categories, const std::vector<std::string>& attributes);

  /// The next frame. `camera`: X_WC with p and q_wxyz, and K of pinholes; `picture`: relative to the data set.
  void AddFrame(const std::string& stem, int64_t t_ns, const nlohmann::ordered_json& camera, const std::string& picture);
  /// In the frame that was added last.
  void AddBox(const NuScenesBox& box);
  /// One file a table, in this folder. To be called once.
  std::vector<ExportedFile> Finish(const std::string& folder);
  size_t boxes() const { return boxes_; }

 private:
  using Json = nlohmann::ordered_json;
  using Track = std::pair<std::string, int64_t>;

  Json& Table(const std::string& name);
  void Add(const std::string& table, Json row) { Table(table).push_back(std::move(row)); }
  void Name(const char* table, const std::string& name);
  void Link(const std::string& table);
  void FinishInstance(const Track& track, const std::vector<size_t>& rows);

  const DatasetSpec& spec_;
  std::map<std::string, Json> tables_;
  std::set<std::pair<std::string, std::string>> named_;  // table and name
  std::string stem_, sample_;                            // of the last frame
  std::map<Track, std::vector<size_t>> of_instance_;     // rows of sample_annotation
  std::map<Track, std::string> category_;
  size_t boxes_ = 0;
};

}  // namespace airsim360::internal

// Reads a finished dataset in the native layout (docs/reference/dataset_format.md) frame by frame; changes nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/dataset/index.h"
#include "airsim360/dataset/record/segments.h"
#include "airsim360/dataset/record/spec.h"
#include "airsim360/image/image.h"

namespace airsim360 {

/// One line of frames.jsonl.
struct NativeFrame {
  size_t position = 0;  ///< in the dataset, from 0
  int64_t index = 0;    ///< of its plan or flight
  std::string stem;
  int64_t t_ns = 0;
  std::string world;
  nlohmann::ordered_json json;  ///< the line itself

  /// Pose of a view in W.
  RigidTransform X_WC(const View& view) const;
  /// Pose of the body: that of rigs is written down, a camera without a rig is fixed to it. With pano_frame level such a
  /// camera tells only the heading.
  RigidTransform X_WB(const View& view) const;
  Vec3d v_WB() const;
  Vec3d w_WB_B() const;
};

/// A category as meta.json has it; external ids are -1 where there is none.
struct NativeCategory {
  CategoryId id = kVoid;
  std::string path;
  Rgb8 color;
  bool thing = true;
  int ade20k = -1, cityscapes = -1, coco = -1;
};

/// All functions may be called from several threads.
class NativeDataset {
 public:
  /// InputError for a folder that holds no dataset or an unfinished one.
  explicit NativeDataset(std::filesystem::path folder);
  ~NativeDataset();
  NativeDataset(const NativeDataset&) = delete;
  NativeDataset& operator=(const NativeDataset&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  const nlohmann::ordered_json& meta() const { return meta_; }
  const DatasetSpec& spec() const { return spec_; }
  const std::vector<View>& views() const { return views_; }
  const std::map<CategoryId, NativeCategory>& categories() const { return categories_; }
  /// InputError naming meta.json for an id that is not there.
  const NativeCategory& category(CategoryId id) const;
  std::vector<std::string> attributions() const;

  size_t size() const { return lines_.size(); }
  NativeFrame Frame(size_t position) const;
  /// SHA-256 of SHA256SUMS: names all the bytes of the dataset.
  std::string Hash() const;
  /// InputError naming the first file beside the pictures that exports read and that is missing or not the one that
  /// SHA256SUMS names. Pictures are compared when they are read.
  void CheckDescription() const;

  bool Has(const std::string& product) const;
  bool HasPeople() const { return !spec_.people.empty(); }
  /// ".png", ".jpg" or ".exr".
  std::string Extension(const std::string& product) const;
  /// "000012_+x.png": name of a view's file within the folder of its product.
  std::string FileName(const NativeFrame& frame, const View& view, const std::string& product) const;
  /// The file as it is. InputError if it is missing or not the one that frames.jsonl names (cut off, damaged).
  Bytes Read(const NativeFrame& frame, const View& view, const std::string& product) const;

  Image<Rgb8> Rgb(const NativeFrame& frame, const View& view) const;
  Image<float> Range(const NativeFrame& frame, const View& view) const;  ///< metres, 0 = nothing hit
  Image<CategoryId> Semantic(const NativeFrame& frame, const View& view) const;
  Image<EntityId> Entity(const NativeFrame& frame, const View& view) const;
  std::vector<Segment> Segments(const NativeFrame& frame, const View& view) const;
  /// Entries of people.jsonl; none without people.
  std::vector<nlohmann::ordered_json> Persons(const NativeFrame& frame, const View& view) const;

 private:
  void ReadMeta();
  void FindLines();

  std::filesystem::path folder_;
  nlohmann::ordered_json meta_;
  DatasetSpec spec_;
  std::vector<View> views_;
  std::map<CategoryId, NativeCategory> categories_;
  std::vector<uint64_t> lines_;  // where each line of frames.jsonl begins
  uint64_t end_ = 0;             // and where the last one ends
  int fd_ = -1;                  // of frames.jsonl
  mutable std::mutex index_mutex_;
  std::unique_ptr<DatasetIndex> index_;
};

}  // namespace airsim360

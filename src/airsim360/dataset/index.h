// index.sqlite: the journal of a collection while it runs and the queryable index of the finished dataset.
// Tables: frames, files, segments, persons, entities, categories; view frame_categories (docs/reference/dataset_format.md has the
// columns).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/dataset/record/record.h"

namespace airsim360 {

inline constexpr char kIndexName[] = "index.sqlite";

/// How much of a dataset is of one category.
struct CategoryTotal {
  CategoryId category = kVoid;
  int64_t pixels = 0;
  double solid_angle = 0;  ///< sum over all pictures, steradians
  int64_t entities = 0;    ///< different ones
};

struct SeenEntity {
  EntityId entity = kNoEntity;
  int64_t first_frame = 0;
};

/// How well the people of a dataset are seen.
struct PeopleTotals {
  int64_t views = 0;          ///< persons in the lists of all pictures
  int64_t views_seen = 0;     ///< of them with at least one pixel
  int64_t persons_seen = 0;   ///< different persons with at least one pixel in some picture
  int64_t persons_large = 0;  ///< … with at least kLargePerson pixels in one
};
inline constexpr int64_t kLargePerson = 100;

class DatasetIndex {
 public:
  enum class Mode { kRead, kJournal };  ///< kJournal creates the file if it is missing
  /// RuntimeError if the file cannot be opened or is not an index.
  DatasetIndex(const std::filesystem::path& folder, Mode mode);
  ~DatasetIndex();

  /// Marks a frame as done, durably: after this returns the frame survives any crash.
  void AddFrame(const FrameRecord& frame, const std::string& json);
  void RemoveFrame(int64_t index);

  std::vector<int64_t> Frames() const;                                             ///< indices of finished frames, ascending
  std::vector<FileRecord> Files(int64_t frame) const;                              ///< in the order in which they were added
  std::string FrameLine(int64_t frame) const;                                      ///< line of frames.jsonl
  std::vector<Segment> Segments(int64_t frame, const std::string& view) const;     ///< by entity id
  std::vector<std::string> Persons(int64_t frame, const std::string& view) const;  ///< texts, by entity id
  PeopleTotals CountPeople() const;
  std::vector<CategoryTotal> CategoryTotals() const;  ///< by category id
  std::vector<SeenEntity> SeenEntities() const;       ///< by entity id

  /// Names of the entities seen, of an index that was finished.
  struct NamedEntity {
    EntityId id = kNoEntity;
    std::string name;
    CategoryId category = kVoid;
  };
  std::vector<NamedEntity> Entities() const;

  /// Adds the frames of another folder's index that this one lacks, durably.
  void Take(const std::filesystem::path& other);

  /// Replaces the file by one that depends only on its content, not on the order and number of writes, with
  /// the names of `scene`'s categories and entities. The index is closed for writing afterwards.
  static void Finish(const std::filesystem::path& folder, const Scene& scene);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360

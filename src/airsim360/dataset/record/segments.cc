#include "airsim360/dataset/record/segments.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

bool IsSet(const uint64_t* bits, int column) { return bits[column >> 6] >> (column & 63) & 1; }

void SetColumns(uint64_t* bits, int begin, int end) {
  for (int c = begin; c < end;) {
    const int stop = std::min(end, (c | 63) + 1);
    const uint64_t ones = stop - c == 64 ? ~uint64_t{0} : ((uint64_t{1} << (stop - c)) - 1);
    bits[c >> 6] |= ones << (c & 63);
    c = stop;
  }
}

// Collects segments run by run.
class SegmentCollector {
 public:
  SegmentCollector(const Scene& scene, int width) : scene_(scene), width_(width), words_((width + 63) / 64) {
    slots_.resize(scene.entities.size() + 1, -1);
  }

  // The segment of an entity, new if it was not seen yet.
  Segment& Find(EntityId id, int x, int y) {
    if (id == kNoEntity || id >= slots_.size()) {
      throw RuntimeError("renderer: entity id " + std::to_string(id) + " at column " + std::to_string(x) + ", row " + std::to_string(y) +
                         " is not in the scene");
    }
    if (slots_[id] < 0) {
      slots_[id] = static_cast<int>(segments_.size());
      segments_.push_back({id, scene_.entity(id).category, 0, {x, y, 0, 0}, {}, 0});
      columns_.resize(columns_.size() + words_, 0);
    }
    return segments_[static_cast<size_t>(slots_[id])];
  }

  // Adds columns [begin, end) of a row.
  void Add(Segment& segment, int begin, int end, int y, double solid_angle) {
    segment.area += end - begin;
    segment.solid_angle += solid_angle;
    PixelBox& box = segment.box;
    const int right = std::max(box.x + box.w, end);
    box.x = std::min(box.x, begin);
    box.w = right - box.x;
    box.h = y + 1 - box.y;
    SetColumns(&columns_[static_cast<size_t>(&segment - segments_.data()) * words_], begin, end);
  }

  std::vector<Segment> Finish(bool wraps) {
    for (size_t i = 0; i < segments_.size(); ++i) {
      Segment& segment = segments_[i];
      segment.box_wrap = segment.box;
      if (wraps) std::tie(segment.box_wrap.x, segment.box_wrap.w) = ShortestColumnRun(&columns_[i * words_], width_);
    }
    std::sort(segments_.begin(), segments_.end(), [](const auto& a, const auto& b) { return a.entity < b.entity; });
    return std::move(segments_);
  }

 private:
  const Scene& scene_;
  int width_;
  size_t words_;            // of one segment's column bits
  std::vector<int> slots_;  // by entity id: index into segments_, -1 = not seen
  std::vector<Segment> segments_;
  std::vector<uint64_t> columns_;  // bits of columns touched, words_ for each segment
};

}  // namespace

std::pair<int, int> ShortestColumnRun(const uint64_t* bits, int width) {
  // The complement of the longest gap. Walk once around from a column that is set.
  int first = 0;
  while (!IsSet(bits, first)) ++first;
  int best_start = first, longest = -1, gap = 0;
  for (int k = 1; k <= width; ++k) {
    const int column = (first + k) % width;
    if (!IsSet(bits, column)) {
      ++gap;
      continue;
    }
    if (gap > longest || (gap == longest && column < best_start)) {
      longest = gap;
      best_start = column;
    }
    gap = 0;
  }
  if (longest == 0) return {0, width};  // no gap anywhere
  return {best_start, width - longest};
}

std::vector<Segment> FindSegments(const Image<EntityId>& entity, const Image<CategoryId>& semantic, const Scene& scene,
                                  const PixelSolidAngles& solid_angles, PictureKind kind) {
  SegmentCollector collector(scene, entity.width());
  for (int y = 0; y < entity.height(); ++y) {
    const auto ids = entity.row(y);
    const auto categories = semantic.row(y);
    for (int begin = 0; begin < entity.width();) {
      if (kind.allows_void && ids[begin] == kNoEntity) {
        ++begin;
        continue;
      }
      // One run of equal ids.
      Segment& segment = collector.Find(ids[begin], begin, y);
      double solid_angle = 0;
      int x = begin;
      for (; x < entity.width() && ids[x] == ids[begin]; ++x) {
        solid_angle += solid_angles(x, y);
        if (categories[x] != segment.category) {
          throw RuntimeError("renderer: category " + std::to_string(categories[x]) + " on entity " + std::to_string(segment.entity) +
                             " of category " + std::to_string(segment.category));
        }
      }
      collector.Add(segment, begin, x, y, solid_angle);
      begin = x;
    }
  }
  return collector.Finish(kind.wraps);
}

}  // namespace airsim360

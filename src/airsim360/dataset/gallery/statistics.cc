#include "airsim360/dataset/gallery/statistics.h"

#include <algorithm>
#include <cstdio>

#include "airsim360/base/file.h"
#include "airsim360/base/log.h"

namespace airsim360::internal {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

template <size_t kCount>
size_t BinOf(const double (&ends)[kCount], double value) {
  return static_cast<size_t>(std::ranges::upper_bound(ends, value) - std::begin(ends));
}

std::string Format(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

template <size_t kCount>
std::string BinName(const double (&ends)[kCount], size_t bin) {
  return bin == kCount ? Format(">= %g", ends[kCount - 1]) : Format("< %g", ends[bin]);
}

void CountSegments(const NativeDataset& data, const NativeFrame& frame, DatasetStatistics& s) {
  std::map<CategoryId, CategoryCount> here;
  for (const View& view : data.views()) {
    for (const Segment& segment : data.Segments(frame, view)) {
      here[segment.category].pixels += segment.area;
      here[segment.category].solid_angle += segment.solid_angle;
    }
    int64_t seen = 0;
    for (const Json& person : data.Persons(frame, view)) seen += person.value("area", int64_t{0}) > 0;
    s.persons += seen;
    s.frames_with_persons += seen > 0;
  }
  WorldCount& world = s.worlds[frame.world];
  ++world.frames;
  for (const auto& [id, count] : here) {
    CategoryCount& total = s.categories[id];
    ++total.frames;
    total.pixels += count.pixels;
    total.solid_angle += count.solid_angle;
    world.pixels[id] += count.pixels;
    s.pixels += count.pixels;
    s.solid_angle += count.solid_angle;
  }
  if (here.size() <= world.richest_count) return;
  world.richest = frame.position;
  world.richest_count = here.size();
}

int64_t DroppedRows(const fs::path& folder) {
  if (!fs::exists(folder / "dropped.csv")) return 0;
  const std::string text = ReadTextFile(folder / "dropped.csv");
  return std::max<int64_t>(0, std::ranges::count(text, '\n') - 1);
}

std::map<std::string, int64_t> FramesOfWorlds(const DatasetStatistics& s) {
  std::map<std::string, int64_t> frames;
  for (const auto& [world, count] : s.worlds) frames[world] = count.frames;
  return frames;
}

// "a | b" rows of a table of two columns.
template <class Counts>
std::string CountTable(const char* what, const Counts& counts) {
  std::string text = "\n| " + std::string(what) + " | frames |\n|---|--:|\n";
  for (const auto& [name, count] : counts) text += "| " + name + " | " + std::to_string(count) + " |\n";
  return text;
}

template <size_t kCount>
std::vector<std::pair<std::string, int64_t>> Named(const double (&ends)[kCount], const std::vector<int64_t>& bins) {
  std::vector<std::pair<std::string, int64_t>> named;
  for (size_t i = 0; i < bins.size(); ++i) named.emplace_back(BinName(ends, i), bins[i]);
  return named;
}

std::vector<std::pair<CategoryId, CategoryCount>> LargestFirst(const DatasetStatistics& s) {
  std::vector<std::pair<CategoryId, CategoryCount>> list(s.categories.begin(), s.categories.end());
  std::ranges::stable_sort(list, std::greater<>(), [](const auto& entry) { return entry.second.pixels; });
  return list;
}

}  // namespace

DatasetStatistics CountDataset(const NativeDataset& data) {
  DatasetStatistics s;
  s.frames = static_cast<int64_t>(data.size());
  s.heights.assign(std::size(kHeightBins) + 1, 0);
  s.ranges.assign(std::size(kRangeBins) + 1, 0);
  ProgressBar progress("card", s.frames);
  for (size_t i = 0; i < data.size(); ++i) {
    const NativeFrame frame = data.Frame(i);
    const Json& own = frame.json.contains("environment") ? frame.json["environment"] : Json(data.spec().environment);
    ++s.environments[own.is_string() ? own.get<std::string>() : own.dump()];
    ++s.heights[BinOf(kHeightBins, frame.X_WC(data.views().front()).p.z)];
    ++s.ranges[BinOf(kRangeBins, frame.json.value("range_median", 0.0))];
    CountSegments(data, frame, s);
    for (const View& view : data.views()) {
      for (const ProductFolder& product : ProductFolders(data.spec())) {
        std::error_code error;
        const auto size = fs::file_size(data.folder() / product.name / data.FileName(frame, view, product.name), error);
        if (!error) s.bytes += static_cast<int64_t>(size);
      }
    }
    progress.Update(static_cast<int64_t>(i) + 1);
  }
  s.dropped = DroppedRows(data.folder());
  return s;
}

std::string StatisticsMarkdown(const NativeDataset& data, const DatasetStatistics& s) {
  std::string text = "# " + data.spec().world + "\n\n| | |\n|---|---|\n";
  const auto row = [&](const char* key, const std::string& value) { text += "| " + std::string(key) + " | " + value + " |\n"; };
  row("frames", std::to_string(s.frames));
  row("pictures a frame", std::to_string(data.views().size()));
  row("bytes a frame", std::to_string(s.bytes / std::max<int64_t>(1, s.frames)));
  row("categories seen", std::to_string(s.categories.size()));
  if (data.HasPeople()) row("people", std::to_string(s.persons) + " seen, in " + std::to_string(s.frames_with_persons) + " pictures");
  row("dropped as duplicates", std::to_string(s.dropped));
  text += CountTable("scene", FramesOfWorlds(s)) + CountTable("environment", s.environments);
  text += CountTable("height of the camera (z), m", Named(kHeightBins, s.heights));
  text += CountTable("median range, m", Named(kRangeBins, s.ranges));
  text += "\n| category | frames | % of frames | % of pixels | % of solid angle |\n|---|--:|--:|--:|--:|\n";
  for (const auto& [id, c] : LargestFirst(s)) {
    text += "| `" + data.category(id).path + "` | " + std::to_string(c.frames) +
            Format(" | %.1f", 100.0 * static_cast<double>(c.frames) / static_cast<double>(s.frames)) +
            Format(" | %.3f", 100.0 * static_cast<double>(c.pixels) / static_cast<double>(s.pixels)) +
            Format(" | %.3f |\n", 100.0 * c.solid_angle / s.solid_angle);
  }
  text += "\n## Licence\n\nThe pictures and labels are computed by AirSim360 and belong to whoever made them.\n";
  for (const std::string& line : data.attributions()) text += "- " + line + "\n";
  return text;
}

Json StatisticsJson(const NativeDataset& data, const DatasetStatistics& s) {
  Json categories = Json::object();
  for (const auto& [id, c] : LargestFirst(s))
    categories[data.category(id).path] = {{"frames", c.frames}, {"pixels", c.pixels}, {"solid_angle", c.solid_angle}};
  return {{"frames", s.frames},         {"bytes", s.bytes},     {"worlds", FramesOfWorlds(s)}, {"environments", s.environments},
          {"height_bins", kHeightBins}, {"heights", s.heights}, {"range_bins", kRangeBins},    {"ranges", s.ranges},
          {"persons", s.persons},       {"dropped", s.dropped}, {"categories", categories}};
}

}  // namespace airsim360::internal

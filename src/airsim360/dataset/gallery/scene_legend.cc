#include "airsim360/dataset/gallery/scene_legend.h"

#include <algorithm>
#include <cctype>
#include <functional>

#include "airsim360/dataset/color_legend.h"
#include "airsim360/image/draw.h"

namespace airsim360::internal {
namespace {

constexpr int kWidestLegend = 1024, kGap = 4, kTitle = 24, kLeastWidth = 320;  // pixels

// Every n-th pixel: categories are never mixed.
Image<Rgb8> DrawSemantic(const NativeDataset& data, const NativeFrame& frame, int step) {
  const Image<CategoryId> semantic = data.Semantic(frame, data.views().front());
  Image<Rgb8> drawn(semantic.width() / step, semantic.height() / step);
  for (int y = 0; y < drawn.height(); ++y) {
    for (int x = 0; x < drawn.width(); ++x) drawn(x, y) = data.category(semantic(x * step, y * step)).color;
  }
  return drawn;
}

std::vector<ColorLegend::Entry> EntriesOf(const NativeDataset& data, const WorldCount& world) {
  std::vector<std::pair<int64_t, CategoryId>> order;
  for (const auto& [id, pixels] : world.pixels) order.emplace_back(-pixels, id);
  std::ranges::sort(order);
  std::vector<ColorLegend::Entry> entries;
  for (const auto& [pixels, id] : order) entries.push_back({data.category(id).color, data.category(id).path});
  return entries;
}

}  // namespace

std::string SceneLegendName(const std::string& world) {
  std::string name = world;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' ? c : '_';
  return "legend_" + name + ".png";
}

Image<Rgb8> DrawSceneLegend(const NativeDataset& data, const DatasetStatistics& statistics, const std::string& world) {
  const WorldCount& count = statistics.worlds.at(world);
  const NativeFrame frame = data.Frame(count.richest);
  const int full = Width(data.views().front().camera);
  const Image<Rgb8> semantic = DrawSemantic(data, frame, std::max(1, (full + kWidestLegend - 1) / kWidestLegend));
  std::vector<Image<Rgb8>> pictures;
  if (data.Has("rgb")) pictures.push_back(ResizeBox(data.Rgb(frame, data.views().front()), semantic.width(), semantic.height()));
  pictures.push_back(semantic);

  const int width = std::max(kLeastWidth, semantic.width());
  const ColorLegend legend(EntriesOf(data, count), width);
  const int pictures_height = static_cast<int>(pictures.size()) * (semantic.height() + kGap);
  Image<Rgb8> sheet(width, kTitle + pictures_height + legend.height() + kGap, {255, 255, 255});
  DrawText(world, kGap, kGap, {0, 0, 0}, 2, sheet);
  int top = kTitle;
  for (const Image<Rgb8>& picture : pictures) {
    Blit(picture, 0, top, sheet);
    top += semantic.height() + kGap;
  }
  legend.Draw(top, sheet);
  return sheet;
}

}  // namespace airsim360::internal

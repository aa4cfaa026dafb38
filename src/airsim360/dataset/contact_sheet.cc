// contact_sheet.png: what a dataset looks like, at a glance.
#include <algorithm>
#include <functional>

#include "airsim360/base/file.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/color_legend.h"
#include "airsim360/dataset/summaries.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/draw.h"
#include "airsim360/image/palette_png.h"
#include "airsim360/scene/category_colors.h"

namespace airsim360 {
namespace {

constexpr int kThumbWidth = 384;
constexpr int kGap = 4;
constexpr int kHeader = 24;                      // pixels of the line of titles
constexpr double kNearest = 1, kFarthest = 300;  // metres, ends of the range colours

// Colours the middle source pixel of each target pixel: ids and ranges are never averaged.
template <class Pixel, class Color>
Image<Rgb8> ShrinkNearest(const Image<Pixel>& source, int width, int height, Color color) {
  Image<Rgb8> target(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      target(x, y) = color(source((2 * x + 1) * source.width() / (2 * width), (2 * y + 1) * source.height() / (2 * height)));
    }
  }
  return target;
}

Image<Rgb8> WithoutAlpha(const Image<Rgba8>& source) {
  Image<Rgb8> target(source.width(), source.height());
  std::transform(source.pixels().begin(), source.pixels().end(), target.pixels().begin(), [](Rgba8 p) { return Rgb8{p.r, p.g, p.b}; });
  return target;
}

std::string Title(const std::string& product) {
  if (product == "rgb") return "colour";
  return product == "range" ? "range, 1 m light ... 300 m dark" : product;
}

// Near is light, far is dark, nothing is black.
Rgb8 RangeColor(float range) { return range > 0 ? ScaleColor(1 - LogScale(range, kNearest, kFarthest)) : Rgb8{}; }

Image<Rgb8> Thumbnail(const std::string& product, const SemanticTree& tree, const std::filesystem::path& file, int width, int height) {
  const Bytes bytes = ReadFile(file);
  const std::string name = file.string();
  if (product == "range") return ShrinkNearest(DecodeExr(bytes, name), width, height, RangeColor);
  if (product == "semantic") {
    return ShrinkNearest(DecodeLabelPng(bytes, name), width, height, [&](uint16_t id) { return CategoryColor(tree, id); });
  }
  if (product == "entity") return ShrinkNearest(DecodeIdPng(bytes, name), width, height, IdColor);
  return ResizeBox(WithoutAlpha(DecodeRgba8(bytes, name)), width, height);
}

// The categories seen, the largest first.
std::vector<ColorLegend::Entry> CategoryEntries(const DatasetIndex& index, const Scene& scene) {
  constexpr size_t kMost = 60;
  std::vector<CategoryTotal> totals = index.CategoryTotals();
  std::ranges::stable_sort(totals, std::greater(), &CategoryTotal::pixels);
  const size_t shown = std::min(totals.size(), kMost);
  std::vector<ColorLegend::Entry> entries;
  for (size_t i = 0; i < shown; ++i)
    entries.push_back({CategoryColor(scene.tree, totals[i].category), scene.tree[totals[i].category].path});
  if (shown < totals.size()) entries.push_back({{255, 255, 255}, std::to_string(totals.size() - shown) + " more: README.md"});
  return entries;
}

// What the colours mean: a scale of ranges, and the categories.
class Legend {
 public:
  Legend(const DatasetIndex& index, const Scene& scene, int width) : width_(width), categories_(CategoryEntries(index, scene), width) {}

  int height() const { return kScaleHeight + categories_.height() + kGap; }

  void Draw(int top, Image<Rgb8>& sheet) const {
    // Ranges from left to right, with their metres below.
    const int length = std::min(width_ - 2 * kGap, kThumbWidth);
    for (int x = 0; x < length; ++x) {
      const double t = static_cast<double>(x) / length;
      FillRectangle(kGap + x, top, 1, ColorLegend::kSwatch, ScaleColor(1 - t), sheet);
    }
    for (int metres : {1, 3, 10, 30, 100}) {
      const int x = kGap + static_cast<int>(LogScale(metres, kNearest, kFarthest) * length);
      DrawText(std::to_string(metres) + " m", x, top + ColorLegend::kSwatch + 2, {0, 0, 0}, 1, sheet);
    }
    categories_.Draw(top + kScaleHeight, sheet);
  }

 private:
  static constexpr int kScaleHeight = 32;
  int width_;
  ColorLegend categories_;
};

}  // namespace

Bytes ContactSheetPng(const DatasetIndex& index, const DatasetSpec& spec, const Scene& scene, const std::filesystem::path& folder) {
  // Rows are pictures spread evenly over the frames, the views by turns; columns are products.
  struct Cell {
    std::string product;
    std::filesystem::path file;
    int width, height;
  };
  std::vector<ProductFolder> products = ProductFolders(spec);
  std::erase_if(products, [](const ProductFolder& product) {
    return std::ranges::none_of(kProducts, [&](const ProductInfo& info) { return info.always && product.name == info.name; });
  });
  const std::vector<int64_t> frames = index.Frames();
  const std::vector<View> views = Views(spec);
  const auto pictures = static_cast<int64_t>(frames.size() * views.size());
  const int64_t rows = std::min<int64_t>(kContactRows, pictures);
  // Each row is as high as its pictures; columns are as wide as the widest.
  std::vector<Cell> cells;
  std::vector<int> tops = {kHeader};
  int width = 1;
  for (int64_t row = 0; row < rows; ++row) {
    const View& view = views[static_cast<size_t>(row) % views.size()];
    const auto frame = static_cast<size_t>(row * static_cast<int64_t>(frames.size()) / rows);
    const std::string stem = Stem(frames[frame]) + view.suffix;
    const int w = std::min(kThumbWidth, Width(view.camera));
    const int h = std::max(1, static_cast<int>(int64_t{w} * Height(view.camera) / Width(view.camera)));
    width = std::max(width, w);
    tops.push_back(tops.back() + h + kGap);
    for (const ProductFolder& product : products) cells.push_back({product.name, folder / product.name / (stem + product.extension), w, h});
  }

  const int sheet_width = static_cast<int>(products.size()) * (width + kGap) - kGap;
  const Legend legend(index, scene, sheet_width);
  Image<Rgb8> sheet(sheet_width, tops.back() + legend.height(), {255, 255, 255});
  for (size_t c = 0; c < products.size(); ++c) {
    DrawText(Title(products[c].name), static_cast<int>(c) * (width + kGap) + kGap, kGap, {0, 0, 0}, 2, sheet);
  }
  std::vector<Image<Rgb8>> thumbs(cells.size());
  ParallelFor(static_cast<int64_t>(cells.size()), [&](int64_t i) {
    const Cell& cell = cells[static_cast<size_t>(i)];
    thumbs[static_cast<size_t>(i)] = Thumbnail(cell.product, scene.tree, cell.file, cell.width, cell.height);
  });
  for (size_t i = 0; i < cells.size(); ++i) {
    const int column = static_cast<int>(i % products.size());
    Blit(thumbs[i], column * (width + kGap), tops[i / products.size()], sheet);
  }
  legend.Draw(tops.back(), sheet);
  return EncodePng(sheet);
}

}  // namespace airsim360

// contact_sheet.png: what a dataset looks like, at a glance.
#include <algorithm>

#include "airsim360/base/file.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/summaries.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/draw.h"

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
      target(x, y) = color(
          source((2 * x + 1) * source.width() / (2 * width), (2 * y + 1) * source.height() / (2 * height)));
    }
  }
  return target;
}

Image<Rgb8> WithoutAlpha(const Image<Rgba8>& source) {
  Image<Rgb8> target(source.width(), source.height());
  std::transform(source.pixels().begin(), source.pixels().end(), target.pixels().begin(), [](Rgba8 p) {
    return Rgb8{p.r, p.g, p.b};
  });
  return target;
}

std::string Title(const std::string& product) {
  if (product == "rgb") return "colour";
  return product == "range" ? "range, 1 m light ... 300 m dark" : product;
}

// Near is light, far is dark, nothing is black.
Rgb8 RangeColor(float range) {
  return range > 0 ? ScaleColor(1 - LogScale(range, kNearest, kFarthest)) : Rgb8{};
}

Image<Rgb8> Thumbnail(const std::string& product, const std::filesystem::path& file, int width, int height) {
  const Bytes bytes = ReadFile(file);
  const std::string name = file.string();
  if (product == "range") return ShrinkNearest(DecodeExr(bytes, name), width, height, RangeColor);
  if (product == "semantic") return ShrinkNearest(DecodeGrayPng(bytes, name), width, height, IdColor);
  if (product == "entity") return ShrinkNearest(DecodeIdPng(bytes, name), width, height, IdColor);
  return ResizeBox(WithoutAlpha(DecodeRgba8(bytes, name)), width, height);
}

}  // namespace

Bytes ContactSheetPng(const DatasetIndex& index, const DatasetSpec& spec,
                      const std::filesystem::path& folder) {
  // Rows are pictures spread evenly over frames and views, columns are products.
  struct Cell {
    std::string product;
    std::filesystem::path file;
  };
  std::vector<ProductFolder> products = ProductFolders(spec);
  std::erase_if(products, [](const ProductFolder& product) {
    return std::none_of(std::begin(kFixedProducts), std::end(kFixedProducts),
                        [&](const char* fixed) { return product.name == fixed; });
  });
  const std::vector<int64_t> frames = index.Frames();
  const std::vector<View> views = Views(spec);
  const auto pictures = static_cast<int64_t>(frames.size() * views.size());
  const int64_t rows = std::min<int64_t>(kContactRows, pictures);
  std::vector<Cell> cells;
  for (int64_t row = 0; row < rows; ++row) {
    const auto picture = static_cast<size_t>(row * pictures / rows);
    const std::string stem = Stem(frames[picture / views.size()]) + views[picture % views.size()].suffix;
    for (const ProductFolder& product : products)
      cells.push_back({product.name, folder / product.name / (stem + product.extension)});
  }

  const int width = std::min(kThumbWidth, spec.width);
  const int height = std::max(1, static_cast<int>(static_cast<int64_t>(width) * spec.height / spec.width));
  const auto columns = static_cast<int64_t>(products.size());
  Image<Rgb8> sheet(static_cast<int>(columns) * (width + kGap) - kGap,
                    kHeader + static_cast<int>(rows) * (height + kGap) - kGap, {255, 255, 255});
  for (size_t c = 0; c < products.size(); ++c) {
    DrawText(Title(products[c].name), static_cast<int>(c) * (width + kGap) + kGap, kGap, {0, 0, 0}, 2, sheet);
  }
  std::vector<Image<Rgb8>> thumbs(cells.size());
  ParallelFor(static_cast<int64_t>(cells.size()), [&](int64_t i) {
    const Cell& cell = cells[static_cast<size_t>(i)];
    thumbs[static_cast<size_t>(i)] = Thumbnail(cell.product, cell.file, width, height);
  });
  for (size_t i = 0; i < cells.size(); ++i) {
    const int column = static_cast<int>(i % products.size()), row = static_cast<int>(i / products.size());
    Blit(thumbs[i], column * (width + kGap), kHeader + row * (height + kGap), sheet);
  }
  return EncodePng(sheet);
}

}  // namespace airsim360

// Images in memory: row-major, top row first, tightly packed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace airsim360 {

struct Rgb8 {
  uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb8&, const Rgb8&) = default;
};
struct Rgba8 {
  uint8_t r = 0, g = 0, b = 0, a = 255;
  friend bool operator==(const Rgba8&, const Rgba8&) = default;
};
struct Rgb16 {
  uint16_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb16&, const Rgb16&) = default;
};
struct Rgb32f {
  float r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb32f&, const Rgb32f&) = default;
};

template <class Pixel>
class Image {
 public:
  Image() = default;
  /// width x height pixels, all equal to `fill`; sizes must not be negative.
  Image(int width, int height, Pixel fill = {})
      : width_(width), height_(height), pixels_(static_cast<size_t>(width) * static_cast<size_t>(height), fill) {}

  int width() const { return width_; }
  int height() const { return height_; }
  size_t size() const { return pixels_.size(); }
  bool empty() const { return pixels_.empty(); }
  /// Pixel of column x, row y (not checked).
  Pixel& operator()(int x, int y) { return pixels_[static_cast<size_t>(y) * width_ + x]; }
  const Pixel& operator()(int x, int y) const { return pixels_[static_cast<size_t>(y) * width_ + x]; }
  std::span<Pixel> row(int y) { return {pixels_.data() + static_cast<size_t>(y) * width_, static_cast<size_t>(width_)}; }
  std::span<const Pixel> row(int y) const { return {pixels_.data() + static_cast<size_t>(y) * width_, static_cast<size_t>(width_)}; }
  std::span<Pixel> pixels() { return pixels_; }
  std::span<const Pixel> pixels() const { return pixels_; }
  friend bool operator==(const Image&, const Image&) = default;

 private:
  int width_ = 0, height_ = 0;
  std::vector<Pixel> pixels_;
};

}  // namespace airsim360

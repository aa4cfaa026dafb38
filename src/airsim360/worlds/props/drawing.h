// Pictures for props: tiling noise textures, and posters, signs and stripes out of simple shapes and letters.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "airsim360/image/image.h"
#include "airsim360/scene/material.h"

namespace airsim360::internal {

/// Value noise in [0, 1] of lattice cells that repeat every (period_x, period_y) cells.
float TileNoise(float x, float y, int period_x, int period_y, uint64_t seed);
/// Sum of `octaves` of TileNoise over the unit square, each twice as fine and half as strong; mean 0.5,
/// repeats.
float TileFractal(float u, float v, int cells_x, int cells_y, int octaves, uint64_t seed);

/// A picture of `color(u, v)` (linear, v downwards) sampled at pixel centres.
Image<Rgba8> Shade(int width, int height, const std::function<Vec3f(float u, float v)>& color);
/// A tangent-space normal map of a repeating height field given in tile widths, for a tile of width:height =
/// `aspect`.
Texture NormalsFromHeight(std::string name, int width, int height, float aspect, const std::function<float(float u, float v)>& height_at);

/// Paints in linear colours; coordinates are 0..1 across the picture, y downwards.
class Canvas {
 public:
  Canvas(int width, int height, Vec3f background);
  void Rectangle(Vec2f min, Vec2f max, Vec3f color);
  /// Filled circle; `r` in picture heights.
  void Disc(Vec2f center, float r, Vec3f color);
  void Line(Vec2f a, Vec2f b, float thickness, Vec3f color);
  /// Filled regular polygon with `sides` corners at distance `r` (picture heights), first corner `turn`
  /// radians from +x.
  void RegularPolygon(Vec2f center, float r, int sides, float turn, Vec3f color);
  /// A line of SignLettering centred on a point; `size` = height of a letter in picture heights, `stretch` = width of a letter
  /// relative to 5/7 of its height.
  void Letters(std::string_view text, Vec2f center, float size, Vec3f color, float stretch = 1);
  /// Applies `color` where `inside(x, y)`; x and y in pixels from the top left, blended over 4x4 samples a
  /// pixel.
  void Fill(Vec2f min_px, Vec2f max_px, const std::function<bool(float, float)>& inside, Vec3f color);

  /// Every pixel anew: `color(u, v, old)` of its centre (v downwards, linear); rows in parallel.
  void Paint(const std::function<Vec3f(float, float, Vec3f)>& color);

  Texture Finish(std::string name);

  /// What of a picture depends on u alone, once for each column.
  class Columns {
   public:
    Columns(const Canvas& canvas, const std::function<float(float u)>& value);
    /// `u`: of the middle of a column, as Paint gives it.
    float operator()(float u) const { return values_[static_cast<size_t>(u * width_)]; }

   private:
    float width_;
    std::vector<float> values_;
  };

 private:
  /// Blends `color` into pixels by `hits_of(x, y)` of their 16 samples.
  template <class Hits>
  void ForPixels(Vec2f min_px, Vec2f max_px, const Hits& hits_of, Vec3f color);

  float width_, height_;
  Image<Rgba8> image_;
};

}  // namespace airsim360::internal

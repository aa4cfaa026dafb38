// Which pixels of a picture a figure is about, and what each of them counts. Pure functions.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360 {

/// What a pixel of a panorama counts.
enum class PixelWeight {
  kPixel,        ///< 1
  kSolidAngle,   ///< steradians, exact: 2 pi / W times the difference of the sines of the row's borders
  kCosLatitude,  ///< cosine of the latitude of the row's centre
};
/// "pixel", "solid_angle"; InputError naming --weights otherwise.
PixelWeight ParsePixelWeight(const std::string& text);

/// One number a row of an equirectangular picture.
std::vector<double> RowWeights(int height, int width, PixelWeight weight);

/// Pixels of a picture in some order, some perhaps several times.
struct PixelView {
  std::vector<uint32_t> source;  ///< row-major index of each in the picture; empty = all of them in order
  std::vector<double> weights;   ///< empty = 1 each
};

/// All pixels. InputError for weights other than 1 unless width = 2 height (as in the functions below).
PixelView WholeView(int width, int height, PixelWeight weight);
/// The rows whose centres lie in the band `band` of `bands` of equal latitude, the northernmost first. InputError for no rows.
PixelView BandView(int width, int height, int band, int bands, PixelWeight weight);
/// The columns nearer than `columns` to the seam (left and right border), or the others.
PixelView SeamView(int width, int height, int columns, bool near, PixelWeight weight);
/// The nearest pixel for each pixel of six cube faces of width / 4.
PixelView CubeView(int width, int height);
/// The same of the 20 pictures that touch the sphere at the centres of an icosahedron's faces, with the panorama's pixel size in the
/// middle. A direction is seen in the picture whose centre is nearest, so that each is seen once (after Eder et al.,
/// "Tangent Images for Mitigating Spherical Distortion", CVPR 2020).
PixelView TangentView(int width, int height);
/// The nearest pixel for each pixel of a picture of another size.
PixelView ResizedView(int width, int height, int new_width, int new_height);

/// Where the pixels of a panorama went when the camera turned: yaw to the right, pitch upwards, roll clockwise, radians, in this order from
/// outside. Of each pixel the one of the turned picture that shows the same direction, so that Take(turned, view) turns it back.
PixelView TurnedView(int width, int height, double yaw, double pitch, double roll);

/// The pixels of a view.
template <class Pixel>
std::vector<Pixel> Take(std::span<const Pixel> pixels, const PixelView& view) {
  if (view.source.empty()) return {pixels.begin(), pixels.end()};
  std::vector<Pixel> taken(view.source.size());
  for (size_t i = 0; i < taken.size(); ++i) taken[i] = pixels[view.source[i]];
  return taken;
}

/// What `pixels` were before each row was moved `columns` to the right, the seam joined.
template <class Pixel>
std::vector<Pixel> RollBack(std::span<const Pixel> pixels, int width, int columns) {
  std::vector<Pixel> back(pixels.size());
  const int shift = ((columns % width) + width) % width;
  for (size_t row = 0; row < pixels.size(); row += static_cast<size_t>(width)) {
    for (int x = 0; x < width; ++x) back[row + static_cast<size_t>(x)] = pixels[row + static_cast<size_t>((x + shift) % width)];
  }
  return back;
}

}  // namespace airsim360

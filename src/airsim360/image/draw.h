// A small raster toolkit for contact sheets and charts: compose, shrink, colour and letter 8-bit sRGB
// pictures. Everything clips at the edges of the canvas, so positions may lie outside.
#pragma once

#include <cstdint>
#include <string_view>

#include "airsim360/image/image.h"

namespace airsim360 {

/// Copies `picture` with its top left corner at (x, y).
void Blit(const Image<Rgb8>& picture, int x, int y, Image<Rgb8>& canvas);

/// Fills the rectangle of `width` x `height` pixels with its top left corner at (x, y).
void FillRectangle(int x, int y, int width, int height, Rgb8 color, Image<Rgb8>& canvas);

/// Resized to width x height (both > 0, else InputError): every pixel is the mean, in linear light, of the
/// area it covers, with parts of pixels counted as parts. Enlarging gives blocks with soft borders.
Image<Rgb8> ResizeBox(const Image<Rgb8>& picture, int width, int height);

/// Colour of t in [0, 1] (clamped; NaN is 0): lightness grows evenly from dark blue over green to light
/// yellow (a straight line in the lightness of Oklab), so that order stays readable in gray.
Rgb8 ScaleColor(double t);

/// 0 at `low`, 1 at `high`, in equal steps for equal ratios; clamped. 0 < low < high. Values <= 0 give 0.
double LogScale(double value, double low, double high);

/// A colour of Oklab by lightness in [0, 1], chroma and hue in degrees; clipped to sRGB.
Rgb8 OklchColor(double lightness, double chroma, double hue_deg);

/// Colour of an id: the same everywhere, well spread for neighbouring ids; 0 is black.
Rgb8 IdColor(uint32_t id);

/// Letters of 5 x 7 pixels in cells of 6 x 8, for ASCII 32..126; other bytes show as '?'.
inline constexpr int kGlyphCellWidth = 6, kGlyphCellHeight = 8;
/// Whether the letter has ink at column 0 … 4, row 0 … 6 of its cell; false outside.
bool HasInk(char letter, int column, int row);
/// Writes one line with the top left corner at (x, y), each font pixel `scale` x `scale` (>= 1) pixels.
void DrawText(std::string_view text, int x, int y, Rgb8 color, int scale, Image<Rgb8>& canvas);
/// Width in pixels that DrawText covers.
int TextWidth(std::string_view text, int scale);

}  // namespace airsim360

// How much two pictures of the same size differ. Pure functions; InputError unless the sizes agree and both
// have pixels (Ssim: at least 11 x 11).
#pragma once

#include "airsim360/image/image.h"

namespace airsim360 {

/// Peak signal-to-noise ratio of 8-bit values over all channels, dB; infinity for equal pictures.
double Psnr(const Image<Rgb8>& a, const Image<Rgb8>& b);

/// The same for equirectangular panoramas, every row weighted by cos(latitude), the solid angle of its pixels
/// (Sun, Lu, Yu, IEEE SPL 24(9), 2017).
double WsPsnr(const Image<Rgb8>& a, const Image<Rgb8>& b);

/// Mean structural similarity of luma (BT.601) in [-1, 1], 1 = equal: Gaussian window of 11 x 11 and standard
/// deviation 1.5, K1 = 0.01, K2 = 0.03, windows that fit into the picture (Wang et al., IEEE TIP 13(4),
/// 2004).
double Ssim(const Image<Rgb8>& a, const Image<Rgb8>& b);

struct FlipOptions {
  /// Pixels per degree of the viewer's field of view: 0.7 m from a screen 0.7 m wide with 3840 columns.
  double pixels_per_degree = 67.0206;
  bool wrap_columns = false;  ///< panoramas: the left border goes on at the right one; else borders are held
};

/// FLIP of display-referred sRGB pictures: perceived difference of every pixel in [0, 1] when flipping
/// between them (Andersson et al., PACM CGIT 3(2), 2020).
Image<float> Flip(const Image<Rgb8>& reference, const Image<Rgb8>& test, const FlipOptions& options = {});
/// Mean of Flip.
double MeanFlip(const Image<Rgb8>& reference, const Image<Rgb8>& test, const FlipOptions& options = {});

}  // namespace airsim360

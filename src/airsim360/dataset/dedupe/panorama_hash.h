// A short fingerprint of what a panorama shows, the same however the camera is turned and exposed.
#pragma once

#include <array>
#include <cstdint>

#include "airsim360/image/image.h"
#include "airsim360/math/transform.h"

namespace airsim360::internal {

/// 256 bits: four bands of latitude (-60 … 60 degrees of W), 64 each.
using PanoramaHash = std::array<uint64_t, 4>;

/// Turns the picture upright and to yaw 0 of W by its pose, averages it over cells of each band, and takes of the band's
/// two-dimensional cosine transform (type II) 16 frequencies of azimuth by 4 of elevation; a bit tells whether one is
/// above their median. Without the mean, and by signs, it does not depend on exposure (the idea of PDQ: Facebook,
/// "The TMK+PDQF Video-Hashing Algorithm and the PDQ Image-Hashing Algorithm", 2019).
PanoramaHash HashPanorama(const Image<Rgb8>& panorama, const Mat3d& R_WC);

/// Number of bits that differ, 0 … 256.
int Distance(const PanoramaHash& a, const PanoramaHash& b);

}  // namespace airsim360::internal

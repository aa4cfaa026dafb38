// The passes of Scatter: one copy per instruction set, bit for bit the same results.
#pragma once

#include "airsim360/base/kernel_isa.h"

namespace airsim360::internal {

/// Rows of complex numbers; rows are padded to the next multiple of kScatterBlock.
struct ScatterRows {
  float *re, *im;
  int length;                    ///< a power of two
  int stride;                    ///< from row to row; no power of two, or the rows share their places in the caches
  const float *cosines, *sines;  ///< of 2 pi k / length, k < length / 2
};
inline constexpr int kScatterBlock = 16;

/// The systems (area + t (flux + next flux + across eigen)) u - t (flux u_above + next flux u_below) = area f of every
/// frequency, and weights of the solutions.
struct ScatterSystem {
  int rows, stride;
  const float *area, *flux, *across;  ///< flux[y]: between rows y - 1 and y; rows + 1 of them, 0 at both ends
  const float* eigen;                 ///< of every element of a row, in the order of its Fourier transform
  int parts;
  const float *t, *weight;
  float* planes[4];
};

}  // namespace airsim360::internal

/// Fourier transforms of the rows `first` to `first` + kScatterBlock - 1, in place. Frequencies come out, and go in,
/// with their bits reversed. Not scaled.
AIRSIM360_DECLARE_KERNEL(void FourierRows(const ScatterRows& rows, int first, bool inverse))
/// Replaces the columns `first` to `first` + kScatterBlock - 1 of the planes by the weighted sum of solutions.
AIRSIM360_DECLARE_KERNEL(void SolveColumns(const ScatterSystem& system, int first))

// The passes of the denoiser, row by row: one copy per instruction set, bit for bit the same results.
#pragma once

#include "airsim360/base/kernel_isa.h"
#include "airsim360/render/filter/filter_planes.h"

/// Fills row y of the planes, all but the columns after `width`; light and data_id of set 0.
AIRSIM360_DECLARE_KERNEL(void LoadFilterRow(const FilterPlanes& planes, int y, const FilterSource& source))
/// Averages light of set 0 along the row over `columns` columns about each pixel, weighted by samples, where
/// pixels are narrower than they are high. Set 1 and window serve as scratch; does not write the padding.
AIRSIM360_DECLARE_KERNEL(void GatherRow(const FilterPlanes& planes, int y, int columns))
/// Statistics of the 3 x 3 neighbourhood: window, own, loose.
AIRSIM360_DECLARE_KERNEL(void WindowRow(const FilterPlanes& planes, int y, int step_x))
/// Variance of noise from the windows three pixels around.
AIRSIM360_DECLARE_KERNEL(void VarianceRow(const FilterPlanes& planes, int y, int step_x))
/// One level: light and data_id of set `in` to the other set, with nine taps `step` pixels apart. Does not
/// write the padding.
AIRSIM360_DECLARE_KERNEL(void AtrousRow(const FilterPlanes& planes, int y, int step, int step_x, int in))
/// Mixes the last frame into light, samples and data_id of set 0. Does not write the padding.
AIRSIM360_DECLARE_KERNEL(void RecallRow(const FilterPlanes& planes, int y, const FilterPast& past))
/// Copies row y of set 0 to `pixels`, FilterPast::kFloats each, with the planes' stride.
AIRSIM360_DECLARE_KERNEL(void KeepRow(const FilterPlanes& planes, int y, float* pixels))

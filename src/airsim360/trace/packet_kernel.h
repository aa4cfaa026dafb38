// Loops over the 16 rays of a packet before it is traced, compiled per instruction set.
#pragma once

#include "airsim360/base/kernel_isa.h"
#include "airsim360/trace/ray_tracer.h"

/// Whether origins and directions of all active lanes are finite (and not so large that their sum is not).
AIRSIM360_DECLARE_KERNEL(bool AllFinite(const int* valid, const RayHit16& rays))
/// Marks the active lanes (-1 in `valid`) as having met nothing.
AIRSIM360_DECLARE_KERNEL(void MarkMissed(const int* valid, RayHit16& rays))

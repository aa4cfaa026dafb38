// Loops over the 16 rays of a packet before it is traced, compiled per instruction set.
#pragma once

#include "airsim360/base/kernel_isa.h"
#include "airsim360/trace/ray_tracer.h"
#include "airsim360/trace/trace_limit.h"

/// Takes out active lanes that cannot be traced (kTraceLimit): `traceable` is `valid` without them. Returns whether
/// there were none.
AIRSIM360_DECLARE_KERNEL(bool KeepTraceable(const int* valid, const RayHit16& rays, int* traceable))
/// Marks the active lanes (-1 in `valid`) as having met nothing.
AIRSIM360_DECLARE_KERNEL(void MarkMissed(const int* valid, RayHit16& rays))

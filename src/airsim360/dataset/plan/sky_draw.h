// One sky out of a mixture.
#pragma once

#include "airsim360/base/random.h"
#include "airsim360/dataset/plan/plan.h"

namespace airsim360::internal {

/// A choice by weight, its preset over `world`, its numbers drawn. A pure function of its arguments.
PlannedSky DrawSky(const SkyMixture& mixture, RngStream random, const Environment& world);

}  // namespace airsim360::internal

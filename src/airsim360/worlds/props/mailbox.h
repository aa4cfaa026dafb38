// The American collection box, in its usual blue and in others.
#pragma once

#include "airsim360/scene/model_source.h"

namespace airsim360::internal {

/// Rounded top, pull-down door at the front, four legs; `paint`: linear base colour.
Model MailboxOf(Vec3f paint);

}  // namespace airsim360::internal

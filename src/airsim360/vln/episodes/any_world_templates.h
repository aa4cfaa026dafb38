// Instructions in the style of the paper's for whatever a world has: its own categories and names, five lengths.
#pragma once

#include "airsim360/vln/episodes/template_syntax.h"

namespace airsim360 {

/// A pure function of its arguments; `rooms`: for flights within rooms. InputError if the scene names nothing of everyday size.
std::vector<InstructionTemplate> AnyWorldTemplates(const Scene& scene, bool rooms);

}  // namespace airsim360

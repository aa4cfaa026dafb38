// From an imported file and its labels to a scene.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "airsim360/assets/imported.h"
#include "airsim360/assets/labels/label_rules.h"
#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// Entities, instances, sky and viewpoint. `title` names the scene and what is nameless, `where` starts error
/// messages. A node whose parts have different labels is split into an entity each. InputError if there is
/// nothing to show or if a coordinate goes beyond 1e9 m. `baked`: whether the light of its rooms is in its colours; not given:
/// as WhyBaked says.
std::shared_ptr<const Scene> AssembleScene(ImportedFile file, const LabelRules& rules, const std::string& title, const std::string& where,
                                           std::optional<bool> baked = {});

}  // namespace airsim360::internal

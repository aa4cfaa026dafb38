// What a file of COCO results looks like where almost nothing in it matches: another numbering, another kind of box, another unit.
#pragma once

#include <span>
#include <string>

#include "airsim360/eval/coco/objects.h"
#include "airsim360/eval/mistakes/likely_cause.h"

namespace airsim360 {

/// The reading under which results match far better than as they are, with the AP50 of both; none if they match well enough as they are (`ap50`
/// from 0.15) or under no reading. Sure where nearly all match so; other category ids only where some do not exist in the truth, as a bad
/// detector may take each category for another one. Matches them anew for each reading.
LikelyMistake LikelyReading(const CocoTruths& truths, std::span<const CocoObject> results, const CocoRun& run, double ap50);

/// What makes figures of truths void without a word: areas of 0 by which the similarity of keypoints divides, and numbers of keypoints that
/// say 0 where keypoints are labelled. "" if nothing does for most of them.
std::string VoidTruths(const CocoTruths& truths, CocoKind kind);

}  // namespace airsim360

// What a frame of a plan is: the recipe's picture, what was given over it, and what the plan itself decides.
#pragma once

#include <map>
#include <string>

#include "airsim360/dataset/plan/plan.h"
#include "airsim360/dataset/record/camera_choice.h"

namespace airsim360 {

/// Pictures as `picture` says, through `camera`. InputError naming the flag for what does not go together, and for products
/// that frames of several worlds cannot have.
DatasetSpec SpecOfPicture(const RecipePicture& picture, const CameraChoice& camera);

/// The same with the fields that flags gave over the recipe's, by name with their JSON text. The spec remembers these, so that
/// the same comes out again.
DatasetSpec SpecOfPictures(const RecipePicture& recipe, const std::map<std::string, std::string>& given);

/// The spec of a dataset of the plan.
DatasetSpec SpecOfPlan(const DatasetPlan& plan, const DatasetSpec& pictures, int64_t shard, int64_t shards);

/// The same of the frames of one block under its sky, whose stops of exposure come on top of those of `spec`.
DatasetSpec SpecOfBlock(const DatasetPlan& plan, const FrameBlock& block, const PlannedSky& sky, DatasetSpec spec);

}  // namespace airsim360

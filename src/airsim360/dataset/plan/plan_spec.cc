#include "airsim360/dataset/plan/plan_spec.h"

#include <set>

#include "airsim360/base/error.h"

namespace airsim360 {

DatasetSpec SpecOfPicture(const RecipePicture& picture, const CameraChoice& camera) {
  DatasetSpec spec = picture.settings;
  camera.Apply(spec);
  spec.products = WithProducts(spec.products, picture.products, "--products");
  for (const View& view : Views(spec)) CheckPictureSettings(spec, view.camera, "--");
  // Numbers of materials are those of one world.
  if (spec.products.material || spec.products.part)
    throw InputError("--products: material and part are numbered by world; collect has them");
  if (spec.products.radiance && spec.tier == Tier::kLabels) throw InputError("--products: tier 'labels' has no light; use --tier fast");
  return spec;
}

DatasetSpec SpecOfPictures(const RecipePicture& recipe, const std::map<std::string, std::string>& given) {
  RecipePicture picture = recipe;
  std::string text = "{";
  for (const auto& [name, value] : given) text += (text.size() > 1 ? ", " : "") + ("\"" + name + "\": ") + value;
  ReadYaml(text + "}", "flags", [&](ConfigVisitor& v) { VisitPicture(v, picture); });
  DatasetSpec spec = SpecOfPicture(picture, {.size = picture.size, .cameras = {}});
  spec.picture = given;
  return spec;
}

DatasetSpec SpecOfPlan(const DatasetPlan& plan, const DatasetSpec& pictures, int64_t shard, int64_t shards) {
  DatasetSpec spec = pictures;
  spec.command = "dataset run";
  spec.plan = plan.hash;
  spec.seed = plan.seed;
  spec.frames = plan.frames();
  spec.shard = shard, spec.shards = shards;
  spec.route = "of the plan";
  spec.environment = "of each frame";
  std::set<std::string> worlds;
  for (const RecipeRow& row : plan.recipe.rows) {
    if (plan.facts(row).exists()) worlds.insert(row.world);
    if (row.people > 0 && plan.facts(row).exists()) spec.people = "in areas of the plan";
  }
  for (const std::string& world : worlds) spec.world += (spec.world.empty() ? "" : ",") + world;
  return spec;
}

DatasetSpec SpecOfBlock(const DatasetPlan& plan, const FrameBlock& block, const PlannedSky& sky, DatasetSpec spec) {
  const RecipeRow& row = plan.recipe.rows[block.row];
  spec.world = row.world;
  spec.row = row.name;
  spec.seed = block.seed;
  spec.environment = DescribeEnvironment(sky.environment);
  spec.exposure_ev += sky.exposure_ev;
  return spec;
}

}  // namespace airsim360

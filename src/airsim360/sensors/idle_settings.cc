#include "airsim360/sensors/idle_settings.h"

#include <algorithm>
#include <string>
#include <vector>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

std::string TierWords(const std::vector<Tier>& tiers) {
  std::string names;
  for (const Tier tier : tiers) names += (names.empty() ? "" : " or ") + std::string(kTierNames[static_cast<int>(tier)]);
  return names;
}

}  // namespace

void RefuseIdleSettings(const PictureSettings& settings, const Products& products, std::string_view prefix) {
  const std::vector<Tier> light = {Tier::kFast, Tier::kHigh, Tier::kReference};
  // Coverage counts the rays of antialiasing in every tier.
  const bool edges = settings.edge_samples != 0 && !products.coverage, flags = !prefix.empty();
  const struct {
    const char* name;
    bool given;
    std::vector<Tier> tiers;
  } all[] = {{"samples", settings.samples != 0, {Tier::kHigh, Tier::kReference}},
             {flags ? "no-denoise" : "denoise", !settings.denoise, {Tier::kHigh}},
             {flags ? "edge-samples" : "edge_samples", edges, {Tier::kFast, Tier::kHigh}},
             {"tone", settings.tone != ToneCurve::kFilmic, light},
             {"exposure", settings.auto_exposure || settings.exposure_ev != 0, light},
             {"lens", settings.lens != LensModel::kIdeal, light},
             {"look", settings.look != Look::kClean, light}};
  const std::string before(prefix);
  for (const auto& one : all) {
    if (one.given && std::ranges::find(one.tiers, settings.tier) == one.tiers.end())
      throw InputError(before + one.name + ": tier '" + kTierNames[static_cast<int>(settings.tier)] + "' has no use for it; use " + before +
                       "tier " + TierWords(one.tiers));
  }
  if (settings.look == Look::kPhoto && settings.tone != ToneCurve::kFilmic)
    throw InputError(before + "tone: " + before + "look photo has a curve of its own" + (flags ? " (--shoulder, --contrast)" : "") +
                     "; leave one of them out");
}

}  // namespace airsim360

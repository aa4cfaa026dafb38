#include <algorithm>
#include <cmath>

#include "airsim360/vln/language/draft.h"

namespace airsim360::internal {
namespace {

constexpr double kSure = 38, kOut = 52;  // degrees from the middle of a sector of +-45: inside, outside for sure
constexpr double kSteep = 55;            // degrees of elevation: what is higher or lower has no clear direction

struct Side {
  const char *name, *said;
  double azimuth;
};
constexpr Side kSides[] = {{"front", "in front of you", 0}, {"right", "on your right", 90}, {"behind", "behind you", 180}, {"left", "on your left", -90}};

double Off(const Seen& seen, const Side& side) { return std::abs(std::remainder(seen.azimuth_deg - side.azimuth, 360)); }

}  // namespace

Speaker::Speaker(const Scene& scene, const Lexicon& lexicon, const Lookout& lookout) : scene_(scene), lexicon_(lexicon), lookout_(lookout) {
  for (int picture = 0; picture < 3; ++picture) {
    groups_[picture] = Group(lexicon, lookout.seen(picture));
    AddNames(picture);
  }
}

Box3d Speaker::BoxOf(EntityId entity) const {
  const Box3f& box = scene_.entity(entity).bounds;
  return {VecCast<double>(box.min), VecCast<double>(box.max)};
}

DistanceBounds Speaker::Range(const Seen& seen, const Picture& from) const {
  const Box3d box = BoxOf(seen.entity);
  Vec3d out;
  for (int i = 0; i < 3; ++i) out[i] = std::max({box.min[i] - from.from.p_W[i], from.from.p_W[i] - box.max[i], 0.0});
  return {Norm(out), seen.nearest};
}

DistanceBounds Speaker::Apart(EntityId a, EntityId b) const {
  const Box3d p = BoxOf(a), q = BoxOf(b);
  Vec3d gap, reach;
  for (int i = 0; i < 3; ++i) {
    gap[i] = std::max({p.min[i] - q.max[i], q.min[i] - p.max[i], 0.0});
    reach[i] = std::max(p.max[i] - q.min[i], q.max[i] - p.min[i]);
  }
  return {Norm(gap), Norm(reach)};
}

std::string Speaker::SectorOf(const Seen& seen) {
  if (std::abs(seen.elevation_deg) > kSteep || seen.right_deg - seen.left_deg > 120) return "";
  for (const Side& side : kSides)
    if (Off(seen, side) < kSure) return side.name;
  return "";
}

void Speaker::AddNames(int picture) {
  for (uint16_t word = 0; word < groups_[picture].size(); ++word) {
    const Sighted& sighted = groups_[picture][word];
    const std::string& one = lexicon_.words()[word].one;
    if (const Seen* only = sighted.only()) {
      names_[picture].push_back({"the " + one, word, "only", only});
      continue;
    }
    if (picture != 0) continue;
    for (const Side& side : kSides) {
      const Seen* found = nullptr;
      bool one_alone = true;
      for (const auto* list : {&sighted.clear, &sighted.doubtful}) {
        for (const Seen* seen : *list) {
          if (Off(*seen, side) > kOut && std::abs(seen->elevation_deg) <= kSteep) continue;
          one_alone = one_alone && found == nullptr && list == &sighted.clear && SectorOf(*seen) == side.name;
          found = seen;
        }
      }
      if (found != nullptr && one_alone) names_[picture].push_back({"the " + one + " " + side.said, word, side.name, found});
    }
  }
}

VlnJson ToJson(const Name& name, const Lexicon& lexicon) { return {{"word", lexicon.words()[name.word].one}, {"where", name.where}}; }

VlnJson Figures(const Seen& seen, const Scene& scene) {
  return {{"entity", seen.entity},
          {"name", scene.entity(seen.entity).name},
          {"pixels", seen.pixels},
          {"azimuth_deg", Rounded(seen.azimuth_deg)},
          {"range", Rounded(seen.nearest)}};
}

}  // namespace airsim360::internal

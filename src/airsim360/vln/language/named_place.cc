#include <algorithm>
#include <cmath>

#include "airsim360/vln/language/named_place.h"

namespace airsim360::internal {
namespace {

constexpr double kSure = 38, kOut = 52;  // degrees from the middle of a sector of +-45: inside, outside for sure
constexpr double kSteep = 55;            // degrees of elevation: what is higher or lower has no clear direction

struct Side {
  const char *name, *said;
  double azimuth;
};
constexpr Side kSides[] = {
    {"front", "in front of you", 0}, {"right", "on your right", 90}, {"behind", "behind you", 180}, {"left", "on your left", -90}};

constexpr double kNearestShare = 1.25, kNearestBy = 0.75;  // share and metres by which the nearest is nearer than the next

double Off(const Seen& seen, const Side& side) { return std::abs(std::remainder(seen.azimuth_deg - side.azimuth, 360)); }

}  // namespace

NamedPlace::NamedPlace(const Scene& scene, const Lexicon& lexicon, const Lookout& lookout)
    : scene_(scene), lexicon_(lexicon), lookout_(lookout) {
  const auto add = [&](const Glance& glance) {
    Said& said = said_.emplace_back(Said{Group(lexicon, glance.seen), {}});
    AddNames(said, glance.picture.panorama);
    AddNearest(said, glance.picture);
  };
  for (const Glance& glance : lookout.glances) add(glance);
  if (lookout.later) add(*lookout.later);
}

Box3d NamedPlace::BoxOf(EntityId entity) const {
  const Box3f& box = scene_.entity(entity).bounds;
  return {VecCast<double>(box.min), VecCast<double>(box.max)};
}

DistanceBounds NamedPlace::Range(const Seen& seen, const Picture& from) const {
  const Box3d box = BoxOf(seen.entity);
  Vec3d out;
  for (int i = 0; i < 3; ++i) out[i] = std::max({box.min[i] - from.from.p_W[i], from.from.p_W[i] - box.max[i], 0.0});
  return {Norm(out), seen.nearest};
}

DistanceBounds NamedPlace::Apart(EntityId a, EntityId b) const {
  const Box3d p = BoxOf(a), q = BoxOf(b);
  Vec3d gap, reach;
  for (int i = 0; i < 3; ++i) {
    gap[i] = std::max({p.min[i] - q.max[i], q.min[i] - p.max[i], 0.0});
    reach[i] = std::max(p.max[i] - q.min[i], q.max[i] - p.min[i]);
  }
  return {Norm(gap), Norm(reach)};
}

std::string NamedPlace::SectorOf(const Seen& seen) {
  if (std::abs(seen.elevation_deg) > kSteep || seen.right_deg - seen.left_deg > 120) return "";
  for (const Side& side : kSides)
    if (Off(seen, side) < kSure) return side.name;
  return "";
}

Name NamedPlace::Turned(const Name& name, int quarters) const {
  Name turned = name;
  for (size_t i = 0; i < std::size(kSides); ++i) {
    if (name.where != kSides[i].name) continue;
    const Side& side = kSides[(i + static_cast<size_t>(quarters)) % std::size(kSides)];
    turned.where = side.name;
    turned.text = "the " + lexicon_.words()[name.word].one + " " + side.said;
  }
  return turned;
}

void NamedPlace::AddNames(Said& said, bool panorama) {
  for (uint16_t word = 0; word < said.groups.size(); ++word) {
    const Sighted& sighted = said.groups[word];
    const std::string& one = lexicon_.words()[word].one;
    if (const Seen* only = sighted.only()) {
      said.names.push_back({"the " + one, word, "only", only});
      continue;
    }
    if (!panorama) continue;
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
      if (found != nullptr && one_alone) said.names.push_back({"the " + one + " " + side.said, word, side.name, found});
    }
  }
}

const Seen* NamedPlace::NearestOf(const Sighted& sighted, const Picture& from) const {
  if (sighted.clear.empty()) return nullptr;
  const Seen* best = *std::ranges::min_element(sighted.clear, {}, &Seen::nearest);
  for (const auto* group : {&sighted.clear, &sighted.doubtful})
    for (const Seen* s : *group)
      if (s != best && best->nearest * kNearestShare + kNearestBy > Range(*s, from).least) return nullptr;
  return best;
}

void NamedPlace::AddNearest(Said& said, const Picture& from) {
  for (uint16_t word = 0; word < said.groups.size(); ++word) {
    if (said.groups[word].only() != nullptr) continue;
    if (const Seen* nearest = NearestOf(said.groups[word], from))
      said.names.push_back({"the nearest " + lexicon_.words()[word].one, word, "nearest", nearest});
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

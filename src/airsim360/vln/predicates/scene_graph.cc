#include "airsim360/vln/predicates/scene_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace airsim360 {
namespace {

bool InCategory(const std::string& path, const std::string& wanted) {
  return path.starts_with(wanted) && (path.size() == wanted.size() || path[wanted.size()] == '/');
}

bool NameIsIn(const std::string& name, const std::vector<std::string>& patterns) {
  return std::ranges::any_of(patterns, [&](const std::string& pattern) { return NameMatches(name, pattern); });
}

std::string KeyOf(const Noun& noun) {
  std::string key = noun.whole ? noun.word + "\n" : "\n";
  for (const auto* list : {&noun.categories, &noun.names, &noun.without}) {
    for (const std::string& text : *list) key += text + "\n";
    key += "\t";
  }
  return key;
}

Box3d ToDouble(const Box3f& box) { return {VecCast<double>(box.min), VecCast<double>(box.max)}; }

}  // namespace

bool NameMatches(std::string_view name, std::string_view pattern) {
  if (pattern.ends_with('*')) return name.starts_with(pattern.substr(0, pattern.size() - 1));
  if (!name.starts_with(pattern)) return false;
  const std::string_view rest = name.substr(pattern.size());
  if (rest.empty()) return true;
  return rest.size() > 1 && rest[0] == ' ' && rest.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

bool Matches(const Scene& scene, const Entity& entity, const Noun& noun) {
  if (entity.bounds.empty() || entity.id == scene.sky_entity) return false;
  const std::string& path = scene.tree[entity.category].path;
  if (InCategory(path, "human") || InCategory(path, "uav")) return false;
  const bool category =
      noun.categories.empty() || std::ranges::any_of(noun.categories, [&](const std::string& wanted) { return InCategory(path, wanted); });
  return category && (noun.names.empty() || NameIsIn(entity.name, noun.names)) && !NameIsIn(entity.name, noun.without);
}

const std::vector<Thing>& SceneGraph::Find(const Noun& noun) {
  const auto [entry, is_new] = found_.try_emplace(KeyOf(noun));
  std::vector<Thing>& things = entry->second;
  if (!is_new) return things;
  for (const Entity& entity : scene_->entities) {
    if (!Matches(*scene_, entity, noun)) continue;
    const Box3d box = ToDouble(entity.bounds);
    if (noun.whole && !things.empty()) {
      Thing& all = things.front();
      all.entities.push_back(entity.id);
      all.box = {Min(all.box.min, box.min), Max(all.box.max, box.max)};
    } else {
      things.push_back({noun.whole && !noun.word.empty() ? noun.word : entity.name, {entity.id}, box});
    }
  }
  return things;
}

DistanceBounds PlanDistance(Vec3d p, const Box3d& box) {
  const auto outside = [](double v, double low, double high) { return std::max({low - v, v - high, 0.0}); };
  const auto farthest = [](double v, double low, double high) { return std::max(std::abs(v - low), std::abs(v - high)); };
  const double far_x = farthest(p.x, box.min.x, box.max.x), far_y = farthest(p.y, box.min.y, box.max.y);
  DistanceBounds bounds{std::hypot(outside(p.x, box.min.x, box.max.x), outside(p.y, box.min.y, box.max.y)),
                        std::numeric_limits<double>::infinity()};
  // On each side of the box lies a point of the thing, at worst in its far corner.
  for (const double x : {box.min.x, box.max.x}) bounds.most = std::min(bounds.most, std::hypot(p.x - x, far_y));
  for (const double y : {box.min.y, box.max.y}) bounds.most = std::min(bounds.most, std::hypot(far_x, p.y - y));
  return bounds;
}

}  // namespace airsim360

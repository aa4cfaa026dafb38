#include "airsim360/worlds/osm/buildings/osm_areas.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace airsim360::internal {
namespace {

constexpr size_t kMaxRingWays = 20000;

// Rings of ways joined end to end; a chain that does not close is closed where its ends are near each other.
// `open` is set where one does not.
std::vector<Ring> JoinWays(std::vector<const OsmWay*> ways, bool& open) {
  std::vector<Ring> rings;
  if (ways.size() > kMaxRingWays) ways.resize(kMaxRingWays);
  std::multimap<int64_t, size_t> ends;  // node -> index into ways
  std::vector<bool> used(ways.size(), false);
  for (size_t i = 0; i < ways.size(); ++i) {
    ends.emplace(ways[i]->nodes.front(), i);
    ends.emplace(ways[i]->nodes.back(), i);
  }
  for (size_t first = 0; first < ways.size(); ++first) {
    if (used[first]) continue;
    used[first] = true;
    Ring ring = ways[first]->line;
    const int64_t start = ways[first]->nodes.front();
    int64_t end = ways[first]->nodes.back();
    while (end != start) {
      const auto [low, high] = ends.equal_range(end);
      const auto next = std::find_if(low, high, [&](const auto& entry) { return !used[entry.second]; });
      if (next == high) break;
      const OsmWay& way = *ways[next->second];
      used[next->second] = true;
      const bool forward = way.nodes.front() == end;
      Ring line = way.line;
      if (!forward) std::reverse(line.begin(), line.end());
      ring.insert(ring.end(), line.begin() + 1, line.end());
      end = forward ? way.nodes.back() : way.nodes.front();
    }
    const Vec2d gap = ring.front() - ring.back();
    if (std::hypot(gap.x, gap.y) < 0.01) ring.pop_back();
    open = open || end != start;
    // Cut off at the edge of the extract: close what is nearly a ring, leave the rest.
    if (end != start && std::hypot(gap.x, gap.y) > 0.35 * std::sqrt(std::abs(SignedArea(ring)))) continue;
    if (ring.size() >= 3 && std::abs(SignedArea(ring)) > 0.02) rings.push_back(std::move(ring));
  }
  return rings;
}

Patches ToPatches(const std::vector<Ring>& outer, const std::vector<Ring>& inner) {
  Patches out, in;
  for (const Ring& ring : outer) out.push_back({ring, {}});
  for (const Ring& ring : inner) in.push_back({ring, {}});
  if (in.empty() && out.size() == 1) return Unite(out);
  return in.empty() ? Unite(out) : Subtract(out, in);
}

struct Rings {
  std::vector<Ring> outer, inner;
  bool broken = false;
};
Rings RingsOf(const OsmData& data, const OsmRelation& relation) {
  std::vector<const OsmWay*> outer, inner;
  bool whole = true, open = false;
  for (const OsmMember& member : relation.members) {
    if (member.type != 'w') continue;
    const OsmWay* way = data.FindWay(member.id);
    whole = whole && way && way->whole;
    if (!way || way->nodes.size() < 2) continue;
    if (member.role == "inner") inner.push_back(way);
    if (member.role == "outer" || member.role.empty()) outer.push_back(way);
  }
  Rings rings{JoinWays(std::move(outer), open), JoinWays(std::move(inner), open)};
  rings.broken = whole && open;
  return rings;
}

// Tags that make a relation a thing of its own.
bool SaysWhat(const OsmTags& tags) {
  return std::any_of(tags.all().begin(), tags.all().end(), [](const auto& tag) {
    return tag.first != "type" && tag.first != "source" && tag.first != "note" && tag.first != "created_by";
  });
}

void Measure(OsmArea& area) {
  area.area = Area(area.patches);
  for (const Patch& patch : area.patches)
    for (Vec2d p : patch.outer) area.bounds.Add(p);
}

}  // namespace

std::string OsmId(const char* kind, int64_t id) { return std::string(kind) + "/" + std::to_string(id); }

std::vector<OsmArea> FindAreas(const OsmData& data) {
  std::vector<OsmArea> areas;
  std::map<int64_t, std::vector<Ring>> holes;  // of ways that carry the tags of a multipolygon
  for (const OsmRelation& relation : data.relations) {
    if (!relation.tags.Is("type", "multipolygon") || SaysWhat(relation.tags)) continue;
    const Rings rings = RingsOf(data, relation);
    for (const OsmMember& member : relation.members) {
      const OsmWay* way = member.type == 'w' && member.role != "inner" ? data.FindWay(member.id) : nullptr;
      if (way && way->closed() && !way->tags.empty()) holes[way->id] = rings.inner;
    }
  }
  for (const OsmWay& way : data.ways) {
    if (!way.closed() || way.tags.empty()) continue;
    OsmArea area{OsmId("way", way.id), way.id, false, &way.tags, {}, 0, {}};
    Ring ring = way.line;
    ring.pop_back();
    const auto inner = holes.find(way.id);
    area.patches = ToPatches({ring}, inner == holes.end() ? std::vector<Ring>() : inner->second);
    Measure(area);
    areas.push_back(std::move(area));
  }
  for (const OsmRelation& relation : data.relations) {
    const bool polygon =
        relation.tags.Is("type", "multipolygon") || (relation.tags.Has("building") && !relation.tags.Is("type", "building"));
    if (!polygon || !SaysWhat(relation.tags)) continue;
    OsmArea area{OsmId("relation", relation.id), relation.id, true, &relation.tags, {}, 0, {}};
    const Rings rings = RingsOf(data, relation);
    if (!rings.outer.empty()) area.patches = ToPatches(rings.outer, rings.inner);
    area.broken = rings.broken;
    Measure(area);
    areas.push_back(std::move(area));
  }
  return areas;
}

}  // namespace airsim360::internal

#include "airsim360/people/navigation/tile_regions.h"

#include <recastnavigation/Recast.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "airsim360/people/navigation/navmesh.h"

namespace airsim360::internal {
namespace {

// A span and its column; span -1: none.
struct SpanPlace {
  int x = 0, y = 0, span = -1;
};

/// Regions and kinds of ground of the spans of a tile, and who is beside whom.
class Patchwork {
 public:
  explicit Patchwork(rcCompactHeightfield& tile) : tile_(tile) {}

  // Every span in turn.
  template <class Visit>
  void EachSpan(const Visit& visit) const {
    for (int y = 0; y < tile_.height; ++y)
      for (int x = 0; x < tile_.width; ++x) {
        const rcCompactCell& cell = tile_.cells[x + y * tile_.width];
        for (size_t i = cell.index; i < size_t{cell.index} + cell.count; ++i) visit(SpanPlace{x, y, static_cast<int>(i)});
      }
  }
  int span_count() const { return tile_.spanCount; }
  SpanPlace At(SpanPlace from, int side) const {
    if (from.span < 0) return from;
    const int x = from.x + rcGetDirOffsetX(side), y = from.y + rcGetDirOffsetY(side);
    const int connection = rcGetCon(tile_.spans[from.span], side);
    if (connection == RC_NOT_CONNECTED) return {x, y, -1};
    return {x, y, static_cast<int>(tile_.cells[x + y * tile_.width].index) + connection};
  }
  unsigned char& KindOf(SpanPlace place) const { return tile_.areas[place.span]; }
  int RegionOf(SpanPlace place) const { return place.span < 0 ? 0 : tile_.spans[place.span].reg; }
  // One that is not the border of the tile.
  bool HasRegion(SpanPlace place) const { return RegionOf(place) != 0 && (RegionOf(place) & RC_BORDER_REG) == 0; }

  // Whether its column has another span of that region: it may not join it then, for the outline of a region that lies above
  // itself (a spiral stair, a ramp) cannot be filled.
  bool LiesAboveItself(SpanPlace place, int region) const {
    const rcCompactCell& cell = tile_.cells[place.x + place.y * tile_.width];
    for (size_t i = cell.index; i < size_t{cell.index} + cell.count; ++i)
      if (static_cast<int>(i) != place.span && tile_.spans[i].reg == region) return true;
    return false;
  }

  // Whether it may leave its region: what is left of that hangs together round it.
  bool CanGive(SpanPlace place) const {
    if (!HasRegion(place)) return false;
    const int region = RegionOf(place);
    std::array<bool, 8> same{};
    for (int side = 0; side < 4; ++side) {
      const SpanPlace beside = At(place, side), around = At(beside, (side + 1) & 3);
      same[static_cast<size_t>(2 * side)] = RegionOf(beside) == region;
      same[static_cast<size_t>(2 * side + 1)] = RegionOf(around) == region;
    }
    // Its neighbours that are of the region and not joined to the next one round the corner end a run of them.
    int beside = 0, ends = 0;
    for (size_t k = 0; k < 8; k += 2) {
      if (!same[k]) continue;
      ++beside;
      ends += !(same[(k + 1) & 7] && same[(k + 2) & 7]);
    }
    return beside > 0 && ends <= 1;
  }
  void Give(SpanPlace place, SpanPlace to) const {
    tile_.spans[place.span].reg = tile_.spans[to.span].reg;
    KindOf(place) = KindOf(to);
  }

  void Leave(SpanPlace place) const { tile_.spans[place.span].reg = 0; }

  bool TakeIn(SpanPlace stray) const {
    if (RegionOf(stray) != 0 || KindOf(stray) == RC_NULL_AREA) return false;
    SpanPlace best;
    for (int side = 0; side < 4; ++side) {
      const SpanPlace beside = At(stray, side);
      if (!HasRegion(beside) || LiesAboveItself(stray, RegionOf(beside))) continue;
      const bool same = KindOf(beside) == KindOf(stray);
      if (best.span < 0 || (same && KindOf(best) != KindOf(stray))) best = beside;
    }
    if (best.span >= 0) Give(stray, best);
    return best.span >= 0;
  }

  // The corner between a span and those on `side` and on the next one.
  bool PartCorner(SpanPlace own, int side) const {
    if (!HasRegion(own)) return false;
    const int region = RegionOf(own), next = (side + 1) & 3;
    const SpanPlace a = At(own, side), b = At(own, next);
    SpanPlace across = At(a, next);
    if (across.span < 0) across = At(b, side);
    const int of_a = RegionOf(a), of_b = RegionOf(b);
    if (RegionOf(across) != region || of_a == region || of_b == region || of_a == of_b) return false;
    for (const SpanPlace beside : {a, b}) {
      if (!CanGive(beside) || LiesAboveItself(beside, region)) continue;
      Give(beside, own);
      return true;
    }
    const SpanPlace other = HasRegion(a) ? a : b;
    for (const SpanPlace mine : {own, across}) {
      if (!HasRegion(other) || !CanGive(mine) || LiesAboveItself(mine, RegionOf(other))) continue;
      Give(mine, other);
      return true;
    }
    return false;
  }

 private:
  rcCompactHeightfield& tile_;
};

}  // namespace

void JoinSpecks(int least, rcCompactHeightfield& tile) {
  const Patchwork patchwork(tile);
  std::vector<bool> seen(static_cast<size_t>(patchwork.span_count()));
  std::vector<SpanPlace> patch;
  patchwork.EachSpan([&](SpanPlace start) {
    const unsigned char kind = patchwork.KindOf(start);
    if (kind == RC_NULL_AREA || seen[static_cast<size_t>(start.span)]) return;
    patch.assign(1, start);
    seen[static_cast<size_t>(start.span)] = true;
    std::array<int, static_cast<size_t>(GroundKind::kCount)> around{};
    for (size_t k = 0; k < patch.size(); ++k)
      for (int side = 0; side < 4; ++side) {
        const SpanPlace beside = patchwork.At(patch[k], side);
        if (beside.span < 0) continue;
        const unsigned char other = patchwork.KindOf(beside);
        if (other != kind) ++around[other];
        if (other != kind || seen[static_cast<size_t>(beside.span)]) continue;
        seen[static_cast<size_t>(beside.span)] = true;
        patch.push_back(beside);
      }
    around[RC_NULL_AREA] = 0;
    const auto most = std::ranges::max_element(around);
    if (static_cast<int>(patch.size()) >= least || *most == 0) return;
    for (const SpanPlace place : patch) patchwork.KindOf(place) = static_cast<unsigned char>(most - around.begin());
  });
}

void TakeInStrays(int least, rcCompactHeightfield& tile) {
  const Patchwork patchwork(tile);
  std::map<int, int> cells;
  patchwork.EachSpan([&](SpanPlace place) { ++cells[patchwork.RegionOf(place)]; });
  patchwork.EachSpan([&](SpanPlace place) {
    if (patchwork.HasRegion(place) && cells[patchwork.RegionOf(place)] < least) patchwork.Leave(place);
  });
  bool changed = true;
  while (changed) {
    changed = false;
    patchwork.EachSpan([&](SpanPlace place) { changed |= patchwork.TakeIn(place); });
  }
}

void PartCorners(rcCompactHeightfield& tile) {
  constexpr int kPasses = 8;  // a cell that changes sides may touch another one at a corner
  const Patchwork patchwork(tile);
  bool changed = true;
  for (int pass = 0; pass < kPasses && changed; ++pass) {
    changed = false;
    patchwork.EachSpan([&](SpanPlace place) {
      for (int side = 0; side < 4; ++side) changed |= patchwork.PartCorner(place, side);
    });
  }
}

}  // namespace airsim360::internal

#include "airsim360/worlds/sf_city/hills.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

constexpr float kPavement = 4, kTransition = 8;

float Smooth(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

struct Hill {
  float x, y, height, radius;
};
constexpr Hill kHills[] = {{-290, 240, 64, 135},     {312, 262, 58, 102},    {-350, -270, 34, 105},  {-1700, 250, 260, 420},
                           {-1500, -1100, 150, 450}, {100, -1800, 120, 480}, {-700, -2300, 210, 600}};

// Level across every street, steeper between them: the coordinate that the hills see. It keeps the centre lines.
float Graded(const std::vector<StreetLine>& lines, float pavement, float x) {
  for (size_t i = 0; i + 1 < lines.size(); ++i) {
    const StreetLine &a = lines[i], &b = lines[i + 1];
    if (x < a.center || x >= b.center) continue;
    const float from = a.center + a.half_width + pavement, to = b.center - b.half_width - pavement, run = to - from - kTransition;
    // Integral of a weight that rises from 0 to 1 and falls again within kTransition.
    const auto rise = [](float t) { return kTransition * (t * t * t - t * t * t * t / 2); };
    float sum = 0;
    if (x > from) sum += rise(std::min(1.0f, (x - from) / kTransition));
    if (x > from + kTransition) sum += std::min(x, to - kTransition) - from - kTransition;
    if (x > to - kTransition) sum += kTransition / 2 - rise(1 - std::min(1.0f, (x - to + kTransition) / kTransition));
    return a.center + (b.center - a.center) * sum / run;
  }
  // Beyond the outermost streets the ground goes on from their pavements.
  const float low = lines.front().center, high = lines.back().center, before = lines.front().half_width + pavement,
              behind = lines.back().half_width + pavement;
  return x < low ? std::min(low, x + before) : std::max(high, x - behind);
}

// How far the streets of the hills stray from the grid.
Vec2f Bend(Vec2f p) {
  const float edge = (1 - Smooth(480, 640, std::abs(p.x))) * (1 - Smooth(400, 600, std::abs(p.y)));
  const float west = Smooth(-130, -300, p.x) * Smooth(-250, -120, p.y);
  const float dx = p.x - 300, dy = p.y - 255, east = std::exp(-(dx * dx + dy * dy) / (2 * 90.0f * 90.0f));
  return {edge * (13 * west * std::sin(0.0209f * p.y + 0.6f) + 8 * east * std::sin(0.026f * p.y)),
          edge * (11 * west * std::sin(0.0203f * p.x + 1.0f) + 7 * east * std::sin(0.026f * p.x))};
}

std::vector<float> LatticeLines() {
  std::vector<float> lines;
  for (float x = -kLatticeEdge; x <= kLatticeEdge; x += 4) lines.push_back(x);
  std::vector<float> out;
  float step = 8;
  for (float x = kLatticeEdge; x < kWorldEdge; step = std::min(step * 1.25f, 900.0f)) {
    x += step;
    out.push_back(x);
  }
  for (float x : out) lines.push_back(x);
  std::reverse(out.begin(), out.end());
  std::vector<float> all;
  for (float x : out) all.push_back(-x);
  all.insert(all.end(), lines.begin(), lines.end());
  return all;
}

}  // namespace

StreetPlan PlanSfCity() {
  StreetPlan plan;
  plan.first_core = 1;
  plan.last_core = 7;
  plan.north_south = {{-488, 6.2f}, {-366, 6.2f}, {-244, 6.6f}, {-122, 6.2f}, {0, 13, StreetKind::kAvenue},
                      {130, 6.8f},  {252, 6.8f},  {374, 6.2f},  {496, 6.2f}};
  plan.east_west = {{-368, 6.2f}, {-276, 6.5f}, {-184, 6.5f}, {-96, 6.5f}, {0, 13, StreetKind::kAvenue},
                    {96, 6.2f},   {188, 6.2f},  {280, 6.2f},  {372, 6.2f}};
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) {
      const StreetLine &west = plan.north_south[static_cast<size_t>(column)], &east = plan.north_south[static_cast<size_t>(column + 1)];
      const StreetLine &south = plan.east_west[static_cast<size_t>(row)], &north = plan.east_west[static_cast<size_t>(row + 1)];
      Block block;
      block.column = column;
      block.row = row;
      block.pavement = kPavement;
      block.kerb = {west.center + west.half_width, south.center + south.half_width, east.center - east.half_width,
                    north.center - north.half_width};
      if (column < 1 || column > 6 || row < 1 || row > 6) block.kind = BlockKind::kBackdrop;
      if (QuarterOf(block) == Quarter::kLake) block.kind = BlockKind::kPark;
      if (QuarterOf(block) == Quarter::kHillPark) block.kind = BlockKind::kPlaza;
      plan.blocks.push_back(block);
    }
  }
  return plan;
}

Quarter QuarterOf(const Block& block) {
  const int c = block.column, r = block.row;
  if (c == 3 && r == 3) return Quarter::kLake;
  if (c == 3 && r == 4) return Quarter::kHillPark;
  if ((c >= 4 && r <= 3) || (c == 3 && r <= 2)) return Quarter::kTowers;
  if (r == 4 && (c == 4 || c == 5)) return Quarter::kShops;
  return Quarter::kHouses;
}

Hills::Hills(const StreetPlan& plan)
    : ns_(plan.north_south),
      ew_(plan.east_west),
      pavement_(plan.blocks.front().pavement),
      scale_(kSteepest / SteepestStreet(plan)),
      drape_(LatticeLines(), LatticeLines(), [this](Vec2f p) { return Ground(p); }) {}

// Without the scale that makes the steepest street as steep as it shall be.
float Hills::Raw(Vec2f p) const {
  const Vec2f q{Graded(ns_, pavement_, p.x), Graded(ew_, pavement_, p.y)};
  float h = 0;
  for (const Hill& hill : kHills) {
    const float dx = q.x - hill.x, dy = q.y - hill.y;
    h += hill.height * std::exp(-(dx * dx + dy * dy) / (2 * hill.radius * hill.radius));
  }
  // The lake lies in a level hollow.
  const float ox = std::max(0.0f, std::abs(q.x + 61) - 61), oy = std::max(0.0f, std::abs(q.y + 48) - 48);
  return h * Smooth(0, 100, std::hypot(ox, oy));
}

float Hills::Height(Vec2f p) const {
  const float sea = Smooth(0, 140, std::max(p.x - 640, p.y - 560));
  return scale_ * Raw(p) - 9 * sea;
}

Vec3f Hills::Ground(Vec2f p) const {
  const Vec2f b = Bend(p);
  return {p.x + b.x, p.y + b.y, Height(p)};
}

float Hills::SteepestStreet(const StreetPlan& plan) const {
  float most = 1e-6f;
  const auto measure = [&](Vec2f p, Vec2f along) { most = std::max(most, std::abs(Raw(p + along) - Raw(p - along)) / 2); };
  for (const StreetLine& line : plan.north_south)
    for (float y = plan.east_west[1].center; y < plan.east_west[7].center; y += 1) measure({line.center, y}, {0, 1});
  for (const StreetLine& line : plan.east_west)
    for (float x = plan.north_south[1].center; x < plan.north_south[7].center; x += 1) measure({x, line.center}, {1, 0});
  return most;
}

}  // namespace airsim360::internal

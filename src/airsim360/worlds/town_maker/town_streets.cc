#include "airsim360/worlds/town_maker/town_streets.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

class Planner {
 public:
  Planner(const TownSpec& spec, RngStream& rng) : spec_(spec), rng_(rng) {}

  StreetNet Run() {
    switch (spec_.plan) {
      case TownPlan::kGrid:
        Lattice(spec_.block * 1.3, spec_.block * 0.85, 0.06, 0, 0);
        break;
      case TownPlan::kOrganic:
        Lattice(spec_.block, spec_.block, 0.17, 0.42, 0.2);
        break;
      case TownPlan::kRadial:
        Radial();
        break;
      case TownPlan::kLinear:
        Linear(true);
        break;
      case TownPlan::kScattered:
        Linear(false);
        break;
    }
    return std::move(net_);
  }

 private:
  size_t Node(Vec2d p) {
    net_.nodes.push_back(p);
    return net_.nodes.size() - 1;
  }
  void Edge(size_t a, size_t b, int rank, std::vector<Vec2d> bends = {}) { net_.edges.push_back({a, b, std::move(bends), rank}); }

  // Rows and columns of nodes over the rectangle and beyond it; `jitter` and `warp` in pitches; a share `lost` of the
  // inner edges is left out.
  void Lattice(double px, double py, double jitter, double warp, double lost) {
    const int nx = std::max(2, static_cast<int>(std::lround(spec_.width / px))),
              ny = std::max(2, static_cast<int>(std::lround(spec_.depth / py)));
    const double phase[4] = {rng_.Uniform(0, 6.28), rng_.Uniform(0, 6.28), rng_.Uniform(0, 6.28), rng_.Uniform(0, 6.28)};
    const auto columns = static_cast<size_t>(nx) + 2, rows = static_cast<size_t>(ny) + 2;
    std::vector<double> dx(columns), dy(rows);
    const bool straight = warp == 0;
    for (double& d : dx) d = rng_.Uniform(-jitter, jitter) * px;
    for (double& d : dy) d = rng_.Uniform(-jitter, jitter) * py;
    for (size_t k = 0; k < rows; ++k)
      for (size_t i = 0; i < columns; ++i) {
        Vec2d p{(static_cast<double>(i) - 0.5 * static_cast<double>(columns - 1)) * px + dx[i],
                (static_cast<double>(k) - 0.5 * static_cast<double>(rows - 1)) * py + dy[k]};
        if (!straight) {
          const double u = p.x / px, v = p.y / py;
          p.x +=
              px * (warp * std::sin(1.9 * v + phase[0]) * 0.6 + warp * 0.4 * std::sin(1.1 * u + phase[1]) + rng_.Uniform(-jitter, jitter));
          p.y +=
              py * (warp * std::sin(1.7 * u + phase[2]) * 0.6 + warp * 0.4 * std::sin(1.3 * v + phase[3]) + rng_.Uniform(-jitter, jitter));
        }
        Node(p);
      }
    const auto id = [&](size_t i, size_t k) { return k * columns + i; };
    std::vector<int> degree(net_.nodes.size(), 4);
    const size_t mid_row = rows / 2, mid_column = columns / 2;
    const auto link = [&](size_t a, size_t b, int rank) {
      const bool keep = rank == 0 || degree[a] < 4 || degree[b] < 4 || !rng_.Chance(lost);
      if (keep) return Edge(a, b, rank);
      --degree[a];
      --degree[b];
    };
    for (size_t k = 0; k < rows; ++k)
      for (size_t i = 0; i < columns; ++i) {
        if (i + 1 < columns && k > 0 && k + 1 < rows) link(id(i, k), id(i + 1, k), k == mid_row ? 0 : LaneRank());
        if (k + 1 < rows && i > 0 && i + 1 < columns) link(id(i, k), id(i, k + 1), i == mid_column ? 0 : LaneRank());
      }
  }

  // In old towns every third street is too narrow for cars.
  int LaneRank() { return spec_.street < 8.5 && rng_.Chance(0.35) ? 2 : 1; }

  void Radial() {
    const double reach = std::hypot(spec_.width, spec_.depth) / 2 + spec_.block;
    std::vector<std::vector<size_t>> rings;
    int spokes = 8;
    const double turn = rng_.Uniform(0, 0.4);
    for (double r = std::max(34.0, spec_.block * 0.6); r < reach; r += spec_.block) {
      // Spokes that would be far apart get another between them.
      if (6.283 * r / spokes > 2.1 * spec_.block) spokes *= 2;
      std::vector<size_t> ring;
      for (int j = 0; j < spokes; ++j) {
        const double a = turn + 6.283185 * j / spokes;
        ring.push_back(Node({r * std::cos(a), r * std::sin(a)}));
      }
      for (int j = 0; j < spokes; ++j) {
        const auto next = static_cast<size_t>((j + 1) % spokes);
        std::vector<Vec2d> bends;
        for (int n = 1; n < 4; ++n) {
          const double a = turn + 6.283185 * (j + n / 4.0) / spokes;
          bends.push_back({r * std::cos(a), r * std::sin(a)});
        }
        Edge(ring[static_cast<size_t>(j)], ring[next], rings.empty() ? 0 : LaneRank(), bends);
      }
      if (!rings.empty()) {
        const size_t before = rings.back().size(), step = ring.size() / before;
        for (size_t j = 0; j < before; ++j) Edge(rings.back()[j], ring[j * step], j * 4 % before == 0 ? 0 : LaneRank());
      }
      rings.push_back(std::move(ring));
    }
  }

  // One road through the town with lanes to both sides; `back`: lanes behind it join them.
  void Linear(bool back) {
    const double pitch = spec_.block, a = 0.07 * spec_.depth, phase = rng_.Uniform(0, 6.28), reach = spec_.width / 2 + 2 * pitch;
    const auto road = [&](double x) { return a * std::sin(x / (0.28 * spec_.width) + phase) - a * std::sin(phase); };
    std::vector<size_t> main;
    for (double x = -reach; x <= reach; x += pitch) main.push_back(Node({x, road(x)}));
    for (size_t i = 0; i + 1 < main.size(); ++i) {
      const double x = net_.nodes[main[i]].x;
      std::vector<Vec2d> bends;
      for (int n = 1; n < 4; ++n) bends.push_back({x + pitch * n / 4, road(x + pitch * n / 4)});
      Edge(main[i], main[i + 1], 0, bends);
    }
    for (int side : {1, -1}) {
      size_t before = SIZE_MAX;
      for (size_t i = 1; i + 1 < main.size(); ++i) {
        const Vec2d p = net_.nodes[main[i]];
        const bool lane = back ? true : (static_cast<int>(i) + side) % 3 == 0;
        if (!lane) continue;
        const double length = std::min(spec_.depth * (back ? 0.26 : 0.33), back ? 1.1 * pitch : 2.2 * pitch);
        const double lean = rng_.Uniform(-0.18, 0.18) * length;
        const Vec2d bend{p.x + 0.35 * lean, p.y + side * length * 0.5}, tip{p.x + lean, p.y + side * length};
        const size_t end = Node(tip);
        Edge(main[i], end, 1, {bend});
        if (back && before != SIZE_MAX && rng_.Chance(0.8)) Edge(before, end, 1);
        before = end;
      }
    }
  }

  const TownSpec& spec_;
  RngStream& rng_;
  StreetNet net_;
};

}  // namespace

std::vector<Vec2d> StreetNet::LineOf(const StreetEdge& edge) const {
  std::vector<Vec2d> line{nodes[edge.a]};
  line.insert(line.end(), edge.bends.begin(), edge.bends.end());
  line.push_back(nodes[edge.b]);
  return line;
}

StreetNet PlanStreets(const TownSpec& spec, RngStream& rng) { return Planner(spec, rng).Run(); }

}  // namespace airsim360::internal

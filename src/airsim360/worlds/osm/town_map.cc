#include "airsim360/worlds/osm/town_map.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "airsim360/base/random.h"

namespace airsim360::internal {
namespace {

// Quantiles 0, 1/40, …, 1 of what real towns measure, counted over OpenStreetMap extracts ((c) OpenStreetMap
// contributors, ODbL 1.0; data/osm/distributions.csv): areas and heights of 1,520 buildings of New York's West
// Village.
constexpr double kAreas[] = {12.43,  39.91,  50.89,  57.48,  61.66,  65.56,  68.72,  71.84,  74.56, 77.14,  81,     84.21,  87.54,  90.28,
                             93.03,  95.5,   98.85,  102.24, 106.27, 109.76, 113.26, 119.54, 124.4, 132.11, 142.46, 149.85, 158.54, 166.48,
                             172.89, 180.02, 190.06, 204.49, 225.61, 248.21, 285.09, 332.37, 384.6, 497.22, 619.78, 932.37, 27507};
constexpr double kHeights[] = {2.7,  5.2,  7.34, 8.6,  9.7,   10.3, 10.7, 11,   11.2, 11.7, 11.9,  12.1,  12.4, 12.6,
                               12.8, 13.1, 13.3, 13.5, 13.7,  14,   14.2, 14.5, 14.8, 15.3, 15.8,  16.3,  16.6, 17,
                               17.3, 17.7, 18.1, 18.3, 18.64, 19.1, 19.7, 20.2, 20.8, 21.5, 24.12, 33.94, 69.4};

// Metres to the nearest other tree, of 117 in Berlin's Tiergarten.
constexpr double kTreeSpacing[] = {3.37, 4.14, 7.35, 7.92, 8.06, 8.06,  8.06, 8.06,  8.08,  8.16,  8.16,  8.16,  8.16, 8.17,
                                   8.39, 8.39, 8.4,  8.4,  8.4,  8.4,   8.4,  8.4,   8.41,  8.44,  9,     9.27,  9.33, 9.38,
                                   9.47, 9.48, 9.48, 9.83, 9.84, 10.24, 10.8, 13.23, 14.04, 17.56, 26.04, 29.17, 81.61};
constexpr int kColumns = 3, kRows = 6;
constexpr double kPavement = 3.6, kHalfStreet = 4.8, kHalfAvenue = 6.5;

// A draw from quantiles.
template <size_t N>
double Draw(const double (&quantiles)[N], double u) {
  const double at = u * (N - 1);
  const auto i = std::min(static_cast<size_t>(at), N - 2);
  return quantiles[i] + (quantiles[i + 1] - quantiles[i]) * (at - static_cast<double>(i));
}

class Drawer {
 public:
  explicit Drawer(uint64_t seed) : seed_(seed), rng_(seed, "town map") {}

  OsmData DrawMap() {
    // Streets every 64 to 80 m, avenues every 180 m or so.
    double x = 0, y = 0;
    for (int i = 0; i <= kColumns; ++i) {
      avenues_.push_back(x);
      x += rng_.Uniform(165, 200);
    }
    for (int i = 0; i <= kRows; ++i) {
      streets_.push_back(y);
      y += rng_.Uniform(64, 78);
    }
    const Vec2d middle{avenues_.back() / 2, streets_.back() / 2};
    for (double& a : avenues_) a -= middle.x;
    for (double& s : streets_) s -= middle.y;
    data_.origin = {40.7, -74.0, 0};
    data_.extent = {avenues_.front() - 12, streets_.front() - 12, avenues_.back() + 12, streets_.back() + 12};
    Streets();
    for (int c = 0; c < kColumns; ++c)
      for (int r = 0; r < kRows; ++r) Block(static_cast<size_t>(c), static_cast<size_t>(r));
    LightTheRest(RngStream(seed_, "town map lamps"));
    std::sort(data_.nodes.begin(), data_.nodes.end(), [](const OsmNode& a, const OsmNode& b) { return a.id < b.id; });
    return std::move(data_);
  }

 private:
  int64_t CrossingId(size_t i, size_t k) const { return static_cast<int64_t>(1 + i * 100 + k); }

  OsmTags Tags(std::initializer_list<std::pair<const char*, std::string>> list) {
    OsmTags tags;
    for (const auto& tag : list) tags.Add(tag.first, tag.second);
    return tags;
  }

  static OsmWay WayOf(int64_t id, OsmTags tags) {
    OsmWay way;
    way.id = id;
    way.tags = std::move(tags);
    return way;
  }

  static void Reverse(OsmWay& way) {
    std::ranges::reverse(way.nodes);
    std::ranges::reverse(way.line);
  }

  // Two-way around the town, inside one-way by turns: whoever drives comes round.
  void Streets() {
    for (size_t i = 0; i < avenues_.size(); ++i) {
      const bool outer = i == 0 || i + 1 == avenues_.size();
      OsmWay way = WayOf(static_cast<int64_t>(10 + i), Tags({{"highway", "secondary"},
                                                             {"name", "Avenue " + std::string(1, static_cast<char>('A' + i))},
                                                             {"width", "13"},
                                                             {"lanes", outer ? "4" : "3"},
                                                             {"oneway", outer ? "no" : "yes"}}));
      if (i == 1) way.tags.Add("cycleway", "lane");
      for (size_t k = 0; k < streets_.size(); ++k) {
        way.nodes.push_back(CrossingId(i, k));
        way.line.push_back({avenues_[i], streets_[k]});
        data_.nodes.push_back({CrossingId(i, k), way.line.back(), Tags({{"highway", "traffic_signals"}})});
      }
      if (i == 2) Reverse(way);
      data_.ways.push_back(std::move(way));
    }
    for (size_t k = 0; k < streets_.size(); ++k) {
      const bool outer = k == 0 || k + 1 == streets_.size();
      OsmWay way = WayOf(static_cast<int64_t>(50 + k), Tags({{"highway", "residential"},
                                                             {"name", "Street " + std::to_string(k + 1)},
                                                             {"width", "9.6"},
                                                             {"oneway", outer ? "no" : "yes"}}));
      for (size_t i = 0; i < avenues_.size(); ++i) {
        way.nodes.push_back(CrossingId(i, k));
        way.line.push_back({avenues_[i], streets_[k]});
      }
      if (k % 2 == 0) Reverse(way);
      data_.ways.push_back(std::move(way));
    }
  }

  void Node(Vec2d p, std::initializer_list<std::pair<const char*, std::string>> tags) {
    data_.nodes.push_back({next_node_++, p, Tags(tags)});
  }

  // Two rows of houses back to back, gardens between, trees and lamps before them.
  void Block(size_t c, size_t r) {
    const double x0 = avenues_[c] + kHalfAvenue + kPavement, x1 = avenues_[c + 1] - kHalfAvenue - kPavement;
    const double y0 = streets_[r] + kHalfStreet + kPavement, y1 = streets_[r + 1] - kHalfStreet - kPavement;
    if (c == 1 && r == 3) return Park(x0, y0, x1, y1);
    for (const bool south : {true, false}) {
      const double front = south ? y0 : y1, inward = south ? 1 : -1, deepest = (y1 - y0) * 0.5 - 2.5;
      double x = x0;
      double height = Draw(kHeights, rng_.Uniform());
      while (x < x1 - 3.5) {
        // Now and then a gap: a yard, a lane.
        if (x > x0 + 1 && rng_.Chance(0.05)) x += rng_.Uniform(2, 5);
        const double area = std::clamp(Draw(kAreas, 0.02 + 0.96 * rng_.Uniform()), 30.0, 900.0);
        double depth = std::min(deepest, std::max(7.0, rng_.Uniform(0.9, 1.35) * std::sqrt(area) * 1.25));
        double width = std::max(4.2, area / depth);
        if (x + width > x1 - 3.5) width = x1 - x;
        depth = std::clamp(area / width, 6.0, deepest);
        // Neighbours are often of one height.
        if (!rng_.Chance(0.25)) height = Draw(kHeights, 0.01 + 0.975 * rng_.Uniform());
        House(x, x + width, front, front + inward * depth, height);
        x += width;
      }
      Furnish(x0 + 4, x1 - 4, front - inward * (kPavement - 1.0), inward);
    }
  }

  void House(double x0, double x1, double front, double rear, double height) {
    OsmWay way = WayOf(next_way_++, Tags({{"building", "yes"}, {"height", std::to_string(height).substr(0, 5)}}));
    const double low = std::min(front, rear), high = std::max(front, rear);
    for (const Vec2d& p : {Vec2d{x0, low}, Vec2d{x1, low}, Vec2d{x1, high}, Vec2d{x0, high}, Vec2d{x0, low}}) {
      way.nodes.push_back(next_node_++);
      way.line.push_back(p);
    }
    way.nodes.back() = way.nodes.front();
    data_.ways.push_back(std::move(way));
  }

  // Planters keep one distance in a row; rows go through the real distribution evenly (golden section).
  double RowPitch() { return Draw(kTreeSpacing, 0.04 + 0.9 * std::fmod(0.38 + 0.6180339887 * ++rows_, 1.0)); }

  // A row of trees, lamps every 20 m on one side of the street.
  void Furnish(double x0, double x1, double y, double inward) {
    const double pitch = RowPitch();
    if (rng_.Chance(0.85))
      for (double x = x0 + rng_.Uniform(0, 6); x < x1; x += pitch + rng_.Uniform(0, 0.06))
        Node({x, y}, {{"natural", "tree"}, {"height", std::to_string(rng_.Uniform(5.5, 9.5)).substr(0, 4)}});
    if (inward > 0)
      for (double x = x0 + 2; x < x1; x += rng_.Uniform(18.6, 21.5)) Node({x, y - 0.45}, {{"highway", "street_lamp"}});
    Node({rng_.Uniform(x0, x1), y}, {{"emergency", "fire_hydrant"}});
    Node({rng_.Uniform(x0, x1), y}, {{"amenity", "waste_basket"}});
    if (rng_.Chance(0.3)) Node({rng_.Uniform(x0, x1), y}, {{"amenity", "post_box"}});
    if (rng_.Chance(0.4)) Node({rng_.Uniform(x0, x1), y}, {{"amenity", "bicycle_parking"}, {"capacity", "8"}});
  }

  // Lamps where no row of houses has brought them: along the avenues, before the garden and on the last street. After all else and
  // by numbers of their own, which leave the rest of the town as it is.
  void LightTheRest(RngStream rng) {
    constexpr double kGap = 0.55;
    const auto along_street = [&](size_t c, size_t k) {
      const double x1 = avenues_[c + 1] - kHalfAvenue - kPavement - 4;
      for (double x = avenues_[c] + kHalfAvenue + kPavement + 6; x < x1; x += rng.Uniform(19.4, 22))
        Node({x, streets_[k] + kHalfStreet + kGap}, {{"highway", "street_lamp"}});
    };
    along_street(1, 3);
    for (size_t c = 0; c < kColumns; ++c) along_street(c, kRows);
    // The lamps of the streets light the crossings.
    for (const double avenue : avenues_) {
      for (size_t k = 0; k + 1 < streets_.size(); ++k) {
        for (double y = streets_[k] + 21; y < streets_[k + 1] - 8; y += rng.Uniform(19.4, 22))
          Node({avenue + kHalfAvenue + kGap, y}, {{"highway", "street_lamp"}});
      }
    }
  }

  void Park(double x0, double y0, double x1, double y1) {
    OsmWay park = WayOf(next_way_++, Tags({{"leisure", "park"}, {"name", "Town Garden"}}));
    for (const Vec2d& p : {Vec2d{x0, y0}, Vec2d{x1, y0}, Vec2d{x1, y1}, Vec2d{x0, y1}, Vec2d{x0, y0}}) {
      park.nodes.push_back(next_node_++);
      park.line.push_back(p);
    }
    park.nodes.back() = park.nodes.front();
    data_.ways.push_back(std::move(park));
    OsmWay path = WayOf(next_way_++, Tags({{"highway", "footway"}}));
    for (int i = 0; i <= 12; ++i) {
      path.nodes.push_back(next_node_++);
      path.line.push_back({x0 + (x1 - x0) * i / 12, (y0 + y1) / 2 + 9 * std::sin(i * 0.52)});
    }
    data_.ways.push_back(std::move(path));
    for (double y : {y0 + 5, y1 - 5})
      for (double x = x0 + 5, pitch = RowPitch(); x < x1 - 4; x += pitch) Node({x, y}, {{"natural", "tree"}, {"height", "10"}});
    for (double x = x0 + 20; x < x1 - 15; x += 18)
      Node({x, (y0 + y1) / 2 + 9 * std::sin((x - x0) / (x1 - x0) * 6.24) + 2.2}, {{"amenity", "bench"}});
  }

  uint64_t seed_;
  RngStream rng_;
  OsmData data_;
  std::vector<double> avenues_, streets_;
  int64_t next_node_ = 10000, next_way_ = 1000;
  int rows_ = 0;
};

}  // namespace

OsmData DrawTownMap(uint64_t seed) { return Drawer(seed).DrawMap(); }

}  // namespace airsim360::internal

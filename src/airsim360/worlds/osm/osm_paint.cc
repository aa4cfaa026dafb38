// Paint on the carriageways: lines between lanes, stop lines, bike lanes, crosswalks.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "airsim360/worlds/kit/bicycle_sign.h"
#include "airsim360/worlds/osm/osm_streets.h"

namespace airsim360::internal {
namespace {

constexpr double kLift = 0.003, kCrossing = 3.2;

class Brush {
 public:
  Brush(OsmScene& scene, MeshBuilder& mesh, const std::vector<Vec2d>& line, double z) : scene_(scene), mesh_(mesh), line_(line), z_(z) {}
  void Use(Surface surface) { mesh_.SetMaterial(scene_.surfaces[surface]); }
  // How high the paint lies above the asphalt.
  void Lift(double lift) { lift_ = lift; }
  // A strip between s0 and s1 along the line, d0 and d1 to its left; follows bends and the ground.
  void Strip(double s0, double s1, double d0, double d1) {
    if (s1 - s0 < 0.05) return;
    std::vector<double> stops{s0};
    double s = 0;
    for (size_t i = 0; i + 1 < line_.size(); ++i) {
      s += std::hypot(line_[i + 1].x - line_[i].x, line_[i + 1].y - line_[i].y);
      if (s > s0 + 0.05 && s < s1 - 0.05) stops.push_back(s);
    }
    stops.push_back(s1);
    Vec2d l0{}, r0{};
    for (size_t i = 0; i < stops.size(); ++i) {
      // At a bend the side is that of the bisector.
      const Vec2d before = PointAt(line_, std::max(stops[i] - 0.02, 0.0)).along, after = PointAt(line_, stops[i] + 0.02).along;
      Vec2d along = before + after;
      const double norm = std::max(std::hypot(along.x, along.y), 1e-6);
      const double widen = std::min(2 / norm, 1.6);
      along = along * (1 / norm);
      const Vec2d side{-along.y * widen, along.x * widen}, p = PointAt(line_, stops[i]).p;
      const Vec2d l1 = p + side * d1, r1 = p + side * d0;
      if (i > 0) Quad(r0, r1, l1, l0);
      l0 = l1;
      r0 = r1;
    }
  }
  // The sign of a bicycle, for those who ride along the line (`way` +1) or against it.
  void Sign(double s, double d, double way, double scale) {
    const LinePoint at = PointAt(line_, s);
    const Vec2d along = at.along * way, left{-along.y, along.x}, o = at.p + Vec2d{-at.along.y, at.along.x} * d;
    for (const SignStroke& stroke : BicycleSign()) {
      const Vec2d a = Vec2d{stroke.from.x, stroke.from.y} * scale, b = Vec2d{stroke.to.x, stroke.to.y} * scale;
      const Vec2d v = b - a, n = Vec2d{-v.y, v.x} * (kSignStroke / 2.0 / std::hypot(v.x, v.y));
      const auto place = [&](Vec2d p) { return o + along * p.x + left * p.y; };
      Quad(place(a - n), place(b - n), place(b + n), place(a + n));
    }
  }
  void Quad(Vec2d a, Vec2d b, Vec2d c, Vec2d d) {
    if (!scene_.data.extent.Contains(a, 29) || !scene_.data.extent.Contains(c, 29)) return;
    if (!scene_.relief.flat()) {
      scene_.Drape(mesh_, a, b, c, z_ + lift_, PlainUv);
      scene_.Drape(mesh_, a, c, d, z_ + lift_, PlainUv);
      return;
    }
    const auto at = [&](Vec2d p) { return scene_.On(p, z_ + lift_); };
    mesh_.QuadUv(at(a), at(b), at(c), at(d), PlainUv(a), PlainUv(b), PlainUv(c), PlainUv(d));
  }

 private:
  OsmScene& scene_;
  MeshBuilder& mesh_;
  const std::vector<Vec2d>& line_;
  double z_, lift_ = kLift;
};

void Zebra(Brush& brush, double s, double half, double width) {
  const int bars = std::max(2, static_cast<int>((2 * half - 0.6) / 1.1));
  for (int i = 0; i < bars; ++i) {
    const double d = -half + 0.3 + (2 * half - 0.6) * (i + 0.25) / bars;
    brush.Strip(s - width / 2, s + width / 2, d, d + (2 * half - 0.6) * 0.5 / bars);
  }
}

// The ground of the lanes for bicycles, between the bays and the lanes for cars.
void PaintGreen(Brush& brush, const Carriageway& way, double a, double b) {
  constexpr double kInside = 0.1;  // of the lane's edges, for the lines
  brush.Use(Surface::kBikeLane);
  brush.Lift(kLift / 2);  // below signs and crossings
  if (way.bikes[1]) brush.Strip(a, b, -way.edge + kInside, -way.edge + kCycleLane - kInside);
  if (way.bikes[0]) brush.Strip(a, b, way.edge - kCycleLane + kInside, way.edge - kInside);
  brush.Lift(kLift);
}

// The line towards the cars and the signs of a lane for bicycles on one side (+1: left).
void PaintSigns(Brush& brush, const RoadSegment& segment, double side, double edge, double a, double b) {
  constexpr double kEvery = 24, kFirst = 7, kSize = 0.8;  // metres, and of the sign
  const double inner = side * (edge - kCycleLane + 0.05), middle = side * (edge - kCycleLane / 2);
  brush.Strip(a, b, inner - 0.05, inner + 0.05);
  const double way = side > 0 && !segment.oneway ? -1 : 1;
  for (double s = a + kFirst; s < b - kFirst; s += kEvery) brush.Sign(way > 0 ? s : s + 2, middle, way, kSize);
}

}  // namespace

bool HasSignals(const OsmData& data, int64_t id) {
  const OsmNode* node = data.FindNode(id);
  return node && node->tags.Is("highway", "traffic_signals");
}

void PaintSegment(OsmScene& scene, MeshBuilder& mesh, const RoadGraph& graph, const RoadSegment& segment, double z) {
  const double length = segment.Length(), s0 = segment.start + 0.3, s1 = length - segment.end - 0.3;
  if (s1 - s0 < 6 || !HasPaint(segment)) return;
  SemanticTree& tree = scene.builder.tree();
  Brush brush(scene, mesh, segment.line, z);
  const Carriageway way = CarriagewayOf(segment);
  const double edge = way.edge, middle = segment.oneway ? 0 : way.shift;
  // Crossings keep 5 m of the ends to themselves where signals stand.
  const double keep = 5.2;
  const bool stop0 = HasSignals(scene.data, graph.nodes[segment.from].id), stop1 = HasSignals(scene.data, graph.nodes[segment.to].id);
  const double a = s0 + (stop0 ? keep : 0), b = s1 - (stop1 ? keep : 0);
  if ((way.bikes[0] || way.bikes[1]) && b - a >= 4) {
    mesh.SetEntity(scene.builder.AddEntity(segment.id + "/bike_lane", tree.At("ground/bike_lane")));
    PaintGreen(brush, way, a, b);
  }
  mesh.SetEntity(scene.builder.AddEntity(segment.id + "/markings", tree.At("ground/lane_marking")));
  if (b - a < 4) return;
  const bool divided = !segment.oneway && segment.lanes >= 2;
  if (divided) {
    brush.Use(scene.europe ? Surface::kPaintWhite : Surface::kPaintYellow);
    if (scene.europe || segment.rank >= 4) {
      for (double s = a; s + 3 < b; s += scene.europe ? 9 : 6) brush.Strip(s, s + 3, middle - 0.06, middle + 0.06);
    } else {
      brush.Strip(a, b, middle + 0.08, middle + 0.2);
      brush.Strip(a, b, middle - 0.2, middle - 0.08);
    }
  }
  // Dashes between lanes of one direction.
  brush.Use(Surface::kPaintWhite);
  for (int i = 1; i < way.lanes; ++i) {
    const double d = -way.width / 2 + way.width * i / way.lanes + way.shift;
    if (divided && std::abs(d - middle) < 1) continue;
    for (double s = a + 1; s + 3 < b; s += 9) brush.Strip(s, s + 3, d - 0.06, d + 0.06);
  }
  for (const double side : {-1.0, 1.0}) {
    const bool bikes = way.bikes[side > 0 ? 0 : 1];
    if (way.parking > 0 && (segment.rank <= 3 || bikes)) brush.Strip(a, b, side * edge - 0.05, side * edge + 0.05);
    if (bikes) PaintSigns(brush, segment, side, edge, a, b);
  }
  // Stop lines before the crossings of signals.
  if (stop1) brush.Strip(b, b + 0.4, -edge, segment.oneway ? edge : middle - 0.25);
  if (stop0 && !segment.oneway) brush.Strip(a - 0.4, a, middle + 0.25, edge);
}

void PaintCrossings(OsmScene& scene, MeshBuilder& mesh, const RoadGraph& graph, double z) {
  const CategoryId crosswalk = scene.builder.tree().At("ground/crosswalk");
  // Where nodes of ways lie: segment and distance.
  std::set<int64_t> mapped;
  for (const OsmNode& node : scene.data.nodes)
    if (node.tags.Is("highway", "crossing")) mapped.insert(node.id);
  const bool any = mapped.size() * 4 > graph.nodes.size() / 2;
  for (const RoadSegment& segment : graph.segments) {
    if (segment.half < 1.8) continue;
    const double length = segment.Length();
    // Crossings that the map places on this segment.
    double s = 0;
    const auto& nodes = segment.way->nodes;
    Brush brush(scene, mesh, segment.line, z);
    for (size_t k = 0; k < segment.line.size(); ++k) {
      if (k > 0) s += std::hypot(segment.line[k].x - segment.line[k - 1].x, segment.line[k].y - segment.line[k - 1].y);
      for (size_t n = 0; n < nodes.size(); ++n) {
        if (!(segment.way->line[n] == segment.line[k]) || !mapped.contains(nodes[n])) continue;
        const double at = std::clamp(s, std::min(segment.start + 2, length / 2), std::max(length - segment.end - 2, length / 2));
        mesh.SetEntity(scene.builder.AddEntity(OsmId("node", nodes[n]), crosswalk));
        brush.Use(Surface::kPaintWhite);
        Zebra(brush, at, segment.half, kCrossing);
        mapped.erase(nodes[n]);
      }
    }
    if (any || segment.rank > 4 || segment.rank == 0) continue;
    for (const bool at_start : {true, false}) {
      const RoadNode& node = graph.nodes[at_start ? segment.from : segment.to];
      if (node.arms.size() < 3 || !HasSignals(scene.data, node.id) || length - segment.start - segment.end < 12) continue;
      mesh.SetEntity(scene.builder.AddEntity(segment.id + "/crosswalk", crosswalk));
      brush.Use(Surface::kPaintWhite);
      Zebra(brush, at_start ? segment.start + 2.2 : length - segment.end - 2.2, segment.half, kCrossing);
    }
  }
}

}  // namespace airsim360::internal

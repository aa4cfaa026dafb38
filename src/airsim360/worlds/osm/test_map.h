// Small maps written by tests: metres east and north of 45 N, 7 E in, OpenStreetMap XML out.
#pragma once

#include <cctype>
#include <cstdio>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/math/vector.h"
#include "airsim360/worlds/osm/osm_world.h"

namespace airsim360::internal {

class TestMap {
 public:
  using Tags = std::initializer_list<std::pair<const char*, std::string>>;
  /// `half_x` and `half_y`: of the box in the header; 0 = no box.
  explicit TestMap(double half_x = 0, double half_y = 0) {
    if (half_x > 0) Bounds({-half_x, -half_y}, {half_x, half_y});
  }
  void Bounds(Vec2d low, Vec2d high) {
    text_ +=
        "<bounds minlat='" + Lat(low.y) + "' minlon='" + Lon(low.x) + "' maxlat='" + Lat(high.y) + "' maxlon='" + Lon(high.x) + "'/>\n";
  }
  int Node(Vec2d p, Tags tags = {}) {
    nodes_ += "<node id='" + std::to_string(++node_) + "' version='1' lat='" + Lat(p.y) + "' lon='" + Lon(p.x) + "'>" + TagText(tags) +
              "</node>\n";
    return node_;
  }
  /// A way over nodes that are there (or, with an id that was never given, missing).
  int WayOf(const std::vector<int>& nodes, Tags tags) {
    ways_ += "<way id='" + std::to_string(++way_) + "' version='1'>";
    for (int id : nodes) ways_ += "<nd ref='" + std::to_string(id) + "'/>";
    ways_ += TagText(tags) + "</way>\n";
    return way_;
  }
  int Line(const std::vector<Vec2d>& points, Tags tags) {
    std::vector<int> nodes;
    for (Vec2d p : points) nodes.push_back(Node(p));
    return WayOf(nodes, tags);
  }
  int Ring(const std::vector<Vec2d>& points, Tags tags) {
    std::vector<int> nodes;
    for (Vec2d p : points) nodes.push_back(Node(p));
    nodes.push_back(nodes.front());
    return WayOf(nodes, tags);
  }
  int Box(Vec2d low, Vec2d high, Tags tags) { return Ring({low, {high.x, low.y}, high, {low.x, high.y}}, tags); }
  int Relation(const std::vector<std::pair<int, const char*>>& ways, Tags tags) {
    relations_ += "<relation id='" + std::to_string(++relation_) + "' version='1'>";
    for (const auto& way : ways) relations_ += "<member type='way' ref='" + std::to_string(way.first) + "' role='" + way.second + "'/>";
    relations_ += TagText(tags) + "</relation>\n";
    return relation_;
  }
  std::string Text() const { return "<osm version='0.6'>\n" + text_ + nodes_ + ways_ + relations_ + "</osm>\n"; }
  std::shared_ptr<const Scene> Build(OsmReport* report = nullptr, const OsmOptions& options = {.fill = false}) const {
    return BuildOsmWorld("test.osm", AsBytes(Text()), options, report);
  }

  static std::string Lat(double y) { return Number(45 + y / 111131.7780); }
  static std::string Lon(double x) { return Number(7 + x / 78846.8350); }

 private:
  static std::string Number(double x) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.9f", x);
    return text;
  }
  static std::string TagText(Tags tags) {
    std::string text;
    for (const auto& tag : tags) text += std::string("<tag k='") + tag.first + "' v='" + tag.second + "'/>";
    return text;
  }

  std::string text_, nodes_, ways_, relations_;
  int node_ = 0, way_ = 0, relation_ = 0;
};

/// "natural=water" as the name of a test.
inline std::string TestName(const std::string& text) {
  std::string name;
  for (char c : text) name += std::isalnum(static_cast<unsigned char>(c)) ? std::string(1, c) : c == '-' ? "_dash_" : "_";
  return name;
}

}  // namespace airsim360::internal

#include "airsim360/planning/export/svg.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace airsim360::internal {
namespace {

std::string Pixels(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f", value);
  return text;
}

std::string Escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

std::string Short(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

double NiceStep(double range) {
  const double rough = std::max(range, 1e-9) / 5, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (rough <= factor * power * 1.0000001) return factor * power;
  }
  return 10 * power;
}

GroundView::GroundView(const Panel& panel, double min_x, double min_y, double max_x, double max_y) {
  const double width = std::max(max_x - min_x, 1e-3), height = std::max(max_y - min_y, 1e-3);
  scale = std::min(panel.width / width, panel.height / height);
  x0 = panel.x + panel.width / 2 - scale * (min_x + max_x) / 2;
  y0 = panel.y + panel.height / 2 + scale * (min_y + max_y) / 2;
}

Svg::Svg(int width, int height) {
  const std::string w = std::to_string(width), h = std::to_string(height);
  out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w + " " + h +
         "\" font-family=\"DejaVu Sans, Helvetica, sans-serif\">\n<rect width=\"" + w + "\" height=\"" + h + "\" fill=\"#ffffff\"/>\n";
}

void Svg::Text(double x, double y, int size, const std::string& text, const char* anchor) {
  out_ += "<text x=\"" + Pixels(x) + "\" y=\"" + Pixels(y) + "\" font-size=\"" + std::to_string(size) + "\" text-anchor=\"" + anchor +
          "\" fill=\"#222222\">" + Escaped(text) + "</text>\n";
}

void Svg::Line(double x1, double y1, double x2, double y2, const char* color, double width, bool dashed) {
  out_ += "<path d=\"M" + Pixels(x1) + " " + Pixels(y1) + "L" + Pixels(x2) + " " + Pixels(y2) + "\" stroke=\"" + color +
          "\" stroke-width=\"" + Pixels(width) + "\"" + (dashed ? " stroke-dasharray=\"6 4\"" : "") + "/>\n";
}

void Svg::Polyline(std::span<const double> x, std::span<const double> y, const std::string& color, double width, double opacity) {
  out_ += "<polyline fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\" stroke=\"" + color + "\" stroke-width=\"" +
          Pixels(width) + "\" opacity=\"" + Short(opacity) + "\" points=\"";
  for (size_t i = 0; i < x.size(); ++i) out_ += Pixels(x[i]) + "," + Pixels(y[i]) + " ";
  out_ += "\"/>\n";
}

void Svg::Dot(double x, double y, double radius, const char* color) {
  out_ += "<circle cx=\"" + Pixels(x) + "\" cy=\"" + Pixels(y) + "\" r=\"" + Pixels(radius) + "\" fill=\"" + color +
          "\" stroke=\"#ffffff\" stroke-width=\"1\"/>\n";
}

void Svg::Frame(const Panel& p) {
  out_ += "<rect x=\"" + Pixels(p.x) + "\" y=\"" + Pixels(p.y) + "\" width=\"" + Pixels(p.width) + "\" height=\"" + Pixels(p.height) +
          "\" fill=\"none\" stroke=\"#888888\"/>\n";
}

void Svg::Map(const Panel& panel, const GroundView& view, const ClearanceField& map, double low, double high) {
  constexpr double kPixel = 2.5;  // width of a picture element
  const char* colors[] = {"#e6e2da", "#6b675f"};
  std::string paths[2];
  const auto shade = [&](double px, double py) {
    const double east = (px - view.x0) / view.scale, north = (view.y0 - py) / view.scale;
    const Box3d& box = map.box();
    if (east < box.min.x || east >= box.max.x || north < box.min.y || north >= box.max.y) return -1;
    const int x = static_cast<int>((east - box.min.x) / map.voxel());
    const int y = static_cast<int>((north - box.min.y) / map.voxel());
    const int first = std::max(0, static_cast<int>((low - box.min.z) / map.voxel()));
    const int last = std::min(map.size(2) - 1, static_cast<int>((high - box.min.z) / map.voxel()));
    for (int z = first; z <= last; ++z) {
      if (map.Occupied(std::min(x, map.size(0) - 1), std::min(y, map.size(1) - 1), z)) return 1;
    }
    return 0;
  };
  // Runs of one shade along the rows.
  for (double y = panel.y; y < panel.y + panel.height; y += kPixel) {
    int shown = -1;
    double begin = panel.x;
    for (double x = panel.x;; x += kPixel) {
      const bool end = x >= panel.x + panel.width;
      const int now = end ? -1 : shade(x + kPixel / 2, y + kPixel / 2);
      if (now == shown && !end) continue;
      if (shown >= 0)
        paths[shown] +=
            "M" + Pixels(begin) + " " + Pixels(y) + "h" + Pixels(x - begin) + "v" + Pixels(kPixel) + "h" + Pixels(begin - x) + "z";
      shown = now;
      begin = x;
      if (end) break;
    }
  }
  for (int i = 0; i < 2; ++i)
    out_ += std::string("<path fill=\"") + colors[i] + "\" shape-rendering=\"crispEdges\" d=\"" + paths[i] + "\"/>\n";
}

void Svg::Diagram(const Panel& p, const std::string& title, std::span<const double> t, std::span<const double> values, double limit) {
  double top = *std::max_element(values.begin(), values.end());
  double bottom = std::min(0.0, *std::min_element(values.begin(), values.end()));
  top = std::max(std::max(top, limit) * 1.08, bottom + 1e-9);
  const double end = std::max(t.back(), 1e-9);
  const auto X = [&](double time) { return p.x + p.width * time / end; };
  const auto Y = [&](double value) { return p.y + p.height * (top - value) / (top - bottom); };
  for (double v = std::ceil(bottom / NiceStep(top - bottom)) * NiceStep(top - bottom); v <= top; v += NiceStep(top - bottom)) {
    Line(p.x, Y(v), p.x + p.width, Y(v), "#e4e4e4", 1);
    Text(p.x - 6, Y(v) + 4, 11, Short(std::fabs(v) < 1e-12 ? 0 : v), "end");
  }
  for (double s = 0; s <= end * 1.0001; s += NiceStep(end)) {
    Line(X(s), p.y + p.height, X(s), p.y + p.height + 4, "#888888", 1);
    Text(X(s), p.y + p.height + 16, 11, Short(s), "middle");
  }
  Frame(p);
  if (limit > 0) {
    Line(p.x, Y(limit), p.x + p.width, Y(limit), "#c0392b", 1.5, true);
    Text(p.x + p.width - 4, Y(limit) - 4, 11, "limit " + Short(limit), "end");
  }
  std::vector<double> x, y;
  for (size_t i = 0; i < t.size(); ++i) {
    x.push_back(X(t[i]));
    y.push_back(Y(values[i]));
  }
  Polyline(x, y, "#1f5fa8", 1.8);
  Text(p.x, p.y - 6, 13, title);
}

void Svg::ScaleBar(const Panel& panel, const GroundView& view) {
  const double metres = NiceStep(panel.width / view.scale), x = panel.x + 12, y = panel.y + panel.height - 12;
  Line(x, y, x + metres * view.scale, y, "#222222", 3);
  Text(x, y - 6, 12, Short(metres) + " m");
}

std::string Svg::Finish() { return std::move(out_) + "</svg>\n"; }

}  // namespace airsim360::internal

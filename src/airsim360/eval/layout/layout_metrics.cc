#include "airsim360/eval/layout/layout_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/text.h"
#include "airsim360/eval/boxes/box_overlap.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/plane.h"
#include "airsim360/math/triangulate.h"

namespace airsim360 {
namespace {

constexpr double kCameraHeight = 1.6;

double Azimuth(double x, int width) { return ((x + 0.5) / width - 0.5) * 2 * kPi; }
double Down(double y, int height) { return ((y + 0.5) / height - 0.5) * kPi; }

struct Room {
  std::vector<Vec2d> plan;  // x to the right, y ahead, metres
  double ceiling = 0;       // above the camera
};

Room RaiseAsItIs(const RoomLayout& layout, int width, int height, const char* whose) {
  const std::string name(whose);
  if (layout.floor.size() < 3 || layout.ceiling.size() != layout.floor.size())
    throw InputError(name + ": a room has at least three pairs of a ceiling and a floor corner");
  Room room;
  for (size_t i = 0; i < layout.floor.size(); ++i) {
    // Half a width covers what is written on from the seam; farther off is another size of picture.
    for (const Vec2d corner : {layout.floor[i], layout.ceiling[i]}) {
      if (!(std::abs(corner.x - width / 2.0) <= width))
        throw InputError(name + ": a corner of pair " + std::to_string(i) + " in column " + ShortestText(corner.x) +
                         " is not in a picture of " + std::to_string(width) + " columns (--size)");
    }
    const double down = Down(layout.floor[i].y, height), up = -Down(layout.ceiling[i].y, height),
                 azimuth = Azimuth(layout.floor[i].x, width);
    if (!(down > 0 && down < kPi / 2 && up > 0 && up < kPi / 2))
      throw InputError(name + ": pair " + std::to_string(i) + " is not a ceiling corner above the horizon, then a floor corner below it");
    if (std::abs(std::remainder(layout.floor[i].x - layout.ceiling[i].x, static_cast<double>(width))) > 1)
      throw InputError(name + ": pair " + std::to_string(i) + " has its corners in different columns");
    const double distance = kCameraHeight / std::tan(down);
    room.plan.push_back({distance * std::sin(azimuth), distance * std::cos(azimuth)});
    room.ceiling += distance * std::tan(up) / static_cast<double>(layout.floor.size());
  }
  return room;
}

RoomLayout Changed(const RoomLayout& layout, Vec2d (*change)(Vec2d corner, Vec2d size), Vec2d size) {
  RoomLayout changed = layout;
  for (auto* corners : {&changed.ceiling, &changed.floor}) {
    for (Vec2d& corner : *corners) corner = change(corner, size);
  }
  return changed;
}

// A room that is none may be one when it is read otherwise.
Room Raise(const RoomLayout& layout, int width, int height, const char* whose) {
  struct Reading {
    const char* text;
    Vec2d (*change)(Vec2d corner, Vec2d size);
  };
  constexpr Reading kReadings[] = {{": are x and y exchanged?",
                                    [](Vec2d c, Vec2d) {
                                      return Vec2d{c.y, c.x};
                                    }},
                                   {": are they shares of the width and height instead of pixels?", [](Vec2d c, Vec2d s) {
                                      return Vec2d{c.x * s.x, c.y * s.y};
                                    }}};
  try {
    return RaiseAsItIs(layout, width, height, whose);
  } catch (const InputError& error) {
    for (const Reading& reading : kReadings) {
      try {
        RaiseAsItIs(Changed(layout, reading.change, {1.0 * width, 1.0 * height}), width, height, whose);
      } catch (const InputError&) {
        continue;
      }
      throw InputError(std::string(error.what()) + reading.text);
    }
    throw;
  }
}

bool Crosses(Vec2d a, Vec2d b, Vec2d c, Vec2d d) {
  return Cross(b - a, c - a) * Cross(b - a, d - a) < 0 && Cross(d - c, a - c) * Cross(d - c, b - c) < 0;
}

bool PlanCrosses(std::span<const Vec2d> plan) {
  for (size_t i = 0; i < plan.size(); ++i) {
    for (size_t k = i + 2; k < plan.size(); ++k) {
      if (Crosses(plan[i], plan[i + 1], plan[k], plan[(k + 1) % plan.size()])) return true;
    }
  }
  return false;
}

// Distance of the nearest wall in a direction; 0 where there is none.
double WallDistance(const Room& room, double azimuth) {
  const Vec2d d{std::sin(azimuth), std::cos(azimuth)};
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < room.plan.size(); ++i) {
    const Vec2d a = room.plan[i], edge = room.plan[(i + 1) % room.plan.size()] - a;
    const double across = d.x * edge.y - d.y * edge.x;
    if (across == 0) continue;
    const double distance = (a.x * edge.y - a.y * edge.x) / across, along = (a.x * d.y - a.y * d.x) / across;
    if (distance > 0 && along >= 0 && along <= 1) nearest = std::min(nearest, distance);
  }
  return std::isfinite(nearest) ? nearest : 0;
}

enum Surface { kCeiling, kWall, kFloor };

struct Seen {
  Surface surface;
  double range;
};

Seen Look(const Room& room, double wall, double down) {
  const double lower = std::atan2(kCameraHeight, wall), upper = -std::atan2(room.ceiling, wall);
  if (down > lower) return {kFloor, kCameraHeight / std::sin(down)};
  if (down < upper) return {kCeiling, -room.ceiling / std::sin(down)};
  return {kWall, wall / std::cos(down)};
}

double CornerError(const RoomLayout& a, const RoomLayout& b, int width, int height, size_t start = 0, bool round = false) {
  if (a.floor.size() != b.floor.size()) return std::numeric_limits<double>::quiet_NaN();
  const auto distance = [&](Vec2d p, Vec2d q) {
    const double dx = p.x - q.x;
    return std::hypot(round ? std::remainder(dx, static_cast<double>(width)) : dx, p.y - q.y);
  };
  double sum = 0;
  for (size_t i = 0; i < a.floor.size(); ++i) {
    const size_t k = (i + start) % a.floor.size();
    sum += distance(a.floor[k], b.floor[i]) + distance(a.ceiling[k], b.ceiling[i]);
  }
  return 100 * sum / (2 * static_cast<double>(a.floor.size())) / std::hypot(width, height);
}

void MeasurePixels(const Room& p, const Room& g, int width, int height, LayoutErrors& errors) {
  double wrong = 0, square = 0, near = 0;
  for (int x = 0; x < width; ++x) {
    const double wall_p = WallDistance(p, Azimuth(x, width)), wall_g = WallDistance(g, Azimuth(x, width));
    if (wall_p == 0 || wall_g == 0)
      throw InputError(std::string(wall_p == 0 ? "the prediction" : "the truth") + ": the camera is outside the room");
    for (int y = 0; y < height; ++y) {
      const Seen a = Look(p, wall_p, Down(y, height)), b = Look(g, wall_g, Down(y, height));
      wrong += a.surface != b.surface;
      square += (a.range - b.range) * (a.range - b.range);
      near += std::max(a.range / b.range, b.range / a.range) < 1.25;
    }
  }
  const double pixels = static_cast<double>(width) * height;
  errors.pixel_error = 100 * wrong / pixels;
  errors.rmse = std::sqrt(square / pixels);
  errors.delta1 = near / pixels;
}

}  // namespace

std::array<double, kLayoutFigures.size()> Figures(const LayoutErrors& e) {
  return {e.iou2d, e.iou3d, e.corner_error, e.pixel_error, e.rmse, e.delta1};
}

double CornerErrorFromAnyStart(const RoomLayout& prediction, const RoomLayout& truth, int width, int height) {
  double least = CornerError(prediction, truth, width, height, 0, true);
  for (size_t start = 1; start < truth.floor.size(); ++start)
    least = std::min(least, CornerError(prediction, truth, width, height, start, true));
  return least;
}

bool WallsCross(const RoomLayout& room, int width, int height) { return PlanCrosses(Raise(room, width, height, "the room").plan); }

LayoutErrors MeasureLayout(const RoomLayout& prediction, const RoomLayout& truth, int width, int height) {
  const Room p = Raise(prediction, width, height, "the prediction"), g = Raise(truth, width, height, "the truth");
  if (PlanCrosses(g.plan)) throw InputError("the truth: walls cross each other; corners must come in turn around the room");
  const double shared = SharedPolygonArea(p.plan, g.plan), area_p = std::abs(SignedArea(p.plan)), area_g = std::abs(SignedArea(g.plan));
  const double high_p = p.ceiling + kCameraHeight, high_g = g.ceiling + kCameraHeight, shared_volume = shared * std::min(high_p, high_g);
  LayoutErrors errors;
  errors.iou2d = shared / (area_p + area_g - shared);
  errors.iou3d = shared_volume / (area_p * high_p + area_g * high_g - shared_volume);
  errors.corner_error = CornerError(prediction, truth, width, height);
  MeasurePixels(p, g, width, height, errors);
  return errors;
}

}  // namespace airsim360

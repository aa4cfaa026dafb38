#include "airsim360/worlds/building/facade_pen.h"

#include <cmath>

namespace airsim360 {

void FacadePen::SetWall(Vec2f a, Vec2f b) {
  length_ = std::hypot(b.x - a.x, b.y - a.y);
  const Vec3f along{(b.x - a.x) / length_, (b.y - a.y) / length_, 0}, up{0, 0, 1};
  X_ = {Mat3f::FromColumns(along, Cross(up, along), up * stretch_), {a.x, a.y, base_}};
  mesh_.SetTransform(X_);
}

void FacadePen::Front(float x0, float x1, float z0, float z1, float y) {
  y = Out(y);
  mesh_.QuadUv({x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}, {x0, -z0}, {x1, -z0}, {x1, -z1}, {x0, -z1});
}

void FacadePen::Left(float x, float y0, float y1, float z0, float z1) {
  y0 = Out(y0);
  y1 = Out(y1);
  mesh_.QuadUv({x, y1, z0}, {x, y0, z0}, {x, y0, z1}, {x, y1, z1}, {y1, -z0}, {y0, -z0}, {y0, -z1}, {y1, -z1});
}

void FacadePen::Right(float x, float y0, float y1, float z0, float z1) {
  y0 = Out(y0);
  y1 = Out(y1);
  mesh_.QuadUv({x, y0, z0}, {x, y1, z0}, {x, y1, z1}, {x, y0, z1}, {y0, -z0}, {y1, -z0}, {y1, -z1}, {y0, -z1});
}

void FacadePen::Up(float x0, float x1, float y0, float y1, float z) {
  y0 = Out(y0);
  y1 = Out(y1);
  mesh_.QuadUv({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}, {x0, -y0}, {x1, -y0}, {x1, -y1}, {x0, -y1});
}

void FacadePen::Down(float x0, float x1, float y0, float y1, float z) {
  y0 = Out(y0);
  y1 = Out(y1);
  mesh_.QuadUv({x0, y1, z}, {x1, y1, z}, {x1, y0, z}, {x0, y0, z}, {x0, y1}, {x1, y1}, {x1, y0}, {x0, y0});
}

void FacadePen::Picture(float x0, float x1, float z0, float z1, float y, Vec2f uv0, Vec2f uv1) {
  y = Out(y);
  mesh_.QuadUv({x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}, {uv0.x, uv1.y}, uv1, {uv1.x, uv0.y}, uv0);
}

void FacadePen::Bar(float x0, float x1, float z0, float z1, float y0, float y1, bool ends, bool bottom) {
  Front(x0, x1, z0, z1, y0);
  Up(x0, x1, y0, y1, z1);
  if (bottom) Down(x0, x1, y0, y1, z0);
  if (!ends) return;
  Left(x0, y0, y1, z0, z1);
  Right(x1, y0, y1, z0, z1);
}

void FacadePen::Reveal(float x0, float x1, float z0, float z1, float y0, float y1) {
  Right(x0, y0, y1, z0, z1);
  Left(x1, y0, y1, z0, z1);
  Up(x0, x1, y0, y1, z0);
  Down(x0, x1, y0, y1, z1);
}

void FacadePen::WallAround(float x0, float x1, float z0, float z1, float ox0, float ox1, float oz0, float oz1) {
  if (oz0 > z0) Front(x0, x1, z0, oz0, 0);
  if (oz1 < z1) Front(x0, x1, oz1, z1, 0);
  if (ox0 > x0) Front(x0, ox0, oz0, oz1, 0);
  if (ox1 < x1) Front(ox1, x1, oz0, oz1, 0);
}

void FacadePen::Window(float x0, float x1, float z0, float z1, float y, const Sash& sash) {
  const float t = sash.t, front = y - 0.06f;
  // Frame: four front strips and the inner faces.
  Use(sash.frame);
  Front(x0, x1, z0, z0 + t, front);
  Front(x0, x1, z1 - t, z1, front);
  Front(x0, x0 + t, z0 + t, z1 - t, front);
  Front(x1 - t, x1, z0 + t, z1 - t, front);
  Reveal(x0 + t, x1 - t, z0 + t, z1 - t, front, y);
  // Glazing bars.
  for (int i = 1; i <= sash.nx; ++i) {
    const float x = x0 + (x1 - x0) * static_cast<float>(i) / static_cast<float>(sash.nx + 1), h = t * 0.4f;
    Front(x - h, x + h, z0 + t, z1 - t, front + 0.01f);
    Left(x - h, front + 0.01f, y, z0 + t, z1 - t);
    Right(x + h, front + 0.01f, y, z0 + t, z1 - t);
  }
  for (int i = 1; i <= sash.nz; ++i) {
    const float z = z0 + (z1 - z0) * static_cast<float>(i) / static_cast<float>(sash.nz + 1), h = t * 0.4f;
    Front(x0 + t, x1 - t, z - h, z + h, front + 0.012f);
    Up(x0 + t, x1 - t, front + 0.012f, y, z + h);
    Down(x0 + t, x1 - t, front + 0.012f, y, z - h);
  }
  // The bottom rail of a sash that is pushed up, and the dark below it.
  const float foot = z0 + t + (z1 - z0 - 2 * t) * std::min(sash.open, 1 - sash.blind);
  if (foot > z0 + t) {
    Use(sash.frame);
    Bar(x0 + t, x1 - t, foot, foot + 0.8f * t, front + 0.02f, y, false, true);
    Use(Surface::kPanelDark);
    Front(x0 + t, x1 - t, z0 + t, foot, y + 0.001f);
  }
  // Pane, covered from above as far as the blind is drawn.
  const float edge = z1 - t - (z1 - z0 - 2 * t) * sash.blind;
  Use(sash.glass);
  if (sash.blind < 0.99f && edge > foot) Front(x0 + t, x1 - t, foot, edge, y);
  Use(sash.cover);
  if (sash.blind > 0.01f) Front(x0 + t, x1 - t, edge, z1 - t, y);
}

}  // namespace airsim360

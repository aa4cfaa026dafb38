#include "airsim360/render/look/photo_geometry.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/frame/camera_rays.h"
#include "airsim360/render/look/scatter_kernels.h"

namespace airsim360::internal {
namespace {

constexpr double kSunDiscRadius = 0.2666 * kPi / 180;

// Radians of a pixel in the middle of the picture.
double PixelAngle(const Camera& camera) {
  const Vec2d middle{0.5 * Width(camera), 0.5 * Height(camera)};
  const auto a = PixelToRay(camera, middle), b = PixelToRay(camera, {middle.x + 1, middle.y});
  return a && b ? std::acos(std::clamp(Dot(*a, *b), -1.0, 1.0)) : kPi / Height(camera);
}

// Direction of a canonical position of a panorama, whatever the frame.
Vec3d SphereDirection(const PhotoGeometry& g, Vec2d at) {
  const double theta = 2 * kPi * at.x / g.width, phi = kPi * (0.5 - at.y / g.height);
  return {std::cos(phi) * std::sin(theta), -std::sin(phi), std::cos(phi) * std::cos(theta)};
}

}  // namespace

PhotoGeometry::PhotoGeometry(const PhotoRequest& request)
    : width(Width(request.camera)),
      height(Height(request.camera)),
      sphere(std::holds_alternative<Equirectangular>(request.camera)),
      shift(0) {
  column = row = sphere ? 2 * kPi / width : PixelAngle(request.camera);
  if (sphere) {
    CameraRays rays;
    rays.Update(request.camera, request.R_WC);
    shift = rays.column_shift();
  }
  // Two pixels or more, but not below 0.35 degrees of a panorama.
  const int most = sphere ? LightCells::kMostColumns : LightCells::kMostColumns / 2;
  cells_across = kScatterBlock;
  while (2 * cells_across <= most && 4 * cells_across <= width &&
         (sphere || int64_t{2} * cells_across * height <= int64_t{LightCells::kMostRows} * width))
    cells_across *= 2;
  const int64_t down = sphere ? cells_across / 2 : (int64_t{cells_across} * height + width / 2) / width;
  cells_down = static_cast<int>(std::clamp<int64_t>(down, 1, LightCells::kMostRows));
}

LightCells PhotoGeometry::Cells() const {
  return {sphere, cells_across, cells_down, column * width / cells_across, row * height / cells_down};
}

PhotoRow FindPhotoRow(bool sphere, int y, int height) {
  if (y >= 0 && y < height) return {y, false};
  if (!sphere) return {std::clamp(y, 0, height - 1), false};
  return {std::clamp(y < 0 ? -1 - y : 2 * height - 1 - y, 0, height - 1), true};
}

LightCells Reduce(const PhotoGeometry& g, const Image<Rgb32f>& light, float most) {
  LightCells cells = g.Cells();
  const auto add = AIRSIM360_SELECT_KERNEL(AddRow);
  const double across = static_cast<double>(g.width) / cells.width, down = static_cast<double>(g.height) / cells.height;
  ParallelFor(cells.height, [&](int64_t task) {
    const int y = static_cast<int>(task);
    std::vector<float> sum(3 * static_cast<size_t>(g.width));
    const double top = y * down, bottom = top + down;
    for (int from = static_cast<int>(top); from < std::min(g.height, static_cast<int>(std::ceil(bottom))); ++from) {
      const double part = std::min(bottom, from + 1.0) - std::max(top, static_cast<double>(from));
      if (part > 1e-9) add(&light(0, from), g.width, most, static_cast<float>(part / (down * across)), sum.data());
    }
    if (g.width == 2 * cells.width) {
      for (int x = 0; x < cells.width; ++x) {
        const float* a = sum.data() + 3 * static_cast<size_t>(g.ImageColumn(2 * x));
        const float* b = sum.data() + 3 * static_cast<size_t>(g.ImageColumn(2 * x + 1));
        for (int k = 0; k < 3; ++k) cells.At(k, x, y) = a[k] + b[k];
      }
      return;
    }
    for (int x = 0; x < cells.width; ++x) {
      const double left = x * across, right = left + across;
      float c[3] = {};
      for (int from = static_cast<int>(left); from < std::min(g.width, static_cast<int>(std::ceil(right))); ++from) {
        const auto part = static_cast<float>(std::min(right, from + 1.0) - std::max(left, static_cast<double>(from)));
        const float* pixel = sum.data() + 3 * static_cast<size_t>(g.ImageColumn(from));
        for (int k = 0; k < 3; ++k) c[k] += part * pixel[k];
      }
      for (int k = 0; k < 3; ++k) cells.At(k, x, y) = c[k];
    }
  });
  return cells;
}

void SpreadCells(const PhotoGeometry& g, const LightCells& cells, float share, int y, float* scratch, ColorRow out) {
  const double v = (y + 0.5) * cells.height / g.height - 0.5;
  const int above = static_cast<int>(std::floor(v));
  const auto f = static_cast<float>(v - above);
  const PhotoRow rows[2] = {FindPhotoRow(g.sphere, above, cells.height), FindPhotoRow(g.sphere, above + 1, cells.height)};
  const int w = cells.width;
  const auto spread = AIRSIM360_SELECT_KERNEL(SpreadRow);
  float* const to[3] = {out.r, out.g, out.b};
  for (int k = 0; k < 3; ++k) {
    // Both rows mixed, each from where it is turned to.
    const float* from[2];
    for (int i = 0; i < 2; ++i) from[i] = cells.planes[static_cast<size_t>(k)].data() + cells.Index(0, rows[i].y);
    const float below = share * f, here = share - below;
    for (int half = 0; half < 2; ++half) {
      const int first = half * (w / 2), last = half == 0 ? w / 2 : w;
      const float* a = from[0] + (rows[0].turned ? (half == 0 ? w / 2 : -(w / 2)) : 0);
      const float* b = from[1] + (rows[1].turned ? (half == 0 ? w / 2 : -(w / 2)) : 0);
      for (int x = first; x < last; ++x) scratch[x] = here * a[x] + below * b[x];
    }
    scratch[-1] = g.sphere ? scratch[w - 1] : scratch[0];
    scratch[w] = g.sphere ? scratch[0] : scratch[w - 1];
    if (g.width == w || g.width == 2 * w) {
      spread(scratch, w, g.width, to[k]);
      continue;
    }
    for (int x = 0; x < g.width; ++x) {
      const double u = (x + 0.5) * w / g.width - 0.5;
      const int left = static_cast<int>(std::floor(u));
      const auto part = static_cast<float>(u - left);
      to[k][x] = scratch[left] + (scratch[left + 1] - scratch[left]) * part;
    }
  }
}

std::optional<Vec2d> FindSun(const PhotoGeometry& g, const PhotoRequest& request) {
  const Daylight& day = request.daylight;
  if (!(day.sun_seen > 0)) return std::nullopt;
  const std::optional<Vec2d> at = RayToPixel(request.camera, request.R_WC.transpose() * VecCast<double>(day.to_sun));
  if (!at) return std::nullopt;
  // To a thousandth of a pixel, so that two headings by whole columns apart agree.
  constexpr double kStep = 1024;
  double x = std::round((at->x + g.shift) * kStep) / kStep;
  if (x >= g.width) x -= g.width;
  return Vec2d{x, std::round(at->y * kStep) / kStep};
}

void ClipSunDisc(const PhotoGeometry& g, const PhotoRequest& request, Vec2d sun, float most, Image<Rgb32f>& light) {
  const double reach = kSunDiscRadius + 1.5 * g.column;
  const auto direction = [&](Vec2d at) { return g.sphere ? std::optional(SphereDirection(g, at)) : PixelToRay(request.camera, at); };
  const std::optional<Vec3d> to_sun = direction(sun);
  if (!to_sun) return;
  // Pixels off the middle of a plane are smaller: three times as many are looked at.
  const int rows = static_cast<int>(reach / g.row * (g.sphere ? 1 : 3)) + 1, middle = static_cast<int>(sun.y);
  for (int y = std::max(0, middle - rows); y <= std::min(g.height - 1, middle + rows); ++y) {
    const double squeeze = g.sphere ? std::max(0.01, std::cos(kPi * (0.5 - (y + 0.5) / g.height))) : 1;
    const int columns = std::min((g.width - 1) / 2, static_cast<int>(rows / squeeze) + 1);
    for (int i = -columns; i <= columns; ++i) {
      int x = static_cast<int>(sun.x) + i;
      if (g.sphere) x = (x + g.width) % g.width;
      if (x < 0 || x >= g.width) continue;
      const std::optional<Vec3d> d = direction({x + 0.5, y + 0.5});
      if (!d || Dot(*d, *to_sun) < std::cos(reach)) continue;
      Rgb32f& c = light(g.ImageColumn(x), y);
      c = {std::min(c.r, most), std::min(c.g, most), std::min(c.b, most)};
    }
  }
}

void AddSun(const PhotoGeometry& g, Vec2d at, const Rgb32f& sun, LightCells& cells) {
  const double u = at.x * cells.width / g.width - 0.5, v = at.y * cells.height / g.height - 0.5;
  const int left = static_cast<int>(std::floor(u)), above = static_cast<int>(std::floor(v));
  for (int i = 0; i < 4; ++i) {
    const int dx = i % 2, dy = i / 2;
    const PhotoRow row = FindPhotoRow(g.sphere, above + dy, cells.height);
    int x = left + dx + (row.turned ? cells.width / 2 : 0);
    x = g.sphere ? (x + cells.width) % cells.width : std::clamp(x, 0, cells.width - 1);
    const double weight = std::abs(1 - dx - (u - left)) * std::abs(1 - dy - (v - above)) / cells.CellAngle(row.y);
    cells.At(0, x, row.y) += static_cast<float>(weight * sun.r);
    cells.At(1, x, row.y) += static_cast<float>(weight * sun.g);
    cells.At(2, x, row.y) += static_cast<float>(weight * sun.b);
  }
}

}  // namespace airsim360::internal

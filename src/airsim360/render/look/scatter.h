// Light that a lens scatters over the whole sphere (glare, bloom, veil), solved as diffusion.
//
// The point-spread function K has, in spherical harmonics of degree l, the symbol
//   F(l) = 1 / (1 + (a^2 l (l + 1))^g),   g = 0.31:
// integral 1, a peak about a wide, and a tail that falls as theta^-2.62: a power law, as measured of the stray light of
// consumer cameras (Bitlis, Jansson and Allebach 2007; Wei, Bouman and Allebach 2014); exponent and a are chosen. F is a mixture of 1 / (1 + t l (l + 1)) over t with positive
// weights (Cole and Cole 1941), each the solution u of u - t laplace(u) = light: after a Fourier transform along the
// rows one tridiagonal system per frequency, on the sphere itself, so that seam and poles are like any other place,
// and what is scattered is exactly what was taken.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace airsim360::internal {

inline constexpr double kScatterExponent = 0.31;

/// Light in cells: of a sphere (equirectangular, as panoramas) or of a plane. Planes are red, green, blue, row-major.
struct LightCells {
  bool sphere = true;
  int width = 0, height = 0;   ///< width is a power of two, at most kMostColumns; height at most kMostRows
  double column = 0, row = 0;  ///< size of a cell of the plane, radians; of a sphere 2 pi / width, pi / height
  std::array<std::vector<float>, 3> planes;

  static constexpr int kMostColumns = 1024, kMostRows = 512;
  LightCells() = default;
  LightCells(bool on_sphere, int columns, int rows, double column_size, double row_size);
  float& At(int plane, int x, int y) { return planes[static_cast<size_t>(plane)][Index(x, y)]; }
  float At(int plane, int x, int y) const { return planes[static_cast<size_t>(plane)][Index(x, y)]; }
  size_t Index(int x, int y) const { return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x); }
  /// Solid angle of a cell of row y (of a plane: its area in radians squared).
  double CellAngle(int y) const;
};

/// The mixture for cells of `cell` radians.
struct ScatterMixture {
  double kept = 0;  ///< weight of what stays within about a third of a cell: not part of what Scatter gives
  double mean = 0;  ///< weight of what is spread evenly
  struct Part {
    double t, weight;
  };
  std::vector<Part> parts;
};
ScatterMixture MakeScatterMixture(double angle_deg, double cell);

/// What the point-spread function with a = `angle_deg` makes of `light`, but for what it keeps in place. A plane
/// has mirrors for borders. The same bytes with any number of threads.
void Scatter(const ScatterMixture& mixture, const LightCells& light, LightCells& out);

}  // namespace airsim360::internal

// Six cube faces to one equirectangular picture.
#include <cmath>
#include <numbers>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/image/color.h"
#include "airsim360/projection/bilinear.h"
#include "airsim360/projection/resample.h"

namespace airsim360 {
namespace {

struct CosSin {
  double c, s;
};

// cos and sin of the azimuths of `samples` evenly spaced positions in every column, and of the elevations in
// every row: the rays of a picture are products of the two.
struct Rays {
  int samples;
  std::vector<CosSin> azimuth, elevation;

  Rays(const Equirectangular& target, int samples_x, int samples_y) : samples(samples_x) {
    for (int i = 0; i < target.width * samples_x; ++i) {
      const double theta = 2 * std::numbers::pi * ((i + 0.5) / samples_x / target.width - 0.5);
      azimuth.push_back({std::cos(theta), std::sin(theta)});
    }
    for (int j = 0; j < target.height * samples_y; ++j) {
      const double phi = std::numbers::pi * (0.5 - (j + 0.5) / samples_y / target.height);
      elevation.push_back({std::cos(phi), std::sin(phi)});
    }
  }
  Vec3d operator()(size_t i, size_t j) const { return {elevation[j].c * azimuth[i].s, -elevation[j].s, elevation[j].c * azimuth[i].c}; }
};

// A face with a border of one texel that continues it over the edge, so that bilinear reads need no cases.
Image<Rgb32f> WithBorder(const CubeFaces<Rgb32f>& faces, size_t f) {
  const Image<Rgb32f>& face = faces[f];
  const int size = face.width();
  Image<Rgb32f> padded(size + 2, size + 2);
  for (int y = 0; y < size; ++y) std::copy(face.row(y).begin(), face.row(y).end(), padded.row(y + 1).begin() + 1);

  // The border texel at a position of the face's plane beyond the edge: what the neighbour shows in that
  // direction.
  const CubeFace camera{static_cast<CubeFaceName>(f), size};
  const auto beyond = [&](int x, int y) {
    const auto [name, at] = RayToCube(*PixelToRay(camera, {x + 0.5, y + 0.5}), size);
    return internal::Bilinear(internal::ClampReader{faces[static_cast<size_t>(name)]}, at);
  };
  for (int k = 0; k < size; ++k) {
    padded(k + 1, 0) = beyond(k, -1);
    padded(k + 1, size + 1) = beyond(k, size);
    padded(0, k + 1) = beyond(-1, k);
    padded(size + 1, k + 1) = beyond(size, k);
  }
  // Three faces meet at a corner of the cube; there is no fourth texel, so it takes the mean of the two
  // beside it.
  for (int x : {0, size + 1}) {
    for (int y : {0, size + 1}) {
      const Rgb32f a = padded(x == 0 ? 1 : size, y), b = padded(x, y == 0 ? 1 : size);
      padded(x, y) = {(a.r + b.r) / 2, (a.g + b.g) / 2, (a.b + b.b) / 2};
    }
  }
  return padded;
}

// Reads a face with its border by positions of the face itself.
struct BorderReader {
  const Image<Rgb32f>& padded;
  const Rgb32f& operator()(int x, int y) const { return padded(x + 1, y + 1); }
};

// Converts six faces or one picture pixel by pixel.
template <class To, class From, class Convert>
Image<To> Converted(const Image<From>& from, const Convert& convert) {
  Image<To> to(from.width(), from.height());
  ParallelFor(from.height(), [&](int64_t y) {
    const auto in = from.row(static_cast<int>(y));
    const auto out = to.row(static_cast<int>(y));
    for (size_t x = 0; x < in.size(); ++x) out[x] = convert(in[x]);
  });
  return to;
}

template <class Pixel, class Decode, class Encode>
Image<Pixel> StitchConverted(const CubeFaces<Pixel>& faces, const Equirectangular& target, const Decode& decode, const Encode& encode) {
  CubeFaces<Rgb32f> numbers;
  for (size_t f = 0; f < 6; ++f) numbers[f] = Converted<Rgb32f>(faces[f], decode);
  return Converted<Pixel>(StitchFiltered(numbers, target), encode);
}

}  // namespace

int CheckFaces(const std::array<FaceSize, 6>& sizes, const std::array<std::string, 6>& names) {
  const auto text = [](FaceSize s) { return std::to_string(s[0]) + "x" + std::to_string(s[1]); };
  for (size_t f = 0; f < 6; ++f) {
    if (sizes[f][0] < 1 || sizes[f][0] != sizes[f][1]) {
      throw InputError(names[f] + " has " + text(sizes[f]) + " pixels; faces must be square");
    }
    if (sizes[f] != sizes[0]) {
      throw InputError(names[f] + " has " + text(sizes[f]) + " pixels, " + names[0] + " has " + text(sizes[0]) +
                       "; all faces must be equal");
    }
  }
  // Six faces are indexed by 32 bits.
  if (sizes[0][0] > 16384) throw InputError(names[0] + " has " + text(sizes[0]) + " pixels; the limit is 16384x16384");
  return sizes[0][0];
}

Image<uint32_t> CubeLookup(int size, const Equirectangular& target) {
  CheckCamera(target);
  const Rays rays(target, 1, 1);
  Image<uint32_t> lookup(target.width, target.height);
  ParallelFor(target.height, [&](int64_t y) {
    for (int x = 0; x < target.width; ++x) {
      const auto [face, at] = RayToCube(rays(static_cast<size_t>(x), static_cast<size_t>(y)), size);
      const int column = std::min(static_cast<int>(at.x), size - 1), row = std::min(static_cast<int>(at.y), size - 1);
      const auto line = static_cast<uint32_t>(face) * static_cast<uint32_t>(size) + static_cast<uint32_t>(row);
      lookup(x, static_cast<int>(y)) = line * static_cast<uint32_t>(size) + static_cast<uint32_t>(column);
    }
  });
  return lookup;
}

Image<Rgb32f> StitchFiltered(const CubeFaces<Rgb32f>& faces, const Equirectangular& target) {
  CheckCamera(target);
  const int size = CheckFaces(faces);
  CubeFaces<Rgb32f> padded;
  for (size_t f = 0; f < 6; ++f) padded[f] = WithBorder(faces, f);

  // Texels are least at the edges of a face, 1 / size radians: as many samples as such texels fit a target
  // pixel, so that no texel is skipped.
  const int samples = std::max(1, static_cast<int>(std::ceil(std::numbers::pi / target.height * size - 1e-9)));
  const Rays rays(target, samples, samples);
  const float weight = 1.0f / static_cast<float>(samples * samples);
  Image<Rgb32f> result(target.width, target.height);
  ParallelFor(target.height, [&](int64_t y) {
    for (int x = 0; x < target.width; ++x) {
      Rgb32f sum;
      for (int j = 0; j < samples; ++j) {
        for (int i = 0; i < samples; ++i) {
          const auto [face, at] = RayToCube(rays(static_cast<size_t>(x * samples + i), static_cast<size_t>(y * samples + j)), size);
          const Rgb32f p = internal::Bilinear(BorderReader{padded[static_cast<size_t>(face)]}, at);
          sum = {sum.r + p.r, sum.g + p.g, sum.b + p.b};
        }
      }
      result(x, static_cast<int>(y)) = {sum.r * weight, sum.g * weight, sum.b * weight};
    }
  });
  return result;
}

Image<Rgb8> StitchFiltered(const CubeFaces<Rgb8>& faces, const Equirectangular& target) {
  return StitchConverted(
      faces, target,
      [](Rgb8 p) {
        return Rgb32f{SrgbToLinear(p.r), SrgbToLinear(p.g), SrgbToLinear(p.b)};
      },
      [](Rgb32f p) {
        return Rgb8{LinearToSrgb8(p.r), LinearToSrgb8(p.g), LinearToSrgb8(p.b)};
      });
}

Image<Rgb16> StitchFiltered(const CubeFaces<Rgb16>& faces, const Equirectangular& target) {
  const auto round = [](float v) { return static_cast<uint16_t>(std::lround(std::clamp(v, 0.0f, 65535.0f))); };
  return StitchConverted(
      faces, target,
      [](Rgb16 p) {
        return Rgb32f{static_cast<float>(p.r), static_cast<float>(p.g), static_cast<float>(p.b)};
      },
      [&](Rgb32f p) {
        return Rgb16{round(p.r), round(p.g), round(p.b)};
      });
}

Image<float> StitchRangeFromDepth(const CubeFaces<float>& depth_z, const Equirectangular& target) {
  Image<float> range = StitchNearest(depth_z, target);
  const Rays rays(target, 1, 1);
  ParallelFor(target.height, [&](int64_t y) {
    for (int x = 0; x < target.width; ++x) {
      // The ray is a unit vector, and its largest component is the one along the axis of its face.
      const Vec3d ray = rays(static_cast<size_t>(x), static_cast<size_t>(y));
      const double along = std::max({std::abs(ray.x), std::abs(ray.y), std::abs(ray.z)});
      float& value = range(x, static_cast<int>(y));
      value = static_cast<float>(value / along);
    }
  });
  return range;
}

Image<float> RangeFromFaceDepth(const Image<float>& depth_z) {
  const int size = depth_z.width();
  if (size < 1 || depth_z.height() != size) throw InputError("a cube face must be square");
  Image<float> range(size, size);
  for (int y = 0; y < size; ++y) {
    const double v = (2 * y + 1.0) / size - 1;
    for (int x = 0; x < size; ++x) {
      const double u = (2 * x + 1.0) / size - 1;
      range(x, y) = static_cast<float>(depth_z(x, y) * std::sqrt(1 + u * u + v * v));
    }
  }
  return range;
}

}  // namespace airsim360

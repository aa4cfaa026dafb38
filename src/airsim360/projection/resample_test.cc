#include "airsim360/projection/resample.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

// The direction that a face pixel sees, by the published formula of cube maps rather than by our camera: a, b
// in [-1, 1] to the right and down on the face.
Vec3d FaceDirection(int face, double a, double b) {
  switch (face) {
    case 0:
      return {1, b, -a};
    case 1:
      return {-1, b, a};
    case 2:
      return {a, 1, -b};
    case 3:
      return {a, -1, b};
    case 4:
      return {a, b, 1};
    default:
      return {-a, b, -1};
  }
}

Vec3d ErpDirection(const Equirectangular& erp, int x, int y) {
  const double theta = 2 * kPi * ((x + 0.5) / erp.width - 0.5), phi = kPi * (0.5 - (y + 0.5) / erp.height);
  return {std::cos(phi) * std::sin(theta), -std::sin(phi), std::cos(phi) * std::cos(theta)};
}

uint16_t Encode(double component) { return static_cast<uint16_t>(std::lround((component * 0.5 + 0.5) * 65535)); }

CubeFaces<Rgb16> DirectionFaces(int size) {
  CubeFaces<Rgb16> faces;
  for (int f = 0; f < 6; ++f) {
    faces[f] = Image<Rgb16>(size, size);
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const Vec3d d = Normalized(FaceDirection(f, (2 * x + 1.0) / size - 1, (2 * y + 1.0) / size - 1));
        faces[f](x, y) = {Encode(d.x), Encode(d.y), Encode(d.z)};
      }
    }
  }
  return faces;
}

Vec3d Decoded(Rgb16 p) { return Normalized(Vec3d{p.r - 32767.5, p.g - 32767.5, p.b - 32767.5}); }

struct Errors {
  double rms = 0, max = 0;
};

// Angular errors of a direction-encoded panorama, in pixels of its equator.
Errors DirectionErrors(const Image<Rgb16>& picture) {
  const Equirectangular erp{picture.width(), picture.height()};
  Errors errors;
  double sum = 0;
  for (int y = 0; y < erp.height; ++y) {
    for (int x = 0; x < erp.width; ++x) {
      const double e = std::acos(std::min(1.0, Dot(Decoded(picture(x, y)), ErpDirection(erp, x, y)))) * erp.height / kPi;
      sum += e * e;
      errors.max = std::max(errors.max, e);
    }
  }
  errors.rms = std::sqrt(sum / static_cast<double>(picture.size()));
  return errors;
}

TEST(Stitch, DirectionEncodedFacesComeBackWithinATwentiethOfAPixel) {
  for (int size : {64, 129, 256, 512}) {
    const Errors errors = DirectionErrors(StitchFiltered(DirectionFaces(size), Equirectangular{4 * size, 2 * size}));
    EXPECT_LE(errors.rms, 0.05) << size;
    EXPECT_LE(errors.max, 0.35) << size;
    RecordProperty("rms_" + std::to_string(size), std::to_string(errors.rms));
    RecordProperty("max_" + std::to_string(size), std::to_string(errors.max));
  }
}

TEST(Stitch, OtherTargetSizesAreAsExact) {
  for (int width : {64, 250, 512, 2048}) {
    const Errors errors = DirectionErrors(StitchFiltered(DirectionFaces(128), Equirectangular{width, width / 2}));
    EXPECT_LE(errors.rms, 0.05) << width;
    EXPECT_LE(errors.max, 0.35) << width;
  }
}

TEST(Stitch, ThereIsNoSeamAtFaceBorders) {
  // A smooth function of direction: second differences along a row are as small across face borders as inside
  // faces.
  constexpr int kSize = 128;
  CubeFaces<Rgb32f> faces;
  for (int f = 0; f < 6; ++f) {
    faces[f] = Image<Rgb32f>(kSize, kSize);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const Vec3d d = Normalized(FaceDirection(f, (2 * x + 1.0) / kSize - 1, (2 * y + 1.0) / kSize - 1));
        faces[f](x, y) = {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
      }
    }
  }
  const auto erp = StitchFiltered(faces, Equirectangular{4 * kSize, 2 * kSize});
  double inside = 0, border = 0;
  for (int y = 1; y + 1 < erp.height(); ++y) {
    for (int x = 0; x < erp.width(); ++x) {
      const auto face = [&](int i, int j) { return RayToCube(ErpDirection({4 * kSize, 2 * kSize}, i, j), kSize).face; };
      const int left = (x + erp.width() - 1) % erp.width(), right = (x + 1) % erp.width();
      const double bend = std::max(std::abs(erp(left, y).r - 2 * erp(x, y).r + erp(right, y).r),
                                   std::abs(erp(x, y - 1).r - 2 * erp(x, y).r + erp(x, y + 1).r));
      const bool crosses = face(left, y) != face(right, y) || face(x, y - 1) != face(x, y + 1);
      (crosses ? border : inside) = std::max(crosses ? border : inside, bend);
    }
  }
  // One step of a pixel is pi / 256 = 0.0123: a seam of a tenth of a pixel would show as 1.2e-3.
  EXPECT_LT(border, inside + 3e-4);
}

TEST(Stitch, AConstantColourStaysExactlyConstant) {
  CubeFaces<Rgb8> faces;
  faces.fill(Image<Rgb8>(17, 17, {10, 128, 251}));
  EXPECT_EQ(StitchFiltered(faces, Equirectangular{68, 34}), Image<Rgb8>(68, 34, {10, 128, 251}));
  EXPECT_EQ(StitchFiltered(faces, Equirectangular{10, 5}), Image<Rgb8>(10, 5, {10, 128, 251}));
}

TEST(Stitch, FilteringKeepsTheMeanLightOfTheSphere) {
  // Random texels, shrunk and enlarged: the mean over the sphere is kept, so no texel is skipped.
  RngStream rng(5, "texels");
  CubeFaces<Rgb32f> faces;
  double mean = 0;
  for (int f = 0; f < 6; ++f) {
    faces[f] = Image<Rgb32f>(64, 64);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const auto v = static_cast<float>(rng.Uniform());
        faces[f](x, y) = {v, v, v};
        mean += v * SolidAngle(CubeFace{static_cast<CubeFaceName>(f), 64}, x, y) / (4 * kPi);
      }
    }
  }
  for (int width : {32, 256, 512}) {
    const Equirectangular target{width, width / 2};
    const auto erp = StitchFiltered(faces, target);
    double sum = 0;
    for (int y = 0; y < target.height; ++y) {
      for (int x = 0; x < target.width; ++x) sum += erp(x, y).r * SolidAngle(target, x, y) / (4 * kPi);
    }
    EXPECT_NEAR(sum, mean, 2e-3) << width;
  }
}

TEST(Stitch, IdFacesGiveExactlyThePixelThatAnIndependentFormulaNames) {
  for (int size : {1, 5, 64, 100, 512}) {
    CubeFaces<uint32_t> faces;
    for (uint32_t f = 0; f < 6; ++f) {
      faces[f] = Image<uint32_t>(size, size);
      for (size_t i = 0; i < faces[f].size(); ++i) faces[f].pixels()[i] = (f << 20) + static_cast<uint32_t>(i);
    }
    const Equirectangular target{4 * size, 2 * size};
    const auto erp = StitchNearest(faces, target);
    for (int y = 0; y < target.height; ++y) {
      for (int x = 0; x < target.width; ++x) {
        // Of all faces, the one whose axis is nearest; then its pixel from the intersection with the cube.
        const Vec3d d = ErpDirection(target, x, y);
        int face = 0;
        for (int f = 1; f < 6; ++f) {
          if (Dot(d, FaceDirection(f, 0, 0)) > Dot(d, FaceDirection(face, 0, 0))) face = f;
        }
        // With odd sizes some rays meet an edge of the cube exactly: either face is right there.
        int nearest = 0;
        for (int f = 0; f < 6; ++f) nearest += Dot(d, FaceDirection(f, 0, 0)) > Dot(d, FaceDirection(face, 0, 0)) - 1e-12;
        if (nearest > 1) continue;
        const Vec3d forward = FaceDirection(face, 0, 0), right = FaceDirection(face, 1, 0) - forward,
                    down = FaceDirection(face, 0, 1) - forward;
        const Vec3d hit = d / Dot(d, forward);
        const int column = static_cast<int>(std::floor((Dot(hit, right) + 1) / 2 * size));
        const int row = static_cast<int>(std::floor((Dot(hit, down) + 1) / 2 * size));
        ASSERT_EQ(erp(x, y), (static_cast<uint32_t>(face) << 20) + static_cast<uint32_t>(row * size + column))
            << size << " at " << x << "," << y;
      }
    }
  }
}

// Distance along a unit ray from a point inside the room of +-5 m (x, z) and -4 ... 2 m (y down) to its
// walls.
double RoomRange(Vec3d p, Vec3d d) {
  double range = 1e30;
  const Vec3d low{-5, -4, -5}, high{5, 2, 5};
  for (int k = 0; k < 3; ++k) {
    if (d[k] != 0) range = std::min(range, ((d[k] > 0 ? high[k] : low[k]) - p[k]) / d[k]);
  }
  return range;
}

CubeFaces<float> RoomDepth(int size, Vec3d p) {
  CubeFaces<float> faces;
  for (int f = 0; f < 6; ++f) {
    faces[f] = Image<float>(size, size);
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const Vec3d d = Normalized(FaceDirection(f, (2 * x + 1.0) / size - 1, (2 * y + 1.0) / size - 1));
        faces[f](x, y) = static_cast<float>(RoomRange(p, d) * Dot(d, FaceDirection(f, 0, 0)));
      }
    }
  }
  return faces;
}

TEST(Stitch, PlanarDepthOfAFaceBecomesTheRangeOfItsRays) {
  const Vec3d p{0.3, -0.2, 0.1};
  const auto faces = RoomDepth(64, p);
  for (int f = 0; f < 6; ++f) {
    const auto range = RangeFromFaceDepth(faces[f]);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const Vec3d d = Normalized(FaceDirection(f, (2 * x + 1.0) / 64 - 1, (2 * y + 1.0) / 64 - 1));
        EXPECT_NEAR(range(x, y) / RoomRange(p, d), 1, 2e-7);  // two roundings to float
      }
    }
  }
}

TEST(Stitch, PlanarDepthOfARoomIsTheRangeOfTheDirectFormulaExceptAtCorners) {
  constexpr int kSize = 256;
  const Vec3d p{0.3, -0.2, 0.1};
  const auto faces = RoomDepth(kSize, p);
  const Equirectangular target{4 * kSize, 2 * kSize};
  const auto exact = StitchRangeFromDepth(faces, target);
  CubeFaces<float> ranges;
  for (int f = 0; f < 6; ++f) ranges[f] = RangeFromFaceDepth(faces[f]);
  const auto nearest = StitchNearest(ranges, target);
  int walls = 0;
  for (int y = 0; y < target.height; ++y) {
    for (int x = 0; x < target.width; ++x) {
      const Vec3d d = ErpDirection(target, x, y);
      const double expected = RoomRange(p, d);
      // A wall seen by the face it is parallel to has constant depth: exact. Any other is seen at a slant,
      // and its depth is that of a ray up to half a texel away, as is every plain nearest range.
      const Vec3d hit = p + d * expected;
      const double along = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
      const bool parallel = (std::abs(d.x) == along && std::abs(hit.x) > 4.999) || (std::abs(d.z) == along && std::abs(hit.z) > 4.999) ||
                            (std::abs(d.y) == along && (hit.y > 1.999 || hit.y < -3.999));
      // Half a texel within the edge of the wall the nearest texel may belong to the next wall.
      const double margin = 0.05;
      const int touching = (5 - std::abs(hit.x) < margin) + (5 - std::abs(hit.z) < margin) + (hit.y > 2 - margin || hit.y < -4 + margin);
      if (parallel && touching == 1) {
        ++walls;
        ASSERT_NEAR(exact(x, y) / expected, 1, 2e-7) << x << "," << y;
      }
      ASSERT_NEAR(exact(x, y) / expected, 1, 0.02) << x << "," << y;
      ASSERT_NEAR(nearest(x, y) / expected, 1, 0.02) << x << "," << y;
    }
  }
  EXPECT_GT(walls, static_cast<int>(exact.size()) / 2);
}

TEST(Stitch, RangeZeroStaysZero) { EXPECT_EQ(RangeFromFaceDepth(Image<float>(3, 3, 0)), Image<float>(3, 3, 0)); }

TEST(Stitch, FacesThatAreNotSquareOrNotEqualAreNamed) {
  CubeFaces<uint8_t> faces;
  faces.fill(Image<uint8_t>(8, 8));
  const auto message = [&] {
    try {
      StitchNearest(faces, Equirectangular{16, 8});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  faces[3] = Image<uint8_t>(8, 7);
  EXPECT_EQ(message(), "cube face -y has 8x7 pixels; faces must be square");
  faces[3] = Image<uint8_t>(9, 9);
  EXPECT_EQ(message(), "cube face -y has 9x9 pixels, cube face +x has 8x8; all faces must be equal");
  faces.fill({});
  EXPECT_EQ(message(), "cube face +x has 0x0 pixels; faces must be square");
  EXPECT_THROW(RangeFromFaceDepth(Image<float>(3, 4)), InputError);
}

Image<uint32_t> RandomLabels(int width, int height) {
  RngStream rng(4, "labels");
  Image<uint32_t> image(width, height);
  for (uint32_t& id : image.pixels()) id = static_cast<uint32_t>(rng.Bits());
  return image;
}

TEST(Resample, TurningByColumnsIsRollingThePictureExactly) {
  const Equirectangular erp{72, 36};
  const auto labels = RandomLabels(72, 36);
  for (int k : {0, 1, 17, 36, 71}) {
    // A target turned to the right by k columns about the vertical axis (down is +Y) sees what lies k columns
    // further on.
    const auto turned = ResampleNearest(labels, ResamplingMap(erp, erp, RotationY(k * 2 * kPi / 72)));
    for (int y = 0; y < 36; ++y) {
      for (int x = 0; x < 72; ++x) ASSERT_EQ(turned(x, y), labels((x + k) % 72, y)) << k;
    }
  }
}

TEST(Resample, ThereAndBackThroughALargerPictureKeepsLabels) {
  const Equirectangular small{64, 32};
  const Camera large = CubeFace{CubeFaceName::kPosZ, 512};
  const auto labels = RandomLabels(64, 32);
  const auto face = ResampleNearest(labels, ResamplingMap(large, small));
  const auto back = ResampleNearest(face, ResamplingMap(small, large), 7u);
  int seen = 0;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (RayToPixel(large, *PixelToRay(small, {x + 0.5, y + 0.5}))) {
        EXPECT_EQ(back(x, y), labels(x, y));
        ++seen;
      } else {
        EXPECT_EQ(back(x, y), 7u);
      }
    }
  }
  EXPECT_GT(seen, 200);
}

TEST(Resample, PanoramaToFacesAndBackKeepsLabels) {
  const Equirectangular erp{64, 32};
  const auto labels = RandomLabels(64, 32);
  CubeFaces<uint32_t> faces;
  for (int f = 0; f < 6; ++f) {
    faces[f] = ResampleNearest(labels, ResamplingMap(CubeFace{static_cast<CubeFaceName>(f), 600}, erp));
  }
  EXPECT_EQ(StitchNearest(faces, erp), labels);
}

Image<Rgb32f> DirectionPicture(const Camera& camera) {
  Image<Rgb32f> picture(Width(camera), Height(camera));
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const auto ray = PixelToRay(camera, {x + 0.5, y + 0.5});
      if (ray) picture(x, y) = {static_cast<float>(ray->x), static_cast<float>(ray->y), static_cast<float>(ray->z)};
    }
  }
  return picture;
}

TEST(Resample, DirectionsSurviveBetweenAnyTwoModelsAlsoOverSeamAndPoles) {
  const Mat3d R = RotationX(0.9) * RotationY(2.5) * RotationZ(-0.4);
  const std::vector<Camera> cameras = {Equirectangular{512, 256}, CubeFace{CubeFaceName::kNegZ, 200}, Pinhole{160, 120, 90, 95, 75, 66},
                                       Fisheye::Equidistant(200, 200, 4)};
  for (const Camera& source : cameras) {
    for (const Camera& target : cameras) {
      const auto map = ResamplingMap(target, source, R);
      const auto picture = ResampleBilinear(DirectionPicture(source), source, map);
      double worst = 0;
      for (int y = 1; y + 1 < map.height(); ++y) {
        for (int x = 1; x + 1 < map.width(); ++x) {
          const Vec2d at = map(x, y);
          // Half a pixel at the border of a source that does not close on itself has no neighbours; nor has a
          // circle's rim.
          const bool closed = source.index() == 0;
          if (std::isnan(at.x)) continue;
          if (!closed && (at.x < 1 || at.y < 1 || at.x > Width(source) - 1 || at.y > Height(source) - 1)) continue;
          if (source.index() == 3 && std::hypot(at.x - 100, at.y - 100) > 97) continue;
          const Vec3d expected = R * *PixelToRay(target, {x + 0.5, y + 0.5});
          const Rgb32f p = picture(x, y);
          worst = std::max(worst, Norm(Vec3d{p.r, p.g, p.b} - expected));
        }
      }
      // Bilinear interpolation errs by h^2 / 8 of the curvature in each axis; h is 4 / 200 at most.
      EXPECT_LT(worst, 2e-4) << source.index() << " to " << target.index();
    }
  }
}

TEST(Resample, WhatTheSourceDoesNotSeeIsFilled) {
  const Camera pinhole = Pinhole{32, 32, 16, 16, 16, 16};
  const Equirectangular erp{64, 32};
  const auto map = ResamplingMap(erp, pinhole);
  const auto labels = ResampleNearest(Image<uint8_t>(32, 32, 1), map, uint8_t{9});
  const auto colors = ResampleBilinear(Image<Rgb32f>(32, 32, {1, 1, 1}), pinhole, map);
  EXPECT_EQ(labels(0, 16), 9);
  EXPECT_EQ(colors(0, 16), (Rgb32f{0, 0, 0}));
  EXPECT_EQ(labels(32, 16), 1);
  EXPECT_EQ(colors(32, 16), (Rgb32f{1, 1, 1}));
  EXPECT_THROW(ResampleBilinear(Image<Rgb32f>(31, 32), pinhole, map), InputError);
  EXPECT_THROW(ResamplingMap(erp, Fisheye{}), InputError);
}

}  // namespace
}  // namespace airsim360

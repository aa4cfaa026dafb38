// No tile of a ground may be seen from the air: 64 m of it from 60 m, 10 cm a pixel, must not look like
// itself moved.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <vector>

#include "airsim360/image/color.h"
#include "airsim360/render/renderer.h"
#include "airsim360/worlds/kit/mesh_builder.h"
#include "airsim360/worlds/texture/surfaces.h"

namespace airsim360 {
namespace {

using Complex = std::complex<double>;
constexpr int kPixels = 640, kCrop = 512, kPadded = 1024;
constexpr double kMetresPerPixel = 0.1;

// One row in place, not normalised.
void Fourier(Complex* a, bool inverse) {
  static const std::vector<Complex> kTurns = [] {
    std::vector<Complex> turns;
    for (int k = 0; k < kPadded / 2; ++k) turns.push_back(std::polar(1.0, -2 * std::numbers::pi * k / kPadded));
    return turns;
  }();
  for (int i = 1, j = 0; i < kPadded; ++i) {
    int bit = kPadded >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(a[i], a[j]);
  }
  for (int length = 2; length <= kPadded; length *= 2) {
    for (int i = 0; i < kPadded; i += length) {
      for (int k = 0; k < length / 2; ++k) {
        const Complex& w = kTurns[k * (kPadded / length)];
        const Complex turn(w.real(), inverse ? -w.imag() : w.imag());
        const Complex odd = a[i + k + length / 2];
        const Complex t(odd.real() * turn.real() - odd.imag() * turn.imag(), odd.real() * turn.imag() + odd.imag() * turn.real());
        a[i + k + length / 2] = a[i + k] - t;
        a[i + k] += t;
      }
    }
  }
}

// Rows, then columns; the result is transposed, so two calls bring the axes back.
void Fourier2(std::vector<Complex>& a, bool inverse) {
  for (int pass = 0; pass < 2; ++pass) {
    for (int y = 0; y < kPadded; ++y) Fourier(&a[static_cast<size_t>(y) * kPadded], inverse);
    if (pass == 1) break;
    for (int y = 0; y < kPadded; ++y) {
      for (int x = 0; x < y; ++x) std::swap(a[static_cast<size_t>(y) * kPadded + x], a[static_cast<size_t>(x) * kPadded + y]);
    }
  }
}

// Normalised autocorrelation without bias: every lag divided by the number of pairs that it has.
class Autocorrelation {
 public:
  explicit Autocorrelation(const Image<Rgb8>& image) : power_(static_cast<size_t>(kPadded) * kPadded) {
    const auto light = [&](int x, int y) {
      const Rgb8 p = image(x + (kPixels - kCrop) / 2, y + (kPixels - kCrop) / 2);
      return 0.2126 * SrgbToLinear(p.r) + 0.7152 * SrgbToLinear(p.g) + 0.0722 * SrgbToLinear(p.b);
    };
    // What the eye takes for a repeat is detail that comes again, not that grounds are lighter here and
    // darker there: the mean of 4 m around is taken away.
    std::vector<double> sums(static_cast<size_t>(kCrop + 1) * (kCrop + 1));
    const auto sum = [&](int x, int y) -> double& { return sums[static_cast<size_t>(y) * (kCrop + 1) + x]; };
    for (int y = 0; y < kCrop; ++y) {
      for (int x = 0; x < kCrop; ++x) sum(x + 1, y + 1) = light(x, y) + sum(x, y + 1) + sum(x + 1, y) - sum(x, y);
    }
    const int half = static_cast<int>(2 / kMetresPerPixel);
    for (int y = 0; y < kCrop; ++y) {
      for (int x = 0; x < kCrop; ++x) {
        const int x0 = std::max(x - half, 0), x1 = std::min(x + half + 1, kCrop), y0 = std::max(y - half, 0),
                  y1 = std::min(y + half + 1, kCrop);
        const double around = (sum(x1, y1) - sum(x0, y1) - sum(x1, y0) + sum(x0, y0)) / (x1 - x0) / (y1 - y0);
        power_[static_cast<size_t>(y) * kPadded + x] = light(x, y) - around;
      }
    }
    Fourier2(power_, false);
    for (Complex& c : power_) c = std::norm(c);
    Fourier2(power_, true);
    zero_ = power_[0].real() / kCrop / kCrop;
  }
  double At(int dx, int dy) const {
    const auto pairs = static_cast<double>(kCrop - std::abs(dx)) * (kCrop - std::abs(dy));
    return power_[static_cast<size_t>(dy & (kPadded - 1)) * kPadded + (dx & (kPadded - 1))].real() / pairs / zero_;
  }
  // Radius in pixels where the mean over directions first falls below 0.12.
  int FirstLobe() const {
    for (int r = 1; r < kCrop / 2; ++r) {
      double sum = 0;
      for (int k = 0; k < 64; ++k) {
        const double a = std::numbers::pi * k / 64;
        sum += At(static_cast<int>(std::lround(r * std::cos(a))), static_cast<int>(std::lround(r * std::sin(a)))) / 64;
      }
      if (sum < 0.12) return r;
    }
    return kCrop / 2;
  }
  // Highest value outside the first lobe, up to half the crop.
  double Peak(int lobe) const {
    double peak = -1;
    for (int dy = 0; dy < kCrop / 2; ++dy) {
      for (int dx = -kCrop / 2 + 1; dx < kCrop / 2; ++dx) {
        if (dx * dx + dy * dy > (lobe + 1) * (lobe + 1)) peak = std::max(peak, At(dx, dy));
      }
    }
    return peak;
  }

 private:
  std::vector<Complex> power_;
  double zero_ = 1;
};

// Grounds side by side, 90 m each; a camera 60 m above the middle of one of them.
class Grounds {
 public:
  explicit Grounds(const std::vector<Surface>& kinds) {
    SceneBuilder builder("grounds");
    builder.AddSky();
    builder.environment().cloud_cover = builder.environment().cirrus_cover = 0;
    const Surfaces surfaces = AddSurfaces(builder);
    const EntityId entity = builder.AddEntity("ground", builder.tree().At("ground/road"));
    for (size_t i = 0; i < kinds.size(); ++i) {
      MeshBuilder mesh;
      mesh.SetMaterial(surfaces[kinds[i]]);
      const float x = 90 * static_cast<float>(i);
      mesh.Polygon(std::vector<Vec2f>{{x, 0}, {x + 90, 0}, {x + 90, 90}, {x, 90}}, 0);
      builder.AddInstance({builder.AddMesh(mesh.Finish("ground")), {}, entity});
    }
    renderer_ = MakeCpuRenderer(std::make_shared<RayTracer>(builder.Build()), {.tier = Tier::kFast});
  }
  Image<Rgb8> FromAbove(size_t i) {
    const double focal = 60 / kMetresPerPixel;
    RenderRequest request;
    request.camera = Pinhole{kPixels, kPixels, focal, focal, kPixels / 2.0, kPixels / 2.0};
    request.X_WC = BodyPose({90.0 * static_cast<double>(i) + 45, 45, 60}, 0, -std::numbers::pi / 2, 0) * CameraInBody();
    request.products = {.rgb = true, .range = false, .semantic = false, .entity = false};
    Frame frame;
    renderer_->Render(request, frame);
    return frame.rgb;
  }

 private:
  std::unique_ptr<Renderer> renderer_;
};

TEST(Repeat, NoGroundRepeatsWithin64Metres) {
  const std::vector<Surface> kinds = {Surface::kAsphalt, Surface::kLawn, Surface::kPath, Surface::kSoil, Surface::kRoofBitumen};
  const char* names[] = {"asphalt", "lawn", "gravel", "soil", "bitumen"};
  Grounds grounds(kinds);
  for (size_t i = 0; i < kinds.size(); ++i) {
    const Autocorrelation correlation(grounds.FromAbove(i));
    const int lobe = correlation.FirstLobe();
    const double peak = correlation.Peak(lobe);
    std::printf("%s: first lobe %.1f m, highest value outside %.3f\n", names[i], lobe * kMetresPerPixel, peak);
    EXPECT_LT(peak, 0.25) << names[i];
  }
}

}  // namespace
}  // namespace airsim360

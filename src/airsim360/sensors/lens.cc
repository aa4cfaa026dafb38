#include "airsim360/sensors/lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/image/codecs.h"
#include "airsim360/render/filter/tone_map.h"

namespace airsim360 {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kBandRows = 16;

/// Approximately normal with variance 1: the sum of four uniform numbers (Irwin-Hall), at most 3.46.
float NormalOfBits(uint64_t bits) {
  const auto part = [&](int k) { return static_cast<float>((bits >> (16 * k)) & 0xffff); };
  return ((part(0) + part(1) + part(2) + part(3)) * (1.0f / 65536) - 2) * 1.7320508f;
}

Rgb32f Bilinear(const Image<Rgb32f>& image, Vec2d at) {
  const double fx = std::floor(at.x - 0.5), fy = std::floor(at.y - 0.5);
  const auto u = static_cast<float>(at.x - 0.5 - fx), v = static_cast<float>(at.y - 0.5 - fy);
  const auto read = [&](int dx, int dy) {
    return image(std::clamp(static_cast<int>(fx) + dx, 0, image.width() - 1),
                 std::clamp(static_cast<int>(fy) + dy, 0, image.height() - 1));
  };
  const Rgb32f a = read(0, 0), b = read(1, 0), c = read(0, 1), d = read(1, 1);
  const auto mix = [&](float p, float q, float r, float s) {
    return (p * (1 - u) + q * u) * (1 - v) + (r * (1 - u) + s * u) * v;
  };
  return {mix(a.r, b.r, c.r, d.r), mix(a.g, b.g, c.g, d.g), mix(a.b, b.b, c.b, d.b)};
}

/// Mean of n x n pixels.
Image<Rgb32f> Reduce(const Image<Rgb32f>& image, int n) {
  if (n == 1) return image;
  Image<Rgb32f> result(image.width() / n, image.height() / n);
  const float scale = 1.0f / static_cast<float>(n * n);
  ParallelFor(result.height(), [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < result.width(); ++x) {
      Rgb32f sum;
      for (int k = 0; k < n * n; ++k) {
        const Rgb32f c = image(x * n + k % n, y * n + k / n);
        sum.r += c.r, sum.g += c.g, sum.b += c.b;
      }
      result(x, y) = {sum.r * scale, sum.g * scale, sum.b * scale};
    }
  });
  return result;
}

/// Tier fast has no antialiased radiance: its sensors are rendered twice as fine.
int Oversampling(Tier tier) { return tier == Tier::kFast ? 2 : 1; }

/// The exposed light of one sensor, row by row at its own time.
Image<Rgb32f> RenderSensor(const Real360& lens, const RenderRequest& settings, const PoseAt& X_WC,
                           bool moving, float exposure, bool rear, const Fisheye& camera, Renderer& renderer,
                           RenderStats& stats) {
  const int n = Oversampling(settings.tier);
  const Fisheye fine{
      camera.width * n, camera.height * n, camera.fx * n, camera.fy * n, camera.cx * n, camera.cy * n, {},
      camera.max_theta};
  RenderRequest request = settings;
  request.products = {.rgb = false, .range = false, .semantic = false, .entity = false, .radiance = true};
  request.auto_exposure = false;
  request.X_WC_next.reset();
  Image<Rgb32f> light(fine.width, fine.height);
  Frame frame;
  const int step = moving && lens.readout > 0 ? kBandRows * n : fine.height;
  for (int first = 0; first < fine.height; first += step) {
    Fisheye band = fine;
    band.height = std::min(step, fine.height - first);
    band.cy = fine.cy - first;
    const double t = ((first + 0.5 * band.height) / fine.height - 0.5) * lens.readout;
    request.camera = band;
    request.X_WC = X_WC(t) * internal::SensorPose(lens, rear);
    const RenderStats part = renderer.Render(request, frame);
    stats.rays += part.rays;
    stats.render_ms += part.render_ms;
    if (frame.radiance.empty()) throw InputError("lens real360: this tier or renderer gives no radiance");
    const float scale = exposure > 0 ? exposure : frame.exposure;
    std::transform(frame.radiance.pixels().begin(), frame.radiance.pixels().end(), &light(0, first),
                   [scale](Rgb32f c) {
                     return Rgb32f{c.r * scale, c.g * scale, c.b * scale};
                   });
  }
  return Reduce(light, n);
}

}  // namespace

LensModel ParseLensModel(std::string_view name) {
  const std::vector<std::string> names(std::begin(kLensModelNames), std::end(kLensModelNames));
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw InputError(UnknownChoiceMessage("lens", name, names));
  return static_cast<LensModel>(found - names.begin());
}

Real360 Real360::Perfect() {
  Real360 lens;
  lens.baseline = lens.vignetting = lens.mismatch_ev = lens.read_noise = lens.readout = lens.fringe = 0;
  lens.full_well = 1e12;
  lens.jpeg_quality = 0;
  return lens;
}

void Real360::Visit(ConfigVisitor& v) {
  v.Field("fov_deg", "field of view of each fisheye, degrees", fov_deg, 180, 220);
  v.Field("baseline", "metres between the optical centres", baseline, 0, 1);
  v.Field("blend_deg", "width of the blended seam, degrees", blend_deg, 0.01, 40);
  v.Field("vignetting", "share of light missing at the rim", vignetting, 0, 1);
  v.Field("mismatch_ev", "stops by which the rear picture is brighter", mismatch_ev, -2, 2);
  v.Field("full_well", "photo-electrons of a pixel at white", full_well, 10, 1e12);
  v.Field("read_noise", "electrons, standard deviation", read_noise, 0, 1e4);
  v.Field("readout", "seconds from the first row to the last", readout, 0, 1);
  v.Field("fringe", "lateral colour: magnification of red", fringe, 0, 0.05);
  v.Field("jpeg_quality", "1 to 100, 0 = not compressed", jpeg_quality, 0, 100);
}

void CheckReal360(const Real360& lens) {
  if (!(lens.fov_deg >= 180 + lens.blend_deg && lens.fov_deg <= 220)) {
    throw InputError("real360: fov_deg " + std::to_string(lens.fov_deg) + " is not in 180 + blend_deg (" +
                     std::to_string(180 + lens.blend_deg) + ") … 220");
  }
  if (!(lens.full_well > 0)) throw InputError("real360: full_well must be positive");
}

double NoiseVariance(const Real360& lens, double signal) {
  const double read = lens.read_noise / lens.full_well;
  return std::max(signal, 0.0) / lens.full_well + read * read;
}

RenderStats RenderReal360(const Real360& lens, const RenderRequest& request, const PoseAt& X_WC, bool moving,
                          float exposure, uint64_t frame, const Equirectangular& target, Renderer& renderer,
                          Image<Rgb8>& rgb) {
  CheckReal360(lens);
  const Fisheye camera = internal::SensorCamera(lens, target);
  RenderStats stats;
  Image<Rgb32f> sensors[2];
  for (const bool rear : {false, true}) {
    Image<Rgb32f>& light = sensors[rear ? 1 : 0];
    light = RenderSensor(lens, request, X_WC, moving, exposure, rear, camera, renderer, stats);
    internal::ExposeSensor(lens, camera, rear, request.seed, frame, light);
  }
  const Image<Rgb32f> light = internal::StitchSensors(lens, camera, sensors[0], sensors[1], target);
  ToneMapImage(light, 1, request.tone, rgb);
  if (lens.jpeg_quality < 1) return stats;
  const Image<Rgba8> coded =
      DecodeRgba8(EncodeJpeg(rgb, static_cast<int>(lens.jpeg_quality)), "picture of real360");
  std::transform(coded.pixels().begin(), coded.pixels().end(), rgb.pixels().begin(), [](Rgba8 c) {
    return Rgb8{c.r, c.g, c.b};
  });
  return stats;
}

namespace internal {

Fisheye SensorCamera(const Real360& lens, const Equirectangular& target) {
  const int size = static_cast<int>(std::lround(lens.fov_deg / 180 * target.height));
  return Fisheye::Equidistant(size, size, lens.fov_deg * kDegree);
}

RigidTransform SensorPose(const Real360& lens, bool rear) {
  const double half = 0.5 * lens.baseline;
  return rear ? RigidTransform{RotationY(std::numbers::pi), {0, 0, -half}} : RigidTransform{{}, {0, 0, half}};
}

void ExposeSensor(const Real360& lens, const Fisheye& camera, bool rear, uint64_t seed, uint64_t frame,
                  Image<Rgb32f>& light) {
  const double gain = rear ? std::exp2(lens.mismatch_ev) : 1;
  const uint64_t key = RngStream(seed, "real360", 2 * frame + (rear ? 1 : 0)).Bits();
  ParallelFor(light.height(), [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < light.width(); ++x) {
      const double theta = std::hypot(x + 0.5 - camera.cx, y + 0.5 - camera.cy) / camera.fx;
      const double rim = theta / camera.max_theta;
      const double scale = rim < 1 ? gain * (1 - lens.vignetting * rim * rim) : 0;
      const uint64_t pixel =
          3 * (static_cast<uint64_t>(y) * static_cast<uint64_t>(light.width()) + static_cast<uint64_t>(x));
      const auto expose = [&](float value, uint64_t channel) {
        const double signal = value * scale;
        const auto sigma = static_cast<float>(std::sqrt(NoiseVariance(lens, signal)));
        return static_cast<float>(signal) + sigma * NormalOfBits(MixBits(key + pixel + channel));
      };
      const Rgb32f c = light(x, y);
      light(x, y) = {expose(c.r, 0), expose(c.g, 1), expose(c.b, 2)};
    }
  });
}

Image<Rgb32f> StitchSensors(const Real360& lens, const Fisheye& camera, const Image<Rgb32f>& front,
                            const Image<Rgb32f>& rear, const Equirectangular& target) {
  const Camera sensor = camera;
  // Where a sensor sees a direction of its own frame, each colour magnified a little differently.
  const auto look = [&](const Image<Rgb32f>& image, Vec3d d) -> Rgb32f {
    const Vec2d at = RayToPixel(sensor, d).value_or(Vec2d{camera.cx, camera.cy});
    if (lens.fringe == 0) return Bilinear(image, at);
    const Vec2d off = (at - Vec2d{camera.cx, camera.cy}) * lens.fringe;
    return {Bilinear(image, at + off).r, Bilinear(image, at).g, Bilinear(image, at - off).b};
  };
  const double blend = lens.blend_deg * kDegree;
  Image<Rgb32f> result(target.width, target.height);
  ParallelFor(target.height, [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < target.width; ++x) {
      const Vec3d d = *PixelToRay(target, {x + 0.5, y + 0.5});
      const double from_front = std::acos(std::clamp(d.z, -1.0, 1.0));
      const double t = std::clamp((from_front - std::numbers::pi / 2) / blend + 0.5, 0.0, 1.0);
      const auto w = static_cast<float>(t * t * (3 - 2 * t));
      Rgb32f c;
      if (w < 1) c = look(front, d);
      if (w > 0) {
        const Rgb32f b = look(rear, {-d.x, d.y, -d.z});
        c = w < 1 ? Rgb32f{c.r + (b.r - c.r) * w, c.g + (b.g - c.g) * w, c.b + (b.b - c.b) * w} : b;
      }
      result(x, y) = c;
    }
  });
  return result;
}

}  // namespace internal
}  // namespace airsim360

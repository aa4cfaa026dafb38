#include "airsim360/flight/mesh/drone_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace airsim360 {
namespace {

constexpr int kSides = 16;
constexpr Vec3f kCarbon{0.03f, 0.03f, 0.035f}, kShell{0.22f, 0.23f, 0.25f}, kMetal{0.35f, 0.35f, 0.36f}, kFront{0.75f, 0.12f, 0.03f},
    kBlade{0.08f, 0.08f, 0.09f};

/// Axes of a solid: three orthogonal unit vectors.
struct Axes {
  Vec3d x, y, z;
};

Axes AxesAlong(Vec3d z) {
  const Vec3d helper = std::abs(z.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d y = Normalized(Cross(z, helper));
  return {Cross(y, z), y, z};
}

class Builder {
 public:
  void Begin(std::string name, Vec3f color, int rotor = -1) {
    out_.parts.push_back({std::move(name), color, static_cast<uint32_t>(out_.triangles.size()), 0, rotor});
  }
  /// A box with half edges `half` along `axes`.
  void Box(Vec3d center, const Axes& axes, Vec3d half) {
    const uint32_t first = Size();
    for (int i = 0; i < 8; ++i) {
      Add(center + axes.x * (i & 1 ? half.x : -half.x) + axes.y * (i & 2 ? half.y : -half.y) + axes.z * (i & 4 ? half.z : -half.z));
    }
    constexpr uint32_t kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& f : kFaces) {
      Triangle(first + f[0], first + f[1], first + f[2]);
      Triangle(first + f[0], first + f[2], first + f[3]);
    }
  }
  /// A cylinder from `bottom`, `height` along axes.z.
  void Cylinder(Vec3d bottom, const Axes& axes, double radius, double height) {
    const uint32_t first = Size();
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSides;
      const Vec3d rim = bottom + (axes.x * std::cos(angle) + axes.y * std::sin(angle)) * radius;
      Add(rim);
      Add(rim + axes.z * height);
    }
    Add(bottom);
    Add(bottom + axes.z * height);
    const uint32_t low = first + 2 * kSides, high = low + 1;
    for (uint32_t i = 0; i < kSides; ++i) {
      const uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % kSides);
      Triangle(a, b, b + 1);
      Triangle(a, b + 1, a + 1);
      Triangle(low, b, a);
      Triangle(high, a + 1, b + 1);
    }
  }
  DroneBody Take() { return std::move(out_); }

 private:
  uint32_t Size() const { return static_cast<uint32_t>(out_.positions.size()); }
  void Add(Vec3d p) { out_.positions.push_back(VecCast<float>(p)); }
  void Triangle(uint32_t a, uint32_t b, uint32_t c) {
    out_.triangles.push_back({a, b, c});
    ++out_.parts.back().count;
  }
  DroneBody out_;
};

/// A propeller of flat blades, each a box pitched by 15 degrees against the direction it turns in.
void AddBlades(Builder& builder, const RotorModel& rotor, Vec3d hub, int blades, double thick) {
  const Axes axes = AxesAlong(rotor.axis_B);
  const double lean = 0.26 * -rotor.direction;
  for (int i = 0; i < blades; ++i) {
    const double angle = 2 * std::numbers::pi * i / blades;
    const Vec3d out = axes.x * std::cos(angle) + axes.y * std::sin(angle), side = Cross(axes.z, out);
    const Axes blade{out, side * std::cos(lean) + axes.z * std::sin(lean), axes.z * std::cos(lean) - side * std::sin(lean)};
    const double radius = rotor.diameter / 2;
    builder.Box(hub + out * (radius / 2), blade, {radius / 2, 0.05 * rotor.diameter, thick / 2});
  }
}

}  // namespace

DroneBody MakeDroneBody(const DroneModel& model, const DroneBodyOptions& options) {
  // Proportions from arms and propellers.
  double arm = 0, diameter = 0, lowest = 0;
  for (const RotorModel& rotor : model.rotors) {
    arm = std::max(arm, std::hypot(rotor.p_B.x, rotor.p_B.y));
    diameter = std::max(diameter, rotor.diameter);
    lowest = std::min(lowest, rotor.p_B.z);
  }
  const Vec3d half{0.40 * arm, 0.25 * arm, 0.13 * arm};
  const double bottom = model.half_size_B.z > half.z ? -model.half_size_B.z : -1.6 * half.z;
  const double motor = std::max(0.09 * diameter, 0.04 * arm), thick = 0.012 * diameter;
  const Axes level{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

  Builder builder;
  builder.Begin("body", kShell);
  builder.Box({}, level, half);
  // A bright nose shows where forward is.
  builder.Begin("front", kFront);
  builder.Box({half.x, 0, 0.2 * half.z}, level, {0.12 * half.x, 0.5 * half.y, 0.4 * half.z});

  for (size_t i = 0; i < model.rotors.size(); ++i) {
    const RotorModel& rotor = model.rotors[i];
    const std::string number = " " + std::to_string(i + 1);
    const Axes up = AxesAlong(rotor.axis_B);
    // The motor reaches from its arm up to the propeller, both within the box of the drone.
    const double height = 0.5 * motor;
    const Vec3d foot = rotor.p_B - rotor.axis_B * (height + thick);
    const double reach = Norm(foot);
    if (reach > 1e-9) {
      const Vec3d along = foot / reach;
      const Vec3d side = Normalized(Cross({0, 0, 1}, along));
      builder.Begin("arm" + number, kCarbon);
      builder.Box(foot * 0.5, {along, side, Cross(along, side)}, {reach / 2, 0.04 * diameter, 0.025 * diameter});
    }
    builder.Begin("motor" + number, rotor.p_B.x > 0.2 * arm ? kFront : kMetal);
    builder.Cylinder(foot, up, motor, height);
    builder.Begin("propeller" + number, kBlade, static_cast<int>(i));
    if (options.discs) {
      builder.Cylinder(rotor.p_B - rotor.axis_B * (thick / 2), up, rotor.diameter / 2, thick);
    } else {
      AddBlades(builder, rotor, rotor.p_B, options.blades, thick);
    }
  }
  // Four legs down to where the drone touches.
  for (int i = 0; i < 4; ++i) {
    const double x = (i & 1 ? 0.8 : -0.8) * half.x, y = (i & 2 ? 0.9 : -0.9) * half.y;
    const double length = -bottom - 0.8 * half.z;
    builder.Begin("leg " + std::to_string(i + 1), kCarbon);
    builder.Cylinder({x, y, bottom}, level, 0.03 * arm, std::max(length, 0.02 * arm));
  }
  return builder.Take();
}

}  // namespace airsim360

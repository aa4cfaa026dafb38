#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/worlds/town/ground.h"
#include "airsim360/worlds/town/street_wear.h"

namespace airsim360 {
namespace {

constexpr float kKerbWidth = 0.15f, kTactileDepth = 0.61f, kRampDepth = 1.5f, kRampDrop = 0.11f, kFlare = 0.9f, kFieldLength = 10;

// Height of the pavement at (s, d) of a side of length `length`: flat but for the dropped kerbs at both ends.
class SideProfile {
 public:
  SideProfile(float length, float radius) : length_(length), start_(radius + kCrosswalkStart) {}
  float Drop(float s) const {
    const float t = std::min(s, length_ - s);  // distance from the nearer end
    const float low = start_ - kFlare, high = start_ + kCrosswalkWidth + kFlare;
    return kRampDrop * std::clamp(std::min(t - low, high - t) / kFlare, 0.0f, 1.0f);
  }
  float Height(float s, float d) const { return -Drop(s) * std::clamp(1 - (d - kKerbWidth) / kRampDepth, 0.0f, 1.0f); }
  // Where the profile bends.
  std::vector<float> Bends() const {
    std::vector<float> bends;
    for (float t : {start_ - kFlare, start_, start_ + kCrosswalkWidth, start_ + kCrosswalkWidth + kFlare}) {
      bends.push_back(t);
      bends.push_back(length_ - t);
    }
    return bends;
  }
  bool OnRamp(float s) const { return Drop(s) > 0.99f * kRampDrop; }

 private:
  float length_, start_;
};

// Breakpoints along a side: field joints and ramp bends, sorted, without near duplicates.
std::vector<float> Breakpoints(const SideProfile& profile, float s0, float s1, int fields) {
  std::vector<float> stops = profile.Bends();
  for (int i = 0; i <= fields; ++i) stops.push_back(s0 + (s1 - s0) * static_cast<float>(i) / static_cast<float>(fields));
  std::sort(stops.begin(), stops.end());
  std::vector<float> kept;
  for (float s : stops) {
    if (s < s0 - 1e-4f || s > s1 + 1e-4f) continue;
    if (kept.empty() || s - kept.back() > 0.02f) kept.push_back(s);
  }
  return kept;
}

std::string PlaceName(const Block& block, int side) {
  static constexpr const char* kSides[] = {"south", "east", "north", "west"};
  return std::string(kSides[side]) + " of block " + std::to_string(block.column) + "." + std::to_string(block.row);
}

void LayKerb(Ground& ground, const Block& block, int side) {
  const BlockSide line = SideOf(block, side);
  const SideProfile profile(line.length, block.corner_radius);
  const float r = block.corner_radius;
  ground.Begin("kerb " + PlaceName(block, side), "ground/kerb", Surface::kKerb);
  const auto strip = [&](Vec2f a, Vec2f b, Vec2f a_in, Vec2f b_in, float za, float zb) {
    ground.Quad({a.x, a.y, za}, {b.x, b.y, zb}, {b_in.x, b_in.y, zb}, {a_in.x, a_in.y, za});
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    ground.mesh().QuadUv({a.x, a.y, -0.17f}, {b.x, b.y, -0.17f}, {b.x, b.y, zb}, {a.x, a.y, za}, {0, 0.17f}, {length, 0.17f}, {length, -zb},
                         {0, -za});
  };
  // Straight part, lowered where the profile drops.
  const std::vector<float> stops = Breakpoints(profile, r, line.length - r, 1);
  for (size_t i = 0; i + 1 < stops.size(); ++i) {
    strip(line.At(stops[i], 0), line.At(stops[i + 1], 0), line.At(stops[i], kKerbWidth), line.At(stops[i + 1], kKerbWidth),
          -profile.Drop(stops[i]), -profile.Drop(stops[i + 1]));
  }
  // The return at the far end of the side.
  const auto arc = [&](float radius, int i) {
    const float a = std::numbers::pi_v<float> / 2 * static_cast<float>(i) / 10;
    return line.At(line.length - r + radius * std::sin(a), r - radius * std::cos(a));
  };
  for (int i = 0; i < 10; ++i) strip(arc(r, i), arc(r, i + 1), arc(r - kKerbWidth, i), arc(r - kKerbWidth, i + 1), 0, 0);
}

void LayFields(Ground& ground, const Block& block, int side, Surface slabs, std::string_view category, bool worn) {
  RngStream rng(static_cast<uint64_t>(block.row * 8 + block.column), "pavement wear", static_cast<uint64_t>(side));
  const BlockSide line = SideOf(block, side);
  const SideProfile profile(line.length, block.corner_radius);
  const float r = block.corner_radius, s0 = r, s1 = line.length - r;
  const int fields = std::max(1, static_cast<int>((s1 - s0) / kFieldLength));
  const float field_length = (s1 - s0) / static_cast<float>(fields);
  const std::vector<float> stops = Breakpoints(profile, s0, s1, fields);
  const float depths[] = {kKerbWidth, kKerbWidth + kTactileDepth, kKerbWidth + kRampDepth, block.pavement};
  const auto at = [&](float s, float d) {
    const Vec2f p = line.At(s, d);
    return Vec3f{p.x, p.y, profile.Height(s, d)};
  };
  int field = -1;
  for (size_t i = 0; i + 1 < stops.size(); ++i) {
    const float middle = (stops[i] + stops[i + 1]) / 2;
    const int now = std::clamp(static_cast<int>((middle - s0) / field_length), 0, fields - 1);
    if (now != field) ground.Begin("pavement " + PlaceName(block, side), category, slabs);
    field = now;
    for (int k = 0; k < 3; ++k) {
      ground.Use(k == 0 && profile.OnRamp(middle) ? Surface::kTactile : slabs);
      ground.Quad(at(stops[i], depths[k]), at(stops[i + 1], depths[k]), at(stops[i + 1], depths[k + 1]), at(stops[i], depths[k + 1]));
    }
    if (!worn || stops[i + 1] - stops[i] < 1.5f) continue;
    const auto lifted = [&](float s, float d, float lift) { return at(s, d) + Vec3f{0, 0, lift}; };
    internal::LayPavementWear(ground, lifted, stops[i], stops[i + 1], depths[2] + 0.03f, block.pavement, slabs, rng);
  }
}

void LayCorner(Ground& ground, const Block& block, int side, Surface slabs, std::string_view category, bool worn) {
  const BlockSide line = SideOf(block, side);
  const float r = block.corner_radius, back = r - kKerbWidth, length = line.length;
  std::vector<Vec2f> outline;
  for (int i = 0; i <= 10; ++i) {
    const float a = std::numbers::pi_v<float> / 2 * static_cast<float>(i) / 10;
    outline.push_back(line.At(length - r + back * std::sin(a), r - back * std::cos(a)));
  }
  outline.push_back(line.At(length - block.pavement, r));
  outline.push_back(line.At(length - block.pavement, block.pavement));
  outline.push_back(line.At(length - r, block.pavement));
  ground.Begin("pavement corner " + PlaceName(block, side), category, slabs);
  ground.Polygon(outline, 0);
  if (!worn) return;
  RngStream rng(static_cast<uint64_t>(block.row * 8 + block.column), "corner wear", static_cast<uint64_t>(side));
  const auto lifted = [&](float s, float d, float lift) {
    const Vec2f p = line.At(s, d);
    return Vec3f{p.x, p.y, lift};
  };
  internal::LayPavementWear(ground, lifted, length - r, length - 0.36f * r, 0.36f * r, block.pavement, slabs, rng);
}

}  // namespace

void LayPavement(Ground& ground, const Block& block, Surface slabs, std::string_view category, bool worn) {
  for (int side = 0; side < 4; ++side) {
    LayKerb(ground, block, side);
    LayFields(ground, block, side, slabs, category, worn);
    LayCorner(ground, block, side, slabs, category, worn);
  }
}

}  // namespace airsim360

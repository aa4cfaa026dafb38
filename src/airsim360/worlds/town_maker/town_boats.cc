// Piers and boats.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/osm/osm_ground_builder.h"
#include "airsim360/worlds/town/district.h"
#include "airsim360/worlds/town_maker/town_finisher.h"

namespace airsim360::internal {

// Planks on posts out into the water; its front is where it goes.
void TownFinisher::Jetty(const TownSpot& spot) {
  Start("jetty", "construction/bridge", spot.p, spot.front, 0.06);
  const auto reach = static_cast<float>(spot.size);
  const float half = spec_.paving == TownPaving::kDirt ? 0.95f : 1.4f;
  mesh_.SetMaterial(scene_.surfaces[Surface::kFrameWood]);
  // Boards with gaps too small to step into, on two beams.
  for (float y = 1.5f; y > -reach; y -= 0.24f) mesh_.Box({-half, y - 0.225f, -0.08f}, {half, y, 0});
  for (float x : {-half + 0.2f, half - 0.34f}) mesh_.Box({x, -reach, -0.26f}, {x + 0.14f, 1.2f, -0.085f});
  for (float y = -1.5f; y > -reach; y -= 3.2f)
    for (float x : {-half - 0.06f, half + 0.06f}) mesh_.Tube({x, y, -2.6f}, {x, y, 0.75f}, 0.11f, 0.1f, 10, false, true);
}

// A hull lofted over sections; its front is the bow.
void TownFinisher::Boat(const TownSpot& spot, double length, double beam, bool mast, bool cabin) {
  static constexpr Vec3f kPaints[] = {
      {0.62f, 0.62f, 0.60f}, {0.05f, 0.13f, 0.30f}, {0.45f, 0.06f, 0.05f}, {0.08f, 0.28f, 0.22f}, {0.60f, 0.48f, 0.16f}};
  Start(mast ? "sailing boat" : cabin ? "boat" : "rowing boat", "vehicle/boat", spot.p, spot.front, -kWaterDrop);
  const MaterialId hull = scene_.tints.Get(scene_.surfaces[Surface::kPanelWhite], kPaints[rng_.Index(5)], 0.6f);
  const auto L = static_cast<float>(length), B = static_cast<float>(beam);
  const float freeboard = cabin ? 0.75f : 0.42f, draught = 0.22f;
  const int n = 12;
  // Half breadth at share t from stern to bow.
  const auto breadth = [&](float t) {
    return B / 2 * (t < 0.55f ? 0.82f + 0.18f * std::sin(t / 0.55f * 1.5708f) : std::cos((t - 0.55f) / 0.45f * 1.5708f));
  };
  const auto sheer = [&](float t) { return freeboard * (1 + 0.45f * t * t); };
  for (int i = 0; i < n; ++i) {
    const float t0 = static_cast<float>(i) / n, t1 = static_cast<float>(i + 1) / n;
    const float y0 = L / 2 - L * t0, y1 = L / 2 - L * t1;
    for (float side : {-1.0f, 1.0f}) {
      const Vec3f a{side * breadth(t0), y0, sheer(t0)}, b{side * breadth(t1), y1, sheer(t1)};
      const Vec3f c{side * breadth(t1) * 0.62f, y1, -draught}, d{side * breadth(t0) * 0.62f, y0, -draught};
      mesh_.SetMaterial(hull);
      side > 0 ? mesh_.Quad(c, d, a, b) : mesh_.Quad(d, c, b, a);
      // Inside, a hand lower, or a deck.
      mesh_.SetMaterial(scene_.surfaces[Surface::kFrameWood]);
      const float drop = cabin ? 0.06f : 0.3f;
      const Vec3f m0{0, y0, sheer(t0) - drop}, m1{0, y1, sheer(t1) - drop}, e{side * breadth(t0) * 0.94f, y0, sheer(t0) - drop},
          f{side * breadth(t1) * 0.94f, y1, sheer(t1) - drop};
      side > 0 ? mesh_.Quad(m1, f, e, m0) : mesh_.Quad(m0, e, f, m1);
      side > 0 ? mesh_.Quad(f, b, a, e) : mesh_.Quad(e, a, b, f);
    }
  }
  mesh_.SetMaterial(hull);
  mesh_.Quad({breadth(0), L / 2, sheer(0)}, {-breadth(0), L / 2, sheer(0)}, {-breadth(0) * 0.62f, L / 2, -draught},
             {breadth(0) * 0.62f, L / 2, -draught});
  if (!cabin) {
    mesh_.SetMaterial(scene_.surfaces[Surface::kFrameWood]);
    for (float y : {-0.18f * L, 0.12f * L}) mesh_.Box({-0.4f * B, y, freeboard - 0.16f}, {0.4f * B, y + 0.22f, freeboard - 0.12f});
    return;
  }
  mesh_.SetMaterial(scene_.surfaces[Surface::kPanelWhite]);
  const float roof = freeboard + (mast ? 0.55f : 1.5f);
  mesh_.Box({-0.27f * B, -0.18f * L, freeboard - 0.1f}, {0.27f * B, 0.12f * L, roof});
  mesh_.SetMaterial(scene_.surfaces[Surface::kGlassDark]);
  mesh_.Box({-0.275f * B, -0.16f * L, roof - 0.42f}, {0.275f * B, 0.1f * L, roof - 0.12f}, MeshBuilder::kLeft | MeshBuilder::kRight);
  mesh_.Box({-0.23f * B, -0.183f * L, roof - 0.42f}, {0.23f * B, 0.0f, roof - 0.12f}, MeshBuilder::kFront);
  mesh_.SetMaterial(scene_.surfaces[Surface::kMetal]);
  if (mast) {
    mesh_.Tube({0, -0.08f * L, freeboard}, {0, -0.08f * L, 1.25f * L}, 0.07f, 0.045f, 10, false, true);
    mesh_.Tube({0, -0.08f * L, roof + 0.5f}, {0, 0.36f * L, roof + 0.45f}, 0.05f, 0.05f, 8);
    for (Vec3f foot : {Vec3f{0, -0.48f * L, sheer(1)}, Vec3f{0, 0.49f * L, sheer(0)}, Vec3f{-0.42f * B, 0.02f * L, sheer(0.5f)},
                       Vec3f{0.42f * B, 0.02f * L, sheer(0.5f)}})
      mesh_.Tube(foot, {0, -0.08f * L, 1.22f * L}, 0.012f, 0.012f, 4, false, false);
    mesh_.SetMaterial(scene_.surfaces[Surface::kAwningBlue]);
    mesh_.Tube({0, -0.06f * L, roof + 0.6f}, {0, 0.35f * L, roof + 0.55f}, 0.13f, 0.09f, 10);  // the furled sail
  }
}

}  // namespace airsim360::internal

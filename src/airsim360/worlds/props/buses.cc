// City buses.
#include <cmath>

#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/wheels.h"

namespace airsim360::internal {
namespace {

constexpr float kHalfLength = 5.95f, kHalfWidth = 1.27f, kHeight = 2.95f;

// A window of the right (+1) or left (-1) side between y0 and y1, proud of the skin by 4 mm.
void SideWindow(PropBuilder& b, float side, float y0, float y1, float z0, float z1) {
  const float x0 = side > 0 ? kHalfWidth - 0.02f : -kHalfWidth - 0.004f;
  b.BevelBox({x0, y0, z0}, {x0 + 0.024f, y1, z1}, 0.003f);
}

// Rounded box with a stripe, a dark foot and a dark band for the windows.
void AddBusBody(PropBuilder& b, const Material& paint, Vec3f stripe) {
  b.Use(paint);
  // The roof is rounded across, nose and tail along; the outline is seen from the front and runs along Y.
  const auto outline = RoundedRectangle({-kHalfWidth, 0.32f}, {kHalfWidth, kHeight}, 0.20f, 5);
  b.Place(Turn(90, 0, 0));
  b.Prism(outline, -kHalfLength + 0.12f, kHalfLength - 0.12f);
  const auto face = RoundedRectangle({-kHalfWidth + 0.06f, 0.36f}, {kHalfWidth - 0.06f, kHeight - 0.06f}, 0.20f, 5);
  b.Prism(face, -kHalfLength, kHalfLength);
  b.Place({});
  b.Use(CarPaint(stripe));
  for (float side : {1.0f, -1.0f}) SideWindow(b, side, -kHalfLength + 0.15f, kHalfLength - 0.15f, 0.62f, 0.86f);
  b.Use(Plastic({0.02f, 0.02f, 0.021f}, 0.5f));
  b.BevelBox({-1.15f, -kHalfLength + 0.2f, 0.22f}, {1.15f, kHalfLength - 0.2f, 0.40f}, 0.03f);
  for (float side : {1.0f, -1.0f}) SideWindow(b, side, -kHalfLength + 0.45f, kHalfLength - 0.35f, 1.28f, 2.42f);
}

// Panes over the black band; the doors reach down.
void AddBusGlass(PropBuilder& b) {
  b.Use(Glass({0.014f, 0.017f, 0.019f}));
  for (int i = 0; i < 7; ++i) {
    const float y = -kHalfLength + 0.50f + 1.58f * static_cast<float>(i);
    for (float side : {1.0f, -1.0f}) {
      const float x0 = side > 0 ? kHalfWidth + 0.001f : -kHalfWidth - 0.008f;
      b.BevelBox({x0, y, 1.33f}, {x0 + 0.007f, y + 1.48f, 2.37f}, 0.002f);
    }
  }
  // Doors are on the pavement side: the right of a bus that drives towards -Y is -X.
  for (float y : {-4.95f, 0.3f}) {
    for (float leaf : {0.0f, 0.62f}) b.BevelBox({-kHalfWidth - 0.012f, y + leaf, 0.42f}, {-kHalfWidth, y + leaf + 0.58f, 2.40f}, 0.003f);
  }
  b.BevelBox({-1.08f, -kHalfLength - 0.012f, 1.05f}, {1.08f, -kHalfLength + 0.02f, 2.45f}, 0.01f);
  b.BevelBox({-0.95f, kHalfLength - 0.02f, 1.55f}, {0.95f, kHalfLength + 0.012f, 2.35f}, 0.01f);
}

// Above the windscreen: line and destination.
void AddBusDisplay(PropBuilder& b, uint32_t variant) {
  Canvas sign(256, 48, {0.008f, 0.008f, 0.008f});
  sign.Letters(variant ? "24 GROVE AVE" : "7 MARKET ST", {0.5f, 0.5f}, 0.62f, {0.90f, 0.38f, 0.02f});
  Material display = Paint({1, 1, 1}, 0.5f);
  display.emission = Vec3f{1, 1, 1} * (900 * kNit);
  display.lamp = true;
  b.Use(display, sign.Finish(variant ? "line 24" : "line 7"));
  b.Picture({-0.80f, -kHalfLength - 0.002f, 2.52f}, {0.80f, -kHalfLength - 0.002f, 2.52f}, {0.80f, -kHalfLength - 0.002f, 2.80f},
            {-0.80f, -kHalfLength - 0.002f, 2.80f});
}

// Head and tail lamps, mirrors, wheels.
void AddBusSides(PropBuilder& b) {
  for (float x : {-1.0f, 1.0f}) {
    b.Use(Glass({0.42f, 0.43f, 0.44f}));
    b.BevelBox({x * 0.90f - 0.17f, -kHalfLength - 0.015f, 0.62f}, {x * 0.90f + 0.17f, -kHalfLength + 0.02f, 0.80f}, 0.03f);
    b.Use(Glass({0.28f, 0.008f, 0.008f}));
    b.BevelBox({x * 1.02f - 0.07f, kHalfLength - 0.02f, 0.75f}, {x * 1.02f + 0.07f, kHalfLength + 0.015f, 1.30f}, 0.02f);
    b.Use(Plastic({0.02f, 0.02f, 0.021f}));
    const Vec3f arm[] = {
        {x * 1.20f, -kHalfLength + 0.15f, 2.50f}, {x * 1.38f, -kHalfLength - 0.10f, 2.48f}, {x * 1.40f, -kHalfLength - 0.14f, 2.30f}};
    b.Bar(arm, 0.018f, 6);
    b.BevelBox({x * 1.40f - 0.09f, -kHalfLength - 0.19f, 1.90f}, {x * 1.40f + 0.09f, -kHalfLength - 0.09f, 2.32f}, 0.03f);
    for (float y : {-3.25f, 2.75f}) {
      // A dark disc stands for the wheel arch.
      b.Use(Plastic({0.012f, 0.012f, 0.013f}, 0.8f));
      b.mesh().Tube({x * (kHalfWidth - 0.03f), y, 0.60f}, {x * (kHalfWidth + 0.006f), y, 0.60f}, 0.54f, 0.54f, 32, false);
      AddWheel(b, {x * (kHalfWidth - 0.13f), y, 0.48f}, 0.48f, 0.30f, x);
    }
  }
}

Model MakeBus(uint32_t variant, uint64_t) {
  PropBuilder b("bus");
  const Material paint = CarPaint({0.68f, 0.68f, 0.67f});
  AddBusBody(b, paint, variant ? Vec3f{0.03f, 0.22f, 0.11f} : Vec3f{0.02f, 0.08f, 0.30f});
  AddBusGlass(b);
  AddBusDisplay(b, variant);
  AddBusSides(b);
  b.Use(paint);
  b.BevelBox({-0.85f, -1.6f, kHeight - 0.02f}, {0.85f, 1.2f, kHeight + 0.20f}, 0.08f);
  b.BevelBox({-0.55f, 2.8f, kHeight - 0.02f}, {0.55f, 4.2f, kHeight + 0.14f}, 0.05f);
  return b.Finish();
}

}  // namespace

std::vector<PropKind> BusKinds() {
  const std::vector<LibraryModel> buses = {{"cityBus"}, {"bus"}};
  return {{"bus", "vehicle/bus", 2, MakeBus, 7.2f, 2.9f, 3.8f, 8000, buses}};
}

}  // namespace airsim360::internal

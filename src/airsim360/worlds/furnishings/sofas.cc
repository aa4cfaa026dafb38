// Sofas and armchairs. Seats 42 to 45 cm high and 55 deep, 70 cm a place (Neufert, Architects' Data: seating).
#include <array>

#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"

namespace airsim360::internal {
namespace {

enum class Cover { kWeave, kLeather };
struct SofaLook {
  int places;
  Cover cover;
  Vec3f color;
  float arm;      // width of an arm
  float arm_top;  // height of an arm
  float leg;      // height of the legs
  Timber timber;
  bool loose;  // pillows lie on it
  Vec3f accent;
};
constexpr float kPlace = 0.68f, kSeat = 0.44f, kBack = 0.82f, kDepth = 0.90f;
constexpr unsigned kOpen = MeshBuilder::kAllSides & ~MeshBuilder::kBottom;

void Upholster(PropBuilder& b, const SofaLook& look, float shade = 1) {
  look.cover == Cover::kWeave ? UseWeave(b, look.color * shade) : UseLeather(b, look.color * shade);
}

void Legs(PropBuilder& b, const SofaLook& look, float half) {
  UseTimber(b, look.timber);
  for (float x : {-half + 0.07f, half - 0.07f})
    for (float y : {-kDepth / 2 + 0.08f, kDepth / 2 - 0.08f})
      b.mesh().Tube({x * 1.02f, y * 1.06f, 0}, {x, y, look.leg}, 0.013f, 0.024f, 12);
}

void Cushions(PropBuilder& b, const SofaLook& look, uint64_t seed) {
  const float inner = kPlace * static_cast<float>(look.places) / 2, y0 = -kDepth / 2, y1 = kDepth / 2;
  for (int i = 0; i < look.places; ++i) {
    const float x = -inner + kPlace * static_cast<float>(i);
    const uint64_t own = seed + 7 * static_cast<uint64_t>(i);
    Upholster(b, look);
    SoftBox(b, {x + 0.004f, y0 - 0.02f, kSeat - 0.17f}, {x + kPlace - 0.004f, y1 - 0.20f, kSeat},
            {.round = 0.05f, .crown = 0.024f, .fold = 0.006f, .seed = own, .cells = 11, .faces = kOpen});
    // Back cushions lean on the back.
    b.Place(Turn(-9, 0, 0, {x + kPlace / 2, y1 - 0.21f, kSeat + 0.005f}));
    SoftBox(b, {-kPlace / 2 + 0.006f, -0.09f, 0}, {kPlace / 2 - 0.006f, 0.09f, 0.45f},
            {.round = 0.075f, .crown = 0.035f, .fold = 0.008f, .seed = own + 3, .cells = 11, .faces = kOpen & ~MeshBuilder::kBack});
    b.Place({});
  }
}

Model MakeSofa(const char* name, const SofaLook& look, uint64_t seed) {
  PropBuilder b(name);
  const float inner = kPlace * static_cast<float>(look.places) / 2, half = inner + look.arm;
  const float y0 = -kDepth / 2, y1 = kDepth / 2;
  Legs(b, look, half);
  Upholster(b, look);
  SoftBox(b, {-half + 0.01f, y0 + 0.015f, look.leg}, {half - 0.01f, y1, kSeat - 0.15f}, {.round = 0.025f, .crown = 0.004f, .cells = 5});
  for (float s : {-1.0f, 1.0f})
    SoftBox(b, {s > 0 ? inner : -half, y0, look.leg}, {s > 0 ? half : -inner, y1 - 0.02f, look.arm_top},
            {.round = std::min(0.07f, look.arm * 0.42f), .crown = 0.008f, .fold = 0.002f, .seed = seed, .cells = 8, .faces = kOpen});
  SoftBox(b, {-half + 0.012f, y1 - 0.19f, look.leg}, {half - 0.012f, y1, kBack - 0.06f},
          {.round = 0.06f, .crown = 0.008f, .cells = 8, .faces = kOpen});
  Cushions(b, look, seed);
  if (look.loose) {
    UseWeave(b, look.accent);
    Pillow(b, Turn(66, 0, 14, {-inner + 0.27f, 0.02f, kSeat + 0.22f}), {0.46f, 0.46f}, 0.15f, seed + 41);
    if (look.places > 1) {
      UseLinen(b, {0.62f, 0.58f, 0.50f});
      Pillow(b, Turn(62, 0, -17, {inner - 0.26f, 0.00f, kSeat + 0.20f}), {0.44f, 0.44f}, 0.14f, seed + 43);
    }
  }
  return b.Finish();
}

SofaLook LookOf(uint32_t variant, int places) {
  const SofaLook looks[4] = {
      {places, Cover::kWeave, {0.34f, 0.34f, 0.34f}, 0.17f, 0.62f, 0.13f, Timber::kOak, true, {0.56f, 0.36f, 0.07f}},
      {places, Cover::kLeather, {0.26f, 0.115f, 0.05f}, 0.21f, 0.60f, 0.08f, Timber::kWenge, false, {}},
      {places, Cover::kWeave, {0.075f, 0.13f, 0.19f}, 0.13f, 0.66f, 0.16f, Timber::kWalnut, true, {0.58f, 0.54f, 0.46f}},
      {places, Cover::kWeave, {0.52f, 0.46f, 0.37f}, 0.24f, 0.58f, 0.06f, Timber::kWenge, true, {0.16f, 0.24f, 0.17f}}};
  return looks[variant];
}

Model MakeSofa2(uint32_t variant, uint64_t seed) { return MakeSofa("sofa_2", LookOf(variant, 2), seed); }
Model MakeSofa3(uint32_t variant, uint64_t seed) { return MakeSofa("sofa_3", LookOf((variant + 1) % 4, 3), seed); }

// A wooden frame with loose cushions, after the Danish easy chairs of the fifties.
Model MakeEasyChair(uint64_t seed) {
  PropBuilder b("armchair");
  UseTimber(b, Timber::kOak, Grain::kUpright);
  for (float s : {-1.0f, 1.0f}) {
    const float x = 0.33f * s;
    const Vec3f front[] = {{x * 1.04f, -0.36f, 0}, {x, -0.33f, 0.30f}, {x, -0.32f, 0.55f}};
    const Vec3f rear[] = {{x * 1.04f, 0.40f, 0}, {x, 0.30f, 0.30f}, {x, 0.27f, 0.52f}};
    const Vec3f arm[] = {{x * 1.03f, -0.39f, 0.565f}, {x * 1.06f, -0.10f, 0.575f}, {x * 1.02f, 0.20f, 0.545f}, {x, 0.33f, 0.52f}};
    const float arms[] = {0.020f, 0.030f, 0.024f, 0.016f};
    b.Bar(front, 0.020f, 12);
    b.Bar(rear, 0.020f, 12);
    b.Bar(arm, arms, 12);
    b.mesh().Tube({x, -0.34f, 0.30f}, {x, 0.32f, 0.25f}, 0.016f, 0.016f, 10);
    const Vec3f back[] = {{x * 0.86f, 0.22f, 0.26f}, {x * 0.86f, 0.36f, 0.62f}, {x * 0.84f, 0.45f, 0.86f}};
    b.Bar(back, 0.017f, 10);
  }
  for (float z : {0.45f, 0.66f, 0.85f})
    b.mesh().Tube({-0.28f, 0.22f + 0.37f * (z - 0.26f), z}, {0.28f, 0.22f + 0.37f * (z - 0.26f), z}, 0.012f, 0.012f, 10);
  for (float y : {-0.30f, 0.26f}) b.mesh().Tube({-0.33f, y, 0.285f}, {0.33f, y, 0.285f}, 0.016f, 0.016f, 10);
  UseWeave(b, {0.27f, 0.29f, 0.21f});
  b.Place(Turn(-4, 0, 0, {0, -0.05f, 0.30f}));
  SoftBox(b, {-0.29f, -0.33f, 0}, {0.29f, 0.30f, 0.14f}, {.round = 0.045f, .crown = 0.02f, .fold = 0.004f, .seed = seed, .cells = 9});
  b.Place(Turn(-20, 0, 0, {0, 0.21f, 0.42f}));
  SoftBox(b, {-0.285f, -0.07f, 0}, {0.285f, 0.07f, 0.50f}, {.round = 0.05f, .crown = 0.02f, .fold = 0.004f, .seed = seed + 1, .cells = 9});
  b.Place({});
  return b.Finish();
}

Model MakeArmchair(uint32_t variant, uint64_t seed) {
  if (variant == 3) return MakeEasyChair(seed);
  SofaLook look = LookOf(variant, 1);
  look.loose = variant == 2;
  return MakeSofa("armchair", look, seed);
}

// Lounge seat of offices and lobbies: low, on steel skids or a plinth.
Model MakeSofaLounge(uint32_t variant, uint64_t seed) {
  PropBuilder b("sofa_lounge");
  const float half = variant == 2 ? 0.40f : 0.80f, y0 = -0.38f, y1 = 0.38f;
  const Vec3f tones[3] = {{0.035f, 0.036f, 0.040f}, {0.10f, 0.22f, 0.24f}, {0.42f, 0.18f, 0.06f}};
  b.Use(variant == 1 ? Paint({0.03f, 0.03f, 0.03f}) : Chrome());
  for (float x : {-half + 0.06f, half - 0.06f}) {
    const Vec3f skid[] = {{x, y0 + 0.03f, 0.16f},  {x, y0 + 0.03f, 0.02f}, {x, y0 + 0.06f, 0.012f},
                          {x, y1 - 0.06f, 0.012f}, {x, y1 - 0.03f, 0.02f}, {x, y1 - 0.03f, 0.16f}};
    b.Bar(skid, 0.012f, 8);
  }
  variant == 0 ? UseLeather(b, tones[0]) : UseWeave(b, tones[variant]);
  SoftBox(b, {-half, y0, 0.15f}, {half, y1, 0.27f}, {.round = 0.02f, .crown = 0.002f, .cells = 5});
  const int places = variant == 2 ? 1 : 2;
  const float w = 2 * half / static_cast<float>(places);
  for (int i = 0; i < places; ++i) {
    const float x = -half + w * static_cast<float>(i);
    SoftBox(b, {x + 0.003f, y0, 0.265f}, {x + w - 0.003f, y1 - 0.14f, 0.43f},
            {.round = 0.035f, .crown = 0.012f, .fold = 0.003f, .seed = seed + static_cast<uint64_t>(i), .cells = 9, .faces = kOpen});
    SoftBox(b, {x + 0.003f, y1 - 0.17f, 0.265f}, {x + w - 0.003f, y1, 0.74f},
            {.round = 0.04f, .crown = 0.010f, .fold = 0.002f, .seed = seed + 9, .cells = 9, .faces = kOpen});
  }
  return b.Finish();
}

}  // namespace

FurnishingRows SofaRows() {
  return {{{"sofa_2", "furniture/sofa", 4, MakeSofa2, 1.0f, 0.75f, 1.05f, 9000}},
          {{"sofa_3", "furniture/sofa", 4, MakeSofa3, 1.3f, 0.75f, 1.05f, 11000}},
          {{"armchair", "furniture/seating/armchair", 4, MakeArmchair, 0.65f, 0.75f, 1.05f, 6500}},
          {{"sofa_lounge", "furniture/sofa", 3, MakeSofaLounge, 0.9f, 0.70f, 0.80f, 5000}}};
}

}  // namespace airsim360::internal

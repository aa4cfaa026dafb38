// Beds and what stands beside them. Mattress sizes of EN 1334 (90, 140, 160, 180 x 200 cm); lying height 45 to 60 cm as
// in catalogues.
#include <array>

#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"

namespace airsim360::internal {
namespace {

struct BedLook {
  float width;  // of the mattress
  int frame;    // 0 wood, 1 upholstered, 2 metal
  Timber timber;
  Vec3f cloth;  // of an upholstered frame
  Vec3f duvet, sheet, blanket;
};

constexpr float kLength = 2.0f, kSlats = 0.30f, kMattress = 0.52f;  // heights: slats, top of the mattress

void WoodFrame(PropBuilder& b, const BedLook& look, float half) {
  UseTimber(b, look.timber);
  for (float s : {-1.0f, 1.0f}) {
    b.BevelBox({s * half - 0.035f, -1.04f, 0}, {s * half + 0.035f, -0.97f, 0.36f}, 0.006f);
    b.BevelBox({s * half - 0.035f, 0.98f, 0}, {s * half + 0.035f, 1.05f, 0.98f}, 0.006f);
    b.BevelBox({s * half - 0.02f, -0.98f, 0.18f}, {s * half + 0.02f, 0.99f, 0.35f}, 0.005f);
  }
  UseTimber(b, look.timber, Grain::kAlongX);
  b.BevelBox({-half, -1.035f, 0.18f}, {half, -1.0f, 0.35f}, 0.005f);
  for (int i = 0; i < 3; ++i) {
    const float z = 0.42f + 0.18f * static_cast<float>(i);
    b.BevelBox({-half + 0.02f, 1.0f, z}, {half - 0.02f, 1.03f, z + 0.165f}, 0.005f);
  }
}

void UpholsteredFrame(PropBuilder& b, const BedLook& look, float half) {
  UseWeave(b, look.cloth);
  for (float s : {-1.0f, 1.0f})
    SoftBox(b, {s > 0 ? half - 0.03f : -half - 0.05f, -1.0f, 0.08f}, {s > 0 ? half + 0.05f : -half + 0.03f, 1.0f, 0.37f},
            {.round = 0.025f, .crown = 0.004f, .cells = 5});
  SoftBox(b, {-half - 0.05f, -1.05f, 0.08f}, {half + 0.05f, -0.98f, 0.37f}, {.round = 0.025f, .crown = 0.004f, .cells = 5});
  // The head in four padded panels.
  const float step = (2 * half + 0.1f) / 4;
  for (int i = 0; i < 4; ++i) {
    const float x = -half - 0.05f + step * static_cast<float>(i);
    SoftBox(b, {x, 0.98f, 0.08f}, {x + step, 1.10f, 1.08f},
            {.round = 0.035f, .crown = 0.022f, .cells = 6, .faces = MeshBuilder::kAllSides & ~MeshBuilder::kBottom});
  }
  b.Use(Plastic({0.02f, 0.02f, 0.02f}));
  for (float x : {-half, half})
    for (float y : {-0.95f, 0.95f}) b.mesh().Tube({x, y, 0}, {x, y, 0.085f}, 0.02f, 0.025f, 12);
}

void MetalFrame(PropBuilder& b, float half) {
  b.Use(Paint({0.035f, 0.036f, 0.038f}, 0.4f));
  for (float y : {-1.03f, 1.03f}) {
    const float top = y < 0 ? 0.55f : 1.0f;
    const Vec3f hoop[] = {{-half, y, 0},          {-half, y, top - 0.12f},        {-half + 0.04f, y, top - 0.03f}, {-half + 0.13f, y, top},
                          {half - 0.13f, y, top}, {half - 0.04f, y, top - 0.03f}, {half, y, top - 0.12f},          {half, y, 0}};
    b.Bar(hoop, 0.016f, 10);
    b.mesh().Tube({-half, y, 0.33f}, {half, y, 0.33f}, 0.012f, 0.012f, 8);
    for (int i = 1; i < 8; ++i) {
      const float x = -half + 2 * half * static_cast<float>(i) / 8;
      b.mesh().Tube({x, y, 0.33f}, {x, y, top}, 0.007f, 0.007f, 8, false, false);
    }
  }
  for (float x : {-half, half}) b.BevelBox({x - 0.015f, -1.03f, 0.28f}, {x + 0.015f, 1.03f, 0.34f}, 0.004f);
}

// Mattress, duvet with its turned-back edge, pillows against the head, a blanket over the foot.
void Bedding(PropBuilder& b, const BedLook& look, uint64_t seed) {
  const float w = look.width / 2;
  UseLinen(b, {0.72f, 0.71f, 0.68f});
  SoftBox(b, {-w, -kLength / 2, kSlats}, {w, kLength / 2, kMattress}, {.round = 0.05f, .crown = 0.006f, .cells = 6});
  UseLinen(b, look.duvet);
  const unsigned open = MeshBuilder::kAllSides & ~MeshBuilder::kBottom;
  SoftBox(b, {-w - 0.07f, -1.03f, kMattress - 0.20f}, {w + 0.07f, 0.33f, kMattress + 0.055f},
          {.round = 0.09f, .crown = 0.03f, .fold = 0.017f, .seed = seed, .cells = 18, .faces = open});
  UseLinen(b, look.sheet);
  SoftBox(b, {-w - 0.075f, 0.10f, kMattress - 0.19f}, {w + 0.075f, 0.40f, kMattress + 0.085f},
          {.round = 0.07f, .crown = 0.012f, .fold = 0.010f, .seed = seed + 5, .cells = 12, .faces = open});
  const int places = look.width > 1.2f ? 2 : 1;
  for (int i = 0; i < places; ++i) {
    const float x = places == 1 ? 0.0f : (static_cast<float>(i) - 0.5f) * look.width * 0.49f;
    UseLinen(b, look.sheet);
    Pillow(b, Turn(22, 0, 3.0f * static_cast<float>(i) - 2, {x, 0.66f, kMattress + 0.13f}), {0.70f, 0.52f}, 0.17f,
           seed + 11 + static_cast<uint64_t>(i));
    UseLinen(b, look.duvet);
    Pillow(b, Turn(58, 0, 2 - 4.0f * static_cast<float>(i), {x * 1.04f, 0.86f, kMattress + 0.25f}), {0.66f, 0.50f}, 0.16f,
           seed + 21 + static_cast<uint64_t>(i));
  }
  UseWeave(b, look.blanket);
  SoftBox(b, {-w - 0.095f, -0.88f, kMattress - 0.22f}, {w + 0.095f, -0.40f, kMattress + 0.092f},
          {.round = 0.085f, .crown = 0.020f, .fold = 0.006f, .seed = seed + 31, .cells = 12, .faces = open});
}

Model MakeBed(const char* name, const BedLook& look, uint64_t seed) {
  PropBuilder b(name);
  const float half = look.width / 2 + 0.035f;
  if (look.frame == 0)
    WoodFrame(b, look, half);
  else if (look.frame == 1)
    UpholsteredFrame(b, look, half);
  else
    MetalFrame(b, half);
  if (look.frame != 1) {
    UseTimber(b, Timber::kPine, Grain::kAlongX);
    for (int i = 0; i < 9; ++i) {
      const float y = -0.9f + 0.21f * static_cast<float>(i);
      b.mesh().Box({-half + 0.02f, y, kSlats - 0.02f}, {half - 0.02f, y + 0.08f, kSlats});
    }
  }
  Bedding(b, look, seed);
  return b.Finish();
}

Model MakeBedDouble(uint32_t variant, uint64_t seed) {
  const BedLook looks[4] = {
      {1.60f, 0, Timber::kOak, {}, {0.66f, 0.65f, 0.62f}, {0.74f, 0.73f, 0.71f}, {0.24f, 0.30f, 0.33f}},
      {1.80f, 1, Timber::kOak, {0.30f, 0.29f, 0.28f}, {0.30f, 0.36f, 0.42f}, {0.72f, 0.72f, 0.70f}, {0.46f, 0.36f, 0.22f}},
      {1.40f, 2, Timber::kPine, {}, {0.62f, 0.52f, 0.46f}, {0.72f, 0.70f, 0.66f}, {0.40f, 0.14f, 0.09f}},
      {1.60f, 0, Timber::kWalnut, {}, {0.25f, 0.30f, 0.24f}, {0.70f, 0.69f, 0.64f}, {0.60f, 0.55f, 0.45f}}};
  return MakeBed("bed_double", looks[variant], seed);
}

Model MakeBedSingle(uint32_t variant, uint64_t seed) {
  const BedLook looks[3] = {
      {0.90f, 0, Timber::kPine, {}, {0.28f, 0.38f, 0.52f}, {0.72f, 0.72f, 0.72f}, {0.62f, 0.60f, 0.55f}},
      {0.90f, 2, Timber::kPine, {}, {0.68f, 0.66f, 0.62f}, {0.72f, 0.71f, 0.69f}, {0.50f, 0.32f, 0.08f}},
      {0.90f, 1, Timber::kOak, {0.20f, 0.26f, 0.30f}, {0.58f, 0.42f, 0.38f}, {0.74f, 0.73f, 0.71f}, {0.26f, 0.22f, 0.30f}}};
  return MakeBed("bed_single", looks[variant], seed);
}

// A chest of one or two drawers on legs or a plinth; the odd one is open at the bottom.
Model MakeNightstand(uint32_t variant, uint64_t) {
  PropBuilder b("nightstand");
  const Timber timber = std::array{Timber::kOak, Timber::kBeech, Timber::kWalnut, Timber::kPine}[variant];
  const float w = 0.22f, d = 0.19f, top = 0.50f, foot = variant == 1 ? 0.05f : 0.16f;
  const bool white = variant == 3;
  const auto body = [&](Grain grain) { white ? UseLacquer(b, {0.74f, 0.73f, 0.70f}) : UseTimber(b, timber, grain); };
  body(Grain::kUpright);
  b.BevelBox({-w, -d, foot}, {-w + 0.018f, d, top - 0.02f}, 0.002f);
  b.BevelBox({w - 0.018f, -d, foot}, {w, d, top - 0.02f}, 0.002f);
  b.BevelBox({-w, d - 0.012f, foot}, {w, d, top - 0.02f}, 0.002f);
  body(Grain::kAlongX);
  b.BevelBox({-w - 0.01f, -d - 0.012f, top - 0.022f}, {w + 0.01f, d, top}, 0.004f);
  b.BevelBox({-w + 0.018f, -d, foot}, {w - 0.018f, d, foot + 0.018f}, 0.002f);
  const int drawers = variant % 2 ? 2 : 1;
  const float face = (top - 0.03f - foot - (drawers == 1 ? 0.16f : 0.004f)) / static_cast<float>(drawers);
  for (int i = 0; i < drawers; ++i) {
    const float z1 = top - 0.026f - face * static_cast<float>(i);
    body(Grain::kAlongX);
    Front(b, -w + 0.003f, w - 0.003f, z1 - face + 0.004f, z1, -d + 0.001f);
    b.Use(variant == 2 ? Metal({0.55f, 0.42f, 0.20f}, 0.28f) : Metal());
    BowHandle(b, {-0.055f, z1 - face / 2}, {0.055f, z1 - face / 2}, -d - 0.016f);
  }
  if (drawers == 1) {
    body(Grain::kAlongX);
    b.BevelBox({-w + 0.018f, -d + 0.01f, top - 0.035f - face}, {w - 0.018f, d, top - 0.02f - face}, 0.002f);
  }
  body(Grain::kUpright);
  if (foot > 0.1f) {
    for (float x : {-w + 0.03f, w - 0.03f})
      for (float y : {-d + 0.03f, d - 0.03f}) b.mesh().Tube({x * 1.06f, y * 1.06f, 0}, {x, y, foot}, 0.011f, 0.018f, 12);
  } else {
    b.BevelBox({-w + 0.03f, -d + 0.03f, 0}, {w - 0.03f, d - 0.01f, foot}, 0.002f);
  }
  return b.Finish();
}

}  // namespace

FurnishingRows BedRows() {
  return {{{"bed_double", "furniture/bed", 4, MakeBedDouble, 1.45f, 0.90f, 1.20f, 12500}},
          {{"bed_single", "furniture/bed", 3, MakeBedSingle, 1.2f, 0.90f, 1.20f, 11500}},
          {{"nightstand", "furniture/cabinet", 4, MakeNightstand, 0.35f, 0.45f, 0.60f, 1500}}};
}

}  // namespace airsim360::internal

#include "airsim360/worlds/furnishings/small_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {
namespace {

constexpr int kSpines = 16, kProducts = 16, kLabels = 4;

constexpr Vec3f kCovers[8] = {{0.35f, 0.05f, 0.04f}, {0.05f, 0.10f, 0.24f},  {0.44f, 0.29f, 0.08f}, {0.06f, 0.16f, 0.11f},
                              {0.62f, 0.58f, 0.50f}, {0.03f, 0.03f, 0.035f}, {0.50f, 0.48f, 0.46f}, {0.20f, 0.10f, 0.22f}};

// Spines side by side: bands, a title of upright strokes, a publisher's mark.
const Texture& SpineTexture() {
  static const Texture texture = [] {
    Canvas canvas(512, 256, {0.5f, 0.5f, 0.5f});
    RngStream rng(71, "spines");
    for (int i = 0; i < kSpines; ++i) {
      const float x0 = static_cast<float>(i) / kSpines, x1 = static_cast<float>(i + 1) / kSpines, xm = (x0 + x1) / 2;
      const Vec3f cover = kCovers[i % 8] * Random(rng, 0.8f, 1.2f);
      const Vec3f ink = cover.y > 0.3f ? Vec3f{0.06f, 0.06f, 0.07f} : Vec3f{0.66f, 0.60f, 0.46f};
      canvas.Rectangle({x0, 0}, {x1, 1}, cover);
      canvas.Rectangle({x0, 0}, {x0 + 0.004f, 1}, cover * 0.7f);
      canvas.Rectangle({x1 - 0.004f, 0}, {x1, 1}, cover * 0.75f);
      const float band = Random(rng, 0.05f, 0.12f);
      if (rng.Chance(0.6)) {
        canvas.Rectangle({x0, band}, {x1, band + 0.012f}, ink);
        canvas.Rectangle({x0, 0.92f - band}, {x1, 0.932f - band}, ink);
      }
      // Letters of the title run down the spine.
      for (float y = 0.22f; y < Random(rng, 0.55f, 0.72f); y += 0.028f) {
        if (rng.Chance(0.85)) canvas.Rectangle({xm - 0.010f, y}, {xm + 0.010f, y + Random(rng, 0.010f, 0.020f)}, ink);
      }
      canvas.Disc({xm, 0.88f}, 0.018f, ink);
    }
    return canvas.Finish("book spines");
  }();
  return texture;
}

// Fronts of packages, 4 by 4: fields of colour, a name, a picture of something round.
const Texture& ProductTexture() {
  static const Texture texture = [] {
    Canvas canvas(512, 512, {0.6f, 0.6f, 0.6f});
    RngStream rng(73, "products");
    const Vec3f grounds[8] = {{0.62f, 0.06f, 0.04f}, {0.05f, 0.16f, 0.50f}, {0.72f, 0.52f, 0.06f}, {0.07f, 0.34f, 0.12f},
                              {0.74f, 0.73f, 0.70f}, {0.70f, 0.28f, 0.05f}, {0.30f, 0.08f, 0.32f}, {0.08f, 0.40f, 0.48f}};
    constexpr std::array<const char*, 16> names = {"OATS",  "RICE",  "PASTA", "MUESLI", "TEA",   "COFFEE", "SOAP", "JUICE",
                                                   "FLOUR", "SUGAR", "BEANS", "COCOA",  "CHIPS", "HONEY",  "MILK", "SALT"};
    for (int i = 0; i < kProducts; ++i) {
      const float x = static_cast<float>(i % 4) / 4, y = static_cast<float>(i / 4) / 4;
      const Vec3f ground = grounds[(i * 3 + i / 4) % 8], second = grounds[(i * 5 + 2) % 8];
      canvas.Rectangle({x, y}, {x + 0.25f, y + 0.25f}, ground);
      canvas.Rectangle({x, y + 0.14f + 0.02f * static_cast<float>(i % 3)}, {x + 0.25f, y + 0.25f}, second * 0.9f);
      canvas.Disc({x + 0.125f, y + 0.165f}, 0.050f, {0.78f, 0.74f, 0.62f});
      canvas.Disc({x + 0.125f, y + 0.165f}, 0.036f, Vec3f{0.55f, 0.30f, 0.10f} * Random(rng, 0.6f, 1.4f));
      canvas.Letters(names[static_cast<size_t>(i)], {x + 0.125f, y + 0.065f}, 0.045f,
                     ground.y > 0.4f ? Vec3f{0.05f, 0.05f, 0.06f} : Vec3f{0.80f, 0.79f, 0.74f});
      for (int k = 0; k < 4; ++k) {
        const float ty = y + 0.222f + 0.006f * static_cast<float>(k);
        canvas.Rectangle({x + 0.02f, ty}, {x + 0.02f + Random(rng, 0.04f, 0.10f), ty + 0.003f}, {0.08f, 0.08f, 0.08f});
      }
    }
    return canvas.Finish("packages");
  }();
  return texture;
}

// Carton sides, two by two: label with bars, arrows, print.
const Texture& CartonPrint() {
  static const Texture texture = [] {
    Canvas canvas(512, 512, {0.41f, 0.27f, 0.15f});
    RngStream rng(79, "cartons");
    canvas.Paint([](float u, float v, Vec3f old) { return old * (0.90f + 0.2f * TileFractal(u, v, 6, 6, 4, 80)); });
    const Vec3f ink{0.05f, 0.04f, 0.035f}, paper{0.70f, 0.69f, 0.66f};
    for (int i = 0; i < kLabels; ++i) {
      const float x = 0.5f * static_cast<float>(i % 2), y = 0.5f * static_cast<float>(i / 2);
      canvas.Rectangle({x, y + 0.235f}, {x + 0.5f, y + 0.265f}, {0.52f, 0.40f, 0.25f});  // tape
      canvas.Rectangle({x + 0.27f, y + 0.30f}, {x + 0.45f, y + 0.45f}, paper);
      for (float bx = x + 0.285f; bx < x + 0.435f; bx += Random(rng, 0.004f, 0.009f))
        canvas.Rectangle({bx, y + 0.39f}, {bx + Random(rng, 0.001f, 0.003f), y + 0.435f}, ink);
      for (int k = 0; k < 4; ++k) {
        const float ty = y + 0.315f + 0.016f * static_cast<float>(k);
        canvas.Rectangle({x + 0.285f, ty}, {x + 0.285f + Random(rng, 0.05f, 0.14f), ty + 0.006f}, ink);
      }
      constexpr std::array<const char*, 4> marks = {"FRAGILE", "A 360", "THIS SIDE UP", "KEEP DRY"};
      canvas.Letters(marks[static_cast<size_t>(i)], {x + 0.20f, y + 0.12f}, 0.032f, ink);
      for (float ax : {0.05f, 0.11f}) {  // arrows
        canvas.Rectangle({x + ax + 0.012f, y + 0.36f}, {x + ax + 0.022f, y + 0.44f}, ink);
        canvas.RegularPolygon({x + ax + 0.017f, y + 0.35f}, 0.022f, 3, -kPiF / 2, ink);
      }
    }
    return canvas.Finish("carton print");
  }();
  return texture;
}

// Rectangle a, b, c, d with the cell (column, row) of a `columns` x `rows` atlas.
void AtlasQuad(PropBuilder& b, Vec3f a, Vec3f bb, Vec3f c, Vec3f d, int cell, int columns, int rows) {
  const float u0 = static_cast<float>(cell % columns) / static_cast<float>(columns), u1 = u0 + 1.0f / static_cast<float>(columns);
  const float v0 = static_cast<float>(cell / columns) / static_cast<float>(rows), v1 = v0 + 1.0f / static_cast<float>(rows);
  const float e = 0.004f;
  b.mesh().QuadUv(a, bb, c, d, {u0 + e, v1 - e}, {u1 - e, v1 - e}, {u1 - e, v0 + e}, {u0 + e, v0 + e});
}

// Tin with its printed label once around, twice the picture.
void Tin(PropBuilder& b, Vec3f c, float r, float h, int product) {
  b.Use(Paint({0.9f, 0.9f, 0.9f}, 0.35f), ProductTexture());
  const float u0 = static_cast<float>(product % 4) / 4, v0 = static_cast<float>(product / 4) / 4;
  const Vec3f up{0, 0, h};
  for (int k = 0; k < 12; ++k) {
    const Vec3f d0 = Around(k, 12, -kPiF), d1 = Around(k + 1, 12, -kPiF);
    const float ua = u0 + 0.25f * static_cast<float>(k % 6) / 6, ub = ua + 0.25f / 6;
    const Vec2f uv[4] = {{ua, v0 + 0.245f}, {ub, v0 + 0.245f}, {ub, v0 + 0.005f}, {ua, v0 + 0.005f}};
    b.mesh().SmoothTriangle({c + d0 * r, c + d1 * r, c + d1 * r + up}, {d0, d1, d1}, {uv[0], uv[1], uv[2]});
    b.mesh().SmoothTriangle({c + d0 * r, c + d1 * r + up, c + d0 * r + up}, {d0, d1, d0}, {uv[0], uv[2], uv[3]});
  }
  b.Use(Metal({0.6f, 0.6f, 0.58f}, 0.3f));
  const Vec2f lid[] = {{r, h}, {r * 0.93f, h + 0.006f}, {0, h + 0.004f}};
  b.Lathe(lid, 12, c);
}

// Printed box from its lower front left corner; its back stands before something.
void Package(PropBuilder& b, Vec3f p, Vec3f size, int product) {
  b.Use(Paint({0.9f, 0.9f, 0.9f}, 0.4f), ProductTexture());
  const Vec3f w{size.x, 0, 0}, d{0, size.y, 0}, h{0, 0, size.z};
  AtlasQuad(b, p, p + w, p + w + h, p + h, product, 4, 4);
  AtlasQuad(b, p + w, p + w + d, p + w + d + h, p + w + h, product, 4, 4);
  AtlasQuad(b, p + d, p, p + h, p + d + h, product, 4, 4);
  AtlasQuad(b, p + h, p + w + h, p + w + d + h, p + d + h, product, 4, 4);
}

void Book(PropBuilder& b, const AffineTransform& X, float thick, float deep, float tall, int spine) {
  b.Place(X);
  b.Use(Plastic(kCovers[spine % 8], 0.5f));
  b.mesh().Box({-thick / 2, 0.001f, 0}, {thick / 2, deep, tall}, MeshBuilder::kLeft | MeshBuilder::kRight);
  b.Use(Stone({0.66f, 0.62f, 0.52f}, 0.9f));
  b.mesh().Box({-thick / 2 + 0.001f, 0.001f, 0.002f}, {thick / 2 - 0.001f, deep - 0.003f, tall - 0.003f},
               MeshBuilder::kTop | MeshBuilder::kBack | MeshBuilder::kBottom);
  b.Use(Paint({0.9f, 0.9f, 0.9f}, 0.5f), SpineTexture());
  AtlasQuad(b, {-thick / 2, 0, 0}, {thick / 2, 0, 0}, {thick / 2, 0, tall}, {-thick / 2, 0, tall}, spine, kSpines, 1);
  b.Place({});
}

}  // namespace

void BooksOnShelf(PropBuilder& b, float x0, float x1, float y0, float z, float room, uint64_t seed) {
  RngStream rng(seed, "books");
  float x = x0;
  float tall = Random(rng, 0.19f, 0.26f);
  while (true) {
    const float thick = Random(rng, 0.014f, 0.046f), deep = Random(rng, 0.12f, 0.19f);
    if (rng.Chance(0.3)) tall = Random(rng, 0.17f, 0.29f);
    const float height = std::min(tall + Random(rng, -0.008f, 0.008f), room - 0.008f);
    if (x + thick > x1) break;
    const bool leans = x1 - x < 0.13f && x1 - x > thick + 0.05f;
    // A leaning book rests on its neighbour's upper part.
    const AffineTransform X = leans ? Turn(0, -14, 0, {x + thick / 2 + 0.045f, y0 + Random(rng, 0, 0.012f), z})
                                    : Move({x + thick / 2, y0 + Random(rng, 0, 0.012f), z});
    Book(b, X, thick, deep, leans ? height * 0.95f : height, static_cast<int>(rng.Index(kSpines)));
    if (leans) break;
    x += thick + Random(rng, 0.0005f, 0.0015f);
  }
}

void ShelfThing(PropBuilder& b, Vec3f p, float radius, float room, uint64_t seed) {
  RngStream rng(seed, "shelf thing");
  switch (rng.Index(4)) {
    case 0: {  // a vase
      const float r = std::min(radius, 0.07f), h = std::min(room - 0.02f, 0.24f);
      UseCeramic(b, kCovers[rng.Index(8)] * 1.1f);
      const Vec2f vase[] = {{0, 0.001f},           {r * 0.6f, 0.001f},     {r * 0.9f, h * 0.25f}, {r, h * 0.45f},
                            {r * 0.75f, h * 0.7f}, {r * 0.38f, h * 0.88f}, {r * 0.48f, h},        {r * 0.40f, h},
                            {r * 0.3f, h * 0.86f}, {0, h * 0.8f}};
      b.Lathe(vase, 18, p);
      break;
    }
    case 1: {  // a storage box with a label
      const float h = std::min(room - 0.03f, 0.17f);
      UseCardboard(b, 1);
      b.BevelBox(p + Vec3f{-radius, -0.10f, 0}, p + Vec3f{radius, 0.10f, h}, 0.004f);
      UseLacquer(b, {0.70f, 0.69f, 0.65f});
      b.BevelBox(p + Vec3f{-0.03f, -0.102f, h * 0.45f}, p + Vec3f{0.03f, -0.099f, h * 0.75f}, 0.001f);
      break;
    }
    case 2: {  // books lying
      for (int i = 0; i < 3; ++i) {
        b.Use(Plastic(kCovers[rng.Index(8)], 0.5f));
        const float w = std::min(radius, 0.085f) - 0.008f * static_cast<float>(i), z = 0.028f * static_cast<float>(i);
        b.BevelBox(p + Vec3f{-w, -0.11f, z}, p + Vec3f{w, 0.10f, z + 0.027f}, 0.002f);
      }
      break;
    }
    default: {  // a photograph in a frame
      const float h = std::min(room - 0.03f, 0.18f), w = std::min(radius, h * 0.4f);
      b.Place(Turn(-10, 0, 8, p + Vec3f{0, 0.02f, 0}));
      b.Use(Metal({0.5f, 0.45f, 0.35f}, 0.3f));
      b.BevelBox({-w, -0.006f, 0.002f}, {w, 0.006f, h}, 0.003f);
      b.Use(Paint(kCovers[rng.Index(8)] * 1.2f, 0.3f));
      b.mesh().Box({-w + 0.012f, -0.0075f, 0.014f}, {w - 0.012f, -0.0065f, h - 0.012f});
      b.Place({});
    }
  }
}

void HangingGarment(PropBuilder& b, const AffineTransform& X, float width, float length, uint64_t seed) {
  const float shift = static_cast<float>(seed % 83);
  b.Place(X);
  const auto around = [&](float u, float v) {
    // u goes once around, v from hem to shoulders; the shoulders slope, the sides fall into folds.
    const float a = 2 * kPiF * u, down = 1 - v;
    const float shoulder = std::min(1.0f, 6 * down), half = width / 2 * (0.30f + 0.70f * std::sqrt(shoulder)) * (1 + 0.10f * down);
    const float fold = 1 + 0.13f * down * std::sin(5 * a + shift) + 0.06f * down * std::sin(9 * a + 2 * shift);
    const float thick = (0.035f + 0.05f * shoulder) * fold;
    return Vec3f{half * std::cos(a) * (0.85f + 0.15f * fold), thick * std::sin(a),
                 -0.03f - 0.02f * shoulder - length * down * (1 - 0.03f * std::cos(a) * std::cos(a))};
  };
  b.Sheet(24, 9, around, {2 * width, length});
  // Sleeves.
  for (float side : {-1.0f, 1.0f}) {
    const Vec3f arm[] = {{side * width * 0.36f, 0, -0.09f},
                         {side * width * 0.50f, 0.0f, -0.16f},
                         {side * width * 0.56f, -0.01f, -0.34f},
                         {side * width * 0.55f, -0.02f, -0.10f - 0.62f * std::min(length, 0.85f)}};
    const float radii[] = {0.05f, 0.058f, 0.05f, 0.042f};
    b.Bar(arm, radii, 9);
  }
  b.Place({});
}

void Carton(PropBuilder& b, const AffineTransform& X, Vec3f size, uint64_t seed) {
  RngStream rng(seed, "carton");
  b.Place(X);
  const Vec3f lo{-size.x / 2, -size.y / 2, 0}, hi{size.x / 2, size.y / 2, size.z};
  const float shade = Random(rng, 0.78f, 1.0f);
  b.Use(Stone(Vec3f{0.9f, 0.9f, 0.9f} * shade, 0.85f), CartonPrint());
  const Vec3f p[8] = {{lo.x, lo.y, lo.z}, {hi.x, lo.y, lo.z}, {hi.x, hi.y, lo.z}, {lo.x, hi.y, lo.z},
                      {lo.x, lo.y, hi.z}, {hi.x, lo.y, hi.z}, {hi.x, hi.y, hi.z}, {lo.x, hi.y, hi.z}};
  const int first = static_cast<int>(rng.Index(kLabels));
  AtlasQuad(b, p[0], p[1], p[5], p[4], first, 2, 2);
  AtlasQuad(b, p[1], p[2], p[6], p[5], (first + 1) % kLabels, 2, 2);
  AtlasQuad(b, p[2], p[3], p[7], p[6], (first + 2) % kLabels, 2, 2);
  AtlasQuad(b, p[3], p[0], p[4], p[7], (first + 3) % kLabels, 2, 2);
  UseCardboard(b, shade);
  // The flaps meet under a strip of tape, the rim a little lower than the middle.
  b.mesh().Quad(p[4], p[5], p[6], p[7]);
  b.mesh().Quad(p[3], p[2], p[1], p[0]);
  b.Use(Plastic({0.42f, 0.33f, 0.21f}, 0.25f));
  const float t = 0.024f, up = size.z + 0.0012f;
  b.mesh().Quad({lo.x, -t, up}, {hi.x, -t, up}, {hi.x, t, up}, {lo.x, t, up});
  b.Place({});
}

void GoodsOnShelf(PropBuilder& b, float x0, float x1, float y0, float depth, float z, float room, uint64_t seed) {
  RngStream rng(seed, "goods");
  float x = x0;
  while (x < x1 - 0.05f) {
    // Some facings of one product.
    const int product = static_cast<int>(rng.Index(kProducts));
    const bool round = rng.Chance(0.3);
    const float w = round ? Random(rng, 0.065f, 0.09f) : Random(rng, 0.08f, 0.19f);
    // Packages fill most of the height between shelves; low tins stand on each other.
    const float h = round ? std::min(room - 0.02f, Random(rng, 0.10f, 0.20f)) : std::min(0.36f, room * Random(rng, 0.58f, 0.93f));
    const int layers = round ? std::clamp(static_cast<int>((room - 0.02f) / (h + 0.007f)), 1, 2) : 1;
    const float deep = std::min(depth, round ? w : Random(rng, 0.05f, 0.09f));
    const int facings = 1 + static_cast<int>(rng.Index(3));
    for (int f = 0; f < facings && x + w <= x1; ++f, x += w + 0.004f) {
      if (rng.Chance(0.05)) continue;  // sold out
      const float back = rng.Chance(0.2) ? Random(rng, 0.0f, depth - deep) : Random(rng, 0, 0.012f);
      const float ya = y0 + back;
      if (round) {
        for (int l = 0; l < layers; ++l) Tin(b, {x + w / 2, ya + w / 2, z + (h + 0.007f) * static_cast<float>(l)}, w / 2, h, product);
      } else {
        Package(b, {x, ya, z}, {w, deep, h}, product);
      }
    }
    x += 0.006f;
  }
}

void Cup(PropBuilder& b, Vec3f p, float r, float h) {
  const Vec2f cup[] = {{0, 0},         {r * 0.62f, 0},        {r * 0.85f, h * 0.12f}, {r * 0.97f, h * 0.6f}, {r, h},
                       {r * 0.93f, h}, {r * 0.88f, h * 0.5f}, {r * 0.7f, h * 0.12f},  {0, h * 0.09f}};
  b.Lathe(cup, 18, p);
  const Vec3f ear[] = {p + Vec3f{r * 0.94f, 0, h * 0.80f}, p + Vec3f{r * 1.35f, 0, h * 0.82f}, p + Vec3f{r * 1.55f, 0, h * 0.55f},
                       p + Vec3f{r * 1.3f, 0, h * 0.28f}, p + Vec3f{r * 0.9f, 0, h * 0.27f}};
  b.Bar(ear, 0.0045f, 6);
}

void Bowl(PropBuilder& b, Vec3f p, float r, float h) {
  const Vec2f bowl[] = {{0, 0},         {r * 0.42f, 0},         {r * 0.45f, h * 0.08f}, {r * 0.8f, h * 0.45f}, {r, h},
                        {r * 0.95f, h}, {r * 0.74f, h * 0.45f}, {r * 0.35f, h * 0.15f}, {0, h * 0.12f}};
  b.Lathe(bowl, 22, p);
}

void Plate(PropBuilder& b, Vec3f p, float r) {
  const Vec2f plate[] = {{0, 0},      {r * 0.6f, 0},       {r * 0.68f, 0.004f}, {r, 0.018f},
                         {r, 0.020f}, {r * 0.68f, 0.009f}, {r * 0.6f, 0.006f},  {0, 0.006f}};
  b.Lathe(plate, 24, p);
}

void Bottle(PropBuilder& b, Vec3f p, float r, float h) {
  const Vec2f bottle[] = {{0, 0},
                          {r * 0.9f, 0},
                          {r, 0.008f},
                          {r, h * 0.60f},
                          {r * 0.75f, h * 0.70f},
                          {r * 0.36f, h * 0.78f},
                          {r * 0.34f, h * 0.95f},
                          {r * 0.40f, h * 0.955f},
                          {r * 0.40f, h},
                          {0, h}};
  b.Lathe(bottle, 16, p);
}

}  // namespace airsim360::internal

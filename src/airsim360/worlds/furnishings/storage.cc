// Wardrobes, chests of drawers, shelves, coat racks. Depths of Neufert's Architects' Data: wardrobes 60 cm, dressers 45,
// shelves 28 to 35.
#include <array>

#include "airsim360/base/random.h"
#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/small_parts.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"

namespace airsim360::internal {
namespace {

// What a case is made of: a timber, or lacquer where `white`.
struct Board {
  Timber timber;
  bool white;
  void Use(PropBuilder& b, Grain grain = Grain::kUpright) const {
    white ? UseLacquer(b, {0.73f, 0.72f, 0.69f}) : UseTimber(b, timber, grain);
  }
};

// An open case of 18 mm boards, its back closed; fronts come in front of it.
void Carcass(PropBuilder& b, const Board& board, float half, float y0, float y1, float z0, float z1) {
  constexpr float t = 0.018f;
  board.Use(b);
  b.BevelBox({-half, y0, z0}, {-half + t, y1, z1}, 0.0015f);
  b.BevelBox({half - t, y0, z0}, {half, y1, z1}, 0.0015f);
  b.mesh().Box({-half + t, y1 - 0.008f, z0}, {half - t, y1, z1});
  board.Use(b, Grain::kAlongX);
  b.BevelBox({-half + t, y0, z0}, {half - t, y1 - 0.008f, z0 + t}, 0.0015f);
  b.BevelBox({-half + t, y0, z1 - t}, {half - t, y1 - 0.008f, z1}, 0.0015f);
}

void Shirts(PropBuilder& b, float x0, float x1, float rail, uint64_t seed) {
  RngStream rng(seed, "shirts");
  const Vec3f tones[5] = {
      {0.60f, 0.60f, 0.58f}, {0.07f, 0.10f, 0.19f}, {0.28f, 0.09f, 0.08f}, {0.20f, 0.25f, 0.20f}, {0.04f, 0.04f, 0.045f}};
  for (float x = x0; x < x1; x += 0.055f + 0.03f * static_cast<float>(rng.Uniform())) {
    UseLinen(b, tones[rng.Index(5)]);
    HangingGarment(b, Turn(0, 0, 90, {x, 0.0f, rail}), 0.40f, 0.62f + 0.35f * static_cast<float>(rng.Uniform()), rng.Bits());
  }
}

// Two or three swinging doors, one variant with sliding ones (one a mirror), one with a door open on clothes.
Model MakeWardrobe(uint32_t variant, uint64_t seed) {
  PropBuilder b("wardrobe");
  const Board board =
      std::array<Board, 4>{{{Timber::kOak, false}, {Timber::kOak, true}, {Timber::kWalnut, false}, {Timber::kBeech, false}}}[variant];
  const int doors = std::array{3, 2, 2, 2}[variant];
  const float half = std::array{0.75f, 0.75f, 1.0f, 0.50f}[variant], top = std::array{2.01f, 2.36f, 2.20f, 1.95f}[variant];
  const float y0 = -0.28f, y1 = 0.30f, foot = 0.07f;
  Carcass(b, board, half, y0, y1, foot, top);
  board.Use(b, Grain::kAlongX);
  b.BevelBox({-half + 0.02f, y0 + 0.03f, 0}, {half - 0.02f, y1 - 0.02f, foot}, 0.002f);
  if (variant == 0) b.BevelBox({-half - 0.02f, y0 - 0.045f, top}, {half + 0.02f, y1, top + 0.03f}, 0.008f);
  const float w = 2 * half / static_cast<float>(doors);
  for (int i = 0; i < doors; ++i) {
    const float x0 = -half + w * static_cast<float>(i) + 0.002f, x1 = x0 + w - 0.004f;
    const bool open = variant == 3 && i == 1, slides = variant == 2;
    if (open) {
      // Hinged at its outer edge, 75 degrees open.
      b.Place(Turn(0, 0, 75, {half, y0, 0}));
      board.Use(b);
      Front(b, -w, 0, foot + 0.003f, top - 0.003f, 0);
      b.Use(Metal());
      BowHandle(b, {-w + 0.04f, 0.95f}, {-w + 0.04f, 1.15f}, -0.018f);
      b.Place({});
      continue;
    }
    const float y = slides && i == 1 ? y0 - 0.022f : y0;
    board.Use(b);
    Front(b, x0, x1 + (slides && i == 0 ? 0.03f : 0), foot + 0.003f, top - 0.003f, y);
    if (slides && i == 1) {
      b.Use(Mirror());
      b.BevelBox({x0 + 0.04f, y - 0.021f, foot + 0.04f}, {x1 - 0.04f, y - 0.017f, top - 0.04f}, 0.002f);
    } else if (!slides) {
      if (variant == 0) {  // framed panel
        board.Use(b, Grain::kAlongX);
        for (float z : {foot + 0.003f, 1.0f, top - 0.083f}) Front(b, x0 + 0.08f, x1 - 0.08f, z, z + 0.08f, y - 0.016f, 0.008f);
        board.Use(b);
        for (float x : {x0, x1 - 0.08f}) Front(b, x, x + 0.08f, foot + 0.003f, top - 0.003f, y - 0.016f, 0.008f);
      }
      b.Use(variant == 0 ? Metal({0.40f, 0.31f, 0.17f}, 0.35f) : Metal());
      const float x = i % 2 == 0 && doors != 3 ? x1 - 0.04f : i == 0 ? x1 - 0.04f : x0 + 0.04f;
      BowHandle(b, {x, 0.95f}, {x, 1.15f}, y - (variant == 0 ? 0.024f : 0.018f));
    }
  }
  if (variant == 3) {
    b.Use(Chrome());
    b.mesh().Tube({0.02f, 0, 1.72f}, {half - 0.02f, 0, 1.72f}, 0.0125f, 0.0125f, 10);
    Shirts(b, 0.06f, half - 0.06f, 1.72f, seed);
    board.Use(b, Grain::kAlongX);
    b.BevelBox({-half + 0.018f, y0 + 0.01f, 1.78f}, {half - 0.018f, y1 - 0.01f, 1.796f}, 0.001f);
    board.Use(b);
    b.BevelBox({-0.009f, y0 + 0.01f, foot + 0.018f}, {0.009f, y1 - 0.01f, 1.78f}, 0.001f);
  }
  return b.Finish();
}

// Three to five rows of drawers, the topmost row split.
Model MakeDresser(uint32_t variant, uint64_t) {
  PropBuilder b("dresser");
  const Board board = std::array<Board, 3>{{{Timber::kPine, false}, {Timber::kOak, true}, {Timber::kWalnut, false}}}[variant];
  const float half = std::array{0.40f, 0.60f, 0.80f}[variant], top = std::array{1.16f, 0.80f, 0.78f}[variant];
  const int rows = std::array{5, 3, 3}[variant];
  const float y0 = -0.22f, y1 = 0.23f, foot = variant == 2 ? 0.17f : 0.06f;
  Carcass(b, board, half, y0, y1, foot, top - 0.02f);
  board.Use(b, Grain::kAlongX);
  b.BevelBox({-half - 0.012f, y0 - 0.03f, top - 0.022f}, {half + 0.012f, y1, top}, 0.005f);
  const float face = (top - 0.026f - foot) / static_cast<float>(rows);
  for (int r = 0; r < rows; ++r) {
    const int columns = r == 0 || variant == 2 ? 2 : 1;
    const float z1 = top - 0.024f - face * static_cast<float>(r), w = (2 * half - 0.006f) / static_cast<float>(columns);
    for (int c = 0; c < columns; ++c) {
      const float x0 = -half + 0.003f + w * static_cast<float>(c);
      // One drawer was not pushed home.
      const float out = variant == 0 && r == 2 ? 0.035f : 0;
      board.Use(b, Grain::kAlongX);
      Front(b, x0 + 0.002f, x0 + w - 0.002f, z1 - face + 0.004f, z1, y0 - out);
      b.Use(variant == 1 ? Metal() : Metal({0.42f, 0.33f, 0.18f}, 0.35f));
      const int knobs = columns == 1 ? 2 : 1;
      for (int k = 0; k < knobs; ++k) {
        const float x = x0 + w * (knobs == 1 ? 0.5f : 0.25f + 0.5f * static_cast<float>(k));
        b.mesh().Tube({x, y0 - out - 0.018f, z1 - face / 2}, {x, y0 - out - 0.034f, z1 - face / 2}, 0.006f, 0.008f, 10, false);
        b.mesh().Sphere({x, y0 - out - 0.040f, z1 - face / 2}, {0.015f, 0.011f, 0.015f}, 8, 12);
      }
    }
  }
  board.Use(b);
  if (foot > 0.1f)
    for (float x : {-half + 0.07f, half - 0.07f})
      for (float y : {y0 + 0.06f, y1 - 0.06f}) b.mesh().Tube({x * 1.03f, y * 1.1f, 0}, {x, y, foot}, 0.012f, 0.022f, 12);
  else
    b.BevelBox({-half + 0.02f, y0 + 0.03f, 0}, {half - 0.02f, y1 - 0.02f, foot}, 0.002f);
  return b.Finish();
}

// Shelves filled unevenly with books, boxes and a vase.
Model MakeBookshelf(uint32_t variant, uint64_t seed) {
  PropBuilder b("bookshelf");
  const Board board =
      std::array<Board, 4>{{{Timber::kBeech, true}, {Timber::kOak, false}, {Timber::kWalnut, false}, {Timber::kPine, false}}}[variant];
  const float half = std::array{0.40f, 0.40f, 0.60f, 0.40f}[variant], top = std::array{2.02f, 2.02f, 1.25f, 1.06f}[variant];
  const int shelves = std::array{6, 6, 3, 3}[variant];
  const float y0 = -0.14f, y1 = 0.14f, foot = 0.06f;
  RngStream rng(seed, "bookshelf");
  Carcass(b, board, half, y0, y1, foot, top);
  board.Use(b, Grain::kAlongX);
  b.BevelBox({-half + 0.018f, y0 + 0.01f, 0}, {half - 0.018f, y1 - 0.01f, foot}, 0.002f);
  const float pitch = (top - foot - 0.018f) / static_cast<float>(shelves);
  for (int i = 0; i < shelves; ++i) {
    const float z = foot + 0.018f + pitch * static_cast<float>(i);
    if (i > 0) {
      board.Use(b, Grain::kAlongX);
      b.BevelBox({-half + 0.018f, y0 + 0.004f, z - 0.018f}, {half - 0.018f, y1 - 0.008f, z}, 0.0015f);
    }
    const float x0 = -half + 0.025f, x1 = half - 0.025f, room = pitch - 0.03f;
    const float share = 0.35f + 0.6f * static_cast<float>(rng.Uniform());
    const float end = x0 + (x1 - x0) * share;
    BooksOnShelf(b, x0, end, y0 + 0.02f, z, std::min(room, 0.30f), rng.Bits());
    if (x1 - end > 0.20f) ShelfThing(b, {(end + x1) / 2, 0.0f, z}, std::min(0.09f, (x1 - end) / 2 - 0.01f), room, rng.Bits());
  }
  return b.Finish();
}

// A stand of bent wood or steel with a coat, a hat and an umbrella on it, or a rail of hooks on a board.
Model MakeCoatRack(uint32_t variant, uint64_t seed) {
  PropBuilder b("coat_rack");
  if (variant == 0)
    UseTimber(b, Timber::kWalnut);
  else
    b.Use(Paint({0.03f, 0.03f, 0.033f}));
  const Vec2f post[] = {{0.028f, 0.02f}, {0.024f, 0.10f}, {0.020f, 1.60f}, {0.024f, 1.72f}, {0.012f, 1.76f}, {0, 1.77f}};
  b.Lathe(post, 14);
  for (int i = 0; i < 4; ++i) {
    const Vec3f d = Around(i, 4, 0.4f);
    const Vec3f foot[] = {Vec3f{0, 0, 0.16f}, d * 0.10f + Vec3f{0, 0, 0.12f}, d * 0.24f + Vec3f{0, 0, 0.022f},
                          d * 0.28f + Vec3f{0, 0, 0.016f}};
    const Vec3f hook[] = {d * 0.01f + Vec3f{0, 0, 1.60f}, d * 0.09f + Vec3f{0, 0, 1.58f}, d * 0.15f + Vec3f{0, 0, 1.63f},
                          d * 0.16f + Vec3f{0, 0, 1.71f}};
    b.Bar(foot, 0.015f, 8);
    b.Bar(hook, 0.009f, 8);
  }
  UseWeave(b, variant == 0 ? Vec3f{0.06f, 0.075f, 0.10f} : Vec3f{0.33f, 0.24f, 0.14f});
  HangingGarment(b, Turn(0, 0, 20, {0.10f, -0.06f, 1.62f}), 0.42f, 1.02f, seed);
  UseWeave(b, variant == 0 ? Vec3f{0.22f, 0.08f, 0.06f} : Vec3f{0.10f, 0.13f, 0.11f});
  HangingGarment(b, Turn(0, 0, 100, {-0.10f, 0.05f, 1.60f}), 0.40f, 0.72f, seed + 3);
  return b.Finish();
}

}  // namespace

FurnishingRows StorageRows() {
  return {{{"wardrobe", "furniture/wardrobe", 4, MakeWardrobe, 0.9f, 1.90f, 2.45f, 9000}},
          {{"dresser", "furniture/chest_of_drawers", 3, MakeDresser, 0.7f, 0.70f, 1.25f, 4500}},
          {{"bookshelf", "furniture/bookcase", 4, MakeBookshelf, 0.5f, 1.0f, 2.10f, 9000}},
          {{"coat_rack", "furniture/coat_rack", 2, MakeCoatRack, 0.4f, 1.70f, 1.85f, 3500}}};
}

}  // namespace airsim360::internal

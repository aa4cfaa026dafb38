// Boards of the 1950s: painted advertisements lit by reflectors, blades of bulbs, neon letters, pictures on bare walls.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/billboard_pictures.h"
#include "airsim360/worlds/props/billboards.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"
#include "airsim360/worlds/props/signs_1950s.h"

namespace airsim360::internal {

// No maker of these names is known to us.
constexpr std::array<PaintedAdvert, kDrawnBoards + kVistaBoards> kPaintedAdverts = {{
    {"BLACK & WHITE", ""},  // the first five are what instructions name
    {"SHARP SUITS", "5TH AVENUE"},
    {"DRIVE RED", "AT YOUR DEALER NOW"},
    {"PORTRAIT", "MUSEUM OF PHOTOGRAPHY"},
    {"BLUE AIR", ""},
    {"HELMOND RADIO", "HEAR IT IN THE PARLOR", PaintedGoods::kRadio},
    {"TRUE-CROWN HATS", "A HEAD ABOVE", PaintedGoods::kHat},
    {"GOLD CREST COFFEE", "A NICKEL WELL SPENT", PaintedGoods::kCup},
    {"SOLWAY LINES", "NEW YORK TO LISBON", PaintedGoods::kLiner},
    {"KESTREL TIRES", "WHITE WALLS AT NO CHARGE", PaintedGoods::kWheel},
    {"MARLOW SOAP", "WHITE BY MONDAY NOON", PaintedGoods::kRays},
    {"DAIRYFIELD MILK", "AT YOUR DOOR AT SIX", PaintedGoods::kBottle},
    {"NORTHFIELD COATS", "THIRD FLOOR", PaintedGoods::kHat},
    {"FINCH TOOTH POWDER", "SMILE ON", PaintedGoods::kBottle},
    {"OSPREY RAILROAD", "THE NIGHT TRAIN WEST", PaintedGoods::kWheel},
    {"HARROW SHOES", "WALK A MILE MORE", PaintedGoods::kRays},
    {"ALDEN PAINTS", "COVER EVERYTHING", PaintedGoods::kRays},
    {"ORCHARD CIDER", "FIVE CENTS", PaintedGoods::kBottle},
    {"MERIDIAN SAVINGS", "2 1/2 PER CENT", PaintedGoods::kWheel},
    {"LUMEN BULBS", "BURN LONGER", PaintedGoods::kRays},
    {"COLD SPRING BEER", "ICE COLD", PaintedGoods::kBottle},
    {"VALE INSURANCE", "CALL BEFORE IT RAINS", PaintedGoods::kRays},
    {"BRANDT GASOLINE", "UP EVERY HILL", PaintedGoods::kWheel},
    {"HELIA PICTURES", "IN FULL COLOR", PaintedGoods::kRays},
    {"QUILL TYPEWRITERS", "FOR THE MODERN OFFICE", PaintedGoods::kRadio},
    {"HARGROVE BREAD", "SOFT TO THE CRUST", PaintedGoods::kLoaf},
    {"LAKE & PINE", "CABINS BY THE WEEK", PaintedGoods::kRays},
    {"IVERSEN SARDINES", "FROM COLD WATERS", PaintedGoods::kLiner},
    {"GRAND BALLROOM", "TWO BANDS NIGHTLY", PaintedGoods::kRays},
    {"THE DAILY HERON", "FIRST WITH THE NEWS", PaintedGoods::kHat},
    {"AURELIO OLIVE OIL", "SINCE 1894", PaintedGoods::kBottle},
    {"BRENNAN LUGGAGE", "GOES WHERE YOU GO", PaintedGoods::kLiner},
}};
constexpr std::array<std::string_view, kLightBoxes> kNeonSigns = {
    "BALLROOM",   "LUNCHEONETTE", "HOTEL ASTRA", "PENNY ARCADE", "CAFETERIA",    "NEWSREELS", "DANCE STUDIO",   "PAWN & LOAN",
    "MUSIC HALL", "STEAK HOUSE",  "BILLIARDS",   "TEXTILE CO",   "ROOMS BY DAY", "COCKTAILS", "THE OYSTER BAR", "GARAGE"};
constexpr std::array<std::string_view, 4> kBlades = {"PALACE", "LIQUOR", "HOTEL", "DANCING"};
constexpr std::array<std::string_view, 4> kWallAdverts = {"HARPER & SONS PIANOS", "OLD CAPTAIN CIGARS", "ROYAL FLOUR", "FRESH BREAD DAILY"};

std::vector<std::string> SignTexts1950s() {
  std::vector<std::string> texts;
  for (const PaintedAdvert& advert : kPaintedAdverts)
    for (const char* text : {advert.name, advert.line}) texts.emplace_back(text);
  for (const auto& list : {std::span<const std::string_view>(kNeonSigns), std::span<const std::string_view>(kBlades),
                           std::span<const std::string_view>(kWallAdverts)})
    texts.insert(texts.end(), list.begin(), list.end());
  std::erase(texts, "");
  return texts;
}

namespace {

constexpr Vec2f kHoarding{560, 336};
constexpr Vec3f kChalk{0.66f, 0.62f, 0.50f}, kTeal{0.03f, 0.20f, 0.20f}, kMustard{0.56f, 0.34f, 0.04f}, kSignRed{0.42f, 0.025f, 0.015f},
    kSignNavy{0.015f, 0.035f, 0.11f}, kRose{0.52f, 0.22f, 0.18f}, kLeafGreen{0.05f, 0.16f, 0.06f}, kSoot{0.014f, 0.014f, 0.016f};

// Ellipse with radii in widths and heights of the hoarding.
void PaintOval(Canvas& c, Vec2f middle, Vec2f r, Vec3f color) {
  const Vec2f m{middle.x * kHoarding.x, middle.y * kHoarding.y}, q{r.x * kHoarding.x, r.y * kHoarding.y};
  c.Fill(
      m - q, m + q, [&](float x, float y) { return (x - m.x) * (x - m.x) / (q.x * q.x) + (y - m.y) * (y - m.y) / (q.y * q.y) < 1; }, color);
}

// What the painter put beside the name, its middle at m, 0.5 high.
void PaintGoods(Canvas& c, PaintedGoods goods, Vec2f m, Vec3f tone, Vec3f light) {
  const auto box = [&](float x0, float y0, float x1, float y1, Vec3f color) {
    c.Rectangle({m.x + x0, m.y + y0}, {m.x + x1, m.y + y1}, color);
  };
  switch (goods) {
    case PaintedGoods::kRadio:
      box(-0.14f, -0.16f, 0.14f, 0.22f, {0.14f, 0.06f, 0.025f});
      box(-0.11f, -0.12f, 0.11f, 0.06f, light * 0.7f);
      for (int i = 0; i < 5; ++i)
        box(-0.10f, -0.11f + 0.035f * static_cast<float>(i), 0.10f, -0.098f + 0.035f * static_cast<float>(i), tone);
      for (float x : {-0.07f, 0.07f}) c.Disc({m.x + x, m.y + 0.14f}, 0.05f, light);
      break;
    case PaintedGoods::kHat:
      PaintOval(c, {m.x, m.y + 0.12f}, {0.18f, 0.07f}, {0.11f, 0.075f, 0.05f});
      PaintOval(c, {m.x, m.y + 0.02f}, {0.10f, 0.17f}, {0.13f, 0.09f, 0.06f});
      box(-0.10f, 0.06f, 0.10f, 0.11f, kSoot);
      break;
    case PaintedGoods::kCup:
      PaintOval(c, {m.x, m.y + 0.20f}, {0.15f, 0.04f}, light * 0.8f);
      box(-0.09f, -0.06f, 0.09f, 0.17f, light);
      PaintOval(c, {m.x, m.y - 0.06f}, {0.09f, 0.03f}, {0.06f, 0.025f, 0.012f});
      c.Line({m.x + 0.09f, m.y}, {m.x + 0.13f, m.y + 0.05f}, 0.035f, light);
      for (float x : {-0.04f, 0.03f}) c.Line({m.x + x, m.y - 0.12f}, {m.x + x + 0.015f, m.y - 0.25f}, 0.016f, light);
      break;
    case PaintedGoods::kLiner:
      for (int i = 0; i < 12; ++i) {
        const float t = static_cast<float>(i) / 11;
        box(-0.19f + 0.05f * t, 0.06f + 0.11f * t, 0.19f - 0.05f * t, 0.08f + 0.11f * t, kSoot);
      }
      box(-0.13f, -0.01f, 0.12f, 0.06f, light);
      for (float x : {-0.08f, 0.0f, 0.08f}) {
        box(x - 0.022f, -0.15f, x + 0.022f, -0.01f, tone);
        box(x - 0.022f, -0.15f, x + 0.022f, -0.11f, kSoot);
      }
      break;
    case PaintedGoods::kWheel:
      c.Disc(m, 0.24f, kSoot);
      c.Disc(m, 0.19f, light);
      c.Disc(m, 0.14f, tone);
      c.Disc(m, 0.06f, light);
      break;
    case PaintedGoods::kBottle:
      box(-0.06f, -0.02f, 0.06f, 0.26f, light);
      box(-0.025f, -0.24f, 0.025f, 0.0f, light);
      PaintOval(c, {m.x, m.y - 0.01f}, {0.06f, 0.07f}, light);
      box(-0.06f, 0.05f, 0.06f, 0.17f, tone);
      break;
    case PaintedGoods::kRays:
      for (int i = 0; i < 12; ++i) {
        const float a = kTauF * static_cast<float>(i) / 12;
        c.Line(m, {m.x + 0.16f * std::cos(a), m.y + 0.27f * std::sin(a)}, 0.03f, light);
      }
      c.Disc(m, 0.14f, tone);
      break;
    case PaintedGoods::kLoaf:
      PaintOval(c, {m.x, m.y + 0.05f}, {0.17f, 0.17f}, {0.28f, 0.13f, 0.04f});
      for (float x : {-0.08f, 0.0f, 0.08f})
        c.Line({m.x + x - 0.02f, m.y + 0.02f}, {m.x + x + 0.03f, m.y - 0.09f}, 0.03f, {0.48f, 0.28f, 0.10f});
  }
}

// A saloon of the time in red, over "DRIVE RED".
void PaintRedCar(Canvas& c) {
  c.Rectangle({0, 0}, {1, 1}, kChalk);
  c.Rectangle({0, 0.74f}, {1, 1}, kTeal);
  const Vec3f red{0.55f, 0.015f, 0.015f}, dark{0.04f, 0.06f, 0.07f};
  PaintOval(c, {0.52f, 0.50f}, {0.20f, 0.17f}, red);
  PaintOval(c, {0.52f, 0.51f}, {0.17f, 0.12f}, dark);
  c.Rectangle({0.505f, 0.36f}, {0.525f, 0.60f}, red);
  c.Rectangle({0.14f, 0.55f}, {0.90f, 0.76f}, red);
  PaintOval(c, {0.16f, 0.655f}, {0.08f, 0.105f}, red);
  PaintOval(c, {0.87f, 0.655f}, {0.09f, 0.105f}, red);
  c.Line({0.10f, 0.62f}, {0.92f, 0.62f}, 0.014f, {0.66f, 0.66f, 0.64f});
  for (float x : {0.27f, 0.76f}) {
    c.Disc({x, 0.76f}, 0.115f, kSoot);
    c.Disc({x, 0.76f}, 0.088f, {0.66f, 0.65f, 0.62f});
    c.Disc({x, 0.76f}, 0.055f, red);
  }
  c.Letters("DRIVE RED", {0.5f, 0.17f}, 0.20f, kSignRed, 0.95f);
}

Texture PaintedBoard(uint32_t variant) {
  // The other named ones are as they always were.
  if (variant < 5 && variant != 2) return BoardPicture(variant);
  static constexpr std::array<std::array<Vec3f, 3>, 6> kSchemes = {{{kChalk, kSignRed, kSignNavy},
                                                                    {kTeal, kChalk, kMustard},
                                                                    {kMustard, kSoot, kSignRed},
                                                                    {kSignNavy, kChalk, kRose},
                                                                    {kSignRed, kChalk, kMustard},
                                                                    {kLeafGreen, kChalk, kMustard}}};
  Canvas c(static_cast<int>(kHoarding.x), static_cast<int>(kHoarding.y), kChalk);
  const PaintedAdvert& advert = kPaintedAdverts[variant];
  if (variant == 2) {
    PaintRedCar(c);
  } else {
    const auto& [ground, ink, accent] = kSchemes[variant % 6];
    c.Rectangle({0, 0}, {1, 1}, ground);
    const bool left = variant % 2 == 0;
    const float x = left ? 0.20f : 0.80f;
    c.Disc({x, 0.48f}, 0.36f, accent);
    PaintGoods(c, advert.goods, {x, 0.47f}, ground, {0.62f, 0.60f, 0.52f});
    // The name in two lines where it has two words.
    const std::string_view name = advert.name;
    const size_t gap = name.rfind(' ');
    const float middle = left ? 0.68f : 0.33f;
    const auto line = [&](std::string_view text, float y, float most) {
      c.Letters(text, {middle, y}, std::min(most, 1.12f / static_cast<float>(std::max<size_t>(text.size(), 4))), ink, 0.85f);
    };
    line(name.substr(0, gap), 0.28f, 0.20f);
    line(name.substr(gap + 1), 0.53f, 0.20f);
    c.Letters(advert.line, {middle, 0.77f}, std::min(0.06f, 1.0f / static_cast<float>(std::string_view(advert.line).size())), ink, 0.85f);
    c.Rectangle({0.02f, 0.93f}, {0.98f, 0.955f}, accent);
  }
  PrintAndAge(c, variant + 80, 4, 2);
  return c.Finish("painted board " + std::to_string(variant));
}

// A face of w x h metres on a frame; lit at night to `nits`.
void AddFace1950s(PropBuilder& b, float w, float h, const Texture& face, float nits) {
  b.Use(Paint({0.045f, 0.055f, 0.045f}, 0.6f));
  b.BevelBox({-w / 2 - 0.16f, -0.34f, 0}, {w / 2 + 0.16f, 0.0f, h + 0.28f}, 0.06f);
  Material picture = Paint({1, 1, 1}, 0.7f);
  picture.name = "painted face";
  picture.emission = Vec3f{1.0f, 0.86f, 0.66f} * (nits * kNit);
  picture.lamp = true;
  b.Use(picture, face);
  b.Picture({-w / 2, -0.345f, 0.14f}, {w / 2, -0.345f, 0.14f}, {w / 2, -0.345f, 0.14f + h}, {-w / 2, -0.345f, 0.14f + h});
}

// Reflectors on arms over the upper edge, whose light falls on the face.
void AddReflectors(PropBuilder& b, float w, float h) {
  for (int i = 0; i < 5; ++i) {
    const float x = -w * 0.4f + w * 0.2f * static_cast<float>(i);
    const Vec3f arm[] = {{x, -0.1f, h + 0.26f}, {x, -0.5f, h + 0.50f}, {x, -1.15f, h + 0.42f}};
    b.Use(Paint({0.03f, 0.035f, 0.03f}, 0.5f));
    b.Bar(arm, 0.025f, 6);
    b.Place(Turn(-40, 0, 0, {x, -1.2f, h + 0.40f}));
    const Vec2f shade[] = {{0.20f, -0.16f}, {0.16f, -0.06f}, {0.07f, 0.02f}, {0, 0.04f}};
    b.Lathe(shade, 12);
    b.Use(Glow({1.0f, 0.82f, 0.56f}, 4000));
    b.mesh().Tube({0, 0, -0.12f}, {0, 0, -0.08f}, 0.09f, 0.09f, 10);
    b.Place({});
  }
}

Model MakePaintedBoard(uint32_t variant, uint64_t) {
  PropBuilder b("billboard_1950s");
  AddFace1950s(b, 10, 6, PaintedBoard(variant), 26);
  AddReflectors(b, 10, 6);
  return b.Finish();
}

constexpr std::array<Vec3f, 6> kNeon = {{{0.80f, 0.06f, 0.03f},
                                         {0.05f, 0.55f, 0.42f},
                                         {0.80f, 0.30f, 0.03f},
                                         {0.70f, 0.10f, 0.28f},
                                         {0.10f, 0.25f, 0.75f},
                                         {0.72f, 0.55f, 0.20f}}};

Model MakeNeonSign(uint32_t variant, uint64_t) {
  PropBuilder b("light_box_1950s");
  Canvas c(576, 128, {0.010f, 0.012f, 0.016f});
  const Vec3f tube = kNeon[variant % 6], other = kNeon[(variant + 1) % 6];
  const auto letters = static_cast<float>(kNeonSigns[variant].size());
  const float size = std::min(0.50f, 5.4f / letters);
  c.Letters(kNeonSigns[variant], {0.504f, 0.512f}, size * 1.07f, tube * 0.20f, 0.85f);  // its glow on the board
  c.Letters(kNeonSigns[variant], {0.5f, 0.5f}, size, tube, 0.85f);
  for (float y : {0.09f, 0.91f}) c.Line({0.03f, y}, {0.97f, y}, 0.035f, other);
  for (float x : {0.03f, 0.97f}) c.Line({x, 0.09f}, {x, 0.91f}, 0.035f, other);
  AddFace1950s(b, 9, 1.9f, c.Finish("neon " + std::to_string(variant)), 130);
  return b.Finish();
}

// Letters one over the other between rows of bulbs.
Model MakeBlade(uint32_t variant, uint64_t) {
  PropBuilder b("banner_1950s");
  static constexpr std::array<Vec3f, 4> kGrounds = {kSignRed, kSignNavy, {0.02f, 0.02f, 0.022f}, kTeal};
  Canvas c(224, 616, kGrounds[variant]);
  const std::string_view word = kBlades[variant];
  const auto n = static_cast<float>(word.size());
  for (size_t i = 0; i < word.size(); ++i)
    c.Letters(word.substr(i, 1), {0.5f, 0.06f + 0.90f * (static_cast<float>(i) + 0.5f) / n}, 0.70f / n, variant == 2 ? kNeon[0] : kChalk,
              1.5f);
  for (int i = 0; i < 34; ++i) {
    const float y = 0.02f + 0.96f * static_cast<float>(i) / 33;
    for (float x : {0.06f, 0.94f}) c.Disc({x, y}, 0.0085f, {0.80f, 0.62f, 0.30f});
  }
  AddFace1950s(b, 4, 11, c.Finish("blade " + std::to_string(variant)), 60);
  return b.Finish();
}

Model MakeWallAdvert(uint32_t variant, uint64_t) {
  PropBuilder b("mural_1950s");
  Canvas c(1008, 720, kChalk * 0.75f);
  static constexpr std::array<std::array<Vec3f, 2>, 4> kTones = {
      {{kSoot * 3.0f, kChalk}, {kSignRed * 0.7f, kChalk}, {kSignNavy, kMustard}, {kLeafGreen * 0.8f, kChalk}}};
  const auto& [ground, ink] = kTones[variant];
  c.Rectangle({0.02f, 0.03f}, {0.98f, 0.97f}, ground);
  c.Rectangle({0.04f, 0.055f}, {0.96f, 0.065f}, ink);
  c.Rectangle({0.04f, 0.935f}, {0.96f, 0.945f}, ink);
  // A word a line.
  const std::string_view text = kWallAdverts[variant];
  const size_t gap = text.rfind(' ');
  const std::string_view first = text.substr(0, gap), last = text.substr(gap + 1);
  c.Letters(first, {0.5f, 0.30f}, std::min(0.22f, 1.45f / static_cast<float>(first.size())), ink, 0.85f);
  c.Letters(last, {0.5f, 0.62f}, std::min(0.28f, 1.5f / static_cast<float>(last.size())), ink, 1.0f);
  c.Letters(variant % 2 ? "5 CENTS" : "EST. 1887", {0.5f, 0.86f}, 0.09f, ink * 0.9f, 1.0f);
  c.Paint([&](float u, float v, Vec3f old) {
    const float worn = TileFractal(u, v, 5, 4, 5, 191 + variant);
    const Vec3f brick = Vec3f{0.21f, 0.135f, 0.095f} * (0.8f + 0.4f * TileNoise(u * 60, v * 124, 60, 124, 7));
    const float keep = std::clamp((0.66f - worn) * 7, 0.25f, 0.92f);
    return brick * (1 - keep) + old * keep;
  });
  b.Use(Paint({1, 1, 1}, 0.85f), c.Finish("wall advert " + std::to_string(variant)), {12.6f, 9});
  b.Sheet(4, 3, [](float u, float v) { return Vec3f{-6.3f + 12.6f * u, -0.02f, 9 * v}; }, {12.6f, 9});
  return b.Finish();
}

}  // namespace

std::vector<PropKind> Signs1950sKinds() {
  return {
      {"billboard_1950s", "signage/billboard", kDrawnBoards + kVistaBoards, MakePaintedBoard, 5.2f, 6.0f, 7.2f, 1200},
      {"banner_1950s", "signage/billboard", 4, MakeBlade, 2.2f, 11.0f, 11.6f, 100},
      {"mural_1950s", "signage/billboard", 4, MakeWallAdvert, 6.4f, 8.9f, 9.1f, 50},
      {"light_box_1950s", "signage/billboard", kLightBoxes, MakeNeonSign, 4.7f, 2.0f, 2.4f, 100},
  };
}

}  // namespace airsim360::internal

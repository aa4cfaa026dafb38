#include "airsim360/worlds/props/billboard_pictures.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/base/disk_cache.h"
#include "airsim360/math/angles.h"
#include "airsim360/scene/luminance.h"
#include "airsim360/worlds/props/billboards.h"
#include "airsim360/worlds/props/portrait.h"
#include "airsim360/worlds/texture/kept_textures.h"

namespace airsim360::internal {
namespace {

constexpr Vec3f kWhite{0.76f, 0.76f, 0.74f}, kBlack{0.012f, 0.012f, 0.013f}, kRed{0.55f, 0.012f, 0.015f}, kYellow{0.80f, 0.48f, 0.012f},
    kSkin{0.50f, 0.30f, 0.21f};

// Filled ellipse, radii in picture widths and heights.
void Ellipse(Canvas& c, Vec2f size, Vec2f middle, Vec2f r, Vec3f color) {
  const Vec2f m{middle.x * size.x, middle.y * size.y}, q{r.x * size.x, r.y * size.y};
  c.Fill(
      m - q, m + q,
      [&](float x, float y) {
        const float dx = (x - m.x) / q.x, dy = (y - m.y) / q.y;
        return dx * dx + dy * dy < 1;
      },
      color);
}

// Filled polygon in picture coordinates.
void Shape(Canvas& c, Vec2f size, std::vector<Vec2f> points, Vec3f color) {
  Vec2f lo{1e9f, 1e9f}, hi{-1e9f, -1e9f};
  for (Vec2f& p : points) {
    p = {p.x * size.x, p.y * size.y};
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  }
  c.Fill(
      lo, hi,
      [&](float x, float y) {
        bool in = false;
        for (size_t i = 0, j = points.size() - 1; i < points.size(); j = i++) {
          const Vec2f a = points[i], b = points[j];
          if ((a.y > y) != (b.y > y) && x < (b.x - a.x) * (y - a.y) / (b.y - a.y) + a.x) in = !in;
        }
        return in;
      },
      color);
}

constexpr Vec2f kBoard{640, 384};

void Gradient(Canvas& c, Vec3f top, Vec3f bottom) {
  for (int i = 0; i < 48; ++i) {
    const float t = static_cast<float>(i) / 47;
    c.Rectangle({0, t * 47 / 48}, {1, t * 47 / 48 + 1.0f / 48}, top * (1 - t) + bottom * t);
  }
}

// A sitter whose middle is at x, before what the canvas shows already. No face is shown: a suit from the neck down, or a
// head against the light in grey.
void Portrait(Canvas& c, float x, const Sitter& sitter, bool gray) {
  const float heads = gray ? 2.35f : 0.98f, top = gray ? 0.86f : -0.52f;  // height of the picture, and where its upper edge lies
  c.Paint([&](float u, float v, Vec3f old) {
    constexpr Vec3f kNobody{-1, -1, -1};
    const Vec3f color = PortraitColor(sitter, (u - x) * heads * kBoard.x / kBoard.y, top - v * heads, kNobody);
    if (color.x < 0) return old;
    const float y = 0.010f + 0.10f * Luminance(color);
    return gray ? Vec3f{y, y, y} : color;
  });
}

// What landscapes of posters are called, and what their advertisers promise: no two alike.
struct Advert {
  const char* name;
  const char* line;
};
constexpr Advert kAdverts[] = {{"NORTHFIELD", "THE LONG WAY HOME"},
                               {"LAKE & PINE", "CABINS BY THE WEEK"},
                               {"HELIA", "SUN CARE SINCE 1974"},
                               {"AURELIO", "OLIVE OIL FROM THE COAST"},
                               {"MERIDIAN BANK", "A PLAN FOR LATER"},
                               {"SOLWAY FERRIES", "FOUR SAILINGS A DAY"},
                               {"TIDEWATER FM", "98.3 MORNINGS"},
                               {"HARROW COATS", "WINTER COLLECTION"},
                               {"ALTO WATER", "FROM 2100 METRES"},
                               {"KESTREL", "BOOTS FOR LIFE"},
                               {"COLD HARBOR", "A NEW SERIES"},
                               {"VALE INSURANCE", "CALL BEFORE IT RAINS"},
                               {"GRANDVIEW", "APARTMENTS FROM SPRING"},
                               {"THE ORCHARD", "CIDER AS IT WAS"},
                               {"OSPREY RAIL", "CITY TO SEA IN 90 MIN"},
                               {"FOLKLORE", "FESTIVAL 12 - 14 JUNE"},
                               {"MUSEUM OF THE SEA", "OPEN LATE FRIDAYS"},
                               {"EASTERLY", "COFFEE ROASTERS"},
                               {"PLATEAU", "TYRES FOR ALL SEASONS"},
                               {"BRIGHT & DAWE", "ATTORNEYS AT LAW"}};
static_assert(std::size(kAdverts) == kVistaBoards);

// A photographed country: sky with clouds, ridges one behind the other in haze, a near slope or water.
class Country {
 public:
  /// `high`: where the horizon lies, 0 … 1.
  Country(const Canvas& canvas, uint32_t k, float high)
      : k_(k),
        water_(k % 4 == 1),
        evening_(k % 3 == 0   ? 1.0f
                 : k % 3 == 1 ? 0.25f
                              : 0.0f),
        horizon_(0.42f + 0.16f * high),
        zenith_(Vec3f{0.10f, 0.20f, 0.42f} * (1 - 0.5f * evening_)),
        low_(Vec3f{0.55f, 0.60f, 0.66f} * (1 - evening_) + Vec3f{0.66f, 0.36f, 0.17f} * evening_),
        ground_(water_  ? Vec3f{0.05f, 0.10f, 0.13f}
                : k % 2 ? Vec3f{0.09f, 0.12f, 0.035f}
                        : Vec3f{0.20f, 0.15f, 0.07f}),
        near_(canvas, [&](float u) { return horizon_ + 0.20f + 0.05f * TileFractal(u, 0.7f, 5, 2, 4, 441 + k); }) {
    for (int layer = 0; layer < 3; ++layer) {
      const auto l = static_cast<float>(layer);
      ridges_.emplace_back(canvas, [&](float u) {
        const float base = horizon_ + 0.05f * l, rough = TileFractal(u + 0.31f * l, 0.2f, 3 + 2 * layer, 2, 6, 421 + k_ * 5);
        return base - (0.26f - 0.06f * l) * (rough - 0.22f);
      });
    }
  }

  Vec3f At(float u, float v) const {
    const float du = u - 0.5f, dv = v - 0.5f;
    return Unshaded(u, v) * (1.05f - 0.55f * (du * du + dv * dv));
  }

 private:
  Vec3f Unshaded(float u, float v) const {
    const float near = near_(u);
    if (v > near) {
      const float t = (v - near) / (1 - near), grain = TileFractal(u, v / (0.3f + t), water_ ? 6 : 40, 48, 4, 451 + k_);
      return water_ ? ground_ * (0.5f + grain) + low_ * (0.28f * (1 - t) * grain) : ground_ * (0.45f + 1.1f * grain);
    }
    for (int layer = 2; layer >= 0; --layer) {
      if (v < ridges_[static_cast<size_t>(layer)](u)) continue;
      const float haze = 0.70f - 0.28f * static_cast<float>(layer), light = 0.6f + 0.8f * TileFractal(u, v, 24, 24, 4, 431 + k_);
      return (ground_ * 0.6f + Vec3f{0.02f, 0.03f, 0.035f}) * light * (1 - haze) + low_ * (0.62f * haze);
    }
    const float up = std::clamp(v / horizon_, 0.0f, 1.0f),
                cloud = std::clamp((TileFractal(u, v * 1.6f, 3, 4, 6, 411 + k_) - 0.50f) * 5, 0.0f, 1.0f);
    const Vec3f clear = zenith_ * (1 - up * up) + low_ * (up * up);
    return clear * (1 - 0.7f * cloud) +
           (Vec3f{0.72f, 0.70f, 0.68f} * (1 - evening_) + Vec3f{0.62f, 0.34f, 0.22f} * evening_) * (0.7f * cloud);
  }

  uint32_t k_;
  bool water_;
  float evening_, horizon_;
  Vec3f zenith_, low_, ground_;
  Canvas::Columns near_;
  std::vector<Canvas::Columns> ridges_;
};

// A country and a line of print.
Texture Vista(uint32_t k) {
  constexpr Vec2f kSize{480, 288};
  Canvas c(static_cast<int>(kSize.x), static_cast<int>(kSize.y), kBlack);
  const auto dice = [&](uint32_t i) {
    return TileNoise(static_cast<float>(k) * 2.31f + 0.5f, static_cast<float>(i) * 1.7f + 0.3f, 64, 64, 401);
  };
  const Country country(c, k, dice(1));
  c.Paint([&](float u, float v, Vec3f) { return country.At(u, v); });
  const Advert& advert = kAdverts[k];
  const bool above = dice(3) < 0.5f, panel = k % 5 == 2;
  const float y = above ? 0.16f : 0.78f, wide = 0.62f + 0.25f * dice(4);
  if (panel)
    c.Rectangle({0, above ? 0.0f : 0.66f}, {1, above ? 0.32f : 1.0f}, k % 2 ? Vec3f{0.58f, 0.57f, 0.53f} : Vec3f{0.05f, 0.07f, 0.09f});
  const Vec3f ink = panel && k % 2 ? kBlack : kWhite;
  const auto letters = static_cast<float>(std::string_view(advert.name).size());
  c.Letters(advert.name, {0.5f, y}, std::min(0.17f, 1.62f / letters), ink, wide);
  c.Letters(advert.line, {0.5f, y + 0.135f}, 0.045f, ink, 0.95f);
  PrintAndAge(c, k + 40, 4, 2);
  return c.Finish("board vista " + std::to_string(k));
}

void RedCar(Canvas& c) {
  const Vec2f s = kBoard;
  Gradient(c, {0.05f, 0.07f, 0.12f}, {0.30f, 0.24f, 0.20f});
  c.Rectangle({0, 0.78f}, {1, 1}, {0.035f, 0.035f, 0.04f});
  Shape(c, s,
        {{0.08f, 0.80f},
         {0.07f, 0.66f},
         {0.16f, 0.58f},
         {0.30f, 0.54f},
         {0.42f, 0.40f},
         {0.62f, 0.39f},
         {0.76f, 0.54f},
         {0.90f, 0.58f},
         {0.94f, 0.68f},
         {0.93f, 0.80f}},
        {0.62f, 0.012f, 0.015f});
  Shape(c, s, {{0.34f, 0.55f}, {0.44f, 0.43f}, {0.52f, 0.43f}, {0.52f, 0.55f}}, {0.05f, 0.07f, 0.09f});
  Shape(c, s, {{0.54f, 0.55f}, {0.54f, 0.43f}, {0.61f, 0.43f}, {0.71f, 0.55f}}, {0.05f, 0.07f, 0.09f});
  c.Line({0.09f, 0.68f}, {0.92f, 0.66f}, 0.012f, {0.30f, 0.006f, 0.008f});
  for (float x : {0.24f, 0.77f}) {
    c.Disc({x, 0.80f}, 0.125f, kBlack);
    c.Disc({x, 0.80f}, 0.078f, {0.45f, 0.46f, 0.48f});
    c.Disc({x, 0.80f}, 0.03f, kBlack);
  }
  Ellipse(c, s, {0.115f, 0.635f}, {0.03f, 0.022f}, {0.85f, 0.83f, 0.7f});
  // Studio light: a bright line along the shoulder, dark flanks, the floor's glow at the sills; a mirror image on the floor.
  c.Paint([](float u, float v, Vec3f old) {
    const auto bell = [](float x, float w) { return std::exp(-x * x / (w * w)); };
    if (old.x > 3.5f * old.y && old.x > 0.2f) {
      const float shoulder = bell(v - 0.575f - 0.02f * std::sin(5 * u), 0.016f), roof = bell(v - 0.41f, 0.014f);
      return old * (0.85f + 0.30f * bell(v - 0.76f, 0.05f)) + Vec3f{0.40f, 0.22f, 0.20f} * (0.75f * shoulder + 0.6f * roof);
    }
    if (v > 0.82f) return old + Vec3f{0.10f, 0.012f, 0.012f} * (bell(u - 0.5f, 0.34f) * bell(v - 0.84f, 0.06f));
    return old * (0.75f + 0.35f * TileFractal(u, v, 3, 2, 3, 61));
  });
  c.Letters("DRIVE RED", {0.5f, 0.18f}, 0.19f, kWhite, 0.95f);
}

void Skyline(Canvas& c, Vec3f color, float base, uint32_t seed) {
  for (int i = 0; i < 22; ++i) {
    const float h = 0.08f + 0.30f * TileNoise(static_cast<float>(i) * 0.73f, 0.5f, 64, 64, seed);
    const float x = static_cast<float>(i) / 22;
    c.Rectangle({x, base - h}, {x + 0.05f, base}, color);
    for (float y = base - h + 0.02f; y < base - 0.02f; y += 0.03f)
      for (float u : {0.010f, 0.024f, 0.037f})
        if (TileNoise(x * 400 + u * 900, y * 300, 512, 512, seed + 3) > 0.5f)
          c.Rectangle({x + u, y}, {x + u + 0.007f, y + 0.014f}, {0.8f, 0.6f, 0.2f});
  }
}

void BlackAndWhiteBoard(Canvas& c) {
  c.Letters("BLACK", {0.30f, 0.28f}, 0.30f, kWhite, 0.72f);
  c.Letters("&", {0.5f, 0.5f}, 0.2f, kRed);
  c.Rectangle({0.0f, 0.60f}, {1, 1}, kWhite);
  c.Letters("WHITE", {0.66f, 0.80f}, 0.28f, kBlack, 0.78f);
}

// A man in a blue suit.
void BlueSuitBoard(Canvas& c) {
  Gradient(c, {0.62f, 0.60f, 0.55f}, {0.72f, 0.70f, 0.65f});
  Portrait(c, 0.30f,
           {kSkin, {0.035f, 0.022f, 0.015f}, {0.10f, 0.16f, 0.22f}, {0.015f, 0.055f, 0.34f}, kWhite, {0.02f, 0.03f, 0.12f}, 0.25f}, false);
  c.Letters("SHARP", {0.73f, 0.34f}, 0.20f, {0.015f, 0.055f, 0.34f}, 0.8f);
  c.Letters("SUITS", {0.73f, 0.60f}, 0.20f, {0.015f, 0.055f, 0.34f}, 0.8f);
  c.Letters("5TH AVENUE", {0.73f, 0.83f}, 0.075f, kBlack, 0.9f);
}

// A black and white portrait.
void PortraitBoard(Canvas& c) {
  Gradient(c, {0.05f, 0.05f, 0.05f}, {0.42f, 0.42f, 0.42f});
  Portrait(c, 0.66f, {kSkin * 1.2f, {0.02f, 0.02f, 0.02f}, {0.1f, 0.1f, 0.1f}, {0.03f, 0.03f, 0.03f}, kWhite, {0.05f, 0.05f, 0.05f}, -0.3f},
           true);
  c.Letters("PORTRAIT", {0.24f, 0.22f}, 0.10f, kWhite, 0.75f);
  c.Letters("MUSEUM OF", {0.24f, 0.70f}, 0.065f, kWhite, 0.9f);
  c.Letters("PHOTOGRAPHY", {0.24f, 0.82f}, 0.065f, kWhite, 0.8f);
}

void BlueAirBoard(Canvas& c) {
  Gradient(c, {0.02f, 0.16f, 0.62f}, {0.05f, 0.30f, 0.80f});
  c.Disc({0.87f, 0.30f}, 0.12f, {0.85f, 0.85f, 0.83f});
  for (int i = 0; i < 3; ++i)
    c.Line({-0.05f, 0.66f + 0.1f * static_cast<float>(i)}, {1.05f, 0.60f + 0.1f * static_cast<float>(i)}, 0.035f, {0.35f, 0.62f, 0.85f});
  c.Letters("BLUE AIR", {0.38f, 0.32f}, 0.21f, kWhite, 0.75f);
}

void EnergyBoard(Canvas& c) {
  c.Letters("WHERE", {0.27f, 0.13f}, 0.13f, kWhite, 0.9f);
  c.Letters("MAXIMUM", {0.38f, 0.30f}, 0.15f, kWhite, 0.9f);
  c.Letters("ENERGY LIVES", {0.43f, 0.47f}, 0.10f, kWhite, 0.9f);
  c.Letters("VOLT+", {0.66f, 0.77f}, 0.28f, kRed, 1.0f);
}

void RunningBoard(Canvas& c) {
  Gradient(c, {0.60f, 0.02f, 0.02f}, {0.42f, 0.01f, 0.012f});
  c.Letters("RUN CITY", {0.5f, 0.24f}, 0.24f, kWhite, 0.85f);
  Shape(c, kBoard,
        {{0.14f, 0.84f}, {0.12f, 0.62f}, {0.30f, 0.56f}, {0.44f, 0.66f}, {0.70f, 0.72f}, {0.86f, 0.80f}, {0.87f, 0.87f}, {0.15f, 0.88f}},
        {0.05f, 0.06f, 0.12f});
  for (int i = 0; i < 4; ++i)
    c.Line({0.34f + 0.07f * static_cast<float>(i), 0.83f}, {0.40f + 0.07f * static_cast<float>(i), 0.66f + 0.015f * static_cast<float>(i)},
           0.02f, kWhite);
  c.Rectangle({0.14f, 0.88f}, {0.88f, 0.93f}, kWhite);
}

void SkylineBoard(Canvas& c) {
  Gradient(c, {0.03f, 0.02f, 0.10f}, {0.45f, 0.14f, 0.10f});
  Skyline(c, {0.012f, 0.012f, 0.03f}, 1.0f, 7);
  c.Letters("SKYLINE LIVE", {0.5f, 0.22f}, 0.17f, {0.85f, 0.62f, 0.18f}, 0.95f);
  c.Letters("THE MUSICAL", {0.5f, 0.44f}, 0.08f, kWhite);
}

void TaxiBoard(Canvas& c) {
  c.Rectangle({0, 0}, {1, 1}, kYellow);
  c.Rectangle({0.04f, 0.62f}, {0.96f, 0.93f}, kBlack);
  c.Letters("NYC TAXI", {0.5f, 0.30f}, 0.26f, kBlack, 0.82f);
  c.Letters("24 HOURS", {0.5f, 0.78f}, 0.17f, kYellow);
}

void MarketBoard(Canvas& c) {
  Gradient(c, {0.02f, 0.20f, 0.09f}, {0.01f, 0.10f, 0.05f});
  for (int i = 0; i < 9; ++i) {
    const float a = kTauF * static_cast<float>(i) / 9;
    Ellipse(c, kBoard, {0.77f + 0.10f * std::cos(a), 0.5f + 0.17f * std::sin(a)}, {0.06f, 0.10f}, {0.75f, 0.55f, 0.60f});
  }
  c.Disc({0.77f, 0.5f}, 0.11f, kYellow);
  c.Letters("FRESH", {0.32f, 0.36f}, 0.20f, kWhite, 0.9f);
  c.Letters("MARKET", {0.32f, 0.64f}, 0.17f, {0.75f, 0.70f, 0.2f}, 0.9f);
}

void CoffeeBoard(Canvas& c) {
  Gradient(c, {0.70f, 0.68f, 0.62f}, {0.60f, 0.56f, 0.48f});
  Shape(c, kBoard, {{0.58f, 0.34f}, {0.88f, 0.34f}, {0.83f, 0.80f}, {0.63f, 0.80f}}, {0.10f, 0.045f, 0.02f});
  Ellipse(c, kBoard, {0.73f, 0.34f}, {0.15f, 0.05f}, {0.045f, 0.02f, 0.01f});
  c.Line({0.88f, 0.42f}, {0.93f, 0.52f}, 0.035f, {0.10f, 0.045f, 0.02f});
  c.Line({0.93f, 0.52f}, {0.86f, 0.62f}, 0.035f, {0.10f, 0.045f, 0.02f});
  for (float x : {0.67f, 0.73f, 0.79f}) c.Line({x, 0.26f}, {x + 0.02f, 0.10f}, 0.018f, kWhite);
  c.Letters("COFFEE", {0.28f, 0.36f}, 0.19f, {0.12f, 0.05f, 0.02f}, 0.85f);
  c.Letters("ALL DAY", {0.28f, 0.64f}, 0.13f, kRed, 0.9f);
}

void JazzBoard(Canvas& c) {
  Gradient(c, {0.30f, 0.02f, 0.30f}, {0.05f, 0.02f, 0.20f});
  for (int i = 0; i < 7; ++i)
    c.Disc({0.15f + 0.12f * static_cast<float>(i), 0.72f + 0.08f * std::sin(1.7f * static_cast<float>(i))}, 0.07f,
           i % 3 == 0   ? kYellow
           : i % 3 == 1 ? Vec3f{0.05f, 0.55f, 0.55f}
                        : Vec3f{0.75f, 0.08f, 0.25f});
  c.Letters("JAZZ CLUB", {0.5f, 0.30f}, 0.24f, {0.10f, 0.70f, 0.62f}, 0.85f);
}

constexpr void (*kBoardPainters[])(Canvas&) = {BlackAndWhiteBoard, BlueSuitBoard, RedCar,    PortraitBoard, BlueAirBoard, EnergyBoard,
                                               RunningBoard,       SkylineBoard,  TaxiBoard, MarketBoard,   CoffeeBoard,  JazzBoard};
static_assert(std::size(kBoardPainters) == kDrawnBoards);

}  // namespace

void PrintAndAge(Canvas& c, uint32_t seed, int sheets_x, int sheets_y) {
  const auto dice = [&](int k) { return TileNoise(static_cast<float>(seed % 61) + 0.37f * static_cast<float>(k), 0.5f, 64, 64, 301); };
  const float faded = 0.16f + 0.22f * dice(1), lift = 0.012f + 0.02f * dice(2);
  const Canvas::Columns streaks(c, [&](float u) { return TileFractal(u, 0.3f, 37, 2, 2, 331 + seed); });
  c.Paint([&](float u, float v, Vec3f old) {
    const float su = u * static_cast<float>(sheets_x), sv = v * static_cast<float>(sheets_y), fu = su - std::floor(su),
                fv = sv - std::floor(sv);
    const float sheet = TileNoise(std::floor(su) * 3.7f + 0.4f, std::floor(sv) * 5.3f + 0.6f, 64, 64, 311 + seed);
    const bool seam = (fu < 0.012f && su >= 1) || (fv < 0.016f && sv >= 1);
    const float cloud = TileFractal(u, v, 4, 3, 4, 321 + seed), streak = streaks(u);
    const float grey = Luminance(old);
    Vec3f color = old * (1 - faded) + Vec3f{grey, grey, 1.04f * grey} * faded;
    color = color * (0.80f * (0.95f + 0.10f * sheet) * (0.92f + 0.16f * cloud)) + Vec3f{lift, lift, lift};
    color = color * (1 - 0.20f * std::max(0.0f, 2 * streak - 1) - 0.14f * v * v);
    return color * (seam ? 0.80f : 1.0f);
  });
}

Texture BoardPicture(uint32_t variant) {
  if (variant >= kDrawnBoards) return Vista(variant - kDrawnBoards);
  const std::string name = "board " + std::to_string(variant);
  const auto paint = [&] {
    Canvas c(static_cast<int>(kBoard.x), static_cast<int>(kBoard.y), kBlack);
    kBoardPainters[variant](c);
    PrintAndAge(c, variant, 5, 2);
    return std::vector{c.Finish(name)};
  };
  // A head takes a second to paint.
  const bool has_head = kBoardPainters[variant] == BlackAndWhiteBoard || kBoardPainters[variant] == BlueSuitBoard;
  return std::move((has_head ? KeptTextures(DiskCache::OfUser(), name, paint) : paint())[0]);
}

Texture MuralPicture(uint32_t variant) {
  Canvas c(1008, 720, {0.30f, 0.26f, 0.21f});
  const Vec3f cream{0.52f, 0.47f, 0.36f}, ink{0.05f, 0.045f, 0.05f};
  switch (variant) {
    case 0:
      c.Rectangle({0, 0}, {1, 1}, ink * 1.6f);
      c.Letters("HARPER & SONS", {0.5f, 0.17f}, 0.13f, cream, 0.85f);
      c.Letters("PIANOS", {0.5f, 0.47f}, 0.27f, cream, 1.15f);
      c.Letters("EST. 1887", {0.5f, 0.80f}, 0.11f, cream * 0.9f, 1.0f);
      break;
    case 1:
      Gradient(c, {0.36f, 0.10f, 0.04f}, {0.55f, 0.36f, 0.08f});
      c.Disc({0.5f, 0.62f}, 0.27f, {0.62f, 0.50f, 0.16f});
      for (int i = 0; i < 5; ++i) {
        const float y = 0.60f + 0.09f * static_cast<float>(i);
        c.Rectangle({0, y}, {1, y + 0.012f + 0.011f * static_cast<float>(i)}, {0.05f, 0.10f, 0.20f});
      }
      Skyline(c, {0.03f, 0.05f, 0.10f}, 1.0f, 21);
      break;
    case 2:
      c.Rectangle({0, 0}, {1, 1}, {0.05f, 0.20f, 0.22f});
      for (int i = 0; i < 9; ++i) {
        const float x = 0.1f + 0.1f * static_cast<float>(i), y = 0.5f + 0.28f * std::sin(2.1f * static_cast<float>(i));
        const Vec3f color = i % 3 == 0 ? Vec3f{0.52f, 0.16f, 0.06f} : i % 3 == 1 ? cream : Vec3f{0.10f, 0.32f, 0.20f};
        c.Disc({x, y}, 0.10f + 0.05f * static_cast<float>(i % 3), color);
      }
      c.Line({0.0f, 0.9f}, {1.0f, 0.15f}, 0.05f, cream);
      break;
    default:
      c.Rectangle({0, 0}, {1, 1}, cream * 0.8f);
      c.Rectangle({0.03f, 0.04f}, {0.97f, 0.96f}, {0.30f, 0.05f, 0.04f});
      c.Letters("FRESH BREAD", {0.5f, 0.30f}, 0.18f, cream, 0.85f);
      c.Letters("DAILY", {0.5f, 0.62f}, 0.24f, cream, 1.2f);
      c.Letters("SINCE 1921", {0.5f, 0.87f}, 0.08f, cream, 0.9f);
  }
  // The brick shows through where the coat has weathered off.
  c.Paint([&](float u, float v, Vec3f old) {
    const float worn = TileFractal(u, v, 5, 4, 5, 91 + variant);
    const Vec3f brick = Vec3f{0.21f, 0.135f, 0.095f} * (0.8f + 0.4f * TileNoise(u * 60, v * 124, 60, 124, 7));
    const float keep = std::clamp((0.66f - worn) * 7, 0.25f, 0.92f);
    return brick * (1 - keep) + old * keep;
  });
  return c.Finish("mural " + std::to_string(variant));
}

Texture BannerPicture(uint32_t variant) {
  Canvas c(224, 616, kBlack);
  switch (variant) {
    case 0:
      c.Rectangle({0, 0.42f}, {1, 0.70f}, kYellow);
      c.Rectangle({0, 0.70f}, {1, 1}, {0.02f, 0.28f, 0.28f});
      c.Letters("NYC", {0.5f, 0.12f}, 0.14f, kYellow, 0.95f);
      c.Letters("LIVE", {0.5f, 0.30f}, 0.11f, kWhite, 0.95f);
      c.Letters("TAXI", {0.5f, 0.50f}, 0.10f, kBlack, 1.0f);
      c.Letters("24H", {0.5f, 0.63f}, 0.09f, kBlack, 1.1f);
      c.Letters("JAZZ", {0.5f, 0.79f}, 0.10f, kWhite, 1.0f);
      c.Letters("CLUB", {0.5f, 0.92f}, 0.10f, kYellow, 1.0f);
      break;
    case 1:
      c.Rectangle({0, 0}, {1, 1}, {0.02f, 0.20f, 0.09f});
      c.Letters("GOLDEN", {0.5f, 0.07f}, 0.055f, kYellow, 1.0f);
      c.Rectangle({0.40f, 0.18f}, {0.60f, 0.34f}, {0.40f, 0.20f, 0.04f});
      c.Rectangle({0.26f, 0.34f}, {0.74f, 0.90f}, {0.45f, 0.23f, 0.04f});
      c.Rectangle({0.26f, 0.50f}, {0.74f, 0.72f}, kWhite);
      c.Letters("ALE", {0.5f, 0.61f}, 0.06f, {0.02f, 0.20f, 0.09f}, 1.0f);
      break;
    case 2:
      c.Rectangle({0, 0}, {1, 1}, kRed);
      for (int i = 0; i < 5; ++i) {
        constexpr const char* kLetters[] = {"H", "O", "T", "E", "L"};
        c.Letters(kLetters[i], {0.5f, 0.12f + 0.19f * static_cast<float>(i)}, 0.14f, kWhite, 1.3f);
      }
      break;
    default:
      c.Rectangle({0, 0}, {1, 1}, {0.70f, 0.70f, 0.68f});
      c.Disc({0.5f, 0.30f}, 0.12f, {0.75f, 0.25f, 0.02f});
      c.Disc({0.5f, 0.48f}, 0.12f, {0.03f, 0.15f, 0.45f});
      c.Letters("MODERN", {0.5f, 0.74f}, 0.05f, kBlack, 1.05f);
      c.Letters("ART", {0.5f, 0.86f}, 0.10f, kBlack, 1.2f);
  }
  PrintAndAge(c, variant + 20, 1, 4);
  return c.Finish("banner " + std::to_string(variant));
}

}  // namespace airsim360::internal

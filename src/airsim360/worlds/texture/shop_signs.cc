#include "airsim360/worlds/texture/shop_signs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/worlds/texture/recipe_shapes.h"
#include "airsim360/worlds/texture/sign_lettering.h"
#include "airsim360/worlds/texture/srgb_codes.h"
#include "airsim360/worlds/texture/surfaces.h"

namespace airsim360::internal {
namespace {

constexpr int kTrades = 52, kForms = kSignCount / kTrades;
static_assert(kTrades * kForms == kSignCount && kSignCount % kSignColumns == 0);

constexpr std::array<const char*, kTrades> kTrade = {
    "BAKERY",       "FLOWERS",   "OPTICIAN",   "PHARMACY",    "PIZZERIA",   "HARDWARE", "TEA ROOM",    "BARBER",     "BICYCLES",
    "GALLERY",      "BOOKS",     "TAILOR",     "DELI",        "LAUNDRY",    "SHOES",    "NAILS & SPA", "PRINT SHOP", "LIQUORS",
    "DINER",        "JEWELRY",   "STATIONERY", "PET SUPPLY",  "NOODLE BAR", "TOYS",     "GREENGROCER", "LOCKSMITH",  "FURNITURE",
    "PHOTO",        "MUSIC",     "ANTIQUES",   "FISH MARKET", "BUTCHER",    "CAFE",     "GRILL",       "ICE CREAM",  "LUGGAGE",
    "DRY CLEANING", "DENTIST",   "TRAVEL",     "FABRICS",     "LIGHTING",   "PAINTS",   "KITCHENS",    "REPAIRS",    "WINE & CHEESE",
    "YOGA STUDIO",  "TACO SHOP", "RAMEN",      "JUICE",       "MATTRESSES", "SPORTS",   "GIFTS"};
constexpr std::array<const char*, kTrades> kTrade1950s = {
    "BAKERY",        "FLORIST",   "OPTICIAN",   "DRUGS",        "PIZZERIA",     "HARDWARE",     "TEA ROOM",     "BARBER",
    "BICYCLES",      "GALLERY",   "BOOKS",      "TAILOR",       "DELICATESSEN", "HAND LAUNDRY", "SHOES",        "HATS",
    "PRINTER",       "LIQUORS",   "DINER",      "JEWELRY",      "STATIONERY",   "PET SHOP",     "CHOP HOUSE",   "TOYS",
    "GREENGROCER",   "LOCKSMITH", "FURNITURE",  "CAMERAS",      "RECORDS",      "ANTIQUES",     "FISH MARKET",  "BUTCHER",
    "COFFEE SHOP",   "GRILL",     "ICE CREAM",  "LUGGAGE",      "DYER",         "DENTIST",      "STEAMSHIPS",   "DRY GOODS",
    "FURS",          "PAINTS",    "HOUSEWARES", "RADIO REPAIR", "WINES",        "DANCE SCHOOL", "LUNCHEONETTE", "CAFETERIA",
    "SODA FOUNTAIN", "BEDDING",   "CIGARS",     "NOTIONS"};
constexpr std::array<const char*, 26> kFamily = {"MARLOW",   "ROSSI",    "OKAFOR", "LINDQVIST", "TANAKA",   "HALLORAN", "MENDEZ",
                                                 "KOWALSKI", "BAPTISTE", "SINGH",  "WEBER",     "ADAMS",    "NAKOS",    "IVERSEN",
                                                 "PEREIRA",  "FINCH",    "DUBOIS", "ZHOU",      "HARGROVE", "SALEH",    "NOVAK",
                                                 "BRENNAN",  "COSTA",    "ALDEN",  "PARK",      "QUILL"};
constexpr std::array<const char*, 13> kPlace = {"CORNER",   "UPTOWN",  "MILL LANE", "UNION", "GRAND",  "HARBOR", "NORTH END",
                                                "OLD TOWN", "SUNRISE", "THIRD AVE", "CITY",  "GARDEN", "STATION"};

// Painted boards, enamel and plastic as they look after some years: grounds mostly dark, white or dull.
struct Paints {
  Vec3f ground, letters;
};
constexpr std::array<Paints, 24> kPaints = {{
    {{0.035f, 0.050f, 0.043f}, {0.55f, 0.48f, 0.30f}}, {{0.030f, 0.036f, 0.060f}, {0.58f, 0.57f, 0.52f}},
    {{0.23f, 0.075f, 0.055f}, {0.60f, 0.56f, 0.46f}},  {{0.54f, 0.53f, 0.49f}, {0.085f, 0.13f, 0.085f}},
    {{0.028f, 0.028f, 0.029f}, {0.62f, 0.61f, 0.58f}}, {{0.58f, 0.58f, 0.57f}, {0.055f, 0.075f, 0.16f}},
    {{0.050f, 0.115f, 0.080f}, {0.60f, 0.60f, 0.56f}}, {{0.050f, 0.038f, 0.030f}, {0.46f, 0.37f, 0.22f}},
    {{0.27f, 0.065f, 0.050f}, {0.62f, 0.60f, 0.55f}},  {{0.070f, 0.060f, 0.085f}, {0.60f, 0.46f, 0.20f}},
    {{0.40f, 0.30f, 0.12f}, {0.045f, 0.042f, 0.040f}}, {{0.100f, 0.120f, 0.105f}, {0.52f, 0.54f, 0.47f}},
    {{0.085f, 0.090f, 0.098f}, {0.60f, 0.59f, 0.56f}}, {{0.52f, 0.50f, 0.47f}, {0.28f, 0.060f, 0.055f}},
    {{0.055f, 0.120f, 0.175f}, {0.60f, 0.60f, 0.58f}}, {{0.60f, 0.59f, 0.56f}, {0.040f, 0.040f, 0.041f}},
    {{0.17f, 0.13f, 0.095f}, {0.58f, 0.54f, 0.43f}},   {{0.60f, 0.60f, 0.59f}, {0.33f, 0.050f, 0.045f}},
    {{0.16f, 0.17f, 0.175f}, {0.63f, 0.62f, 0.59f}},   {{0.46f, 0.44f, 0.37f}, {0.10f, 0.070f, 0.050f}},
    {{0.030f, 0.070f, 0.075f}, {0.56f, 0.55f, 0.48f}}, {{0.60f, 0.58f, 0.50f}, {0.060f, 0.115f, 0.10f}},
    {{0.12f, 0.035f, 0.045f}, {0.55f, 0.50f, 0.42f}},  {{0.33f, 0.32f, 0.30f}, {0.040f, 0.042f, 0.046f}},
}};

std::string SmallLine(uint32_t i, ShopSigns signs) {
  const bool old = signs == ShopSigns::k1950s;
  const auto n = [&](uint32_t low, uint32_t span, uint32_t k) {
    return std::to_string(low + static_cast<uint32_t>(HashUnit(i, k, 71) * static_cast<float>(span)));
  };
  switch (i % 5) {
    case 0:
      return "SINCE " + (old ? n(1868, 82, 1) : n(1908, 95, 1));
    case 1:
      return (old ? "TEL. MARLOW 5-" : "TEL. 555-") + n(1000, 8999, 2);
    case 2:
      return old ? "OPEN EVENINGS" : "OPEN 7 DAYS";
    case 3:
      return n(10, 380, 3);
    default:
      return "SALES - REPAIRS - HIRE";
  }
}

// TilingFbm(seed, u, v, 7, 3) from tables of its lattices, for the many texels of a sign; u and v in [0, 1).
class SignClouds {
 public:
  explicit SignClouds(uint32_t seed) {
    for (int octave = 0; octave < kOctaves; ++octave) {
      const int cells = kCells << octave;
      for (int y = 0; y <= cells; ++y)
        for (int x = 0; x <= cells; ++x)
          corners_[octave].push_back(
              (TilingNoise(seed + static_cast<uint32_t>(octave), static_cast<float>(x), static_cast<float>(y), cells) + 1) / 2);
    }
  }
  float operator()(float u, float v) const {
    float sum = 0, amplitude = 0.6f;
    for (int octave = 0; octave < kOctaves; ++octave) {
      const int cells = kCells << octave;
      const float x = u * static_cast<float>(cells), y = v * static_cast<float>(cells);
      const int i = static_cast<int>(x), j = static_cast<int>(y);
      const float* corner = &corners_[octave][static_cast<size_t>(j * (cells + 1) + i)];
      const float right = Smooth(x - static_cast<float>(i)), down = Smooth(y - static_cast<float>(j));
      const float low = corner[0] + (corner[1] - corner[0]) * right;
      const float high = corner[cells + 1] + (corner[cells + 2] - corner[cells + 1]) * right;
      sum += amplitude * (2 * (low + (high - low) * down) - 1);
      amplitude *= 0.55f;
    }
    return sum;
  }

 private:
  static constexpr int kCells = 7, kOctaves = 3;
  static float Smooth(float t) { return t * t * (3 - 2 * t); }
  std::vector<float> corners_[kOctaves];
};

// How one sign is laid out; lengths in metres from its upper left corner, 5 x 0.8 in all.
struct Board {
  Paints paints;
  SignLettering name, small;
  float high, left, wide;  ///< of the name: height and left edge of the capitals, width
  float top;
  bool has_small, framed, plate;
  uint32_t id;
  float fade;                  ///< what the sun took
  std::vector<float> streaks;  ///< of rain from the upper edge: strength in each column
  SignClouds clouds;
};

// Texels of a sign from left to right, and where they are, in metres.
constexpr int kSignTexels = 512;
float AlongSign(int texel) { return 5 * (static_cast<float>(texel) + 0.5f) / kSignTexels; }

Board MakeBoard(int i, ShopSigns signs) {
  const auto id = static_cast<uint32_t>(i);
  const std::string name = ShopName(i, signs);
  Board b{kPaints[static_cast<size_t>(HashUnit(id, 11) * 24)],
          SignLettering(name, 0.11f + 0.09f * HashUnit(id, 12)),
          SignLettering(SmallLine(id, signs), 0.14f),
          0,
          0,
          0,
          0,
          HashUnit(id, 13) < 0.45f,
          HashUnit(id, 14) < 0.35f,
          HashUnit(id, 15) < 0.30f,
          id,
          0.06f + 0.22f * HashUnit(id, 19),
          {},
          SignClouds(id + 300)};
  const float spread = 0.85f + 0.45f * HashUnit(id, 16);  // narrow to wide letters
  b.high = b.has_small ? 0.30f : 0.30f + 0.12f * HashUnit(id, 17);
  b.wide = b.name.width() * b.high * spread;
  if (b.wide > 4.2f) {
    b.high *= std::max(0.75f, 4.2f / b.wide);
    b.wide = 4.2f;
  }
  b.left = HashUnit(id, 18) < 0.75f ? (5 - b.wide) / 2 : 0.4f;
  b.top = b.has_small ? 0.13f : (0.8f - b.high) / 2;
  for (int x = 0; x < kSignTexels; ++x) b.streaks.push_back(std::max(0.0f, TilingFbm(id + 700, AlongSign(x) / 5, 0.5f, 61, 2)));
  return b;
}

// Share of ink at (x, y): four samples of a texel of 9.8 x 10.2 mm.
float Ink(const SignLettering& line, float x, float y, float left, float top, float wide, float high) {
  if (x < left - 0.02f || x > left + wide + 0.02f || y < top - 0.02f || y > top + high + 0.02f) return 0;
  float ink = 0;
  for (int k = 0; k < 4; ++k) {
    const float dx = k % 2 ? 0.0024f : -0.0024f, dy = k / 2 ? 0.0025f : -0.0025f;
    ink += line.Inked((x + dx - left) * line.width() / wide, (y + dy - top) / high) ? 0.25f : 0.0f;
  }
  return ink;
}

Vec3f BoardColor(const Board& b, int texel, float y) {
  const float x = AlongSign(texel);
  const float edge = std::min({x, 5 - x, y, 0.8f - y});
  Vec3f color = b.paints.ground;
  if (b.plate && edge > 0.1f && edge < 0.125f) color = b.paints.letters;
  if (b.framed && edge < 0.045f) color = b.paints.letters * 0.55f;
  const float small_wide = std::min(3.0f, b.small.width() * 0.11f);
  float ink = Ink(b.name, x, y, b.left, b.top, b.wide, b.high);
  if (b.has_small) ink = std::max(ink, 0.85f * Ink(b.small, x, y, (5 - small_wide) / 2, 0.545f, small_wide, 0.11f));
  color = Mix(color, b.paints.letters, ink);
  // Sun fades, rain draws streaks from the upper edge, dust lies along the lower.
  const float cloud = b.clouds(x / 5, y / 5), streak = b.streaks[static_cast<size_t>(texel)] * (1 - 0.5f * y / 0.8f);
  const float grey = 0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z;
  color = Mix(color, Vec3f{1, 1, 1} * (0.85f * grey + 0.05f), b.fade) * (1 + 0.07f * cloud - 0.22f * streak);
  return Mix(color, Vec3f{0.20f, 0.18f, 0.15f}, 0.22f * Step(0.62f, 0.8f, y));
}

}  // namespace

std::string ShopName(int i, ShopSigns signs) {
  const auto k = static_cast<size_t>(i % kTrades);
  const std::string trade = signs == ShopSigns::k1950s ? kTrade1950s[k] : kTrade[k];
  switch (i / kTrades) {
    case 0:
      return trade;
    case 1:
      return kFamily[(k * 7 + 3) % kFamily.size()] + (" " + trade);
    case 2:
      return kPlace[(k * 5 + 2) % kPlace.size()] + (" " + trade);
    default:
      return kFamily[k % kFamily.size()] + std::string(k < kFamily.size() ? " & SONS" : " BROTHERS");
  }
}

Texture MakeShopSigns(ShopSigns signs) {
  constexpr int kRows = kSignCount / kSignColumns, kHigh = 4096;
  const SrgbCodes code;
  Image<Rgba8> sheet(kSignTexels * kSignColumns, kHigh);
  ParallelFor(kSignCount, [&](int64_t i) {
    const Board board = MakeBoard(static_cast<int>(i), signs);
    const int column = static_cast<int>(i) % kSignColumns, row = static_cast<int>(i) / kSignColumns;
    for (int y = (row * kHigh + kRows - 1) / kRows; y * kRows < (row + 1) * kHigh; ++y) {
      const float down = (static_cast<float>(y) + 0.5f) * kRows / kHigh - static_cast<float>(row);
      for (int x = 0; x < kSignTexels; ++x) {
        const Vec3f c = BoardColor(board, x, 0.8f * down);
        sheet(column * kSignTexels + x, y) = {code(c.x), code(c.y), code(c.z), 255};
      }
    }
  });
  return Texture::FromImage("shop signs", std::move(sheet), true);
}

}  // namespace airsim360::internal

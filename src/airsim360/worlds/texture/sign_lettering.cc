#include "airsim360/worlds/texture/sign_lettering.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace airsim360::internal {
namespace {

// The middle of a stroke in the letter's box, x and y from 0 to 1, y downwards: a line from (a, b) to (c, d), or a piece of the
// ellipse around (a, b) with radii (c, d) from angle `from` to `to` (degrees, 0 right, 90 down).
struct Stroke {
  float a, b, c, d;
  float from = 0, to = 0;
  bool arc() const { return from != to; }
};

struct Glyph {
  char letter;
  float width;  // of its box
  std::span<const Stroke> strokes;
};

constexpr Stroke kA[] = {{0, 1, .5f, 0}, {.5f, 0, 1, 1}, {.2f, .66f, .8f, .66f}};
constexpr Stroke kB[] = {
    {0, 0, 0, 1}, {0, 0, .6f, 0}, {0, .48f, .6f, .48f}, {0, 1, .6f, 1}, {.6f, .24f, .36f, .24f, -90, 90}, {.6f, .74f, .4f, .26f, -90, 90}};
constexpr Stroke kC[] = {{.5f, .3f, .5f, .3f, 180, 345}, {0, .3f, 0, .7f}, {.5f, .7f, .5f, .3f, 15, 180}};
constexpr Stroke kD[] = {
    {0, 0, 0, 1}, {0, 0, .45f, 0}, {0, 1, .45f, 1}, {.45f, .3f, .55f, .3f, -90, 0}, {1, .3f, 1, .7f}, {.45f, .7f, .55f, .3f, 0, 90}};
constexpr Stroke kE[] = {{0, 0, 0, 1}, {0, 0, 1, 0}, {0, .49f, .85f, .49f}, {0, 1, 1, 1}};
constexpr Stroke kF[] = {{0, 0, 0, 1}, {0, 0, 1, 0}, {0, .5f, .85f, .5f}};
constexpr Stroke kG[] = {
    {.5f, .3f, .5f, .3f, 180, 345}, {0, .3f, 0, .7f}, {.5f, .7f, .5f, .3f, 0, 180}, {1, .7f, 1, .54f}, {.6f, .54f, 1, .54f}};
constexpr Stroke kH[] = {{0, 0, 0, 1}, {1, 0, 1, 1}, {0, .5f, 1, .5f}};
constexpr Stroke kI[] = {{.5f, 0, .5f, 1}};
constexpr Stroke kJ[] = {{1, 0, 1, .7f}, {.5f, .7f, .5f, .3f, 0, 170}};
constexpr Stroke kK[] = {{0, 0, 0, 1}, {1, 0, 0, .62f}, {.32f, .42f, 1, 1}};
constexpr Stroke kL[] = {{0, 0, 0, 1}, {0, 1, 1, 1}};
constexpr Stroke kM[] = {{0, 0, 0, 1}, {1, 0, 1, 1}, {0, 0, .5f, .75f}, {.5f, .75f, 1, 0}};
constexpr Stroke kN[] = {{0, 0, 0, 1}, {1, 0, 1, 1}, {0, 0, 1, 1}};
constexpr Stroke kO[] = {{.5f, .3f, .5f, .3f, 180, 360}, {0, .3f, 0, .7f}, {1, .3f, 1, .7f}, {.5f, .7f, .5f, .3f, 0, 180}};
constexpr Stroke kP[] = {{0, 0, 0, 1}, {0, 0, .55f, 0}, {0, .55f, .55f, .55f}, {.55f, .275f, .45f, .275f, -90, 90}};
constexpr Stroke kQ[] = {
    {.5f, .3f, .5f, .3f, 180, 360}, {0, .3f, 0, .7f}, {1, .3f, 1, .7f}, {.5f, .7f, .5f, .3f, 0, 180}, {.6f, .68f, 1, 1}};
constexpr Stroke kR[] = {{0, 0, 0, 1}, {0, 0, .55f, 0}, {0, .52f, .55f, .52f}, {.55f, .26f, .45f, .26f, -90, 90}, {.45f, .52f, 1, 1}};
constexpr Stroke kS[] = {{.5f, .25f, .5f, .25f, 90, 340}, {.5f, .75f, .5f, .25f, -90, 160}};
constexpr Stroke kT[] = {{0, 0, 1, 0}, {.5f, 0, .5f, 1}};
constexpr Stroke kU[] = {{0, 0, 0, .7f}, {1, 0, 1, .7f}, {.5f, .7f, .5f, .3f, 0, 180}};
constexpr Stroke kV[] = {{0, 0, .5f, 1}, {1, 0, .5f, 1}};
constexpr Stroke kW[] = {{0, 0, .25f, 1}, {.25f, 1, .5f, .15f}, {.5f, .15f, .75f, 1}, {.75f, 1, 1, 0}};
constexpr Stroke kX[] = {{0, 0, 1, 1}, {1, 0, 0, 1}};
constexpr Stroke kY[] = {{0, 0, .5f, .52f}, {1, 0, .5f, .52f}, {.5f, .52f, .5f, 1}};
constexpr Stroke kZ[] = {{0, 0, 1, 0}, {1, 0, 0, 1}, {0, 1, 1, 1}};
constexpr Stroke k1[] = {{.7f, 0, .7f, 1}, {0, .22f, .7f, 0}};
constexpr Stroke k2[] = {{.5f, .28f, .5f, .28f, 190, 390}, {.93f, .42f, 0, 1}, {0, 1, 1, 1}};
constexpr Stroke k3[] = {{.5f, .25f, .48f, .25f, 200, 450}, {.5f, .75f, .5f, .25f, -90, 160}};
constexpr Stroke k4[] = {{.75f, 0, .75f, 1}, {.75f, 0, 0, .7f}, {0, .7f, 1, .7f}};
constexpr Stroke k5[] = {{.1f, 0, .95f, 0}, {.1f, 0, .05f, .46f}, {.47f, .69f, .53f, .31f, 220, 520}};
constexpr Stroke k6[] = {{.5f, .68f, .5f, .32f, 0, 360}, {.03f, .62f, .62f, 0}};
constexpr Stroke k7[] = {{0, 0, 1, 0}, {1, 0, .35f, 1}};
constexpr Stroke k8[] = {{.5f, .25f, .44f, .25f, 0, 360}, {.5f, .75f, .5f, .25f, 0, 360}};
constexpr Stroke k9[] = {{.5f, .32f, .5f, .32f, 0, 360}, {.97f, .38f, .38f, 1}};
constexpr Stroke kAnd[] = {{.40f, .23f, .27f, .23f, 0, 360}, {.38f, .73f, .38f, .27f, 20, 300}, {.22f, .40f, 1, 1}, {.72f, .83f, 1, .55f}};
constexpr Stroke kDot[] = {{.5f, 1, .5f, 1}};
constexpr Stroke kComma[] = {{.5f, .98f, .5f, 1.06f}};
constexpr Stroke kDash[] = {{0, .54f, 1, .54f}};
constexpr Stroke kPlus[] = {{0, .5f, 1, .5f}, {.5f, .2f, .5f, .8f}};
constexpr Stroke kBang[] = {{.5f, 0, .5f, .64f}, {.5f, 1, .5f, 1}};
constexpr Stroke kTick[] = {{.5f, 0, .5f, .16f}};
constexpr Stroke kSlash[] = {{1, 0, 0, 1}};
constexpr Stroke kPercent[] = {{.18f, .2f, .18f, .2f, 0, 360}, {.82f, .8f, .18f, .2f, 0, 360}, {.85f, 0, .15f, 1}};
constexpr Glyph kGlyphs[] = {
    {'A', .56f, kA},  {'B', .46f, kB},     {'C', .48f, kC},      {'D', .48f, kD},  {'E', .40f, kE},    {'F', .38f, kF},    {'G', .49f, kG},
    {'H', .47f, kH},  {'I', 0, kI},        {'J', .36f, kJ},      {'K', .50f, kK},  {'L', .37f, kL},    {'M', .64f, kM},    {'N', .48f, kN},
    {'O', .50f, kO},  {'P', .45f, kP},     {'Q', .50f, kQ},      {'R', .48f, kR},  {'S', .45f, kS},    {'T', .46f, kT},    {'U', .47f, kU},
    {'V', .54f, kV},  {'W', .82f, kW},     {'X', .52f, kX},      {'Y', .52f, kY},  {'Z', .44f, kZ},    {'0', .44f, kO},    {'1', .24f, k1},
    {'2', .42f, k2},  {'3', .43f, k3},     {'4', .46f, k4},      {'5', .43f, k5},  {'6', .44f, k6},    {'7', .42f, k7},    {'8', .45f, k8},
    {'9', .44f, k9},  {'&', .56f, kAnd},   {'.', 0, kDot},       {',', 0, kComma}, {'-', .26f, kDash}, {'+', .40f, kPlus}, {'!', 0, kBang},
    {'\'', 0, kTick}, {'/', .34f, kSlash}, {'%', .66f, kPercent}};

const Glyph* Find(char letter) {
  const auto it = std::find_if(std::begin(kGlyphs), std::end(kGlyphs), [&](const Glyph& g) { return g.letter == letter; });
  return it == std::end(kGlyphs) ? nullptr : &*it;
}

constexpr float kGap = 0.11f, kSpace = 0.34f;

// Whether (x, y) lies within `h` of the stroke, in the letter's box of width w whose strokes keep h from its edges.
bool OnStroke(const Stroke& s, float w, float h, float x, float y) {
  const float high = 1 - 2 * h;
  if (!s.arc()) {
    const float ax = h + s.a * w, ay = h + s.b * high, dx = h + s.c * w - ax, dy = h + s.d * high - ay, l = std::hypot(dx, dy);
    if (l < 1e-6f) return std::abs(x - ax) < h && std::abs(y - ay) < h;
    const float along = ((x - ax) * dx + (y - ay) * dy) / l, across = ((x - ax) * dy - (y - ay) * dx) / l;
    // Slanted strokes end where they meet others inside the box, and are cut flat at its edges.
    const bool straight = s.a == s.c || s.b == s.d;
    const float before = straight || s.b <= 0 || s.b >= 1 ? h : 0, beyond = straight || s.d <= 0 || s.d >= 1 ? h : 0;
    return std::abs(across) < h && along > -before && along < l + beyond;
  }
  const float px = x - h - s.a * w, py = y - h - s.b * high, rx = std::max(1e-3f, s.c * w), ry = std::max(1e-3f, s.d * high);
  const float r = std::hypot(px / rx, py / ry);
  if (r < 1e-4f || std::abs(r - 1) * std::hypot(px, py) / r >= h) return false;
  float angle = std::atan2(py / ry, px / rx) * 57.29578f;
  while (angle < s.from) angle += 360;
  return angle <= s.to;
}

}  // namespace

SignLettering::SignLettering(std::string_view text, float weight) : half_(weight / 2) {
  for (char c : text) {
    const Glyph* glyph = Find(c);
    const float wide = glyph ? glyph->width + 2 * half_ : kSpace;
    letters_.push_back({c, width_, width_ + wide});
    width_ += wide + kGap;
  }
  width_ = std::max(0.0f, width_ - kGap);
}

bool SignLettering::Inked(float x, float y) const {
  if (y < 0 || y > 1) return false;
  const auto it = std::upper_bound(letters_.begin(), letters_.end(), x, [](float v, const Placed& p) { return v < p.right; });
  if (it == letters_.end() || x < it->left) return false;
  const Glyph* glyph = Find(it->letter);
  if (!glyph) return false;
  return std::any_of(glyph->strokes.begin(), glyph->strokes.end(),
                     [&](const Stroke& s) { return OnStroke(s, glyph->width, half_, x - it->left, y); });
}

}  // namespace airsim360::internal

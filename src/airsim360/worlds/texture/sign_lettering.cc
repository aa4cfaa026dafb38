#include "airsim360/worlds/texture/sign_lettering.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace airsim360::internal {
namespace {

// The middle of a stroke in the letter's box, x and y from 0 to 1, y downwards: a line from (a, b) to (c, d), or a piece of the
// ellipse around (a, b) with radii (c, d) from angle `from` to `to` (degrees, 0 right, 90 down).
struct DrawnStroke {
  float a, b, c, d;
  float from = 0, to = 0;
  bool arc() const { return from != to; }
};

struct Glyph {
  char letter;
  float width;  // of its box
  std::span<const DrawnStroke> strokes;
};

constexpr DrawnStroke kA[] = {{0, 1, .5f, 0}, {.5f, 0, 1, 1}, {.2f, .66f, .8f, .66f}};
constexpr DrawnStroke kB[] = {
    {0, 0, 0, 1}, {0, 0, .6f, 0}, {0, .48f, .6f, .48f}, {0, 1, .6f, 1}, {.6f, .24f, .36f, .24f, -90, 90}, {.6f, .74f, .4f, .26f, -90, 90}};
constexpr DrawnStroke kC[] = {{.5f, .3f, .5f, .3f, 180, 345}, {0, .3f, 0, .7f}, {.5f, .7f, .5f, .3f, 15, 180}};
constexpr DrawnStroke kD[] = {
    {0, 0, 0, 1}, {0, 0, .45f, 0}, {0, 1, .45f, 1}, {.45f, .3f, .55f, .3f, -90, 0}, {1, .3f, 1, .7f}, {.45f, .7f, .55f, .3f, 0, 90}};
constexpr DrawnStroke kE[] = {{0, 0, 0, 1}, {0, 0, 1, 0}, {0, .49f, .85f, .49f}, {0, 1, 1, 1}};
constexpr DrawnStroke kF[] = {{0, 0, 0, 1}, {0, 0, 1, 0}, {0, .5f, .85f, .5f}};
constexpr DrawnStroke kG[] = {
    {.5f, .3f, .5f, .3f, 180, 345}, {0, .3f, 0, .7f}, {.5f, .7f, .5f, .3f, 0, 180}, {1, .7f, 1, .54f}, {.6f, .54f, 1, .54f}};
constexpr DrawnStroke kH[] = {{0, 0, 0, 1}, {1, 0, 1, 1}, {0, .5f, 1, .5f}};
constexpr DrawnStroke kI[] = {{.5f, 0, .5f, 1}};
constexpr DrawnStroke kJ[] = {{1, 0, 1, .7f}, {.5f, .7f, .5f, .3f, 0, 170}};
constexpr DrawnStroke kK[] = {{0, 0, 0, 1}, {1, 0, 0, .62f}, {.32f, .42f, 1, 1}};
constexpr DrawnStroke kL[] = {{0, 0, 0, 1}, {0, 1, 1, 1}};
constexpr DrawnStroke kM[] = {{0, 0, 0, 1}, {1, 0, 1, 1}, {0, 0, .5f, .75f}, {.5f, .75f, 1, 0}};
constexpr DrawnStroke kN[] = {{0, 0, 0, 1}, {1, 0, 1, 1}, {0, 0, 1, 1}};
constexpr DrawnStroke kO[] = {{.5f, .3f, .5f, .3f, 180, 360}, {0, .3f, 0, .7f}, {1, .3f, 1, .7f}, {.5f, .7f, .5f, .3f, 0, 180}};
constexpr DrawnStroke kP[] = {{0, 0, 0, 1}, {0, 0, .55f, 0}, {0, .55f, .55f, .55f}, {.55f, .275f, .45f, .275f, -90, 90}};
constexpr DrawnStroke kQ[] = {
    {.5f, .3f, .5f, .3f, 180, 360}, {0, .3f, 0, .7f}, {1, .3f, 1, .7f}, {.5f, .7f, .5f, .3f, 0, 180}, {.6f, .68f, 1, 1}};
constexpr DrawnStroke kR[] = {{0, 0, 0, 1}, {0, 0, .55f, 0}, {0, .52f, .55f, .52f}, {.55f, .26f, .45f, .26f, -90, 90}, {.45f, .52f, 1, 1}};
constexpr DrawnStroke kS[] = {{.5f, .25f, .5f, .25f, 90, 340}, {.5f, .75f, .5f, .25f, -90, 160}};
constexpr DrawnStroke kT[] = {{0, 0, 1, 0}, {.5f, 0, .5f, 1}};
constexpr DrawnStroke kU[] = {{0, 0, 0, .7f}, {1, 0, 1, .7f}, {.5f, .7f, .5f, .3f, 0, 180}};
constexpr DrawnStroke kV[] = {{0, 0, .5f, 1}, {1, 0, .5f, 1}};
constexpr DrawnStroke kW[] = {{0, 0, .25f, 1}, {.25f, 1, .5f, .15f}, {.5f, .15f, .75f, 1}, {.75f, 1, 1, 0}};
constexpr DrawnStroke kX[] = {{0, 0, 1, 1}, {1, 0, 0, 1}};
constexpr DrawnStroke kY[] = {{0, 0, .5f, .52f}, {1, 0, .5f, .52f}, {.5f, .52f, .5f, 1}};
constexpr DrawnStroke kZ[] = {{0, 0, 1, 0}, {1, 0, 0, 1}, {0, 1, 1, 1}};
constexpr DrawnStroke k1[] = {{.7f, 0, .7f, 1}, {0, .22f, .7f, 0}};
constexpr DrawnStroke k2[] = {{.5f, .28f, .5f, .28f, 190, 390}, {.93f, .42f, 0, 1}, {0, 1, 1, 1}};
constexpr DrawnStroke k3[] = {{.5f, .25f, .48f, .25f, 200, 450}, {.5f, .75f, .5f, .25f, -90, 160}};
constexpr DrawnStroke k4[] = {{.75f, 0, .75f, 1}, {.75f, 0, 0, .7f}, {0, .7f, 1, .7f}};
constexpr DrawnStroke k5[] = {{.1f, 0, .95f, 0}, {.1f, 0, .05f, .46f}, {.47f, .69f, .53f, .31f, 220, 520}};
constexpr DrawnStroke k6[] = {{.5f, .68f, .5f, .32f, 0, 360}, {.03f, .62f, .62f, 0}};
constexpr DrawnStroke k7[] = {{0, 0, 1, 0}, {1, 0, .35f, 1}};
constexpr DrawnStroke k8[] = {{.5f, .25f, .44f, .25f, 0, 360}, {.5f, .75f, .5f, .25f, 0, 360}};
constexpr DrawnStroke k9[] = {{.5f, .32f, .5f, .32f, 0, 360}, {.97f, .38f, .38f, 1}};
constexpr DrawnStroke kAnd[] = {
    {.40f, .23f, .27f, .23f, 0, 360}, {.38f, .73f, .38f, .27f, 20, 300}, {.22f, .40f, 1, 1}, {.72f, .83f, 1, .55f}};
constexpr DrawnStroke kDot[] = {{.5f, 1, .5f, 1}};
constexpr DrawnStroke kComma[] = {{.5f, .98f, .5f, 1.06f}};
constexpr DrawnStroke kDash[] = {{0, .54f, 1, .54f}};
constexpr DrawnStroke kPlus[] = {{0, .5f, 1, .5f}, {.5f, .2f, .5f, .8f}};
constexpr DrawnStroke kBang[] = {{.5f, 0, .5f, .64f}, {.5f, 1, .5f, 1}};
constexpr DrawnStroke kTick[] = {{.5f, 0, .5f, .16f}};
constexpr DrawnStroke kSlash[] = {{1, 0, 0, 1}};
constexpr DrawnStroke kPercent[] = {{.18f, .2f, .18f, .2f, 0, 360}, {.82f, .8f, .18f, .2f, 0, 360}, {.85f, 0, .15f, 1}};
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

}  // namespace

SignLettering::SignLettering(std::string_view text, float weight) : half_(weight / 2) {
  const float h = half_, high = 1 - 2 * h;
  // In the letter's box of width w, whose strokes keep h from its edges.
  const auto prepared = [&](const DrawnStroke& s, float w) {
    Stroke stroke{.arc = s.arc(), .dot = false, .x = h + s.a * w, .y = h + s.b * high};
    if (s.arc()) {
      stroke.x = s.a * w, stroke.y = s.b * high;
      stroke.rx = std::max(1e-3f, s.c * w), stroke.ry = std::max(1e-3f, s.d * high);
      stroke.from = s.from, stroke.to = s.to;
      return stroke;
    }
    stroke.dx = h + s.c * w - stroke.x, stroke.dy = h + s.d * high - stroke.y;
    stroke.length = std::hypot(stroke.dx, stroke.dy);
    stroke.dot = stroke.length < 1e-6f;
    // Slanted strokes end where they meet others inside the box, and are cut flat at its edges.
    const bool straight = s.a == s.c || s.b == s.d;
    stroke.before = straight || s.b <= 0 || s.b >= 1 ? h : 0;
    stroke.beyond = straight || s.d <= 0 || s.d >= 1 ? h : 0;
    return stroke;
  };
  for (char c : text) {
    const Glyph* glyph = Find(c);
    const float wide = glyph ? glyph->width + 2 * half_ : kSpace;
    Placed placed{width_, width_ + wide, {}};
    if (glyph)
      for (const DrawnStroke& s : glyph->strokes) placed.strokes.push_back(prepared(s, glyph->width));
    letters_.push_back(std::move(placed));
    width_ += wide + kGap;
  }
  width_ = std::max(0.0f, width_ - kGap);
}

// Whether (x, y) in the letter's box lies within half_ of the stroke.
bool SignLettering::OnStroke(const Stroke& s, float x, float y) const {
  const float h = half_;
  if (s.dot) return std::abs(x - s.x) < h && std::abs(y - s.y) < h;
  if (!s.arc) {
    const float along = ((x - s.x) * s.dx + (y - s.y) * s.dy) / s.length, across = ((x - s.x) * s.dy - (y - s.y) * s.dx) / s.length;
    return std::abs(across) < h && along > -s.before && along < s.length + s.beyond;
  }
  const float px = x - h - s.x, py = y - h - s.y;
  const float r = std::hypot(px / s.rx, py / s.ry);
  if (r < 1e-4f || std::abs(r - 1) * std::hypot(px, py) / r >= h) return false;
  float angle = std::atan2(py / s.ry, px / s.rx) * 57.29578f;
  while (angle < s.from) angle += 360;
  return angle <= s.to;
}

bool SignLettering::Inked(float x, float y) const {
  if (y < 0 || y > 1) return false;
  const auto it = std::upper_bound(letters_.begin(), letters_.end(), x, [](float v, const Placed& p) { return v < p.right; });
  if (it == letters_.end() || x < it->left) return false;
  return std::ranges::any_of(it->strokes, [&](const Stroke& s) { return OnStroke(s, x - it->left, y); });
}

}  // namespace airsim360::internal

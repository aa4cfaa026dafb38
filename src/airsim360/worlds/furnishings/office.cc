// Offices. EN 527 desks 160 x 80 and 180 x 80 cm, 72 to 75 cm high; EN 1335 chairs, seats 40 to 51 cm; partitions of
// 1.2 to 1.6 m; filing cabinets after DIN 4544 (A4: 46 to 80 cm wide).
#include <array>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/small_parts.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {
namespace {

constexpr Vec3f kGrey{0.50f, 0.51f, 0.52f}, kWhite{0.74f, 0.74f, 0.73f}, kBlack{0.03f, 0.031f, 0.033f};

// White on a T frame, oak on an A frame, a corner of 1.8 m with a pedestal of drawers, height-adjustable.
Model MakeDeskOffice(uint32_t variant, uint64_t) {
  PropBuilder b("desk_office");
  const float x = variant == 1 || variant == 3 ? 0.90f : 0.80f, y = 0.40f, top = std::array{0.74f, 0.73f, 0.75f, 0.74f}[variant];
  const bool oak = variant == 1, dark = variant == 2;
  oak ? UseTimber(b, Timber::kOak, Grain::kAlongX) : dark ? UseTimber(b, Timber::kWalnut, Grain::kAlongX) : UseLacquer(b, kWhite, 0.4f);
  RoundedBoard(b, {-x, -y}, {x, y}, 0.012f, top - 0.025f, top, 0.003f);
  b.Use(Paint(oak || variant == 3 ? kBlack : kGrey, 0.4f));
  for (float s : {-1.0f, 1.0f}) {
    const float px = s * (x - 0.09f);
    if (variant == 1) {
      for (float e : {-1.0f, 1.0f}) b.mesh().Beam({px, e * (y - 0.04f), 0}, {px * 0.97f, e * 0.10f, top - 0.03f}, 0.04f);
    } else {
      b.BevelBox({px - 0.04f, -0.03f, 0.03f}, {px + 0.04f, 0.05f, top - 0.03f}, 0.006f);
      if (variant == 3) b.BevelBox({px - 0.033f, -0.023f, 0.42f}, {px + 0.033f, 0.043f, 0.44f}, 0.002f);
      b.BevelBox({px - 0.035f, -y + 0.06f, 0.0f}, {px + 0.035f, y - 0.04f, 0.035f}, 0.010f);
    }
    b.BevelBox({px - 0.025f, -y + 0.06f, top - 0.055f}, {px + 0.025f, y - 0.06f, top - 0.025f}, 0.004f);
  }
  b.BevelBox({-x + 0.10f, 0.06f, top - 0.07f}, {x - 0.10f, 0.10f, top - 0.03f}, 0.004f);
  b.Use(Plastic(kBlack, 0.5f));  // cable outlet and tray
  const Vec2f outlet[] = {{0.04f, top - 0.001f}, {0.042f, top + 0.0015f}, {0.03f, top + 0.002f}, {0, top + 0.0005f}};
  b.Lathe(outlet, 20, {x - 0.16f, y - 0.09f, 0});
  b.BevelBox({-x + 0.25f, 0.14f, top - 0.15f}, {x - 0.25f, 0.27f, top - 0.14f}, 0.003f);
  for (int i = 0; i < 3; ++i) {  // cables that hang into the tray
    const float cx = -0.3f + 0.22f * static_cast<float>(i);
    const Vec3f cable[] = {{cx, 0.20f, top - 0.13f},
                           {cx + 0.05f, 0.26f, top - 0.22f - 0.04f * static_cast<float>(i)},
                           {cx + 0.16f, 0.24f, top - 0.2f},
                           {cx + 0.22f, 0.20f, top - 0.13f}};
    b.Bar(cable, 0.004f, 6);
  }
  if (dark) {  // a modesty board
    UseTimber(b, Timber::kWalnut, Grain::kAlongX);
    b.BevelBox({-x + 0.14f, 0.27f, 0.30f}, {x - 0.14f, 0.288f, top - 0.03f}, 0.003f);
  }
  // Pedestal of drawers on castors.
  if (variant % 2 == 0) {
    const float px = x - 0.38f, h = 0.56f;
    UseCoatedSteel(b, dark ? Vec3f{0.10f, 0.10f, 0.105f} : kWhite);
    b.BevelBox({px - 0.20f, -0.26f, 0.04f}, {px + 0.20f, 0.26f, h}, 0.004f);
    for (int i = 0; i < 3; ++i) {
      const float z0 = 0.05f + (i == 0 ? 0 : i == 1 ? 0.265f : 0.39f), z1 = 0.05f + (i == 0 ? 0.255f : i == 1 ? 0.38f : 0.50f);
      Front(b, px - 0.196f, px + 0.196f, z0, z1, -0.26f, 0.016f);
    }
    b.Use(Plastic(kBlack));
    for (float z : {0.29f, 0.415f, 0.535f}) b.BevelBox({px - 0.06f, -0.279f, z - 0.012f}, {px + 0.06f, -0.2755f, z}, 0.001f);
    for (float cx : {px - 0.16f, px + 0.16f})
      for (float cy : {-0.2f, 0.2f}) b.mesh().Tube({cx, cy, 0}, {cx, cy, 0.045f}, 0.02f, 0.015f, 10);
  }
  return b.Finish();
}

void StarBase(PropBuilder& b, bool chrome, float seat) {
  for (int i = 0; i < 5; ++i) {
    const Vec3f d = Around(i, 5, 0.3f), tip = d * 0.30f;
    chrome ? b.Use(Chrome()) : b.Use(Plastic(kBlack, 0.45f));
    const Vec3f arm[] = {Vec3f{0, 0, 0.105f}, d * 0.12f + Vec3f{0, 0, 0.10f}, tip + Vec3f{0, 0, 0.075f}};
    const float radii[] = {0.028f, 0.022f, 0.016f};
    b.Bar(arm, radii, 8);
    Castor(b, tip + Vec3f{0, 0, 0.07f});
  }
  b.Use(Plastic(kBlack, 0.45f));
  b.mesh().Tube({0, 0, 0.08f}, {0, 0, 0.25f}, 0.032f, 0.030f, 14);
  b.Use(Chrome());
  b.mesh().Tube({0, 0, 0.25f}, {0, 0, seat - 0.06f}, 0.014f, 0.014f, 12);
  b.Use(Plastic(kBlack, 0.45f));
  b.BevelBox({-0.09f, -0.10f, seat - 0.09f}, {0.09f, 0.12f, seat - 0.05f}, 0.015f);
}

// Task chair with a net back, executive chair of leather, plain swivel chair without arms.
Model MakeOfficeChair(uint32_t variant, uint64_t seed) {
  PropBuilder b("office_chair");
  const float seat = std::array{0.47f, 0.49f, 0.46f, 0.47f}[variant];
  StarBase(b, variant == 1, seat);
  const Vec3f cloth =
      std::array<Vec3f, 4>{{{0.035f, 0.036f, 0.04f}, {0.03f, 0.03f, 0.032f}, {0.10f, 0.17f, 0.28f}, {0.30f, 0.31f, 0.32f}}}[variant];
  variant == 1 ? UseLeather(b, cloth) : UseWeave(b, cloth);
  SoftBox(b, {-0.25f, -0.25f, seat - 0.06f}, {0.25f, 0.22f, seat + 0.02f},
          {.round = 0.038f, .crown = 0.012f, .fold = variant == 1 ? 0.003f : 0.0f, .seed = seed, .cells = 10});
  const float lean = variant == 1 ? -12.0f : -9.0f, tall = variant == 1 ? 0.70f : variant == 2 ? 0.40f : 0.56f;
  b.Place(Turn(lean, 0, 0, {0, 0.24f, seat + (variant == 2 ? 0.16f : 0.09f)}));
  if (variant == 1) {
    for (int i = 0; i < 3; ++i)
      SoftBox(b, {-0.25f, -0.06f, 0.235f * static_cast<float>(i)}, {0.25f, 0.04f, 0.235f * static_cast<float>(i + 1)},
              {.round = 0.045f, .crown = 0.018f, .fold = 0.002f, .seed = seed + static_cast<uint64_t>(i), .cells = 8});
  } else if (variant == 2) {
    SoftBox(b, {-0.21f, -0.035f, 0}, {0.21f, 0.025f, tall}, {.round = 0.028f, .crown = 0.012f, .cells = 9});
  } else {
    // A frame with a taut net, bent round the loins.
    const auto at = [&](float u, float v) {
      const float s = 2 * u - 1, wide = 0.235f - 0.035f * std::abs(v - 0.4f);
      return Vec3f{wide * s, -0.035f * std::sin(3.1f * v) - 0.045f * s * s + 0.01f, tall * v};
    };
    UseLinedCloth(b, cloth);
    b.Sheet(10, 10, at, {0.47f, tall});
    b.Use(Plastic(kBlack, 0.4f));
    std::vector<Vec3f> rim;
    for (int i = 0; i <= 40; ++i) {
      const float t = static_cast<float>(i) / 10;
      const int side = std::min(3, i / 10);
      const float f = t - static_cast<float>(side);
      rim.push_back(side == 0 ? at(f, 0) : side == 1 ? at(1, f) : side == 2 ? at(1 - f, 1) : at(0, 1 - f));
    }
    b.Bar(rim, 0.011f, 6);
    b.Bar(std::array<Vec3f, 3>{Vec3f{0, 0.03f, -0.12f}, Vec3f{0, 0.06f, 0.05f}, Vec3f{0, 0.01f, 0.26f}}, 0.018f, 8);
  }
  b.Place({});
  b.Use(Plastic(kBlack, 0.45f));
  b.Bar(std::array<Vec3f, 4>{Vec3f{0, 0.05f, seat - 0.075f}, Vec3f{0, 0.24f, seat - 0.07f}, Vec3f{0, 0.285f, seat},
                             Vec3f{0, 0.30f, seat + 0.20f}},
        0.020f, 8);
  if (variant != 2) {
    for (float s : {-1.0f, 1.0f}) {
      b.Bar(std::array<Vec3f, 4>{Vec3f{s * 0.12f, 0.02f, seat - 0.075f}, Vec3f{s * 0.28f, 0.03f, seat - 0.06f},
                                 Vec3f{s * 0.295f, 0.03f, seat}, Vec3f{s * 0.295f, 0.03f, seat + 0.19f}},
            0.014f, 8);
      SoftBox(b, {s * 0.295f - 0.04f, -0.13f, seat + 0.185f}, {s * 0.295f + 0.04f, 0.13f, seat + 0.22f},
              {.round = 0.016f, .crown = 0.004f, .cells = 6});
    }
  }
  return b.Finish();
}

// Two to four drawers of steel with label holders; a cupboard with rolling shutters.
Model MakeFilingCabinet(uint32_t variant, uint64_t) {
  PropBuilder b("filing_cabinet");
  const int drawers = std::array{4, 2, 3}[variant];
  const float half = variant == 2 ? 0.40f : 0.235f, depth = variant == 2 ? 0.225f : 0.31f, h = std::array{1.32f, 0.72f, 1.05f}[variant];
  const Vec3f tone = std::array<Vec3f, 3>{{{0.44f, 0.45f, 0.46f}, {0.72f, 0.72f, 0.71f}, {0.15f, 0.16f, 0.17f}}}[variant];
  UseCoatedSteel(b, tone);
  b.BevelBox({-half, -depth + 0.02f, 0.03f}, {half, depth, h}, 0.004f);
  b.mesh().Box({-half + 0.02f, -depth + 0.05f, 0}, {half - 0.02f, depth - 0.02f, 0.03f});
  const float face = (h - 0.05f) / static_cast<float>(drawers);
  for (int i = 0; i < drawers; ++i) {
    const float z0 = 0.045f + face * static_cast<float>(i), out = variant == 0 && i == 2 ? 0.11f : 0;
    UseCoatedSteel(b, tone);
    Front(b, -half + 0.012f, half - 0.012f, z0, z0 + face - 0.012f, -depth + 0.02f - out, 0.018f);
    if (out > 0) b.mesh().Box({-half + 0.03f, -depth + 0.02f - out, z0 + 0.02f}, {half - 0.03f, -depth + 0.03f, z0 + face - 0.05f});
    b.Use(Metal({0.6f, 0.6f, 0.6f}, 0.3f));
    BowHandle(b, {-0.06f, z0 + face - 0.09f}, {0.06f, z0 + face - 0.09f}, -depth + 0.002f - out, 0.006f);
    b.BevelBox({-0.045f, -depth - 0.0005f - out, z0 + face - 0.065f}, {0.045f, -depth + 0.002f - out, z0 + face - 0.03f}, 0.001f);
    b.Use(Stone({0.76f, 0.75f, 0.71f}, 0.9f));
    b.BevelBox({-0.038f, -depth - 0.0012f - out, z0 + face - 0.061f}, {0.038f, -depth - 0.0004f - out, z0 + face - 0.034f}, 0.0002f);
  }
  return b.Finish();
}

// For six, ten or round for four.
Model MakeMeetingTable(uint32_t variant, uint64_t) {
  PropBuilder b("meeting_table");
  const float top = 0.74f;
  if (variant == 2) {
    UseLacquer(b, kWhite, 0.35f);
    RoundBoard(b, 0.60f, top - 0.025f, top, 0.004f);
    b.Use(Metal({0.58f, 0.58f, 0.58f}, 0.28f));
    const Vec2f column[] = {{0.32f, 0}, {0.325f, 0.008f}, {0.30f, 0.014f}, {0.05f, 0.03f}, {0.04f, 0.06f}, {0.04f, top - 0.03f}};
    b.Lathe(column, 36);
    return b.Finish();
  }
  const float x = variant == 0 ? 1.0f : 1.8f, y = variant == 0 ? 0.5f : 0.6f;
  UseTimber(b, variant == 0 ? Timber::kBeech : Timber::kWalnut, Grain::kAlongX);
  std::vector<Vec2f> outline;  // boat shape: sides bulge
  for (int i = 0; i < 40; ++i) {
    const Vec3f d = Around(i, 40);
    const auto sq = [](float c) { return std::copysign(std::pow(std::abs(c), 0.28f), c); };
    outline.push_back({x * sq(d.x), y * sq(d.y) * (1 - 0.16f * d.x * d.x * std::abs(sq(d.x)))});
  }
  b.Prism(outline, top - 0.032f, top);
  b.Use(Paint(kBlack, 0.4f));
  for (float s : {-1.0f, 1.0f}) {
    const float px = s * x * 0.55f;
    b.BevelBox({px - 0.06f, -y * 0.45f, 0.02f}, {px + 0.06f, y * 0.45f, top - 0.032f}, 0.01f);
    b.BevelBox({px - 0.18f, -y * 0.62f, 0}, {px + 0.18f, y * 0.62f, 0.025f}, 0.008f);
  }
  b.Use(Plastic({0.05f, 0.05f, 0.052f}, 0.4f));  // sockets in the top
  for (float px : {-0.3f, 0.3f}) b.BevelBox({px - 0.11f, -0.05f, top}, {px + 0.11f, 0.05f, top + 0.004f}, 0.002f);
  return b.Finish();
}

// Words and boxes drawn with markers.
const Texture& BoardPicture(uint32_t variant) {
  static const std::array<Texture, 2> pictures = [] {
    std::array<Texture, 2> both;
    for (uint32_t k = 0; k < 2; ++k) {
      Canvas canvas(512, 256, {0.80f, 0.80f, 0.80f});
      RngStream rng(91 + k, "board");
      canvas.Paint([](float u, float v, Vec3f old) { return old * (0.95f + 0.05f * TileFractal(u, v, 5, 4, 4, 92)); });
      const Vec3f inks[3] = {{0.03f, 0.05f, 0.25f}, {0.35f, 0.03f, 0.03f}, {0.03f, 0.03f, 0.035f}};
      if (k == 0) {
        for (int i = 0; i < 3; ++i) {
          const float x = 0.14f + 0.30f * static_cast<float>(i), y = 0.36f;
          for (const auto& [a, e] : {std::pair{Vec2f{x - 0.09f, y - 0.12f}, Vec2f{x + 0.09f, y - 0.125f}},
                                     {Vec2f{x + 0.09f, y - 0.125f}, Vec2f{x + 0.095f, y + 0.12f}},
                                     {Vec2f{x + 0.095f, y + 0.12f}, Vec2f{x - 0.088f, y + 0.125f}},
                                     {Vec2f{x - 0.088f, y + 0.125f}, Vec2f{x - 0.09f, y - 0.12f}}})
            canvas.Line(a, e, 0.012f, inks[0]);
          canvas.Letters(std::array{"SENSE", "PLAN", "ACT"}[static_cast<size_t>(i)], {x, y}, 0.075f, inks[2]);
          if (i < 2) {
            canvas.Line({x + 0.105f, y}, {x + 0.19f, y}, 0.012f, inks[1]);
            canvas.RegularPolygon({x + 0.19f, y}, 0.025f, 3, 0, inks[1]);
          }
        }
        for (int i = 0; i < 4; ++i)
          canvas.Line({0.08f, 0.66f + 0.07f * static_cast<float>(i)},
                      {0.25f + static_cast<float>(rng.Uniform(0, 0.3)), 0.655f + 0.07f * static_cast<float>(i)}, 0.010f, inks[0]);
      } else {
        canvas.Line({0.10f, 0.15f}, {0.10f, 0.85f}, 0.012f, inks[2]);
        canvas.Line({0.10f, 0.85f}, {0.60f, 0.85f}, 0.012f, inks[2]);
        Vec2f last{0.10f, 0.8f};
        for (int i = 1; i <= 8; ++i) {
          const Vec2f next{0.10f + 0.058f * static_cast<float>(i),
                           0.8f - 0.07f * static_cast<float>(i) + 0.05f * static_cast<float>(rng.Uniform(-1, 1))};
          canvas.Line(last, next, 0.013f, inks[1]);
          last = next;
        }
        canvas.Letters("Q4", {0.78f, 0.22f}, 0.12f, inks[0]);
        for (int i = 0; i < 5; ++i)
          canvas.Line({0.68f, 0.40f + 0.09f * static_cast<float>(i)},
                      {0.74f + static_cast<float>(rng.Uniform(0.03, 0.2)), 0.40f + 0.09f * static_cast<float>(i)}, 0.010f, inks[2]);
      }
      both[k] = canvas.Finish("board " + std::to_string(k));
    }
    return both;
  }();
  return pictures[variant];
}

Model MakeWhiteboard(uint32_t variant, uint64_t) {
  PropBuilder b("whiteboard");
  const float half = variant == 0 ? 0.90f : 0.60f, h = variant == 0 ? 1.20f : 0.90f;
  b.Use(Metal({0.66f, 0.66f, 0.66f}, 0.35f));
  for (float s : {-1.0f, 1.0f}) b.BevelBox({s > 0 ? half - 0.02f : -half, -0.022f, 0.03f}, {s > 0 ? half : -half + 0.02f, 0, h}, 0.004f);
  b.BevelBox({-half + 0.02f, -0.022f, 0.03f}, {half - 0.02f, 0, 0.05f}, 0.004f);
  b.BevelBox({-half + 0.02f, -0.022f, h - 0.02f}, {half - 0.02f, 0, h}, 0.004f);
  b.BevelBox({-half * 0.5f, -0.09f, 0.0f}, {half * 0.5f, -0.01f, 0.012f}, 0.003f);
  b.BevelBox({-half * 0.5f, -0.02f, 0.0f}, {half * 0.5f, 0, 0.04f}, 0.003f);
  b.Use(Paint({0.9f, 0.9f, 0.9f}, 0.12f), BoardPicture(variant));
  b.Picture({-half + 0.018f, -0.012f, 0.048f}, {half - 0.018f, -0.012f, 0.048f}, {half - 0.018f, -0.012f, h - 0.018f},
            {-half + 0.018f, -0.012f, h - 0.018f});
  const Vec3f pens[3] = {{0.4f, 0.04f, 0.03f}, {0.04f, 0.08f, 0.35f}, {0.03f, 0.03f, 0.03f}};
  for (int i = 0; i < 3; ++i) {
    b.Use(Plastic(pens[i], 0.4f));
    const float x = -0.15f + 0.10f * static_cast<float>(i);
    b.mesh().Tube({x, -0.055f, 0.02f}, {x + 0.085f, -0.05f, 0.02f}, 0.008f, 0.008f, 8);
  }
  return b.Finish();
}

// Screens between desks, 1.6 m wide: cloth in an aluminium frame, low with a glass top, high.
Model MakePartition(uint32_t variant, uint64_t) {
  PropBuilder b("partition");
  const float half = 0.80f, h = std::array{1.40f, 1.20f, 1.65f}[variant];
  const Vec3f tone = std::array<Vec3f, 3>{{{0.36f, 0.40f, 0.42f}, {0.12f, 0.24f, 0.30f}, {0.44f, 0.40f, 0.33f}}}[variant];
  const float cloth_top = variant == 1 ? 0.85f : h - 0.025f;
  UseWeave(b, tone);
  SoftBox(b, {-half + 0.02f, -0.025f, 0.06f}, {half - 0.02f, 0.025f, cloth_top}, {.round = 0.008f, .crown = 0.003f, .cells = 6});
  b.Use(Metal({0.64f, 0.64f, 0.64f}, 0.35f));
  for (float s : {-1.0f, 1.0f}) {
    b.BevelBox({s > 0 ? half - 0.025f : -half, -0.02f, 0.02f}, {s > 0 ? half : -half + 0.025f, 0.02f, h}, 0.004f);
    b.BevelBox({s * (half - 0.10f) - 0.025f, -0.22f, 0}, {s * (half - 0.10f) + 0.025f, 0.22f, 0.02f}, 0.006f);
  }
  b.BevelBox({-half, -0.02f, h - 0.025f}, {half, 0.02f, h}, 0.004f);
  b.BevelBox({-half + 0.02f, -0.018f, 0.02f}, {half - 0.02f, 0.018f, 0.065f}, 0.004f);
  if (variant == 1) {
    b.BevelBox({-half + 0.02f, -0.02f, cloth_top}, {half - 0.02f, 0.02f, cloth_top + 0.02f}, 0.003f);
    b.Use(ClearGlass({0.88f, 0.94f, 0.93f}));
    b.BevelBox({-half + 0.02f, -0.003f, cloth_top + 0.018f}, {half - 0.02f, 0.003f, h - 0.02f}, 0.001f);
  }
  return b.Finish();
}

// Round with a liner, square mesh, pedal bin.
Model MakeWasteBinIndoor(uint32_t variant, uint64_t seed) {
  PropBuilder b("waste_bin_indoor");
  RngStream rng(seed, "bin");
  const float h = std::array{0.32f, 0.30f, 0.62f}[variant], r = std::array{0.135f, 0.145f, 0.16f}[variant];
  if (variant == 2) {
    UseBrushedSteel(b);
    const Vec2f body[] = {{0, 0.02f}, {r, 0.02f}, {r, h - 0.07f}};
    b.Lathe(body, 28);
    b.Use(Plastic({0.04f, 0.04f, 0.042f}, 0.4f));
    const Vec2f foot[] = {{0, 0}, {r + 0.004f, 0}, {r + 0.004f, 0.022f}, {r, 0.024f}};
    b.Lathe(foot, 28);
    b.BevelBox({-0.05f, -r - 0.05f, 0.012f}, {0.05f, -r + 0.02f, 0.03f}, 0.005f);
    const Vec2f lid[] = {{r + 0.004f, h - 0.075f}, {r + 0.005f, h - 0.05f}, {r * 0.85f, h - 0.015f}, {r * 0.4f, h}, {0, h}};
    b.Lathe(lid, 28);
    return b.Finish();
  }
  variant == 0 ? b.Use(Plastic({0.05f, 0.052f, 0.055f}, 0.5f)) : b.Use(Metal({0.32f, 0.33f, 0.34f}, 0.45f));
  const Vec2f body[] = {{0, 0.001f},     {r * 0.78f, 0.001f},      {r * 0.80f, 0.006f}, {r, h - 0.008f}, {r + 0.006f, h - 0.004f},
                        {r + 0.004f, h}, {r - 0.004f, h - 0.004f}, {r * 0.78f, 0.012f}, {0, 0.012f}};
  b.Lathe(body, 28);
  for (int i = 0; i < 6; ++i) {  // crumpled paper
    b.Use(Stone(i % 2 ? Vec3f{0.72f, 0.71f, 0.68f} : Vec3f{0.50f, 0.44f, 0.34f}, 0.95f));
    const Vec3f d = Around(i, 6, static_cast<float>(rng.Uniform())) * (i ? r * 0.5f : 0.0f);
    SoftBox(b, d + Vec3f{-0.04f, -0.035f, h * 0.55f + 0.03f * static_cast<float>(i % 3)},
            d + Vec3f{0.04f, 0.04f, h * 0.55f + 0.075f + 0.03f * static_cast<float>(i % 3)},
            {.round = 0.02f, .crown = 0.006f, .fold = 0.02f, .seed = rng.Bits(), .cells = 5});
  }
  return b.Finish();
}

void RingBinders(PropBuilder& b, RngStream& rng) {
  const Vec3f tones[4] = {{0.05f, 0.10f, 0.30f}, {0.35f, 0.05f, 0.04f}, {0.05f, 0.05f, 0.055f}, {0.30f, 0.32f, 0.33f}};
  for (int i = 0; i < 6; ++i) {  // ring binders
    const float x = -0.24f + 0.08f * static_cast<float>(i), lean = i == 5 ? 12.0f : 0.0f;
    b.Place(Turn(0, -lean, 0, {x + (i == 5 ? 0.065f : 0), 0, 0}));
    b.Use(Plastic(tones[rng.Index(4)], 0.5f));
    b.BevelBox({-0.039f, -0.145f, 0.001f}, {0.039f, 0.145f, 0.318f}, 0.004f);
    b.Use(Stone({0.74f, 0.74f, 0.72f}, 0.9f));
    b.BevelBox({-0.026f, -0.1465f, 0.10f}, {0.026f, -0.145f, 0.27f}, 0.0005f);
    b.Use(Metal());
    b.mesh().Tube({0, -0.1455f, 0.055f}, {0, -0.148f, 0.055f}, 0.013f, 0.013f, 12, false);
    b.Place({});
  }
}

// Sheets lying, a letter tray, ring binders, an open notebook with a pen.
Model MakePapers(uint32_t variant, uint64_t seed) {
  PropBuilder b("papers");
  RngStream rng(seed, "papers");
  static const Texture print = [] {
    Canvas canvas(128, 180, {0.80f, 0.80f, 0.78f});
    RngStream lines(95, "print");
    canvas.Rectangle({0.12f, 0.08f}, {0.6f, 0.11f}, {0.05f, 0.05f, 0.06f});
    for (float y = 0.17f; y < 0.9f; y += 0.032f)
      canvas.Rectangle({0.12f, y}, {0.5f + static_cast<float>(lines.Uniform(0, 0.38)), y + 0.011f}, {0.22f, 0.22f, 0.23f});
    return canvas.Finish("printed page");
  }();
  const auto sheet = [&](Vec3f p, float turn) {
    b.Place(Turn(0, 0, turn, p));
    b.Picture({-0.105f, -0.1485f, 0}, {0.105f, -0.1485f, 0}, {0.105f, 0.1485f, 0}, {-0.105f, 0.1485f, 0});
    b.Place({});
  };
  const auto pad = [&](Vec3f p, float turn, float thick, Vec3f tone) {
    b.Use(Stone(tone, 0.9f));
    b.Place(Turn(0, 0, turn, p));
    b.mesh().Box({-0.105f, -0.1485f, 0}, {0.105f, 0.1485f, thick});
    b.Place({});
    b.Use(Stone({0.9f, 0.9f, 0.9f}, 0.9f), print);
    sheet(p + Vec3f{0, 0, thick + 0.0003f}, turn);
  };
  if (variant == 0) {
    for (int i = 0; i < 4; ++i)
      pad({-0.08f + 0.07f * static_cast<float>(i), static_cast<float>(rng.Uniform(-0.04, 0.04)), 0.0012f * static_cast<float>(i)},
          static_cast<float>(rng.Uniform(-25, 25)), 0.0012f, {0.74f, 0.73f, 0.70f});
  } else if (variant == 1) {
    for (int i = 0; i < 3; ++i) {  // trays
      const float z = 0.06f * static_cast<float>(i);
      b.Use(Plastic({0.04f, 0.042f, 0.045f}, 0.35f));
      b.BevelBox({-0.128f, -0.17f, z}, {0.128f, 0.17f, z + 0.003f}, 0.001f);
      for (float s : {-1.0f, 1.0f}) b.BevelBox({s > 0 ? 0.125f : -0.128f, -0.17f, z}, {s > 0 ? 0.128f : -0.125f, 0.17f, z + 0.05f}, 0.001f);
      b.BevelBox({-0.125f, 0.167f, z}, {0.125f, 0.17f, z + 0.05f}, 0.001f);
      for (float x : {-0.12f, 0.12f})
        for (float y : {-0.15f, 0.16f}) b.mesh().Tube({x, y, z}, {x, y, z + 0.06f}, 0.005f, 0.005f, 6);
      pad({0, static_cast<float>(rng.Uniform(-0.012, 0.008)), z + 0.004f}, static_cast<float>(rng.Uniform(-2, 2)),
          static_cast<float>(rng.Uniform(0.004, 0.03)), {0.74f, 0.73f, 0.70f});
    }
  } else if (variant == 2) {
    RingBinders(b, rng);
  } else {
    pad({-0.107f, 0, 0}, 0, 0.010f, {0.72f, 0.70f, 0.63f});
    pad({0.107f, 0, 0}, 0, 0.006f, {0.72f, 0.70f, 0.63f});
    b.Use(Metal({0.3f, 0.3f, 0.31f}, 0.4f));
    for (int i = 0; i < 14; ++i) {
      const float y = -0.135f + 0.0205f * static_cast<float>(i);
      b.Bar(std::array<Vec3f, 3>{Vec3f{-0.007f, y, 0.010f}, Vec3f{0, y, 0.017f}, Vec3f{0.007f, y, 0.007f}}, 0.0012f, 5);
    }
    b.Use(Plastic({0.04f, 0.06f, 0.20f}, 0.3f));
    b.mesh().Tube({0.06f, -0.06f, 0.012f}, {0.14f, 0.05f, 0.012f}, 0.0045f, 0.0045f, 8);
  }
  return b.Finish();
}

}  // namespace

FurnishingRows OfficeRows() {
  return {{{"desk_office", "furniture/desk", 4, MakeDeskOffice, 1.0f, 0.72f, 0.78f, 2000}},
          {{"office_chair", "furniture/seating/office_chair", 4, MakeOfficeChair, 0.4f, 0.90f, 1.35f, 7500}},
          {{"filing_cabinet", "furniture/cabinet", 3, MakeFilingCabinet, 0.5f, 0.70f, 1.35f, 1500}},
          {{"meeting_table", "furniture/table", 3, MakeMeetingTable, 1.9f, 0.72f, 0.78f, 1200}},
          {{"whiteboard", "furniture/whiteboard", 2, MakeWhiteboard, 0.75f, 0.85f, 1.25f, 600}, Mount::kWall, 0.90f},
          {{"partition", "furniture/partition", 3, MakePartition, 0.9f, 1.15f, 1.70f, 1200}},
          {{"waste_bin_indoor", "furniture/waste/trash_can", 3, MakeWasteBinIndoor, 0.25f, 0.25f, 0.65f, 3500}},
          {{"papers", "furniture/misc", 4, MakePapers, 0.3f, 0.002f, 0.34f, 1500}, Mount::kSurface}};
}

}  // namespace airsim360::internal

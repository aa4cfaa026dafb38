// Billboards with pictures: boards of 10 x 6 m, banners of 4 x 11 m, light boxes of 9 x 1.9 m.
// They hang on walls: back at y = 0, lower edge at z = 0.
#include <algorithm>
#include <string_view>

#include "airsim360/worlds/props/billboard_pictures.h"
#include "airsim360/worlds/props/billboards.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

// A coat of paint of 12.6 m x 9 m on a wall at y = 0.
Model MakeMural(uint32_t variant, uint64_t) {
  PropBuilder b("mural");
  b.Use(Paint({1, 1, 1}, 0.85f), MuralPicture(variant), {12.6f, 9});
  b.Sheet(4, 3, [](float u, float v) { return Vec3f{-6.3f + 12.6f * u, -0.02f, 9 * v}; }, {12.6f, 9});
  return b.Finish();
}

// A board with a frame, its face a little in front; `glow`: luminance of its whites by night, cd/m^2.
void AddBoard(PropBuilder& b, float w, float h, Texture face, float glow) {
  b.Use(Paint({0.025f, 0.026f, 0.028f}, 0.5f));
  b.BevelBox({-w / 2 - 0.12f, -0.40f, 0}, {w / 2 + 0.12f, 0.0f, h + 0.24f}, 0.04f);
  Material picture = Paint({1, 1, 1}, 0.55f);
  picture.name = "billboard face";
  picture.emission = Vec3f{1, 1, 1} * (glow * kNit);
  picture.lamp = true;
  b.Use(picture, face);
  b.Picture({-w / 2, -0.405f, 0.12f}, {w / 2, -0.405f, 0.12f}, {w / 2, -0.405f, 0.12f + h}, {-w / 2, -0.405f, 0.12f + h});
}

Model MakeBillboard(uint32_t variant, uint64_t) {
  PropBuilder b("billboard");
  AddBoard(b, 10, 6, BoardPicture(variant), 130);
  return b.Finish();
}

Model MakeBanner(uint32_t variant, uint64_t) {
  PropBuilder b("banner");
  AddBoard(b, 4, 11, BannerPicture(variant), 100);
  return b.Finish();
}

constexpr const char* kBoxes[] = {"NY PUPPETS",   "CAFE BISTRO",  "HOTEL ASTOR",    "ARCADE",      "PIZZA SLICE", "CINEMA",
                                  "DANCE STUDIO", "PAWN & LOAN",  "MUSIC HALL",     "STEAK HOUSE", "BILLIARDS",   "TEXTILE CO",
                                  "ROOMS BY DAY", "CAMERA WORLD", "THE OYSTER BAR", "PARKING"};
static_assert(std::size(kBoxes) == kLightBoxes);

Model MakeLightBox(uint32_t variant, uint64_t) {
  PropBuilder b("light_box");
  Canvas c(576, 128, variant % 3 == 1 ? Vec3f{0.42f, 0.41f, 0.39f} : Vec3f{0.018f, 0.018f, 0.020f});
  constexpr Vec3f kColors[] = {{0.60f, 0.58f, 0.52f}, {0.30f, 0.045f, 0.04f}, {0.58f, 0.32f, 0.12f},
                               {0.62f, 0.60f, 0.57f}, {0.05f, 0.075f, 0.18f}, {0.52f, 0.55f, 0.60f}};
  c.Letters(kBoxes[variant], {0.5f, 0.5f}, std::min(0.52f, 5.6f / static_cast<float>(std::string_view(kBoxes[variant]).size())),
            kColors[variant % 6], 0.85f);
  PrintAndAge(c, variant + 60, 6, 1);
  AddBoard(b, 9, 1.9f, c.Finish("light box " + std::to_string(variant)), 350);
  return b.Finish();
}

// Steel frame that holds a board above a roof: 10 m wide, its board's foot at 2.2 m.
Model MakeBillboardFrame(uint32_t, uint64_t) {
  PropBuilder b("billboard_frame");
  b.Use(Paint({0.045f, 0.047f, 0.05f}, 0.6f));
  for (int i = 0; i < 5; ++i) {
    const float x = -4.6f + 2.3f * static_cast<float>(i);
    b.mesh().Beam({x, 0.1f, 0}, {x, 0.1f, 8.2f}, 0.16f);
    b.mesh().Beam({x, 3.0f, 0}, {x, 0.1f, 6.8f}, 0.12f);
    b.mesh().Beam({x, 3.0f, 0.1f}, {x, 0.1f, 0.1f}, 0.12f);
  }
  for (float z : {2.2f, 5.0f, 8.0f}) b.mesh().Beam({-5, 0.1f, z}, {5, 0.1f, z}, 0.14f);
  // A catwalk along the lower edge.
  b.mesh().Box({-5, -0.9f, 2.05f}, {5, 0.0f, 2.10f});
  for (float z : {2.6f, 3.1f}) b.mesh().Beam({-5, -0.88f, z}, {5, -0.88f, z}, 0.035f);
  return b.Finish();
}

}  // namespace

std::vector<PropKind> BillboardKinds() {
  return {
      {"billboard", "signage/billboard", kDrawnBoards + kVistaBoards, MakeBillboard, 5.2f, 6.0f, 6.5f, 100},
      {"banner", "signage/billboard", 4, MakeBanner, 2.2f, 11.0f, 11.5f, 100},
      {"mural", "signage/billboard", 4, MakeMural, 6.4f, 8.9f, 9.1f, 50},
      {"light_box", "signage/billboard", kLightBoxes, MakeLightBox, 4.7f, 2.0f, 2.3f, 100},
      {"billboard_frame", "signage/billboard", 1, MakeBillboardFrame, 5.0f, 8.0f, 8.4f, 600},
  };
}

}  // namespace airsim360::internal

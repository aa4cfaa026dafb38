// Lamp posts and street lights.
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

constexpr Vec3f kGreenBlack{0.020f, 0.030f, 0.026f};

// Post of cast iron with opal globes: one on top and three or four on curved arms.
Model MakeLampPost(uint32_t variant, uint64_t) {
  PropBuilder b("lamp_post");
  b.Use(Paint(kGreenBlack, 0.35f));
  const Vec2f post[] = {{0.24f, -0.2f},  {0.24f, 0.05f},  {0.22f, 0.07f},  {0.20f, 0.075f}, {0.19f, 0.30f},  {0.165f, 0.34f},
                        {0.165f, 0.72f}, {0.185f, 0.75f}, {0.185f, 0.79f}, {0.13f, 0.85f},  {0.095f, 1.0f},  {0.075f, 1.2f},
                        {0.09f, 1.22f},  {0.09f, 1.26f},  {0.072f, 1.29f}, {0.055f, 3.35f}, {0.085f, 3.37f}, {0.085f, 3.42f},
                        {0.055f, 3.46f}, {0.05f, 3.75f},  {0.09f, 3.80f},  {0.09f, 3.84f},  {0.03f, 3.86f},  {0, 3.86f}};
  b.Lathe(post, 20);
  const int arms = variant == 0 ? 3 : variant == 1 ? 4 : 2;
  std::vector<Vec3f> globes = {{0, 0, 4.03f}};
  for (int i = 0; i < arms; ++i) {
    const float a = kTauF * static_cast<float>(i) / static_cast<float>(arms);
    const Vec3f d{std::cos(a), std::sin(a), 0};
    const auto at = [&](float r, float z) { return d * r + Vec3f{0, 0, z}; };
    const Vec3f arm[] = {at(0.04f, 3.40f), at(0.18f, 3.34f), at(0.32f, 3.33f), at(0.44f, 3.39f), at(0.48f, 3.50f)};
    const Vec3f curl[] = {at(0.05f, 3.05f), at(0.12f, 3.10f), at(0.20f, 3.22f), at(0.25f, 3.33f)};
    b.Bar(arm, 0.022f, 10);
    b.Bar(curl, 0.013f, 8);
    const Vec2f cup[] = {{0.022f, 0}, {0.05f, 0.01f}, {0.085f, 0.05f}, {0.085f, 0.075f}, {0, 0.075f}};
    b.Lathe(cup, 16, at(0.48f, 3.49f));
    globes.push_back(at(0.48f, 3.70f));
  }
  // 75 cd each: 5 to 10 lx on the path around the post.
  b.Use(WhiteGlow({1.0f, 0.80f, 0.56f}, 660));
  for (Vec3f c : globes) b.mesh().Sphere(c, {0.19f, 0.19f, 0.19f}, 14, 24);
  b.Use(Paint(kGreenBlack, 0.35f));
  for (Vec3f c : globes) {
    const Vec2f finial[] = {{0.06f, 0.180f}, {0.05f, 0.20f}, {0.012f, 0.205f}, {0.014f, 0.24f}, {0, 0.25f}};
    b.Lathe(finial, 12, c);
  }
  return b.Finish();
}

// Tapered steel mast with a curved arm towards -Y (the road) and a flat LED or cobra head.
Model MakeStreetLight(uint32_t variant, uint64_t) {
  PropBuilder b("street_light");
  const float height = variant == 0 ? 8.6f : 9.2f, reach = variant == 0 ? 2.4f : 1.8f;
  b.Use(Metal({0.50f, 0.51f, 0.52f}, 0.42f), ScratchedTexture());
  b.BevelBox({-0.17f, -0.17f, 0}, {0.17f, 0.17f, 0.025f}, 0.006f);
  const Vec2f mast[] = {{0.125f, 0.02f}, {0.125f, 0.05f}, {0.11f, 0.07f}, {0.10f, 1.2f}, {0.058f, height - 0.9f}, {0, height - 0.88f}};
  b.Lathe(mast, 18);
  b.BevelBox({-0.06f, -0.122f, 0.55f}, {0.06f, -0.085f, 0.95f}, 0.008f);
  for (float x : {-0.13f, 0.13f}) {
    for (float y : {-0.13f, 0.13f}) b.mesh().Tube({x, y, 0.02f}, {x, y, 0.055f}, 0.016f, 0.016f, 6);
  }
  // The arm rises and levels out like a quarter of an ellipse.
  std::vector<Vec3f> arm;
  std::vector<float> radii;
  for (int i = 0; i <= 12; ++i) {
    const float a = kTauF / 4 * static_cast<float>(i) / 12;
    arm.push_back({0, -reach * (1 - std::cos(a)), height - 1.0f + 0.95f * std::sin(a)});
    radii.push_back(0.055f - 0.0018f * static_cast<float>(i));
  }
  b.Bar(arm, radii, 12);
  // Head: a flattened body along the arm with a lens below.
  b.Place(Turn(0, 0, 0, {0, -reach - 0.22f, height - 0.05f}));
  const Vec2f outline[] = {{0.05f, 0.30f},   {-0.05f, 0.30f}, {-0.13f, 0.10f}, {-0.15f, -0.18f},
                           {-0.11f, -0.36f}, {0.11f, -0.36f}, {0.15f, -0.18f}, {0.13f, 0.10f}};
  b.Prism(outline, -0.03f, 0.035f);
  std::vector<Vec2f> crown;
  for (Vec2f p : outline) crown.push_back({p.x * 0.72f, p.y * 0.85f});
  b.Prism(crown, 0.034f, 0.06f);
  b.Use(Plastic({0.72f, 0.72f, 0.68f}, 0.25f));
  b.BevelBox({-0.10f, -0.30f, -0.045f}, {0.10f, 0.02f, -0.029f}, 0.012f);
  // The light itself faces the road alone: 1000 cd straight down, 14 lx from 8.6 m.
  b.Use(WhiteGlow({1.0f, 0.80f, 0.56f}, 20500));
  b.mesh().Quad({-0.085f, -0.285f, -0.046f}, {-0.085f, 0.005f, -0.046f}, {0.085f, 0.005f, -0.046f}, {0.085f, -0.285f, -0.046f});
  return b.Finish();
}

// Park lamp: a slender post that ends in a crook, from which a bell-shaped shade hangs towards -Y.
Model MakeCrookLamp(uint32_t variant, uint64_t) {
  PropBuilder b("crook_lamp");
  const Material iron = Paint({0.018f, 0.019f, 0.021f}, 0.38f);
  b.Use(iron);
  const Vec2f post[] = {{0.15f, -0.2f},  {0.15f, 0.03f},  {0.125f, 0.06f}, {0.115f, 0.50f}, {0.135f, 0.53f},
                        {0.135f, 0.56f}, {0.085f, 0.60f}, {0.066f, 0.80f}, {0.060f, 2.2f},  {0.072f, 2.22f},
                        {0.072f, 2.26f}, {0.056f, 2.29f}, {0.046f, 5.55f}, {0, 5.56f}};
  b.Lathe(post, 18);
  const float reach = variant == 0 ? 0.46f : 0.38f;
  std::vector<Vec3f> crook;
  for (int i = 0; i <= 14; ++i) {
    const float a = kTauF / 2 * static_cast<float>(i) / 14;
    crook.push_back({0, -reach * (1 - std::cos(a)), 5.50f + 0.95f * reach * std::sin(a)});
  }
  const Vec3f tip{0, -2 * reach, 5.26f};
  crook.push_back(tip);
  b.Bar(crook, 0.034f, 12);
  const Vec2f shade[] = {{0.24f, -0.42f}, {0.235f, -0.36f}, {0.21f, -0.26f}, {0.165f, -0.16f}, {0.10f, -0.09f},
                         {0.07f, -0.05f}, {0.06f, 0.0f},    {0.045f, 0.06f}, {0, 0.07f}};
  b.Lathe(shade, 24, tip);
  // 150 cd straight down: 6 lx from 5 m.
  b.Use(WhiteGlow({0.86f, 0.84f, 0.78f}, 1200));
  const Vec2f lens[] = {{0, -0.47f}, {0.10f, -0.455f}, {0.17f, -0.43f}, {0.20f, -0.405f}, {0, -0.40f}};
  b.Lathe(lens, 18, tip);
  return b.Finish();
}

// Knee-high path light: a post, a lantern of opal glass and a flat cap.
Model MakeBollardLamp(uint32_t variant, uint64_t) {
  PropBuilder b("bollard_lamp");
  const Material iron = Paint({0.020f, 0.021f, 0.023f}, 0.40f);
  b.Use(iron);
  const float neck = variant == 0 ? 0.92f : 0.84f;
  const Vec2f post[] = {{0.085f, -0.15f},      {0.085f, 0.02f},        {0.055f, 0.05f},  {0.048f, neck},
                        {0.09f, neck + 0.05f}, {0.095f, neck + 0.07f}, {0, neck + 0.07f}};
  b.Lathe(post, 16);
  const Vec2f cap[] = {{0.125f, 0}, {0.125f, 0.025f}, {0.09f, 0.055f}, {0.03f, 0.075f}, {0, 0.078f}};
  b.Lathe(cap, 18, {0, 0, neck + 0.29f});
  for (int i = 0; i < 4; ++i) {
    const float a = kTauF * (static_cast<float>(i) + 0.5f) / 4;
    const Vec3f d{0.088f * std::cos(a), 0.088f * std::sin(a), 0};
    b.mesh().Tube(d + Vec3f{0, 0, neck + 0.06f}, d + Vec3f{0, 0, neck + 0.30f}, 0.006f, 0.006f, 6);
  }
  // 25 cd to all sides.
  b.Use(WhiteGlow({0.88f, 0.86f, 0.80f}, 800));
  b.mesh().Tube({0, 0, neck + 0.07f}, {0, 0, neck + 0.29f}, 0.066f, 0.078f, 16);
  return b.Finish();
}

}  // namespace

std::vector<PropKind> LampKinds() {
  return {
      {"bollard_lamp", "furniture/lighting/lamp_post/type_b", 2, MakeBollardLamp, 0.2f, 1.1f, 1.4f, 1500},
      {"crook_lamp", "furniture/lighting/lamp_post", 2, MakeCrookLamp, 0.3f, 5.6f, 6.2f, 3000},
      {"lamp_post", "furniture/lighting/lamp_post", 3, MakeLampPost, 0.4f, 4.0f, 4.5f, 6000},
      {"street_light", "furniture/lighting/street_light", 2, MakeStreetLight, 0.3f, 8.0f, 9.5f, 2000},
  };
}

}  // namespace airsim360::internal

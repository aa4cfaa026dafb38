#include "airsim360/people/body/body_pack.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs.h"
#include "airsim360/people/body/figure.h"

namespace airsim360 {
namespace {

// A pack of one snowman per sex.
BodyPack Snowmen() {
  BodyPack pack;
  pack.texture_names = {"white"};
  pack.textures = {EncodePng(Image<Rgba8>(4, 4, Rgba8{200, 210, 220, 255}))};
  for (const Sex sex : {Sex::kFemale, Sex::kMale}) {
    const auto model = MakeProceduralBody({.sex = sex});
    PackCharacter c;
    c.spec = model->spec;
    c.name = sex == Sex::kMale ? "man" : "woman";
    c.p_PJ = model->p_PJ;
    c.sockets = model->sockets;
    c.materials = {Material{.name = "snow", .base_color_texture = 0}};
    c.cloths = {Cloth::kTop};
    for (int level = 0; level < internal::kBodyLevels; ++level) {
      internal::LoftMesh mesh;
      mesh.Ellipsoid({0, 0, 1}, {0.2, 0.2, 0.7}, Joint::kSpine2, 0, 24 >> level);
      c.levels.push_back(mesh.Finish(""));
    }
    pack.characters.push_back(std::move(c));
  }
  return pack;
}

TEST(BodyPack, ComesBackAsItWasWritten) {
  const BodyPack pack = Snowmen();
  const Bytes bytes = EncodeBodyPack(pack);
  const BodyPack back = DecodeBodyPack(bytes, "test.pack");
  ASSERT_EQ(back.characters.size(), 2u);
  EXPECT_EQ(EncodeBodyPack(back), bytes);
  EXPECT_EQ(back.characters[1].levels[0].mesh.positions, pack.characters[1].levels[0].mesh.positions);
}

TEST(BodyPack, GivesBodiesOfTheSexAndStatureAskedFor) {
  const BodyPack pack = Snowmen();
  const auto body = MakePackBody(pack, {.sex = Sex::kFemale, .stature = 1.60});
  EXPECT_EQ(body->character, "woman");
  const double scale = 1.60 / 1.75;
  EXPECT_NEAR(body->p_PJ[5].z, pack.characters[0].p_PJ[5].z * scale, 1e-12);
  EXPECT_NEAR(body->levels[0].mesh.positions[0].z, pack.characters[0].levels[0].mesh.positions[0].z * scale, 1e-6);
  // With props, which it shares with procedural bodies; parts refer to materials that are there.
  EXPECT_EQ(body->levels[0].props.size(), 4u);
  for (const MeshPart& part : body->levels[2].mesh.parts) EXPECT_LT(part.material, body->materials.size());
  EXPECT_EQ(body->textures.size(), 1u);
  // Everybody in the same picture shares it.
  EXPECT_EQ(MakePackBody(pack, {.sex = Sex::kFemale, .stature = 1.7})->textures[0], body->textures[0]);
}

TEST(BodyPack, SkinsDifferByOneAmountOfMelanin) {
  BodyPack pack = Snowmen();
  for (PackCharacter& c : pack.characters) c.cloths = {Cloth::kSkin}, c.materials[0].base_color = {1, 1, 1};
  double fair = 0;
  constexpr uint64_t kPeople = 400;
  for (uint64_t look = 0; look < kPeople; ++look) {
    const Vec3f skin = MakePackBody(pack, {.look = look}, internal::kBodyLevels - 1)->materials[0].base_color;
    // One amount of melanin for all three channels.
    EXPECT_NEAR(std::log(skin.x) / std::log(skin.y), 0.7, 1e-3);
    EXPECT_NEAR(std::log(skin.z) / std::log(skin.y), 1.3, 1e-3);
    EXPECT_GE(skin.y, std::exp(-0.65f));
    EXPECT_LE(skin.y, 1);
    fair += skin.y > std::exp(-0.15f);
  }
  EXPECT_NEAR(fair / kPeople, 0.5, 0.1);
}

TEST(BodyPack, RefusesWhatWouldReachOutOfItsLists) {
  const auto refused = [](const auto& spoil) {
    BodyPack pack = Snowmen();
    spoil(pack.characters[1]);
    EXPECT_THROW(DecodeBodyPack(EncodeBodyPack(pack), "bad.pack"), InputError);
  };
  refused([](PackCharacter& c) { c.levels[0].mesh.triangles[3].y = 100000; });
  refused([](PackCharacter& c) { c.levels[1].influences[0].joint[2] = 77; });
  refused([](PackCharacter& c) { c.levels[2].mesh.parts[0].material = 5; });
  refused([](PackCharacter& c) { c.levels[2].mesh.parts[0].triangle_count += 1; });
  refused([](PackCharacter& c) { c.materials[0].base_color_texture = 9; });
  refused([](PackCharacter& c) { c.sockets.pop_back(); });
  Bytes cut = EncodeBodyPack(Snowmen());
  cut.resize(cut.size() / 2);
  EXPECT_THROW(DecodeBodyPack(cut, "cut.pack"), InputError);
  EXPECT_THROW(DecodeBodyPack(AsBytes("not a pack at all"), "text.pack"), InputError);
}

}  // namespace
}  // namespace airsim360

// The rules that characters are baked by, on shapes whose answer is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "airsim360/image/color.h"
#include "airsim360/math/angles.h"
#include "layers.h"
#include "levels.h"
#include "picture.h"
#include "rest_pose.h"

namespace airsim360::bake {
namespace {

// A standing tube about the z axis, open at both ends, facing outwards.
Piece Tube(float radius, float height, Layer layer, uint32_t around = 48, uint32_t rings = 40) {
  Piece piece;
  piece.layer = layer;
  for (uint32_t i = 0; i <= rings; ++i) {
    for (uint32_t k = 0; k < around; ++k) {
      const double a = kTau * k / around;
      piece.positions.push_back({radius * static_cast<float>(std::cos(a)), radius * static_cast<float>(std::sin(a)),
                                 height * static_cast<float>(i) / static_cast<float>(rings)});
      piece.source.push_back(static_cast<uint32_t>(piece.source.size()));
      Influences in;
      in.joint[0] = static_cast<uint8_t>(Joint::kPelvis);
      in.weight[0] = 1;
      piece.influences.push_back(in);
    }
  }
  for (uint32_t i = 0; i < rings; ++i) {
    for (uint32_t k = 0; k < around; ++k) {
      const uint32_t a = i * around + k, b = i * around + (k + 1) % around;
      piece.indices.insert(piece.indices.end(), {a, b, b + around, a, b + around, a + around});
    }
  }
  piece.uvs.resize(piece.positions.size());
  return piece;
}

float RadiusOf(Vec3f p) { return std::hypot(p.x, p.y); }

TEST(Layers, SkinGoesUnderItsGarmentAndStaysElsewhere) {
  // An arm that sticks out of its sleeve by 5 mm; the sleeve covers the lower half.
  std::vector<Piece> pieces{Tube(0.05f, 0.6f, Layer::kSkin), Tube(0.045f, 0.3f, Layer::kTop)};
  TuckIn(pieces, 0.006f);
  for (const Vec3f& p : pieces[0].positions) {
    if (p.z < 0.29f) {
      EXPECT_LT(RadiusOf(p), 0.045f - 0.005f) << p.z;
    }
    if (p.z > 0.34f) {
      EXPECT_NEAR(RadiusOf(p), 0.05f, 1e-5f) << p.z;
    }
  }
  for (const Vec3f& p : pieces[1].positions) EXPECT_NEAR(RadiusOf(p), 0.045f, 1e-6f);
}

TEST(Layers, WhatLiesUnderTwoGarmentsGoesUnderBoth) {
  std::vector<Piece> pieces{Tube(0.05f, 0.3f, Layer::kSkin), Tube(0.05f, 0.3f, Layer::kBottom), Tube(0.05f, 0.3f, Layer::kTop)};
  TuckIn(pieces, 0.008f);
  EXPECT_NEAR(RadiusOf(pieces[1].positions[500]), 0.042f, 5e-4f);
  EXPECT_NEAR(RadiusOf(pieces[0].positions[500]), 0.034f, 1e-3f);
}

TEST(Layers, SkinStaysUnderItsGarmentInAnyPose) {
  // A shoulder: the cloth turns with the arm from half of its height on, the skin's own bones change at another height.
  std::vector<Piece> pieces{Tube(0.05f, 0.3f, Layer::kSkin), Tube(0.056f, 0.3f, Layer::kTop)};
  for (Piece& piece : pieces) {
    const float from = piece.layer == Layer::kSkin ? 0.03f : 0.18f;
    for (size_t v = 0; v < piece.positions.size(); ++v) {
      const float arm = std::clamp((piece.positions[v].z - from) / 0.06f, 0.0f, 1.0f);
      piece.influences[v].joint = {static_cast<uint8_t>(Joint::kLeftClavicle), static_cast<uint8_t>(Joint::kLeftShoulder), 0, 0};
      piece.influences[v].weight = {1 - arm, arm, 0, 0};
    }
  }
  const auto sticks_out = [](const std::vector<Piece>& at) {
    // Turned by 60 degrees about (0, 0, 0.15); the tubes' vertices lie over each other.
    const Mat3d R = RotationY(60 * kDegree);
    float most = 0;
    for (size_t v = 0; v < at[0].positions.size(); ++v) {
      const auto moved = [&](const Piece& piece) {
        const float arm = static_cast<Joint>(piece.influences[v].joint[0]) == Joint::kLeftShoulder ? piece.influences[v].weight[0]
                                                                                                   : piece.influences[v].weight[1];
        const Vec3d p = VecCast<double>(piece.positions[v]), c{0, 0, 0.15};
        return p * (1.0 - arm) + (R * (p - c) + c) * static_cast<double>(arm);
      };
      const Vec3d outwards{at[0].positions[v].x, at[0].positions[v].y, 0};
      most = std::max(most, static_cast<float>(Dot(moved(at[0]) - moved(at[1]), Normalized(outwards))));
    }
    return most;
  };
  EXPECT_GT(sticks_out(pieces), 0.01f);
  TuckIn(pieces, 0.006f);
  EXPECT_LT(sticks_out(pieces), 1e-4f);
}

TEST(Layers, OnlyWhatNobodySeesIsDropped) {
  // A long sleeve hides the middle of an arm, not what can be looked at through its ends.
  std::vector<Piece> pieces{Tube(0.05f, 1.0f, Layer::kSkin), Tube(0.052f, 0.6f, Layer::kTop)};
  const size_t before = pieces[0].indices.size();
  DropHidden(pieces);
  EXPECT_LT(pieces[0].indices.size(), before * 3 / 4);
  float lowest = 1;
  for (const uint32_t v : pieces[0].indices) {
    const float z = pieces[0].positions[v].z;
    if (z > 0.1f) lowest = std::min(lowest, z);
  }
  EXPECT_GT(lowest, 0.4f);   // gone below
  EXPECT_LT(lowest, 0.58f);  // and there at the sleeve's end
  EXPECT_EQ(pieces[1].indices.size(), before);
}

// Whether the outer of two pieces hides the inner one from the side, everywhere.
bool Hides(const Piece& outer, const std::vector<uint32_t>& outer_indices, const Piece& inner, const std::vector<uint32_t>& inner_indices,
           float* depth) {
  // Least distance of the outer one's faces from the axis against the greatest of the inner one's corners.
  float least = 1e9f, most = 0;
  for (size_t i = 0; i + 2 < outer_indices.size(); i += 3) {
    const uint32_t* t = &outer_indices[i];
    const Vec3f a = outer.positions[t[0]], n = Normalized(Cross(outer.positions[t[1]] - a, outer.positions[t[2]] - a));
    least = std::min(least, std::abs(Dot(Vec3f{a.x, a.y, 0}, n)));
  }
  for (const uint32_t v : inner_indices) most = std::max(most, RadiusOf(inner.positions[v]));
  *depth = least - most;
  return least >= most;
}

TEST(Layers, GarmentsCoverAtEveryLevelOfDetail) {
  // A finely meshed arm under a sleeve 3 mm wider that becomes coarse: without tucking in it comes through.
  const std::vector<Piece> made{Tube(0.05f, 0.3f, Layer::kSkin), Tube(0.053f, 0.3f, Layer::kTop)};
  for (const float gap : {0.0f, 0.016f}) {
    std::vector<Piece> pieces = made;
    if (gap > 0) TuckIn(pieces, gap);
    const auto simple = SimplifyTogether(pieces, 24, 0.04f);
    EXPECT_LE(simple[0].size() / 3 + simple[1].size() / 3, 24u);
    float depth = 0;
    EXPECT_EQ(Hides(pieces[1], simple[1], pieces[0], simple[0], &depth), gap > 0) << depth;
  }
}

TEST(Layers, PiecesAreSimplifiedWithTheSameError) {
  // A plain tube needs few triangles; a small one, ten times more finely meshed, must not lose its shape for it.
  const std::vector<Piece> pieces{Tube(0.1f, 1.0f, Layer::kSkin, 64, 80), Tube(0.02f, 0.1f, Layer::kTop, 24, 10)};
  const size_t all = (pieces[0].indices.size() + pieces[1].indices.size()) / 3;
  const auto simple = SimplifyTogether(pieces, all / 20, 0.04f);
  const auto share = [&](size_t k) { return static_cast<double>(simple[k].size()) / static_cast<double>(pieces[k].indices.size()); };
  EXPECT_LE((simple[0].size() + simple[1].size()) / 3, all / 20);
  EXPECT_GT(share(1), 1.5 * share(0));
  // What is whole stays so.
  std::vector<Piece> whole = pieces;
  whole[1].whole = true;
  EXPECT_EQ(SimplifyTogether(whole, all / 5, 0.04f)[1], whole[1].indices);
}

TEST(Layers, OnlySmallPartsAreCrumbs) {
  Piece piece = Tube(0.1f, 1.0f, Layer::kTop);
  const std::vector<uint32_t> shirt = piece.indices;
  const Piece button = Tube(0.005f, 0.003f, Layer::kTop, 8, 1);
  const auto first = static_cast<uint32_t>(piece.positions.size());
  piece.positions.insert(piece.positions.end(), button.positions.begin(), button.positions.end());
  for (const uint32_t s : button.source) piece.source.push_back(first + s);
  for (const uint32_t i : button.indices) piece.indices.push_back(first + i);
  const std::vector<uint32_t> all = piece.indices;
  DropCrumbs(0.009f, piece);
  EXPECT_EQ(piece.indices, all);
  DropCrumbs(0.012f, piece);
  EXPECT_EQ(piece.indices, shirt);
}

TEST(Layers, ASkirtIsOneClothAroundBothLegs) {
  Piece skirt = Tube(0.2f, 0.5f, Layer::kBottom);
  // Drawn in between the legs, and shared out by legs and knees as trousers are.
  for (size_t v = 0; v < skirt.positions.size(); ++v) {
    Vec3f& p = skirt.positions[v];
    if (std::abs(p.y) < 0.06f && p.z < 0.4f) p.x *= 0.5f;
    Influences& in = skirt.influences[v];
    in.joint = {static_cast<uint8_t>(p.y > 0 ? Joint::kLeftHip : Joint::kRightHip),
                static_cast<uint8_t>(p.y > 0 ? Joint::kLeftKnee : Joint::kRightKnee), static_cast<uint8_t>(Joint::kPelvis), 0};
    in.weight = {0.5f, 0.2f, 0.3f, 0};
  }
  MakeTaut(skirt, 0.45f);
  HangFromHips(skirt, 0.16f);
  for (size_t v = 0; v < skirt.positions.size(); ++v) {
    const Vec3f p = skirt.positions[v];
    // The chord over the dent, at y = 0.06, lies at 0.19.
    if (p.z < 0.38f) {
      EXPECT_GT(RadiusOf(p), 0.18f) << p.y << " " << p.z;
    }
    const Influences& in = skirt.influences[v];
    float left = 0, right = 0, sum = 0;
    for (size_t k = 0; k < 4; ++k) {
      EXPECT_FALSE(in.weight[k] > 0 && static_cast<Joint>(in.joint[k]) == Joint::kLeftKnee);
      if (static_cast<Joint>(in.joint[k]) == Joint::kLeftHip) left += in.weight[k];
      if (static_cast<Joint>(in.joint[k]) == Joint::kRightHip) right += in.weight[k];
      sum += in.weight[k];
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    EXPECT_NEAR(left + right, 0.7, 1e-5);
    // Steps of no more than a tenth from one vertex of the front to the next (at most 27 mm apart).
    if (std::abs(p.y) < 0.001f) {
      EXPECT_NEAR(left, right, 1e-4);
    }
    if (p.y > 0.081f) {
      EXPECT_EQ(right, 0);
    }
  }
}

// A package of one arm: the bones that are turned, with the nodes of their tails between them.
BaseHuman Arm(std::vector<Vec3f>& v) {
  BaseHuman base;
  const auto bone = [&](const std::string& name, Vec3f head, int parent) {
    base.bone_names.push_back(name + "____head");
    base.bone_parents.push_back(parent);
    base.bone_names.push_back(name);  // its tail
    base.bone_parents.push_back(static_cast<int>(base.bone_names.size()) - 2);
    base.joints[name + "____head"] = {static_cast<int>(v.size())};
    v.push_back(head);
    return static_cast<int>(base.bone_names.size()) - 1;
  };
  const int root = bone("spine01", {0, 5, 0}, -1);
  const int clavicle = bone("clavicle.L", {0.3f, 5.2f, 0.5f}, root), shoulder = bone("shoulder01.L", {1.2f, 5.5f, 0.4f}, clavicle);
  const int upper = bone("upperarm01.L", {1.7f, 5.2f, 0.1f}, shoulder), elbow = bone("lowerarm01.L", {3.1f, 3.5f, 0.1f}, upper);
  const int wrist = bone("wrist.L", {4.3f, 2.5f, 1.7f}, elbow);
  for (int f = 1; f <= 5; ++f) {
    const std::string name = "finger" + std::to_string(f);
    const float out = 0.25f * static_cast<float>(f - 3);
    const int first = bone(name + "-1.L", {4.6f + 0.4f * out, 1.9f - 0.4f * out, 2.5f - 0.6f * out}, wrist);
    bone(name + "-2.L", {4.7f + 0.9f * out, 1.7f - 0.9f * out, 2.7f - 1.4f * out}, first);
  }
  return base;
}

double AngleOf(Vec3d a, Vec3d b) { return std::acos(std::clamp(Dot(Normalized(a), Normalized(b)), -1.0, 1.0)) / kDegree; }

TEST(RestPose, ArmsComeDownFingersCloseAndNoBoneChangesItsLength) {
  std::vector<Vec3f> v;
  const BaseHuman base = Arm(v);
  const std::vector<RigidTransform> bones = RelaxedBones(base, v);
  const auto before = [&](const char* name) { return BoneEnd(base, v, std::string(name) + ".L____head"); };
  const auto after = [&](const char* name) { return PosedEnd(base, v, bones, std::string(name) + ".L____head"); };
  const char* chain[] = {"clavicle", "shoulder01", "upperarm01", "lowerarm01", "wrist", "finger3-1", "finger3-2"};
  for (size_t k = 1; k < std::size(chain); ++k)
    EXPECT_NEAR(Norm(after(chain[k]) - after(chain[k - 1])), Norm(before(chain[k]) - before(chain[k - 1])), 1e-6) << chain[k];
  // All of the way is shared, and it is 20 degrees about the axis that points forward.
  const auto lean = [](Vec3d d) { return std::atan2(d.x, -d.y) / kDegree; };
  EXPECT_NEAR(lean(before("lowerarm01") - before("upperarm01")) - lean(after("lowerarm01") - after("upperarm01")), 20, 1e-6);
  EXPECT_NEAR(AngleOf(before("upperarm01") - before("shoulder01"), after("upperarm01") - after("shoulder01")), 12 * 0.87, 3);
  // Elbows open by what they shall.
  const auto bent = [&](const auto& at) { return AngleOf(at("wrist") - at("lowerarm01"), at("lowerarm01") - at("upperarm01")); };
  EXPECT_NEAR(bent(before) - bent(after), 16, 1e-6);
  for (const char finger : {'2', '4', '5'}) {
    const std::string a = std::string("finger") + finger + "-1", b = std::string("finger") + finger + "-2";
    const auto spread = [&](const auto& at) { return AngleOf(at(b.c_str()) - at(a.c_str()), at("finger3-2") - at("finger3-1")); };
    EXPECT_LT(spread(after), 0.5 * spread(before)) << finger;
  }
}

TEST(RestPose, AThirdOfAShoulderIsGirtMoreEvenlyThanAHinge) {
  // Between two bones a vertex half of each comes (1 - cos(angle / 2)) of its radius nearer: closed form of linear blending.
  std::vector<Vec3f> v;
  const BaseHuman base = Arm(v);
  const std::vector<RigidTransform> bones = RelaxedBones(base, v);
  const auto index = [&](const std::string& name) {
    return static_cast<int>(std::ranges::find(base.bone_names, name + ".L____head") - base.bone_names.begin());
  };
  SourceMesh mesh;
  mesh.bones = {{index("shoulder01"), index("upperarm01"), 0, 0}};
  mesh.weights = {{0.5f, 0.5f, 0, 0}};
  const Vec3d pivot = BoneEnd(base, v, "upperarm01.L____head");
  const Vec3d p = pivot + Vec3d{0.3, 0.2, 0};
  const std::vector<Vec3f> posed = Posed(mesh, {VecCast<float>(p)}, bones);
  const double radius = Norm(VecCast<double>(posed[0]) - PosedEnd(base, v, bones, "upperarm01.L____head"));
  EXPECT_NEAR(radius, Norm(p - pivot) * std::cos(4 * kDegree), 1e-5);
}

Image<Rgba8> Striped(uint8_t a, uint8_t b) {
  Image<Rgba8> image(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) image(x, y) = {x % 8 < 4 ? a : b, x % 8 < 4 ? a : b, x % 8 < 4 ? a : b, 255};
  }
  return image;
}

TEST(Pictures, SkinComesToTheAlbedoAskedForAndKeepsItsShades) {
  // Skin in the left half, in two shades; a ground that nothing shows in the right half.
  Image<Rgba8> image(16, 8, Rgba8{0, 255, 0, 255});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) image(x, y) = y < 3 ? Rgba8{160, 80, 60, 255} : Rgba8{120, 60, 45, 255};
  const std::vector<std::array<Vec2f, 3>> uvs{{{{0, 0}, {0.5f, 0}, {0.5f, 1}}}, {{{0, 0}, {0.5f, 1}, {0, 1}}}};
  const Vec3f albedo{0.25f, 0.13f, 0.08f};
  const double before = SrgbToLinear(160) / SrgbToLinear(120);
  MakeSkin(albedo, uvs, image);
  const Rgba8 common = image(4, 6), bright = image(4, 1);
  EXPECT_EQ(common.r, LinearToSrgb8(albedo.x));
  EXPECT_EQ(common.g, LinearToSrgb8(albedo.y));
  EXPECT_EQ(common.b, LinearToSrgb8(albedo.z));
  EXPECT_NEAR(SrgbToLinear(bright.r) / SrgbToLinear(common.r), before, 0.02);
  EXPECT_EQ(common.a, 255);
}

TEST(Picture, HairThatIsPaintedDarkWithLightsIsEvenEnoughToBeTinted) {
  Image<Rgba8> image = Striped(12, 90);
  MakeTintable(0.22, image);
  // Two levels about their mean, ratio exp(2 spread).
  EXPECT_NEAR(static_cast<double>(image(4, 0).g) / image(0, 0).g, std::exp(0.44), 0.02);
  EXPECT_NEAR(0.5 * (image(4, 0).g + image(0, 0).g), 188, 1.5);
  Image<Rgba8> even = Striped(100, 110);
  MakeTintable(0.22, even);
  EXPECT_NEAR(static_cast<double>(even(4, 0).g) / even(0, 0).g, 1.1, 0.01);
}

TEST(Picture, PlainClothHasNoPrint) {
  Image<Rgba8> image = Striped(188, 20);
  MakePlain(0.12, image);
  EXPECT_EQ(image(0, 0).g, 188);
  EXPECT_GT(image(4, 0).g, 188 * std::exp(-0.13));
}

TEST(Picture, WhatTheMapLeavesFreeIsFilledFromBesides) {
  Image<Rgba8> image = Striped(0, 0);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 32; ++x) image(x, y) = {200, 50, 20, 255};
  }
  FillAround({{Vec2f{0, 0}, Vec2f{0.5f, 0}, Vec2f{0.5f, 1}}, {Vec2f{0, 0}, Vec2f{0.5f, 1}, Vec2f{0, 1}}}, image);
  for (const Rgba8& p : image.pixels()) {
    EXPECT_NEAR(p.r, 200, 1);
    EXPECT_NEAR(p.g, 50, 1);
  }
}

}  // namespace
}  // namespace airsim360::bake

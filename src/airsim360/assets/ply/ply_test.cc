#include "airsim360/assets/ply/ply.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "airsim360/assets/importing/scene_assembly.h"
#include "airsim360/assets/test_text.h"
#include "airsim360/base/error.h"
#include "airsim360/image/codecs.h"

namespace airsim360::internal {
namespace {

const ResourceLoader kNothing = [](const std::string&) { return std::optional<Bytes>(); };

ImportedFile ReadPlyText(const std::string& text) { return ReadPly("a.ply", AsBytes(text), kNothing); }

std::string PlyError(const std::string& text) {
  try {
    ReadPlyText(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// The same model in each of the three formats: numbers are appended as their types say.
class PlyText {
 public:
  PlyText(std::string format, const std::string& header)
      : format_(std::move(format)), text_("ply\nformat " + format_ + " 1.0\n" + header + "end_header\n") {}
  template <class T>
  PlyText& Add(T value) {
    if (format_ == "ascii") {
      text_ += std::to_string(value) + (++count_ % 3 == 0 ? "\r\n" : " ");
      return *this;
    }
    std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
    if (format_ == "binary_big_endian") std::reverse(raw.begin(), raw.end());
    text_ += raw;
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string format_, text_;
  int count_ = 0;
};

constexpr const char* kFormats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

// A square with a confidence to skip and an element to skip, and a pentagon that is not convex.
std::string Shapes(const char* format) {
  PlyText ply(
      format,
      "comment made by hand\nelement vertex 9\nproperty float x\nproperty double y\nproperty short z\nproperty uchar confidence\n"
      "element face 2\nproperty list uchar int vertex_indices\nproperty ushort flags\nelement extra 2\nproperty list uint8 float32 numbers\n");
  const double corners[9][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {4, 0}, {4, 2}, {3, 0.5}, {2, 2}};
  for (const auto& [x, y] : corners) ply.Add(static_cast<float>(x)).Add(y).Add(int16_t{-3}).Add(uint8_t{200});
  ply.Add(uint8_t{4});
  for (int32_t i : {0, 1, 2, 3}) ply.Add(i);
  ply.Add(uint16_t{65535}).Add(uint8_t{5});
  for (int32_t i : {4, 5, 6, 7, 8}) ply.Add(i);
  ply.Add(uint16_t{1}).Add(uint8_t{0}).Add(uint8_t{2}).Add(1.5f).Add(-2.5f);
  return ply.text();
}

double Area(const Mesh& mesh) {
  double area = 0;
  for (const Vec3u& t : mesh.triangles)
    area += Cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]).z / 2;
  return area;
}

TEST(Ply, TheThreeFormatsGiveTheSameMesh) {
  const ImportedFile first = ReadPlyText(Shapes(kFormats[0]));
  ASSERT_EQ(first.meshes.size(), 1u);
  EXPECT_EQ(first.meshes[0].triangles.size(), 5u);
  EXPECT_DOUBLE_EQ(Area(first.meshes[0]), 1 + 2.5);  // shoelace formula of both outlines
  EXPECT_EQ(first.meshes[0].positions[0], (Vec3f{0, 0, -3}));
  for (const char* format : kFormats) {
    const ImportedFile file = ReadPlyText(Shapes(format));
    EXPECT_EQ(file.meshes[0].positions, first.meshes[0].positions) << format;
    EXPECT_EQ(file.meshes[0].triangles, first.meshes[0].triangles) << format;
  }
}

TEST(Ply, EveryCutOffFileIsAnErrorThatNamesThePlace) {
  for (const char* format : kFormats) {
    const std::string text = Shapes(format);
    for (size_t size = 0; size + 1 < text.size(); ++size) {
      const std::string error = PlyError(text.substr(0, size));
      // The last digits of an ASCII file may go unnoticed: what is left of the number is one too.
      if (std::string(format) == "ascii" && size > text.rfind('-')) continue;
      EXPECT_TRUE(Contains(error, {"a.ply:"})) << format << " " << size;
    }
  }
}

TEST(Ply, NormalsTextureCoordinatesColoursAndPicturesAreRead) {
  const std::string text =
      "ply\nformat ascii 1.0\ncomment TextureFile a b.png\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face 1\nproperty list uchar int vertex_index\nproperty list uchar float texcoord\nend_header\n"
      "0 0 0 0 0.6 0.8 255 0 0\n1 0 0 0 0.6 0.8 255 0 0\n0 1 0 0 0.6 0.8 255 0 0\n3 0 1 2 6 0 0 1 0.25 0.5 1\n";
  std::string asked;
  const ImportedFile file = ReadPly("a.ply", AsBytes(text), [&](const std::string& name) {
    asked = name;
    return std::optional<Bytes>(EncodePng(Image<Rgba8>(2, 2)));
  });
  EXPECT_EQ(asked, "a b.png");
  ASSERT_EQ(file.meshes[0].uvs.size(), 3u);
  EXPECT_EQ(file.meshes[0].uvs[1], (Vec2f{1, 0.75f}));  // v grows downwards here
  EXPECT_EQ(file.meshes[0].normals[0], (Vec3f{0, 0.6f, 0.8f}));
  ASSERT_EQ(file.materials.size(), 1u);
  EXPECT_EQ(file.materials[0].base_color, (Vec3f{1, 1, 1}));  // red is of the vertices
  EXPECT_EQ(file.meshes[0].colors, (std::vector<VertexColor>(3, {65535, 0, 0, 65535})));
  EXPECT_EQ(file.materials[0].base_color_texture, 0);
  EXPECT_EQ(file.textures.size(), 1u);
}

TEST(Ply, FacesMayStandBeforeTheirVertices) {
  for (const char* format : kFormats) {
    PlyText ply(
        format,
        "element note 1\nproperty list uchar short words\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n"
        "property float x\nproperty float y\nproperty float z\nelement tristrips 1\nproperty list uchar int vertex_indices\n");
    ply.Add(uint8_t{2}).Add(int16_t{7}).Add(int16_t{8});
    ply.Add(uint8_t{3});
    for (int32_t i : {0, 1, 2}) ply.Add(i);
    for (float c : {0.f, 0.f, 5.f, 2.f, 0.f, 5.f, 0.f, 2.f, 5.f}) ply.Add(c);
    ply.Add(uint8_t{3});
    for (int32_t i : {0, 1, 2}) ply.Add(i);
    const ImportedFile file = ReadPlyText(ply.text());
    ASSERT_EQ(file.meshes[0].triangles.size(), 2u) << format;
    EXPECT_DOUBLE_EQ(Area(file.meshes[0]), 4) << format;
  }
  EXPECT_TRUE(Contains(PlyError("ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\nproperty "
                                "float x\nproperty float y\nproperty float z\nend_header\n3 0 1 3\n0 0 0\n1 0 0\n0 1 0\n"),
                       {"a.ply:10", "face 0", "only 3 vertices, not a number 3"}));
}

TEST(Ply, TriangleStripsBeginAnewAtMinusOne) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0 1 0 0 0 1 0 1 1 0 5 0 0 6 0 0 5 1 0\n8 0 1 2 3 -1 4 5 6\n";
  const ImportedFile file = ReadPlyText(text);
  EXPECT_EQ(file.meshes[0].triangles.size(), 3u);
  EXPECT_DOUBLE_EQ(Area(file.meshes[0]), 1.5);  // all turn the same way
}

TEST(Ply, DamageNamesLineOrElement) {
  const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n",
                    faces = "element face 1\nproperty list uchar int vertex_indices\n";
  const auto ascii = [](const std::string& rest) { return "ply\nformat ascii 1.0\n" + rest; };
  EXPECT_TRUE(Contains(PlyError("plx\n"), {"a.ply: not a PLY file"}));
  EXPECT_TRUE(Contains(PlyError("ply\nformat cube 1.0\n"), {"a.ply:2:", "'cube'"}));
  EXPECT_TRUE(Contains(PlyError(ascii("element vertex -1\n")), {"a.ply:3:", "'-1'"}));
  EXPECT_TRUE(Contains(PlyError(ascii("property float x\n")), {"a.ply:3:", "before any element"}));
  EXPECT_TRUE(Contains(PlyError(ascii("element v 1\nproperty flot x\n")), {"a.ply:4:", "'flot'"}));
  EXPECT_TRUE(Contains(PlyError(ascii("element v 1\nproperty list float int x\n")), {"a.ply:4:", "whole number"}));
  EXPECT_TRUE(Contains(PlyError(ascii(vertices + faces)), {"a.ply:", "no end"}));
  const std::string header = ascii(vertices + faces + "end_header\n");
  EXPECT_TRUE(Contains(PlyError(header + "0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n"), {"a.ply:12:", "vertex 2", "'x'"}));
  EXPECT_TRUE(Contains(PlyError(header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), {"face 0", "only 3 vertices"}));
  EXPECT_TRUE(Contains(PlyError(header + "0 0 0\n1 0 0\n0 1 0\n200 0 1 2\n"), {"face 0", "list of 200"}));
  EXPECT_TRUE(Contains(PlyError(header + "0 0 0\n1 0 0\n0 1e30 0\n3 0 1 2\n"), {"vertex 2", "1e9"}));
  EXPECT_TRUE(Contains(PlyError(ascii("element vertex 99999999999999\nproperty float x\nend_header\n1\n")), {"cannot stand in"}));
  EXPECT_TRUE(Contains(PlyError(ascii(vertices + "end_header\n0 0 0 1 0 0 0 1 0\n")), {"3 points and no surface"}));
}

}  // namespace
}  // namespace airsim360::internal

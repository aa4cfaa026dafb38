// Compressed geometry against the same geometry uncompressed: encoded here with the libraries' own encoders.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "airsim360/assets/gltf/gltf_test_internal.h"
#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

using nlohmann::json;

// A wavy sheet of 8 x 8 points.
struct Sheet {
  static constexpr uint32_t kSide = 8;
  std::vector<float> positions;
  std::vector<uint32_t> indices;
  Sheet() {
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
      const auto x = static_cast<float>(i % kSide);
      const auto y = static_cast<float>(i / kSide);
      positions.insert(positions.end(), {x, y, std::sin(x * 1.3f + y)});
    }
    for (uint32_t y = 0; y + 1 < kSide; ++y) {
      for (uint32_t x = 0; x + 1 < kSide; ++x) {
        const uint32_t a = y * kSide + x;
        indices.insert(indices.end(), {a, a + 1, a + kSide, a + 1, a + kSide + 1, a + kSide});
      }
    }
  }
};

// A document with one mesh whose position and index accessors stand at 0 and 1.
void AddMeshAndNode(GltfDocument& doc) {
  doc.json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}});
  doc.json["nodes"].push_back({{"mesh", 0}});
}

GltfDocument Plain(const Sheet& sheet) {
  GltfDocument doc;
  doc.AddAccessor(sheet.positions, 5126, "VEC3");
  doc.AddAccessor(sheet.indices, 5125, "SCALAR");
  AddMeshAndNode(doc);
  return doc;
}

GltfDocument Draco(const Sheet& sheet, int speed, int bits) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(sheet.indices.size() / 3));
  const int attribute = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const auto corner = [&](size_t i) { return &sheet.positions[3 * sheet.indices[i]]; };
  for (size_t f = 0; f < sheet.indices.size() / 3; ++f) {
    builder.SetAttributeValuesForFace(attribute, draco::FaceIndex(static_cast<uint32_t>(f)), corner(3 * f), corner(3 * f + 1),
                                      corner(3 * f + 2));
  }
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
  encoder.SetSpeedOptions(speed, speed);
  draco::EncoderBuffer encoded;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*builder.Finalize(), &encoded).ok());

  GltfDocument doc;
  const size_t view = doc.AddView(std::vector<char>(encoded.data(), encoded.data() + encoded.size()));
  doc.json["accessors"] = json::array({{{"componentType", 5126}, {"count", Sheet::kSide * Sheet::kSide}, {"type", "VEC3"}},
                                       {{"componentType", 5125}, {"count", sheet.indices.size()}, {"type", "SCALAR"}}});
  AddMeshAndNode(doc);
  doc.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  doc.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view},
                                                                                        {"attributes", {{"POSITION", 0}}}};
  return doc;
}

GltfDocument Meshopt(const Sheet& sheet) {
  const size_t vertices = sheet.positions.size() / 3;
  std::vector<unsigned char> v(meshopt_encodeVertexBufferBound(vertices, 12));
  v.resize(meshopt_encodeVertexBuffer(v.data(), v.size(), sheet.positions.data(), vertices, 12));
  std::vector<unsigned char> i(meshopt_encodeIndexBufferBound(sheet.indices.size(), vertices));
  i.resize(meshopt_encodeIndexBuffer(i.data(), i.size(), sheet.indices.data(), sheet.indices.size()));

  GltfDocument doc;
  doc.json["extensionsRequired"] = {"EXT_meshopt_compression"};
  doc.AddView(v);
  doc.AddView(i);
  const auto describe = [&](size_t view, size_t stride, size_t count, const char* mode) {
    json& object = doc.json["bufferViews"][view];
    object["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0}, {"byteOffset", object["byteOffset"]}, {"byteLength", object["byteLength"]}, {"byteStride", stride}, {"count", count},
        {"mode", mode}};
  };
  describe(0, 12, vertices, "ATTRIBUTES");
  describe(1, 4, sheet.indices.size(), "TRIANGLES");
  doc.json["accessors"] = json::array({{{"bufferView", 0}, {"componentType", 5126}, {"count", vertices}, {"type", "VEC3"}},
                                       {{"bufferView", 1}, {"componentType", 5125}, {"count", sheet.indices.size()}, {"type", "SCALAR"}}});
  AddMeshAndNode(doc);
  return doc;
}

// Triangles as sorted corner positions, so that two meshes can be compared whatever their order.
std::vector<std::array<float, 9>> SortedTriangles(const Mesh& mesh) {
  std::vector<std::array<float, 9>> out;
  for (Vec3u t : mesh.triangles) {
    std::array<uint32_t, 3> v = {t.x, t.y, t.z};
    const auto less = [&](uint32_t a, uint32_t b) {
      const Vec3f p = mesh.positions[a], q = mesh.positions[b];
      return std::tuple(std::round(p.x), std::round(p.z)) < std::tuple(std::round(q.x), std::round(q.z));
    };
    std::rotate(v.begin(), std::min_element(v.begin(), v.end(), less), v.end());
    std::array<float, 9> flat;
    for (int k = 0; k < 9; ++k) flat[k] = mesh.positions[v[k / 3]][k % 3];
    out.push_back(flat);
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
    const auto key = [](const auto& t) {
      std::array<int, 6> rounded;
      for (int k = 0; k < 3; ++k) {
        rounded[2 * k] = static_cast<int>(std::lround(t[3 * k]));
        rounded[2 * k + 1] = static_cast<int>(std::lround(t[3 * k + 2]));
      }
      return rounded;
    };
    return key(a) < key(b);
  });
  return out;
}

void ExpectSameShape(const GltfDocument& a, const GltfDocument& b, float tolerance) {
  const auto x = SortedTriangles(ReadText(a.Text()).meshes.at(0));
  const auto y = SortedTriangles(ReadText(b.Text()).meshes.at(0));
  ASSERT_EQ(x.size(), y.size());
  for (size_t i = 0; i < x.size(); ++i) {
    for (int k = 0; k < 9; ++k) ASSERT_NEAR(x[i][k], y[i][k], tolerance) << i;
  }
}

TEST(GltfCompression, DracoGivesTheShapeBackToItsQuantisation) {
  const Sheet sheet;
  // 12 bits over 7 m: steps of 1.7 mm. Speed 0 is edgebreaker coding, 10 sequential.
  ExpectSameShape(Plain(sheet), Draco(sheet, 0, 12), 7.0f / 4095);
  ExpectSameShape(Plain(sheet), Draco(sheet, 10, 12), 7.0f / 4095);
}

TEST(GltfCompression, MeshoptGivesTheShapeBackExactly) {
  const Sheet sheet;
  ExpectSameShape(Plain(sheet), Meshopt(sheet), 0);
}

TEST(GltfCompression, DamagedDracoBytesNeverCrash) {
  const Sheet sheet;
  const std::string good = Draco(sheet, 0, 12).Glb();
  const size_t start = good.find("DRACO");
  ASSERT_NE(start, std::string::npos);
  for (size_t i = start; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x55);
    try {
      ReadGltf("bad.glb", AsBytes(bad), kNoFiles);
    } catch (const InputError&) {
    }
  }
}

// The fuzzer's seeds are these documents: AIRSIM360_WRITE_SEEDS=1 writes them anew.
TEST(GltfCompression, FuzzerSeedsLoad) {
  const std::filesystem::path folder = "data/fuzz/gltf_fuzz";
  const Sheet sheet;
  if (std::getenv("AIRSIM360_WRITE_SEEDS")) {
    CreateWritableFolder(folder);
    WriteFileAtomically(folder / "plain.gltf", Plain(sheet).Text());
    WriteFileAtomically(folder / "draco0.glb", Draco(sheet, 0, 8).Glb());
    WriteFileAtomically(folder / "draco10.glb", Draco(sheet, 10, 8).Glb());
    WriteFileAtomically(folder / "meshopt.glb", Meshopt(sheet).Glb());
  }
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no seeds here";
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const Bytes bytes = ReadFile(file.path());
    EXPECT_NO_THROW(ReadGltf(file.path().string(), bytes, kNoFiles)) << file.path();
  }
}

}  // namespace
}  // namespace airsim360::internal

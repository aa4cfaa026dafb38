#include "airsim360/opening/world_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/opening/world_loader.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

fs::path Written(const std::string& text) {
  const fs::path file = fs::path(testing::TempDir()) / "lamps.yaml";
  WriteFileAtomically(file, text);
  return file;
}

std::string MessageOf(const std::string& text) {
  try {
    const fs::path file = Written(text);
    LampsOfWorldFile(file);
    LoadWorld({.world = file.string()});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Lamps, OfAWorldFileComeAfterEverythingElseAndShineWithTheirFlux) {
  const auto plain = LoadWorld({.world = "box_room"});
  const auto lit = LoadWorld(
      {.world =
           Written(
               "world: box_room\nlamps:\n  - {x: 1, y: 2, z: 3, lumens: 800, kelvin: 4000, radius: 0.2}\n  - {x: 2, y: 2, z: 3, always: true}\n")
               .string()});
  ASSERT_EQ(lit->entities.size(), plain->entities.size() + 2);
  for (size_t i = 0; i < plain->entities.size(); ++i) EXPECT_EQ(lit->entities[i].name, plain->entities[i].name);
  const Entity &first = lit->entities[lit->entities.size() - 2], &second = lit->entities.back();
  EXPECT_EQ(first.name, "lamp");
  EXPECT_EQ(second.name, "lamp 2");
  EXPECT_EQ(lit->tree[first.category].path, "furniture/lighting/lamp");
  EXPECT_NEAR(first.bounds.center().y, 2, 1e-3);
  EXPECT_NEAR(first.bounds.max.z - first.bounds.min.z, 0.4, 1e-3);
  // Luminous flux of a ball of uniform luminance L: pi L times its area.
  const Material& material = lit->materials[lit->materials.size() - 2];
  const double luminance = (0.2126 * material.emission.x + 0.7152 * material.emission.y + 0.0722 * material.emission.z) / kNit;
  EXPECT_NEAR(std::numbers::pi * luminance * 4 * std::numbers::pi * 0.2 * 0.2, 800, 8);
  EXPECT_TRUE(material.lamp);
  EXPECT_FALSE(lit->materials.back().lamp);
  EXPECT_EQ(LampsOfWorldFile(Written("world: nowhere.glb\n")).size(), 0u);
}

TEST(Lamps, MistakesAreNamed) {
  EXPECT_NE(MessageOf("world: box_room\nlamps:\n  - {x: 1, lumen: 3}\n").find("lamps.yaml:3"), std::string::npos);
  EXPECT_NE(MessageOf("world: box_room\nlamps:\n  - {kelvin: 1e308}\n").find("lamps.yaml:3"), std::string::npos);
  EXPECT_NE(MessageOf("world: box_room\nlamps:\n  - {x: 50, name: far}\n").find("'far' at 50.0"), std::string::npos);
  EXPECT_NE(MessageOf("world: box_room\nlamps:\n  - {z: -3}\n").find("outside of the world"), std::string::npos);
}

TEST(WorldFile, FillIsRefusedWhereThereIsNothingToFill) {
  EXPECT_NE(MessageOf("world: box_room\nfill: false\n").find("fill: it is for maps"), std::string::npos);
}

}  // namespace
}  // namespace airsim360

#include "airsim360/base/file_name.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

TEST(FileName, WhatPassesIsOnePlainFileOfItsFolder) {
  std::mt19937 random(1);
  int passed = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string name;
    for (size_t k = random() % 6; k > 0; --k) name += std::string_view("a./\0\n\x7f\x1f \xc3-", 10)[random() % 10];
    try {
      CheckFileName("name", name);
    } catch (const InputError&) {
      continue;
    }
    ++passed;
    const std::filesystem::path path = std::filesystem::path("folder") / name;
    EXPECT_EQ(path.lexically_normal().parent_path(), "folder") << name;
    EXPECT_EQ(path.filename(), name);
    // What the system is given is the whole of it.
    EXPECT_EQ(std::string(path.filename().c_str()), name);
  }
  EXPECT_GT(passed, 1000);
}

TEST(FileName, SaysWhatIsWrong) {
  const auto refusal = [](std::string_view name) {
    try {
      CheckFileName("file", name);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal("grid.binvox"), "");
  EXPECT_EQ(refusal("Kamera süd 1"), "");
  EXPECT_EQ(refusal(std::string_view("settings.json\0.binvox", 21)),
            "file: 'settings.json?.binvox' holds a control character: it becomes the name of a file");
  EXPECT_NE(refusal("../x").find("holds a '/'"), std::string::npos);
  EXPECT_NE(refusal(".profile").find("begins with a dot"), std::string::npos);
  EXPECT_NE(refusal("").find("empty"), std::string::npos);
  EXPECT_NE(refusal(std::string(201, 'a')).find("201 bytes"), std::string::npos);
}

TEST(FileName, ExtensionsAreToldInLowerCase) {
  EXPECT_EQ(LowerCaseExtension("some.dir/Sky.JPEG"), ".jpeg");
  EXPECT_EQ(LowerCaseExtension("some.dir/sky"), "");
}

}  // namespace
}  // namespace airsim360

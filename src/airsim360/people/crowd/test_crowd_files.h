// People files of a test's own, and a park where most of them live.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

#include <unistd.h>

#include "airsim360/base/error.h"
#include "airsim360/people/crowd/test_crowd.h"

namespace airsim360::internal {

/// A square with a few boxes, a lawn and two benches with back rests.
inline std::shared_ptr<const Scene> Park() {
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, 40, 30);
  ground.Floor("ground/grass", 40, 0, 50, 30);
  for (const float x : {8.0f, 20.0f, 30.0f}) ground.Box("furniture/planter/pot", {x, 14, 0}, {x + 2, 15, 0.8f});
  for (const float x : {10.0f, 25.0f}) ground.Seat("furniture/seating/bench/wood", x, 25, 1.8f);
  return ground.Build();
}

class CrowdFiles : public testing::Test {
 protected:
  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / ("crowd_" + std::to_string(::getpid()));
  void TearDown() override { std::filesystem::remove_all(folder_); }
  CrowdRequest File(const std::string& yaml, const std::string& xml = "") {
    if (!xml.empty()) WriteTestFile(folder_, "trees.xml", xml);
    CrowdRequest request;
    request.file = WriteTestFile(folder_, "people.yaml", yaml);
    return request;
  }
  std::string ErrorOf(const std::string& yaml, const std::string& xml = "") {
    try {
      const auto scene = Park();
      BuildCrowd(*scene, NavMesh::Build(*scene), File(yaml, xml));
    } catch (const InputError& error) {
      std::string text = error.what();
      const size_t at = text.find(folder_.string());
      return at == std::string::npos ? text : text.replace(at, folder_.string().size() + 1, "");
    }
    return "none";
  }
};

inline CrowdRequest Default(size_t n, uint64_t seed = 1) {
  CrowdRequest request;
  request.count = n;
  request.seed = seed;
  return request;
}

}  // namespace airsim360::internal

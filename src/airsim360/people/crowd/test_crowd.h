// A crowd on a small world, for tests: reserve people who are put where a test wants them.
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/people/crowd/crowd.h"
#include "airsim360/people/navigation/test_ground.h"

namespace airsim360::internal {

class TestCrowd {
 public:
  TestCrowd(std::shared_ptr<const Scene> scene, const CrowdRequest& request)
      : mesh(NavMesh::Build(*scene)), model(BuildCrowd(*scene, mesh, request)), state(StartCrowd(*model)) {}

  /// Steps until `seconds` have passed or `done()`; returns the time then.
  template <class Done>
  double Run(double seconds, const Done& done) {
    const int64_t end = state.t_ns + static_cast<int64_t>(seconds * 1e9);
    while (state.t_ns < end && !done()) StepCrowd(*model, state, kCrowdTickNs, drones, &events);
    return static_cast<double>(state.t_ns) * 1e-9;
  }
  double Run(double seconds) {
    return Run(seconds, [] { return false; });
  }
  void Do(PersonIndex person, const PersonAction& action) { CommandPerson(*model, state, person, action, &events); }
  const PersonState& operator[](PersonIndex person) const { return state.people[person]; }
  /// Smallest distance between two people who are in the world.
  double Closest() const {
    double closest = 1e9;
    for (size_t i = 0; i < state.people.size(); ++i)
      for (size_t k = 0; k < i; ++k)
        if (state.people[i].visible && state.people[k].visible)
          closest = std::min(closest, Norm(state.people[i].p_WP - state.people[k].p_WP));
    return closest;
  }
  size_t Count(CrowdEvent::Kind kind, const std::string& to = "", const std::string& text = "") const {
    size_t n = 0;
    for (const CrowdEvent& event : events)
      n += event.kind == kind && (to.empty() || event.to == to) && (text.empty() || event.text.find(text) != std::string::npos);
    return n;
  }

  std::shared_ptr<const NavMesh> mesh;
  std::shared_ptr<const CrowdModel> model;
  CrowdState state;
  std::vector<CrowdDrone> drones;
  std::vector<CrowdEvent> events;
};

/// A file of the test's own folder.
inline std::filesystem::path WriteTestFile(const std::filesystem::path& folder, const std::string& name, const std::string& text) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / name) << text;
  return folder / name;
}

inline CrowdRequest ReserveOf(size_t n) {
  CrowdRequest request;
  request.count = 0;
  request.reserve = n;
  return request;
}

}  // namespace airsim360::internal

// What `render` and `collect` share: opening a world and reporting what a run did.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "airsim360/app/commands.h"
#include "airsim360/dataset/collector.h"
#include "airsim360/opening/world_environment.h"
#include "airsim360/render/renderer.h"
#include "airsim360/sim/people/populate.h"
#include "airsim360/sim/step.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

/// A world ready to be rendered.
struct OpenedWorld {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const RayTracer> tracer;
  std::unique_ptr<Renderer> renderer;
  Environment environment;  ///< the world's own with what the flags say
  double load_ms = 0;       ///< building or importing the scene and its ray tracing structure
  std::shared_ptr<const SimPeople> people;  ///< null: nobody

  /// A simulation of it without drones.
  SimModel Model(int64_t dt_ns) const;
};
/// Seed and device are those of `globals`. Without `renders` there is no renderer: other processes have theirs.
OpenedWorld OpenWorld(const std::string& world, const GlobalOptions& globals, Tier tier,
                      const EnvironmentFlags& flags = {}, const PeopleRequest& people = {}, bool renders = true);

/// Prints what a run did: JSON or a few lines of text.
void ReportRun(const OpenedWorld& world, const DatasetSpec& spec, const CollectResult& result,
               const std::filesystem::path& out, bool json);

}  // namespace airsim360

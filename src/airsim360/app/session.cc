#include "airsim360/app/session.h"

#include <cstdio>

#include "airsim360/app/arguments.h"
#include "airsim360/app/world_flags.h"
#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/dataset/index.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/render/vulkan/choose_renderer.h"
#include "airsim360/sim/drone_bodies.h"

namespace airsim360 {

SimModel OpenedWorld::Model(int64_t dt_ns) const {
  SimModel model{.tracer = WithoutBodies(tracer, {}, people.get()), .dt_ns = dt_ns};
  model.people = people;
  return model;
}

OpenedWorld OpenWorld(const std::string& world, const GlobalOptions& globals, Tier tier,
                      const EnvironmentFlags& flags, const PeopleRequest& people, bool renders) {
  // Wrong flags are found before the world is loaded.
  ApplyFlags(flags, {});
  if (globals.gpu >= 0 && globals.device == "cpu") throw InputError("--gpu: --device cpu uses no GPU; leave one of them out");
  const LongTask building("building " + world);
  OpenedWorld opened;
  opened.scene = LoadWorld(RequestOf(world, globals));
  if (people.any()) {
    PopulatedScene populated = Populate(std::move(opened.scene), people);
    opened.scene = std::move(populated.scene);
    opened.people = std::move(populated.people);
  }
  opened.tracer = std::make_shared<const RayTracer>(opened.scene);
  opened.environment = ApplyFlags(flags, opened.scene->environment);
  if (renders)
    opened.renderer = MakeRenderer(opened.tracer, {.tier = tier, .environment = opened.environment},
                                   {globals.device, globals.gpu});
  opened.load_ms = 1e3 * building.seconds();
  return opened;
}

namespace {

// What is worth knowing of the people of a dataset; warns where hardly anybody is to be seen.
nlohmann::ordered_json ReportPeople(const OpenedWorld& world, const CollectResult& result, const std::filesystem::path& out,
                                    bool json) {
  const PeopleTotals totals = DatasetIndex(out, DatasetIndex::Mode::kRead).CountPeople();
  const size_t people = world.people->cast.size();
  if (!json) {
    std::printf("people: %lld of %zu have pixels, %lld of them %lld or more in some picture; %lld of %lld labelled views of a "
                "person have pixels\n",
                static_cast<long long>(totals.persons_seen), people, static_cast<long long>(totals.persons_large),
                static_cast<long long>(kLargePerson), static_cast<long long>(totals.views_seen),
                static_cast<long long>(totals.views));
  }
  // Fewer than one a frame, or nobody large enough to be recognised.
  if (totals.views_seen < result.frames || totals.persons_large == 0) {
    LogWarning("few people are in these pictures: leave out --route and --pose, which then are chosen near people, or have "
               "more with --people");
  }
  return {{"people_seen", totals.persons_seen},
          {"people_seen_100px", totals.persons_large},
          {"person_views", totals.views},
          {"person_views_seen", totals.views_seen}};
}

}  // namespace

void ReportRun(const OpenedWorld& world, const DatasetSpec& spec, const CollectResult& result,
               const std::filesystem::path& out, bool json) {
  // Means of the frames that this run wrote.
  const double written = result.written > 0 ? static_cast<double>(result.written) : 1;
  const double render_ms = result.render_ms / written, write_ms = result.write_ms / written;
  const double rendered_fps = render_ms > 0 ? 1000 / render_ms : 0;
  const double written_fps =
      result.wall_ms > 0 ? 1000 * static_cast<double>(result.written) / result.wall_ms : 0;
  const SceneCounts counts = world.scene->Count();
  const bool peopled = world.people && !world.people->refs.empty();
  if (json) {
    nlohmann::ordered_json report = {{"out", out.string()},
                                     {"world", spec.world},
                                     {"frames", result.frames},
                                     {"frames_written", result.written},
                                     {"already_complete", result.already_complete},
                                     {"render_ms", render_ms},
                                     {"write_ms", write_ms},
                                     {"load_ms", world.load_ms},
                                     {"frames_per_second", rendered_fps},
                                     {"frames_per_second_written", written_fps},
                                     {"rays", static_cast<uint64_t>(static_cast<double>(result.rays) / written + 0.5)},
                                     {"triangles", counts.instanced_triangles},
                                     {"entities", counts.entities},
                                     {"people", world.people ? world.people->cast.size() : 0},
                                     {"peak_rss_mib", PeakRssMib()}};
    if (peopled) report.update(ReportPeople(world, result, out, json));
    PrintJson(report);
    return;
  }
  if (result.already_complete) {
    std::printf("%s is complete already: %lld frames; nothing changed\n", out.c_str(),
                static_cast<long long>(result.frames));
    return;
  }
  std::printf(
      "%s: %lld frames (%lld written now), %.1f ms rendering a frame (%.2f frames/s), %.2f frames/s "
      "written\n",
      out.c_str(), static_cast<long long>(result.frames), static_cast<long long>(result.written), render_ms,
      rendered_fps, written_fps);
  if (peopled) ReportPeople(world, result, out, json);
  std::printf("contact sheet: %s\n", (out / "contact_sheet.png").c_str());
}

}  // namespace airsim360

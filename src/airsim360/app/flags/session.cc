#include "airsim360/app/flags/session.h"

#include <cstdio>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/world_flags.h"
#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/dataset/index.h"

namespace airsim360 {

StageOptions StageOptionsOf(const std::string& world, const GlobalOptions& globals, const EnvironmentFlags& environment,
                            const PeopleRequest& people, const TrafficRequest& traffic) {
  return {.world = RequestOf(world, globals),
          .environment = environment,
          .people = people,
          .traffic = traffic,
          .device = {globals.device, globals.gpu}};
}

CollectInput InputOf(Stage& stage, const DatasetSpec& spec, const Flight& flight, const std::filesystem::path& out,
                     std::string trajectory_json) {
  CollectInput input{spec, stage.scene(), flight, out, std::move(trajectory_json)};
  input.people = stage.people();
  input.tracer = stage.tracer();
  input.traffic = stage.traffic();
  return input;
}

namespace {

// What is worth knowing of the people of a dataset; warns where hardly anybody is to be seen.
nlohmann::ordered_json ReportPeople(const Stage& stage, const CollectResult& result, const std::filesystem::path& out, bool json) {
  const PeopleTotals totals = DatasetIndex(out, DatasetIndex::Mode::kRead).CountPeople();
  const size_t people = stage.people()->cast.size();
  if (!json) {
    std::printf(
        "people: %lld of %zu have pixels, %lld of them %lld or more in some picture; %lld of %lld labelled views of a "
        "person have pixels\n",
        static_cast<long long>(totals.persons_seen), people, static_cast<long long>(totals.persons_large),
        static_cast<long long>(kLargePerson), static_cast<long long>(totals.views_seen), static_cast<long long>(totals.views));
  }
  // Fewer than one a frame, or nobody large enough to be recognised.
  if (totals.views_seen < result.frames || totals.persons_large == 0) {
    LogWarning(
        "few people are in these pictures: leave out --route and --pose, which then are chosen near people, or have "
        "more with --people");
  }
  return {{"people_seen", totals.persons_seen},
          {"people_seen_100px", totals.persons_large},
          {"person_views", totals.views},
          {"person_views_seen", totals.views_seen}};
}

}  // namespace

void ReportRun(const Stage& stage, const DatasetSpec& spec, const CollectResult& result, const std::filesystem::path& out, bool json) {
  // Means of the frames that this run wrote.
  const double written = result.written > 0 ? static_cast<double>(result.written) : 1;
  const double render_ms = result.render_ms / written, write_ms = result.write_ms / written;
  const double rendered_fps = render_ms > 0 ? 1000 / render_ms : 0;
  const double written_fps = result.wall_ms > 0 ? 1000 * static_cast<double>(result.written) / result.wall_ms : 0;
  const SceneCounts counts = stage.scene().Count();
  const bool peopled = stage.people() && !stage.people()->refs.empty();
  if (json) {
    nlohmann::ordered_json report = {{"out", out.string()},
                                     {"world", spec.world},
                                     {"frames", result.frames},
                                     {"frames_written", result.written},
                                     {"already_complete", result.already_complete},
                                     {"render_ms", render_ms},
                                     {"write_ms", write_ms},
                                     {"load_ms", 1e3 * stage.load_seconds()},
                                     {"frames_per_second", rendered_fps},
                                     {"frames_per_second_written", written_fps},
                                     {"rays", static_cast<uint64_t>(static_cast<double>(result.rays) / written + 0.5)},
                                     {"triangles", counts.instanced_triangles},
                                     {"entities", counts.entities},
                                     {"people", stage.people() ? stage.people()->cast.size() : 0},
                                     {"peak_rss_mib", PeakRssMib()}};
    if (peopled) report.update(ReportPeople(stage, result, out, json));
    PrintJson(report);
    return;
  }
  if (result.already_complete) {
    std::printf("%s is complete already: %lld frames; nothing changed\n", out.c_str(), static_cast<long long>(result.frames));
    return;
  }
  std::printf(
      "%s: %lld frames (%lld written now), %.1f ms rendering a frame (%.2f frames/s), %.2f frames/s "
      "written\n",
      out.c_str(), static_cast<long long>(result.frames), static_cast<long long>(result.written), render_ms, rendered_fps, written_fps);
  if (peopled) ReportPeople(stage, result, out, json);
  std::printf("contact sheet: %s\n", (out / "contact_sheet.png").c_str());
}

}  // namespace airsim360

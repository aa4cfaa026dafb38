// One episode of panoramic vision-and-language navigation, as a line of episodes.jsonl holds it
// (docs/reference/vln_episode.schema.json).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/vln/episodes/template_syntax.h"
#include "airsim360/vln/episodes/world_things.h"

namespace airsim360 {

struct EpisodeSpec;

/// What a level panorama at the start shows of the goal's things.
struct SeenAtStart {
  int64_t pixels = 0;      ///< of kSeenWidth * kSeenWidth / 2
  double azimuth_deg = 0;  ///< of their middle, positive to the right; 0 if there are none
  double elevation_deg = 0;
  double range = 0;  ///< metres to the nearest of them
};
inline constexpr int kSeenWidth = 512;
/// Of these pixels, what a person needs to recognise a thing: of sixteen goals flown to by hand five were not recognised, with 6 to
/// 11 pixels where they were in sight at all (docs/internals/benchmarks/vln.md).
inline constexpr int64_t kInSight = 24;

/// A part of an instruction of several, before the last one.
struct EpisodePart {
  Viewpoint seen_from = {};  ///< the start, or the end of the part before in the direction of its flight
  Query query = {};
  std::vector<EntityId> entities = {};
  std::string name = {};
  GoalKind goal_kind = GoalKind::kNear;
  Vec3d goal = {};
  std::string proof = {};  ///< JSON
};

struct LanguageEpisode {
  std::string id, template_id, instruction, world;
  uint64_t world_seed = 0, seed = 0;  ///< `seed`: of gusts and of agents that draw
  WorldThings things = {};            ///< of the world that it was made in
  std::string weather = {};           ///< --weather of the pictures; "" = the world's own
  int64_t people = 0;
  Viewpoint start;
  std::vector<EpisodePart> before = {};  ///< parts of the instruction that come before what `query` asks for
  std::optional<Viewpoint> turn = {};    ///< where the instruction turns; with `before`, the end of the last of them
  Query query;
  std::vector<EntityId> entities;  ///< the one thing that answers the query; empty, as the query, where it was imported
  std::string name;                ///< of it
  GoalKind goal_kind = GoalKind::kNear;
  Vec3d goal;                      ///< the place to stop at
  std::vector<Vec3d> places = {};  ///< in rooms: other places near the thing that count as the goal too
  double radius = 20;              ///< metres around it that count as there, of protocol `ours`
  SeenAtStart seen;
  std::vector<Vec3d> ref;  ///< from start to goal, proved clear
  double geodesic_length = 0;
  std::string difficulty, split;
  std::string proof = {};   ///< JSON
  std::string source = {};  ///< JSON: the form that it was imported from, and its record there
};

/// As a navigation task, with the radius of the episode.
EpisodeSpec SpecOf(const LanguageEpisode& episode);
/// Whether it has a query, so that there is something to prove.
bool IsBound(const LanguageEpisode& episode);
/// One line, without its end.
std::string EpisodeLine(const LanguageEpisode& episode);
/// InputError "FILE:LINE.field: …".
LanguageEpisode ParseEpisodeLine(const std::string& line, const std::string& where);
/// All of a file. InputError for one that is none, holds none, more than 1,000,000, or an id twice.
std::vector<LanguageEpisode> ReadEpisodes(const std::filesystem::path& file);

}  // namespace airsim360

#include "airsim360/tasks/agent_server/agent_answers.h"

#include <cmath>

#include "airsim360/base/base64.h"
#include "airsim360/image/codecs.h"
#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

constexpr float kClearanceReach = 20;  // metres up to which it is measured

// Direction to a place in the level frame of a heading, degrees.
Answer DirectionTo(Vec3d p_W, const RigidTransform& X_WB) {
  const Vec3d way = p_W - X_WB.p;
  const double level = std::hypot(way.x, way.y);
  const double azimuth = std::remainder(HeadingOfBody(X_WB) - std::atan2(way.y, way.x), 2 * std::numbers::pi);
  return {{"azimuth_deg", level > 0 ? azimuth * kRadian : 0}, {"elevation_deg", std::atan2(way.z, level) * kRadian}};
}

Answer CollisionOf(Episode& episode) {
  const Vehicle& vehicle = episode.vehicle();
  const CollisionInfo& c = vehicle.collision;
  Answer answer = {{"count", c.count}, {"touching", vehicle.touching}};
  if (c.count > 0) {
    answer["t"] = 1e-9 * static_cast<double>(c.t_ns);
    answer["p"] = VectorOf(c.p_W);
    answer["impact_speed"] = c.impact_speed;
    answer["entity"] = c.entity == kNoEntity ? "" : episode.world().scene().entity(c.entity).name;
  }
  return answer;
}

Answer PictureOf(const Image<Rgb8>& image, int quality) {
  return {{"width", image.width()}, {"height", image.height()}, {"format", "jpeg"}, {"data", Base64(JpegOf(image, quality))}};
}

}  // namespace

Answer VectorOf(Vec3d v) { return {v.x, v.y, v.z}; }

std::string JpegOf(const Image<Rgb8>& image, int quality) { return std::string(AsText(EncodeJpeg(image, quality))); }

Answer GridOf(const RangeGrid& grid) {
  Answer rows = Answer::array();
  for (int row = 0; row < grid.rows; ++row) {
    Answer values = Answer::array();
    for (int column = 0; column < grid.columns; ++column) {
      const float range = grid.range[static_cast<size_t>(row * grid.columns + column)];
      values.push_back(range > 0 ? Answer(range) : Answer(nullptr));
    }
    rows.push_back(std::move(values));
  }
  return {{"rows", grid.rows}, {"columns", grid.columns}, {"range", std::move(rows)}};
}

Answer ScoreOf(const Episode& episode) {
  const EpisodeScore score = episode.Score();
  return {{"success", score.success},
          {"oracle_success", score.oracle_success},
          {"navigation_error", score.navigation_error},
          {"path_length", score.path_length},
          {"shortest_length", score.shortest_length},
          {"shortest_is_straight", score.shortest_is_straight},
          {"spl", score.spl},
          {"ndtw", score.ndtw}};
}

Answer SpecOf(const Episode& episode) {
  const EpisodeSpec& spec = episode.spec();
  return {{"instruction", spec.instruction},
          {"start", {{"p", VectorOf(episode.start())}, {"yaw_deg", spec.start_yaw * kRadian}}},
          {"goal", spec.tells_goal ? VectorOf(episode.goal()) : Answer(nullptr)},
          {"seed", spec.seed},
          {"drone", spec.drone},
          {"success", {{"rule", kSuccessRuleNames[static_cast<int>(spec.success)]}, {"radius", episode.success_radius()}}},
          {"speed", spec.speed},
          {"limits", {{"max_steps", spec.max_steps}, {"max_seconds", spec.max_seconds}, {"end_on_collision", spec.end_on_collision}}}};
}

Answer ObservationOf(Episode& episode, const ObserveRequest& request) {
  const Kinematics& motion = episode.vehicle().motion;
  const RigidTransform& X_WB = motion.X_WB;
  const Quaternion q = ToQuaternion(X_WB.R);
  Answer answer = {{"step", episode.steps()},
                   {"t", episode.seconds()},
                   {"done", episode.end() != EpisodeEnd::kRunning},
                   {"end", kEpisodeEndNames[static_cast<int>(episode.end())]},
                   {"pose", {{"p", VectorOf(X_WB.p)}, {"q_wxyz", {q.w, q.x, q.y, q.z}}, {"yaw_deg", HeadingOfBody(X_WB) * kRadian}}},
                   {"velocity", {{"v", VectorOf(motion.v_WB)}, {"w", VectorOf(motion.w_WB_B)}}},
                   {"collision", CollisionOf(episode)},
                   {"clearance", episode.world().stage().solid()->Clearance(VecCast<float>(X_WB.p), kClearanceReach)},
                   {"distance_to_goal", nullptr},
                   {"goal_direction", nullptr}};
  if (episode.spec().tells_goal) {
    answer["distance_to_goal"] = episode.distance_to_goal();
    answer["goal_direction"] = DirectionTo(episode.goal(), X_WB);
  }
  if (request.grid) answer["range_grid"] = GridOf(episode.world().Grid(X_WB, request.grid->rows, request.grid->columns, episode.moved()));
  if (const auto& panorama = request.panorama) {
    answer["panorama"] = PictureOf(episode.world().Panorama(X_WB, panorama->width, panorama->frame, episode.moved()), panorama->quality);
  }
  if (!request.views.empty()) {
    Answer views = Answer::array();
    for (const ViewRequest& v : request.views) {
      views.push_back(PictureOf(episode.world().View(X_WB, v.azimuth, v.elevation, v.fov, v.width, v.height, episode.moved()), v.quality));
      views.back()["azimuth_deg"] = v.azimuth * kRadian;
      views.back()["elevation_deg"] = v.elevation * kRadian;
      views.back()["fov_deg"] = v.fov * kRadian;
    }
    answer["views"] = std::move(views);
  }
  return answer;
}

std::string TextOf(const Answer& answer) { return answer.dump(-1, ' ', false, Answer::error_handler_t::replace); }

std::string ErrorBody(const std::string& field, const std::string& message, const std::string& nearest) {
  Answer error = {{"message", message}};
  if (!field.empty()) error["field"] = field;
  if (!nearest.empty()) error["nearest"] = nearest;
  return TextOf({{"error", std::move(error)}});
}

}  // namespace airsim360::internal

// Episodes as the JSON that agents are answered with. For the .cc files of this module alone.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "airsim360/tasks/agent_server/agent_request.h"

namespace airsim360::internal {

using Answer = nlohmann::ordered_json;

/// Everything an agent may know of this instant, with the pictures asked for.
Answer ObservationOf(Episode& episode, const ObserveRequest& request);
Answer ScoreOf(const Episode& episode);
/// The task: instruction, start, goal, limits.
Answer SpecOf(const Episode& episode);
Answer GridOf(const RangeGrid& grid);
Answer VectorOf(Vec3d v);
std::string JpegOf(const Image<Rgb8>& image, int quality);
/// {"error": …}
std::string ErrorBody(const std::string& field, const std::string& message, const std::string& nearest);
/// As text; a client's bytes that are no UTF-8 are replaced.
std::string TextOf(const Answer& answer);

}  // namespace airsim360::internal

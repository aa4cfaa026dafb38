// What one client, and all of them together, can take of the server. docs/guide/airsim_server.md has the same as a table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// Of one answer. A panorama of 8192 x 4096 as the floats of a stock client (160 MiB) and its colours (96 MiB) fit, and so does
/// every picture that is alone in its call but for 8192 x 8192 of flow.
inline constexpr uint64_t kMostReplyBytes = uint64_t{320} << 20;

/// std::invalid_argument with the bytes asked for, the limit and `help` if an answer of so many bytes is too large. To be asked
/// before memory is taken for it.
void CheckReplyBytes(uint64_t bytes, std::string_view help);

/// std::invalid_argument "latitude: 123 is not in -90 … 90 degrees; the nearest is 90" for a place that is
/// not on the Earth. Longitudes of -360 … 360 are taken, as some clients count from 0 and some from -180.
void CheckPlaceOnEarth(double latitude, double longitude);

/// Fastest state of a vehicle that may be set, m/s and rad/s.
inline constexpr double kFastestState = 1000;
/// std::invalid_argument naming the velocity, its size, the limit and the nearest velocity of the same
/// direction.
void CheckVelocity(std::string_view name, Vec3d velocity, std::string_view unit);

}  // namespace airsim360

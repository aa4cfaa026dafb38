// What one client, and all of them together, can take of the server. docs/guide/airsim_server.md has the same as a table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace airsim360 {

/// Of one answer. A panorama of 8192 x 4096 as the floats of a stock client (160 MiB) and its colours (96 MiB) fit, and so does
/// every picture that is alone in its call but for 8192 x 8192 of flow.
inline constexpr uint64_t kMostReplyBytes = uint64_t{320} << 20;

/// std::invalid_argument with the bytes asked for, the limit and `help` if an answer of so many bytes is too large. To be asked
/// before memory is taken for it.
void CheckReplyBytes(uint64_t bytes, std::string_view help);

}  // namespace airsim360

// Tables, JSON, LaTeX and lists as the sentences that they stand for.
#pragma once

#include <string>
#include <string_view>

namespace airsim360::internal {

/// "| Mass | 1.2 | kg |", {"mass_kg": 1.2}, "\SI{1.2}{\kilo\gram}", "<mass unit="kg">1.2</mass>", "Mass ..... 1.2 kg" all
/// become "Mass: 1.2 kg"; the rows of a table are lines. Text without such signs stays as it is.
std::string WithoutMarkup(std::string_view text);

}  // namespace airsim360::internal

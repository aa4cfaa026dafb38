// Version of the program, written into every dataset.
#pragma once

namespace airsim360 {

/// Same as the project version of CMakeLists.txt (a test compares them).
inline constexpr char kVersion[] = "0.1.0";

}  // namespace airsim360

// Arrays of numbers as files hold them. InputError naming the file for damage, kinds of numbers that are none, and sizes beyond kMaxPixels.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360 {

struct NumberArray {
  std::vector<int64_t> shape;  ///< each at least 1
  std::vector<double> values;  ///< the last index runs fastest
};

/// NumPy's format (NEP 1), versions 1 to 3, either byte order and either order of indices: integers of 8 to 64 bits, floats of 16 to 64, truth
/// values.
NumberArray DecodeNpy(std::span<const std::byte> bytes, std::string_view name);

}  // namespace airsim360

// NPZ files (a ZIP of NumPy arrays), written without compression: numpy.load reads them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360 {

/// Collects arrays, C order, little endian. The bytes are a pure function of what was added.
class NpzWriter {
 public:
  /// InputError if the product of `shape` is not the number of values.
  void Add(std::string_view name, std::span<const double> values, std::vector<size_t> shape);
  void Add(std::string_view name, std::span<const int64_t> values, std::vector<size_t> shape);
  /// The whole file.
  std::string Finish();

 private:
  void AddArray(std::string_view name, const char* type, const void* data, size_t count, const std::vector<size_t>& shape);
  struct Entry {
    std::string name;
    uint32_t crc, size, offset;
  };
  std::string bytes_;
  std::vector<Entry> entries_;
};

/// An array of an NPZ file.
struct NpzArray {
  std::string name;
  std::vector<size_t> shape;
  std::vector<double> values;  ///< integers too
};

/// Reads what NpzWriter wrote (stored entries, <f8 and <i8). InputError naming what is wrong otherwise.
std::vector<NpzArray> ReadNpz(std::string_view bytes, std::string_view name);

}  // namespace airsim360

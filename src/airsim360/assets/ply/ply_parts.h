// The parts of the PLY reader: what its header says, and the numbers after it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "airsim360/assets/imported.h"
#include "airsim360/base/error.h"

namespace airsim360::internal {

enum class PlyFormat { kAscii, kLittle, kBig };
enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };
inline constexpr size_t kPlyTypeBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;
  std::optional<PlyType> count;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::vector<std::string> textures;
  size_t size = 0;  ///< in bytes
  int64_t lines = 0;
};

/// InputError "file:line: …" for damage.
PlyHeader ReadPlyHeader(const std::string& file, std::string_view text);

/// Numbers after the header.
class PlyValues {
 public:
  PlyValues(const std::string& file, const PlyHeader& header, std::span<const std::byte> bytes)
      : file_(file), format_(header.format), rest_(bytes.subspan(header.size)), line_(header.lines + 1) {}

  /// `what` is being read, for messages.
  void Enter(const std::string& what, uint64_t index) { what_ = &what, index_ = index; }
  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(file_ + ":" + (format_ == PlyFormat::kAscii ? std::to_string(line_) + ":" : "") + " " + *what_ + " " +
                     std::to_string(index_) + ": " + what);
  }
  size_t left() const { return rest_.size(); }
  bool ascii() const { return format_ == PlyFormat::kAscii; }

  /// Where reading is, to go back to.
  struct Mark {
    std::span<const std::byte> rest;
    int64_t line = 0;
  };
  Mark mark() const { return {rest_, line_}; }
  void Return(const Mark& mark) { rest_ = mark.rest, line_ = mark.line; }

  /// The next number; a type counts in binary data alone.
  double Next(PlyType type);

 private:
  double NextText();

  const std::string& file_;
  PlyFormat format_;
  std::span<const std::byte> rest_;
  int64_t line_;
  const std::string* what_ = nullptr;
  uint64_t index_ = 0;
};

}  // namespace airsim360::internal

// Values to bytes and back, for files of this very program: no versions, no byte order. One list of fields
// serves both ways: call an archive with all of them, in the same order.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360 {

/// Types that are kept as their memory: numbers, and structs of numbers without padding or pointers.
template <class T>
concept PlainValue = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

/// Appends to `bytes()`. Takes plain values, strings, and vectors of plain values.
class ArchiveWriter {
 public:
  ArchiveWriter() = default;
  /// With room for `expected` bytes, so that long runs are not copied while it grows.
  explicit ArchiveWriter(size_t expected) { bytes_.reserve(expected); }
  template <class... Values>
  void operator()(const Values&... values) {
    (Put(values), ...);
  }
  /// A run whose length the reader knows.
  template <PlainValue T>
  void Raw(std::span<const T> run) {
    const auto bytes = std::as_bytes(run);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  /// Calls body(element) for each; an element may be of any type.
  template <class T, class Body>
  void Each(const std::vector<T>& list, const Body& body) {
    Put(list.size());
    for (const T& element : list) body(element);
  }
  const Bytes& bytes() const { return bytes_; }
  Bytes Take() { return std::move(bytes_); }

 private:
  template <PlainValue T>
  void Put(const T& value) {
    Raw(std::span<const T>(&value, 1));
  }
  void Put(const std::string& text) {
    Put(text.size());
    Raw(std::span<const char>(text));
  }
  template <PlainValue T, class Allocator>
  void Put(const std::vector<T, Allocator>& list) {
    Put(list.size());
    Raw(std::span<const T>(list));
  }

  Bytes bytes_;
};

/// Reads what an ArchiveWriter wrote; InputError where the bytes end too early. Memory is taken only for what
/// is there. A copy goes on reading where this one is.
class ArchiveReader {
 public:
  explicit ArchiveReader(std::span<const std::byte> bytes) : rest_(bytes) {}
  template <class... Values>
  void operator()(Values&... values) {
    (Get(values), ...);
  }
  template <PlainValue T>
  void Raw(std::span<T> run) {
    if (run.empty()) return;
    const auto from = Take(run.size_bytes());
    std::memcpy(run.data(), from.data(), from.size());
  }
  template <class T, class Body>
  void Each(std::vector<T>& list, const Body& body) {
    list.resize(Count(1));
    for (T& element : list) body(element);
  }
  /// InputError unless `count` elements of `size` bytes can still come.
  void Expect(uint64_t count, size_t size) const {
    if (count > rest_.size() / size) throw InputError("archive is cut off");
  }
  /// Passes over a string or a vector of T.
  template <PlainValue T>
  void SkipList() {
    Take(Count(sizeof(T)) * sizeof(T));
  }
  bool done() const { return rest_.empty(); }

 private:
  std::span<const std::byte> Take(size_t size) {
    Expect(size, 1);
    const auto taken = rest_.first(size);
    rest_ = rest_.subspan(size);
    return taken;
  }
  size_t Count(size_t element_size) {
    size_t count = 0;
    Get(count);
    Expect(count, element_size);
    return count;
  }
  template <PlainValue T>
  void Get(T& value) {
    Raw(std::span<T>(&value, 1));
  }
  void Get(std::string& text) {
    text.resize(Count(1));
    Raw(std::span<char>(text));
  }
  template <PlainValue T, class Allocator>
  void Get(std::vector<T, Allocator>& list) {
    list.resize(Count(sizeof(T)));
    Raw(std::span<T>(list));
  }

  std::span<const std::byte> rest_;
};

}  // namespace airsim360

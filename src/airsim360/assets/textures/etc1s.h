// ETC1S pictures in BasisLZ: codebooks that all images of a container share, and slices that name their entries.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace airsim360::internal {

/// Codes of up to 16 bits by the lengths of their symbols, as DEFLATE numbers them.
class HuffmanTable {
 public:
  HuffmanTable() = default;
  /// false for lengths that are no complete code (one symbol alone may be incomplete).
  bool Build(const std::vector<uint8_t>& lengths);
  bool empty() const { return symbols_.empty(); }

 private:
  friend class BitReader;
  std::array<uint32_t, 17> counts_{};
  std::vector<uint16_t> symbols_;  // by length, then by number
};

/// Bits of a stream, lowest of each byte first; zeros after its end.
class BitReader {
 public:
  /// `where` starts the messages of InputErrors and outlives the reader.
  BitReader(std::span<const std::byte> bytes, const std::string& where) : bytes_(bytes), where_(where) {}
  uint32_t Bits(int count);
  uint32_t Symbol(const HuffmanTable& table);
  HuffmanTable Table();
  /// Groups of `chunk` bits, lowest first, each with a bit that says whether more follow.
  uint32_t Chunks(int chunk);
  [[noreturn]] void Fail(const std::string& what) const;

 private:
  std::span<const std::byte> bytes_;
  const std::string& where_;
  uint64_t at_ = 0;
};

/// The shared part of a container.
class Etc1sCodebooks {
 public:
  Etc1sCodebooks(std::span<const std::byte> endpoints, uint32_t endpoint_count, std::span<const std::byte> selectors,
                 uint32_t selector_count, std::span<const std::byte> tables, const std::string& where);

  /// Pixels (r, g, b) of a slice, row by row, `columns` x `rows` blocks of 4 x 4. InputError for damage.
  std::vector<std::array<uint8_t, 3>> Decode(std::span<const std::byte> slice, uint32_t columns, uint32_t rows) const;

 private:
  struct Endpoint {
    std::array<uint8_t, 3> color5;
    uint8_t intensity;
  };
  using Selector = std::array<uint8_t, 4>;  // a byte a row, two bits a pixel

  struct SliceReader;
  void ReadEndpoints(BitReader bits, uint32_t count);
  void ReadSelectors(BitReader bits, uint32_t count);
  static std::array<std::array<uint8_t, 3>, 4> ColorsOf(const Endpoint& endpoint);

  const std::string& where_;
  std::vector<Endpoint> endpoints_;
  std::vector<Selector> selectors_;
  HuffmanTable predictions_, endpoint_deltas_, selector_symbols_, runs_;
  uint32_t history_size_ = 0;
};

}  // namespace airsim360::internal

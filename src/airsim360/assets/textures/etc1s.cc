#include "airsim360/assets/textures/etc1s.h"

#include <algorithm>
#include <utility>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr int kLongestCode = 16;

// Distances of the four tones of a block from its colour, by intensity (ETC1).
constexpr int kTones[8][4] = {{-8, -2, 2, 8},     {-17, -5, 5, 17},   {-29, -9, 9, 29},     {-42, -13, 13, 42},
                              {-60, -18, 18, 60}, {-80, -24, 24, 80}, {-106, -33, 33, 106}, {-183, -47, 47, 183}};

// Where the endpoint of a block comes from.
enum Prediction : uint32_t { kLeft, kUpper, kUpperLeft, kDelta };
constexpr uint32_t kRepeatPrediction = 256;
constexpr uint32_t kLeastRun = 3, kLongRun = 63;

}  // namespace

bool HuffmanTable::Build(const std::vector<uint8_t>& lengths) {
  counts_ = {};
  uint32_t used = 0;
  uint64_t covered = 0;
  for (uint8_t length : lengths) {
    if (length > kLongestCode) return false;
    if (length == 0) continue;
    ++counts_[length];
    ++used;
    covered += uint64_t{1} << (kLongestCode - length);
  }
  if (used == 0 || covered > (1u << kLongestCode) || (covered < (1u << kLongestCode) && used != 1)) return false;
  std::array<uint32_t, kLongestCode + 2> first{};
  for (size_t length = 1; length <= kLongestCode; ++length) first[length + 1] = first[length] + counts_[length];
  symbols_.resize(used);
  for (size_t i = 0; i < lengths.size(); ++i) {
    if (lengths[i] != 0) symbols_[first[lengths[i]]++] = static_cast<uint16_t>(i);
  }
  return true;
}

void BitReader::Fail(const std::string& what) const { throw InputError(where_ + ": " + what); }

uint32_t BitReader::Bits(int count) {
  uint32_t value = 0;
  for (int k = 0; k < count; ++k, ++at_) {
    const uint64_t byte = at_ / 8;
    if (byte < bytes_.size()) value |= (std::to_integer<uint32_t>(bytes_[byte]) >> (at_ % 8) & 1u) << k;
  }
  // Encoders may leave out what is zero at the end; much beyond it is damage.
  if (at_ > uint64_t{bytes_.size()} * 8 + 64) Fail("compressed data cut short");
  return value;
}

uint32_t BitReader::Symbol(const HuffmanTable& table) {
  uint32_t code = 0, first = 0, index = 0;
  for (size_t length = 1; length <= kLongestCode; ++length) {
    code |= Bits(1);
    const uint32_t count = table.counts_[length];
    if (code < first + count) return table.symbols_[index + (code - first)];
    index += count;
    first = (first + count) << 1;
    code <<= 1;
  }
  Fail("a code that stands for nothing");
}

uint32_t BitReader::Chunks(int chunk) {
  uint32_t value = 0;
  for (int shift = 0; shift < 32; shift += chunk) {
    const uint32_t bits = Bits(chunk + 1);
    value |= (bits & ((1u << chunk) - 1)) << shift;
    if (bits >> chunk == 0) break;
  }
  return value;
}

HuffmanTable BitReader::Table() {
  // Lengths of the codes of lengths, in this order; 17 and 18 are runs of zeros, 19 and 20 of the last length.
  constexpr std::array<uint8_t, 21> kOrder = {17, 18, 19, 20, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15, 16};
  HuffmanTable table;
  const uint32_t count = Bits(14);
  if (count == 0) return table;
  const uint32_t codes = Bits(5);
  if (codes < 1 || codes > kOrder.size()) Fail("a damaged table of codes");
  std::vector<uint8_t> lengths(kOrder.size());
  for (uint32_t i = 0; i < codes; ++i) lengths[kOrder[i]] = static_cast<uint8_t>(Bits(3));
  HuffmanTable of_lengths;
  if (!of_lengths.Build(lengths)) Fail("a damaged table of codes");
  lengths.clear();
  while (lengths.size() < count) {
    const uint32_t symbol = Symbol(of_lengths);
    const auto run = [&](int bits, uint32_t least) { return Bits(bits) + least; };
    if (symbol <= 16) {
      lengths.push_back(static_cast<uint8_t>(symbol));
    } else if (symbol <= 18) {
      lengths.resize(lengths.size() + (symbol == 17 ? run(3, 3) : run(7, 11)), 0);
    } else {
      if (lengths.empty() || lengths.back() == 0) Fail("a damaged table of codes");
      lengths.resize(lengths.size() + (symbol == 19 ? run(2, 3) : run(7, 7)), lengths.back());
    }
  }
  if (lengths.size() != count || !table.Build(lengths)) Fail("a damaged table of codes");
  return table;
}

Etc1sCodebooks::Etc1sCodebooks(std::span<const std::byte> endpoints, uint32_t endpoint_count, std::span<const std::byte> selectors,
                               uint32_t selector_count, std::span<const std::byte> tables, const std::string& where)
    : where_(where) {
  BitReader bits(tables, where);
  if (endpoint_count == 0 || selector_count == 0) bits.Fail("empty codebooks");
  ReadEndpoints(BitReader(endpoints, where), endpoint_count);
  ReadSelectors(BitReader(selectors, where), selector_count);
  predictions_ = bits.Table();
  endpoint_deltas_ = bits.Table();
  selector_symbols_ = bits.Table();
  runs_ = bits.Table();
  history_size_ = bits.Bits(13);
  if (predictions_.empty() || endpoint_deltas_.empty() || selector_symbols_.empty() || runs_.empty() || history_size_ == 0)
    bits.Fail("a table of codes is missing");
}

void Etc1sCodebooks::ReadEndpoints(BitReader bits, uint32_t count) {
  // Differences of channels are coded by how large the channel was before.
  std::array<HuffmanTable, 3> deltas = {bits.Table(), bits.Table(), bits.Table()};
  const HuffmanTable intensities = bits.Table();
  if (deltas[0].empty() || deltas[1].empty() || deltas[2].empty() || intensities.empty()) bits.Fail("a table of codes is missing");
  const bool grey = bits.Bits(1) != 0;
  Endpoint last{{16, 16, 16}, 0};
  for (uint32_t i = 0; i < count; ++i) {
    last.intensity = static_cast<uint8_t>((last.intensity + bits.Symbol(intensities)) & 7);
    for (size_t c = 0; c < (grey ? 1u : 3u); ++c) {
      const uint8_t before = last.color5[c];
      last.color5[c] = static_cast<uint8_t>((before + bits.Symbol(deltas[before <= 9 ? 0 : before <= 21 ? 1 : 2])) & 31);
    }
    if (grey) last.color5[1] = last.color5[2] = last.color5[0];
    endpoints_.push_back(last);
  }
}

void Etc1sCodebooks::ReadSelectors(BitReader bits, uint32_t count) {
  if (bits.Bits(1) != 0 || bits.Bits(1) != 0) bits.Fail("codebooks outside the file are not read");
  const bool raw = bits.Bits(1) != 0;
  HuffmanTable deltas;
  if (!raw) deltas = bits.Table();
  if (!raw && count > 1 && deltas.empty()) bits.Fail("a table of codes is missing");
  Selector last{};
  for (uint32_t i = 0; i < count; ++i) {
    for (uint8_t& row : last) row = raw || i == 0 ? static_cast<uint8_t>(bits.Bits(8)) : static_cast<uint8_t>(row ^ bits.Symbol(deltas));
    selectors_.push_back(last);
  }
}

std::array<std::array<uint8_t, 3>, 4> Etc1sCodebooks::ColorsOf(const Endpoint& endpoint) {
  std::array<std::array<uint8_t, 3>, 4> colors{};
  for (size_t tone = 0; tone < 4; ++tone) {
    for (size_t c = 0; c < 3; ++c) {
      const int base = endpoint.color5[c] << 3 | endpoint.color5[c] >> 2;
      colors[tone][c] = static_cast<uint8_t>(std::clamp(base + kTones[endpoint.intensity][tone], 0, 255));
    }
  }
  return colors;
}

/// What the blocks of a slice read one after the other remember.
struct Etc1sCodebooks::SliceReader {
  const Etc1sCodebooks& books;
  BitReader bits;
  std::vector<uint32_t> above, here;  // endpoints of two rows of blocks
  std::vector<uint32_t> history;      // selectors lately used
  std::vector<uint8_t> lower;         // predictions of the lower row of each two
  uint32_t repeat = 0, predicted = 0, codes = 0, endpoint = 0, run = 0, rover;

  SliceReader(const Etc1sCodebooks& codebooks, std::span<const std::byte> slice, uint32_t columns)
      : books(codebooks),
        bits(slice, codebooks.where_),
        above(columns),
        here(columns),
        history(codebooks.history_size_),
        lower(columns),
        rover(codebooks.history_size_ / 2) {}

  /// How the endpoint of block (x, y) follows from its neighbours: one symbol says it for two by two blocks.
  uint32_t Prediction(uint32_t x, uint32_t y) {
    if (x % 2 == 0 && y % 2 == 0) {
      if (repeat > 0) {
        --repeat;
      } else if (const uint32_t symbol = bits.Symbol(books.predictions_); symbol == kRepeatPrediction) {
        repeat = bits.Chunks(4) + kLeastRun - 1;
      } else {
        predicted = symbol;
      }
      codes = predicted & 15;
      lower[x] = static_cast<uint8_t>(predicted >> 4 & 15);
    } else if (x % 2 == 0) {
      codes = lower[x];
    }
    const uint32_t prediction = codes & 3;
    codes >>= 2;
    if ((x == 0 && (prediction == kLeft || prediction == kUpperLeft)) || (y == 0 && (prediction == kUpper || prediction == kUpperLeft)))
      bits.Fail("a block that follows one outside the picture");
    return prediction;
  }

  uint32_t NextEndpoint(uint32_t x, uint32_t y) {
    const uint32_t prediction = Prediction(x, y);
    if (prediction == kUpper) endpoint = above[x];
    if (prediction == kUpperLeft) endpoint = above[x - 1];
    if (prediction == kDelta) {
      const auto count = static_cast<uint32_t>(books.endpoints_.size());
      endpoint += bits.Symbol(books.endpoint_deltas_);
      if (endpoint >= count) endpoint -= count;
      if (endpoint >= count) bits.Fail("an endpoint beyond the codebook");
    }
    return here[x] = endpoint;
  }

  /// A new one, or one of those lately used, which moves to the front half way.
  uint32_t NextSelector() {
    const auto count = static_cast<uint32_t>(books.selectors_.size());
    uint32_t symbol = count;
    if (run > 0) {
      --run;
    } else {
      symbol = bits.Symbol(books.selector_symbols_);
      if (symbol == count + books.history_size_) {
        const uint32_t length = bits.Symbol(books.runs_);
        run = (length == kLongRun ? bits.Chunks(7) : length) + kLeastRun - 1;
        symbol = count;
      }
    }
    if (symbol < count) {
      history[rover] = symbol;
      if (++rover == books.history_size_) rover = books.history_size_ / 2;
      return symbol;
    }
    const uint32_t place = symbol - count;
    if (place >= books.history_size_) bits.Fail("a selector beyond the codebook");
    const uint32_t selector = history[place];
    std::swap(history[place / 2], history[place]);
    return selector;
  }
};

std::vector<std::array<uint8_t, 3>> Etc1sCodebooks::Decode(std::span<const std::byte> slice, uint32_t columns, uint32_t rows) const {
  SliceReader reader(*this, slice, columns);
  std::vector<std::array<uint8_t, 3>> pixels(size_t{columns} * rows * 16);
  for (uint32_t y = 0; y < rows; ++y) {
    for (uint32_t x = 0; x < columns; ++x) {
      const auto colors = ColorsOf(endpoints_[reader.NextEndpoint(x, y)]);
      const auto& selector = selectors_[reader.NextSelector()];
      for (uint32_t j = 0; j < 4; ++j) {
        for (uint32_t i = 0; i < 4; ++i) pixels[(size_t{y} * 4 + j) * columns * 4 + x * 4 + i] = colors[selector[j] >> (2 * i) & 3];
      }
    }
    std::swap(reader.above, reader.here);
  }
  return pixels;
}

}  // namespace airsim360::internal

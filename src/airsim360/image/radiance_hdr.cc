// Radiance RGBE pictures from memory.
#include <charconv>
#include <cmath>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs_internal.h"

namespace airsim360 {
namespace {

constexpr int kMaxSide = 1 << 16;

class HdrReader {
 public:
  explicit HdrReader(std::span<const std::byte> bytes) : rest_(AsText(bytes)) {}

  std::string_view Line() {
    const size_t end = rest_.substr(0, 4096).find('\n');
    if (end == std::string_view::npos) throw InputError("truncated header");
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return line;
  }
  uint8_t Byte() {
    if (rest_.empty()) throw InputError("truncated pixels");
    const auto byte = static_cast<uint8_t>(rest_[0]);
    rest_.remove_prefix(1);
    return byte;
  }
  size_t left() const { return rest_.size(); }
  uint8_t Peek(size_t at) const { return at < rest_.size() ? static_cast<uint8_t>(rest_[at]) : 0; }

 private:
  std::string_view rest_;
};

// Product of all EXPOSURE lines, up to the empty line.
float ReadHeader(HdrReader& reader) {
  const std::string_view magic = reader.Line();
  if (!magic.starts_with("#?")) throw InputError("not a Radiance picture");
  double exposure = 1;
  for (std::string_view line = reader.Line(); !line.empty() && line != "\r"; line = reader.Line()) {
    if (line.starts_with("FORMAT=") && !line.starts_with("FORMAT=32-bit_rle_rgbe")) throw InputError("only 32-bit_rle_rgbe is read");
    if (!line.starts_with("EXPOSURE=")) continue;
    line.remove_prefix(9);
    while (line.starts_with(' ')) line.remove_prefix(1);
    double value = 1;
    std::from_chars(line.data(), line.data() + line.size(), value);
    if (value > 1e-12 && value < 1e12) exposure *= value;
  }
  if (!(exposure > 1e-30 && exposure < 1e30)) throw InputError("EXPOSURE out of range");
  return static_cast<float>(1 / exposure);
}

// "-Y height +X width": the usual orientation alone.
void ReadSize(HdrReader& reader, int& width, int& height) {
  const std::string_view line = reader.Line();
  const size_t x = line.find(" +X ");
  if (!line.starts_with("-Y ") || x == std::string_view::npos) throw InputError("only -Y +X pictures are read");
  std::from_chars(line.data() + 3, line.data() + x, height);
  std::from_chars(line.data() + x + 4, line.data() + line.size(), width);
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) throw InputError("size out of range");
}

// Four bytes a pixel; runs as in the oldest files: (1, 1, 1, n) repeats the pixel before.
void ReadFlatRow(HdrReader& reader, std::vector<uint8_t>& row, int width) {
  int shift = 0;
  for (int x = 0; x < width;) {
    uint8_t* p = &row[static_cast<size_t>(x) * 4];
    for (int c = 0; c < 4; ++c) p[c] = reader.Byte();
    if (p[0] != 1 || p[1] != 1 || p[2] != 1) {
      ++x;
      shift = 0;
      continue;
    }
    const int64_t count = int64_t{p[3]} << shift;
    if (x == 0 || shift > 16 || count > width - x) throw InputError("damaged run");
    for (int64_t k = 0; k < count * 4; ++k) p[k] = p[k - 4];
    x += static_cast<int>(count);
    shift += 8;
  }
}

// One channel after the other, in runs and literals.
void ReadPackedRow(HdrReader& reader, std::vector<uint8_t>& row, int width) {
  for (int k = 0; k < 4; ++k) reader.Byte();
  for (int c = 0; c < 4; ++c) {
    for (int x = 0; x < width;) {
      const int code = reader.Byte(), count = code > 128 ? code - 128 : code;
      if (count == 0 || count > width - x) throw InputError("damaged run");
      const uint8_t value = code > 128 ? reader.Byte() : 0;
      for (int k = 0; k < count; ++k) row[static_cast<size_t>(x + k) * 4 + c] = code > 128 ? value : reader.Byte();
      x += count;
    }
  }
}

Image<Rgb32f> ReadHdr(std::span<const std::byte> bytes) {
  HdrReader reader(bytes);
  const float scale = ReadHeader(reader);
  int width = 0, height = 0;
  ReadSize(reader, width, height);
  internal::CheckSize(width, height, "size");
  // A row takes 4 bytes and, packed, at least 2 for every 127 of a channel's pixels; old runs take 4 bytes
  // for up to 2^24 pixels, so they are bounded by their row alone.
  if (static_cast<size_t>(height) * 4 > reader.left()) throw InputError("truncated pixels");
  Image<Rgb32f> image(width, height);
  std::vector<uint8_t> row(static_cast<size_t>(width) * 4);
  for (int y = 0; y < height; ++y) {
    const bool packed =
        width >= 8 && width < 32768 && reader.Peek(0) == 2 && reader.Peek(1) == 2 && (reader.Peek(2) << 8 | reader.Peek(3)) == width;
    packed ? ReadPackedRow(reader, row, width) : ReadFlatRow(reader, row, width);
    for (int x = 0; x < width; ++x) {
      const uint8_t* p = &row[static_cast<size_t>(x) * 4];
      const float unit = p[3] == 0 ? 0.0f : std::ldexp(scale, int{p[3]} - 136);
      image(x, y) = {p[0] * unit, p[1] * unit, p[2] * unit};
    }
  }
  return image;
}

}  // namespace

Image<Rgb32f> DecodeRadianceHdr(std::span<const std::byte> bytes, std::string_view name) {
  try {
    return ReadHdr(bytes);
  } catch (const InputError& error) {
    internal::ThrowDamaged(name, error.what());
  }
}

}  // namespace airsim360

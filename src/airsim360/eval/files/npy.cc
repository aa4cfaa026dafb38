// NumPy's .npy.
#include <bit>
#include <cmath>
#include <cstring>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/eval/files/number_array.h"
#include "airsim360/image/codecs.h"

namespace airsim360 {
namespace {

constexpr size_t kMostDimensions = 8;
static_assert(std::endian::native == std::endian::little);

struct Header {
  char kind = 0;  // NumPy's: b i u f
  size_t size = 0;
  bool big_endian = false, fortran = false;
  std::vector<int64_t> shape;
};

[[noreturn]] void Fail(std::string_view name, const std::string& text) { throw InputError(std::string(name) + ": " + text); }

// The value of a key of the header's dictionary: the text after "'key':".
std::string_view ValueOf(std::string_view header, const char* key, std::string_view name) {
  const size_t at = header.find("'" + std::string(key) + "':");
  if (at == std::string_view::npos) Fail(name, std::string("the header has no '") + key + "'");
  std::string_view value = header.substr(at + std::strlen(key) + 3);
  return value.substr(std::min(value.find_first_not_of(' '), value.size()));
}

Header ParseHeader(std::string_view text, std::string_view name) {
  Header header;
  const std::string_view type = ValueOf(text, "descr", name);
  if (type.size() < 5 || type[0] != '\'' || type[4] != '\'' || type[3] < '1' || type[3] > '8')
    Fail(name, "numbers of an unknown kind " + std::string(type.substr(0, 12)));
  header.big_endian = type[1] == '>';
  header.kind = type[2];
  header.size = static_cast<size_t>(type[3] - '0');
  header.fortran = ValueOf(text, "fortran_order", name).starts_with("True");
  std::string_view shape = ValueOf(text, "shape", name);
  if (!shape.starts_with('(')) Fail(name, "the header has no shape");
  int64_t count = 1;
  for (shape.remove_prefix(1); !shape.empty() && shape[0] != ')';) {
    if (shape[0] == ' ' || shape[0] == ',') {
      shape.remove_prefix(1);
      continue;
    }
    int64_t n = 0;
    size_t digits = 0;
    for (; digits < shape.size() && shape[digits] >= '0' && shape[digits] <= '9' && n <= kMaxPixels; ++digits)
      n = 10 * n + (shape[digits] - '0');
    if (digits == 0 || n < 1 || n > kMaxPixels || header.shape.size() == kMostDimensions)
      Fail(name, "a shape that is none, empty or too large");
    shape.remove_prefix(digits);
    header.shape.push_back(n);
    count *= n;
    if (count > 4 * kMaxPixels) Fail(name, "more than " + std::to_string(4 * kMaxPixels) + " numbers");
  }
  return header;
}

double Half(uint16_t bits) {
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  const double magnitude = exponent == 0    ? std::ldexp(fraction, -24)
                           : exponent == 31 ? (fraction ? NAN : INFINITY)
                                            : std::ldexp(1024 + fraction, exponent - 25);
  return bits & 0x8000 ? -magnitude : magnitude;
}

double ValueAt(const std::byte* at, const Header& header) {
  uint64_t bits = 0;
  for (size_t i = 0; i < header.size; ++i) bits |= static_cast<uint64_t>(at[i]) << (8 * (header.big_endian ? header.size - 1 - i : i));
  const int unused = static_cast<int>(64 - 8 * header.size);
  switch (header.kind) {
    case 'i':
      return static_cast<double>(static_cast<int64_t>(bits << unused) >> unused);
    case 'f':
      if (header.size == 8) return std::bit_cast<double>(bits);
      return header.size == 4 ? std::bit_cast<float>(static_cast<uint32_t>(bits)) : Half(static_cast<uint16_t>(bits));
    default:
      return static_cast<double>(bits);
  }
}

// Where the element with the row-major index `i` lies in an array whose first index runs fastest.
size_t FortranPlace(size_t i, const std::vector<int64_t>& shape) {
  size_t place = 0, stride = 1, all = 1;
  for (const int64_t n : shape) all *= static_cast<size_t>(n);
  for (const int64_t n : shape) {
    all /= static_cast<size_t>(n);
    place += i / all % static_cast<size_t>(n) * stride;
    stride *= static_cast<size_t>(n);
  }
  return place;
}

}  // namespace

NumberArray DecodeNpy(std::span<const std::byte> bytes, std::string_view name) {
  const std::string_view text = AsText(bytes);
  if (text.size() < 12 || !text.starts_with("\x93NUMPY")) Fail(name, "is no .npy file");
  const auto byte = [&](size_t i) { return static_cast<size_t>(static_cast<unsigned char>(text[i])); };
  const int version = text[6];
  if (version < 1 || version > 3) Fail(name, "version " + std::to_string(version) + " of .npy is not known");
  const size_t begin = version == 1 ? 10 : 12, length = byte(8) | byte(9) << 8 | (version == 1 ? 0 : byte(10) << 16 | byte(11) << 24);
  if (length > text.size() - begin) Fail(name, "ends within its header");
  const Header header = ParseHeader(text.substr(begin, length), name);
  const bool known = (header.kind == 'f' && (header.size == 2 || header.size == 4 || header.size == 8)) ||
                     ((header.kind == 'i' || header.kind == 'u') && std::has_single_bit(header.size)) ||
                     (header.kind == 'b' && header.size == 1);
  if (!known) Fail(name, std::string("numbers of the kind ") + header.kind + std::to_string(header.size) + " are not known");
  size_t count = 1;
  for (const int64_t n : header.shape) count *= static_cast<size_t>(n);
  if (bytes.size() - begin - length < count * header.size) Fail(name, "ends before its " + std::to_string(count) + " numbers");
  NumberArray array{header.shape, std::vector<double>(count)};
  const std::byte* data = bytes.data() + begin + length;
  if (header.kind == 'f' && !header.big_endian && !header.fortran && header.size >= 4) {
    // As this machine holds them: what most files are, many times faster.
    if (header.size == 8) std::memcpy(array.values.data(), data, 8 * count);
    for (size_t i = 0; header.size == 4 && i < count; ++i) {
      float value;
      std::memcpy(&value, data + 4 * i, 4);
      array.values[i] = value;
    }
    return array;
  }
  for (size_t i = 0; i < count; ++i)
    array.values[i] = ValueAt(data + (header.fortran ? FortranPlace(i, header.shape) : i) * header.size, header);
  return array;
}

}  // namespace airsim360

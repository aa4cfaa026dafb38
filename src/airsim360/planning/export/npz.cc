#include "airsim360/planning/export/npz.h"

#include <array>
#include <charconv>
#include <cstring>
#include <limits>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr uint32_t kLocal = 0x04034b50, kCentral = 0x02014b50, kEnd = 0x06054b50;  // signatures, APPNOTE 4.3
constexpr size_t kLocalSize = 30;
constexpr uint16_t kVersion = 20;
constexpr uint16_t kFirstDay = 0x21;  // 1 January 1980: files do not depend on the time they are made

uint32_t Crc32(std::string_view bytes) {
  static const std::array<uint32_t, 256> table = [] {
    std::array<uint32_t, 256> t{};
    for (uint32_t i = 0; i < 256; ++i) {
      uint32_t c = i;
      for (int k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
      t[i] = c;
    }
    return t;
  }();
  uint32_t crc = ~0u;
  for (const char c : bytes) crc = table[(crc ^ static_cast<uint8_t>(c)) & 255] ^ (crc >> 8);
  return ~crc;
}

template <class Integer>
void Put(std::string& out, Integer value) {
  for (size_t i = 0; i < sizeof(Integer); ++i) out += static_cast<char>(value >> (8 * i));
}

// Version, flags, method (stored), time, date, checksum, sizes, length of the name, no extra field.
void PutHeader(std::string& out, uint32_t crc, uint32_t size, size_t name) {
  for (const uint16_t v : {kVersion, uint16_t{0}, uint16_t{0}, uint16_t{0}, kFirstDay}) Put(out, v);
  Put(out, crc);
  Put(out, size);
  Put(out, size);
  Put(out, static_cast<uint16_t>(name));
  Put(out, uint16_t{0});
}

std::string NpyHeader(const char* type, const std::vector<size_t>& shape) {
  std::string text = std::string("{'descr': '") + type + "', 'fortran_order': False, 'shape': (";
  for (const size_t n : shape) text += std::to_string(n) + ",";
  text += "), }";
  constexpr size_t kMagic = 10, kAlign = 64;
  text.append((kAlign - (kMagic + text.size() + 1) % kAlign) % kAlign, ' ');
  text += '\n';
  std::string out("\x93NUMPY\x01\x00", 8);
  Put(out, static_cast<uint16_t>(text.size()));
  return out + text;
}

}  // namespace

void NpzWriter::AddArray(std::string_view name, const char* type, const void* data, size_t count, const std::vector<size_t>& shape) {
  size_t product = 1;
  for (const size_t n : shape) product *= n;
  if (product != count) throw InputError("npz: array '" + std::string(name) + "' does not fit its shape");
  std::string body = NpyHeader(type, shape);
  body.append(static_cast<const char*>(data), count * 8);
  if (bytes_.size() + body.size() > std::numeric_limits<uint32_t>::max() / 2) throw InputError("npz: more than 2 GiB");
  Entry entry{std::string(name) + ".npy", Crc32(body), static_cast<uint32_t>(body.size()), static_cast<uint32_t>(bytes_.size())};
  Put(bytes_, kLocal);
  PutHeader(bytes_, entry.crc, entry.size, entry.name.size());
  bytes_ += entry.name;
  bytes_ += body;
  entries_.push_back(std::move(entry));
}

void NpzWriter::Add(std::string_view name, std::span<const double> values, std::vector<size_t> shape) {
  AddArray(name, "<f8", values.data(), values.size(), shape);
}

void NpzWriter::Add(std::string_view name, std::span<const int64_t> values, std::vector<size_t> shape) {
  AddArray(name, "<i8", values.data(), values.size(), shape);
}

std::string NpzWriter::Finish() {
  const auto start = static_cast<uint32_t>(bytes_.size());
  for (const Entry& entry : entries_) {
    Put(bytes_, kCentral);
    Put(bytes_, kVersion);
    PutHeader(bytes_, entry.crc, entry.size, entry.name.size());
    for (int i = 0; i < 3; ++i) Put(bytes_, uint16_t{0});  // comment, disk, internal attributes
    Put(bytes_, uint32_t{0});
    Put(bytes_, entry.offset);
    bytes_ += entry.name;
  }
  const auto size = static_cast<uint32_t>(bytes_.size()) - start;
  Put(bytes_, kEnd);
  Put(bytes_, uint32_t{0});
  for (int i = 0; i < 2; ++i) Put(bytes_, static_cast<uint16_t>(entries_.size()));
  Put(bytes_, size);
  Put(bytes_, start);
  Put(bytes_, uint16_t{0});
  return std::move(bytes_);
}

namespace {

template <class Integer>
Integer Get(std::string_view bytes, size_t at) {
  Integer value = 0;
  for (size_t i = 0; i < sizeof(Integer); ++i)
    value |= static_cast<Integer>(static_cast<Integer>(static_cast<uint8_t>(bytes[at + i])) << (8 * i));
  return value;
}

NpzArray ParseNpy(std::string_view body, std::string name, const std::string& where) {
  NpzArray array{std::move(name), {}, {}};
  const auto check = [&](bool good, const char* what) {
    if (!good) throw InputError(where + ": " + array.name + ": " + what);
  };
  check(body.size() >= 10 && body.starts_with(std::string_view("\x93NUMPY\x01\x00", 8)), "not an array");
  const size_t header = Get<uint16_t>(body, 8);
  check(body.size() >= 10 + header, "it ends early");
  const std::string_view text = body.substr(10, header);
  const bool integers = text.find("'<i8'") != std::string_view::npos;
  check(integers || text.find("'<f8'") != std::string_view::npos, "neither <f8 nor <i8");
  check(text.find("'fortran_order': False") != std::string_view::npos, "not in C order");
  size_t at = text.find("'shape': (");
  check(at != std::string_view::npos, "no shape");
  size_t count = 1;
  for (at += 10; at < text.size() && text[at] != ')';) {
    size_t n = 0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), n);
    check(error == std::errc() && (n == 0 || count <= body.size() / n), "bad shape");
    count *= n;
    array.shape.push_back(n);
    at = static_cast<size_t>(end - text.data());
    while (at < text.size() && (text[at] == ',' || text[at] == ' ')) ++at;
  }
  const std::string_view data = body.substr(10 + header);
  check(data.size() == count * 8, "its size does not fit its shape");
  array.values.resize(count);
  for (size_t i = 0; i < count; ++i) {
    const auto bits = Get<uint64_t>(data, 8 * i);
    if (integers) {
      array.values[i] = static_cast<double>(static_cast<int64_t>(bits));
    } else {
      std::memcpy(&array.values[i], &bits, 8);
    }
  }
  return array;
}

}  // namespace

std::vector<NpzArray> ReadNpz(std::string_view bytes, std::string_view name) {
  const std::string where(name);
  std::vector<NpzArray> arrays;
  size_t at = 0;
  while (bytes.size() >= at + kLocalSize && Get<uint32_t>(bytes, at) == kLocal) {
    const size_t size = Get<uint32_t>(bytes, at + 18), name_size = Get<uint16_t>(bytes, at + 26), extra = Get<uint16_t>(bytes, at + 28);
    if (Get<uint16_t>(bytes, at + 8) != 0) throw InputError(where + ": compressed entries are not read");
    const size_t body = at + kLocalSize + name_size + extra;
    if (bytes.size() < body + size) throw InputError(where + ": it ends early");
    std::string entry(bytes.substr(at + kLocalSize, name_size));
    const std::string_view data = bytes.substr(body, size);
    if (Crc32(data) != Get<uint32_t>(bytes, at + 14)) throw InputError(where + ": " + entry + " is damaged");
    if (entry.ends_with(".npy")) entry.resize(entry.size() - 4);
    arrays.push_back(ParseNpy(data, std::move(entry), where));
    at = body + size;
  }
  if (arrays.empty()) throw InputError(where + ": not an NPZ file");
  return arrays;
}

}  // namespace airsim360

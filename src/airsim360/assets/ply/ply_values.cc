#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>

#include "airsim360/assets/ply/ply_parts.h"

namespace airsim360::internal {
namespace {

template <class T>
T As(const std::array<std::byte, 8>& raw) {
  T value;
  std::memcpy(&value, raw.data(), sizeof value);
  return value;
}

}  // namespace

double PlyValues::Next(PlyType type) {
  if (ascii()) return NextText();
  const size_t size = kPlyTypeBytes[static_cast<int>(type)];
  if (rest_.size() < size) Fail("the file ends here");
  std::array<std::byte, 8> raw{};
  std::memcpy(raw.data(), rest_.data(), size);
  rest_ = rest_.subspan(size);
  if ((format_ == PlyFormat::kBig) == (std::endian::native == std::endian::little))
    std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
  switch (type) {
    case PlyType::kInt8:
      return As<int8_t>(raw);
    case PlyType::kUint8:
      return As<uint8_t>(raw);
    case PlyType::kInt16:
      return As<int16_t>(raw);
    case PlyType::kUint16:
      return As<uint16_t>(raw);
    case PlyType::kInt32:
      return As<int32_t>(raw);
    case PlyType::kUint32:
      return As<uint32_t>(raw);
    case PlyType::kFloat:
      return static_cast<double>(As<float>(raw));
    case PlyType::kDouble:
      return As<double>(raw);
  }
  return 0;
}

double PlyValues::NextText() {
  std::string_view text = AsText(rest_);
  size_t at = 0;
  while (at < text.size() && (text[at] == ' ' || text[at] == '\t' || text[at] == '\n' || text[at] == '\r')) line_ += text[at++] == '\n';
  size_t end = at;
  while (end < text.size() && end - at < 64 && static_cast<unsigned char>(text[end]) > ' ') ++end;
  const std::string_view word = text.substr(at, end - at);
  rest_ = rest_.subspan(end);
  if (word.empty()) Fail("the file ends here");
  double value = 0;
  const auto [stop, error] = std::from_chars(word.data() + (word.front() == '+'), word.data() + word.size(), value);
  if (error != std::errc() || stop != word.data() + word.size()) Fail(Quoted(word) + " is no number");
  return value;
}

}  // namespace airsim360::internal

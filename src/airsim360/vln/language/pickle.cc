#include "airsim360/vln/language/pickle.h"

#include <bit>
#include <cstdint>

namespace airsim360::internal {
namespace {

void Little(std::string& out, uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i));
}

void Text(std::string& out, const std::string& text) {
  out += 'X';  // BINUNICODE
  Little(out, text.size(), 4);
  out += text;
}

void Number(std::string& out, const VlnJson& value) {
  if (value.is_number_float()) {
    out += 'G';  // BINFLOAT, high byte first
    const auto bits = std::bit_cast<uint64_t>(value.get<double>());
    for (int i = 7; i >= 0; --i) out += static_cast<char>(bits >> (8 * i));
    return;
  }
  const auto whole = value.get<int64_t>();
  if (whole >= INT32_MIN && whole <= INT32_MAX) {
    out += 'J';  // BININT
    Little(out, static_cast<uint32_t>(whole), 4);
  } else {
    out += "\x8a\x08";  // LONG1 of eight bytes
    Little(out, static_cast<uint64_t>(whole), 8);
  }
}

// NOLINTNEXTLINE(misc-no-recursion): as deep as the value, which is our own
void Put(std::string& out, const VlnJson& value) {
  if (value.is_null()) {
    out += 'N';
  } else if (value.is_boolean()) {
    out += value.get<bool>() ? '\x88' : '\x89';
  } else if (value.is_number()) {
    Number(out, value);
  } else if (value.is_string()) {
    Text(out, value.get<std::string>());
  } else if (value.is_array()) {
    out += "](";  // EMPTY_LIST, MARK … APPENDS
    for (const VlnJson& item : value) Put(out, item);
    out += 'e';
  } else {
    out += "}(";  // EMPTY_DICT, MARK … SETITEMS
    for (const auto& [key, item] : value.items()) {
      Text(out, key);
      Put(out, item);
    }
    out += 'u';
  }
}

}  // namespace

std::string PickleOf(const VlnJson& value) {
  std::string out = "\x80\x02";  // PROTO 2
  Put(out, value);
  return out + '.';
}

}  // namespace airsim360::internal

#include <algorithm>
#include <charconv>
#include <utility>

#include "airsim360/assets/ply/ply_parts.h"

namespace airsim360::internal {
namespace {

// Words of the text at the front of a file, with the line that they stand in.
class HeaderReader {
 public:
  HeaderReader(const std::string& file, std::string_view text) : file_(file), text_(text) {}
  PlyHeader Read();

 private:
  [[noreturn]] void Fail(const std::string& what) const { throw InputError(file_ + ":" + std::to_string(header_.lines) + ": " + what); }
  bool NextLine();
  std::string_view Word();
  PlyType ReadType(std::string_view word) const;
  void ReadElement();
  void ReadProperty();

  const std::string& file_;
  std::string_view text_, line_;
  PlyHeader header_;
};

bool HeaderReader::NextLine() {
  constexpr size_t kLongest = 4096;
  if (header_.size >= text_.size()) return false;
  const size_t end = text_.find('\n', header_.size);
  if (end == std::string_view::npos || end - header_.size > kLongest) return false;
  line_ = text_.substr(header_.size, end - header_.size);
  if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  header_.size = end + 1;
  ++header_.lines;
  return true;
}

std::string_view HeaderReader::Word() {
  line_.remove_prefix(std::min(line_.find_first_not_of(" \t"), line_.size()));
  const std::string_view word = line_.substr(0, line_.find_first_of(" \t"));
  line_.remove_prefix(word.size());
  return word;
}

PlyType HeaderReader::ReadType(std::string_view word) const {
  static constexpr std::pair<std::string_view, PlyType> kTypes[] = {
      {"char", PlyType::kInt8},   {"int8", PlyType::kInt8},     {"uchar", PlyType::kUint8},   {"uint8", PlyType::kUint8},
      {"short", PlyType::kInt16}, {"int16", PlyType::kInt16},   {"ushort", PlyType::kUint16}, {"uint16", PlyType::kUint16},
      {"int", PlyType::kInt32},   {"int32", PlyType::kInt32},   {"uint", PlyType::kUint32},   {"uint32", PlyType::kUint32},
      {"float", PlyType::kFloat}, {"float32", PlyType::kFloat}, {"double", PlyType::kDouble}, {"float64", PlyType::kDouble}};
  for (const auto& [name, type] : kTypes) {
    if (name == word) return type;
  }
  Fail(Quoted(word) + " is no type of a property");
}

void HeaderReader::ReadElement() {
  constexpr size_t kMost = 64;
  if (header_.elements.size() >= kMost) Fail("more than 64 elements");
  PlyElement element;
  element.name = CleanName(Word());
  const std::string_view count = Word();
  const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
  if (error != std::errc() || end != count.data() + count.size()) Fail("element " + element.name + ": " + Quoted(count) + " is no count");
  header_.elements.push_back(std::move(element));
}

void HeaderReader::ReadProperty() {
  constexpr size_t kMost = 256;
  if (header_.elements.empty()) Fail("a property before any element");
  std::vector<PlyProperty>& properties = header_.elements.back().properties;
  if (properties.size() >= kMost) Fail("more than 256 properties");
  PlyProperty property;
  std::string_view word = Word();
  if (word == "list") {
    property.count = ReadType(Word());
    if (*property.count >= PlyType::kFloat) Fail("the length of a list is a whole number");
    word = Word();
  }
  property.type = ReadType(word);
  property.name = CleanName(Word());
  properties.push_back(std::move(property));
}

PlyHeader HeaderReader::Read() {
  if (!NextLine() || line_ != "ply") throw InputError(file_ + ": not a PLY file");
  bool format = false;
  while (NextLine()) {
    const std::string_view key = Word();
    if (key == "format") {
      const std::string_view name = Word();
      if (name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian")
        Fail("format " + Quoted(name) + ": ascii, binary_little_endian or binary_big_endian expected");
      header_.format = name == "ascii" ? PlyFormat::kAscii : name == "binary_big_endian" ? PlyFormat::kBig : PlyFormat::kLittle;
      format = true;
    } else if (key == "element") {
      ReadElement();
    } else if (key == "property") {
      ReadProperty();
    } else if (key == "comment") {
      if (Word() == "TextureFile" && header_.textures.size() < 256) {
        line_.remove_prefix(std::min(line_.find_first_not_of(" \t"), line_.size()));
        header_.textures.emplace_back(line_);
      }
    } else if (key == "end_header") {
      if (!format) Fail("no format is named");
      return header_;
    } else if (!key.empty() && key != "obj_info") {
      Fail(Quoted(key) + " is no word of a PLY header");
    }
  }
  ++header_.lines;
  Fail("the header has no end");
}

}  // namespace

PlyHeader ReadPlyHeader(const std::string& file, std::string_view text) { return HeaderReader(file, text).Read(); }

}  // namespace airsim360::internal

#include "airsim360/dataset/export/parquet_file.h"

#include <cstring>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr int64_t kRowsAGroup = 10'000;
constexpr int kPhysicalType[] = {2, 4, 5, 6};  // INT64, FLOAT, DOUBLE, BYTE_ARRAY

// Thrift's compact protocol, as far as Parquet's metadata needs it.
class Thrift {
 public:
  void Begin() { last_.push_back(0); }
  void End() {
    last_.pop_back();
    text_ += '\0';
  }
  void Int(int field, int64_t value, bool is64 = false) {
    Field(field, is64 ? 6 : 5);
    Varint(ZigZag(value));
  }
  void Text(int field, const std::string& value) {
    Field(field, 8);
    Bare(value);
  }
  void Struct(int field) {
    Field(field, 12);
    Begin();
  }
  enum Element { kI32 = 5, kBinary = 8, kStruct = 12 };
  void List(int field, Element element, size_t count) {
    Field(field, 9);
    if (count < 15) {
      text_ += static_cast<char>((count << 4) | element);
    } else {
      text_ += static_cast<char>(0xf0 | element);
      Varint(count);
    }
  }
  void Bare(const std::string& value) {
    Varint(value.size());
    text_ += value;
  }
  void Bare(int64_t value) { Varint(ZigZag(value)); }
  std::string Take() { return std::move(text_); }

 private:
  static uint64_t ZigZag(int64_t v) { return (static_cast<uint64_t>(v) << 1) ^ static_cast<uint64_t>(v >> 63); }
  void Varint(uint64_t v) {
    for (; v >= 128; v >>= 7) text_ += static_cast<char>(v | 128);
    text_ += static_cast<char>(v);
  }
  void Field(int field, int type) {
    const int delta = field - last_.back();
    text_ += static_cast<char>((delta << 4) | type);  // fields come in order, less than 16 apart
    last_.back() = field;
  }

  std::string text_;
  std::vector<int> last_;
};

template <class T>
void AppendRaw(std::string& to, T value) {
  to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Levels of one bit, bit-packed in the hybrid encoding, with their length before.
std::string PackLevels(const std::vector<uint8_t>& levels) {
  const size_t groups = (levels.size() + 7) / 8;
  std::string packed;
  for (uint64_t header = groups << 1 | 1;;) {
    packed += static_cast<char>(header >= 128 ? header | 128 : header);
    if ((header >>= 7) == 0) break;
  }
  for (size_t g = 0; g < groups; ++g) {
    unsigned byte = 0;
    for (size_t b = 0; b < 8 && 8 * g + b < levels.size(); ++b) byte |= static_cast<unsigned>(levels[8 * g + b]) << b;
    packed += static_cast<char>(byte);
  }
  std::string text;
  AppendRaw(text, static_cast<uint32_t>(packed.size()));
  return text + packed;
}

void AppendValue(std::string& to, ParquetFile::Type type, const ParquetFile::Value& value) {
  if (static_cast<size_t>(type) != value.index()) throw RuntimeError("parquet: a value of another type than its column");
  if (const auto* text = std::get_if<std::string>(&value)) {
    AppendRaw(to, static_cast<uint32_t>(text->size()));
    to += *text;
  } else {
    std::visit(
        [&](const auto& number) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(number)>, std::string>) AppendRaw(to, number);
        },
        value);
  }
}

}  // namespace

ParquetFile::ParquetFile(ExportFolder& folder, const std::string& path, std::vector<Column> columns)
    : file_(folder, path), columns_(std::move(columns)), buffers_(columns_.size()) {
  file_.Append("PAR1");
}

void ParquetFile::AddRow(const std::vector<std::vector<Value>>& row) {
  if (row.size() != columns_.size()) throw RuntimeError("parquet: a row of another number of columns");
  for (size_t c = 0; c < row.size(); ++c) {
    Buffer& buffer = buffers_[c];
    if (!columns_[c].list && row[c].size() != 1) throw RuntimeError("parquet: not one value in column " + columns_[c].name);
    for (size_t i = 0; i < row[c].size(); ++i) {
      AppendValue(buffer.values, columns_[c].type, row[c][i]);
      buffer.repetition.push_back(i > 0);
      buffer.definition.push_back(1);
    }
    if (row[c].empty()) {
      buffer.repetition.push_back(0);
      buffer.definition.push_back(0);
    }
    buffer.count += static_cast<int64_t>(std::max<size_t>(1, row[c].size()));
  }
  ++rows_;
  if (++rows_in_group_ == kRowsAGroup) FlushGroup();
}

void ParquetFile::FlushGroup() {
  RowGroup group{.chunks = {}, .rows = rows_in_group_};
  for (size_t c = 0; c < columns_.size(); ++c) {
    Buffer& buffer = buffers_[c];
    std::string page;
    if (columns_[c].list) page = PackLevels(buffer.repetition) + PackLevels(buffer.definition);
    page += buffer.values;
    Thrift header;
    header.Begin();
    header.Int(1, 0);  // DATA_PAGE
    header.Int(2, static_cast<int64_t>(page.size()));
    header.Int(3, static_cast<int64_t>(page.size()));
    header.Struct(5);
    header.Int(1, buffer.count), header.Int(2, 0), header.Int(3, 3), header.Int(4, 3);  // PLAIN, levels RLE
    header.End();
    header.End();
    const std::string text = header.Take();
    group.chunks.push_back({static_cast<int64_t>(file_.size()), static_cast<int64_t>(text.size() + page.size()), buffer.count});
    file_.Append(text);
    file_.Append(page);
    buffer = {};
  }
  groups_.push_back(std::move(group));
  rows_in_group_ = 0;
}

std::string ParquetFile::Footer() const {
  Thrift t;
  t.Begin();
  t.Int(1, 1);
  size_t elements = 1;
  for (const Column& column : columns_) elements += column.list ? 3 : 1;
  t.List(2, Thrift::kStruct, elements);
  t.Begin(), t.Text(4, "schema"), t.Int(5, static_cast<int64_t>(columns_.size())), t.End();
  const auto leaf = [&](const std::string& name, Type type) {
    t.Begin(), t.Int(1, kPhysicalType[static_cast<int>(type)]), t.Int(3, 0), t.Text(4, name);
    if (type == Type::kText) t.Int(6, 0);  // UTF8
    t.End();
  };
  for (const Column& column : columns_) {
    if (!column.list) {
      leaf(column.name, column.type);
      continue;
    }
    t.Begin(), t.Int(3, 0), t.Text(4, column.name), t.Int(5, 1), t.Int(6, 3), t.End();  // LIST
    t.Begin(), t.Int(3, 2), t.Text(4, "list"), t.Int(5, 1), t.End();
    leaf("element", column.type);
  }
  t.Int(3, rows_, true);
  t.List(4, Thrift::kStruct, groups_.size());
  for (const RowGroup& group : groups_) {
    int64_t bytes = 0;
    t.Begin();
    t.List(1, Thrift::kStruct, group.chunks.size());
    for (size_t c = 0; c < columns_.size(); ++c) {
      const Chunk& chunk = group.chunks[c];
      const Column& column = columns_[c];
      bytes += chunk.bytes;
      t.Begin(), t.Int(2, chunk.offset, true), t.Struct(3);
      t.Int(1, kPhysicalType[static_cast<int>(column.type)]);
      t.List(2, Thrift::kI32, 2), t.Bare(int64_t{0}), t.Bare(int64_t{3});
      t.List(3, Thrift::kBinary, column.list ? 3 : 1), t.Bare(column.name);
      if (column.list) t.Bare(std::string("list")), t.Bare(std::string("element"));
      t.Int(4, 0), t.Int(5, chunk.values, true), t.Int(6, chunk.bytes, true), t.Int(7, chunk.bytes, true);
      t.Int(9, chunk.offset, true);
      t.End(), t.End();
    }
    t.Int(2, bytes, true), t.Int(3, group.rows, true);
    t.End();
  }
  t.Text(6, "airsim360");
  t.End();
  return t.Take();
}

void ParquetFile::Finish() {
  if (rows_in_group_ > 0) FlushGroup();
  const std::string footer = Footer();
  file_.Append(footer);
  std::string end;
  AppendRaw(end, static_cast<uint32_t>(footer.size()));
  file_.Append(end + "PAR1");
  file_.Close();
}

}  // namespace airsim360::internal

// Writes Apache Parquet files: PLAIN, uncompressed, required columns of numbers, texts and lists of them
// (github.com/apache/parquet-format: README, thrift/parquet.thrift). Every Parquet reader takes these.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "airsim360/dataset/export/export_folder.h"

namespace airsim360::internal {

class ParquetFile {
 public:
  enum class Type { kInt64, kFloat, kDouble, kText };
  struct Column {
    std::string name;
    Type type;
    bool list = false;  ///< each row holds any number of values
  };

  ParquetFile(ExportFolder& folder, const std::string& path, std::vector<Column> columns);
  /// Values of a row, column by column: one each, or as many as wanted in a list. RuntimeError if they do not fit the columns.
  using Value = std::variant<int64_t, float, double, std::string>;
  void AddRow(const std::vector<std::vector<Value>>& row);
  void Finish();

 private:
  struct Buffer {
    std::string values;               // PLAIN
    std::vector<uint8_t> repetition;  // of lists: 1 = goes on with the list before
    std::vector<uint8_t> definition;  // of lists: 0 = an empty list
    int64_t count = 0;                // of values, empty lists counted
  };
  struct Chunk {
    int64_t offset = 0, bytes = 0, values = 0;
  };
  struct RowGroup {
    std::vector<Chunk> chunks;
    int64_t rows = 0;
  };
  void FlushGroup();
  std::string Footer() const;

  GrowingFile file_;
  std::vector<Column> columns_;
  std::vector<Buffer> buffers_;
  std::vector<RowGroup> groups_;
  int64_t rows_in_group_ = 0, rows_ = 0;
};

}  // namespace airsim360::internal

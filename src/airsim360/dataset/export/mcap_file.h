// Writes MCAP files (mcap.dev/spec): zstd chunks with CRC and message index, summary, statistics.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "airsim360/dataset/export/export_folder.h"

namespace airsim360::internal {

class McapFile {
 public:
  McapFile(ExportFolder& folder, const std::string& path, const std::string& profile);
  /// A topic of messages of one type; gives its number. `definition` in the encoding "ros2msg".
  uint16_t AddChannel(const std::string& topic, const std::string& type, const std::string& definition);
  /// `data` in the encoding "cdr".
  void AddMessage(uint16_t channel, int64_t t_ns, const std::string& data);
  void Finish();

 private:
  struct ChunkInfo {
    uint64_t first = 0, last = 0, start = 0, length = 0, index_length = 0, compressed = 0, uncompressed = 0;
    std::map<uint16_t, uint64_t> index_offsets;
  };
  void Append(const std::string& bytes);
  void FlushChunk();
  std::string Statistics() const;

  GrowingFile file_;
  uint32_t crc_ = 0;                             // of the file so far
  std::vector<std::string> schemas_, channels_;  // their records
  std::map<std::string, uint16_t> schema_ids_;
  std::string chunk_;
  std::map<uint16_t, std::vector<std::pair<uint64_t, uint64_t>>> index_;  // of the chunk: time, offset
  std::vector<ChunkInfo> chunks_;
  std::map<uint16_t, uint64_t> counts_;
  std::map<uint16_t, uint32_t> sequence_;
};

}  // namespace airsim360::internal

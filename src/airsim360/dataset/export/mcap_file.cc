#include "airsim360/dataset/export/mcap_file.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr size_t kChunkBytes = 4 << 20;
constexpr int kZstdLevel = 1;  // pictures are compressed already
constexpr char kMagic[] = "\x89MCAP0\r\n";

enum Op : uint8_t {
  kHeader = 1,
  kFooter,
  kSchema,
  kChannel,
  kMessage,
  kChunk,
  kMessageIndex,
  kChunkIndex,
  kStatistics = 0x0b,
  kSummaryOffset = 0x0e,
  kDataEnd
};

// Little-endian numbers, texts with their length before.
class Fields {
 public:
  template <class T>
  Fields& N(T value) {
    for (size_t i = 0; i < sizeof(T); ++i) text_ += static_cast<char>(static_cast<uint64_t>(value) >> (8 * i));
    return *this;
  }
  Fields& Text(const std::string& text) {
    N(static_cast<uint32_t>(text.size()));
    return Raw(text);
  }
  Fields& Raw(const std::string& bytes) {
    text_ += bytes;
    return *this;
  }
  std::string Take() { return std::move(text_); }

 private:
  std::string text_;
};

std::string Record(Op op, const std::string& content) {
  return Fields().N(static_cast<uint8_t>(op)).N(static_cast<uint64_t>(content.size())).Raw(content).Take();
}

uint32_t Crc(uint32_t crc, const std::string& bytes) {
  return static_cast<uint32_t>(::crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string Compressed(const std::string& bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const size_t size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kZstdLevel);
  if (ZSTD_isError(size)) throw RuntimeError(std::string("zstd: ") + ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

}  // namespace

McapFile::McapFile(ExportFolder& folder, const std::string& path, const std::string& profile) : file_(folder, path) {
  Append(std::string(kMagic, 8));
  Append(Record(kHeader, Fields().Text(profile).Text("airsim360").Take()));
}

void McapFile::Append(const std::string& bytes) {
  crc_ = Crc(crc_, bytes);
  file_.Append(bytes);
}

uint16_t McapFile::AddChannel(const std::string& topic, const std::string& type, const std::string& definition) {
  const auto [schema, added] = schema_ids_.try_emplace(type, static_cast<uint16_t>(schema_ids_.size() + 1));
  if (added) schemas_.push_back(Record(kSchema, Fields().N(schema->second).Text(type).Text("ros2msg").Text(definition).Take()));
  const auto id = static_cast<uint16_t>(channels_.size());
  channels_.push_back(Record(kChannel, Fields().N(id).N(schema->second).Text(topic).Text("cdr").N(uint32_t{0}).Take()));
  // They stand in the first chunk in which they are used and again in the summary.
  if (added) chunk_ += schemas_.back();
  chunk_ += channels_.back();
  counts_[id] = 0;
  return id;
}

void McapFile::AddMessage(uint16_t channel, int64_t t_ns, const std::string& data) {
  const auto t = static_cast<uint64_t>(t_ns);
  index_[channel].emplace_back(t, chunk_.size());
  chunk_ += Record(kMessage, Fields().N(channel).N(sequence_[channel]++).N(t).N(t).Raw(data).Take());
  ++counts_[channel];
  if (chunk_.size() >= kChunkBytes) FlushChunk();
}

void McapFile::FlushChunk() {
  if (index_.empty()) return;
  ChunkInfo info;
  info.first = ~uint64_t{0};
  for (const auto& [channel, entries] : index_) {
    for (const auto& [t, offset] : entries) {
      info.first = std::min(info.first, t);
      info.last = std::max(info.last, t);
    }
  }
  const std::string packed = Compressed(chunk_);
  info.start = file_.size();
  info.compressed = packed.size();
  info.uncompressed = chunk_.size();
  const std::string record = Record(kChunk, Fields()
                                                .N(info.first)
                                                .N(info.last)
                                                .N(static_cast<uint64_t>(chunk_.size()))
                                                .N(Crc(0, chunk_))
                                                .Text("zstd")
                                                .N(static_cast<uint64_t>(packed.size()))
                                                .Raw(packed)
                                                .Take());
  info.length = record.size();
  Append(record);
  const uint64_t indices = file_.size();
  for (auto& [channel, entries] : index_) {
    std::ranges::stable_sort(entries, {}, &std::pair<uint64_t, uint64_t>::first);
    info.index_offsets[channel] = file_.size();
    Fields list;
    for (const auto& [t, offset] : entries) list.N(t).N(offset);
    Append(Record(kMessageIndex, Fields().N(channel).Text(list.Take()).Take()));
  }
  info.index_length = file_.size() - indices;
  chunks_.push_back(std::move(info));
  chunk_.clear();
  index_.clear();
}

std::string McapFile::Statistics() const {
  uint64_t messages = 0, first = ~uint64_t{0}, last = 0;
  Fields counts;
  for (const auto& [channel, count] : counts_) {
    counts.N(channel).N(count);
    messages += count;
  }
  for (const ChunkInfo& chunk : chunks_) {
    first = std::min(first, chunk.first);
    last = std::max(last, chunk.last);
  }
  return Record(kStatistics, Fields()
                                 .N(messages)
                                 .N(static_cast<uint16_t>(schemas_.size()))
                                 .N(static_cast<uint32_t>(channels_.size()))
                                 .N(uint32_t{0})
                                 .N(uint32_t{0})
                                 .N(static_cast<uint32_t>(chunks_.size()))
                                 .N(messages > 0 ? first : 0)
                                 .N(last)
                                 .Text(counts.Take())
                                 .Take());
}

void McapFile::Finish() {
  FlushChunk();
  const uint32_t data_crc = crc_;
  Append(Record(kDataEnd, Fields().N(data_crc).Take()));
  // Summary: groups of records of one kind, then where each group is.
  const uint64_t summary = file_.size();
  std::string text, offsets;
  const auto group = [&](Op op, const std::string& records) {
    if (records.empty()) return;
    offsets += Record(kSummaryOffset, Fields()
                                          .N(static_cast<uint8_t>(op))
                                          .N(static_cast<uint64_t>(summary + text.size()))
                                          .N(static_cast<uint64_t>(records.size()))
                                          .Take());
    text += records;
  };
  std::string schemas, channels, chunks;
  for (const std::string& record : schemas_) schemas += record;
  for (const std::string& record : channels_) channels += record;
  for (const ChunkInfo& c : chunks_) {
    Fields map;
    for (const auto& [channel, offset] : c.index_offsets) map.N(channel).N(offset);
    chunks += Record(kChunkIndex, Fields()
                                      .N(c.first)
                                      .N(c.last)
                                      .N(c.start)
                                      .N(c.length)
                                      .Text(map.Take())
                                      .N(c.index_length)
                                      .Text("zstd")
                                      .N(c.compressed)
                                      .N(c.uncompressed)
                                      .Take());
  }
  group(kSchema, schemas);
  group(kChannel, channels);
  group(kStatistics, Statistics());
  group(kChunkIndex, chunks);
  const uint64_t offsets_start = summary + text.size();
  text += offsets;
  // The CRC of the summary runs through the footer up to itself.
  text += Fields().N(static_cast<uint8_t>(kFooter)).N(uint64_t{20}).N(summary).N(offsets_start).Take();
  text += Fields().N(Crc(0, text)).Take();
  file_.Append(text + std::string(kMagic, 8));
  file_.Close();
}

}  // namespace airsim360::internal

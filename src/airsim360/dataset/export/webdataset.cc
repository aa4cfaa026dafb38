// WebDataset: POSIX ustar files of samples; files of one sample lie together and share the name up to the first dot.
#include <array>
#include <cstdio>
#include <cstring>
#include <optional>

#include "airsim360/base/error.h"
#include "airsim360/dataset/export/export_job.h"

namespace airsim360::internal {
namespace {

constexpr size_t kBlock = 512;

// The header of a plain file: owner, mode and time are fixed, so that the bytes depend on name and content alone.
std::string TarHeader(const std::string& name, uint64_t size) {
  if (name.size() > 99) throw InputError("--format webdataset: the name '" + name + "' has more than 99 bytes");
  std::array<char, kBlock> block{};
  const auto octal = [&](size_t at, size_t digits, uint64_t value) {
    for (size_t i = digits; i-- > 0; value /= 8) block[at + i] = static_cast<char>('0' + value % 8);
  };
  std::memcpy(block.data(), name.data(), name.size());
  octal(100, 7, 0644), octal(108, 7, 0), octal(116, 7, 0), octal(124, 11, size), octal(136, 11, 0);
  std::memset(block.data() + 148, ' ', 8);
  block[156] = '0';
  std::memcpy(block.data() + 257, "ustar\00000", 8);
  unsigned sum = 0;
  for (const char c : block) sum += static_cast<unsigned char>(c);
  octal(148, 6, sum);
  block[155] = ' ';
  return {block.data(), block.size()};
}

void AppendFile(std::string& tar, const std::string& name, std::string_view content) {
  tar += TarHeader(name, content.size());
  tar += content;
  tar.append((kBlock - content.size() % kBlock) % kBlock, '\0');
}

Json SampleJson(const ExportJob& job, const NativeFrame& frame, const View& view) {
  Json json = frame.json;
  json.erase("sha256");
  json["view"] = view.suffix;
  Json segments = Json::array();
  for (const Segment& s : job.data.Segments(frame, view)) {
    segments.push_back({{"id", s.entity},
                        {"category_id", s.category},
                        {"area", s.area},
                        {"bbox", {s.box.x, s.box.y, s.box.w, s.box.h}},
                        {"bbox_wrap", {s.box_wrap.x, s.box_wrap.y, s.box_wrap.w, s.box_wrap.h}}});
  }
  json["segments_info"] = std::move(segments);
  if (job.data.HasPeople()) json["persons"] = job.data.Persons(frame, view);
  return json;
}

// The files of all views of a frame.
std::string Sample(const ExportJob& job, const NativeFrame& frame) {
  std::string tar;
  for (const View& view : job.data.views()) {
    const std::string key = frame.stem + view.suffix;
    const auto add = [&](const char* product, const std::string& suffix) {
      const Bytes bytes = job.data.Read(frame, view, product);
      AppendFile(tar, key + "." + suffix + job.data.Extension(product), AsText(bytes));
    };
    if (job.data.Has("rgb")) add("rgb", "rgb");
    add("range", "depth");
    add("semantic", "semantic");
    add("entity", "panoptic");
    AppendFile(tar, key + ".meta.json", Dump(SampleJson(job, frame, view)));
  }
  return tar;
}

std::string ShardName(int64_t shard) {
  char text[32];
  std::snprintf(text, sizeof text, "shard-%06lld.tar", static_cast<long long>(shard));
  return text;
}

}  // namespace

void ExportWebDataset(ExportJob& job) {
  std::optional<GrowingFile> shard;
  int64_t shards = 0;
  const std::string end(2 * kBlock, '\0');
  const auto close = [&] {
    if (!shard) return;
    shard->Append(end);
    shard->Close();
  };
  job.EachFrame([&](const NativeFrame& frame) { return Sample(job, frame); },
                [&](const NativeFrame&, std::string sample) {
                  const auto grown = static_cast<int64_t>(shard ? shard->size() + sample.size() + end.size() : 0);
                  if (!shard || grown > job.options.shard_bytes) {
                    close();
                    shard.emplace(job.out, ShardName(shards++));
                  }
                  shard->Append(sample);
                });
  close();
  job.out.Write("dataset.json", Pretty({{"categories", job.data.meta().at("categories")},
                                        {"conventions", job.data.meta().at("conventions")},
                                        {"encodings", job.data.meta().at("encodings")}}));
  job.notes["shards"] = shards;
}

}  // namespace airsim360::internal

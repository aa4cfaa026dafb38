#include "airsim360/video/mp4_boxes.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr size_t kHeader = 8;
constexpr size_t kNoChildren = SIZE_MAX;

// Bytes of a box before its children.
size_t HeadOf(std::string_view type) {
  constexpr std::array<std::string_view, 6> kContainers = {"moov", "trak", "edts", "mdia", "minf", "stbl"};
  constexpr std::array<std::string_view, 4> kEntries = {"avc1", "avc3", "hvc1", "hev1"};
  constexpr size_t kFullBoxAndCount = 8, kVisualSampleEntry = 78;
  if (std::ranges::count(kContainers, type) > 0) return 0;
  if (type == "stsd") return kFullBoxAndCount;
  if (std::ranges::count(kEntries, type) > 0) return kVisualSampleEntry;
  return kNoChildren;
}

}  // namespace

size_t Mp4Box::Size() const {
  size_t size = kHeader + head.size();
  for (const Mp4Box& child : children) size += child.Size();
  return size;
}

Mp4Box* Mp4Box::Find(std::string_view wanted) {
  const auto found = std::ranges::find(children, wanted, &Mp4Box::type);
  return found == children.end() ? nullptr : &*found;
}

std::vector<Mp4Box> ParseBoxes(std::span<const std::byte> bytes) {
  std::vector<Mp4Box> boxes;
  for (size_t at = 0; at < bytes.size();) {
    const uint64_t size = GetNumber(bytes, at, 4);
    if (size < kHeader || size > bytes.size() - at) throw RuntimeError("MP4: a box of " + std::to_string(size) + " bytes does not fit");
    Mp4Box& box = boxes.emplace_back();
    box.type = AsText(bytes.subspan(at + 4, 4));
    const auto inside = bytes.subspan(at + kHeader, size - kHeader);
    const size_t head = std::min(HeadOf(box.type), inside.size());
    box.head.assign(inside.begin(), inside.begin() + static_cast<ptrdiff_t>(head));
    box.children = ParseBoxes(inside.subspan(head));
    at += size;
  }
  return boxes;
}

void AppendBox(const Mp4Box& box, Bytes& to) {
  AppendNumber(to, 4, box.Size());
  const auto type = AsBytes(box.type);
  to.insert(to.end(), type.begin(), type.end());
  to.insert(to.end(), box.head.begin(), box.head.end());
  for (const Mp4Box& child : box.children) AppendBox(child, to);
}

uint64_t GetNumber(std::span<const std::byte> bytes, size_t at, int size) {
  if (at > bytes.size() || bytes.size() - at < static_cast<size_t>(size)) throw RuntimeError("MP4: a box ends too early");
  uint64_t value = 0;
  for (int i = 0; i < size; ++i) value = value << 8 | static_cast<uint64_t>(bytes[at + static_cast<size_t>(i)]);
  return value;
}

void SetNumber(Bytes& bytes, size_t at, int size, uint64_t value) {
  GetNumber(bytes, at, size);
  for (int i = size; i-- > 0; value >>= 8) bytes[at + static_cast<size_t>(i)] = static_cast<std::byte>(value & 0xff);
}

void AppendNumber(Bytes& bytes, int size, uint64_t value) {
  bytes.resize(bytes.size() + static_cast<size_t>(size));
  SetNumber(bytes, bytes.size() - static_cast<size_t>(size), size, value);
}

}  // namespace airsim360::internal

#include "airsim360/eval/coco/mask.h"

#include <algorithm>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs.h"

namespace airsim360 {
namespace {

std::string SizeText(const RleMask& mask) { return std::to_string(mask.width) + "x" + std::to_string(mask.height); }

// Calls found(begin, end) for every run of pixels inside both, in column-major order.
template <class Found>
void EachSharedRun(const RleMask& a, const RleMask& b, const Found& found) {
  if (a.width != b.width || a.height != b.height) throw InputError("masks of different size: " + SizeText(a) + " and " + SizeText(b));
  size_t i = 0, j = 0;
  uint64_t begin = 0, a_end = a.counts.empty() ? 0 : a.counts[0], b_end = b.counts.empty() ? 0 : b.counts[0];
  while (i < a.counts.size() && j < b.counts.size()) {
    const uint64_t end = std::min(a_end, b_end);
    if (i % 2 == 1 && j % 2 == 1 && end > begin) found(begin, end);
    begin = end;
    if (a_end == end && ++i < a.counts.size()) a_end += a.counts[i];
    if (b_end == end && ++j < b.counts.size()) b_end += b.counts[j];
  }
}

RleMask Unite(const RleMask& a, const RleMask& b) {
  if (a.width != b.width || a.height != b.height) throw InputError("masks of different size: " + SizeText(a) + " and " + SizeText(b));
  RleMask united{a.width, a.height, {}};
  size_t i = 0, j = 0;
  uint64_t begin = 0, a_end = a.counts.empty() ? 0 : a.counts[0], b_end = b.counts.empty() ? 0 : b.counts[0];
  bool inside = false;
  uint64_t start = 0;
  while (i < a.counts.size() && j < b.counts.size()) {
    const bool now = i % 2 == 1 || j % 2 == 1;
    const uint64_t end = std::min(a_end, b_end);
    if (now != inside && end > begin) {
      united.counts.push_back(static_cast<uint32_t>(begin - start));
      start = begin;
      inside = now;
    }
    begin = end;
    if (a_end == end && ++i < a.counts.size()) a_end += a.counts[i];
    if (b_end == end && ++j < b.counts.size()) b_end += b.counts[j];
  }
  united.counts.push_back(static_cast<uint32_t>(begin - start));
  return united;
}

}  // namespace

void CheckMask(const RleMask& mask) {
  const uint64_t pixels = static_cast<uint64_t>(mask.width) * mask.height;
  if (pixels == 0 || pixels > static_cast<uint64_t>(kMaxPixels)) throw InputError("a mask of " + SizeText(mask) + " pixels");
  uint64_t sum = 0;
  for (const uint32_t count : mask.counts) sum += count;
  if (sum != pixels)
    throw InputError("run lengths of a mask sum to " + std::to_string(sum) + ", but " + SizeText(mask) + " are " + std::to_string(pixels) +
                     " pixels");
}

RleMask EncodeMask(std::span<const uint8_t> pixels, int width, int height) {
  RleMask mask{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
  bool inside = false;
  uint32_t run = 0;
  for (int x = 0; x < width; ++x) {
    for (int y = 0; y < height; ++y) {
      if ((pixels[static_cast<size_t>(y) * width + x] != 0) != inside) {
        mask.counts.push_back(run);
        run = 0;
        inside = !inside;
      }
      ++run;
    }
  }
  mask.counts.push_back(run);
  return mask;
}

std::vector<uint8_t> DecodeMask(const RleMask& mask) {
  std::vector<uint8_t> pixels(static_cast<size_t>(mask.width) * mask.height, 0);
  uint64_t at = 0;
  for (size_t i = 0; i < mask.counts.size(); ++i) {
    const uint64_t end = at + mask.counts[i];
    if (i % 2 == 1) {
      for (; at < end; ++at) pixels[at % mask.height * mask.width + at / mask.height] = 1;
    }
    at = end;
  }
  return pixels;
}

RleMask UniteMasks(std::span<const RleMask> masks) {
  if (masks.empty()) throw InputError("no masks to unite");
  RleMask united = masks[0];
  for (const RleMask& mask : masks.subspan(1)) united = Unite(united, mask);
  return united;
}

RleMask RollMaskBack(const RleMask& mask, int columns) {
  const int64_t width = mask.width, shift = (columns % width + width) % width;
  const uint64_t moved = static_cast<uint64_t>(shift) * mask.height;
  // Columns are stored one after the other: the first of them go to the end.
  std::vector<uint32_t> front, rest;
  uint64_t at = 0;
  for (const uint32_t count : mask.counts) {
    const uint64_t before = std::clamp(moved, at, at + count) - at;
    front.push_back(static_cast<uint32_t>(before));
    rest.push_back(static_cast<uint32_t>(count - before));
    at += count;
  }
  RleMask back{mask.width, mask.height, {0}};
  bool inside = false;  // whether the last run is
  for (const auto& part : {rest, front}) {
    for (size_t i = 0; i < part.size(); ++i) {
      if (part[i] == 0) continue;
      if (const bool now = i % 2 == 1; now == inside) {
        back.counts.back() += part[i];
      } else {
        back.counts.push_back(part[i]);
        inside = now;
      }
    }
  }
  return back;
}

uint64_t MaskArea(const RleMask& mask) {
  uint64_t area = 0;
  for (size_t i = 1; i < mask.counts.size(); i += 2) area += mask.counts[i];
  return area;
}

uint64_t SharedArea(const RleMask& a, const RleMask& b) {
  uint64_t area = 0;
  EachSharedRun(a, b, [&](uint64_t begin, uint64_t end) { area += end - begin; });
  return area;
}

std::array<double, 4> MaskBox(const RleMask& mask) {
  uint64_t left = mask.width, right = 0, top = mask.height, bottom = 0, at = 0;
  for (size_t i = 0; i < mask.counts.size(); ++i) {
    const uint64_t end = at + mask.counts[i];
    if (i % 2 == 1 && end > at) {
      const uint64_t first = at / mask.height, last = (end - 1) / mask.height;
      left = std::min(left, first);
      right = std::max(right, last + 1);
      // A run over a border of columns reaches the last row and begins at the first.
      top = std::min(top, first == last ? at % mask.height : 0);
      bottom = std::max(bottom, first == last ? (end - 1) % mask.height + 1 : mask.height);
    }
    at = end;
  }
  if (right == 0) return {0, 0, 0, 0};
  return {static_cast<double>(left), static_cast<double>(top), static_cast<double>(right - left), static_cast<double>(bottom - top)};
}

RowSums::RowSums(std::span<const double> weights) : height_(weights.size()), sums_(weights.size() + 1, 0) {
  for (size_t y = 0; y < weights.size(); ++y) sums_[y + 1] = sums_[y] + weights[y];
}

double WeighedArea(const RleMask& mask, const RowSums& sums) {
  double area = 0;
  uint64_t at = 0;
  for (size_t i = 0; i < mask.counts.size(); ++i) {
    const uint64_t end = at + mask.counts[i];
    if (i % 2 == 1) area += sums.Before(end) - sums.Before(at);
    at = end;
  }
  return area;
}

double WeighedSharedArea(const RleMask& a, const RleMask& b, const RowSums& sums) {
  double area = 0;
  EachSharedRun(a, b, [&](uint64_t begin, uint64_t end) { area += sums.Before(end) - sums.Before(begin); });
  return area;
}

}  // namespace airsim360

// COCO's compressed strings of run lengths.
#include <limits>

#include "airsim360/base/error.h"
#include "airsim360/eval/coco/mask.h"

namespace airsim360 {
namespace {

constexpr int kBits = 5, kOffset = 48, kMore = 32, kSign = 16;

}  // namespace

RleMask ParseCompressedRle(std::string_view text, int width, int height) {
  RleMask mask{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
  for (size_t at = 0; at < text.size();) {
    int64_t value = 0;
    for (int shift = 0;; shift += kBits) {
      if (at == text.size()) throw InputError("a compressed mask ends within a number");
      const int group = static_cast<unsigned char>(text[at]) - kOffset;
      if (group < 0 || group >= 2 * kMore || shift > 8 * kBits)
        throw InputError("a compressed mask has the character '" + std::string(1, text[at]) + "' at " + std::to_string(at));
      ++at;
      value |= static_cast<int64_t>(group & (kMore - 1)) << shift;
      if (group & kMore) continue;
      if (group & kSign) value |= -(int64_t{1} << (shift + kBits));
      break;
    }
    if (mask.counts.size() > 2) value += mask.counts[mask.counts.size() - 2];
    if (value < 0 || value > std::numeric_limits<uint32_t>::max())
      throw InputError("a compressed mask has a run of " + std::to_string(value) + " pixels");
    mask.counts.push_back(static_cast<uint32_t>(value));
  }
  CheckMask(mask);
  return mask;
}

std::string CompressRle(const RleMask& mask) {
  std::string text;
  for (size_t i = 0; i < mask.counts.size(); ++i) {
    int64_t value = mask.counts[i];
    if (i > 2) value -= mask.counts[i - 2];
    for (bool more = true; more;) {
      int group = static_cast<int>(value & (kMore - 1));
      value >>= kBits;
      // Done once what is left repeats the sign bit of the group.
      more = group & kSign ? value != -1 : value != 0;
      if (more) group |= kMore;
      text += static_cast<char>(group + kOffset);
    }
  }
  return text;
}

}  // namespace airsim360

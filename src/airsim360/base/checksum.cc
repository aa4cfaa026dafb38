#include "airsim360/base/checksum.h"

#include <bit>
#include <cstring>

namespace airsim360 {
namespace {

static_assert(std::endian::native == std::endian::little);

// Primes of the specification.
constexpr uint64_t kPrime[] = {0, 0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x85EBCA77C2B2AE63, 0x27D4EB2F165667C5};
constexpr size_t kStripe = 32;

template <class Word>
uint64_t Read(const std::byte* at) {
  Word word;
  std::memcpy(&word, at, sizeof word);
  return word;
}

uint64_t Round(uint64_t lane, uint64_t input) { return std::rotl(lane + input * kPrime[2], 31) * kPrime[1]; }

// Four lanes over all whole stripes, which `at` is moved behind.
uint64_t Stripes(const std::byte*& at, const std::byte* end) {
  uint64_t lanes[] = {kPrime[1] + kPrime[2], kPrime[2], 0, 0 - kPrime[1]};
  for (; static_cast<size_t>(end - at) >= kStripe; at += kStripe) {
    for (int i = 0; i < 4; ++i) lanes[i] = Round(lanes[i], Read<uint64_t>(at + 8 * i));
  }
  uint64_t sum = std::rotl(lanes[0], 1) + std::rotl(lanes[1], 7) + std::rotl(lanes[2], 12) + std::rotl(lanes[3], 18);
  for (const uint64_t lane : lanes) sum = (sum ^ Round(0, lane)) * kPrime[1] + kPrime[4];
  return sum;
}

}  // namespace

uint64_t Checksum(std::span<const std::byte> bytes) {
  const std::byte* at = bytes.data();
  const std::byte* const end = at + bytes.size();
  uint64_t sum = bytes.size() >= kStripe ? Stripes(at, end) : kPrime[5];
  sum += bytes.size();
  for (; end - at >= 8; at += 8) sum = std::rotl(sum ^ Round(0, Read<uint64_t>(at)), 27) * kPrime[1] + kPrime[4];
  for (; end - at >= 4; at += 4) sum = std::rotl(sum ^ (Read<uint32_t>(at) * kPrime[1]), 23) * kPrime[2] + kPrime[3];
  for (; at != end; ++at) sum = std::rotl(sum ^ (Read<uint8_t>(at) * kPrime[5]), 11) * kPrime[1];
  sum = (sum ^ sum >> 33) * kPrime[2];
  sum = (sum ^ sum >> 29) * kPrime[3];
  return sum ^ sum >> 32;
}

}  // namespace airsim360

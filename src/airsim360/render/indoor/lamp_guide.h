// Which lamps a place in a room sees, learnt from rays that its neighbours sent: a tree of lamps knows of no walls.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "airsim360/render/lights/light_tree.h"

namespace airsim360::internal {

/// What rays to one lamp have brought.
struct FoundLamp {
  uint32_t lamp;
  float squares;  ///< sum over rays of the squared luminance of irradiance, as if all rays went to this lamp
  float rays;     ///< those that met something else count
};

/// One entry a lamp, in ascending order.
void JoinFound(std::vector<FoundLamp>& found);

/// Sums of what several places have found.
class LampTally {
 public:
  explicit LampTally(size_t lamps) : by_lamp_(lamps) {}
  void Add(std::span<const FoundLamp> found) {
    for (const FoundLamp& one : found) by_lamp_[one.lamp].squares += one.squares, by_lamp_[one.lamp].rays += one.rays;
  }

 private:
  friend class LampGuide;
  struct Entry {
    float squares = 0, rays = 0;
  };
  std::vector<Entry> by_lamp_;
};

/// Chooses among lamps that were found, the rest of the rays go by the tree: no lamp that can send light is ever left out.
class LampGuide {
 public:
  LampGuide() = default;
  /// By the root of the mean square of what a ray brings: a lamp that few of the places see is dear to those that do.
  explicit LampGuide(const LampTally& tally);
  /// Share of the rays that the tree sends: 1 where nothing was found.
  float tree_share() const { return lamps_.empty() ? 1 : kTreeShare; }
  /// Probability with which Choose gives that lamp.
  float Probability(uint32_t lamp) const;
  /// u in [0, 1); probability: of Choose alone. Not where nothing was found.
  LightTree::Choice Choose(float u) const;

 private:
  static constexpr float kTreeShare = 0.25f;
  std::vector<uint32_t> lamps_;  ///< ascending
  std::vector<float> up_to_;     ///< by lamp, sum of probabilities with its own
};

}  // namespace airsim360::internal

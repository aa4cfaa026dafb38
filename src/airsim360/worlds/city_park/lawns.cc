#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/parallel.h"
#include "airsim360/worlds/city_park/noise.h"
#include "airsim360/worlds/city_park/park.h"

namespace airsim360::internal::park {
namespace {

constexpr int kHalf = static_cast<int>(kParkRadius) + 8, kSide = 2 * kHalf;
constexpr uint16_t kBlocked = 0, kFree = 0xffff;
constexpr int kSectors = 12;
constexpr size_t kSmallest = 60;  // cells; smaller pieces join the country around

}  // namespace

Lawns::Lawns(SceneBuilder& builder, const Layout& layout) : piece_(static_cast<size_t>(kSide) * kSide, kBlocked), layout_(layout) {
  const auto add = [&](std::string name, const char* path) { return builder.AddEntity(std::move(name), builder.tree().At(path)); };
  for (int i = 0; i < kSectors; ++i) country_.push_back(add("country", "ground/terrain/landscape"));
  for (int i = 0; i < kSectors; ++i) country_.push_back(add("hills", "nature/hill"));
  lake_bed_ = add("lake bed", "ground/dirt");

  ParallelFor(kSide, [&](int64_t y) {
    for (int x = 0; x < kSide; ++x) {
      const Vec2f p{static_cast<float>(x - kHalf) + 0.5f, static_cast<float>(y - kHalf) + 0.5f};
      if (std::hypot(p.x, p.y) > kParkRadius || (layout.Lake(p) < 1.02f && layout.Island(p) < 0.6f) || layout.BeyondRoad(p) < 0 ||
          layout.PathDistance(p, 3) < kPathHalf)
        continue;
      piece_[static_cast<size_t>(y) * kSide + static_cast<size_t>(x)] = kFree;
    }
  });

  // Pieces by flooding, in raster order.
  entities_.push_back(kNoEntity);
  std::vector<int> stack, cells;
  for (int start = 0; start < kSide * kSide; ++start) {
    if (piece_[static_cast<size_t>(start)] != kFree) continue;
    const auto piece = static_cast<uint16_t>(entities_.size());
    stack = {start};
    cells = {start};
    piece_[static_cast<size_t>(start)] = piece;
    while (!stack.empty()) {
      const int at = stack.back();
      stack.pop_back();
      for (int next : {at - 1, at + 1, at - kSide, at + kSide}) {
        if (next < 0 || next >= kSide * kSide || piece_[static_cast<size_t>(next)] != kFree) continue;
        piece_[static_cast<size_t>(next)] = piece;
        stack.push_back(next);
        cells.push_back(next);
      }
    }
    if (cells.size() < kSmallest) {
      for (int cell : cells) piece_[static_cast<size_t>(cell)] = kBlocked;
      continue;
    }
    area_ += static_cast<double>(cells.size());
    entities_.push_back(add("lawn", "ground/terrain/landscape"));
  }
}

int Lawns::Cell(Vec2f p) const {
  const int x = static_cast<int>(std::floor(p.x)) + kHalf, y = static_cast<int>(std::floor(p.y)) + kHalf;
  return x < 0 || y < 0 || x >= kSide || y >= kSide ? -1 : y * kSide + x;
}

EntityId Lawns::At(Vec2f p) const {
  if (layout_.Lake(p) < 1.0f && layout_.Island(p) < 0.3f) return lake_bed_;
  for (float reach : {0.0f, 1.0f, 2.0f, 3.5f}) {
    for (int k = 0; k < (reach > 0 ? 8 : 1); ++k) {
      const float a = std::numbers::pi_v<float> / 4 * static_cast<float>(k);
      const int cell = Cell({p.x + reach * std::cos(a), p.y + reach * std::sin(a)});
      if (cell >= 0 && piece_[static_cast<size_t>(cell)] != kBlocked) return entities_[piece_[static_cast<size_t>(cell)]];
    }
  }
  const float turn = std::atan2(p.y, p.x) / (2 * std::numbers::pi_v<float>)+0.5f;
  const int sector = std::clamp(static_cast<int>(turn * kSectors), 0, kSectors - 1);
  return country_[static_cast<size_t>(sector + (std::hypot(p.x, p.y) > 1300 ? kSectors : 0))];
}

bool Lawns::IsLawn(Vec2f p) const {
  const int cell = Cell(p);
  if (cell < 0 || piece_[static_cast<size_t>(cell)] == kBlocked) return false;
  return layout_.BeyondRoad(p) > 0.25f && layout_.PathDistance(p, 2) > kPathHalf + 0.12f &&
         (layout_.Lake(p) > 1.05f || layout_.Island(p) > 0.62f);
}

}  // namespace airsim360::internal::park

#include "airsim360/app/view/followed_pictures.h"

#include <algorithm>
#include <string>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/view/planes.h"

namespace airsim360 {
namespace {

constexpr size_t kKept = 4;

}  // namespace

void FollowedPictures::Add(int64_t number, Frame frame) {
  seen_.push_back({number, std::move(frame)});
  if (seen_.size() > kKept) seen_.pop_front();
}

SocketMessage FollowedPictures::Planes(int64_t number) const {
  const auto found = std::ranges::find(seen_, number, &Seen::number);
  if (found == seen_.end()) throw InputError("number: picture " + std::to_string(number) + " is gone");
  PlaneMessage planes;
  for (const char* name : {"range", "entity"}) planes.AddProduct(found->frame, name);
  return {planes.Finish("\"number\":" + std::to_string(number)), true};
}

}  // namespace airsim360

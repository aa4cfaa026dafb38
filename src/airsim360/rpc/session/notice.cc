#include "airsim360/rpc/session/notice.h"

#include <mutex>
#include <set>

#include "airsim360/base/log.h"

namespace airsim360 {

void NoticeOnce(const std::string& text) {
  constexpr size_t kMostTexts = 500;
  static std::mutex mutex;
  static std::set<std::string> told;
  const std::lock_guard lock(mutex);
  if (told.size() < kMostTexts && told.insert(text).second) LogInfo(text);
}

}  // namespace airsim360

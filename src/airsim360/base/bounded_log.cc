#include "airsim360/base/bounded_log.h"

#include "airsim360/base/log.h"

namespace airsim360 {

void BoundedLog::Warn(std::string_view message) {
  const std::string line = LineAt(message, Clock::now());
  if (!line.empty()) LogWarning(line);
}

std::string BoundedLog::LineAt(std::string_view message, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  if (now - start_ >= kPeriod) start_ = now, written_ = 0;
  if (written_ >= kLines) {
    ++left_out_;
    return "";
  }
  ++written_;
  std::string line(message);
  if (left_out_ > 0) line += " (" + std::to_string(left_out_) + " more such lines were left out)";
  left_out_ = 0;
  return line;
}

}  // namespace airsim360

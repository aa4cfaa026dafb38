#include "airsim360/base/log.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>

namespace airsim360 {

void LogInfo(std::string_view message) { std::fprintf(stderr, "%.*s\n", static_cast<int>(message.size()), message.data()); }

void LogWarning(std::string_view message) { std::fprintf(stderr, "warning: %.*s\n", static_cast<int>(message.size()), message.data()); }

std::string ClockText(double seconds) {
  const auto s = static_cast<long long>(std::clamp(seconds, 0.0, 1e9) + 0.5);
  char text[48];
  if (s >= 3600)
    std::snprintf(text, sizeof(text), "%lld:%02lld:%02lld", s / 3600, s / 60 % 60, s % 60);
  else
    std::snprintf(text, sizeof(text), "%lld:%02lld", s / 60, s % 60);
  return text;
}

namespace internal {

/// What is being done and since when; tells it from a thread of its own, as one step of the work may take
/// minutes.
class ProgressTicker {
 public:
  /// `total` 0: unknown.
  ProgressTicker(std::string label, int64_t total, std::chrono::milliseconds period)
      : label_(std::move(label)), total_(total), bar_(total > 0 && ::isatty(STDERR_FILENO) != 0) {
    if (!bar_) StartTelling(period);
  }

  ~ProgressTicker() {
    if (bar_) std::fputc('\n', stderr);
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    wake_.notify_all();
    thread_.join();
  }

  void Update(int64_t done) {
    done_ = done;
    if (bar_) ShowBar();
  }

  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  // Signals are for the threads that were there.
  void StartTelling(std::chrono::milliseconds period) {
    sigset_t all, before;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([this, period] {
      std::unique_lock lock(mutex_);
      while (!wake_.wait_for(lock, period, [&] { return over_; })) Tell();
    });
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }

  double Fraction() const { return std::clamp(static_cast<double>(done_) / static_cast<double>(total_), 0.0, 1.0); }
  double SecondsLeft() const {
    const double fraction = Fraction();
    return fraction > 0 ? seconds() * (1 - fraction) / fraction : 0;
  }

  void Tell() const {
    if (total_ == 0) return LogInfo(label_ + ": " + std::to_string(static_cast<int64_t>(seconds())) + " s");
    const std::string left = done_ > 0 ? ClockText(SecondsLeft()) + " left" : ClockText(seconds()) + " so far";
    LogInfo(label_ + ": " + std::to_string(done_) + "/" + std::to_string(total_) + ", " + left);
  }

  void ShowBar() const {
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(Fraction() * kWidth);
    std::fprintf(stderr, "\r%s [%s%s] %lld/%lld  %s left ", label_.c_str(), std::string(filled, '#').c_str(),
                 std::string(kWidth - filled, '.').c_str(), static_cast<long long>(done_), static_cast<long long>(total_),
                 ClockText(SecondsLeft()).c_str());
    std::fflush(stderr);
  }

  const std::string label_;
  const int64_t total_;
  const bool bar_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::atomic<int64_t> done_ = 0;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace internal

ProgressBar::ProgressBar(std::string label, int64_t total, std::chrono::milliseconds period)
    : ticker_(std::make_unique<internal::ProgressTicker>(std::move(label), std::max<int64_t>(total, 1), period)) {}
ProgressBar::~ProgressBar() = default;
void ProgressBar::Update(int64_t done) { ticker_->Update(done); }

LongTask::LongTask(std::string what, std::chrono::milliseconds period)
    : ticker_(std::make_unique<internal::ProgressTicker>(std::move(what), 0, period)) {}
LongTask::~LongTask() = default;
double LongTask::seconds() const { return ticker_->seconds(); }

}  // namespace airsim360

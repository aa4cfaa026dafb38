#include "airsim360/dataset/frame_writer.h"

#include <chrono>

#include "airsim360/base/file.h"
#include "airsim360/base/parallel.h"

namespace airsim360 {

FrameWriter::FrameWriter(const EncodeContext& context, DatasetIndex& index, const std::filesystem::path& folder)
    : context_(context), index_(index), folder_(folder), background_(ThreadCount() > 1) {
  free_.resize(background_ ? 2 : 1, std::vector<Capture>(context.views.size()));
  if (background_) thread_ = std::thread([this] { Loop(); });
}

FrameWriter::~FrameWriter() {
  if (!background_) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::vector<Capture> FrameWriter::Acquire() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !free_.empty() || error_; });
  if (error_) std::rethrow_exception(error_);
  std::vector<Capture> captures = std::move(free_.back());
  free_.pop_back();
  return captures;
}

void FrameWriter::Submit(int64_t index, std::vector<Capture> captures, FrameLabels people) {
  Job job{index, std::move(captures), std::move(people)};
  if (!background_) {
    Write(job);
    free_.push_back(std::move(job.captures));
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(std::move(job));
  }
  changed_.notify_all();
}

void FrameWriter::Finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return (queue_.empty() && !busy_) || error_; });
  if (error_) std::rethrow_exception(error_);
}

void FrameWriter::Loop() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return !queue_.empty() || stop_; });
    if (stop_) return;
    Job job = std::move(queue_.front());
    queue_.erase(queue_.begin());
    busy_ = true;
    lock.unlock();
    std::exception_ptr error;
    try {
      Write(job);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    busy_ = false;
    free_.push_back(std::move(job.captures));
    if (error && !error_) error_ = error;
    if (error_) queue_.clear();
    changed_.notify_all();
  }
}

void FrameWriter::Write(const Job& job) {
  const auto start = std::chrono::steady_clock::now();
  const EncodedFrame frame = Encode(context_, job.index, job.captures, job.people);
  ParallelFor(static_cast<int64_t>(frame.files.size()), [&](int64_t i) {
    const EncodedFile& file = frame.files[static_cast<size_t>(i)];
    WriteFileAtomically(folder_ / file.record.path, file.bytes);
  });
  // Only now, with every file on the disk, is the frame done.
  index_.AddFrame(frame.record, FrameJson(frame.record, context_.spec));
  write_ms_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace airsim360

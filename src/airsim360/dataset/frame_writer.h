// Writes frames while the next ones are rendered.
#pragma once

#include <condition_variable>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>
#include <vector>

#include "airsim360/dataset/encode.h"
#include "airsim360/dataset/index.h"

namespace airsim360 {

/// Encodes, writes and journals frames in the order in which they are submitted. With one thread in all it
/// works inside Submit; otherwise on a thread of its own, one frame behind the renderer.
class FrameWriter {
 public:
  FrameWriter(const EncodeContext& context, DatasetIndex& index, const std::filesystem::path& folder);
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Captures to fill next, one for each view; waits until a set is free. Rethrows what went wrong in
  /// writing.
  std::vector<Capture> Acquire();
  /// Hands over a frame; after an error in an earlier frame it is dropped.
  void Submit(int64_t index, std::vector<Capture> captures, FrameLabels people = {});
  /// Waits until everything is written; rethrows what went wrong.
  void Finish();
  /// Milliseconds of encoding and writing so far; call after Finish.
  double write_ms() const { return write_ms_; }

 private:
  struct Job {
    int64_t index;
    std::vector<Capture> captures;
    FrameLabels people;
  };
  void Write(const Job& job);
  void Loop();

  const EncodeContext& context_;
  DatasetIndex& index_;
  const std::filesystem::path folder_;
  const bool background_;
  double write_ms_ = 0;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::vector<Capture>> free_;  // sets of captures to reuse
  std::vector<Job> queue_;
  bool busy_ = false, stop_ = false;
  std::exception_ptr error_;
  std::thread thread_;
};

}  // namespace airsim360

// The program ffmpeg as a process of its own: nothing of it is linked.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace airsim360::internal {

/// Path of ffmpeg: $AIRSIM360_FFMPEG, else the first in $PATH. InputError naming the Debian package if there is none.
std::string FindFfmpeg();

/// A file descriptor that closes itself.
class OwnedFd {
 public:
  explicit OwnedFd(int fd = -1) : fd_(fd) {}
  ~OwnedFd() { Close(); }
  OwnedFd(OwnedFd&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
  OwnedFd& operator=(OwnedFd&& other) noexcept;
  int get() const { return fd_; }
  void Close();

 private:
  int fd_;
};

/// One run of ffmpeg, fed through its standard input. Signals of the terminal do not reach it; it ends when its input
/// does.
class FfmpegRun {
 public:
  /// `output` (if not negative) is its file descriptor 3. RuntimeError if it cannot be started.
  FfmpegRun(const std::vector<std::string>& arguments, int output);
  /// Kills it if it still runs.
  ~FfmpegRun();
  FfmpegRun(const FfmpegRun&) = delete;
  FfmpegRun& operator=(const FfmpegRun&) = delete;

  /// Waits until it has taken all; false if it has ended instead.
  bool Send(std::span<const std::byte> bytes);
  /// Ends its input and waits for it; true if it was content.
  bool Finish();
  /// What it complained about, in one line; after Finish.
  std::string Complaint() const;

 private:
  pid_t pid_ = -1;
  OwnedFd input_, errors_;
  int status_ = -1;
};

}  // namespace airsim360::internal

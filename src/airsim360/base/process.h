// Other programs, run without a shell; folders for what they write.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace airsim360 {

/// A new folder among the temporary files, readable by this user alone; it and all that it holds goes with its
/// object. RuntimeError if it cannot be made.
class ScratchFolder {
 public:
  /// `kind` is part of its name.
  explicit ScratchFolder(const std::string& kind);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The program of this name in $PATH; nullopt if there is none.
std::optional<std::filesystem::path> FindProgram(const std::string& name);

struct ProcessOptions {
  std::filesystem::path out = "/dev/null";         ///< what it prints
  std::filesystem::path complaints = "/dev/null";  ///< its standard error; may be `out` itself
  double seconds = 600;                            ///< then it and all that it started are killed
  uint64_t most_bytes = uint64_t{4} << 30;         ///< of each file that it writes
};

/// How a program ended.
struct ProcessEnd {
  int status = 0;          ///< as it said; 128 + signal where one ended it
  bool timed_out = false;  ///< it was killed for taking too long
};

/// Runs `words[0]` (looked for in $PATH) with the arguments that follow, and waits. Its standard input is empty.
/// nullopt if there is no such program.
std::optional<ProcessEnd> RunProgram(const std::vector<std::string>& words, const ProcessOptions& options = {});

}  // namespace airsim360

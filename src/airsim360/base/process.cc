#include "airsim360/base/process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <system_error>

#include "airsim360/base/error.h"

extern char** environ;

namespace airsim360 {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder(const std::string& kind) {
  const fs::path folder = fs::temp_directory_path();
  std::string pattern = (folder / ("airsim360_" + kind + "_XXXXXX")).string();
  if (!mkdtemp(pattern.data())) throw RuntimeError("cannot create a folder in " + folder.string());
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
}

std::optional<fs::path> FindProgram(const std::string& name) {
  const char* variable = std::getenv("PATH");
  std::string folders = variable ? variable : "/usr/bin:/bin";
  for (size_t begin = 0; begin <= folders.size();) {
    const size_t end = std::min(folders.find(':', begin), folders.size());
    const fs::path file = fs::path(folders.substr(begin, end - begin)) / name;
    std::error_code error;
    if (end > begin && fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0) return file;
    begin = end + 1;
  }
  return std::nullopt;
}

namespace {

// Starts it as the head of a process group of its own, so that all that it starts can be ended with it; 0 if
// there is no such program.
pid_t Spawn(const std::vector<std::string>& words, const ProcessOptions& options) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, options.out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (options.complaints == options.out)
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
  else
    posix_spawn_file_actions_addopen(&actions, 2, options.complaints.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, words[0].c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (failed) return 0;
  const rlimit most{options.most_bytes, options.most_bytes};
  static_cast<void>(::prlimit(child, RLIMIT_FSIZE, &most, nullptr));
  return child;
}

}  // namespace

std::optional<ProcessEnd> RunProgram(const std::vector<std::string>& words, const ProcessOptions& options) {
  const pid_t child = Spawn(words, options);
  if (child == 0) return std::nullopt;
  ProcessEnd end;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.seconds);
  int status = 0;
  for (int wait_ms = 1;; wait_ms = std::min(wait_ms * 2, 50)) {
    const pid_t ended = ::waitpid(child, &status, end.timed_out ? 0 : WNOHANG);
    if (ended == child || (ended < 0 && errno != EINTR)) break;
    if (!end.timed_out && std::chrono::steady_clock::now() >= deadline) {
      end.timed_out = true;
      ::kill(-child, SIGKILL);
    }
    if (!end.timed_out) ::poll(nullptr, 0, wait_ms);
  }
  // What it left behind ends with it.
  ::kill(-child, SIGKILL);
  end.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + (WIFSIGNALED(status) ? WTERMSIG(status) : 0);
  return end;
}

}  // namespace airsim360

#include "airsim360/video/ffmpeg.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "airsim360/base/error.h"

extern char** environ;

namespace airsim360::internal {
namespace {

constexpr int kFirstOwn = 10;  // descriptors of ours stay clear of those that ffmpeg gets

OwnedFd Moved(int fd) {
  if (fd < 0) throw RuntimeError(std::string("ffmpeg: cannot be started: ") + std::strerror(errno));
  OwnedFd moved(::fcntl(fd, F_DUPFD_CLOEXEC, kFirstOwn));
  ::close(fd);
  return moved;
}

bool IsProgram(const std::string& path) { return !path.empty() && ::access(path.c_str(), X_OK) == 0; }

}  // namespace

std::string FindFfmpeg() {
  constexpr const char* kInstall = "videos need the program ffmpeg: sudo apt-get install ffmpeg (or set AIRSIM360_FFMPEG to its path)";
  if (const char* given = std::getenv("AIRSIM360_FFMPEG")) {
    if (IsProgram(given)) return given;
    throw InputError("AIRSIM360_FFMPEG: '" + std::string(given) + "' is not a program; " + kInstall);
  }
  const char* path = std::getenv("PATH");
  const std::string folders = path ? path : "/usr/local/bin:/usr/bin:/bin";
  for (size_t begin = 0; begin <= folders.size();) {
    const size_t end = std::min(folders.find(':', begin), folders.size());
    const std::string program = folders.substr(begin, end - begin) + "/ffmpeg";
    if (IsProgram(program)) return program;
    begin = end + 1;
  }
  throw InputError(kInstall);
}

OwnedFd& OwnedFd::operator=(OwnedFd&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

void OwnedFd::Close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

FfmpegRun::FfmpegRun(const std::vector<std::string>& arguments, int output) {
  // A socket for its input, because writing to it raises no signal when ffmpeg has gone.
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) Moved(-1);
  input_ = Moved(ends[0]);
  const OwnedFd its_input = Moved(ends[1]);
  errors_ = Moved(::memfd_create("ffmpeg errors", MFD_CLOEXEC));
  const OwnedFd nothing = Moved(::open("/dev/null", O_RDWR | O_CLOEXEC));

  std::vector<std::string> words = {FindFfmpeg(), "-hide_banner", "-loglevel", "error", "-y"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, its_input.get(), 0);
  posix_spawn_file_actions_adddup2(&actions, nothing.get(), 1);
  posix_spawn_file_actions_adddup2(&actions, errors_.get(), 2);
  const OwnedFd its_output = output >= 0 ? OwnedFd(::fcntl(output, F_DUPFD_CLOEXEC, kFirstOwn)) : OwnedFd();
  if (output >= 0) posix_spawn_file_actions_adddup2(&actions, its_output.get(), 3);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, defaults;
  sigemptyset(&none);
  sigemptyset(&defaults);
  for (const int signal : {SIGPIPE, SIGXFSZ, SIGINT, SIGTERM}) sigaddset(&defaults, signal);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  const int error = ::posix_spawn(&pid_, words[0].c_str(), &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    pid_ = -1;
    throw RuntimeError(words[0] + ": cannot be started: " + std::strerror(error));
  }
}

FfmpegRun::~FfmpegRun() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool FfmpegRun::Send(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::send(input_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    bytes = bytes.subspan(static_cast<size_t>(n));
  }
  return true;
}

bool FfmpegRun::Finish() {
  input_.Close();
  while (pid_ >= 0 && ::waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return WIFEXITED(status_) && WEXITSTATUS(status_) == 0;
}

std::string FfmpegRun::Complaint() const {
  constexpr size_t kMost = 2000;
  std::string text(kMost, '\0');
  const ssize_t n = ::pread(errors_.get(), text.data(), text.size(), 0);
  text.resize(n > 0 ? static_cast<size_t>(n) : 0);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at)) text.replace(at, 1, "; ");
  if (!text.empty()) return text;
  if (WIFSIGNALED(status_)) return "killed by signal " + std::to_string(WTERMSIG(status_));
  return "exit status " + std::to_string(WEXITSTATUS(status_));
}

}  // namespace airsim360::internal

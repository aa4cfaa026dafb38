#include "airsim360/app/dataset/collect_processes.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <thread>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/base/parallel.h"

extern char** environ;

namespace airsim360 {
namespace {

constexpr int kMostProcesses = 256;
constexpr int kMostDeaths = 3;  // of one process without a frame in between

// What this program was started with.
std::vector<std::string> OwnArguments() {
  std::vector<std::string> words;
  std::ifstream text("/proc/self/cmdline", std::ios::binary);
  for (std::string word; std::getline(text, word, '\0');) words.push_back(word);
  return words;
}

/// A process that renders some of the frames.
class Worker {
 public:
  Worker(int number, int count, std::vector<int64_t> frames)
      : name_(std::to_string(number) + "/" + std::to_string(count)), frames_(std::move(frames)) {}
  ~Worker() { Kill(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  bool running() const { return pid_ > 0; }
  int output() const { return channel_; }

  void Start() {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
      throw RuntimeError(std::string("--processes: ") + std::strerror(errno));
    channel_ = ends[0];
    std::vector<std::string> words = OwnArguments();
    words.insert(words.end(), {"--worker", name_});
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 0);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
    const int error = ::posix_spawn(&pid_, "/proc/self/exe", &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    if (error != 0) {
      pid_ = -1;
      throw RuntimeError(std::string("--processes: cannot start one more: ") + std::strerror(error));
    }
    sending_.clear();
    for (const int64_t frame : frames_) sending_ += std::to_string(frame) + "\n";
    sending_ += "end\n";
  }

  /// Sends what fits of the list of frames.
  void Feed() {
    const ssize_t n = ::send(channel_, sending_.data(), sending_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n > 0) sending_.erase(0, static_cast<size_t>(n));
    if (n < 0 && errno != EAGAIN && errno != EINTR) sending_.clear();
  }
  bool has_to_feed() const { return !sending_.empty(); }

  /// Takes what it reports; false when it has closed its end.
  template <class Line>
  bool Listen(const Line& line) {
    char text[4096];
    const ssize_t n = ::read(channel_, text, sizeof text);
    if (n < 0 && errno == EINTR) return true;
    if (n <= 0) return false;
    received_.append(text, static_cast<size_t>(n));
    for (size_t end = received_.find('\n'); end != std::string::npos; end = received_.find('\n')) {
      const std::string one = received_.substr(0, end);
      received_.erase(0, end + 1);
      if (one.starts_with("frame ")) deaths_ = 0;
      line(one);
    }
    return true;
  }

  /// It has ended: true if it is done, false if it was killed and may be started again. RuntimeError if it failed.
  bool End() {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    ::close(channel_);
    channel_ = -1;
    received_.clear();
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return true;
    // Its own message stands on stderr already.
    if (WIFEXITED(status)) throw RuntimeError("collect: process " + name_ + " failed; what is written stays, run it again to go on");
    const std::string death = "process " + name_ + " was ended by signal " + std::to_string(WTERMSIG(status)) +
                              (WTERMSIG(status) == SIGKILL ? " (out of memory?)" : "");
    if (++deaths_ >= kMostDeaths) throw RuntimeError("collect: " + death + " " + std::to_string(kMostDeaths) + " times without a frame");
    LogWarning("collect: " + death + "; it is started again");
    return false;
  }

 private:
  void Kill() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
      }
    }
    if (channel_ >= 0) ::close(channel_);
  }

  const std::string name_;
  const std::vector<int64_t> frames_;
  pid_t pid_ = -1;
  int channel_ = -1, deaths_ = 0;
  std::string sending_, received_;
};

// "total RENDER_MS WRITE_MS RAYS"
void AddTotals(const std::string& line, CollectResult& result) {
  std::istringstream words(line.substr(6));
  double render_ms = 0, write_ms = 0;
  uint64_t rays = 0;
  words >> render_ms >> write_ms >> rays;
  result.render_ms += render_ms, result.write_ms += write_ms, result.rays += rays;
}

void RenderAll(int processes, Dealing dealing, const std::vector<int64_t>& missing, const std::function<void()>& written,
               CollectResult& result) {
  const auto count = std::min(static_cast<size_t>(processes), missing.size());
  std::vector<std::unique_ptr<Worker>> workers;
  for (size_t k = 0; k < count; ++k) {
    std::vector<int64_t> frames;
    if (dealing == Dealing::kInTurn) {
      for (size_t i = k; i < missing.size(); i += count) frames.push_back(missing[i]);
    } else {
      const auto border = [&](size_t n) { return missing.begin() + static_cast<ptrdiff_t>(missing.size() * n / count); };
      frames.assign(border(k), border(k + 1));
    }
    workers.push_back(std::make_unique<Worker>(static_cast<int>(k), static_cast<int>(count), std::move(frames)));
    workers.back()->Start();
  }
  const auto line = [&](const std::string& text) {
    if (text.starts_with("frame ")) written();
    if (text.starts_with("total ")) AddTotals(text, result);
  };
  while (std::ranges::any_of(workers, [](const auto& w) { return w->running(); })) {
    std::vector<pollfd> waiting;
    std::vector<Worker*> which;
    for (const auto& worker : workers) {
      if (!worker->running()) continue;
      waiting.push_back({worker->output(), static_cast<short>(POLLIN | (worker->has_to_feed() ? POLLOUT : 0)), 0});
      which.push_back(worker.get());
    }
    if (::poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR)
      throw RuntimeError(std::string("--processes: ") + std::strerror(errno));
    for (size_t i = 0; i < waiting.size(); ++i) {
      if (waiting[i].revents & POLLOUT) which[i]->Feed();
      if ((waiting[i].revents & (POLLIN | POLLHUP | POLLERR)) == 0) continue;
      if (!which[i]->Listen(line) && !which[i]->End()) which[i]->Start();
    }
  }
}

}  // namespace

void ProcessArguments::AddTo(CLI::App& command) {
  command
      .add_option(
          "--processes", processes,
          "render in so many processes at once (default 1, or one for each of several --gpu); the dataset is the same, byte for byte")
      ->check(CLI::Range(1, kMostProcesses));
  command.add_option("--worker", worker)->group("");  // of those processes: not for people
}

int CountProcesses(const ProcessArguments& arguments, const GlobalOptions& globals) {
  const int gpus = static_cast<int>(globals.gpus.size());
  if (arguments.processes == 0) return std::max(gpus, 1);
  if (arguments.processes < gpus)
    throw InputError("--processes: " + std::to_string(arguments.processes) + " processes cannot use the " + std::to_string(gpus) +
                     " GPUs of --gpu");
  return arguments.processes;
}

void BecomeWorker(const ProcessArguments& arguments, GlobalOptions& globals) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  int number = 0, count = 1;
  if (std::sscanf(arguments.worker.c_str(), "%d/%d", &number, &count) != 2 || number < 0 || number >= count)
    throw InputError("--worker: '" + arguments.worker + "' is not K/N");
  if (!globals.gpus.empty()) globals.gpu = globals.gpus[static_cast<size_t>(number) % globals.gpus.size()];
  globals.gpus.clear();
  if (globals.threads > 0) return;
  // Left to the end of the process: the cores are shared by all.
  static const ThreadLimit share(std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / count));
}

void RunWorker(const WriteFramesHere& write) {
  std::vector<int64_t> frames;
  std::string line;
  while (std::getline(std::cin, line) && line != "end") frames.push_back(std::stoll(line));
  if (line != "end") throw RuntimeError("--worker: the process that knows the frames is gone");
  const CollectResult result = write(frames, [](int64_t frame) {
    std::printf("frame %lld\n", static_cast<long long>(frame));
    if (std::fflush(stdout) != 0) throw RuntimeError("--worker: the process that asked for frames is gone");
  });
  std::printf("total %.6f %.6f %llu\n", result.render_ms, result.write_ms, static_cast<unsigned long long>(result.rays));
}

RenderElsewhere RenderInProcesses(int processes, Dealing dealing) {
  return [processes, dealing](const std::vector<int64_t>& missing, const std::function<void()>& written, CollectResult& result) {
    RenderAll(processes, dealing, missing, written, result);
  };
}

}  // namespace airsim360

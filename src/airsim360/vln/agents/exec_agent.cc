// A program of the user's: a line of JSON in, a line of JSON out.
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>

#include "airsim360/base/base64.h"
#include "airsim360/base/error.h"
#include "airsim360/base/process.h"
#include "airsim360/vln/agents/observation.h"
#include "airsim360/vln/agents/told_agents.h"

extern char** environ;

namespace airsim360 {
namespace {

using internal::Tame;
using Clock = std::chrono::steady_clock;

constexpr size_t kLongestQuotedLine = 200;

// A child with pipes to its input and from its output, ended with all that it started.
class Child {
 public:
  explicit Child(const std::vector<std::string>& command) {
    int in[2], out[2];
    if (pipe2(in, O_CLOEXEC) != 0 || pipe2(out, O_CLOEXEC) != 0) throw RuntimeError("cannot make a pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in[0], 0);
    posix_spawn_file_actions_adddup2(&actions, out[1], 1);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const int failed = posix_spawnp(&pid_, arguments[0], &actions, &attributes, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    close(in[0]);
    close(out[1]);
    to_ = in[1];
    from_ = out[0];
    fcntl(to_, F_SETFL, O_NONBLOCK);
    if (failed) pid_ = -1;
  }
  ~Child() {
    close(to_);
    close(from_);
    if (pid_ <= 0) return;
    kill(-pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Its answer to a line; "" with `fault` set where none came.
  std::string Ask(const std::string& line, double seconds, std::string& fault) {
    if (pid_ <= 0) {
      fault = "the program cannot be started";
      return "";
    }
    const auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    const std::string text = line + "\n";
    size_t sent = 0;
    while (true) {
      const size_t end = held_.find('\n');
      if (sent == text.size() && end != std::string::npos) {
        std::string answer = held_.substr(0, end);
        held_.erase(0, end + 1);
        return answer;
      }
      if (held_.size() > kLongestAnswer) {
        fault = "an answer of more than 65536 bytes";
        held_.clear();
        return "";
      }
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
      if (left <= 0) {
        fault = "no answer within " + std::to_string(static_cast<int>(seconds)) + " s";
        return "";
      }
      if (!Exchange(text, sent, static_cast<int>(std::min<int64_t>(left, 1000)))) {
        fault = "the program has ended";
        return "";
      }
    }
  }

 private:
  // False: the other end is closed.
  bool Exchange(const std::string& text, size_t& sent, int milliseconds) {
    pollfd ends[2] = {{from_, POLLIN, 0}, {to_, POLLOUT, 0}};
    poll(ends, sent < text.size() ? 2 : 1, milliseconds);
    if (sent < text.size() && (ends[1].revents & (POLLOUT | POLLERR))) {
      const ssize_t count = write(to_, text.data() + sent, text.size() - sent);
      if (count > 0) sent += static_cast<size_t>(count);
      if (count < 0 && errno != EAGAIN && errno != EINTR) return false;
    }
    if (!(ends[0].revents & (POLLIN | POLLHUP))) return true;
    char bytes[4096];
    const ssize_t count = read(from_, bytes, sizeof(bytes));
    if (count > 0) held_.append(bytes, static_cast<size_t>(count));
    return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
  }

  pid_t pid_ = -1;
  int to_ = -1, from_ = -1;
  std::string held_;
};

class ExecAgent : public VlnAgent {
 public:
  explicit ExecAgent(const ExecOptions& options) : options_(options), child_(options.command) {}

  Decision Decide(VlnSituation& s) override {
    internal::VlnJson asked = internal::ObservationJson(s);
    internal::VlnJson pictures = internal::VlnJson::array();
    for (const VlnPicture& picture : s.eyes.Pictures(s.flight.vehicle().motion.X_WB, s.episode.weather, s.moved()))
      pictures.push_back(
          {{"name", picture.name}, {"width", picture.width}, {"height", picture.height}, {"jpeg_base64", Base64(picture.jpeg)}});
    asked["pictures"] = std::move(pictures);
    Decision decision;
    for (int attempt = 0; attempt < 2; ++attempt) {
      std::string fault;
      const std::string text = child_.Ask(asked.dump(-1, ' ', true, internal::VlnJson::error_handler_t::replace), options_.seconds, fault);
      if (!fault.empty()) {
        // What has ended or is late by now will not answer the next time: its lines would be out of step.
        decision.faults.push_back(fault);
        decision.answer = {PresetAction{Preset::kHover}};
        decision.give_up = true;
        return decision;
      }
      try {
        decision.said = text;
        decision.answer = ParseAnswer(text, s.decisions);
        in_a_row_ = 0;
        return decision;
      } catch (const InputError& error) {
        decision.faults.push_back(Tame(error.what(), kLongestQuotedLine) + " in '" + Tame(text, kLongestQuotedLine) + "'");
        asked["told"] = "your last answer could not be read: " + Tame(error.what(), kLongestQuotedLine);
      }
    }
    decision.answer = {PresetAction{Preset::kHover}};
    decision.give_up = ++in_a_row_ >= 3;
    return decision;
  }

 private:
  ExecOptions options_;
  Child child_;
  int in_a_row_ = 0;
};

}  // namespace

std::unique_ptr<VlnAgent> MakeExecAgent(const ExecOptions& options) {
  if (options.command.empty()) throw InputError("--agent exec: needs --program");
  if (options.command[0].find('/') == std::string::npos ? !FindProgram(options.command[0]) : access(options.command[0].c_str(), X_OK) != 0)
    throw InputError("--program: there is no program '" + options.command[0] + "'");
  signal(SIGPIPE, SIG_IGN);  // a program that has ended is a fault of its episode, not of ours
  return std::make_unique<ExecAgent>(options);
}

}  // namespace airsim360

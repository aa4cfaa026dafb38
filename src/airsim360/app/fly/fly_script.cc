#include "airsim360/app/fly/fly_script.h"

#include <charconv>
#include <cmath>
#include <cstdio>

#include "airsim360/base/error.h"
#include "airsim360/base/text.h"
#include "airsim360/math/coordinate_limit.h"

namespace airsim360 {
namespace {

constexpr double kLongestTask = 600;  // seconds that a task may take that ends by itself

constexpr std::pair<std::string_view, std::string_view> kForms[] = {
    {"takeoff", "takeoff [HEIGHT]"},        {"hover", "hover SECONDS"}, {"goto", "goto X,Y,Z[,SPEED]"},
    {"velocity", "velocity X,Y,Z,SECONDS"}, {"return", "return"},       {"land", "land"}};

// How the task is written that begins with the same word.
std::string FormOf(std::string_view task) {
  const std::string_view word = task.substr(0, task.find_first_of(" \t"));
  for (const auto& [name, form] : kForms) {
    if (name == word) return "'" + std::string(form) + "'";
  }
  return {};
}

[[noreturn]] void Fail(const std::string& task, const std::string& what) { throw InputError("--script: '" + task + "': " + what); }

constexpr const char* kBlanks = " \t\n";

// "1, 2.5,3": from `least` to `most` numbers.
std::vector<double> Numbers(const std::string& task, const std::string& text, size_t least, size_t most) {
  std::vector<double> numbers;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::string part(Trimmed(std::string_view(text).substr(begin, end - begin), kBlanks));
    double value = 0;
    const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || stop != part.data() + part.size() || !std::isfinite(value))
      Fail(task, "'" + part + "' is not a number; write " + FormOf(task));
    if (std::abs(value) > kCoordinateLimit) Fail(task, BeyondLimitText(value));
    numbers.push_back(value);
    begin = end + 1;
  }
  if (numbers.size() >= least && numbers.size() <= most) return numbers;
  Fail(task, "found " + std::to_string(numbers.size()) + " numbers; write " + FormOf(task));
}

double Positive(const std::string& task, double value) {
  if (value > 0 && value <= 1e6) return value;
  char text[64];
  std::snprintf(text, sizeof text, "%g is not above 0 and at most 1000000", value);
  Fail(task, text);
}

FlyTask ParseTask(const std::string& task) {
  const size_t space = std::min(task.find_first_of(" \t"), task.size());
  const std::string word = task.substr(0, space), rest = task.substr(space);
  const auto numbers = [&](size_t least, size_t most) { return Numbers(task, std::string(Trimmed(rest, kBlanks)), least, most); };
  if (word == "takeoff") {
    const auto n = numbers(0, 1);
    return {task, TakeoffCommand{.height = n.empty() ? 2 : Positive(task, n[0])}, kLongestTask, true};
  }
  if (word == "hover") return {task, HoverCommand{}, Positive(task, numbers(1, 1)[0])};
  if (word == "goto") {
    const auto n = numbers(3, 4);
    const double speed = n.size() > 3 ? Positive(task, n[3]) : 0;
    return {task, PositionCommand{.p_W = {n[0], n[1], n[2]}, .speed = speed, .yaw = {YawTarget::Mode::kForward}}, kLongestTask, true};
  }
  if (word == "velocity") {
    const auto n = numbers(4, 4);
    return {task, VelocityCommand{.v = {n[0], n[1], n[2]}}, Positive(task, n[3])};
  }
  if (word == "return" || word == "land") {
    numbers(0, 0);
    if (word == "return") return {task, ReturnCommand{}, kLongestTask, true};
    return {task, LandCommand{}, kLongestTask, true};
  }
  std::vector<std::string> words;
  for (const auto& form : kForms) words.emplace_back(form.first);
  throw InputError("--script: " + UnknownChoiceMessage("task", word, words));
}

}  // namespace

std::vector<FlyTask> ParseFlyScript(const std::string& text) {
  std::vector<FlyTask> tasks;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(';', begin), text.size());
    const std::string task(Trimmed(std::string_view(text).substr(begin, end - begin), kBlanks));
    if (!task.empty()) tasks.push_back(ParseTask(task));
    begin = end + 1;
  }
  if (tasks.empty()) throw InputError("--script: nothing to do");
  return tasks;
}

}  // namespace airsim360

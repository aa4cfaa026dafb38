// Worst case of base/pattern.h: hard expressions on many names. Usage: pattern_bench [EXPRESSIONS]. Prints
// milliseconds of processor time an expression takes, parsing included: mean, median, 99 %, worst.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/pattern.h"
#include "clock.h"

namespace {

std::mt19937 random_number(7);

int Below(int n) { return static_cast<int>(random_number() % static_cast<unsigned>(n)); }

std::string Sequence(int depth, int length);

std::string Atom(int depth) {
  static const char* const kAtoms[] = {".", "a", "[a-z]", "\\w", "[^_]", "e", "_", "\\d", "[aeiou]", "i", "(.*)", "(a|e)", "\\S"};
  if (depth == 0 || Below(2) == 0) return kAtoms[Below(13)];
  std::string text = "(" + Sequence(depth - 1, 1 + Below(3));
  while (Below(3) == 0) text += "|" + Sequence(depth - 1, 1 + Below(3));
  return text + ")";
}

std::string Sequence(int depth, int length) {
  static const char* const kTimes[] = {"*", "+", "?", "{2,9}", "{3}", "*?", "{0,20}", "{1,}", "", ""};
  std::string text;
  for (int i = 0; i < length; ++i) text += Atom(depth) + kTimes[Below(10)];
  return text;
}

// Nested repetitions, repeated choices, memory of the past, assertions beside them.
std::string HardExpression() {
  const auto times = [](int n) { return "{" + std::to_string(n) + "}"; };
  std::string text;
  switch (Below(8)) {
    case 0:
      return ".*[aeiou_]." + times(1 + Below(900)) + ".*";
    case 1: {
      const int depth = 1 + Below(300);
      for (int k = 0; k < depth; ++k) text += std::string("(.*") + static_cast<char>('a' + Below(26));
      for (int k = 0; k < depth; ++k) text += ")*";
      return text + "x";
    }
    case 2:
      for (int k = Below(200) + 2; k > 0; --k) text += ".?";
      return "(" + text + "|.*a." + times(Below(400)) + ")*";
    case 3:
      text = "(.*)*x";
      while (text.size() < 900 && Below(20) != 0) text = "(" + text + "|" + Atom(1) + "*)*";
      return text;
    case 4:
      return "\\b(.*[a-m]." + times(Below(200)) + "\\b|\\B)*";
    case 5:
      return "(.*[ae]." + times(Below(250)) + "|.*[io_]." + times(Below(250)) + "|(.?\\w?)" + times(1 + Below(200)) + ")";
    default:
      return Sequence(4, 2 + Below(6));
  }
}

// Names as worlds have them, and random ones.
std::vector<std::string> Names() {
  static const char* const kKinds[] = {"building", "tree",           "car",        "lamp",         "window_frame",
                                       "person",   "traffic_barrel", "bench_wood", "road_marking", "SM_Facade_Wall"};
  std::vector<std::string> names;
  for (int i = 0; i < 14000; ++i) {
    names.push_back(std::string(kKinds[Below(10)]) + "_" + std::to_string(Below(3000)) + "/" + kKinds[Below(10)] + "_" +
                    std::to_string(Below(100)));
  }
  for (int i = 0; i < 6000; ++i) {
    std::string name;
    for (int k = 5 + Below(40); k > 0; --k) name += "abcdefghijklmnopqrstuvwxyz_0123456789"[Below(37)];
    names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

double ProcessorMs() { return 1e3 * airsim360::SecondsOf(CLOCK_THREAD_CPUTIME_ID); }

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 10000;
  const std::vector<std::string> names = Names();
  std::vector<std::pair<double, std::string>> taken;
  int refused = 0;
  for (int i = 0; i < count; ++i) {
    const std::string text = HardExpression().substr(0, airsim360::kLongestPattern);
    const double start = ProcessorMs();
    try {
      const airsim360::Pattern pattern = airsim360::Pattern::Regex(text, true);
      airsim360::PatternMatcher matcher(pattern);
      for (const std::string& name : names) matcher.Matches(name);
    } catch (const airsim360::InputError&) {
      ++refused;
    }
    taken.emplace_back(ProcessorMs() - start, text);
  }
  std::ranges::sort(taken);
  double sum = 0;
  for (const auto& [ms, text] : taken) sum += ms;
  std::printf("%d expressions (%d refused) on %zu names: mean %.2f ms, median %.2f, 99 %% %.2f, worst %.2f: %s\n", count, refused,
              names.size(), sum / count, taken[taken.size() / 2].first, taken[taken.size() * 99 / 100].first, taken.back().first,
              taken.back().second.c_str());
  return 0;
}

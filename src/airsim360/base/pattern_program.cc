#include "airsim360/base/pattern_program.h"

#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/pattern.h"
#include "airsim360/base/pattern_expression.h"

namespace airsim360 {
namespace {

using Expression = internal::PatternExpression;
using Kind = PatternProgram::Kind;

constexpr uint32_t kMostSteps = 4096;  // of writing a program; repetitions of nothing count too

// Writes a program from its end to its start.
class Writer {
 public:
  PatternProgram Write(const Expression& expression) {
    program_.nodes.push_back({.kind = Kind::kEnd});
    program_.start = Emit(expression, 0);
    return std::move(program_);
  }

 private:
  // The node at which `e` begins, when `next` comes after it.
  uint32_t Emit(const Expression& e, uint32_t next) {
    using Form = Expression::Form;
    if (++steps_ > kMostSteps) throw InputError("pattern: too large once its repetitions are written out");
    switch (e.form) {
      case Form::kBytes:
        if (program_.places.size() >= kMostPatternPlaces) {
          throw InputError("pattern: more than " + std::to_string(kMostPatternPlaces) + " characters once its repetitions are written out");
        }
        program_.places.push_back(e.bytes);
        return Add({.kind = Kind::kPlace, .next = next, .place = static_cast<uint32_t>(program_.places.size() - 1)});
      case Form::kAssertion:
        return Add({.kind = e.assertion, .next = next});
      case Form::kSequence:
        for (size_t i = e.parts.size(); i-- > 0;) next = Emit(e.parts[i], next);
        return next;
      case Form::kChoice: {
        uint32_t ways = Emit(e.parts[0], next);
        for (size_t i = 1; i < e.parts.size(); ++i) {
          const uint32_t way = Emit(e.parts[i], next);
          ways = Add({.kind = Kind::kSplit, .next = ways, .other = way});
        }
        return ways;
      }
      case Form::kRepeat:
        return EmitRepeat(e, next);
    }
    return next;
  }

  uint32_t EmitRepeat(const Expression& e, uint32_t next) {
    const Expression& part = e.parts[0];
    if (e.most == Expression::kNoLimit) {
      const uint32_t split = Add({.kind = Kind::kSplit, .next = next, .other = next});
      const uint32_t again = Emit(part, split);
      program_.nodes[split].other = again;
      next = split;
    }
    // Each of the possible ones may be left out with all after it.
    const uint32_t end = next;
    for (int i = e.least; i < e.most; ++i) {
      const uint32_t once = Emit(part, next);
      next = Add({.kind = Kind::kSplit, .next = end, .other = once});
    }
    for (int i = 0; i < e.least; ++i) next = Emit(part, next);
    return next;
  }

  uint32_t Add(PatternProgram::Node node) {
    program_.nodes.push_back(node);
    return static_cast<uint32_t>(program_.nodes.size() - 1);
  }

  PatternProgram program_;
  uint32_t steps_ = 0;
};

void CheckLength(std::string_view text) {
  if (text.size() <= kLongestPattern) return;
  throw InputError("pattern: " + std::to_string(text.size()) + " characters are more than " + std::to_string(kLongestPattern));
}

}  // namespace

bool IsWordByte(uint8_t c) { return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

PatternProgram ParseRegex(std::string_view text, bool ignore_case) {
  CheckLength(text);
  return Writer().Write(internal::ParseRegexExpression(text, ignore_case));
}

PatternProgram ParseWildcard(std::string_view text) {
  CheckLength(text);
  Expression sequence;
  for (const char c : text) {
    const bool any = c == '*' || c == '?';
    Expression item{.form = Expression::Form::kBytes};
    any ? (void)item.bytes.set() : (void)item.bytes.set(static_cast<uint8_t>(c));
    if (c == '*') {
      Expression repeat{.form = Expression::Form::kRepeat, .least = 0, .most = Expression::kNoLimit};
      repeat.parts.push_back(std::move(item));
      item = std::move(repeat);
    }
    sequence.parts.push_back(std::move(item));
  }
  return Writer().Write(sequence);
}

}  // namespace airsim360

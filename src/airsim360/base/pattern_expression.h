// What a pattern says, as a tree: what parsing gives, before it is written out as a program.
#pragma once

#include <string_view>
#include <vector>

#include "airsim360/base/pattern_program.h"

namespace airsim360::internal {

struct PatternExpression {
  using ByteSet = PatternProgram::ByteSet;
  enum class Form : uint8_t { kBytes, kAssertion, kSequence, kChoice, kRepeat };
  static constexpr int kNoLimit = -1;

  Form form = Form::kSequence;
  ByteSet bytes = {};                                           ///< of kBytes
  PatternProgram::Kind assertion = PatternProgram::Kind::kEnd;  ///< of kAssertion
  int least = 0, most = 0;                                      ///< of kRepeat, whose part is the only one
  std::vector<PatternExpression> parts = {};
};

/// InputError as Pattern::Regex.
PatternExpression ParseRegexExpression(std::string_view text, bool ignore_case);

}  // namespace airsim360::internal

// Errors that carry the exit status the command line returns for them.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace airsim360 {

/// Something failed at run time (disk full, broken device): exit status 1.
class RuntimeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The user's input is wrong (flag, file, name): exit status 2. The message names the flag or
/// file:line:column, the value and the nearest valid choice.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The entry of `choices` that was meant by `word` (base/nearest_name.h), or "" where none is near.
std::string NearestChoice(std::string_view word, std::span<const std::string> choices);

/// "unknown <what> 'word'; did you mean 'x'? (choices: a, b, …)", without the question where no choice is
/// near: the text for a name that is not among `choices`.
std::string UnknownChoiceMessage(std::string_view what, std::string_view word, std::span<const std::string> choices);

}  // namespace airsim360

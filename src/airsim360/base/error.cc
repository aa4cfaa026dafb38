#include "airsim360/base/error.h"

#include "airsim360/base/nearest_name.h"
#include "airsim360/base/printable.h"

namespace airsim360 {

std::string UnknownChoiceMessage(std::string_view what, std::string_view word, std::span<const std::string> choices) {
  std::string message = "unknown " + std::string(what) + " '" + Printable(word.substr(0, 256)) + "'";
  if (choices.empty()) return message;
  message += DidYouMean(word, choices) + " (choices: ";
  for (size_t i = 0; i < choices.size(); ++i) message += (i ? ", " : "") + choices[i];
  return message + ")";
}

}  // namespace airsim360

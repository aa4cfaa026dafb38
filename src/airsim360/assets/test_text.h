// For tests of messages.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

namespace airsim360::internal {

/// Does `text` contain every part? Shows the text if not.
inline testing::AssertionResult Contains(const std::string& text, std::initializer_list<std::string> parts) {
  for (const std::string& part : parts) {
    if (text.find(part) == std::string::npos) return testing::AssertionFailure() << '"' << text << "\" lacks \"" << part << '"';
  }
  return testing::AssertionSuccess();
}

}  // namespace airsim360::internal

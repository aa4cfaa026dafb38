// Reading line-based text formats (OBJ, MTL, properties) with messages that name file:line.
#pragma once

#include <string>
#include <string_view>

#include "airsim360/base/error.h"

namespace airsim360::internal {

/// Steps through the lines of a text; a backslash at the end of a line continues it if `continuations`.
class TextLines {
 public:
  TextLines(std::string file, std::string_view text, bool continuations);
  /// The next line without its end and without blanks around it; false at the end of the text.
  bool Next(std::string_view& line);
  /// Throws InputError "file:line: what".
  [[noreturn]] void Fail(const std::string& what) const;
  int64_t line_number() const { return number_; }
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::string_view rest_;
  bool continuations_;
  char end_mark_;  ///< of a line: '\r' in files of the old Macintosh, which have no '\n'
  std::string joined_;
  int64_t number_ = 0;
  int64_t lines_read_ = 0;
};

/// Cuts the first word (up to a blank) off the front of `line`; "" at its end.
std::string_view NextWord(std::string_view& line);
/// Without blanks at both ends.
std::string_view Trimmed(std::string_view text);
/// The whole word as a finite number; InputError at the current line otherwise.
float ParseFloat(std::string_view word, const TextLines& where);

}  // namespace airsim360::internal

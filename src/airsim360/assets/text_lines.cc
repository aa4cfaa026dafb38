#include "airsim360/assets/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "airsim360/assets/imported.h"
#include "airsim360/base/text.h"

namespace airsim360::internal {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

}  // namespace

std::string_view Trimmed(std::string_view text) { return airsim360::Trimmed(text, kBlanks); }

std::string_view NextWord(std::string_view& line) {
  line = line.substr(std::min(line.find_first_not_of(kBlanks), line.size()));
  const size_t length = std::min(line.find_first_of(kBlanks), line.size());
  const std::string_view word = line.substr(0, length);
  line.remove_prefix(length);
  return word;
}

TextLines::TextLines(std::string file, std::string_view text, bool continuations)
    : file_(std::move(file)), rest_(text), continuations_(continuations), end_mark_(text.find('\n') == text.npos ? '\r' : '\n') {
  if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
}

bool TextLines::Next(std::string_view& line) {
  if (rest_.empty()) return false;
  number_ = lines_read_ + 1;
  joined_.clear();
  bool more = true;
  while (more) {
    const size_t end = std::min(rest_.find(end_mark_), rest_.size());
    line = Trimmed(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++lines_read_;

    // Lines that continue are gathered in a string of our own.
    more = continuations_ && !line.empty() && line.back() == '\\' && !rest_.empty();
    if (more || !joined_.empty()) {
      if (more) line.remove_suffix(1);
      joined_.append(line).append(" ");
    }
  }
  if (!joined_.empty()) line = Trimmed(joined_);
  return true;
}

void TextLines::Fail(const std::string& what) const { throw InputError(file_ + ":" + std::to_string(number_) + ": " + what); }

float ParseFloat(std::string_view word, const TextLines& where) {
  const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  // Too small for a double is as good as zero; too large is not.
  const bool underflow = error == std::errc::result_out_of_range && digits.find_first_of("eE") != std::string_view::npos &&
                         digits.find('-', 1) != std::string_view::npos;
  if ((error != std::errc() && !underflow) || end != digits.data() + digits.size()) {
    where.Fail(Quoted(word) + " is not a number");
  }
  const auto result = static_cast<float>(value);
  if (!std::isfinite(result)) where.Fail(Quoted(word) + " is not a finite number");
  return result;
}

}  // namespace airsim360::internal

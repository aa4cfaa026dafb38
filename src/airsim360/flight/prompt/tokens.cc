#include "airsim360/flight/prompt/tokens.h"

#include <charconv>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/nearest_name.h"

namespace airsim360::internal {
namespace {

constexpr size_t kLongestPrompt = 1000;

bool IsDigit(char c) { return c >= '0' && c <= '9'; }
bool IsLetter(char c) { return c >= 'a' && c <= 'z'; }

/// Lower case, hyphens between words as spaces; InputError for anything but plain text.
std::string Clean(std::string_view prompt) {
  if (prompt.size() > kLongestPrompt) throw InputError("the description is longer than 1000 characters");
  std::string text;
  for (size_t i = 0; i < prompt.size(); ++i) {
    char c = prompt[i];
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    const bool starts = i == 0 || prompt[i - 1] == ' ';
    if (c == '-' && starts && i + 1 < prompt.size() && IsDigit(prompt[i + 1])) {
      throw InputError("a negative number describes no drone: '" + std::string(prompt.substr(i, 12)) + "'");
    }
    if (c == '-' || c == '\t' || c == '\n' || c == '\r' || c == '(' || c == ')') c = ' ';
    if (c == ';') c = ',';
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) {
      throw InputError("the description holds a character that is not plain ASCII text");
    }
    text += c;
  }
  return text;
}

/// A plain decimal number at the start; its length, 0 if there is none.
size_t ReadNumber(std::string_view text, double& value) {
  if (text.empty() || !(IsDigit(text[0]) || (text[0] == '.' && text.size() > 1 && IsDigit(text[1]))))
    return 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc() || !(value < 1e9)) {
    throw InputError("the number '" + std::string(text.substr(0, 20)) + "' describes no drone");
  }
  return static_cast<size_t>(end - text.data());
}

/// "5x4.3x3" at the start; its length, 0 if there is none.
size_t ReadPropellerCode(std::string_view text, double (&code)[3]) {
  size_t at = ReadNumber(text, code[0]);
  for (int k = 1; at > 0 && k < 3; ++k) {
    if (at >= text.size() || text[at] != 'x') return k == 1 ? 0 : at;
    const size_t length = ReadNumber(text.substr(at + 1), code[k]);
    if (length == 0) return k == 1 ? 0 : at;
    at += 1 + length;
  }
  return at;
}

Token ReadWord(std::string_view rest) {
  size_t length = 0;
  while (length < rest.size() && (IsLetter(rest[length]) || IsDigit(rest[length]) || rest[length] == '/'))
    ++length;
  if (length == 0) length = 1;  // a sign such as "+"
  Token token;
  token.text = std::string(rest.substr(0, length));
  token.word = FindWord(token.text);
  if (token.word == nullptr) {
    throw InputError("the word '" + token.text + "' is not understood" + DidYouMean(token.text, LexiconTexts()) + ". " +
                     "`airsim360 drone --words` lists all that can be said");
  }
  return token;
}

}  // namespace

std::vector<Token> Tokenize(std::string_view prompt) {
  const std::string text = Clean(prompt);
  std::vector<Token> tokens;
  for (size_t at = 0; at < text.size();) {
    const std::string_view rest = std::string_view(text).substr(at);
    // A full stop ends a sentence, an apostrophe says nothing.
    const bool stop = rest[0] == '.' && !(rest.size() > 1 && IsDigit(rest[1]));
    if (rest[0] == ' ' || rest[0] == '\'' || rest[0] == '~') {
      ++at;
      continue;
    }
    Token token;
    size_t length = 1;
    if (rest[0] == ',' || stop || rest[0] == ':') {
      token.kind = Token::Kind::kComma;
    } else if (rest[0] == '"') {
      token.word = FindWord("inch");
    } else if (const size_t code = ReadPropellerCode(rest, token.code)) {
      token.kind = Token::Kind::kPropellerCode;
      length = code;
    } else if (const size_t number = ReadNumber(rest, token.value)) {
      token.kind = Token::Kind::kNumber;
      length = number;
      // "4:1"
      if (rest.substr(number).starts_with(":1") && !(rest.size() > number + 2 && IsDigit(rest[number + 2])))
        length += 2;
    } else {
      token = ReadWord(rest);
      length = token.text.size();
      if (token.word->kind == WordKind::kNumber) {
        token.kind = Token::Kind::kNumber;
        token.value = token.word->value;
      }
    }
    token.text = std::string(rest.substr(0, length));
    tokens.push_back(std::move(token));
    at += length;
  }
  return tokens;
}

}  // namespace airsim360::internal

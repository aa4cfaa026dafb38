#include "airsim360/base/pattern_expression.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/base/pattern.h"

namespace airsim360::internal {
namespace {

using Expression = PatternExpression;
using ByteSet = PatternProgram::ByteSet;
using Kind = PatternProgram::Kind;

constexpr int kNoLimit = Expression::kNoLimit;

template <class Test>
ByteSet BytesWhere(const Test& test) {
  ByteSet set;
  for (int c = 0; c < 256; ++c) set[static_cast<size_t>(c)] = test(static_cast<uint8_t>(c));
  return set;
}

bool IsAscii(uint8_t c) { return c < 128; }
bool IsDigit(uint8_t c) { return c >= '0' && c <= '9'; }
bool IsSpace(uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool IsUpper(uint8_t c) { return c >= 'A' && c <= 'Z'; }
bool IsLower(uint8_t c) { return c >= 'a' && c <= 'z'; }
uint8_t Lower(uint8_t c) { return IsUpper(c) ? static_cast<uint8_t>(c + 32) : c; }
uint8_t Upper(uint8_t c) { return IsLower(c) ? static_cast<uint8_t>(c - 32) : c; }

class RegexParser {
 public:
  RegexParser(std::string_view text, bool ignore_case) : text_(text), ignore_case_(ignore_case) {}

  Expression All() {
    Expression all = Choice();
    if (!AtEnd()) Fail("')' without '('");
    return all;
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError("regular expression: at character " + std::to_string(at_ + 1) + ": " + what);
  }
  bool AtEnd() const { return at_ == text_.size(); }
  uint8_t Peek() const { return AtEnd() ? 0 : static_cast<uint8_t>(text_[at_]); }
  bool Take(std::string_view what) {
    if (!text_.substr(at_).starts_with(what)) return false;
    at_ += what.size();
    return true;
  }

  Expression Choice() {
    Expression choice{.form = Expression::Form::kChoice};
    do choice.parts.push_back(Sequence());
    while (Take("|"));
    return choice.parts.size() == 1 ? std::move(choice.parts[0]) : choice;
  }

  Expression Sequence() {
    Expression sequence;
    while (!AtEnd() && Peek() != '|' && Peek() != ')') sequence.parts.push_back(Repeated());
    return sequence;
  }

  Expression Repeated() {
    Expression part = Single();
    while (const auto times = Times()) {
      if (part.form == Expression::Form::kAssertion) Fail("nothing to repeat");
      Expression repeat{.form = Expression::Form::kRepeat, .least = times->first, .most = times->second};
      repeat.parts.push_back(std::move(part));
      part = std::move(repeat);
    }
    return part;
  }

  // A repetition, if one is next.
  std::optional<std::pair<int, int>> Times() {
    std::pair<int, int> times;
    if (Take("*")) {
      times = {0, kNoLimit};
    } else if (Take("+")) {
      times = {1, kNoLimit};
    } else if (Take("?")) {
      times = {0, 1};
    } else if (Take("{")) {
      times.first = times.second = Count();
      if (Take(",")) times.second = Peek() == '}' ? kNoLimit : Count();
      if (!Take("}")) Fail("'{' without '}'");
      if (times.second != kNoLimit && times.second < times.first) Fail("'{m,n}' with n below m");
    } else {
      return {};
    }
    Take("?");  // as few as possible: the whole text matches just the same
    return times;
  }

  int Count() {
    if (!IsDigit(Peek())) Fail("a number is expected in '{}'");
    size_t count = 0;
    for (; IsDigit(Peek()); ++at_) count = std::min<size_t>(count * 10 + Peek() - '0', kMostPatternPlaces + 1);
    if (count > kMostPatternPlaces) Fail("more than " + std::to_string(kMostPatternPlaces) + " repetitions");
    return static_cast<int>(count);
  }

  Expression Single() {
    if (Take("(")) return Group();
    if (Take("[")) return Bytes(Class());
    if (Take(".")) return Bytes(BytesWhere([](uint8_t c) { return c != '\n' && c != '\r'; }));
    if (Take("^")) return Assertion(Kind::kLineBegin);
    if (Take("$")) return Assertion(Kind::kLineEnd);
    if (Take("\\b")) return Assertion(Kind::kWordEdge);
    if (Take("\\B")) return Assertion(Kind::kNoWordEdge);
    if (Take("\\")) return Bytes(Escape(false));
    if (std::string_view("*+?{").find(text_[at_]) != std::string_view::npos) Fail("nothing to repeat");
    return Bytes(Literal(static_cast<uint8_t>(text_[at_++])));
  }

  Expression Group() {
    if (Peek() == '?' && !Take("?:")) Fail("lookaheads are not possible here; only '(?:' may begin with '(?'");
    Expression inside = Choice();
    if (!Take(")")) Fail("'(' without ')'");
    return inside;
  }

  static Expression Bytes(const ByteSet& bytes) { return {.form = Expression::Form::kBytes, .bytes = bytes}; }
  static Expression Assertion(Kind kind) { return {.form = Expression::Form::kAssertion, .assertion = kind}; }

  ByteSet Literal(uint8_t c) const { return Range(c, c); }
  ByteSet Range(uint8_t from, uint8_t to) const {
    const auto is_in = [&](uint8_t c) { return c >= from && c <= to; };
    return BytesWhere([&](uint8_t c) { return is_in(c) || (ignore_case_ && (is_in(Lower(c)) || is_in(Upper(c)))); });
  }

  // What follows a backslash, which may be a whole class.
  ByteSet Escape(bool in_class) {
    if (AtEnd()) Fail("'\\' at the end");
    const char c = text_[at_];
    if (c >= '1' && c <= '9') Fail("back-references are not possible here");
    switch (c) {
      case 'd':
        ++at_;
        return BytesWhere(IsDigit);
      case 'D':
        ++at_;
        return ~BytesWhere(IsDigit);
      case 'w':
        ++at_;
        return BytesWhere(IsWordByte);
      case 'W':
        ++at_;
        return ~BytesWhere(IsWordByte);
      case 's':
        ++at_;
        return BytesWhere(IsSpace);
      case 'S':
        ++at_;
        return ~BytesWhere(IsSpace);
      default:
        return Literal(EscapedByte(in_class));
    }
  }

  uint8_t EscapedByte(bool in_class) {
    const char c = text_[at_++];
    switch (c) {
      case '0':
        return 0;
      case 'b':
        return in_class ? '\b' : static_cast<uint8_t>(c);
      case 'f':
        return '\f';
      case 'n':
        return '\n';
      case 'r':
        return '\r';
      case 't':
        return '\t';
      case 'v':
        return '\v';
      case 'c':
        if (AtEnd()) Fail("a letter is expected after '\\c'");
        return static_cast<uint8_t>(static_cast<uint8_t>(text_[at_++]) % 32);
      case 'x':
        return Hex(2);
      case 'u':
        return Hex(4);
      default:
        return static_cast<uint8_t>(c);
    }
  }

  uint8_t Hex(int digits) {
    unsigned value = 0;
    for (int i = 0; i < digits; ++i, ++at_) {
      const uint8_t c = Lower(Peek());
      if (!std::isxdigit(c)) Fail(std::to_string(digits) + " hexadecimal digits are expected");
      value = value * 16 + (IsDigit(c) ? c - '0' : c - 'a' + 10u);
    }
    if (value > 255) Fail("characters are bytes: '\\u' goes to 00ff");
    return static_cast<uint8_t>(value);
  }

  // The inside of [ ], of which the bracket has been taken.
  ByteSet Class() {
    const bool negated = Take("^");
    ByteSet set;
    while (!Take("]")) {
      if (AtEnd()) Fail("'[' without ']'");
      const auto [bytes, single] = ClassItem();
      const bool is_range = single && Peek() == '-' && at_ + 1 < text_.size() && text_[at_ + 1] != ']';
      if (!is_range) {
        set |= bytes;
        continue;
      }
      ++at_;
      const auto [others, last] = ClassItem();
      if (!last || *last < *single) Fail("a range in '[]' that does not ascend");
      set |= Range(*single, *last);
    }
    return negated ? ~set : set;
  }

  // One item of a class, and its byte if it is a single one.
  std::pair<ByteSet, std::optional<uint8_t>> ClassItem() {
    if (AtEnd()) Fail("'[' without ']'");
    if (Take("[:")) return {NamedClass(), {}};
    if (Peek() == '[' && (text_.substr(at_).starts_with("[.") || text_.substr(at_).starts_with("[=")))
      Fail("'[.' and '[=' are not possible here");
    if (!Take("\\")) {
      const auto c = static_cast<uint8_t>(text_[at_++]);
      return {Literal(c), c};
    }
    if (std::string_view("dDwWsS").find(static_cast<char>(Peek())) != std::string_view::npos && !AtEnd()) return {Escape(true), {}};
    if (AtEnd() || (Peek() >= '1' && Peek() <= '9')) return {Escape(true), {}};
    const uint8_t c = EscapedByte(true);
    return {Literal(c), c};
  }

  ByteSet NamedClass() {
    const size_t end = text_.find(":]", at_);
    if (end == std::string_view::npos) Fail("'[:' without ':]'");
    const std::string name(text_.substr(at_, end - at_));
    struct Named {
      const char* name;
      int (*test)(int);
    };
    static constexpr Named kNamed[] = {{"alnum", std::isalnum}, {"alpha", std::isalpha},  {"blank", std::isblank}, {"cntrl", std::iscntrl},
                                       {"digit", std::isdigit}, {"graph", std::isgraph},  {"print", std::isprint}, {"punct", std::ispunct},
                                       {"space", std::isspace}, {"xdigit", std::isxdigit}};
    for (const Named& named : kNamed) {
      if (name != named.name) continue;
      at_ = end + 2;
      return BytesWhere([&](uint8_t c) { return IsAscii(c) && named.test(c) != 0; });
    }
    const bool lower = name == "lower", upper = name == "upper";
    if (!lower && !upper) Fail("there is no class '[:" + name.substr(0, 20) + ":]'");
    at_ = end + 2;
    return BytesWhere([&](uint8_t c) { return IsLower(c) ? lower || ignore_case_ : IsUpper(c) && (upper || ignore_case_); });
  }

  std::string_view text_;
  bool ignore_case_;
  size_t at_ = 0;
};

}  // namespace

PatternExpression ParseRegexExpression(std::string_view text, bool ignore_case) { return RegexParser(text, ignore_case).All(); }

}  // namespace airsim360::internal

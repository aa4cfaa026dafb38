#include "airsim360/base/pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <regex>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

bool Matches(std::string_view regex, std::string_view text, bool ignore_case = false) {
  const Pattern pattern = Pattern::Regex(regex, ignore_case);
  return PatternMatcher(pattern).Matches(text);
}

bool MatchesWildcard(std::string_view wildcard, std::string_view text) {
  const Pattern pattern = Pattern::Wildcard(wildcard);
  return PatternMatcher(pattern).Matches(text);
}

// Random expressions that std::regex finishes on short texts.
class RandomRegex {
 public:
  explicit RandomRegex(uint32_t seed) : random_(seed) {}

  std::string Choice(int depth) {
    std::string text = Sequence(depth);
    for (int i = Below(4) == 0 ? 1 + Below(2) : 0; i > 0; --i) text += "|" + Sequence(depth);
    return text;
  }
  std::string Text() {
    static constexpr char kCharacters[] = "abcABZ_ 19.-\n\t/";
    std::string text;
    for (int i = Below(9); i > 0; --i) text += kCharacters[Below(sizeof kCharacters - 1)];
    return text;
  }

 private:
  int Below(int n) { return static_cast<int>(random_() % static_cast<uint32_t>(n)); }

  std::string Sequence(int depth) {
    std::string text;
    for (int i = Below(4); i > 0; --i) text += Item(depth);
    return text;
  }
  std::string Item(int depth) {
    static const std::vector<std::string> kAssertions = {"^", "$", "\\b", "\\B"};
    static const std::vector<std::string> kTimes = {"*", "+", "?", "*?", "+?", "??", "{2}", "{1,}", "{0,2}", "{1,3}?"};
    if (Below(8) == 0) return kAssertions[static_cast<size_t>(Below(4))];
    const std::string atom = Atom(depth);
    return Below(3) != 0 ? atom : atom + kTimes[static_cast<size_t>(Below(static_cast<int>(kTimes.size())))];
  }
  std::string Atom(int depth) {
    static const std::vector<std::string> kAtoms = {"a",     "b",     "c",      "A",      "Z",      "_",           " ",
                                                    "1",     "/",     "-",      ".",      "\\.",    "\\d",         "\\D",
                                                    "\\w",   "\\W",   "\\s",    "\\S",    "\\t",    "\\x41",       "[abc]",
                                                    "[^ab]", "[a-c]", "[^A-Z]", "[\\d_]", "[^\\s]", "[[:alpha:]]", "[[:upper:]1]",
                                                    "[.b-]", "]",     "}"};
    if (depth > 0 && Below(4) == 0) return (Below(2) ? "(" : "(?:") + Choice(depth - 1) + ")";
    return kAtoms[static_cast<size_t>(Below(static_cast<int>(kAtoms.size())))];
  }

  std::mt19937 random_;
};

TEST(Pattern, AgreesWithStdRegexOnRandomExpressionsAndTexts) {
  int matched = 0, asked = 0;
  for (uint32_t seed = 0; seed < 4000; ++seed) {
    RandomRegex random(seed);
    const std::string expression = random.Choice(3);
    const bool ignore_case = seed % 2 == 0;
    // The library's executor that does not backtrack: it ends.
    auto flags = std::regex::ECMAScript | std::regex_constants::__polynomial;
    if (ignore_case) flags |= std::regex::icase;
    const std::regex other(expression, flags);
    const Pattern pattern = Pattern::Regex(expression, ignore_case);
    PatternMatcher matcher(pattern);
    for (int i = 0; i < 20; ++i) {
      const std::string text = random.Text();
      const bool expected = std::regex_match(text, other);
      ASSERT_EQ(matcher.Matches(text), expected) << "seed " << seed << ": " << expression << " on '" << text << "'";
      matched += expected;
      ++asked;
    }
  }
  // The comparison is not one of refusals alone.
  EXPECT_GT(matched, asked / 20);
  EXPECT_LT(matched, asked / 2);
}

TEST(Pattern, RefusesTheSameMistakesAsStdRegex) {
  for (const char* text : {"[", "(", ")", "*", "+a", "a|*", "{2}", "a{2", "a{", "a{3,2}", "[b-a]", "\\", "(?", "[a", "a{x}",
                           "[[:nothing:]]", "^*", "\\x1", "[[:alpha:]"}) {
    EXPECT_THROW(std::regex(text, std::regex::ECMAScript), std::regex_error) << text;
    EXPECT_THROW(Pattern::Regex(text, false), InputError) << text;
  }
}

TEST(Pattern, RefusesWhatNoAutomatonOfItsSizeCanDoAndSaysWhere) {
  for (const auto& [text, part] : std::vector<std::pair<std::string, std::string>>{{"(a)\\1", "character 5: back-references"},
                                                                                   {"a(?=b)", "character 3: lookaheads"},
                                                                                   {"a(?!b)", "lookaheads"},
                                                                                   {"a{2000}", "more than 1024 repetitions"},
                                                                                   {"(a{100}){100}", "more than 1024 characters"},
                                                                                   {"(((()){1000}){1000}){1000}", "too large"},
                                                                                   {std::string(1001, 'a'), "1001 characters"}}) {
    try {
      Pattern::Regex(text, false);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(Pattern::Wildcard(std::string(1001, '*')), InputError);
  EXPECT_NO_THROW(Pattern::Regex(std::string(500, '(') + std::string(500, ')'), false));
}

TEST(Pattern, ExpressionsThatBacktrackersNeverFinishEndAtOnce) {
  const std::string text(500, 'a');
  const auto start = std::chrono::steady_clock::now();
  for (const char* regex : {"(.*)*x", "(.*.*)*x", "(a+)+b", "(a|aa)+$b", "(a|a)*b", "(.*a){20}x", "((a?){30}a{30})*b", "(\\w+\\s?)*x",
                            "(a|b|ab)*bc", "(.|a)*.{500}x"}) {
    EXPECT_FALSE(Matches(regex, text)) << regex;
  }
  EXPECT_TRUE(Matches("(.*)*", text));
  EXPECT_TRUE(Matches("(a|aa)+", text));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(Pattern, CountsOfThePastAreRemembered) {
  // Ten characters before the end an a: 1024 states of the deterministic automaton and more.
  const Pattern pattern = Pattern::Regex(".*a.{10}", false);
  PatternMatcher matcher(pattern);
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (int k = 0; k < 30; ++k) text += random() % 2 ? 'a' : 'b';
    ASSERT_EQ(matcher.Matches(text), text[text.size() - 11] == 'a') << text;
  }
}

TEST(Pattern, SharedBeginningsOfManyTextsChangeNothing) {
  // More states than a matcher keeps; dead ends at different depths; words beside other characters.
  const char* const expressions[] = {"[ab_ ]*a.{12}", "(a|b)+(\\b.{3}|_[ab]{14})", "b[ab]{0,20}.*a[^ ]{13}"};
  for (const char* expression : expressions) {
    const Pattern pattern = Pattern::Regex(expression, false);
    PatternMatcher shared(pattern);
    std::mt19937 random(4);
    std::vector<std::string> texts;
    for (int i = 0; i < 6000; ++i) {
      std::string text;
      for (size_t k = random() % 40; k > 0; --k) text += "aaabbb_ "[random() % 8];
      texts.push_back(text);
    }
    std::ranges::sort(texts);
    int matched = 0;
    for (const std::string& text : texts) {
      PatternMatcher alone(pattern);
      const bool expected = alone.Matches(text);
      ASSERT_EQ(shared.Matches(text), expected) << expression << " on '" << text << "'";
      matched += expected;
    }
    EXPECT_GT(matched, 10) << expression;
  }
}

TEST(Pattern, OneLongTextMayFillTheTablesManyTimes) {
  const Pattern pattern = Pattern::Regex(".*a.{20}", false);
  PatternMatcher matcher(pattern);
  std::mt19937 random(2);
  std::string text;
  for (int k = 0; k < 100000; ++k) text += random() % 2 ? 'a' : 'b';
  for (int k = 0; k < 50; ++k) {
    text += random() % 2 ? 'a' : 'b';
    ASSERT_EQ(matcher.Matches(text), text[text.size() - 21] == 'a') << k;
  }
}

TEST(Pattern, NeighboursInAListGetTheirOwnAnswers) {
  const Pattern pattern = Pattern::Regex("wall_(1|22)", true);
  PatternMatcher matcher(pattern);
  const std::pair<const char*, bool> cases[] = {{"wall_1", true},  {"wall_12", false}, {"wall_", false},
                                                {"WALL_22", true}, {"wall_22", true},  {"wall_22", true},
                                                {"", false},       {"door", false},    {"wall_1", true}};
  for (const auto& [text, expected] : cases) EXPECT_EQ(matcher.Matches(text), expected) << text;
}

// The textbook definition, by recursion.
bool SlowWildcard(std::string_view p, std::string_view t) {
  if (p.empty()) return t.empty();
  if (p[0] == '*') return SlowWildcard(p.substr(1), t) || (!t.empty() && SlowWildcard(p, t.substr(1)));
  return !t.empty() && (p[0] == '?' || p[0] == t[0]) && SlowWildcard(p.substr(1), t.substr(1));
}

TEST(Pattern, WildcardsAgreeWithTheirDefinition) {
  std::mt19937 random(3);
  const auto text = [&](std::string_view characters) {
    std::string out;
    for (size_t i = random() % 8; i > 0; --i) out += characters[random() % characters.size()];
    return out;
  };
  int matched = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::string wildcard = text("ab*?.["), name = text("ab.[");
    ASSERT_EQ(MatchesWildcard(wildcard, name), SlowWildcard(wildcard, name)) << wildcard << " on " << name;
    matched += SlowWildcard(wildcard, name);
  }
  EXPECT_GT(matched, 1000);
  EXPECT_TRUE(MatchesWildcard("Cylinder*", "Cylinder_12"));
  EXPECT_FALSE(MatchesWildcard("cylinder*", "Cylinder_12"));
  EXPECT_TRUE(MatchesWildcard("*a*b*", "xxayybzz"));
  EXPECT_FALSE(MatchesWildcard(std::string(30, '*') + "b", std::string(5000, 'a')));
}

}  // namespace
}  // namespace airsim360

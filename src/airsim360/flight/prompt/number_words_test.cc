// Numbers in words and how many words belong to each.
#include "airsim360/flight/prompt/number_words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

std::string BelowHundred(int n) {
  static const char* const kSmall[] = {"",         "one",     "two",     "three",     "four",     "five",    "six",
                                       "seven",    "eight",   "nine",    "ten",       "eleven",   "twelve",  "thirteen",
                                       "fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen"};
  static const char* const kTens[] = {"", "", "twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety"};
  if (n < 20) return kSmall[n];
  return kTens[n / 10] + std::string(n % 10 ? "-" : "") + kSmall[n % 10];
}

std::string Joined(const std::string& whole, const std::string& rest, const char* link) {
  return whole.empty() || rest.empty() ? whole + rest : whole + link + rest;
}

/// `link`: what stands before the last part, " " or " and ".
std::string InWords(int n, const char* link) {
  const std::string thousands = n >= 1000 ? BelowHundred(n / 1000) + " thousand" : "";
  const std::string hundreds = n % 1000 >= 100 ? BelowHundred(n % 1000 / 100) + " hundred" : "";
  const std::string rest = BelowHundred(n % 100);
  if (rest.empty()) return Joined(thousands, hundreds, link);
  return Joined(Joined(thousands, hundreds, " "), rest, link);
}

/// The first number of a text, with its unit right after it; else -1.
double First(const std::string& text) {
  const std::vector<Token> tokens = Tokenize(text);
  for (size_t i = 0; i + 1 < tokens.size(); ++i) {
    if (tokens[i].kind == Token::Kind::kNumber) return tokens[i + 1].Is(WordKind::kMassUnit) ? tokens[i].value : -1;
  }
  return -1;
}

TEST(NumberWords, EveryEnglishNumberComesBackWithAndWithoutAnd) {
  for (int n = 11; n < 30000; n += n < 1300 ? 1 : 37) {
    EXPECT_EQ(First(InWords(n, " ") + " grams"), n) << InWords(n, " ");
    EXPECT_EQ(First(InWords(n, " and ") + " grams"), n) << InWords(n, " and ");
  }
}

TEST(NumberWords, HundredsAreCountedPastTen) {
  EXPECT_EQ(First("twelve hundred and fifty grams"), 1250);
  EXPECT_EQ(First("eleven hundred grams"), 1100);
  EXPECT_EQ(First("a hundred and eighty grams"), 180);
  EXPECT_EQ(First("a thousand two hundred grams"), 1200);
  EXPECT_EQ(First("two and a half thousand grams"), 2500);
}

TEST(NumberWords, FiguresAsProgramsWriteThem) {
  EXPECT_EQ(First("1e3 g quad"), 1000);
  EXPECT_EQ(First("1.5E+3 g quad"), 1500);
  EXPECT_EQ(First("5e-1 kg quad"), 0.5);
  EXPECT_EQ(First("25e1kg quad"), 250);
  EXPECT_EQ(First("mass: 2.5e-01 kg"), 0.25);
  EXPECT_THROW(Tokenize("1e99 kg quad"), InputError);
}

TEST(NumberWords, AndBetweenTwoFiguresJoinsNothing) {
  const std::vector<Token> tokens = Tokenize("two batteries and four motors");
  EXPECT_EQ(std::count_if(tokens.begin(), tokens.end(), [](const Token& t) { return t.kind == Token::Kind::kNumber; }), 2);
  EXPECT_EQ(First("five and twenty grams"), -1);
}

}  // namespace
}  // namespace airsim360::internal

#include "airsim360/worlds/words/word_tokens.h"

#include <gtest/gtest.h>

namespace airsim360::internal {
namespace {

// Tokens with blanks between; numbers as they are understood: "[3..5]", "[>=3]".
std::string Read(const char* words) {
  static constexpr const char* kLimits[] = {"", ">=", "<=", ">", "<"};
  std::string all;
  for (const WordToken& token : WordTokens(words)) {
    char text[64];
    if (token.number && token.upper)
      std::snprintf(text, sizeof text, "[%g..%g]", *token.number, *token.upper);
    else if (token.number)
      std::snprintf(text, sizeof text, "[%s%g]", kLimits[static_cast<size_t>(token.limit)], *token.number);
    all += (all.empty() ? "" : " ") + (token.number ? text : token.plain);
  }
  return all;
}

TEST(WordTokens, NumbersAreOneTokenHoweverTheyAreWritten) {
  for (const auto& [words, read] : {std::array<const char*, 2>{"Two hundred and fifty houses", "[250] house"},
                                    {"twenty-five people", "[25] people"},
                                    {"twenty two-storey houses", "[20] [2] storey house"},
                                    {"10,000 m2, 1,5 ha", "[10000] m2 [1.5] ha"},
                                    {"20.000 m²", "[20000] m2"},
                                    {"40x20m", "[40] x [20] m"},
                                    {"300m × 200m", "[300] m x [200] m"},
                                    {"1/2 acre, 2 1/2 ha, ½ km2", "[0.5] acre [2.5] ha [0.5] km2"},
                                    {"half a square mile, a quarter of a hectare", "[0.5] square mile [0.25] hectare"},
                                    {"half a town, a quarter", "half a town a quarter"},
                                    {"a couple of parks, a couple of dozen houses", "a [2] park a [24] house"},
                                    {"half a dozen", "[6]"},
                                    {"several squares", "[3..7] square"},
                                    {"-5ha, \u22123 floors", "[-5] ha [-3] floor"},
                                    {"1e308 ha", "[1e+308] ha"}})
    EXPECT_EQ(Read(words), read) << words;
}

TEST(WordTokens, RangesAndLimitsBelongToTheNumber) {
  for (const auto& [words, read] : {std::array<const char*, 2>{"3-5 storeys", "[3..5] storey"},
                                    {"3\u20135 storeys", "[3..5] storey"},
                                    {"3 - 5 storeys", "[3..5] storey"},
                                    {"between two and four", "[2..4]"},
                                    {"from 2 to 4", "[2..4]"},
                                    {"one or two floors", "[1..2] floor"},
                                    {"2 to -4", "[2..-4]"},
                                    {"at least three, no more than 4", "[>=3] [<=4]"},
                                    {"over a dozen", "[>12]"},
                                    {"< 3 floors, ≥ 4 floors", "[<3] floor [>=4] floor"},
                                    {"30 houses maximum", "[<=30] house"},
                                    {"3 or more floors, 4+ floors", "[>=3] floor [>=4] floor"},
                                    {"2 parks at most 3 floors", "[2] park [<=3] floor"},
                                    {"approx. 10 acres, ca. 5 ha, ~12 m", "[10] acre [5] ha [12] m"},
                                    {"about 3 to 4 ha", "[3..4] ha"},
                                    {"a dozen or so people", "a [12] people"}})
    EXPECT_EQ(Read(words), read) << words;
}

TEST(WordTokens, TheTokensTogetherAreTheDescription) {
  const auto tokens = WordTokens("At least 3-storey houses (tree-lined), about 1/2 km2: 3-5 cafés!");
  EXPECT_EQ(JoinedTokens(tokens, 0, tokens.size()), "at least 3 storey houses tree lined about 1/2 km2 3-5 cafes");
}

TEST(WordTokens, Units) {
  EXPECT_NEAR(MetresOf("mile"), 1609.3, 0.1);
  EXPECT_EQ(MetresOf("house"), 0);
  const auto tokens = WordTokens("2 sq. ft, 3 acres, 4 square towns");
  EXPECT_NEAR(SquareMetresAt(tokens, 1).first, 0.0929, 1e-4);
  EXPECT_EQ(SquareMetresAt(tokens, 1).second, 2u);
  EXPECT_EQ(SquareMetresAt(tokens, 4).second, 1u);
  EXPECT_EQ(SquareMetresAt(tokens, 6).second, 0u);
}

}  // namespace
}  // namespace airsim360::internal

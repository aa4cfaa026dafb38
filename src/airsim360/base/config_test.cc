#include "airsim360/base/config.h"

#include <gtest/gtest.h>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

struct Example {
  bool fog = false;
  uint64_t seed = 7;
  double height = 2;
  std::string name = "town";
  std::vector<std::string> tags;
  double azimuth = 0;

  void Visit(ConfigVisitor& v) {
    v.Field("fog", "whether there is fog", fog);
    v.Field("seed", "random seed", seed);
    v.Field("height", "metres", height, 0, 100);
    v.Field("name", "name", name);
    v.Field("tags", "tags", tags);
    v.Group("sun", "the sun", [&](ConfigVisitor& g) { g.Field("azimuth", "degrees", azimuth, 0, 360); });
  }
};

Example Read(std::string_view text) {
  Example example;
  ReadYaml(text, "x.yaml", [&](ConfigVisitor& v) { example.Visit(v); });
  return example;
}

std::string ErrorOf(std::string_view text) {
  try {
    Read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Config, ReadsEveryKindOfFieldAndKeepsDefaults) {
  const Example e = Read("fog: true\nheight: 3.5\ntags: [a, b]\nsun: {azimuth: 90}\n");
  EXPECT_TRUE(e.fog);
  EXPECT_EQ(e.seed, 7u);
  EXPECT_EQ(e.height, 3.5);
  EXPECT_EQ(e.name, "town");
  EXPECT_EQ(e.tags, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(e.azimuth, 90);
}

TEST(Config, ErrorsNameThePlaceTheValueAndTheNearestKey) {
  EXPECT_NE(ErrorOf("fog: true\nhieght: 3\n").find("x.yaml:2:1: unknown key 'hieght'; did you mean 'height'?"), std::string::npos);
  EXPECT_NE(ErrorOf("sun:\n  azimut: 3\n").find("x.yaml:2:3: unknown key 'azimut'; did you mean 'azimuth'?"), std::string::npos);
  EXPECT_NE(ErrorOf("height: tall\n").find("x.yaml:1:9: height: expected a number, found 'tall'"), std::string::npos);
  EXPECT_NE(ErrorOf("height: 101\n").find("from 0 to 100"), std::string::npos);
  EXPECT_NE(ErrorOf("height: .nan\n").find("from 0 to 100"), std::string::npos);
  EXPECT_NE(ErrorOf("seed: -1\n").find("0 or more"), std::string::npos);
  EXPECT_NE(ErrorOf("fog: [1\n").find("x.yaml:"), std::string::npos);
  EXPECT_NE(ErrorOf("fog: true\nfog: false\n").find("twice"), std::string::npos);
  EXPECT_NE(ErrorOf("- a\n- b\n").find("key: value"), std::string::npos);
  EXPECT_NE(ErrorOf("[a]: 1\n").find("plain word"), std::string::npos);
}

enum class Size { kSmall, kLarge };
constexpr const char* kSizeNames[] = {"small", "large"};

struct Chosen {
  Size size = Size::kSmall;
  int count = 0;
  double level = 1.5;
  bool automatic = false;
  void Visit(ConfigVisitor& v) {
    v.Field("size", "one of two", size, kSizeNames);
    v.Count("count", "how many", count, 8);
    v.NumberOr("level", "how much", "auto", automatic, level, -2, 2);
  }
};

Chosen ReadChosen(std::string_view text) {
  Chosen chosen;
  ReadYaml(text, "x.yaml", [&](ConfigVisitor& v) { chosen.Visit(v); });
  return chosen;
}

TEST(Config, WordsCountsAndNumbersOrAWordAreReadAndKeepWhatIsNotGiven) {
  const Chosen all = ReadChosen("size: large\ncount: 8\nlevel: auto\n");
  EXPECT_EQ(all.size, Size::kLarge);
  EXPECT_EQ(all.count, 8);
  EXPECT_TRUE(all.automatic);
  const Chosen none = ReadChosen("{}");
  EXPECT_EQ(none.size, Size::kSmall);
  EXPECT_EQ(none.count, 0);
  EXPECT_FALSE(none.automatic);
  EXPECT_EQ(none.level, 1.5);
  EXPECT_EQ(ReadChosen("level: -2").level, -2);
}

TEST(Config, WordsCountsAndNumbersOutOfRangeAreRefusedWithTheirPlace) {
  const auto refusal = [](std::string_view text) -> std::string {
    try {
      ReadChosen(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(refusal("size: lrge"), "x.yaml:1:7: size: unknown size 'lrge'; did you mean 'large'? (choices: small, large)");
  for (const char* text :
       {"count: 0", "count: 9", "count: -1", "count: 4000000000", "count: 99999999999999999999", "count: 1.5", "count: many", "count: [1]"})
    EXPECT_NE(refusal(text).find("x.yaml:1:8: count: expected a whole number from 1 to 8"), std::string::npos) << refusal(text);
  for (const char* text : {"level: 2.1", "level: .nan", "level: .inf", "level: -1e300"})
    EXPECT_NE(refusal(text).find("x.yaml:1:8: level: expected a number from -2 to 2"), std::string::npos) << refusal(text);
  for (const char* text : {"level: atuo", "level: 1e999", "level: [1]"})
    EXPECT_NE(refusal(text).find("x.yaml:1:8: level: expected a number"), std::string::npos) << refusal(text);
}

TEST(Config, DeepNestingIsAnErrorNotACrash) {
  EXPECT_NE(ErrorOf(std::string(100000, '[')), "no error");
  EXPECT_NE(ErrorOf(std::string(100000, '{')), "no error");
}

TEST(Config, ASecondDocumentIsRefused) {
  EXPECT_EQ(ErrorOf("seed: 3\n---\nseed: 4\n").find("a second document") != std::string::npos, true) << ErrorOf("seed: 3\n---\nseed: 4\n");
}

TEST(Config, DescribesEveryField) {
  Example e;
  const std::string text = DescribeConfig([&](ConfigVisitor& v) { e.Visit(v); });
  EXPECT_NE(text.find("seed: 7  # random seed"), std::string::npos);
  EXPECT_NE(text.find("  azimuth: 0  # degrees"), std::string::npos);
}

}  // namespace
}  // namespace airsim360

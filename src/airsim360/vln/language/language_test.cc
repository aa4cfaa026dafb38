// Language data of a made-up town of boxes: what is said is compared with what one can tell by hand, and with the second method.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/parallel.h"
#include "airsim360/vln/language/balance.h"
#include "airsim360/vln/language/check_language.h"
#include "airsim360/vln/language/layouts.h"
#include "airsim360/vln/language/make_language.h"
#include "airsim360/vln/language/pickle.h"
#include "airsim360/vln/language/second_look.h"
#include "airsim360/vln/language/sight.h"
#include "airsim360/vln/predicates/test_town.h"

namespace airsim360 {
namespace {

using internal::VlnJson;

// Streets of things between four houses.
std::shared_ptr<const Scene> Town() {
  static const std::shared_ptr<const Scene> kTown = [] {
    TestTown town;
    town.Box("ground", "ground/road", {0, 0, 0}, {140, 140, 0.2f}, -0.2f);
    RngStream random(7, "town");
    for (const float x : {-30.0f, 30.0f})
      for (const float y : {-30.0f, 30.0f}) town.Box("house", "construction/building", {x, y, 0}, {24, 24, 12});
    struct Kind {
      const char *name, *category;
      Vec3f size;
      int count;
    };
    for (const Kind& kind :
         {Kind{"bus", "vehicle/bus", {8, 2.5f, 3}, 5}, Kind{"taxi", "vehicle/car", {4, 1.8f, 1.5f}, 6},
          Kind{"van", "vehicle/van", {4, 2, 2}, 3}, Kind{"bench", "furniture/seating/bench", {1.6f, 0.6f, 0.9f}, 10},
          Kind{"fountain", "construction/fountain", {3, 3, 1.5f}, 4}, Kind{"booth", "construction/phone_booth", {1, 1, 2.3f}, 8},
          Kind{"sign", "signage/traffic_sign", {0.7f, 0.2f, 2.5f}, 12}, Kind{"tree", "vegetation/tree", {2.5f, 2.5f, 6}, 10}}) {
      for (int i = 0; i < kind.count; ++i) {
        // On the cross of streets or around the houses.
        const float along = static_cast<float>(random.Uniform(-62, 62)), off = static_cast<float>(random.Uniform(-14, 14));
        const bool east = random.Chance(0.5);
        // Of different sizes: where two overlap, no faces coincide.
        town.Box(kind.name, kind.category, east ? Vec3f{along, off, 0} : Vec3f{off, along, 0},
                 kind.size * (1 + 0.01f * static_cast<float>(i)));
      }
    }
    return town.Build();
  }();
  return kTown;
}

std::shared_ptr<Stage> TownStage() { return std::make_shared<Stage>(Town(), StageOptions{.world = {.world = "town", .seed = 3}}); }

std::vector<std::string> LinesOf(const LanguageOptions& options) {
  std::vector<std::string> lines;
  MakeLanguage(*TownStage(), options, [&](const std::string& line) { lines.push_back(line); });
  return lines;
}

std::filesystem::path Written(const std::string& name, const std::vector<std::string>& lines) {
  const auto path = std::filesystem::temp_directory_path() / ("language_test_" + std::to_string(getpid()) + "_" + name);
  std::ofstream out(path);
  for (const std::string& line : lines) out << line << "\n";
  return path;
}

std::vector<LanguageComplaint> Complaints(const std::vector<std::string>& lines) {
  const auto path = Written("check.jsonl", lines);
  const auto check = CheckLanguage(path, [](const std::string&, uint64_t) { return TownStage(); });
  std::filesystem::remove(path);
  return check.complaints;
}

const std::vector<std::string>& Questions() {
  static const auto kLines = LinesOf({.kind = "vqa", .count = 240, .width = 512});
  return kLines;
}

TEST(Lexicon, ACabIsACarAndAVanMayBeTakenForOne) {
  const Lexicon lexicon(*Town());
  const auto word = [&](const std::string& one) {
    return static_cast<uint16_t>(std::ranges::find(lexicon.words(), one, &Word::one) - lexicon.words().begin());
  };
  const auto is = [](std::span<const uint16_t> list, uint16_t w) { return std::ranges::find(list, w) != list.end(); };
  for (const Entity& e : Town()->entities) {
    if (e.name.starts_with("taxi")) {
      EXPECT_TRUE(is(lexicon.NamedBy(e.id), word("cab")) && is(lexicon.NamedBy(e.id), word("car")));
    }
    if (e.name.starts_with("van")) {
      EXPECT_TRUE(is(lexicon.NamedBy(e.id), word("van")) && is(lexicon.MistakenFor(e.id), word("car")));
    }
    if (e.name.starts_with("house")) {
      EXPECT_TRUE(lexicon.NamedBy(e.id).empty());
    }
  }
}

TEST(Sight, PixelsBecomeAnglesAlsoAcrossTheSeam) {
  const internal::Picture picture{true, 0, {}, 360, 180};
  Frame frame;
  frame.entity = Image<EntityId>(360, 180);
  frame.range = Image<float>(360, 180);
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 360; ++x) {
      frame.entity(x, y) = (x < 10 || x >= 350) && y >= 80 && y < 100 ? 7 : x >= 260 && x < 280 && y >= 80 && y < 100 ? 8 : 1;
      frame.range(x, y) = frame.entity(x, y) == 8 ? 5.0f + static_cast<float>(x) : 9;
    }
  }
  const auto seen = internal::Look(picture, frame);
  ASSERT_EQ(seen.size(), 3U);
  EXPECT_EQ(seen[1].pixels, 400);
  EXPECT_NEAR(std::abs(seen[1].azimuth_deg), 180, 1e-6);
  EXPECT_NEAR(seen[1].right_deg - seen[1].left_deg, 19, 1e-9);
  EXPECT_TRUE(seen[1].round);
  EXPECT_TRUE(seen[1].clear()) << "a panorama goes on behind its seam";
  EXPECT_NEAR(seen[2].azimuth_deg, 90, 1e-9);
  EXPECT_NEAR(seen[2].elevation_deg, 0, 1e-9);
  EXPECT_FLOAT_EQ(static_cast<float>(seen[2].nearest), 265);
  EXPECT_FALSE(seen[2].round);
}

TEST(SurfacePoints, LieOnTheThingEvenly) {
  TestTown town;
  const EntityId slab = town.Box("slab", "furniture/box", {4, 5, 0}, {6, 2, 1});
  const internal::SurfacePoints surfaces(town.Build());
  const auto points = surfaces.Of(slab);
  ASSERT_NEAR(static_cast<double>(points.size()), internal::SurfacePoints::kMost, 2);
  Vec3d sum;
  for (const Vec3d& p : points) {
    const Vec3d off{std::abs(p.x - 4) - 3, std::abs(p.y - 5) - 1, std::abs(p.z - 0.5) - 0.5};
    EXPECT_NEAR(std::max({off.x, off.y, off.z}), 0, 1e-5) << "on its surface";
    sum += p;
  }
  // The mean of a surface that is its own mirror image is its middle.
  EXPECT_LT(Norm(sum / static_cast<double>(points.size()) - Vec3d{4, 5, 0.5}), 0.25);
}

// A shelf full of books: each of them is less than one of the points.
TEST(SurfacePoints, LieOnThingsOfManySmallPartsToo) {
  TestTown town;
  const EntityId shelf = town.Boxes("shelf", "furniture/bookcase", 300, {0, 10, 0}, {0.1f, 0, 0}, {0.1f, 1, 1});
  const internal::SurfacePoints surfaces(town.Build());
  const auto points = surfaces.Of(shelf);
  ASSERT_NEAR(static_cast<double>(points.size()), internal::SurfacePoints::kMost, 2);
  Vec3d sum;
  for (const Vec3d& p : points) sum += p;
  EXPECT_LT(Norm(sum / static_cast<double>(points.size()) - Vec3d{14.95, 10, 0.5}), 0.5);
}

// A thing of many pixels may be a strip of something at the edge of a camera's picture, or the top of something behind a wall.
TEST(Sight, WhatIsSmallHiddenOrCutIsNotClear) {
  TestTown town;
  const EntityId whole = town.Box("whole", "furniture/box", {10, 5, 0}, {1, 1, 2}),
                 far = town.Box("far", "furniture/box", {60, -8, 0}, {1, 1, 2}),
                 hidden = town.Box("hidden", "furniture/box", {20, -2, 0}, {2, 2, 4}),
                 cut = town.Box("cut", "furniture/box", {10, -11, 0}, {4, 4, 2});
  town.Box("wall", "construction/wall", {15, -1.5f, 0}, {0.2f, 4, 3});
  const auto scene = town.Build();
  Stage stage(scene, StageOptions{.world = {.world = "t", .seed = 1}});
  const internal::Picture picture{false, 0, {{0, 0, 1.8}, 0}, 512, 512};
  Frame frame;
  stage.renderer(Tier::kLabels)
      .Render(
          MakeRequest(picture.camera(), picture.X_WC(), Tier::kLabels, {.rgb = false, .range = true, .semantic = false, .entity = true}),
          frame);
  const internal::SurfacePoints surfaces(scene);
  internal::SecondLook second(stage.tracer());
  LanguagePicture same;
  same.panorama = false;
  same.position = {0, 0, 1.8};
  same.width = same.height = 512;
  for (const internal::Seen& seen : internal::Look(picture, frame, &surfaces)) {
    if (seen.entity == whole) {
      EXPECT_TRUE(seen.clear());
      EXPECT_GT(seen.shown, 0.95);
    }
    if (seen.entity == far) {
      EXPECT_FALSE(seen.clear()) << seen.pixels;
    }
    if (seen.entity == hidden || seen.entity == cut) {
      EXPECT_GT(seen.pixels, 200);
      EXPECT_FALSE(seen.clear()) << seen.shown;
    }
    // By rays of the second method.
    if (seen.entity == whole || seen.entity == hidden) {
      EXPECT_NEAR(second.Shown(same, seen.entity), seen.shown, 0.25);
    }
  }
}

TEST(Language, EveryQuestionIsAskedWithEachOfItsAnswersEquallyOften) {
  std::map<std::string, std::map<std::string, int>> answers;
  std::map<std::string, std::set<std::string>> choices;
  for (const std::string& line : Questions()) {
    const VlnJson item = VlnJson::parse(line);
    const auto key = item["question"].get<std::string>() + item["choices"].dump();
    ++answers[key][item["answer"].dump()];
    EXPECT_EQ(item["choices"][item["answer_index"].get<size_t>()], item["answer"]);
    for (const VlnJson& choice : item["choices"]) choices[key].insert(choice.dump());
  }
  // All groups are whole, but for one at most that makes up the number.
  int broken = 0;
  for (const auto& [key, counts] : answers) {
    const bool whole = counts.size() == choices[key].size();
    broken += !whole || std::ranges::any_of(counts, [&](const auto& entry) { return entry.second != counts.begin()->second; });
  }
  EXPECT_LE(broken, 1);
}

TEST(Language, TheWordsAloneTellNoMoreThanChance) {
  // The most frequent answer of the words, of its type, learned on one half and asked of the other.
  std::map<std::string, std::map<std::string, int>> seen;
  double right = 0, chance = 0;
  for (size_t half : {0, 1}) {
    for (size_t i = half; i < Questions().size(); i += 2) {
      const VlnJson item = VlnJson::parse(Questions()[i]);
      auto& counts = seen[item["question"].get<std::string>()];
      if (half == 0) {
        ++counts[item["answer"].dump()];
        continue;
      }
      std::string best = item["choices"][0].dump();
      for (const auto& [answer, count] : counts)
        if (count > counts[best]) best = answer;
      right += best == item["answer"].dump();
      chance += 1.0 / static_cast<double>(item["choices"].size());
    }
  }
  EXPECT_LE(right, 1.2 * chance);
}

TEST(Language, TheSecondMethodFindsNothingWrongInAnyKind) {
  for (const auto& [kind, count] : {std::pair("vqa", 240), std::pair("refer", 120), std::pair("caption", 40)}) {
    const auto lines = std::string(kind) == "vqa" ? Questions() : LinesOf({.kind = kind, .count = count, .width = 512});
    for (const LanguageComplaint& c : Complaints(lines)) ADD_FAILURE() << c.id << ": " << c.what;
  }
}

TEST(Language, TheSecondMethodFindsEveryWrongAnswer) {
  std::vector<std::string> spoiled;
  for (const std::string& line : Questions()) {
    VlnJson item = VlnJson::parse(line);
    const size_t other = (item["answer_index"].get<size_t>() + 1) % item["choices"].size();
    item["answer_index"] = other;
    item["answer"] = item["choices"][other];
    spoiled.push_back(item.dump());
  }
  EXPECT_EQ(Complaints(spoiled).size(), spoiled.size());
}

TEST(Language, TheSecondMethodNamesWhatCompetes) {
  // "the bench nearest to you", said as if there were no other.
  for (const std::string& line : LinesOf({.kind = "refer", .count = 120, .width = 512})) {
    VlnJson item = VlnJson::parse(line);
    const VlnJson competitors = item["proof"].value("competitors", VlnJson::array());
    if (item["type"] != "nearest" || competitors.empty() || competitors[0]["pixels"] < 60) continue;
    item["query"]["where"] = "only";
    const auto complaints = Complaints({item.dump()});
    ASSERT_EQ(complaints.size(), 1U);
    EXPECT_TRUE(complaints[0].what.starts_with("not unique") && complaints[0].what.find("compete") != std::string::npos)
        << complaints[0].what;
    return;
  }
  FAIL() << "no expression of that type";
}

TEST(Language, TheSameBytesWithAnyNumberOfThreads) {
  std::vector<std::string> one;
  {
    const ThreadLimit limit(1);
    one = LinesOf({.kind = "refer", .count = 60, .width = 512});
  }
  const ThreadLimit limit(4);
  EXPECT_EQ(LinesOf({.kind = "refer", .count = 60, .width = 512}), one);
}

TEST(Language, AWorldThatGivesTooLittleSaysSo) {
  TestTown empty;
  empty.Box("ground", "ground/road", {0, 0, 0}, {40, 40, 0.2f}, -0.2f);
  Stage nothing(empty.Build());
  EXPECT_THROW(MakeLanguage(nothing, {}, [](const std::string&) {}), InputError);
  for (const LanguageOptions& wrong : {LanguageOptions{.kind = "captions"}, LanguageOptions{.count = 0}, LanguageOptions{.width = 100}})
    EXPECT_THROW(MakeLanguage(*TownStage(), wrong, [](const std::string&) {}), InputError);
}

TEST(Language, LinesThatAreNoItemsAreRefusedByFieldAndLine) {
  const std::string good = Questions()[0];
  for (const auto& [field, value] : std::vector<std::pair<std::string, VlnJson>>{{"kind", "poem"},
                                                                                 {"answer_index", 99},
                                                                                 {"choices", VlnJson::array()},
                                                                                 {"pictures", 3},
                                                                                 {"world_seed", -1},
                                                                                 {"query", 1},
                                                                                 {"entities", {-4}},
                                                                                 {"nonsense", 1}}) {
    VlnJson item = VlnJson::parse(good);
    item[field] = value;
    const auto path = Written("bad.jsonl", {item.dump()});
    try {
      PicturesOf(path);
      ADD_FAILURE() << field;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(field), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(":1"), std::string::npos) << e.what();
    }
    std::filesystem::remove(path);
  }
}

TEST(Pickle, IsWhatPythonsPickletoolsSay) {
  EXPECT_EQ(internal::PickleOf({1, "a"}), std::string("\x80\x02](J\x01\0\0\0X\x01\0\0\0ae.", 17));
  EXPECT_EQ(internal::PickleOf({{"k", 0.5}}), std::string("\x80\x02}(X\x01\0\0\0kG\x3f\xe0\0\0\0\0\0\0u.", 21));
}

}  // namespace
}  // namespace airsim360

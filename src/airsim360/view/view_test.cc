#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "airsim360/view/coming_world.h"
#include "airsim360/view/fair_mutex.h"
#include "airsim360/view/folder_file.h"
#include "airsim360/view/frame_pool.h"
#include "airsim360/view/live_world.h"
#include "airsim360/view/page_files.h"
#include "airsim360/view/planes.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class FolderFile : public testing::Test {
 protected:
  void SetUp() override {
    room_ = fs::path(testing::TempDir()) / ("folder_file_" + std::to_string(::getpid()));
    fs::create_directories(room_ / "in/sub");
    std::ofstream(room_ / "secret") << "secret";
    std::ofstream(room_ / "in/a.txt") << "a";
    std::ofstream(room_ / "in/sub/b.txt") << "b";
    fs::create_symlink(room_ / "secret", room_ / "in/link");
    fs::create_symlink(room_, room_ / "in/up");
    fs::create_symlink("a.txt", room_ / "in/inside");
    ::mkfifo((room_ / "in/fifo").c_str(), 0600);
  }
  void TearDown() override { fs::remove_all(room_); }

  // What the descriptor reads; "-" = there is none.
  std::string Read(std::string_view path) const {
    const int file = OpenInFolder(room_ / "in", path);
    if (file < 0) return "-";
    char text[16];
    const ssize_t size = ::read(file, text, sizeof text);
    ::close(file);
    return {text, static_cast<size_t>(size)};
  }

  fs::path room_;
};

TEST_F(FolderFile, FilesBelowTheFolderAreRead) {
  EXPECT_EQ(Read("a.txt"), "a");
  EXPECT_EQ(Read("sub/b.txt"), "b");
}

TEST_F(FolderFile, NothingElseIs) {
  const std::string absolute = (room_ / "secret").string();
  for (const std::string_view path :
       {std::string_view("../secret"), std::string_view("sub/../../secret"), std::string_view("sub/../a.txt"), std::string_view("./a.txt"),
        std::string_view("link"), std::string_view("up/secret"), std::string_view("inside"), std::string_view("fifo"),
        std::string_view("sub"), std::string_view("sub/"), std::string_view(""), std::string_view("/"), std::string_view("//a.txt"),
        std::string_view("a.txt/"), std::string_view("a.txt\0b", 7), std::string_view("missing"), std::string_view(absolute)}) {
    EXPECT_EQ(Read(path), "-") << path;
  }
  EXPECT_EQ(Read(std::string(1 << 20, 'a')), "-");
}

TEST(PercentDecoded, IsTheInverseOfPercentEncoding) {
  std::string all, encoded;
  for (int c = 0; c < 256; ++c) {
    all += static_cast<char>(c);
    char text[4];
    std::snprintf(text, sizeof text, "%%%02x", c);
    encoded += text;
  }
  EXPECT_EQ(PercentDecoded(encoded), all);
  EXPECT_EQ(PercentDecoded("/a-b_c.png"), "/a-b_c.png");
  for (const char* text : {"%", "%2", "%zz", "a%+1", "%-1", "100%"}) EXPECT_EQ(PercentDecoded(text), "") << text;
}

TEST(PageFiles, AreWholeAndLoadNothingFromElsewhere) {
  ASSERT_NE(FindPageFile("index.html"), nullptr);
  EXPECT_EQ(FindPageFile("../index.html"), nullptr);
  for (const PageFile& file : PageFiles()) {
    EXPECT_FALSE(file.text.empty()) << file.name;
    EXPECT_NE(ContentType(file.name), "application/octet-stream") << file.name;
    std::string text(file.text);
    for (size_t at; (at = text.find("http://www.w3.org/2000/svg")) != text.npos;) text.erase(at, 26);
    EXPECT_EQ(text.find("://"), text.npos) << file.name;
  }
}

struct Parts {
  Json header;
  std::string data;
};

Parts Read(const std::string& message) {
  uint32_t length = 0;
  EXPECT_EQ(message.substr(0, 4), "A360");
  std::memcpy(&length, message.data() + 4, 4);
  return {Json::parse(message.substr(8, length)), message.substr(8 + length)};
}

TEST(PlaneMessage, HoldsEveryPlaneAtAMultipleOfFourBytes) {
  Frame frame;
  frame.range = Image<float>(3, 1);
  frame.semantic = Image<CategoryId>(3, 1);
  frame.entity = Image<EntityId>(3, 1);
  for (int x = 0; x < 3; ++x) {
    frame.range(x, 0) = 1.5f * static_cast<float>(x);
    frame.semantic(x, 0) = static_cast<CategoryId>(300 + x);
    frame.entity(x, 0) = 70000u + static_cast<EntityId>(x);
  }
  PlaneMessage message;
  for (const char* name : {"semantic", "range", "entity"}) EXPECT_TRUE(message.AddProduct(frame, name));
  EXPECT_FALSE(message.AddProduct(frame, "nothing"));
  const std::string bytes = message.Finish("\"number\":7");
  const Parts parts = Read(bytes);
  EXPECT_EQ(parts.header["number"], 7);
  EXPECT_EQ((bytes.size() - parts.data.size()) % 4, 0u);
  ASSERT_EQ(parts.header["planes"].size(), 3u);
  for (const Json& plane : parts.header["planes"]) EXPECT_EQ(plane["at"].get<size_t>() % 4, 0u);
  uint16_t semantic = 0;
  float range = 0;
  uint32_t entity = 0;
  std::memcpy(&semantic, parts.data.data() + parts.header["planes"][0]["at"].get<size_t>() + 4, sizeof semantic);
  std::memcpy(&range, parts.data.data() + parts.header["planes"][1]["at"].get<size_t>() + 8, sizeof range);
  std::memcpy(&entity, parts.data.data() + parts.header["planes"][2]["at"].get<size_t>() + 4, sizeof entity);
  EXPECT_EQ(semantic, 302);
  EXPECT_EQ(range, 3.0f);
  EXPECT_EQ(entity, 70001u);
}

class Live : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    stage_ = std::make_shared<Stage>(StageOptions{.world = {.world = "box_room"}, .device = {.device = "cpu"}});
  }
  static void TearDownTestSuite() { stage_.reset(); }

  // Flies half a second forward and up, told ten times; all pictures one after the other.
  static std::string Fly() {
    double now = 0;
    LiveWorld world(stage_, {.clock = [&] { return now; }});
    std::string all;
    for (int i = 0; i < 10; ++i) {
      now += 0.05;
      Json message{{"do", "picture"}, {"width", 128}, {"products", {"range"}}, {"token", "t"}, {"input", {0.2, 0, 0.1, 0.3}}};
      std::string bytes = world.Answer(message.dump(), "t").bytes;
      // How long rendering took is of no account.
      const size_t at = bytes.find("\"render_ms\":"), end = bytes.find(',', at);
      EXPECT_NE(at, bytes.npos) << bytes.substr(0, 200);
      const Parts parts = airsim360::Read(bytes);
      all += bytes.substr(8, at - 8) + bytes.substr(end, bytes.find(']', end) - end) + parts.data;
      last_ = parts.header;
    }
    return all;
  }

  static std::shared_ptr<Stage> stage_;
  static Json last_;
};
std::shared_ptr<Stage> Live::stage_;
Json Live::last_;

TEST_F(Live, TheSameHandsAtTheSameTimesFlyTheSameWay) {
  const std::string first = Fly();
  EXPECT_GT(last_["p"][0].get<double>(), 0.05);
  EXPECT_NEAR(last_["t"].get<double>(), 0.45, 1e-9);  // it begins with the first of ten pictures
  EXPECT_EQ(Fly(), first);
}

TEST_F(Live, TimeStandsWhileTheClockDoesAndNeverJumps) {
  double now = 0;
  LiveWorld world(stage_, {.clock = [&] { return now; }});
  const auto time = [&] { return airsim360::Read(world.Answer(R"({"do":"picture","width":128})", "t").bytes).header["t"].get<double>(); };
  EXPECT_EQ(time(), 0);
  EXPECT_EQ(time(), 0);
  now = 1e6;
  EXPECT_NEAR(time(), 0.25, 1e-9);
  now = -5;
  EXPECT_NEAR(time(), 0.25, 1e-9);
}

TEST_F(Live, HandsThatAreToldOnALineOfTheirOwnFlyLikeThoseOfAPicture) {
  const auto fly = [](bool apart) {
    double now = 0;
    LiveWorld world(stage_, {.clock = [&] { return now; }});
    Json header;
    for (int i = 1; i <= 6; ++i) {
      now += 0.05;
      Json picture{{"do", "picture"}, {"width", 128}, {"token", "t"}};
      const Json input{0.2, 0, 0.1, 0.3};
      if (apart)
        EXPECT_EQ(world.Answer(Json{{"do", "hands"}, {"input", input}, {"number", 10 * i}, {"token", "t"}}.dump(), "t").bytes,
                  R"({"done":"hands"})");
      else
        picture["input"] = input;
      header = airsim360::Read(world.Answer(picture.dump(), "t").bytes).header;
      EXPECT_EQ(header["hands"], apart ? 10 * i : 0);
    }
    header.erase("render_ms");
    header.erase("hands");
    return header;
  };
  const Json told = fly(true);
  EXPECT_GT(told["v"][2].get<double>(), 0.1);
  EXPECT_EQ(told, fly(false));
}

// The clock is read when a picture has taken the hands and before it is rendered: who presses a key then is answered by this picture.
TEST_F(Live, AKeyDuringAPictureIsInThatPictureAndTheDriftOfAStickInTheNext) {
  for (const double ahead : {1.0, 0.3}) {
    LiveWorld* told = nullptr;
    int reads = 0;
    LiveWorld world(
        stage_, {.clock = [&] {
          if (++reads % 2 == 1)
            told->Answer(Json{{"do", "hands"}, {"input", {reads % 4 == 1 ? ahead : 0, 0, 0, 0}}, {"number", reads}, {"token", "t"}}.dump(),
                         "t");
          return 0.0;
        }});
    told = &world;
    const auto hands = [&] {
      return airsim360::Read(world.Answer(R"({"do":"picture","width":128})", "t").bytes).header["hands"].get<int>();
    };
    EXPECT_EQ(hands(), ahead == 1 ? 1 : 0);
    EXPECT_EQ(reads, ahead == 1 ? 2 : 1);
    EXPECT_EQ(hands(), ahead == 1 ? 3 : 1);
  }
}

TEST_F(Live, APictureThatFailsLeavesTheNextOneWhole) {
  LiveWorld world(stage_, {.clock = [] { return 0.0; }});
  const auto picture = [&] { return world.Answer(R"({"do":"picture","width":128})", "t").bytes; };
  const std::string before = picture();
  for (int i = 0; i < 3; ++i)
    EXPECT_NE(world.Answer(R"({"do":"picture","width":128,"token":"t","input":[2,0,0,0]})", "t").bytes.find("-1 ... 1"), std::string::npos);
  EXPECT_EQ(airsim360::Read(picture()).header["planes"], airsim360::Read(before).header["planes"]);
}

TEST_F(Live, KeysWithoutEndDoNotKeepPicturesBack) {
  LiveWorld* told = nullptr;
  int reads = 0;
  LiveWorld world(stage_, {.clock = [&] {
                    told->Answer(Json{{"do", "hands"}, {"input", {++reads % 2, 0, 0, 0}}, {"number", reads}, {"token", "t"}}.dump(), "t");
                    return 0.0;
                  }});
  told = &world;
  for (int i = 1; i <= 5; ++i) {
    EXPECT_EQ(airsim360::Read(world.Answer(R"({"do":"picture","width":128})", "t").bytes).header["number"], i);
    EXPECT_EQ(reads, 2 * i);
  }
}

TEST_F(Live, HandsAreToldOnceAndNotWithoutTheToken) {
  double now = 0;
  LiveWorld world(stage_, {.clock = [&] { return now; }});
  const auto refused = [&](const char* message, const char* why) {
    EXPECT_NE(world.Answer(message, "t").bytes.find(why), std::string::npos) << message;
  };
  refused(R"({"do":"hands","input":[0,0,1,0],"number":1})", "token");
  refused(R"({"do":"hands","input":[0,0,2,0],"number":1,"token":"t"})", "-1 ... 1");
  refused(R"({"do":"hands","number":1,"token":"t"})", "four numbers");
  refused(R"({"do":"hands","input":[0,0,1,0],"number":-1,"token":"t"})", "number");
  world.Answer(R"({"do":"hands","input":[0,0,1,0],"number":4,"token":"t"})", "t");
  // Half a second later, told nothing more, it stops.
  double v = 0, fastest = 0;
  for (int i = 0; i < 60; ++i) {
    now += 0.05;
    v = airsim360::Read(world.Answer(R"({"do":"picture","width":128})", "t").bytes).header["v"][2].get<double>();
    fastest = std::max(fastest, v);
  }
  EXPECT_GT(fastest, 1);
  EXPECT_LT(std::abs(v), 0.1);
}

TEST_F(Live, PicturesThatAreAskedForAtOnceFollowEachOtherAndAreWhole) {
  double now = 0;
  LiveWorld world(stage_, {.clock = [&] { return now; }});
  std::vector<int64_t> numbers[2];
  const auto look = [&](int who, const char* message) {
    for (int i = 0; i < 12; ++i) {
      const Parts parts = airsim360::Read(world.Answer(message, "t").bytes);
      numbers[who].push_back(parts.header["number"].get<int64_t>());
      EXPECT_EQ(parts.header["planes"].size(), who == 0 ? 2u : 1u);
      // Who asks about it gets the planes of that very picture, whatever has been looked at since.
      const std::string planes = world.Answer(Json{{"do", "planes"}, {"number", numbers[who].back()}}.dump(), "t").bytes;
      if (planes.starts_with("A360"))
        EXPECT_EQ(airsim360::Read(planes).header["planes"].size(), 3u);
      else
        EXPECT_NE(planes.find("is gone"), std::string::npos) << planes;
    }
  };
  std::thread other([&] { look(1, R"({"do":"picture","width":256})"); });
  look(0, R"({"do":"picture","width":128,"products":["coverage"]})");
  other.join();
  std::vector<int64_t> all;
  for (const auto& some : numbers) {
    EXPECT_TRUE(std::ranges::is_sorted(some));
    all.insert(all.end(), some.begin(), some.end());
  }
  std::ranges::sort(all);
  for (size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], static_cast<int64_t>(i + 1));
}

TEST_F(Live, QuestionsAreAnsweredWhileAPictureIsRendered) {
  double now = 0;
  LiveWorld world(stage_, {.clock = [&] { return now; }});
  std::atomic<bool> done = false;
  std::thread looking([&] {
    for (int i = 0; i < 3; ++i) world.Answer(R"({"do":"picture","width":2048})", "t");
    done = true;
  });
  // Who waits for a picture each time has three answers or four.
  int answers = 0;
  while (!done) {
    EXPECT_NE(world.Answer(R"({"do":"mission"})", "t").bytes.find("none"), std::string::npos);
    ++answers;
  }
  looking.join();
  EXPECT_GT(answers, 20);
}

TEST(FramePool, MemoryIsUsedAgainAndHoldsNothingBeyondWhatEveryPictureHas) {
  auto pool = std::make_unique<FramePool>();
  auto first = pool->Take(), second = pool->Take(), third = pool->Take();
  first->rgb = Image<Rgb8>(8, 4);
  first->entity = Image<EntityId>(8, 4);
  first->coverage = Image<CoveragePixel>(8, 4);
  const Frame* memory = first.get();
  const Rgb8* pixels = first->rgb.pixels().data();
  std::shared_ptr<const Frame> held = first;
  first.reset();
  EXPECT_EQ(pool->resting(), 0u);
  std::thread([&held] { held.reset(); }).join();
  EXPECT_EQ(pool->resting(), 1u);
  const auto again = pool->Take();
  EXPECT_EQ(again.get(), memory);
  EXPECT_EQ(again->rgb.pixels().data(), pixels);
  EXPECT_EQ(again->entity.width(), 8);
  EXPECT_TRUE(again->coverage.empty());
  const auto fourth = pool->Take();
  second.reset(), third.reset();
  EXPECT_EQ(pool->resting(), 2u);
  { const auto last = pool->Take(), one = pool->Take(), more = pool->Take(); }
  EXPECT_EQ(pool->resting(), 2u);
  pool.reset();  // what is out still may come back
}

TEST(FairMutex, TwoWhoWantItAllTheTimeHaveItByTurns) {
  FairMutex mutex;
  std::string order;
  const auto take = [&](char who) {
    for (int i = 0; i < 200; ++i) {
      const std::lock_guard lock(mutex);
      order += who;
      std::this_thread::sleep_for(std::chrono::microseconds(200));  // the other one asks meanwhile
    }
  };
  std::thread other([&] { take('b'); });
  take('a');
  other.join();
  // A std::mutex goes to whoever held it last, hundreds of times.
  const size_t both = std::min(order.find_last_of('a'), order.find_last_of('b')), first = std::max(order.find('a'), order.find('b'));
  size_t longest = 0, run = 0;
  for (size_t i = first + 1; i <= both; ++i) longest = std::max(longest, run = order[i] == order[i - 1] ? run + 1 : 0);
  EXPECT_LE(longest, 20U) << order;
}

// Answers everything with what it was asked.
class Echo : public LiveSource {
 public:
  std::string DescriptionJson() const override { return R"({"world":"there"})"; }
  std::string EntitiesJson() const override { return "entities"; }
  SocketMessage Answer(std::string_view message, const std::string& token) override { return {token + std::string(message)}; }
};

TEST(ComingWorld, SaysThatItComesAndWhoAsksMoreWaitsUntilItIsThere) {
  ComingWorld world("far_city");
  EXPECT_EQ(Json::parse(world.DescriptionJson()), Json({{"coming", "far_city"}}));
  std::atomic<bool> answered = false;
  std::string answer;
  std::thread asks([&] {
    answer = world.Answer("?", "token").bytes;
    answered = true;
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  EXPECT_FALSE(answered);
  world.Come(std::make_shared<Echo>());
  asks.join();
  EXPECT_EQ(answer, "token?");
  EXPECT_EQ(world.DescriptionJson(), R"({"world":"there"})");
  EXPECT_EQ(world.EntitiesJson(), "entities");
}

TEST(ComingWorld, WhoWaitsForOneThatCannotBeOpenedIsTold) {
  ComingWorld world("no_city");
  std::string answer;
  std::thread asks([&] { answer = world.Answer("?", "").bytes; });
  world.Fail();
  asks.join();
  EXPECT_NE(Json::parse(answer).value("error", "").find("no_city"), std::string::npos);
  EXPECT_TRUE(Json::parse(world.DescriptionJson()).contains("error"));
  EXPECT_TRUE(Json::parse(world.EntitiesJson()).contains("error"));
}

}  // namespace
}  // namespace airsim360

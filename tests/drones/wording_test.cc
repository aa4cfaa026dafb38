// The same figures in other words are the same drone: generated sentences whose words stand for each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/request.h"
#include "exam.h"

namespace airsim360 {
namespace {

using Forms = std::vector<std::string>;

/// `form` with every `%x` replaced by what stands for it.
std::string Filled(std::string form, char mark, const std::string& text) {
  const std::string what = {'%', mark};
  for (size_t at = 0; (at = form.find(what, at)) != std::string::npos; at += text.size()) form.replace(at, 2, text);
  return form;
}

struct SaidMass {
  const char* words;
  double kilograms;
};
constexpr SaidMass kMasses[] = {{"900 g", 0.9},        {"900g", 0.9},      {"1.2 kg", 1.2}, {"1,2 kg", 1.2},     {"2 lb", 0.90718474},
                                {"40 oz", 1.13398093}, {"1.5 kilos", 1.5}, {"one kilo", 1}, {"850 grams", 0.85}, {"2-pound", 0.90718474}};

constexpr const char* kVerbs[] = {"carry", "haul",      "lift",    "lug",   "deliver", "drop", "hoist",
                                  "bring", "transport", "airlift", "ferry", "hold",    "tote", "shuttle"};

// Things that are in no lexicon, made-up ones among them: nouns are an open class.
constexpr const char* kThings[] = {
    "buoy",     "kettle",  "zorblatt",  "methane sniffer", "throw bag",   "lidar",    "self inflating raft", "teddy bear", "wooden crate",
    "geophone", "pumpkin", "sonar pod", "repair kit",      "frobnicator", "spray can"};

/// How often a form is read as it is meant, and the first sentences that are not.
class Tally {
 public:
  void Add(const std::string& sentence, std::optional<double> is, double meant) {
    ++all_;
    const bool good = is && std::abs(*is - meant) < 1e-3 * meant;
    good_ += good;
    if (!good && (all_ - good_) <= 12) bad_ += sentence + " -> " + (is ? std::to_string(*is) : "nothing") + "\n";
  }
  void Refused(const std::string& sentence, const std::string& why) {
    ++all_;
    if (all_ - good_ <= 12) bad_ += sentence + " -> refused: " + why + "\n";
  }
  double share() const { return static_cast<double>(good_) / static_cast<double>(all_); }
  const std::string& bad() const { return bad_; }

 private:
  size_t all_ = 0, good_ = 0;
  std::string bad_;
};

template <typename Field>
void Check(Tally& tally, const std::string& sentence, Field field, double meant) {
  try {
    tally.Add(sentence, ParsePrompt(sentence).*field, meant);
  } catch (const InputError& error) {
    tally.Refused(sentence, error.what());
  }
}

TEST(Wording, WhateverIsCarriedIsPayloadWhereverItsMassStands) {
  const Forms forms = {"hexa that can %v a %m %n, 20 min",
                       "hexa to %v a %n of %m, 20 min",
                       "hexacopter to %v my %n (%m), 20 min",
                       "hexa, must %v a %n, %m, for 20 min",
                       "20 min hexa which has to %v one %m %n",
                       "Can a hexa %v our %n? It weighs %m. 20 min",
                       "I have a %n, it weighs %m. I need a hexa to %v it for 20 min",
                       "We want to %v a %n weighing %m with six rotors for 20 min",
                       "to %v a %n that weighs %m for 20 minutes I want a hexa"};
  size_t turn = 0;
  for (const std::string& form : forms) {
    Tally tally;
    for (const char* verb : kVerbs) {
      for (const char* thing : kThings) {
        // Every verb meets every thing, and masses take turns.
        const SaidMass& mass = kMasses[turn++ % std::size(kMasses)];
        Check(tally, Filled(Filled(Filled(form, 'v', verb), 'n', thing), 'm', mass.words), &DroneRequest::payload, mass.kilograms);
      }
    }
    EXPECT_EQ(tally.share(), 1) << form << "\n" << tally.bad();
  }
}

TEST(Wording, AThingBesideTheDroneIsPayloadWithoutAVerb) {
  const Forms forms = {"hexa with a %n weighing %m, 20 min",
                       "hexa for a %m %n, 20 min",
                       "hexa with a %m %n on board, 20 min",
                       "hexa + %n %m, 20 min",
                       "hexa plus a %m %n, 20 min",
                       "six rotors, 20 min with a %m %n",
                       "MTOW 9 kg hexa, %n %m, 20 min",
                       "hexa, 20 min. The %n is %m.",
                       "hexa, 20 min, %n weighs %m",
                       "the %n comes to %m, hexa, 20 min",
                       "Hexa for 20 min; %n = %m",
                       "hexa, 20 min, my %n is about %m",
                       "20 min hexa with a %n of %m",
                       "hexa equipped with a %n (%m), 20 min",
                       "Hexacopter mit einem %n von %m, 20 min",
                       "hexacoptere avec un %n de %m, 20 min",
                       "hexacoptero con un %n de %m, 20 min"};
  for (const std::string& form : forms) {
    Tally tally;
    for (const char* thing : kThings) {
      for (const SaidMass& mass : kMasses)
        Check(tally, Filled(Filled(form, 'n', thing), 'm', mass.words), &DroneRequest::payload, mass.kilograms);
    }
    EXPECT_EQ(tally.share(), 1) << form << "\n" << tally.bad();
  }
}

TEST(Wording, TheMassOfTheDroneStaysItsOwn) {
  const Forms forms = {"a %m %d",
                       "%d, %m, 20 min",
                       "%d weighing %m",
                       "%d, AUW %m, with a buoy",
                       "%d with a camera, all up %m",
                       "my %d comes out at %m",
                       "%d, 10 inch, 4S 5000, %m ready to fly",
                       "%d that weighs %m with its battery",
                       "my %d is %m",
                       "%d for my nephew, %m, 10 min",
                       "%m %d for mapping vineyards",
                       "looking for a %m %d with 10 inch props",
                       "I want a %m %d that flies 15 min",
                       "%d (%m) on 10 inch props",
                       "this %d tips the scales at %m",
                       "%d, carbon, %m, foldable"};
  const Forms drones = {"quad", "quadcopter", "hexa", "camera drone", "racer", "F450", "sprayer", "flat octo"};
  for (const std::string& form : forms) {
    Tally tally;
    for (const std::string& drone : drones) {
      for (const SaidMass& mass : kMasses)
        Check(tally, Filled(Filled(form, 'd', drone), 'm', mass.words), &DroneRequest::mass, mass.kilograms);
    }
    EXPECT_EQ(tally.share(), 1) << form << "\n" << tally.bad();
  }
}

TEST(Wording, MotorsAndPropellersByAnyCode) {
  Tally kv, propeller;
  for (const int value : {400, 920, 1750, 2450}) {
    for (const char* form : {"2207 %kkv", "2207/%kKV", "2207-%kkv", "RS2207-%k", "MN5212XF-%k", "%k KV motors", "KV%k", "2312E %k kv",
                             "four Hobbywing X8 (%kKV)", "2207s %kkv", "motors: %k kv"})
      Check(kv, "quad, 1.2 kg, " + Filled(form, 'k', std::to_string(value)) + ", 4S", &DroneRequest::motor_kv, value);
  }
  for (const char* form : {"1045 props", "1045s", "10x4.5", "10 x 4.5 props", "P10x4.5", "10\" props", "10in props", "10-inch propellers",
                           "10 inchs props", "25.4 cm props", "254mm propellers", "props 10in"})
    Check(propeller, std::string("quad, 1.2 kg, ") + form + ", 4S", &DroneRequest::propeller, 0.254);
  EXPECT_EQ(kv.share(), 1) << kv.bad();
  EXPECT_EQ(propeller.share(), 1) << propeller.bad();
}

TEST(Wording, ThrustOverWeightAndTimesInAnyWords) {
  Tally ratio, time;
  for (const char* form :
       {"TWR 4", "4:1", "4 to 1 thrust", "thrust to weight of 4", "T/W 4:1", "4:1 punch", "thrust-to-weight ratio 4", "with a 4:1 ratio"})
    Check(ratio, std::string("quad, 1.2 kg, 10 inch, ") + form, &DroneRequest::thrust_to_weight, 4);
  for (const char* form : {"6 min", "6 mins", "6 minits", "6 minuets", "6 minutes per charge", "6 min on one charge", "six minutes",
                           "360 seconds", "6 Minuten", "0.1 h", "6 minutos"})
    Check(time, std::string("quad, 1.2 kg, 10 inch, flies ") + form, &DroneRequest::flight_time, 360);
  EXPECT_EQ(ratio.share(), 1) << ratio.bad();
  EXPECT_EQ(time.share(), 1) << time.bad();
}

TEST(Wording, CaseAndSpacesSayNothing) {
  for (const ExamSentence& sentence : ReadExam(AIRSIM360_SOURCE_DIR "/data/drones/exam_newcomers_6.json")) {
    std::string loud = sentence.text;
    std::transform(loud.begin(), loud.end(), loud.begin(), [](unsigned char c) { return std::toupper(c); });
    loud = "  " + loud + "  ";
    for (size_t at = 0; (at = loud.find(", ", at)) != std::string::npos; at += 3) loud.replace(at, 2, ",  ");
    EXPECT_EQ(ExamProblem(sentence).empty(), ExamProblem({loud, sentence.build, sentence.figures}).empty()) << loud;
  }
}

TEST(Wording, MorePowerThanTheBatteryHoldsIsRefusedAndNoLessIs) {
  for (const double minutes : {5.0, 10.0, 14.0, 16.0, 40.0}) {
    char text[96];
    std::snprintf(text, sizeof(text), "2 kg quad, 13 inch props. Battery 100 Wh. Hover power 400 W. Hovers %g min", minutes);
    // 100 Wh last 15 minutes at 400 W.
    if (minutes < 15) {
      EXPECT_NO_THROW(DroneFromPrompt(text)) << text;
    } else {
      EXPECT_THROW(DroneFromPrompt(text), InputError) << text;
    }
  }
  // Momentum theory: 2 kg on four discs of 10 inches take (2 g)^1.5 / sqrt(2 rho A) = 123 W.
  EXPECT_THROW(DroneFromPrompt("2 kg quad, 10 inch props, hovers at 110 W"), InputError);
  EXPECT_NO_THROW(DroneFromPrompt("2 kg quad, 10 inch props, hovers at 250 W"));
}

TEST(Wording, PacksInParallelAddTheirChargeAndNoOthersDo) {
  const auto capacity = &DroneRequest::capacity_ah;
  Tally tally;
  for (const char* sentence : {"two 6S 16000 mAh packs in parallel, hexa, 20 kg", "hexa, 20 kg, 2x 6S 16Ah in parallel",
                               "hexa 20 kg 6S 2x16000 parallel", "hexa, 20 kg, 6S 32Ah"})
    Check(tally, sentence, capacity, 32);
  for (const char* sentence : {"hexa, 6S2P 16000 mAh li-ion, 20 kg", "hexa, 20 kg, two 3S 16Ah packs in series",
                               "hexa, 20 kg, 6S 16000 with two spare 6S 16000 packs"})
    Check(tally, sentence, capacity, 16);
  Check(tally, "quad, 6S4P from 5 Ah 21700 cells, 4.5 kg", capacity, 20);
  EXPECT_EQ(tally.share(), 1) << tally.bad();
}

TEST(Wording, ListsOfThingsAddUp) {
  const auto payload = &DroneRequest::payload;
  Tally tally;
  for (const char* sentence :
       {"hexa, payload: lidar 1 kg, camera 300 g, gimbal 200 g, 9 kg AUW",
        "hexa carrying a 1 kg lidar, a 300 g camera and a 200 g gimbal, 9 kg AUW", "hexa that carries 3 cartons of 500 g, 9 kg",
        "hexa, 9 kg AUW including a 1.5 kg payload", "hexa, 9 kg incl. 1.5 kg radiosonde"})
    Check(tally, sentence, payload, 1.5);
  const auto mass = &DroneRequest::mass;
  Check(tally, "quad: frame 400 g, motors 320 g, electronics 130 g, battery 350 g, 9 inch props", mass, 1.2);
  Check(tally, "hexa, seven point five kilos", mass, 7.5);
  EXPECT_EQ(tally.share(), 1) << tally.bad();
}

TEST(Wording, FiguresThatNoLawLetsBeAreRefused) {
  for (const char* prompt :
       {"4S 22.2V quad, 1.8 kg", "quad with a 3S (14.8 V) pack, 1.2 kg", "5 kg quad, TWR 15:1, 4 motors, 2 kg thrust each",
        "2 kg quad, total thrust 1.5 kg", "quad without battery, dynamos on the props recharge it", "quad, 1 kg, hovers indefinitely",
        "F450 carrying me, 75 kg", "Drohne, Abfluggewicht 3 kg, Gesamtschub 2 kg", "quad at 30 km altitude, 5 kg",
        "quad, 2 kg, 100 Wh, flies 500 km", "quad with no battery and no cable, 1 kg",
        "quad without any battery, fuel or other energy source, 1 kg", "20 inch props, 2000 kv motors, 12S, quad",
        "quad 2 kg, maximum thrust of 0.3 times its weight", "quad weighing 250 g all up including its 300 g camera",
        "2000 Wh lipo that weighs 500 g, 3 kg quad"})
    EXPECT_THROW(DroneFromPrompt(prompt), InputError) << prompt;
  for (const char* prompt : {"4S 14.8V quad, 1.8 kg", "6S (25.2 V) quad, 1.8 kg", "4S quad with a 12V lamp, 1.8 kg",
                             "2 kg quad, TWR 2:1, motors with 1 kg of thrust each", "quad, often -20C outside, 1 kg",
                             "quad, 4000 m altitude, 2 kg", "2 kg quad, flies 5 km", "quad, 1 kg, ELRS link with 100 km range",
                             "quad 1 kg, battery not included", "quad, AUW 2 kg, motors of 90 g each"})
    EXPECT_NO_THROW(DroneFromPrompt(prompt)) << prompt;
}

}  // namespace
}  // namespace airsim360

// Numbers of names, calendars, money and work beside the figures of a drone.
#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/design.h"

namespace airsim360 {
namespace {

constexpr double kInch = 0.0254;

TEST(SideNumbers, ANumberAfterWhatIsNumberedIsAName) {
  for (const char* name : {"turbine 14", "room 12", "unit 6", "mast 31", "tower 6", "sortie 23", "step 1", "job no. 7", "ticket 88",
                           "number 3", "0093", "workshop job 0450", "floor 2", "chapter 4", "site 8 in the valley", "run 12 in 2024"}) {
    for (const char* link : {": ", ", ", ". "}) {
      const std::string words = std::string(name) + link + "10 inch props, quadcopter, 1.6 kg";
      const DroneRequest request = ParsePrompt(words);
      EXPECT_EQ(request.rotors, 4) << words;
      EXPECT_NEAR(request.propeller.value_or(0), 10 * kInch, 1e-9) << words;
      EXPECT_EQ(request.mass, 1.6) << words;
      EXPECT_FALSE(request.arm) << words;
    }
  }
}

TEST(SideNumbers, AVerbThatIsAlsoSuchANounLeavesItsNumberACount) {
  EXPECT_EQ(ParsePrompt("we run 6 motors with 15 inch props").rotors, 6);
  EXPECT_EQ(ParsePrompt("test 8 rotors, 20 kg").rotors, 8);
  EXPECT_EQ(ParsePrompt("drone on 6S, we run 15 inch props").cells, 6);
  EXPECT_NEAR(*ParsePrompt("in this order: 450 quad, 4S").arm, 0.225, 1e-9);
}

TEST(SideNumbers, AColonAfterABareNumberEndsWhatItCounts) {
  const DroneRequest request = ParsePrompt("At stand 6: 15 inch props on a quadcopter of 4.1 kg");
  EXPECT_EQ(request.rotors, 4);
  EXPECT_NEAR(*request.propeller, 15 * kInch, 1e-9);
  EXPECT_EQ(ParsePrompt("quad with thrust to weight 3:1").thrust_to_weight, 3);
}

TEST(SideNumbers, SpansOfTheCalendarAreNotFlown) {
  for (const char* span :
       {"Claims in the last five years: none.", "2-year warranty.", "A three-year project.", "It has flown for 6 years.",
        "The props last 3 months.", "Delivery within 10 days.", "Next flight in 2 weeks.", "Flight log of the past 4 weeks."}) {
    const DroneRequest request = ParsePrompt(std::string("Quadcopter, 895 g, flight time 31 min. ") + span);
    EXPECT_EQ(request.flight_time, 31 * 60) << span;
    EXPECT_EQ(request.mass, 0.895) << span;
  }
  EXPECT_THROW(ParsePrompt("a quad that flies for three days"), InputError);
  EXPECT_THROW(ParsePrompt("quad, flight time 2 weeks"), InputError);
}

TEST(SideNumbers, InBeforeATimeAPlaceOrAStateIsNoInch) {
  for (const char* phrase : {"you get one in spring", "he will be 13 in June", "we bought 14 in 2022", "two in service", "two in white",
                             "one in the shed", "five in storage", "sold 20 in this month"}) {
    const DroneRequest request = ParsePrompt(std::string("quadcopter, 1.2 kg; ") + phrase + ".");
    EXPECT_FALSE(request.propeller) << phrase;
    EXPECT_EQ(request.rotors, 4) << phrase;
  }
  for (const char* props : {"13 in folding props", "13 in props", "13in", "props 13 in", "13 in. props", "13 in carbon fibre propellers",
                            "thirteen in props", "propellers: 13 in, black"})
    EXPECT_NEAR(ParsePrompt(std::string("quadcopter, ") + props).propeller.value_or(0), 13 * kInch, 1e-9) << props;
}

TEST(SideNumbers, MoneyWorkMaterialAndToolsAreNoFiguresOfADrone) {
  for (const char* side : {"Starting bid 350 pounds.", "45 hours of printing.", "Printed in 45 hours.", "1.2 kg of filament.",
                           "The battery lasted 300 cycles.", "Use a 2.5 mm hex key.", "Bought for 90 pounds.", "Tyre size 26 x 2.1.",
                           "Cabin bag 8 kg allowed.", "Lesson: 45 minutes."}) {
    const DroneRequest request = ParsePrompt(std::string("Quadcopter weighing 1.7 kg with 10 inch props, flies 24 min. ") + side);
    EXPECT_EQ(request.mass, 1.7) << side;
    EXPECT_EQ(request.rotors, 4) << side;
    EXPECT_EQ(request.flight_time, 24 * 60) << side;
    EXPECT_FALSE(request.payload || request.capacity_ah || request.arm) << side;
  }
  EXPECT_NEAR(*ParsePrompt("the hex weighs 5 pounds").mass, 2.26796185, 1e-9);
  EXPECT_EQ(ParsePrompt("I carry my 1.6 kg quadcopter in a backpack").mass, 1.6);
  EXPECT_EQ(ParsePrompt("The quadcopter itself weighs 1.7 kg").payload, std::nullopt);
}

}  // namespace
}  // namespace airsim360

// Figures that are none of the drone's, and units that stand apart from their numbers.
#include "airsim360/flight/prompt/other_figures.h"

#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/design.h"

namespace airsim360 {
namespace {

struct Case {
  const char* words;
  double value;
};

TEST(OtherFigures, WhatSensorsMeasureIsNoSizeOfTheDrone) {
  for (const Case& c : std::initializer_list<Case>{{"quad with stereo rig, baseline is maybe 20 cm, 450 mm wheelbase, 1.6 kg", 0.45},
                                                   {"wheelbase 250 mm, mocap accuracy 1 mm, quad, 0.7 kg", 0.25},
                                                   {"octo, lidar (10 Hz, 1.2 m to 3 m), 1.6 m between opposite motors", 1.6},
                                                   {"quad, RTK (8 mm + 1 ppm), 700 mm diagonal", 0.7},
                                                   {"quad; depth sensor min range 30 cm; 2.1 kg; wheelbase 600 mm", 0.6},
                                                   {"drone, 280 mm between motors, flies 1 m above the snow", 0.28},
                                                   {"wheelbase=0.5m, n_rotors=4, gps_std=1.2m, baro_std=0.3m", 0.5},
                                                   {"quad, 360 camera on a 30 cm stick, diagonal 500 mm", 0.5},
                                                   {"hexa, protective cage 90 cm wide, 800 mm motor to motor", 0.8}}) {
    EXPECT_NEAR(2 * ParsePrompt(c.words).arm.value_or(0), c.value, 1e-9) << c.words;
  }
}

TEST(OtherFigures, SecondsOfACameraAreNoCells) {
  for (const char* words : {"hexa, 6S 22Ah, a photo every 2 s", "hexa, 6S, shutter 0.7 s", "hexa, 6S, photos at 1.5 s spacing",
                            "hexa, trigger interval of 2 s, 6S", "hexa, Sony camera at 2 s intervals, 6S"}) {
    EXPECT_EQ(ParsePrompt(words).cells, 6) << words;
    EXPECT_FALSE(ParsePrompt(words).flight_time) << words;
  }
  EXPECT_EQ(ParsePrompt("each motor pulls 1.8 kg and there's 4 of them, 2.9 kg, 6S").cells, 6);
  EXPECT_EQ(ParsePrompt("quad, 4 s battery").cells, 4);
}

TEST(OtherFigures, WhatWasBeforeAChangeIsLeftOut) {
  EXPECT_EQ(ParsePrompt("used to run 4S with 2400KV, moved to 6S and 1860KV, quad").cells, 6);
  EXPECT_EQ(ParsePrompt("used to run 4S with 2400KV, moved to 6S and 1860KV, quad").motor_kv, 1860);
  EXPECT_EQ(ParsePrompt("octo, old weight 10.2 kg, new weight 9.4 kg, everything on board").mass, 9.4);
  EXPECT_EQ(ParsePrompt("my quad was 1.9 kg before I changed the frame, now it is 1.6 kg").mass, 1.6);
  EXPECT_NEAR(*ParsePrompt("quad, replaced the 10 inch props by 11 inch ones").propeller, 11 * 0.0254, 1e-9);
  EXPECT_EQ(ParsePrompt("upgraded from 2200 mAh to 5000 mAh, quad 3S").capacity_ah, 5);
  EXPECT_EQ(ParsePrompt("I no longer fly 4S; the quad runs 6S").cells, 6);
  EXPECT_EQ(ParsePrompt("formerly 8 rotors, now a hexa of 7 kg").rotors, 6);
  // Without a change two figures contradict each other.
  EXPECT_THROW(ParsePrompt("quad of 1.9 kg that weighs 1.6 kg"), InputError);
  EXPECT_THROW(ParsePrompt("a 4S quad, 6S"), InputError);
}

TEST(OtherFigures, OtherDronesCasesAndPersonsHaveTheirOwn) {
  EXPECT_EQ(ParsePrompt("smaller than a Matrice 300 (6.3 kg), mine is 3.9 kg, quad").mass, 3.9);
  EXPECT_EQ(ParsePrompt("a Phantom 4 weighs 1380 g; my quad is 1.9 kg").mass, 1.9);
  EXPECT_EQ(ParsePrompt("the old hexa weighed 8 kg, the new quad weighs 5.5 kg").mass, 5.5);
  EXPECT_EQ(ParsePrompt("the old hexa weighed 8 kg, the new quad weighs 5.5 kg").rotors, 4);
  EXPECT_EQ(ParsePrompt("ships in a 15 kg case, hexa 8.8 kg take-off").mass, 8.8);
  EXPECT_EQ(ParsePrompt("I'm 82 kg and no, it is not going to lift me. Octo, 31 kg take-off mass").mass, 31);
  EXPECT_EQ(ParsePrompt("the charger weighs 1.1 kg. Quad 1.5 kg ready to fly").mass, 1.5);
  EXPECT_EQ(ParsePrompt("anything above 4 kg is forbidden here, so the quad has 3.9 kg").mass, 3.9);
  // A person who is to be carried is a load.
  EXPECT_THROW(DroneFromPrompt("octo of 31 kg take-off mass that lifts me, I'm 82 kg"), InputError);
}

TEST(OtherFigures, TimesOnTheGroundAreNotFlown) {
  for (const char* words :
       {"quad, 18 minutes of flight and 50 minutes on the charger", "quad, flight time 18 min, setup within 3 minutes",
        "quad, flies 18 min, recharging time 70 min, 10 min to set up", "quad, flies 18 min, recharge 20 min on the generator",
        "hexa, back on the ground after 18 minutes. Then we had coffee for 40 minutes", "quad, 18 min, next check at 100 h",
        "quad, 18 min per pack. I charge 6 packs at once, about an hour", "quad, 18 min. Our record of last year was 16 min",
        "quad, one charge gives eighteen minutes"}) {
    EXPECT_EQ(ParsePrompt(words).flight_time, 18 * 60) << words;
  }
  EXPECT_EQ(ParsePrompt("quad, 18 min between charges").flight_time, 18 * 60);
  // A second time that is flown contradicts the first.
  EXPECT_THROW(ParsePrompt("quad, flight time 18 min, flight time 50 min"), InputError);
}

TEST(OtherFigures, VoltsOfLinesAndOfSingleCellsAreNoMotorsAndPacks) {
  EXPECT_EQ(ParsePrompt("our lines have 110 kV and 380 kV; hexa, motors 440 KV").motor_kv, 440);
  EXPECT_EQ(ParsePrompt("hexa for inspecting 220 kV pylons: 15 inch props, 340 KV motors").motor_kv, 340);
  EXPECT_EQ(ParsePrompt("quad, 6S, landed at 3.5 V per cell").cells, 6);
  EXPECT_FALSE(ParsePrompt("quad, landed at 3.5 V per cell").cells);
  EXPECT_FALSE(ParsePrompt("quad of 2 kg; 400kv or 340kv?").motor_kv);
  EXPECT_THROW(ParsePrompt("quad, motors 400 KV, motors 340 KV"), InputError);
}

TEST(OtherFigures, CellsOfAPackHoweverTheyAreWired) {
  EXPECT_EQ(ParsePrompt("X8, packs are 6S 16Ah, you use two in series at a time").cells, 12);
  EXPECT_EQ(ParsePrompt("quad, 4S, two 5000s in parallel").capacity_ah, 10);
  EXPECT_EQ(ParsePrompt("quad, 6S6P pack from 5.0 Ah 21700s (36 cells)").capacity_ah, 30);
  EXPECT_EQ(ParsePrompt("quad, 4S 1800? no, sorry, the new ones are 3S 2700 mAh").cells, 3);
  EXPECT_EQ(ParsePrompt("quad, 4S 1800? no, sorry, the new ones are 3S 2700 mAh").capacity_ah, 2.7);
}

TEST(OtherFigures, WhatStandsInABoxOrIsLostIsNotThisDrone) {
  EXPECT_EQ(ParsePrompt("hexa, transport case: 78 x 52 x 40 cm, 11.5 kg, take-off weight 7.8 kg").mass, 7.8);
  EXPECT_EQ(ParsePrompt("X8, 4.6 kg all up, price incl. Pelican case (9 kg)").mass, 4.6);
  EXPECT_EQ(ParsePrompt("hexa, 4 kg AUW. Ships in two boxes, 8 kg and 5 kg").mass, 4);
  EXPECT_EQ(ParsePrompt("hexa, transport box 30 x 20 x 20 cm, 1.5 kg payload, take-off 7 kg").payload, 1.5);
  EXPECT_EQ(ParsePrompt("tricopter died, now a proper quad").rotors, 4);
  EXPECT_EQ(ParsePrompt("the quad we launch from the stern weighs 4 kg with its battery").mass, 4);
  EXPECT_EQ(ParsePrompt("7-Zoll-Quad, 6S 3300er Lipo, mit Akku 1,05 kg").mass, 1.05);
  EXPECT_EQ(ParsePrompt("quad, 5 kg take-off mass, carries a 1.5 kg box").payload, 1.5);
}

TEST(OtherFigures, OfSeveralConditionsOneIsTaken) {
  EXPECT_EQ(ParsePrompt("hexa, 18 kg, 40 min with 2 kg payload, 28 min with 5 kg payload").flight_time, 28 * 60);
  EXPECT_EQ(ParsePrompt("hexa, 18 kg, 40 min with 2 kg payload, 28 min with 5 kg payload").payload, 5);
  EXPECT_EQ(ParsePrompt("quad, 20 min, 14 min in winter").flight_time, 20 * 60);
  EXPECT_EQ(ParsePrompt("quad, 35 minutes claimed, in reality I get 26 minutes").flight_time, 26 * 60);
  EXPECT_EQ(ParsePrompt("quad, max speed 20 m/s, 8 m/s on the lines").speed, 20);
  EXPECT_NEAR(*ParsePrompt("X8, 22 inch uppers, 20 inch lowers").propeller, 22 * 0.0254, 1e-9);
  EXPECT_NEAR(*ParsePrompt("quad, 20 m/s (14 in P mode), 9.4in props").propeller, 9.4 * 0.0254, 1e-9);
}

TEST(BorrowedUnits, ANumberTakesTheUnitOfWhatItReplacesOrShares) {
  EXPECT_EQ(ParsePrompt("hexa, takeoff mass seventeen kg, no wait, eighteen").mass, 18);
  EXPECT_NEAR(*ParsePrompt("quad, wheelbase 17, props 9, both in inches").arm, 17 * 0.0127, 1e-9);
  EXPECT_NEAR(*ParsePrompt("quad, wheelbase 17, props 9, both in inches").propeller, 9 * 0.0254, 1e-9);
  EXPECT_NEAR(*ParsePrompt("quad, dims in mm: wheelbase 450, props 254").propeller, 0.254, 1e-9);
  EXPECT_EQ(ParsePrompt("quad, one hour twenty of hover").hover_time, 80 * 60);
  EXPECT_EQ(ParsePrompt("quad, flight time 22'").flight_time, 22 * 60);
}

TEST(OtherFigures, WholesByTheirPartsAndByWhatTheyInclude) {
  EXPECT_EQ(ParsePrompt("quad, 590 g without the pack, pack is 390 g, makes 980 g at launch").mass, 0.98);
  EXPECT_NEAR(*ParsePrompt("hexa, 40 ignition balls at 150 g each, so 6 kg, take-off weight 19.5 kg").payload, 6, 1e-9);
  EXPECT_EQ(ParsePrompt("quad, the camera alone is 1.55 kg, the drone with camera and battery 6.9 kg").mass, 6.9);
  EXPECT_EQ(ParsePrompt("drone throwing a life buoy of 900 g. Weight with buoy 3.8 kg").mass, 3.8);
  EXPECT_EQ(ParsePrompt("drone throwing a life buoy of 900 g. Weight with buoy 3.8 kg").payload, 0.9);
  const DroneRequest loaded = ParsePrompt("drone 4.2 kg, with the lidar 5.6 kg, quad");
  EXPECT_EQ(loaded.mass, 5.6);
  EXPECT_EQ(loaded.empty_mass, 4.2);
  // Six tenths of the whole are no load: the empty drone was weighed without its battery.
  EXPECT_EQ(ParsePrompt("octo, empty weight 14 kg, maximum take-off weight 36 kg").bare_mass, 14);
}

TEST(OtherFigures, PropellersThatOverlapALittleStandAtTwoHeights) {
  const DroneDesign hexa = DroneFromPrompt("hexa, wheelbase 550 mm, 12 inch props, 2.7 kg");
  EXPECT_NEAR(hexa.wheelbase, 0.55, 1e-9);
  EXPECT_NEAR(hexa.model.rotors[0].diameter, 0.3048, 1e-9);
  for (size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(std::abs(hexa.model.rotors[i].p_B.z - hexa.model.rotors[(i + 1) % 6].p_B.z), 0.1 * 0.3048, 1e-9);
  EXPECT_THROW(DroneFromPrompt("hexa, wheelbase 400 mm, 12 inch props"), InputError);
}

}  // namespace
}  // namespace airsim360

// Turns of phrase that descriptions of drones use.
#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/flight/control/flight_check.h"
#include "airsim360/flight/prompt/design.h"
#include "airsim360/flight/prompt/gate.h"

namespace airsim360 {
namespace {

double RatioOf(const char* prompt) { return FiguresOf(DroneFromPrompt(prompt).model).thrust_to_weight; }

TEST(Reader, AMassBelongsToTheWholeToItsLoadOrToTheDroneWithoutBattery) {
  EXPECT_EQ(ParsePrompt("quad, AUW with gopro 265 g").mass, 0.265);
  EXPECT_EQ(ParsePrompt("quad, take-off weight with camera and battery 1.9 kg").mass, 1.9);
  EXPECT_EQ(ParsePrompt("X500, we add a RealSense so total is 1.95 kg").mass, 1.95);
  EXPECT_EQ(ParsePrompt("quad, 900 g (without battery), 4S 5000 mAh").bare_mass, 0.9);
  EXPECT_NEAR(DroneFromPrompt("quad, 900 g (without battery), 4S 5000 mAh, 10 inch").model.mass,
              0.9 + 74 / 150.0, 0.15);
  EXPECT_NEAR(*ParsePrompt("5 inch quad, 420 g dry, the lipo adds 190 g").mass, 0.61, 1e-12);
  EXPECT_NEAR(*ParsePrompt("quad, 310 g without the GoPro, 120 g payload").mass, 0.43, 1e-12);
  EXPECT_EQ(ParsePrompt("quad, lifts 1 litre of water (call it 1 kg), weighs 5 kg").payload, 1);
  // Of 9 kg in all no drone carries 6 kg.
  EXPECT_EQ(ParsePrompt("hexa that weighs 9 kg with battery and could carry 6 kg").mass, 15);
  EXPECT_THROW(DroneFromPrompt("hexa, take-off weight 9 kg, payload 6 kg"), InputError);
}

TEST(Reader, ThrustOverTheWeightIsTheRatio) {
  EXPECT_NEAR(RatioOf("quad of 2 kg, the four motors together give 8 kg of thrust"), 4, 1e-9);
  EXPECT_NEAR(RatioOf("quad, AUW 1.2 kg, each motor pulls 900 g"), 3, 1e-9);
  EXPECT_NEAR(RatioOf("hexa, mass 2 kg, 7 N thrust per motor"), 6 * 7 / (2 * 9.80665), 1e-9);
  EXPECT_THROW(DroneFromPrompt("quad with a total thrust of 2 kg, weighs 3 kg"), InputError);
}

TEST(Reader, CountsOfOtherThingsAreNone) {
  EXPECT_EQ(ParsePrompt("quad, one arm slightly chipped").rotors, 4);
  EXPECT_EQ(ParsePrompt("quad with two motors spare and 8 spare props").rotors, 4);
  EXPECT_EQ(ParsePrompt("something with 4 or 6 rotors").rotors, 4);
  EXPECT_EQ(ParsePrompt("coaxial quad-arm octo").rotors, 8);
  EXPECT_EQ(ParsePrompt("a coaxial octo on a quad frame").rotors, 8);
  EXPECT_EQ(ParsePrompt("Y6 tricopter").rotors, 6);
  EXPECT_EQ(ParsePrompt("not a tricopter, a quad").rotors, 4);
  EXPECT_EQ(ParsePrompt("a bicopter - scratch that, my boss wants an ordinary quad").rotors, 4);
  EXPECT_THROW(ParsePrompt("mini tri, 5 inch"), InputError);
}

TEST(Reader, LengthsOfPlacesAndBoxesAreNone) {
  const DroneRequest r =
      ParsePrompt("450 mm quad, 10 inch props, fits a 60x40x30 cm case and a 3 m x 3 m room");
  EXPECT_DOUBLE_EQ(*r.arm, 0.225);
  EXPECT_DOUBLE_EQ(*r.propeller, 0.254);
  EXPECT_FALSE(ParsePrompt("survey quad, GSD 2 cm").arm);
  EXPECT_DOUBLE_EQ(*ParsePrompt("quad, 92 mm rotor to rotor").arm, 0.046);
  EXPECT_DOUBLE_EQ(*ParsePrompt("frame 650, 15 inch props").arm, 0.325);
  EXPECT_DOUBLE_EQ(*ParsePrompt("75 mm whoop, 40 mm 4-blade props").propeller, 0.04);
}

TEST(Reader, RangesWithBetweenAndOfRatios) {
  EXPECT_EQ(ParsePrompt("quad between 600 and 700 g").mass, 0.65);
  EXPECT_EQ(ParsePrompt("quad, thrust to weight between 8 and 10").thrust_to_weight, 9);
  EXPECT_EQ(ParsePrompt("quad, TWR 2 to 1").thrust_to_weight, 2);
  EXPECT_EQ(ParsePrompt("quad, 13~15 min").flight_time, 840);
  // The middle turns the tips too fast, an end does not.
  EXPECT_GE(RatioOf("a 0.65 kg racing quad, 5 inch, TWR 12-16"), 12 - 1e-9);
}

TEST(Reader, CodesOfPartsAndChargesAreToldApart) {
  EXPECT_EQ(ParsePrompt("quad, 1300 kv 2806.5").motor_kv, 1300);
  const DroneRequest r = ParsePrompt("hex, 6S 2200, 280 kv... no wait 1800 kv");
  EXPECT_EQ(r.capacity_ah, 2.2);
  EXPECT_EQ(r.motor_kv, 1800);
  EXPECT_FALSE(ParsePrompt("6S 2207 1950kv quad").capacity_ah);
  EXPECT_EQ(ParsePrompt("quad on 4S 1500s").capacity_ah, 1.5);
  EXPECT_EQ(ParsePrompt("toy quad, 2S 500, 120 g").capacity_ah, 0.5);
  EXPECT_EQ(ParsePrompt("quad, two 6S 22 Ah packs in series").cells, 12);
  EXPECT_EQ(ParsePrompt("single-cell 240 mAh quad").cells, 1);
}

TEST(Reader, SharesOfARealDrone) {
  EXPECT_NEAR(*ParsePrompt("70% of the weight of a Mavic 3").mass, 0.7 * 0.895, 1e-12);
  EXPECT_NEAR(*ParsePrompt("70% of a Mavic 3").mass, 0.7 * 0.895, 1e-12);
  EXPECT_NEAR(*ParsePrompt("20 % lighter than a Phantom 4").mass, 0.8 * 1.38, 1e-12);
}

TEST(Reader, WhatNoDroneCanDoIsRefusedAndNotSoughtForEver) {
  EXPECT_THROW(DroneFromPrompt("2200 mAh, hovers 5 hours, 2 inch"), InputError);
}

TEST(Reader, FiveAndSevenRotorsFly) {
  for (const char* prompt : {"pentacopter, 10 inch props, 1.9 kg", "heptacopter of 2.6 kg, 9 inch props"}) {
    const DroneDesign design = DroneFromPrompt(prompt);
    const FlightCheck check = CheckFlight(design.model);
    EXPECT_TRUE(check.passed) << prompt << ": rms " << check.tracking.rms;
  }
  EXPECT_THROW(DroneFromPrompt("pentacopter, 10 inch props, TWR 1.3"), InputError);
}

}  // namespace
}  // namespace airsim360

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
  EXPECT_NEAR(DroneFromPrompt("quad, 900 g (without battery), 4S 5000 mAh, 10 inch").model.mass, 0.9 + 74 / 150.0, 0.15);
  EXPECT_NEAR(*ParsePrompt("5 inch quad, 420 g dry, the lipo adds 190 g").mass, 0.61, 1e-12);
  EXPECT_NEAR(*ParsePrompt("quad, 310 g without the GoPro, 120 g payload").mass, 0.43, 1e-12);
  EXPECT_EQ(ParsePrompt("quad, lifts 1 litre of water (call it 1 kg), weighs 5 kg").payload, 1);
  // Of 9 kg in all no drone carries 6 kg.
  EXPECT_EQ(ParsePrompt("hexa that weighs 9 kg with battery and could carry 6 kg").mass, 15);
  EXPECT_THROW(DroneFromPrompt("hexa, take-off weight 9 kg, payload 6 kg"), InputError);
}

TEST(Reader, TheSameInAnotherUnitIsNoSecondFigureUnlessItDiffers) {
  const DroneRequest whoop = ParsePrompt("85 mm ducted whoop quad, 2 inch props (51 mm), 85 grams");
  EXPECT_NEAR(*whoop.propeller, 0.0508, 1e-3);
  EXPECT_NEAR(*ParsePrompt("quad of 3 lb (1.36 kg) on 10 inch props").mass, 1.36, 0.01);
  EXPECT_THROW(ParsePrompt("my quad weighs 3 lb (2.5 kg) on 10 inch props"), InputError);
}

TEST(Reader, OfSeveralReadingsTheOneThatExplainsAllMassesIsTaken) {
  const DroneRequest list =
      ParsePrompt("quad: frame 115 g, four motors 34 g each, stack 18 g, lipo 205 g, rx and straps 24 g, action cam 120 g");
  EXPECT_NEAR(*list.mass, 0.115 + 4 * 0.034 + 0.018 + 0.205 + 0.024 + 0.12, 1e-12);
  EXPECT_NEAR(*list.payload, 0.12, 1e-12);
  const DroneRequest sum = ParsePrompt("hexa. Payload: lidar 1.35 kg plus 45 MP camera 0.65 kg. MTOW 12.5 kg");
  EXPECT_EQ(sum.mass, 12.5);
  EXPECT_NEAR(*sum.payload, 2, 1e-12);
  const DroneRequest package = ParsePrompt("octo, camera package (camera, lens, gimbal all in 9.5 kg), 27 kg AUW");
  EXPECT_EQ(package.mass, 27);
  EXPECT_EQ(package.payload, 9.5);
  const DroneRequest more = ParsePrompt("package is two boxes of 1.2 kg and one of 600 g, quad, 11 kg all together");
  EXPECT_NEAR(*more.payload, 3, 1e-12);
  EXPECT_EQ(more.mass, 11);
  EXPECT_EQ(ParsePrompt("quad, 58 grams without and 84 grams with battery").bare_mass, 0.058);
  EXPECT_EQ(ParsePrompt("quad, 58 grams without and 84 grams with battery").mass, 0.084);
  EXPECT_EQ(ParsePrompt("quad, net weight (without battery): 14.5 kg").bare_mass, 14.5);
  // Whatever is said of its kind, two masses of one drone contradict each other.
  EXPECT_THROW(ParsePrompt("a 250 g quad of 1 kg"), InputError);
}

TEST(Reader, PartsAreNoMoreThanTheirWhole) {
  for (const char* prompt :
       {"hexa, six motors of 400 g each, AUW 600 g", "quad, frame 2 kg, battery 3 kg, payload 5 kg, take-off weight 3 kg",
        "Mass budget: airframe 4 kg, battery 6 kg, payload 5 kg. Take-off mass with all of these on board: 3 kg. Octo",
        "Quadricopt\xc3\xa8re de 4 kg au d\xc3\xa9"
        "collage ; chacun des quatre moteurs \xc3\xa0 bord p\xc3\xa8se 3,5 kg"})
    EXPECT_THROW(DroneFromPrompt(prompt), InputError) << prompt;
  EXPECT_EQ(ParsePrompt("hexa, six motors of 40 g each, AUW 600 g").mass, 0.6);
}

TEST(Reader, FiguresInTheFormsOfShopsAndForums) {
  EXPECT_EQ(ParsePrompt("whoop, flight time 4:30").flight_time, 270);
  EXPECT_EQ(ParsePrompt("whoop, flies 4min 30s").flight_time, 270);
  EXPECT_EQ(ParsePrompt("quad, 32 min. 12S 16000mAh").cells, 12);
  EXPECT_EQ(ParsePrompt("quad, 6S 2x 4500").capacity_ah, 9);
  EXPECT_EQ(ParsePrompt("quad, two 4S 5000 in parallel").capacity_ah, 10);
  EXPECT_EQ(ParsePrompt("drone, axis: 6, 30 inch").rotors, 6);
  EXPECT_EQ(ParsePrompt("Battery: 3-4S. Quad").cells, 4);
  EXPECT_EQ(ParsePrompt("quad, 4K/30fps, max speed 16 m/s").speed, 16);
  EXPECT_EQ(ParsePrompt("quad, auw 680").mass, 0.68);
  EXPECT_EQ(ParsePrompt("quad, 18 x 6.1 carbon").propeller, 18 * 0.0254);
  EXPECT_EQ(ParsePrompt("quad, motor 6010 KV130").motor_kv, 130);
  EXPECT_EQ(ParsePrompt("quad, 0.8 m tip to tip, motor to motor 550 mm").arm, 0.275);
  EXPECT_EQ(ParsePrompt("quad, 30 min without payload, 18 min with 2 kg payload").flight_time, 1080);
  EXPECT_NEAR(*ParsePrompt("quad, 1.6 kg, payload of 0.3 kg on top of that").mass, 1.9, 1e-12);
  EXPECT_NEAR(*ParsePrompt("sub250 quad, 238 g").mass, 0.238, 1e-12);
  EXPECT_NEAR(*ParsePrompt("5G WiFi quad of 210 g").mass, 0.21, 1e-12);
  EXPECT_EQ(ParsePrompt("quad, stays up 1h10m").flight_time, 4200);
  EXPECT_NEAR(*ParsePrompt("Quadrokopter, weighing 15 N").mass, 15 / 9.80665, 1e-9);
  EXPECT_EQ(ParsePrompt("quad, AUW just shy of 230 g... say 225").mass, 0.225);
  EXPECT_THROW(ParsePrompt("quad, 28 inch props at 60,000 rpm"), InputError);
}

TEST(Reader, ManyMassesTakeNoLongTime) {
  std::string masses = "quad";
  while (masses.size() < 980) masses += " and 9 g";
  try {
    ParsePrompt(masses);
  } catch (const InputError&) {
  }
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
  const DroneRequest r = ParsePrompt("450 mm quad, 10 inch props, fits a 60x40x30 cm case and a 3 m x 3 m room");
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

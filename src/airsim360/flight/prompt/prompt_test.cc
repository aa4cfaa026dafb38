#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/design.h"
#include "airsim360/flight/prompt/gate.h"

namespace airsim360 {
namespace {

std::string ErrorOf(std::string_view prompt) {
  try {
    DroneFromPrompt(prompt);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

::testing::AssertionResult Says(const std::string& text, std::initializer_list<const char*> parts) {
  for (const char* part : parts) {
    if (text.find(part) == std::string::npos) return ::testing::AssertionFailure() << "'" << part << "' is not in: " << text;
  }
  return ::testing::AssertionSuccess();
}

TEST(Prompt, NumbersFindTheNounOrUnitThatSaysWhatTheyAre) {
  const DroneRequest r = ParsePrompt(
      "A 1.2 kg hexacopter with 10x4.5x3 props, arms of 30 cm, a 4S 5000 mAh battery, "
      "25 minutes, 15 m/s and a 200 g payload");
  EXPECT_EQ(r.mass, 1.2);
  EXPECT_EQ(r.rotors, 6);
  EXPECT_DOUBLE_EQ(*r.propeller, 0.254);
  EXPECT_DOUBLE_EQ(*r.pitch, 0.1143);
  EXPECT_EQ(r.blades, 3);
  EXPECT_DOUBLE_EQ(*r.arm, 0.3);
  EXPECT_EQ(r.cells, 4);
  EXPECT_DOUBLE_EQ(*r.capacity_ah, 5);
  EXPECT_EQ(r.flight_time, 1500);
  EXPECT_EQ(r.speed, 15);
  EXPECT_DOUBLE_EQ(*r.payload, 0.2);
}

TEST(Prompt, TheSameThingInOtherWordsAndUnitsIsTheSameRequest) {
  const auto same = [](std::string_view a, std::string_view b) {
    const DroneModel x = DroneFromPrompt(a).model, y = DroneFromPrompt(b).model;
    EXPECT_NEAR(x.mass, y.mass, 1e-12 * x.mass);
    EXPECT_NEAR(x.inertia_B.m[2][2], y.inertia_B.m[2][2], 1e-9 * x.inertia_B.m[2][2]);
    EXPECT_NEAR(x.rotors[0].max_speed, y.rotors[0].max_speed, 1e-9 * x.rotors[0].max_speed);
  };
  same("a 250 g five-inch racing quad", "RACING quadcopter, 0.25kg, 5\" propellers");
  same("a 450 mm wheelbase quad", "a quad with a diagonal of 45 cm");
  same("a 450 mm quad", "a quad with arms of 225 mm");
  same("a quad that flies 36 km/h, 1 kg", "a 1000 gram quad with a top speed of 10 m/s");
  same("a 1 kg quad with thrust to weight 4", "a 1 kg quad with a thrust-to-weight ratio of 4:1");
  same("a coaxial 5 kg drone", "an X8 of 5 kg");
}

TEST(Prompt, AWordThatCarriesNoFigureIsListedAndNeverARefusal) {
  const DroneRequest r = ParsePrompt("a shiny 1 kg quad for my nephew with 4K, Pixhawk and 3 friends");
  EXPECT_EQ(r.mass, 1);
  EXPECT_EQ(r.unused, (std::vector<std::string>{"shiny", "nephew", "4", "k", "pixhawk", "3", "friends"}));
  EXPECT_TRUE(ParsePrompt("a 1 kg quad").unused.empty());
  EXPECT_EQ(DroneFromPrompt("a quad with 7").unused, std::vector<std::string>{"7"});
  EXPECT_TRUE(DroneFromPrompt("a quad of \xc3\xa9 kg").unused.empty());
}

TEST(Prompt, AQuantityFindsItsNounByGrammar) {
  EXPECT_DOUBLE_EQ(*ParsePrompt("quad, 2 kg, props 33 cm across").propeller, 0.33);
  EXPECT_DOUBLE_EQ(*ParsePrompt("hexa of 3 kg, rotor radius 0.165 m").propeller, 0.33);
  EXPECT_DOUBLE_EQ(*ParsePrompt("a drone 60 cm across").arm, 0.3);
  EXPECT_DOUBLE_EQ(*ParsePrompt("65mm whoop 1S 31mm props AUW 25 g").propeller, 0.031);
  EXPECT_EQ(ParsePrompt("lifts a crate (about nine kilos)").payload, 9);
  EXPECT_EQ(ParsePrompt("carries a half-kilo canopy").payload, 0.5);
  EXPECT_EQ(ParsePrompt("lifting two bags of 3 kg").payload, 6);
  EXPECT_FALSE(ParsePrompt("a 907 g drone, 1\" CMOS").propeller);
  EXPECT_EQ(ParsePrompt("weight=3kg; rotors=6").rotors, 6);
  EXPECT_EQ(ParsePrompt("weight (g): 1200").mass, 1.2);
  EXPECT_EQ(ParsePrompt("1 500 g quad").mass, 1.5);
  EXPECT_EQ(ParsePrompt("2kg500 quad").mass, 2.5);
  EXPECT_DOUBLE_EQ(*ParsePrompt("quad, 2S 450").capacity_ah, 0.45);
  EXPECT_DOUBLE_EQ(*ParsePrompt("4S 450 quad").arm, 0.225);
  EXPECT_DOUBLE_EQ(*ParsePrompt("quad with 22-inch props? no, 18 inch").propeller, 18 * 0.0254);
  EXPECT_NEAR(*ParsePrompt("Mavic Air 2 that weighs 100 g more than normal").mass, 0.67, 1e-12);
}

TEST(Prompt, SomethingThatFliesIsBuiltAndSaid) {
  const DroneRequest r = ParsePrompt("something cheap that flies for my 9 year old nephew, indoors");
  ASSERT_FALSE(r.decided.empty());
  EXPECT_TRUE(Says(r.decided[0], {"nothing is said of its kind"}));
}

TEST(Prompt, AMisspeltWordThatMattersIsReadAndSaid) {
  const DroneRequest r = ParsePrompt("a hexcopterr with propelers of 12 inch");
  EXPECT_EQ(r.rotors, 6);
  EXPECT_DOUBLE_EQ(*r.propeller, 0.3048);
  ASSERT_EQ(r.decided.size(), 2u);
  EXPECT_TRUE(Says(r.decided[0], {"'hexcopterr'", "'hexcopter'"}));
}

TEST(Prompt, WhatDescribesNoDroneIsRefusedWithTheReason) {
  EXPECT_TRUE(Says(ErrorOf(""), {"empty"}));
  EXPECT_TRUE(Says(ErrorOf("purple elephant"), {"nothing in", "describes a drone"}));
  EXPECT_TRUE(Says(ErrorOf("a -5 kg quad"), {"negative"}));
  EXPECT_TRUE(Says(ErrorOf("a 1.2.3 kg quad"), {"1.2.3 kg", "no number"}));
  EXPECT_TRUE(Says(ErrorOf("a 0x10 kg quad"), {"0x10 kg", "no number"}));
  EXPECT_TRUE(Says(ErrorOf("a 0 kg quad"), {"'0 kg'", "0.01 to 400 kg"}));
  EXPECT_TRUE(Says(ErrorOf("a 900 kg quad"), {"'900 kg'", "mass"}));
  EXPECT_TRUE(Says(ErrorOf("a tricopter"), {"three"}));
  EXPECT_TRUE(Says(ErrorOf("a drone with 9 rotors"), {"4 to 8"}));
  EXPECT_TRUE(Says(ErrorOf(std::string(2000, 'a')), {"1000"}));
  EXPECT_TRUE(Says(ErrorOf("a 99999999999999999999999 kg quad"), {"describes no drone"}));
  for (const char* other : {"a fixed-wing UAV", "an RC helicopter", "a VTOL drone", "an underwater drone", "a blimp"})
    EXPECT_TRUE(Says(ErrorOf(other), {"not a multirotor"})) << other;
  EXPECT_TRUE(Says(ErrorOf("a racing drone, top speed Mach 2"), {"'mach 2'", "speed"}));
  EXPECT_TRUE(Says(ErrorOf("a drone with zero propellers"), {"4 to 8"}));
  EXPECT_TRUE(Says(ErrorOf("an eighteen rotor drone"), {"no more than 8"}));
  EXPECT_TRUE(Says(ErrorOf("a quad that flies for 3 days"), {"'3 days'"}));
  EXPECT_TRUE(Says(ErrorOf("a boat"), {"not a multirotor"}));
  // What a drone is for is no vehicle of its own.
  EXPECT_EQ(ParsePrompt("a 2 kg drone to film boats and cars").mass, 2);
}

TEST(Prompt, RealDronesStandInWithTheirFactsUnlessOthersAreSaid) {
  EXPECT_DOUBLE_EQ(DroneFromPrompt("DJI Mavic 3").model.mass, 0.895);
  const DroneDesign heavy = DroneFromPrompt("like a Mavic 3 but twice as heavy");
  EXPECT_DOUBLE_EQ(heavy.model.mass, 1.79);
  // The same disc loading.
  EXPECT_NEAR(heavy.model.rotors[0].diameter, 9.4 * 0.0254 * std::sqrt(2), 1e-9);
  const DroneDesign six = DroneFromPrompt("like a Phantom 4 but with six rotors");
  EXPECT_EQ(six.model.rotors.size(), 6u);
  EXPECT_DOUBLE_EQ(six.model.mass, 1.38);
  EXPECT_DOUBLE_EQ(DroneFromPrompt("a crazyflie with a 10 g deck").model.mass, 0.037);
  EXPECT_DOUBLE_EQ(DroneFromPrompt("a mini 2 inch quad of 90 g").model.rotors[0].diameter, 0.0508);
}

TEST(Prompt, WhatWasChosenForTheUserIsSaid) {
  const DroneDesign design = DroneFromPrompt("a quad with 25-30 min of flight and a 22.2 V battery");
  std::string all;
  for (const std::string& sentence : design.decided) all += sentence + "\n";
  EXPECT_TRUE(Says(all, {"the middle", "6 cells", "the mass was not said", "no kind was said"}));
  EXPECT_DOUBLE_EQ(design.flight_time, 27.5 * 60);
}

TEST(Prompt, WordsThatContradictEachOtherAreRefusedNamingBoth) {
  EXPECT_TRUE(Says(ErrorOf("a 250 g quad of 1 kg"), {"'1 kg'", "'250 g'", "mass"}));
  EXPECT_TRUE(Says(ErrorOf("a quad hexacopter"), {"'hexacopter'", "'quad'", "rotors"}));
  EXPECT_TRUE(Says(ErrorOf("an X plus quad"), {"'plus'", "'x'", "layout"}));
  EXPECT_TRUE(Says(ErrorOf("an H octocopter"), {"'h'", "8"}));
  EXPECT_TRUE(Says(ErrorOf("a 10 kg quad with 2 inch propellers"), {"'10 kg'", "'2 inch'", "disc"}));
  EXPECT_TRUE(Says(ErrorOf("a 20 g quad with 20 inch propellers"), {"'20 g'", "'20 inch'"}));
  EXPECT_TRUE(Says(ErrorOf("a quad with 10 inch propellers and a 250 mm wheelbase"), {"overlap", "'10 inch'", "'250 mm'"}));
  EXPECT_TRUE(Says(ErrorOf("a 1 kg quad with a 5 kg payload"), {"'5 kg'", "'1 kg'"}));
  EXPECT_TRUE(Says(ErrorOf("a tiny 20 kg quad"), {"'tiny'", "'20 kg'"}));
  EXPECT_TRUE(Says(ErrorOf("a huge 100 g quad"), {"'huge'"}));
  EXPECT_TRUE(Says(ErrorOf("a 500 g quad with 5 hours of flight time"), {"'5 hours'", "battery"}));
  EXPECT_TRUE(Says(ErrorOf("a 1 kg quad with thrust to weight 1.3 that flies 40 m/s"), {"'40 m/s'", "level flight ends"}));
  EXPECT_TRUE(Says(ErrorOf("a 2 kg quad with 5 inch propellers and thrust to weight 12"), {"thrust to weight 12"}));
  EXPECT_TRUE(Says(ErrorOf("a quad with 5x9 propellers"), {"pitch"}));
  EXPECT_TRUE(Says(ErrorOf("a 1 kg quad with 10 inch propellers, 60 minutes and a 1000 mAh battery"), {"'60 minutes'", "'1000 mah'"}));
}

TEST(Prompt, EveryParameterHasItsLaw) {
  const DroneDesign design = DroneFromPrompt("a 250 g five-inch racing quad");
  EXPECT_TRUE(Says(design.laws.at("mass"), {"said: '250 g'"}));
  EXPECT_TRUE(Says(design.laws.at("thrust_factor"), {"C_T", "Budinger"}));
  for (const char* name : {"rotors", "arm", "diameter", "torque_ratio", "max_speed", "inertia", "tau", "in_plane_drag", "quadratic_drag",
                           "cells", "capacity_ah", "battery", "motors", "half_size"}) {
    EXPECT_FALSE(design.laws.at(name).empty()) << name;
  }
}

TEST(Prompt, OfTwoMassesTheOneOfANamedThingIsCarried) {
  for (const char* prompt : {"hexa with a sonar pod, 1.5 kg, MTOW 9 kg", "9 kg hexa, RFID reader 1.5 kg on board",
                             "hexa, all-up 9 kg, 1.5 kg on the hook", "hexa, total 9 kg, cargo 1.5 kg"}) {
    const DroneDesign design = DroneFromPrompt(prompt);
    EXPECT_NEAR(design.model.mass, 9, 0.1) << prompt;
    EXPECT_NEAR(design.parts.payload, 1.5, 0.01) << prompt;
  }
  EXPECT_THROW(DroneFromPrompt("a 2 kg quad, 3 kg"), InputError);
}

TEST(Prompt, WhereThereIsNoAirNothingIsBuilt) {
  for (const char* prompt : {"a quad on the Moon, 3 kg", "a quad hovering in space", "2 kg hexa for flights on Mars"})
    EXPECT_THROW(DroneFromPrompt(prompt), InputError) << prompt;
  EXPECT_NO_THROW(DroneFromPrompt("a 500 g quad flying in space constrained rooms"));
}

TEST(Design, PartsAddUpToTheMassAndSaidFiguresAreKept) {
  for (const char* prompt : {"a 250 g five-inch racing quad", "a 12 kg delivery octocopter with a 4 kg parcel",
                             "a 2 kg hexacopter with 20 minutes, thrust to weight 2.5"}) {
    const DroneDesign design = DroneFromPrompt(prompt);
    EXPECT_NEAR(design.parts.Sum(), design.model.mass, 1e-12 * design.model.mass);
    EXPECT_GT(design.parts.body, 0);
  }
  const DroneDesign timed = DroneFromPrompt("a 2 kg hexacopter with 20 minutes, thrust to weight 2.5");
  EXPECT_NEAR(timed.endurance, 1200, 1);
  EXPECT_NEAR(FiguresOf(timed.model).thrust_to_weight, 2.5, 1e-9);
  EXPECT_GE(DroneFromPrompt("a 900 g quad that flies 22 m/s").level_speed, 22);
}

TEST(Design, FollowsTheWorkedExampleOfItsLaws) {
  // Five-inch three-blade propellers of 4.3 inch pitch: C_T = (0.0427 + 0.144 * 0.86) * 2^... = 0.213.
  const DroneDesign design = DroneFromPrompt("a 250 g 5x4.3x3 racing quad, thrust to weight 8");
  const DroneFigures figures = FiguresOf(design.model);
  const double c_t = (0.0427 + 0.144 * 0.86) * std::pow(1.5, 0.61);
  EXPECT_NEAR(figures.thrust_coefficient, c_t, 1e-12);
  EXPECT_NEAR(design.model.rotors[0].thrust_factor, c_t * 1.225 * std::pow(0.127, 4) / (4 * M_PI * M_PI), 1e-18);
  // Hover: n k_f w^2 = m g.
  EXPECT_NEAR(4 * design.model.rotors[0].thrust_factor * figures.hover_speed * figures.hover_speed, 0.25 * kGravity, 1e-12);
  EXPECT_NEAR(figures.max_thrust, 8 * 0.25 * kGravity, 1e-9);
}

TEST(Design, MoreMassNeedsFasterRotorsMoreInertiaAndMorePower) {
  const DroneDesign light = DroneFromPrompt("a 1 kg quad with 10 inch propellers");
  const DroneDesign heavy = DroneFromPrompt("a 1.6 kg quad with 10 inch propellers");
  EXPECT_GT(FiguresOf(heavy.model).hover_speed, FiguresOf(light.model).hover_speed);
  EXPECT_GT(heavy.model.inertia_B.m[0][0], light.model.inertia_B.m[0][0]);
  EXPECT_GT(heavy.hover_power, 1.6 * light.hover_power);
}

}  // namespace
}  // namespace airsim360

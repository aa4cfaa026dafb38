#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/request.h"

namespace airsim360 {
namespace {

TEST(OtherSentences, AFormerDroneIsNotTheOneThatIsDescribed) {
  EXPECT_EQ(ParsePrompt("7 inch quad, 6S, 1.1 kg. My last build was on 4S and weighed 0.9 kg.").cells, 6);
  EXPECT_EQ(ParsePrompt("7 inch quad, 6S, 1.1 kg. My last build was on 4S and weighed 0.9 kg.").mass, 1.1);
  EXPECT_EQ(ParsePrompt("octo of 19 kg. The old one was a hexa, lost in a lake.").rotors, 8);
  EXPECT_EQ(ParsePrompt("pentacopter, 6S. Before that I flew a Y6.").rotors, 5);
  EXPECT_EQ(ParsePrompt("quad, 4S 1500; it used to be on 3S 1300").cells, 4);
  EXPECT_EQ(ParsePrompt("hexa, 4 kg, 30 min. In 2017 we had an octo of 6 kg for 20 min.").mass, 4);
  EXPECT_EQ(ParsePrompt("v3 of the quad: 140 g. v2 was 190 g.").mass, 0.14);
}

TEST(OtherSentences, NeitherIsSomebodyElsesNorABaseline) {
  EXPECT_EQ(ParsePrompt("quad of 9 kg that hovers 50 min; the competitor's hexa lifts 12 kg").rotors, 4);
  EXPECT_EQ(ParsePrompt("7 inch quad on 6S. His other one, a 5 inch on 4S, waits for parts.").cells, 6);
  EXPECT_EQ(ParsePrompt("We replaced the quad (2.9 kg) by a hexacopter of 7.9 kg").rotors, 6);
  EXPECT_EQ(ParsePrompt("hexa of 95 g; for comparison, the commercial one weighs 27 g").mass, 0.095);
  EXPECT_NEAR(*ParsePrompt("N = 4, D = 14 in, m = 3.2 kg. The baseline in chapter 2 had D = 11 in, ignore it.").propeller, 14 * 0.0254,
              1e-9);
}

TEST(OtherSentences, WhatCanBeHadBesidesIsNotOnBoard) {
  EXPECT_EQ(ParsePrompt("hexa, 6S 10 Ah, 3.4 kg; a second battery (6S 16 Ah) is available for 120").capacity_ah, 10);
  EXPECT_EQ(ParsePrompt("octo, 6S 22 Ah; the 16 Ah pack was tried and given up").capacity_ah, 22);
  EXPECT_EQ(ParsePrompt("hexa, 12S 22000. Batteries up to 30 Ah were not bought.").capacity_ah, 22);
  EXPECT_EQ(ParsePrompt("octo, 18S 30 Ah, 12 min. Stretch goal: 45 Ah and 15 min.").capacity_ah, 30);
}

TEST(OtherSentences, WhatIsSaidOfTheDroneAloneStays) {
  EXPECT_EQ(ParsePrompt("My first build: a quad of 1.2 kg on 4S").mass, 1.2);
  EXPECT_EQ(ParsePrompt("a quad whose battery used to be in my car, 4S").cells, 4);
  EXPECT_EQ(ParsePrompt("my last build was a quad of 1.2 kg").mass, 1.2);
  EXPECT_EQ(ParsePrompt("My old quad was 1.9 kg, the new one has 1.6 kg").mass, 1.6);
  EXPECT_THROW(ParsePrompt("a quad of 1.9 kg. It weighs 1.2 kg."), InputError);
}

TEST(OtherSentences, PacksAndPropellersAreCounted) {
  EXPECT_EQ(ParsePrompt("octo with two parallel 6S 22 Ah batteries").capacity_ah, 44);
  EXPECT_EQ(ParsePrompt("whoop, one 450 mAh cell").cells, 1);
  EXPECT_EQ(ParsePrompt("quad on a single 21700, 3000 mAh").cells, 1);
  EXPECT_EQ(ParsePrompt("6 x 13\" props, 4 kg").rotors, 6);
  EXPECT_NEAR(*ParsePrompt("6 x 13\" props, 4 kg").propeller, 13 * 0.0254, 1e-9);
  EXPECT_NEAR(*ParsePrompt("quad, 9 x 4.5 inch props").propeller, 9 * 0.0254, 1e-9);
  EXPECT_EQ(ParsePrompt("octo of forty kilos, of which 12 is payload").payload, 12);
  EXPECT_EQ(ParsePrompt("m_TO: 7.5 kg; m_PL: 1.2 kg; octo").payload, 1.2);
  EXPECT_EQ(ParsePrompt("oct-rotor of 15 kg").rotors, 8);
  EXPECT_EQ(ParsePrompt("a six-armed drone of 3 kg").rotors, 6);
  EXPECT_NEAR(*ParsePrompt("four rotors, diameter 21 inch, 7.5 kg").propeller, 21 * 0.0254, 1e-9);
}

}  // namespace
}  // namespace airsim360

// Tables, JSON, LaTeX and lists say the same as the sentences that they stand for.
#include "airsim360/flight/prompt/markup.h"

#include <gtest/gtest.h>

#include "airsim360/flight/prompt/request.h"

namespace airsim360::internal {
namespace {

TEST(Markup, EveryFormOfATableIsTheSameDrone) {
  for (
      const char* text : {
          "hexa, 6.2 kg, 18 inch propellers, 12S",
          "| parameter | value | unit |\n|---|---|---|\n| rotors | 6 | - |\n| mass | 6.2 | kg |\n| propeller | 18 | inch |\n| cells | 12 | S |",
          "Rotors | 6\nMass | 6.2 kg\nPropeller | 18 inch\nCells | 12S",
          "| Rotors | Mass | Propeller | Battery |\n|---|---|---|---|\n| 6 | 6.2 kg | 18 inch | 12S |",
          "rotors,mass_kg,prop_in,cells\n6,6.2,18,12",
          "{\"type\": \"hexarotor\", \"mass_kg\": 6.2, \"prop_in\": 18, \"battery\": {\"cells\": 12}, \"camera\": {\"fps\": 30}}",
          "<tr><td>Rotors</td><td>6</td></tr><tr><td>Mass</td><td>6.2 kg</td></tr><tr><td>Propeller</td><td>18 inch</td></tr>"
          "<tr><td>Cells</td><td>12S</td></tr>",
          "<drone><type>hexacopter</type><mass unit=\"kg\">6.2</mass><propeller unit=\"inch\">18</propeller><cells>12</cells></drone>",
          "\\begin{tabular}{ll}\nNumber of rotors & 6 \\\\\nMass & \\SI{6.2}{\\kilo\\gram} \\\\\nPropeller & \\SI{18}{\\inch} \\\\\n"
          "Battery & 12S \\\\\n\\end{tabular}",
          "Mass ........ 6.2 kg\nRotors ...... 6\nPropeller ... 18 in\nCells ... 12",
          "Mass in kg: 6.2\nRotors: 6\nPropeller in inch: 18\nCells: 12",
          "rotors;6\nmass;6.2 kg\npropeller;18 inch\ncells;12",
          "1. Hexacopter\n2. 6.2 kg\n3. 18 inch props\n4. 12S",
      }) {
    const DroneRequest request = ParsePrompt(text);
    EXPECT_NEAR(request.mass.value_or(0), 6.2, 1e-9) << text;
    EXPECT_NEAR(request.propeller.value_or(0), 0.4572, 1e-9) << text;
    EXPECT_EQ(request.rotors, 6) << text;
    EXPECT_EQ(request.cells, 12) << text;
  }
}

TEST(Markup, SymbolsBelongToTheNamesBeforeThem) {
  const DroneRequest request =
      ParsePrompt("octorotor, mass m = 11 500 g, rotor radius R = 20.3 cm, distance of opposite motors D = 110 cm, v_max = 14 m s^-1");
  EXPECT_NEAR(*request.mass, 11.5, 1e-9);
  EXPECT_NEAR(*request.propeller, 0.406, 1e-9);
  EXPECT_NEAR(*request.arm, 0.55, 1e-9);
  EXPECT_NEAR(*request.speed, 14, 1e-9);
}

TEST(Markup, PlainSentencesStayAsTheyAre) {
  for (const char* text : {"a 250 g five-inch racing quad", "quad, 4S 5000mAh: 18 min hover", "under 250 g, $400", "2 x 16 Ah",
                           "Drone \"Condor\": hexa / 22\" / 12S"})
    EXPECT_EQ(WithoutMarkup(text), text);
  EXPECT_EQ(WithoutMarkup(""), "");
}

}  // namespace
}  // namespace airsim360::internal

#include "airsim360/worlds/town_spec.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "airsim360/base/error.h"

namespace airsim360 {

void TownSpec::Visit(ConfigVisitor& v) {
  v.Field("plan", "of the streets", plan, kTownPlans);
  v.Field("style", "of the houses", style, kTownStyles);
  v.Field("relief", "of the ground", relief, kTownReliefs);
  v.Field("climb", "metres between the lowest and the highest ground; nothing where it is flat", climb, 0, kMostClimb);
  v.Field("water", "in, beside or around the town", water, kTownWaters);
  v.Field("paving", "of streets and squares", paving, kTownPavings);
  v.Field("country", "around the town", country, kTownCountries);
  v.Field("colours", "of walls", colours, kTownColours);
  v.Field("roofs", "of houses", roofs, kTownRoofs);
  v.Field("width", "metres east", width, kLeastSide, kMostSide);
  v.Field("depth", "metres north", depth, kLeastSide, kMostSide);
  v.Field("least_floors", "of houses", least_floors, 1, kMostFloors);
  v.Field("most_floors", "of houses", most_floors, 1, kMostFloors);
  v.Field("street", "metres between the walls of a street", street, 4, 40);
  v.Field("block", "metres between streets", block, 30, 200);
  v.Field("built", "share of the fronts that have a house", built, 0.05, 1);
  v.Field("setback", "metres of front gardens; more than 0: houses stand apart", setback, 0, 30);
  v.Field("trees", "along streets, 1 = usual", trees, 0, 1.6);
  v.Field("traffic", "cars at the kerb and in the lanes, 1 = usual", traffic, 0, 1.6);
  v.Field("squares", "0 to 4", squares);
  v.Field("parks", "0 to 6", parks);
  v.Field("houses", "at most so many; 0 = as many as fit", houses);
  v.Field("church", "on the square", church);
  v.Field("castle", "above the town", castle);
  v.Field("clock_tower", "on the square", clock_tower);
  v.Field("windmill", "at the edge of the town", windmill);
  v.Field("market", "stalls on the square", market);
  v.Field("cafes", "tables and sunshades on the pavements", cafes);
  v.Field("ruins", "columns and old walls", ruins);
  v.Field("arches", "over lanes", arches);
  v.Field("wires", "tram tracks and the wires over them", wires);
  v.Field("harbour", "piers and boats; needs sea, island, river or lake", harbour);
  v.Field("playground", "in a park of its own", playground);
  v.Field("fountain", "on the square", fountain);
  v.Field("towers", "high-rises among the houses", towers);
  v.Field("cycle_lanes", "on the main streets", cycle_lanes);
  v.Field("palms", "instead of street trees", palms);
  v.Field("lamps", "along the streets", lamps);
  v.Field("bus_stops", "on the main streets, near corners", bus_stops);
  v.Field("central_water", "a river, canal or lake lies in the middle of the town", central_water);
  v.Field("terrace", "the world begins on the roof in its middle", terrace);
}

void TownSpec::Check(const char* prefix) const {
  const auto refuse = [&](const std::string& why) { throw InputError(prefix + why); };
  const auto number = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return std::string(text);
  };
  if (least_floors > most_floors) refuse("least_floors: " + number(least_floors) + " is more than most_floors: " + number(most_floors));
  if (harbour && (water == TownWater::kNone || water == TownWater::kCanal))
    refuse(std::string("harbour: true needs water: sea, island, river or lake, not ") + kTownWaters[static_cast<int>(water)]);
  if (squares > 4) refuse("squares: " + std::to_string(squares) + " is not from 0 to 4");
  if (parks > 6) refuse("parks: " + std::to_string(parks) + " is not from 0 to 6");
  if (houses > 4000) refuse("houses: " + std::to_string(houses) + " is not from 0 to 4000");
  if ((market || clock_tower || fountain) && squares == 0) refuse("market, clock_tower and fountain need a square: squares is 0");
  if (terrace && (relief != TownRelief::kFlat || most_floors < 6)) refuse("terrace: true needs relief: flat and most_floors of 6 and more");
  if (relief != TownRelief::kFlat && climb > 0.3 * std::min(width, depth))
    refuse("climb: " + number(climb) + " is steeper than 30 % for a town of " + number(width) + " x " + number(depth) + " m");
}

}  // namespace airsim360

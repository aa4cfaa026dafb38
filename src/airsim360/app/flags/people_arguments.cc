#include "airsim360/app/flags/people_arguments.h"

#include <charconv>
#include <filesystem>

#include "airsim360/base/error.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/text.h"

namespace airsim360 {
namespace {

constexpr uint64_t kMostPeople = 20000;

// A number of people; nullopt if the text is none.
std::optional<uint64_t> ParseCount(const std::string& text) {
  uint64_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return count;
}

}  // namespace

void PeopleArguments::AddTo(CLI::App& command) {
  command.add_option("--people", people, "people in the world: how many, or a people.yaml (docs/guide/people_behaviour.md)");
  command.add_option("--people-warmup", warm_up, "seconds that people live before the first frame (default 15)")
      ->check(CLI::Range(0.0, 3600.0));
  command.add_option("--people-level", level, "detail of all bodies, 0 = finest (default: by their distance)")->check(CLI::Range(0, 3));
  command.add_option("--people-reserve", reserve, "people who can be spawned later (default 0)")
      ->check(CLI::Range(0, static_cast<int>(kMostPeople)));
  command.add_option("--sockets", sockets, "further keypoints, fixed to joints (docs/guide/people_labels.md)");
}

PeopleRequest PeopleArguments::Request(uint64_t seed) const {
  PeopleRequest request{.sockets = sockets, .warm_up = warm_up, .level = level, .seed = seed};
  request.reserve = static_cast<size_t>(reserve);
  if (people.empty()) {
    const std::string flag = !sockets.empty()                       ? "--sockets"
                             : level >= 0                           ? "--people-level"
                             : warm_up != PeopleArguments().warm_up ? "--people-warmup"
                                                                    : "";
    // Not accepted and ignored.
    if (!flag.empty() && !request.any()) throw InputError(flag + ": there is nobody; add --people N, for example --people 30");
    return request;
  }
  if (const auto count = ParseCount(people)) {
    if (*count > kMostPeople) {
      throw InputError("--people: " + people + " is not in 0 … " + std::to_string(kMostPeople) + "; did you mean " +
                       std::to_string(kMostPeople) + "?");
    }
    request.count = *count;
  } else if (std::filesystem::is_regular_file(people)) {
    request.file = people;
  } else {
    throw InputError("--people: '" + people + "' is neither a number nor a file, for example 30 or people.yaml");
  }
  return request;
}

std::string PeopleArguments::Describe() const {
  if (!Request(0).any()) return {};
  const std::optional<uint64_t> count = ParseCount(people);
  std::string text = count ? std::to_string(*count) : people.empty() ? "0" : "sha256:" + Sha256HexOfFile(people);
  text += ", warm-up " + ShortestText(warm_up) + " s";
  if (level >= 0) text += ", level " + std::to_string(level);
  if (reserve > 0) text += ", reserve " + std::to_string(reserve);
  if (!sockets.empty()) text += ", sockets sha256:" + Sha256HexOfFile(sockets);
  return text;
}

}  // namespace airsim360

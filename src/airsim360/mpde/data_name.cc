#include "airsim360/mpde/data_name.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

template <class Number>
Number NumberOf(const std::string& text, const std::string& whole) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw InputError("'" + whole + "': '" + text + "' is no number; data are PATH[:SPLIT][#PERSONS][@SHARE]");
  return value;
}

bool IsFile(const std::string& path) { return !fs::is_directory(path); }

// All samples of some persons: those that come first when their ids are shuffled by the seed.
std::vector<MpdeSample> SomePersons(std::vector<MpdeSample> samples, uint64_t persons, uint64_t seed) {
  if (persons == 0) return samples;
  std::set<std::pair<uint64_t, uint64_t>> order;
  for (const MpdeSample& sample : samples) order.emplace(MixBits(sample.person ^ MixBits(seed)), sample.person);
  if (order.size() < persons)
    throw InputError("#" + std::to_string(persons) + ": there are only " + std::to_string(order.size()) + " persons");
  std::set<uint64_t> taken;
  for (auto it = order.begin(); taken.size() < persons; ++it) taken.insert(it->second);
  std::erase_if(samples, [&](const MpdeSample& sample) { return !taken.contains(sample.person); });
  return samples;
}

}  // namespace

MpdeDataName ParseMpdeData(const std::string& text) {
  MpdeDataName name;
  std::string rest = text;
  const auto cut = [&](char mark) {
    const size_t at = rest.rfind(mark);
    if (at == std::string::npos || rest.find('/', at) != std::string::npos) return std::string();
    std::string tail = rest.substr(at + 1);
    rest.resize(at);
    return tail;
  };
  if (const std::string share = cut('@'); !share.empty()) name.share = NumberOf<double>(share, text);
  if (const std::string persons = cut('#'); !persons.empty()) {
    name.persons = NumberOf<uint64_t>(persons, text);
    if (name.persons == 0) throw InputError("'" + text + "': nobody to train on; leave '#0' out to take everybody");
  }
  name.split = cut(':');
  name.path = rest;
  if (!(name.share > 0 && std::isfinite(name.share))) throw InputError("'" + text + "': a share must be above 0");
  if (name.path.empty()) throw InputError("'" + text + "': has no path; data are PATH[:SPLIT][#PERSONS][@SHARE]");
  return name;
}

std::vector<ViewDraw> ParseViews(const std::string& text, const std::string& convention) {
  std::vector<ViewDraw> views;
  std::stringstream list(text);
  for (std::string entry; std::getline(list, entry, ',');) {
    ViewDraw draw;
    if (entry.ends_with(".yaml")) {
      std::string like;
      // Twice: fields that the file names count over those of what it is like.
      const auto read = [&] {
        ReadYamlFile(entry, [&](ConfigVisitor& v) {
          v.Field("like", "views to begin with", like);
          draw.Visit(v);
        });
      };
      read();
      try {
        if (!like.empty()) draw = NamedViews(like), read();
        if (draw.highest < draw.lowest || draw.farthest < draw.nearest)
          throw InputError("views need highest >= lowest and farthest >= nearest");
      } catch (const InputError& error) {
        const std::string what = error.what();
        throw InputError(what.starts_with(entry) ? what : entry + ": " + what);
      }
    } else {
      draw = NamedViews(entry);
    }
    if (!convention.empty()) {
      const auto found = std::ranges::find(kKeypointConventionNames, convention);
      if (found == std::end(kKeypointConventionNames))
        throw InputError("--convention: " + UnknownChoiceMessage("convention", convention,
                                                                 std::vector<std::string>(std::begin(kKeypointConventionNames),
                                                                                          std::end(kKeypointConventionNames))));
      draw.convention = static_cast<KeypointConvention>(found - std::begin(kKeypointConventionNames));
    }
    views.push_back(draw);
  }
  return views;
}

std::vector<MpdeSet> ReadTrainingSets(const MpdeDataName& name, std::span<const ViewDraw> views, uint64_t seed) {
  if (IsFile(name.path)) {
    std::vector<MpdeSample> samples =
        SomePersons(ReadMonolocoFile(name.path, name.split.empty() ? "train" : name.split), name.persons, seed);
    if (samples.empty()) throw InputError(name.path + ": its split holds nobody");
    return {{.name = name.path, .samples = std::move(samples), .share = name.share}};
  }
  if (name.persons > 0) throw InputError(name.path + ": '#' is for files in MonoLoco's layout");
  const std::string split = !name.split.empty() ? name.split : fs::exists(fs::path(name.path) / "subsets.json") ? "train" : "";
  const PeopleData data = ReadPeopleFolder(name.path, split, {});
  if (views.empty()) {
    if (data.samples.empty())
      throw InputError(name.path + ": has no pictures of pinhole cameras with people in them; look at them through --views kitti");
    return {{.name = name.path, .samples = data.samples, .share = name.share}};
  }
  if (data.shapes.empty()) throw InputError(name.path + ": holds nobody");
  std::vector<MpdeSet> sets;
  for (const ViewDraw& draw : views) {
    MpdeSet set{.name = name.path, .shapes = data.shapes, .draw = draw, .share = name.share / static_cast<double>(views.size())};
    if (draw.convention == KeypointConvention::kAnnotators) std::ranges::transform(set.shapes, set.shapes.begin(), AsAnnotated);
    sets.push_back(std::move(set));
  }
  return sets;
}

std::vector<MpdeSample> ReadTestSamples(const MpdeDataName& name, std::span<const ViewDraw> views, uint64_t count, uint64_t seed) {
  if (IsFile(name.path)) {
    std::vector<MpdeSample> samples = SomePersons(ReadMonolocoFile(name.path, name.split.empty() ? "val" : name.split), name.persons, seed);
    if (samples.empty()) throw InputError(name.path + ": its split holds nobody");
    return samples;
  }
  MpdeDataName of_test = name;
  if (of_test.split.empty() && fs::exists(fs::path(name.path) / "subsets.json")) of_test.split = "test";
  const std::vector<MpdeSet> sets = ReadTrainingSets(of_test, views, seed);
  if (views.empty()) return sets.front().samples;
  std::vector<MpdeSample> samples;
  for (uint64_t i = 0; i < count; ++i) {
    RngStream random(seed, "mpde test", i);
    const MpdeSet& set = sets[random.Index(static_cast<uint32_t>(sets.size()))];
    samples.push_back(DrawView(set.shapes[random.Index(static_cast<uint32_t>(set.shapes.size()))], set.draw, random));
  }
  return samples;
}

}  // namespace airsim360

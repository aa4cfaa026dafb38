#include "airsim360/mpde/table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "airsim360/base/error.h"
#include "airsim360/mpde/data_name.h"
#include "airsim360/mpde/evaluate.h"

namespace airsim360 {
namespace {

constexpr double kLevel = 5;  // degrees: what counts as pitch 0, or as pitch 20

std::vector<MpdeSample> DrawViews(const std::vector<PersonShape>& shapes, const ViewDraw& draw, uint64_t count, uint64_t seed) {
  std::vector<MpdeSample> samples;
  for (uint64_t i = 0; i < count; ++i) {
    RngStream random(seed, "mpde stand-in", i);
    samples.push_back(DrawView(shapes[random.Index(static_cast<uint32_t>(shapes.size()))], draw, random));
  }
  return samples;
}

// What a row trains on and all rows are tested on.
struct Data {
  MpdeSet base;
  std::array<MpdeSet, 3> ours;  // all, pitch 0, pitch 20
  std::vector<std::vector<MpdeSample>> tests;
};

MpdeSet OurSet(const MpdeTableOptions& options, const char* name, double pitch, double around, const char* views) {
  const PeopleData data = ReadPeopleFolder(options.people, "train", {.pitch_low_deg = pitch - around, .pitch_high_deg = pitch + around});
  if (!data.samples.empty()) return {.name = name, .samples = data.samples, .share = options.our_share};
  // Panoramas have no cameras of their own: virtual ones see the same people.
  const PeopleData everyone = ReadPeopleFolder(options.people, "train", {});
  ViewDraw draw = NamedViews(views);
  if (around > kLevel) draw.pitch_deg = 10, draw.pitch_spread_deg = 8;
  return {.name = name, .shapes = everyone.shapes, .draw = draw, .share = options.our_share};
}

Data Gather(const MpdeTableOptions& options) {
  Data data;
  const PeopleData train = ReadPeopleFolder(options.people, "train", {}), test = ReadPeopleFolder(options.people, "test", {});
  if (train.shapes.empty() || test.shapes.empty())
    throw InputError(options.people + ": splits train and test must both hold people; see docs/guide/mpde.md");
  const auto real = [&](const char* name) { return options.real.contains(name) ? ParseMpdeData(options.real.at(name)) : MpdeDataName(); };
  data.base = real("nuscenes").path.empty()
                  ? MpdeSet{.name = "stand-in of nuscenes", .shapes = train.shapes, .draw = NamedViews("nuscenes")}
                  : MpdeSet{.name = "nuscenes", .samples = ReadMonolocoFile(real("nuscenes").path, "train")};
  data.ours = {OurSet(options, "ours", 0, 90, "drone20"), OurSet(options, "ours, pitch 0", 0, kLevel, "drone0"),
               OurSet(options, "ours, pitch 20", 20, kLevel, "drone20")};
  for (size_t i = 0; i < kMpdeTests.size(); ++i) {
    const MpdeTestSet& set = kMpdeTests[i];
    if (const MpdeDataName file = real(set.name); !file.path.empty()) {
      data.tests.push_back(ReadMonolocoFile(file.path, file.split.empty() ? "val" : file.split));
    } else if (!set.published && !test.samples.empty()) {
      data.tests.push_back(test.samples);
    } else {
      data.tests.push_back(DrawViews(test.shapes, NamedViews(set.views), options.test_samples, i));
    }
    if (data.tests.back().empty()) throw InputError(std::string(set.name) + ": the test holds nobody");
  }
  return data;
}

Spread SpreadOf(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  Spread spread;
  for (const double value : values) spread.mean += value / n;
  for (const double value : values) spread.deviation += (value - spread.mean) * (value - spread.mean);
  spread.deviation = values.size() > 1 ? std::sqrt(spread.deviation / (n - 1)) : 0;
  return spread;
}

MpdeCell CellOf(const std::vector<MpdeErrors>& of_seeds) {
  std::vector<double> distance, angle, unwrapped;
  for (const MpdeErrors& errors : of_seeds) {
    distance.push_back(errors.distance_mae_m);
    angle.push_back(errors.angle_mae_deg);
    unwrapped.push_back(errors.angle_unwrapped_mae_deg);
  }
  return {SpreadOf(distance), SpreadOf(angle), SpreadOf(unwrapped)};
}

// Errors of one network on all tests, then All and Pub.
std::vector<MpdeErrors> TestAll(MpdeModel& model, const Data& data) {
  std::vector<MpdeErrors> errors, all, pub;
  for (size_t i = 0; i < kMpdeTests.size(); ++i) {
    errors.push_back(Judge(Predict(model, data.tests[i]), data.tests[i]).errors);
    all.push_back(errors.back());
    all.back().count = kMpdeTests[i].weight;
    if (kMpdeTests[i].published) pub.push_back(all.back());
  }
  errors.push_back(PoolMpde(all));
  errors.push_back(PoolMpde(pub));
  return errors;
}

}  // namespace

MpdeTable MakeMpdeTable(const MpdeTableOptions& options, const std::function<void(const std::string&)>& progress) {
  if (options.seeds < 1 || options.seeds > 100) throw InputError("seeds: " + std::to_string(options.seeds) + " is not from 1 to 100");
  for (const auto& [name, file] : options.real) {
    std::vector<std::string> names;
    for (const MpdeTestSet& set : kMpdeTests) names.emplace_back(set.name);
    if (std::ranges::count(names, name) == 0) throw InputError("--real: " + UnknownChoiceMessage("test set", name, names));
  }
  const Data data = Gather(options);
  MpdeTable table;
  table.base_is_real = options.real.contains("nuscenes");
  for (size_t i = 0; i < kMpdeTests.size(); ++i) {
    table.test_is_real.push_back(options.real.contains(kMpdeTests[i].name));
    table.test_count.push_back(static_cast<int64_t>(data.tests[i].size()));
    double miss = 0;
    for (const MpdeSample& sample : data.tests[i]) miss += std::abs(ConstantHeightDistance(sample.rays) - sample.truth.distance);
    table.constant_height_m.push_back(miss / static_cast<double>(data.tests[i].size()));
  }
  for (size_t row = 0; row < std::size(kMpdeRows); ++row) {
    std::vector<std::vector<MpdeErrors>> of_sets(kMpdeTests.size() + 2);  // by test, then All and Pub: one entry a seed
    for (uint64_t seed = 0; seed < options.seeds; ++seed) {
      std::vector<MpdeSet> sets = {data.base};
      if (row > 0) sets.push_back(data.ours[row - 1]);
      MpdeTraining training = options.training;
      training.seed = options.training.seed + seed;
      MpdeModel model = TrainMpde(sets, training);
      const std::vector<MpdeErrors> errors = TestAll(model, data);
      for (size_t i = 0; i < errors.size(); ++i) of_sets[i].push_back(errors[i]);
      char line[160];
      std::snprintf(line, sizeof line, "%s, seed %llu: %.3f m, %.1f deg over all", kMpdeRows[row],
                    static_cast<unsigned long long>(training.seed), errors[kMpdeTests.size()].distance_mae_m,
                    errors[kMpdeTests.size()].angle_mae_deg);
      progress(line);
    }
    MpdeTableRow result;
    result.training = kMpdeRows[row];
    for (size_t i = 0; i < kMpdeTests.size(); ++i) result.cells.push_back(CellOf(of_sets[i]));
    result.all = CellOf(of_sets[kMpdeTests.size()]);
    result.pub = CellOf(of_sets[kMpdeTests.size() + 1]);
    table.rows.push_back(std::move(result));
  }
  return table;
}

}  // namespace airsim360

#include "airsim360/dataset/dedupe/dedupe.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/dedupe/alike_search.h"
#include "airsim360/dataset/dedupe/panorama_hash.h"
#include "airsim360/dataset/export/native_dataset.h"
#include "airsim360/dataset/folder.h"

namespace airsim360 {

namespace fs = std::filesystem;

namespace {

constexpr double kHashReach = 4;    // times the parallax: how far apart pictures are compared
constexpr double kSkyRange = 50;    // metres: stands for the median range where a picture is all sky
constexpr double kTurn = 0.02;      // radians: how little pictures that are no panoramas may be turned
constexpr double kRounding = 1e-6;  // of the similarity of a picture with itself

// What of a frame decides.
struct Candidate {
  size_t position = 0;
  int64_t index = 0;
  std::string stem;
  std::string place;  // world: frames of different ones are never twins
  std::string state;  // environment, and time where people move
  Vec3d p;
  Mat3d R;
  double range = 0;
};

Candidate CandidateOf(const NativeDataset& data, size_t position) {
  const NativeFrame frame = data.Frame(position);
  const View& view = data.views().front();
  const RigidTransform X = frame.X_WC(view);
  Candidate c{.position = position, .index = frame.index, .stem = frame.stem, .place = {}, .state = {}, .p = X.p, .R = X.R};
  c.place = frame.world + "#" + (frame.json.contains("world_seed") ? frame.json["world_seed"].dump() : std::string());
  for (const char* key : {"environment", "exposure"}) {
    if (frame.json.contains(key)) c.state += frame.json[key].dump() + ";";
  }
  if (data.HasPeople()) c.state += std::to_string(frame.t_ns);
  c.range = frame.json.value("range_median", 0.0);
  if (!(c.range > 0)) c.range = kSkyRange;
  return c;
}

double Turn(const Mat3d& a, const Mat3d& b) {
  double trace = 0;
  for (int i = 0; i < 3; ++i) trace += Dot(a.column(i), b.column(i));
  return std::acos(std::clamp(0.5 * (trace - 1), -1.0, 1.0));
}

double Parallax(const Candidate& a, const Candidate& b) { return Norm(a.p - b.p) / std::min(a.range, b.range); }

// Kept frames by place: grids whose cells are as wide as the reach of the frames in them, one for each power of two.
class KeptFrames {
 public:
  explicit KeptFrames(double reach) : reach_(reach) {}

  void Add(const Candidate& frame, size_t number) {
    const int level = LevelOf(frame);
    levels_[{frame.place, level}][CellOf(frame.p, level)].push_back(number);
  }
  /// Calls body(number) for all that can be within the reach of both.
  template <class Body>
  void Near(const Candidate& frame, const Body& body) const {
    for (auto at = levels_.lower_bound({frame.place, INT32_MIN}); at != levels_.end() && at->first.first == frame.place; ++at) {
      const auto [x, y, z] = CellOf(frame.p, at->first.second);
      for (int i = 0; i < 27; ++i) {
        const auto found = at->second.find({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1});
        if (found == at->second.end()) continue;
        for (const size_t number : found->second) body(number);
      }
    }
  }

 private:
  using Cell = std::tuple<int64_t, int64_t, int64_t>;
  struct CellHash {
    size_t operator()(const Cell& c) const {
      const auto& [x, y, z] = c;
      return static_cast<size_t>(x * 73856093) ^ static_cast<size_t>(y * 19349663) ^ static_cast<size_t>(z * 83492791);
    }
  };
  int LevelOf(const Candidate& frame) const { return static_cast<int>(std::ceil(std::log2(reach_ * frame.range))); }
  static Cell CellOf(Vec3d p, int level) {
    const double size = std::ldexp(1.0, level);
    const auto cell = [&](double v) { return static_cast<int64_t>(std::floor(v / size)); };
    return {cell(p.x), cell(p.y), cell(p.z)};
  }

  double reach_;
  std::map<std::pair<std::string, int>, std::unordered_map<Cell, std::vector<size_t>, CellHash>> levels_;
};

// Hashes of pictures, made when they are first wanted.
class Hashes {
 public:
  explicit Hashes(const NativeDataset& data) : data_(data) {}
  const internal::PanoramaHash& Of(const Candidate& frame) {
    const auto found = hashes_.find(frame.position);
    if (found != hashes_.end()) return found->second;
    return hashes_.emplace(frame.position, Make(frame)).first->second;
  }
  /// Makes those of `frames` on all threads.
  void Prepare(const std::vector<const Candidate*>& frames) {
    ProgressBar progress("dedupe: pictures", static_cast<int64_t>(frames.size()));
    constexpr size_t kBatch = 64;
    for (size_t begin = 0; begin < frames.size(); begin += kBatch) {
      const size_t n = std::min(kBatch, frames.size() - begin);
      std::vector<internal::PanoramaHash> made(n);
      ParallelFor(static_cast<int64_t>(n),
                  [&](int64_t i) { made[static_cast<size_t>(i)] = Make(*frames[begin + static_cast<size_t>(i)]); });
      for (size_t i = 0; i < n; ++i) hashes_.emplace(frames[begin + i]->position, made[i]);
      progress.Update(static_cast<int64_t>(begin + n));
    }
  }
  size_t size() const { return hashes_.size(); }

 private:
  internal::PanoramaHash Make(const Candidate& frame) const {
    return internal::HashPanorama(data_.Rgb(data_.Frame(frame.position), data_.views().front()), frame.R);
  }
  const NativeDataset& data_;
  std::unordered_map<size_t, internal::PanoramaHash> hashes_;
};

struct Methods {
  bool parallax = false, hash = false, sscd = false;
};

Methods MethodsOf(const NativeDataset& data, const DedupeOptions& options) {
  Methods methods;
  for (const std::string& name : options.methods) {
    bool* const chosen[] = {&methods.parallax, &methods.hash, &methods.sscd};
    *chosen[ParseChoice<size_t>("method", name, kDedupeMethods, "--method")] = true;
  }
  if (!methods.parallax && !methods.hash && !methods.sscd) throw InputError("--method: name parallax, hash or sscd");
  if (methods.sscd && options.model.empty())
    throw InputError("--method sscd: name an ONNX file of the network with --model; there is none in the program");
  if (data.views().size() != 1)
    throw InputError("dedupe: '" + data.folder().string() + "' has several pictures a frame; datasets of one camera are filtered");
  const bool hashable = data.Has("rgb") && data.views().front().projection == Projection::kErp;
  if (methods.hash && !hashable && !methods.parallax)
    throw InputError("--method hash: needs colour panoramas, which '" + data.folder().string() + "' lacks; use parallax");
  methods.hash = methods.hash && hashable;
  if (methods.sscd && !hashable)
    throw InputError("--method sscd: needs colour panoramas, which '" + data.folder().string() + "' lacks; use parallax");
  return methods;
}

std::vector<Candidate> ReadCandidates(const NativeDataset& data) {
  std::vector<Candidate> frames(data.size());
  ParallelFor(static_cast<int64_t>((frames.size() + 255) / 256), [&](int64_t block) {
    const size_t begin = static_cast<size_t>(block) * 256, end = std::min(begin + 256, frames.size());
    for (size_t i = begin; i < end; ++i) frames[i] = CandidateOf(data, i);
  });
  std::ranges::stable_sort(frames, {}, &Candidate::index);
  return frames;
}

// Everything one pass over the frames needs.
struct Filter {
  const NativeDataset& data;
  const DedupeOptions& options;
  Methods methods;
  std::vector<Candidate> frames;
  Hashes hashes{data};
  std::optional<internal::AlikeSearch> alike = {};

  bool IsParallaxTwin(const Candidate& a, const Candidate& b) const {
    if (a.state != b.state || Parallax(a, b) >= options.parallax) return false;
    return data.views().front().projection == Projection::kErp || Turn(a.R, b.R) < kTurn;
  }
  // All pictures that can be wanted: those with any earlier one near that is no twin by parallax.
  void PrepareHashes();
  void OpenModel();
  DedupeResult Run();
};

void Filter::OpenModel() {
  std::vector<internal::AlikeFrame> list;
  for (const Candidate& frame : frames) list.push_back({frame.position, frame.R, frame.place});
  alike.emplace(data, std::move(list), options.model);
}

void Filter::PrepareHashes() {
  const double reach = kHashReach * options.parallax;
  KeptFrames seen(reach);
  std::vector<bool> wanted(frames.size());
  for (size_t i = 0; i < frames.size(); ++i) {
    bool twin = false;
    std::vector<size_t> near;
    seen.Near(frames[i], [&](size_t k) {
      if (Parallax(frames[i], frames[k]) >= reach) return;
      twin |= methods.parallax && IsParallaxTwin(frames[i], frames[k]);
      near.push_back(k);
    });
    if (twin) continue;
    for (const size_t k : near) wanted[i] = wanted[k] = true;
    seen.Add(frames[i], i);
  }
  std::vector<const Candidate*> list;
  for (size_t i = 0; i < frames.size(); ++i) {
    if (wanted[i]) list.push_back(&frames[i]);
  }
  hashes.Prepare(list);
}

DedupeResult Filter::Run() {
  DedupeResult result;
  result.histogram.assign(std::size(kParallaxBins) + 1, 0);
  if (methods.sscd) OpenModel();
  if (methods.hash) PrepareHashes();
  ProgressBar progress("dedupe: frames", static_cast<int64_t>(frames.size()));
  const double reach = std::max(kHashReach * options.parallax, kParallaxBins[std::size(kParallaxBins) - 1]);
  KeptFrames kept(reach);
  for (size_t i = 0; i < frames.size(); ++i) {
    const Candidate& frame = frames[i];
    // The nearest twin by parallax, else the most alike by hash, else by the network; of equal ones the earliest.
    std::optional<DroppedFrame> by_parallax, by_hash, by_network;
    double nearest = reach;
    kept.Near(frame, [&](size_t k) {
      const double parallax = Parallax(frame, frames[k]);
      if (parallax >= reach) return;
      nearest = std::min(nearest, parallax);
      const auto note = [&](std::optional<DroppedFrame>& best, const char* reason, double value) {
        const bool better = !best || value < best->value || (value == best->value && frames[k].stem < best->twin);
        if (better) best = DroppedFrame{frame.stem, frames[k].stem, reason, value};
      };
      if (methods.parallax && IsParallaxTwin(frame, frames[k])) note(by_parallax, "parallax", parallax);
      if (methods.hash && parallax < kHashReach * options.parallax && !by_parallax) {
        const int bits = internal::Distance(hashes.Of(frame), hashes.Of(frames[k]));
        if (bits <= options.bits) note(by_hash, "hash", bits);
      }
    });
    const auto bin = static_cast<size_t>(std::ranges::upper_bound(kParallaxBins, nearest) - std::begin(kParallaxBins));
    if (i > 0) ++result.histogram[std::min(bin, std::size(kParallaxBins))];
    if (alike && !by_parallax && !by_hash) {
      const auto twin = alike->MostAlike(i);
      if (twin && twin->similarity >= options.similarity - kRounding)
        by_network = DroppedFrame{frame.stem, frames[twin->number].stem, "sscd", twin->similarity};
    }
    if (by_parallax || by_hash || by_network) {
      result.dropped.push_back(by_parallax ? *by_parallax : by_hash ? *by_hash : *by_network);
    } else {
      result.kept.push_back(frame.stem);
      kept.Add(frame, i);
      if (alike) alike->Keep();
    }
    progress.Update(static_cast<int64_t>(i + 1));
  }
  result.hashed = static_cast<int64_t>(hashes.size()) + (alike ? alike->described() : 0);
  return result;
}

std::string DroppedCsv(const DedupeResult& result) {
  std::string text = "frame,twin,reason,value\n";
  for (const DroppedFrame& frame : result.dropped) {
    char value[32];
    std::snprintf(value, sizeof value, "%.6g", frame.value);
    text += frame.stem + "," + frame.twin + "," + frame.reason + "," + value + "\n";
  }
  return text;
}

}  // namespace

DedupeResult DedupeDataset(const fs::path& folder, const DedupeOptions& options) {
  if (!(options.parallax > 0 && options.parallax < 1))
    throw InputError("--parallax: " + std::to_string(options.parallax) + " is not in 0 … 1 rad");
  if (options.bits < 0 || options.bits > 256) throw InputError("--bits: " + std::to_string(options.bits) + " is not in 0 … 256");
  if (!(options.similarity > 0 && options.similarity <= 1))
    throw InputError("--similarity: " + std::to_string(options.similarity) + " is not above 0 and at most 1");
  DedupeResult result;
  {
    const NativeDataset data(folder);
    Filter filter{data, options, MethodsOf(data, options), ReadCandidates(data)};
    result = filter.Run();
  }
  CreateWritableFolder(folder);
  const FolderLock lock(folder);
  std::string kept;
  for (const std::string& stem : result.kept) kept += stem + "\n";
  WriteFileAtomically(folder / "kept.txt", kept);
  WriteFileAtomically(folder / "dropped.csv", DroppedCsv(result));
  if (options.apply) internal::RemoveFrames(folder, result);
  return result;
}

}  // namespace airsim360

// Frames of a dataset that show what another one shows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace airsim360 {

struct DedupeOptions {
  std::vector<std::string> methods = {"parallax", "hash"};  ///< of kDedupeMethods
  double parallax = 0.02;            ///< radians: baseline / median range below which two frames of one state are twins
  int bits = 31;                     ///< of 256: hashes of twins differ in no more
  double similarity = 0.75;          ///< cosine of the descriptors of twins by the network: at least; (0, 1]
  std::filesystem::path model = {};  ///< of sscd: ONNX file of the network
  bool apply = false;                ///< take the dropped frames out of the dataset
};
inline constexpr const char* kDedupeMethods[] = {"parallax", "hash", "sscd"};

struct DroppedFrame {
  std::string stem, twin;  ///< twin: the earlier frame that stays
  std::string reason;      ///< the method
  double value = 0;        ///< radians of parallax, bits of the hash, cosine of the descriptors
};

struct DedupeResult {
  std::vector<std::string> kept;  ///< stems, by index of the frames
  std::vector<DroppedFrame> dropped;
  int64_t hashed = 0;              ///< pictures that were looked at, by hash or network
  std::vector<int64_t> histogram;  ///< of the parallax to the nearest kept frame, kParallaxBins
};
/// Upper ends of the bins of the histogram, radians; a last bin holds the rest.
inline constexpr double kParallaxBins[] = {0.005, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32};

/// Goes through the frames by their index and drops each that has a twin among those kept so far; the order of lines in
/// frames.jsonl does not matter.
/// `parallax`: the baseline over the smaller of the two median ranges is below options.parallax, in one world, environment
/// and (with people) at one time. `hash`: the pictures of two frames closer than four times that, whatever environment and
/// time, differ in at most options.bits: poses are exact, so frames farther apart are no twins and are not looked at.
/// `sscd`: descriptors by the network options.model (dedupe/copy_detector.h) of two upright panoramas of one world, wherever
/// they are, whatever environment and time, are alike by options.similarity.
/// Writes kept.txt and dropped.csv into the folder; with `apply` then removes the dropped frames and their files and makes
/// frames.jsonl, panoptic.json, people.jsonl, index.sqlite, README.md and SHA256SUMS anew.
/// InputError for unknown names, `sscd` without a model that works, frames without one picture each, a folder that is no
/// finished dataset: then nothing is written. RuntimeError if writing fails.
DedupeResult DedupeDataset(const std::filesystem::path& folder, const DedupeOptions& options);

namespace internal {
/// The part behind `apply`; the folder is locked. An interruption leaves an unfinished dataset, which the command that made
/// it completes again.
void RemoveFrames(const std::filesystem::path& folder, const DedupeResult& result);
}  // namespace internal

}  // namespace airsim360

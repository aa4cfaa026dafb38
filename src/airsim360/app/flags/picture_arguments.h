// Flags that say how pictures are made and which: those of `render`, `collect` and `fly`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "airsim360/dataset/record/spec.h"

namespace airsim360 {

struct PictureArguments {
  /// Adds the flags; this object must outlive the parsing.
  void AddTo(CLI::App& command);
  /// A dataset whose pictures are made so; the rest is the caller's. InputError naming the flag and the value.
  DatasetSpec Spec() const;
  /// What does not fit the cameras of `spec`: InputError naming the flag.
  static void Check(const DatasetSpec& spec);

 private:
  DatasetSpec picture_;  // what DatasetSpec::Visit names
  const CLI::App* command_ = nullptr;
  std::vector<std::string> products_;
  bool normal_ = false, radiance_ = false;
};

/// The flags that all pictures have, for completion and the groups of --help.
const std::vector<std::string>& PictureFlagNames();

}  // namespace airsim360

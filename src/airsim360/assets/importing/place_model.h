// Applies a placement to what a reader made of a file, and tells likely units.
#pragma once

#include <string>
#include <vector>

#include "airsim360/assets/imported.h"
#include "airsim360/assets/importing/placement.h"

namespace airsim360::internal {

/// Turns the axis `up` of the file to +Z and scales; `as_read` is the axis that the reader has turned there.
void TurnUp(const std::string& up, const std::string& as_read, double scale, ImportedFile& file);

/// The whole of a placement.
void PlaceModel(const ModelPlacement& placement, const std::string& as_read, ImportedFile& file);

/// A plain of 8 x 8 km on z = 0.
void AddPlain(ImportedFile& file);

/// A thing of a kind whose size is about known.
struct KnownSize {
  std::string name, category;
  double extent = 0;  ///< its longest side as imported, metres
  double usual = 0;   ///< of its kind
};

/// "…: looks like centimetres: use scale: 0.01", from things of known size, else from the longest side of all;
/// "" where nothing speaks against metres.
std::string GuessUnits(const std::vector<KnownSize>& sizes, double extent);

}  // namespace airsim360::internal

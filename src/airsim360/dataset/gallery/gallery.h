// The card of a dataset, and a page that shows all of its pictures.
#pragma once

#include <filesystem>
#include <string>

namespace airsim360 {

struct DatasetCard {
  std::string markdown;  ///< counts by scene, environment, height, range, category; people; licences
  std::string json;      ///< the same figures
};

/// Counts a finished dataset. InputError if it is none.
DatasetCard CardOfDataset(const std::filesystem::path& folder);

/// Writes index.html and its pictures (`gallery/`) into the folder: a page without scripts from elsewhere, which a browser
/// opens from the disk, with every product of every frame and the card. Range, entities, flow and others that browsers
/// cannot show are drawn in colours. Nothing of the dataset is changed. Returns the page. InputError for damaged pictures.
std::filesystem::path WriteGallery(const std::filesystem::path& folder);

}  // namespace airsim360

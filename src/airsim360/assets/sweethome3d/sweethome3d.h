// The catalogue of a Sweet Home 3D furniture library (.sh3f).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "airsim360/math/transform.h"

namespace airsim360::internal {

/// One piece of the catalogue.
struct CatalogueModel {
  std::string stem;  ///< "poplar"
  std::string path;  ///< of the OBJ inside the zip, without a leading '/'
  std::string title, creator, licence, category, tags;
  Vec3f size;        ///< width (x), depth (y), height (z) in metres, frame W
  Mat3d rotation_G;  ///< modelRotation: applied to the vertices first, frame G
};

/// The models of PluginFurnitureCatalog.properties, by number. Pieces without model or with a size that is
/// not positive are left out. InputError naming the file for a damaged number.
std::vector<CatalogueModel> ParseCatalogue(const std::string& file, std::string_view text);

}  // namespace airsim360::internal

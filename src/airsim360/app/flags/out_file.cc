#include "airsim360/app/flags/out_file.h"

#include <filesystem>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360 {

void CheckOutFile(const std::string& file) {
  if (file.empty()) return;
  const std::filesystem::path path(file);
  if (std::filesystem::is_directory(path)) throw InputError("--out: '" + file + "' is a folder; give a file");
  if (path.has_parent_path()) CreateWritableFolder(path.parent_path());
}

}  // namespace airsim360

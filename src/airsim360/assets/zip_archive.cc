#include "airsim360/assets/zip_archive.h"

#include <zip.h>

#include "airsim360/base/error.h"

namespace airsim360::internal {

ZipArchive::ZipArchive(const std::filesystem::path& path) : name_(path.string()) {
  int error = 0;
  zip_t* const zip = zip_open(path.c_str(), ZIP_RDONLY, &error);
  if (!zip) {
    zip_error_t reason;
    zip_error_init_with_code(&reason, error);
    const std::string text = zip_error_strerror(&reason);
    zip_error_fini(&reason);
    throw InputError(name_ + ": not a readable zip file: " + text);
  }
  zip_ = std::shared_ptr<void>(zip, [](void* z) { zip_discard(static_cast<zip_t*>(z)); });
}

std::optional<Bytes> ZipArchive::Read(const std::string& entry) const {
  constexpr uint64_t kMaxSize = uint64_t{1} << 30;
  auto* const zip = static_cast<zip_t*>(zip_.get());
  const zip_int64_t index = zip_name_locate(zip, entry.c_str(), ZIP_FL_NOCASE);
  if (index < 0) return std::nullopt;

  // The size is claimed by the file: bounded first, then held against what really comes.
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_stat_index(zip, static_cast<zip_uint64_t>(index), 0, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE) || stat.size > kMaxSize) {
    throw InputError(name_ + ": entry '" + entry + "' has no sensible size");
  }
  Bytes bytes(stat.size);
  zip_file_t* const file = zip_fopen_index(zip, static_cast<zip_uint64_t>(index), 0);
  const zip_int64_t got = file ? zip_fread(file, bytes.data(), bytes.size()) : -1;
  if (file) zip_fclose(file);
  if (got != static_cast<zip_int64_t>(bytes.size())) throw InputError(name_ + ": entry '" + entry + "' is damaged");
  return bytes;
}

}  // namespace airsim360::internal

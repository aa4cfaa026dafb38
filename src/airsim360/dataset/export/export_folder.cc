#include "airsim360/dataset/export/export_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "airsim360/base/error.h"
#include "airsim360/base/write_all.h"

namespace airsim360 {

namespace fs = std::filesystem;

namespace {

using internal::ThrowWriteError;

fs::path WithoutSlash(fs::path path) { return path.has_filename() ? path : path.parent_path(); }

}  // namespace

ExportFolder::ExportFolder(fs::path target) : target_(WithoutSlash(std::move(target))) {
  if (fs::exists(target_) && !fs::is_directory(target_)) throw InputError("--out: '" + target_.string() + "' is not a folder");
  if (fs::exists(target_) && !fs::is_empty(target_))
    throw InputError("--out: '" + target_.string() + "' holds something else (such as '" +
                     fs::directory_iterator(target_)->path().filename().string() + "'); choose a new folder or remove it");
  if (target_.has_parent_path()) CreateWritableFolder(target_.parent_path());
  temporary_ = target_.string() + ".tmp";
  CreateWritableFolder(temporary_);
  lock_ = std::make_unique<FolderLock>(temporary_);
  // What a killed export left.
  for (const auto& entry : fs::directory_iterator(temporary_)) fs::remove_all(entry.path());
}

ExportFolder::~ExportFolder() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

fs::path ExportFolder::Place(const std::string& path) {
  const fs::path place = temporary_ / path;
  std::error_code error;
  fs::create_directories(place.parent_path(), error);
  if (error) throw RuntimeError(place.parent_path().string() + ": cannot create folder: " + error.message());
  return place;
}

void ExportFolder::Write(const std::string& path, std::span<const std::byte> bytes) {
  const fs::path place = Place(path);
  const int fd = ::open(place.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (fd < 0) ThrowWriteError(target_ / path, errno);
  int error = internal::WriteAll(fd, bytes);
  if (::close(fd) != 0 && error == 0) error = errno;
  if (error != 0) ThrowWriteError(target_ / path, error);
}

void ExportFolder::Commit() {
  const int fd = ::open(temporary_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  int error = fd < 0 || ::syncfs(fd) != 0 ? errno : 0;
  if (fd >= 0) ::close(fd);
  // An empty target goes: a folder takes the place of an empty one only.
  if (error == 0 && ::rename(temporary_.c_str(), target_.c_str()) != 0) error = errno;
  if (error != 0) ThrowWriteError(target_, error);
  committed_ = true;
}

GrowingFile::GrowingFile(ExportFolder& folder, const std::string& path)
    : path_(folder.Place(path)), file_(path_, std::ios::binary | std::ios::trunc) {
  if (!file_) ThrowWriteError(path_, errno);
}

void GrowingFile::Append(std::span<const std::byte> bytes) {
  if (!file_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) ThrowWriteError(path_, errno);
  size_ += bytes.size();
}

void GrowingFile::Close() {
  file_.close();
  if (!file_) ThrowWriteError(path_, errno);
}

JsonLists::JsonLists(ExportFolder& folder, std::string path, std::vector<std::string> lists) : folder_(folder), path_(std::move(path)) {
  for (std::string& name : lists) {
    const std::string scratch = path_ + "." + name + ".part";
    lists_.push_back({name, std::make_unique<GrowingFile>(folder, scratch), folder.Place(scratch)});
  }
}

void JsonLists::Add(const std::string& list, std::string_view element) {
  for (List& candidate : lists_) {
    if (candidate.name != list) continue;
    candidate.file->Append(candidate.file->size() > 0 ? ",\n" : "\n");
    candidate.file->Append(element);
    return;
  }
  throw RuntimeError("no list '" + list + "' in " + path_);
}

void JsonLists::Finish(const std::vector<std::pair<std::string, std::string>>& last) {
  GrowingFile file(folder_, path_);
  std::string comma = "{";
  std::vector<char> buffer(1 << 20);
  for (List& list : lists_) {
    list.file->Close();
    file.Append(comma + "\"" + list.name + "\":[");
    std::ifstream scratch(list.scratch, std::ios::binary);
    while (scratch.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || scratch.gcount() > 0)
      file.Append(std::string_view(buffer.data(), static_cast<size_t>(scratch.gcount())));
    file.Append("]");
    comma = ",\n";
    fs::remove(list.scratch);
  }
  for (const auto& [key, text] : last) {
    file.Append(comma + "\"" + key + "\":" + text);
    comma = ",\n";
  }
  file.Append("}\n");
  file.Close();
}

}  // namespace airsim360

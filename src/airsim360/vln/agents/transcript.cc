#include <fstream>
#include <sstream>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/vln/agents/told_agents.h"
#include "airsim360/vln/predicates/query_json.h"

namespace airsim360 {

Transcript::Transcript(std::filesystem::path file) : file_(std::move(file)) {
  if (file_.empty() || !std::filesystem::exists(file_)) return;
  const std::string text = ReadTextFile(file_, uint64_t{8} << 30);
  size_t whole = 0;
  for (size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string line = text.substr(begin, end - begin);
    const internal::VlnJson json = internal::ParseVlnJson(line, file_.string());
    if (!json.is_object() || !json.contains("key") || !json["key"].is_string()) throw InputError(file_.string() + ": is no transcript");
    lines_[json["key"].get<std::string>()] = line;
    whole = end + 1;
  }
  if (whole != text.size()) std::filesystem::resize_file(file_, whole);
}

std::string Transcript::Find(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  const auto found = lines_.find(key);
  return found == lines_.end() ? "" : found->second;
}

void Transcript::Add(const std::string& key, const std::string& line) {
  const std::lock_guard lock(mutex_);
  lines_[key] = line;
  if (file_.empty()) return;
  std::ofstream out(file_, std::ios::app | std::ios::binary);
  out << line << '\n' << std::flush;
  if (!out) throw RuntimeError("cannot write " + file_.string());
}

}  // namespace airsim360

#include "airsim360/view/page_files.h"

#include <algorithm>
#include <array>
#include <utility>

namespace airsim360 {

const PageFile* FindPageFile(std::string_view name) {
  const auto files = PageFiles();
  const auto found = std::ranges::find(files, name, &PageFile::name);
  return found == files.end() ? nullptr : &*found;
}

std::string_view ContentType(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kTypes{{{".html", "text/html; charset=utf-8"},
                                                                                        {".css", "text/css; charset=utf-8"},
                                                                                        {".js", "text/javascript; charset=utf-8"},
                                                                                        {".json", "application/json"},
                                                                                        {".png", "image/png"},
                                                                                        {".jpg", "image/jpeg"},
                                                                                        {".exr", "image/x-exr"},
                                                                                        {".csv", "text/csv; charset=utf-8"},
                                                                                        {".md", "text/plain; charset=utf-8"}}};
  const auto found = std::ranges::find_if(kTypes, [&](const auto& type) { return name.ends_with(type.first); });
  return found == kTypes.end() ? "application/octet-stream" : found->second;
}

}  // namespace airsim360

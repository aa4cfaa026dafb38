// The page of `airsim360 view`: the files of the folder page/, which are part of the program.
#pragma once

#include <span>
#include <string_view>

namespace airsim360 {

struct PageFile {
  std::string_view name, text;
};

/// By name. Made of page/ at build time (module.cmake).
std::span<const PageFile> PageFiles();

/// null: there is none.
const PageFile* FindPageFile(std::string_view name);

/// Content type by the end of a file's name.
std::string_view ContentType(std::string_view name);

}  // namespace airsim360

// Which ids of label pictures are which classes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360 {

struct LabelClass {
  uint32_t id = 0;
  std::string name;
};

/// A .json with a list of {id, name} (or an object whose `categories` is one, as in meta.json and COCO's files; or an object name -> id), or a text with one
/// class a line: "id name", "name id", or names alone, numbered from 0. In the order of the file. InputError naming file and line for anything else, no
/// class, ids above 65534 and ids or names that occur twice.
std::vector<LabelClass> ReadClassFile(const std::filesystem::path& path);
std::vector<LabelClass> ParseClassFile(std::string_view text, const std::string& name, bool json);

}  // namespace airsim360

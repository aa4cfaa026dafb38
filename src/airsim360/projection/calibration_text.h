// The text of a file from a stranger as a YAML document: what is none is said in plain words. Not for other modules.
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace airsim360::internal {

/// Whether the text is XML.
bool IsXml(std::string_view text);

/// InputError for what is no text: pictures, databases, COLMAP's cameras.bin.
void CheckIsText(std::string_view text, const std::filesystem::path& file);

/// A YAML or JSON document, OpenCV's "%YAML:1.0" or OpenCV's XML (<opencv_storage>), its nodes on the lines of the file. InputError
/// "file:line: …" for errors of syntax, more than 32 levels, and a key that a mapping has twice.
YAML::Node LoadDocument(std::string_view text, const std::filesystem::path& file);

/// ":LINE: …" about a file of another program that is recognised but not read, and what to write instead; nullopt for all others.
std::optional<std::string> ForeignFormat(const YAML::Node& root);
std::optional<std::string> ForeignText(std::string_view text);

}  // namespace airsim360::internal

// XML as a tree of elements, from untrusted files.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace airsim360::internal {

struct XmlElement {
  std::string tag;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< in the order of the file
  std::vector<XmlElement> children;
  int line = 0;

  const std::string* Find(std::string_view attribute) const;
};

/// The root element. Text between elements is left out. InputError "name:line:column: …" for what is no XML, a
/// DOCTYPE, more than 1 MiB, 64 levels or 20000 elements and attributes.
XmlElement ReadXml(std::string_view text, std::string_view name);

}  // namespace airsim360::internal

// XML as a tree of elements, from untrusted files.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace airsim360::behaviour {

struct XmlElement {
  std::string tag;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< in the order of the file
  std::vector<XmlElement> children;
  int line = 0;
  int order = 0;  ///< among all elements of the file, from 0: as their begins follow one another

  const std::string* Find(std::string_view attribute) const;
};

/// The root element. Text between elements is left out. InputError "name:line:column: …" for what is no XML, a
/// DOCTYPE, more than 1 MiB, 64 levels or 20000 elements and attributes.
XmlElement ReadXml(std::string_view text, std::string_view name);

/// The elements as a file: two spaces a level, attributes in their order, a line each element. Equal elements give equal
/// bytes, whoever made them; reading them back gives the same elements (but for lines).
std::string WriteXml(const XmlElement& root);
/// A text as it stands between quotes.
std::string EscapeXml(std::string_view text);

}  // namespace airsim360::behaviour

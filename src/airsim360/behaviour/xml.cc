#include "airsim360/behaviour/xml.h"

#include <expat.h>

#include <memory>

#include "airsim360/base/error.h"

namespace airsim360::behaviour {
namespace {

constexpr size_t kMaxSize = size_t{1} << 20, kMaxItems = 20000, kMaxDepth = 64;

struct Reader {
  XML_Parser parser;
  XmlElement root;
  std::vector<XmlElement> open;
  size_t items = 0;
  int elements = 0;
  std::string error;

  void Stop(std::string why) {
    if (error.empty()) error = std::move(why);
    XML_StopParser(parser, XML_FALSE);
  }
};

void OnStart(void* user, const XML_Char* tag, const XML_Char** attributes) {
  auto& reader = *static_cast<Reader*>(user);
  XmlElement element;
  element.tag = tag;
  element.line = static_cast<int>(XML_GetCurrentLineNumber(reader.parser));
  element.order = reader.elements++;
  for (int i = 0; attributes[i]; i += 2) element.attributes.emplace_back(attributes[i], attributes[i + 1]);
  reader.items += 1 + element.attributes.size();
  if (reader.items > kMaxItems) return reader.Stop("more than 20000 elements and attributes");
  if (reader.open.size() >= kMaxDepth) return reader.Stop("elements are nested more than 64 deep");
  reader.open.push_back(std::move(element));
}

void OnEnd(void* user, const XML_Char*) {
  auto& reader = *static_cast<Reader*>(user);
  if (reader.open.empty()) return;
  XmlElement done = std::move(reader.open.back());
  reader.open.pop_back();
  (reader.open.empty() ? reader.root : reader.open.back().children.emplace_back()) = std::move(done);
}

void OnDoctype(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int) {
  static_cast<Reader*>(user)->Stop("a DOCTYPE is not allowed");
}

void Append(const XmlElement& element, int depth, std::string& out) {
  const std::string indent(static_cast<size_t>(2 * depth), ' ');
  out += indent + "<" + element.tag;
  for (const auto& [name, value] : element.attributes) out += " " + name + "=\"" + EscapeXml(value) + "\"";
  if (element.children.empty()) {
    out += "/>\n";
    return;
  }
  out += ">\n";
  for (const XmlElement& child : element.children) Append(child, depth + 1, out);
  out += indent + "</" + element.tag + ">\n";
}

}  // namespace

std::string EscapeXml(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\n':
        out += "&#10;";
        break;
      case '\t':
        out += "&#9;";
        break;
      case '\r':
        out += "&#13;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string WriteXml(const XmlElement& root) {
  std::string out;
  Append(root, 0, out);
  return out;
}

const std::string* XmlElement::Find(std::string_view attribute) const {
  for (const auto& [name, value] : attributes)
    if (name == attribute) return &value;
  return nullptr;
}

XmlElement ReadXml(std::string_view text, std::string_view name) {
  if (text.size() > kMaxSize) throw InputError(std::string(name) + ": larger than 1 MiB");
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, void (*)(XML_Parser)> parser(XML_ParserCreate("UTF-8"), XML_ParserFree);
  if (!parser) throw std::bad_alloc();
  Reader reader{.parser = parser.get(), .root = {}, .open = {}, .error = {}};
  XML_SetUserData(parser.get(), &reader);
  XML_SetElementHandler(parser.get(), OnStart, OnEnd);
  XML_SetStartDoctypeDeclHandler(parser.get(), OnDoctype);
  if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), XML_TRUE) != XML_STATUS_OK) {
    const std::string why = reader.error.empty() ? XML_ErrorString(XML_GetErrorCode(parser.get())) : reader.error;
    throw InputError(std::string(name) + ":" + std::to_string(XML_GetCurrentLineNumber(parser.get())) + ":" +
                     std::to_string(XML_GetCurrentColumnNumber(parser.get()) + 1) + ": malformed XML: " + why);
  }
  return std::move(reader.root);
}

}  // namespace airsim360::behaviour

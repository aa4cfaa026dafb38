#include "airsim360/rpc/wire/json_text.h"

#include <charconv>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr int kMaxDepth = 64;

class Parser {
 public:
  Parser(std::string_view text, std::string_view name) : text_(text), name_(name) {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
  }

  JsonNode Document() {
    JsonNode node = Value(0);
    SkipSpace();
    if (at_ < text_.size()) Fail("something follows the end");
    return node;
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(std::string(name_) + ":" + std::to_string(line_) + ": " + what);
  }

  void SkipSpace() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\n') ++line_;
      if (c != ' ' && c != '\t' && c != '\r' && c != '\n') return;
    }
  }
  char Peek() {
    SkipSpace();
    if (at_ >= text_.size()) Fail("the text ends too early");
    return text_[at_];
  }
  bool Take(char c) {
    if (Peek() != c) return false;
    ++at_;
    return true;
  }
  void Expect(char c) {
    if (!Take(c)) Fail(std::string("expected '") + c + "' instead of '" + text_[at_] + "'");
  }

  JsonNode Value(int depth) {
    if (depth > kMaxDepth) Fail("nested too deeply");
    const char c = Peek();
    JsonNode node;
    node.line = line_;
    if (c == '{') {
      Object(node, depth);
    } else if (c == '[') {
      Array(node, depth);
    } else if (c == '"') {
      node.kind = JsonNode::Kind::kString;
      node.text = String();
    } else if (!Word(node)) {
      Number(node);
    }
    return node;
  }

  void Object(JsonNode& node, int depth) {
    node.kind = JsonNode::Kind::kObject;
    Expect('{');
    if (Take('}')) return;
    do {
      if (Peek() != '"') Fail("expected a key in quotation marks");
      node.keys.push_back(String());
      Expect(':');
      node.items.push_back(Value(depth + 1));
    } while (Take(','));
    Expect('}');
  }

  void Array(JsonNode& node, int depth) {
    node.kind = JsonNode::Kind::kArray;
    Expect('[');
    if (Take(']')) return;
    do {
      node.items.push_back(Value(depth + 1));
    } while (Take(','));
    Expect(']');
  }

  // true, false, null.
  bool Word(JsonNode& node) {
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("null")) {
      at_ += 4;
      return true;
    }
    if (!rest.starts_with("true") && !rest.starts_with("false")) return false;
    node.kind = JsonNode::Kind::kBool;
    node.flag = rest[0] == 't';
    at_ += node.flag ? 4 : 5;
    return true;
  }

  void Number(JsonNode& node) {
    node.kind = JsonNode::Kind::kNumber;
    const char* first = text_.data() + at_;
    const auto [end, error] = std::from_chars(first, text_.data() + text_.size(), node.number);
    const bool starts_well = *first == '-' || (*first >= '0' && *first <= '9');
    if (error != std::errc() || !starts_well) Fail("expected a value");
    at_ += static_cast<size_t>(end - first);
  }

  std::string String() {
    std::string out;
    for (++at_; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '"') {
        ++at_;
        return out;
      }
      if (c == '\n') Fail("a text ends at its line");
      if (c != '\\') {
        out += c;
        continue;
      }
      if (++at_ < text_.size()) Escape(out);
    }
    Fail("a text has no end");
  }

  void Escape(std::string& out) {
    static constexpr std::string_view kLetters = "\"\\/bfnrt", kMeanings = "\"\\/\b\f\n\r\t";
    const char c = text_[at_];
    if (const size_t i = kLetters.find(c); i != std::string_view::npos) {
      out += kMeanings[i];
      return;
    }
    unsigned code = 0;
    const std::string_view digits = c == 'u' ? text_.substr(at_ + 1, 4) : std::string_view();
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
    if (digits.size() != 4 || error != std::errc() || end != digits.data() + 4) Fail("unknown escape in a text");
    at_ += 4;
    AppendUtf8(code, out);
  }

  // Halves of surrogate pairs are kept as they are: names of things do not hold them.
  static void AppendUtf8(unsigned code, std::string& out) {
    if (code < 0x80) {
      out += static_cast<char>(code);
    } else if (code < 0x800) {
      out += static_cast<char>(0xc0 | code >> 6);
      out += static_cast<char>(0x80 | (code & 0x3f));
    } else {
      out += static_cast<char>(0xe0 | code >> 12);
      out += static_cast<char>(0x80 | (code >> 6 & 0x3f));
      out += static_cast<char>(0x80 | (code & 0x3f));
    }
  }

  std::string_view text_, name_;
  size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

const JsonNode* JsonNode::Find(std::string_view key) const {
  for (size_t i = keys.size(); i-- > 0;) {
    if (keys[i] == key) return &items[i];
  }
  return nullptr;
}

JsonNode ParseJson(std::string_view text, std::string_view name) { return Parser(text, name).Document(); }

}  // namespace airsim360

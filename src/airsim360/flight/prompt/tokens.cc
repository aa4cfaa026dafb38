#include "airsim360/flight/prompt/tokens.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/foreign_numbers.h"
#include "airsim360/flight/prompt/markup.h"
#include "airsim360/flight/prompt/number_words.h"
#include "airsim360/flight/prompt/other_figures.h"
#include "airsim360/flight/prompt/plain_text.h"
#include "airsim360/flight/prompt/spoken_forms.h"

namespace airsim360::internal {
namespace {

constexpr size_t kLongestPrompt = 1000;
constexpr size_t kMostChunks = 8;  // of one name or phrase

bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80; }

/// A run of letters and digits, or one character of a script without spaces.
struct Chunk {
  size_t begin = 0, end = 0;
};

class Cutter {
 public:
  explicit Cutter(std::string text) : text_(std::move(text)) {}

  std::vector<Token> Run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (IsDigit(c) || IsLetter(c) || (c == '.' && at_ + 1 < text_.size() && IsDigit(text_[at_ + 1]))) {
        CutPiece();
      } else {
        CutSign(c);
      }
    }
    return std::move(tokens_);
  }

 private:
  void Add(Token token, size_t length) {
    token.text = text_.substr(at_, length);
    token.glued = at_ > 0 && text_[at_ - 1] != ' ';
    at_ += length;
    tokens_.push_back(std::move(token));
  }
  void AddKind(Token::Kind kind, size_t length) {
    Token token;
    token.kind = kind;
    Add(std::move(token), length);
  }

  void CutSign(char c) {
    const bool after_number = !tokens_.empty() && tokens_.back().kind == Token::Kind::kNumber && at_ > 0;
    if (c == '"' || c == '\'' || c == '%' || c == '+' || c == '<' || c == '&') {
      // An inch, a foot; two feet signs are one inch sign.
      const bool two = c == '\'' && at_ + 1 < text_.size() && text_[at_ + 1] == '\'';
      const bool is_unit = after_number && (IsDigit(text_[at_ - 1]) || text_[at_ - 1] == '.' || c == '%');
      Token token;
      token.kind = Token::Kind::kWord;
      token.word = c == '&'   ? FindWord("with", false)
                   : c == '+' ? nullptr
                   : c == '<' ? FindWord("under", false)
                   : is_unit  ? FindWord(two ? "\"" : std::string_view(&c, 1), false)
                              : nullptr;
      if (c == '+') token.kind = Token::Kind::kUnknown;
      if (token.word != nullptr || c == '+') return Add(std::move(token), two ? 2 : 1);
      ++at_;
      return;
    }
    // "1.1 kg - AUW 4.3 kg": a dash in spaces after a figure ends its phrase; "weight - 2 kg" has its figure to come.
    const bool spaced = at_ > 0 && text_[at_ - 1] == ' ' && at_ + 1 < text_.size() && text_[at_ + 1] == ' ';
    const bool figure = at_ + 2 < text_.size() && (IsDigit(text_[at_ + 2]) || text_[at_ + 2] == '.' || text_[at_ + 2] == '~');
    if (c == '-' && spaced && (!figure || (!after_number && EndsInUnit()))) return AddKind(Token::Kind::kComma, 1);
    if (c == '-' || c == '/') {
      // "EO/IR" is one word; lists of figures are divided.
      const bool joins = at_ > 0 && IsLetter(text_[at_ - 1]) && at_ + 1 < text_.size() && IsLetter(text_[at_ + 1]) && !EndsInUnit();
      return c == '-' || joins ? AddKind(Token::Kind::kDash, 1) : AddKind(Token::Kind::kComma, 1);
    }
    if (c == ':' && (EndsHeading() || EndsName())) return AddKind(Token::Kind::kComma, 1);
    const bool ends = c == ',' || c == ';' || c == '.' || c == '!' || c == '?' || c == '(' || c == ')' || c == '[' || c == ']' || c == '|';
    if (c == '.' && FollowsAbbreviation()) return void(++at_);
    if (ends) return AddKind(Token::Kind::kComma, 1);
    ++at_;
  }

  /// "A quad for benchmarking planners: 0.8 kg" ends there; "Take-off weight: 2 kg" is a label with its figure.
  bool EndsHeading() const {
    constexpr size_t kLabel = 3;
    size_t words = 0;
    for (size_t k = tokens_.size(); k-- > 0 && tokens_[k].kind != Token::Kind::kComma && tokens_[k].kind != Token::Kind::kNumber;) {
      if (tokens_[k].kind == Token::Kind::kWord && tokens_[k].word->kind >= WordKind::kRotorNoun &&
          tokens_[k].word->kind <= WordKind::kElse)
        return false;
      words += tokens_[k].kind != Token::Kind::kDash;
    }
    const bool figure = at_ + 1 < text_.size() && (text_[at_ + 1] == ' ' || IsDigit(text_[at_ + 1]));
    return words > kLabel && figure;
  }

  /// "At turbine 14: 21 inch props": the number of a name counts nothing beyond its colon.
  bool EndsName() const {
    const bool number = !tokens_.empty() && tokens_.back().kind == Token::Kind::kNumber && at_ > 0 && IsDigit(text_[at_ - 1]);
    return number && at_ + 1 < text_.size() && text_[at_ + 1] == ' ';
  }

  bool EndsInUnit() const {
    if (tokens_.size() < 2) return false;
    const Token& last = tokens_.back();
    const bool unit = last.kind == Token::Kind::kWord && IsUnitKind(last.word->kind);
    return unit && tokens_[tokens_.size() - 2].kind == Token::Kind::kNumber;
  }

  /// The point of "incl." ends no sentence.
  bool FollowsAbbreviation() const {
    for (const std::string_view word : {"incl", "inkl", "inc", "approx", "ca", "excl", "dia", "resp"}) {
      const bool follows = at_ >= word.size() && std::string_view(text_).substr(at_ - word.size(), word.size()) == word;
      if (follows && (at_ == word.size() || !IsLetter(text_[at_ - word.size() - 1]))) return true;
    }
    return false;
  }

  size_t EndOfChunk(size_t begin) const {
    if (static_cast<unsigned char>(text_[begin]) >= 0xe0) return begin + CharacterLength(std::string_view(text_).substr(begin));
    size_t end = begin;
    while (end < text_.size()) {
      const char c = text_[end];
      const bool point = c == '.' && end + 1 < text_.size() && IsDigit(text_[end + 1]) &&
                         (end == begin || IsDigit(text_[end - 1]) || IsLetter(text_[end - 1]));
      const bool letter = IsLetter(c) && static_cast<unsigned char>(c) < 0xe0;
      if (!IsDigit(c) && !letter && !point) break;
      ++end;
    }
    return std::max(end, begin + 1);
  }

  /// The longest name or phrase that begins here.
  bool CutPhrase() {
    std::string key;
    size_t begin = at_;
    Token best;
    size_t best_length = 0;
    for (size_t n = 0; n < kMostChunks && begin < text_.size(); ++n) {
      const size_t end = EndOfChunk(begin);
      key += text_.substr(begin, end - begin);
      size_t next = end;
      if (next < text_.size() && text_[next] == '+') {
        if (const KnownModel* model = FindKnownModel(key + "plus")) {
          best.kind = Token::Kind::kModel;
          best.model = model;
          best_length = next + 1 - at_;
        }
      }
      Take(key, n > 0, end, best, best_length);
      // "max. speed" is one phrase; the point after a longer word ends a sentence.
      if (end - begin > 4 && next + 1 < text_.size() && text_[next] == '.' && text_[next + 1] == ' ') break;
      while (next < text_.size() &&
             (text_[next] == ' ' || text_[next] == '-' || text_[next] == '/' || text_[next] == '.' || text_[next] == '\''))
        ++next;
      if (next >= text_.size() || !(IsDigit(text_[next]) || IsLetter(text_[next]))) break;
      begin = next;
    }
    if (best_length == 0) return false;
    Add(std::move(best), best_length);
    return true;
  }

  void Take(const std::string& key, bool joined, size_t end, Token& best, size_t& best_length) const {
    // "2S 500" and "4x500" are no S500 and no X500.
    const bool after_digit = at_ > 0 && IsDigit(text_[at_ - 1]) && IsLetter(key[0]);
    if (const KnownModel* model = after_digit ? nullptr : FindKnownModel(key); model && !IsCount(key, end)) {
      best.kind = Token::Kind::kModel;
      best.model = model;
      best.word = nullptr;
      best_length = end - at_;
    } else if (const Word* word = FindWord(key, joined)) {
      best.kind = Token::Kind::kWord;
      best.word = word;
      best.model = nullptr;
      best_length = end - at_;
    }
  }

  /// Whether the figure that ends a name ("mini 2") rather counts what follows it ("a mini 2 inch quad").
  bool IsCount(const std::string& key, size_t end) const {
    if (!IsDigit(key.back())) return false;
    while (end < text_.size() && (text_[end] == ' ' || text_[end] == '-')) ++end;
    if (end >= text_.size()) return false;
    if (text_[end] == '"') return true;
    const Word* next = FindWord(text_.substr(end, EndOfChunk(end) - end), false);
    if (next == nullptr) return false;
    return (next->kind >= WordKind::kMassUnit && next->kind <= WordKind::kPercent && next->aliases[0] != 's') ||
           next->kind == WordKind::kRotorNoun || next->kind == WordKind::kMotor || next->kind == WordKind::kPropeller;
  }

  void CutPiece() {
    const size_t end = EndOfChunk(at_);
    const bool starts_with_digit = !IsLetter(text_[at_]);
    if (starts_with_digit && CutNumber(end)) return;
    if (CutPhrase()) return;
    const std::string text = text_.substr(at_, end - at_);
    if (starts_with_digit) return AddKind(Token::Kind::kUnknown, std::max<size_t>(end - at_, 1));
    CutWord(text);
  }

  /// A number with what is written onto it: "920kv", "5x4.3x3". False where a name is meant: "3dr".
  bool CutNumber(size_t end) {
    const size_t place = at_;
    const size_t tokens = tokens_.size();
    if (end > at_ && CutPhrase()) {
      if (tokens_.back().kind == Token::Kind::kModel || tokens_.back().Is(WordKind::kLithiumIon)) return true;
      at_ = place;
      tokens_.resize(tokens);
    }
    Token token;
    size_t length = BoxLength(std::string_view(text_).substr(at_));
    if (length > 0) return AddKind(Token::Kind::kUnknown, length), true;
    if (ReadPropellerCode(std::string_view(text_).substr(at_), token.code, length)) {
      token.kind = Token::Kind::kPropellerCode;
      Add(std::move(token), length);
      return true;
    }
    token.kind = Token::Kind::kNumber;
    length = ReadNumber(std::string_view(text_).substr(at_), token.value);
    if (length == 0) return false;
    const bool dash = at_ > 0 && text_[at_ - 1] == '-';
    const bool spaced = at_ < 2 || text_[at_ - 2] == ' ' || text_[at_ - 2] == ',';
    token.negative = dash && spaced && (tokens_.size() < 2 || tokens_[tokens_.size() - 2].kind != Token::Kind::kNumber);
    if (CutNumberAround(length, token)) return true;
    length += ReadThousands(std::string_view(text_).substr(at_), length, token.value);
    // "4:1"
    const std::string_view rest = std::string_view(text_).substr(at_ + length);
    const bool to_one = rest.starts_with(":1") && !(rest.size() > 2 && IsDigit(rest[2]));
    Add(std::move(token), length + (to_one ? 2 : 0));
    return true;
  }

  /// A number written around its unit: "2kg500", "1m20", "1h30".
  bool CutNumberAround(size_t length, Token& number) {
    struct Around {
      std::string_view unit;
      size_t digits;
      double parts;
    };
    for (const Around& around : {Around{"kg", 3, 1000}, {"kg", 1, 10}, {"m", 2, 100}, {"h", 2, 60}}) {
      const std::string_view rest = std::string_view(text_).substr(at_ + length);
      const size_t end = around.unit.size() + around.digits;
      if (!rest.starts_with(around.unit) || rest.size() < end || number.value != std::floor(number.value)) continue;
      const std::string_view tail = rest.substr(around.unit.size(), around.digits);
      const bool ends = rest.size() == end || !(IsDigit(rest[end]) || IsLetter(rest[end]));
      if (!ends || !std::all_of(tail.begin(), tail.end(), IsDigit)) continue;
      double more = 0;
      ReadNumber(tail, more);
      number.value += more / around.parts;
      Add(std::move(number), length);
      Token unit;
      unit.kind = Token::Kind::kWord;
      unit.word = FindWord(around.unit, false);
      Add(std::move(unit), end);
      return true;
    }
    return false;
  }

  void CutWord(const std::string& text) {
    // Letters with a number onto them: "kv920".
    const size_t letters = std::find_if(text.begin(), text.end(), IsDigit) - text.begin();
    if (letters < text.size()) {
      const bool unit = !tokens_.empty() && tokens_.back().kind == Token::Kind::kNumber;
      if (const Word* word = FindWord(text.substr(0, letters), false);
          word != nullptr && word->kind > WordKind::kTo && word->kind != WordKind::kOtherUnit && (letters > 1 || unit)) {
        Token token;
        token.kind = Token::Kind::kWord;
        token.word = word;
        return Add(std::move(token), letters);
      }
      if (CutLetteredCode(text, letters)) return;
      return AddKind(Token::Kind::kUnknown, text.size());
    }
    Token token;
    if (const Word* head = FindCompound(text)) {
      token.kind = Token::Kind::kWord;
      token.word = head;
      return Add(std::move(token), text.size());
    }
    const bool unit = !tokens_.empty() && tokens_.back().kind == Token::Kind::kNumber;
    const std::string_view heard = unit ? UnitAsHeard(text) : std::string_view();
    const std::string_view respelled = heard.empty() ? Respelled(text) : heard;
    if (!respelled.empty()) {
      token.kind = Token::Kind::kWord;
      token.word = FindWord(respelled, false) ? FindWord(respelled, false) : FindWord(respelled, true);
      token.respelled = std::string(respelled);
    }
    Add(std::move(token), text.size());
  }

  /// "G28x9.2": a propeller's sizes after the letters of its series.
  bool CutLetteredCode(const std::string& text, size_t letters) {
    Token token;
    size_t length = 0;
    const bool code = letters <= 2 && ReadPropellerCode(std::string_view(text).substr(letters), token.code, length) &&
                      letters + length == text.size() && token.code[0] >= 8;
    if (!code) return false;
    token.kind = Token::Kind::kPropellerCode;
    Add(std::move(token), text.size());
    return true;
  }

  std::string text_;
  size_t at_ = 0;
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> Tokenize(std::string_view prompt) {
  if (prompt.size() > kLongestPrompt) throw InputError("the description is longer than 1000 bytes");
  return WithoutOtherFigures(WithBorrowedUnits(JoinNumbers(Cutter(SpeltOut(WithForeignNumbers(PlainText(WithoutMarkup(prompt))))).Run())));
}

}  // namespace airsim360::internal

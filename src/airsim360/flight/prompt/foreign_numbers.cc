#include "airsim360/flight/prompt/foreign_numbers.h"

#include <cmath>
#include <map>
#include <regex>
#include <string_view>
#include <vector>

namespace airsim360::internal {
namespace {

using Words = std::map<std::string, double, std::less<>>;

void Add(Words& words, double first, double step, std::initializer_list<const char*> names) {
  for (const char* name : names) words.emplace(name, first), first += step;
}

/// Parts of German numbers, which are written as one word.
const Words& GermanParts() {
  static const Words kWords = [] {
    Words words;
    Add(words, 1, 1,
        {"ein", "zwei", "drei", "vier", "funf", "sechs", "sieben", "acht", "neun", "zehn", "elf", "zwolf", "dreizehn", "vierzehn",
         "funfzehn", "sechzehn", "siebzehn", "achtzehn", "neunzehn"});
    Add(words, 20, 10, {"zwanzig", "dreissig", "vierzig", "funfzig", "sechzig", "siebzig", "achtzig", "neunzig"});
    for (const auto& [name, value] : {std::pair("fuenf", 5), {"zwoelf", 12}, {"fuenfzehn", 15}, {"fuenfzig", 50}})
      words.emplace(name, value);
    return words;
  }();
  return kWords;
}

/// Value of a German number of several parts; 0: it is none. "zweieinhalb", "funfundzwanzig", "zweitausendfunfhundert".
double German(std::string_view word) {
  const auto& parts = GermanParts();
  if (const auto part = parts.find(word); part != parts.end()) return part->second;
  if (constexpr std::string_view kHalf = "einhalb"; word.ends_with(kHalf)) {
    const double whole = German(word.substr(0, word.size() - kHalf.size()));
    return whole > 0 ? whole + 0.5 : 0;
  }
  for (const auto& [name, factor] : {std::pair<std::string_view, double>{"tausend", 1000}, {"hundert", 100}}) {
    const size_t at = word.find(name);
    if (at == std::string_view::npos) continue;
    const std::string_view before = word.substr(0, at), after = word.substr(at + name.size());
    const double times = before.empty() ? 1 : German(before), rest = after.empty() ? 0 : German(after);
    return times > 0 && (after.empty() || (rest > 0 && rest < factor)) ? times * factor + rest : 0;
  }
  if (const size_t at = word.find("und"); at != std::string_view::npos) {
    const double unit = German(word.substr(0, at)), ten = German(word.substr(at + 3));
    return unit > 0 && unit < 10 && ten >= 20 && ten < 100 && std::fmod(ten, 10) == 0 ? ten + unit : 0;
  }
  return 0;
}

/// Words of a language that writes numbers apart; 100 and 1000 multiply what stands before them.
Words Spanish() {
  Words words;
  Add(words, 1, 1, {"un",          "dos",        "tres",        "cuatro",     "cinco",      "seis",      "siete",      "ocho",
                    "nueve",       "diez",       "once",        "doce",       "trece",      "catorce",   "quince",     "dieciseis",
                    "diecisiete",  "dieciocho",  "diecinueve",  "veinte",     "veintiun",   "veintidos", "veintitres", "veinticuatro",
                    "veinticinco", "veintiseis", "veintisiete", "veintiocho", "veintinueve"});
  Add(words, 30, 10, {"treinta", "cuarenta", "cincuenta", "sesenta", "setenta", "ochenta", "noventa"});
  Add(words, 200, 100,
      {"doscientos", "trescientos", "cuatrocientos", "quinientos", "seiscientos", "setecientos", "ochocientos", "novecientos"});
  for (const char* one : {"uno", "una"}) words.emplace(one, 1);
  for (const char* hundred : {"cien", "ciento"}) words.emplace(hundred, 100);
  words.emplace("mil", 1000);
  return words;
}

Words French() {
  Words words;
  Add(words, 1, 1,
      {"un", "deux", "trois", "quatre", "cinq", "six", "sept", "huit", "neuf", "dix", "onze", "douze", "treize", "quatorze", "quinze",
       "seize"});
  Add(words, 20, 10, {"vingt", "trente", "quarante", "cinquante", "soixante"});
  for (const auto& [name, value] : {std::pair("une", 1), {"vingts", 20}, {"cent", 100}, {"cents", 100}, {"mille", 1000}})
    words.emplace(name, value);
  return words;
}

Words Italian() {
  Words words;
  constexpr std::string_view kOnes[] = {"uno", "due", "tre", "quattro", "cinque", "sei", "sette", "otto", "nove"};
  constexpr std::string_view kTens[] = {"venti", "trenta", "quaranta", "cinquanta", "sessanta", "settanta", "ottanta", "novanta"};
  for (const char* one : {"un", "una"}) words.emplace(one, 1);
  for (int one = 1; one <= 9; ++one) {
    words.emplace(kOnes[one - 1], one);
    if (one > 1) words.emplace(std::string(kOnes[one - 1]) + "cento", 100 * one);
  }
  Add(words, 10, 1, {"dieci", "undici", "dodici", "tredici", "quattordici", "quindici", "sedici", "diciassette", "diciotto", "diciannove"});
  for (int ten = 2; ten <= 9; ++ten) {
    const std::string name(kTens[ten - 2]);
    words.emplace(name, 10 * ten);
    for (int one = 1; one <= 9; ++one) {
      const bool vowel = one == 1 || one == 8;  // "ventuno", "ventotto"
      words.emplace(name.substr(0, name.size() - (vowel ? 1 : 0)).append(kOnes[one - 1]), 10 * ten + one);
    }
  }
  for (const auto& [name, value] : {std::pair("cento", 100), {"mille", 1000}, {"mila", 1000}}) words.emplace(name, value);
  return words;
}

/// One number of several words from `at` on: how many it takes, 0 if the first is none.
size_t Read(const Words& words, const std::vector<std::string>& text, size_t at, double& value) {
  double whole = 0, below = 0, last = 0;
  size_t used = 0;
  for (size_t i = at; i < text.size(); ++i) {
    const bool joins = used > 0 && (text[i] == "y" || text[i] == "et") && i + 1 < text.size() && words.contains(text[i + 1]);
    const auto word = words.find(text[joins ? i + 1 : i]);
    if (word == words.end()) break;
    const double next = word->second;
    const bool eighty = below == 4 && next == 20 && last == 4,
               teens = (last == 60 || last == 20) && next < 20 && std::fmod(below, 100) != 20;
    const double room = last >= 100 ? 100 : last >= 20 ? 10 : 0;
    if (next == 1000 && whole == 0) {
      whole = 1000 * (used == 0 ? 1 : below), below = 0;
    } else if (next == 100 && below < 10) {
      below = 100 * (below == 0 ? 1 : below);
    } else if (eighty) {
      below = 80;
    } else if (below == 0 || next < room || teens) {
      below += next;
    } else {
      break;
    }
    last = next;
    used = i + (joins ? 2 : 1) - at;
    i += joins;
  }
  value = whole + below;
  return used;
}

std::string Figures(double value) {
  std::string text = std::to_string(value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

/// Whether "y medio", "et demie", "e mezzo" stand after a number and its unit at `at`.
bool HalfFollows(const std::vector<std::string>& text, size_t at) {
  static const std::regex kHalf("medi[oa]|demie?|mezz[oa]");
  return at + 2 < text.size() && (text[at + 1] == "y" || text[at + 1] == "et" || text[at + 1] == "e") &&
         std::regex_match(text[at + 2], kHalf);
}

/// A run of words that only spaces and dashes part, in digits where it is a number; empty: nothing is.
std::string InDigits(const std::vector<std::string>& text) {
  static const Words kLanguages[] = {Spanish(), French(), Italian()};
  static const std::regex kUnit(
      "kilos?|chil[oi]|horas?|heures?|or[ae]|minut[oi]s?|minutes?|metros?|metres?|metri|litros?|litres?|litri|libras?|livres?");
  std::string out;
  bool changed = false;
  for (size_t i = 0; i < text.size();) {
    double value = 0;
    size_t used = 0;
    for (const Words& words : kLanguages) {
      double read = 0;
      if (const size_t n = Read(words, text, i, read); n > used) used = n, value = read;
    }
    const bool unit = i + used < text.size() && std::regex_match(text[i + used], kUnit), half = unit && HalfFollows(text, i + used);
    const bool compound = used > 1 || (used == 1 && ((value >= 200 && value != 1000) || (value > 20 && std::fmod(value, 10) != 0)));
    if (half) {
      out.append(Figures((used == 0 ? 1 : value) + 0.5)).append(1, ' ').append(text[i + used]).append(1, ' ');
      i += used + 3;
    } else if (compound) {
      out.append(Figures(value)).append(1, ' ');
      i += used;
    } else if (const double german = text[i].size() > 7 && !GermanParts().contains(text[i]) ? German(text[i]) : 0; german > 0) {
      out.append(Figures(german)).append(1, ' ');
      ++i;
      changed = true;
      continue;
    } else {
      out.append(text[i++]).append(1, ' ');
      continue;
    }
    changed = true;
  }
  if (!changed) return {};
  out.pop_back();
  return out;
}

}  // namespace

std::string WithForeignNumbers(const std::string& plain) {
  static const std::regex kRun("[a-z]+(?:[ -][a-z]+)*"), kWord("[a-z]+");
  std::string out;
  size_t at = 0;
  for (std::sregex_iterator run(plain.begin(), plain.end(), kRun), end; run != end; ++run) {
    const auto first = static_cast<size_t>(run->position());
    out.append(plain, at, first - at);
    at = first + static_cast<size_t>(run->length());
    const std::string text = run->str();
    std::vector<std::string> words;
    for (std::sregex_iterator word(text.begin(), text.end(), kWord); word != end; ++word) words.push_back(word->str());
    const std::string digits = InDigits(words);
    out += digits.empty() ? text : digits;
  }
  return out.append(plain, at, plain.size() - at);
}

}  // namespace airsim360::internal

#include "airsim360/flight/prompt/markup.h"

#include <algorithm>
#include <regex>
#include <utility>
#include <vector>

#include "airsim360/base/text.h"

namespace airsim360::internal {
namespace {

using Rule = std::pair<std::regex, const char*>;
using Row = std::vector<std::string>;

std::string Replaced(std::string text, const std::vector<Rule>& rules) {
  for (const auto& [pattern, words] : rules) text = std::regex_replace(text, pattern, words);
  return text;
}

bool HasDigit(std::string_view text) { return text.find_first_of("0123456789") != std::string_view::npos; }

Row Split(std::string_view text, char at) {
  Row parts;
  for (size_t begin = 0;; ++begin) {
    const size_t end = std::min(text.find(at, begin), text.size());
    parts.emplace_back(Trimmed(text.substr(begin, end - begin)));
    if (end == text.size()) return parts;
    begin = end;
  }
}

/// The units of siunitx: prefixes and names are written one after another.
std::string Latex(std::string text) {
  static const std::regex kLatex(R"(\\[a-zA-Z])");
  if (!std::regex_search(text, kLatex)) return text;
  static const std::vector<Rule> kRules = {
      {std::regex(R"(\\(begin|end)\s*\{[^{}]*\}(\{[lcr|p. ]*\})?)"), "\n"},
      {std::regex(R"(\\(hline|toprule|midrule|bottomrule|centering)\b)"), " "},
      {std::regex(R"(\\item\b)"), "\n"},
      {std::regex(R"(\\(%|_|#|\$|&))"), "$1"},
      {std::regex(R"(\\\\)"), "\n"},
      {std::regex(R"(\\[,;:! ]|~)"), " "},
      {std::regex(R"(\\(SI|qty|SIrange|numproduct)\s*(\[[^\]]*\])?\s*\{([^{}]*)\}\s*\{([^{}]*)\})"), "$3 $4"},
      {std::regex(R"(\\times\b)"), "x"},
      {std::regex(R"(\\(approx|sim)\b)"), " "},
      {std::regex(R"(\\pm\b)"), "+-"},
      {std::regex(R"(\\(kilo|kg)\s*\\gram\b|\\kilogram\b|\\kg\b)"), "kg"},
      {std::regex(R"(\\milli\s*\\(metre|meter)\b|\\mm\b)"), "mm"},
      {std::regex(R"(\\centi\s*\\(metre|meter)\b|\\cm\b)"), "cm"},
      {std::regex(R"(\\milli\s*\\ampere\s*\\hour\b)"), "mAh"},
      {std::regex(R"(\\ampere\s*\\hour\b)"), "Ah"},
      {std::regex(R"(\\watt\s*\\hour\b)"), "Wh"},
      {std::regex(R"(\\kilo\s*\\(metre|meter)\s*\\per\s*\\hour\b)"), "km/h"},
      {std::regex(R"(\\(metre|meter)\s*\\per\s*\\second\b)"), "m/s"},
      {std::regex(R"(\\(kilo|mega)?\s*\\hertz\b)"), "Hz"},
      {std::regex(R"(\\gram\b)"), "g"},
      {std::regex(R"(\\(metre|meter)\b)"), "m"},
      {std::regex(R"(\\minute\b)"), "min"},
      {std::regex(R"(\\second\b)"), "sec"},
      {std::regex(R"(\\hour\b)"), "h"},
      {std::regex(R"(\\volt\b)"), "V"},
      {std::regex(R"(\\inch\b)"), "inch"},
      {std::regex(R"(\\[a-zA-Z]+\*?)"), " "},
      {std::regex(R"([{}$])"), ""},
      {std::regex(R"(&)"), "|"},
  };
  return Replaced(std::move(text), kRules);
}

/// Marks of pages: cells are divided, other elements are labels with the unit that they say.
std::string Elements(const std::string& text) {
  static const std::regex kElement(R"(<(/?)([a-zA-Z][\w-]*)((?:\s[^<>]*)?)>)");
  static const std::regex kUnit("unit\\s*=\\s*[\"']([^\"']*)[\"']"), kLine("tr|li|br|p|ul|ol|table|tbody|div|h[1-6]");
  static const std::regex kCell("td|th"), kPlain("b|i|em|strong|span|u|sub|sup|code|a");
  std::string out, unit;
  size_t at = 0;
  for (std::sregex_iterator element(text.begin(), text.end(), kElement), end; element != end; ++element) {
    out.append(text, at, static_cast<size_t>(element->position()) - at);
    at = static_cast<size_t>(element->position() + element->length());
    const bool closes = element->length(1) > 0;
    const std::string name = element->str(2), attributes = element->str(3);
    std::smatch found;
    if (std::regex_match(name, kPlain)) continue;
    if (std::regex_match(name, kCell)) {
      out += closes ? " | " : "";
    } else if (std::regex_match(name, kLine)) {
      out += "\n";
    } else if (closes) {
      out += " " + std::exchange(unit, std::string()) + "\n";
    } else {
      if (std::regex_search(attributes, found, kUnit)) unit = found.str(1);
      out += "\n" + name + ": ";
    }
  }
  return out.append(text, at, text.size() - at);
}

/// {"mass_kg": 1.2}, "wheelbaseMm = 450", "prop_in: 11".
std::string Keys(std::string text) {
  static const std::vector<Rule> kFirst = {
      // {"mass": {"value": 9.4, "unit": "kg"}}
      {std::regex("\\{\\s*\"value\"\\s*:\\s*\"?([0-9.]+)\"?\\s*,\\s*\"units?\"\\s*:\\s*\"([^\"]+)\"\\s*\\}"), "$1 $2"},
      // A name says nothing, whatever else it means.
      {std::regex(
           "(^|[\n,{])\\s*\"?([nN]ame|id|title|callsign)\"?\\s*[:=]\\s*\"?(?![^\"\n,]*([rR]otor|opter|[qQ]uad|[hH]ex|[oO]cto))[A-Za-z _-]*\"?(?=[\n,}])"),
       "$1"},
  };
  text = Replaced(std::move(text), kFirst);
  static const std::regex kJson("(^|[{,]\\s*)\"[^\"\n]*\"\\s*:");
  if (std::regex_search(text, kJson)) {
    static const std::vector<Rule> kRules = {
        {std::regex(R"(["\[\]])"), " "}, {std::regex(R"([{}])"), "\n"}, {std::regex(R"(,\s*(?=[a-zA-Z_]+\s*:))"), "\n"}};
    text = Replaced(std::move(text), kRules);
  }
  static const std::vector<Rule> kRules = {
      {std::regex(R"(([a-z]{2})(Kg|Mm|Cm|Mah|Ah|Wh|Min|Inch|Kv|Kmh|Mps)(?=\s*[:=]))"), "$1_$2"},
      {std::regex(R"(_(m_s|mps|ms|m_per_s)\s*([:=,|]+)\s*([\d.]+)(?![\w.]))"), "$2 $3 m/s"},
      {std::regex(R"(_(kmh|kph|km_h)\s*([:=,|]+)\s*([\d.]+)(?![\w.]))"), "$2 $3 km/h"},
      {std::regex(R"(_(s|sec)\s*([:=,|]+)\s*([\d.]+)(?![\w.]))"), "$2 $3 sec"},
      {std::regex(
           R"(_([kK]g|g|lbs?|oz|[mM]m|[cC]m|m|in|[iI]nch|inches|[mM]in|minutes|h|hz|[mM]?[aA]h|[wW]h|v|[kK]v|l|mph)\s*([:=,|]+)\s*([\d.]+)(?![\w.]))"),
       "$2 $3 $1"},
      {std::regex(R"(([a-z]{2,})_(?=[a-z]))"), "$1 "},
      // "Mass in kg: 3.2", "AUW/kg = 3.2"
      {std::regex(R"((?:\bin |/ ?)(kg|g|lbs?|mm|cm|m|inch|inches|min|minutes|mAh|Ah|Wh)\s*[:=]\s*([\d.]+)(?![ \t]*[a-zA-Z"%\d.]))"),
       ": $2 $1"},
      // "14 m s^-1"
      {std::regex("\\bm ?(\\*|\xc2\xb7)? ?s ?(\\^ ?-1|\xe2\x81\xbb\xc2\xb9)"), "m/s"},
  };
  return Replaced(std::move(text), kRules);
}

bool IsRule(const std::string& line) {
  return line.find('-') != std::string::npos && line.find_first_not_of("|-:+= \t") == std::string::npos;
}

Row CellsOf(const std::string& line, char divider) {
  Row cells = Split(line, divider);
  if (divider == '|') {
    if (cells.size() > 1 && cells.front().empty()) cells.erase(cells.begin());
    if (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  }
  return cells;
}

bool IsHeader(const Row& row) {
  return row.size() > 1 && std::none_of(row.begin(), row.end(), [](const std::string& cell) { return HasDigit(cell); });
}

/// Names above, figures below: each name with its figure.
bool IsWide(const Row& head, const Row& row, size_t rows) {
  if (head.size() < 3 || head.size() != row.size() || !IsHeader(head)) return false;
  const auto figures = std::count_if(row.begin(), row.end(), [](const std::string& cell) { return HasDigit(cell); });
  return rows == 2 && 2 * static_cast<size_t>(figures) >= row.size();
}

std::string Sentence(const Row& row) {
  std::string out = row[0];
  if (row.size() == 1) return out;
  const bool label = !row[0].empty() && !HasDigit(row[0]);
  const bool figure = !row[1].empty() && (HasDigit(row[1].substr(0, 2)) || row.size() == 2);
  for (size_t k = 1; k < row.size(); ++k) {
    if (row[k] == "-") continue;  // no unit
    out += (k == 1 && label && figure ? ": " : k > 1 && label && figure && row.size() == 3 ? " " : ", ") + row[k];
  }
  return out;
}

/// Lines of a table with one divider.
void AddTable(const std::vector<std::string>& lines, char divider, std::string& out) {
  std::vector<Row> rows;
  for (const std::string& line : lines) {
    if (!IsRule(line)) rows.push_back(CellsOf(line, divider));
  }
  const bool ruled = std::any_of(lines.begin(), lines.end(), IsRule);
  if (rows.size() >= 2 && IsWide(rows[0], rows[1], rows.size())) {
    for (size_t k = 0; k < rows[0].size(); ++k) out += rows[0][k] + ": " + rows[1][k] + "\n";
    return;
  }
  for (size_t k = 0; k < rows.size(); ++k) {
    if (k == 0 && rows.size() > 1 && ruled && IsHeader(rows[0])) continue;
    out += Sentence(rows[k]) + "\n";
  }
}

/// "Mass ..... 1.2 kg", "Mass -> 1.2 kg", "1) Mass 1.2 kg" as labels with their figures.
std::string Line(std::string line) {
  static const std::vector<Rule> kRules = {
      {std::regex("^\\s*([0-9]{1,2}[.)]|\\*|-|\xe2\x80\xa2|\xc2\xb7)\\s+(?=\\S)"), ""},
      {std::regex("^([^0-9|:]{2,40}?)\\s*(\\.{3,}|\t+| {3,}|-+>|=+>|\xe2\x86\x92|\xe2\x80\xa6)\\s*(?=[~<>0-9])"), "$1: "},
      {std::regex("^([^0-9|:;,.]{2,40});\\s*(?=[~<>0-9])"), "$1: "},
      {std::regex("^([^0-9|:;,.]{2,40}),(?=[0-9.]+ ?\\w*$)"), "$1: "},
  };
  return Replaced(std::move(line), kRules);
}

std::string Tables(const std::string& text) {
  std::vector<std::string> lines;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  const bool csv = lines.size() == 2 && Split(lines[0], ',').size() >= 3 && IsWide(Split(lines[0], ','), Split(lines[1], ','), 2);
  std::string out;
  if (csv) {
    AddTable(lines, ',', out);
    return out;
  }
  const auto is_row = [&](size_t k) { return lines[k].find('|') != std::string::npos; };
  for (size_t k = 0; k < lines.size(); ++k) {
    std::vector<std::string> table;
    for (; k < lines.size() && (is_row(k) || (!table.empty() && IsRule(lines[k]))); ++k) table.push_back(lines[k]);
    if (!table.empty()) AddTable(table, '|', out);
    if (k < lines.size()) out += Line(lines[k]) + "\n";
  }
  out.pop_back();
  return out;
}

}  // namespace

std::string WithoutMarkup(std::string_view text) {
  std::string plain = Tables(Elements(Latex(std::string(text))));
  return Keys(std::move(plain));
}

}  // namespace airsim360::internal

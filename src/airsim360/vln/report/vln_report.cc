#include "airsim360/vln/report/vln_report.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "airsim360/base/base64.h"
#include "airsim360/vln/report/score_table.h"

namespace airsim360 {
namespace {

using internal::ScoreTable;

constexpr size_t kMostFailures = 200, kMostPaths = 120;

std::string Number(double value, int digits) {
  if (!std::isfinite(value)) return "—";
  char text[32];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

// A table of texts in either form.
struct Sheet {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

std::string Escaped(const std::string& text, bool html) {
  std::string out;
  for (const char c : text) {
    if (html && c == '<')
      out += "&lt;";
    else if (html && c == '>')
      out += "&gt;";
    else if (html && c == '&')
      out += "&amp;";
    else if (html && c == '"')
      out += "&quot;";
    else if (!html && c == '|')
      out += "\\|";
    else if (c == '\n')
      out += ' ';
    else
      out += c;
  }
  return out;
}

std::string Show(const Sheet& sheet, bool html) {
  std::string out = html ? "<table>\n<tr>" : "|";
  for (const std::string& cell : sheet.head) out += html ? "<th>" + Escaped(cell, true) + "</th>" : " " + Escaped(cell, false) + " |";
  out += html ? "</tr>\n" : "\n|";
  if (!html) {
    for (size_t i = 0; i < sheet.head.size(); ++i) out += "---|";
    out += "\n";
  }
  for (const auto& row : sheet.rows) {
    out += html ? "<tr>" : "|";
    for (const std::string& cell : row) out += html ? "<td>" + Escaped(cell, true) + "</td>" : " " + Escaped(cell, false) + " |";
    out += html ? "</tr>\n" : "\n";
  }
  return out + (html ? "</table>\n" : "\n");
}

std::string Heading(const std::string& text, bool html) { return html ? "<h2>" + Escaped(text, true) + "</h2>\n" : "## " + text + "\n\n"; }
std::string Paragraph(const std::string& text, bool html) { return html ? "<p>" + Escaped(text, true) + "</p>\n" : text + "\n\n"; }

size_t Column(const std::string& name) {
  const auto names = internal::ScoreNames();
  return static_cast<size_t>(std::ranges::find(names, name) - names.begin());
}

std::string Cell(const ScoreTable& table, const char* name, int digits) {
  const size_t i = Column(name);
  if (table.means.empty()) return "—";
  return Number(table.means[i], digits) + " [" + Number(table.intervals[i].low, digits) + ", " + Number(table.intervals[i].high, digits) +
         "]";
}

Sheet MainTable(const std::vector<VlnRun>& runs) {
  Sheet sheet{{"run", "agent", "view", "decisions by", "protocol", "episodes", "SR", "OSR", "SPL", "SPL straight", "NE (m)", "nDTW", "SDTW",
               "CLS", "process", "collisions", "decisions", "yaw turned (deg)", "path / geodesic"},
              {}};
  for (const VlnRun& run : runs) {
    const ScoreTable table = internal::TableOf(internal::Pointers(run.results));
    const VlnResult& first = run.results.front();
    sheet.rows.push_back({run.name, first.agent, first.view, first.decisions_by, first.protocol, std::to_string(table.episodes),
                          Cell(table, "sr", 3), Cell(table, "osr", 3), Cell(table, "spl", 3), Cell(table, "spl_straight", 3),
                          Cell(table, "ne", 1), Cell(table, "ndtw", 3), Cell(table, "sdtw", 3), Cell(table, "cls", 3),
                          Cell(table, "process_fidelity", 3), Cell(table, "collision_rate", 3), Cell(table, "decisions", 1),
                          Cell(table, "yaw_turned_deg", 0), Cell(table, "path_over_geodesic", 2)});
  }
  return sheet;
}

Sheet GroupTable(const std::vector<VlnRun>& runs, std::string VlnResult::*field, const char* name) {
  std::set<std::string> keys;
  for (const VlnRun& run : runs)
    for (const VlnResult& r : run.results) keys.insert(r.*field);
  Sheet sheet{{name}, {}};
  for (const VlnRun& run : runs) sheet.head.push_back(run.name);
  for (const std::string& key : keys) {
    std::vector<std::string> row = {key};
    for (const VlnRun& run : runs) {
      size_t all = 0, good = 0;
      for (const VlnResult& r : run.results) {
        all += r.*field == key;
        good += r.*field == key && r.success;
      }
      row.push_back(all == 0 ? "—"
                             : std::to_string(good) + " / " + std::to_string(all) + " (" +
                                   Number(100.0 * static_cast<double>(good) / static_cast<double>(all), 0) + " %)");
    }
    sheet.rows.push_back(row);
  }
  return sheet;
}

// How often a flight had arrived by its k-th decision: what moving only once is about.
Sheet DecisionsTable(const std::vector<VlnRun>& runs) {
  static constexpr int64_t kBy[] = {1, 2, 3, 4, 6, 10, 20, 50, 100, 500};
  Sheet sheet{{"arrived within … decisions"}, {}};
  for (const VlnRun& run : runs) sheet.head.push_back(run.name);
  for (const int64_t most : kBy) {
    std::vector<std::string> row = {std::to_string(most)};
    for (const VlnRun& run : runs) {
      const auto good = std::ranges::count_if(run.results, [&](const VlnResult& r) { return r.success && r.decisions <= most; });
      row.push_back(Number(100.0 * static_cast<double>(good) / static_cast<double>(run.results.size()), 1) + " %");
    }
    sheet.rows.push_back(row);
  }
  return sheet;
}

Sheet Failures(const std::vector<VlnRun>& runs, size_t& left_out) {
  Sheet sheet{{"run", "episode", "end", "why"}, {}};
  for (const VlnRun& run : runs) {
    for (const VlnResult& r : run.results) {
      if (r.success) continue;
      if (sheet.rows.size() >= kMostFailures)
        ++left_out;
      else
        sheet.rows.push_back({run.name, r.id, r.end, r.explanation});
    }
  }
  return sheet;
}

// The flights of a world seen from above: north up, grey where the reference leads, green and red where the drone flew.
std::string Map(const std::vector<const VlnResult*>& results) {
  Vec3d low{1e9, 1e9, 0}, high{-1e9, -1e9, 0};
  for (const VlnResult* r : results) {
    for (const auto* path : {&r->ref, &r->pred}) {
      for (const Vec3d& p : *path) {
        low = Min(low, p);
        high = Max(high, p);
      }
    }
  }
  // A town and a room look alike: lines and dots are as wide as the map allows.
  const double unit = std::max({high.x - low.x, high.y - low.y, 1.0}) / 300, margin = 10 * unit;
  const double width = high.x - low.x + 2 * margin, height = high.y - low.y + 2 * margin;
  const auto stroke = [&](const char* colour, double thickness) {
    return std::string("fill=\"none\" stroke=\"") + colour + "\" stroke-width=\"" + Number(thickness * unit, 3) + "\"";
  };
  const auto line = [&](const std::vector<Vec3d>& path, const std::string& style) {
    std::string points;
    for (const Vec3d& p : path) points += Number(p.x - low.x + margin, 2) + "," + Number(high.y - p.y + margin, 2) + " ";
    return "<polyline points=\"" + points + "\" " + style + "/>\n";
  };
  const auto dot = [&](Vec3d p, const char* colour, double radius) {
    return "<circle cx=\"" + Number(p.x - low.x + margin, 2) + "\" cy=\"" + Number(high.y - p.y + margin, 2) + "\" r=\"" +
           Number(radius * unit, 3) + "\" fill=\"" + colour + "\"/>\n";
  };
  std::string svg = "<svg viewBox=\"0 0 " + Number(width, 2) + " " + Number(height, 2) +
                    "\" style=\"max-width:900px;width:100%;background:#fafafa\" role=\"img\">\n";
  size_t drawn = 0;
  for (const VlnResult* r : results) {
    if (++drawn > kMostPaths) break;
    svg += "<g><title>" + Escaped(r->id + ": " + (r->success ? "success" : r->explanation), true) + "</title>\n";
    svg += line(r->ref, stroke("#bbbbbb", 1.5));
    svg += line(r->pred, stroke(r->success ? "#1b7f3b" : "#c0392b", 0.9));
    svg += dot(r->ref.front(), "#2c5f9e", 2) + dot(r->ref.back(), "#222222", 1.6) + "</g>\n";
  }
  return svg + "</svg>\n";
}

std::string Maps(const std::vector<VlnRun>& runs) {
  std::string out;
  for (const VlnRun& run : runs) {
    for (const auto& [world, group] : internal::GroupBy(run.results, &VlnResult::world)) {
      out += "<h3>" + Escaped(run.name + ": " + world, true) + "</h3>\n" + Map(group);
      if (group.size() > kMostPaths)
        out += "<p>The first " + std::to_string(kMostPaths) + " of " + std::to_string(group.size()) + " flights.</p>\n";
    }
  }
  return out;
}

// What was seen where a flight failed.
std::string Panoramas(const std::vector<VlnRun>& runs, const FailurePictures& pictures) {
  std::string out;
  for (const VlnRun& run : runs) {
    for (const VlnResult& r : run.results) {
      const auto found = pictures.find({run.name, r.id});
      if (found == pictures.end()) continue;
      out += "<figure><img style=\"width:100%\" alt=\"panorama at the end of the flight\" src=\"data:image/jpeg;base64," +
             Base64(found->second) + "\"><figcaption>" + Escaped(run.name + ", " + r.id + ": " + r.explanation, true) +
             "</figcaption></figure>\n";
    }
  }
  return out;
}

std::string Pages(const std::vector<VlnRun>& runs, bool html, const FailurePictures& pictures = {}) {
  std::string out;
  out += Heading("Scores", html) + Paragraph("Means with 95 % bootstrap intervals over episodes.", html) + Show(MainTable(runs), html);
  out += Heading("Success by difficulty", html) + Show(GroupTable(runs, &VlnResult::difficulty, "difficulty"), html);
  out += Heading("You only move once", html) +
         Paragraph("Share of all episodes that were successes with at most so many decisions: a turn counts as one.", html) +
         Show(DecisionsTable(runs), html);
  out += Heading("Success by instruction", html) + Show(GroupTable(runs, &VlnResult::template_id, "instruction"), html);
  if (html)
    out += Heading("Maps", true) +
           Paragraph("Blue: start; black: goal; grey: reference; green: success; red: failure. North is up.", true) + Maps(runs);
  size_t left_out = 0;
  const Sheet failures = Failures(runs, left_out);
  out += Heading("Failures", html) + Show(failures, html);
  if (left_out > 0) out += Paragraph(std::to_string(left_out) + " more failures are in the files.", html);
  if (html && !pictures.empty())
    out += Heading("Where flights failed", true) +
           Paragraph("The panorama at the last place, in the direction of the last move. The ring is around the goal.", true) +
           Panoramas(runs, pictures);
  return out;
}

}  // namespace

std::string ReportMarkdown(const std::vector<VlnRun>& runs) { return "# Vision-and-language navigation\n\n" + Pages(runs, false); }

std::string ReportHtml(const std::vector<VlnRun>& runs, const FailurePictures& pictures) {
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><link rel=\"icon\" href=\"data:,\"><title>Vision-and-language navigation</title>\n"
         "<style>body{font:15px/1.5 sans-serif;max-width:1200px;margin:2em auto;padding:0 1em}table{border-collapse:collapse;display:block;overflow-x:auto}"
         "td,th{border:1px solid #ccc;padding:.25em .6em;text-align:left;vertical-align:top}th{background:#f2f2f2}</style></head><body>\n"
         "<h1>Vision-and-language navigation</h1>\n" +
         Pages(runs, true, pictures) + "</body></html>\n";
}

}  // namespace airsim360

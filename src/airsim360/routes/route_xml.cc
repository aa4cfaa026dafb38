// GPX and KML, as far as routes need them: tags, attributes and text of well-formed XML without a DOCTYPE.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/routes/route_file.h"

namespace airsim360 {
namespace {

constexpr size_t kMaxPoints = 1'000'000;

class Reader {
 public:
  Reader(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  [[noreturn]] void Fail(size_t at, const std::string& what) const {
    const auto before = text_.substr(0, std::min(at, text_.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const size_t start = before.rfind('\n');
    const size_t column = start == std::string_view::npos ? before.size() + 1 : before.size() - start;
    throw InputError(std::string(name_) + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " + what);
  }
  // Line of a place; places are asked for in order.
  size_t Line(size_t at) {
    line_ +=
        static_cast<size_t>(std::count(text_.begin() + static_cast<ptrdiff_t>(counted_), text_.begin() + static_cast<ptrdiff_t>(at), '\n'));
    counted_ = at;
    return line_;
  }

  // The next tag: its content between < and >, and the text before it. False at the end.
  bool Next(std::string_view& before, std::string_view& tag) {
    for (;;) {
      const size_t open = text_.find('<', at_);
      if (open == std::string_view::npos) return false;
      before = text_.substr(at_, open - at_);
      const char* end_mark = text_.substr(open).starts_with("<!--") ? "-->" : text_.substr(open).starts_with("<?") ? "?>" : ">";
      const size_t close = end_mark[0] == '>' ? EndOfTag(open) : text_.find(end_mark, open);
      if (close == std::string_view::npos) Fail(open, "this tag does not end");
      if (text_.substr(open).starts_with("<!") && end_mark[0] == '>') Fail(open, "a DOCTYPE or CDATA section is not read");
      at_ = close + std::string_view(end_mark).size();
      tag = text_.substr(open + 1, close - open - 1);
      if (end_mark[0] == '>') {
        Nest(open, tag);
        return true;
      }
    }
  }
  // A file that is cut off, or whose elements do not fit into each other, would lose points.
  void CheckEnd() const {
    if (!open_.empty())
      Fail(open_.back().first, "'" + std::string(open_.back().second.substr(0, 64)) + "' is not closed: the file is cut off");
  }
  size_t Offset(std::string_view part) const { return static_cast<size_t>(part.data() - text_.data()); }

  double Number(std::string_view part) const {
    const size_t begin = part.find_first_not_of(" \t\r\n");
    std::string_view trimmed = begin == std::string_view::npos ? std::string_view() : part.substr(begin);
    trimmed = trimmed.substr(0, trimmed.find_last_not_of(" \t\r\n") + 1);
    double value = 0;
    const auto [end, error] = std::from_chars(trimmed.data(), trimmed.data() + trimmed.size(), value);
    if (error != std::errc() || end != trimmed.data() + trimmed.size() || !(std::fabs(value) <= 1e7))
      Fail(Offset(part), "'" + std::string(trimmed.substr(0, 64)) + "' is not a number");
    return value;
  }
  // Value of an attribute of a tag.
  double Attribute(std::string_view tag, const std::string& name) const {
    for (const char quote : {'"', '\''}) {
      const size_t found = tag.find(" " + name + "=" + quote);
      if (found == std::string_view::npos) continue;
      const size_t begin = found + name.size() + 3, end = tag.find(quote, begin);
      if (end != std::string_view::npos) return Number(tag.substr(begin, end - begin));
    }
    Fail(Offset(tag), "attribute '" + name + "' is missing");
  }

 private:
  // The > that ends a tag: one in quotes belongs to an attribute.
  size_t EndOfTag(size_t open) const {
    char quote = 0;
    for (size_t i = open; i < text_.size(); ++i) {
      const char c = text_[i];
      if (quote != 0) {
        if (c == quote) quote = 0;
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '>') {
        return i;
      }
    }
    return std::string_view::npos;
  }
  void Nest(size_t at, std::string_view tag) {
    const bool closes = tag.starts_with("/");
    if (closes) tag.remove_prefix(1);
    const std::string_view element = tag.substr(0, tag.find_first_of(" \t\r\n/"));
    if (!closes) {
      if (!tag.ends_with("/")) open_.emplace_back(at, element);
      return;
    }
    if (open_.empty() || open_.back().second != element) Fail(at, "'" + std::string(element.substr(0, 64)) + "' is closed, but not open");
    open_.pop_back();
  }

  std::string_view text_, name_;
  size_t at_ = 0, counted_ = 0, line_ = 1;
  std::vector<std::pair<size_t, std::string_view>> open_;  // elements and where they begin
};

struct Found {
  GeoPoint point;
  size_t line;
  size_t at;
  bool has_altitude = false;
};

// Name of a tag without prefix: "gpx:wpt lat=…" is wpt.
std::string_view NameOf(std::string_view tag) {
  tag = tag.substr(0, tag.find_first_of(" \t\r\n/", tag.starts_with("/") ? 1 : 0));
  const bool closing = tag.starts_with("/");
  const size_t colon = tag.find(':');
  if (colon == std::string_view::npos) return tag;
  return closing ? tag : tag.substr(colon + 1);
}

void CheckPlace(const Reader& reader, size_t at, const GeoPoint& p) {
  if (std::fabs(p.latitude_deg) <= 90 && std::fabs(p.longitude_deg) <= 360) return;
  char text[96];
  std::snprintf(text, sizeof(text), "latitude %.9g or longitude %.9g is out of range", p.latitude_deg, p.longitude_deg);
  reader.Fail(at, text);
}

// lon,lat[,alt] with white space between.
void ReadCoordinates(Reader& reader, std::string_view text, std::vector<Found>& points) {
  for (size_t at = 0;;) {
    at = text.find_first_not_of(" \t\r\n", at);
    if (at == std::string_view::npos) return;
    const size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
    std::string_view tuple = text.substr(at, end - at);
    const size_t place = reader.Offset(tuple);
    double values[3] = {0, 0, 0};
    int count = 0;
    for (size_t from = 0; from <= tuple.size(); ++count) {
      const size_t comma = std::min(tuple.find(',', from), tuple.size());
      if (count == 3) reader.Fail(place, "more than lon,lat,alt");
      values[count] = reader.Number(tuple.substr(from, comma - from));
      from = comma + 1;
    }
    if (count < 2) reader.Fail(place, "lon,lat[,alt] is needed");
    const GeoPoint p{values[1], values[0], values[2]};
    CheckPlace(reader, place, p);
    points.push_back({p, reader.Line(place), place, true});  // KML's altitude is 0 unless given
    if (points.size() > kMaxPoints) reader.Fail(place, "more than 1,000,000 points");
    at = end;
  }
}

std::vector<Found> FindPoints(Reader& reader) {
  std::vector<Found> points;
  std::string_view before, tag;
  bool in_elevation = false, in_coordinates = false, in_point = false;
  while (reader.Next(before, tag)) {
    const std::string_view name = NameOf(tag);
    if (in_elevation && in_point) {
      points.back().point.altitude = reader.Number(before);
      points.back().has_altitude = true;
    }
    if (in_coordinates) ReadCoordinates(reader, before, points);
    in_elevation = name == "ele";
    in_coordinates = name == "coordinates" && !tag.ends_with("/");
    if (name == "wpt" || name == "rtept" || name == "trkpt") {
      const GeoPoint p{reader.Attribute(tag, "lat"), reader.Attribute(tag, "lon"), 0};
      CheckPlace(reader, reader.Offset(tag), p);
      points.push_back({p, reader.Line(reader.Offset(tag)), reader.Offset(tag)});
      if (points.size() > kMaxPoints) reader.Fail(reader.Offset(tag), "more than 1,000,000 points");
      in_point = true;
    }
  }
  reader.CheckEnd();
  for (const Found& found : points) {
    if (found.has_altitude != points.front().has_altitude)
      reader.Fail((found.has_altitude ? points.front() : found).at, "no height (ele), which other points have");
  }
  return points;
}

}  // namespace

std::vector<Waypoint> ParseRouteXml(std::string_view text, std::string_view name, const std::optional<GeoPoint>& origin) {
  Reader reader(text, name);
  const std::vector<Found> points = FindPoints(reader);
  if (points.empty()) throw InputError(std::string(name) + ": no points (wpt, rtept, trkpt or coordinates)");
  const GeoPoint first = points.front().point;
  const GeoFrame frame(origin.value_or(GeoPoint{first.latitude_deg, first.longitude_deg, 0}));
  std::vector<Waypoint> waypoints;
  for (const Found& found : points) {
    Waypoint w;
    w.p = frame.ToWorld(found.point);
    w.line = found.line;
    waypoints.push_back(w);
  }
  return waypoints;
}

}  // namespace airsim360

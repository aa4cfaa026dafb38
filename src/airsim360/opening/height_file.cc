#include "airsim360/opening/height_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/process.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double kMostCells = 1 << 26;
constexpr int64_t kManyCells = 1 << 22;
constexpr int kUnknown = -99999;

// Runs one of GDAL's programs; what it prints goes to `out`, what it complains of to `log`.
int Run(const std::vector<std::string>& words, const fs::path& out, const fs::path& log) {
  const auto end = RunProgram(words, {.out = out, .complaints = log, .seconds = 3600});
  if (!end) throw RuntimeError(words[0] + " is not installed: it reads GeoTIFF heights; install it with 'apt install gdal-bin'");
  return end->status;
}

// Degrees and cells of a raster with north up.
struct Cells {
  double west = 0, north = 0, lon = 0, lat = 0;  // outer corner, degrees a cell
  int64_t columns = 0, rows = 0;
};

// Into how many a cell is cut along each side.
struct Refinement {
  int lon = 1, lat = 1;
};

// How stored numbers become metres.
struct Scale {
  double factor = 1, offset = 0;
};

class HeightReader {
 public:
  explicit HeightReader(const fs::path& file) : name_(file.string()), file_(fs::absolute(file).string()) {}

  HeightGrid Read(const GeoBox& area) {
    const Json source = Info(file_, {"-if", "GTiff"});
    const Scale scale = ScaleOf(source);
    if (!source.contains("coordinateSystem") || source["coordinateSystem"].value("wkt", "").empty() || !source.contains("geoTransform"))
      throw Bad(
          "has no place on the Earth (no coordinate system); 'gdal_translate -a_srs EPSG:… -a_ullr WEST NORTH EAST SOUTH' gives it one");
    // The whole file as GDAL would lay it in degrees, without reading a height.
    const std::string whole = (scratch_.path() / "whole.vrt").string();
    Warp({"-of", "VRT", "-t_srs", "EPSG:4326"}, file_, whole);
    const Json turned = Info(whole, {});
    const bool same = turned["geoTransform"] == source["geoTransform"];
    const Cells all = CellsOf(turned);
    if (same) return Fetch(Cut(all, area, {1, 1}), "near", scale);
    // GDAL's cells are as wide as high in degrees: a quarter (a half, where those are many) of the file's metres both
    // ways is more along the meridian.
    const double wide = std::sqrt(std::cos((area.south + area.north) / 2 * M_PI / 180));
    const auto cut = [&](double parts) {
      return Cut(all, area, {static_cast<int>(std::ceil(parts * wide)), static_cast<int>(std::ceil(parts / wide))});
    };
    const Cells half = cut(2);
    return Fetch(half.columns * half.rows < kManyCells ? cut(4) : half, "bilinear", scale);
  }

 private:
  InputError Bad(const std::string& what) const { return InputError(name_ + ": " + what); }

  std::string FirstComplaint() const {
    std::string words = ReadTextFile(log(), 1 << 20);
    // GDAL begins with "ERROR 4: ".
    if (const size_t at = words.find("ERROR "); at != std::string::npos)
      words.erase(0, std::min(words.find(' ', at + 6), words.size() - 1) + 1);
    if (const size_t end = words.find('\n'); end != std::string::npos) words.resize(end);
    return words;
  }

  Json Info(const std::string& file, const std::vector<std::string>& flags) const {
    std::vector<std::string> words{"gdalinfo", "-json", "-nomd"};
    words.insert(words.end(), flags.begin(), flags.end());
    words.push_back(file);
    if (Run(words, out(), log()) != 0) throw Bad("not a GeoTIFF of heights: " + FirstComplaint());
    const Json info = Json::parse(ReadTextFile(out(), 64 << 20), nullptr, false);
    if (!info.is_object()) throw Bad("gdalinfo gave no JSON");
    return info;
  }

  void Warp(const std::vector<std::string>& flags, const std::string& from, const std::string& to) const {
    std::vector<std::string> words{"gdalwarp", "-q", "-overwrite", "-ot", "Float32", "-dstnodata", std::to_string(kUnknown)};
    if (from == file_) words.insert(words.end(), {"-if", "GTiff"});
    words.insert(words.end(), flags.begin(), flags.end());
    words.insert(words.end(), {from, to});
    if (Run(words, "/dev/null", log()) != 0) throw Bad("its heights cannot be read: " + FirstComplaint());
  }

  Scale ScaleOf(const Json& info) const {
    const Json& bands = info.contains("bands") ? info["bands"] : Json::array();
    if (bands.empty()) throw Bad("has no band");
    const Json& band = bands[0];
    const std::string colour = band.value("colorInterpretation", ""), type = band.value("type", "");
    if (colour == "Red" || colour == "Palette") throw Bad("its first band is colour ('" + colour + "'), not heights");
    if (type.starts_with("C")) throw Bad("its first band holds complex numbers ('" + type + "'), not heights");
    Scale scale{band.value("scale", 1.0), band.value("offset", 0.0)};
    std::string unit = band.value("unit", "");
    for (char& c : unit) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (unit.starts_with("ft") || unit.find("foot") != std::string::npos || unit.find("feet") != std::string::npos) {
      scale.factor *= 0.3048;
      scale.offset *= 0.3048;
    }
    return scale;
  }

  Cells CellsOf(const Json& info) const {
    const Json& t = info["geoTransform"];
    const Cells cells{t[0], t[3], t[1], -t[5].get<double>(), info["size"][0], info["size"][1]};
    if (!(cells.lon > 0) || !(cells.lat > 0) || cells.columns < 1 || cells.rows < 1) throw Bad("has no cells on the Earth");
    return cells;
  }

  // What of `all` an area needs, in smaller cells.
  Cells Cut(const Cells& all, const GeoBox& area, Refinement refine) const {
    const auto cell = [](double place, int64_t most) {
      return static_cast<int64_t>(std::clamp(std::floor(place), 0.0, static_cast<double>(most)));
    };
    const int64_t x0 = cell((area.west - all.west) / all.lon - 1, all.columns),
                  x1 = cell((area.east - all.west) / all.lon + 2, all.columns), y0 = cell((all.north - area.north) / all.lat - 1, all.rows),
                  y1 = cell((all.north - area.south) / all.lat + 2, all.rows);
    if (x0 >= x1 || y0 >= y1)
      throw Bad("covers latitude " + std::to_string(all.north - all.lat * static_cast<double>(all.rows)) + " to " +
                std::to_string(all.north) + ", longitude " + std::to_string(all.west) + " to " +
                std::to_string(all.west + all.lon * static_cast<double>(all.columns)) + "; the map lies at " +
                std::to_string((area.south + area.north) / 2) + ", " + std::to_string((area.west + area.east) / 2));
    const Cells cut{all.west + all.lon * static_cast<double>(x0),
                    all.north - all.lat * static_cast<double>(y0),
                    all.lon / refine.lon,
                    all.lat / refine.lat,
                    (x1 - x0) * refine.lon,
                    (y1 - y0) * refine.lat};
    const double count = static_cast<double>(cut.columns) * static_cast<double>(cut.rows);
    if (count > kMostCells)
      throw Bad("gives " + std::to_string(std::llround(count / 1e6)) + " million cells for the map; at most " +
                std::to_string(std::llround(kMostCells / 1e6)) + " million: make them larger with 'gdal_translate -tr'");
    return cut;
  }

  HeightGrid Fetch(const Cells& cut, const std::string& filter, Scale scale) const {
    const auto degrees = [](double x) {
      std::array<char, 40> text{};
      std::snprintf(text.data(), text.size(), "%.17g", x);
      return std::string(text.data());
    };
    const fs::path raw = scratch_.path() / "heights.bin";
    Warp({"-of", "ENVI", "-r", filter, "-t_srs", "EPSG:4326", "-te", degrees(cut.west),
          degrees(cut.north - cut.lat * static_cast<double>(cut.rows)), degrees(cut.west + cut.lon * static_cast<double>(cut.columns)),
          degrees(cut.north), "-ts", std::to_string(cut.columns), std::to_string(cut.rows)},
         file_, raw.string());
    HeightGrid grid{static_cast<int>(cut.columns), static_cast<int>(cut.rows), cut.west, cut.north, cut.lon, cut.lat, {}};
    grid.heights.resize(static_cast<size_t>(cut.columns) * static_cast<size_t>(cut.rows));
    const Bytes data = ReadFile(raw, uint64_t{1} << 32);  // all bands, one after the other
    if (data.size() < grid.heights.size() * sizeof(float)) throw Bad("gdalwarp gave too few heights");
    std::memcpy(grid.heights.data(), data.data(), grid.heights.size() * sizeof(float));
    bool known = false;
    for (float& h : grid.heights) {
      const double metres = static_cast<double>(h) * scale.factor + scale.offset;
      const bool sound = h != static_cast<float>(kUnknown) && std::abs(metres) < 12000;
      h = sound ? static_cast<float>(metres) : std::numeric_limits<float>::quiet_NaN();
      known |= sound;
    }
    if (!known)
      throw Bad("knows no height where the map lies (latitude " + std::to_string(cut.north) + ", longitude " + std::to_string(cut.west) +
                ")");
    return grid;
  }

  fs::path out() const { return scratch_.path() / "out"; }
  fs::path log() const { return scratch_.path() / "log"; }

  std::string name_, file_;
  ScratchFolder scratch_{"heights"};
};

}  // namespace

HeightGrid ReadHeights(const fs::path& file, const GeoBox& area) {
  if (!fs::is_regular_file(file)) throw InputError(file.string() + ": no such file");
  return HeightReader(file).Read(area);
}

}  // namespace airsim360

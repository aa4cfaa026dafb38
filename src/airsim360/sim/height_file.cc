#include "airsim360/sim/height_file.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

extern char** environ;

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

constexpr double kMostCells = 1 << 26;
constexpr float kUnknown = -99999;

// A folder that goes away with its object.
struct ScratchFolder {
  ScratchFolder() {
    std::string pattern = (fs::temp_directory_path() / "airsim360_heights_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw RuntimeError("cannot create a folder in " + fs::temp_directory_path().string());
    path = pattern;
  }
  ~ScratchFolder() {
    std::error_code error;
    fs::remove_all(path, error);
  }
  fs::path path;
};

// Runs a program without a shell; its words go to `log`.
int Run(const std::vector<std::string>& words, const fs::path& log) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed) throw RuntimeError(words[0] + " is not installed: it reads GeoTIFF heights; install it with 'apt install gdal-bin'");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

// "key = value" of an ENVI header.
std::optional<std::string> HeaderValue(const std::string& header, const std::string& key) {
  std::istringstream lines(header);
  std::string line;
  while (std::getline(lines, line)) {
    const size_t equals = line.find('=');
    if (equals == std::string::npos || line.compare(0, key.size(), key) != 0) continue;
    return line.substr(equals + 1);
  }
  return std::nullopt;
}

HeightGrid ParseGrid(const std::string& where, const std::string& header, const Bytes& data) {
  HeightGrid grid;
  const auto bad = [&](const char* what) { return InputError(where + ": " + what); };
  try {
    grid.columns = std::stoi(HeaderValue(header, "samples").value_or("0"));
    grid.rows = std::stoi(HeaderValue(header, "lines").value_or("0"));
  } catch (const std::exception&) {
    throw bad("gdalwarp gave an unreadable header");
  }
  // {Geographic Lat/Lon, 1, 1, west, north, cell, cell, …}
  std::string map = HeaderValue(header, "map info").value_or("");
  const size_t open = map.find('{');
  std::vector<double> numbers;
  std::istringstream fields(open == std::string::npos ? "" : map.substr(open + 1));
  std::string field;
  std::getline(fields, field, ',');
  while (numbers.size() < 6 && std::getline(fields, field, ',')) numbers.push_back(std::strtod(field.c_str(), nullptr));
  if (grid.columns < 1 || grid.rows < 1 || numbers.size() < 6 || !(numbers[4] > 0) || !(numbers[5] > 0))
    throw bad("has no place on the Earth (no coordinate system)");
  grid.longitude_west = numbers[2];
  grid.latitude_north = numbers[3];
  grid.cell_lon = numbers[4];
  grid.cell_lat = numbers[5];
  const size_t cells = static_cast<size_t>(grid.columns) * static_cast<size_t>(grid.rows);
  if (static_cast<double>(cells) > kMostCells) throw bad("has more than 67 million cells; cut it with gdal_translate -projwin");
  if (data.size() < cells * sizeof(float)) throw bad("gdalwarp gave too few heights");
  grid.heights.resize(cells);
  std::memcpy(grid.heights.data(), data.data(), cells * sizeof(float));
  for (float& h : grid.heights)
    if (!(std::abs(h) < 12000)) h = std::numeric_limits<float>::quiet_NaN();
  return grid;
}

}  // namespace

HeightGrid ReadHeights(const fs::path& file) {
  if (!fs::is_regular_file(file)) throw InputError(file.string() + ": no such file");
  const ScratchFolder scratch;
  const fs::path out = scratch.path / "heights.bin", log = scratch.path / "log";
  const int status = Run({"gdalwarp", "-q", "-if", "GTiff", "-t_srs", "EPSG:4326", "-r", "bilinear", "-ot", "Float32",
                          "-dstnodata", std::to_string(kUnknown), "-of", "ENVI", fs::absolute(file).string(), out.string()},
                         log);
  if (status != 0) {
    std::string words = ReadTextFile(log, 1 << 20);
    if (const size_t end = words.find('\n'); end != std::string::npos) words.resize(end);
    throw InputError(file.string() + ": not a GeoTIFF of heights: " + words);
  }
  const fs::path header = scratch.path / "heights.hdr";
  return ParseGrid(file.string(), ReadTextFile(header, 1 << 20), ReadFile(out, uint64_t{1} << 29));
}

}  // namespace airsim360

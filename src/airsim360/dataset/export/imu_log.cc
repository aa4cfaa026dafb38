#include "airsim360/dataset/export/imu_log.h"

#include <charconv>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360::internal {

namespace fs = std::filesystem;

fs::path FindImu(const fs::path& dataset) {
  const fs::path folder = fs::weakly_canonical(dataset);
  for (const fs::path& path : {folder / "imu.csv", folder.parent_path() / "imu.csv", folder.parent_path() / "sensors" / "imu.csv"}) {
    if (fs::exists(path)) return path;
  }
  return {};
}

std::vector<ImuRow> ReadImu(const fs::path& path) {
  const std::string text = ReadTextFile(path);
  std::vector<ImuRow> rows;
  int64_t number = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (++number == 1 || line.empty()) continue;  // names of columns
    double values[7] = {};
    const char *at = line.data(), *last = line.data() + line.size();
    bool good = true;
    ImuRow row;
    for (int i = 0; i < 7 && good; ++i) {
      const auto [rest, error] = std::from_chars(at, last, values[i]);
      good = error == std::errc() && std::isfinite(values[i]) && (i == 6 ? rest == last : rest != last && *rest == ',');
      if (i == 0 && good) row.text.assign(rest + 1, last);
      at = good && i < 6 ? rest + 1 : rest;
    }
    if (!good) throw InputError(path.string() + ":" + std::to_string(number) + ": '" + line + "' is no row 't_s,wx,wy,wz,fx,fy,fz'");
    row.t_ns = std::llround(values[0] * 1e9);
    row.w = {values[1], values[2], values[3]};
    row.f = {values[4], values[5], values[6]};
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace airsim360::internal

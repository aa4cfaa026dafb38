// GeoTIFF heights by way of GDAL: against the heights written into the files.
#include "airsim360/opening/height_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

constexpr double kWest = 13.30, kSouth = 52.50, kCell = 0.001;
constexpr int kColumns = 60, kRows = 40;
const GeoBox kArea{13.32, 52.51, 13.34, 52.53};

double HeightAt(int column, int row) { return 35 + ((column * 7 + row * 13) % 29); }

class HeightFile : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("gdal_translate --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "gdal-bin is not installed";
    folder_ = fs::temp_directory_path() / ("airsim360_height_file_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // A GeoTIFF of HeightAt with one unknown cell (30, 20), by way of a text grid.
  fs::path Tiff(const std::string& name, double west, double south, double cell, const std::string& flags) {
    const fs::path text = folder_ / (name + ".asc"), tiff = folder_ / (name + ".tif");
    std::ofstream out(text);
    out.precision(12);
    out << "ncols " << kColumns << "\nnrows " << kRows << "\nxllcorner " << west << "\nyllcorner " << south << "\ncellsize " << cell
        << "\nNODATA_value -9999\n";
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column)
        out << (row == 20 && column == 30 ? -9999 : HeightAt(column, row)) << (column + 1 < kColumns ? " " : "\n");
    out.close();
    const std::string command = "gdal_translate -q " + flags + " '" + text.string() + "' '" + tiff.string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return tiff;
  }
  std::string ErrorOf(const fs::path& file, const GeoBox& area = kArea) {
    try {
      ReadHeights(file, area);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  static void ExpectSays(const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << message;
  }

  fs::path folder_;
};

// Every cell that the grid holds, exactly.
void ExpectCells(const HeightGrid& grid) {
  ASSERT_NEAR(grid.cell_lon, kCell, 1e-9);
  int unknown = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const auto source_column = static_cast<int>(std::lround((grid.longitude_west - kWest) / kCell)) + column;
      const auto source_row = static_cast<int>(std::lround((kSouth + kRows * kCell - grid.latitude_north) / kCell)) + row;
      const float h = grid.heights[static_cast<size_t>(row * grid.columns + column)];
      if (!std::isfinite(h)) {
        ++unknown;
        EXPECT_EQ(source_column, 30);
        EXPECT_EQ(source_row, 20);
        continue;
      }
      ASSERT_EQ(static_cast<double>(h), HeightAt(source_column, source_row)) << source_column << " " << source_row;
    }
  EXPECT_EQ(unknown, 1);
}

TEST_F(HeightFile, DegreesKeepTheirCellsAndAreCutToTheArea) {
  for (const char* type : {"Float32", "Int16"}) {
    const HeightGrid grid = ReadHeights(Tiff(type, kWest, kSouth, kCell, std::string("-a_srs EPSG:4326 -ot ") + type), kArea);
    EXPECT_LE(grid.columns, 24);
    EXPECT_LE(grid.rows, 24);
    EXPECT_LT(grid.longitude_west, kArea.west);
    EXPECT_GT(grid.latitude_north, kArea.north);
    ExpectCells(grid);
  }
}

TEST_F(HeightFile, MetresOfAProjectionComeInSmallerCells) {
  // UTM 33 N: the area's middle is at about x 386,600, y 5,820,000.
  const HeightGrid grid = ReadHeights(Tiff("utm", 385'000, 5'818'000, 100, "-a_srs EPSG:32633 -ot Float32"), {13.32, 52.51, 13.335, 52.52});
  EXPECT_LT(grid.cell_lat * 111'300, 26);
  EXPECT_LT(grid.cell_lon * 111'300 * std::cos(52.5 * M_PI / 180), 26);
  for (float h : grid.heights)
    if (std::isfinite(h)) {
      EXPECT_GE(h, 35);
      EXPECT_LE(h, 64);
    }
}

TEST_F(HeightFile, ScaleAndFeetBecomeMetres) {
  const HeightGrid scaled = ReadHeights(Tiff("scaled", kWest, kSouth, kCell, "-a_srs EPSG:4326 -ot Int16 -a_scale 0.1 -a_offset 5"), kArea);
  const HeightGrid plain = ReadHeights(Tiff("plain", kWest, kSouth, kCell, "-a_srs EPSG:4326"), kArea);
  EXPECT_NEAR(scaled.heights[0], plain.heights[0] * 0.1f + 5, 1e-4);
}

TEST_F(HeightFile, FilesThatAreNoHeightsAreToldWhy) {
  const fs::path good = Tiff("good", kWest, kSouth, kCell, "-a_srs EPSG:4326");
  ExpectSays(ErrorOf(folder_ / "none.tif"), "no such file");
  ExpectSays(ErrorOf(good, {-70, 0, -69.9, 0.1}), "the map lies at 0.05");
  ExpectSays(ErrorOf(Tiff("lost", kWest, kSouth, kCell, "")), "no place on the Earth");
  ExpectSays(ErrorOf(Tiff("colours", kWest, kSouth, kCell, "-a_srs EPSG:4326 -ot Byte -b 1 -b 1 -b 1 -colorinterp red,green,blue")),
             "colour");
  ExpectSays(ErrorOf(good, {13.3301, 52.5191, 13.3303, 52.5193}), "no error");
  std::ofstream(folder_ / "text.tif") << "hello";
  ExpectSays(ErrorOf(folder_ / "text.tif"), "not a GeoTIFF");
  const Bytes bytes = ReadFile(good);
  std::ofstream(folder_ / "cut.tif", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size() / 2));
  ExpectSays(ErrorOf(folder_ / "cut.tif"), "cut.tif: ");
  EXPECT_NE(ErrorOf(folder_ / "cut.tif"), "no error");
}

TEST_F(HeightFile, AFileOfAContinentIsReadWhereTheMapLies) {
  // 36,000 x 18,000 cells that claim 2.6 GB; the area needs a few thousand.
  const fs::path huge = folder_ / "huge.tif";
  const std::string command =
      "gdal_create -q -of GTiff -co SPARSE_OK=TRUE -co TILED=YES -ot Float32 -outsize 36000 18000 -a_srs EPSG:4326 -a_ullr -180 90 180 -90 '" +
      huge.string() + "' 2>/dev/null";
  if (std::system(command.c_str()) != 0) GTEST_SKIP() << "gdal_create makes no sparse files";
  const HeightGrid grid = ReadHeights(huge, {13, 52, 13.5, 52.5});
  EXPECT_LT(grid.columns, 60);
  ExpectSays(ErrorOf(huge, {-170, -80, 170, 80}), "million cells");
}

}  // namespace
}  // namespace airsim360

// Calibrations of several programs, and what is wrong with files.
#include "airsim360/projection/calibration_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

class CalibrationFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("calibration_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::vector<Calibration> Read(const std::string& name, const std::string& text) {
    WriteFileAtomically(folder_ / name, text);
    EXPECT_TRUE(IsCalibration(text, folder_ / name));
    return ReadCalibrations(folder_ / name);
  }
  Camera One(const std::string& name, const std::string& text) {
    const Calibration c = Read(name, text).at(0);
    return MakeCamera(c.model, c.width, c.height, c.parameters);
  }
  void Refused(const std::string& name, const std::string& text, const std::string& says) {
    try {
      Read(name, text);
      FAIL() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
  }
  fs::path folder_;
};

constexpr char kKalibr[] = R"(cam0:
  T_cam_imu:
  - [0.0, -1.0, 0.0, 0.01]
  - [0.0, 0.0, -1.0, 0.02]
  - [1.0, 0.0, 0.0, 0.03]
  - [0.0, 0.0, 0.0, 1.0]
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.28, 0.07, 0.0002, 1.8e-05]
  distortion_model: radtan
  intrinsics: [458.5, 457.5, 367.25, 248.5]
  resolution: [752, 480]
  rostopic: /cam0/image_raw
cam1:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.11]
  - [0.0, 1.0, 0.0, 0.0]
  - [0.0, 0.0, 1.0, 0.0]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: ds
  distortion_coeffs: []
  distortion_model: none
  intrinsics: [-0.18, 0.59, 158.0, 159.0, 254.5, 256.5]
  resolution: [512, 512]
)";

TEST_F(CalibrationFile, KalibrColmapAndOpenCvSpellTheSameCamera) {
  const Camera kalibr = One("camchain.yaml", kKalibr);
  EXPECT_EQ(One("cameras.txt", "# Camera list\n3 OPENCV 752 480 458.5 457.5 367.75 249 -0.28 0.07 0.0002 1.8e-05\n"), kalibr);
  EXPECT_EQ(One("opencv.yaml",
                "%YAML:1.0\n---\nimage_width: 752\nimage_height: 480\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
                "   data: [ 458.5, 0., 367.25, 0., 457.5, 248.5, 0., 0., 1. ]\ndistortion_coefficients: !!opencv-matrix\n   rows: 1\n"
                "   cols: 5\n   dt: d\n   data: [ -0.28, 0.07, 0.0002, 1.8e-05, 0. ]\n"),
            kalibr);
  EXPECT_EQ(One("ros.yaml",
                "image_width: 752\nimage_height: 480\ncamera_name: left\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
                "  data: [458.5, 0, 367.25, 0, 457.5, 248.5, 0, 0, 1]\ndistortion_model: plumb_bob\ndistortion_coefficients:\n"
                "  rows: 1\n  cols: 5\n  data: [-0.28, 0.07, 0.0002, 1.8e-05, 0]\n"),
            kalibr);
  const Camera fisheye = One("fisheye.yaml",
                             "cam0:\n  camera_model: pinhole\n  intrinsics: [190, 191, 254.5, 256.5]\n  distortion_model: equidistant\n"
                             "  distortion_coeffs: [0.0034, 0.0007, -0.002, 0.0002]\n  resolution: [512, 512]\n");
  EXPECT_EQ(One("cameras.txt", "1 OPENCV_FISHEYE 512 512 190 191 255 257 0.0034 0.0007 -0.002 0.0002\n"), fisheye);
  EXPECT_TRUE(std::holds_alternative<Fisheye>(fisheye));
}

TEST_F(CalibrationFile, KalibrsPosesAreThoseOfTheImu) {
  const std::vector<Calibration> cameras = Read("camchain.yaml", kKalibr);
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[1].name, "cam1");
  EXPECT_EQ(cameras[1].model, "DOUBLE_SPHERE");
  EXPECT_EQ(cameras[1].parameters, (std::vector<double>{158, 159, 255, 257, -0.18, 0.59}));
  // cam0 looks along the IMU's +X, with +Z up; its origin in the IMU is -R^T t.
  const RigidTransform X = *cameras[0].X_IC;
  EXPECT_LT(Norm(X.R.column(2) - Vec3d{1, 0, 0}) + Norm(X.R.column(1) - Vec3d{0, 0, -1}), 1e-12);
  EXPECT_LT(Norm(X.p - Vec3d{-0.03, 0.01, 0.02}), 1e-12);
  // cam1 is 11 cm to the right of cam0.
  EXPECT_LT(Norm(cameras[1].X_IC->p - (X * Vec3d{0.11, 0, 0})), 1e-12);
}

TEST_F(CalibrationFile, EveryCombinationOfKalibrHasItsModel) {
  const auto model = [&](const std::string& camera, const std::string& intrinsics, const std::string& distortion, const std::string& coefficients) {
    return Read("c.yaml", "cam0: {camera_model: " + camera + ", intrinsics: [" + intrinsics + "], distortion_model: " + distortion +
                              ", distortion_coeffs: [" + coefficients + "], resolution: [640, 480]}\n")
        .at(0)
        .model;
  };
  EXPECT_EQ(model("pinhole", "1, 1, 1, 1", "none", ""), "PINHOLE");
  EXPECT_EQ(model("pinhole", "1, 1, 1, 1", "fov", "0.9"), "FOV");
  EXPECT_EQ(model("omni", "1, 1, 1, 1, 1", "radtan", "0, 0, 0, 0"), "OMNI");
  EXPECT_EQ(model("omni", "1, 1, 1, 1, 1", "none", ""), "OMNI");
  EXPECT_EQ(model("eucm", "0.5, 1, 1, 1, 1, 1", "none", ""), "EUCM");
}

TEST_F(CalibrationFile, WhatIsWrongIsNamedWithItsLine) {
  const std::string text = kKalibr;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return changed;
  };
  Refused("a.yaml", with("camera_model: pinhole", "camera_model: pinhol"), "a.yaml:8: cam0: camera_model: unknown camera_model 'pinhol'; did you mean 'pinhole'");
  Refused("a.yaml", with("[458.5, 457.5, 367.25, 248.5]", "[458.5, 457.5, 367.25]"), "a.yaml:11: cam0: intrinsics: expected 4 numbers");
  Refused("a.yaml", with("[458.5,", "[x,"), "a.yaml:11: cam0: intrinsics: expected a number, found 'x'");
  Refused("a.yaml", with("distortion_coeffs: [-0.28, 0.07, 0.0002, 1.8e-05]", "distortion_coeffs: [-0.28]"), "expected 4 numbers (k1, k2, p1, p2), found 1");
  Refused("a.yaml", with("distortion_model: none", "distortion_model: radtan"), "does not go with camera_model 'ds'");
  Refused("a.yaml", with("resolution: [752, 480]", "resolution: [752, 0]"), "a.yaml:12");
  Refused("a.yaml", with("- [0.0, -1.0, 0.0, 0.01]", "- [0.0, -1.1, 0.0, 0.01]"), "T_cam_imu: is no rotation");
  Refused("a.yaml", with("rostopic", "rostopix"), "did you mean 'rostopic'");
  Refused("cameras.txt", "1 OPENCV 752 480 a\n", "cameras.txt:1: 'a' is not a number");
  Refused("cameras.txt", "# Camera list\n\n1 OPENCV 752\n", "cameras.txt:3: expected CAMERA_ID");
  Refused("cameras.txt", "# Camera list\n", "no cameras");
  const std::string opencv = "image_width: 64\nimage_height: 48\ncamera_matrix: [[50, 0, 32], [0, 50, 24], [0, 0, 1]]\n";
  Refused("b.yaml", opencv + "distortion_coefficients: [0, 0, 0]\n", "b.yaml:4: distortion_coefficients: OpenCV has 4, 5, 8, 12 or 14");
  Refused("b.yaml", opencv + "distortion_coefficients: [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.1, 0]\n", "tilted");
  Refused("b.yaml", "image_width: 64\nimage_height: 48\ncamera_matrix: [[50, 1, 32], [0, 50, 24], [0, 0, 1]]\n", "b.yaml:3: camera_matrix");
}

}  // namespace
}  // namespace airsim360

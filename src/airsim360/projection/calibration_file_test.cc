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
  const auto model = [&](const std::string& camera, const std::string& intrinsics, const std::string& distortion,
                         const std::string& coefficients) {
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
  Refused("a.yaml", with("camera_model: pinhole", "camera_model: pinhol"),
          "a.yaml:8: cam0: camera_model: unknown camera_model 'pinhol'; did you mean 'pinhole'");
  Refused("a.yaml", with("[458.5, 457.5, 367.25, 248.5]", "[458.5, 457.5, 367.25]"), "a.yaml:11: cam0: intrinsics: expected 4 numbers");
  Refused("a.yaml", with("[458.5,", "[x,"), "a.yaml:11: cam0: intrinsics: expected a number, found 'x'");
  Refused("a.yaml", with("distortion_coeffs: [-0.28, 0.07, 0.0002, 1.8e-05]", "distortion_coeffs: [-0.28]"),
          "expected 4 numbers (k1, k2, p1, p2), found 1");
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

// A camera of a chain, one metre to the right of the one before; `pose` is its key.
std::string ChainCamera(int number, const std::string& pose, double metres) {
  return "cam" + std::to_string(number) + ":\n  camera_model: pinhole\n  intrinsics: [60, 60, 39.5, 29.5]\n  distortion_model: none\n" +
         "  resolution: [80, 60]\n" +
         (pose.empty() ? "" : "  " + pose + ": [[1, 0, 0, " + std::to_string(metres) + "], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n");
}

TEST_F(CalibrationFile, ChainsGoByNumberWhateverTheOrderOfTheFile) {
  for (const std::vector<int>& order :
       {std::vector{0, 1, 10, 11, 2, 3, 4, 5, 6, 7, 8, 9}, std::vector{11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0}}) {
    std::string text;
    for (const int number : order) text += ChainCamera(number, number > 0 ? "T_cn_cnm1" : "", -number);
    const std::vector<Calibration> cameras = Read("c.yaml", text);
    ASSERT_EQ(cameras.size(), order.size());
    for (size_t i = 0; i < order.size(); ++i) {
      EXPECT_EQ(cameras[i].name, "cam" + std::to_string(order[i]));
      // 1 + 2 + … + n metres to the right.
      EXPECT_LT(Norm(cameras[i].X_IC->p - Vec3d{0, -order[i] * (order[i] + 1) / 2.0, 0}), 1e-12);
    }
  }
}

TEST_F(CalibrationFile, AChainWithAGapIsRefused) {
  Refused("c.yaml", ChainCamera(0, "", 0) + ChainCamera(2, "T_cn_cnm1", -1),
          "cam2: T_cn_cnm1: it says where cam2 stands to cam1, and the file has no cam1");
  Refused("c.yaml", ChainCamera(1, "T_cn_cnm1", -1), "the file has no cam0");
  Refused("c.yaml", ChainCamera(0, "", 0) + ChainCamera(1, "", 0), "cam1: key 'T_cn_cnm1' is missing");
  Refused("c.yaml", ChainCamera(0, "", 0) + "cam00" + ChainCamera(0, "", 0).substr(4), "two cameras of the number 0");
  // With the poses of an IMU nothing is missing; what hangs on such a camera, before or after it, goes with it.
  EXPECT_EQ(Read("c.yaml", ChainCamera(0, "T_cam_imu", 0) + ChainCamera(2, "T_cam_imu", -1)).size(), 2u);
  const std::vector<Calibration> cameras =
      Read("c.yaml", ChainCamera(0, "", 0) + ChainCamera(1, "T_cn_cnm1", -1) + ChainCamera(2, "T_cn_cnm1", -1) +
                         "  T_cam_imu: [[1, 0, 0, -5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n");
  for (size_t i = 0; i < 3; ++i) EXPECT_LT(Norm(cameras[i].X_IC->p - Vec3d{3.0 + static_cast<double>(i), 0, 0}), 1e-12);
  EXPECT_EQ(Read("c.yaml", ChainCamera(1, "", 0)).at(0).X_IC->R.m, CameraInBody().R.m);
}

TEST_F(CalibrationFile, PosesOfOpenVinsAreTheInverseOfKalibrs) {
  std::string text = kKalibr;
  text.replace(text.find("T_cam_imu"), 9, "T_imu_cam");
  const RigidTransform kalibr = *Read("a.yaml", kKalibr).at(0).X_IC, openvins = *Read("b.yaml", text).at(0).X_IC;
  EXPECT_LT(Norm((kalibr * openvins).p), 1e-12);
  EXPECT_LT(Norm(openvins.p - Vec3d{0.01, 0.02, 0.03}), 1e-12);
  Refused("b.yaml", ChainCamera(0, "T_imu_cam", 0) + ChainCamera(0, "T_cam_imu", 0).substr(ChainCamera(0, "", 0).size()),
          "give one of them");
  EXPECT_NO_THROW(Read("b.yaml", ChainCamera(0, "", 0) + "  line_delay: 2.0e-05\n"));
}

constexpr char kRos[] = R"(image_width: 64
image_height: 48
camera_name: left
camera_matrix:
  rows: 3
  cols: 3
  data: [50, 0, 32, 0, 51, 24, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.1, 0.02, 0, 0, 0]
)";

std::string With(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST_F(CalibrationFile, NamesOfRosBecomeNamesOfFiles) {
  const auto name = [&](const std::string& written) { return Read("ros.yaml", With(kRos, "left", written)).at(0).name; };
  EXPECT_EQ(name("''"), "camera");
  EXPECT_EQ(name("rgb_PS1080_PrimeSense"), "rgb_ps1080_primesense");
  EXPECT_EQ(name("head-camera/left"), "head_camera_left");
  EXPECT_EQ(name("größe"), "gr__e");
  EXPECT_EQ(name(std::string(40, 'x')), std::string(32, 'x'));
}

TEST_F(CalibrationFile, OpenCvsXmlIsItsYaml) {
  const std::string xml =
      "<?xml version=\"1.0\"?>\n<opencv_storage>\n<!-- a\ncomment -->\n<calibration_time>\"it's <late>\"</calibration_time>\n<image_width>64</image_width>\n"
      "<image_height>48</image_height>\n<camera_matrix type_id=\"opencv-matrix\">\n  <rows>3</rows>\n  <cols>3</cols>\n  <dt>d</dt>\n  <data>\n"
      "    50. 0. 32. 0.\n    51. 24. 0. 0. 1.</data></camera_matrix>\n<distortion_coefficients type_id=\"opencv-matrix\"><rows>5</rows><cols>1</cols>"
      "<dt>d</dt>\n<data>-0.1 0.02 0. 0. 0.</data></distortion_coefficients>\n<points><_>\n 1. 2.</_><_>3.</_></points><none/></opencv_storage>\n";
  const std::string plain = With(xml, "\"it's <late>\"", "\"it's late\"");
  EXPECT_EQ(One("a.xml", plain), One("a.yaml", kRos));
  Refused("a.xml", With(plain, "51. 24.", "51. x"), "a.xml:14: camera_matrix: expected a number, found 'x'");
  Refused("a.xml", With(plain, "<rows>5", "<rows>6"), "a.xml:15: distortion_coefficients: '6' rows of '1' columns, but data has 5 numbers");
  Refused("a.xml", plain.substr(0, 200), "a.xml:");
  Refused("a.xml", "<?xml version=\"1.0\"?>\n<calibration></calibration>\n", "a.xml:2: is XML, but not OpenCV's");
  std::string deep = "<opencv_storage>";
  for (int i = 0; i < 20000; ++i) deep += "<a>";
  Refused("a.xml", deep, "nested more than 32 deep");
}

TEST_F(CalibrationFile, OpenCvAndRosMistakesAreNamed) {
  Refused("r.yaml", With(kRos, "cols: 3", "cols: 4"), "r.yaml:5: camera_matrix: '3' rows of '4' columns, but data has 9 numbers");
  Refused("r.yaml", With(kRos, "distortion_coefficients", "distortion_coefficents"),
          "r.yaml:9: key 'distortion_coefficients' is missing; is it meant by 'distortion_coefficents'?");
  Refused("r.yaml", With(kRos, "camera_matrix", "camera_matrx"),
          "r.yaml:4: key 'camera_matrix' is missing; is it meant by 'camera_matrx'?");
  Refused("r.yaml", With(kRos, "image_height: 48\n", ""), "r.yaml:1: key 'image_height' is missing");
  Refused("r.yaml", std::string(kRos) + "image_width: 65\n", "r.yaml:13: key 'image_width' is given twice, first in line 1");
}

TEST_F(CalibrationFile, FilesThatAreNoneSayWhatTheyAre) {
  const auto says = [&](const std::string& name, const std::string& text, const std::string& what) {
    try {
      WriteFileAtomically(folder_ / name, text);
      IsCalibration(text, folder_ / name);
      FAIL() << text.substr(0, 100);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  says("cameras.bin", std::string(64, '\0'), "model_converter --output_type TXT");
  says("a.yaml", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16), "is binary, not text");
  says("a.yaml", "cam0:\n\tcamera_model: pinhole\n", "a.yaml:2: is indented with a tab");
  says("a.yaml", "cam0:\n  rostopic: " + std::string(40, '[') + std::string(40, ']') + "\n",
       "a.yaml:2: lists and mappings are nested more than 32 deep");
  says("a.yaml", "cam0: " + std::string(200000, '[') + "\n", "nested more than 32 deep");
  says("a.yaml", "cam0:\n  intrinsics: [1, 2\n", "the list that begins in line 2 is cut off: its ']' is missing");
  says("a.yaml", "cam0:\n  resolution: [8, 6]\n  resolution: [8, 6]\n", "a.yaml:3: key 'resolution' is given twice, first in line 2");
  // A rig of our own is none.
  EXPECT_FALSE(IsCalibration("cameras:\n  - {name: a}\n", folder_ / "rig.yaml"));
}

TEST_F(CalibrationFile, FormatsThatAreKnownAndNotReadSayWhatToWrite) {
  const std::pair<const char*, const char*> kFiles[] = {{"model_type: MEI\nmirror_parameters: {xi: 1}\n", "camodocal"},
                                                        {"model_type: PINHOLE\nprojection_parameters: {fx: 1}\n", "camodocal"},
                                                        {"Camera.type: \"PinHole\"\nCamera1.fx: 1\n", "ORB-SLAM"},
                                                        {"image_Width: 64\nCamera_Matrix: []\nDistortion_Coefficients: []\n", "OpenCV 2.4"},
                                                        {"M1: []\nD1: []\n", "stereo"},
                                                        {"sensor_type: camera\nT_BS: {}\ncamera_model: pinhole\n", "T_imu_cam"},
                                                        {"{\"value0\": {\"intrinsics\": [{\"camera_type\": \"ds\"}]}}", "Basalt"},
                                                        {"{\"fl_x\": 1, \"frames\": []}", "nerfstudio"},
                                                        {"{\"frames\": [{\"fl_x\": 1}]}", "nerfstudio"},
                                                        {"{\"rig\": {\"sensors\": []}}", "F_THETA"},
                                                        {"width: 64\ndistortion_model: plumb_bob\nd: []\nk: []\n", "ros2 topic echo"}};
  for (const auto& [text, says] : kFiles) Refused("a.yaml", text, says);
  Refused("a.txt", "#polynomial coefficients for the DIRECT mapping (ocam_model.ss)\n5 1 2 3 4 5\n", "OCamCalib");
}

TEST_F(CalibrationFile, ColmapsIdsAndModelsAreItsOwn) {
  for (const char* id : {"one", "-1", "99999999999999999999", "4294967295", "1.5"})
    Refused("cameras.txt", std::string(id) + " PINHOLE 64 48 50 50 32 24\n",
            std::string("cameras.txt:1: CAMERA_ID: '") + id + "' is not a whole number from 0 to 4294967294");
  EXPECT_EQ(Read("cameras.txt", "4294967294 PINHOLE 64 48 50 50 32 24\n").at(0).name, "cam4294967294");
  EXPECT_EQ(Read("cameras.txt",
                 "\xef\xbb\xbf"
                 "7 PINHOLE 64 48 50 50 32 24\n")
                .at(0)
                .name,
            "cam7");
  Refused("cameras.txt", "1 EQUIRECTANGULAR 2048 1024 2048 1024\n", "projection: erp, size: 2048x1024");
  Refused("cameras.txt", "1 DIVISION 64 48 50 50 32 24 0.1\n", "DIVISION is not read");
}

TEST_F(CalibrationFile, AWrongParameterIsNamedWithItsOwnLine) {
  const auto says = [&](const std::string& name, const std::string& text, size_t camera, const std::string& what) {
    try {
      MakeCamera(Read(name, text).at(camera), std::nullopt);
      FAIL() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  says("a.yaml", With(kKalibr, "457.5", "-457.5"), 0, "a.yaml:11: camera 'cam0': fy -457.5 is not in");
  says("a.yaml", With(kKalibr, "-0.28", "-0.9"), 0, "a.yaml:9: camera 'cam0': the lens folds over");
  says("a.yaml", With(kKalibr, "0.59", "1.5"), 1, "a.yaml:23: camera 'cam1': camera: alpha 1.5");
  says("r.yaml", With(kRos, "[50,", "[0,"), 0, "r.yaml:7: camera 'left': fx 0");
  says("r.yaml", With(kRos, "[-0.1, 0.02", "[-3, 0"), 0, "r.yaml:12: camera 'left': the lens folds over");
  says("cameras.txt", "# Camera list\n1 OPENCVV 64 48 50 50 32 24\n", 0,
       "cameras.txt:2: camera 'cam1': model: unknown camera model 'OPENCVV'; did you mean 'OPENCV'?");
  says("cameras.txt", "# Camera list\n1 PINHOLE 64 48 50 50 1e9 24\n", 0, "cameras.txt:2: camera 'cam1': cx 1000000000");
}

TEST_F(CalibrationFile, ReflectionsAndRowsAreNamed) {
  Refused("a.yaml", With(kKalibr, "- [1.0, 0.0, 0.0, 0.03]", "- [-1.0, 0.0, 0.0, 0.03]"),
          "a.yaml:3: cam0: T_cam_imu: is a reflection, no rotation: its determinant is -1");
  Refused("a.yaml", With(kKalibr, "1.0, 0.0, 0.0, -0.11", "1.0, 0.0, 0.0, -110"), "are these millimetres?");
  Refused("a.yaml", With(kKalibr, "- [0.0, 0.0, 0.0, 1.0]", "- [0.0, 0.0, 0.0, 2.0]"), "its last row is not 0, 0, 0, 1");
}

}  // namespace
}  // namespace airsim360

#include "airsim360/projection/calibration_file.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360 {
namespace {

constexpr uint64_t kMostBytes = uint64_t{1} << 20;
constexpr size_t kMostCameras = 64;
constexpr int kMostPixels = 16384;  // of a side

bool ParseDouble(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

// Reads nodes of one file; messages begin with "file:line: ".
class Reader {
 public:
  Reader(std::string file, std::string_view camera = {}) : file_(std::move(file)), camera_(camera) {}

  static size_t LineOf(const YAML::Node& node) {
    return node.Mark().is_null() ? 0 : static_cast<size_t>(node.Mark().line) + 1;
  }
  [[noreturn]] void Fail(size_t line, const std::string& what) const {
    throw InputError(file_ + ":" + std::to_string(line) + ": " + (camera_.empty() ? "" : camera_ + ": ") + what);
  }
  [[noreturn]] void Fail(const YAML::Node& node, const std::string& what) const { Fail(LineOf(node), what); }
  static std::string Shown(const YAML::Node& node) {
    return node.IsScalar() ? "'" + node.Scalar().substr(0, 100) + "'" : "a list or mapping";
  }

  YAML::Node Need(const YAML::Node& map, const std::string& key) const {
    const YAML::Node node = map[key];
    if (!node.IsDefined()) Fail(map, "key '" + key + "' is missing");
    return node;
  }
  /// InputError for a key that is not among `keys`.
  void CheckKeys(const YAML::Node& map, const std::vector<std::string>& keys) const {
    if (!map.IsMap()) Fail(map, "expected 'key: value' lines");
    for (const auto& entry : map) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
      if (std::ranges::find(keys, key) == keys.end()) Fail(entry.first, UnknownChoiceMessage("key", key, keys));
    }
  }
  double Number(const YAML::Node& node, const std::string& what) const {
    double value = 0;
    if (!node.IsScalar() || !ParseDouble(node.Scalar(), value)) Fail(node, what + ": expected a number, found " + Shown(node));
    return value;
  }
  int Side(const YAML::Node& node, const std::string& what) const {
    const double value = Number(node, what);
    if (!(value >= 1 && value <= kMostPixels && value == std::floor(value)))
      Fail(node, what + ": expected pixels from 1 to " + std::to_string(kMostPixels) + ", found " + Shown(node));
    return static_cast<int>(value);
  }
  std::vector<double> Numbers(const YAML::Node& node, const std::string& what) const {
    if (!node.IsSequence()) Fail(node, what + ": expected a list of numbers, found " + Shown(node));
    std::vector<double> numbers;
    for (const auto& entry : node) numbers.push_back(Number(entry, what));
    return numbers;
  }
  /// A list of so many.
  std::vector<double> Numbers(const YAML::Node& map, const std::string& key, size_t count, const std::string& names) const {
    const YAML::Node node = Need(map, key);
    const std::vector<double> numbers = Numbers(node, key);
    if (numbers.size() != count)
      Fail(node, key + ": expected " + std::to_string(count) + " numbers (" + names + "), found " + std::to_string(numbers.size()));
    return numbers;
  }
  std::string Word(const YAML::Node& node, const std::string& what, const std::vector<std::string>& choices) const {
    if (!node.IsScalar()) Fail(node, what + ": expected a word, found " + Shown(node));
    if (std::ranges::find(choices, node.Scalar()) == choices.end())
      Fail(node, what + ": " + UnknownChoiceMessage(what, node.Scalar(), choices));
    return node.Scalar();
  }
  /// A matrix as rows of a list, or as {rows, cols, data}.
  std::vector<double> Matrix(const YAML::Node& node, const std::string& what) const {
    if (node.IsMap()) return Numbers(Need(node, "data"), what);
    std::vector<double> numbers;
    if (!node.IsSequence()) Fail(node, what + ": expected a matrix, found " + Shown(node));
    for (const auto& row : node) {
      if (!row.IsSequence()) return Numbers(node, what);
      const std::vector<double> values = Numbers(row, what);
      numbers.insert(numbers.end(), values.begin(), values.end());
    }
    return numbers;
  }
  RigidTransform Pose(const YAML::Node& node, const std::string& what) const {
    const std::vector<double> m = Matrix(node, what);
    if (m.size() != 16 && m.size() != 12) Fail(node, what + ": expected 4 rows of 4 numbers, found " + std::to_string(m.size()));
    RigidTransform X{{}, {m[3], m[7], m[11]}};
    for (size_t i = 0; i < 9; ++i) X.R.m[i / 3][i % 3] = m[i / 3 * 4 + i % 3];
    const Mat3d product = X.R * X.R.transpose();
    double off = 0;
    for (int i = 0; i < 9; ++i) off = std::max(off, std::abs(product.m[i / 3][i % 3] - (i % 4 == 0 ? 1 : 0)));
    if (!(off < 1e-4) || !(X.R.determinant() > 0))
      Fail(node, what + ": is no rotation: R R^T differs from the identity by " + std::to_string(off));
    X.R = ToMatrix(ToQuaternion(X.R));
    return X;
  }

 private:
  std::string file_, camera_;
};

// OpenCV, Kalibr and ROS count from the centre of the first pixel.
constexpr double kHalf = 0.5;

void SetKalibrModel(const Reader& in, const YAML::Node& node, Calibration& camera) {
  const std::string model = in.Word(in.Need(node, "camera_model"), "camera_model", {"pinhole", "omni", "ds", "eucm"});
  const YAML::Node of_distortion = in.Need(node, "distortion_model");
  const std::string distortion = in.Word(of_distortion, "distortion_model", {"radtan", "equidistant", "fov", "none"});
  const auto intrinsics = [&](size_t own, const std::string& names) {
    std::vector<double> v = in.Numbers(node, "intrinsics", own + 4, names + "fu, fv, pu, pv");
    v[own + 2] += kHalf, v[own + 3] += kHalf;
    std::rotate(v.begin(), v.begin() + static_cast<ptrdiff_t>(own), v.end());
    return v;
  };
  const auto coefficients = [&](size_t count, const std::string& names) {
    return in.Numbers(node, "distortion_coeffs", count, names);
  };
  const auto append = [&](const std::vector<double>& more) {
    camera.parameters.insert(camera.parameters.end(), more.begin(), more.end());
  };
  if (distortion == "none" && node["distortion_coeffs"].IsDefined() && node["distortion_coeffs"].size() > 0)
    in.Fail(node["distortion_coeffs"], "distortion_coeffs: there are none of distortion_model none");
  if (model == "pinhole") {
    camera.parameters = intrinsics(0, "");
    camera.model = distortion == "radtan" ? "OPENCV" : distortion == "equidistant" ? "OPENCV_FISHEYE" : distortion == "fov" ? "FOV" : "PINHOLE";
    if (distortion == "radtan") append(coefficients(4, "k1, k2, p1, p2"));
    if (distortion == "equidistant") append(coefficients(4, "k1, k2, k3, k4"));
    if (distortion == "fov") append(coefficients(1, "w"));
    return;
  }
  if (distortion != "none" && !(model == "omni" && distortion == "radtan"))
    in.Fail(of_distortion, "distortion_model: '" + distortion + "' does not go with camera_model '" + model + "'; use none" +
                               (model == "omni" ? " or radtan" : ""));
  if (model == "omni") {
    camera.model = "OMNI";
    camera.parameters = intrinsics(1, "xi, ");
    append(distortion == "radtan" ? coefficients(4, "k1, k2, p1, p2") : std::vector<double>(4));
  } else {
    camera.model = model == "ds" ? "DOUBLE_SPHERE" : "EUCM";
    camera.parameters = intrinsics(2, model == "ds" ? "xi, alpha, " : "alpha, beta, ");
  }
}

bool IsKalibrName(const std::string& key) {
  return key.size() > 3 && key.starts_with("cam") && std::ranges::all_of(key.substr(3), [](char c) { return c >= '0' && c <= '9'; });
}

std::vector<Calibration> ReadKalibr(const std::string& file, const YAML::Node& root) {
  std::vector<Calibration> cameras;
  for (const auto& entry : root) {
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
    const YAML::Node& node = entry.second;
    const Reader in(file, name);
    if (!IsKalibrName(name)) in.Fail(entry.first, "expected cam0, cam1, … of Kalibr");
    // What a recording is called and when its pictures came says nothing of the lens.
    in.CheckKeys(node, {"camera_model", "intrinsics", "distortion_model", "distortion_coeffs", "resolution", "T_cam_imu", "T_cn_cnm1",
                        "rostopic", "cam_overlaps", "timeshift_cam_imu"});
    Calibration camera{.name = name, .line = Reader::LineOf(entry.first)};
    SetKalibrModel(in, node, camera);
    const YAML::Node size = in.Need(node, "resolution");
    in.Numbers(node, "resolution", 2, "width, height");
    camera.width = in.Side(size[0], "resolution"), camera.height = in.Side(size[1], "resolution");
    if (node["T_cam_imu"].IsDefined()) {
      camera.X_IC = in.Pose(node["T_cam_imu"], "T_cam_imu").inverse();
    } else if (cameras.empty()) {
      camera.X_IC = CameraInBody();
    } else {
      camera.X_IC = *cameras.back().X_IC * in.Pose(in.Need(node, "T_cn_cnm1"), "T_cn_cnm1").inverse();
    }
    cameras.push_back(camera);
    if (cameras.size() > kMostCameras) in.Fail(node, "more than " + std::to_string(kMostCameras) + " cameras");
  }
  return cameras;
}

// k1 k2 p1 p2 [k3 [k4 k5 k6 [s1 s2 s3 s4 [tau_x tau_y]]]]
std::vector<double> OpenCvDistortion(const Reader& in, const YAML::Node& node, std::vector<double> d) {
  constexpr size_t kCounts[] = {4, 5, 8, 12, 14};
  if (std::ranges::find(kCounts, d.size()) == std::end(kCounts))
    in.Fail(node, "distortion_coefficients: OpenCV has 4, 5, 8, 12 or 14 of them, not " + std::to_string(d.size()));
  d.resize(14);
  if (d[12] != 0 || d[13] != 0) in.Fail(node, "distortion_coefficients: tilted sensors (tau_x, tau_y) are not modelled");
  d.resize(12);
  return d;
}

std::vector<Calibration> ReadOpenCv(const std::string& file, const YAML::Node& root) {
  const Reader in(file);
  Calibration camera{.name = "camera", .line = 1};
  if (const YAML::Node name = root["camera_name"]; name.IsDefined() && name.IsScalar()) camera.name = name.Scalar();
  camera.width = in.Side(in.Need(root, "image_width"), "image_width");
  camera.height = in.Side(in.Need(root, "image_height"), "image_height");
  const YAML::Node matrix = in.Need(root, "camera_matrix");
  const std::vector<double> K = in.Matrix(matrix, "camera_matrix");
  if (K.size() != 9) in.Fail(matrix, "camera_matrix: expected 9 numbers, found " + std::to_string(K.size()));
  if (K[1] != 0 || K[3] != 0 || K[6] != 0 || K[7] != 0 || K[8] != 1)
    in.Fail(matrix, "camera_matrix: expected [fx, 0, cx, 0, fy, cy, 0, 0, 1]; skew is not modelled");
  camera.parameters = {K[0], K[4], K[2] + kHalf, K[5] + kHalf};
  const YAML::Node of_distortion = in.Need(root, "distortion_coefficients");
  std::vector<double> d = in.Matrix(of_distortion, "distortion_coefficients");
  std::string model = "rational_polynomial";
  if (const YAML::Node node = root["distortion_model"]; node.IsDefined())
    model = in.Word(node, "distortion_model", {"plumb_bob", "rational_polynomial", "equidistant", "fisheye"});
  if (const YAML::Node node = root["fisheye_model"]; node.IsDefined() && in.Number(node, "fisheye_model") != 0) model = "fisheye";
  if (model == "equidistant" || model == "fisheye") {
    if (d.size() != 4) in.Fail(of_distortion, "distortion_coefficients: a fisheye has 4 of them (k1 … k4), not " + std::to_string(d.size()));
    camera.model = "OPENCV_FISHEYE";
  } else {
    d = OpenCvDistortion(in, of_distortion, d);
    // Ours go k1 k2 p1 p2 k3 … k6 s1 … s4, as OpenCV's.
    camera.model = "OPENCV_THIN_PRISM";
  }
  camera.parameters.insert(camera.parameters.end(), d.begin(), d.end());
  return {camera};
}

std::vector<Calibration> ReadColmap(const std::string& file, const std::string& text) {
  const Reader in(file);
  std::vector<Calibration> cameras;
  std::istringstream lines(text);
  size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line);
    std::vector<std::string> parts;
    for (std::string word; words >> word;) parts.push_back(word);
    if (parts.empty() || parts[0].starts_with("#")) continue;
    if (parts.size() < 5) in.Fail(number, "expected CAMERA_ID MODEL WIDTH HEIGHT PARAMS[], found '" + line.substr(0, 100) + "'");
    Calibration camera{.name = "cam" + parts[0], .model = parts[1], .line = number};
    for (size_t i = 2; i < parts.size(); ++i) {
      double value = 0;
      if (!ParseDouble(parts[i], value)) in.Fail(number, "'" + parts[i].substr(0, 100) + "' is not a number");
      if (i > 3) {
        camera.parameters.push_back(value);
        continue;
      }
      if (!(value >= 1 && value <= kMostPixels && value == std::floor(value)))
        in.Fail(number, "'" + parts[i] + "' pixels are not in 1 … " + std::to_string(kMostPixels));
      (i == 2 ? camera.width : camera.height) = static_cast<int>(value);
    }
    cameras.push_back(camera);
    if (cameras.size() > kMostCameras) in.Fail(number, "more than " + std::to_string(kMostCameras) + " cameras");
  }
  return cameras;
}

// OpenCV's "%YAML:1.0" is no directive of YAML.
std::string WithoutDirective(std::string text) {
  if (text.starts_with("%YAML")) text[0] = '#';
  return text;
}

bool IsColmap(std::string_view text, const std::filesystem::path& file) {
  return file.extension() == ".txt" || text.starts_with("# Camera list") || text.starts_with("# CAMERA_ID");
}

YAML::Node Load(const std::string& text, const std::string& file) {
  try {
    return YAML::Load(WithoutDirective(text));
  } catch (const YAML::Exception& error) {
    throw InputError(file + ":" + std::to_string(error.mark.line + 1) + ": " + error.msg);
  }
}

}  // namespace

bool IsCalibration(std::string_view text, const std::filesystem::path& file) {
  if (IsColmap(text, file) || text.starts_with("%YAML:")) return true;
  const YAML::Node root = Load(std::string(text), file.string());
  if (!root.IsMap()) return false;
  return root["camera_matrix"].IsDefined() || std::ranges::any_of(root, [](const auto& entry) {
           return entry.first.IsScalar() && IsKalibrName(entry.first.Scalar());
         });
}

std::vector<Calibration> ReadCalibrations(const std::filesystem::path& path) {
  const std::string text = ReadTextFile(path, kMostBytes), file = path.string();
  std::vector<Calibration> cameras;
  if (IsColmap(text, path)) {
    cameras = ReadColmap(file, text);
  } else {
    const YAML::Node root = Load(text, file);
    if (!root.IsMap() || root.size() == 0)
      throw InputError(file + ":1: expected Kalibr's cam0: …, OpenCV's camera_matrix: … or COLMAP's cameras.txt");
    try {
      cameras = root["camera_matrix"].IsDefined() ? ReadOpenCv(file, root) : ReadKalibr(file, root);
    } catch (const YAML::Exception& error) {
      throw InputError(file + ":" + std::to_string(error.mark.line + 1) + ": " + error.msg);
    }
  }
  if (cameras.empty()) throw InputError(file + ": no cameras");
  return cameras;
}

}  // namespace airsim360

#include "airsim360/projection/calibration_file.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/nearest_name.h"
#include "airsim360/projection/calibration_text.h"

namespace airsim360 {
namespace {

constexpr int kMostPixels = 16384;  // of a side
constexpr int kFurthest = 100;      // metres, as of the places in a rig

bool ParseDouble(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

// Of a camera of Kalibr. What a recording is called and when its pictures and their lines came says nothing of the lens.
constexpr const char* kKalibrKeys[] = {"camera_model", "intrinsics",   "distortion_model",  "distortion_coeffs",
                                       "resolution",   "T_cam_imu",    "T_imu_cam",         "T_cn_cnm1",
                                       "rostopic",     "cam_overlaps", "timeshift_cam_imu", "line_delay"};
// Of OpenCV and ROS.
constexpr const char* kOpenCvKeys[] = {
    "image_width", "image_height", "camera_name", "camera_matrix", "distortion_model", "distortion_coefficients", "fisheye_model",
    "rows",        "cols",         "dt",          "data"};

// Reads nodes of one file; messages begin with "file:line: ".
class Reader {
 public:
  Reader(std::string file, std::string_view camera = {}) : file_(std::move(file)), camera_(camera) {}

  static size_t LineOf(const YAML::Node& node) { return node.Mark().is_null() ? 0 : static_cast<size_t>(node.Mark().line) + 1; }
  /// Of a matrix {rows, cols, data}: where its data begins.
  static size_t LineOfNumbers(const YAML::Node& node) { return LineOf(node.IsMap() ? node["data"] : node); }
  [[noreturn]] void Fail(size_t line, const std::string& what) const {
    throw InputError(file_ + ":" + std::to_string(line) + ": " + (camera_.empty() ? "" : camera_ + ": ") + what);
  }
  [[noreturn]] void Fail(const YAML::Node& node, const std::string& what) const { Fail(LineOf(node), what); }
  static std::string Shown(const YAML::Node& node) {
    return node.IsScalar() ? "'" + node.Scalar().substr(0, 100) + "'" : "a list or mapping";
  }

  YAML::Node Need(const YAML::Node& map, const std::string& key) const {
    const YAML::Node node = map[key];
    if (node.IsDefined()) return node;
    // A key that nobody reads and that is nearly the one: its own line says more than that of the camera.
    for (const auto& entry : map) {
      const std::string other = entry.first.IsScalar() ? entry.first.Scalar().substr(0, 100) : "";
      const auto is_other = [&](const auto& keys) { return std::ranges::find(keys, other) != std::end(keys); };
      if (is_other(kOpenCvKeys) || is_other(kKalibrKeys) || internal::EditDistance(key, other) > key.size() / 3) continue;
      Fail(LineOf(entry.first), "key '" + key + "' is missing; is it meant by '" + other + "'?");
    }
    Fail(map, "key '" + key + "' is missing");
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
    if (node.IsMap()) {
      const std::vector<double> data = Numbers(Need(node, "data"), what);
      const YAML::Node rows = node["rows"], cols = node["cols"];
      if (rows.IsDefined() && cols.IsDefined() &&
          Side(rows, what + ": rows") * static_cast<int64_t>(Side(cols, what + ": cols")) != std::ssize(data)) {
        Fail(node,
             what + ": " + Shown(rows) + " rows of " + Shown(cols) + " columns, but data has " + std::to_string(data.size()) + " numbers");
      }
      return data;
    }
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
    if (m.size() == 16 && (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1)) Fail(node, what + ": its last row is not 0, 0, 0, 1");
    RigidTransform X{{}, {m[3], m[7], m[11]}};
    for (size_t i = 0; i < 9; ++i) X.R.m[i / 3][i % 3] = m[i / 3 * 4 + i % 3];
    const Mat3d product = X.R * X.R.transpose();
    double off = 0;
    for (int i = 0; i < 9; ++i) off = std::max(off, std::abs(product.m[i / 3][i % 3] - (i % 4 == 0 ? 1 : 0)));
    if (!(off < 1e-4)) Fail(node, what + ": is no rotation: R R^T differs from the identity by " + std::to_string(off));
    if (!(X.R.determinant() > 0)) Fail(node, what + ": is a reflection, no rotation: its determinant is -1");
    X.R = ToMatrix(ToQuaternion(X.R));
    if (!(std::max({std::abs(X.p.x), std::abs(X.p.y), std::abs(X.p.z)}) <= kFurthest))
      Fail(node, what + ": a camera is at most " + std::to_string(kFurthest) + " metres off; are these millimetres?");
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
    camera.lines.assign(v.size(), Reader::LineOf(node["intrinsics"]));
    v[own + 2] += kHalf, v[own + 3] += kHalf;
    std::rotate(v.begin(), v.begin() + static_cast<ptrdiff_t>(own), v.end());
    return v;
  };
  const auto coefficients = [&](size_t count, const std::string& names) { return in.Numbers(node, "distortion_coeffs", count, names); };
  const auto append = [&](const std::vector<double>& more) {
    camera.parameters.insert(camera.parameters.end(), more.begin(), more.end());
    camera.lines.resize(camera.parameters.size(), Reader::LineOf(node["distortion_coeffs"]));
  };
  if (distortion == "none" && node["distortion_coeffs"].IsDefined() && node["distortion_coeffs"].size() > 0)
    in.Fail(node["distortion_coeffs"], "distortion_coeffs: there are none of distortion_model none");
  if (model == "pinhole") {
    camera.parameters = intrinsics(0, "");
    camera.model = distortion == "radtan"        ? "OPENCV"
                   : distortion == "equidistant" ? "OPENCV_FISHEYE"
                   : distortion == "fov"         ? "FOV"
                                                 : "PINHOLE";
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

// The number of "cam0", "cam1", …; -1 for another name.
int KalibrNumber(const std::string& name) {
  int number = 0;
  if (!name.starts_with("cam") || name.size() < 4 || name[3] == '-') return -1;
  const auto [end, error] = std::from_chars(name.data() + 3, name.data() + name.size(), number);
  return error == std::errc() && end == name.data() + name.size() ? number : -1;
}

// Where a camera stands, as its entry says it.
struct KalibrPose {
  size_t index = 0;                              // among the cameras of the file
  std::optional<RigidTransform> X_IC = {};       // T_cam_imu
  std::optional<RigidTransform> from_last = {};  // T_cn_cnm1: from the frame of camera n - 1 to that of n
};

// Poses of all cameras. Camera n hangs on n - 1, in whatever order the file has them: sorted as text, cam10 follows cam1.
void ChainPoses(const std::string& file, std::map<int, KalibrPose>& poses, std::vector<Calibration>& cameras) {
  // Without an IMU the first one looks forward.
  KalibrPose& first = poses.begin()->second;
  const bool has_imu = std::ranges::any_of(poses, [](const auto& entry) { return entry.second.X_IC.has_value(); });
  if (!has_imu && !first.from_last) first.X_IC = CameraInBody();
  const auto before = [&](int number) { return poses.find(number - 1); };
  for (auto& [number, pose] : poses) {
    if (const auto last = before(number); !pose.X_IC && pose.from_last && last != poses.end() && last->second.X_IC)
      pose.X_IC = *last->second.X_IC * pose.from_last->inverse();
  }
  // Those before the first that the IMU knows.
  for (auto entry = poses.rbegin(); entry != poses.rend(); ++entry) {
    const auto& [number, pose] = *entry;
    if (const auto last = before(number); pose.X_IC && pose.from_last && last != poses.end() && !last->second.X_IC)
      last->second.X_IC = *pose.X_IC * *pose.from_last;
  }
  for (const auto& [number, pose] : poses) {
    Calibration& camera = cameras[pose.index];
    camera.X_IC = pose.X_IC;
    if (camera.X_IC) continue;
    const Reader in(file, camera.name);
    const std::string last = "cam" + std::to_string(number - 1);
    if (pose.from_last && before(number) == poses.end()) {
      in.Fail(camera.line, "T_cn_cnm1: it says where " + camera.name + " stands to " + last + ", and the file has no " + last +
                               "; add it, or give T_cam_imu");
    }
    if (pose.from_last)
      in.Fail(camera.line, "T_cn_cnm1: it says where " + camera.name + " stands to " + last + ", whose own place is not known");
    in.Fail(camera.line, "key 'T_cn_cnm1' is missing, or 'T_cam_imu': where " + camera.name + " stands is not known");
  }
}

std::vector<Calibration> ReadKalibr(const std::string& file, const YAML::Node& root) {
  std::vector<Calibration> cameras;
  std::map<int, KalibrPose> poses;
  for (const auto& entry : root) {
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
    const YAML::Node& node = entry.second;
    const Reader in(file, name.substr(0, 100));
    const int number = KalibrNumber(name);
    if (number < 0) in.Fail(entry.first, "expected cam0, cam1, … of Kalibr, or camera_matrix of OpenCV and ROS");
    in.CheckKeys(node, {std::begin(kKalibrKeys), std::end(kKalibrKeys)});
    Calibration camera{.name = name, .line = Reader::LineOf(entry.first)};
    SetKalibrModel(in, node, camera);
    const YAML::Node size = in.Need(node, "resolution");
    in.Numbers(node, "resolution", 2, "width, height");
    camera.width = in.Side(size[0], "resolution"), camera.height = in.Side(size[1], "resolution");
    KalibrPose pose{.index = cameras.size()};
    const YAML::Node of_camera = node["T_cam_imu"], of_imu = node["T_imu_cam"], of_last = node["T_cn_cnm1"];
    if (of_camera.IsDefined() && of_imu.IsDefined()) in.Fail(of_imu, "T_imu_cam: it is the inverse of T_cam_imu; give one of them");
    if (of_camera.IsDefined()) pose.X_IC = in.Pose(of_camera, "T_cam_imu").inverse();
    if (of_imu.IsDefined()) pose.X_IC = in.Pose(of_imu, "T_imu_cam");
    if (of_last.IsDefined()) pose.from_last = in.Pose(of_last, "T_cn_cnm1");
    if (!poses.emplace(number, pose).second) in.Fail(entry.first, "there are two cameras of the number " + std::to_string(number));
    cameras.push_back(camera);
    if (cameras.size() > kMostRigCameras) in.Fail(node, "more than " + std::to_string(kMostRigCameras) + " cameras");
  }
  ChainPoses(file, poses, cameras);
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

// A name of a rig's camera for whatever ROS calls it: small letters, digits and _, 32 of them.
std::string SafeName(const std::string& name) {
  std::string safe;
  for (const char c : name) {
    if ((static_cast<unsigned char>(c) & 0xc0) == 0x80) continue;  // the rest of a letter of UTF-8
    const char small = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    safe += (small >= 'a' && small <= 'z') || (small >= '0' && small <= '9') ? small : '_';
    if (safe.size() == 32) break;
  }
  return safe.empty() ? "camera" : safe;
}

std::vector<Calibration> ReadOpenCv(const std::string& file, const YAML::Node& root) {
  const Reader in(file);
  Calibration camera{.name = "camera", .line = 1};
  if (const YAML::Node name = root["camera_name"]; name.IsDefined() && name.IsScalar()) camera.name = SafeName(name.Scalar());
  camera.width = in.Side(in.Need(root, "image_width"), "image_width");
  camera.height = in.Side(in.Need(root, "image_height"), "image_height");
  const YAML::Node matrix = in.Need(root, "camera_matrix");
  const std::vector<double> K = in.Matrix(matrix, "camera_matrix");
  if (K.size() != 9) in.Fail(matrix, "camera_matrix: expected 9 numbers, found " + std::to_string(K.size()));
  if (matrix.IsMap() && matrix["rows"].IsDefined() && in.Number(matrix["rows"], "camera_matrix: rows") != 3)
    in.Fail(matrix, "camera_matrix: expected 3 rows of 3 columns");
  if (K[1] != 0 || K[3] != 0 || K[6] != 0 || K[7] != 0 || K[8] != 1)
    in.Fail(matrix, "camera_matrix: expected [fx, 0, cx, 0, fy, cy, 0, 0, 1]; skew is not modelled");
  camera.parameters = {K[0], K[4], K[2] + kHalf, K[5] + kHalf};
  camera.lines.assign(4, Reader::LineOfNumbers(matrix));
  const YAML::Node of_distortion = in.Need(root, "distortion_coefficients");
  std::vector<double> d = in.Matrix(of_distortion, "distortion_coefficients");
  std::string model = "rational_polynomial";
  if (const YAML::Node node = root["distortion_model"]; node.IsDefined())
    model = in.Word(node, "distortion_model", {"plumb_bob", "rational_polynomial", "equidistant", "fisheye"});
  if (const YAML::Node node = root["fisheye_model"]; node.IsDefined() && in.Number(node, "fisheye_model") != 0) model = "fisheye";
  if (model == "equidistant" || model == "fisheye") {
    if (d.size() != 4)
      in.Fail(of_distortion, "distortion_coefficients: a fisheye has 4 of them (k1 … k4), not " + std::to_string(d.size()));
    camera.model = "OPENCV_FISHEYE";
  } else {
    d = OpenCvDistortion(in, of_distortion, d);
    // Ours go k1 k2 p1 p2 k3 … k6 s1 … s4, as OpenCV's.
    camera.model = "OPENCV_THIN_PRISM";
  }
  camera.parameters.insert(camera.parameters.end(), d.begin(), d.end());
  camera.lines.resize(camera.parameters.size(), Reader::LineOfNumbers(of_distortion));
  return {camera};
}

// The id of a camera of COLMAP: 32 bits, of which all ones are none.
uint32_t ColmapId(const Reader& in, size_t line, const std::string& word) {
  uint32_t id = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), id);
  if (error != std::errc() || end != word.data() + word.size() || id == UINT32_MAX)
    in.Fail(line, "CAMERA_ID: '" + word.substr(0, 100) + "' is not a whole number from 0 to " + std::to_string(UINT32_MAX - 1));
  return id;
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
    Calibration camera{.name = "cam" + std::to_string(ColmapId(in, number, parts[0])), .model = parts[1], .line = number};
    if (camera.model == "EQUIRECTANGULAR")
      in.Fail(number, "model: EQUIRECTANGULAR is the panorama of this program: write {projection: erp, size: " + parts[2].substr(0, 9) +
                          "x" + parts[3].substr(0, 9) + "} in a rig");
    if (camera.model == "DIVISION" || camera.model == "SIMPLE_DIVISION")
      in.Fail(number, "model: COLMAP's " + camera.model + " is not read; estimate OPENCV or SIMPLE_RADIAL instead");
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
    if (cameras.size() > kMostRigCameras) in.Fail(number, "more than " + std::to_string(kMostRigCameras) + " cameras");
  }
  return cameras;
}

bool IsColmap(std::string_view text, const std::filesystem::path& file) {
  return file.extension() == ".txt" || text.starts_with("# Camera list") || text.starts_with("# CAMERA_ID");
}

// COLMAP's text without the mark that Windows puts before it.
std::string_view WithoutMark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

}  // namespace

Camera MakeCamera(const Calibration& c, std::optional<double> fov_deg) {
  try {
    return MakeCamera(c.model, c.width, c.height, c.parameters, fov_deg);
  } catch (const LensError& error) {
    if (c.file.empty()) throw;
    const size_t line = error.parameter < c.lines.size() ? c.lines[error.parameter] : c.line;
    throw InputError(c.file + ":" + std::to_string(line) + ": camera '" + c.name + "': " + error.what());
  }
}

bool IsCalibration(std::string_view text, const std::filesystem::path& file) {
  internal::CheckIsText(text, file);
  if (IsColmap(WithoutMark(text), file) || text.starts_with("%YAML:") || internal::IsXml(text)) return true;
  const YAML::Node root = internal::LoadDocument(text, file);
  if (!root.IsMap() || root["cameras"].IsDefined()) return false;
  return root["camera_matrix"].IsDefined() || root["image_width"].IsDefined() || internal::ForeignFormat(root) ||
         std::ranges::any_of(root, [](const auto& entry) { return entry.first.IsScalar() && KalibrNumber(entry.first.Scalar()) >= 0; });
}

std::vector<Calibration> ReadCalibrations(const std::filesystem::path& path) {
  const std::string text = ReadTextFile(path, kMostRigBytes), file = path.string();
  std::vector<Calibration> cameras;
  internal::CheckIsText(text, path);
  if (IsColmap(WithoutMark(text), path)) {
    if (const auto foreign = internal::ForeignText(text)) throw InputError(file + *foreign);
    cameras = ReadColmap(file, std::string(WithoutMark(text)));
  } else {
    const YAML::Node root = internal::LoadDocument(text, path);
    if (!root.IsMap() || root.size() == 0)
      throw InputError(file + ":1: expected Kalibr's cam0: …, OpenCV's camera_matrix: … or COLMAP's cameras.txt");
    const bool opencv = root["camera_matrix"].IsDefined();
    if (const auto foreign = internal::ForeignFormat(root); foreign && !opencv) throw InputError(file + *foreign);
    try {
      // A misspelt camera_matrix is still no camera of Kalibr.
      cameras = opencv || root["image_width"].IsDefined() ? ReadOpenCv(file, root) : ReadKalibr(file, root);
    } catch (const YAML::Exception& error) {
      throw InputError(file + ":" + std::to_string(error.mark.line + 1) + ": " + error.msg);
    }
  }
  if (cameras.empty()) throw InputError(file + ": no cameras");
  for (Calibration& camera : cameras) camera.file = file;
  return cameras;
}

}  // namespace airsim360

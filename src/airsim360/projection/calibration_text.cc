#include "airsim360/projection/calibration_text.h"

#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <vector>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr size_t kDeepest = 32;  // levels; calibrations have five

[[noreturn]] void Fail(const std::string& file, size_t line, const std::string& what) {
  throw InputError(file + ":" + std::to_string(line) + ": " + what);
}

// Walks a document without building it: aliases are not followed, so that a few lines cannot become billions of nodes.
class Checker : public YAML::EventHandler {
 public:
  explicit Checker(const std::string& file) : file_(file) {}
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { Entry(mark, nullptr); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { Entry(mark, nullptr); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string& value) override { Entry(mark, &value); }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    Open(mark, false);
  }
  void OnSequenceEnd() override { levels_.pop_back(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override { Open(mark, true); }
  void OnMapEnd() override { levels_.pop_back(); }
  /// Line where the innermost list or mapping begins that has not ended, from 1.
  int OpenLine() const { return levels_.empty() ? 1 : levels_.back().line; }

 private:
  struct Level {
    bool map = false, is_key = true;
    int line = 0;
    std::map<std::string, int> lines = {};  // of its keys
  };

  void Entry(const YAML::Mark& mark, const std::string* value) {
    if (levels_.empty() || !levels_.back().map) return;
    Level& level = levels_.back();
    if (level.is_key && value != nullptr) {
      const auto [first, fresh] = level.lines.emplace(*value, mark.line + 1);
      if (!fresh) {
        Fail(file_, static_cast<size_t>(mark.line) + 1,
             "key '" + value->substr(0, 100) + "' is given twice, first in line " + std::to_string(first->second));
      }
    }
    level.is_key = !level.is_key;
  }
  void Open(const YAML::Mark& mark, bool map) {
    Entry(mark, nullptr);
    levels_.push_back({.map = map, .line = mark.line + 1});
    if (levels_.size() > kDeepest)
      Fail(file_, static_cast<size_t>(mark.line) + 1, "lists and mappings are nested more than " + std::to_string(kDeepest) + " deep");
  }

  std::string file_;
  std::vector<Level> levels_;
};

// The line, from 1, of the first that is indented with a tab; 0: none is.
size_t LineWithTab(std::string_view text) {
  size_t line = 1;
  for (bool indent = true; const char c : text) {
    if (indent && c == '\t') return line;
    if (c == '\n') ++line;
    indent = c == '\n' || (indent && c == ' ');
  }
  return 0;
}

std::string InPlainWords(const std::string& message, int open_line) {
  const std::string from = " that begins in line " + std::to_string(open_line) + " is cut off: its ";
  if (message == YAML::ErrorMsg::END_OF_SEQ_FLOW) return "the list" + from + "']' is missing";
  if (message == YAML::ErrorMsg::END_OF_MAP_FLOW) return "the mapping" + from + "'}' is missing";
  return "is neither YAML nor JSON: " + message;
}

// OpenCV's XML as YAML of the same lines.
class XmlReader {
 public:
  XmlReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  std::string Read() {
    Skip();
    while (Sees("<?") || Sees("<!DOCTYPE")) {
      Through(">");
      Skip();
    }
    if (!Sees("<opencv_storage")) FailHere("is XML, but not OpenCV's: it does not begin with <opencv_storage>");
    Element(0, false);
    return yaml_;
  }

 private:
  [[noreturn]] void FailHere(const std::string& what) const {
    Fail(file_, 1 + static_cast<size_t>(std::ranges::count(text_.substr(0, at_), '\n')), what);
  }
  bool Sees(std::string_view what) const { return text_.substr(at_).starts_with(what); }
  // What is before `end`, and goes behind it.
  std::string_view Through(std::string_view end) {
    const size_t found = text_.find(end, at_);
    if (found == std::string_view::npos) {
      std::string what = "the XML is cut off: it has no more ";
      FailHere(what.append(end));
    }
    const std::string_view before = text_.substr(at_, found - at_);
    yaml_.append(static_cast<size_t>(std::ranges::count(before, '\n')), '\n');
    at_ = found + end.size();
    return before;
  }
  // White space and comments; lines stay lines.
  void Skip() {
    for (;;) {
      while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) {
        if (text_[at_] == '\n') yaml_ += '\n';
        ++at_;
      }
      if (!Sees("<!--")) return;
      Through("-->");
    }
  }
  static std::string Quoted(std::string_view text) {
    std::string quoted = "'";
    for (const char c : text) quoted.append(c == '\'' ? 2 : 1, c == '\n' ? ' ' : c);
    return quoted + "'";
  }
  // One tag with all that is in it; `item`: it is one of a list and its name says nothing.
  void Element(size_t depth, bool item) {
    if (depth > kDeepest) FailHere("tags are nested more than " + std::to_string(kDeepest) + " deep");
    at_ += 1;
    std::string_view tag = Through(">");
    const bool empty = tag.ends_with('/');
    if (empty) tag.remove_suffix(1);
    const std::string name(tag.substr(0, tag.find_first_of(" \t\r\n")));
    if (name.empty()) FailHere("a tag without a name");
    if (depth > 0 && !item) yaml_ += Quoted(name) + ": ";
    if (empty) {
      yaml_ += "~";
      return;
    }
    Skip();
    if (Sees("<") && !Sees("</")) {
      const bool list = Sees("<_>") || Sees("<_ ");
      yaml_ += list ? '[' : '{';
      while (!Sees("</")) {
        if (!Sees("<")) FailHere("text between tags");
        Element(depth + 1, list);
        yaml_ += ", ";
        Skip();
      }
      yaml_ += list ? ']' : '}';
    } else {
      Value();
    }
    const std::string end = "</" + name + ">";
    if (!Sees(end)) FailHere("'" + end + "' is missing");
    at_ += end.size();
  }
  // A quoted text, a number or word, or several of them: a list.
  void Value() {
    const size_t end = std::min(text_.find('<', at_), text_.size());
    const std::string_view text = text_.substr(at_, end - at_);
    at_ = end;
    std::vector<std::string> words;
    std::istringstream stream{std::string(text)};
    for (std::string word; stream >> word;) words.push_back(word);
    const bool quoted = text.starts_with('"');
    if (quoted || words.size() == 1) {
      yaml_ += Quoted(quoted ? text : words[0]);
      yaml_.append(static_cast<size_t>(std::ranges::count(text, '\n')), '\n');
      return;
    }
    yaml_ += '[';
    size_t from = 0;
    for (const std::string& word : words) {
      const size_t found = text.find(word, from);
      yaml_.append(static_cast<size_t>(std::ranges::count(text.substr(from, found - from), '\n')), '\n');
      yaml_ += Quoted(word) + ", ";
      from = found + word.size();
    }
    yaml_.append(static_cast<size_t>(std::ranges::count(text.substr(from), '\n')), '\n');
    yaml_ += ']';
  }

  std::string_view text_;
  std::string file_, yaml_;
  size_t at_ = 0;
};

// A format by keys that only it has ("a/b": b within a; of a list its first entry), and what a rig has for it.
struct ForeignRow {
  const char* format;
  const char* keys;
  const char* advice;
};
constexpr ForeignRow kForeign[] = {
    {"camodocal and VINS", "model_type projection_parameters",
     "write a rig with model, size and parameters: PINHOLE is OPENCV (fx fy cx cy k1 k2 p1 p2), KANNALA_BRANDT is OPENCV_FISHEYE (mu mv u0 v0 k2 k3 k4 k5), "
     "MEI is OMNI (gamma1 gamma2 u0 v0 xi k1 k2 p1 p2), with 0.5 added to both coordinates of the centre"},
    {"camodocal and VINS", "model_type mirror_parameters",
     "write a rig with model, size and parameters: MEI is OMNI (gamma1 gamma2 u0 v0 xi k1 k2 p1 p2), with 0.5 added to u0 and v0"},
    {"ORB-SLAM", "Camera.type",
     "write a rig with model, size and parameters: PinHole is OPENCV (fx fy cx cy k1 k2 p1 p2), KannalaBrandt8 is OPENCV_FISHEYE (fx fy cx cy k1 k2 k3 k4), "
     "with 0.5 added to cx and cy"},
    {"ORB-SLAM", "Camera.fx Camera.fy",
     "write a rig with model, size and parameters: this is OPENCV (fx fy cx cy k1 k2 p1 p2), with 0.5 added to cx and cy"},
    {"OpenCV 2.4", "Camera_Matrix Distortion_Coefficients",
     "rename its keys as later versions do: camera_matrix, distortion_coefficients, image_width, image_height"},
    {"OpenCV's stereo calibration", "M1 D1",
     "write a file for each camera: M1 as camera_matrix, D1 as distortion_coefficients, and image_width and image_height, which it lacks"},
    {"OpenCV's stereo calibration", "K1 D1",
     "write a file for each camera: K1 as camera_matrix, D1 as distortion_coefficients, and image_width and image_height, which it lacks"},
    {"EuRoC, sensor.yaml", "T_BS camera_model",
     "write Kalibr's cam0: with camera_model, intrinsics, distortion_model: radtan, distortion_coeffs, resolution, and T_imu_cam: the four rows of T_BS"},
    {"EuRoC, sensor.yaml", "sensor_type intrinsics",
     "write Kalibr's cam0: with camera_model, intrinsics, distortion_model: radtan, distortion_coeffs and resolution"},
    {"Basalt", "value0/intrinsics",
     "write a rig with model, size and parameters: ds is DOUBLE_SPHERE (fx fy cx cy xi alpha), kb4 is OPENCV_FISHEYE (fx fy cx cy k1 k2 k3 k4), "
     "eucm is EUCM (fx fy cx cy alpha beta), with 0.5 added to cx and cy"},
    {"nerfstudio or instant-ngp, transforms.json", "frames fl_x",
     "write a rig with model, size and parameters: OPENCV is fl_x fl_y cx cy k1 k2 p1 p2, OPENCV_FISHEYE is fl_x fl_y cx cy k1 k2 k3 k4"},
    {"nerfstudio or instant-ngp, transforms.json", "frames camera_angle_x",
     "write a rig with model: PINHOLE, size and parameters: fx = w / (2 tan(camera_angle_x / 2)), fy, cx and cy"},
    {"nerfstudio or instant-ngp, transforms.json", "frames/fl_x",
     "its frames have lenses of their own: write a rig with one, model: OPENCV, size and parameters: fl_x fl_y cx cy k1 k2 p1 p2"},
    {"NVIDIA DriveWorks", "rig/sensors",
     "write a rig with model, size and parameters: a polynomial from angle to pixel is F_THETA (1 1 cx cy a1 … a6); fit one to a polynomial from pixel to angle"},
    {"`ros2 topic echo` (sensor_msgs/CameraInfo)", "distortion_model d k",
     "write width as image_width, height as image_height, k as camera_matrix and d as distortion_coefficients, both with rows, cols and data"},
    {"`rostopic echo` (sensor_msgs/CameraInfo)", "distortion_model D K",
     "write width as image_width, height as image_height, K as camera_matrix and D as distortion_coefficients, both with rows, cols and data"},
};

bool Has(const YAML::Node& root, const std::string& path) {
  if (root.IsSequence()) return root.size() > 0 && Has(root[0], path);
  if (!root.IsMap()) return false;
  const size_t slash = path.find('/');
  const YAML::Node node = root[path.substr(0, slash)];
  return node.IsDefined() && (slash == std::string::npos || Has(node, path.substr(slash + 1)));
}

// Line of the key of a mapping, from 1.
size_t LineOfKey(const YAML::Node& root, const std::string& key) {
  for (const auto& entry : root) {
    if (entry.first.IsScalar() && entry.first.Scalar() == key) return static_cast<size_t>(entry.first.Mark().line) + 1;
  }
  return 1;
}

std::string Advice(size_t line, const std::string& format, const std::string& sign, const std::string& advice) {
  return ":" + std::to_string(line) + ": " + sign + ": this is a file of " + format + ", which is not read; " + advice;
}

}  // namespace

bool IsXml(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && (text.substr(first).starts_with("<?xml") || text.substr(first).starts_with("<opencv_storage"));
}

void CheckIsText(std::string_view text, const std::filesystem::path& file) {
  // YAML may be UTF-16 or UTF-32, which have zeros, with a mark at the front.
  using namespace std::string_view_literals;
  const bool wide = text.starts_with("\xff\xfe"sv) || text.starts_with("\xfe\xff"sv) || text.starts_with("\0\0\xfe\xff"sv);
  if (wide || text.find('\0') == std::string_view::npos) return;
  throw InputError(file.string() + ": is binary, not text" +
                   (file.extension() == ".bin" ? "; COLMAP writes cameras.txt with `colmap model_converter --output_type TXT`" : ""));
}

YAML::Node LoadDocument(std::string_view text, const std::filesystem::path& path) {
  const std::string file = path.string();
  CheckIsText(text, path);
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::string yaml = IsXml(text) ? XmlReader(text, file).Read() : std::string(text);
  // OpenCV's "%YAML:1.0" is no directive of YAML.
  if (yaml.starts_with("%YAML")) yaml[0] = '#';
  Checker checker(file);
  try {
    std::istringstream stream(yaml);
    YAML::Parser parser(stream);
    parser.HandleNextDocument(checker);
    return YAML::Load(yaml);
  } catch (const YAML::Exception& error) {
    const size_t line = error.mark.is_null() ? 1 : static_cast<size_t>(error.mark.line) + 1;
    if (const size_t tab = LineWithTab(yaml); tab > 0) Fail(file, tab, "is indented with a tab; YAML takes spaces alone");
    Fail(file, line, InPlainWords(error.msg, checker.OpenLine()));
  }
}

std::optional<std::string> ForeignFormat(const YAML::Node& root) {
  if (!root.IsMap()) return std::nullopt;
  for (const ForeignRow& row : kForeign) {
    std::istringstream keys(row.keys);
    bool all = true;
    for (std::string key; all && keys >> key;) all = Has(root, key);
    const std::string keys_of_row = row.keys, first = keys_of_row.substr(0, keys_of_row.find(' '));
    if (all) return Advice(LineOfKey(root, first.substr(0, first.find('/'))), row.format, "'" + first + "'", row.advice);
  }
  return std::nullopt;
}

std::optional<std::string> ForeignText(std::string_view text) {
  if (text.find("ocam_model") == std::string_view::npos) return std::nullopt;
  return Advice(1, "OCamCalib", "'ocam_model'",
                "fit OPENCV_FISHEYE (fx fy cx cy k1 k2 k3 k4) or F_THETA (1 1 cx cy a1 … a6) to its polynomial and write a rig");
}

}  // namespace airsim360::internal

#include "airsim360/projection/camera_model_names.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/projection/calibrated_lens.h"
#include "airsim360/projection/fisheye_radius.h"

namespace airsim360 {
namespace {

// A model: the names of its parameters in order, and where each goes: h, k, d, t, s and a digit are the arrays of
// CalibratedLens (shape, radial, divisor, tangential, prism); f is both focal lengths.
struct ModelRow {
  const char* name;
  LensLaw law;
  const char* names;
  const char* slots;
  bool colmap = true;
};
constexpr LensLaw kTan = LensLaw::kPerspective, kAngle = LensLaw::kEquidistant;
// Of the models that say all of a lens the first one with two focal lengths is its name.
constexpr ModelRow kModels[] = {
    {"SIMPLE_PINHOLE", kTan, "f cx cy", "f cx cy"},
    {"PINHOLE", kTan, "fx fy cx cy", "fx fy cx cy"},
    {"SIMPLE_RADIAL", kTan, "f cx cy k", "f cx cy k0"},
    {"RADIAL", kTan, "f cx cy k1 k2", "f cx cy k0 k1"},
    {"OPENCV", kTan, "fx fy cx cy k1 k2 p1 p2", "fx fy cx cy k0 k1 t0 t1"},
    {"FULL_OPENCV", kTan, "fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6", "fx fy cx cy k0 k1 t0 t1 k2 d0 d1 d2"},
    {"OPENCV_THIN_PRISM", kTan, "fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4", "fx fy cx cy k0 k1 t0 t1 k2 d0 d1 d2 s0 s1 s2 s3",
     false},
    {"SIMPLE_FISHEYE", kAngle, "f cx cy", "f cx cy"},
    {"FISHEYE", kAngle, "fx fy cx cy", "fx fy cx cy"},
    {"SIMPLE_RADIAL_FISHEYE", kAngle, "f cx cy k", "f cx cy h0"},
    {"RADIAL_FISHEYE", kAngle, "f cx cy k1 k2", "f cx cy h0 h1"},
    {"OPENCV_FISHEYE", kAngle, "fx fy cx cy k1 k2 k3 k4", "fx fy cx cy h0 h1 h2 h3"},
    {"THIN_PRISM_FISHEYE", kAngle, "fx fy cx cy k1 k2 p1 p2 k3 k4 sx1 sy1", "fx fy cx cy k0 k1 t0 t1 k2 k3 s0 s2"},
    // Its tangential and prism terms are of the distorted radius, its p0 is OpenCV's p2.
    {"RAD_TAN_THIN_PRISM_FISHEYE", kAngle, "fx fy cx cy k0 k1 k2 k3 k4 k5 p0 p1 s0 s1 s2 s3",
     "fx fy cx cy h0 h1 h2 h3 h4 h5 t1 t0 s0 s1 s2 s3"},
    {"FOV", LensLaw::kFieldOfView, "fx fy cx cy omega", "fx fy cx cy h0"},
    {"EUCM", LensLaw::kExtendedUnified, "fx fy cx cy alpha beta", "fx fy cx cy h0 h1"},
    {"DOUBLE_SPHERE", LensLaw::kDoubleSphere, "fx fy cx cy xi alpha", "fx fy cx cy h0 h1", false},
    {"OMNI", LensLaw::kUnifiedSphere, "fx fy cx cy xi k1 k2 p1 p2", "fx fy cx cy h0 k0 k1 t0 t1", false},
    {"F_THETA", LensLaw::kAngleToRadius, "fx fy cx cy a1 a2 a3 a4 a5 a6", "fx fy cx cy h0 h1 h2 h3 h4 h5", false},
};

std::vector<std::string_view> Words(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const size_t end = std::min(text.find(' '), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

// Where a parameter goes.
double& Slot(CalibratedLens& lens, std::string_view slot) {
  if (slot == "f" || slot == "fx") return lens.fx;
  if (slot == "fy") return lens.fy;
  if (slot == "cx") return lens.cx;
  if (slot == "cy") return lens.cy;
  const auto i = static_cast<size_t>(slot[1] - '0');
  switch (slot[0]) {
    case 'h':
      return lens.shape[i];
    case 'k':
      return lens.radial[i];
    case 'd':
      return lens.divisor[i];
    case 't':
      return lens.tangential[i];
    default:
      return lens.prism[i];
  }
}

const ModelRow& FindModel(std::string_view name) {
  std::vector<std::string> names;
  for (const ModelRow& row : kModels) names.emplace_back(row.name);
  try {
    return kModels[ParseChoice("camera model", name, names, "model")];
  } catch (const InputError& error) {
    throw LensError(error.what(), LensError::kNone);
  }
}

bool AllZero(std::span<const double> values) {
  return std::ranges::all_of(values, [](double x) { return x == 0; });
}

bool HasPlaneTerms(const CalibratedLens& lens) { return !AllZero(lens.divisor) || !AllZero(lens.tangential) || !AllZero(lens.prism); }

// A pinhole or a fisheye where the numbers are those of one.
Camera Simplified(const CalibratedLens& lens, bool limited) {
  if (HasPlaneTerms(lens)) return lens;
  const bool straight = AllZero(lens.radial);
  if (lens.law == LensLaw::kPerspective && straight && !limited)
    return Pinhole{lens.width, lens.height, lens.fx, lens.fy, lens.cx, lens.cy};
  // Of a radius that is the angle itself both polynomials are the same.
  if (lens.law != LensLaw::kEquidistant || lens.shape[4] != 0 || lens.shape[5] != 0) return lens;
  if (!straight && !AllZero(lens.shape)) return lens;
  const double* k = straight ? lens.shape.data() : lens.radial.data();
  return Fisheye{lens.width, lens.height, lens.fx, lens.fy, lens.cx, lens.cy, {k[0], k[1], k[2], k[3]}, lens.max_theta};
}

CalibratedLens LensOf(std::string_view model, int width, int height, std::span<const double> parameters) {
  const ModelRow& row = FindModel(model);
  const std::vector<std::string_view> slots = Words(row.slots);
  if (parameters.size() != slots.size()) {
    throw LensError(std::string(row.name) + " has " + std::to_string(slots.size()) + " parameters (" + row.names + "), not " +
                        std::to_string(parameters.size()),
                    LensError::kNone);
  }
  CalibratedLens lens{.law = row.law, .width = width, .height = height};
  for (size_t i = 0; i < slots.size(); ++i) {
    Slot(lens, slots[i]) = parameters[i];
    if (slots[i] == "f") lens.fy = parameters[i];
  }
  // The limit of the law, which has no formula there: Kalibr and COLMAP write lenses without distortion so.
  if (lens.law == LensLaw::kFieldOfView && lens.shape[0] == 0) lens.law = kTan;
  return lens;
}

// Further off or longer, its rays are parallel to the precision of a renderer, or its picture is a few points.
constexpr double kMostPictures = 10, kMostSides = 1000;

// InputError for a parameter that no lens has; MakeCamera's alone, as datasets of before may have any.
void CheckParameters(const CalibratedLens& lens, std::string_view model, std::span<const double> parameters) {
  const ModelRow& row = FindModel(model);
  const std::vector<std::string_view> names = Words(row.names), slots = Words(row.slots);
  const double side = std::max(lens.width, lens.height);
  for (size_t i = 0; i < slots.size(); ++i) {
    const std::string name(names[i]);
    const double value = parameters[i];
    const auto within = [&](double low, double high, const char* why) {
      if (value >= low && value <= high) return;
      char text[200];
      std::snprintf(text, sizeof text, "%s %.10g is not in %.6g … %.6g, %s", name.c_str(), value, low, high, why);
      throw LensError(text, i);
    };
    if (slots[i] == "cx") within(-kMostPictures * lens.width, (kMostPictures + 1) * lens.width, "10 widths of the picture from it");
    if (slots[i] == "cy") within(-kMostPictures * lens.height, (kMostPictures + 1) * lens.height, "10 heights of the picture from it");
    if (slots[i].starts_with('f')) {
      // Of F_THETA the pixels are those of fx a1, of which one may be 1.
      const double a1 = lens.law == LensLaw::kAngleToRadius ? lens.shape[0] : 1;
      if (!(a1 > 0 && std::isfinite(a1))) continue;
      within(side / kMostSides / a1, side * kMostSides / a1, "a thousandth to a thousand times the longer side of the picture");
    } else if (!(std::abs(value) < 1e30)) {
      throw LensError(name + " must be finite, and below 1e30", i);
    }
  }
}

// The parameter to blame for a law or a distortion: the first one of `slots` that is not zero, else the first of the law.
size_t Blamed(std::string_view model, std::span<const double> parameters, std::string_view kinds) {
  const std::vector<std::string_view> slots = Words(FindModel(model).slots);
  for (size_t i = 0; i < slots.size(); ++i) {
    if (kinds.find(slots[i][0]) != std::string_view::npos && parameters[i] != 0) return i;
  }
  for (size_t i = 0; i < slots.size(); ++i) {
    if (slots[i][0] == 'h') return i;
  }
  return LensError::kNone;
}

// Sets max_theta; `blamed` is the parameter for a lens that folds over within the picture.
void SetField(CalibratedLens& lens, std::optional<double> fov_deg, size_t blamed) {
  const internal::LensLimit limit = internal::FindLensLimit(lens);
  const double most_deg = std::floor(limit.theta * 360 / kPi * 1e4) / 1e4;
  char text[400];
  if (fov_deg) {
    lens.max_theta = *fov_deg / 2 * kPi / 180;
    if (*fov_deg > 0 && lens.max_theta <= limit.theta) return;
    std::snprintf(text, sizeof text, "fov_deg %g is not above 0 and at most %.6g, where the lens %s", *fov_deg, most_deg,
                  limit.folds ? "folds over" : "ends");
    throw InputError(text);
  }
  // Just before a fold, where the picture still grows.
  lens.max_theta = limit.folds ? limit.theta * (1 - 1e-9) : limit.theta;
  if (!limit.folds || internal::FillsPicture(lens)) return;
  // Tangential and prism terms fold one side before the others, perhaps beside the picture. The field is a cone around the axis all
  // the same: a direction beyond the fold would be seen twice.
  const double sine = std::sin(lens.max_theta);
  const Vec2d at = ProjectBeyond(lens, {sine * std::cos(limit.azimuth), sine * std::sin(limit.azimuth), std::cos(lens.max_theta)});
  const bool inside = at.x >= 0 && at.x <= lens.width && at.y >= 0 && at.y <= lens.height;
  const bool round = AllZero(lens.tangential) && AllZero(lens.prism);
  std::snprintf(
      text, sizeof text,
      "the lens folds over %.6g degrees from its axis%s; correct its coefficients, or give fov_deg in a rig, at most %.6g, "
      "beyond which nothing is seen",
      limit.theta * 180 / kPi,
      inside || round ? ", inside of the picture" : " on a side that is outside of the picture, and on another the picture reaches further",
      most_deg);
  throw LensError(text, blamed);
}

// InputError unless some pixel sees something. A lens grows outwards from its principal point: the pixel nearest to that is the
// last one to lose its ray.
void CheckSees(const CalibratedLens& lens) {
  const Vec2d nearest{std::clamp(std::floor(lens.cx) + 0.5, 0.5, lens.width - 0.5),
                      std::clamp(std::floor(lens.cy) + 0.5, 0.5, lens.height - 0.5)};
  if (internal::LensRay(lens, nearest)) return;
  char text[200];
  std::snprintf(text, sizeof text, "no pixel has a ray: of %dx%d pixels with the axis at (%.6g, %.6g) none is within %.4g degrees of it",
                lens.width, lens.height, lens.cx, lens.cy, lens.max_theta * 180 / kPi);
  throw LensError(text, 0);
}

}  // namespace

Camera MakeCamera(std::string_view model, int width, int height, std::span<const double> parameters, std::optional<double> fov_deg) {
  CalibratedLens lens = LensOf(model, width, height, parameters);
  CheckParameters(lens, model, parameters);
  // Numbers first: the limit is of a lens that makes sense.
  lens.max_theta = 1e-9;
  try {
    CheckCamera(lens);
  } catch (const InputError& error) {
    throw LensError(error.what(), Blamed(model, parameters, "h"));
  }
  SetField(lens, fov_deg, Blamed(model, parameters, lens.law == LensLaw::kEquidistant ? "hkdts" : "kdts"));
  CheckSees(lens);
  return Simplified(lens, fov_deg.has_value());
}

Camera RestoreCamera(std::string_view model, int width, int height, std::span<const double> parameters, double max_theta) {
  CalibratedLens lens = LensOf(model, width, height, parameters);
  lens.max_theta = max_theta;
  CheckCamera(lens);
  return Simplified(lens, true);
}

std::optional<CameraModel> ModelOf(const Camera& camera) {
  CalibratedLens lens;
  if (const auto* pinhole = std::get_if<Pinhole>(&camera)) {
    lens = {.law = kTan, .fx = pinhole->fx, .fy = pinhole->fy, .cx = pinhole->cx, .cy = pinhole->cy};
  } else if (const auto* fisheye = std::get_if<Fisheye>(&camera)) {
    const auto& k = fisheye->k;
    return CameraModel{"OPENCV_FISHEYE", {fisheye->fx, fisheye->fy, fisheye->cx, fisheye->cy, k[0], k[1], k[2], k[3]}, true};
  } else if (const auto* calibrated = std::get_if<CalibratedLens>(&camera)) {
    lens = *calibrated;
  } else {
    return std::nullopt;
  }
  lens.width = lens.height = 0;
  lens.max_theta = 0;
  for (const ModelRow& row : kModels) {
    if (row.law != lens.law || row.slots[1] == ' ') continue;
    // What the model does not hold must be zero.
    CalibratedLens rest = lens;
    CameraModel model{row.name, {}, row.colmap};
    for (const std::string_view slot : Words(row.slots)) {
      model.parameters.push_back(Slot(lens, slot));
      Slot(rest, slot) = 0;
    }
    rest.law = kTan;
    if (rest == CalibratedLens{.law = kTan, .width = 0, .height = 0}) return model;
  }
  return std::nullopt;
}

Camera Resized(const Camera& camera, int width, int height) {
  const int w = Width(camera), h = Height(camera);
  if (w == width && h == height) return camera;
  // Programs round both sides, up, down or to the nearest.
  const double across = static_cast<double>(width) / w, down = static_cast<double>(height) / h;
  if (!(std::abs(height - across * h) <= 1)) {
    throw InputError("size: " + std::to_string(width) + "x" + std::to_string(height) + " has not the shape of the calibrated " +
                     std::to_string(w) + "x" + std::to_string(h) + ": " + std::to_string(width) + " wide it is " +
                     std::to_string(std::lround(across * h)) + " high");
  }
  const auto scaled = [&](auto lens) {
    lens.width = width, lens.height = height;
    lens.fx *= across, lens.fy *= down, lens.cx *= across, lens.cy *= down;
    return Camera(lens);
  };
  if (const auto* pinhole = std::get_if<Pinhole>(&camera)) return scaled(*pinhole);
  if (const auto* fisheye = std::get_if<Fisheye>(&camera)) return scaled(*fisheye);
  return scaled(std::get<CalibratedLens>(camera));
}

}  // namespace airsim360

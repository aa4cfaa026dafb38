// COLMAP text models: every picture as it is, and for panoramas six pinhole faces beside. World to camera, axes right, down,
// forward.
#include <cmath>
#include <optional>

#include "airsim360/dataset/export/export_job.h"
#include "airsim360/dataset/export/range_points.h"
#include "airsim360/image/codecs.h"
#include "airsim360/projection/camera_model_names.h"
#include "airsim360/projection/resample.h"

namespace airsim360::internal {
namespace {

constexpr char kImagesHead[] = "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n# POINTS2D[] as (X, Y, POINT3D_ID)\n";
constexpr char kPointsHead[] = "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
constexpr char kCamerasHead[] = "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n";

struct Observation {
  Vec2d pixel;
  int64_t point = 0;
};

std::string CameraLine(size_t id, const Camera& camera) {
  std::string model = "EQUIRECTANGULAR";
  std::vector<double> params = {static_cast<double>(Width(camera)), static_cast<double>(Height(camera))};
  if (const auto* face = std::get_if<CubeFace>(&camera)) {
    model = "PINHOLE";
    params.assign(4, 0.5 * face->size);
  } else if (const auto* pinhole = std::get_if<Pinhole>(&camera)) {
    model = "PINHOLE";
    params = {pinhole->fx, pinhole->fy, pinhole->cx, pinhole->cy};
  } else if (const auto* fisheye = std::get_if<Fisheye>(&camera)) {
    model = "OPENCV_FISHEYE";
    params = {fisheye->fx, fisheye->fy, fisheye->cx, fisheye->cy, fisheye->k[0], fisheye->k[1], fisheye->k[2], fisheye->k[3]};
  } else if (const std::optional<CameraModel> lens = ModelOf(camera)) {
    model = lens->name;
    params = lens->parameters;
  }
  std::string line = std::to_string(id) + " " + model + " " + std::to_string(Width(camera)) + " " + std::to_string(Height(camera));
  for (const double value : params) line.append(" ").append(Number(value));
  return line + "\n";
}

std::string ImageLines(int64_t image, size_t camera, const RigidTransform& X_WC, const std::string& name,
                       const std::vector<Observation>& seen) {
  const RigidTransform X_CW = X_WC.inverse();
  const Quaternion q = ToQuaternion(X_CW.R);
  std::string line = std::to_string(image);
  for (const double value : {q.w, q.x, q.y, q.z, X_CW.p.x, X_CW.p.y, X_CW.p.z}) line.append(" ").append(Number(value));
  line += " " + std::to_string(camera) + " " + name + "\n";
  for (size_t i = 0; i < seen.size(); ++i)
    line += std::string(i > 0 ? " " : "") + Number(seen[i].pixel.x) + " " + Number(seen[i].pixel.y) + " " + std::to_string(seen[i].point);
  return line + "\n";
}

std::string PointLine(int64_t id, const RangePoint& point, int64_t image, size_t index) {
  const auto millimetre = [](double v) { return Number(std::round(v * 1e5) / 1e5); };
  return std::to_string(id) + " " + millimetre(point.p_W.x) + " " + millimetre(point.p_W.y) + " " + millimetre(point.p_W.z) + " " +
         std::to_string(point.color.r) + " " + std::to_string(point.color.g) + " " + std::to_string(point.color.b) + " 0 " +
         std::to_string(image) + " " + std::to_string(index) + "\n";
}

// Files of one model that grow.
struct Model {
  Model(ExportFolder& out, const std::string& folder)
      : images(out, folder + "sparse/0/images.txt"), points(out, folder + "sparse/0/points3D.txt") {
    images.Append(kImagesHead);
    points.Append(kPointsHead);
  }
  void Close() {
    images.Close();
    points.Close();
  }
  GrowingFile images, points;
};

// The axes of a picture as COLMAP has them: those of a cube face are the face's own.
RigidTransform PictureInWorld(const NativeFrame& frame, const View& view) {
  RigidTransform X = frame.X_WC(view);
  if (const auto* face = std::get_if<CubeFace>(&view.camera)) X.R = X.R * CubeFaceRotation(face->face);
  return X;
}

// The faces of panoramas of one size: where each pixel comes from.
struct FaceMaps {
  FaceMaps(int width, const Camera& panorama) : size(std::max(1, width / 4)), source(panorama) {
    for (int f = 0; f < 6; ++f) maps.push_back(ResamplingMap(CubeFace{static_cast<CubeFaceName>(f), size}, panorama));
  }
  int size;
  Camera source;
  std::vector<Image<Vec2d>> maps;
};

Image<Rgb8> Resampled(const Image<Rgb8>& picture, const FaceMaps& faces, size_t f) {
  Image<Rgb32f> floats(picture.width(), picture.height());
  std::ranges::transform(picture.pixels(), floats.pixels().begin(), [](Rgb8 c) {
    return Rgb32f{static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
  });
  const Image<Rgb32f> face = ResampleBilinear(floats, faces.source, faces.maps[f]);
  Image<Rgb8> result(face.width(), face.height());
  const auto byte = [](float v) { return static_cast<uint8_t>(std::lround(std::clamp(v, 0.0f, 255.0f))); };
  std::ranges::transform(face.pixels(), result.pixels().begin(), [&](Rgb32f c) { return Rgb8{byte(c.r), byte(c.g), byte(c.b)}; });
  return result;
}

// Range in another picture of the same centre. 1 / range is linear along straight lines on planes, so it is interpolated where
// the four pixels around are of about the same range, which one surface has; elsewhere the nearest is taken.
Image<float> ResampledRange(const Image<float>& range, const Image<Vec2d>& map) {
  constexpr float kOneSurface = 1.1f;  // ratio of farthest to nearest
  Image<float> result = ResampleNearest(range, map);
  const int w = range.width(), h = range.height();
  for (size_t i = 0; i < map.size(); ++i) {
    const Vec2d at = map.pixels()[i];
    if (std::isnan(at.x)) continue;
    const double fx = std::floor(at.x - 0.5), fy = std::floor(at.y - 0.5), u = at.x - 0.5 - fx, v = at.y - 0.5 - fy;
    const int x = static_cast<int>(fx), y = static_cast<int>(fy);
    if (y < 0 || y + 1 >= h) continue;
    const int left = (x + w) % w, right = (x + 1) % w;
    const float a = range(left, y), b = range(right, y), c = range(left, y + 1), d = range(right, y + 1);
    const auto [least, most] = std::minmax({a, b, c, d});
    if (least <= 0 || most > kOneSurface * least) continue;
    result.pixels()[i] = static_cast<float>(1 / ((1 - v) * ((1 - u) / a + u / b) + v * ((1 - u) / c + u / d)));
  }
  return result;
}

void WriteFaces(const ExportJob& job, const NativeFrame& frame, const View& view, const FaceMaps& faces) {
  const Image<Rgb8> picture = job.data.Rgb(frame, view);
  const Image<float> range = job.data.Range(frame, view);
  std::optional<Image<Rgb16>> normal;
  if (job.data.Has("normal")) normal = DecodeRgb16Png(job.data.Read(frame, view, "normal"), "normal");
  for (size_t f = 0; f < 6; ++f) {
    const std::string name = frame.stem + view.suffix + "_" + kCubeFaceNames[f];
    job.out.Write("faces/images/" + name + ".png", EncodePng(Resampled(picture, faces, f)));
    job.out.Write("faces/range/" + name + ".exr", EncodeExr(ResampledRange(range, faces.maps[f])));
    if (normal) job.out.Write("faces/normal/" + name + ".png", EncodePng(ResampleNearest(*normal, faces.maps[f])));
  }
}

void CopyPictures(const ExportJob& job, const NativeFrame& frame, const View& view) {
  for (const auto& [product, folder] : {std::pair("rgb", "images/"), std::pair("range", "range/"), std::pair("normal", "normal/")}) {
    if (!job.data.Has(product)) continue;
    job.out.Write(folder + job.data.FileName(frame, view, product), job.data.Read(frame, view, product));
  }
}

void WriteCameras(const ExportJob& job, bool faces, const std::optional<FaceMaps>& maps) {
  std::string text = kCamerasHead;
  for (size_t v = 0; v < job.data.views().size(); ++v) text += CameraLine(v + 1, job.data.views()[v].camera);
  job.out.Write("sparse/0/cameras.txt", text);
  if (faces) job.out.Write("faces/sparse/0/cameras.txt", kCamerasHead + CameraLine(1, CubeFace{CubeFaceName::kPosZ, maps->size}));
}

// Place of each face among the six names in alphabetical order: COLMAP numbers pictures by name when it finds features, and
// a model with the same numbers can be given to its point_triangulator as it is.
constexpr std::array<int64_t, 6> kNameOrder = {0, 3, 1, 4, 2, 5};

// Writes the lines of one panorama's faces; `first` is the id of its first point.
void AddFaces(Model& model, const NativeFrame& frame, const View& view, int size, const std::vector<RangePoint>& points, int64_t first) {
  const RigidTransform X_WC = frame.X_WC(view);
  std::array<std::vector<Observation>, 6> seen;
  const auto image_of = [&](size_t face) { return static_cast<int64_t>(frame.position * 6) + kNameOrder[face] + 1; };
  for (size_t i = 0; i < points.size(); ++i) {
    const CubePixel at = RayToCube(X_WC.inverse() * points[i].p_W, size);
    const auto face = static_cast<size_t>(at.face);
    const int64_t id = first + static_cast<int64_t>(i);
    model.points.Append(PointLine(id, points[i], image_of(face), seen[face].size()));
    seen[face].push_back({at.pixel, id});
  }
  for (const size_t f : {0, 2, 4, 1, 3, 5}) {  // by name
    RigidTransform X = X_WC;
    X.R = X.R * CubeFaceRotation(static_cast<CubeFaceName>(f));
    model.images.Append(ImageLines(image_of(f), 1, X, frame.stem + view.suffix + "_" + kCubeFaceNames[f] + ".png", seen[f]));
  }
}

}  // namespace

void ExportColmap(ExportJob& job) {
  job.NeedColour();
  const std::vector<View>& views = job.data.views();
  for (const View& view : views) {
    const std::optional<CameraModel> lens = ModelOf(view.camera);
    job.Need(!lens || lens->colmap, "lenses that COLMAP has a model of (not " + (lens ? lens->name : "") + ")", "other --cameras");
  }
  const bool faces = views.size() == 1 && views[0].projection == Projection::kErp;
  std::optional<FaceMaps> maps;
  if (faces) maps.emplace(Width(views[0].camera), views[0].camera);
  WriteCameras(job, faces, maps);
  Model model(job.out, "");
  std::optional<Model> face_model;
  if (faces) face_model.emplace(job.out, "faces/");
  const int64_t count = PointsAPicture(job);
  int64_t next = 1;
  job.EachFrame(
      [&](const NativeFrame& frame) {
        std::vector<std::vector<RangePoint>> points;
        for (const View& view : views) {
          CopyPictures(job, frame, view);
          points.push_back(PointsOf(job, frame, view, count));
        }
        if (faces) WriteFaces(job, frame, views[0], *maps);
        return points;
      },
      [&](const NativeFrame& frame, const std::vector<std::vector<RangePoint>>& points) {
        for (size_t v = 0; v < views.size(); ++v) {
          const auto image = static_cast<int64_t>(frame.position * views.size() + v + 1);
          std::vector<Observation> seen;
          for (const RangePoint& point : points[v]) {
            const int64_t id = next + static_cast<int64_t>(seen.size());
            model.points.Append(PointLine(id, point, image, seen.size()));
            seen.push_back({point.pixel, id});
          }
          model.images.Append(ImageLines(image, v + 1, PictureInWorld(frame, views[v]), job.data.FileName(frame, views[v], "rgb"), seen));
          if (faces) AddFaces(*face_model, frame, views[v], maps->size, points[v], next);
          next += static_cast<int64_t>(points[v].size());
        }
      });
  model.Close();
  if (face_model) face_model->Close();
  job.notes["points"] = next - 1;
}

}  // namespace airsim360::internal

// nerfstudio: transforms.json with poses camera to world, axes right, up, backward, and a cloud of points to begin from.
#include "airsim360/dataset/export/export_job.h"
#include "airsim360/dataset/export/range_points.h"
#include "airsim360/dataset/record/intrinsics.h"

namespace airsim360::internal {
namespace {

Json OpenGlMatrix(const RigidTransform& X) {
  const Vec3d columns[] = {X.R.column(0), -X.R.column(1), -X.R.column(2), X.p};
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back({columns[0][i], columns[1][i], columns[2][i], columns[3][i]});
  rows.push_back({0.0, 0.0, 0.0, 1.0});
  return rows;
}

// Intrinsics in nerfstudio's names; of panoramas fl_x = fl_y = height, as its EQUIRECTANGULAR wants.
Json Intrinsics(const View& view) {
  const int width = Width(view.camera), height = Height(view.camera);
  if (view.projection == Projection::kErp) {
    return {{"camera_model", "EQUIRECTANGULAR"},
            {"w", width},
            {"h", height},
            {"fl_x", height},
            {"fl_y", height},
            {"cx", width / 2.0},
            {"cy", height / 2.0}};
  }
  const Json K = IntrinsicsJson(view.camera);
  const bool fisheye = K["model"] == "OPENCV_FISHEYE";
  Json json = {{"camera_model", fisheye ? "OPENCV_FISHEYE" : "OPENCV"},
               {"w", width},
               {"h", height},
               {"fl_x", K["fx"]},
               {"fl_y", K["fy"]},
               {"cx", K["cx"]},
               {"cy", K["cy"]}};
  const char* const names[] = {"k1", "k2", fisheye ? "k3" : "p1", fisheye ? "k4" : "p2"};
  for (size_t i = 0; i < K["distortion"].size(); ++i) json[names[i]] = K["distortion"][i];
  return json;
}

// Vertices of a binary little-endian PLY: float x y z, uchar red green blue.
void AppendVertex(std::string& ply, const RangePoint& point) {
  const float xyz[] = {static_cast<float>(point.p_W.x), static_cast<float>(point.p_W.y), static_cast<float>(point.p_W.z)};
  ply.append(reinterpret_cast<const char*>(xyz), sizeof xyz);
  ply += {static_cast<char>(point.color.r), static_cast<char>(point.color.g), static_cast<char>(point.color.b)};
}

}  // namespace

void ExportNerfstudio(ExportJob& job) {
  job.NeedColour();
  const View& view = job.OneView();
  const Json K = IntrinsicsJson(view.camera);
  const bool known = K.is_null() || K["model"] == "PINHOLE" || K["model"] == "OPENCV" || K["model"] == "OPENCV_FISHEYE";
  job.Need(known, "a panorama, a pinhole, OPENCV or OPENCV_FISHEYE (nerfstudio has no other lenses)", "other --cameras");
  const int64_t count = PointsAPicture(job);
  std::string frames, vertices;
  int64_t points = 0;
  job.EachFrame(
      [&](const NativeFrame& frame) {
        job.out.Write("images/" + job.data.FileName(frame, view, "rgb"), job.data.Read(frame, view, "rgb"));
        return PointsOf(job, frame, view, count);
      },
      [&](const NativeFrame& frame, const std::vector<RangePoint>& made) {
        const Json json = {{"file_path", "images/" + job.data.FileName(frame, view, "rgb")},
                           {"transform_matrix", OpenGlMatrix(frame.X_WC(view))}};
        frames += (frames.empty() ? "\n" : ",\n") + Dump(json);
        for (const RangePoint& point : made) AppendVertex(vertices, point);
        points += static_cast<int64_t>(made.size());
      });
  const std::string head = Dump(Intrinsics(view));
  const std::string cloud = points > 0 ? ",\"ply_file_path\":\"sparse_pc.ply\"" : "";
  job.out.Write("transforms.json", head.substr(0, head.size() - 1) + cloud + ",\"frames\":[" + frames + "]}\n");
  if (points > 0) {
    job.out.Write("sparse_pc.ply", "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points) +
                                       "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                                       "property uchar green\nproperty uchar blue\nend_header\n" +
                                       vertices);
  }
  job.notes["points"] = points;
}

}  // namespace airsim360::internal

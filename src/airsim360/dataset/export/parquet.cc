// A table with one row a frame: what is in it, how much, and from where it was seen.
#include <map>

#include "airsim360/dataset/export/export_job.h"
#include "airsim360/dataset/export/parquet_file.h"

namespace airsim360::internal {

namespace {

ParquetFile FrameTable(ExportJob& job) {
  using Type = ParquetFile::Type;
  return ParquetFile(job.out, "frames.parquet",
                     {{"index", Type::kInt64},
                      {"stem", Type::kText},
                      {"t_ns", Type::kInt64},
                      {"world", Type::kText},
                      {"x", Type::kDouble},
                      {"y", Type::kDouble},
                      {"z", Type::kDouble},
                      {"qw", Type::kDouble},
                      {"qx", Type::kDouble},
                      {"qy", Type::kDouble},
                      {"qz", Type::kDouble},
                      {"range_min", Type::kDouble},
                      {"range_median", Type::kDouble},
                      {"entities", Type::kInt64},
                      {"people", Type::kInt64},
                      {"categories", Type::kText, true},
                      {"category_pixels", Type::kInt64, true},
                      {"files", Type::kText, true}});
}

}  // namespace

void ExportParquet(ExportJob& job) {
  using Values = std::vector<ParquetFile::Value>;
  ParquetFile file = FrameTable(job);
  for (size_t i = 0; i < job.data.size(); ++i) {
    const NativeFrame frame = job.data.Frame(i);
    const View& first = job.data.views().front();
    const RigidTransform X = frame.X_WC(first);
    const Quaternion q = ToQuaternion(X.R);
    std::map<CategoryId, int64_t> pixels;
    int64_t entities = 0, people = 0;
    Values files;
    for (const View& view : job.data.views()) {
      for (const Segment& segment : job.data.Segments(frame, view)) {
        pixels[segment.category] += segment.area;
        ++entities;
      }
      for (const Json& person : job.data.Persons(frame, view)) people += person.value("area", int64_t{0}) > 0;
      for (const ProductFolder& product : ProductFolders(job.data.spec()))
        files.push_back(product.name + "/" + job.data.FileName(frame, view, product.name));
    }
    Values names, areas;
    for (const auto& [id, area] : pixels) {
      names.push_back(job.data.category(id).path);
      areas.push_back(area);
    }
    file.AddRow({{frame.index},
                 {frame.stem},
                 {frame.t_ns},
                 {frame.world},
                 {X.p.x},
                 {X.p.y},
                 {X.p.z},
                 {q.w},
                 {q.x},
                 {q.y},
                 {q.z},
                 {frame.json.value("range_min", 0.0)},
                 {frame.json.value("range_median", 0.0)},
                 {entities},
                 {people},
                 names,
                 areas,
                 files});
  }
  file.Finish();
}

}  // namespace airsim360::internal

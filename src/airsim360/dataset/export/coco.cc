// COCO instances, entities and keypoints (cocodataset.org/#format-data). Boxes that know the seam stand beside COCO's own.
#include "airsim360/dataset/export/export_job.h"
#include "airsim360/dataset/people/json_lines.h"
#include "airsim360/dataset/people/people_export.h"

namespace airsim360::internal {
namespace {

Json ImageJson(const ExportJob& job, const NativeFrame& frame, const View& view, int64_t id) {
  return {{"id", id},
          {"file_name", job.data.FileName(frame, view, "rgb")},
          {"width", Width(view.camera)},
          {"height", Height(view.camera)},
          {"frame", frame.index}};
}

// Without ids, which depend on the frames before.
std::vector<Json> Annotations(const ExportJob& job, const NativeFrame& frame, const View& view, bool entities) {
  const auto runs = EntityRuns(job.data.Entity(frame, view));
  std::vector<Json> list;
  for (const Segment& segment : job.data.Segments(frame, view)) {
    const NativeCategory& category = job.data.category(segment.category);
    if (!entities && !category.thing) continue;
    const auto found = runs.find(segment.entity);
    if (found == runs.end()) continue;
    const PixelBox &b = segment.box, &w = segment.box_wrap;
    Json json = {{"id", 0},
                 {"image_id", 0},
                 {"category_id", entities ? 1 : segment.category},
                 {"segmentation", {{"size", {Height(view.camera), Width(view.camera)}}, {"counts", RleText(found->second)}}},
                 {"area", segment.area},
                 {"bbox", {b.x, b.y, b.w, b.h}},
                 {"iscrowd", 0},
                 {"bbox_wrap", {w.x, w.y, w.w, w.h}},
                 {"solid_angle", segment.solid_angle},
                 {"entity_id", segment.entity}};
    if (entities) json["source_category"] = category.path;
    list.push_back(std::move(json));
  }
  return list;
}

Json Categories(const ExportJob& job, bool entities) {
  if (entities) return Json::array({{{"id", 1}, {"name", "entity"}, {"supercategory", "entity"}}});
  Json list = Json::array();
  for (const auto& [id, category] : job.data.categories()) {
    if (!category.thing) continue;
    list.push_back({{"id", id},
                    {"name", category.path},
                    {"supercategory", category.path.substr(0, category.path.find('/'))},
                    {"coco_id", category.coco}});
  }
  return list;
}

void CopyPicture(const ExportJob& job, const NativeFrame& frame, const View& view) {
  job.out.Write("images/" + job.data.FileName(frame, view, "rgb"), job.data.Read(frame, view, "rgb"));
}

void ExportInstances(ExportJob& job, bool entities) {
  job.NeedColour();
  JsonLists file(job.out, "annotations/instances.json", {"images", "annotations"});
  int64_t image = 0, annotation = 0;
  job.EachFrame(
      [&](const NativeFrame& frame) {
        std::vector<std::vector<Json>> made;
        for (const View& view : job.data.views()) {
          CopyPicture(job, frame, view);
          made.push_back(Annotations(job, frame, view, entities));
        }
        return made;
      },
      [&](const NativeFrame& frame, std::vector<std::vector<Json>> made) {
        for (size_t v = 0; v < made.size(); ++v) {
          file.Add("images", Dump(ImageJson(job, frame, job.data.views()[v], ++image)));
          for (Json& json : made[v]) {
            json["id"] = ++annotation;
            json["image_id"] = image;
            file.Add("annotations", Dump(json));
          }
        }
      });
  Json info = {{"description", "AirSim360: " + job.data.spec().world}, {"version", "1.0"}};
  file.Finish({{"categories", Dump(Categories(job, entities))}, {"licenses", "[]"}, {"info", Dump(info)}});
  job.notes["annotations"] = annotation;
}

}  // namespace

void ExportCoco(ExportJob& job) { ExportInstances(job, false); }
void ExportCocoEntity(ExportJob& job) { ExportInstances(job, true); }

void ExportCocoKeypoints(ExportJob& job) {
  job.NeedColour();
  job.NeedPeople();
  JsonLists file(job.out, "annotations/person_keypoints.json", {"images", "annotations"});
  int64_t image = 0, annotation = 0;
  std::string categories;
  job.EachFrame(
      [&](const NativeFrame& frame) {
        // The conversion of people.jsonl, a frame at a time.
        std::string lines;
        for (const View& view : job.data.views()) {
          CopyPicture(job, frame, view);
          Json line = {{"index", frame.index},
                       {"stem", frame.stem + view.suffix},
                       {"camera", {{"width", Width(view.camera)}, {"height", Height(view.camera)}}},
                       {"persons", job.data.Persons(frame, view)}};
          lines += Dump(line) + "\n";
        }
        return Json::parse(CocoKeypoints(lines, job.data.spec()).text);
      },
      [&](const NativeFrame&, Json made) {
        const int64_t first_image = image;
        for (Json& json : made["images"]) {
          json["id"] = ++image;
          file.Add("images", Dump(json));
        }
        for (Json& json : made["annotations"]) {
          json["id"] = ++annotation;
          json["image_id"] = first_image + json["image_id"].get<int64_t>();
          file.Add("annotations", Dump(json));
        }
        categories = Dump(made["categories"]);
      });
  file.Finish({{"categories", categories}});
  job.notes["annotations"] = annotation;
}

}  // namespace airsim360::internal

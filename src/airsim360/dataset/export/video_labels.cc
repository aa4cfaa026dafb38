// Labels of videos: one id is one entity over all frames. Video panoptic (VIPSeg's JSON), KITTI-STEP, MOTS.
#include <cstdio>

#include "airsim360/base/error.h"
#include "airsim360/dataset/export/cityscapes_ids.h"
#include "airsim360/dataset/export/export_job.h"
#include "airsim360/image/codecs.h"

namespace airsim360::internal {
namespace {

// Numbers of things in the order in which they are first seen, from 1.
class Numbering {
 public:
  explicit Numbering(int most) : most_(most) {}
  int Of(EntityId entity) {
    const auto [at, added] = numbers_.try_emplace(entity, static_cast<int>(numbers_.size()) + 1);
    if (at->second > most_) throw InputError("more than " + std::to_string(most_) + " things of one class: the format has no more numbers");
    return at->second;
  }

 private:
  int most_;
  std::map<EntityId, int> numbers_;
};

std::string VideoName(const View& view) { return view.suffix.empty() ? "0000" : view.suffix.substr(1); }

std::string FrameName(const NativeFrame& frame) {
  char text[24];
  std::snprintf(text, sizeof text, "%06zu", frame.position);
  return text;
}

Json SegmentsJson(const std::vector<Segment>& segments) {
  Json list = Json::array();
  for (const Segment& s : segments) {
    const PixelBox &b = s.box, &w = s.box_wrap;
    list.push_back({{"id", s.entity},
                    {"category_id", s.category},
                    {"area", s.area},
                    {"bbox", {b.x, b.y, b.w, b.h}},
                    {"iscrowd", 0},
                    {"bbox_wrap", {w.x, w.y, w.w, w.h}}});
  }
  return list;
}

// Numbers of all persons and cars, given in the order of frames before the pictures are made in any order.
struct Tracks {
  Numbering cars, persons;
  std::map<EntityId, std::pair<int, int>> of;  // entity -> Cityscapes label, number
};

Tracks FindTracks(const ExportJob& job, int most) {
  Tracks tracks{Numbering(most), Numbering(most), {}};
  for (size_t i = 0; i < job.data.size(); ++i) {
    const NativeFrame frame = job.data.Frame(i);
    for (const View& view : job.data.views()) {
      for (const Segment& segment : job.data.Segments(frame, view)) {
        const int label = job.data.category(segment.category).cityscapes;
        if (label == kCarLabel) tracks.of[segment.entity] = {label, tracks.cars.Of(segment.entity)};
        if (label == kPersonLabel) tracks.of[segment.entity] = {label, tracks.persons.Of(segment.entity)};
      }
    }
  }
  return tracks;
}

Json VideoCategories(const ExportJob& job) {
  Json list = Json::array();
  for (const auto& [id, c] : job.data.categories())
    list.push_back({{"id", id}, {"name", c.path}, {"isthing", c.thing ? 1 : 0}, {"color", {c.color.r, c.color.g, c.color.b}}});
  return list;
}

}  // namespace

void ExportVps(ExportJob& job) {
  job.NeedColour();
  const std::vector<View>& views = job.data.views();
  std::vector<std::string> images(views.size()), annotations(views.size());
  job.EachFrame(
      [&](const NativeFrame& frame) {
        for (const View& view : views) {
          const std::string name = VideoName(view) + "/" + FrameName(frame);
          job.out.Write("images/" + name + job.data.Extension("rgb"), job.data.Read(frame, view, "rgb"));
          job.out.Write("panomasksRGB/" + name + ".png", job.data.Read(frame, view, "entity"));
        }
        return 0;
      },
      [&](const NativeFrame& frame, int) {
        for (size_t v = 0; v < views.size(); ++v) {
          const std::string name = FrameName(frame), comma = images[v].empty() ? "\n" : ",\n";
          images[v] += comma + Dump({{"id", name},
                                     {"file_name", name + job.data.Extension("rgb")},
                                     {"width", Width(views[v].camera)},
                                     {"height", Height(views[v].camera)}});
          annotations[v] +=
              comma +
              Dump({{"image_id", name}, {"file_name", name + ".png"}, {"segments_info", SegmentsJson(job.data.Segments(frame, views[v]))}});
        }
      });
  JsonLists file(job.out, "panoptic_gt.json", {"videos", "annotations"});
  for (size_t v = 0; v < views.size(); ++v) {
    const std::string head = "{\"video_id\":\"" + VideoName(views[v]) + "\",";
    file.Add("videos", head + "\"images\":[" + images[v] + "]}");
    file.Add("annotations", head + "\"annotations\":[" + annotations[v] + "]}");
  }
  file.Finish({{"categories", Dump(VideoCategories(job))}});
}

void ExportStep(ExportJob& job) {
  job.NeedColour();
  const Tracks tracks = FindTracks(job, 65535);
  job.EachFrame([&](const NativeFrame& frame) {
    for (const View& view : job.data.views()) {
      const Image<CategoryId> semantic = job.data.Semantic(frame, view);
      const Image<EntityId> entity = job.data.Entity(frame, view);
      Image<Rgb8> panoptic(semantic.width(), semantic.height());
      for (size_t i = 0; i < semantic.size(); ++i) {
        const auto found = tracks.of.find(entity.pixels()[i]);
        const int number = found == tracks.of.end() ? 0 : found->second.second;
        const uint8_t train =
            semantic.pixels()[i] == kVoid ? uint8_t{255} : CityscapesTrainId(job.data.category(semantic.pixels()[i]).cityscapes);
        panoptic.pixels()[i] = {train, static_cast<uint8_t>(number / 256), static_cast<uint8_t>(number % 256)};
      }
      const std::string name = VideoName(view) + "/" + FrameName(frame);
      job.out.Write("images/train/" + name + job.data.Extension("rgb"), job.data.Read(frame, view, "rgb"));
      job.out.Write("panoptic_maps/train/" + name + ".png", EncodePng(panoptic));
    }
  });
  job.notes["tracks"] = tracks.of.size();
}

void ExportMots(ExportJob& job) {
  job.NeedColour();
  const Tracks tracks = FindTracks(job, 999);
  job.Need(!tracks.of.empty(), "cars or people in its pictures", "--people N, or where cars are");
  // MOTS: class 1 = car, 2 = pedestrian; id = class * 1000 + number.
  const auto id_of = [&](EntityId entity) {
    const auto found = tracks.of.find(entity);
    if (found == tracks.of.end()) return 0;
    return (found->second.first == kCarLabel ? 1 : 2) * 1000 + found->second.second;
  };
  std::map<std::string, std::string> lines;  // by video
  job.EachFrame(
      [&](const NativeFrame& frame) {
        std::vector<std::string> texts;
        for (const View& view : job.data.views()) {
          const Image<EntityId> entity = job.data.Entity(frame, view);
          Image<uint16_t> mask(entity.width(), entity.height());
          std::ranges::transform(entity.pixels(), mask.pixels().begin(), [&](EntityId e) { return static_cast<uint16_t>(id_of(e)); });
          const std::string name = VideoName(view) + "/" + FrameName(frame);
          job.out.Write("images/" + name + job.data.Extension("rgb"), job.data.Read(frame, view, "rgb"));
          job.out.Write("instances/" + name + ".png", EncodePng(mask));
          std::string text;
          for (const auto& [e, runs] : EntityRuns(entity)) {
            if (const int id = id_of(e); id > 0) {
              text += std::to_string(frame.position) + " " + std::to_string(id) + " " + std::to_string(id / 1000) + " " +
                      std::to_string(entity.height()) + " " + std::to_string(entity.width()) + " " + RleText(runs) + "\n";
            }
          }
          texts.push_back(std::move(text));
        }
        return texts;
      },
      [&](const NativeFrame&, const std::vector<std::string>& texts) {
        for (size_t v = 0; v < texts.size(); ++v) lines[VideoName(job.data.views()[v])] += texts[v];
      });
  for (const auto& [video, text] : lines) job.out.Write("instances_txt/" + video + ".txt", text);
  job.notes["tracks"] = tracks.of.size();
}

}  // namespace airsim360::internal

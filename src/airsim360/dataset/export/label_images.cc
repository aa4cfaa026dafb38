// Label pictures by the tables of Cityscapes, ADE20K, WildPASS and indoor data sets, and what share of the pixels has no class there.
#include <cstdio>
#include <functional>

#include "airsim360/dataset/export/cityscapes_ids.h"
#include "airsim360/dataset/export/export_job.h"
#include "airsim360/dataset/export/indoor_classes.h"
#include "airsim360/image/codecs.h"

namespace airsim360::internal {
namespace {

// WildPASS' eight classes in its order, by the categories that belong to them.
struct WildPassRow {
  const char* name;
  std::vector<const char*> paths;
};
const std::vector<WildPassRow>& WildPassRows() {
  static const std::vector<WildPassRow> rows = {
      {"Car", {"vehicle/car", "vehicle/van"}},
      {"Truck", {"vehicle/truck", "vehicle/food_truck", "vehicle/trailer"}},
      {"Bus", {"vehicle/bus"}},
      {"Road", {"ground/road", "ground/lane_marking", "ground/manhole", "ground/bike_lane", "ground/parking"}},
      {"Sidewalk", {"ground/sidewalk", "ground/pavement", "ground/path"}},
      {"Person", {"human"}},
      {"Curb", {"ground/kerb"}},
      {"Crosswalk", {"ground/crosswalk"}}};
  return rows;
}

bool IsBelow(const std::string& path, const std::string& ancestor) {
  return path == ancestor || (path.size() > ancestor.size() && path.starts_with(ancestor) && path[ancestor.size()] == '/');
}

int WildPassId(const std::string& path) {
  const auto& rows = WildPassRows();
  for (size_t i = 0; i < rows.size(); ++i) {
    for (const char* ancestor : rows[i].paths) {
      if (IsBelow(path, ancestor)) return static_cast<int>(i);
    }
  }
  return -1;
}

// Category id -> value, by a function of the category that gives -1 for none.
std::vector<uint8_t> Table(const ExportJob& job, const std::function<int(const NativeCategory&)>& value, uint8_t none) {
  std::vector<uint8_t> table(size_t{1} << 16, none);
  for (const auto& [id, category] : job.data.categories()) {
    const int mapped = value(category);
    if (mapped >= 0) table[id] = static_cast<uint8_t>(mapped);
  }
  return table;
}

struct Counted {
  uint64_t none = 0, all = 0;
};

// A picture by a table; counts the pixels of the categories without a class.
Image<uint8_t> Mapped(const Image<CategoryId>& semantic, const std::vector<uint8_t>& table) {
  Image<uint8_t> labels(semantic.width(), semantic.height());
  std::ranges::transform(semantic.pixels(), labels.pixels().begin(), [&](CategoryId id) { return table[id]; });
  return labels;
}

Counted Count(const Image<CategoryId>& semantic, const std::vector<bool>& has_class) {
  Counted counted{0, semantic.size()};
  for (const CategoryId id : semantic.pixels()) counted.none += !has_class[id];
  return counted;
}

std::vector<bool> HasClass(const ExportJob& job, const std::function<int(const NativeCategory&)>& value) {
  std::vector<bool> has(size_t{1} << 16);
  for (const auto& [id, category] : job.data.categories()) has[id] = value(category) >= 0;
  return has;
}

void Report(ExportJob& job, Counted counted) {
  job.notes["unmapped_share"] = static_cast<double>(counted.none) / static_cast<double>(counted.all);
}

std::string CityName(const ExportJob& job) {
  std::string name = std::filesystem::path(job.data.spec().world).stem().string();
  // Names of files are city_sequence_frame: no '_' within the city.
  std::erase_if(name, [](char c) { return c == '_' || c == ' '; });
  return name.empty() ? "world" : name;
}

// instanceIds: id * 1000 + number of things that have instances, else id. Numbers follow the entity ids within a picture.
Image<uint16_t> InstanceIds(const Image<uint8_t>& labels, const Image<EntityId>& entity, const std::vector<Segment>& segments,
                            const std::vector<uint8_t>& table) {
  std::map<EntityId, uint16_t> of_entity;
  std::map<int, int> next;
  for (const Segment& segment : segments) {
    const int id = table[segment.category];
    if (id < kFirstThing || id > kLastThing) continue;
    const int number = std::min(next[id]++, 999);
    of_entity[segment.entity] = static_cast<uint16_t>(id * 1000 + number);
  }
  Image<uint16_t> instances(labels.width(), labels.height());
  for (size_t i = 0; i < labels.size(); ++i) {
    const auto found = of_entity.find(entity.pixels()[i]);
    instances.pixels()[i] = found == of_entity.end() ? labels.pixels()[i] : found->second;
  }
  return instances;
}

using Write = std::function<void(const NativeFrame&, const View&, const Image<CategoryId>&)>;

// Writes every picture and counts what has no class.
void EachPicture(ExportJob& job, const std::function<int(const NativeCategory&)>& value, const Write& write) {
  job.NeedColour();
  const std::vector<bool> has_class = HasClass(job, value);
  Counted total;
  job.EachFrame(
      [&](const NativeFrame& frame) {
        Counted counted;
        for (const View& view : job.data.views()) {
          const Image<CategoryId> semantic = job.data.Semantic(frame, view);
          const Counted here = Count(semantic, has_class);
          counted.none += here.none, counted.all += here.all;
          write(frame, view, semantic);
        }
        return counted;
      },
      [&](const NativeFrame&, Counted counted) { total.none += counted.none, total.all += counted.all; });
  Report(job, total);
}

}  // namespace

void ExportCityscapes(ExportJob& job) {
  const auto value = [](const NativeCategory& c) { return c.cityscapes >= 0 && c.cityscapes <= 33 ? c.cityscapes : -1; };
  const std::vector<uint8_t> table = Table(job, value, 0);  // 0 = unlabeled
  const std::string city = CityName(job);
  EachPicture(job, value, [&](const NativeFrame& frame, const View& view, const Image<CategoryId>& semantic) {
    char number[32];
    std::snprintf(number, sizeof number, "_%06d_%06lld_", static_cast<int>(&view - job.data.views().data()),
                  static_cast<long long>(frame.index));
    const std::string name = city + "/" + city + number, fine = "gtFine/train/" + name + "gtFine_";
    const Image<uint8_t> labels = Mapped(semantic, table);
    Image<uint8_t> train(labels.width(), labels.height());
    std::ranges::transform(labels.pixels(), train.pixels().begin(), [](uint8_t id) { return CityscapesTrainId(id); });
    job.out.Write("leftImg8bit/train/" + name + "leftImg8bit" + job.data.Extension("rgb"), job.data.Read(frame, view, "rgb"));
    job.out.Write(fine + "labelIds.png", EncodePng(labels));
    job.out.Write(fine + "labelTrainIds.png", EncodePng(train));
    job.out.Write(fine + "instanceIds.png",
                  EncodePng(InstanceIds(labels, job.data.Entity(frame, view), job.data.Segments(frame, view), table)));
  });
}

void ExportAde20k(ExportJob& job) {
  const auto value = [](const NativeCategory& c) { return c.ade20k >= 0 ? c.ade20k + 1 : -1; };  // 1 … 150
  const std::vector<uint8_t> table = Table(job, value, 0);                                       // 0 = other
  EachPicture(job, value, [&](const NativeFrame& frame, const View& view, const Image<CategoryId>& semantic) {
    const std::string stem = frame.stem + view.suffix;
    job.out.Write("images/training/" + stem + job.data.Extension("rgb"), job.data.Read(frame, view, "rgb"));
    job.out.Write("annotations/training/" + stem + ".png", EncodePng(Mapped(semantic, table)));
  });
}

void ExportWildPass(ExportJob& job) {
  const auto value = [](const NativeCategory& c) { return WildPassId(c.path); };
  const std::vector<uint8_t> table = Table(job, value, 255);  // 255 = none of the eight
  EachPicture(job, value, [&](const NativeFrame& frame, const View& view, const Image<CategoryId>& semantic) {
    const std::string stem = frame.stem + view.suffix;
    job.out.Write("leftImg8bit/train/" + stem + job.data.Extension("rgb"), job.data.Read(frame, view, "rgb"));
    job.out.Write("gtFine/train/" + stem + ".png", EncodePng(Mapped(semantic, table)));
  });
  std::string classes;
  for (size_t i = 0; i < WildPassRows().size(); ++i) classes += std::to_string(i) + " " + WildPassRows()[i].name + "\n";
  job.out.Write("classes.txt", classes);
}

namespace {

// 0 = none; the classes by number beside them.
void ExportIndoor(ExportJob& job, IndoorList list) {
  const auto value = [list](const NativeCategory& c) { return IndoorId(list, c.path); };
  const std::vector<uint8_t> table = Table(job, value, 0);
  EachPicture(job, value, [&](const NativeFrame& frame, const View& view, const Image<CategoryId>& semantic) {
    const std::string stem = frame.stem + view.suffix;
    job.out.Write("color/" + stem + job.data.Extension("rgb"), job.data.Read(frame, view, "rgb"));
    job.out.Write("label/" + stem + ".png", EncodePng(Mapped(semantic, table)));
  });
  std::string classes;
  int id = 0;
  for (const char* name : IndoorNames(list)) classes += std::to_string(++id) + " " + name + "\n";
  job.out.Write("classes.txt", classes);
}

}  // namespace

void ExportScanNet(ExportJob& job) { ExportIndoor(job, IndoorList::kNyu40); }
void ExportMatterport(ExportJob& job) { ExportIndoor(job, IndoorList::kMpcat40); }
void ExportStanford2d3d(ExportJob& job) { ExportIndoor(job, IndoorList::kStanford13); }

}  // namespace airsim360::internal

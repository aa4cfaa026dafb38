#include "airsim360/dataset/viewing/viewed_dataset.h"

#include <array>
#include <charconv>
#include <mutex>
#include <unordered_map>

#include "airsim360/base/error.h"
#include "airsim360/dataset/export/native_dataset.h"
#include "airsim360/dataset/folder.h"
#include "airsim360/dataset/sqlite.h"

namespace airsim360 {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr std::string_view kPeople = "people/", kJsonEnd = ".json";
constexpr std::array kTables{"entities.json", "parts.json", "materials.json"};
// Of a person; the rest of people.jsonl is for other programs.
constexpr std::array kPersonFields{
    "entity_id", "track_id",  "name", "character",      "outfit",    "behaviour",        "locomotion", "speaking",   "position_world",
    "yaw",       "keypoints", "area", "velocity_world", "bbox_wrap", "visible_fraction", "distance",   "box3d_world"};

fs::path DatasetIn(const fs::path& folder) {
  const fs::path frames = folder / "frames";
  return !fs::exists(folder / kMetaName) && fs::exists(frames / kMetaName) ? frames : folder;
}

// Appends a number in the shortest form that is right to `digits` places.
void Append(std::string& text, double value, int digits) {
  char buffer[400];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, digits).ptr;
  std::string_view number(buffer, static_cast<size_t>(end - buffer));
  if (digits > 0) number = number.substr(0, number.find_last_not_of('0') + 1);
  if (number.ends_with('.')) number.remove_suffix(1);
  text += number;
}

constexpr int kPlaceDigits = 4, kTurnDigits = 7, kTimeDigits = 6;

// One JSON array of a value for each frame.
class Column {
 public:
  void Add(double value, int digits) {
    text_ += Separator();
    Append(text_, value, digits);
  }
  void Add(std::initializer_list<double> values, int digits) {
    text_ += Separator();
    text_ += '[';
    for (const double& value : values) {
      if (&value != values.begin()) text_ += ',';
      Append(text_, value, digits);
    }
    text_ += ']';
  }
  void Add(const std::string& value) { text_ += Separator() + Json(value).dump(); }
  std::string Take() { return text_ + "]"; }

 private:
  const char* Separator() const { return text_.size() > 1 ? "," : ""; }
  std::string text_ = "[";
};

Json CategoriesOf(const NativeDataset& data) {
  Json categories = Json::array();
  for (const auto& [id, c] : data.categories())
    categories.push_back({{"id", id}, {"path", c.path}, {"color", {c.color.r, c.color.g, c.color.b}}, {"thing", c.thing}});
  return categories;
}

Json Described(const NativeDataset& data, const std::string& name) {
  Json products = Json::object();
  for (const ProductFolder& product : ProductFolders(data.spec())) products[product.name] = product.extension;
  Json about{{"name", name},
             {"world", data.spec().world},
             {"environment", data.spec().environment},
             {"seed", data.spec().seed},
             {"people", data.HasPeople()},
             {"products", products},
             {"categories", CategoriesOf(data)}};
  return about;
}

struct ViewColumns {
  Column p, q;
};

std::string ViewText(const View& view, ViewColumns& columns) {
  const Json about{{"suffix", view.suffix}, {"projection", kProjectionNames[static_cast<int>(view.projection)]}};
  std::string text = about.dump();
  text.pop_back();
  return text + ",\"p\":" + columns.p.Take() + ",\"q\":" + columns.q.Take() + "}";
}

}  // namespace

struct ViewedDataset::Impl {
  explicit Impl(const fs::path& folder) : data(DatasetIn(folder)), database(data.folder() / kIndexName, internal::Database::Mode::kRead) {}

  std::string Index() const;
  std::string Appearances() const;
  std::optional<std::string> People(std::string_view picture) const;
  // Frame and view of "STEM[SUFFIX]"; null: there is none.
  std::pair<size_t, const View*> Find(std::string_view picture) const;
  const std::unordered_map<std::string, size_t>& Positions() const;

  NativeDataset data;
  mutable std::mutex mutex;  // of what follows
  mutable internal::Database database;
  mutable std::unordered_map<std::string, size_t> positions;  // by stem, once asked for
};

std::string ViewedDataset::Impl::Index() const {
  Column stems, times, ranges, worlds;
  std::vector<ViewColumns> views(data.views().size());
  for (size_t i = 0; i < data.size(); ++i) {
    const NativeFrame frame = data.Frame(i);
    stems.Add(frame.stem);
    times.Add(1e-9 * static_cast<double>(frame.t_ns), kTimeDigits);
    ranges.Add(frame.json.value("range_median", 0.0), kPlaceDigits);
    worlds.Add(frame.world);
    for (size_t v = 0; v < views.size(); ++v) {
      const RigidTransform X_WC = frame.X_WC(data.views()[v]);
      const Quaternion q = ToQuaternion(X_WC.R);
      views[v].p.Add({X_WC.p.x, X_WC.p.y, X_WC.p.z}, kPlaceDigits);
      views[v].q.Add({q.w, q.x, q.y, q.z}, kTurnDigits);
    }
  }
  std::string text = Described(data, fs::canonical(data.folder()).filename().string()).dump();
  text.pop_back();
  text += ",\"frames\":{\"stem\":" + stems.Take() + ",\"t\":" + times.Take() + ",\"range\":" + ranges.Take() +
          ",\"world\":" + worlds.Take() + "},\"views\":[";
  for (size_t v = 0; v < views.size(); ++v) text += (v ? "," : "") + ViewText(data.views()[v], views[v]);
  return text + "]}";
}

std::string ViewedDataset::Impl::Appearances() const {
  std::unordered_map<int64_t, size_t> position;
  for (size_t i = 0; i < data.size(); ++i) position[data.Frame(i).index] = i;
  const std::lock_guard lock(mutex);
  internal::Statement rows(database, "SELECT entity, frame, SUM(area) FROM segments GROUP BY entity, frame ORDER BY entity, frame");
  std::string text = "{";
  int64_t entity = -1;
  while (rows.Next()) {
    const auto found = position.find(rows.Int(1));
    if (found == position.end()) continue;
    if (rows.Int(0) != entity) {
      text += (entity < 0 ? "\"" : "],\"") + std::to_string(rows.Int(0)) + "\":[";
      entity = rows.Int(0);
    } else {
      text += ',';
    }
    text += std::to_string(found->second) + "," + std::to_string(rows.Int(2));
  }
  return text + (entity < 0 ? "}" : "]}");
}

const std::unordered_map<std::string, size_t>& ViewedDataset::Impl::Positions() const {
  const std::lock_guard lock(mutex);
  if (positions.empty()) {
    for (size_t i = 0; i < data.size(); ++i) positions[data.Frame(i).stem] = i;
  }
  return positions;
}

std::pair<size_t, const View*> ViewedDataset::Impl::Find(std::string_view picture) const {
  for (const View& view : data.views()) {
    if (!picture.ends_with(view.suffix)) continue;
    const auto found = Positions().find(std::string(picture.substr(0, picture.size() - view.suffix.size())));
    if (found != Positions().end()) return {found->second, &view};
  }
  return {0, nullptr};
}

std::optional<std::string> ViewedDataset::Impl::People(std::string_view picture) const {
  const auto [position, view] = Find(picture);
  if (!view) return std::nullopt;
  Json persons = Json::array();
  for (const Json& person : data.Persons(data.Frame(position), *view)) {
    Json& shown = persons.emplace_back(Json::object());
    for (const char* field : kPersonFields) {
      if (person.contains(field)) shown[field] = person[field];
    }
  }
  return persons.dump();
}

ViewedDataset::ViewedDataset(const fs::path& folder) : impl_(std::make_unique<Impl>(folder)) {}
ViewedDataset::~ViewedDataset() = default;

const fs::path& ViewedDataset::folder() const { return impl_->data.folder(); }
std::string ViewedDataset::name() const { return fs::canonical(folder()).filename().string(); }

std::vector<std::string> ViewedDataset::MadeFiles() const {
  std::vector<std::string> files{"index.json", "appearances.json"};
  if (!impl_->data.HasPeople()) return files;
  for (size_t i = 0; i < impl_->data.size(); ++i) {
    for (const View& view : impl_->data.views())
      files.push_back(std::string(kPeople) + impl_->data.Frame(i).stem + view.suffix + std::string(kJsonEnd));
  }
  return files;
}

std::optional<std::string> ViewedDataset::Made(std::string_view path) const {
  if (path == "index.json") return impl_->Index();
  if (path == "appearances.json") return impl_->Appearances();
  if (!path.starts_with(kPeople) || !path.ends_with(kJsonEnd) || !impl_->data.HasPeople()) return std::nullopt;
  return impl_->People(path.substr(kPeople.size(), path.size() - kPeople.size() - kJsonEnd.size()));
}

std::vector<std::string> ViewedDataset::Files() const {
  std::vector<std::string> files;
  for (const char* table : kTables) {
    if (fs::exists(folder() / table)) files.push_back(table);
  }
  for (size_t i = 0; i < impl_->data.size(); ++i) {
    const NativeFrame frame = impl_->data.Frame(i);
    for (const ProductFolder& product : ProductFolders(impl_->data.spec())) {
      for (const View& view : impl_->data.views()) files.push_back(product.name + "/" + impl_->data.FileName(frame, view, product.name));
    }
  }
  return files;
}

}  // namespace airsim360

#include "airsim360/dataset/export/native_dataset.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/file_name.h"
#include "airsim360/base/hash.h"
#include "airsim360/dataset/folder.h"
#include "airsim360/dataset/record/intrinsics.h"
#include "airsim360/dataset/verify.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/palette_png.h"
#include "airsim360/math/angles.h"

namespace airsim360 {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr uint64_t kMostLine = 64 << 20;  // bytes of one line of frames.jsonl

Vec3d Vector(const Json& json) { return {json.at(0), json.at(1), json.at(2)}; }

RigidTransform Pose(const Json& X) {
  const Json& q = X.at("q_wxyz");
  return {ToMatrix({q.at(0), q.at(1), q.at(2), q.at(3)}), Vector(X.at("p"))};
}

GimbalMount GimbalOf(const Json& json) {
  GimbalMount gimbal{.spec = {.p_BG = {json.at("x"), json.at("y"), json.at("z")},
                              .stabilise_yaw = json.at("stabilise_yaw"),
                              .stabilise_pitch = json.at("stabilise_pitch"),
                              .stabilise_roll = json.at("stabilise_roll")},
                     .command = {json.at("yaw_deg").get<double>() * kDegree, json.at("pitch_deg").get<double>() * kDegree,
                                 json.at("roll_deg").get<double>() * kDegree}};
  gimbal.spec.yaw_limit_deg = json.at("yaw_limit_deg");
  gimbal.spec.pitch_low_deg = json.at("pitch_low_deg");
  gimbal.spec.pitch_high_deg = json.at("pitch_high_deg");
  gimbal.spec.roll_limit_deg = json.at("roll_limit_deg");
  return gimbal;
}

RigCamera CameraOf(const Json& json) {
  RigCamera camera{.name = json.at("name"),
                   .projection = ParseChoice<Projection>("projection", json.at("projection").get<std::string>(), kProjectionNames),
                   .width = json.at("width"),
                   .height = json.at("height"),
                   .fov_deg = json.value("fov_deg", 90.0),
                   .p_B = Vector(json.at("p_B"))};
  camera.yaw_deg = json.value("yaw_deg", 0.0);
  camera.pitch_deg = json.value("pitch_deg", 0.0);
  camera.roll_deg = json.value("roll_deg", 0.0);
  if (json.contains("K")) camera.lens = CameraOfIntrinsics(json["K"], json.value("max_theta", std::numbers::pi));
  if (json.contains("X_IC")) camera.X_IC = Pose(json["X_IC"]);
  if (json.contains("gimbal")) camera.gimbal = GimbalOf(json["gimbal"]);
  return camera;
}

// What of the parameters says which files there are.
DatasetSpec SpecOf(const Json& meta) {
  const Json& p = meta.at("parameters");
  DatasetSpec spec;
  spec.command = p.value("command", "collect");
  spec.world = p.at("world");
  spec.seed = p.at("seed");
  spec.projection = ParseChoice<Projection>("projection", p.at("projection").get<std::string>(), kProjectionNames);
  spec.width = p.at("width");
  spec.height = p.at("height");
  spec.fov_deg = p.value("fov_deg", 90.0);
  for (const Json& camera : p.value("cameras", Json::array())) spec.cameras.push_back(CameraOf(camera));
  spec.tier = ParseChoice<Tier>("tier", p.at("tier").get<std::string>(), kTierNames);
  spec.rgb_format = ParseChoice<RgbFormat>("rgb_format", p.at("rgb_format").get<std::string>(), kRgbFormatNames);
  spec.pano_frame = ParseChoice<PanoFrame>("pano_frame", p.at("pano_frame").get<std::string>(), kPanoFrameNames);
  spec.people = p.value("people", std::string());
  spec.traffic = p.value("traffic", std::string());
  spec.environment = p.value("environment", std::string());
  spec.products = WithProducts(spec.products, p.at("products").get<std::vector<std::string>>());
  return spec;
}

}  // namespace

RigidTransform NativeFrame::X_WC(const View& view) const {
  if (view.name.empty() || !json.contains("cameras")) return Pose(json.at("X_WC"));
  return Pose(json.at("cameras").at(view.name).at("X_WC"));
}
RigidTransform NativeFrame::X_WB(const View& view) const {
  return json.contains("X_WB") ? Pose(json.at("X_WB")) : X_WC(view) * view.X_BC.inverse();
}
Vec3d NativeFrame::v_WB() const { return Vector(json.at("v_WB")); }
Vec3d NativeFrame::w_WB_B() const { return Vector(json.at("w_WB_B")); }

NativeDataset::NativeDataset(fs::path folder) : folder_(std::move(folder)) {
  if (!fs::is_directory(folder_)) throw InputError("'" + folder_.string() + "' is not a folder");
  if (!fs::exists(folder_ / kMetaName)) throw InputError("'" + folder_.string() + "' is not a dataset: it has no " + kMetaName);
  if (!fs::exists(folder_ / kChecksumsName) || !fs::exists(folder_ / "frames.jsonl"))
    throw InputError("'" + folder_.string() + "' is not complete: run its collection again to finish it");
  ReadMeta();
  index_ = std::make_unique<DatasetIndex>(folder_, DatasetIndex::Mode::kRead);
  FindLines();
}

NativeDataset::~NativeDataset() {
  if (fd_ >= 0) ::close(fd_);
}

void NativeDataset::ReadMeta() {
  const std::string path = (folder_ / kMetaName).string();
  meta_ = Json::parse(ReadTextFile(folder_ / kMetaName), nullptr, false);
  if (!meta_.is_object()) throw InputError(path + ": damaged");
  try {
    spec_ = SpecOf(meta_);
    views_ = Views(spec_);
    for (const Json& json : meta_.at("categories")) {
      const Json& color = json.at("color");
      NativeCategory category{.id = json.at("id"),
                              .path = json.at("path"),
                              .color = {color.at(0), color.at(1), color.at(2)},
                              .thing = json.at("kind") == "thing",
                              .ade20k = json.value("ade20k", -1),
                              .cityscapes = json.value("cityscapes", -1),
                              .coco = json.value("coco", -1)};
      categories_[category.id] = std::move(category);
    }
  } catch (const Json::exception& error) {
    throw InputError(path + ": not as this version writes it (" + error.what() + ")");
  }
}

void NativeDataset::FindLines() {
  const fs::path path = folder_ / "frames.jsonl";
  fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd_ < 0) throw InputError(path.string() + ": cannot read");
  std::vector<char> buffer(1 << 20);
  uint64_t at = 0;
  bool begins = true;
  for (;;) {
    const ssize_t n = ::pread(fd_, buffer.data(), buffer.size(), static_cast<off_t>(at));
    if (n < 0) throw InputError(path.string() + ": cannot read");
    if (n == 0) break;
    for (ssize_t i = 0; i < n; ++i) {
      if (begins) lines_.push_back(at + static_cast<uint64_t>(i));
      begins = buffer[static_cast<size_t>(i)] == '\n';
    }
    at += static_cast<uint64_t>(n);
  }
  end_ = at;
  if (lines_.empty()) throw InputError(path.string() + ": no frames");
}

NativeFrame NativeDataset::Frame(size_t position) const {
  const uint64_t begin = lines_.at(position), end = position + 1 < lines_.size() ? lines_[position + 1] : end_;
  const std::string place = (folder_ / "frames.jsonl").string() + ":" + std::to_string(position + 1);
  if (end - begin > kMostLine) throw InputError(place + ": too long a line");
  std::string text(end - begin, '\0');
  if (::pread(fd_, text.data(), text.size(), static_cast<off_t>(begin)) != static_cast<ssize_t>(text.size()))
    throw InputError(place + ": cannot read");
  NativeFrame frame{.position = position, .stem = {}, .world = {}, .json = Json::parse(text, nullptr, false)};
  try {
    frame.index = frame.json.at("index");
    frame.stem = frame.json.at("stem");
    frame.t_ns = frame.json.at("t_ns");
    frame.world = frame.json.value("world", spec_.world);
    (void)Pose(frame.json.at("X_WC"));
    (void)frame.json.at("sha256");
  } catch (const Json::exception&) {
    throw InputError(place + ": not a frame (cut off?); 'airsim360 verify' tells what else is damaged");
  }
  CheckFileName(place + ": stem", frame.stem);
  return frame;
}

std::string NativeDataset::Hash() const { return Sha256HexOfFile(folder_ / kChecksumsName); }

void NativeDataset::CheckDescription() const {
  constexpr const char* kHint = "; 'airsim360 verify' lists all such files";
  std::vector<Finding> unreadable;
  const Checksums checksums = ReadChecksums(folder_, unreadable);
  for (const char* name : {kMetaName, "frames.jsonl", kIndexName, "entities.json", "vehicles.jsonl"}) {
    const auto sum = checksums.find(name);
    if (sum == checksums.end()) {
      // Only datasets with traffic have vehicles.
      if (std::string_view(name) == "vehicles.jsonl" && spec_.traffic.empty()) continue;
      throw InputError((folder_ / kChecksumsName).string() + ": damaged or cut off: it does not name " + name + kHint);
    }
    const fs::path path = folder_ / name;
    if (!fs::is_regular_file(path)) throw InputError(path.string() + ": missing" + kHint);
    if (Sha256HexOfFile(path) != sum->second)
      throw InputError(path.string() + ": damaged or cut off (its SHA-256 is not that of " + kChecksumsName + ")" + kHint);
  }
}

const NativeCategory& NativeDataset::category(CategoryId id) const {
  const auto found = categories_.find(id);
  if (found == categories_.end()) throw InputError((folder_ / kMetaName).string() + ": no category has the id " + std::to_string(id));
  return found->second;
}

std::vector<std::string> NativeDataset::attributions() const {
  std::vector<std::string> lines;
  for (const Json& line : meta_.value("attributions", Json::array())) lines.push_back(line.get<std::string>());
  return lines;
}

bool NativeDataset::Has(const std::string& product) const {
  const auto folders = ProductFolders(spec_);
  return std::ranges::any_of(folders, [&](const ProductFolder& f) { return f.name == product; });
}

std::string NativeDataset::Extension(const std::string& product) const {
  for (const ProductFolder& folder : ProductFolders(spec_)) {
    if (folder.name == product) return folder.extension;
  }
  throw RuntimeError("the dataset has no product '" + product + "'");
}

std::string NativeDataset::FileName(const NativeFrame& frame, const View& view, const std::string& product) const {
  return frame.stem + view.suffix + Extension(product);
}

Bytes NativeDataset::Read(const NativeFrame& frame, const View& view, const std::string& product) const {
  const fs::path path = folder_ / product / FileName(frame, view, product);
  Bytes bytes = ReadFile(path);
  const Json& sums = frame.json.at("sha256");
  const auto sum = sums.find(product + view.suffix);
  if (sum == sums.end() || !sum->is_string())
    throw InputError((folder_ / "frames.jsonl").string() + ":" + std::to_string(frame.position + 1) + ": no checksum of " + product +
                     view.suffix);
  if (Sha256Hex(bytes) != sum->get<std::string>())
    throw InputError(path.string() +
                     ": damaged or cut off (its SHA-256 is not that of frames.jsonl); "
                     "'airsim360 verify' lists all such files");
  return bytes;
}

Image<Rgb8> NativeDataset::Rgb(const NativeFrame& frame, const View& view) const {
  const Image<Rgba8> full = DecodeRgba8(Read(frame, view, "rgb"), FileName(frame, view, "rgb"));
  Image<Rgb8> picture(full.width(), full.height());
  for (size_t i = 0; i < full.size(); ++i) picture.pixels()[i] = {full.pixels()[i].r, full.pixels()[i].g, full.pixels()[i].b};
  return picture;
}

Image<float> NativeDataset::Range(const NativeFrame& frame, const View& view) const {
  return DecodeExr(Read(frame, view, "range"), FileName(frame, view, "range"));
}

Image<CategoryId> NativeDataset::Semantic(const NativeFrame& frame, const View& view) const {
  return DecodeLabelPng(Read(frame, view, "semantic"), FileName(frame, view, "semantic"));
}

Image<EntityId> NativeDataset::Entity(const NativeFrame& frame, const View& view) const {
  return DecodeIdPng(Read(frame, view, "entity"), FileName(frame, view, "entity"));
}

std::vector<Segment> NativeDataset::Segments(const NativeFrame& frame, const View& view) const {
  const std::lock_guard lock(index_mutex_);
  return index_->Segments(frame.index, view.suffix);
}

std::vector<Json> NativeDataset::Persons(const NativeFrame& frame, const View& view) const {
  std::vector<std::string> texts;
  {
    const std::lock_guard lock(index_mutex_);
    texts = index_->Persons(frame.index, view.suffix);
  }
  std::vector<Json> persons;
  for (const std::string& text : texts) persons.push_back(Json::parse(text));
  return persons;
}

}  // namespace airsim360

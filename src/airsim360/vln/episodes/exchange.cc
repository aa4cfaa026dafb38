#include "airsim360/vln/episodes/exchange.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/planning/routes/search.h"
#include "airsim360/vln/predicates/query_json.h"

namespace airsim360 {
namespace {

using internal::PointOf;
using internal::Rounded;
using internal::VlnJson;

constexpr size_t kMostRecords = 1'000'000;

// This module's boundary to worlds of north, east, down (AirSim's): a heading there is clockwise from north.
Vec3d Ned(Vec3d p) { return {p.y, p.x, -p.z}; }
double NedYaw(double yaw) { return std::remainder(kPi / 2 - yaw, 2 * kPi); }

VlnJson Json3(Vec3d p) { return internal::ToJson(p); }
VlnJson Quaternion(double yaw) { return {std::cos(yaw / 2), 0, 0, std::sin(yaw / 2)}; }  // w, x, y, z

// One record, and what is read from it; `where` names it in messages.
struct Record {
  const VlnJson& json;
  std::string where;

  const VlnJson& At(const VlnJson& of, const char* name, const std::string& path) const {
    if (!of.is_object() || !of.contains(name)) throw InputError(where + path + "." + name + ": is missing");
    return of.at(name);
  }
  const VlnJson& At(const char* name) const { return At(json, name, ""); }
  const VlnJson& First(const char* name) const {
    const VlnJson& list = At(name);
    if (!list.is_array() || list.empty()) throw InputError(where + "." + name + ": is no list with something in it");
    return list[0];
  }
  std::string Text(const VlnJson& value, const std::string& path) const {
    if (!value.is_string() || value.get<std::string>().empty()) throw InputError(where + path + ": is no text");
    return value.get<std::string>().substr(0, 2000);
  }
  // The first three numbers of each row.
  std::vector<Vec3d> Path(const char* name) const {
    First(name);
    std::vector<Vec3d> points;
    for (const VlnJson& row : At(name)) {
      if (!row.is_array() || row.size() < 3)
        throw InputError(where + "." + name + "[" + std::to_string(points.size()) + "]: is no [x, y, z]");
      points.push_back(PointOf(VlnJson::array({row[0], row[1], row[2]}), where + "." + name));
    }
    return points;
  }
  double Yaw(const VlnJson& quaternion, const std::string& path) const {
    if (!quaternion.is_array() || quaternion.size() != 4) throw InputError(where + path + ": is no quaternion [w, x, y, z]");
    double q[4];
    for (size_t i = 0; i < 4; ++i) {
      if (!quaternion[i].is_number() || !(std::abs(quaternion[i].get<double>()) <= 2))
        throw InputError(where + path + ": is no quaternion [w, x, y, z]");
      q[i] = quaternion[i].get<double>();
    }
    return std::atan2(2 * (q[0] * q[3] + q[1] * q[2]), 1 - 2 * (q[2] * q[2] + q[3] * q[3]));
  }
  std::string Id(const char* name, size_t number) const {
    if (!json.contains(name)) return std::to_string(number);
    const VlnJson& id = json.at(name);
    return id.is_string() ? id.get<std::string>().substr(0, 200) : id.dump().substr(0, 40);
  }
};

struct Form {
  const char* name;
  const char* list;  ///< field that holds the records; "" = the file is the list
  std::function<void(const LanguageEpisode&, VlnJson&)> write;
  std::function<void(const Record&, LanguageEpisode&)> read;
};

void WriteAerial(const LanguageEpisode& e, VlnJson& r) {
  r["episode_id"] = e.id;
  if (!r.contains("trajectory_id")) r["trajectory_id"] = e.id;
  if (!r.contains("scene_id")) r["scene_id"] = e.world;
  r["instruction"]["instruction_text"] = e.instruction;
  r["start_position"] = Json3(Ned(e.start.p_W));
  r["start_rotation"] = Quaternion(NedYaw(e.start.yaw));
  r["goals"] = VlnJson::array({VlnJson{{"position", Json3(Ned(e.goal))}, {"radius", e.radius}}});
  VlnJson path = VlnJson::array();
  for (const Vec3d& p : e.ref) path.push_back(Json3(Ned(p)));
  r["reference_path"] = path;
  if (!r.contains("actions")) r["actions"] = VlnJson::array();
}

void ReadAerial(const Record& r, LanguageEpisode& e) {
  e.instruction = r.Text(r.At(r.At("instruction"), "instruction_text", ".instruction"), ".instruction.instruction_text");
  e.start = {Ned(PointOf(r.At("start_position"), r.where + ".start_position")), NedYaw(r.Yaw(r.At("start_rotation"), ".start_rotation"))};
  e.goal = Ned(PointOf(r.At(r.First("goals"), "position", ".goals[0]"), r.where + ".goals[0].position"));
  for (const Vec3d& p : r.Path("reference_path")) e.ref.push_back(Ned(p));
}

void WriteOpenFly(const LanguageEpisode& e, VlnJson& r) {
  if (!r.contains("image_path")) r["image_path"] = e.id;
  r["gpt_instruction"] = e.instruction;
  VlnJson path = VlnJson::array(), yaws = VlnJson::array();
  for (size_t i = 0; i < e.ref.size(); ++i) {
    path.push_back(Json3(e.ref[i]));
    const Vec3d d = i + 1 < e.ref.size() ? e.ref[i + 1] - e.ref[i] : Vec3d{};
    yaws.push_back(i == 0 ? e.start.yaw : d.x == 0 && d.y == 0 ? yaws.back().get<double>() : std::atan2(d.y, d.x));
  }
  if (!r.contains("action")) r["action"] = VlnJson::array();
  if (!r.contains("index_list")) r["index_list"] = VlnJson::array();
  r["pos"] = path;
  if (!r.contains("yaw")) r["yaw"] = yaws;
}

void ReadOpenFly(const Record& r, LanguageEpisode& e) {
  e.instruction = r.Text(r.At("gpt_instruction"), ".gpt_instruction");
  e.ref = r.Path("pos");
  const VlnJson& yaw = r.First("yaw");
  if (!yaw.is_number() || !(std::abs(yaw.get<double>()) <= 100)) throw InputError(r.where + ".yaw[0]: is no angle");
  e.start = {e.ref.front(), std::remainder(yaw.get<double>(), 2 * kPi)};
  e.goal = e.ref.back();
}

void WriteCityNav(const LanguageEpisode& e, VlnJson& r) {
  if (!r.contains("area")) r["area"] = e.world;
  if (!r.contains("block")) r["block"] = std::to_string(e.world_seed);
  if (!r.contains("object_ids")) r["object_ids"] = e.entities;
  if (!r.contains("ann_ids")) r["ann_ids"] = VlnJson::array({e.id});
  r["descriptions"] = VlnJson::array({e.instruction});
  VlnJson path = VlnJson::array();
  for (const Vec3d& p : e.ref) path.push_back({Rounded(p.x), Rounded(p.y), Rounded(p.z), e.start.yaw, 0});
  if (!r.contains("trajectory")) r["trajectory"] = path;
  r["target_positions"] = VlnJson::array({Json3(e.goal)});
  if (!r.contains("split")) r["split"] = e.split;
}

void ReadCityNav(const Record& r, LanguageEpisode& e) {
  e.instruction = r.Text(r.First("descriptions"), ".descriptions[0]");
  e.ref = r.Path("trajectory");
  e.goal = r.Path("target_positions").front();
  const VlnJson& row = r.First("trajectory");
  // Rows of five end with yaw and pitch, rows of six with a direction.
  double yaw = 0;
  if (row.size() == 5 && row[3].is_number()) yaw = row[3].get<double>();
  if (row.size() == 6 && row[3].is_number() && row[4].is_number()) yaw = std::atan2(row[4].get<double>(), row[3].get<double>());
  if (!std::isfinite(yaw)) throw InputError(r.where + ".trajectory[0]: has no heading");
  e.start = {e.ref.front(), std::remainder(yaw, 2 * kPi)};
}

void WriteTravel(const LanguageEpisode& e, VlnJson& r) {
  VlnJson path = VlnJson::array();
  for (const Vec3d& p : e.ref) path.push_back(Json3(Ned(p)));
  r["trajectory_raw_detailed"] = path;
  if (!r.contains("start_yaw")) r["start_yaw"] = NedYaw(e.start.yaw);
  r["conversations"] = VlnJson::array({VlnJson{{"from", "human"}, {"value", e.instruction}}});
  r["mark"]["object_name"] = e.name;
  r["mark"]["target"]["position"] = Json3(Ned(e.goal));
}

void ReadTravel(const Record& r, LanguageEpisode& e) {
  e.instruction = r.Text(r.At(r.First("conversations"), "value", ".conversations[0]"), ".conversations[0].value");
  for (const Vec3d& p : r.Path("trajectory_raw_detailed")) e.ref.push_back(Ned(p));
  e.goal = Ned(PointOf(r.At(r.At(r.At("mark"), "target", ".mark"), "position", ".mark.target"), r.where + ".mark.target.position"));
  if (r.json["mark"].contains("object_name") && r.json["mark"]["object_name"].is_string())
    e.name = r.json["mark"]["object_name"].get<std::string>().substr(0, 200);
  double yaw = 0;
  if (r.json.contains("start_yaw") && r.json["start_yaw"].is_number()) yaw = r.json["start_yaw"].get<double>();
  e.start = {e.ref.front(), std::isfinite(yaw) ? NedYaw(std::remainder(yaw, 2 * kPi)) : 0};
}

void WriteUavOn(const LanguageEpisode& e, VlnJson& r) {
  r["episode_id"] = e.id;
  if (!r.contains("map_name")) r["map_name"] = e.world;
  r["true_name"] = e.name;
  if (!r.contains("size")) r["size"] = "mid";
  if (!r.contains("pose")) r["pose"] = VlnJson::array({Json3(Ned(e.goal))});
  r["start_pose"] = {{"start_position", Json3(Ned(e.start.p_W))}, {"start_quaternionr", Quaternion(NedYaw(e.start.yaw))}};
  r["description"] = e.instruction;
  r["info"]["euclidean_distance"] = Rounded(Norm(e.goal - e.start.p_W));
  r["info"]["geodesic_distance"] = Rounded(e.geodesic_length);
}

void ReadUavOn(const Record& r, LanguageEpisode& e) {
  e.instruction = r.Text(r.At("description"), ".description");
  e.goal = Ned(r.Path("pose").front());
  const VlnJson& start = r.At("start_pose");
  e.start = {Ned(PointOf(r.At(start, "start_position", ".start_pose"), r.where + ".start_pose.start_position")),
             NedYaw(r.Yaw(r.At(start, "start_quaternionr", ".start_pose"), ".start_pose.start_quaternionr"))};
  if (r.json.contains("true_name") && r.json["true_name"].is_string()) e.name = r.json["true_name"].get<std::string>().substr(0, 200);
  // No way is given: the straight one stands for it.
  e.ref = {e.start.p_W, e.goal};
}

const std::vector<Form>& Forms() {
  static const std::vector<Form> forms = {{"aerialvln", "episodes", WriteAerial, ReadAerial},
                                          {"openfly", "", WriteOpenFly, ReadOpenFly},
                                          {"citynav", "", WriteCityNav, ReadCityNav},
                                          {"traveluav", "", WriteTravel, ReadTravel},
                                          {"uavon", "episodes", WriteUavOn, ReadUavOn}};
  return forms;
}

const Form& FindForm(const std::string& format) {
  for (const Form& form : Forms())
    if (format == form.name) return form;
  throw InputError("--format: " + UnknownChoiceMessage("format", format, ExchangeFormats()));
}

}  // namespace

const std::vector<std::string>& ExchangeFormats() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Form& form : Forms()) list.emplace_back(form.name);
    return list;
  }();
  return names;
}

std::string ExportEpisodes(const std::vector<LanguageEpisode>& episodes, const std::string& format) {
  const Form& form = FindForm(format);
  VlnJson list = VlnJson::array();
  for (const LanguageEpisode& e : episodes) {
    VlnJson record = VlnJson::object();
    if (!e.source.empty()) {
      const VlnJson source = VlnJson::parse(e.source);
      if (source.value("format", "") == format && source.contains("record")) record = source["record"];
    }
    form.write(e, record);
    list.push_back(std::move(record));
  }
  return (*form.list ? VlnJson{{form.list, list}} : list).dump(1) + "\n";
}

std::vector<LanguageEpisode> ImportEpisodes(const std::string& text, const std::string& name, const std::string& format,
                                            const std::string& world) {
  const Form& form = FindForm(format);
  const VlnJson json = internal::ParseVlnJson(text, name);
  const bool wrapped = *form.list && json.is_object() && json.contains(form.list);
  const VlnJson& list = wrapped ? json.at(form.list) : json;
  if (!list.is_array() || list.empty() || list.size() > kMostRecords) throw InputError(name + ": is no list of records of " + format);
  std::vector<LanguageEpisode> episodes;
  for (size_t i = 0; i < list.size(); ++i) {
    const Record record{list[i], name + "[" + std::to_string(i) + "]"};
    if (!list[i].is_object()) throw InputError(record.where + ": is no object");
    LanguageEpisode e;
    e.id = record.Id("episode_id", i);
    e.template_id = format;
    e.world = world;
    form.read(record, e);
    e.geodesic_length = PolylineLength(e.ref);
    e.source = VlnJson{{"format", format}, {"record", list[i]}}.dump();
    episodes.push_back(std::move(e));
  }
  return episodes;
}

}  // namespace airsim360

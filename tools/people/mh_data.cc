#include "mh_data.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360::bake {
namespace {

using Json = nlohmann::json;
constexpr int kVertices = 19158;

// What upstream (makehumancommunity, LICENSE.ASSETS.md) has released as CC0 and what is vertex-identical to
// it: see docs/guide/people.md. Everything else of the package is refused.
const std::map<std::string, std::set<std::string>> kAllowed = {
    {"clothes", {"fedora", "fedora_cocked", "female_casualsuit01", "female_casualsuit02", "female_elegantsuit01", "female_sportsuit01", "male_casualsuit01", "male_casualsuit02", "male_casualsuit03",
                 "male_casualsuit04", "male_casualsuit05", "male_casualsuit06", "male_elegantsuit01", "shoes01", "shoes02", "shoes03", "shoes04", "shoes05", "shoes06"}},
    {"hair", {"afro01", "bob01", "bob02", "Braid01", "long01", "ponytail01", "short01", "short02", "short03", "short04"}},
    {"eyebrows", {"eyebrow001", "eyebrow002", "eyebrow003", "eyebrow004", "eyebrow005", "eyebrow006", "eyebrow007", "eyebrow008", "eyebrow009", "eyebrow010", "eyebrow011", "eyebrow012"}},
};

Json ReadJson(const std::filesystem::path& path) {
  try {
    return Json::parse(ReadTextFile(path));
  } catch (const Json::exception& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

// three.js JSON 3.1: flat lists; each face begins with a bit mask.
SourceMesh ReadMesh(const Json& j, bool body_only) {
  SourceMesh mesh;
  const auto v = j.at("vertices").get<std::vector<float>>(), uv = j.at("uvs").at(0).get<std::vector<float>>();
  for (size_t i = 0; i + 2 < v.size(); i += 3) mesh.positions.push_back({v[i], v[i + 1], v[i + 2]});
  for (size_t i = 0; i + 1 < uv.size(); i += 2) mesh.uvs.push_back({uv[i], 1 - uv[i + 1]});
  const auto f = j.at("faces").get<std::vector<int>>();
  for (size_t i = 0; i < f.size();) {
    const int type = f[i++], corners = type & 1 ? 4 : 3;
    std::array<int, 4> a{}, b{};
    const auto read = [&](std::array<int, 4>& to) {
      for (int k = 0; k < corners; ++k) to[static_cast<size_t>(k)] = f.at(i++);
      if (corners == 3) to[3] = to[2];
    };
    read(a);
    const int material = type & 2 ? f.at(i++) : 0;
    if (type & 8) read(b);
    if (type & 16) ++i;
    if (type & 32) i += static_cast<size_t>(corners);
    if (body_only && material != 0) continue;
    mesh.faces.push_back(a);
    mesh.uv_faces.push_back(b);
  }
  const auto bones = j.at("skinIndices").get<std::vector<int>>();
  const auto weights = j.at("skinWeights").get<std::vector<float>>();
  for (size_t i = 0; i + 3 < bones.size(); i += 4) {
    mesh.bones.push_back({bones[i], bones[i + 1], bones[i + 2], bones[i + 3]});
    mesh.weights.push_back({weights[i], weights[i + 1], weights[i + 2], weights[i + 3]});
  }
  return mesh;
}

// min, average and max weights of a slider.
std::array<std::pair<std::string, double>, 3> Thirds(double s, const std::string& what) {
  const double high = std::max(0.0, 2 * s - 1), low = std::max(0.0, 1 - 2 * s);
  return {{{"min" + what, low}, {"average" + what, 1 - high - low}, {"max" + what, high}}};
}

}  // namespace

Package::Package(std::filesystem::path folder) : folder_(std::move(folder)) {
  const Json j = ReadJson(folder_ / "public/data/models/human_full_size.json");
  base_.mesh = ReadMesh(j, true);
  if (base_.mesh.positions.size() != kVertices) throw InputError(folder_.string() + ": not the base mesh hm08");
  for (const Json& bone : j.at("bones")) {
    base_.bone_names.push_back(bone.at("name").get<std::string>());
    base_.bone_parents.push_back(bone.at("parent").get<int>());
  }
  for (const auto& [name, list] : j.at("metadata").at("joint_pos_idxs").items()) base_.joints[name] = list.get<std::vector<int>>();

  // Rows of the morphs are in the order of their sorted names.
  const Json list = ReadJson(folder_ / "src/json/targets/target-list.json").at("targets");
  std::vector<std::string> names;
  for (const auto& item : list.items()) names.push_back(item.key());
  std::ranges::sort(names);
  for (size_t i = 0; i < names.size(); ++i) rows_[names[i]] = static_cast<int>(i);
  targets_ = (folder_ / "public/data/targets/targets.bin").string();
}

std::vector<Vec3f> Package::Morph(const Sliders& s) const {
  std::vector<Vec3f> v = base_.mesh.positions;
  std::ifstream file(targets_, std::ios::binary);
  std::vector<int16_t> row(size_t{3} * kVertices);
  const auto add = [&](const std::string& name, double weight) {
    const auto found = rows_.find("data/targets/macrodetails/" + name + ".target");
    if (weight <= 1e-4 || found == rows_.end()) return;
    file.seekg(static_cast<std::streamoff>(found->second) * kVertices * 6);
    file.read(reinterpret_cast<char*>(row.data()), static_cast<std::streamsize>(row.size() * 2));
    if (!file) throw InputError(targets_ + ": cut off");
    const auto w = static_cast<float>(weight * 1e-3);
    for (size_t i = 0; i < v.size(); ++i) v[i] += Vec3f{w * row[3 * i], w * row[3 * i + 1], w * row[3 * i + 2]};
  };
  double baby = 0, child = 0, young = 0, old = 0;
  if (s.age < 0.5) {
    baby = std::max(0.0, 1 - s.age / 0.1875);
    young = std::max(0.0, (s.age - 0.1875) / 0.3125);
    child = std::max(0.0, std::min(1.0, s.age / 0.1875) - young);
  } else {
    old = 2 * s.age - 1;
    young = 1 - old;
  }
  const std::pair<std::string, double> ages[] = {{"baby", baby}, {"child", child}, {"young", young}, {"old", old}};
  const std::pair<std::string, double> sexes[] = {{"male", s.male}, {"female", 1 - s.male}};
  const std::string race = std::array{"caucasian", "african", "asian"}[static_cast<size_t>(s.race)];
  for (const auto& [sex, ws] : sexes) {
    for (const auto& [age, wa] : ages) {
      add(race + "-" + sex + "-" + age, ws * wa);
      for (const auto& [muscle, wm] : Thirds(s.muscle, "muscle")) {
        for (const auto& [weight, ww] : Thirds(s.weight, "weight")) {
          const std::string name = sex + "-" + age + "-" + muscle + "-" + weight;
          add("universal-" + name, ws * wa * wm * ww);
          for (const auto& [height, wh] : Thirds(s.height, "height")) add("height/" + name + "-" + height, ws * wa * wm * ww * wh);
        }
      }
    }
  }
  return v;
}

Proxy Package::ReadProxy(const std::string& kind, const std::string& name) const {
  const auto list = kAllowed.find(kind);
  if (list == kAllowed.end() || !list->second.contains(name)) throw InputError(kind + "/" + name + " is not on the list of CC0 items");
  const std::filesystem::path folder = folder_ / "public/data/proxies" / kind / name;
  const Json j = ReadJson(folder / (name + ".json"));
  Proxy proxy;
  proxy.name = name;
  proxy.mesh = ReadMesh(j, false);
  for (const Json& r : j.at("ref_vIdxs")) proxy.refs.push_back(r.get<std::array<int, 3>>());
  for (const Json& w : j.at("weights")) proxy.weights.push_back(w.get<std::array<float, 3>>());
  for (const Json& o : j.at("offsets")) {
    const auto a = o.get<std::array<float, 3>>();
    proxy.offsets.push_back({a[0], a[1], a[2]});
  }
  const size_t count = proxy.mesh.positions.size();
  if (proxy.refs.size() != count || proxy.weights.size() != count || proxy.offsets.size() != count) throw InputError((folder / name).string() + ": lists of unequal length");
  for (const auto& r : proxy.refs) {
    for (int k : r) {
      if (k < 0 || k >= kVertices) throw InputError((folder / name).string() + ": reference out of range");
    }
  }
  proxy.hides.assign(kVertices, false);
  if (const auto& metadata = j.at("metadata"); metadata.contains("deleteVerts") && metadata["deleteVerts"].size() == kVertices) {
    for (size_t i = 0; i < kVertices; ++i) {
      const Json& d = metadata["deleteVerts"][i];
      proxy.hides[i] = d.is_boolean() ? d.get<bool>() : d.get<int>() != 0;
    }
  }
  if (const std::string map = j.at("materials").at(0).value("mapDiffuse", ""); !map.empty()) proxy.picture = folder / map;
  return proxy;
}

std::filesystem::path Package::Skin(const std::string& age, const std::string& race, bool male) const {
  const std::filesystem::path folder = folder_ / "public/data/skins" / (age + "_" + race + (male ? "_male" : "_female")) / "textures";
  std::vector<std::filesystem::path> pictures;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().find("skinned") != std::string::npos) pictures.push_back(entry.path());
  }
  std::ranges::sort(pictures);
  if (pictures.empty()) throw InputError(folder.string() + ": no skin");
  return pictures.front();
}

std::vector<Vec3f> FitProxy(const Proxy& proxy, const std::vector<Vec3f>& body, const std::vector<Vec3f>& original) {
  std::vector<Vec3f> out(proxy.refs.size());
  for (size_t i = 0; i < out.size(); ++i) {
    const size_t a = static_cast<size_t>(proxy.refs[i][0]), b = static_cast<size_t>(proxy.refs[i][1]), c = static_cast<size_t>(proxy.refs[i][2]);
    // Offsets grow with the triangle they stand on.
    const float before = Norm(Cross(original[b] - original[a], original[c] - original[a]));
    const float after = Norm(Cross(body[b] - body[a], body[c] - body[a]));
    const float scale = before > 1e-8f ? std::clamp(std::sqrt(after / before), 0.4f, 1.4f) : 1;
    const auto& w = proxy.weights[i];
    out[i] = body[a] * w[0] + body[b] * w[1] + body[c] * w[2] + proxy.offsets[i] * scale;
  }
  return out;
}

double AgeSlider(double years) {
  if (years < 10) return 0.1875 * std::max(0.0, years - 1) / 9;
  if (years < 25) return 0.1875 + 0.3125 * (years - 10) / 15;
  return 0.5 + 0.5 * std::min(1.0, (years - 25) / 65);
}

}  // namespace airsim360::bake

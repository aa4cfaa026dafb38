#include "baked_person.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <numeric>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs.h"
#include "airsim360/people/body/anatomy.h"
#include "airsim360/people/body/loft.h"
#include "airsim360/people/body/seat_sockets.h"

namespace airsim360::bake {
namespace {

using internal::At;
constexpr size_t kTrianglesOf[] = {26000, 6000, 1500, 300};

Vec3f ToPerson(Vec3f v) { return {0.1f * v.z, 0.1f * v.x, 0.1f * v.y}; }

// The joint of ours that a bone of MakeHuman follows; its own children follow it by name.
Joint JointOf(const std::string& full) {
  const std::string bone = full.substr(0, full.find("____"));
  const bool left = bone.ends_with(".L");
  const std::string b = bone.substr(0, bone.find('.'));
  const auto side = [&](Joint l, Joint r) { return left ? l : r; };
  const auto is = [&](std::string_view prefix) { return b.starts_with(prefix); };
  if (b == "root" || b == "spine05" || b == "pelvis") return Joint::kPelvis;
  if (b == "spine04") return Joint::kSpine1;
  if (b == "spine03") return Joint::kSpine2;
  if (is("spine") || b == "breast") return Joint::kSpine3;
  if (is("neck")) return Joint::kNeck;
  if (b == "clavicle" || b == "shoulder01") return side(Joint::kLeftClavicle, Joint::kRightClavicle);
  if (is("upperarm")) return side(Joint::kLeftShoulder, Joint::kRightShoulder);
  if (is("lowerarm")) return side(Joint::kLeftElbow, Joint::kRightElbow);
  if (b == "wrist" || is("metacarpal")) return side(Joint::kLeftWrist, Joint::kRightWrist);
  if (b == "finger1-1") return side(Joint::kLeftThumb1, Joint::kRightThumb1);
  if (is("finger1")) return side(Joint::kLeftThumb2, Joint::kRightThumb2);
  if (is("finger")) return b.ends_with("-1") ? side(Joint::kLeftFingers1, Joint::kRightFingers1) : side(Joint::kLeftFingers2, Joint::kRightFingers2);
  if (is("upperleg")) return side(Joint::kLeftHip, Joint::kRightHip);
  if (is("lowerleg")) return side(Joint::kLeftKnee, Joint::kRightKnee);
  if (b == "foot") return side(Joint::kLeftAnkle, Joint::kRightAnkle);
  if (is("toe")) return side(Joint::kLeftToes, Joint::kRightToes);
  return Joint::kHead;  // head, jaw, eyes, face, tongue
}

// Which end of which bone each of our joints is.
std::array<Vec3d, kJointCount> Joints(const BaseHuman& base, const std::vector<Vec3f>& v) {
  const auto mean = [&](const std::string& end) {
    const auto found = base.joints.find(end);
    if (found == base.joints.end()) throw InputError("base mesh has no joint '" + end + "'");
    Vec3d sum{};
    for (int i : found->second) sum += VecCast<double>(ToPerson(v[static_cast<size_t>(i)]));
    return sum / static_cast<double>(found->second.size());
  };
  std::array<Vec3d, kJointCount> q;
  const auto set = [&](Joint j, const std::string& bone) { q[At(j)] = mean(bone + "____head"); };
  set(Joint::kPelvis, "spine05");
  set(Joint::kSpine1, "spine04");
  set(Joint::kSpine2, "spine03");
  set(Joint::kSpine3, "spine02");
  set(Joint::kNeck, "neck01");
  set(Joint::kHead, "head");
  const std::pair<Joint, std::string> sides[] = {
      {Joint::kLeftClavicle, "clavicle"}, {Joint::kLeftShoulder, "upperarm01"}, {Joint::kLeftElbow, "lowerarm01"}, {Joint::kLeftWrist, "wrist"},
      {Joint::kLeftHip, "upperleg01"}, {Joint::kLeftKnee, "lowerleg01"}, {Joint::kLeftAnkle, "foot"}, {Joint::kLeftToes, "toe2-1"},
      {Joint::kLeftThumb1, "finger1-1"}, {Joint::kLeftThumb2, "finger1-2"}, {Joint::kLeftFingers1, "finger3-1"}, {Joint::kLeftFingers2, "finger3-2"}};
  for (const auto& [joint, bone] : sides) {
    set(joint, bone + ".L");
    set(internal::MirrorOf(joint), bone + ".R");
  }
  return q;
}

// Weights of the package folded onto our joints. A third of what lies on the lower forearm goes to the wrist,
// so that the turn of the hand is spread.
Influences Folded(const BaseHuman& base, const std::array<int, 4>& bones, const std::array<float, 4>& weights) {
  std::array<double, kJointCount> sum{};
  for (size_t k = 0; k < 4; ++k) {
    if (weights[k] <= 0 || bones[k] < 0 || static_cast<size_t>(bones[k]) >= base.bone_names.size()) continue;
    const std::string& name = base.bone_names[static_cast<size_t>(bones[k])];
    const Joint joint = JointOf(name);
    const double share = name.starts_with("lowerarm02") ? 0.35 : 0;
    sum[At(joint)] += weights[k] * (1 - share);
    if (share > 0) sum[At(joint == Joint::kLeftElbow ? Joint::kLeftWrist : Joint::kRightWrist)] += weights[k] * share;
  }
  std::array<size_t, kJointCount> order;
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::stable_sort(order, [&](size_t a, size_t b) { return sum[a] > sum[b]; });
  Influences in;
  double total = 0;
  for (size_t k = 0; k < 4; ++k) total += sum[order[k]];
  if (total <= 0) return internal::Bone(Joint::kHead);
  for (size_t k = 0; k < 4 && sum[order[k]] > 0; ++k) {
    in.joint[k] = static_cast<uint8_t>(order[k]);
    in.weight[k] = static_cast<float>(sum[order[k]] / total);
  }
  return in;
}

// Triangles of one material, vertices split by uv.
struct Piece {
  Cloth cloth = Cloth::kOther;
  uint32_t material = 0;
  std::vector<Vec3f> positions;  // in P
  std::vector<Vec2f> uvs;
  std::vector<Influences> influences;
  std::vector<uint32_t> source;  // vertex of the source mesh, for smooth normals over uv seams
  std::vector<uint32_t> indices;
};

template <class Keep>
Piece MakePiece(const BaseHuman& base, const SourceMesh& mesh, const std::vector<Vec3f>& at, const Keep& keep) {
  Piece piece;
  std::map<std::pair<int, int>, uint32_t> known;
  const auto vertex = [&](int p, int uv) {
    const auto [slot, fresh] = known.try_emplace({p, uv}, static_cast<uint32_t>(piece.positions.size()));
    if (fresh) {
      const auto i = static_cast<size_t>(p);
      piece.positions.push_back(ToPerson(at[i]));
      piece.uvs.push_back(mesh.uvs.empty() ? Vec2f{} : mesh.uvs[static_cast<size_t>(uv)]);
      piece.influences.push_back(i < mesh.bones.size() ? Folded(base, mesh.bones[i], mesh.weights[i]) : internal::Bone(Joint::kHead));
      piece.source.push_back(static_cast<uint32_t>(p));
    }
    return slot->second;
  };
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto &a = mesh.faces[f], &b = mesh.uv_faces[f];
    if (!keep(a)) continue;
    const uint32_t v[4] = {vertex(a[0], b[0]), vertex(a[1], b[1]), vertex(a[2], b[2]), vertex(a[3], b[3])};
    piece.indices.insert(piece.indices.end(), {v[0], v[1], v[2]});
    if (v[3] != v[2] && a[3] != a[2]) piece.indices.insert(piece.indices.end(), {v[0], v[2], v[3]});
  }
  return piece;
}

// Connected parts of a suit, each above or below the waist: shirts apart from trousers.
std::vector<bool> FacesOfTop(const SourceMesh& mesh, const std::vector<Vec3f>& at, float waist) {
  std::vector<int> root(at.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[static_cast<size_t>(i)] != i) i = root[static_cast<size_t>(i)] = root[static_cast<size_t>(root[static_cast<size_t>(i)])];
    return i;
  };
  for (const auto& f : mesh.faces) {
    for (int k = 1; k < 4; ++k) root[static_cast<size_t>(find(f[static_cast<size_t>(k)]))] = find(f[0]);
  }
  std::map<int, std::pair<double, int>> height;
  for (size_t i = 0; i < at.size(); ++i) {
    auto& [sum, count] = height[find(static_cast<int>(i))];
    sum += at[i].y;
    ++count;
  }
  std::vector<bool> top(at.size());
  for (size_t i = 0; i < at.size(); ++i) {
    const auto& [sum, count] = height[find(static_cast<int>(i))];
    top[i] = sum / count > waist;
  }
  return top;
}

// Simplifies every piece by the same share and joins them.
BodyLevel MakeLevel(const std::vector<Piece>& pieces, size_t level) {
  size_t all = 0;
  for (const Piece& p : pieces) all += p.indices.size() / 3;
  const double share = std::min(1.0, static_cast<double>(kTrianglesOf[level]) / static_cast<double>(all));
  BodyLevel out;
  for (const Piece& p : pieces) {
    std::vector<uint32_t> indices = p.indices;
    size_t target = static_cast<size_t>(static_cast<double>(p.indices.size() / 3) * share) * 3;
    // Brows are for near views.
    if (level >= 2 && p.cloth == Cloth::kOther) continue;
    if (share < 1) {
      std::vector<uint32_t> fewer(indices.size());
      size_t count = meshopt_simplify(fewer.data(), indices.data(), indices.size(), &p.positions[0].x, p.positions.size(), sizeof(Vec3f), target, level == 1 ? 0.03f : 0.2f, 0, nullptr);
      if (level >= 2 && count > target * 3 / 2) {
        const size_t sloppy = meshopt_simplifySloppy(fewer.data(), indices.data(), indices.size(), &p.positions[0].x, p.positions.size(), sizeof(Vec3f), std::max<size_t>(target, 36), 1.0f, nullptr);
        if (sloppy > 0) count = sloppy;
        else count = meshopt_simplify(fewer.data(), indices.data(), indices.size(), &p.positions[0].x, p.positions.size(), sizeof(Vec3f), target, 1.0f, 0, nullptr);
      }
      fewer.resize(count);
      indices = std::move(fewer);
    }
    if (indices.empty()) continue;

    // Only vertices that are left.
    std::vector<uint32_t> remap(p.positions.size());
    meshopt_optimizeVertexFetchRemap(remap.data(), indices.data(), indices.size(), p.positions.size());
    const auto first = static_cast<uint32_t>(out.mesh.positions.size());
    uint32_t used = 0;
    for (uint32_t r : remap) used = r == ~0u ? used : std::max(used, r + 1);
    out.mesh.positions.resize(first + used);
    out.mesh.uvs.resize(first + used);
    out.influences.resize(first + used);
    std::vector<uint32_t> source(used);
    for (size_t v = 0; v < remap.size(); ++v) {
      if (remap[v] == ~0u) continue;
      out.mesh.positions[first + remap[v]] = p.positions[v];
      out.mesh.uvs[first + remap[v]] = p.uvs[v];
      out.influences[first + remap[v]] = p.influences[v];
      source[remap[v]] = p.source[v];
    }
    // Normals are smooth over uv seams.
    std::map<uint32_t, Vec3f> sums;
    const auto start = static_cast<uint32_t>(out.mesh.triangles.size());
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
      const uint32_t t[3] = {remap[indices[i]], remap[indices[i + 1]], remap[indices[i + 2]]};
      const Vec3f a = out.mesh.positions[first + t[0]], b = out.mesh.positions[first + t[1]], c = out.mesh.positions[first + t[2]];
      const Vec3f area = Cross(b - a, c - a);
      for (uint32_t k : t) sums[source[k]] += area;
      out.mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    for (uint32_t k = 0; k < used; ++k) {
      const Vec3f n = Normalized(sums[source[k]]);
      out.mesh.normals.push_back(n == Vec3f{} ? Vec3f{0, 0, 1} : n);
    }
    out.mesh.parts.push_back({start, static_cast<uint32_t>(out.mesh.triangles.size()) - start, p.material, kNoEntity});
  }
  out.body_vertices = static_cast<uint32_t>(out.mesh.positions.size());
  return out;
}

// Pictures of clothes that will be tinted keep their light and shade only.
Bytes Picture(const std::filesystem::path& path, bool gray) {
  Image<Rgba8> image = DecodeRgba8(ReadFile(path), path.string());
  if (gray) {
    double sum = 0;
    int count = 0;
    for (const Rgba8& p : image.pixels()) {
      if (p.a < 128) continue;
      sum += 0.3 * p.r + 0.59 * p.g + 0.11 * p.b;
      ++count;
    }
    const double mean = count > 0 ? std::max(20.0, sum / count) : 128;
    for (Rgba8& p : image.pixels()) {
      const double light = 0.3 * p.r + 0.59 * p.g + 0.11 * p.b;
      const auto v = static_cast<uint8_t>(std::clamp(light * 188 / mean, 0.0, 255.0));
      p = {v, v, v, p.a};
    }
  }
  return EncodePng(image);
}

TextureId AddPicture(BodyPack& pack, const std::filesystem::path& path, bool gray) {
  const std::string name = path.filename().string() + (gray ? " gray" : "");
  const auto found = std::ranges::find(pack.texture_names, name);
  if (found != pack.texture_names.end()) return static_cast<TextureId>(found - pack.texture_names.begin());
  pack.texture_names.push_back(name);
  pack.textures.push_back(Picture(path, gray));
  return static_cast<TextureId>(pack.textures.size() - 1);
}

// The sockets in the order of kSocketNames: vertices of the base mesh (MPFB2's picks), joints, ends of bones.
std::vector<Socket> Sockets(const BaseHuman& base, const std::vector<Vec3f>& v, const std::array<Vec3d, kJointCount>& q, double stature) {
  Body dummy;
  dummy.p_PJ = q;
  internal::Proportions proportions;
  proportions.stature = stature;
  std::vector<Socket> sockets = internal::ProceduralSockets(dummy, proportions);
  const auto put = [&](const std::string& name, Vec3d p) {
    const auto s = std::ranges::find(sockets, name, &Socket::name);
    if (s == sockets.end()) throw InputError("no socket '" + name + "'");
    s->p_J = p - q[At(s->joint)];
  };
  const auto mean = [&](std::initializer_list<size_t> list) {
    Vec3d sum{};
    for (size_t i : list) sum += VecCast<double>(ToPerson(v[i]));
    return sum / static_cast<double>(list.size());
  };
  const auto end = [&](const std::string& bone) {
    Vec3d sum{};
    const auto& list = base.joints.at(bone + "____tail");
    for (int i : list) sum += VecCast<double>(ToPerson(v[static_cast<size_t>(i)]));
    return sum / static_cast<double>(list.size());
  };
  put("nose", mean({297, 7063}));
  put("left_eye", mean({14634, 14661}));
  put("right_eye", mean({14706, 14733}));
  put("left_ear", mean({12106, 12195}));
  put("right_ear", mean({5507, 5598}));
  put("left_knee", mean({11227, 17607}));
  put("right_knee", mean({4609, 16278}));
  put("left_heel", mean({12910, 17981}));
  put("right_heel", mean({6314, 16611}));
  put("neck", mean({1528, 3780}));
  put("head_top", mean({881}));
  put("chin", end("jaw"));
  put("head_center", (mean({881}) + end("jaw")) * 0.5);
  put("mid_hip", (q[At(Joint::kLeftHip)] + q[At(Joint::kRightHip)]) * 0.5);
  for (const char side : {'L', 'R'}) {
    const std::string name = side == 'L' ? "left_" : "right_", dot = std::string(".") + side;
    put(name + "big_toe", end("toe1-2" + dot));
    put(name + "small_toe", end("toe5-3" + dot));
    put(name + "thumb_tip", end("finger1-3" + dot));
    put(name + "finger_tip", end("finger3-3" + dot));
  }
  for (const Socket& s : sockets) {
    const double y = q[At(s.joint)].y + s.p_J.y;
    if ((s.name.starts_with("left") && y <= 0) || (s.name.starts_with("right") && y >= 0)) throw InputError("socket '" + s.name + "' is on the wrong side");
  }
  return sockets;
}

// Height of the skin without hair, metres.
double StatureOf(const std::vector<Vec3f>& v) {
  float low = 1e9f, high = -1e9f;
  for (size_t i = 0; i < 13380; ++i) {
    low = std::min(low, v[i].y);
    high = std::max(high, v[i].y);
  }
  return 0.1 * (high - low);
}

// An eyeball of our own: the package's are not on the list.
void AddEyes(const std::vector<Socket>& sockets, const std::array<Vec3d, kJointCount>& q, double stature, std::vector<Piece>& pieces, uint32_t white, uint32_t iris) {
  for (const size_t eye : {size_t{1}, size_t{2}}) {
    const Vec3d center = q[At(Joint::kHead)] + sockets[eye].p_J;
    const double r = 0.0072 * stature;
    for (const bool ring : {false, true}) {
      internal::LoftMesh mesh;
      const Vec3d c = ring ? center + Vec3d{0.52 * r, 0, 0} : center;
      const double k = ring ? 0.60 * r : r;
      mesh.Ellipsoid(c, {k, k, k}, Joint::kHead, 0, ring ? 8 : 12);
      const BodyLevel level = mesh.Finish("eye");
      Piece piece;
      piece.cloth = Cloth::kOther;
      piece.material = ring ? iris : white;
      piece.positions = level.mesh.positions;
      piece.uvs = level.mesh.uvs;
      piece.influences = level.influences;
      for (uint32_t i = 0; i < piece.positions.size(); ++i) piece.source.push_back(i);
      for (const Vec3u& t : level.mesh.triangles) piece.indices.insert(piece.indices.end(), {t.x, t.y, t.z});
      pieces.push_back(std::move(piece));
    }
  }
}

}  // namespace

void BakePerson(const Package& package, const Recipe& recipe, BodyPack& pack) {
  const BaseHuman& base = package.base();
  const bool male = recipe.spec.sex == Sex::kMale, child = recipe.spec.age < 16;

  // The height slider whose body has the stature asked for.
  Sliders sliders{AgeSlider(recipe.spec.age), male ? 1.0 : 0.0, std::clamp(0.5 + 0.3 * recipe.spec.build, 0.2, 0.95), male ? 0.58 : 0.5, 0.5, recipe.race};
  double low = 0.2, high = 0.75;
  std::vector<Vec3f> v;
  for (int i = 0; i < 9; ++i) {
    sliders.height = 0.5 * (low + high);
    v = package.Morph(sliders);
    (StatureOf(v) < recipe.spec.stature ? low : high) = sliders.height;
  }

  PackCharacter c;
  c.name = recipe.name;
  c.spec = recipe.spec;
  c.spec.stature = StatureOf(v);
  c.outfit = recipe.suit + ", " + recipe.shoes + ", " + recipe.hair;

  const auto add_material = [&](const std::string& name, Cloth cloth, const std::filesystem::path& picture, bool cutout, float roughness) {
    Material m;
    m.name = "person " + name;
    m.base_color = {1, 1, 1};
    m.roughness = roughness;
    if (cutout) m.alpha_mode = AlphaMode::kMask, m.alpha_cutoff = 0.4f;
    const bool gray = cloth != Cloth::kSkin && cloth != Cloth::kOther;
    if (!picture.empty()) m.base_color_texture = AddPicture(pack, picture, gray);
    c.materials.push_back(m);
    c.cloths.push_back(cloth);
    return static_cast<uint32_t>(c.materials.size() - 1);
  };

  // Clothes on the body, then the skin that they leave.
  std::vector<Piece> pieces;
  std::vector<bool> hidden(v.size(), false);
  const auto wear = [&](const std::string& kind, const std::string& name, Cloth cloth, bool cutout) {
    const Proxy proxy = package.ReadProxy(kind, name);
    const std::vector<Vec3f> at = FitProxy(proxy, v, base.mesh.positions);
    for (size_t i = 0; i < hidden.size(); ++i) hidden[i] = hidden[i] || proxy.hides[i];
    if (cloth == Cloth::kTop) {
      const float waist = v[static_cast<size_t>(base.joints.at("spine05____head")[0])].y;
      const std::vector<bool> top = FacesOfTop(proxy.mesh, at, waist);
      for (const bool upper : {true, false}) {
        Piece piece = MakePiece(base, proxy.mesh, at, [&](const std::array<int, 4>& f) { return top[static_cast<size_t>(f[0])] == upper; });
        if (piece.indices.empty()) continue;
        piece.cloth = upper ? Cloth::kTop : Cloth::kBottom;
        piece.material = add_material(name + (upper ? " top" : " bottom"), piece.cloth, proxy.picture, false, 0.9f);
        pieces.push_back(std::move(piece));
      }
      return;
    }
    Piece piece = MakePiece(base, proxy.mesh, at, [](const std::array<int, 4>&) { return true; });
    piece.cloth = cloth;
    piece.material = add_material(name, cloth, proxy.picture, cutout, cloth == Cloth::kShoes ? 0.5f : 0.7f);
    pieces.push_back(std::move(piece));
  };
  wear("clothes", recipe.suit, Cloth::kTop, false);
  wear("clothes", recipe.shoes, Cloth::kShoes, false);
  wear("hair", recipe.hair, Cloth::kHair, true);
  wear("eyebrows", male ? "eyebrow001" : "eyebrow003", Cloth::kOther, true);
  Piece skin = MakePiece(base, base.mesh, v, [&](const std::array<int, 4>& f) {
    return !std::ranges::all_of(f, [&](int i) { return hidden[static_cast<size_t>(i)]; });
  });
  skin.cloth = Cloth::kSkin;
  const std::string age = recipe.spec.age < 36 ? "young" : recipe.spec.age < 60 ? "middleage" : "old";
  const std::string races[] = {"caucasian", "african", "asian"};
  skin.material = add_material("skin", Cloth::kSkin, package.Skin(age, races[recipe.race], male && !child), false, 0.55f);
  pieces.push_back(std::move(skin));

  // The lowest point of the shoes is the ground; the middle between the ankles stands over the origin.
  c.p_PJ = Joints(base, v);
  c.sockets = Sockets(base, v, c.p_PJ, c.spec.stature);
  const uint32_t white = add_material("eye", Cloth::kOther, {}, false, 0.2f), iris = add_material("iris", Cloth::kOther, {}, false, 0.15f);
  c.materials[white].base_color = {0.62f, 0.60f, 0.58f};
  c.materials[iris].base_color = recipe.race == 0 && recipe.spec.look % 2 == 0 ? Vec3f{0.06f, 0.11f, 0.16f} : Vec3f{0.035f, 0.018f, 0.010f};
  AddEyes(c.sockets, c.p_PJ, c.spec.stature, pieces, white, iris);
  float floor = 1e9f;
  for (const Piece& p : pieces) {
    for (const Vec3f& x : p.positions) floor = std::min(floor, x.z);
  }
  const Vec3d ankles = (c.p_PJ[At(Joint::kLeftAnkle)] + c.p_PJ[At(Joint::kRightAnkle)]) * 0.5;
  const Vec3d shift{-ankles.x - 0.006 * c.spec.stature, 0, -floor};
  for (Vec3d& p : c.p_PJ) p += shift;
  for (Piece& p : pieces) {
    for (Vec3f& x : p.positions) x += VecCast<float>(shift);
  }
  c.heel_length = 0.036 * c.spec.stature;
  c.radius = 0.155 * c.spec.stature;
  for (size_t level = 0; level < std::size(kTrianglesOf); ++level) c.levels.push_back(MakeLevel(pieces, level));
  // The picks lie on the naked skin, tips at its very end: inside what is seen, shoes and clothes too.
  SeatSockets(c.levels, c.p_PJ, 0.002, 0.03, c.sockets);
  pack.characters.push_back(std::move(c));
}

}  // namespace airsim360::bake

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
#include "layers.h"
#include "picture.h"
#include "rest_pose.h"

namespace airsim360::bake {
namespace {

using internal::At;
constexpr size_t kTrianglesOf[] = {26000, 6000, 1250, 300};

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
std::array<Vec3d, kJointCount> Joints(const BaseHuman& base, const std::vector<Vec3f>& v, const std::vector<RigidTransform>& bones) {
  const auto mean = [&](const std::string& end) { return VecCast<double>(ToPerson(VecCast<float>(PosedEnd(base, v, bones, end)))); };
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
    if (!keep(f)) continue;
    const uint32_t v[4] = {vertex(a[0], b[0]), vertex(a[1], b[1]), vertex(a[2], b[2]), vertex(a[3], b[3])};
    piece.indices.insert(piece.indices.end(), {v[0], v[1], v[2]});
    if (v[3] != v[2] && a[3] != a[2]) piece.indices.insert(piece.indices.end(), {v[0], v[2], v[3]});
  }
  return piece;
}

// Heights that a connected part of a garment spans.
struct Part {
  float low = 1e9f, high = -1e9f;
  double sum = 0;
  int count = 0;
  double mean() const { return sum / count; }
  void Add(float y) {
    low = std::min(low, y);
    high = std::max(high, y);
    sum += y;
    ++count;
  }
};

// By face, its part: faces are connected that share one of their `corners`.
std::vector<Part> PartsBy(const std::vector<std::array<int, 4>>& corners, const SourceMesh& mesh, const std::vector<Vec3f>& at) {
  int count = 0;
  for (const auto& f : corners) count = std::max(count, std::ranges::max(f) + 1);
  std::vector<int> root(static_cast<size_t>(count));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[static_cast<size_t>(i)] != i) i = root[static_cast<size_t>(i)] = root[static_cast<size_t>(root[static_cast<size_t>(i)])];
    return i;
  };
  for (const auto& f : corners) {
    for (size_t k = 1; k < 4; ++k) root[static_cast<size_t>(find(f[k]))] = find(f[0]);
  }
  std::map<int, Part> parts;
  for (size_t i = 0; i < corners.size(); ++i) {
    for (const int v : mesh.faces[i]) parts[find(corners[i][0])].Add(at[static_cast<size_t>(v)].y);
  }
  std::vector<Part> of_face;
  for (const auto& f : corners) of_face.push_back(parts[find(f[0])]);
  return of_face;
}

// Connected parts of a garment, by face. A suit in one piece from the legs to the chest is parted at its seams, where
// the map is cut.
std::vector<Part> PartsOf(const SourceMesh& mesh, const std::vector<Vec3f>& at) {
  constexpr float kOnePiece = 11;  // decimetres
  std::vector<Part> parts = PartsBy(mesh.faces, mesh, at);
  const bool whole = std::ranges::any_of(parts, [](const Part& p) { return p.high - p.low > kOnePiece; });
  return whole && !mesh.uvs.empty() ? PartsBy(mesh.uv_faces, mesh, at) : parts;
}

// What each level may be off by at most, metres, and how far garments are kept from what they cover: further than
// that, or skin shows through them.
constexpr float kMostError[] = {0.004f, 0.02f, 0.035f, 0.06f};
constexpr float kGap[] = {0.004f, 0.008f, 0.016f, 0.03f};
constexpr float kCrumb[] = {0, 0.012f, 0.05f, 0.1f};

// Hair and shoes are of many parts and seams, which simplifying does not get below a thousand triangles: far off they are
// made anew on a grid.
void MakeCoarse(size_t triangles, Piece& p) {
  if (p.indices.size() / 3 <= triangles) return;
  std::vector<uint32_t> fewer(p.indices.size());
  const size_t count = meshopt_simplifySloppy(fewer.data(), p.indices.data(), p.indices.size(), &p.positions[0].x, p.positions.size(), sizeof(Vec3f), 3 * triangles, 1.0f, nullptr);
  if (count == 0) return;
  fewer.resize(count);
  p.indices = std::move(fewer);
  p.whole = true;
}

// Adds triangles of a piece to a level, with the vertices that are left.
void Append(const Piece& p, const std::vector<uint32_t>& indices, BodyLevel& out) {
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

// Simplifies the pieces together and joins them.
BodyLevel MakeLevel(std::vector<Piece> pieces, size_t level) {
  // Brows and eyes are for near views.
  if (level >= 2) std::erase_if(pieces, [](const Piece& p) { return p.cloth == Cloth::kOther && p.layer == Layer::kLoose; });
  for (Piece& piece : pieces) {
    if (!piece.whole) DropCrumbs(kCrumb[level], piece);
  }
  std::erase_if(pieces, [](const Piece& p) { return p.indices.empty(); });
  TuckIn(pieces, kGap[level]);
  for (Piece& piece : pieces) {
    if (level >= 2 && piece.cloth == Cloth::kHair) MakeCoarse(level == 2 ? 250 : 36, piece);
    if (level >= 2 && piece.layer == Layer::kShoes) MakeCoarse(level == 2 ? 120 : 48, piece);
  }
  std::vector<std::vector<uint32_t>> simple = SimplifyTogether(pieces, kTrianglesOf[level], kMostError[level]);
  size_t all = 0;
  for (const auto& list : simple) all += list.size() / 3;
  // Suits of many seams are still too many: on a grid too, as many as their share.
  for (size_t k = 0; level >= 2 && all > kTrianglesOf[level] * 21 / 20 && k < pieces.size(); ++k) {
    // A grid leaves gaps where garments are narrow; a plain shirt needs none.
    constexpr size_t kPlain = 130;
    if (pieces[k].whole || simple[k].size() / 3 <= kPlain) continue;
    MakeCoarse(std::max(simple[k].size() / 3 * kTrianglesOf[level] / all, kPlain), pieces[k]);
    if (pieces[k].whole) simple[k] = pieces[k].indices;
  }
  BodyLevel out;
  for (size_t k = 0; k < pieces.size(); ++k) {
    if (!simple[k].empty()) Append(pieces[k], simple[k], out);
  }
  out.body_vertices = static_cast<uint32_t>(out.mesh.positions.size());
  return out;
}

// How a picture becomes one of the pack.
struct Look {
  bool gray = false;   // it will be tinted
  bool plain = false;  // without its print
  double spread = 10;
  std::vector<std::array<Vec2f, 3>> uvs = {};  // what of it is used; empty: all
};

TextureId AddPicture(BodyPack& pack, const std::filesystem::path& path, const Look& look) {
  const std::string name = path.filename().string() + (look.gray ? " gray" : "") + (look.plain ? " plain" : "");
  const auto found = std::ranges::find(pack.texture_names, name);
  if (found != pack.texture_names.end()) return static_cast<TextureId>(found - pack.texture_names.begin());
  Image<Rgba8> image = DecodeRgba8(ReadFile(path), path.string());
  if (look.gray) MakeTintable(look.spread, image);
  if (look.plain) MakePlain(0.12, image);
  if (!look.uvs.empty()) FillAround(look.uvs, image);
  pack.texture_names.push_back(name);
  pack.textures.push_back(EncodePng(image));
  return static_cast<TextureId>(pack.textures.size() - 1);
}

std::vector<std::array<Vec2f, 3>> UsedUvs(const SourceMesh& mesh) {
  std::vector<std::array<Vec2f, 3>> list;
  if (mesh.uvs.empty()) return list;
  for (const auto& f : mesh.uv_faces) {
    const auto uv = [&](size_t k) { return mesh.uvs[static_cast<size_t>(f[k])]; };
    list.push_back({uv(0), uv(1), uv(2)});
    if (f[3] != f[2]) list.push_back({uv(0), uv(2), uv(3)});
  }
  return list;
}

// The sockets in the order of kSocketNames: vertices of the base mesh (MPFB2's picks), joints, ends of bones.
// `v` are the vertices as modelled, `posed` those that are baked.
std::vector<Socket> Sockets(const BaseHuman& base, const std::vector<Vec3f>& v, const std::vector<RigidTransform>& bones, const std::vector<Vec3f>& posed,
                            const std::array<Vec3d, kJointCount>& q, double stature) {
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
    for (size_t i : list) sum += VecCast<double>(ToPerson(posed[i]));
    return sum / static_cast<double>(list.size());
  };
  const auto end = [&](const std::string& bone) { return VecCast<double>(ToPerson(VecCast<float>(PosedEnd(base, v, bones, bone + "____tail")))); };
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

// Vertices of the base mesh that mark the eyeballs, which its lids fit.
constexpr size_t kEyeMarkers[2][2] = {{14598, 14670}, {14670, 14742}};

struct Ball {
  Vec3d center;
  double radius = 0;
};

Ball EyeBall(const std::vector<Vec3f>& v, size_t eye) {
  const auto [first, end] = kEyeMarkers[eye];
  const auto count = static_cast<double>(end - first);
  Ball ball;
  for (size_t i = first; i < end; ++i) ball.center += VecCast<double>(ToPerson(v[i])) / count;
  for (size_t i = first; i < end; ++i) ball.radius += Norm(VecCast<double>(ToPerson(v[i])) - ball.center) / count;
  return ball;
}

// Eyeballs of our own, the package's are not on the list: white, iris and pupil, one ball before the other.
void AddEyes(const std::vector<Vec3f>& v, std::vector<Piece>& pieces, const std::array<uint32_t, 3>& materials) {
  struct Shell {
    double forward, radius;
  };
  constexpr Shell kShells[] = {{0, 1}, {0.52, 0.595}, {0.74, 0.385}};
  for (const size_t eye : {size_t{0}, size_t{1}}) {
    const Ball ball = EyeBall(v, eye);
    for (size_t k = 0; k < std::size(kShells); ++k) {
      internal::LoftMesh mesh;
      const double r = kShells[k].radius * ball.radius;
      mesh.Ellipsoid(ball.center + Vec3d{kShells[k].forward * ball.radius, 0, 0}, {r, r, r}, Joint::kHead, 0, k == 0 ? 12 : 8);
      const BodyLevel level = mesh.Finish("eye");
      Piece piece;
      piece.whole = true;
      piece.material = materials[k];
      piece.positions = level.mesh.positions;
      piece.uvs = level.mesh.uvs;
      piece.influences = level.influences;
      for (uint32_t i = 0; i < piece.positions.size(); ++i) piece.source.push_back(i);
      for (const Vec3u& t : level.mesh.triangles) {
        // Only what can look out between the lids.
        const Vec3f middle = (piece.positions[t.x] + piece.positions[t.y] + piece.positions[t.z]) * (1.0f / 3);
        if (middle.x > ball.center.x + 0.1 * ball.radius) piece.indices.insert(piece.indices.end(), {t.x, t.y, t.z});
      }
      pieces.push_back(std::move(piece));
    }
  }
}

}  // namespace

namespace {

// One person while being dressed.
class Dressing {
 public:
  Dressing(const Package& package, const Recipe& recipe, BodyPack& pack) : package_(package), recipe_(recipe), pack_(pack) {
    // The height slider whose body has the stature asked for.
    Sliders sliders{AgeSlider(recipe.spec.age), male() ? 1.0 : 0.0, std::clamp(0.5 + 0.3 * recipe.spec.build, 0.2, 0.95), male() ? 0.58 : 0.5, 0.5, recipe.race};
    double low = 0.2, high = 0.75;
    for (int i = 0; i < 9; ++i) {
      sliders.height = 0.5 * (low + high);
      v_ = package.Morph(sliders);
      (StatureOf(v_) < recipe.spec.stature ? low : high) = sliders.height;
    }
    bones_ = RelaxedBones(base(), v_);
    posed_ = Posed(base().mesh, v_, bones_);
    hidden_.resize(v_.size());
    waist_ = static_cast<float>(BoneEnd(base(), v_, "spine05____head").y);
    c.name = recipe.name;
    c.spec = recipe.spec;
    c.spec.stature = StatureOf(v_);
    c.outfit = recipe.suit + ", " + recipe.bottom + ", " + recipe.shoes + ", " + recipe.hair;
  }

  void Dress();
  void Finish();

  PackCharacter c;

 private:
  const BaseHuman& base() const { return package_.base(); }
  bool male() const { return recipe_.spec.sex == Sex::kMale; }

  uint32_t AddMaterial(const std::string& name, Cloth cloth, const std::filesystem::path& picture, bool cutout, float roughness, const SourceMesh* mesh = nullptr);
  // The parts of a proxy for which `keep` is true, as one piece.
  template <class Keep>
  void Wear(const Proxy& proxy, const std::string& name, Cloth cloth, Layer layer, bool cutout, const Keep& keep);
  void WearSuit();
  void WearShoes();
  void WearSkin();

  const Package& package_;
  const Recipe& recipe_;
  BodyPack& pack_;
  std::vector<Vec3f> v_, posed_;  // as modelled, as baked
  std::vector<RigidTransform> bones_;
  std::vector<bool> hidden_;
  float waist_ = 0, hem_ = 1e9f;  // in the package's axes, decimetres; of a skirt, in P
  std::vector<Piece> pieces_;
};

// A skirt that legs walk in does not follow them closely: there are none in it above `height`.
void DropLegs(float height, Piece& skin) {
  const auto inside = [&](uint32_t v) {
    const Influences& in = skin.influences[v];
    const size_t most = static_cast<size_t>(std::ranges::max_element(in.weight) - in.weight.begin());
    const auto joint = static_cast<Joint>(in.joint[most]);
    return skin.positions[v].z > height && (joint == Joint::kLeftHip || joint == Joint::kRightHip || joint == Joint::kLeftKnee || joint == Joint::kRightKnee);
  };
  std::vector<uint32_t> kept;
  for (size_t i = 0; i + 2 < skin.indices.size(); i += 3) {
    const uint32_t* t = &skin.indices[i];
    if (!inside(t[0]) || !inside(t[1]) || !inside(t[2])) kept.insert(kept.end(), t, t + 3);
  }
  skin.indices = std::move(kept);
}

uint32_t Dressing::AddMaterial(const std::string& name, Cloth cloth, const std::filesystem::path& picture, bool cutout, float roughness, const SourceMesh* mesh) {
  Material m;
  m.name = "person " + name;
  m.base_color = {1, 1, 1};
  m.roughness = roughness;
  if (cutout) m.alpha_mode = AlphaMode::kMask, m.alpha_cutoff = 0.4f;
  if (!picture.empty()) {
    Look look{.gray = cloth != Cloth::kSkin && cloth != Cloth::kOther};
    // Dark hair is painted with strong lights, which would make fair hair spotted.
    if (cloth == Cloth::kHair) look.spread = 0.22;
    // Two in three wear no print: there is but one for each cut.
    look.plain = cloth == Cloth::kTop && recipe_.spec.look % 3 != 0;
    // Hair is cut out by its picture and stays as it is.
    if (mesh != nullptr && !cutout) look.uvs = UsedUvs(*mesh);
    m.base_color_texture = AddPicture(pack_, picture, look);
  }
  c.materials.push_back(m);
  c.cloths.push_back(cloth);
  return static_cast<uint32_t>(c.materials.size() - 1);
}

template <class Keep>
void Dressing::Wear(const Proxy& proxy, const std::string& name, Cloth cloth, Layer layer, bool cutout, const Keep& keep) {
  const std::vector<Vec3f> fitted = FitProxy(proxy, v_, base().mesh.positions);
  const std::vector<Part> parts = PartsOf(proxy.mesh, fitted);
  Piece piece = MakePiece(base(), proxy.mesh, Posed(proxy.mesh, fitted, bones_), [&](size_t f) { return keep(parts[f]); });
  if (piece.indices.empty()) return;
  piece.cloth = cloth;
  piece.layer = layer;
  piece.material = AddMaterial(name, cloth, proxy.picture, cutout, cloth == Cloth::kShoes ? 0.5f : cloth == Cloth::kTop || cloth == Cloth::kBottom ? 0.9f : 0.7f, &proxy.mesh);
  pieces_.push_back(std::move(piece));
}

// A shirt or jacket of one suit, trousers or skirt of the same or of another one.
void Dressing::WearSuit() {
  const Proxy top = package_.ReadProxy("clothes", recipe_.suit), bottom = package_.ReadProxy("clothes", recipe_.bottom);
  for (size_t i = 0; i < hidden_.size(); ++i) hidden_[i] = v_[i].y > waist_ ? top.hides[i] : bottom.hides[i];
  Wear(top, recipe_.suit + " top", Cloth::kTop, Layer::kTop, false, [&](const Part& p) { return p.mean() > waist_; });
  // Suits and jackets are darker than shirts.
  const float dark = recipe_.suit == "male_elegantsuit01" ? 0.25f : recipe_.suit == "male_casualsuit05" ? 0.6f : 1;
  c.materials.back().base_color = Vec3f{1, 1, 1} * dark;
  Wear(bottom, recipe_.bottom + " bottom", Cloth::kBottom, Layer::kBottom, false, [&](const Part& p) { return p.mean() <= waist_; });
  // A skirt is one cloth around both legs.
  if (recipe_.bottom == "female_elegantsuit01" && pieces_.back().cloth == Cloth::kBottom) {
    const auto hips = static_cast<float>(0.1 * BoneEnd(base(), v_, "upperleg01.L____head").y);
    MakeTaut(pieces_.back(), hips);
    HangFromHips(pieces_.back(), static_cast<float>(0.06 * c.spec.stature));
    for (const Vec3f& p : pieces_.back().positions) hem_ = std::min(hem_, p.z);
  }
}

// Shoes come with socks, which are parts of their own that reach far over the ankle.
void Dressing::WearShoes() {
  const Proxy shoes = package_.ReadProxy("clothes", recipe_.shoes);
  for (size_t i = 0; i < hidden_.size(); ++i) hidden_[i] = hidden_[i] || shoes.hides[i];
  const double ankle = BoneEnd(base(), v_, "foot.L____head").y;
  const auto is_sock = [&](const Part& p) { return p.high > ankle + 0.06 * 10 * c.spec.stature / 1.7; };
  Wear(shoes, recipe_.shoes, Cloth::kShoes, Layer::kShoes, false, [&](const Part& p) { return !is_sock(p); });
  Proxy socks = shoes;
  socks.picture.clear();
  Wear(socks, "socks", Cloth::kOther, Layer::kSocks, false, is_sock);
  constexpr Vec3f kSocks[] = {{0.55f, 0.54f, 0.52f}, {0.03f, 0.03f, 0.035f}, {0.10f, 0.10f, 0.11f}, {0.02f, 0.03f, 0.06f}};
  c.materials.back().base_color = kSocks[recipe_.spec.look % std::size(kSocks)];
  c.materials.back().roughness = 0.95f;
}

void Dressing::WearSkin() {
  Piece skin = MakePiece(base(), base().mesh, posed_, [&](size_t f) {
    return !std::ranges::all_of(base().mesh.faces[f], [&](int i) { return hidden_[static_cast<size_t>(i)]; });
  });
  skin.cloth = Cloth::kSkin;
  skin.layer = Layer::kSkin;
  DropLegs(hem_ + 0.05f, skin);
  const std::string age = recipe_.spec.age < 36 ? "young" : recipe_.spec.age < 60 ? "middleage" : "old";
  const std::string races[] = {"caucasian", "african", "asian"};
  skin.material = AddMaterial("skin", Cloth::kSkin, package_.Skin(age, races[recipe_.race], male() && recipe_.spec.age >= 16), false, 0.55f);
  pieces_.push_back(std::move(skin));
}

void Dressing::Dress() {
  const auto all = [](const Part&) { return true; };
  WearSuit();
  WearShoes();
  WearSkin();
  // What is seen between strands is the colour of the hair, not of a bald head.
  // Only Europeans have fair hair by the wardrobe's chances; that of others is darkened, less so when it is grey.
  const float dark = recipe_.race == 0 ? 1 : recipe_.spec.age < 60 ? 0.3f : 0.8f;
  const Vec3f eyes = VecCast<float>(EyeBall(posed_, 0).center), top = ToPerson(posed_[881]);
  Wear(package_.ReadProxy("hair", recipe_.hair), recipe_.hair, Cloth::kHair, Layer::kLoose, true, all);
  c.materials.back().base_color = Vec3f{1, 1, 1} * dark;
  Piece scalp = TakeScalp(pieces_[pieces_.size() - 2], pieces_.back(), eyes, top);
  scalp.cloth = Cloth::kHair;
  scalp.material = AddMaterial("scalp", Cloth::kHair, {}, false, 0.9f);
  c.materials.back().base_color = Vec3f{0.3f, 0.3f, 0.3f} * dark;
  if (!scalp.indices.empty()) pieces_.push_back(std::move(scalp));
  const std::string brows = male() ? std::array{"eyebrow001", "eyebrow004", "eyebrow003"}[recipe_.spec.look % 3] : std::array{"eyebrow002", "eyebrow003"}[recipe_.spec.look % 2];
  Wear(package_.ReadProxy("eyebrows", brows), brows, Cloth::kOther, Layer::kLoose, true, all);
  const uint32_t white = AddMaterial("eye", Cloth::kOther, {}, false, 0.25f), iris = AddMaterial("iris", Cloth::kOther, {}, false, 0.15f), pupil = AddMaterial("pupil", Cloth::kOther, {}, false, 0.15f);
  c.materials[white].base_color = {0.50f, 0.46f, 0.43f};
  c.materials[iris].base_color = recipe_.race == 0 && recipe_.spec.look % 2 == 0 ? Vec3f{0.06f, 0.11f, 0.16f} : Vec3f{0.035f, 0.018f, 0.010f};
  c.materials[pupil].base_color = {0.01f, 0.01f, 0.01f};
  AddEyes(posed_, pieces_, {white, iris, pupil});
}

void Dressing::Finish() {
  // The lowest point of the shoes is the ground; the middle between the ankles stands over the origin.
  c.p_PJ = Joints(base(), v_, bones_);
  c.sockets = Sockets(base(), v_, bones_, posed_, c.p_PJ, c.spec.stature);
  float floor = 1e9f;
  for (const Piece& p : pieces_) {
    for (const uint32_t i : p.indices) floor = std::min(floor, p.positions[i].z);
  }
  const Vec3d ankles = (c.p_PJ[At(Joint::kLeftAnkle)] + c.p_PJ[At(Joint::kRightAnkle)]) * 0.5;
  const Vec3d shift{-ankles.x - 0.006 * c.spec.stature, 0, -floor};
  for (Vec3d& p : c.p_PJ) p += shift;
  for (Piece& p : pieces_) {
    for (Vec3f& x : p.positions) x += VecCast<float>(shift);
  }
  c.heel_length = 0.036 * c.spec.stature;
  c.radius = 0.155 * c.spec.stature;
  // The farthest level is too coarse for garments that only just overlap.
  std::vector<Piece> seen = pieces_;
  DropHidden(seen);
  for (size_t level = 0; level < std::size(kTrianglesOf); ++level) c.levels.push_back(MakeLevel(level < 3 ? seen : pieces_, level));
  // The picks lie on the naked skin, tips at its very end: inside what is seen, shoes and clothes too.
  SeatSockets(c.levels, c.p_PJ, 0.002, 0.03, c.sockets);
}

}  // namespace

void BakePerson(const Package& package, const Recipe& recipe, BodyPack& pack) {
  Dressing dressing(package, recipe, pack);
  dressing.Dress();
  dressing.Finish();
  pack.characters.push_back(std::move(dressing.c));
}

}  // namespace airsim360::bake

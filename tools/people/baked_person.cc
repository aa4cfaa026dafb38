#include "baked_person.h"

#include <algorithm>
#include <map>
#include <optional>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs.h"
#include "airsim360/people/body/anatomy.h"
#include "airsim360/people/body/loft.h"
#include "airsim360/people/body/seat_sockets.h"
#include "connected.h"
#include "eyes.h"
#include "joints.h"
#include "layers.h"
#include "levels.h"
#include "picture.h"
#include "rest_pose.h"

namespace airsim360::bake {
namespace {

using internal::At;

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
  const std::vector<uint32_t> part = ConnectedParts(static_cast<size_t>(count), corners);
  std::vector<Part> parts(part.size());
  for (size_t i = 0; i < corners.size(); ++i) {
    for (const int v : mesh.faces[i]) parts[part[static_cast<size_t>(corners[i][0])]].Add(at[static_cast<size_t>(v)].y);
  }
  std::vector<Part> of_face;
  for (const auto& f : corners) of_face.push_back(parts[part[static_cast<size_t>(f[0])]]);
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

// Fair skin of each of the package's three kinds, linear: CIELAB (66, 11, 18), (46, 11, 18) and (64, 10, 19) under D65, near the
// light end of what Xiao et al. (2017, "Characterising the variations in ethnic skin colours") measured; the person's own
// tone darkens it (MakePackBody).
constexpr Vec3f kSkinAlbedo[] = {{0.522f, 0.317f, 0.219f}, {0.248f, 0.132f, 0.079f}, {0.482f, 0.296f, 0.194f}};

// How a picture becomes one of the pack.
struct Look {
  bool gray = false;   // it will be tinted
  bool plain = false;  // without its print
  double spread = 10;
  std::optional<Vec3f> skin = {};              // albedo, linear, where it shows skin
  std::vector<std::array<Vec2f, 3>> uvs = {};  // what of it is used; empty: all
};

TextureId AddPicture(BodyPack& pack, const std::filesystem::path& path, const Look& look) {
  const std::string name = path.filename().string() + (look.gray ? " gray" : "") + (look.plain ? " plain" : "");
  const auto found = std::ranges::find(pack.texture_names, name);
  if (found != pack.texture_names.end()) return static_cast<TextureId>(found - pack.texture_names.begin());
  Image<Rgba8> image = DecodeRgba8(ReadFile(path), path.string());
  if (look.gray) MakeTintable(look.spread, image);
  if (look.plain) MakePlain(0.12, image);
  if (look.skin) MakeSkin(*look.skin, look.uvs, image);
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

// Height of the skin without hair, metres.
double StatureOf(const std::vector<Vec3f>& v) {
  float low = 1e9f, high = -1e9f;
  for (size_t i = 0; i < 13380; ++i) {
    low = std::min(low, v[i].y);
    high = std::max(high, v[i].y);
  }
  return 0.1 * (high - low);
}

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
    if (cloth == Cloth::kSkin) look.skin = kSkinAlbedo[recipe_.race];
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
  skin.material = AddMaterial("skin", Cloth::kSkin, package_.Skin(age, races[recipe_.race], male() && recipe_.spec.age >= 16), false, 0.55f, &base().mesh);
  pieces_.push_back(std::move(skin));
}

// The package's brows slope down to the nose, which makes a face that rests look angry: their inner ends are raised.
void RelaxBrows(double stature, Piece& brows) {
  float outer = 0;
  for (const Vec3f& p : brows.positions) outer = std::max(outer, std::abs(p.y));
  const auto rise = static_cast<float>(0.0042 * stature);
  for (Vec3f& p : brows.positions) p.z += rise * (1 - std::abs(p.y) / outer);
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
  RelaxBrows(c.spec.stature, pieces_.back());
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
  for (size_t level = 0; level < kBakedLevels; ++level) c.levels.push_back(MakeLevel(level < 3 ? seen : pieces_, level));
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

#include "airsim360/people/body/body_pack.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>

#include "airsim360/base/archive.h"
#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/image/codecs.h"
#include "airsim360/people/body/figure.h"

namespace airsim360 {
namespace {

constexpr uint64_t kMagic = 0x3130504f45503341;  // "A3PEOP01"
constexpr uint64_t kMaxBytes = uint64_t{1} << 30;

// Fields of one character, the same list both ways.
template <class Archive, class Character>
void Fields(Archive& a, Character& c) {
  a(c.spec.sex, c.spec.age, c.spec.stature, c.spec.build, c.name, c.outfit);
  for (auto& p : c.p_PJ) a(p.x, p.y, p.z);
  a(c.heel_length, c.radius);
  a.Each(c.sockets, [&](auto& s) { a(s.name, s.joint, s.p_J.x, s.p_J.y, s.p_J.z, s.radius); });
  a.Each(c.materials, [&](auto& m) {
    a(m.name, m.alpha_mode, m.alpha_cutoff, m.base_color.x, m.base_color.y, m.base_color.z, m.roughness, m.base_color_texture);
  });
  a(c.cloths);
  a.Each(c.levels, [&](auto& l) {
    a(l.mesh.positions, l.mesh.normals, l.mesh.uvs, l.mesh.triangles);
    a.Each(l.mesh.parts, [&](auto& p) { a(p.first_triangle, p.triangle_count, p.material, p.entity); });
    a.Each(l.influences, [&](auto& in) {
      for (size_t k = 0; k < 4; ++k) a(in.joint[k], in.weight[k]);
    });
    a(l.body_vertices);
  });
}

void Check(bool good, const std::string& name, const std::string& what) {
  if (!good) throw InputError(name + ": " + what);
}

// Indices of a file are not trusted.
void CheckCharacter(const PackCharacter& c, size_t textures, const std::string& name) {
  Check(c.sockets.size() >= static_cast<size_t>(kSocketCount) && c.levels.size() == internal::kBodyLevels &&
            c.cloths.size() == c.materials.size(),
        name, "character '" + c.name + "' is incomplete");
  for (const Socket& s : c.sockets) Check(s.joint < Joint::kCount, name, "a socket of '" + c.name + "' has no joint");
  for (const Material& m : c.materials)
    Check(m.base_color_texture >= -1 && m.base_color_texture < static_cast<TextureId>(textures) && m.alpha_mode <= AlphaMode::kMask, name,
          "a material of '" + c.name + "' is out of range");
  for (const BodyLevel& l : c.levels) {
    const size_t vertices = l.mesh.positions.size();
    Check(l.influences.size() == vertices && l.mesh.normals.size() == vertices && l.mesh.uvs.size() == vertices &&
              l.body_vertices == vertices,
          name, "a level of '" + c.name + "' lacks data");
    for (const Influences& in : l.influences) {
      for (uint8_t j : in.joint) Check(j < kJointCount, name, "a bone of '" + c.name + "' is out of range");
    }
    for (const Vec3u& t : l.mesh.triangles)
      Check(std::max({t.x, t.y, t.z}) < vertices, name, "a triangle of '" + c.name + "' is out of range");
    uint64_t next = 0;
    for (const MeshPart& p : l.mesh.parts) {
      Check(p.first_triangle == next && p.material < c.materials.size() && p.entity == 0, name,
            "a part of '" + c.name + "' is out of range");
      next += p.triangle_count;
    }
    Check(next == l.mesh.triangles.size(), name, "parts of '" + c.name + "' do not cover it");
  }
}

}  // namespace

Bytes EncodeBodyPack(const BodyPack& pack) {
  ArchiveWriter a;
  a(kMagic);
  a.Each(pack.texture_names, [&](const std::string& n) { a(n); });
  a.Each(pack.textures, [&](const Bytes& b) { a(b); });
  a.Each(pack.characters, [&](const PackCharacter& c) { Fields(a, c); });
  return a.Take();
}

BodyPack DecodeBodyPack(std::span<const std::byte> bytes, const std::string& name) {
  BodyPack pack;
  ArchiveReader a(bytes);
  uint64_t magic = 0;
  a(magic);
  Check(magic == kMagic, name, "not a pack of people of this version; run 'make people' again");
  a.Each(pack.texture_names, [&](std::string& n) { a(n); });
  a.Each(pack.textures, [&](Bytes& b) { a(b); });
  a.Each(pack.characters, [&](PackCharacter& c) { Fields(a, c); });
  Check(a.done() && pack.texture_names.size() == pack.textures.size() && !pack.characters.empty(), name, "pack of people is damaged");
  for (const PackCharacter& c : pack.characters) CheckCharacter(c, pack.textures.size(), name);
  return pack;
}

std::optional<std::filesystem::path> BodyPackPath() {
  if (const char* path = std::getenv("AIRSIM360_PEOPLE")) {
    if (*path == 0) return std::nullopt;
    return std::filesystem::path(path);
  }
  // Tests and other runs that keep nothing on disk use nothing from there either.
  const char* cache = std::getenv("AIRSIM360_CACHE");
  if (cache != nullptr && *cache == 0) return std::nullopt;
  const char* home = std::getenv("HOME");
  if (home == nullptr) return std::nullopt;
  return std::filesystem::path(home) / ".cache" / "airsim360" / "people" / "people.pack";
}

const BodyPack* InstalledBodyPack() {
  static const std::unique_ptr<BodyPack> pack = []() -> std::unique_ptr<BodyPack> {
    const auto path = BodyPackPath();
    // Who names a pack wants its people and no others; the one that `make people` leaves is welcome where it is good.
    const bool named = std::getenv("AIRSIM360_PEOPLE") != nullptr;
    if (!path || (!named && !std::filesystem::exists(*path))) return nullptr;
    try {
      return std::make_unique<BodyPack>(DecodeBodyPack(ReadFile(*path, kMaxBytes), path->string()));
    } catch (const std::exception& error) {
      if (named) throw InputError("AIRSIM360_PEOPLE: " + std::string(error.what()));
      std::fprintf(stderr, "%s; people are procedural\n", error.what());
      return nullptr;
    }
  }();
  return pack.get();
}

namespace {

// Pictures of a pack, decoded when first used and kept while somebody wears them.
std::shared_ptr<const Texture> DecodedTexture(const BodyPack& pack, size_t index) {
  static std::mutex mutex;
  static std::map<std::pair<const BodyPack*, size_t>, std::weak_ptr<const Texture>> known;
  const std::scoped_lock lock(mutex);
  std::weak_ptr<const Texture>& slot = known[{&pack, index}];
  if (auto texture = slot.lock()) return texture;
  auto texture = std::make_shared<Texture>(
      Texture::FromImage(pack.texture_names[index], DecodeRgba8(pack.textures[index], pack.texture_names[index]), true));
  slot = texture;
  return texture;
}

const PackCharacter& Nearest(const BodyPack& pack, const BodySpec& spec) {
  std::vector<std::pair<double, const PackCharacter*>> order;
  for (const PackCharacter& c : pack.characters) {
    double miss = std::abs(c.spec.age - spec.age) / 18 + std::abs(c.spec.stature - spec.stature) / 0.12;
    if (c.spec.sex != spec.sex) miss += 4;
    if ((c.spec.age < 16) != (spec.age < 16)) miss += 8;
    order.emplace_back(miss, &c);
  }
  std::ranges::stable_sort(order, {}, &std::pair<double, const PackCharacter*>::first);
  // One of the good ones, by look.
  size_t good = 1;
  while (good < order.size() && good < 8 && order[good].first < order[0].first + 0.7) ++good;
  return *order[MixBits(spec.look) % good].second;
}

// Cloth in the street: four tenths of a colour's purity are gone by washing and light.
Vec3f Worn(Vec3f color) {
  const float light = 0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z;
  return color + (Vec3f{light, light, light} - color) * 0.4f;
}

// How much darker a person's skin is than the pack's picture of it, by channel. Melanin absorbs the more the shorter the wave:
// about as its length to the power of -3.3 (Jacques 2013); the exponent of blue is lowered, for it saturates in dark skin.
Vec3f SkinShade(double melanin) {
  return {static_cast<float>(std::exp(-0.7 * melanin)), static_cast<float>(std::exp(-melanin)),
          static_cast<float>(std::exp(-1.3 * melanin))};
}

// Half of the people are about as fair as the picture, the others darker up to a lightness (CIELAB) of 14 less.
double DrawMelanin(const BodySpec& spec) {
  RngStream rng(spec.look, "melanin");
  return rng.Chance(0.5) ? rng.Uniform(0, 0.15) : rng.Uniform(0.15, 0.65);
}

}  // namespace

std::shared_ptr<const Body> MakePackBody(const BodyPack& pack, const BodySpec& spec, int finest_level) {
  const PackCharacter& c = Nearest(pack, spec);
  const double scale = spec.stature / c.spec.stature;
  auto body = std::make_shared<Body>();
  body->spec = spec;
  body->character = c.name;
  body->outfit = c.outfit;
  for (size_t j = 0; j < kJointCount; ++j) body->p_PJ[j] = c.p_PJ[j] * scale;
  internal::FinishSkeleton(*body);
  body->size.heel_length = c.heel_length * scale;
  body->size.radius = c.radius * scale;
  body->sockets = c.sockets;
  for (Socket& s : body->sockets) s = {s.name, s.joint, s.p_J * scale, s.radius * scale};

  // Materials, clothes tinted by the look.
  internal::Wardrobe wear = internal::DrawWardrobe(spec);
  const double melanin = DrawMelanin(spec);
  // Fair hair goes with fair skin; what is darker than brown, or grey, stays.
  if (melanin > 0.3 && wear.hair_color.x > 1.3f * wear.hair_color.z)
    wear.hair_color = wear.hair_color * std::min(1.0f, 0.04f / wear.hair_color.x);
  std::map<TextureId, TextureId> own;
  for (size_t k = 0; k < c.materials.size(); ++k) {
    Material m = c.materials[k];
    if (m.base_color_texture != kNoTexture) {
      const auto [slot, fresh] = own.try_emplace(m.base_color_texture, static_cast<TextureId>(body->textures.size()));
      if (fresh) body->textures.push_back(DecodedTexture(pack, static_cast<size_t>(m.base_color_texture)));
      m.base_color_texture = slot->second;
    }
    const auto tint = [&](Vec3f color, float lift) { m.base_color = m.base_color * (Worn(color) * lift + Vec3f{0.02f, 0.02f, 0.02f}); };
    if (c.cloths[k] == Cloth::kSkin) m.base_color = m.base_color * SkinShade(melanin);
    if (c.cloths[k] == Cloth::kTop) tint(wear.top_color, 1.7f);
    if (c.cloths[k] == Cloth::kBottom) tint(wear.bottom_color, 2.0f);
    if (c.cloths[k] == Cloth::kShoes) tint(wear.shoe_color, 1.6f);
    if (c.cloths[k] == Cloth::kHair) {
      const Vec3f hair = wear.hair_color * 2.0f + Vec3f{0.008f, 0.007f, 0.006f};
      m.base_color = m.base_color * (hair * std::min(1.0f, 0.6f / std::max({hair.x, hair.y, hair.z})));
    }
    body->materials.push_back(std::move(m));
  }
  internal::Wardrobe painted = wear;
  const auto first = static_cast<uint32_t>(body->materials.size());
  Body props;
  internal::PaintBody(painted, spec, props);
  for (const auto index : {internal::kPropDark, internal::kPropLight, internal::kPropColor})
    body->materials.push_back(props.materials[index]);

  for (const BodyLevel& level : c.levels) {
    if (static_cast<int>(body->levels.size()) < finest_level) {
      body->levels.emplace_back();
      continue;
    }
    BodyLevel copy = level;
    copy.mesh.name = c.name;
    for (Vec3f& p : copy.mesh.positions) p *= static_cast<float>(scale);
    internal::LoftMesh extra;
    internal::AddProps(body->p_PJ, spec.stature, first, extra);
    internal::AppendLevel(extra.Finish("props"), copy);
    body->levels.push_back(std::move(copy));
  }
  return body;
}

std::shared_ptr<const Body> MakeBody(const BodySpec& spec, int finest_level) {
  const BodyPack* pack = InstalledBodyPack();
  return pack == nullptr ? MakeProceduralBody(spec, finest_level) : MakePackBody(*pack, spec, finest_level);
}

}  // namespace airsim360

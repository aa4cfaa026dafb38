// The textures of one imported file: each picture is decoded once for each way it is used.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "airsim360/assets/imported.h"
#include "airsim360/assets/limits.h"

namespace airsim360::internal {

/// How a texture is used: the same picture as colour and as data gives two textures.
struct TextureUse {
  bool srgb = true;
  Wrap wrap_u = Wrap::kRepeat, wrap_v = Wrap::kRepeat;
  std::string alpha_file;  ///< a second picture whose brightness becomes the alpha channel; "" = none
  auto operator<=>(const TextureUse&) const = default;
};

class TextureStore {
 public:
  /// `model` starts every message.
  TextureStore(std::string model, const ImportLimits& limits, Warnings& warnings)
      : model_(std::move(model)), limits_(limits), warnings_(warnings) {}

  /// The texture of a picture, loaded by `load(name)` on first use. A picture that is not there, or is of a
  /// kind that we do not read, gives kNoTexture and a warning; a damaged PNG, JPEG or WebP, or too many
  /// pixels, an InputError.
  TextureId Get(const std::string& name, const TextureUse& use, const ResourceLoader& load);
  /// Has a pixel less than half opaque (cutouts).
  bool HasHoles(TextureId id) const { return id != kNoTexture && has_holes_[static_cast<size_t>(id)]; }
  std::vector<Texture> Take() { return std::move(textures_); }

 private:
  std::optional<Image<Rgba8>> Decode(const std::string& name, const ResourceLoader& load);

  std::string model_;
  ImportLimits limits_;
  Warnings& warnings_;
  uint64_t pixels_ = 0;
  std::map<std::pair<std::string, TextureUse>, TextureId> ids_;
  std::vector<Texture> textures_;
  std::vector<bool> has_holes_;
};

}  // namespace airsim360::internal

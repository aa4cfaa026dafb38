#include "airsim360/assets/textures/texture_store.h"

#include <algorithm>
#include <utility>

#include "airsim360/assets/textures/ktx2.h"
#include "airsim360/base/error.h"
#include "airsim360/image/codecs.h"

namespace airsim360::internal {
namespace {

// By the first bytes: a format that DecodeRgba8 or DecodeKtx2 reads.
bool IsReadable(const Bytes& bytes) {
  const std::string_view text = AsText(bytes).substr(0, 12);
  return text.starts_with("\x89PNG") || text.starts_with("\xff\xd8\xff") ||
         (text.starts_with("RIFF") && text.size() == 12 && text.substr(8) == "WEBP") || IsKtx2(bytes);
}

// Alpha of `image` = brightness of `mask` at the same place.
void SetAlpha(Image<Rgba8>& image, const Image<Rgba8>& mask) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Rgba8 m =
          mask(static_cast<int>(int64_t{x} * mask.width() / image.width()), static_cast<int>(int64_t{y} * mask.height() / image.height()));
      const auto brightness = static_cast<uint8_t>((m.r + m.g + m.b) / 3);
      image(x, y).a = std::min(m.a, brightness);
    }
  }
}

}  // namespace

std::optional<Image<Rgba8>> TextureStore::Decode(const std::string& name, const ResourceLoader& load) {
  const std::optional<Bytes> bytes = load(name);
  if (!bytes || !IsReadable(*bytes)) {
    warnings_.Add(model_ + ": texture " + Quoted(name) + " " + (bytes ? "is neither PNG, JPEG, WebP nor KTX2" : "is missing") +
                  ": left out");
    return std::nullopt;
  }
  const std::string where = model_ + ": texture " + Quoted(name);
  std::string unread;
  std::optional<Image<Rgba8>> decoded =
      IsKtx2(*bytes) ? DecodeKtx2(*bytes, where, limits_.max_texture_pixels - pixels_, unread) : DecodeRgba8(*bytes, where);
  if (!decoded) {
    warnings_.Add(where + " is " + unread + ": left out; 'npx @gltf-transform/cli ktxdecompress' makes PNG of it");
    return std::nullopt;
  }
  Image<Rgba8>& image = *decoded;
  pixels_ += image.size();
  if (pixels_ > limits_.max_texture_pixels) {
    throw InputError(model_ + ": textures of more than " + std::to_string(limits_.max_texture_pixels) + " pixels");
  }
  return decoded;
}

TextureId TextureStore::Get(const std::string& name, const TextureUse& use, const ResourceLoader& load) {
  const auto [it, is_new] = ids_.try_emplace({name, use}, kNoTexture);
  if (!is_new) return it->second;
  std::optional<Image<Rgba8>> image = Decode(name, load);
  if (!image || image->empty()) return kNoTexture;

  // An own file for opacity; the same file means its own alpha channel.
  if (!use.alpha_file.empty() && use.alpha_file != name) {
    if (const auto mask = Decode(use.alpha_file, load); mask && !mask->empty()) SetAlpha(*image, *mask);
  }
  has_holes_.push_back(std::any_of(image->pixels().begin(), image->pixels().end(), [](Rgba8 p) { return p.a < 128; }));
  textures_.push_back(Texture::FromImage(CleanName(name), std::move(*image), use.srgb));
  textures_.back().wrap_u = use.wrap_u;
  textures_.back().wrap_v = use.wrap_v;
  return it->second = static_cast<TextureId>(textures_.size() - 1);
}

}  // namespace airsim360::internal

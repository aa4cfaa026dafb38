// Texture references: where on the surface, which picture, how it goes on beyond its edges.
#include <algorithm>
#include <cmath>

#include "airsim360/assets/gltf/gltf_parts.h"
#include "airsim360/assets/gltf/gltf_uri.h"

namespace airsim360::internal {
namespace {

Wrap ToWrap(uint64_t code) { return code == 33071 ? Wrap::kClamp : code == 33648 ? Wrap::kMirror : Wrap::kRepeat; }

}  // namespace

std::optional<JsonRef> GltfExtension(const JsonRef& json, const char* name) {
  const auto extensions = json.Find("extensions");
  return extensions ? extensions->Find(name) : std::nullopt;
}

bool UvUse::IsIdentity() const { return offset[0] == 0 && offset[1] == 0 && scale[0] == 1 && scale[1] == 1 && rotation == 0; }

Vec2f UvUse::operator()(Vec2f uv) const {
  const double u = uv.x * scale[0];
  const double v = uv.y * scale[1];
  const double c = std::cos(rotation);
  const double s = std::sin(rotation);
  return {static_cast<float>(c * u + s * v + offset[0]), static_cast<float>(-s * u + c * v + offset[1])};
}

TextureId GltfMaterials::ReadTexture(const JsonRef& info, bool srgb, UvUse* uv) {
  // Where on the surface: the set, and the transform of the texture that leads.
  UvUse use;
  use.set = info.UintOr("texCoord", 0);
  if (const auto transform = GltfExtension(info, "KHR_texture_transform")) {
    const std::vector<double> offset = transform->NumbersOr("offset", {0, 0});
    const std::vector<double> scale = transform->NumbersOr("scale", {1, 1});
    std::copy(offset.begin(), offset.end(), use.offset);
    std::copy(scale.begin(), scale.end(), use.scale);
    use.rotation = transform->NumberOr("rotation", 0);
    use.set = transform->UintOr("texCoord", use.set);
  }
  if (use.set > 31) info.Fail("texture coordinate sets beyond 31 are not read");
  if (uv) *uv = use;

  // Which picture, and how it goes on beyond its edges.
  const JsonRef texture = buffers_.Element("textures", info.At("index"));
  std::optional<JsonRef> source = texture.Find("source");
  for (const char* name : {"EXT_texture_webp", "KHR_texture_basisu", "KHR_texture_ktx"}) {
    if (const auto extension = GltfExtension(texture, name)) source = extension->Find("source");
  }
  if (!source) {
    warnings_.Add(root_.file() + ": " + texture.pointer() + ": has no picture that we read: left out");
    return kNoTexture;
  }
  const JsonRef image = buffers_.Element("images", *source);
  TextureUse how{.srgb = srgb, .wrap_u = Wrap::kRepeat, .wrap_v = Wrap::kRepeat, .alpha_file = {}};
  if (const auto sampler = texture.Find("sampler")) {
    const JsonRef json = buffers_.Element("samplers", *sampler);
    how.wrap_u = ToWrap(json.UintOr("wrapS", 10497));
    how.wrap_v = ToWrap(json.UintOr("wrapT", 10497));
  }

  // Embedded pictures are known by their place in the document, others by their file name.
  const std::string label = image.pointer().substr(1);
  const auto uri = image.Find("uri");
  if (!uri) {
    const std::span<const std::byte> bytes = buffers_.View(image.At("bufferView"));
    return textures_.Get(label, how, [&](const std::string&) { return Bytes(bytes.begin(), bytes.end()); });
  }
  const std::string text = uri->Text();
  if (IsDataUri(text)) {
    return textures_.Get(label, how, [&](const std::string&) {
      auto bytes = DecodeDataUri(text);
      if (!bytes) uri->Fail("a damaged data URI");
      return bytes;
    });
  }
  const auto name = DecodePercent(text);
  if (!name) uri->Fail("a damaged URI");
  return textures_.Get(*name, how, load_);
}

}  // namespace airsim360::internal

#include "airsim360/dataset/stored_pictures.h"

#include <zstd.h>

#include <algorithm>
#include <cstring>

#include "airsim360/base/archive.h"
#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/encode.h"
#include "airsim360/dataset/encode_extra.h"
#include "airsim360/image/codecs.h"
#include "airsim360/scene/parts.h"

namespace airsim360 {
namespace {

using Type = StoredPicture::Type;

constexpr int kZstdLevel = 1;

// Pixels of `depth` values each as they lie in memory.
template <class Pixel>
void Put(const Image<Pixel>& image, Type type, StoredPicture& picture) {
  picture.type = type;
  picture.width = image.width(), picture.height = image.height();
  picture.depth = static_cast<int>(sizeof(Pixel) / SizeOf(type));
  const auto bytes = std::as_bytes(image.pixels());
  picture.values.assign(bytes.begin(), bytes.end());
}

void PutChannels(const internal::ChannelPicture& channels, StoredPicture& picture) {
  picture.type = Type::kFloat32;
  picture.width = channels.width, picture.height = channels.height;
  picture.depth = static_cast<int>(channels.channels.size());
  picture.channels.assign(channels.channels.begin(), channels.channels.end());
  const auto bytes = std::as_bytes(std::span(channels.values));
  picture.values.assign(bytes.begin(), bytes.end());
}

// What JPEG makes of a colour picture.
Image<Rgb8> ThroughJpeg(const Image<Rgb8>& rgb) {
  const Image<Rgba8> read = DecodeRgba8(EncodeJpeg(rgb, kJpegQuality), "jpeg");
  Image<Rgb8> plain(read.width(), read.height());
  std::transform(read.pixels().begin(), read.pixels().end(), plain.pixels().begin(), [](Rgba8 c) { return Rgb8{c.r, c.g, c.b}; });
  return plain;
}

void Store(const DatasetSpec& spec, const Frame& frame, EntityId sky, bool wide, StoredPicture& picture) {
  const std::string& product = picture.product;
  if (product == "rgb") return Put(spec.rgb_format == RgbFormat::kJpeg ? ThroughJpeg(frame.rgb) : frame.rgb, Type::kUint8, picture);
  if (product == "range") return Put(frame.range, Type::kFloat32, picture);
  if (product == "semantic" && wide) return Put(frame.semantic, Type::kUint16, picture);
  if (product == "semantic") return Put(internal::NarrowSemantic(frame.semantic), Type::kUint8, picture);
  if (product == "entity") return Put(frame.entity, Type::kUint32, picture);
  if (product == "normal") return Put(internal::CodeNormal(frame.normal), Type::kUint16, picture);
  if (product == "albedo") return Put(internal::CodeAlbedo(frame.albedo), Type::kUint8, picture);
  if (product == "sky") return Put(SkyMask(frame.entity, sky), Type::kUint8, picture);
  // Half floats.
  if (product == "radiance") return Put(DecodeExrRgb(EncodeHalfExr(frame.radiance), product), Type::kFloat32, picture);
  PutChannels(internal::CodeChannels(product, frame), picture);
}

bool IsPacked(const StoredPicture& picture) {
  return picture.product == "semantic" || picture.product == "entity" || picture.product == "sky";
}

Bytes Compressed(const Bytes& bytes) {
  Bytes packed(ZSTD_compressBound(bytes.size()));
  const size_t size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kZstdLevel);
  if (ZSTD_isError(size)) throw RuntimeError(std::string("zstd: ") + ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

// One list of fields for both ways.
template <class Archive, class Picture>
void Fields(Archive& archive, Picture& picture) {
  archive(picture.product, picture.view, picture.type, picture.width, picture.height, picture.depth);
  archive.Each(picture.channels, [&](auto& channel) { archive(channel); });
}

}  // namespace

size_t SizeOf(Type type) {
  constexpr size_t kSizes[] = {1, 2, 4, 4};
  return kSizes[static_cast<size_t>(type)];
}

std::vector<StoredPicture> StoredPictures(const DatasetSpec& spec, std::span<const View> views, std::span<const Capture> captures,
                                          EntityId sky, bool wide) {
  std::vector<StoredPicture> pictures;
  std::vector<const Frame*> frames;
  for (const ProductFolder& folder : ProductFolders(spec)) {
    for (size_t v = 0; v < views.size(); ++v) {
      pictures.push_back({.product = folder.name, .view = views[v].suffix.empty() ? "" : views[v].suffix.substr(1)});
      frames.push_back(&captures[v].frame);
    }
  }
  ParallelFor(static_cast<int64_t>(pictures.size()),
              [&](int64_t i) { Store(spec, *frames[static_cast<size_t>(i)], sky, wide, pictures[static_cast<size_t>(i)]); });
  return pictures;
}

Bytes PackPictures(const std::string& text, const std::vector<StoredPicture>& pictures) {
  ArchiveWriter archive;
  archive(text);
  archive.Each(pictures, [&](const StoredPicture& picture) {
    Fields(archive, picture);
    archive(IsPacked(picture) ? Compressed(picture.values) : picture.values);
  });
  return archive.Take();
}

bool UnpackPictures(std::span<const std::byte> bytes, std::string& text, std::vector<StoredPicture>& pictures) {
  try {
    ArchiveReader archive(bytes);
    archive(text);
    archive.Each(pictures, [&](StoredPicture& picture) {
      Fields(archive, picture);
      Bytes stored;
      archive(stored);
      if (picture.type > Type::kFloat32 || picture.width < 1 || picture.height < 1 || picture.depth < 1 ||
          int64_t{picture.width} * picture.height > kMaxPixels || picture.depth > 16)
        throw InputError("not pictures");
      const size_t size = static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height) * static_cast<size_t>(picture.depth) *
                          SizeOf(picture.type);
      if (IsPacked(picture)) {
        picture.values.resize(size);
        if (ZSTD_decompress(picture.values.data(), size, stored.data(), stored.size()) != size) throw InputError("not pictures");
      } else {
        picture.values = std::move(stored);
      }
      if (picture.values.size() != size) throw InputError("not pictures");
    });
    return archive.done();
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace airsim360

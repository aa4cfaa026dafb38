// PNG reader on libpng. libpng reports errors by longjmp, so everything that owns memory lives outside the
// two functions that call setjmp.
#include <png.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs_internal.h"
#include "airsim360/image/palette_png.h"

namespace airsim360 {
namespace {

struct Source {
  std::span<const std::byte> rest;
  char message[200] = "damaged PNG";
};

void ReadBytes(png_structp png, png_bytep out, size_t n) {
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  if (n > source->rest.size()) png_error(png, "truncated PNG");
  std::memcpy(out, source->rest.data(), n);
  source->rest = source->rest.subspan(n);
}

void OnError(png_structp png, png_const_charp message) {
  auto* source = static_cast<Source*>(png_get_error_ptr(png));
  std::strncpy(source->message, message, sizeof source->message - 1);
  png_longjmp(png, 1);
}

void OnWarning(png_structp, png_const_charp) {}

// What the caller wants the pixels to be.
enum class Form { kRgba8, kGray, kRgb16 };

struct Info {
  uint32_t width = 0, height = 0;
  int bit_depth = 0, color_type = 0;
};

class PngReader {
 public:
  PngReader(std::span<const std::byte> bytes, std::string_view name) : name_(name) {
    source_.rest = bytes;
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, OnError, OnWarning);
    info_ = png_ ? png_create_info_struct(png_) : nullptr;
    if (!info_) throw RuntimeError("libpng: out of memory");
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  /// Reads up to the pixels; checks the size before memory is taken.
  Info ReadHeader() {
    const size_t file_size = source_.rest.size();
    if (!TryReadHeader()) internal::ThrowDamaged(name_, source_.message);
    Info info;
    png_get_IHDR(png_, info_, &info.width, &info.height, &info.bit_depth, &info.color_type, nullptr, nullptr, nullptr);
    internal::CheckSize(info.width, info.height, name_);
    // Deflate shrinks at most 1032 times: a small file cannot hold a large picture.
    const uint64_t bits = static_cast<uint64_t>(png_get_channels(png_, info_)) * info.bit_depth * info.width * info.height;
    if (bits / 8 / 1032 > file_size) internal::ThrowDamaged(name_, "truncated PNG");
    return info;
  }

  /// The palette; empty where there is none. After ReadHeader.
  std::vector<Rgb8> Palette() const {
    png_colorp colors = nullptr;
    int count = 0;
    std::vector<Rgb8> palette;
    if (png_get_PLTE(png_, info_, &colors, &count) == 0) return palette;
    for (int i = 0; i < count; ++i) palette.push_back({colors[i].red, colors[i].green, colors[i].blue});
    return palette;
  }

  /// Reads all pixels as `form` into rows of memory, to the end of the file.
  void ReadPixels(Form form, std::vector<png_bytep>& rows) {
    if (!TryReadPixels(form, rows.data())) internal::ThrowDamaged(name_, source_.message);
  }

 private:
  bool TryReadHeader() {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_read_fn(png_, &source_, ReadBytes);
    png_set_user_limits(png_, 0x7fffffff, 0x7fffffff);
    png_set_chunk_malloc_max(png_, 16 << 20);
    png_set_chunk_cache_max(png_, 64);
    // Metadata is not wanted: only the chunks that change pixels are kept.
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_read_info(png_, info_);
    return true;
  }

  bool TryReadPixels(Form form, png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_))) return false;
    switch (form) {
      case Form::kRgba8:
        png_set_expand(png_);
        png_set_scale_16(png_);
        png_set_gray_to_rgb(png_);
        png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);
        break;
      case Form::kGray:
        png_set_packing(png_);
        png_set_strip_alpha(png_);
        break;
      case Form::kRgb16:
        png_set_expand_16(png_);
        png_set_gray_to_rgb(png_);
        png_set_strip_alpha(png_);
        break;
    }
    if (form != Form::kRgba8 && std::endian::native == std::endian::little) png_set_swap(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

  std::string_view name_;
  Source source_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

template <class Pixel>
Image<Pixel> ReadInto(PngReader& reader, const Info& info, Form form) {
  Image<Pixel> image(static_cast<int>(info.width), static_cast<int>(info.height));
  std::vector<png_bytep> rows(info.height);
  for (uint32_t y = 0; y < info.height; ++y) rows[y] = reinterpret_cast<png_bytep>(image.row(static_cast<int>(y)).data());
  reader.ReadPixels(form, rows);
  return image;
}

}  // namespace

namespace internal {

Image<Rgba8> DecodePngRgba8(std::span<const std::byte> bytes, std::string_view name) {
  PngReader reader(bytes, name);
  const Info info = reader.ReadHeader();
  return ReadInto<Rgba8>(reader, info, Form::kRgba8);
}

}  // namespace internal

PngKind ReadPngKind(std::span<const std::byte> bytes, std::string_view name) {
  const Info info = PngReader(bytes, name).ReadHeader();
  if (info.color_type == PNG_COLOR_TYPE_PALETTE) return {3, 8};
  return {info.color_type & PNG_COLOR_MASK_COLOR ? 3 : 1, info.bit_depth};
}

namespace {

Image<uint16_t> Widened(const Image<uint8_t>& narrow) {
  Image<uint16_t> image(narrow.width(), narrow.height());
  std::copy(narrow.pixels().begin(), narrow.pixels().end(), image.pixels().begin());
  return image;
}

}  // namespace

bool IsPalettePng(std::span<const std::byte> bytes, std::string_view name) {
  return PngReader(bytes, name).ReadHeader().color_type == PNG_COLOR_TYPE_PALETTE;
}

PalettePicture DecodePalettePng(std::span<const std::byte> bytes, std::string_view name) {
  PngReader reader(bytes, name);
  const Info info = reader.ReadHeader();
  if (info.color_type != PNG_COLOR_TYPE_PALETTE) internal::ThrowDamaged(name, "a PNG with a palette is expected");
  PalettePicture picture{.indices = {}, .palette = reader.Palette()};
  picture.indices = ReadInto<uint8_t>(reader, info, Form::kGray);
  const auto beyond = [&](uint8_t index) { return index >= picture.palette.size(); };
  if (std::any_of(picture.indices.pixels().begin(), picture.indices.pixels().end(), beyond))
    internal::ThrowDamaged(name, "a pixel is beyond the palette");
  return picture;
}

Image<uint16_t> DecodeLabelPng(std::span<const std::byte> bytes, std::string_view name) {
  return IsPalettePng(bytes, name) ? Widened(DecodePalettePng(bytes, name).indices) : DecodeGrayPng(bytes, name);
}

Image<uint16_t> DecodeGrayPng(std::span<const std::byte> bytes, std::string_view name) {
  PngReader reader(bytes, name);
  const Info info = reader.ReadHeader();
  if (info.color_type & PNG_COLOR_MASK_COLOR) internal::ThrowDamaged(name, "a gray PNG is expected, this one has colour");
  if (info.bit_depth == 16) return ReadInto<uint16_t>(reader, info, Form::kGray);
  return Widened(ReadInto<uint8_t>(reader, info, Form::kGray));
}

Image<Rgb16> DecodeRgb16Png(std::span<const std::byte> bytes, std::string_view name) {
  PngReader reader(bytes, name);
  const Info info = reader.ReadHeader();
  return ReadInto<Rgb16>(reader, info, Form::kRgb16);
}

Image<uint32_t> DecodeIdPng(std::span<const std::byte> bytes, std::string_view name) {
  PngReader reader(bytes, name);
  const Info info = reader.ReadHeader();
  if (info.bit_depth != 8 || (info.color_type != PNG_COLOR_TYPE_RGB && info.color_type != PNG_COLOR_TYPE_RGB_ALPHA)) {
    internal::ThrowDamaged(name, "an id picture is an 8-bit RGB PNG");
  }
  const auto rgb = ReadInto<Rgba8>(reader, info, Form::kRgba8);
  Image<uint32_t> ids(rgb.width(), rgb.height());
  for (size_t i = 0; i < rgb.size(); ++i) {
    const Rgba8 p = rgb.pixels()[i];
    ids.pixels()[i] = p.r | p.g << 8 | p.b << 16;
  }
  return ids;
}

}  // namespace airsim360

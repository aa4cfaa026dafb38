// JPEG on libjpeg-turbo. libjpeg reports errors by longjmp, so everything that owns memory lives outside the
// functions that call setjmp.
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
// jpeglib.h needs FILE and size_t before it.
#include <jerror.h>
#include <jpeglib.h>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs_internal.h"

namespace airsim360 {
namespace {

// More scans than this are an attack: each costs a pass over the whole picture.
constexpr int kMaxScans = 64;

struct ErrorManager {
  jpeg_error_mgr base;  // first, so that libjpeg's pointer to it is a pointer to this
  std::jmp_buf jump;
  char message[JMSG_LENGTH_MAX] = "damaged JPEG";
};

[[noreturn]] void OnError(j_common_ptr info) {
  auto* error = reinterpret_cast<ErrorManager*>(info->err);
  info->err->format_message(info, error->message);
  std::longjmp(error->jump, 1);
}

// Warnings mean damaged data, but for three that say only that the file is unusual.
void OnMessage(j_common_ptr info, int level) {
  if (level >= 0) return;
  const int code = info->err->msg_code;
  if (code == JWRN_EXTRANEOUS_DATA || code == JWRN_ADOBE_XFORM || code == JWRN_NOT_SEQUENTIAL) return;
  OnError(info);
}

jpeg_error_mgr* Prepare(ErrorManager& error) {
  jpeg_std_error(&error.base);
  error.base.error_exit = OnError;
  error.base.emit_message = OnMessage;
  return &error.base;
}

void LimitScans(j_common_ptr info) {
  auto* decoder = reinterpret_cast<j_decompress_ptr>(info);
  if (decoder->input_scan_number <= kMaxScans) return;
  auto* error = reinterpret_cast<ErrorManager*>(info->err);
  std::strcpy(error->message, "more scans than any camera writes");
  std::longjmp(error->jump, 1);
}

class JpegReader {
 public:
  JpegReader(std::span<const std::byte> bytes, std::string_view name) : bytes_(bytes), name_(name) { decoder_.err = Prepare(error_); }
  ~JpegReader() { jpeg_destroy_decompress(&decoder_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  Image<Rgba8> Read() {
    if (!TryReadHeader()) internal::ThrowDamaged(name_, error_.message);
    const int64_t width = decoder_.image_width, height = decoder_.image_height;
    internal::CheckSize(width, height, name_);
    // A Huffman-coded block of 64 samples takes at least a bit, and sampling factors of 4 spread 8 of them
    // over 1024 pixels at worst: a small file cannot hold a large picture.
    if (!decoder_.arith_code && width * height / 1024 > static_cast<int64_t>(bytes_.size())) {
      internal::ThrowDamaged(name_, "truncated JPEG");
    }
    Image<Rgba8> image(static_cast<int>(width), static_cast<int>(height));
    std::vector<uint8_t> cmyk(
        decoder_.jpeg_color_space == JCS_CMYK || decoder_.jpeg_color_space == JCS_YCCK ? static_cast<size_t>(width) * 4 : 0);
    if (!TryReadPixels(image, cmyk)) internal::ThrowDamaged(name_, error_.message);
    return image;
  }

 private:
  bool TryReadHeader() {
    if (setjmp(error_.jump)) return false;
    jpeg_create_decompress(&decoder_);
    progress_.progress_monitor = LimitScans;
    decoder_.progress = &progress_;
    jpeg_mem_src(&decoder_, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
    jpeg_read_header(&decoder_, TRUE);
    return true;
  }

  bool TryReadPixels(Image<Rgba8>& image, std::vector<uint8_t>& cmyk) {
    if (setjmp(error_.jump)) return false;
    decoder_.out_color_space = cmyk.empty() ? JCS_EXT_RGBA : JCS_CMYK;
    decoder_.dct_method = JDCT_ISLOW;
    jpeg_start_decompress(&decoder_);
    while (decoder_.output_scanline < decoder_.output_height) {
      const auto out = image.row(static_cast<int>(decoder_.output_scanline));
      JSAMPROW row = cmyk.empty() ? reinterpret_cast<JSAMPROW>(out.data()) : cmyk.data();
      jpeg_read_scanlines(&decoder_, &row, 1);
      if (!cmyk.empty()) FromCmyk(cmyk, out);
    }
    jpeg_finish_decompress(&decoder_);
    return true;
  }

  // Adobe writes CMYK inverted (255 = no ink).
  void FromCmyk(const std::vector<uint8_t>& cmyk, std::span<Rgba8> out) const {
    for (size_t i = 0; i < out.size(); ++i) {
      uint8_t c[4];
      for (int k = 0; k < 4; ++k) c[k] = decoder_.saw_Adobe_marker ? cmyk[4 * i + k] : 255 - cmyk[4 * i + k];
      for (int k = 0; k < 3; ++k) c[k] = static_cast<uint8_t>((c[k] * c[3] + 127) / 255);
      out[i] = {c[0], c[1], c[2], 255};
    }
  }

  std::span<const std::byte> bytes_;
  std::string_view name_;
  jpeg_decompress_struct decoder_{};
  jpeg_progress_mgr progress_{};
  ErrorManager error_;
};

struct Output {
  unsigned char* data = nullptr;  // owned by malloc, as jpeg_mem_dest does it
  unsigned long size = 0;
  ~Output() { std::free(data); }
};

bool TryEncode(const Image<Rgb8>& image, int quality, std::string_view app1, jpeg_compress_struct& encoder, ErrorManager& error,
               Output& out) {
  if (setjmp(error.jump)) return false;
  jpeg_create_compress(&encoder);
  jpeg_mem_dest(&encoder, &out.data, &out.size);
  encoder.image_width = static_cast<JDIMENSION>(image.width());
  encoder.image_height = static_cast<JDIMENSION>(image.height());
  encoder.input_components = 3;
  encoder.in_color_space = JCS_RGB;
  jpeg_set_defaults(&encoder);
  jpeg_set_quality(&encoder, quality, TRUE);
  encoder.comp_info[0].h_samp_factor = encoder.comp_info[0].v_samp_factor = 1;  // 4:4:4
  encoder.dct_method = JDCT_ISLOW;
  jpeg_start_compress(&encoder, TRUE);
  if (!app1.empty()) {
    jpeg_write_marker(&encoder, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(app1.data()), static_cast<unsigned>(app1.size()));
  }
  while (encoder.next_scanline < encoder.image_height) {
    const auto* row = reinterpret_cast<const JSAMPLE*>(image.row(static_cast<int>(encoder.next_scanline)).data());
    JSAMPROW rows[] = {const_cast<JSAMPROW>(row)};
    jpeg_write_scanlines(&encoder, rows, 1);
  }
  jpeg_finish_compress(&encoder);
  return true;
}

}  // namespace

namespace internal {

Image<Rgba8> DecodeJpegRgba8(std::span<const std::byte> bytes, std::string_view name) { return JpegReader(bytes, name).Read(); }

}  // namespace internal

Bytes EncodeJpeg(const Image<Rgb8>& image, int quality, const std::optional<GPano>& gpano) {
  internal::CheckSize(image.width(), image.height(), "JPEG");
  if (quality < 1 || quality > 100) throw InputError("JPEG: quality " + std::to_string(quality) + " is not in 1..100");
  if (image.width() > JPEG_MAX_DIMENSION || image.height() > JPEG_MAX_DIMENSION) {
    throw InputError("JPEG: sides are limited to " + std::to_string(JPEG_MAX_DIMENSION) + " pixels");
  }
  using std::string_literals::operator""s;
  std::string app1;
  if (gpano) app1 = "http://ns.adobe.com/xap/1.0/\0"s + internal::GPanoXmp(*gpano, image.width(), image.height());

  jpeg_compress_struct encoder{};
  ErrorManager error;
  encoder.err = Prepare(error);
  Output out;
  const bool done = TryEncode(image, quality, app1, encoder, error, out);
  jpeg_destroy_compress(&encoder);
  if (!done) throw RuntimeError(std::string("JPEG: ") + error.message);
  const auto* data = reinterpret_cast<const std::byte*>(out.data);
  return Bytes(data, data + out.size);
}

}  // namespace airsim360

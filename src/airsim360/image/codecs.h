// Encoding to and decoding from file formats, all in memory; writing files is base/file.h.
// Encoders are deterministic: the same image and options give the same bytes.
// Decoders take untrusted bytes: any damage gives an InputError whose message starts with `name`, never a
// crash; images of more than kMaxPixels are refused before memory is taken.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "airsim360/base/file.h"
#include "airsim360/image/image.h"

namespace airsim360 {

inline constexpr int64_t kMaxPixels = int64_t{1} << 28;

/// What GPano (Google Photo Sphere XMP) says of an equirectangular picture; degrees, compass heading
/// clockwise from north.
struct GPano {
  double heading_deg = 0, pitch_deg = 0, roll_deg = 0;
};

/// PNG, 8 or 16 bit, 1, 3 or 4 channels by pixel type. Fast lossless settings; `gpano` goes into an iTXt XMP
/// packet.
Bytes EncodePng(const Image<Rgb8>& image, const std::optional<GPano>& gpano = std::nullopt);
Bytes EncodePng(const Image<Rgba8>& image);
Bytes EncodePng(const Image<Rgb16>& image);
Bytes EncodePng(const Image<uint8_t>& image);
Bytes EncodePng(const Image<uint16_t>& image);
/// Entity ids as COCO panoptic PNG: id = R + 256 G + 65536 B. Ids of 2^24 or more: InputError.
Bytes EncodeIdPng(const Image<uint32_t>& ids);

/// JPEG, 4:4:4, quality 1..100; `gpano` goes into an APP1 XMP segment.
Bytes EncodeJpeg(const Image<Rgb8>& image, int quality = 95, const std::optional<GPano>& gpano = std::nullopt);

/// OpenEXR, float32, one channel "Y" (range), ZIP compressed.
Bytes EncodeExr(const Image<float>& image);
/// OpenEXR, float32, channels R G B (linear light).
Bytes EncodeExr(const Image<Rgb32f>& image);
/// The same as half floats; beyond 65504 held there.
Bytes EncodeHalfExr(const Image<Rgb32f>& image);
/// OpenEXR, float32, any channels, given pixel by pixel: pixels.size() == width * height * channels.size().
Bytes EncodeExr(std::span<const float> pixels, int width, int height, std::span<const char* const> channels);

/// Any PNG/JPEG/WebP, converted to 8-bit RGBA. The format is told by its first bytes.
Image<Rgba8> DecodeRgba8(std::span<const std::byte> bytes, std::string_view name);
/// How a PNG stores its pixels: gray (1 channel) or colour (3), transparency aside, with 1 ... 16 bits a
/// sample; pictures with a palette count as 8-bit colour. Reads the header alone.
struct PngKind {
  int channels = 0, bit_depth = 0;
};
PngKind ReadPngKind(std::span<const std::byte> bytes, std::string_view name);
/// PNG kept at full depth: gray 8/16 bit to uint16 (8-bit values not scaled), colour to 16 bit (8-bit values
/// times 257).
Image<uint16_t> DecodeGrayPng(std::span<const std::byte> bytes, std::string_view name);
Image<Rgb16> DecodeRgb16Png(std::span<const std::byte> bytes, std::string_view name);
/// Entity ids of a PNG written by EncodeIdPng.
Image<uint32_t> DecodeIdPng(std::span<const std::byte> bytes, std::string_view name);
/// One channel of an EXR as float32: `Y`, else `R`, else the first.
Image<float> DecodeExr(std::span<const std::byte> bytes, std::string_view name);
/// The channel of that name; InputError if there is none.
Image<float> DecodeExrChannel(std::span<const std::byte> bytes, std::string_view name, std::string_view channel);
/// Linear colour of an EXR: R, G, B, or one channel thrice; lossy compressions too.
Image<Rgb32f> DecodeExrRgb(std::span<const std::byte> bytes, std::string_view name);
/// Radiance picture (.hdr, .pic) with RGBE pixels, top row first: linear colour, EXPOSURE lines undone
/// (Ward, "Real Pixels", Graphics Gems II, 1991).
Image<Rgb32f> DecodeRadianceHdr(std::span<const std::byte> bytes, std::string_view name);

}  // namespace airsim360

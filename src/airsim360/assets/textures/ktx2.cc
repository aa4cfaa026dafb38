#include "airsim360/assets/textures/ktx2.h"

#include <algorithm>
#include <array>

#include "airsim360/assets/textures/etc1s.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360::internal {
namespace {

constexpr std::string_view kMagic("\xabKTX 20\xbb\r\n\x1a\n", 12);
constexpr uint32_t kBasisLz = 1;
constexpr uint32_t kModelEtc1s = 163, kModelUastc = 166;
constexpr uint32_t kVideo = 2;
constexpr uint8_t kGreen = 4;  // channel of a second slice; else it is alpha

// A container whose parts lie where they say.
class Container {
 public:
  Container(std::span<const std::byte> bytes, const std::string& where) : bytes_(bytes), where_(where) {}

  [[noreturn]] void Fail(const std::string& what) const { throw InputError(where_ + ": " + what); }
  uint64_t Number(uint64_t at, int size) const {
    const auto part = Part(at, static_cast<uint64_t>(size));
    uint64_t value = 0;
    for (size_t k = 0; k < part.size(); ++k) value |= std::to_integer<uint64_t>(part[k]) << (8 * k);
    return value;
  }
  uint32_t U32(uint64_t at) const { return static_cast<uint32_t>(Number(at, 4)); }
  std::span<const std::byte> Part(uint64_t at, uint64_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at) Fail("a KTX2 file cut short");
    return bytes_.subspan(at, size);
  }

 private:
  std::span<const std::byte> bytes_;
  const std::string& where_;
};

Image<Rgba8> DecodePlain(const Container& file, std::span<const std::byte> level, int width, int height, size_t channels) {
  Image<Rgba8> image(width, height);
  if (level.size() < image.size() * channels) file.Fail("a KTX2 level cut short");
  for (size_t i = 0; i < image.size(); ++i) {
    const auto at = [&](size_t c) { return std::to_integer<uint8_t>(level[i * channels + c]); };
    image.pixels()[i] = {at(0), at(1), at(2), channels == 4 ? at(3) : uint8_t{255}};
  }
  return image;
}

// Global data: counts, lengths, what each image is; then the codebooks.
Image<Rgba8> DecodeBasisLz(const Container& file, const std::string& where, std::span<const std::byte> level, int width, int height) {
  const uint64_t global = file.Number(64, 8), size = file.Number(72, 8), level_count = std::max(file.U32(40), 1u);
  const std::span<const std::byte> data = file.Part(global, size);
  const Container part(data, where);
  constexpr uint64_t kHeader = 20, kImage = 20;
  const auto endpoints = static_cast<uint32_t>(part.Number(0, 2)), selectors = static_cast<uint32_t>(part.Number(2, 2));
  uint64_t at = kHeader + kImage * level_count;
  const auto next = [&](uint64_t field) {
    const uint64_t length = part.U32(field), begin = at;
    at += length;
    return part.Part(begin, length);
  };
  const auto endpoint_data = next(4), selector_data = next(8), table_data = next(12);
  if ((part.U32(kHeader) & kVideo) != 0) file.Fail("a frame of a video");
  const Etc1sCodebooks codebooks(endpoint_data, endpoints, selector_data, selectors, table_data, where);
  const Container slices(level, where);
  const auto columns = static_cast<uint32_t>((width + 3) / 4), rows = static_cast<uint32_t>((height + 3) / 4);
  const auto color = codebooks.Decode(slices.Part(part.U32(kHeader + 4), part.U32(kHeader + 8)), columns, rows);
  std::vector<std::array<uint8_t, 3>> second;
  if (const uint32_t length = part.U32(kHeader + 16)) second = codebooks.Decode(slices.Part(part.U32(kHeader + 12), length), columns, rows);

  // What the second slice is stands with the second sample of the format descriptor.
  const uint64_t format = file.U32(48), format_size = file.U32(52);
  constexpr uint64_t kSecondChannel = 4 + 24 + 16 + 3;
  const bool green = !second.empty() && format_size > kSecondChannel && (file.Number(format + kSecondChannel, 1) & 15) == kGreen;
  Image<Rgba8> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const size_t i = static_cast<size_t>(y) * columns * 4 + static_cast<size_t>(x);
      Rgba8& pixel = image(x, y) = {color[i][0], color[i][1], color[i][2], 255};
      if (green)
        pixel.g = second[i][0];
      else if (!second.empty())
        pixel.a = second[i][1];
    }
  }
  return image;
}

}  // namespace

bool IsKtx2(std::span<const std::byte> bytes) { return AsText(bytes).starts_with(kMagic); }

std::optional<Image<Rgba8>> DecodeKtx2(std::span<const std::byte> bytes, const std::string& where, uint64_t most_pixels,
                                       std::string& unread) {
  const Container file(bytes, where);
  if (!IsKtx2(bytes)) file.Fail("not a KTX2 file");
  const uint32_t vulkan_format = file.U32(12), width = file.U32(20), height = file.U32(24), scheme = file.U32(44);
  constexpr uint32_t kWidest = 65536;
  if (width == 0 || height == 0 || width > kWidest || height > kWidest || uint64_t{width} * height > most_pixels)
    file.Fail("a KTX2 picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
  if (file.U32(28) != 0 || file.U32(32) > 1 || file.U32(36) != 1) {
    unread = "a KTX2 volume, array or cube";
    return std::nullopt;
  }
  const auto level = file.Part(file.Number(80, 8), file.Number(88, 8));
  const auto w = static_cast<int>(width), h = static_cast<int>(height);
  const bool rgb = vulkan_format == 23 || vulkan_format == 29, rgba = vulkan_format == 37 || vulkan_format == 43;
  if (scheme == 0 && (rgb || rgba)) return DecodePlain(file, level, w, h, rgb ? 3 : 4);
  const uint64_t model = file.Number(file.U32(48) + uint64_t{12}, 1);
  if (vulkan_format == 0 && scheme == kBasisLz && model == kModelEtc1s) return DecodeBasisLz(file, where, level, w, h);
  unread = model == kModelUastc
               ? "a KTX2 picture in UASTC"
               : "a KTX2 picture of Vulkan format " + std::to_string(vulkan_format) + ", supercompression " + std::to_string(scheme);
  return std::nullopt;
}

}  // namespace airsim360::internal

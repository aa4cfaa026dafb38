// OpenEXR float pictures from memory, single threaded (callers are parallel over pictures).
#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfVersion.h>
#include <OpenEXR/ImfXdr.h>

#include <cstring>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs_internal.h"
#include "airsim360/image/exr_metadata.h"

namespace airsim360 {
namespace {

class MemoryReader : public Imf::IStream {
 public:
  explicit MemoryReader(std::span<const std::byte> bytes) : IStream("memory"), bytes_(bytes) {}
  bool read(char out[], int n) override {
    if (n < 0 || at_ > bytes_.size() || static_cast<size_t>(n) > bytes_.size() - at_) throw InputError("truncated EXR");
    if (n > 0) std::memcpy(out, bytes_.data() + at_, static_cast<size_t>(n));
    at_ += static_cast<size_t>(n);
    return at_ < bytes_.size();
  }
  uint64_t tellg() override { return at_; }
  void seekg(uint64_t at) override { at_ = at; }

 private:
  std::span<const std::byte> bytes_;
  uint64_t at_ = 0;
};

// Lines of pixels that a compression packs together; 0 for those we do not read. Lossy ones are for colours
// alone: a range must be exact.
int LinesPerChunk(Imf::Compression compression, bool lossy) {
  switch (compression) {
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION:
      return 1;
    case Imf::ZIP_COMPRESSION:
      return 16;
    case Imf::PIZ_COMPRESSION:
      return 32;
    case Imf::PXR24_COMPRESSION:
      return lossy ? 16 : 0;
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
      return lossy ? 32 : 0;
    case Imf::DWAB_COMPRESSION:
      return lossy ? 256 : 0;
    default:
      return 0;
  }
}

// Walks the attributes (name, 0, type, 0, size, value) and refuses one that is larger than the file: OpenEXR
// would take memory for it first.
void CheckAttributes(std::string_view header) {
  while (!header.empty() && header[0] != 0) {
    for (int text = 0; text < 2; ++text) {
      const size_t end = header.find('\0');
      header.remove_prefix(end == std::string_view::npos ? header.size() : end + 1);
    }
    if (header.size() < 4) throw InputError("truncated EXR");
    uint32_t size = 0;
    for (int i = 3; i >= 0; --i) size = size << 8 | static_cast<uint8_t>(header[static_cast<size_t>(i)]);
    header.remove_prefix(4);
    if (size > header.size()) throw InputError("truncated EXR");
    header.remove_prefix(size);
    if (header.empty()) throw InputError("truncated EXR");
  }
}

// Looks at the header alone, so that a hostile one is refused before OpenEXR takes memory for it.
void CheckHeader(std::span<const std::byte> bytes, bool lossy) {
  MemoryReader reader(bytes);
  int magic = 0, version = 0;
  Imf::Xdr::read<Imf::StreamIO>(reader, magic);
  Imf::Xdr::read<Imf::StreamIO>(reader, version);
  if (magic != Imf::MAGIC) throw InputError("not an EXR file");
  if (Imf::getVersion(version) != 2 || (Imf::getFlags(version) & ~Imf::LONG_NAMES_FLAG) != 0) {
    throw InputError("only single-part scan-line EXR files are read");
  }
  CheckAttributes(AsText(bytes.subspan(8)));
  Imf::Header header;
  header.readFrom(reader, version);
  const Imath::Box2i window = header.dataWindow();
  const int64_t width = int64_t{window.max.x} - window.min.x + 1, height = int64_t{window.max.y} - window.min.y + 1;
  constexpr int kFarthest = 1 << 24;
  if (window.min.x < -kFarthest || window.min.y < -kFarthest || window.max.x > kFarthest || window.max.y > kFarthest) {
    throw InputError("data window out of range");
  }
  internal::CheckSize(width, height, "size");
  const int lines = LinesPerChunk(header.compression(), lossy);
  if (lines == 0) throw InputError("lossy EXR compression; write it with none, RLE, ZIPS, ZIP or PIZ");

  // The table of offsets and the head of each chunk take 16 bytes a chunk at least, and no compression we
  // read shrinks more than 1032 times (deflate): a small file cannot hold a large picture.
  int64_t channels = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    const bool full = c.channel().xSampling == 1 && c.channel().ySampling == 1;
    if (!full) throw InputError("subsampled channels are not read");
    ++channels;
  }
  if (channels == 0 || channels > 64 || width * channels * 4 * lines > int64_t{1} << 28) {
    throw InputError("too many or too wide channels");
  }
  const auto size = static_cast<int64_t>(bytes.size());
  if ((height + lines - 1) / lines * 16 > size || width * height * channels * 2 / 1032 > size) {
    throw InputError("truncated EXR");
  }
}

std::string ChannelToRead(const Imf::ChannelList& channels, std::string_view wanted) {
  if (!wanted.empty()) {
    if (channels.findChannel(std::string(wanted)) == nullptr) throw InputError("no channel '" + std::string(wanted) + "'");
    return std::string(wanted);
  }
  for (const char* name : {"Y", "R"}) {
    if (channels.findChannel(name)) return name;
  }
  return channels.begin().name();
}

Image<float> ReadExr(std::span<const std::byte> bytes, std::string_view channel) {
  CheckHeader(bytes, false);
  MemoryReader reader(bytes);
  Imf::InputFile file(reader, 0);
  if (!file.isComplete()) throw InputError("truncated EXR");
  const Imath::Box2i window = file.header().dataWindow();
  Image<float> image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);
  Imf::FrameBuffer frame;
  frame.insert(ChannelToRead(file.header().channels(), channel),
               Imf::Slice::Make(Imf::FLOAT, image.pixels().data(), window, sizeof(float), sizeof(float) * image.width()));
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

Image<Rgb32f> ReadExrRgb(std::span<const std::byte> bytes) {
  CheckHeader(bytes, true);
  MemoryReader reader(bytes);
  Imf::InputFile file(reader, 0);
  if (!file.isComplete()) throw InputError("truncated EXR");
  const Imath::Box2i window = file.header().dataWindow();
  const Imf::ChannelList& channels = file.header().channels();
  const bool color = channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B");
  Image<Rgb32f> image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);
  Imf::FrameBuffer frame;
  Rgb32f* first = image.pixels().data();
  const auto insert = [&](const std::string& name, float* to) {
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, to, window, sizeof(Rgb32f), sizeof(Rgb32f) * image.width()));
  };
  insert(color ? "R" : ChannelToRead(channels, {}), &first->r);
  if (color) insert("G", &first->g), insert("B", &first->b);
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  if (!color) {
    for (Rgb32f& pixel : image.pixels()) pixel.g = pixel.b = pixel.r;
  }
  return image;
}

}  // namespace

Image<Rgb32f> DecodeExrRgb(std::span<const std::byte> bytes, std::string_view name) {
  try {
    return ReadExrRgb(bytes);
  } catch (const std::exception& error) {
    internal::ThrowDamaged(name, error.what());
  }
}

std::vector<std::string> ExrChannels(std::span<const std::byte> bytes, std::string_view name) {
  try {
    CheckHeader(bytes, true);
    MemoryReader reader(bytes);
    const Imf::InputFile file(reader, 0);
    std::vector<std::string> names;
    const Imf::ChannelList& channels = file.header().channels();
    for (auto c = channels.begin(); c != channels.end(); ++c) names.emplace_back(c.name());
    return names;
  } catch (const std::exception& error) {
    internal::ThrowDamaged(name, error.what());
  }
}

Image<float> DecodeExrChannel(std::span<const std::byte> bytes, std::string_view name, std::string_view channel) {
  // OpenEXR reports everything by exceptions derived from std::exception.
  try {
    return ReadExr(bytes, channel);
  } catch (const std::exception& error) {
    internal::ThrowDamaged(name, error.what());
  }
}

Image<float> DecodeExr(std::span<const std::byte> bytes, std::string_view name) { return DecodeExrChannel(bytes, name, {}); }

}  // namespace airsim360

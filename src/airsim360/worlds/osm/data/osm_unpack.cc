#include "airsim360/worlds/osm/data/osm_unpack.h"

#include <bzlib.h>
#include <zlib.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace airsim360::internal {
namespace {

constexpr std::string_view kGzip("\x1f\x8b\x08", 3);
constexpr std::string_view kBzip2 = "BZh", kBlock = "1AY&SY";
constexpr size_t kGzipHeader = 10, kBzip2Header = 10;
constexpr size_t kPiece = size_t{1} << 20;

// Does a part begin at `at`? The reserved flags, the level and the system of gzip's header rule out other bytes.
bool BeginsGzip(std::string_view text, size_t at) {
  if (text.size() - at < kGzipHeader || text.substr(at, kGzip.size()) != kGzip) return false;
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[at + i]); };
  const bool level = byte(8) == 0 || byte(8) == 2 || byte(8) == 4, system = byte(9) <= 13 || byte(9) == 255;
  return (byte(3) & 0xe0) == 0 && level && system;
}

bool BeginsBzip2(std::string_view text, size_t at) {
  return text.size() - at >= kBzip2Header && text.substr(at, kBzip2.size()) == kBzip2 && text.substr(at + 4, kBlock.size()) == kBlock;
}

void Append(std::string& out, const std::vector<char>& piece, size_t size, uint64_t limit) {
  if (out.size() + size > limit) throw std::runtime_error("it unpacks to more than " + std::to_string(limit >> 20) + " MiB");
  out.append(piece.data(), size);
}

std::string UnpackGzip(std::string_view text, uint64_t limit) {
  std::string out;
  std::vector<char> piece(kPiece);
  z_stream stream{};
  constexpr int kGzipOnly = 15 + 16;
  if (inflateInit2(&stream, kGzipOnly) != Z_OK) throw std::runtime_error("gzip error");
  size_t at = 0;
  int state = Z_STREAM_END;
  try {
    while (at < text.size()) {
      if (state == Z_STREAM_END && inflateReset(&stream) != Z_OK) throw std::runtime_error("gzip error");
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data() + at));
      stream.avail_in = static_cast<uInt>(std::min<size_t>(text.size() - at, kPiece));
      const uInt given = stream.avail_in;
      stream.next_out = reinterpret_cast<Bytef*>(piece.data());
      stream.avail_out = static_cast<uInt>(piece.size());
      state = inflate(&stream, Z_NO_FLUSH);
      if (state != Z_OK && state != Z_STREAM_END)
        throw std::runtime_error(std::string("gzip error: ") + (stream.msg ? stream.msg : "cut off"));
      at += given - stream.avail_in;
      Append(out, piece, piece.size() - stream.avail_out, limit);
    }
    if (state != Z_STREAM_END) throw std::runtime_error("gzip error: cut off");
  } catch (...) {
    inflateEnd(&stream);
    throw;
  }
  inflateEnd(&stream);
  return out;
}

std::string UnpackBzip2(std::string_view text, uint64_t limit) {
  std::string out;
  std::vector<char> piece(kPiece);
  for (size_t at = 0; at < text.size();) {
    bz_stream stream{};
    if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::runtime_error("bzip2 error");
    int state = BZ_OK;
    try {
      while (state != BZ_STREAM_END) {
        stream.next_in = const_cast<char*>(text.data() + at);
        stream.avail_in = static_cast<unsigned>(std::min<size_t>(text.size() - at, kPiece));
        const unsigned given = stream.avail_in;
        stream.next_out = piece.data();
        stream.avail_out = static_cast<unsigned>(piece.size());
        state = BZ2_bzDecompress(&stream);
        if (state != BZ_OK && state != BZ_STREAM_END) throw std::runtime_error("bzip2 error: damaged");
        at += given - stream.avail_in;
        const size_t written = piece.size() - stream.avail_out;
        if (given == 0 && written == 0 && state == BZ_OK) throw std::runtime_error("bzip2 error: cut off");
        Append(out, piece, written, limit);
      }
    } catch (...) {
      BZ2_bzDecompressEnd(&stream);
      throw;
    }
    BZ2_bzDecompressEnd(&stream);
  }
  return out;
}

// Does a part begin anywhere behind the first?
template <class Begins>
bool HasSecond(std::string_view text, std::string_view magic, Begins begins) {
  for (size_t at = text.find(magic, 1); at != std::string_view::npos; at = text.find(magic, at + 1))
    if (begins(text, at)) return true;
  return false;
}

}  // namespace

std::optional<std::string> UnpackParts(std::span<const std::byte> bytes, uint64_t limit) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (BeginsGzip(text, 0) && HasSecond(text, kGzip, BeginsGzip)) return UnpackGzip(text, limit);
  if (BeginsBzip2(text, 0) && HasSecond(text, kBzip2, BeginsBzip2)) return UnpackBzip2(text, limit);
  return std::nullopt;
}

}  // namespace airsim360::internal

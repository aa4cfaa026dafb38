#include "airsim360/video/spherical_mp4.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <map>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/write_all.h"
#include "airsim360/video/mp4_boxes.h"

namespace airsim360::internal {
namespace {

constexpr size_t kMostMovieBytes = size_t{1} << 30;

Mp4Box& Need(Mp4Box& parent, const char* type) {
  if (Mp4Box* child = parent.Find(type)) return *child;
  throw RuntimeError(std::string("MP4: no ") + type + " in " + parent.type);
}

// Where numbers stand in a box of version 0 and 1, and how wide they are.
struct Field {
  size_t at0, at1;
  int size0, size1;
};
constexpr Field kMovieScale{12, 20, 4, 4}, kMovieDuration{16, 24, 4, 8}, kTrackDuration{20, 28, 4, 8};

void SetDuration(Mp4Box& box, const Field& field, uint64_t value) {
  const bool wide = GetNumber(box.head, 0, 1) == 1;
  if (!wide && value > UINT32_MAX) throw RuntimeError("MP4: a video of " + std::to_string(value) + " ticks is too long");
  SetNumber(box.head, wide ? field.at1 : field.at0, wide ? field.size1 : field.size0, value);
}

uint32_t Timescale(const Mp4Box& box) {
  const bool wide = GetNumber(box.head, 0, 1) == 1;
  const auto scale = static_cast<uint32_t>(GetNumber(box.head, wide ? kMovieScale.at1 : kMovieScale.at0, 4));
  if (scale == 0) throw RuntimeError("MP4: a clock of 0 Hz");
  return scale;
}

// st3d: monoscopic. sv3d: equirectangular, the whole sphere, the middle of the picture ahead.
void AddSphere(Mp4Box& sample_entry) {
  std::erase_if(sample_entry.children, [](const Mp4Box& b) { return b.type == "st3d" || b.type == "sv3d"; });
  Mp4Box stereo{"st3d", Bytes(5), {}};
  Mp4Box header{"svhd", Bytes(4), {}}, pose{"prhd", Bytes(16), {}}, bounds{"equi", Bytes(20), {}};
  for (const char c : std::string_view("AirSim360\0", 10)) AppendNumber(header.head, 1, static_cast<uint64_t>(c));
  Mp4Box projection{"proj", {}, {std::move(pose), std::move(bounds)}};
  sample_entry.children.push_back(std::move(stereo));
  sample_entry.children.push_back({"sv3d", {}, {std::move(header), std::move(projection)}});
}

// The same in words, as V1 wants it.
Mp4Box SphereInXml() {
  constexpr uint8_t kUuid[16] = {0xff, 0xcc, 0x82, 0x63, 0xf8, 0x55, 0x4a, 0x93, 0x88, 0x14, 0x58, 0x7a, 0x02, 0x52, 0x1f, 0xdd};
  constexpr std::string_view kXml =
      "<?xml version=\"1.0\"?><rdf:SphericalVideo xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\" "
      "xmlns:GSpherical=\"http://ns.google.com/videos/1.0/spherical/\"><GSpherical:Spherical>true</GSpherical:Spherical>"
      "<GSpherical:Stitched>true</GSpherical:Stitched><GSpherical:StitchingSoftware>AirSim360</GSpherical:StitchingSoftware>"
      "<GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType></rdf:SphericalVideo>";
  Mp4Box box{"uuid", {}, {}};
  for (const uint8_t byte : kUuid) AppendNumber(box.head, 1, byte);
  const auto xml = AsBytes(kXml);
  box.head.insert(box.head.end(), xml.begin(), xml.end());
  return box;
}

// stts: runs of pictures that are shown equally long.
Bytes DurationTable(std::span<const uint64_t> ticks) {
  Bytes table(8);
  uint64_t runs = 0;
  for (size_t i = 0, begin = 0; i + 1 < ticks.size(); ++i) {
    const uint64_t duration = ticks[i + 1] - ticks[i];
    if (i + 2 < ticks.size() && ticks[i + 2] - ticks[i + 1] == duration) continue;
    AppendNumber(table, 4, i + 1 - begin);
    AppendNumber(table, 4, duration);
    begin = i + 1;
    ++runs;
  }
  SetNumber(table, 4, 4, runs);
  return table;
}

void ShiftOffsets(Mp4Box& samples, int64_t shift) {
  for (const auto& [type, size] : {std::pair{"stco", 4}, std::pair{"co64", 8}}) {
    Mp4Box* const table = samples.Find(type);
    if (table == nullptr) continue;
    const uint64_t count = GetNumber(table->head, 4, 4);
    for (uint64_t i = 0; i < count; ++i) {
      const size_t at = 8 + static_cast<size_t>(i) * static_cast<size_t>(size);
      const uint64_t to = GetNumber(table->head, at, size) + static_cast<uint64_t>(shift);
      if (size == 4 && to > UINT32_MAX) throw RuntimeError("MP4: offsets beyond 4 GiB in a table of 32 bits");
      SetNumber(table->head, at, size, to);
    }
  }
}

// Where the boxes of a whole file stand.
struct Extent {
  uint64_t begin, size;
};
std::map<std::string, Extent> TopLevel(int file, uint64_t end) {
  std::map<std::string, Extent> extents;
  for (uint64_t at = 0; at < end;) {
    Bytes head(16);
    const ssize_t got = ::pread(file, head.data(), head.size(), static_cast<off_t>(at));
    if (got < 8) throw RuntimeError("MP4: cannot read what ffmpeg wrote");
    uint64_t size = GetNumber(head, 0, 4);
    if (size == 1) size = GetNumber(head, 8, 8);
    if (size == 0) size = end - at;
    if (size < 8 || size > end - at) throw RuntimeError("MP4: ffmpeg did not finish the file");
    extents[std::string(AsText(std::span(head).subspan(4, 4)))] = {at, size};
    at += size;
  }
  for (const char* type : {"ftyp", "mdat", "moov"}) {
    if (!extents.contains(type)) throw RuntimeError(std::string("MP4: ffmpeg wrote no ") + type);
  }
  return extents;
}

void MustWriteAll(int to, std::span<const std::byte> bytes) {
  if (const int error = WriteAll(to, bytes); error != 0) throw RuntimeError(std::strerror(error));
}

Bytes ReadExtent(int file, const Extent& extent) {
  if (extent.size > kMostMovieBytes) throw RuntimeError("MP4: tables of " + std::to_string(extent.size) + " bytes");
  Bytes bytes(extent.size);
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t n = ::pread(file, bytes.data() + done, bytes.size() - done, static_cast<off_t>(extent.begin + done));
    if (n <= 0) throw RuntimeError("MP4: cannot read what ffmpeg wrote");
    done += static_cast<size_t>(n);
  }
  return bytes;
}

void Copy(int from, const Extent& extent, int to) {
  constexpr uint64_t kPiece = uint64_t{4} << 20;
  for (uint64_t done = 0; done < extent.size; done += kPiece)
    MustWriteAll(to, ReadExtent(from, {extent.begin + done, std::min(kPiece, extent.size - done)}));
}

}  // namespace

std::vector<uint64_t> TicksOf(std::span<const int64_t> times_ns, uint32_t timescale, int64_t lone_ns) {
  std::vector<uint64_t> ticks;
  const auto tick = [&](int64_t ns) { return static_cast<uint64_t>(std::llround(static_cast<double>(ns) * timescale / 1e9)); };
  for (const int64_t t : times_ns) ticks.push_back(tick(t - times_ns.front()));
  const size_t n = times_ns.size();
  ticks.push_back(ticks.back() + (n > 1 ? ticks[n - 1] - ticks[n - 2] : std::max<uint64_t>(tick(lone_ns), 1)));
  return ticks;
}

Bytes EditMovie(std::span<const std::byte> moov, bool spherical, std::span<const int64_t> times_ns, int64_t lone_ns, int64_t shift) {
  std::vector<Mp4Box> boxes = ParseBoxes(moov);
  if (boxes.size() != 1 || boxes[0].type != "moov") throw RuntimeError("MP4: no movie");
  Mp4Box& movie = boxes[0];
  Mp4Box& track = Need(movie, "trak");
  Mp4Box& media = Need(track, "mdia");
  Mp4Box& samples = Need(Need(media, "minf"), "stbl");
  const uint64_t pictures = GetNumber(Need(samples, "stsz").head, 8, 4);
  if (pictures != times_ns.size())
    throw RuntimeError("ffmpeg wrote " + std::to_string(pictures) + " of " + std::to_string(times_ns.size()) + " pictures");
  if (samples.Find("ctts") != nullptr) throw RuntimeError("MP4: the encoder changed the order of pictures");

  // Times: every picture begins when the simulation took it.
  Mp4Box &movie_header = Need(movie, "mvhd"), &media_header = Need(media, "mdhd");
  const uint32_t scale = Timescale(media_header), movie_scale = Timescale(movie_header);
  const std::vector<uint64_t> ticks = TicksOf(times_ns, scale, lone_ns);
  Need(samples, "stts").head = DurationTable(ticks);
  const auto in_movie = static_cast<uint64_t>(std::llround(static_cast<double>(ticks.back()) * movie_scale / scale));
  SetDuration(media_header, kMovieDuration, ticks.back());
  SetDuration(movie_header, kMovieDuration, in_movie);
  SetDuration(Need(track, "tkhd"), kTrackDuration, in_movie);
  if (Mp4Box* edits = track.Find("edts")) SetDuration(Need(*edits, "elst"), {8, 8, 4, 8}, in_movie);

  ShiftOffsets(samples, shift);
  if (spherical) {
    Mp4Box& descriptions = Need(samples, "stsd");
    if (descriptions.children.empty()) throw RuntimeError("MP4: no sample entry");
    AddSphere(descriptions.children.front());
    track.children.push_back(SphereInXml());
  }
  Bytes edited;
  AppendBox(movie, edited);
  return edited;
}

void WriteMovie(int file, bool spherical, std::span<const int64_t> times_ns, int64_t lone_ns, const std::filesystem::path& path) {
  const off_t end = ::lseek(file, 0, SEEK_END);
  const auto extents = TopLevel(file, static_cast<uint64_t>(std::max<off_t>(end, 0)));
  const Extent type = extents.at("ftyp"), media = extents.at("mdat");
  const Bytes moov = ReadExtent(file, extents.at("moov"));
  // The size of the box does not depend on the offsets in it.
  const auto begin = static_cast<int64_t>(type.size + EditMovie(moov, spherical, times_ns, lone_ns, 0).size());
  const Bytes edited = EditMovie(moov, spherical, times_ns, lone_ns, begin - static_cast<int64_t>(media.begin));

  std::filesystem::path temporary = path;
  temporary += ".tmp";
  const int to = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (to < 0) ThrowWriteError(path, errno);
  try {
    MustWriteAll(to, ReadExtent(file, type));
    MustWriteAll(to, edited);
    Copy(file, media, to);
    if (::fsync(to) != 0 || ::rename(temporary.c_str(), path.c_str()) != 0) throw RuntimeError(std::strerror(errno));
  } catch (const RuntimeError& error) {
    ::close(to);
    ::unlink(temporary.c_str());
    throw RuntimeError(path.string() + ": cannot write: " + error.what());
  }
  ::close(to);
}

}  // namespace airsim360::internal

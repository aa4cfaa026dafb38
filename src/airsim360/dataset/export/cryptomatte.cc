// Cryptomatte 1.2 (Friedman and Jones, SIGGRAPH 2015 talks): ids as hashes of names in float channels, with coverage.
#include <cstdio>
#include <cstring>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/dataset/export/export_job.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/exr_metadata.h"

namespace airsim360::internal {
namespace {

constexpr char kLayer[] = "CryptoObject";
constexpr int kRanks = 4;  // entities of a pixel, two to a layer of RGBA

// MurmurHash3_x86_32 with seed 0 (A. Appleby, public domain).
uint32_t Murmur3(const std::string& text) {
  const auto rotate = [](uint32_t v, int by) { return v << by | v >> (32 - by); };
  const auto mix = [&](uint32_t k) { return rotate(k * 0xcc9e2d51u, 15) * 0x1b873593u; };
  uint32_t h = 0;
  const size_t blocks = text.size() / 4;
  for (size_t i = 0; i < blocks; ++i) {
    uint32_t k = 0;
    std::memcpy(&k, text.data() + 4 * i, 4);
    h = rotate(h ^ mix(k), 13) * 5 + 0xe6546b64u;
  }
  uint32_t tail = 0;
  for (size_t i = text.size(); i-- > 4 * blocks;) tail = tail << 8 | static_cast<unsigned char>(text[i]);
  h ^= mix(tail);
  h ^= static_cast<uint32_t>(text.size());
  h = (h ^ h >> 16) * 0x85ebca6bu;
  h = (h ^ h >> 13) * 0xc2b2ae35u;
  return h ^ h >> 16;
}

// The bits as a float that is neither denormal nor infinite: an exponent of 0 or 255 has its lowest bit flipped.
uint32_t IdBits(const std::string& name) {
  uint32_t bits = Murmur3(name);
  const uint32_t exponent = bits >> 23 & 255;
  if (exponent == 0 || exponent == 255) bits ^= 1u << 23;
  return bits;
}

std::string Hex(uint32_t bits) {
  char text[16];
  std::snprintf(text, sizeof text, "%08x", bits);
  return text;
}

struct Manifest {
  std::string json;
  std::map<EntityId, float> id_of;
};

// Names of all entities of the dataset; a name that several have gets the entity's number behind it.
Manifest ReadManifest(const ExportJob& job) {
  const Json entities = Json::parse(ReadTextFile(job.data.folder() / "entities.json"), nullptr, false);
  if (!entities.is_object()) throw InputError((job.data.folder() / "entities.json").string() + ": damaged");
  std::map<std::string, int> uses;
  for (const auto& [id, entity] : entities.items()) ++uses[entity.at("name").get<std::string>()];
  Manifest manifest;
  Json names = Json::object();
  for (const auto& [id, entity] : entities.items()) {
    std::string name = entity.at("name");
    if (uses[name] > 1) name += "#" + id;
    const uint32_t bits = IdBits(name);
    names[name] = Hex(bits);
    float value = 0;
    std::memcpy(&value, &bits, 4);
    manifest.id_of[static_cast<EntityId>(std::stoul(id))] = value;
  }
  manifest.json = Dump(names);
  return manifest;
}

Bytes Encode(const ExportJob& job, const NativeFrame& frame, const View& view, const Manifest& manifest) {
  const Bytes stored = job.data.Read(frame, view, "coverage");
  const std::string name = job.data.FileName(frame, view, "coverage");
  std::vector<Image<float>> ids, shares;
  for (int rank = 0; rank < kRanks; ++rank) {
    ids.push_back(DecodeExrChannel(stored, name, "id." + std::to_string(rank)));
    shares.push_back(DecodeExrChannel(stored, name, "share." + std::to_string(rank)));
  }
  const int width = ids[0].width(), height = ids[0].height();
  std::vector<float> pixels(ids[0].size() * 2 * kRanks);
  for (size_t i = 0; i < ids[0].size(); ++i) {
    for (size_t rank = 0; rank < kRanks; ++rank) {
      const auto entity = static_cast<EntityId>(ids[rank].pixels()[i]);
      const auto found = manifest.id_of.find(entity);
      if (found == manifest.id_of.end()) continue;
      pixels[2 * kRanks * i + 2 * rank] = found->second;
      pixels[2 * kRanks * i + 2 * rank + 1] = shares[rank].pixels()[i];
    }
  }
  constexpr const char* kChannels[] = {"CryptoObject00.R", "CryptoObject00.G", "CryptoObject00.B", "CryptoObject00.A",
                                       "CryptoObject01.R", "CryptoObject01.G", "CryptoObject01.B", "CryptoObject01.A"};
  const std::string key = std::string("cryptomatte/") + Hex(Murmur3(kLayer)).substr(0, 7) + "/";
  return EncodeExr(pixels, width, height, kChannels,
                   {{key + "name", kLayer},
                    {key + "hash", "MurmurHash3_32"},
                    {key + "conversion", "uint32_to_float32"},
                    {key + "manifest", manifest.json}});
}

}  // namespace

void ExportCryptomatte(ExportJob& job) {
  job.Need(job.data.Has("coverage"), "coverage of pixels", "--products coverage");
  const Manifest manifest = ReadManifest(job);
  job.EachFrame([&](const NativeFrame& frame) {
    for (const View& view : job.data.views())
      job.out.Write("cryptomatte/" + frame.stem + view.suffix + ".exr", Encode(job, frame, view, manifest));
  });
  job.notes["names"] = manifest.id_of.size();
}

}  // namespace airsim360::internal

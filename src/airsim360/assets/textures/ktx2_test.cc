#include "airsim360/assets/textures/ktx2.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "airsim360/assets/gltf/gltf_test_internal.h"
#include "airsim360/assets/test_text.h"
#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

// A writer of BasisLZ: every table gives all its symbols codes of one length, so that a code is its symbol.
class BitWriter {
 public:
  void Bits(uint32_t value, int count) {
    for (int k = 0; k < count; ++k) {
      if (used_ % 8 == 0) bytes_ += '\0';
      bytes_.back() = static_cast<char>(bytes_.back() | static_cast<char>((value >> k & 1) << (used_ % 8)));
      ++used_;
    }
  }
  // Codes go highest bit first.
  void Symbol(uint32_t symbol, int length) {
    for (int k = length - 1; k >= 0; --k) Bits(symbol >> k & 1, 1);
  }
  // 2^length symbols of this length. The code of lengths has this one length, of one bit.
  void Table(int length) {
    constexpr std::array<int, 21> kOrder = {17, 18, 19, 20, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15, 16};
    Bits(1u << length, 14);
    Bits(21, 5);
    for (int symbol : kOrder) Bits(symbol == length, 3);
    for (uint32_t i = 0; i < 1u << length; ++i) Bits(0, 1);
  }
  void Chunks(uint32_t value, int chunk) {
    for (; value >> chunk != 0; value >>= chunk) Bits((value & ((1u << chunk) - 1)) | 1u << chunk, chunk + 1);
    Bits(value, chunk + 1);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  size_t used_ = 0;
};

constexpr uint32_t kHistory = 8, kPredictionBits = 9, kDeltaBits = 5, kSelectorBits = 6, kRunBits = 6;

struct Endpoint {
  std::array<uint32_t, 3> color5;
  uint32_t intensity;
};
using Selector = std::array<uint8_t, 16>;  // tone of each pixel

// Pixels by the text of the ETC1 format.
int Channel(const Endpoint& e, int tone, size_t c) {
  constexpr int kSmall[] = {2, 5, 9, 13, 18, 24, 33, 47}, kLarge[] = {8, 17, 29, 42, 60, 80, 106, 183};
  const int distance = tone == 0 || tone == 3 ? kLarge[e.intensity] : kSmall[e.intensity];
  const int base = static_cast<int>(e.color5[c] * 8 + e.color5[c] / 4);
  return std::clamp(base + (tone < 2 ? -distance : distance), 0, 255);
}

struct Picture {
  int width = 0, height = 0;
  std::vector<Endpoint> endpoints;
  std::vector<Selector> selectors;
  std::vector<uint32_t> endpoint_of, selector_of;  // of blocks
  int columns() const { return (width + 3) / 4; }
  int rows() const { return (height + 3) / 4; }
  int At(int x, int y, size_t c) const {
    const auto block = static_cast<size_t>(y / 4 * columns() + x / 4);
    return Channel(endpoints[endpoint_of[block]], selectors[selector_of[block]][static_cast<size_t>(y % 4 * 4 + x % 4)], c);
  }
};

Picture MakePicture(int width, int height, std::mt19937& random) {
  Picture p;
  p.width = width, p.height = height;
  const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
  for (int i = 0; i < 20; ++i) p.endpoints.push_back({{below(32), below(32), below(32)}, below(8)});
  for (int i = 0; i < 24; ++i) {
    Selector s{};
    for (uint8_t& tone : s) tone = static_cast<uint8_t>(below(4));
    p.selectors.push_back(s);
  }
  // Long runs of the same, and jumps.
  uint32_t e = 0, s = 0;
  for (int i = 0; i < p.columns() * p.rows(); ++i) {
    if (below(4) == 0) e = below(20);
    if (below(9) == 0) s = below(24);
    p.endpoint_of.push_back(e);
    p.selector_of.push_back(s);
  }
  return p;
}

// One of the ways to say where each block's endpoint comes from.
std::vector<uint32_t> Predictions(const Picture& p, std::mt19937& random) {
  std::vector<uint32_t> out;
  for (int y = 0; y < p.rows(); ++y) {
    for (int x = 0; x < p.columns(); ++x) {
      const auto at = [&](int dx, int dy) { return p.endpoint_of[static_cast<size_t>((y - dy) * p.columns() + x - dx)]; };
      std::vector<uint32_t> ways = {3};
      if (x > 0 && at(1, 0) == at(0, 0)) ways.push_back(0);
      if (y > 0 && at(0, 1) == at(0, 0)) ways.push_back(1);
      if (x > 0 && y > 0 && at(1, 1) == at(0, 0)) ways.push_back(2);
      out.push_back(ways[random() % 8 == 0 ? random() % ways.size() : ways.size() - 1]);
    }
  }
  return out;
}

std::string Slice(const Picture& p, std::mt19937& random) {
  BitWriter bits;
  const std::vector<uint32_t> ways = Predictions(p, random);
  std::vector<uint32_t> symbols;  // of two by two blocks
  for (int y = 0; y < p.rows(); y += 2) {
    for (int x = 0; x < p.columns(); x += 2) {
      uint32_t symbol = 0;
      for (int k = 0; k < 4; ++k) {
        const int i = x + k % 2, j = y + k / 2;
        if (i < p.columns() && j < p.rows()) symbol |= ways[static_cast<size_t>(j * p.columns() + i)] << (2 * k);
      }
      symbols.push_back(symbol);
    }
  }
  std::array<uint32_t, kHistory> history{};
  uint32_t endpoint = 0, rover = kHistory / 2, last_symbol = 0, repeats = 0, run = 0;
  size_t quad = 0;
  const auto blocks = p.selector_of.size();
  for (size_t block = 0; block < blocks; ++block) {
    const size_t x = block % static_cast<size_t>(p.columns()), y = block / static_cast<size_t>(p.columns());
    if (x % 2 == 0 && y % 2 == 0) {
      if (repeats > 0) {
        --repeats;
      } else {
        uint32_t same = 0;
        while (quad + same < symbols.size() && symbols[quad + same] == last_symbol) ++same;
        if (same >= 3) {
          bits.Symbol(256, kPredictionBits);
          bits.Chunks(same - 3, 4);
          repeats = same - 1;
        } else {
          bits.Symbol(last_symbol = symbols[quad], kPredictionBits);
        }
      }
      ++quad;
    }
    if (ways[block] == 3) {
      const auto count = static_cast<uint32_t>(p.endpoints.size());
      bits.Symbol((p.endpoint_of[block] + count - endpoint) % count, kDeltaBits);
    }
    endpoint = p.endpoint_of[block];
    if (run > 0) {
      --run;
      continue;
    }
    const uint32_t wanted = p.selector_of[block], count = static_cast<uint32_t>(p.selectors.size());
    uint32_t same = 0;
    while (block + same < blocks && p.selector_of[block + same] == history[0]) ++same;
    const auto place = static_cast<uint32_t>(std::find(history.begin(), history.end(), wanted) - history.begin());
    if (same >= 3) {
      bits.Symbol(count + kHistory, kSelectorBits);
      bits.Symbol(same - 3 < 63 ? same - 3 : 63, kRunBits);
      if (same - 3 >= 63) bits.Chunks(same - 3, 7);
      run = same - 1;
    } else if (place < kHistory && random() % 3 != 0) {
      bits.Symbol(count + place, kSelectorBits);
      std::swap(history[place / 2], history[place]);
    } else {
      bits.Symbol(wanted, kSelectorBits);
      history[rover] = wanted;
      if (++rover == kHistory) rover = kHistory / 2;
    }
  }
  return bits.bytes();
}

std::string Number(uint64_t value, int size) {
  std::string out;
  for (int k = 0; k < size; ++k) out += static_cast<char>(value >> (8 * k));
  return out;
}

std::string Codebooks(const Picture& p, std::string& selectors, std::string& tables) {
  BitWriter e, s, t;
  for (int k = 0; k < 3; ++k) e.Table(5);
  e.Table(3);
  e.Bits(0, 1);
  Endpoint last{{16, 16, 16}, 0};
  for (const Endpoint& endpoint : p.endpoints) {
    e.Symbol((endpoint.intensity - last.intensity) & 7, 3);
    for (size_t c = 0; c < 3; ++c) e.Symbol((endpoint.color5[c] - last.color5[c]) & 31, 5);
    last = endpoint;
  }
  s.Bits(0, 3);
  s.Table(8);
  std::array<uint32_t, 4> before{};
  for (size_t i = 0; i < p.selectors.size(); ++i) {
    for (size_t row = 0; row < 4; ++row) {
      uint32_t byte = 0;
      for (size_t k = 0; k < 4; ++k) byte |= static_cast<uint32_t>(p.selectors[i][row * 4 + k]) << (2 * k);
      if (i == 0)
        s.Bits(byte, 8);
      else
        s.Symbol(byte ^ before[row], 8);
      before[row] = byte;
    }
  }
  t.Table(kPredictionBits);
  t.Table(kDeltaBits);
  t.Table(kSelectorBits);
  t.Table(kRunBits);
  t.Bits(kHistory, 13);
  selectors = s.bytes();
  tables = t.bytes();
  return e.bytes();
}

// The container: header, level index, format descriptor with two samples, global data, level.
std::string Ktx2(const Picture& p, const std::string& color, const std::string& second, uint32_t channel) {
  std::string selectors, tables;
  const std::string endpoints = Codebooks(p, selectors, tables);
  std::string descriptor = Number(60, 4) + Number(0, 4) + Number(56u << 16 | 2, 4) + Number(163, 1) + std::string(15, '\0');
  for (uint32_t k : {0u, channel}) descriptor += Number(0, 3) + Number(k, 1) + std::string(12, '\0');
  std::string global = Number(p.endpoints.size(), 2) + Number(p.selectors.size(), 2) + Number(endpoints.size(), 4) +
                       Number(selectors.size(), 4) + Number(tables.size(), 4) + Number(0, 4) + Number(0, 4) + Number(0, 4) +
                       Number(color.size(), 4) + Number(color.size(), 4) + Number(second.size(), 4) + endpoints + selectors + tables;
  const uint64_t at = 104, sgd = at + descriptor.size(), level = sgd + global.size();
  std::string out("\xabKTX 20\xbb\r\n\x1a\n", 12);
  for (uint32_t v : {0u, 1u, static_cast<uint32_t>(p.width), static_cast<uint32_t>(p.height), 0u, 0u, 1u, 1u, 1u}) out += Number(v, 4);
  out += Number(at, 4) + Number(descriptor.size(), 4) + Number(0, 8) + Number(sgd, 8) + Number(global.size(), 8);
  out += Number(level, 8) + Number(color.size() + second.size(), 8) + Number(0, 8);
  return out + descriptor + global + color + second;
}

std::optional<Image<Rgba8>> Decode(const std::string& bytes, uint64_t most = 1 << 20) {
  std::string unread;
  return DecodeKtx2(AsBytes(bytes), "a.ktx2", most, unread);
}

TEST(Ktx2, Etc1sPicturesComeBackToTheLastPixel) {
  for (uint32_t seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const int width = 1 + static_cast<int>(random() % 90), height = 1 + static_cast<int>(random() % 70);
    Picture p = MakePicture(width, height, random);
    const std::string color = Slice(p, random);
    Picture alpha = p;
    std::reverse(alpha.selector_of.begin(), alpha.selector_of.end());
    const uint32_t channel = seed % 3 == 0 ? 4 : 15;
    const std::string second = seed % 3 == 2 ? "" : Slice(alpha, random);
    const auto image = Decode(Ktx2(p, color, second, channel));
    ASSERT_TRUE(image);
    ASSERT_EQ(image->width(), width);
    ASSERT_EQ(image->height(), height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Rgba8 got = (*image)(x, y);
        ASSERT_EQ(got.r, p.At(x, y, 0)) << seed << ": " << x << ", " << y;
        ASSERT_EQ(got.g, seed % 3 == 0 ? alpha.At(x, y, 0) : p.At(x, y, 1)) << seed;
        ASSERT_EQ(got.b, p.At(x, y, 2)) << seed;
        ASSERT_EQ(got.a, seed % 3 == 1 ? alpha.At(x, y, 1) : 255) << seed;
      }
    }
  }
}

TEST(Ktx2, DamageIsAnErrorOrAPictureNeverACrash) {
  std::mt19937 random(7);
  const Picture p = MakePicture(40, 24, random);
  const std::string whole = Ktx2(p, Slice(p, random), "", 15);
  ASSERT_TRUE(Decode(whole));
  for (size_t size = 12; size + 16 < whole.size(); ++size) EXPECT_THROW(Decode(whole.substr(0, size)), InputError) << size;
  for (int i = 0; i < 20000; ++i) {
    std::string bad = whole;
    for (int k = 0; k <= i % 3; ++k) bad[12 + random() % (bad.size() - 12)] = static_cast<char>(random());
    try {
      Decode(bad);
    } catch (const InputError&) {
    }
  }
  EXPECT_THROW(Decode(whole, 40 * 24 - 1), InputError);
}

TEST(Ktx2, WhatIsNotReadIsNamed) {
  std::mt19937 random(3);
  const Picture p = MakePicture(8, 8, random);
  std::string bytes = Ktx2(p, Slice(p, random), "", 15), unread;
  bytes[104 + 12] = static_cast<char>(166);
  EXPECT_FALSE(DecodeKtx2(AsBytes(bytes), "a.ktx2", 1 << 20, unread));
  EXPECT_TRUE(Contains(unread, {"UASTC"}));
}

TEST(Ktx2, GltfTexturesInKtx2AreRead) {
  std::mt19937 random(5);
  const Picture p = MakePicture(16, 8, random);
  const std::string ktx = Ktx2(p, Slice(p, random), "", 15);
  GltfDocument doc = GltfDocument::Triangle();
  const size_t view = doc.AddView(std::vector<char>(ktx.begin(), ktx.end()));
  doc.json["extensionsRequired"] = {"KHR_texture_basisu"};
  doc.json["images"] = {{{"bufferView", view}, {"mimeType", "image/ktx2"}}};
  doc.json["textures"] = nlohmann::json::array({{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}});
  doc.json["materials"] = nlohmann::json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
  doc.json["meshes"][0]["primitives"][0]["material"] = 0;
  const ImportedFile file = ReadText(doc.Text());
  EXPECT_TRUE(file.warnings.empty());
  ASSERT_EQ(file.textures.size(), 1u);
  EXPECT_EQ(file.textures[0].levels[0](9, 5).r, p.At(9, 5, 0));
}

}  // namespace
}  // namespace airsim360::internal

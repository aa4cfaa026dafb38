#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "airsim360/rpc/wire/airsim_image_types.h"
#include "airsim360/rpc/wire/message.h"
#include "airsim360/rpc/wire/wire_convert.h"
#include "airsim360/rpc/wire/wire_value.h"

namespace airsim360 {
namespace {

std::span<const uint8_t> Span(const std::string& text) { return {reinterpret_cast<const uint8_t*>(text.data()), text.size()}; }
std::string Hex(std::initializer_list<int> bytes) {
  std::string text;
  for (int byte : bytes) text.push_back(static_cast<char>(byte));
  return text;
}

// Bytes worked out by hand from the specification.
TEST(Wire, ReadsEveryFormOfTheSpecification) {
  using Kind = WireValue::Kind;
  const auto decode = [](std::initializer_list<int> bytes) {
    static std::string kept;
    kept = Hex(bytes);
    return DecodeWire(Span(kept));
  };
  EXPECT_EQ(decode({0xc0}).kind, Kind::kNil);
  EXPECT_TRUE(decode({0xc3}).flag);
  EXPECT_EQ(decode({0x7f}).integer, 127);
  EXPECT_EQ(decode({0xe0}).integer, -32);
  EXPECT_EQ(decode({0xff}).integer, -1);
  EXPECT_EQ(decode({0xcc, 0xff}).integer, 255);
  EXPECT_EQ(decode({0xcd, 0x01, 0x00}).integer, 256);
  EXPECT_EQ(decode({0xce, 0xff, 0xff, 0xff, 0xff}).integer, 4294967295);
  EXPECT_EQ(decode({0xcf, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff}).natural, UINT64_MAX);
  EXPECT_EQ(decode({0xd0, 0x80}).integer, -128);
  EXPECT_EQ(decode({0xd1, 0x80, 0x00}).integer, -32768);
  EXPECT_EQ(decode({0xd2, 0xff, 0xff, 0xff, 0xfe}).integer, -2);
  EXPECT_EQ(decode({0xd3, 0x80, 0, 0, 0, 0, 0, 0, 0}).integer, INT64_MIN);
  EXPECT_EQ(decode({0xca, 0x3f, 0x80, 0, 0}).real, 1.0);
  EXPECT_EQ(decode({0xcb, 0xc0, 0, 0, 0, 0, 0, 0, 0}).real, -2.0);
  EXPECT_EQ(decode({0xa2, 'h', 'i'}).text, "hi");
  EXPECT_EQ(decode({0xd9, 0x01, 'x'}).text, "x");
  EXPECT_EQ(decode({0xc4, 0x02, 0, 1}).kind, Kind::kBinary);
  EXPECT_EQ(decode({0xd4, 0x05, 0x07}).text, "\x07");
  EXPECT_EQ(decode({0x92, 0x01, 0x02}).items[1].integer, 2);
  EXPECT_EQ(decode({0x81, 0xa1, 'k', 0x09}).Find("k")->integer, 9);
}

TEST(Wire, WhatIsWrittenReadsBack) {
  WireWriter writer;
  const std::vector<int64_t> integers = {0,         127,      128, 255,  256,  65535,  65536,  4294967295, 4294967296,
                                         -1,        -32,      -33, -128, -129, -32768, -32769, INT32_MIN,  int64_t{INT32_MIN} - 1,
                                         INT64_MIN, INT64_MAX};
  ToWire(writer, std::vector<std::string>{std::string(31, 'a'), std::string(32, 'b'), std::string(256, 'c'), std::string(70000, 'd')});
  const std::string texts = writer.bytes();
  const WireValue text_value = DecodeWire(Span(texts));
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(text_value.items[i].text.size(), (std::vector<size_t>{31, 32, 256, 70000}[i]));
  for (const int64_t integer : integers) {
    WireWriter one;
    one.Int(integer);
    EXPECT_EQ(DecodeWire(Span(one.bytes())).integer, integer);
  }
  WireWriter floats;
  floats.Floats(std::vector<float>(70000, 1.5f));
  EXPECT_EQ(floats.bytes().size(), 5 + 5 * 70000u);
  EXPECT_EQ(DecodeWire(Span(floats.bytes())).items[69999].real, 1.5);
}

TEST(Wire, ScannerFindsTheEndHoweverTheBytesArrive) {
  WireWriter writer;
  airsim::Pose pose;
  ToWire(writer, std::vector<airsim::Pose>(20, pose));
  const std::string message = writer.bytes(), stream = message + message + Hex({0x93, 0x01});
  for (size_t step : {size_t{1}, size_t{7}, stream.size()}) {
    WireScanner scanner;
    size_t start = 0, found = 0;
    for (size_t have = 0; have < stream.size();) {
      have = std::min(stream.size(), have + step);
      while (const auto length = scanner.Scan(Span(stream).subspan(start, have - start))) {
        EXPECT_EQ(*length, message.size());
        start += *length;
        ++found;
      }
    }
    EXPECT_EQ(found, 2u);
  }
}

TEST(Wire, LimitsAreKept) {
  const WireLimits limits{.bytes = 100, .values = 10, .depth = 3};
  const auto refuses = [&](const std::string& bytes) {
    WireScanner scanner(limits);
    EXPECT_THROW(scanner.Scan(Span(bytes)), WireError) << bytes.size();
    EXPECT_THROW(DecodeWire(Span(bytes), limits), WireError);
  };
  refuses(Hex({0x91, 0x91, 0x91, 0x91, 0xc0}));             // depth
  refuses(Hex({0xdd, 0xff, 0xff, 0xff, 0xff}));             // an array of 2^32 - 1
  refuses(Hex({0x9b, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));  // values
  refuses(Hex({0xc6, 0x7f, 0xff, 0xff, 0xff}));             // a binary of 2 GiB
  refuses(Hex({0xc1}));
  refuses(Hex({0xdf, 0x7f, 0xff, 0xff, 0xff, 0xc0}));
  // A promise of many values costs no memory.
  const std::string promise = Hex({0xdd, 0x00, 0x0f, 0xff, 0xff, 0xc0});
  EXPECT_THROW(DecodeWire(Span(promise)), WireError);
}

TEST(Wire, StructsTakeWhatIsThereAndRefuseWrongTypes) {
  WireWriter writer;
  writer.MapHeader(3);
  writer.String("x_val"), writer.Int(3);
  writer.String("unknown"), writer.MapHeader(0);
  writer.String("z_val"), writer.Double(2.5);
  airsim::Vector3r v{1, 7, 1};
  FromWire(DecodeWire(Span(writer.bytes())), v);
  EXPECT_EQ(v.x_val, 3);
  EXPECT_EQ(v.y_val, 7);
  EXPECT_EQ(v.z_val, 2.5f);

  const std::string number = Hex({0x05}), text = Hex({0xa1, 'x'}), half = Hex({0xca, 0x3f, 0, 0, 0}), negative = Hex({0xff});
  bool flag = false;
  uint32_t count = 0;
  std::string word;
  float real = 0;
  EXPECT_THROW(FromWire(DecodeWire(Span(number)), flag), BadArgument);
  EXPECT_THROW(FromWire(DecodeWire(Span(number)), word), BadArgument);
  EXPECT_THROW(FromWire(DecodeWire(Span(number)), v), BadArgument);
  EXPECT_THROW(FromWire(DecodeWire(Span(text)), real), BadArgument);
  EXPECT_THROW(FromWire(DecodeWire(Span(half)), count), BadArgument);
  EXPECT_THROW(FromWire(DecodeWire(Span(negative)), count), BadArgument);
}

TEST(Wire, MessagesAreRequestsOrNotifications) {
  const std::string request = Hex({0x94, 0x00, 0x05, 0xa4, 'p', 'i', 'n', 'g', 0x90});
  const WireValue value = DecodeWire(Span(request));
  const RpcMessage message = ParseMessage(value);
  EXPECT_EQ(message.id, 5u);
  EXPECT_EQ(message.method, "ping");
  EXPECT_TRUE(message.arguments->items.empty());
  const std::string notification = Hex({0x93, 0x02, 0xa1, 'x', 0x91, 0x01});
  const WireValue other = DecodeWire(Span(notification));
  EXPECT_FALSE(ParseMessage(other).id);
  for (const std::string& bad :
       {Hex({0xc0}), Hex({0x90}), Hex({0x94, 0x01, 0x05, 0xc0, 0xc0}), Hex({0x93, 0x00, 0x05, 0x90}),
        Hex({0x94, 0x00, 0xff, 0xa1, 'x', 0x90}), Hex({0x94, 0x00, 0x05, 0x01, 0x90}), Hex({0x94, 0x00, 0x05, 0xa1, 'x', 0x80})}) {
    const WireValue decoded = DecodeWire(Span(bad));
    EXPECT_THROW(ParseMessage(decoded), WireError);
  }
}

}  // namespace
}  // namespace airsim360

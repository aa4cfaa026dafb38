#include "airsim360/view/planes.h"

#include <cmath>
#include <cstring>

#include "airsim360/image/codecs.h"
#include "airsim360/image/color.h"

namespace airsim360 {
namespace {

constexpr int kQuality = 88;
constexpr size_t kAlignment = 4;

void Pad(std::string& bytes, char with) {
  while (bytes.size() % kAlignment) bytes += with;
}

template <class Pixel, class Value>
auto Mapped(const Image<Pixel>& image, const Value& value) {
  std::vector<std::decay_t<decltype(value(image.pixels()[0]))>> values(image.size());
  for (size_t i = 0; i < image.size(); ++i) values[i] = value(image.pixels()[i]);
  return values;
}

uint8_t NormalByte(float n) { return static_cast<uint8_t>(std::lround(127.5f * (n + 1))); }

}  // namespace

void PlaneMessage::Add(const std::string& product, const char* plane, const char* type, int width, int height, const void* data,
                       size_t bytes) {
  list_ += (list_.empty() ? "" : ",") + ("{\"product\":\"" + product + "\",\"plane\":\"" + plane + "\",\"type\":\"" + type + "\"") +
           ",\"width\":" + std::to_string(width) + ",\"height\":" + std::to_string(height) + ",\"at\":" + std::to_string(data_.size()) +
           ",\"bytes\":" + std::to_string(bytes) + "}";
  data_.append(static_cast<const char*>(data), bytes);
  Pad(data_, '\0');
}

void PlaneMessage::AddPicture(const Image<Rgb8>& rgb) {
  const Bytes file = EncodeJpeg(rgb, kQuality);
  Add("rgb", "file", "jpeg", rgb.width(), rgb.height(), file.data(), file.size());
}

void PlaneMessage::AddJpeg(std::string_view file, int width, int height) {
  Add("rgb", "file", "jpeg", width, height, file.data(), file.size());
}

bool PlaneMessage::AddProduct(const Frame& frame, const std::string& name) {
  const auto add = [&](const auto& image, const char* plane, const char* type, const auto& values) {
    Add(name, plane, type, image.width(), image.height(), values.data(), values.size() * sizeof(values[0]));
  };
  static const SrgbEncoder encode;
  if (name == "range")
    add(frame.range, "Y", "f32", frame.range.pixels());
  else if (name == "semantic")
    add(frame.semantic, "value", "u16", frame.semantic.pixels());
  else if (name == "entity")
    add(frame.entity, "id", "u32", frame.entity.pixels());
  else if (name == "material")
    add(frame.material, "value", "u16", frame.material.pixels());
  else if (name == "normal")
    add(frame.normal, "value", "u8", Mapped(frame.normal, [](const Vec3f& n) {
          return Rgb8{NormalByte(n.x), NormalByte(n.y), NormalByte(n.z)};
        }));
  else if (name == "albedo")
    add(frame.albedo, "value", "u8", Mapped(frame.albedo, [&](const Rgb32f& c) { return Rgb8{encode(c.r), encode(c.g), encode(c.b)}; }));
  else if (name == "coverage")
    add(frame.coverage, "share.0", "f32", Mapped(frame.coverage, [](const CoveragePixel& c) { return c.share[0]; }));
  else if (name == "position") {
    add(frame.position, "X", "f32", Mapped(frame.position, [](const Vec3f& p) { return p.x; }));
    add(frame.position, "Y", "f32", Mapped(frame.position, [](const Vec3f& p) { return p.y; }));
    add(frame.position, "Z", "f32", Mapped(frame.position, [](const Vec3f& p) { return p.z; }));
  } else if (name == "flow") {
    add(frame.flow, "dx", "f32", Mapped(frame.flow, [](const FlowPixel& f) { return f.dx; }));
    add(frame.flow, "dy", "f32", Mapped(frame.flow, [](const FlowPixel& f) { return f.dy; }));
  } else {
    return false;
  }
  return true;
}

void PlaneMessage::AddStored(const StoredPicture& picture) {
  using Type = StoredPicture::Type;
  const size_t pixels = static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height),
               depth = static_cast<size_t>(picture.depth);
  if (picture.product == "rgb") {
    Image<Rgb8> rgb(picture.width, picture.height);
    std::memcpy(rgb.pixels().data(), picture.values.data(), picture.values.size());
    return AddPicture(rgb);
  }
  if (!picture.channels.empty()) {
    // Values of a pixel lie together; planes do not.
    for (size_t c = 0; c < depth; ++c) {
      std::vector<float> plane(pixels);
      for (size_t i = 0; i < pixels; ++i) std::memcpy(&plane[i], picture.values.data() + (i * depth + c) * sizeof(float), sizeof(float));
      Add(picture.product, picture.channels[c].c_str(), "f32", picture.width, picture.height, plane.data(), plane.size() * sizeof(float));
    }
    return;
  }
  if (picture.product == "normal") {
    // 16 bits, of which the page shows 8.
    std::string high(pixels * depth, '\0');
    for (size_t i = 0; i < high.size(); ++i) high[i] = static_cast<char>(picture.values[2 * i + 1]);
    return Add("normal", "value", "u8", picture.width, picture.height, high.data(), high.size());
  }
  constexpr const char* kTypes[] = {"u8", "u16", "u32", "f32"};
  const char* plane = picture.product == "range" ? "Y" : picture.product == "entity" ? "id" : "value";
  Add(picture.product, plane, kTypes[static_cast<size_t>(picture.type)], picture.width, picture.height, picture.values.data(),
      picture.values.size());
  static_assert(static_cast<int>(Type::kFloat32) == 3);
}

std::string PlaneMessage::Finish(const std::string& fields) const {
  std::string header = "{" + fields + (fields.empty() ? "" : ",") + "\"planes\":[" + list_ + "]}";
  Pad(header, ' ');
  std::string message = "A360";
  const auto length = static_cast<uint32_t>(header.size());
  message.append(reinterpret_cast<const char*>(&length), sizeof length);
  return message + header + data_;
}

}  // namespace airsim360

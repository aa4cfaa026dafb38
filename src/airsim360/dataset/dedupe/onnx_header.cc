#include "airsim360/dataset/dedupe/onnx_header.h"

#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360::internal {
namespace {

using ByteSpan = std::span<const std::byte>;

// One field of a message: a number, or bytes.
struct WireField {
  uint32_t number = 0;
  uint64_t value = 0;
  ByteSpan bytes;
};

// Goes through the fields of a message (https://protobuf.dev/programming-guides/encoding).
class WireReader {
 public:
  explicit WireReader(ByteSpan message) : rest_(message) {}

  // The next field; nullopt at the end, and where the message is none: then whole() is false.
  std::optional<WireField> Next() {
    if (rest_.empty() || !whole_) return std::nullopt;
    const uint64_t key = Varint();
    WireField field{.number = static_cast<uint32_t>(key >> 3), .value = 0, .bytes = {}};
    switch (key & 7) {
      case 0:
        field.value = Varint();
        break;
      case 1:
        Take(8);
        break;
      case 2:
        field.bytes = Take(Varint());
        break;
      case 5:
        Take(4);
        break;
      default:
        whole_ = false;
    }
    if (field.number == 0) whole_ = false;
    return whole_ ? std::optional(field) : std::nullopt;
  }
  bool whole() const { return whole_; }

 private:
  uint64_t Varint() {
    uint64_t value = 0;
    for (int shift = 0; shift < 64 && !rest_.empty(); shift += 7) {
      const auto byte = static_cast<uint64_t>(rest_.front());
      rest_ = rest_.subspan(1);
      value |= (byte & 127) << shift;
      if (byte < 128) return value;
    }
    whole_ = false;
    return 0;
  }
  ByteSpan Take(uint64_t size) {
    if (size > rest_.size()) {
      whole_ = false;
      return {};
    }
    const ByteSpan bytes = rest_.first(static_cast<size_t>(size));
    rest_ = rest_.subspan(static_cast<size_t>(size));
    return bytes;
  }

  ByteSpan rest_;
  bool whole_ = true;
};

// Calls body(field) for all fields; false if the message is none.
template <class Body>
bool ForFields(ByteSpan message, const Body& body) {
  WireReader reader(message);
  while (const auto field = reader.Next()) body(*field);
  return reader.whole();
}

// The bytes of the last field of this number in a message.
ByteSpan Inner(ByteSpan message, uint32_t number) {
  ByteSpan found;
  ForFields(message, [&](const WireField& field) {
    if (field.number == number) found = field.bytes;
  });
  return found;
}

// What a ValueInfoProto tells: name, type of its elements, extents (0: any).
struct TensorInfo {
  std::string name;
  uint64_t type = 0;
  std::vector<uint64_t> extents;
};

TensorInfo ReadTensor(ByteSpan value) {
  TensorInfo tensor{.name = std::string(AsText(Inner(value, 1))), .type = 0, .extents = {}};
  const ByteSpan type = Inner(Inner(value, 2), 1);  // TypeProto.tensor_type
  ForFields(type, [&](const WireField& field) {
    if (field.number == 1) tensor.type = field.value;
  });
  ForFields(Inner(type, 2), [&](const WireField& field) {  // TensorShapeProto.dim
    if (field.number != 1) return;
    uint64_t extent = 0;
    ForFields(field.bytes, [&](const WireField& dim) {
      if (dim.number == 1) extent = dim.value;
    });
    tensor.extents.push_back(extent);
  });
  return tensor;
}

std::string ShapeText(const std::vector<uint64_t>& extents) {
  std::string text;
  for (const uint64_t n : extents) text += (text.empty() ? "" : " x ") + (n == 0 ? std::string("?") : std::to_string(n));
  return text.empty() ? "nothing" : text;
}

void CheckInput(const TensorInfo& input, const std::string& name) {
  constexpr uint64_t kFloat = 1;  // TensorProto.DataType
  const std::string at = name + ": its input '" + input.name.substr(0, 60) + "' is ";
  if (input.type != kFloat) throw InputError(at + "not of float32; export the network with float32 weights and pictures");
  const std::vector<uint64_t>& n = input.extents;
  const auto fits = [](uint64_t extent, uint64_t wanted) { return extent == 0 || extent == wanted; };
  if (n.size() != 4 || !fits(n[0], 1) || !fits(n[1], 3)) throw InputError(at + ShapeText(n) + ", not 1 x 3 x height x width");
  for (const uint64_t side : {n[2], n[3]}) {
    if (side != 0 && (side < kLeastSide || side > kMostSide))
      throw InputError(at + ShapeText(n) + ": sides of pictures are " + std::to_string(kLeastSide) + " … " + std::to_string(kMostSide) +
                       " pixels");
  }
}

}  // namespace

OnnxHeader ReadOnnxHeader(ByteSpan model, const std::string& name) {
  OnnxHeader header;
  ByteSpan graph;
  const bool whole = ForFields(model, [&](const WireField& field) {
    if (field.number == 7) graph = field.bytes;  // ModelProto.graph
    if (field.number != 8) return;               // ModelProto.opset_import: the standard operators have no domain
    int64_t version = 0;
    bool standard = true;
    ForFields(field.bytes, [&](const WireField& entry) {
      if (entry.number == 1) standard = entry.bytes.empty() || AsText(entry.bytes) == "ai.onnx";
      if (entry.number == 2) version = static_cast<int64_t>(entry.value);
    });
    if (standard) header.opset = version;
  });
  if (!whole || graph.empty() || header.opset < 1) throw InputError(name + ": not an ONNX file");
  // Old files list weights among the inputs.
  std::vector<TensorInfo> inputs;
  std::set<std::string> weights;
  const bool whole_graph = ForFields(graph, [&](const WireField& field) {
    if (field.number == 5) weights.emplace(AsText(Inner(field.bytes, 8)));  // GraphProto.initializer, TensorProto.name
    if (field.number == 11) inputs.push_back(ReadTensor(field.bytes));      // GraphProto.input
  });
  if (!whole_graph) throw InputError(name + ": not an ONNX file: its graph is cut off");
  std::erase_if(inputs, [&](const TensorInfo& input) { return weights.contains(input.name); });
  if (inputs.size() != 1) throw InputError(name + ": the network has " + std::to_string(inputs.size()) + " inputs, not one picture");
  CheckInput(inputs[0], name);
  header.height = static_cast<int>(inputs[0].extents[2]);
  header.width = static_cast<int>(inputs[0].extents[3]);
  return header;
}

}  // namespace airsim360::internal

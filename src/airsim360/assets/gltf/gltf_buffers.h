// Bytes of a glTF document: buffers, buffer views, accessors. Every offset, stride, length and count is
// checked against what is really there, in arithmetic that cannot overflow, before memory is taken.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "airsim360/assets/gltf/gltf_json_internal.h"
#include "airsim360/assets/imported.h"
#include "airsim360/assets/limits.h"
#include "airsim360/math/transform.h"

namespace airsim360::internal {

class GltfBuffers {
 public:
  /// `root` and `glb` (the binary chunk of a .glb, else empty) must outlive the object.
  GltfBuffers(const JsonRef& root, std::span<const std::byte> glb, const ResourceLoader& load, const ImportLimits& limits)
      : root_(root), glb_(glb), load_(load), limits_(limits) {}

  /// Element of the root array `array` whose index stands at `index`.
  JsonRef Element(const char* array, const JsonRef& index) const;
  /// Bytes of the buffer view whose index stands at `index`; decompressed if it is compressed.
  std::span<const std::byte> View(const JsonRef& index) { return ReadView(index).bytes; }
  /// The accessor whose index stands at `index`, as `components` floats an element (16: a MAT4); integers are
  /// normalised where the accessor says so.
  std::vector<float> Floats(const JsonRef& index, int components);
  /// The same as unsigned integers; components must be unsigned and not normalised.
  std::vector<uint32_t> Uints(const JsonRef& index, int components);
  /// Number of elements of the accessor whose index stands at `index`.
  uint64_t Count(const JsonRef& index) const { return Element("accessors", index).At("count").Uint(); }

  /// Takes `bytes` from the budget for decoded data; fails at `where` when that is used up.
  void Charge(uint64_t bytes, const JsonRef& where);

 private:
  struct ViewBytes {
    std::span<const std::byte> bytes;
    uint64_t stride = 0;  // 0 = tightly packed
  };
  struct Accessor;

  std::span<const std::byte> Buffer(const JsonRef& index);
  std::span<const std::byte> Slice(const JsonRef& object);
  ViewBytes ReadView(const JsonRef& index);
  std::span<const std::byte> Decompress(const JsonRef& extension, uint64_t key);
  Accessor Describe(const JsonRef& index, int components);
  template <class Out, class Convert>
  std::vector<Out> Read(const Accessor& accessor, const JsonRef& where, Convert convert);

  JsonRef root_;
  std::span<const std::byte> glb_;
  const ResourceLoader& load_;
  ImportLimits limits_;
  uint64_t charged_ = 0;
  std::map<uint64_t, Bytes> buffers_;       // loaded external and embedded buffers
  std::map<uint64_t, Bytes> decompressed_;  // buffer views
};

}  // namespace airsim360::internal

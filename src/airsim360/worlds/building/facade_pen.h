// Draws one wall: x along the wall (to the right seen from outside), y into the building, z up, wall plane y
// = 0.
#pragma once

#include "airsim360/worlds/kit/mesh_builder.h"
#include "airsim360/worlds/texture/surfaces.h"

namespace airsim360 {

class FacadePen {
 public:
  FacadePen(MeshBuilder& mesh, const Surfaces& surfaces) : mesh_(mesh), surfaces_(surfaces) {}

  /// Where z = 0 of the following walls lies, and what heights, and what stands proud of the wall, are multiplied
  /// by.
  void SetScale(float base, float stretch, float reach) {
    base_ = base;
    stretch_ = stretch;
    reach_ = reach;
  }
  /// The wall from a to b of a counter-clockwise outline.
  void SetWall(Vec2f a, Vec2f b);
  float length() const { return length_; }
  const AffineTransform& X_WF() const { return X_; }
  void Use(Surface surface) { mesh_.SetMaterial(surfaces_[surface]); }
  void UseEntity(EntityId entity) { mesh_.SetEntity(entity); }

  // Rectangles, named by the side they face; y0 is nearer to the street than y1.
  void Front(float x0, float x1, float z0, float z1, float y);
  void Left(float x, float y0, float y1, float z0, float z1);
  void Right(float x, float y0, float y1, float z0, float z1);
  void Up(float x0, float x1, float y0, float y1, float z);
  void Down(float x0, float x1, float y0, float y1, float z);
  /// Front with its own uv box (pictures): (0, 0) top left to (u1, v1).
  void Picture(float x0, float x1, float z0, float z1, float y, Vec2f uv0, Vec2f uv1);
  /// A bar standing proud of what is behind it: front, ends, top and bottom.
  void Bar(float x0, float x1, float z0, float z1, float y0, float y1, bool ends = true, bool bottom = true);
  /// The four inner faces of an opening between y0 and y1.
  void Reveal(float x0, float x1, float z0, float z1, float y0, float y1);
  /// Wall around an opening within [x0, x1] x [z0, z1].
  void WallAround(float x0, float x1, float z0, float z1, float ox0, float ox1, float oz0, float oz1);
  /// Frame of width `t`, `nx` and `nz` glazing bars, and the pane behind: its upper part `blind` (0..1)
  /// covered. `open` (0..0.6, of the height): the lower sash is pushed up that far and the opening below is dark.
  struct Sash {
    float t = 0.06f;
    int nx = 1, nz = 1;
    Surface frame = Surface::kFrameWhite, glass = Surface::kGlassDark, cover = Surface::kGlassBlind;
    float blind = 0, open = 0;
  };
  void Window(float x0, float x1, float z0, float z1, float y, const Sash& sash);

  MeshBuilder& mesh() { return mesh_; }
  /// Factor of everything that stands proud of the wall.
  float reach() const { return reach_; }

 private:
  MeshBuilder& mesh_;
  const Surfaces& surfaces_;
  AffineTransform X_;
  float Out(float y) const { return y < 0 ? y * reach_ : y; }
  float length_ = 0, base_ = 0, stretch_ = 1, reach_ = 1;
};

}  // namespace airsim360

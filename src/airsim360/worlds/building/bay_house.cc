#include "airsim360/worlds/building/bay_house.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/building/facade_bays.h"

namespace airsim360 {
namespace {

using S = Surface;
using Kind = BayHouse::Kind;

constexpr float kGround = 3.6f, kStorey = 3.35f, kDoorPart = 2.2f, kSill = 1.1f, kRecess = 1.2f, kParapet = 0.55f;

// The canted or square bay: where it begins and ends along the front, how far it stands out, how wide its slanting sides are.
struct BayShape {
  float x0, x1, out, cant;
};
BayShape ShapeOf(const BayHouse& h) {
  const float part = h.width - kDoorPart, left = h.door_right ? 0 : kDoorPart;
  const bool square = h.kind == Kind::kStucco;
  const float wide = std::min(part - 0.5f, square ? 3.6f : 3.1f), middle = left + part / 2;
  return {middle - wide / 2, middle + wide / 2, square ? 0.6f : 0.85f, square ? 0.02f : 0.72f};
}

// Draws the parts of one house; every wall is set up before it is drawn.
class HousePen {
 public:
  HousePen(FacadeContext& context, const BayHouse& house)
      : h_(house),
        pen_(context.mesh, context.surfaces),
        mesh_(context.mesh),
        surfaces_(context.surfaces),
        rng_(house.seed, "bay house"),
        dress_{house.wall, house.trim, house.frame, house.garage, S::kGlassDark, house.wall, S::kFarWalls1, 0},
        bay_(ShapeOf(house)),
        top_(house.height()),
        rim_(house.kind == Kind::kGabled ? top_ : top_ + kParapet) {
    pen_.SetScale(0, 1, 1);
  }

  void Front() {
    SetFront();
    GarageFloor();
    DoorFloor();
    Storeys();
    Bay();
    SetFront();
    if (!h_.flat) {
      Crown(0, bay_.x0);
      Crown(bay_.x1, h_.width);
    }
  }
  void Sides() {
    Side({h_.width, 0}, {h_.width, h_.depth}, h_.hidden_right, h_.open_right);
    Side({0, h_.depth}, {0, 0}, h_.hidden_left, h_.open_left);
    pen_.SetWall({h_.width, h_.depth}, {0, h_.depth});
    Windows(3, h_.rear_ground);
  }
  void Deck(EntityId building, EntityId roof);
  void Gable(EntityId building, EntityId roof);

 private:
  void SetFront() { pen_.SetWall({0, 0}, {h_.width, 0}); }
  float Fall(float x) const { return h_.fall_left + (h_.fall_right - h_.fall_left) * x / h_.width; }
  float uniform(float a, float b) { return static_cast<float>(rng_.Uniform(a, b)); }

  void GarageFloor() {
    const float left = h_.door_right ? 0 : kDoorPart, right = left + h_.width - kDoorPart, m = (left + right) / 2;
    const float z0 = 0.05f - Fall(m), z1 = std::min(z0 + 2.35f, kGround - 0.7f), x0 = m - 1.3f, x1 = m + 1.3f;
    pen_.Use(h_.wall);
    pen_.WallAround(left, right, -h_.foot, kGround, x0, x1, z0, z1);
    pen_.Reveal(x0, x1, z0, z1, 0, 0.4f);
    pen_.Use(h_.garage);
    pen_.Front(x0, x1, z0, z1, 0.4f);
    if (h_.flat) return;
    // Panels, a row of small panes, a frame.
    for (int row = 0; row < 4; ++row) {
      const float z = z0 + (z1 - z0) * static_cast<float>(row) / 4 + 0.06f, up = (z1 - z0) / 4 - 0.12f;
      for (int i = 0; i < 4; ++i) {
        const float x = x0 + 0.65f * static_cast<float>(i) + 0.07f;
        pen_.Use(row == 3 ? S::kGlassDark : h_.garage);
        if (row == 3)
          pen_.Front(x, x + 0.51f, z, z + up, 0.385f);
        else
          pen_.Bar(x, x + 0.51f, z, z + up, 0.37f, 0.4f);
      }
    }
    pen_.Use(h_.trim);
    for (float x : {x0 - 0.16f, x1}) pen_.Bar(x, x + 0.16f, z0, z1 + 0.16f, -0.05f, 0, true, false);
    pen_.Bar(x0, x1, z1, z1 + 0.16f, -0.05f, 0);
    // A sill course ties the storey together.
    pen_.Bar(-0.02f, h_.width + 0.02f, kGround - 0.16f, kGround, -0.12f, 0);
  }

  void DoorFloor() {
    const float left = h_.door_right ? h_.width - kDoorPart : 0, right = left + kDoorPart, m = BayHouseStoop(h_);
    const float x0 = m - 0.75f, x1 = m + 0.75f, head = kSill + 2.25f;
    pen_.Use(h_.wall);
    pen_.WallAround(left, right, -h_.foot, kGround, x0, x1, -h_.foot, head);
    pen_.Right(x0, 0, kRecess, -h_.foot, head);
    pen_.Left(x1, 0, kRecess, -h_.foot, head);
    pen_.Down(x0, x1, 0, kRecess, head);
    pen_.Front(x0, x1, -h_.foot, head, kRecess);
    pen_.Use(h_.door);
    pen_.Bar(m - 0.5f, m + 0.5f, kSill, kSill + 2.05f, kRecess - 0.05f, kRecess, true, false);
    if (h_.flat) return;
    pen_.Use(h_.trim);
    for (float x : {m - 0.62f, m + 0.5f}) pen_.Bar(x, x + 0.12f, kSill, kSill + 2.2f, kRecess - 0.09f, kRecess, true, false);
    pen_.Bar(m - 0.62f, m + 0.62f, kSill + 2.05f, kSill + 2.2f, kRecess - 0.09f, kRecess);
    pen_.Use(S::kGlassLit);
    pen_.Front(m - 0.32f, m + 0.32f, kSill + 1.15f, kSill + 1.85f, kRecess - 0.06f);
    // Pilasters and a hood before the recess.
    pen_.Use(h_.trim);
    for (float x : {x0 - 0.2f, x1}) pen_.Bar(x, x + 0.2f, kSill, head, -0.12f, 0, true, true);
    pen_.Bar(x0 - 0.3f, x1 + 0.3f, head, head + 0.18f, -0.3f, 0);
    Stoop(m, Fall(m));
  }

  void Stoop(float m, float fall) {
    const float rise = kSill + fall, run = kRecess + kStoopReach - 0.3f;
    const int steps = std::clamp(static_cast<int>(std::ceil(rise / 0.18f)), 4, static_cast<int>(run / 0.22f));
    const float tread = std::min(0.29f, run / static_cast<float>(steps)), x0 = m - 0.74f, x1 = m + 0.74f;
    for (int i = 0; i < steps; ++i) {
      const float z = rise * static_cast<float>(i + 1) / static_cast<float>(steps) - fall,
                  y = kRecess - tread * static_cast<float>(steps - i);
      pen_.Use(S::kTrimStone);
      pen_.Bar(x0, x1, -h_.foot, z, y, i + 1 == steps ? kRecess : y + tread, true, false);
      if (y > -tread) continue;
      pen_.Use(h_.wall);
      for (float x : {x0 - 0.2f, x1}) {
        pen_.Bar(x, x + 0.2f, -h_.foot, z + 0.32f, y, y + tread, true, false);
        pen_.mesh().Quad({x, y + tread, -h_.foot}, {x, y + tread, z + 0.32f}, {x + 0.2f, y + tread, z + 0.32f},
                         {x + 0.2f, y + tread, -h_.foot});
      }
    }
    const float y0 = kRecess - tread * static_cast<float>(steps) + 0.1f;
    if (y0 > -0.4f) return;
    const float z0 = rise / static_cast<float>(steps) - fall + 0.32f, slope = rise / (tread * static_cast<float>(steps));
    pen_.Use(S::kIronBlack);
    for (float x : {x0 - 0.1f, x1 + 0.1f}) {
      pen_.mesh().Beam({x, y0, z0 + 0.62f}, {x, 0, z0 + 0.62f - y0 * slope}, 0.045f);
      for (float y = y0; y < -0.1f; y += 0.3f)
        pen_.mesh().Beam({x, y, z0 - 0.1f + (y - y0) * slope}, {x, y, z0 + 0.62f + (y - y0) * slope}, 0.02f);
    }
  }

  // A sash window of a storey in the wall at hand, between x0 and x1 of it.
  void Window(float x0, float x1, float z, float half, bool hood) {
    const float m = (x0 + x1) / 2, a = m - half, b = m + half, z0 = z + 0.78f, z1 = z + 2.72f;
    pen_.Use(h_.wall);
    pen_.WallAround(x0, x1, z, z + kStorey, a, b, z0, z1);
    pen_.Reveal(a, b, z0, z1, 0, 0.14f);
    if (h_.flat) {
      pen_.Use(S::kGlassDark);
      pen_.Front(a, b, z0, z1, 0.14f);
      return;
    }
    FacadePen::Sash sash{.t = 0.055f, .nx = 0, .nz = 1, .frame = h_.frame};
    internal::Furnish(sash, rng_);
    pen_.Window(a, b, z0, z1, 0.14f, sash);
    pen_.Use(h_.trim);
    for (float x : {a - 0.11f, b}) pen_.Bar(x, x + 0.11f, z0, z1, -0.05f, 0, true, false);
    pen_.Bar(a - 0.16f, b + 0.16f, z0 - 0.1f, z0, -0.1f, 0.1f);
    pen_.Bar(a - 0.14f, b + 0.14f, z1, z1 + 0.16f, -0.08f, 0);
    if (hood) pen_.Bar(a - 0.24f, b + 0.24f, z1 + 0.16f, z1 + 0.27f, -0.22f, 0);
    // A raised panel below.
    if (b - a > 0.5f) pen_.Bar(a, b, z + 0.16f, z + 0.58f, -0.03f, 0);
  }

  void Storeys() {
    const float left = h_.door_right ? h_.width - kDoorPart : 0, right = left + kDoorPart;
    for (int f = 0; f < h_.floors; ++f) {
      const float z = kGround + kStorey * static_cast<float>(f);
      Window(left, right, z, 0.48f, true);
      pen_.Use(h_.wall);
      const float a = h_.door_right ? 0 : kDoorPart, b = a + h_.width - kDoorPart;
      pen_.Front(a, bay_.x0, z, z + kStorey, 0);
      pen_.Front(bay_.x1, b, z, z + kStorey, 0);
    }
    pen_.Use(h_.wall);
    if (rim_ <= top_) return;
    pen_.Front(0, bay_.x0, top_, rim_, 0);
    pen_.Front(bay_.x1, h_.width, top_, rim_, 0);
  }

  void Bay() {
    const Vec2f p[4] = {{bay_.x0, 0}, {bay_.x0 + bay_.cant, -bay_.out}, {bay_.x1 - bay_.cant, -bay_.out}, {bay_.x1, 0}};
    const float foot = kGround - 0.3f, rim = h_.kind == Kind::kGabled ? top_ : rim_;
    for (int side = 0; side < 3; ++side) {
      pen_.SetWall(p[side], p[side + 1]);
      const float L = pen_.length();
      pen_.Use(h_.trim);
      pen_.Front(0, L, foot, kGround, 0);
      if (!h_.flat) pen_.Bar(-0.03f, L + 0.03f, kGround - 0.1f, kGround + 0.02f, -0.07f, 0);
      for (int f = 0; f < h_.floors; ++f) {
        const float z = kGround + kStorey * static_cast<float>(f);
        if (L > 2.2f) {
          for (int k = 0; k < 2; ++k) Window(L / 2 * static_cast<float>(k), L / 2 * static_cast<float>(k + 1), z, L / 4 - 0.2f, false);
        } else {
          Window(0, L, z, std::max(0.15f, std::min(0.6f, L / 2 - 0.17f)), false);
        }
        if (f > 0 && !h_.flat) {
          pen_.Use(h_.trim);
          pen_.Bar(-0.03f, L + 0.03f, z - 0.08f, z + 0.08f, -0.09f, 0);
        }
      }
      pen_.Use(h_.wall);
      if (rim > top_) pen_.Front(0, L, top_, rim, 0);
      if (!h_.flat) Crown(0, L);
    }
    // Underside with a taper, and a lid.
    SetFront();
    pen_.Use(h_.trim);
    const Vec2f low[4] = {{bay_.x0 + 0.25f, 0},
                          {bay_.x0 + bay_.cant + 0.1f, -bay_.out * 0.55f},
                          {bay_.x1 - bay_.cant - 0.1f, -bay_.out * 0.55f},
                          {bay_.x1 - 0.25f, 0}};
    for (int i = 0; i < 3; ++i)
      mesh_.Quad({low[i].x, low[i].y, foot - 0.35f}, {low[i + 1].x, low[i + 1].y, foot - 0.35f}, {p[i + 1].x, p[i + 1].y, foot},
                 {p[i].x, p[i].y, foot});
    mesh_.Quad({low[3].x, low[3].y, foot - 0.35f}, {low[2].x, low[2].y, foot - 0.35f}, {low[1].x, low[1].y, foot - 0.35f},
               {low[0].x, low[0].y, foot - 0.35f});
    pen_.Use(S::kRoofBitumen);
    mesh_.Quad({p[0].x, p[0].y, rim}, {p[1].x, p[1].y, rim}, {p[2].x, p[2].y, rim}, {p[3].x, p[3].y, rim});
  }

  // Frieze, cornice and brackets below the eaves between x0 and x1 of the wall at hand; a strip of tiles on stucco.
  void Crown(float x0, float x1) {
    if (x1 - x0 < 0.1f) return;
    if (h_.kind == Kind::kStucco) {
      pen_.Use(S::kRoofTile);
      mesh_.Quad({x0 - 0.05f, -0.36f, rim_ - 0.5f}, {x1 + 0.05f, -0.36f, rim_ - 0.5f}, {x1 + 0.05f, 0.1f, rim_ - 0.02f},
                 {x0 - 0.05f, 0.1f, rim_ - 0.02f});
      pen_.Use(h_.trim);
      pen_.Down(x0 - 0.05f, x1 + 0.05f, -0.36f, 0, rim_ - 0.5f);
      pen_.Bar(x0, x1, rim_ - 0.72f, rim_ - 0.56f, -0.08f, 0);
      return;
    }
    const float z = h_.kind == Kind::kGabled ? top_ : rim_ - 0.1f;
    pen_.Use(h_.trim);
    pen_.Bar(x0 - 0.02f, x1 + 0.02f, z - 0.85f, z - 0.72f, -0.07f, 0);
    pen_.Bar(x0 - 0.12f, x1 + 0.12f, z - 0.28f, z - 0.06f, -0.26f, 0);
    pen_.Bar(x0 - 0.22f, x1 + 0.22f, z - 0.06f, z + 0.09f, -0.40f, 0);
    const int brackets = std::max(1, static_cast<int>((x1 - x0) / 0.55f));
    for (int i = 0; i < brackets; ++i) {
      const float x = x0 + (x1 - x0) * (static_cast<float>(i) + 0.5f) / static_cast<float>(brackets);
      pen_.Bar(x - 0.07f, x + 0.07f, z - 0.72f, z - 0.28f, -0.22f, 0);
    }
  }

  // Windows of a wall without ornament.
  void Windows(int bays, float yard) {
    const float L = pen_.length(), w = L / static_cast<float>(bays);
    const bool ground = yard < 0.5f;
    int first = 0;
    while (first + 1 < h_.floors && kGround + kStorey * static_cast<float>(first) + 0.4f < yard) ++first;
    pen_.Use(h_.wall);
    pen_.Front(0, L, -h_.foot, ground ? 0 : kGround + kStorey * static_cast<float>(first), 0);
    for (int i = 0; i < bays; ++i) {
      const float x0 = w * static_cast<float>(i), m = x0 + w / 2;
      if (ground) internal::SimpleOpening(pen_, dress_, x0, x0 + w, 0, kGround, m - 0.6f, m + 0.6f, 0.9f, 2.4f, 0.12f, rng_);
      for (int f = first; f < h_.floors; ++f) {
        const float z = kGround + kStorey * static_cast<float>(f);
        internal::SimpleOpening(pen_, dress_, x0, x0 + w, z, z + kStorey, m - 0.55f, m + 0.55f, z + 0.9f, z + 2.6f, 0.12f, rng_);
      }
    }
    pen_.Use(h_.wall);
    if (rim_ > top_) pen_.Front(0, L, top_, rim_, 0);
  }

  void Side(Vec2f a, Vec2f b, float hidden, bool open) {
    pen_.SetWall(a, b);
    if (open) return Windows(4, std::max(0.6f, h_.rear_ground));
    const float from = std::clamp(hidden, -h_.foot, rim_);
    pen_.Use(h_.wall);
    if (from < rim_ - 0.01f) pen_.Front(0, pen_.length(), from, rim_, 0);
  }

  const BayHouse& h_;
  FacadePen pen_;
  MeshBuilder& mesh_;
  const Surfaces& surfaces_;
  RngStream rng_;
  internal::Dress dress_;
  BayShape bay_;
  float top_, rim_;
};

// A flat deck behind the parapet, with hatch, skylight and chimney.
void HousePen::Deck(EntityId building, EntityId roof) {
  constexpr float kThick = 0.2f;
  const float w = h_.width, d = h_.depth;
  mesh_.SetTransform({});
  mesh_.SetEntity(roof);
  mesh_.SetMaterial(surfaces_[h_.seed % 3 == 0 ? S::kAsphaltPale : S::kRoofBitumen]);
  const GroundRect outer{0, 0, w, d}, inner = outer.Inset(kThick);
  mesh_.Polygon(inner.Outline(), top_);
  mesh_.SetMaterial(surfaces_[S::kCoping]);
  const std::vector<Vec2f> out = outer.Outline(), in = inner.Outline();
  for (size_t i = 0; i < 4; ++i) {
    const size_t k = (i + 1) % 4;
    mesh_.Quad({out[i].x, out[i].y, rim_}, {out[k].x, out[k].y, rim_}, {in[k].x, in[k].y, rim_}, {in[i].x, in[i].y, rim_});
  }
  mesh_.SetEntity(building);
  mesh_.SetMaterial(surfaces_[h_.wall]);
  const std::vector<Vec2f> turned(in.rbegin(), in.rend());
  mesh_.Walls(turned, top_, rim_);
  constexpr unsigned kSides = MeshBuilder::kLeft | MeshBuilder::kRight | MeshBuilder::kFront | MeshBuilder::kBack,
                     kOpen = kSides | MeshBuilder::kTop;
  const auto box = [&](S surface, float x, float y, float hx, float hy, float height) {
    mesh_.SetMaterial(surfaces_[surface]);
    mesh_.Box({x - hx, y - hy, top_}, {x + hx, y + hy, top_ + height}, kOpen);
  };
  box(h_.wall, w * uniform(0.35f, 0.65f), d * uniform(0.5f, 0.7f), 0.7f, 1.1f, 2.1f);
  box(S::kBrickRed, h_.seed % 2 ? 0.6f : w - 0.6f, d * uniform(0.2f, 0.45f), 0.28f, 0.4f, 1.5f);
  mesh_.SetEntity(roof);
  box(S::kMetal, w * uniform(0.3f, 0.7f), d * uniform(0.15f, 0.4f), 0.55f, 0.85f, 0.28f);
  box(S::kGlassBlue, w * 0.5f, d * 0.85f, 0.5f, 0.6f, 0.35f);
  for (int i = 0; i < 3; ++i) {
    const Vec3f at{w * uniform(0.15f, 0.85f), d * uniform(0.1f, 0.95f), top_};
    mesh_.SetMaterial(surfaces_[S::kMetal]);
    mesh_.Tube(at, at + Vec3f{0, 0, uniform(0.4f, 0.9f)}, 0.06f, 0.06f, 7, false, true);
  }
}

// A roof with its gable to the street, boards along its edges, an attic window.
void HousePen::Gable(EntityId building, EntityId roof) {
  constexpr float kOver = 0.4f, kPitch = 0.82f;
  const float w = h_.width, d = h_.depth, m = w / 2, ridge = top_ + m * kPitch, e = 0.05f;
  mesh_.SetTransform({});
  mesh_.SetEntity(roof);
  mesh_.SetMaterial(surfaces_[S::kRoofSlate]);
  const float run = std::hypot(m, m * kPitch);
  mesh_.QuadUv({w, -kOver, top_ + e}, {w, d + kOver, top_ + e}, {m, d + kOver, ridge + e}, {m, -kOver, ridge + e}, {0, run},
               {d + 2 * kOver, run}, {d + 2 * kOver, 0}, {0, 0});
  mesh_.QuadUv({0, d + kOver, top_ + e}, {0, -kOver, top_ + e}, {m, -kOver, ridge + e}, {m, d + kOver, ridge + e}, {0, run},
               {d + 2 * kOver, run}, {d + 2 * kOver, 0}, {0, 0});
  // Undersides of the overhang.
  mesh_.SetMaterial(surfaces_[h_.trim]);
  for (float y0 : {-kOver, d}) {
    const float y1 = y0 + kOver;
    mesh_.Quad({w, y1, top_}, {w, y0, top_}, {m, y0, ridge}, {m, y1, ridge});
    mesh_.Quad({0, y0, top_}, {0, y1, top_}, {m, y1, ridge}, {m, y0, ridge});
  }
  for (float y : {-kOver + 0.03f, d + kOver - 0.03f}) {
    mesh_.Beam({0, y, top_ - 0.06f}, {m, y, ridge - 0.06f}, 0.16f);
    mesh_.Beam({w, y, top_ - 0.06f}, {m, y, ridge - 0.06f}, 0.16f);
  }
  mesh_.SetEntity(building);
  mesh_.SetMaterial(surfaces_[h_.wall]);
  const auto uv = [](Vec3f p) { return Vec2f{p.x, -p.z}; };
  const Vec3f a{0, 0, top_}, b{w, 0, top_}, c{m, 0, ridge}, a1{0, d, top_}, b1{w, d, top_}, c1{m, d, ridge};
  mesh_.Triangle(a, b, c, uv(a), uv(b), uv(c));
  mesh_.Triangle(b1, a1, c1, uv(b1), uv(a1), uv(c1));
  SetFront();
  if (!h_.flat) {
    const float z0 = top_ + 0.55f, z1 = top_ + 1.75f;
    pen_.Use(h_.trim);
    pen_.Bar(m - 0.62f, m + 0.62f, z0 - 0.12f, z1 + 0.14f, -0.05f, 0);
    pen_.Bar(m - 0.72f, m + 0.72f, z0 - 0.2f, z0 - 0.08f, -0.12f, 0);
    pen_.Use(S::kGlassDark);
    pen_.Front(m - 0.45f, m + 0.45f, z0, z1, -0.055f);
    pen_.Use(h_.frame);
    pen_.Bar(m - 0.03f, m + 0.03f, z0, z1, -0.08f, -0.055f, true, false);
    pen_.Bar(m - 0.45f, m + 0.45f, (z0 + z1) / 2 - 0.03f, (z0 + z1) / 2 + 0.03f, -0.08f, -0.055f);
  }
  mesh_.SetTransform({});
  mesh_.SetMaterial(surfaces_[S::kBrickRed]);
  const float cy = d * uniform(0.3f, 0.7f), cx = m + (h_.seed % 2 ? 1.1f : -1.1f);
  mesh_.Box({cx - 0.3f, cy - 0.4f, top_ + 0.5f}, {cx + 0.3f, cy + 0.4f, ridge + 0.8f}, MeshBuilder::kAllSides & ~MeshBuilder::kBottom);
}

}  // namespace

float BayHouse::height() const { return kGround + kStorey * static_cast<float>(floors); }
float BayHouse::top() const { return height() + (kind == Kind::kGabled ? width / 2 * 0.82f : kParapet); }

float BayHouseStoop(const BayHouse& house) { return house.door_right ? house.width - kDoorPart / 2 : kDoorPart / 2; }

void BuildBayHouse(FacadeContext& context, const BayHouse& house, EntityId building, EntityId roof) {
  context.mesh.SetEntity(building);
  HousePen pen(context, house);
  pen.Front();
  pen.Sides();
  if (house.kind == Kind::kGabled) {
    pen.Gable(building, roof);
  } else {
    pen.Deck(building, roof);
  }
  context.mesh.SetTransform({});
}

}  // namespace airsim360

#include "airsim360/worlds/interior/finishes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "airsim360/base/parallel.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/texture/texture_field.h"

namespace airsim360::internal {
namespace {

// FinishPictures of surfaces; grey ones have a mean near 1 and are coloured by the material.
enum class Weave {
  kNone,
  kBoards,
  kCarpet,
  kTiles60,
  kTiles20,
  kTerrazzo,
  kStone,
  kConcrete,
  kPlaster,
  kCeilingGrid,
  kRibs,
  kBlocks,
  kCount
};

struct Row {
  Finish finish;
  const char* name;
  Vec3f color;
  float roughness;
  Weave weave = Weave::kNone;
  float metallic = 0;
};
using F = Finish;
using W = Weave;
constexpr Row kRows[] = {
    {F::kOak, "oak floor", {0.36f, 0.235f, 0.13f}, 0.42f, W::kBoards},
    {F::kWalnut, "walnut floor", {0.19f, 0.11f, 0.062f}, 0.4f, W::kBoards},
    {F::kCarpetGrey, "carpet grey", {0.17f, 0.172f, 0.18f}, 0.97f, W::kCarpet},
    {F::kCarpetBlue, "carpet blue", {0.10f, 0.135f, 0.19f}, 0.97f, W::kCarpet},
    {F::kTileWhite, "floor tiles pale", {0.62f, 0.60f, 0.56f}, 0.3f, W::kTiles60},
    {F::kTileGrey, "floor tiles grey", {0.30f, 0.295f, 0.285f}, 0.35f, W::kTiles60},
    {F::kTerrazzo, "terrazzo", {0.40f, 0.375f, 0.34f}, 0.16f, W::kTerrazzo},
    {F::kStone, "stone floor", {0.55f, 0.50f, 0.43f}, 0.2f, W::kStone},
    {F::kEpoxy, "epoxy floor", {0.36f, 0.38f, 0.40f}, 0.28f, W::kConcrete},
    {F::kConcreteFloor, "concrete floor", {0.36f, 0.35f, 0.335f}, 0.4f, W::kConcrete},
    {F::kDeck, "deck coating", {0.25f, 0.255f, 0.26f}, 0.55f, W::kConcrete},
    {F::kPlasterWhite, "wall white", {0.76f, 0.755f, 0.735f}, 0.9f, W::kPlaster},
    {F::kPlasterWarm, "wall cream", {0.72f, 0.66f, 0.56f}, 0.9f, W::kPlaster},
    {F::kPlasterSage, "wall sage", {0.47f, 0.53f, 0.44f}, 0.9f, W::kPlaster},
    {F::kPlasterBlue, "wall blue", {0.38f, 0.47f, 0.56f}, 0.9f, W::kPlaster},
    {F::kPlasterGrey, "wall grey", {0.48f, 0.485f, 0.48f}, 0.9f, W::kPlaster},
    {F::kPlasterRose, "wall rose", {0.64f, 0.49f, 0.44f}, 0.9f, W::kPlaster},
    {F::kBathTiles, "wall tiles", {0.74f, 0.75f, 0.74f}, 0.15f, W::kTiles20},
    {F::kConcreteWall, "concrete wall", {0.44f, 0.43f, 0.41f}, 0.75f, W::kConcrete},
    {F::kBlockWall, "block wall", {0.62f, 0.61f, 0.58f}, 0.85f, W::kBlocks},
    {F::kRibbedWhite, "wall panel", {0.66f, 0.67f, 0.67f}, 0.45f, W::kRibs},
    {F::kCeilingPlaster, "ceiling white", {0.82f, 0.82f, 0.81f}, 0.92f, W::kPlaster},
    {F::kCeilingTiles, "ceiling tiles", {0.78f, 0.78f, 0.76f}, 0.95f, W::kCeilingGrid},
    {F::kCeilingConcrete, "ceiling concrete", {0.50f, 0.49f, 0.475f}, 0.8f, W::kConcrete},
    {F::kSteelDeck, "steel deck", {0.60f, 0.61f, 0.61f}, 0.45f, W::kRibs, 0.3f},
    {F::kFacadeRender, "facade render", {0.66f, 0.60f, 0.50f}, 0.9f, W::kPlaster},
    {F::kFacadePanel, "facade panel", {0.42f, 0.43f, 0.44f}, 0.5f, W::kConcrete},
    {F::kFacadeRibbed, "facade ribbed", {0.34f, 0.40f, 0.46f}, 0.45f, W::kRibs, 0.2f},
    {F::kGlass, "clear glass", {0.97f, 0.985f, 0.98f}, 0.03f},
    {F::kGlassTinted, "partition glass", {0.93f, 0.965f, 0.955f}, 0.03f},
    {F::kFrosted, "frosted glass", {0.80f, 0.84f, 0.83f}, 0.35f},
    {F::kFrameDark, "frame dark", {0.055f, 0.057f, 0.06f}, 0.4f},
    {F::kFrameWhite, "frame white", {0.76f, 0.76f, 0.75f}, 0.4f},
    {F::kFrameSteel, "frame steel", {0.54f, 0.55f, 0.55f}, 0.3f, W::kNone, 1},
    {F::kDoorOak, "door oak", {0.40f, 0.26f, 0.14f}, 0.45f, W::kBoards},
    {F::kDoorWhite, "door white", {0.76f, 0.755f, 0.74f}, 0.4f},
    {F::kDoorGrey, "door grey", {0.33f, 0.34f, 0.35f}, 0.45f},
    {F::kDoorSteel, "door steel", {0.53f, 0.54f, 0.54f}, 0.33f, W::kNone, 0.9f},
    {F::kSkirting, "skirting", {0.74f, 0.735f, 0.72f}, 0.5f},
    {F::kSill, "sill", {0.70f, 0.69f, 0.66f}, 0.3f},
    {F::kChrome, "chrome", {0.56f, 0.565f, 0.57f}, 0.08f, W::kNone, 1},
    {F::kRubber, "rubber", {0.03f, 0.03f, 0.031f}, 0.8f},
    {F::kSteelBlue, "steel blue", {0.035f, 0.10f, 0.27f}, 0.4f},
    {F::kSteelGrey, "steel grey", {0.38f, 0.39f, 0.40f}, 0.45f},
    {F::kPaintYellow, "marking yellow", {0.70f, 0.46f, 0.03f}, 0.5f},
    {F::kPaintWhite, "marking white", {0.70f, 0.70f, 0.68f}, 0.5f},
    {F::kPaintRed, "paint red", {0.46f, 0.03f, 0.025f}, 0.45f},
    {F::kPaintGreen, "paint green", {0.03f, 0.26f, 0.10f}, 0.45f},
    {F::kPaintBlack, "paint black", {0.03f, 0.03f, 0.03f}, 0.5f},
    {F::kTread, "tread", {0.34f, 0.33f, 0.32f}, 0.5f, W::kTerrazzo},
    {F::kRadiator, "radiator", {0.76f, 0.76f, 0.75f}, 0.35f},
    {F::kPlastic, "plastic white", {0.74f, 0.74f, 0.72f}, 0.4f},
};
static_assert(std::size(kRows) == static_cast<size_t>(Finish::kCount));

// Metres of a tile of the picture.
float TileOf(Weave weave) {
  switch (weave) {
    case W::kBoards:
      return 2.4f;
    case W::kCarpet:
      return 1.0f;
    case W::kTiles60:
      return 1.2f;
    case W::kTiles20:
      return 0.8f;
    case W::kTerrazzo:
      return 1.2f;
    case W::kStone:
      return 1.8f;
    case W::kConcrete:
      return 6.0f;
    case W::kPlaster:
      return 1.0f;
    case W::kCeilingGrid:
      return 1.2f;
    case W::kRibs:
      return 1.0f;
    case W::kBlocks:
      return 0.8f;
    default:
      return 1;
  }
}

// Distance from the joints of a grid of n x m tiles (odd rows shifted by `bond`), in tiles of the grid; and the tile's number.
struct FinishCell {
  float edge_u, edge_v;
  int tile;
};
FinishCell CellOf(float u, float v, int n, int m, float bond) {
  const float y = v * static_cast<float>(m), row = std::floor(y);
  float x = u * static_cast<float>(n) + bond * row;
  x -= std::floor(x / static_cast<float>(n)) * static_cast<float>(n);
  const float column = std::floor(x);
  return {std::min(x - column, column + 1 - x), std::min(y - row, row + 1 - y), static_cast<int>(row) * n + static_cast<int>(column)};
}
float OfTile(int tile, int salt) { return TileNoise(static_cast<float>(tile) + 0.0f, static_cast<float>(salt), 4096, 64, 77); }

Vec3f BoardsAt(float u, float v) {
  // Boards of 0.15 x 1.2 m along u, each with its own tone and grain.
  const int rows = 16;
  const float y = v * rows, row = std::floor(y);
  const float x = u * 2 + TileNoise(row, 3, 16, 8, 5) * 2, board = std::floor(x);
  const int tile = static_cast<int>(row) * 7 + (static_cast<int>(board) % 2 + 2) % 2;
  const float along = std::min(x - board, board + 1 - x) * 1.2f, across = std::min(y - row, row + 1 - y) * 0.15f;
  const float grain = TileFractal(u, v, 3, 160, 3, 40 + static_cast<uint64_t>(tile)),
              ring = TileFractal(u, v, 5, 40, 2, 90 + static_cast<uint64_t>(tile));
  const float tone = 0.72f + 0.40f * OfTile(tile, 1) + 0.28f * (grain - 0.5f) + 0.25f * (ring - 0.5f);
  const float joint = std::min(1.0f, std::min(along, across) / 0.0016f);
  return Vec3f{1, 0.985f - 0.03f * OfTile(tile, 2), 0.96f - 0.06f * OfTile(tile, 3)} * (tone * (0.45f + 0.55f * joint));
}

Vec3f TilesAt(float u, float v, int n, int m, float bond, float grout, float size, float speckle) {
  const FinishCell c = CellOf(u, v, n, m, bond);
  const float d = std::min(c.edge_u, c.edge_v) * size;
  const float tone = 0.93f + 0.10f * OfTile(c.tile, 4) + speckle * (TileFractal(u, v, 24, 24, 4, 17) - 0.5f);
  return d < grout ? Vec3f{0.55f, 0.54f, 0.52f} : Vec3f{1, 1, 1} * tone;
}

// Chips of marble in cement, ground flat: broken stones of 4 to 11 mm and splinters of 3 mm between them, each of one colour.
struct Chips {
  CellPattern pattern;
  float least, spread;  // of a chip's reach, in cells
  int salt;
  // Share of the chip at (u, v), 0 or 1, and its colour.
  float At(float u, float v, Vec3f& color) const {
    constexpr Vec3f kStones[] = {{1.20f, 1.19f, 1.16f}, {1.14f, 1.10f, 1.02f}, {0.86f, 0.83f, 0.80f}, {0.97f, 0.86f, 0.70f},
                                 {1.17f, 1.16f, 1.15f}, {0.56f, 0.54f, 0.52f}, {1.10f, 1.08f, 1.04f}};
    const CellPattern::Cell c = pattern.At(u, v);
    const int id = static_cast<int>(c.id % 4093);
    color = kStones[static_cast<size_t>(OfTile(id, salt) * 6.999f)];
    return c.edge > 0.06f && c.nearest < least + spread * OfTile(id, salt + 1) ? 1.0f : 0.0f;
  }
};

// Ground slabs of 0.6 m, no two of one batch, with joints of 4.5 mm. Its mean is about 1.
Vec3f TerrazzoAt(float u, float v) {
  static const Chips stones{CellPattern(100, 100, 0.9f, 21), 0.16f, 0.34f, 11}, splinters{CellPattern(260, 260, 0.9f, 22), 0.1f, 0.36f, 13};
  const FinishCell c = CellOf(u, v, 2, 2, 0);
  if (std::min(c.edge_u, c.edge_v) * 0.6f < 0.00225f) return Vec3f{0.40f, 0.39f, 0.37f};
  const float cloud = TileFractal(u, v, 4, 4, 4, 23) - 0.5f;
  Vec3f color, chip;
  if (stones.At(u, v, chip) > 0)
    color = chip;
  else if (splinters.At(u, v, chip) > 0)
    color = chip * 0.96f;
  else
    color = Vec3f{0.99f, 0.97f, 0.93f};
  return color * (0.97f + 0.11f * (OfTile(c.tile, 7) - 0.5f) + 0.08f * cloud);
}

Vec3f ColorAt(Weave weave, float u, float v) {
  const Vec3f one{1, 1, 1};
  switch (weave) {
    case W::kBoards:
      return BoardsAt(u, v);
    case W::kCarpet: {
      const FinishCell c = CellOf(u, v, 2, 2, 0);
      const float pile = TileNoise(u * 256, v * 256, 256, 256, 3) + 0.6f * TileFractal(u, v, 8, 8, 5, 6);
      return one * (0.62f + 0.42f * pile + 0.05f * OfTile(c.tile, 8));
    }
    case W::kTiles60:
      return TilesAt(u, v, 2, 2, 0, 0.0025f, 0.6f, 0.10f);
    case W::kTiles20:
      return TilesAt(u, v, 4, 8, 0.5f, 0.0018f, 0.15f, 0.03f);
    case W::kTerrazzo:
      return TerrazzoAt(u, v);
    case W::kStone: {
      const FinishCell c = CellOf(u, v, 2, 3, 0.5f);
      const float vein = std::abs(2 * TileFractal(u, v, 3, 4, 5, 31 + static_cast<uint64_t>(c.tile)) - 1);
      const float d = std::min(c.edge_u * 0.9f, c.edge_v * 0.6f);
      return d < 0.0016f ? Vec3f{0.5f, 0.49f, 0.46f}
                         : Vec3f{1, 0.99f, 0.97f} * (0.82f + 0.13f * OfTile(c.tile, 5) + 0.16f * std::min(1.0f, 3 * vein));
    }
    case W::kConcrete: {
      const float cloud = TileFractal(u, v, 4, 4, 6, 51), fine = TileNoise(u * 500, v * 500, 500, 500, 52);
      const float stain = std::max(0.0f, TileFractal(u, v, 9, 9, 4, 53) - 0.58f);
      return Vec3f{1, 0.99f, 0.975f} * (0.82f + 0.30f * cloud + 0.06f * fine - 0.8f * stain);
    }
    case W::kPlaster:
      return one * (0.965f + 0.05f * TileFractal(u, v, 3, 3, 4, 61) + 0.02f * TileNoise(u * 200, v * 200, 200, 200, 62));
    case W::kCeilingGrid: {
      const FinishCell c = CellOf(u, v, 2, 2, 0);
      const float d = std::min(c.edge_u, c.edge_v) * 0.6f;
      if (d < 0.012f) return one * (d > 0.010f ? 0.62f : 1.04f);
      const bool hole = TileNoise(u * 180, v * 180, 180, 180, 71) > 0.83f;
      return one * (hole ? 0.62f : 0.96f + 0.05f * TileFractal(u, v, 8, 8, 3, 72));
    }
    case W::kRibs:
      return one * (0.95f + 0.07f * TileFractal(u, v, 2, 6, 4, 81));
    case W::kBlocks: {
      const FinishCell c = CellOf(u, v, 2, 4, 0.5f);
      const float d = std::min(c.edge_u * 0.4f, c.edge_v * 0.2f);
      return one * ((d < 0.005f ? 0.86f : 0.95f + 0.05f * OfTile(c.tile, 6)) + 0.06f * (TileFractal(u, v, 30, 30, 3, 91) - 0.5f));
    }
    default:
      return one;
  }
}

// Metres out of the surface; 0 where the picture alone tells.
float HeightAt(Weave weave, float u, float v) {
  switch (weave) {
    case W::kCarpet:
      return 0.0012f * TileNoise(u * 128, v * 128, 128, 128, 3);
    case W::kTiles60: {
      const FinishCell c = CellOf(u, v, 2, 2, 0);
      return 0.001f * std::min(1.0f, std::min(c.edge_u, c.edge_v) * 0.6f / 0.004f);
    }
    case W::kTiles20: {
      const FinishCell c = CellOf(u, v, 4, 8, 0.5f);
      return 0.001f * std::min(1.0f, std::min(c.edge_u * 0.2f, c.edge_v * 0.1f) / 0.003f);
    }
    case W::kPlaster:
      return 0.0006f * TileFractal(u, v, 48, 48, 2, 63);
    case W::kCeilingGrid: {
      const FinishCell c = CellOf(u, v, 2, 2, 0);
      return -0.004f * (std::min(c.edge_u, c.edge_v) * 0.6f < 0.012f ? 0.0f : 1.0f);
    }
    case W::kRibs: {
      const float phase = u * 5 - std::floor(u * 5);
      return 0.02f * std::clamp((0.25f - std::abs(phase - 0.5f)) / 0.08f, 0.0f, 1.0f);
    }
    case W::kBlocks: {
      const FinishCell c = CellOf(u, v, 2, 4, 0.5f);
      return 0.004f * std::min(1.0f, std::min(c.edge_u * 0.4f, c.edge_v * 0.2f) / 0.008f);
    }
    default:
      return 0;
  }
}
bool HasRelief(Weave weave) {
  return weave == W::kCarpet || weave == W::kTiles60 || weave == W::kTiles20 || weave == W::kPlaster || weave == W::kCeilingGrid ||
         weave == W::kRibs || weave == W::kBlocks;
}

struct FinishPictures {
  TextureId color = kNoTexture, normal = kNoTexture;
};

}  // namespace

Finishes::Finishes(SceneBuilder& builder) {
  constexpr auto kWeaves = static_cast<int64_t>(Weave::kCount);
  // Chips of terrazzo are finer than anything else.
  const auto size = [](Weave weave) { return weave == W::kTerrazzo ? 1024 : 512; };
  std::vector<Texture> colors(kWeaves), normals(kWeaves);
  ParallelFor(2 * kWeaves, [&](int64_t job) {
    const auto weave = static_cast<Weave>(job / 2);
    const auto i = static_cast<size_t>(job / 2);
    if (weave == Weave::kNone) return;
    const std::string name = "interior " + std::to_string(i);
    if (job % 2 == 0)
      colors[i] =
          Texture::FromImage(name, Shade(size(weave), size(weave), [&](float u, float v) { return ColorAt(weave, u, v) * 0.8f; }), true);
    else if (HasRelief(weave)) {
      const float tile = TileOf(weave);
      normals[i] =
          NormalsFromHeight(name + " normals", size(weave), size(weave), 1, [&](float u, float v) { return HeightAt(weave, u, v) / tile; });
    }
  });
  std::vector<FinishPictures> pictures(kWeaves);
  for (size_t i = 1; i < pictures.size(); ++i) {
    pictures[i].color = builder.AddTexture(std::move(colors[i]));
    if (HasRelief(static_cast<Weave>(i))) pictures[i].normal = builder.AddTexture(std::move(normals[i]));
  }
  for (const Row& row : kRows) {
    Material m;
    m.name = row.name;
    m.base_color = row.color;
    m.roughness = row.roughness;
    m.metallic = row.metallic;
    if (row.weave != Weave::kNone) {
      const FinishPictures& p = pictures[static_cast<size_t>(row.weave)];
      m.base_color = row.color * (1 / 0.8f);  // pictures are held below white
      m.base_color_texture = p.color;
      m.normal_texture = p.normal;
      m.uv_scale = Vec2f{1, 1} * (1 / TileOf(row.weave));
    }
    if (row.finish == F::kFrosted) {
      m.kind = SurfaceKind::kFoliage;  // light comes through it scattered
      m.transmission = 0.7f;
    }
    if (row.finish == F::kGlass || row.finish == F::kGlassTinted) {
      m.kind = SurfaceKind::kGlass;
      m.transmission = 1;
    }
    materials_[static_cast<size_t>(row.finish)] = builder.AddMaterial(std::move(m));
  }
}

}  // namespace airsim360::internal

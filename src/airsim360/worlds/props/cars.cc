// Cars and vans: body, grille, lights, plates, mirrors and wheels.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/props/car_shape.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/wheels.h"

namespace airsim360::internal {
namespace {

// Bumper inserts, grille, lights, plates, mirrors, door lines and the dark underside.
void AddDetails(PropBuilder& b, const CarShape& s, const Material& paint) {
  const float nose = s.top.front().x, tail = s.top.back().x, low = Lookup(s.belt, nose), high = Lookup(s.belt, tail),
              w = Lookup(s.width, nose + 0.1f);
  const Material black = Plastic({0.012f, 0.012f, 0.013f}, 0.5f);
  b.Use(black);
  b.BevelBox({-0.52f, nose - 0.02f, low - 0.20f}, {0.52f, nose + 0.2f, low - 0.06f}, 0.02f);
  b.BevelBox({-0.56f, nose - 0.015f, 0.22f}, {0.56f, nose + 0.3f, 0.33f}, 0.03f);
  b.BevelBox({-0.60f, tail - 0.3f, 0.22f}, {0.60f, tail + 0.02f, 0.40f}, 0.04f);
  const float inner = Lookup(s.width, 0) - 0.28f;
  b.BevelBox({-inner, nose + 0.25f, 0.18f}, {inner, tail - 0.25f, 0.70f}, 0.05f);
  for (float x : {-1.0f, 1.0f}) {
    b.Use(Glass({0.34f, 0.35f, 0.36f}));
    b.mesh().Sphere({x * (w - 0.15f), nose + 0.17f, low + 0.025f}, {0.19f, 0.20f, 0.085f}, 8, 16);
    Material red = Glass({0.30f, 0.008f, 0.008f});
    b.Use(red);
    const float tail_width = Lookup(s.width, tail - 0.06f);
    b.BevelBox({x > 0 ? tail_width - 0.22f : -tail_width - 0.005f, tail - 0.14f, high - 0.12f},
               {x > 0 ? tail_width + 0.005f : -tail_width + 0.22f, tail + 0.012f, high + 0.03f}, 0.03f);
    // Mirror at the front end of the side window.
    const float y = s.side_glass.from + 0.18f, z = Lookup(s.belt, y) + 0.10f, x0 = Lookup(s.width, y);
    b.Use(paint);
    b.BevelBox({x > 0 ? x0 - 0.03f : -x0 - 0.17f, y - 0.06f, z - 0.06f}, {x > 0 ? x0 + 0.17f : -x0 + 0.03f, y + 0.05f, z + 0.07f}, 0.04f);
  }
  // Plates.
  Canvas plate(128, 64, {0.72f, 0.73f, 0.70f});
  plate.Rectangle({0, 0}, {1, 0.2f}, {0.02f, 0.06f, 0.25f});
  plate.Letters("7KR360", {0.5f, 0.6f}, 0.36f, {0.03f, 0.04f, 0.12f});
  b.Use(Paint({1, 1, 1}), plate.Finish("plate"));
  b.Picture({-0.15f, nose - 0.022f, low - 0.21f}, {0.15f, nose - 0.022f, low - 0.21f}, {0.15f, nose - 0.022f, low - 0.07f},
            {-0.15f, nose - 0.022f, low - 0.07f});
  b.Picture({0.15f, tail + 0.003f, high - 0.28f}, {-0.15f, tail + 0.003f, high - 0.28f}, {-0.15f, tail + 0.003f, high - 0.14f},
            {0.15f, tail + 0.003f, high - 0.14f});
  for (float x : {-1.0f, 1.0f}) {
    for (float y : {s.front_axle, s.rear_axle})
      AddWheel(b, {x * (Lookup(s.width, y) - 0.125f), y, s.wheel_radius}, s.wheel_radius, 0.21f, x);
  }
}

// Adds the parts of `more` to `model`.
void Append(Model& model, Model more) {
  const auto vertices = static_cast<uint32_t>(model.mesh.positions.size());
  const auto triangles = static_cast<uint32_t>(model.mesh.triangles.size());
  const auto textures = static_cast<TextureId>(model.textures.size());
  const auto materials = static_cast<MaterialId>(model.materials.size());
  const auto join = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  join(model.mesh.positions, more.mesh.positions);
  join(model.mesh.normals, more.mesh.normals);
  join(model.mesh.uvs, more.mesh.uvs);
  for (Vec3u t : more.mesh.triangles) model.mesh.triangles.push_back({t.x + vertices, t.y + vertices, t.z + vertices});
  for (MeshPart part : more.mesh.parts) {
    part.first_triangle += triangles;
    part.material += materials;
    model.mesh.parts.push_back(part);
  }
  for (Material m : more.materials) {
    for (TextureId* id : {&m.base_color_texture, &m.emission_texture})
      if (*id != kNoTexture) *id += textures;
    model.materials.push_back(std::move(m));
  }
  join(model.textures, more.textures);
}

Model Assemble(const char* name, const CarShape& s, Vec3f color) {
  PropBuilder b(name);
  // Greys and silvers are metallic paints, white, black and bright colours mostly plain.
  const float most = std::max({color.x, color.y, color.z}), least = std::min({color.x, color.y, color.z});
  const bool grey = most > 0.05f && most < 0.5f && least > 0.85f * most;
  const Material paint = CarPaint(color, grey ? 0.45f : 0.0f);
  AddCarBody(b, s, paint);
  AddDetails(b, s, paint);
  return b.Finish();
}

Model MakeCar(uint32_t variant, uint64_t) {
  // White, greys, black, silver are most of the cars on a street; a few are coloured.
  constexpr Vec3f colors[12] = {{0.68f, 0.68f, 0.66f},    {0.022f, 0.023f, 0.025f}, {0.33f, 0.34f, 0.35f}, {0.10f, 0.105f, 0.11f},
                                {0.28f, 0.018f, 0.015f},  {0.02f, 0.05f, 0.17f},    {0.60f, 0.60f, 0.58f}, {0.16f, 0.165f, 0.17f},
                                {0.012f, 0.013f, 0.015f}, {0.05f, 0.075f, 0.06f},   {0.42f, 0.42f, 0.41f}, {0.30f, 0.26f, 0.20f}};
  const CarShape* shapes[3] = {&Sedan(), &Suv(), &Hatchback()};
  return Assemble("car", *shapes[variant % 3], colors[variant]);
}

// A yellow cab with its sign on the roof.
Model MakeTaxi(uint32_t variant, uint64_t) {
  const CarShape& shape = variant % 2 ? Suv() : Sedan();
  Model model = Assemble("taxi", shape, {0.80f, 0.43f, 0.012f});
  PropBuilder b("taxi sign");
  const float roof = Lookup(shape.top, 0.15f);
  Canvas canvas(128, 48, {0.85f, 0.80f, 0.62f});
  canvas.Letters("TAXI", {0.5f, 0.5f}, 0.6f, {0.02f, 0.02f, 0.02f});
  b.Use(Plastic({0.02f, 0.02f, 0.02f}));
  b.BevelBox({-0.40f, 0.05f, roof - 0.03f}, {0.40f, 0.25f, roof + 0.20f}, 0.02f);
  Material sign = Paint({1, 1, 1});
  sign.emission = Vec3f{1, 1, 1} * (250 * kNit);
  sign.lamp = true;
  b.Use(sign, canvas.Finish("taxi sign"));
  b.Picture({-0.36f, 0.046f, roof}, {0.36f, 0.046f, roof}, {0.36f, 0.046f, roof + 0.18f}, {-0.36f, 0.046f, roof + 0.18f});
  b.Picture({0.36f, 0.254f, roof}, {-0.36f, 0.254f, roof}, {-0.36f, 0.254f, roof + 0.18f}, {0.36f, 0.254f, roof + 0.18f});
  Append(model, b.Finish());
  return model;
}

// Most are white, and no two whites are as old.
constexpr int kVans = 8;
constexpr Vec3f kVanColors[kVans] = {{0.68f, 0.68f, 0.67f},  {0.30f, 0.31f, 0.32f}, {0.04f, 0.08f, 0.15f}, {0.60f, 0.59f, 0.56f},
                                     {0.11f, 0.115f, 0.12f}, {0.72f, 0.72f, 0.71f}, {0.42f, 0.42f, 0.41f}, {0.05f, 0.075f, 0.06f}};

Model MakeVan(uint32_t variant, uint64_t) { return Assemble("van", PanelVan(), kVanColors[variant]); }

}  // namespace

std::vector<PropKind> CarKinds() {
  const std::vector<LibraryModel> cars = {
      {"suv", 0, 0, "firstcolor", {0.66f, 0.66f, 0.65f}},
      {"peugeot-308", 0, 0, "color-exterior", {0.36f, 0.37f, 0.38f}},
      {"renault-scenic", 0, 0, "color-beige-green", {0.45f, 0.47f, 0.50f}},
      {"seat_leon", 0, 0, "chapa_roja", {0.055f, 0.058f, 0.062f}},
      {"smart-car"},
      {"suv", 0, 0, "firstcolor", {0.020f, 0.021f, 0.023f}},
      {""},
      {"seat_leon", 0, 0, "chapa_roja", {0.26f, 0.016f, 0.014f}},
      {"peugeot-308", 0, 0, "color-exterior", {0.018f, 0.045f, 0.14f}},
      {"VW-new-beetle", 0, 0, "PAINT_yellow", {0.40f, 0.42f, 0.40f}},
      {"renault-scenic", 0, 0, "color-beige-green", {0.09f, 0.095f, 0.10f}},
      {"chevrolet", 0, 0, "firstcolor", {0.13f, 0.135f, 0.14f}},
  };
  constexpr Vec3f kCab{0.80f, 0.43f, 0.012f};
  const std::vector<LibraryModel> taxis = {
      {""}, {"suv", 0, 0, "firstcolor", kCab}, {""}, {"renault-scenic", 0, 0, "color-beige-green", kCab}};
  std::vector<LibraryModel> vans{{"van"}};
  for (int i = 1; i < kVans; ++i) vans.push_back({"van", 0, 0, "firstcolor", kVanColors[i]});
  return {
      {"car", "vehicle/car", 12, MakeCar, 2.5f, 1.2f, 2.0f, 8000, cars},
      {"taxi", "vehicle/car", 4, MakeTaxi, 2.5f, 1.2f, 2.3f, 8500, taxis},
      {"van", "vehicle/van", kVans, MakeVan, 3.1f, 2.2f, 2.8f, 8000, vans},
  };
}

}  // namespace airsim360::internal
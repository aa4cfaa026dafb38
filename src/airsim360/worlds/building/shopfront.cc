#include "airsim360/worlds/building/shopfront.h"

#include <algorithm>

namespace airsim360::internal {
namespace {

constexpr float kSignFrom = 3.15f, kSignTo = 3.85f;

void BuildAwning(FacadeContext& context, FacadePen& pen, float x0, float x1, RngStream& rng) {
  // Striped, and as many of one dull colour.
  static constexpr Surface kCloths[] = {Surface::kAwningRed, Surface::kAwningGreen, Surface::kAwningBlue,   Surface::kAwningYellow,
                                        Surface::kTrimDark,  Surface::kFrameGreen,  Surface::kShutterGreen, Surface::kBrownstoneTrim};
  const EntityId entity = context.builder.AddEntity("awning", context.builder.tree().At("construction/awning"));
  const float out = -static_cast<float>(rng.Uniform(1.1, 1.5)), top = kSignFrom - 0.02f, low = top - 0.62f;
  pen.UseEntity(entity);
  pen.Use(kCloths[rng.Index(8)]);
  // Cloth, valance and cheeks; two layers so that both sides show.
  MeshBuilder& mesh = pen.mesh();
  const float w = x1 - x0;
  mesh.QuadUv({x0, out, low}, {x1, out, low}, {x1, -0.03f, top}, {x0, -0.03f, top}, {0, 1.6f}, {w, 1.6f}, {w, 0}, {0, 0});
  mesh.QuadUv({x0, -0.03f, top - 0.03f}, {x1, -0.03f, top - 0.03f}, {x1, out, low - 0.03f}, {x0, out, low - 0.03f}, {0, 0}, {w, 0},
              {w, 1.6f}, {0, 1.6f});
  pen.Front(x0, x1, low - 0.22f, low, out);
  mesh.QuadUv({x1, out + 0.02f, low - 0.22f}, {x0, out + 0.02f, low - 0.22f}, {x0, out + 0.02f, low}, {x1, out + 0.02f, low}, {w, 0.2f},
              {0, 0.2f}, {0, 0}, {w, 0});
  mesh.Triangle({x0, -0.03f, low}, {x0, out, low}, {x0, -0.03f, top}, {0, 0}, {0.1f, 0}, {0, 0.1f});
  mesh.Triangle({x1, out, low}, {x1, -0.03f, low}, {x1, -0.03f, top}, {0, 0}, {0.1f, 0}, {0, 0.1f});
  // Arms.
  pen.Use(Surface::kFrameDark);
  for (float x : {x0 + 0.05f, x1 - 0.05f}) mesh.Beam({x, -0.02f, low - 0.5f}, {x, out + 0.05f, low - 0.05f}, 0.03f);
}

void BuildSign(FacadeContext& context, FacadePen& pen, float x0, float x1) {
  const float width = std::min(4.6f, x1 - x0), middle = (x0 + x1) / 2;
  // All of them before one comes again: the step has no factor in common with their number.
  context.next_sign = (context.next_sign + 57) % kSignCount;
  const SignBox box = ShopSignBox(context.next_sign);
  pen.UseEntity(context.builder.AddEntity("shop sign", context.builder.tree().At("signage/shop_sign")));
  pen.Use(Surface::kSigns);
  const float crop = std::min((1 - width / 5) / 2, 0.06f);  // narrower signs squeeze their letters
  pen.Picture(middle - width / 2, middle + width / 2, kSignFrom + 0.04f, kSignTo - 0.04f, -0.16f,
              {box.uv0.x + crop / kSignColumns, box.uv0.y}, {box.uv1.x - crop / kSignColumns, box.uv1.y});
}

constexpr float kPier = 0.38f, kHead = kSignFrom - 0.05f, kPost = 0.12f;

// Where the parts of a shop lie along the wall, and what they are made of.
struct Shop {
  float x0, x1;  // whole bay
  float a, b;    // between the piers
  float d0, d1;  // door
  float w0, w1;  // display window
  bool door_right;
  Surface inside, door;
};

Shop PlanShop(float x0, float x1, RngStream& rng) {
  static constexpr Surface kInsides[] = {Surface::kShopInside0, Surface::kShopInside1, Surface::kShopInside2};
  static constexpr Surface kDoors[] = {Surface::kDoorGreen, Surface::kDoorRed, Surface::kDoorWood, Surface::kFrameDark};
  Shop shop;
  shop.inside = kInsides[rng.Index(3)];
  shop.door = kDoors[rng.Index(4)];
  shop.door_right = rng.Chance(0.5);
  shop.x0 = x0;
  shop.x1 = x1;
  shop.a = x0 + kPier;
  shop.b = x1 - kPier;
  const float door_width = std::min(1.15f, (shop.b - shop.a) * 0.4f);
  shop.d0 = shop.door_right ? shop.b - door_width : shop.a;
  shop.d1 = shop.d0 + door_width;
  shop.w0 = shop.door_right ? shop.a : shop.d1 + kPost;
  shop.w1 = shop.door_right ? shop.d0 - kPost : shop.b;
  return shop;
}

// Piers with plinth blocks, wall and a course above the fascia.
void BuildPiers(FacadePen& pen, const GroundFloor& floor, const Shop& shop) {
  for (float x : {shop.x0, shop.b}) {
    pen.Use(floor.trim);
    pen.Bar(x, x + kPier, 0.45f, kSignTo, -0.10f, 0.35f, true, false);
    pen.Use(Surface::kGranite);
    pen.Bar(x - 0.02f, x + kPier + 0.02f, 0, 0.45f, -0.13f, 0.35f, true, false);
  }
  pen.Use(floor.wall);
  pen.Front(shop.x0, shop.x1, kSignTo, floor.height, 0);
  pen.Use(floor.trim);
  pen.Bar(shop.x0, shop.x1, kSignTo, kSignTo + 0.14f, -0.24f, 0, true, true);
}

// Display window over a stall riser, the shop behind it.
void BuildDisplay(FacadePen& pen, const GroundFloor& floor, const Shop& shop, RngStream& rng) {
  const float w0 = shop.w0, w1 = shop.w1;
  pen.Use(shop.door);
  pen.Bar(w0, w1, 0, 0.5f, 0.02f, 0.25f, true, false);
  pen.Use(floor.frame);
  pen.Bar(w0, w1, 0.5f, 0.58f, 0.0f, 0.2f, false, false);
  for (float x : {w0, (w0 + w1) / 2, w1 - 0.06f}) {
    pen.Front(x, x + 0.06f, 0.58f, kHead, 0.06f);
    pen.Left(x, 0.06f, 0.12f, 0.58f, kHead);
    pen.Right(x + 0.06f, 0.06f, 0.12f, 0.58f, kHead);
  }
  pen.Bar(w0, w1, 2.55f, 2.62f, 0.05f, 0.12f, false, true);
  const float u0 = static_cast<float>(rng.Uniform(0, 0.5)), span = std::min(1.0f, (w1 - w0) / 5);
  pen.Use(shop.inside);
  pen.Picture(w0, w1, 0.58f, kHead, 0.12f, {u0, 0}, {u0 + span, 1});
}

// Door set back behind a threshold, and the post between it and the display window.
void BuildDoor(FacadePen& pen, const GroundFloor& floor, const Shop& shop) {
  const float back = 0.95f, d0 = shop.d0, d1 = shop.d1, l = d0 + 0.12f, r = d1 - 0.12f;
  pen.Use(Surface::kGranite);
  pen.Up(d0, d1, 0, back, 0.03f);
  pen.Front(d0, d1, 0, 0.03f, 0);
  pen.Use(floor.trim);
  pen.Down(d0, d1, 0, back, kHead);
  // Cheeks: glass towards the display window.
  pen.Use(shop.door_right ? shop.inside : floor.trim);
  pen.Right(d0, 0.12f, back, 0.03f, kHead);
  pen.Use(shop.door_right ? floor.trim : shop.inside);
  pen.Left(d1, 0.12f, back, 0.03f, kHead);
  // Leaf with two panes and a handle.
  pen.Use(shop.door);
  pen.Front(d0, l, 0.03f, kHead, back);
  pen.Front(r, d1, 0.03f, kHead, back);
  pen.Front(l, r, 0.03f, 0.75f, back);
  pen.Front(l, r, 2.15f, 2.3f, back);
  pen.Reveal(l, r, 0.75f, 2.15f, back, back + 0.03f);
  pen.Reveal(l, r, 2.3f, kHead, back, back + 0.03f);
  pen.Use(shop.inside);
  pen.Picture(l, r, 0.75f, 2.15f, back + 0.03f, {0.3f, 0.3f}, {0.5f, 0.8f});
  pen.Picture(l, r, 2.3f, kHead, back + 0.03f, {0.3f, 0.02f}, {0.5f, 0.2f});
  pen.Use(Surface::kMetal);
  pen.Bar(d0 + 0.16f, d0 + 0.19f, 0.95f, 1.35f, back - 0.06f, back);
  pen.Use(floor.frame);
  const float post = shop.door_right ? d0 - kPost : d1;
  pen.Bar(post, post + kPost, 0, kHead, 0.0f, 0.2f, true, false);
}

}  // namespace

void BuildShop(FacadeContext& context, FacadePen& pen, const GroundFloor& floor, float x0, float x1, RngStream& rng) {
  const Shop shop = PlanShop(x0, x1, rng);
  pen.UseEntity(floor.entity);
  BuildPiers(pen, floor, shop);
  pen.Use(floor.frame);
  pen.Bar(shop.a, shop.b, kHead, kSignTo, -0.12f, 0.3f, false, true);
  BuildSign(context, pen, shop.a + 0.1f, shop.b - 0.1f);
  pen.UseEntity(floor.entity);
  BuildDisplay(pen, floor, shop, rng);
  BuildDoor(pen, floor, shop);
  if (rng.Chance(0.45) && floor.plan.awnings) BuildAwning(context, pen, shop.a, shop.b, rng);
  pen.UseEntity(floor.entity);
}

void BuildLobby(FacadePen& pen, const GroundFloor& floor, float x0, float x1) {
  const float top = floor.height - 0.6f, y = 0.35f;
  pen.Use(floor.trim);
  for (float x : {x0, x1 - 0.4f}) pen.Bar(x, x + 0.4f, 0, top, -0.06f, y + 0.1f, true, false);
  pen.Front(x0, x1, top, floor.height, 0);
  pen.Down(x0, x1, 0, y + 0.1f, top);
  // Glass from floor to ceiling in four leaves.
  const float a = x0 + 0.4f, b = x1 - 0.4f;
  pen.Use(Surface::kShopInside2);
  pen.Picture(a, b, 0.1f, top, y, {0.05f, 0}, {0.7f, 1});
  pen.Use(floor.frame);
  pen.Bar(a, b, 0, 0.1f, y - 0.08f, y, false, false);
  pen.Bar(a, b, 2.5f, 2.62f, y - 0.08f, y, false, true);
  for (int i = 0; i <= 4; ++i) {
    const float x = a + (b - a - 0.07f) * static_cast<float>(i) / 4;
    pen.Bar(x, x + 0.07f, 0.1f, top, y - 0.08f, y, true, false);
  }
  // Canopy.
  pen.Use(Surface::kPanelDark);
  pen.Bar(a, b, 2.95f, 3.15f, -1.5f, y - 0.08f);
}

}  // namespace airsim360::internal

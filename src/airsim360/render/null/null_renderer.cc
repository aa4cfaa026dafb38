#include <string>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

constexpr Rgb8 kSkyColor{135, 180, 235};

class NullRenderer : public Renderer {
 public:
  explicit NullRenderer(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {}

  RenderStats Render(const RenderRequest& request, Frame& frame) override {
    const int width = Width(request.camera), height = Height(request.camera);
    if (width <= 0 || height <= 0) {
      throw InputError("camera of " + std::to_string(width) + "x" + std::to_string(height) + " pixels");
    }
    const EntityId sky = scene_->sky_entity;
    const CategoryId category = sky == kNoEntity ? kVoid : scene_->entity(sky).category;
    const Products& products = request.products;
    const auto fill = [&](auto& image, bool wanted, auto value) {
      image = wanted ? std::remove_reference_t<decltype(image)>(width, height, value) : std::remove_reference_t<decltype(image)>();
    };
    fill(frame.rgb, products.rgb && request.tier != Tier::kLabels, kSkyColor);
    fill(frame.range, products.range, 0.0f);
    fill(frame.semantic, products.semantic, category);
    fill(frame.entity, products.entity, sky);
    fill(frame.normal, products.normal, Vec3f{});
    fill(frame.radiance, products.radiance && request.tier != Tier::kLabels, Rgb32f{1, 1, 1});
    frame.exposure = 1;
    fill(frame.position, products.position, Vec3f{});
    fill(frame.albedo, products.albedo, Rgb32f{});
    fill(frame.material, products.material, uint16_t{0});
    fill(frame.flow, products.flow, FlowPixel{});
    fill(frame.coverage, products.coverage, CoveragePixel{{sky}, {1.0f}});
    return {};
  }

 private:
  std::shared_ptr<const Scene> scene_;
};

}  // namespace

std::unique_ptr<Renderer> MakeNullRenderer(std::shared_ptr<const Scene> scene) { return std::make_unique<NullRenderer>(std::move(scene)); }

}  // namespace airsim360

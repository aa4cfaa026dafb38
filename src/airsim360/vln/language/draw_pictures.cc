#include <cmath>
#include <numbers>

#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/image/codecs.h"
#include "airsim360/vln/language/make_language.h"
#include "airsim360/vln/language/sight.h"

namespace airsim360 {

void DrawPictures(Stage& stage, const std::vector<LanguagePicture>& pictures, const RenderSettings& settings,
                  const std::filesystem::path& folder) {
  constexpr int kQuality = 90;
  ProgressBar bar("language pictures", static_cast<int64_t>(pictures.size()));
  Renderer& renderer = stage.renderer(settings.tier);
  Frame frame;
  int64_t done = 0;
  for (const LanguagePicture& p : pictures) {
    const std::filesystem::path file = folder / p.file;
    if (!std::filesystem::exists(file)) {
      const internal::Picture picture{p.panorama, p.azimuth_deg, {p.position, p.yaw_deg * std::numbers::pi / 180}, p.width, p.height};
      RenderRequest request;
      static_cast<RenderSettings&>(request) = settings;
      request.camera = picture.camera();
      request.X_WC = picture.X_WC();
      request.products = {.rgb = true, .range = false, .semantic = false, .entity = false};
      renderer.Render(request, frame);
      CreateWritableFolder(file.parent_path());
      WriteFileAtomically(file, EncodeJpeg(frame.rgb, kQuality));
    }
    bar.Update(++done);
  }
}

}  // namespace airsim360

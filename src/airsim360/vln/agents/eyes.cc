#include "airsim360/vln/agents/eyes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/image/codecs.h"
#include "airsim360/math/angles.h"
#include "airsim360/tasks/agent_server/agent_action.h"

namespace airsim360 {
namespace {

constexpr int kRecogniserWidth = 512;  // of its panorama: as SeenAtStart
constexpr int kQuality = 85;

// Digits of 3 x 5 pixels, a row in three bits.
constexpr std::array<std::array<int, 5>, 11> kDigits = {{{7, 5, 5, 5, 7},
                                                         {2, 6, 2, 2, 7},
                                                         {7, 1, 7, 4, 7},
                                                         {7, 1, 7, 1, 7},
                                                         {5, 5, 7, 1, 1},
                                                         {7, 4, 7, 1, 7},
                                                         {7, 4, 7, 5, 7},
                                                         {7, 1, 2, 2, 2},
                                                         {7, 5, 7, 5, 7},
                                                         {7, 5, 7, 1, 7},
                                                         {0, 0, 7, 0, 0}}};

void Dot(Image<Rgb8>& image, int x, int y, int size, Rgb8 colour) {
  for (int dy = 0; dy < size; ++dy)
    for (int dx = 0; dx < size; ++dx)
      if (y + dy >= 0 && y + dy < image.height()) image((x + dx + image.width()) % image.width(), y + dy) = colour;
}

void Write(Image<Rgb8>& image, int x, int y, int size, const std::string& text) {
  for (const char c : text) {
    const auto& rows = kDigits[c == '-' ? 10 : static_cast<size_t>(c - '0')];
    for (int row = 0; row < 5; ++row)
      for (int column = 0; column < 3; ++column)
        if (rows[row] & (4 >> column)) Dot(image, x + column * size, y + row * size, size, {255, 255, 0});
    x += 4 * size;
  }
}

// A tick every 30 degrees at the top and the bottom, with its azimuth.
void MarkAzimuths(Image<Rgb8>& image) {
  const int size = std::max(1, image.width() / 512), w = image.width();
  for (int azimuth = -150; azimuth <= 180; azimuth += 30) {
    const int x = static_cast<int>((azimuth / 360.0 + 0.5) * w) % w;
    for (int y = 0; y < 6 * size; y += size) {
      Dot(image, x, y, size, {255, 255, 0});
      Dot(image, x, image.height() - 1 - y, size, {255, 255, 0});
    }
    const std::string text = std::to_string(azimuth);
    Write(image, x - 2 * size * static_cast<int>(text.size()), 8 * size, size, text);
  }
}

}  // namespace

struct Eyes::Shot {
  std::string name;
  double azimuth = 0, elevation = 0;  // rad, of the camera to the level heading
  Camera camera;
  RigidTransform X_WC;
};

Eyes::Eyes(std::shared_ptr<SharedRenderers> renderers, VlnView view, const RenderSettings& picture, int width)
    : renderers_(std::move(renderers)), view_(view), picture_(picture), width_(width) {}

Eyes::~Eyes() = default;

std::vector<Eyes::Shot> Eyes::Shots(const RigidTransform& X_WB, int width) const {
  const double yaw = HeadingOfBody(X_WB);
  if (view_ == VlnView::kErp) return {{"erp", 0, 0, Equirectangular{width, width / 2}, BodyPose(X_WB.p, yaw, 0, 0) * CameraInBody()}};
  struct Face {
    const char* name;
    double azimuth, elevation;
  };
  static constexpr Face kFaces[] = {{"front", 0, 0}, {"right", 90, 0}, {"back", 180, 0}, {"left", -90, 0}, {"up", 0, 90}, {"down", 0, -90}};
  const int side = width / 2;
  std::vector<Shot> shots;
  for (const Face& face : kFaces) {
    const double azimuth = face.azimuth * kDegree, elevation = face.elevation * kDegree;
    shots.push_back({face.name, azimuth, elevation, Pinhole{side, side, side / 2.0, side / 2.0, side / 2.0, side / 2.0},
                     BodyPose(X_WB.p, yaw - azimuth, elevation, 0) * CameraInBody()});
    if (view_ == VlnView::kFront) break;
  }
  return shots;
}

SeenAtStart Eyes::Recognise(const RigidTransform& X_WB, const std::vector<EntityId>& entities,
                            const std::shared_ptr<const SceneState>& moved) {
  SeenAtStart seen;
  Vec3d sum;  // of directions in the level heading frame
  for (const Shot& shot : Shots(X_WB, kRecogniserWidth)) {
    RenderRequest request =
        MakeRequest(shot.camera, shot.X_WC, Tier::kLabels, {.rgb = false, .range = true, .semantic = false, .entity = true});
    request.state = moved;
    renderers_->Render("", request, frame_);
    const int w = frame_.entity.width(), h = frame_.entity.height();
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        if (!std::ranges::binary_search(entities, frame_.entity(x, y))) continue;
        Vec3d d;
        if (view_ == VlnView::kErp) {
          const double a = 2 * kPi * ((x + 0.5) / w - 0.5), e = kPi * (0.5 - (y + 0.5) / h);
          d = {std::cos(e) * std::cos(a), -std::cos(e) * std::sin(a), std::sin(e)};
        } else {
          const Vec3d ray = Normalized(Vec3d{1, 1 - 2 * (x + 0.5) / w, 1 - 2 * (y + 0.5) / h});
          d = BodyPose({}, -shot.azimuth, shot.elevation, 0).R * ray;
        }
        sum += d;
        const double range = frame_.range(x, y);
        if (range > 0 && (seen.range == 0 || range < seen.range)) seen.range = range;
        ++seen.pixels;
      }
    }
  }
  if (seen.pixels == 0) return seen;
  seen.azimuth_deg = -std::atan2(sum.y, sum.x) / kDegree;
  seen.elevation_deg = std::atan2(sum.z, std::hypot(sum.x, sum.y)) / kDegree;
  return seen;
}

std::vector<VlnPicture> Eyes::Pictures(const RigidTransform& X_WB, const std::string& weather,
                                       const std::shared_ptr<const SceneState>& moved) {
  std::vector<VlnPicture> pictures;
  for (const Shot& shot : Shots(X_WB, width_)) {
    RenderRequest request{picture_, shot.camera, shot.X_WC};
    request.products = {.rgb = true, .range = false, .semantic = false, .entity = false};
    request.state = moved;
    renderers_->Render(weather, request, frame_);
    Image<Rgb8> image = frame_.rgb;
    if (view_ == VlnView::kErp) MarkAzimuths(image);
    const Bytes jpeg = EncodeJpeg(image, kQuality);
    pictures.push_back({shot.name, image.width(), image.height(), std::string(AsText(jpeg))});
  }
  return pictures;
}

}  // namespace airsim360

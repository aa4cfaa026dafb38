#include "airsim360/app/view/followed_server.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>
#include <nlohmann/json.hpp>

#include "airsim360/app/rpc_client.h"
#include "airsim360/app/view/followed_pictures.h"
#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/rpc/wire/airsim_image_types.h"
#include "airsim360/view/live_messages.h"
#include "airsim360/view/planes.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

constexpr float kMoveSeconds = 0.5F;  // after which a drone that is told nothing stops
constexpr const char* kCameras[] = {"panorama_original", "panorama_depth", "panorama_entity"};

// What simGetImages gives of one panorama.
struct Panorama {
  int width = 0, height = 0;
  std::string bytes;
};

void WriteRequests(WireWriter& writer, const std::string& vehicle) {
  writer.ArrayHeader(std::size(kCameras));
  for (const char* camera : kCameras) {
    const bool is_depth = std::string_view(camera) == "panorama_depth";
    writer.MapHeader(6);
    writer.String("camera_name"), writer.String(camera);
    writer.String("image_type"), writer.Int(0);
    writer.String("pixels_as_float"), writer.Bool(is_depth);
    writer.String("compress"), writer.Bool(false);
    writer.String("annotation_name"), writer.String("");
    writer.String("binary_float"), writer.Bool(is_depth);
  }
  writer.String(vehicle);
  writer.Bool(false);
}

Panorama PanoramaOf(const WireValue& image, const char* pixels, size_t pixel_bytes) {
  Panorama panorama;
  const WireValue *width = image.Find("width"), *height = image.Find("height"), *data = image.Find(pixels);
  if (!width || !height || !data) throw RuntimeError("the server's pictures are not understood");
  FromWire(*width, panorama.width), FromWire(*height, panorama.height);
  const bool fits = panorama.width > 0 && panorama.height > 0 && panorama.width <= 8192 && panorama.height <= 4096 &&
                    data->text.size() == static_cast<size_t>(panorama.width) * static_cast<size_t>(panorama.height) * pixel_bytes;
  if (!fits) throw RuntimeError("the server's pictures have another size than they say");
  panorama.bytes = data->text;
  return panorama;
}

// Blue, green, red.
Image<Rgb8> ColorsOf(const Panorama& panorama) {
  Image<Rgb8> rgb(panorama.width, panorama.height);
  const auto* bytes = reinterpret_cast<const uint8_t*>(panorama.bytes.data());
  for (size_t i = 0; i < rgb.size(); ++i) rgb.pixels()[i] = {bytes[3 * i + 2], bytes[3 * i + 1], bytes[3 * i]};
  return rgb;
}

// A camera of AirSim looks along its x axis and has z down; C looks along z and has y down.
Mat3d CameraRotation(const Mat3d& R_WB) {
  const Vec3d ahead = R_WB.column(0), left = R_WB.column(1), up = R_WB.column(2);
  Mat3d R;
  for (int i = 0; i < 3; ++i) R.m[i][0] = -left[i], R.m[i][1] = -up[i], R.m[i][2] = ahead[i];
  return R;
}

}  // namespace

bool IsAirSimServer(const std::string& address) {
  RpcClient client(address);
  try {
    client.Call(
        "ping", 0, [](WireWriter&) {}, [](const WireValue&) {});
    return true;
  } catch (const InputError&) {
    return true;  // it answers, if only that it does not know the call
  } catch (const RuntimeError&) {
    return false;
  }
}

struct FollowedServer::Impl {
  explicit Impl(const FollowOptions& given) : options(given), client(given.address), moves(given.address) {}

  SocketMessage Do(const Json& message, bool may_fly);
  SocketMessage Picture();
  SocketMessage Planes(const Json& message);
  void Fly(const Json& input);
  void Control(bool enabled);
  std::string HeaderOf(const WireValue& image);

  FollowOptions options;
  RpcClient client, moves;  // a move is answered when it ends
  std::mutex mutex;         // of what follows
  int64_t next_number = 1;
  FollowedPictures pictures;
};

void FollowedServer::Impl::Control(bool enabled) {
  client.Call(
      "enableApiControl", 2, [&](WireWriter& w) { w.Bool(enabled), w.String(options.vehicle); }, [](const WireValue&) {});
}

void FollowedServer::Impl::Fly(const Json& input) {
  const auto [ahead, left, up, turn] = SticksOf(input);
  if (ahead == 0 && left == 0 && up == 0 && turn == 0) return;
  moves.Post("moveByVelocityBodyFrame", 7, [&](WireWriter& w) {
    w.Float(static_cast<float>(ahead * kStickSpeed)), w.Float(static_cast<float>(-left * kStickSpeed)),
        w.Float(static_cast<float>(-up * kStickSpeed));
    w.Float(kMoveSeconds), w.Int(0);
    w.MapHeader(2), w.String("is_rate"), w.Bool(true), w.String("yaw_or_rate"),
        w.Float(static_cast<float>(-turn * kStickTurnRate / kDegree));
    w.String(options.vehicle);
  });
}

// Pose and time of a picture, as fields of the header.
std::string FollowedServer::Impl::HeaderOf(const WireValue& image) {
  airsim::Pose pose;
  uint64_t stamp = 0;
  if (const WireValue* p = image.Find("camera_position")) FromWire(*p, pose.position);
  if (const WireValue* q = image.Find("camera_orientation")) FromWire(*q, pose.orientation);
  if (const WireValue* t = image.Find("time_stamp")) FromWire(*t, stamp);
  const RigidTransform X_WB = airsim::FromPose(pose, {});
  const Quaternion q = ToQuaternion(CameraRotation(X_WB.R));
  const Json fields{{"number", next_number},
                    {"t", 1e-9 * static_cast<double>(stamp)},
                    {"p", {X_WB.p.x, X_WB.p.y, X_WB.p.z}},
                    {"q", {q.w, q.x, q.y, q.z}}};
  const std::string text = fields.dump();
  return text.substr(1, text.size() - 2);
}

SocketMessage FollowedServer::Impl::Picture() {
  PlaneMessage planes;
  SocketMessage answer;
  Frame next;
  client.Call(
      "simGetImages", 3, [&](WireWriter& w) { WriteRequests(w, options.vehicle); },
      [&](const WireValue& images) {
        if (images.items.size() != std::size(kCameras)) throw RuntimeError("the server's pictures are not understood");
        next.rgb = ColorsOf(PanoramaOf(images.items[0], "image_data_uint8", 3));
        const Panorama range = PanoramaOf(images.items[1], "image_data_float", sizeof(float)),
                       entity = PanoramaOf(images.items[2], "image_data_uint8", 3);
        next.range = Image<float>(range.width, range.height);
        std::memcpy(next.range.pixels().data(), range.bytes.data(), range.bytes.size());
        const Image<Rgb8> ids = ColorsOf(entity);
        next.entity = Image<EntityId>(entity.width, entity.height);
        for (size_t i = 0; i < ids.size(); ++i)
          next.entity.pixels()[i] = ids.pixels()[i].r + 256U * ids.pixels()[i].g + 65536U * ids.pixels()[i].b;
        const std::lock_guard lock(mutex);
        planes.AddPicture(next.rgb);
        planes.AddProduct(next, "range");
        planes.AddProduct(next, "entity");
        answer = {planes.Finish(HeaderOf(images.items[0])), true};
        pictures.Add(next_number++, std::move(next));
      });
  return answer;
}

SocketMessage FollowedServer::Impl::Planes(const Json& message) {
  const std::lock_guard lock(mutex);
  const auto number = message.value("number", int64_t{0});
  return pictures.Planes(number);
}

SocketMessage FollowedServer::Impl::Do(const Json& message, bool may_fly) {
  const std::string what = message.value("do", "");
  if (what == "planes") return Planes(message);
  if (what != "picture") throw InputError("do: '" + what + "' is none of picture, planes: the world is elsewhere");
  if (options.lease && message.contains("input")) {
    if (!may_fly) throw InputError("token: flying needs the page's token");
    Fly(message["input"]);
  }
  return Picture();
}

FollowedServer::FollowedServer(const FollowOptions& options) : impl_(std::make_unique<Impl>(options)) {
  impl_->client.Call(
      "listVehicles", 0, [](WireWriter&) {},
      [&](const WireValue& names) {
        std::vector<std::string> all;
        for (const WireValue& name : names.items) all.emplace_back(name.text);
        if (all.empty()) throw InputError("--connect: the server at " + options.address + " has no vehicles");
        if (impl_->options.vehicle.empty()) impl_->options.vehicle = all.front();
        if (std::ranges::find(all, impl_->options.vehicle) == all.end())
          throw InputError("--vehicle: " + UnknownChoiceMessage("vehicle", impl_->options.vehicle, all));
      });
  if (options.lease) impl_->Control(true);
}

FollowedServer::~FollowedServer() {
  if (!impl_ || !impl_->options.lease) return;
  try {
    impl_->Control(false);
  } catch (const std::exception&) {
    // The server is gone: there is nothing to give back.
  }
}

std::string FollowedServer::DescriptionJson() const {
  return Json{{"world", impl_->options.vehicle + " at " + impl_->options.address},
              {"products", {"range", "entity"}},
              {"scale", {kNearestColor, kFarthestColor}},
              {"weathers", Json::array()},
              {"keeps", false},
              {"flies", impl_->options.lease},
              {"follows", true},
              {"categories", Json::array()}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string FollowedServer::EntitiesJson() const {
  Json entities = Json::object();
  impl_->client.Call(
      "simListInstanceSegmentationObjects", 0, [](WireWriter&) {},
      [&](const WireValue& names) {
        for (size_t i = 0; i < names.items.size(); ++i)
          entities[std::to_string(i + 1)] = {{"name", names.items[i].text}, {"category_path", ""}, {"kind", "thing"}};
      });
  return entities.dump(-1, ' ', false, Json::error_handler_t::replace);
}

SocketMessage FollowedServer::Answer(std::string_view text, const std::string& token) {
  const bool tangled = std::ranges::count(text, '[') + std::ranges::count(text, '{') > 16;
  return AnswerMessage<Json>(tangled ? "" : text, {}, token,
                             [&](const Json& message, bool may_fly) { return impl_->Do(message, may_fly); });
}

}  // namespace airsim360

#include "airsim360/rpc/images/image_service.h"

#include <algorithm>
#include <chrono>

#include "airsim360/base/freed_memory.h"
#include "airsim360/render/relightable.h"
#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/rpc/wire/limits.h"

namespace airsim360 {
namespace {

// Optical flow leads to where things are after one frame of simContinueForFrames.
constexpr double kFlowSeconds = 1e-9 * kFrameNs;

// Cameras made here are panoramas, or pinholes with square pixels and the middle as principal point.
bool SameProjection(const Camera& a, const Camera& b) {
  if (a.index() != b.index() || Width(a) != Width(b) || Height(a) != Height(b)) return false;
  const auto *first = std::get_if<Pinhole>(&a), *second = std::get_if<Pinhole>(&b);
  return first == nullptr || first->fx == second->fx;
}

}  // namespace

// One rendering: what requests with the same camera and projection share.
struct ImageService::Shot {
  Camera camera;
  RigidTransform X_WA;
  size_t self = kNobody;  // the vehicle that looks
  RigidTransform X_BA;    // of the camera on it
  Products products;
  std::vector<std::pair<size_t, ImageContent>> requests;  // index and what it shows
};

RigidTransform CameraPoseIn(const Snapshot& snapshot, size_t vehicle, const CameraSetup& camera) {
  return snapshot.state.vehicles[vehicle].motion.X_WB * camera.X_BA;
}

ImageService::ImageService(Session& session, Stage& stage, const RenderSettings& picture)
    : session_(session), stage_(stage), picture_(picture), ray_tracers_(stage.tracer()) {
  const SnapshotPointer snapshot = session_.snapshot();
  MakeRendererFor(*snapshot->world);
  thread_ = std::thread([this] { Run(); });
}

ImageService::~ImageService() { Stop(); }

void ImageService::Stop() {
  jobs_.Stop();
  if (thread_.joinable()) thread_.join();
}

void ImageService::Post(uint64_t client, Job job) { jobs_.Post(client, std::move(job)); }

void ImageService::Trigger(const std::string& vehicle, SnapshotPointer snapshot) {
  const std::lock_guard lock(mutex_);
  triggered_[vehicle] = std::move(snapshot);
}

void ImageService::Run() {
  constexpr std::chrono::seconds kPause{1};  // without a job: nobody is in a hurry
  while (!jobs_.stopped()) {
    const std::optional<Job> job = holds_memory_ ? jobs_.NextWithin(kPause) : jobs_.Next();
    if (job) {
      (*job)(*this);
      holds_memory_ = true;
    } else if (holds_memory_ && !jobs_.stopped()) {
      GiveBackMemory();
    }
  }
}

// Images and blocks are kept from one picture to the next, large ones not for ever.
void ImageService::GiveBackMemory() {
  constexpr int64_t kSmall = 2048 * 1024;  // pixels
  if (frame_pixels_ > kSmall) {
    // Renderers keep images of the last size: a tiny picture takes their place.
    frame_ = {};
    frame_pixels_ = 0;
    renderer_->Render(MakeRequest(Equirectangular{16, 8}, {}, picture_.tier), frame_);
  }
  pool_.Rest();
  ReturnFreedMemory();
  holds_memory_ = false;
}

void ImageService::FollowEnvironment(const WorldView& world) {
  if (renderer_ != nullptr && world.environment_version == environment_version_) return;
  auto* relightable = dynamic_cast<Relightable*>(renderer_.get());
  if (relightable == nullptr || !relightable->SetEnvironment(world.environment)) return MakeRendererFor(world);
  environment_version_ = world.environment_version;
}

void ImageService::MakeRendererFor(const WorldView& world) {
  renderer_.reset();  // a GPU need not hold two
  renderer_ = stage_.NewRenderer(picture_.tier, world.environment);
  environment_version_ = world.environment_version;
}

// What has moved, as vehicle `self` sees it: objects, people, and the bodies of the other drones.
std::shared_ptr<const SceneState> ImageService::StateOf(const Snapshot& snapshot, size_t self) const {
  return WithObjects(snapshot, SceneStateOf(*snapshot.model, snapshot.state, self));
}

// Adds the objects that calls have moved.
std::shared_ptr<const SceneState> ImageService::WithObjects(const Snapshot& snapshot, std::shared_ptr<const SceneState> bodies) const {
  if (snapshot.world->places.empty()) return bodies;
  auto state = bodies ? std::make_shared<SceneState>(*bodies) : std::make_shared<SceneState>();
  for (const auto& [entity, place] : snapshot.world->places) session_.objects().Move(entity, place, state->moved);
  std::sort(state->moved.begin(), state->moved.end(),
            [](const MovedInstance& a, const MovedInstance& b) { return a.instance < b.instance; });
  return state;
}

std::shared_ptr<const RayTracer> ImageService::TracerOf(const Snapshot& snapshot, size_t vehicle) {
  return ray_tracers_.At(StateOf(snapshot, vehicle));
}

const Frame& ImageService::RenderShot(const Snapshot& snapshot, const Shot& shot) {
  FollowEnvironment(*snapshot.world);
  RenderRequest request{picture_, shot.camera, shot.X_WA * CameraInBody(), shot.products};
  // Without colours there is no shading to be paid for.
  if (!shot.products.rgb) request.tier = Tier::kLabels;
  request.state = StateOf(snapshot, shot.self);
  if (shot.products.flow) {
    const NextTrigger next = InstantAfter(*snapshot.model, snapshot.state, shot.self, kFlowSeconds);
    const bool carried = shot.self != kNobody;
    request.X_WC_next = (carried ? next.X_WB * shot.X_BA : shot.X_WA) * CameraInBody();
    request.next_state = WithObjects(snapshot, next.state);
  }
  frame_pixels_ = std::max(frame_pixels_, int64_t{Width(shot.camera)} * Height(shot.camera));
  render_ms_ += renderer_->Render(request, frame_).render_ms;
  return frame_;
}

airsim::ImageResponse ImageService::Respond(const airsim::ImageRequest& request, ImageContent content, const Snapshot& snapshot,
                                            const Shot& shot, Vec3d origin_W, LentRegion* region) {
  airsim::ImageResponse response;
  response.camera_name = request.camera_name.text;
  response.image_type = request.image_type;
  response.pixels_as_float = request.pixels_as_float;
  response.compress = request.compress;
  response.annotation_name = request.annotation_name;
  response.width = Width(shot.camera);
  response.height = Height(shot.camera);
  response.time_stamp = snapshot.time_stamp();
  const airsim::Pose pose = airsim::ToPose(shot.X_WA, origin_W);
  response.camera_position = pose.position;
  response.camera_orientation = pose.orientation;
  if (request.image_type == airsim::ImageType::kScene) response.exposure_factor = frame_.exposure;

  const AirSimSettings& settings = session_.settings();
  PixelOptions options{.half_depth = !settings.float32_depth && !request.binary_float && std::holds_alternative<Pinhole>(shot.camera),
                       .centimetres = settings.depth_in_centimetres && content == ImageContent::kRange,
                       .rgb_order = settings.cosys,
                       .segmentation = &snapshot.world->segmentation};
  const auto layer = snapshot.world->annotations.find(request.annotation_name);
  if (layer != snapshot.world->annotations.end()) options.annotation = &layer->second;
  const TakeBytes take = [&](size_t size) {
    std::shared_ptr<char[]> lent = region != nullptr ? region->Take(size) : nullptr;
    return lent ? lent : pool_.Take(size);
  };
  if (request.pixels_as_float) {
    response.image_data_float = FloatBytesOf(content, frame_, shot.camera, options, request.binary_float, take);
  } else if (request.compress) {
    response.image_data_uint8.bytes = WireBlock(PngOf(content, frame_, shot.camera, options));
  } else {
    response.image_data_uint8.bytes = BytePixelsOf(content, frame_, shot.camera, options, take);
  }
  return response;
}

// Bytes of all pictures of a call whose size is known before they are made and that do not fit in lent memory.
size_t ImageService::SocketBytes(const std::vector<Shot>& shots, const std::vector<airsim::ImageRequest>& requests,
                                 const LentRegion* region) {
  std::optional<LentRegion> trial;
  if (region != nullptr) trial = *region;
  size_t bytes = 0;
  for (const Shot& shot : shots) {
    for (const auto& [i, content] : shot.requests) {
      const airsim::ImageRequest& request = requests[i];
      if (!request.pixels_as_float && request.compress) continue;
      const size_t size = PixelBytes(content, shot.camera, request.pixels_as_float, request.binary_float);
      if (!trial || !trial->Take(size)) bytes += size;
    }
  }
  return bytes;
}

// Requests that the same rays can answer are one shot.
std::vector<ImageService::Shot> ImageService::PlanShots(const std::vector<airsim::ImageRequest>& requests, const Snapshot& snapshot,
                                                        size_t vehicle, bool external) const {
  const CameraMap& cameras = external ? snapshot.world->external_cameras : snapshot.world->cameras[vehicle];
  std::vector<Shot> shots;
  for (size_t i = 0; i < requests.size(); ++i) {
    const airsim::ImageType type = requests[i].image_type;
    if (static_cast<unsigned>(type) >= static_cast<unsigned>(airsim::ImageType::kCount)) {
      throw std::invalid_argument("image_type " + std::to_string(static_cast<int>(type)) + " is not in 0 ... 11");
    }
    const CameraSetup& camera = FindCamera(cameras, requests[i].camera_name.text);
    Shot shot;
    shot.camera = ProjectionOf(camera, type);
    shot.products.rgb = false;
    if (external) {
      shot.X_WA = airsim::FromPose(airsim::ToMount(camera.X_BA), session_.origin_W());
    } else {
      shot.X_WA = CameraPoseIn(snapshot, vehicle, camera);
      shot.self = vehicle;
      shot.X_BA = camera.X_BA;
    }
    const auto same = std::find_if(shots.begin(), shots.end(), [&](const Shot& other) {
      return SameProjection(other.camera, shot.camera) && other.X_WA.p == shot.X_WA.p && other.X_WA.R == shot.X_WA.R;
    });
    Shot& chosen = same == shots.end() ? shots.emplace_back(std::move(shot)) : *same;
    const ImageContent content = ContentOf(camera, type);
    AddProducts(content, chosen.products);
    chosen.requests.emplace_back(i, content);
  }
  return shots;
}

// Where a panorama is asked for, everything is of the instant of its trigger.
SnapshotPointer ImageService::InstantFor(const std::vector<airsim::ImageRequest>& requests, const SnapshotPointer& now, size_t vehicle) {
  const bool panorama = std::any_of(requests.begin(), requests.end(), [&](const airsim::ImageRequest& request) {
    const CameraSetup& camera = FindCamera(now->world->cameras[vehicle], request.camera_name.text);
    return camera.panorama != PanoramaKind::kNone;
  });
  if (!panorama) return now;
  const std::lock_guard lock(mutex_);
  const auto found = triggered_.find(now->vehicles[vehicle].name);
  return found == triggered_.end() ? now : found->second;
}

std::vector<airsim::ImageResponse> ImageService::Capture(const SnapshotPointer& now, const std::vector<airsim::ImageRequest>& requests,
                                                         const std::string& vehicle, bool external, LentRegion* region) {
  // Cameras of the world need no vehicle.
  external = external && vehicle.empty();
  const size_t index = external ? 0 : now->Find(vehicle);
  const SnapshotPointer instant = external ? now : InstantFor(requests, now, index);
  const Vec3d origin_W = external ? session_.origin_W() : instant->vehicles[index].origin_W;
  std::vector<airsim::ImageResponse> responses(requests.size());
  render_ms_ = 0;
  const std::vector<Shot> shots = PlanShots(requests, *instant, index, external);
  size_t bytes = SocketBytes(shots, requests, region);
  constexpr const char* kHelp =
      "what helps: fewer pictures in a call, PNG (compress = True), or airsim360.airsim on the server's machine, which "
      "takes them through lent memory";
  CheckReplyBytes(bytes, kHelp);
  for (const Shot& shot : shots) {
    RenderShot(*instant, shot);
    for (const auto& [i, content] : shot.requests) {
      responses[i] = Respond(requests[i], content, *instant, shot, origin_W, region);
      if (requests[i].pixels_as_float || !requests[i].compress) continue;
      bytes += responses[i].image_data_uint8.bytes.size();
      CheckReplyBytes(bytes, kHelp);
    }
  }
  return responses;
}

ImageService::View ImageService::RenderLabels(const Snapshot& snapshot, size_t vehicle, const std::string& name, airsim::ImageType type) {
  const CameraSetup& camera = FindCamera(snapshot.world->cameras[vehicle], name);
  Shot shot;
  shot.camera = ProjectionOf(camera, type);
  shot.X_WA = CameraPoseIn(snapshot, vehicle, camera);
  shot.self = vehicle;
  shot.products.rgb = false;
  const Frame& frame = RenderShot(snapshot, shot);
  return {&frame, shot.camera, shot.X_WA * CameraInBody()};
}

}  // namespace airsim360

// Pictures for clients: one thread that renders snapshots, so that nothing else ever waits for a picture.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "airsim360/rpc/images/image_products.h"
#include "airsim360/rpc/session/session.h"
#include "airsim360/rpc/wire/fair_queue.h"
#include "airsim360/rpc/wire/shared_memory.h"

namespace airsim360 {

/// Everything but Post and Trigger belongs to jobs, which run in the service's thread.
class ImageService {
 public:
  using Job = std::function<void(ImageService&)>;

  /// The renderer is made at once.
  ImageService(Session& session, Stage& stage, const RenderSettings& picture);
  ~ImageService();
  ImageService(const ImageService&) = delete;
  ImageService& operator=(const ImageService&) = delete;

  /// Runs `job` after those of the same client before it, in turn with those of others; from any thread. Nothing happens after Stop.
  void Post(uint64_t client, Job job);
  /// Ends the present job, drops those that wait, and joins the thread.
  void Stop();
  /// Keeps the present instant of a vehicle for its panoramas; from any thread.
  void Trigger(const std::string& vehicle, SnapshotPointer snapshot);

  /// The pictures of one call: all from one instant, that of the last trigger where a panorama is among them.
  /// `region`: pixels that are not compressed are written there as far as they fit. std::exception for a camera or vehicle
  /// that there is not, and, before anything is rendered, for an answer beyond kMostReplyBytes; compressed pictures count when
  /// they are made.
  std::vector<airsim::ImageResponse> Capture(const SnapshotPointer& now, const std::vector<airsim::ImageRequest>& requests,
                                             const std::string& vehicle, bool external, LentRegion* region = nullptr);
  /// Labels (range, semantic, entity) of an ordinary camera now, and its pose.
  struct View {
    const Frame* frame;
    Camera camera;
    RigidTransform X_WC;
  };
  View RenderLabels(const Snapshot& snapshot, size_t vehicle, const std::string& camera, airsim::ImageType type);
  /// The scene of a snapshot as ray sensors of `vehicle` meet it: other drones, people and moved objects in their
  /// places, its own body hidden.
  std::shared_ptr<const RayTracer> TracerOf(const Snapshot& snapshot, size_t vehicle);
  Session& session() { return session_; }
  /// What the renderer itself took for the last Capture.
  double last_render_ms() const { return render_ms_; }

 private:
  struct Shot;
  void Run();
  void GiveBackMemory();
  const Frame& RenderShot(const Snapshot& snapshot, const Shot& shot);
  void FollowEnvironment(const WorldView& world);
  void MakeRendererFor(const WorldView& world);
  std::shared_ptr<const SceneState> StateOf(const Snapshot& snapshot, size_t self) const;
  std::shared_ptr<const SceneState> WithObjects(const Snapshot& snapshot, std::shared_ptr<const SceneState> bodies) const;
  std::vector<Shot> PlanShots(const std::vector<airsim::ImageRequest>& requests, const Snapshot& snapshot, size_t vehicle,
                              bool external) const;
  SnapshotPointer InstantFor(const std::vector<airsim::ImageRequest>& requests, const SnapshotPointer& now, size_t vehicle);
  static size_t SocketBytes(const std::vector<Shot>& shots, const std::vector<airsim::ImageRequest>& requests, const LentRegion* region);
  airsim::ImageResponse Respond(const airsim::ImageRequest& request, ImageContent content, const Snapshot& snapshot, const Shot& shot,
                                Vec3d origin_W, LentRegion* region);

  Session& session_;
  Stage& stage_;
  RenderSettings picture_;
  std::unique_ptr<Renderer> renderer_;
  DynamicTracer ray_tracers_;
  uint64_t environment_version_ = 0;
  Frame frame_;
  BlockPool pool_;  // of the answers
  double render_ms_ = 0;
  int64_t frame_pixels_ = 0;   // of the largest picture since the last GiveBackMemory
  bool holds_memory_ = false;  // a job has run since the last GiveBackMemory

  std::mutex mutex_;  // of what follows
  std::map<std::string, SnapshotPointer> triggered_;
  FairQueue<Job> jobs_;
  std::thread thread_;
};

/// Pose of a camera's body-like frame in W at a snapshot.
RigidTransform CameraPoseIn(const Snapshot& snapshot, size_t vehicle, const CameraSetup& camera);

}  // namespace airsim360

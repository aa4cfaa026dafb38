// People who stand still in the analytic room, for tests of labels: no crowd, no motion.
#pragma once

#include <memory>
#include <vector>

#include "airsim360/people/body/test_bodies.h"
#include "airsim360/render/renderer.h"
#include "airsim360/sim/people/labels.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360::internal {

struct Stand {
  Vec3d p;
  double yaw = 0;
};

/// The room with people at rest.
struct PeopledRoom {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<SimPeople> people = std::make_shared<SimPeople>();
  PeoplePoses poses;
  std::shared_ptr<const RayTracer> base, tracer;
  std::shared_ptr<SceneState> state = std::make_shared<SceneState>();

  explicit PeopledRoom(const std::vector<Stand>& stands, int level = 1) {
    for (size_t i = 0; i < stands.size(); ++i) {
      people->cast.push_back({"person/" + std::to_string(i), MakeProceduralBody(DrawBodySpec(5, i)), level});
      PersonState person;
      person.p_WP = stands[i].p;
      person.yaw = stands[i].yaw;
      poses.states.push_back(person);
      poses.poses.push_back(RestPose(*people->cast[i].body, {RotationZ(person.yaw), person.p_WP}));
    }
    scene = AddPeople(BuildWorld("box_room", {}), people->cast, people->refs);
    ShowPeople(*people, poses, *state);
    base = std::make_shared<const RayTracer>(scene);
    tracer = DynamicTracer(base).At(state);
  }

  PeoplePicture Picture(const Camera& camera, const RigidTransform& X_WC) const { return {*people, poses, *tracer, camera, X_WC}; }
  Frame Render(const Camera& camera, const RigidTransform& X_WC) const {
    const auto renderer = MakeCpuRenderer(base, {.tier = Tier::kLabels});
    RenderRequest request = MakeRequest(camera, X_WC, Tier::kLabels);
    request.products.rgb = false;
    request.state = state;
    Frame frame;
    renderer->Render(request, frame);
    return frame;
  }
};

/// A level camera at p that looks along `yaw`.
inline RigidTransform LevelCamera(Vec3d p, double yaw = 0) { return BodyPose(p, yaw, 0, 0) * CameraInBody(); }

}  // namespace airsim360::internal

// Labels of people in one picture: exact positions, visibility by rays, boxes.
#pragma once

#include <span>
#include <vector>

#include "airsim360/projection/camera.h"
#include "airsim360/sim/people/people.h"
#include "airsim360/sim/people/person_label.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

/// A picture of the people.
struct PeoplePicture {
  const SimPeople& people;
  const PeoplePoses& poses;
  const RayTracer& tracer;  ///< of the scene with ShowPeople(poses): what the picture was rendered from
  const Camera& camera;
  RigidTransform X_WC;
};

struct LabelOptions {
  double farthest = 200;  ///< metres: people farther away are not labelled
  bool boxes = true;      ///< 3D boxes and amodal silhouettes too; false: keypoints alone
};

/// Everybody who is in the world, within range, and (unless the picture is a panorama) not wholly outside the
/// picture; by person. Runs on all threads; the result does not depend on them.
std::vector<PersonLabel> LabelPeople(const PeoplePicture& picture, const LabelOptions& options = {});

/// Keypoints of one person, all visibilities decided.
std::vector<KeypointLabel> LabelKeypoints(const PeoplePicture& picture, size_t person);

/// A point of a person: `radius` is how deep below the skin it lies.
struct SightTarget {
  Vec3d p_W;
  double radius = 0;
};
struct Sight {
  KeypointState state = KeypointState::kVisible;
  EntityId occluder = kNoEntity;
};
/// What stands between the camera and points of a person whose entity is `entity`; `is_person` flags by entity id
/// (size: number of entities + 1). A point counts as visible if its ray meets the own body first and no deeper than
/// 1.3 radii + 1 cm before the point, or meets nothing before it.
void TestSight(const RayTracer& tracer, Vec3d p_WC, EntityId entity, const std::vector<bool>& is_person,
               std::span<const SightTarget> targets, std::span<Sight> sights);

/// A point of a person in the picture, `range` metres from the camera.
struct PixelTarget {
  Vec2d pixel;
  double range = 0;
};
/// Whether any of the nine pixels around each point shows `entity`, the person's body: by the rays through their centres,
/// as the picture has them. `shown` is as long as `targets`.
void TestPixels(const RayTracer& tracer, const Camera& camera, const RigidTransform& X_WC, EntityId entity,
                std::span<const PixelTarget> targets, std::span<uint8_t> shown);

/// Flags of the entities that are bodies of people, by entity id.
std::vector<bool> PersonFlags(const SimPeople& people, size_t entities);

/// Share of the silhouette's pixels that show the person, in [0, 1].
double VisibleFraction(const PersonLabel& label, int64_t visible_pixels);

}  // namespace airsim360

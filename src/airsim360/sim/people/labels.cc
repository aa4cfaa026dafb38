#include "airsim360/sim/people/labels.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/sim/people/silhouette.h"

namespace airsim360 {
namespace {

/// What all labels of a picture share.
struct Shared {
  const PeoplePicture& picture;
  RigidTransform X_CW;
  std::vector<bool> is_person;
  PixelDirections directions;
};

KeypointLabel Place(const PeoplePicture& picture, const RigidTransform& X_CW, Vec3d p_W) {
  KeypointLabel label;
  label.p_W = p_W;
  label.p_C = X_CW * p_W;
  const Vec2d place = LonLat(label.p_C);
  label.lon = place.x;
  label.lat = place.y;
  label.range = Norm(label.p_C);
  if (const auto pixel = RayToPixel(picture.camera, label.p_C)) {
    label.pixel = *pixel;
    label.state = KeypointState::kVisible;
  }
  return label;
}

// Points that nothing hides: whether the picture shows the person there decides. A ray may reach a limb that lies between
// pixel centres, or a person through gaps of foliage that are finer than pixels.
void ResolvePixels(const PeoplePicture& picture, EntityId entity, std::vector<KeypointLabel>& labels) {
  std::vector<size_t> asked;
  std::vector<PixelTarget> targets;
  for (size_t k = 0; k < labels.size(); ++k) {
    if (labels[k].state != KeypointState::kVisible) continue;
    asked.push_back(k);
    targets.push_back({labels[k].pixel, labels[k].range});
  }
  std::vector<uint8_t> shown(asked.size());
  TestPixels(picture.tracer, picture.camera, picture.X_WC, entity, targets, shown);
  for (size_t i = 0; i < asked.size(); ++i) {
    if (shown[i] == 0) labels[asked[i]].state = KeypointState::kUnresolved;
  }
}

std::vector<KeypointLabel> Keypoints(const Shared& shared, size_t i) {
  const PeoplePicture& picture = shared.picture;
  const Body& body = *picture.people.cast[i].body;
  const SkeletonPose& pose = picture.poses.poses[i];
  std::vector<KeypointLabel> labels;
  std::vector<SightTarget> targets;
  labels.reserve(body.sockets.size() + picture.people.sockets.size());
  targets.reserve(labels.capacity());
  for (const std::vector<Socket>* sockets : {&body.sockets, &picture.people.sockets}) {
    for (const Socket& socket : *sockets) {
      labels.push_back(Place(picture, shared.X_CW, SocketPosition(socket, pose)));
      targets.push_back({labels.back().p_W, socket.radius});
    }
  }
  const EntityId entity = picture.people.refs[i].entity;
  std::vector<Sight> sights(targets.size());
  TestSight(picture.tracer, picture.X_WC.p, entity, shared.is_person, targets, sights);
  for (size_t k = 0; k < labels.size(); ++k) {
    if (labels[k].state == KeypointState::kAbsent) continue;
    labels[k].state = sights[k].state;
    labels[k].occluder = sights[k].occluder;
  }
  ResolvePixels(picture, entity, labels);
  return labels;
}

double Wrapped(double angle) {
  const double wrapped = std::remainder(angle, 2 * kPi);
  return wrapped >= kPi ? -kPi : wrapped;
}

// The level of detail that the picture shows of a person.
int ShownLevel(const PeoplePicture& picture, size_t i) {
  return picture.people.refs[i].LevelFor(picture.poses.levels.empty() ? 0 : picture.poses.levels[i]);
}

// Vertices of the person's body now, props left out, in W; empty if it has no mesh in the scene.
std::vector<Vec3d> SkinOf(const PeoplePicture& picture, size_t i) {
  const PersonRef& ref = picture.people.refs[i];
  const int shown = ShownLevel(picture, i);
  const BodyLevel& level = picture.people.cast[i].body->levels[static_cast<size_t>(shown)];
  const std::span<const Vec3f> positions = picture.tracer.Positions(ref.MeshOf(shown));
  const AffineTransform& X_WM = picture.tracer.Place(ref.InstanceOf(shown));
  std::vector<Vec3d> skin;
  const size_t count = std::min<size_t>(positions.size(), level.body_vertices);
  skin.reserve(count);
  for (size_t v = 0; v < count; ++v) {
    // People are placed without rotation or scale; adding in double keeps what float vertices have.
    skin.push_back(VecCast<double>(X_WM.A * positions[v]) + VecCast<double>(X_WM.p));
  }
  return skin;
}

PersonBox3d BoxAround(const Shared& shared, size_t i, std::span<const Vec3d> skin) {
  const RigidTransform& X_CW = shared.X_CW;
  const PersonState& state = shared.picture.poses.states[i];
  PersonBox3d box;
  box.yaw = state.yaw;
  const Vec3d ahead{std::cos(box.yaw), std::sin(box.yaw), 0}, left{-ahead.y, ahead.x, 0};
  Vec3d low{INFINITY, INFINITY, INFINITY}, high = -low;
  for (const Vec3d& p : skin) {
    const Vec3d q{Dot(p - state.p_WP, ahead), Dot(p - state.p_WP, left), p.z - state.p_WP.z};
    low = Min(low, q), high = Max(high, q);
  }
  const Vec3d middle = (low + high) * 0.5, size = high - low;
  box.center_W = state.p_WP + ahead * middle.x + left * middle.y + Vec3d{0, 0, middle.z};
  box.length = size.x, box.width = size.y, box.height = size.z;
  box.center_C = X_CW * box.center_W;
  box.bottom_C = X_CW * (box.center_W - Vec3d{0, 0, box.height / 2});
  const Vec3d ahead_C = X_CW.R * ahead;
  box.rotation_y = Wrapped(std::atan2(-ahead_C.z, ahead_C.x));
  box.alpha = Wrapped(box.rotation_y - std::atan2(box.center_C.x, box.center_C.z));
  return box;
}

// Indices of the triangles of the body itself.
std::vector<Vec3u> BodyTriangles(const BodyLevel& level) {
  std::vector<Vec3u> triangles;
  for (const MeshPart& part : level.mesh.parts) {
    if (part.entity != 0) continue;
    const auto first = level.mesh.triangles.begin() + part.first_triangle;
    triangles.insert(triangles.end(), first, first + part.triangle_count);
  }
  return triangles;
}

// Share of the box of the projected corners that is outside the picture (KITTI's truncation).
double Truncation(const Camera& camera, std::span<const Vec3f> p_C) {
  const auto* pinhole = std::get_if<Pinhole>(&camera);
  const auto* lens = std::get_if<CalibratedLens>(&camera);
  if (pinhole == nullptr && lens == nullptr) return 0;
  constexpr float kNear = 0.05f;  // metres
  const auto project = [&](const Vec3f& p) {
    if (lens != nullptr) return ProjectBeyond(*lens, VecCast<double>(p));
    return Vec2d{pinhole->fx * p.x / p.z + pinhole->cx, pinhole->fy * p.y / p.z + pinhole->cy};
  };
  double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
  for (const Vec3f& p : p_C) {
    if (pinhole != nullptr && p.z < kNear) continue;
    const auto [x, y] = project(p);
    x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
  }
  const double all = (x1 - x0) * (y1 - y0);
  if (!(all > 0)) return 1;
  const double w = std::min<double>(x1, Width(camera)) - std::max(x0, 0.0), h = std::min<double>(y1, Height(camera)) - std::max(y0, 0.0);
  return w > 0 && h > 0 ? 1 - w * h / all : 1;
}

// A few directions whose convex hull is that of all: extremes along 16 directions of the tangent plane, found
// again among what lies outside their polygon would be exact; 64 directions are, to 0.1 % of the width.
std::vector<Vec3d> OuterDirections(std::span<const Vec3f> p_C) {
  constexpr int kCount = 64;
  Vec3d sum;
  for (const Vec3f& p : p_C) sum += VecCast<double>(Normalized(p));
  const Vec2d middle = LonLat(sum);
  const ViewAxes axes = AxesOf({.lon = middle.x, .lat = middle.y});
  std::vector<Vec2f> plane;
  plane.reserve(p_C.size());
  for (const Vec3f& p : p_C) {
    const Vec3d d = VecCast<double>(p);
    const double z = std::max(Dot(d, axes.forward), 1e-3 * Norm(d));
    plane.push_back({static_cast<float>(Dot(d, axes.right) / z), static_cast<float>(Dot(d, axes.down) / z)});
  }
  std::vector<Vec3d> outer;
  for (int k = 0; k < kCount; ++k) {
    const auto angle = static_cast<float>(2 * kPi * k / kCount);
    const float c = std::cos(angle), s = std::sin(angle);
    size_t best = 0;
    float reach = -INFINITY;
    for (size_t i = 0; i < plane.size(); ++i) {
      const float along = plane[i].x * c + plane[i].y * s;
      if (along > reach) reach = along, best = i;
    }
    outer.push_back(VecCast<double>(Normalized(p_C[best])));
  }
  return outer;
}

void AddBoxes(const Shared& shared, size_t i, PersonLabel& label) {
  const std::vector<Vec3d> skin = SkinOf(shared.picture, i);
  if (skin.empty()) return;
  label.box3d = BoxAround(shared, i, skin);
  std::vector<Vec3f> p_C;
  p_C.reserve(skin.size());
  for (const Vec3d& p : skin) p_C.push_back(VecCast<float>(shared.X_CW * p));
  const BodyLevel& body = shared.picture.people.cast[i].body->levels[static_cast<size_t>(ShownLevel(shared.picture, i))];
  const Silhouette silhouette = FindSilhouette(shared.directions, p_C, BodyTriangles(body));
  label.amodal.box = silhouette.box;
  label.amodal.pixels = silhouette.pixels;
  label.amodal.truncation = Truncation(shared.picture.camera, p_C);
  const std::vector<Vec3d> outer = OuterDirections(p_C);
  label.amodal.bfov = FitFieldOfView(outer);
  label.amodal.rbfov = FitRotatedFieldOfView(outer);
}

// Whether anything of a person can be in the picture.
bool Outside(const Camera& camera, const PersonLabel& label) {
  if (std::holds_alternative<Equirectangular>(camera) || label.amodal.pixels > 0) return false;
  return std::ranges::all_of(label.keypoints, [](const KeypointLabel& k) { return k.state == KeypointState::kAbsent; });
}

}  // namespace

std::vector<KeypointLabel> LabelKeypoints(const PeoplePicture& picture, size_t person) {
  const Shared shared{picture, picture.X_WC.inverse(), PersonFlags(picture.people, picture.tracer.scene().entities.size()),
                      PixelDirections(picture.camera)};
  return Keypoints(shared, person);
}

std::vector<PersonLabel> LabelPeople(const PeoplePicture& picture, const LabelOptions& options) {
  const Camera& camera = picture.camera;
  const Shared shared{picture, picture.X_WC.inverse(), PersonFlags(picture.people, picture.tracer.scene().entities.size()),
                      options.boxes ? PixelDirections(camera) : PixelDirections(Pinhole{})};
  std::vector<PersonLabel> labels;
  for (size_t i = 0; i < picture.poses.states.size() && !picture.people.refs.empty(); ++i) {
    const PersonState& state = picture.poses.states[i];
    if (!state.visible || Norm(state.p_WP - picture.X_WC.p) > options.farthest) continue;
    PersonLabel& label = labels.emplace_back();
    label.person = static_cast<PersonIndex>(i);
    label.entity = picture.people.refs[i].entity;
    label.state = state;
  }
  ParallelFor(static_cast<int64_t>(labels.size()), [&](int64_t k) {
    PersonLabel& label = labels[static_cast<size_t>(k)];
    label.pose = picture.poses.poses[label.person];
    label.R_CW = shared.X_CW.R;
    label.keypoints = Keypoints(shared, label.person);
    if (options.boxes) AddBoxes(shared, label.person, label);
  });
  std::erase_if(labels, [&](const PersonLabel& label) { return Outside(camera, label); });
  return labels;
}

double VisibleFraction(const PersonLabel& label, int64_t visible_pixels) {
  if (label.amodal.pixels <= 0) return visible_pixels > 0 ? 1 : 0;
  return std::min(1.0, static_cast<double>(visible_pixels) / static_cast<double>(label.amodal.pixels));
}

}  // namespace airsim360

#include "airsim360/rpc/coordinates/ned.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace airsim360 {
namespace {

constexpr Mat3d kNedFromWorld{{{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}}};
constexpr Mat3d kFrdFromBody{{{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}};

}  // namespace

Mat3d NedRotation(const Mat3d& R_WB) { return kNedFromWorld * R_WB * kFrdFromBody; }
Mat3d WorldRotation(const Mat3d& R_NF) { return kNedFromWorld * R_NF * kFrdFromBody; }
Mat3d FrdRotation(const Mat3d& R_BA) { return kFrdFromBody * R_BA * kFrdFromBody; }

Mat3d ObjectRotation(const Mat3d& R) { return kNedFromWorld * R * kNedFromWorld; }

double SwapHeading(double yaw) { return std::remainder(std::numbers::pi / 2 - yaw, 2 * std::numbers::pi); }

namespace airsim {
namespace {

// A part of a pose of which every number is NaN keeps its default; whether it is so.
template <class Part>
bool ReadPart(const WireValue& pose, const char* key, Part& part) {
  const WireValue* value = pose.Find(key);
  if (value == nullptr) return false;
  if (value->kind == WireValue::Kind::kMap) {
    bool all = true;
    auto look = [&](const char* name, float&) {
      const WireValue* number = value->Find(name);
      all = all && number != nullptr && IsNanOnWire(*number);
    };
    part.Visit(look);
    if (all) return true;
  }
  try {
    FromWire(*value, part);
  } catch (BadArgument& error) {
    error.Within(key);
    throw;
  }
  return false;
}

}  // namespace

void FromWire(const WireValue& value, PoseChange& out) {
  if (value.kind != WireValue::Kind::kMap) ThrowWrongKind(value, "a map");
  out.keeps_position = ReadPart(value, "position", out.position);
  out.keeps_orientation = ReadPart(value, "orientation", out.orientation);
}

Vector3r ToVector(Vec3d v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
Vec3d FromVector(const Vector3r& v) { return {v.x_val, v.y_val, v.z_val}; }

Quaternionr ToQuaternionr(const Mat3d& R) {
  const Quaternion q = ToQuaternion(R);
  return {static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
}

Mat3d FromQuaternionr(const Quaternionr& q) {
  const double w = q.w_val, x = q.x_val, y = q.y_val, z = q.z_val;
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  if (!(length > 1e-6) || !std::isfinite(length)) throw std::invalid_argument("the orientation is no rotation");
  return ToMatrix({w / length, x / length, y / length, z / length});
}

Pose ToPose(const RigidTransform& X_WB, Vec3d origin_W) {
  return {ToVector(NedFromWorld(X_WB.p - origin_W)), ToQuaternionr(NedRotation(X_WB.R))};
}

RigidTransform FromPose(const Pose& pose, Vec3d origin_W) {
  return {WorldRotation(FromQuaternionr(pose.orientation)), origin_W + NedFromWorld(FromVector(pose.position))};
}

RigidTransform Changed(const RigidTransform& now, const PoseChange& change, Vec3d origin_W) {
  RigidTransform X = FromPose(change, origin_W);
  if (change.keeps_position) X.p = now.p;
  if (change.keeps_orientation) X.R = now.R;
  return X;
}

Pose ToMount(const RigidTransform& X_BA) { return {ToVector(FrdFromBody(X_BA.p)), ToQuaternionr(FrdRotation(X_BA.R))}; }

RigidTransform FromMount(const Pose& pose) {
  return {FrdRotation(FromQuaternionr(pose.orientation)), FrdFromBody(FromVector(pose.position))};
}

}  // namespace airsim
}  // namespace airsim360

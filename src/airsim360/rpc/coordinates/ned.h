// Between our frames and AirSim's. W: east, north, up; N: north, east, down, its origin somewhere in W.
// B: forward, left, up; F: forward, right, down. The camera frame of AirSim is F-like (x forward), ours C
// (right, down, forward).
#pragma once

#include "airsim360/math/transform.h"
#include "airsim360/rpc/wire/airsim_types.h"

namespace airsim360 {

/// A direction of W in N; the same function leads back.
constexpr Vec3d NedFromWorld(Vec3d v_W) { return {v_W.y, v_W.x, -v_W.z}; }
/// A direction of B in F; the same function leads back.
constexpr Vec3d FrdFromBody(Vec3d v_B) { return {v_B.x, -v_B.y, -v_B.z}; }

/// R_NF of R_WB and back.
Mat3d NedRotation(const Mat3d& R_WB);
Mat3d WorldRotation(const Mat3d& R_NF);
/// R_FG of R_BA where both A and G are body-like (a camera's mount in its vehicle); the same function leads
/// back.
Mat3d FrdRotation(const Mat3d& R_BA);

/// Turn of an object against how the scene has it, from axes of W to axes of N; the same function leads back.
Mat3d ObjectRotation(const Mat3d& R);

/// Heading of W (counter-clockwise from east) and of N (clockwise from north); the same function leads back.
double SwapHeading(double yaw);

namespace airsim {

Vector3r ToVector(Vec3d v);
Vec3d FromVector(const Vector3r& v);
Quaternionr ToQuaternionr(const Mat3d& R);
/// The rotation of a quaternion of any length; std::invalid_argument for zero or infinite ones.
Mat3d FromQuaternionr(const Quaternionr& q);

/// Pose of a body in N whose origin is at `origin_W`, and back.
Pose ToPose(const RigidTransform& X_WB, Vec3d origin_W);
/// `now` with what `change` says.
RigidTransform Changed(const RigidTransform& now, const PoseChange& change, Vec3d origin_W);
RigidTransform FromPose(const Pose& pose, Vec3d origin_W);
/// Mount of a body-like frame in a body, and back.
Pose ToMount(const RigidTransform& X_BA);
RigidTransform FromMount(const Pose& pose);

}  // namespace airsim
}  // namespace airsim360

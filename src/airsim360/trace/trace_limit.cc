#include "airsim360/trace/trace_limit.h"

#include <cmath>

namespace airsim360::internal {

bool Invert(const Mat3f& A, Mat3f& inverse) {
  const Vec3f a = A.column(0), b = A.column(1), c = A.column(2);
  const Mat3f cofactors = Mat3f::FromColumns(Cross(b, c), Cross(c, a), Cross(a, b)).transpose();
  const float determinant = Dot(a, Cross(b, c));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      inverse.m[i][j] = cofactors.m[i][j] / determinant;
      if (!std::isfinite(inverse.m[i][j])) return false;
    }
  }
  return true;
}

bool IsTraceable(const Mat3f& A) {
  constexpr float kLargest = 1e7f;  // times the trace limit: far from where Embree's numbers end, 1.8e18
  Mat3f inverse;
  if (!Invert(A, inverse)) return false;
  for (int i = 0; i < 3; ++i) {
    const Vec3f row = inverse.row(i);
    if (!(std::fabs(row.x) + std::fabs(row.y) + std::fabs(row.z) <= kLargest)) return false;
  }
  return true;
}

}  // namespace airsim360::internal

#include "airsim360/planning/splines/excess_kernel.h"

#include "airsim360/planning/splines/spline_lanes.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

/// x and its next smaller power while both are squared again and again: x^(2^n) and x^(2^n - 1).
struct Powers {
  V8 x, one_less;

  AIRSIM360_INLINE void Square() {
    one_less *= x;
    x *= x;
  }
};

/// A row of the basis: one number for all lanes, or one for each.
template <int kShare>
AIRSIM360_INLINE auto Row(const double* basis, int row) {
  if constexpr (kShare == 1) {
    return basis[row];
  } else {
    return Load8(basis + 8 * row);
  }
}

/// Eight segments in the lanes, or few segments kShare times.
template <int kPowers, int kShare>
class Group {
 public:
  Group(const ExcessArguments& arguments, size_t first) : args_(arguments), first_(first) {
    alignas(64) double inverse[kWidth], weight[kWidth], g[3][kPowers][kWidth];
    for (size_t lane = 0; lane < kWidth; ++lane) {
      const size_t segment = Segment(lane);
      const double duration = args_.durations[segment];
      inverse[lane] = 1 / duration;
      // Lanes beyond the last segment repeat it without weight.
      weight[lane] = first + lane < args_.segments ? args_.weight * duration : 0;
      double power = 1;
      for (size_t k = 0; k < kPowers; ++k, power *= duration) {
        power_[k][lane] = power;
        for (size_t axis = 0; axis < 3; ++axis) {
          g[axis][k][lane] = args_.coefficients[(3 * segment + axis) * kPowers + k] * power;
        }
      }
    }
    inverse_ = Repeated(inverse);
    weight_ = Repeated(weight);
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < kPowers; ++k) g_[axis][k] = Repeated(g[axis][k]);
    }
  }

  double Run() {
    for (size_t j = 0; j < args_.samples; j += kShare) Sample(args_.basis + j / kShare * ExcessBasisSize(kShare));
    Store();
    double total = 0;
    for (int lane = 0; lane < 8; ++lane) total += sum_[lane];
    return total;
  }

 private:
  static constexpr size_t kWidth = 8 / kShare;  // segments

  /// For every share of the lanes.
  AIRSIM360_INLINE static V8 Repeated(const double* x) {
    if constexpr (kShare == 1) {
      return Load8(x);
    } else if constexpr (kShare == 2) {
      const V4 v = Load4(x);
      return Join(v, v);
    } else {
      const V2 v = Load2(x);
      const V4 twice = __builtin_shufflevector(v, v, 0, 1, 0, 1);
      return Join(twice, twice);
    }
  }

  size_t Segment(size_t lane) const {
    const size_t segment = first_ + lane;
    return segment < args_.segments ? segment : args_.segments - 1;
  }

  AIRSIM360_INLINE void Sample(const double* basis) {
    V8 v[3], a[3];
    AIRSIM360_UNROLL
    for (int axis = 0; axis < 3; ++axis) {
      v[axis] = g_[axis][1];
      a[axis] = g_[axis][2] * 2.0;
      AIRSIM360_UNROLL
      for (int k = 2; k < kPowers; ++k) v[axis] += g_[axis][k] * Row<kShare>(basis, k);
      AIRSIM360_UNROLL
      for (int k = 3; k < kPowers; ++k) a[axis] += g_[axis][k] * Row<kShare>(basis, 8 + k);
    }
    const V8 inverse2 = inverse_ * inverse_;
    const V8 speed_unit = inverse2 * args_.inverse_speed;
    const V8 acceleration_unit = inverse2 * inverse2 * args_.inverse_acceleration;
    const V8 speed = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) * speed_unit;
    const V8 acceleration = (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * acceleration_unit;

    // Side by side: each is a chain of multiplications.
    const V8 one = V8{} + 1.0;
    Powers of_speed = {Larger(speed, V8{} + args_.least_speed), one};
    Powers of_acceleration = {Larger(acceleration, V8{} + args_.least_acceleration), one};
    of_speed.Square();
    for (int i = 1; i < args_.squarings; ++i) {
      of_speed.Square();
      of_acceleration.Square();
    }
    sum_ += weight_ * (of_speed.x + of_acceleration.x);
    const double q = static_cast<double>(1LL << args_.squarings);
    const V8 by_v = weight_ * of_speed.one_less * speed_unit * (2 * q);
    const V8 by_a = weight_ * of_acceleration.one_less * acceleration_unit * q;
    AIRSIM360_UNROLL
    for (int axis = 0; axis < 3; ++axis) {
      const V8 gv = by_v * v[axis], ga = by_a * a[axis];
      by_g_[axis][1] += gv;
      by_g_[axis][2] += gv * Row<kShare>(basis, 2) + ga * 2.0;
      AIRSIM360_UNROLL
      for (int k = 3; k < kPowers; ++k) {
        by_g_[axis][k] += gv * Row<kShare>(basis, k) + ga * Row<kShare>(basis, 8 + k);
      }
    }
  }

  /// Derivatives by g_k = c_k T^k at fixed T become those by c_k and T.
  void Store() {
    // At fixed g a term goes with T^(1 - 2 q).
    const double q = static_cast<double>(1LL << args_.squarings);
    V8 by_duration = sum_ * (1 - 2 * q);
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 1; k < kPowers; ++k) by_duration += by_g_[axis][k] * g_[axis][k] * static_cast<double>(k);
    }
    alignas(64) double by_t[8], by_g[3][kPowers][8];
    Store8(by_duration * inverse_, by_t);
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < kPowers; ++k) Store8(by_g_[axis][k], by_g[axis][k]);
    }
    for (size_t lane = 0; lane < kWidth && first_ + lane < args_.segments; ++lane) {
      const size_t segment = first_ + lane;
      args_.by_duration[segment] = OverShares(by_t, lane);
      for (size_t axis = 0; axis < 3; ++axis) {
        double* const out = args_.by_coefficient + (3 * segment + axis) * kPowers;
        for (size_t k = 0; k < kPowers; ++k) out[k] = OverShares(by_g[axis][k], lane) * power_[k][lane];
      }
    }
  }

  static double OverShares(const double* x, size_t lane) {
    double sum = x[lane];
    for (size_t i = lane + kWidth; i < 8; i += kWidth) sum += x[i];
    return sum;
  }

  const ExcessArguments& args_;
  size_t first_;
  V8 inverse_ = {}, weight_ = {}, sum_ = {}, g_[3][kPowers] = {}, by_g_[3][kPowers] = {};
  double power_[kPowers][kWidth];
};

template <int kPowers, int kShare>
double ExcessOf(const ExcessArguments& arguments) {
  double total = 0;
  for (size_t first = 0; first < arguments.segments; first += 8 / kShare) {
    total += Group<kPowers, kShare>(arguments, first).Run();
  }
  return total;
}

template <int kPowers>
double ExcessShared(const ExcessArguments& arguments) {
  return arguments.share == 4   ? ExcessOf<kPowers, 4>(arguments)
         : arguments.share == 2 ? ExcessOf<kPowers, 2>(arguments)
                                : ExcessOf<kPowers, 1>(arguments);
}

double Excess(const ExcessArguments& arguments) { return arguments.powers == 8 ? ExcessShared<8>(arguments) : ExcessShared<6>(arguments); }

}  // namespace

const ExcessKernels kExcessKernels = {Excess};

}  // namespace airsim360::internal::AIRSIM360_ISA

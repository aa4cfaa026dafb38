#include "airsim360/planning/splines/spline_kernel.h"
#include "airsim360/planning/splines/spline_lanes.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

/// Two problems with the same matrix side by side, x y z in the lanes: 0 the route itself, 1 the adjoint,
/// whose loads are the derivatives of F by the states (at knots) and by the costates (within segments). All
/// in the units of the segment at hand; the adjoint is T^(2 D + 1) times its true size. Derivation:
/// docs/internals/trajectories.md.
template <class Model>
class AdjointSolver {
 public:
  explicit AdjointSolver(const AdjointArguments& arguments)
      : args_(arguments), route_(arguments.route), saved_(reinterpret_cast<Saved*>(arguments.route.workspace)) {}

  AIRSIM360_INLINE void Run() {
    Belief belief = StartBelief();
    for (size_t k = 0; k < route_.segments; ++k) ForwardStep(k, belief);
    V4 after[2][D], state_end[2][D] = {};
    EndCostates(belief, after, state_end[0]);
    for (size_t k = 0; k <= route_.segments; ++k) StoreWaypoint(k, V4{});
    for (size_t k = route_.segments; k-- > 0;) BackwardStep(k, after, state_end);
  }

 private:
  static constexpr int D = Model::kStates, kPowers = Model::kDegree + 1, kUnit = 2 * D + 1;
  using Belief = KnotBelief<V4, 2, D>;
  using Record = SegmentRecord<V4, 2, D>;
  struct Saved {
    Record record;
    V4 load[D];    // on the state at the segment's start
    V4 constant;   // dF/dc_0
    V4 free_load;  // dF/dg_D where g_D is free
    double duration, inverse, explicit_part, padding;
  };

  AIRSIM360_INLINE static V4 Splat(double x) { return V4{x, x, x, x}; }
  AIRSIM360_INLINE static double Sum(V4 v) { return (v[0] + v[1]) + (v[2] + v[3]); }
  AIRSIM360_INLINE V4 Knot(size_t k) const { return Load4(route_.knots + 4 * k); }
  AIRSIM360_INLINE void StoreWaypoint(size_t k, V4 v) const { *reinterpret_cast<V4Memory*>(args_.by_waypoint + 4 * k) = v; }
  AIRSIM360_INLINE void AddWaypoint(size_t k, V4 v) const { StoreWaypoint(k, Load4(args_.by_waypoint + 4 * k) + v); }

  AIRSIM360_INLINE void Boundary(const double* end, double duration, V4* state) const {
    double power = duration;
    AIRSIM360_UNROLL
    for (int i = 0; i < D; ++i, power *= duration) state[i] = Load4(end + 4 * i) * power;
  }

  AIRSIM360_INLINE Belief StartBelief() const {
    Belief belief = {};
    Boundary(route_.start, route_.durations[0], belief.mean[0]);
    if (route_.free_start) belief.mean[0][D - 1] = V4{};
    return belief;
  }

  /// dF/dg_k = dF/dc_k / T^k in the lanes, and sum_k k g_k dF/dg_k.
  AIRSIM360_INLINE double LoadGradient(size_t segment, double inverse, V4* by_g) const {
    const double* const f = args_.by_coefficient + segment * 3 * kPowers;
    const double* const c = route_.coefficients + segment * 3 * kPowers;
    V4 sum = V4{};
    double power = 1;
    AIRSIM360_UNROLL
    for (int k = 0; k < kPowers; ++k) {
      const V4 by_c = V4{f[k], f[k + kPowers], f[k + 2 * kPowers], 0};
      by_g[k] = by_c * power;
      sum += by_c * V4{c[k], c[k + kPowers], c[k + 2 * kPowers], 0} * static_cast<double>(k);
      power *= inverse;
    }
    return Sum(sum);
  }

  /// dF/d(costate at the segment's end), from that by the high coefficients.
  AIRSIM360_INLINE static void CostateLoad(const V4* by_high, V4* load) {
    if constexpr (Model::kIsLinear) {
      const V4 constant = by_high[0] * (-1 / Factorial<double>(D + 1));
      const V4 linear = by_high[0] * (3 / Factorial<double>(D + 1)) - by_high[1] * (6 / Factorial<double>(D + 2));
      AIRSIM360_UNROLL
      for (int i = 0; i <= D; ++i) {
        load[i] = constant * ConstantEffect<double, D>(i) + linear * LinearEffect<double, D>(i);
      }
    } else {
      V4 start[D + 1];
      AIRSIM360_UNROLL
      for (int m = 0; m <= D; ++m) {
        start[D - m] = by_high[m] * ((m % 2 == 0 ? -1 : 1) / Factorial<double>(D + 1 + m));
      }
      AIRSIM360_UNROLL
      for (int i = 0; i <= D; ++i) {
        V4 sum = start[D] * (1 / Factorial<double>(D - i));
        AIRSIM360_UNROLL
        for (int j = D - 1; j >= i; --j) sum += start[j] * (1 / Factorial<double>(j - i));
        load[i] = sum;
      }
    }
  }

  AIRSIM360_INLINE void ForwardStep(size_t k, Belief& belief) {
    Saved& saved = saved_[k];
    const double duration = route_.durations[k], inverse = 1 / duration;
    saved.duration = duration;
    saved.inverse = inverse;
    if (k > 0) ChangeUnits(Splat(duration * saved_[k - 1].inverse), Splat(saved_[k - 1].duration * inverse), belief);

    V4 by_g[kPowers], jump[D + 1];
    saved.explicit_part = LoadGradient(k, inverse, by_g);
    saved.constant = by_g[0];
    const bool free = route_.free_start && k == 0;
    if (free) CloseFreeStart(by_g, saved);
    double unit = duration;
    AIRSIM360_UNROLL
    for (int i = 1; i < kUnit; ++i) unit *= duration;
    AIRSIM360_UNROLL
    for (int i = 1; i < kPowers; ++i) by_g[i] *= unit;
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) saved.load[i - 1] = by_g[i] * (1 / Factorial<double>(i));
    CostateLoad(by_g + D + 1, jump);

    // The load on the state shifts the adjoint's mean, the load on the costate makes it jump.
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      AIRSIM360_UNROLL
      for (int j = 1; j <= D; ++j) {
        belief.mean[1][i - 1] -= belief.covariance[i <= j ? Packed(i, j, D) : Packed(j, i, D)] * saved.load[j - 1];
      }
    }
    saved.record.start = belief;
    if (free) {
      StepFreeCovariance<double, Model>(saved.record, belief);
    } else {
      StepCovariance<double, Model>(saved.record, belief);
    }
    const V4 from[2] = {Knot(k), jump[0]}, to[2] = {Knot(k + 1), V4{}};
    StepMean<double, Model>(from, to, saved.record, belief);
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) belief.mean[1][i - 1] += jump[i];
  }

  /// g_D = distance - the other coefficients: its load moves to them and to the waypoints.
  AIRSIM360_INLINE static void CloseFreeStart(V4* by_g, Saved& saved) {
    saved.free_load = by_g[D];
    by_g[D] = V4{};
    AIRSIM360_UNROLL
    for (int i = 1; i < kPowers; ++i) by_g[i] -= i == D ? V4{} : saved.free_load;
  }

  AIRSIM360_INLINE void EndCostates(const Belief& belief, V4 (*after)[D], V4* end) const {
    Boundary(route_.end, route_.durations[route_.segments - 1], end);
    AIRSIM360_UNROLL
    for (int i = 0; i < D; ++i) {
      after[0][i] = belief.mean[0][i] - end[i];
      after[1][i] = belief.mean[1][i];
    }
    if (route_.free_end) {
      after[0][D - 1] = after[1][D - 1] = V4{};
      SolveSymmetric<D, 2>(belief.covariance, D - 1, after);
    } else {
      SolveSymmetric<D, 2>(belief.covariance, D, after);
    }
  }

  AIRSIM360_INLINE void BackwardStep(size_t k, V4 (*after)[D], V4 (*state_end)[D]) {
    const Saved& saved = saved_[k];
    const Costate<V4, D> route_end = EndCostate(saved.record, 0, after[0]);
    const Costate<V4, D> adjoint_end = EndCostate(saved.record, 1, after[1]);
    const Costate<V4, D> route_start = StartCostate<double>(route_end);
    const Costate<V4, D> adjoint_start = StartCostate<double>(adjoint_end);
    V4 route_state[D], adjoint_state[D];
    SmoothStart(saved.record.start, 0, route_start, route_state);
    SmoothStart(saved.record.start, 1, adjoint_start, adjoint_state);

    // The duration acts through the units of state and costate at both ends.
    V4 sum = V4{};
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      const V4 before = adjoint_start.at[i] + saved.load[i - 1];
      sum += (before * route_state[i - 1] - adjoint_end.at[i] * state_end[0][i - 1]) * static_cast<double>(i);
      sum -= (adjoint_state[i - 1] * route_start.at[i] - state_end[1][i - 1] * route_end.at[i]) * static_cast<double>(kUnit - i);
      after[0][i - 1] = route_start.at[i];
      after[1][i - 1] = before;
    }
    double unit = saved.inverse;
    AIRSIM360_UNROLL
    for (int i = 1; i < kUnit; ++i) unit *= saved.inverse;
    args_.by_duration[k] += (Sum(sum) * unit - saved.explicit_part) * saved.inverse;

    const V4 force = adjoint_start.at[0] * unit;
    AddWaypoint(k, saved.constant + force);
    AddWaypoint(k + 1, -force);
    if (k == 0) {
      if (route_.free_start) {
        AddWaypoint(0, -saved.free_load);
        AddWaypoint(1, saved.free_load);
      }
      return;
    }
    const V4 ratio = Splat(saved_[k - 1].duration * saved.inverse);
    V4 power = ratio;
    AIRSIM360_UNROLL
    for (int i = 0; i < D; ++i) {
      state_end[0][i] = route_state[i] * power;
      state_end[1][i] = adjoint_state[i] * power;
      power *= ratio;
    }
    ChangeCostateUnits<V4, D>(ratio, after[0]);
    ChangeCostateUnits<V4, D>(ratio, after[1]);
  }

  const AdjointArguments& args_;
  const RouteArguments& route_;
  Saved* saved_;
};

template <class Model>
void SolveAdjoint(const AdjointArguments& arguments) {
  AdjointSolver<Model>(arguments).Run();
}

}  // namespace

const AdjointKernels kAdjointKernels = {{SolveAdjoint<SnapModel>, SolveAdjoint<QuinticModel>, SolveAdjoint<JerkModel>}};

}  // namespace airsim360::internal::AIRSIM360_ISA

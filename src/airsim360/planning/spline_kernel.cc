#include "airsim360/planning/spline_kernel.h"

#include "airsim360/planning/spline_lanes.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

/// One forward step: fills the record of a segment, moves the belief to its end. The first segments start
/// with known derivatives, but for the highest where that is free.
template <class Model, class V, int A>
AIRSIM360_INLINE void Step(const V* delta, SegmentRecord<V, A, Model::kStates>& record,
                           KnotBelief<V, A, Model::kStates>& belief) {
  record.start = belief;
  StepCovariance<double, Model>(record, belief);
  const V zero[A] = {};
  StepMean<double, Model>(zero, delta, record, belief);
}
template <class Model, class V, int A>
AIRSIM360_INLINE void FirstStep(bool free_start, const V* delta, SegmentRecord<V, A, Model::kStates>& record,
                                KnotBelief<V, A, Model::kStates>& belief) {
  record.start = belief;
  if (free_start) {
    StepFreeCovariance<double, Model>(record, belief);
  } else {
    StepKnownCovariance<Model>(record, belief);
  }
  const V zero[A] = {};
  StepMean<double, Model>(zero, delta, record, belief);
}

/// Multiplies c[k] by factor^k.
template <int kPowers, class V>
AIRSIM360_INLINE void ScalePowers(V factor, V* c) {
  V power = factor;
  AIRSIM360_UNROLL
  for (int k = 1; k < kPowers; ++k) {
    c[k] *= power;
    if (k + 1 < kPowers) power *= factor;
  }
}

/// Moves the highest coefficient so that the polynomial, evaluated at the end of its duration by Horner's
/// scheme, gives the waypoint there: rounding of the others would show as a gap at the end of a route.
template <int kPowers, class V>
AIRSIM360_INLINE void CloseGap(V duration, V inverse, V to, V* c) {
  V value = c[kPowers - 1], power = inverse;
  AIRSIM360_UNROLL
  for (int k = kPowers - 2; k >= 0; --k) {
    value = value * duration + c[k];
    if (k > 0) power *= inverse;
  }
  c[kPowers - 1] += (to - value) * power;
}

// ---- One route: two chains, from both ends to the middle. Lanes 0 to 3 walk forwards (x y z 0), lanes 4 to
// 7 walk backwards in time, where odd derivatives change sign.

template <class Model>
class RouteSolver {
 public:
  explicit RouteSolver(const RouteArguments& arguments)
      : args_(arguments),
        segments_(arguments.segments),
        common_(arguments.segments / 2),
        inverse_(arguments.workspace),
        records_(reinterpret_cast<Record*>(arguments.workspace + (segments_ + 7) / 8 * 8)) {}

  AIRSIM360_INLINE void Run() {
    for (size_t i = 0; i < segments_; ++i) inverse_[i] = 1.0 / args_.durations[i];
    Belief belief = StartBelief();
    const bool ragged = segments_ % 2 != 0;
    const V8 first_delta = Delta(0);
    FirstStep<Model>(args_.free_start, &first_delta, records_[0], belief);
    for (size_t k = 1; k < common_; ++k) {
      ToNextUnits(k, belief);
      const V8 delta = Delta(k);
      Step<Model>(&delta, records_[k], belief);
    }
    if (ragged) {
      // The forward chain alone takes the middle segment.
      const Belief before = belief;
      ToNextUnits(common_, belief);
      const V8 delta = Delta(common_);
      Step<Model>(&delta, records_[common_], belief);
      AIRSIM360_UNROLL
      for (int i = 0; i < D; ++i) belief.mean[0][i] = Halves(belief.mean[0][i], before.mean[0][i]);
      AIRSIM360_UNROLL
      for (int i = 0; i < kPacked; ++i) {
        belief.covariance[i] = Halves(belief.covariance[i], before.covariance[i]);
      }
    }
    Meet(belief);
    if (ragged) BackwardStep(common_, true);
    for (size_t k = common_; k-- > 0;) BackwardStep(k, false);
  }

 private:
  static constexpr int D = Model::kStates, kPowers = Model::kDegree + 1, kPacked = D * (D + 1) / 2;
  using Record = SegmentRecord<V8, 1, D>;
  using Belief = KnotBelief<V8, 1, D>;

  /// Segments that the two chains walk in step k; beyond its own the backward chain repeats its last.
  AIRSIM360_INLINE size_t Forward(size_t k) const { return k; }
  AIRSIM360_INLINE size_t Backward(size_t k) const { return segments_ - 1 - (k < common_ ? k : common_ - 1); }
  AIRSIM360_INLINE V8 Inverse(size_t k) const { return Join(inverse_[Forward(k)], inverse_[Backward(k)]); }
  AIRSIM360_INLINE V8 Duration(size_t k) const {
    return Join(args_.durations[Forward(k)], args_.durations[Backward(k)]);
  }
  AIRSIM360_INLINE V4 Knot(size_t k) const { return Load4(args_.knots + 4 * k); }

  AIRSIM360_INLINE V8 Delta(size_t k) const {
    const size_t b = Backward(k);
    return Join(Knot(k + 1) - Knot(k), Knot(b) - Knot(b + 1));
  }

  AIRSIM360_INLINE void ToNextUnits(size_t k, Belief& belief) const {
    ChangeUnits(Duration(k) * Inverse(k - 1), Duration(k - 1) * Inverse(k), belief);
  }

  AIRSIM360_INLINE Belief StartBelief() const {
    Belief belief = {};
    const V8 duration = Duration(0);
    V8 power = duration;
    AIRSIM360_UNROLL
    for (int i = 0; i < D; ++i) {
      const V4 first = Load4(args_.start + 4 * i), last = Load4(args_.end + 4 * i);
      belief.mean[0][i] = Join(first, i % 2 == 0 ? -last : last) * power;
      power *= duration;
    }
    if (args_.free_start) belief.mean[0][D - 1] = V8{};
    return belief;
  }

  /// The beliefs of both chains at the middle knot give its state and costates.
  AIRSIM360_INLINE void Meet(const Belief& belief) {
    // Everything in the units and the direction of time of the forward chain.
    const size_t f = segments_ - common_ - 1, b = f + 1;
    const double to_forward = args_.durations[f] * inverse_[b],
                 to_backward = args_.durations[b] * inverse_[f];
    double forward_power[2 * D + 1], backward_power[2 * D + 1];  // powers of the two ratios
    forward_power[0] = backward_power[0] = 1;
    AIRSIM360_UNROLL
    for (int i = 1; i <= 2 * D; ++i) {
      forward_power[i] = forward_power[i - 1] * to_forward;
      backward_power[i] = backward_power[i - 1] * to_backward;
    }
    V4 sum[kPacked], costate[1][D], own[D], other[D];
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      AIRSIM360_UNROLL
      for (int j = i; j <= D; ++j) {
        const V8 both = belief.covariance[Packed(i, j, D)];
        const double sign = (i + j) % 2 == 0 ? 1 : -1;
        sum[Packed(i, j, D)] = Low(both) + High(both) * (sign * backward_power[2 * D + 1 - i - j]);
      }
      own[i - 1] = Low(belief.mean[0][i - 1]);
      other[i - 1] = High(belief.mean[0][i - 1]) * ((i % 2 == 0 ? 1 : -1) * forward_power[i]);
      costate[0][i - 1] = own[i - 1] - other[i - 1];
    }
    SolveSymmetric<D, 1>(sum, D, costate);
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      V4 state = own[i - 1];
      AIRSIM360_UNROLL
      for (int j = 1; j <= D; ++j) {
        state -= Low(belief.covariance[i <= j ? Packed(i, j, D) : Packed(j, i, D)]) * costate[0][j - 1];
      }
      const double sign = i % 2 == 0 ? 1 : -1;
      state_[i - 1] = Join(state, state * (sign * backward_power[i]));
      costate_[i - 1] = Join(costate[0][i - 1], costate[0][i - 1] * (-sign * backward_power[2 * D + 1 - i]));
    }
  }

  AIRSIM360_INLINE static V4 Low(V8 v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); }
  AIRSIM360_INLINE static V4 High(V8 v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); }

  /// From the state and costates at the end of step k to those at its start, with the coefficients between.
  AIRSIM360_INLINE void BackwardStep(size_t k, bool forward_only) {
    const Record& record = records_[k];
    const size_t b = Backward(k);
    const Costate<V8, D> end = EndCostate(record, 0, costate_);
    const Costate<V8, D> start = StartCostate<double>(end);
    V8 state[D];
    SmoothStart(record.start, 0, start, state);

    // True time starts where the forward chain does and where the backward chain ends.
    V8 c[kPowers];
    c[0] = Join(Knot(k), Knot(b));
    HighCoefficients<double, Model, false>(Model::kIsLinear ? end : start, c + D + 1);
    V8 reversed[kPowers - D - 1];
    HighCoefficients<double, Model, true>(end, reversed);
    AIRSIM360_UNROLL
    for (int i = D + 1; i < kPowers; ++i) c[i] = Halves(c[i], reversed[i - D - 1]);
    if (k == 0 && args_.free_start) FreeState(c, state);
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      c[i] = Halves(state[i - 1], i % 2 == 0 ? state_[i - 1] : -state_[i - 1]) * (1 / Factorial<double>(i));
    }
    ScalePowers<kPowers>(Inverse(k), c);
    if (k == 0) CloseGap<kPowers>(Duration(0), Inverse(0), Join(Knot(1), Knot(segments_)), c);
    Store(c, k, 0);
    if (!forward_only) Store(c, b, 1);

    // On to the step before.
    if (k == 0) return;
    V8 next_state[D], next_costate[D];
    const V8 ratio = Duration(k - 1) * Inverse(k);
    V8 power = ratio;
    AIRSIM360_UNROLL
    for (int i = 0; i < D; ++i, power *= ratio) next_state[i] = state[i] * power;
    AIRSIM360_UNROLL
    for (int i = D; i >= 1; --i) {
      next_costate[i - 1] = start.at[i] * power;
      if (i > 1) power *= ratio;
    }
    AIRSIM360_UNROLL
    for (int i = 0; i < D; ++i) {
      state_[i] = forward_only ? Halves(next_state[i], state_[i]) : next_state[i];
      costate_[i] = forward_only ? Halves(next_costate[i], costate_[i]) : next_costate[i];
    }
  }

  /// The highest state at a free start closes the distance to the next waypoint; only forward lanes count.
  /// `c` has the high coefficients in place.
  AIRSIM360_INLINE void FreeState(const V8* c, V8* state) const {
    V8 rest = Delta(0);
    AIRSIM360_UNROLL
    for (int i = 1; i < D; ++i) rest -= state[i - 1] * (1 / Factorial<double>(i));
    AIRSIM360_UNROLL
    for (int i = D + 1; i < kPowers; ++i) rest -= c[i];
    state[D - 1] = rest * Factorial<double>(D);
  }

  AIRSIM360_INLINE void Store(const V8* c, size_t segment, int half) const {
    double* const base = args_.coefficients + segment * 3 * kPowers;
    double* const out[3] = {base, base + kPowers, base + 2 * kPowers};
    StoreHalf<kPowers>(c, half, out, 3);
  }

  const RouteArguments& args_;
  size_t segments_, common_;
  double* inverse_;
  Record* records_;
  V8 state_[D], costate_[D];
};

template <class Model>
void SolveRoute(const RouteArguments& arguments) {
  RouteSolver<Model>(arguments).Run();
}

// ---- Eight routes in the lanes, one forward chain.

template <class Model>
class BatchSolver {
 public:
  explicit BatchSolver(const BatchArguments& arguments)
      : args_(arguments), saved_(reinterpret_cast<Saved*>(arguments.workspace)) {}

  AIRSIM360_INLINE void Run() {
    Belief belief = {};  // at rest the mean starts at zero
    LoadWaypoint(0);
    ForwardStep(0, true, belief);
    for (size_t k = 1; k < args_.segments; ++k) ForwardStep(k, false, belief);
    V8 after[3][D];
    EndCostates(belief, after);
    for (size_t k = args_.segments; k-- > 0;) BackwardStep(k, after);
  }

 private:
  static constexpr int D = Model::kStates, kPowers = Model::kDegree + 1;
  using Belief = KnotBelief<V8, 3, D>;
  struct Saved {
    SegmentRecord<V8, 3, D> record;
    V8 duration, inverse, waypoint[3];  // of the segment's start
  };

  AIRSIM360_INLINE void LoadWaypoint(size_t k) {
    const double* const* w = args_.waypoints;
    const size_t x = 3 * k, y = x + 1, z = x + 2;
    V8* const to = saved_[k].waypoint;
    to[0] = V8{w[0][x], w[1][x], w[2][x], w[3][x], w[4][x], w[5][x], w[6][x], w[7][x]};
    to[1] = V8{w[0][y], w[1][y], w[2][y], w[3][y], w[4][y], w[5][y], w[6][y], w[7][y]};
    to[2] = V8{w[0][z], w[1][z], w[2][z], w[3][z], w[4][z], w[5][z], w[6][z], w[7][z]};
  }
  AIRSIM360_INLINE V8 Duration(size_t k) const {
    const double* const* d = args_.durations;
    return V8{d[0][k], d[1][k], d[2][k], d[3][k], d[4][k], d[5][k], d[6][k], d[7][k]};
  }

  AIRSIM360_INLINE void ForwardStep(size_t k, bool first, Belief& belief) {
    const V8 duration = Duration(k), inverse = 1.0 / duration;
    saved_[k].duration = duration;
    saved_[k].inverse = inverse;
    if (!first) ChangeUnits(duration * saved_[k - 1].inverse, saved_[k - 1].duration * inverse, belief);
    LoadWaypoint(k + 1);
    const V8 delta[3] = {saved_[k + 1].waypoint[0] - saved_[k].waypoint[0],
                         saved_[k + 1].waypoint[1] - saved_[k].waypoint[1],
                         saved_[k + 1].waypoint[2] - saved_[k].waypoint[2]};
    if (first) {
      FirstStep<Model>(Model::kIsLinear, delta, saved_[k].record, belief);
    } else {
      Step<Model>(delta, saved_[k].record, belief);
    }
  }

  /// At rest: mean - covariance costate = 0 for the clamped derivatives.
  AIRSIM360_INLINE static void EndCostates(const Belief& belief, V8 (*after)[D]) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < D; ++i) after[axis][i] = belief.mean[axis][i];
      if (Model::kIsLinear) after[axis][D - 1] = V8{};
    }
    SolveSymmetric<D, 3>(belief.covariance, Model::kIsLinear ? D - 1 : D, after);
  }

  AIRSIM360_INLINE void BackwardStep(size_t k, V8 (*after)[D]) {
    BackwardAxis<0>(k, after[0]);
    BackwardAxis<1>(k, after[1]);
    BackwardAxis<2>(k, after[2]);
  }

  template <int axis>
  AIRSIM360_INLINE void BackwardAxis(size_t k, V8* after) {
    const SegmentRecord<V8, 3, D>& record = saved_[k].record;
    const Costate<V8, D> end = EndCostate(record, axis, after);
    const Costate<V8, D> start = StartCostate<double>(end);
    V8 c[kPowers];
    c[0] = saved_[k].waypoint[axis];
    SmoothStart(record.start, axis, start, c + 1);
    HighCoefficients<double, Model, false>(Model::kIsLinear ? end : start, c + D + 1);
    LowCoefficients(c);
    if (Model::kIsLinear && k == 0) FreeState(saved_[1].waypoint[axis], c);
    ScalePowers<kPowers>(saved_[k].inverse, c);
    if (k + 1 == args_.segments) {
      CloseGap<kPowers>(saved_[k].duration, saved_[k].inverse, saved_[k + 1].waypoint[axis], c);
    }
    Store(c, (3 * k + axis) * kPowers);
    NextCostate(start, after);
    if (k > 0) ChangeCostateUnits<V8, D>(saved_[k - 1].duration * saved_[k].inverse, after);
  }

  AIRSIM360_INLINE static void LowCoefficients(V8* c) {
    AIRSIM360_UNROLL
    for (int i = 2; i <= D; ++i) c[i] *= 1 / Factorial<double>(i);
  }

  /// The highest state at a free start closes the distance to the next waypoint.
  AIRSIM360_INLINE static void FreeState(V8 to, V8* c) {
    V8 rest = to - c[0];
    AIRSIM360_UNROLL
    for (int i = 1; i < kPowers; ++i) rest -= i == D ? V8{} : c[i];
    c[D] = rest;
  }

  AIRSIM360_INLINE static void NextCostate(const Costate<V8, D>& start, V8* after) {
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) after[i - 1] = start.at[i];
  }

  AIRSIM360_INLINE void Store(const V8* c, size_t at) const {
    double* const* o = args_.coefficients;
    double* const out[8] = {o[0] + at, o[1] + at, o[2] + at, o[3] + at,
                            o[4] + at, o[5] + at, o[6] + at, o[7] + at};
    StoreHalf<kPowers>(c, 0, out, 4);
    StoreHalf<kPowers>(c, 1, out + 4, 4);
  }

  const BatchArguments& args_;
  Saved* saved_;
};

template <class Model>
void SolveBatch(const BatchArguments& arguments) {
  BatchSolver<Model>(arguments).Run();
}

}  // namespace

const SplineKernels kSplineKernels = {
    {SolveRoute<SnapModel>, SolveRoute<QuinticModel>, SolveRoute<JerkModel>},
    {SolveBatch<SnapModel>, SolveBatch<QuinticModel>, SolveBatch<JerkModel>},
};

}  // namespace airsim360::internal::AIRSIM360_ISA

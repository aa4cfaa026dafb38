#include "airsim360/planning/spline_kernel.h"

#include "airsim360/planning/spline_lanes.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

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

}  // namespace

const SplineKernels kSplineKernels = {
    {SolveRoute<SnapModel>, SolveRoute<QuinticModel>, SolveRoute<JerkModel>},
};

}  // namespace airsim360::internal::AIRSIM360_ISA

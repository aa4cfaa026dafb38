#include "airsim360/planning/splines/spline_kernel.h"

#include "airsim360/planning/splines/number_check.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

// ---- One route: two chains, from both ends to the middle, the second backwards in time, where odd
// derivatives change sign. Covariances and gains do not depend on the axis: one lane for each chain. Means,
// states and costates have x y z 0 in the lanes, one vector for each chain.

/// kFixed: the number of segments, or 0 if known only at run time. kFree: the highest derivative is free at
/// both ends. kRest: all prescribed derivatives are zero.
template <class Model, bool kFree, int kFixed, bool kRest>
class RouteSolver {
 public:
  // Field by field: the caller has just written them, and wide loads would wait for narrow stores.
  AIRSIM360_INLINE explicit RouteSolver(const RouteArguments& arguments)
      : knots_(arguments.knots),
        durations_(arguments.durations),
        start_(arguments.start),
        end_(arguments.end),
        coefficients_(arguments.coefficients),
        any_segments_(arguments.segments),
        workspace_(arguments.workspace) {}

  AIRSIM360_INLINE void Run() {
    for (size_t i = 0; i < Segments(); ++i) SegmentInverse(i) = 1.0 / durations_[i];
    Belief belief;
    Start(belief);
    ForwardStep<true>(0, 2, belief);
    for (size_t k = 1; k < Common(); ++k) ForwardStep<false>(k, 2, belief);
    if (Segments() % 2 != 0) {
      // The forward chain alone takes the middle segment.
      V2 before[kPacked];
      AIRSIM360_UNROLL
      for (int i = 0; i < kPacked; ++i) before[i] = belief.covariance[i];
      ForwardStep<false>(Common(), 1, belief);
      AIRSIM360_UNROLL
      for (int i = 0; i < kPacked; ++i) belief.covariance[i] = V2{belief.covariance[i][0], before[i][1]};
    }
    Meet(belief);
    if (Segments() % 2 != 0) BackwardChain<0, false>(Common());
    for (size_t k = Common(); k-- > 1;) {
      BackwardChain<0, false>(k);
      BackwardChain<1, false>(k);
    }
    BackwardChain<0, true>(0);
    BackwardChain<1, true>(0);
  }

 private:
  static constexpr int D = Model::kStates, kPowers = Model::kDegree + 1, kPacked = D * (D + 1) / 2;

  /// What both chains know at a knot, in the units of the segment that follows.
  struct Belief {
    V2 covariance[kPacked];
    V4 mean[2][D];
  };
  /// What the way back needs of a segment of each chain.
  struct Record {
    V2 covariance[kPacked], gain[D], information;
    V2 ratio[2 * D];  // powers of the duration before over the own one
    V4 mean[2][D], innovation[2];
  };
  static_assert(sizeof(Record) <= 9 * 64);

  AIRSIM360_INLINE size_t Segments() const { return kFixed > 0 ? kFixed : any_segments_; }
  AIRSIM360_INLINE size_t Common() const { return Segments() / 2; }
  AIRSIM360_INLINE double& SegmentInverse(size_t i) {
    if constexpr (kFixed > 0) return fixed_inverse_[i];
    return workspace_[i];
  }
  AIRSIM360_INLINE Record& RecordOf(size_t k) {
    if constexpr (kFixed > 0) return fixed_records_[k];
    return reinterpret_cast<Record*>(workspace_ + (any_segments_ + 7) / 8 * 8)[k];
  }

  /// Segments that the two chains walk in step k; beyond its own the backward chain repeats its last.
  AIRSIM360_INLINE size_t Forward(size_t k) const { return k; }
  AIRSIM360_INLINE size_t Backward(size_t k) const { return Segments() - 1 - (k < Common() ? k : Common() - 1); }
  AIRSIM360_INLINE V2 Inverse(size_t k) { return V2{SegmentInverse(Forward(k)), SegmentInverse(Backward(k))}; }
  AIRSIM360_INLINE V2 Duration(size_t k) const { return V2{durations_[Forward(k)], durations_[Backward(k)]}; }
  AIRSIM360_INLINE V4 Knot(size_t k) const { return Load4(knots_ + 4 * k); }

  template <int chain>
  AIRSIM360_INLINE V4 Delta(size_t k) const {
    if constexpr (chain == 0) return Knot(k + 1) - Knot(k);
    const size_t b = Backward(k);
    return Knot(b) - Knot(b + 1);
  }

  AIRSIM360_INLINE void Start(Belief& belief) const {
    AIRSIM360_UNROLL
    for (int chain = 0; chain < 2; ++chain) {
      const double duration = Duration(0)[chain];
      const double* const end = chain == 0 ? start_ : end_;
      V4 power = Splat4(duration);
      AIRSIM360_UNROLL
      for (int i = 0; i < D; ++i, power *= duration) {
        const bool known = !kRest && !(kFree && i == D - 1);
        belief.mean[chain][i] = known ? Load4(end + 4 * i) * (chain == 1 && i % 2 == 0 ? -power : power) : V4{};
      }
    }
  }

  template <bool kFirst>
  AIRSIM360_INLINE void ForwardStep(size_t k, int chains, Belief& belief) {
    Record& record = RecordOf(k);
    V2 gain[D];
    if constexpr (kFirst) {
      FirstCovariance(record, gain, belief.covariance);
    } else {
      ChangeUnits(k, chains, record, belief);
      AIRSIM360_UNROLL
      for (int i = 0; i < kPacked; ++i) record.covariance[i] = belief.covariance[i];
      FilterCovariance<double, Model>(record.covariance, gain, record.information, belief.covariance);
      AIRSIM360_UNROLL
      for (int i = 0; i < D; ++i) record.gain[i] = gain[i];
    }
    MeanStep<kFirst, 0>(k, record, gain, belief.mean[0]);
    if (chains > 1) MeanStep<kFirst, 1>(k, record, gain, belief.mean[1]);
  }

  template <bool kFirst, int chain>
  AIRSIM360_INLINE void MeanStep(size_t k, Record& record, const V2* gain, V4* mean) const {
    V4 before[D];
    AIRSIM360_UNROLL
    for (int i = 0; i < D; ++i) record.mean[chain][i] = before[i] = mean[i];
    V4 innovation = Delta<chain>(k);
    if constexpr (kFirst && kRest) {
      AIRSIM360_UNROLL
      for (int i = 0; i < D; ++i) mean[i] = innovation * gain[i][chain];
    } else {
      innovation -= Advance<double, D>(before, 0);
      AIRSIM360_UNROLL
      for (int i = 1; i <= D; ++i) {
        mean[i - 1] = Advance<double, D>(before, i) + innovation * gain[i - 1][chain];
      }
    }
    record.innovation[chain] = innovation;
  }

  /// The state is known at the start, but for its highest derivative where that is free.
  AIRSIM360_INLINE void FirstCovariance(Record& record, V2* gain, V2* covariance) const {
    record.information = V2{} + (kFree ? 0 : KnownInformation<Model>());
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      record.gain[i - 1] = gain[i - 1] = V2{} + (kFree ? FreeGain<double, D>(i) : KnownGain<Model>(i));
      AIRSIM360_UNROLL
      for (int j = i; j <= D; ++j) {
        covariance[Packed(i, j, D)] = V2{} + (kFree ? FreeCovariance<double, Model>(i, j) : KnownCovariance<Model>(i, j));
      }
    }
  }

  AIRSIM360_INLINE void ChangeUnits(size_t k, int chains, Record& record, Belief& belief) {
    const V2 ratio = Duration(k - 1) * Inverse(k);
    V2 power = ratio;
    AIRSIM360_UNROLL
    for (int exponent = 1; exponent <= 2 * D; ++exponent, power *= ratio) {
      record.ratio[exponent - 1] = power;
      // Covariance of derivatives i and j goes with ratio^(2 D + 1 - i - j).
      AIRSIM360_UNROLL
      for (int i = 1; i <= D; ++i) {
        const int j = 2 * D + 1 - exponent - i;
        if (j >= i && j <= D) belief.covariance[Packed(i, j, D)] *= power;
      }
    }
    AIRSIM360_UNROLL
    for (int chain = 0; chain < chains; ++chain) {
      const size_t at = chain == 0 ? Forward(k) : Backward(k), before = chain == 0 ? at - 1 : at + 1;
      const V4 inverse = Splat4(durations_[at]) * SegmentInverse(before);
      V4 growth = inverse;
      AIRSIM360_UNROLL
      for (int i = 0; i < D; ++i, growth *= inverse) belief.mean[chain][i] *= growth;
    }
  }

  /// The beliefs of both chains at the middle knot give its state and costates.
  AIRSIM360_INLINE void Meet(const Belief& belief) {
    // Everything in the units and the direction of time of the forward chain.
    const size_t f = Segments() - Common() - 1, b = f + 1;
    // Divisions of their own: nothing here waits for the inverses.
    const double to_forward = durations_[f] / durations_[b], to_backward = durations_[b] / durations_[f];
    double forward_power[2 * D + 1], backward_power[2 * D + 1];  // powers of the two ratios
    forward_power[0] = backward_power[0] = 1;
    AIRSIM360_UNROLL
    for (int i = 1; i <= 2 * D; ++i) {
      forward_power[i] = i == 1 ? to_forward : forward_power[i / 2] * forward_power[i - i / 2];
      backward_power[i] = i == 1 ? to_backward : backward_power[i / 2] * backward_power[i - i / 2];
    }
    double sum[kPacked];
    V4 costate[1][D];
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      AIRSIM360_UNROLL
      for (int j = i; j <= D; ++j) {
        const V2 both = belief.covariance[Packed(i, j, D)];
        const double other = both[1] * backward_power[2 * D + 1 - i - j];
        sum[Packed(i, j, D)] = (i + j) % 2 == 0 ? both[0] + other : both[0] - other;
      }
      const V4 own = belief.mean[0][i - 1], other = belief.mean[1][i - 1] * forward_power[i];
      costate[0][i - 1] = i % 2 == 0 ? own - other : own + other;
    }
    SolveSymmetric<D, 1>(sum, D, costate);
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      const V4 turned = costate[0][i - 1] * backward_power[2 * D + 1 - i];
      costate_[0][i - 1] = costate[0][i - 1];
      costate_[1][i - 1] = i % 2 == 0 ? -turned : turned;
    }
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      state_[i - 1] = belief.mean[1][i - 1];
      AIRSIM360_UNROLL
      for (int j = 1; j <= D; ++j) {
        state_[i - 1] -= costate_[1][j - 1] * belief.covariance[i <= j ? Packed(i, j, D) : Packed(j, i, D)][1];
      }
    }
  }

  /// From the costates (and in the backward chain the state) at the end of step k to those at its start, with
  /// the coefficients between.
  template <int chain, bool kFirst>
  AIRSIM360_INLINE void BackwardChain(size_t k) {
    const Record& record = RecordOf(k);
    const Costate<V4, D> end = End<chain>(record, kFirst), start = StartCostate<double>(end);
    V4 state[D];
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      V4 sum = record.mean[chain][i - 1];
      AIRSIM360_UNROLL
      for (int j = 1; j <= D && !kFirst; ++j) {
        sum -= start.at[j] * record.covariance[i <= j ? Packed(i, j, D) : Packed(j, i, D)][chain];
      }
      state[i - 1] = sum;
    }

    // True time starts where the forward chain does and where the backward chain ends.
    const size_t segment = chain == 0 ? Forward(k) : Backward(k);
    V4 c[kPowers];
    c[0] = Knot(segment);
    HighCoefficients<double, Model, chain == 1>(chain == 1 || Model::kIsLinear ? end : start, c + D + 1);
    if constexpr (kFirst && kFree && chain == 0) FreeState(c, state);
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      const double sign = chain == 1 && i % 2 != 0 ? -1 : 1;
      c[i] = (chain == 0 ? state[i - 1] : state_[i - 1]) * (sign / Factorial<double>(i));
    }
    if constexpr (kFirst && chain == 1) CloseGap(c);
    StoreScaled<kFirst && kRest && chain == 0>(c, segment);
    if constexpr (kFirst) return;

    // On to the step before.
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      costate_[chain][i - 1] = start.at[i] * record.ratio[2 * D - i][chain];
      if (chain == 1) state_[i - 1] = state[i - 1] * record.ratio[i - 1][1];
    }
  }

  template <int chain>
  AIRSIM360_INLINE Costate<V4, D> End(const Record& record, bool first) const {
    Costate<V4, D> end;
    V4 sum = record.innovation[chain] * (first && !kFree ? KnownInformation<Model>() : record.information[chain]);
    AIRSIM360_UNROLL
    for (int i = D; i >= 1; --i) {
      const V4 after = costate_[chain][i - 1];
      sum += after * (first && !kFree ? KnownGain<Model>(i) : record.gain[i - 1][chain]);
      end.at[i] = after;
    }
    end.at[0] = -sum;
    return end;
  }

  /// The highest state at a free start closes the distance to the next waypoint. `c` has the high
  /// coefficients in place.
  AIRSIM360_INLINE void FreeState(const V4* c, V4* state) const {
    V4 rest = Delta<0>(0);
    AIRSIM360_UNROLL
    for (int i = 1; i < D; ++i) rest -= state[i - 1] * (1 / Factorial<double>(i));
    AIRSIM360_UNROLL
    for (int i = D + 1; i < kPowers; ++i) rest -= c[i];
    state[D - 1] = rest * Factorial<double>(D);
  }

  /// Moves the highest coefficient (in units of the duration) so that the last segment ends at the last
  /// waypoint: rounding of the others would show as a gap there.
  AIRSIM360_INLINE void CloseGap(V4* c) const {
    V4 term[kPowers];
    AIRSIM360_UNROLL
    for (int i = 0; i < kPowers; ++i) term[i] = c[i];
    AIRSIM360_UNROLL
    for (int count = kPowers; count > 1; count = (count + 1) / 2) {
      AIRSIM360_UNROLL
      for (int i = 0; i < count / 2; ++i) term[i] += term[count - 1 - i];
    }
    c[kPowers - 1] += Knot(Segments()) - term[0];
  }

  /// Of coefficients in units of the duration: scaled with powers in the lanes. kStill: powers 1 to
  /// D have coefficients of zero.
  template <bool kStill>
  AIRSIM360_INLINE void StoreScaled(const V4* c, size_t segment) {
    double* const base = coefficients_ + segment * 3 * kPowers;
    double* const out[3] = {base, base + kPowers, base + 2 * kPowers};
    const V4 one = Splat4(1), inverse = Splat4(SegmentInverse(segment)), square = inverse * inverse;
    const V4 low = __builtin_shufflevector(one, inverse, 0, 5, 2, 7) * __builtin_shufflevector(one, square, 0, 1, 6, 7);
    const V4 scale[2] = {low, low * (square * square)};
    if constexpr (kStill && kPowers == 8) {
      V4 high[4] = {c[4], c[5], c[6], c[7]};
      Transpose4(high[0], high[1], high[2], high[3]);
      AIRSIM360_UNROLL
      for (size_t axis = 0; axis < 3; ++axis) {
        Store4(V4{knots_[4 * segment + axis], 0, 0, 0}, out[axis]);
        Store4(high[axis] * scale[1], out[axis] + 4);
      }
    } else {
      StorePowers<kPowers>(c, out, 3, scale);
    }
  }

  const double *const knots_, *const durations_, *const start_, *const end_;
  double* const coefficients_;
  const size_t any_segments_;
  double* const workspace_;
  double fixed_inverse_[kFixed + 1];
  Record fixed_records_[kFixed / 2 + 1];
  V4 state_[D], costate_[2][D];
};

template <class Model, bool kFree, int kFixed, bool kRest>
void SolveRouteAs(const RouteArguments& arguments) {
  RouteSolver<Model, kFree, kFixed, kRest>(arguments).Run();
}

template <class Model>
void SolveRoute(const RouteArguments& arguments) {
  constexpr bool kLinear = Model::kIsLinear;
  if constexpr (Model::kStates == 3 && !kLinear) {
    if (arguments.free_start) return SolveRouteAs<Model, true, 0, false>(arguments);
  }
  SolveRouteAs<Model, kLinear, 0, false>(arguments);
}

template <int kSegments>
NumberCheck SolveFew(const double* waypoints, const double* durations, double* knots, double* durations_copy, double* coefficients) {
  const bool points = Pad(waypoints, kSegments + 1, knots);
  double least = durations[0], largest = least, finite = 0;
  AIRSIM360_UNROLL
  for (int i = 0; i < kSegments; ++i) {
    const double duration = durations[i];
    durations_copy[i] = duration;
    least = duration < least ? duration : least;
    largest = duration > largest ? duration : largest;
    finite += duration - duration;
  }
  RouteArguments route = {};
  route.knots = knots;
  route.durations = durations;
  route.coefficients = coefficients;
  RouteSolver<SnapModel, false, kSegments, true>(route).Run();
  const bool valid = points && least > 0 && finite == 0;
  return {valid, !(largest <= kDoubleRatio * least) || Extreme(least, largest)};
}

}  // namespace

const SplineKernels kSplineKernels = {
    {SolveRoute<SnapModel>, SolveRoute<QuinticModel>, SolveRoute<JerkModel>},
    {SolveFew<2>, SolveFew<3>, SolveFew<4>, SolveFew<5>},
};

}  // namespace airsim360::internal::AIRSIM360_ISA

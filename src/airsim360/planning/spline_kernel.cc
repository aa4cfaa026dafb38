#include "airsim360/planning/spline_kernel.h"

#include "airsim360/planning/spline_lanes.h"

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
  AIRSIM360_INLINE size_t Backward(size_t k) const {
    return Segments() - 1 - (k < Common() ? k : Common() - 1);
  }
  AIRSIM360_INLINE V2 Inverse(size_t k) {
    return V2{SegmentInverse(Forward(k)), SegmentInverse(Backward(k))};
  }
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
        belief.mean[chain][i] =
            known ? Load4(end + 4 * i) * (chain == 1 && i % 2 == 0 ? -power : power) : V4{};
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
        covariance[Packed(i, j, D)] =
            V2{} + (kFree ? FreeCovariance<double, Model>(i, j) : KnownCovariance<Model>(i, j));
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
    const double to_forward = durations_[f] * SegmentInverse(b),
                 to_backward = durations_[b] * SegmentInverse(f);
    double forward_power[2 * D + 1], backward_power[2 * D + 1];  // powers of the two ratios
    forward_power[0] = backward_power[0] = 1;
    AIRSIM360_UNROLL
    for (int i = 1; i <= 2 * D; ++i) {
      forward_power[i] = forward_power[i - 1] * to_forward;
      backward_power[i] = backward_power[i - 1] * to_backward;
    }
    double sum[kPacked];
    V4 costate[1][D], own[D];
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      AIRSIM360_UNROLL
      for (int j = i; j <= D; ++j) {
        const V2 both = belief.covariance[Packed(i, j, D)];
        const double sign = (i + j) % 2 == 0 ? 1 : -1;
        sum[Packed(i, j, D)] = both[0] + both[1] * (sign * backward_power[2 * D + 1 - i - j]);
      }
      own[i - 1] = belief.mean[0][i - 1];
      costate[0][i - 1] = own[i - 1] - belief.mean[1][i - 1] * ((i % 2 == 0 ? 1 : -1) * forward_power[i]);
    }
    SolveSymmetric<D, 1>(sum, D, costate);
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      V4 state = own[i - 1];
      AIRSIM360_UNROLL
      for (int j = 1; j <= D; ++j) {
        state -= costate[0][j - 1] * belief.covariance[i <= j ? Packed(i, j, D) : Packed(j, i, D)][0];
      }
      const double sign = i % 2 == 0 ? 1 : -1;
      state_[i - 1] = state * (sign * backward_power[i]);
      costate_[0][i - 1] = costate[0][i - 1];
      costate_[1][i - 1] = costate[0][i - 1] * (-sign * backward_power[2 * D + 1 - i]);
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
    if constexpr (kFirst) {
      const V4 inverse = Splat4(SegmentInverse(segment));
      ScalePowers<kPowers>(inverse, c);
      CloseGap<kPowers>(Splat4(durations_[segment]), inverse, Knot(segment + 1), c);
      Store(c, segment);
    } else {
      StoreScaled(c, segment);
    }
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
    V4 sum =
        record.innovation[chain] * (first && !kFree ? KnownInformation<Model>() : record.information[chain]);
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
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

  AIRSIM360_INLINE void Store(const V4* c, size_t segment) const {
    double* const base = coefficients_ + segment * 3 * kPowers;
    double* const out[3] = {base, base + kPowers, base + 2 * kPowers};
    StoreLanes<kPowers>(c, out, 3);
  }

  /// The same of coefficients in units of the duration: scaled with powers in the lanes.
  AIRSIM360_INLINE void StoreScaled(const V4* c, size_t segment) {
    double* const base = coefficients_ + segment * 3 * kPowers;
    double* const out[3] = {base, base + kPowers, base + 2 * kPowers};
    const V4 one = Splat4(1), inverse = Splat4(SegmentInverse(segment)), square = inverse * inverse;
    const V4 low =
        __builtin_shufflevector(one, inverse, 0, 5, 2, 7) * __builtin_shufflevector(one, square, 0, 1, 6, 7);
    const V4 scale[2] = {low, low * (square * square)};
    StoreLanes<kPowers>(c, out, 3, scale);
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
    if (arguments.at_rest) {
      switch (arguments.segments) {
        case 2:
          return SolveRouteAs<Model, false, 2, true>(arguments);
        case 3:
          return SolveRouteAs<Model, false, 3, true>(arguments);
        case 4:
          return SolveRouteAs<Model, false, 4, true>(arguments);
        case 5:
          return SolveRouteAs<Model, false, 5, true>(arguments);
        default:
          break;
      }
    }
  }
  SolveRouteAs<Model, kLinear, 0, false>(arguments);
}

}  // namespace

const SplineKernels kSplineKernels = {
    {SolveRoute<SnapModel>, SolveRoute<QuinticModel>, SolveRoute<JerkModel>},
};

}  // namespace airsim360::internal::AIRSIM360_ISA

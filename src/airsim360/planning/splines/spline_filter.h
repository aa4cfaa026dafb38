// The optimal spline as a fixed-interval smoother: one step of the forward pass and one of the backward pass,
// for any arithmetic type V (double, a SIMD vector, a wider float). Included by kernels: types and
// always_inline functions only. Derivation: docs/internals/trajectories.md.
//
// A path that minimises the integral of the squared derivative D + 1 is the most likely path of D + 1 times
// integrated white noise. Its state at a waypoint is y = (T p', T^2 p'', T^3 p'''), in units of the duration
// T of the segment at hand; the position is known. The forward pass carries the mean and covariance of y
// given the waypoints so far, the backward pass the costates, which are the higher derivatives of the path.
#pragma once

#define AIRSIM360_INLINE [[gnu::always_inline]] inline
// Loops over states, axes and powers must unroll completely, for their arrays are registers.
#define AIRSIM360_UNROLL _Pragma("GCC unroll 9")

namespace airsim360::internal {

/// Of the derivative whose square is minimised, less one: the state has the derivatives 1 to D.
/// kLinear: that derivative is linear in time on each segment (the paper's quintic) instead of free.
template <int D, bool kLinear>
struct SplineModel {
  static constexpr int kStates = D;
  static constexpr int kDegree = kLinear ? D + 2 : 2 * D + 1;
  static constexpr bool kIsLinear = kLinear;
};
using SnapModel = SplineModel<3, false>;
using QuinticModel = SplineModel<3, true>;
using JerkModel = SplineModel<2, false>;

template <class S>
AIRSIM360_INLINE constexpr S Factorial(int n) {
  S product = 1;
  AIRSIM360_UNROLL
  for (int i = 2; i <= n; ++i) product *= S(i);
  return product;
}

/// Effect of the control's Legendre components 1 and sqrt(3)(2 tau - 1) on derivative i at the segment's end
/// (the second without its sqrt(3)).
template <class S, int D>
AIRSIM360_INLINE constexpr S ConstantEffect(int i) {
  return S(1) / Factorial<S>(D + 1 - i);
}
template <class S, int D>
AIRSIM360_INLINE constexpr S LinearEffect(int i) {
  return -S(D - i) / (S(D - i + 1) * S(D - i + 2) * Factorial<S>(D - i));
}

/// Covariance that a unit segment adds between derivatives i and j.
template <class S, class Model>
AIRSIM360_INLINE constexpr S Noise(int i, int j) {
  constexpr int D = Model::kStates;
  if (Model::kIsLinear) {
    return ConstantEffect<S, D>(i) * ConstantEffect<S, D>(j) + S(3) * LinearEffect<S, D>(i) * LinearEffect<S, D>(j);
  }
  return S(1) / (Factorial<S>(D - i) * Factorial<S>(D - j) * S(2 * D + 1 - i - j));
}

/// Gain, information and posterior covariance after the first segment when its start is known exactly.
template <class Model>
AIRSIM360_INLINE constexpr double KnownGain(int i) {
  using S = long double;
  return static_cast<double>(Noise<S, Model>(0, i) / Noise<S, Model>(0, 0));
}
template <class Model>
AIRSIM360_INLINE constexpr double KnownInformation() {
  return static_cast<double>(1 / Noise<long double, Model>(0, 0));
}
template <class Model>
AIRSIM360_INLINE constexpr double KnownCovariance(int i, int j) {
  using S = long double;
  return static_cast<double>(Noise<S, Model>(i, j) - Noise<S, Model>(0, i) / Noise<S, Model>(0, 0) * Noise<S, Model>(0, j));
}

/// Gain and posterior covariance after the first segment when the highest state is free at its start.
template <class S, int D>
AIRSIM360_INLINE constexpr S FreeGain(int i) {
  return Factorial<S>(D) / Factorial<S>(D - i);
}
template <class S, class Model>
AIRSIM360_INLINE constexpr S FreeCovariance(int i, int j) {
  constexpr int D = Model::kStates;
  return Noise<S, Model>(i, j) - FreeGain<S, D>(i) * Noise<S, Model>(0, j) - FreeGain<S, D>(j) * Noise<S, Model>(0, i) +
         FreeGain<S, D>(i) * FreeGain<S, D>(j) * Noise<S, Model>(0, 0);
}

/// Index of (i, j), 1 <= i <= j <= D, in a packed symmetric matrix.
AIRSIM360_INLINE constexpr int Packed(int i, int j, int d) { return (i - 1) * d - (i - 1) * (i - 2) / 2 + j - i; }

/// What the forward pass knows at the start of a segment, in the segment's units.
template <class V, int A, int D>
struct KnotBelief {
  V mean[A][D];
  V covariance[D * (D + 1) / 2];
};

/// What the backward pass needs of a segment.
template <class V, int A, int D>
struct SegmentRecord {
  KnotBelief<V, A, D> start;
  V gain[D];      // of derivatives 1 to D by the position innovation
  V information;  // inverse variance of the innovation; 0 where the start was free
  V innovation[A];
};

/// From units of one segment to those of the next: ratio = T_next / T, inverse = T / T_next.
template <class V, int A, int D>
AIRSIM360_INLINE void ChangeUnits(V ratio, V inverse, KnotBelief<V, A, D>& belief) {
  V power = ratio;
  AIRSIM360_UNROLL
  for (int i = 0; i < D; ++i) {
    AIRSIM360_UNROLL
    for (int axis = 0; axis < A; ++axis) belief.mean[axis][i] *= power;
    if (i + 1 < D) power *= ratio;
  }
  // Covariance of derivatives i and j goes with inverse^(2 D + 1 - i - j).
  V inverse_power = inverse;
  AIRSIM360_UNROLL
  for (int exponent = 1; exponent <= 2 * D - 1; ++exponent) {
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      const int j = 2 * D + 1 - exponent - i;
      if (j >= i && j <= D) belief.covariance[Packed(i, j, D)] *= inverse_power;
    }
    if (exponent < 2 * D - 1) inverse_power *= inverse;
  }
}

/// sum over k >= i of x_k / (k - i)!: derivative i at the end of a unit segment from derivatives at its
/// start; x[0] is derivative 1.
template <class S, int D, class V>
AIRSIM360_INLINE V Advance(const V* x, int i) {
  const int first = i > 1 ? i : 1;
  V sum = x[D - 1] * (S(1) / Factorial<S>(D - i));
  AIRSIM360_UNROLL
  for (int k = D - 1; k >= first; --k) sum += x[k - 1] * (S(1) / Factorial<S>(k - i));
  return sum;
}

/// Mean of the state at the segment's end before and after its waypoint is seen.
template <class S, class Model, class V, int A>
AIRSIM360_INLINE void StepMean(const V* from, const V* to, SegmentRecord<V, A, Model::kStates>& record,
                               KnotBelief<V, A, Model::kStates>& next) {
  constexpr int D = Model::kStates;
  AIRSIM360_UNROLL
  for (int axis = 0; axis < A; ++axis) {
    const V* mean = record.start.mean[axis];
    record.innovation[axis] = (to[axis] - from[axis]) - Advance<S, D>(mean, 0);
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) {
      next.mean[axis][i - 1] = Advance<S, D>(mean, i) + record.gain[i - 1] * record.innovation[axis];
    }
  }
}

/// Gain of a unit segment, inverse variance of its innovation and covariance at its end after its waypoint is
/// seen, from the covariance at its start.
template <class S, class Model, class C>
AIRSIM360_INLINE void FilterCovariance(const C* from, C* gain, C& information, C* to) {
  constexpr int D = Model::kStates, kTerms = D * (D + 1) / 2;
  // Predicted = G P G^T + noise, rows 0 to D. The variance of the position is what the division waits for, so
  // it is summed on its own, as a tree.
  C term[kTerms + 1];
  AIRSIM360_UNROLL
  for (int i = 1; i <= D; ++i) {
    AIRSIM360_UNROLL
    for (int j = i; j <= D; ++j) {
      const int at = Packed(i, j, D);
      term[at] = from[at] * (S(i == j ? 1 : 2) / (Factorial<S>(i) * Factorial<S>(j)));
    }
  }
  term[kTerms - 1] += Noise<S, Model>(0, 0);
  AIRSIM360_UNROLL
  for (int count = kTerms; count > 1; count = (count + 1) / 2) {
    AIRSIM360_UNROLL
    for (int i = 0; i < count / 2; ++i) term[i] += term[count - 1 - i];
  }
  information = S(1) / term[0];
  C half[D + 1][D];
  AIRSIM360_UNROLL
  for (int i = 0; i <= D; ++i) {
    AIRSIM360_UNROLL
    for (int j = 1; j <= D; ++j) {
      C column[D];
      AIRSIM360_UNROLL
      for (int k = 1; k <= D; ++k) column[k - 1] = from[k <= j ? Packed(k, j, D) : Packed(j, k, D)];
      half[i][j - 1] = Advance<S, D>(column, i);
    }
  }
  C cross[D];
  AIRSIM360_UNROLL
  for (int j = 1; j <= D; ++j) {
    cross[j - 1] = Advance<S, D>(half[0], j) + Noise<S, Model>(0, j);
    gain[j - 1] = cross[j - 1] * information;
  }
  AIRSIM360_UNROLL
  for (int i = 1; i <= D; ++i) {
    AIRSIM360_UNROLL
    for (int j = i; j <= D; ++j) {
      to[Packed(i, j, D)] = (Advance<S, D>(half[i], j) + Noise<S, Model>(i, j)) - gain[i - 1] * cross[j - 1];
    }
  }
}

template <class S, class Model, class V, int A>
AIRSIM360_INLINE void StepCovariance(SegmentRecord<V, A, Model::kStates>& record, KnotBelief<V, A, Model::kStates>& next) {
  FilterCovariance<S, Model>(record.start.covariance, record.gain, record.information, next.covariance);
}

/// The same for a first segment whose highest derivative is free at its start: infinite prior variance.
template <class S, class Model, class V, int A>
AIRSIM360_INLINE void StepFreeCovariance(SegmentRecord<V, A, Model::kStates>& record, KnotBelief<V, A, Model::kStates>& next) {
  constexpr int D = Model::kStates;
  record.information = V{};
  AIRSIM360_UNROLL
  for (int i = 1; i <= D; ++i) {
    record.gain[i - 1] = V{} + FreeGain<S, D>(i);
    AIRSIM360_UNROLL
    for (int j = i; j <= D; ++j) {
      next.covariance[Packed(i, j, D)] = V{} + FreeCovariance<S, Model>(i, j);
    }
  }
}

/// The same for a first segment whose start is known exactly: covariance zero there.
template <class Model, class V, int A>
AIRSIM360_INLINE void StepKnownCovariance(SegmentRecord<V, A, Model::kStates>& record, KnotBelief<V, A, Model::kStates>& next) {
  constexpr int D = Model::kStates;
  record.information = V{} + KnownInformation<Model>();
  AIRSIM360_UNROLL
  for (int i = 1; i <= D; ++i) {
    record.gain[i - 1] = V{} + KnownGain<Model>(i);
    AIRSIM360_UNROLL
    for (int j = i; j <= D; ++j) next.covariance[Packed(i, j, D)] = V{} + KnownCovariance<Model>(i, j);
  }
}

/// Costates along a segment: derivatives of half the local cost by (p, y_1 .. y_D) at one of its ends.
template <class V, int D>
struct Costate {
  V at[D + 1];
};

/// Costate at a segment's end, from the costate of y there (`after`, in the segment's units).
template <class V, int A, int D>
AIRSIM360_INLINE Costate<V, D> EndCostate(const SegmentRecord<V, A, D>& record, int axis, const V* after) {
  Costate<V, D> end;
  V sum = record.innovation[axis] * record.information;
  AIRSIM360_UNROLL
  for (int i = D; i >= 1; --i) {
    sum += record.gain[i - 1] * after[i - 1];
    end.at[i] = after[i - 1];
  }
  end.at[0] = -sum;
  return end;
}

/// Costate at the segment's start from that at its end. That of the position, which comes last, is added
/// last.
template <class S, class V, int D>
AIRSIM360_INLINE Costate<V, D> StartCostate(const Costate<V, D>& end) {
  Costate<V, D> start;
  start.at[0] = end.at[0];
  AIRSIM360_UNROLL
  for (int i = 1; i <= D; ++i) {
    V sum = end.at[i];
    AIRSIM360_UNROLL
    for (int k = i - 1; k >= 0; --k) sum += end.at[k] * (S(1) / Factorial<S>(i - k));
    start.at[i] = sum;
  }
  return start;
}

/// y at the segment's start: mean - covariance costate.
template <class V, int A, int D>
AIRSIM360_INLINE void SmoothStart(const KnotBelief<V, A, D>& belief, int axis, const Costate<V, D>& start, V* y) {
  AIRSIM360_UNROLL
  for (int i = 1; i <= D; ++i) {
    V sum = belief.mean[axis][i - 1];
    AIRSIM360_UNROLL
    for (int j = 1; j <= D; ++j) {
      sum -= belief.covariance[i <= j ? Packed(i, j, D) : Packed(j, i, D)] * start.at[j];
    }
    y[i - 1] = sum;
  }
}

/// Coefficients D + 1 and up, in local time over T, but for their HighFactor. `costate` is that at the
/// segment's start; for a segment walked backwards in time (`reversed`) and for linear controls that at the
/// end of the walk.
template <class S, class Model, bool reversed, class V>
AIRSIM360_INLINE void HighTerms(const Costate<V, Model::kStates>& costate, V* high) {
  constexpr int D = Model::kStates;
  if constexpr (Model::kIsLinear) {
    // The control is the costate's polynomial projected on linear functions. Both components are taken from
    // the costate at the end of the walk; walking backwards changes the sign of time.
    V constant = V{}, linear = V{};
    AIRSIM360_UNROLL
    for (int i = D; i >= 0; --i) {
      constant -= costate.at[i] * ConstantEffect<S, D>(i);
      if (i < D) linear -= costate.at[i] * (S(3) * LinearEffect<S, D>(i));
    }
    if constexpr (reversed) linear = -linear;
    high[0] = constant - linear;
    high[1] = linear;
  } else {
    AIRSIM360_UNROLL
    for (int m = 0; m <= D; ++m) high[m] = costate.at[D - m];
  }
}

template <class Model, bool reversed, class S = double>
AIRSIM360_INLINE constexpr S HighFactor(int m) {
  constexpr int D = Model::kStates;
  if (Model::kIsLinear) return S(m == 0 ? 1 : 2) / Factorial<S>(D + 1 + m);
  const bool negative = reversed ? D % 2 == 1 : m % 2 == 0;
  return (negative ? -S(1) : S(1)) / Factorial<S>(D + 1 + m);
}

template <class S, class Model, bool reversed, class V>
AIRSIM360_INLINE void HighCoefficients(const Costate<V, Model::kStates>& costate, V* high) {
  constexpr int D = Model::kStates;
  HighTerms<S, Model, reversed>(costate, high);
  AIRSIM360_UNROLL
  for (int m = 0; m < Model::kDegree - D; ++m) high[m] *= HighFactor<Model, reversed, S>(m);
}

/// Multiplies the costate of y by ratio^(2 D + 1 - i): into the units of the neighbour T_neighbour = ratio T.
template <class V, int D>
AIRSIM360_INLINE void ChangeCostateUnits(V ratio, V* costate) {
  V power = ratio;
  AIRSIM360_UNROLL
  for (int i = 0; i < D; ++i) power *= ratio;
  AIRSIM360_UNROLL
  for (int i = D; i >= 1; --i) {
    costate[i - 1] *= power;
    if (i > 1) power *= ratio;
  }
}

}  // namespace airsim360::internal

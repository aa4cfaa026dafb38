#include "airsim360/planning/splines/spline_wide.h"

#include <algorithm>
#include <vector>

#include "airsim360/planning/splines/spline_filter.h"

namespace airsim360::internal {
namespace {

__extension__ typedef __float128 Quad;

/// Knots between an uneven place and the border of the part solved again; the influence of the border decays
/// at least by 0.54 per knot.
constexpr size_t kMargin = 16;

template <class Model, class S>
class ChainSolver {
 public:
  explicit ChainSolver(const RouteArguments& arguments) : args_(arguments), records_(arguments.segments) {}

  void Run() {
    KnotBelief<S, 3, D> belief = Start();
    for (size_t k = 0; k < args_.segments; ++k) {
      if (k > 0) ChangeUnits(Duration(k) / Duration(k - 1), Duration(k - 1) / Duration(k), belief);
      records_[k].start = belief;
      if (args_.free_start && k == 0) {
        StepFreeCovariance<S, Model>(records_[k], belief);
      } else {
        StepCovariance<S, Model>(records_[k], belief);
      }
      S from[3], to[3];
      for (int axis = 0; axis < 3; ++axis) {
        from[axis] = Knot(k, axis);
        to[axis] = Knot(k + 1, axis);
      }
      StepMean<S, Model>(from, to, records_[k], belief);
    }
    for (int axis = 0; axis < 3; ++axis) Backward(belief, axis);
  }

 private:
  static constexpr int D = Model::kStates, kPowers = Model::kDegree + 1;

  S Duration(size_t k) const { return args_.durations[k]; }
  S Knot(size_t k, int axis) const { return args_.knots[4 * k + static_cast<size_t>(axis)]; }

  /// Derivative i + 1 at an end in units of the duration of its segment.
  static S Boundary(const double* end, int axis, int i, S duration) {
    S value = end[4 * i + axis];
    for (int k = 0; k <= i; ++k) value *= duration;
    return value;
  }

  KnotBelief<S, 3, D> Start() const {
    KnotBelief<S, 3, D> belief = {};
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < (args_.free_start ? D - 1 : D); ++i) {
        belief.mean[axis][i] = Boundary(args_.start, axis, i, Duration(0));
      }
    }
    return belief;
  }

  /// covariance costate = mean - prescribed state, for the clamped derivatives.
  void EndCostates(const KnotBelief<S, 3, D>& belief, int axis, S* x) const {
    const int n = args_.free_end ? D - 1 : D;
    S l[D][D] = {}, d[D] = {};
    for (int i = 0; i < D; ++i) x[i] = S(0);
    for (int i = 0; i < n; ++i) {
      x[i] = belief.mean[axis][i] - Boundary(args_.end, axis, i, Duration(args_.segments - 1));
    }
    for (int j = 0; j < n; ++j) {
      d[j] = belief.covariance[Packed(j + 1, j + 1, D)];
      for (int k = 0; k < j; ++k) d[j] -= l[j][k] * l[j][k] * d[k];
      for (int i = j + 1; i < n; ++i) {
        S sum = belief.covariance[Packed(j + 1, i + 1, D)];
        for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k] * d[k];
        l[i][j] = sum / d[j];
      }
    }
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < i; ++k) x[i] -= l[i][k] * x[k];
    }
    for (int i = n; i-- > 0;) {
      x[i] /= d[i];
      for (int k = i + 1; k < n; ++k) x[i] -= l[k][i] * x[k];
    }
  }

  void Backward(const KnotBelief<S, 3, D>& belief, int axis) {
    S after[D];
    EndCostates(belief, axis, after);
    for (size_t k = args_.segments; k-- > 0;) {
      const Costate<S, D> end = EndCostate(records_[k], axis, after);
      const Costate<S, D> start = StartCostate<S>(end);
      S c[kPowers];
      c[0] = Knot(k, axis);
      SmoothStart(records_[k].start, axis, start, c + 1);
      HighCoefficients<S, Model, false>(Model::kIsLinear ? end : start, c + D + 1);
      for (int i = 2; i <= D; ++i) c[i] /= Factorial<S>(i);
      if (args_.free_start && k == 0) {
        c[D] = Knot(1, axis) - c[0];
        for (int i = 1; i < kPowers; ++i) c[D] -= i == D ? S(0) : c[i];
      }
      double* const out = args_.coefficients + (k * 3 + static_cast<size_t>(axis)) * kPowers;
      S power = 1;
      for (int i = 0; i < kPowers; ++i, power *= Duration(k)) out[i] = static_cast<double>(c[i] / power);
      if (k + 1 == args_.segments) CloseGap(k, axis, out);
      for (int i = 1; i <= D; ++i) after[i - 1] = start.at[i];
      if (k > 0) ChangeCostateUnits<S, D>(Duration(k - 1) / Duration(k), after);
    }
  }

  /// As the kernels do: Horner's scheme in double precision meets the last waypoint.
  void CloseGap(size_t k, int axis, double* c) const {
    const double duration = args_.durations[k];
    double value = c[kPowers - 1], power = duration;
    for (int i = kPowers - 2; i >= 0; --i) value = value * duration + c[i];
    for (int i = 2; i < kPowers; ++i) power *= duration;
    c[kPowers - 1] += (args_.knots[4 * (k + 1) + static_cast<size_t>(axis)] - value) / power;
  }

  const RouteArguments& args_;
  std::vector<SegmentRecord<S, 3, D>> records_;
};

template <class S>
void SolveKind(SplineKind kind, const RouteArguments& arguments) {
  switch (kind) {
    case SplineKind::kMinimumSnap:
      return ChainSolver<SnapModel, S>(arguments).Run();
    case SplineKind::kPaperQuintic:
      return ChainSolver<QuinticModel, S>(arguments).Run();
    case SplineKind::kMinimumJerk:
      return ChainSolver<JerkModel, S>(arguments).Run();
  }
}

}  // namespace

void SolveRouteWide(SplineKind kind, const RouteArguments& arguments) {
  if (arguments.segments == 1) return SolveKind<long double>(kind, arguments);
  SolveKind<Quad>(kind, arguments);
}

namespace {

/// Derivatives 1 to 3 at the start of a segment, in the layout of RouteArguments.
void StartDerivatives(const RouteArguments& arguments, size_t segment, size_t powers, double* out) {
  for (size_t axis = 0; axis < 3; ++axis) {
    const double* const c = arguments.coefficients + (segment * 3 + axis) * powers;
    out[axis] = c[1];
    out[4 + axis] = 2 * c[2];
    out[8 + axis] = 6 * c[3];
  }
}

/// Whether 64-bit mantissas are enough: they lose up to the fifth power of the largest ratio of durations
/// that are near each other, which leaves 2e-13 here.
bool LongDoubleWillDo(const double* durations, size_t n) {
  constexpr size_t kNear = 5;
  constexpr double kRatio = 20;
  for (size_t i = 0; i < n; ++i) {
    const auto [least, largest] = std::minmax_element(durations + i, durations + std::min(n, i + kNear));
    if (*largest > kRatio * *least) return false;
  }
  return true;
}

/// Segments [first, last) solved again with what the solution has at their borders.
void SolveAgain(SplineKind kind, const RouteArguments& all, size_t first, size_t last) {
  RouteArguments part = all;
  const size_t powers = static_cast<size_t>(PowersOf(kind));
  double start[12] = {}, end[12] = {};
  part.knots += 4 * first;
  part.durations += first;
  part.segments = last - first;
  part.coefficients += first * 3 * powers;
  if (first > 0) {
    StartDerivatives(all, first, powers, start);
    part.start = start;
    part.free_start = false;
  }
  if (last < all.segments) {
    StartDerivatives(all, last, powers, end);
    part.end = end;
    part.free_end = false;
  }
  if (LongDoubleWillDo(part.durations, part.segments)) return SolveKind<long double>(kind, part);
  SolveKind<Quad>(kind, part);
}

}  // namespace

void RefineUneven(SplineKind kind, const CheckKernels& kernels, const RouteArguments& arguments) {
  const size_t segments = arguments.segments;
  if (segments <= kFewSegments) return SolveAgain(kind, arguments, 0, segments);
  constexpr size_t kBlock = 64;
  size_t first = segments, last = 0;  // the part being collected
  for (size_t i = 0; i + 1 < segments; ++i) {
    // Block by block first.
    if (i % kBlock == 0) {
      while (i + 1 < segments && !kernels.any_uneven(arguments.durations + i, std::min(kBlock + 2, segments - i))) {
        i += kBlock;
      }
      if (i + 1 >= segments) break;
    }
    if (!kernels.any_uneven(arguments.durations + i, std::min<size_t>(3, segments - i))) continue;
    const size_t from = i > kMargin ? i - kMargin : 0, to = std::min(segments, i + 3 + kMargin);
    if (first < last && from > last) {
      SolveAgain(kind, arguments, first, last);
      first = from;
    }
    first = std::min(first, from);
    last = to;
  }
  if (first < last) SolveAgain(kind, arguments, first, last);
}

}  // namespace airsim360::internal

// Eight routes in the lanes, or eight overlapping chunks of one route; one forward chain each.
#include "airsim360/planning/spline_kernel.h"
#include "airsim360/planning/spline_lanes.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

#ifdef __AVX512F__
typedef V8 Lanes;
constexpr int kLanes = 8;
#else
typedef V4 Lanes;
constexpr int kLanes = 4;
#endif

/// The routes or chunks first to first + kLanes - 1 in the lanes.
template <class Model>
class BatchSolver {
 public:
  AIRSIM360_INLINE BatchSolver(const BatchArguments& arguments, int first)
      : segments_(arguments.segments),
        stride_(arguments.stride),
        end_(arguments.segments),
        waypoints_(arguments.waypoints + first),
        durations_(arguments.durations + first),
        coefficients_(arguments.coefficients + first),
        saved_(reinterpret_cast<Saved*>(arguments.workspace)) {}

  AIRSIM360_INLINE void Run() {
    Belief belief = {};  // at rest the mean starts at zero
    LoadWaypoint(0, true);
    ForwardStep(0, true, belief);
    for (size_t k = 1; k < segments_; ++k) ForwardStep(k, false, belief);
    Lanes after[3][D] = {};
    EndCostates(belief, after);
    for (size_t k = segments_; k-- > 0;) BackwardStep(k, k, after);
  }

  /// Chunks: the overlap before a chunk makes the filter forget that it did not start at the route's start,
  /// the one behind it makes the costates forget that the route goes on.
  AIRSIM360_INLINE void RunChunks(size_t overlap, const double* start, const double* end) {
    const size_t first = overlap, last = segments_ - overlap;
    Belief belief = {};
    LoadWaypoint(0, true);
    ForwardStep(0, true, belief);
    for (size_t k = 1; k < first; ++k) ForwardStep(k, false, belief);
    if (start != nullptr) StartLane(start, belief);
    for (size_t k = first; k < segments_; ++k) ForwardStep(k, false, belief);

    end_ = last;
    Lanes after[3][D] = {};
    for (size_t k = segments_; k-- > last;) SkipBack(k, after);
    if (end != nullptr) EndLane(end, last, after);
    for (size_t k = last; k-- > first;) BackwardStep(k, k - first, after);
  }

 private:
  static constexpr int D = Model::kStates, kPowers = Model::kDegree + 1;
  using Belief = KnotBelief<Lanes, 3, D>;
  struct Saved {
    SegmentRecord<Lanes, 3, D> record;
    Lanes duration, inverse, waypoint[3];  // of the segment's start
  };

  /// Reads one number before a waypoint, behind the first one of a lane: always inside its array.
  AIRSIM360_INLINE void LoadWaypoint(size_t k, bool first) {
    const double* const* const w = waypoints_;
    const size_t at = stride_ * k - (first ? 0 : 1);
    AIRSIM360_UNROLL
    for (int half = 0; half < kLanes / 4; ++half) {
      V4 row[4];
      AIRSIM360_UNROLL
      for (int lane = 0; lane < 4; ++lane) row[lane] = Load4(w[4 * half + lane] + at);
      Transpose4(row[0], row[1], row[2], row[3]);
      AIRSIM360_UNROLL
      for (int axis = 0; axis < 3; ++axis) {
        V4* const out = reinterpret_cast<V4*>(&saved_[k].waypoint[axis]);
        out[half] = row[first ? axis : axis + 1];
      }
    }
  }
  AIRSIM360_INLINE Lanes Duration(size_t k) const {
    const double* const* d = durations_;
#ifdef __AVX512F__
    return Lanes{d[0][k], d[1][k], d[2][k], d[3][k], d[4][k], d[5][k], d[6][k], d[7][k]};
#else
    return Lanes{d[0][k], d[1][k], d[2][k], d[3][k]};
#endif
  }

  AIRSIM360_INLINE void ForwardStep(size_t k, bool first, Belief& belief) {
    const Lanes duration = Duration(k), inverse = 1.0 / duration;
    saved_[k].duration = duration;
    saved_[k].inverse = inverse;
    if (!first) ChangeUnits(duration * saved_[k - 1].inverse, saved_[k - 1].duration * inverse, belief);
    LoadWaypoint(k + 1, false);
    const Lanes delta[3] = {saved_[k + 1].waypoint[0] - saved_[k].waypoint[0],
                            saved_[k + 1].waypoint[1] - saved_[k].waypoint[1],
                            saved_[k + 1].waypoint[2] - saved_[k].waypoint[2]};
    if (first) {
      FirstStep<Model>(Model::kIsLinear, delta, saved_[k].record, belief);
    } else {
      Step<Model>(delta, saved_[k].record, belief);
    }
  }

  /// At rest: mean - covariance costate = 0 for the clamped derivatives.
  AIRSIM360_INLINE static void EndCostates(const Belief& belief, Lanes (*after)[D]) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < D; ++i) after[axis][i] = belief.mean[axis][i];
      if (Model::kIsLinear) after[axis][D - 1] = Lanes{};
    }
    SolveSymmetric<D, 3>(belief.covariance, Model::kIsLinear ? D - 1 : D, after);
  }

  /// Lane 0 starts here, with known derivatives.
  AIRSIM360_INLINE void StartLane(const double* start, Belief& belief) const {
    const double duration = durations_[0][0];
    AIRSIM360_UNROLL
    for (int axis = 0; axis < 3; ++axis) {
      double power = duration;
      AIRSIM360_UNROLL
      for (int i = 0; i < D; ++i, power *= duration) {
        belief.mean[axis][i][0] = start[4 * i + axis] * power;
      }
    }
    AIRSIM360_UNROLL
    for (int i = 0; i < D * (D + 1) / 2; ++i) belief.covariance[i][0] = 0;
  }

  /// The last lane ends at the start of segment k, which lasts as long as the one before.
  AIRSIM360_INLINE void EndLane(const double* end, size_t k, Lanes (*after)[D]) const {
    const Belief& belief = saved_[k].record.start;
    const double duration = saved_[k].duration[kLanes - 1];
    Lanes costate[3][D];
    AIRSIM360_UNROLL
    for (int axis = 0; axis < 3; ++axis) {
      double power = duration;
      AIRSIM360_UNROLL
      for (int i = 0; i < D; ++i, power *= duration) {
        costate[axis][i] = belief.mean[axis][i] - end[4 * i + axis] * power;
      }
    }
    SolveSymmetric<D, 3>(belief.covariance, D, costate);
    AIRSIM360_UNROLL
    for (int axis = 0; axis < 3; ++axis) {
      AIRSIM360_UNROLL
      for (int i = 0; i < D; ++i) after[axis][i][kLanes - 1] = costate[axis][i][kLanes - 1];
    }
  }

  /// Only the costates go back.
  AIRSIM360_INLINE void SkipBack(size_t k, Lanes (*after)[D]) const {
    AIRSIM360_UNROLL
    for (int axis = 0; axis < 3; ++axis) {
      NextCostate(StartCostate<double>(EndCostate(saved_[k].record, axis, after[axis])), after[axis]);
      ChangeCostateUnits<Lanes, D>(saved_[k - 1].duration * saved_[k].inverse, after[axis]);
    }
  }

  /// `to`: where its coefficients go, in segments of each lane.
  AIRSIM360_INLINE void BackwardStep(size_t k, size_t to, Lanes (*after)[D]) {
    Lanes scale[kPowers], costate_scale[D];
    PowerScales(saved_[k].inverse, scale);
    if (k > 0) CostateScales(saved_[k - 1].duration * saved_[k].inverse, costate_scale);
    BackwardAxis<0>(k, to, scale, costate_scale, after[0]);
    BackwardAxis<1>(k, to, scale, costate_scale, after[1]);
    BackwardAxis<2>(k, to, scale, costate_scale, after[2]);
  }

  /// From states and costates to coefficients.
  AIRSIM360_INLINE static void PowerScales(Lanes inverse, Lanes* scale) {
    Lanes power = inverse;
    AIRSIM360_UNROLL
    for (int i = 1; i < kPowers; ++i) {
      scale[i] = power * (i <= D ? 1 / Factorial<double>(i) : HighFactor<Model, false>(i - D - 1));
      if (i + 1 < kPowers) power *= inverse;
    }
  }
  AIRSIM360_INLINE static void CostateScales(Lanes ratio, Lanes* scale) {
    AIRSIM360_UNROLL
    for (int i = 0; i < D; ++i) scale[i] = Lanes{} + 1.0;
    ChangeCostateUnits<Lanes, D>(ratio, scale);
  }

  template <int axis>
  AIRSIM360_INLINE void BackwardAxis(size_t k, size_t to, const Lanes* scale, const Lanes* costate_scale,
                                     Lanes* after) {
    const SegmentRecord<Lanes, 3, D>& record = saved_[k].record;
    const Costate<Lanes, D> end = EndCostate(record, axis, after);
    const Costate<Lanes, D> start = StartCostate<double>(end);
    Lanes c[kPowers];
    c[0] = saved_[k].waypoint[axis];
    SmoothStart(record.start, axis, start, c + 1);
    HighTerms<double, Model, false>(Model::kIsLinear ? end : start, c + D + 1);
    if (Model::kIsLinear && k == 0) FreeState(saved_[1].waypoint[axis], c);
    AIRSIM360_UNROLL
    for (int i = 1; i < kPowers; ++i) c[i] *= scale[i];
    if (k + 1 == end_) {
      CloseGap<kPowers>(saved_[k].duration, saved_[k].inverse, saved_[k + 1].waypoint[axis], c);
    }
    Store(c, (3 * to + axis) * kPowers);
    NextCostate(start, after);
    if (k == 0) return;
    AIRSIM360_UNROLL
    for (int i = 0; i < D; ++i) after[i] *= costate_scale[i];
  }

  /// The highest state at a free start closes the distance to the next waypoint.
  AIRSIM360_INLINE static void FreeState(Lanes to, Lanes* c) {
    Lanes rest = to - c[0];
    AIRSIM360_UNROLL
    for (int i = 1; i < kPowers; ++i) {
      if (i != D) rest -= c[i] * (i < D ? 1 / Factorial<double>(i) : HighFactor<Model, false>(i - D - 1));
    }
    c[D] = rest * Factorial<double>(D);
  }

  AIRSIM360_INLINE static void NextCostate(const Costate<Lanes, D>& start, Lanes* after) {
    AIRSIM360_UNROLL
    for (int i = 1; i <= D; ++i) after[i - 1] = start.at[i];
  }

  AIRSIM360_INLINE void Store(const Lanes* c, size_t at) const {
    double* out[kLanes];
    AIRSIM360_UNROLL
    for (int lane = 0; lane < kLanes; ++lane) out[lane] = coefficients_[lane] + at;
#ifdef __AVX512F__
    if constexpr (kPowers == 8) return StoreTransposed8(c, out);
    V4 low[kPowers], high[kPowers];
    AIRSIM360_UNROLL
    for (int i = 0; i < kPowers; ++i) {
      low[i] = Low(c[i]);
      high[i] = High(c[i]);
    }
    StoreLanes<kPowers>(low, out, 4);
    StoreLanes<kPowers>(high, out + 4, 4);
#else
    StoreLanes<kPowers>(c, out, kLanes);
#endif
  }

  size_t segments_, stride_;
  size_t end_;  // behind the last segment whose coefficients are wanted
  const double* const* waypoints_;
  const double* const* durations_;
  double* const* coefficients_;
  Saved* saved_;
};

template <class Model>
void SolveBatch(const BatchArguments& arguments) {
  for (int first = 0; first < 8; first += kLanes) BatchSolver<Model>(arguments, first).Run();
}

template <class Model>
void SolveChunks(const ChunkArguments& chunks) {
  for (int first = 0; first < 8; first += kLanes) {
    const bool starts = first == 0 && chunks.has_start, ends = first + kLanes == 8 && chunks.has_end;
    BatchSolver<Model>(chunks.lanes, first)
        .RunChunks(chunks.overlap, starts ? chunks.start : nullptr, ends ? chunks.end : nullptr);
  }
}

}  // namespace

const BatchKernels kBatchKernels = {
    {SolveBatch<SnapModel>, SolveBatch<QuinticModel>, SolveBatch<JerkModel>},
    {SolveChunks<SnapModel>, nullptr, SolveChunks<JerkModel>},
};

}  // namespace airsim360::internal::AIRSIM360_ISA

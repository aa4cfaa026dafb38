// Eight routes in the lanes, or eight overlapping chunks of one route; one forward chain each.
#include "airsim360/planning/spline_kernel.h"
#include "airsim360/planning/spline_lanes.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

template <class Model>
class BatchSolver {
 public:
  explicit BatchSolver(const BatchArguments& arguments)
      : args_(arguments), end_(arguments.segments), saved_(reinterpret_cast<Saved*>(arguments.workspace)) {}

  AIRSIM360_INLINE void Run() {
    Belief belief = {};  // at rest the mean starts at zero
    LoadWaypoint(0, true);
    ForwardStep(0, true, belief);
    for (size_t k = 1; k < args_.segments; ++k) ForwardStep(k, false, belief);
    V8 after[3][D] = {};
    EndCostates(belief, after);
    for (size_t k = args_.segments; k-- > 0;) BackwardStep(k, k, after);
  }

  /// Chunks: the overlap before a chunk makes the filter forget that it did not start at the route's start,
  /// the one behind it makes the costates forget that the route goes on.
  AIRSIM360_INLINE void RunChunks(const ChunkArguments& chunks) {
    const size_t first = chunks.overlap, last = args_.segments - chunks.overlap;
    Belief belief = {};
    LoadWaypoint(0, true);
    ForwardStep(0, true, belief);
    for (size_t k = 1; k < first; ++k) ForwardStep(k, false, belief);
    if (chunks.has_start) StartLane(chunks.start, belief);
    for (size_t k = first; k < args_.segments; ++k) ForwardStep(k, false, belief);

    end_ = last;
    V8 after[3][D] = {};
    for (size_t k = args_.segments; k-- > last;) SkipBack(k, after);
    if (chunks.has_end) EndLane(chunks.end, last, after);
    for (size_t k = last; k-- > first;) BackwardStep(k, k - first, after);
  }

 private:
  static constexpr int D = Model::kStates, kPowers = Model::kDegree + 1;
  using Belief = KnotBelief<V8, 3, D>;
  struct Saved {
    SegmentRecord<V8, 3, D> record;
    V8 duration, inverse, waypoint[3];  // of the segment's start
  };

  /// Reads one number before a waypoint, behind the first one of a lane: always inside its array.
  AIRSIM360_INLINE void LoadWaypoint(size_t k, bool first) {
    const double* const* const w = args_.waypoints;
    const size_t at = args_.stride * k - (first ? 0 : 1);
    V4 low[4], high[4];
    AIRSIM360_UNROLL
    for (int lane = 0; lane < 4; ++lane) {
      low[lane] = Load4(w[lane] + at);
      high[lane] = Load4(w[lane + 4] + at);
    }
    Transpose4(low[0], low[1], low[2], low[3]);
    Transpose4(high[0], high[1], high[2], high[3]);
    AIRSIM360_UNROLL
    for (int axis = 0; axis < 3; ++axis) {
      const int row = first ? axis : axis + 1;
      saved_[k].waypoint[axis] = Join(low[row], high[row]);
    }
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
    LoadWaypoint(k + 1, false);
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

  /// Lane 0 starts here, with known derivatives.
  AIRSIM360_INLINE void StartLane(const double* start, Belief& belief) const {
    const double duration = args_.durations[0][0];
    AIRSIM360_UNROLL
    for (int axis = 0; axis < 3; ++axis) {
      double power = duration;
      AIRSIM360_UNROLL
      for (int i = 0; i < D; ++i, power *= duration) belief.mean[axis][i][0] = start[4 * i + axis] * power;
    }
    AIRSIM360_UNROLL
    for (int i = 0; i < D * (D + 1) / 2; ++i) belief.covariance[i][0] = 0;
  }

  /// Lane 7 ends at the start of segment k, which lasts as long as the one before.
  AIRSIM360_INLINE void EndLane(const double* end, size_t k, V8 (*after)[D]) const {
    const Belief& belief = saved_[k].record.start;
    const double duration = saved_[k].duration[7];
    V8 costate[3][D];
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
      for (int i = 0; i < D; ++i) after[axis][i][7] = costate[axis][i][7];
    }
  }

  /// Only the costates go back.
  AIRSIM360_INLINE void SkipBack(size_t k, V8 (*after)[D]) const {
    AIRSIM360_UNROLL
    for (int axis = 0; axis < 3; ++axis) {
      NextCostate(StartCostate<double>(EndCostate(saved_[k].record, axis, after[axis])), after[axis]);
      ChangeCostateUnits<V8, D>(saved_[k - 1].duration * saved_[k].inverse, after[axis]);
    }
  }

  /// `to`: where its coefficients go, in segments of each lane.
  AIRSIM360_INLINE void BackwardStep(size_t k, size_t to, V8 (*after)[D]) {
    BackwardAxis<0>(k, to, after[0]);
    BackwardAxis<1>(k, to, after[1]);
    BackwardAxis<2>(k, to, after[2]);
  }

  template <int axis>
  AIRSIM360_INLINE void BackwardAxis(size_t k, size_t to, V8* after) {
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
    if (k + 1 == end_) {
      CloseGap<kPowers>(saved_[k].duration, saved_[k].inverse, saved_[k + 1].waypoint[axis], c);
    }
    Store(c, (3 * to + axis) * kPowers);
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
  size_t end_;  // behind the last segment whose coefficients are wanted
  Saved* saved_;
};

template <class Model>
void SolveBatch(const BatchArguments& arguments) {
  BatchSolver<Model>(arguments).Run();
}

template <class Model>
void SolveChunks(const ChunkArguments& arguments) {
  BatchSolver<Model>(arguments.lanes).RunChunks(arguments);
}

}  // namespace

const BatchKernels kBatchKernels = {
    {SolveBatch<SnapModel>, SolveBatch<QuinticModel>, SolveBatch<JerkModel>},
    {SolveChunks<SnapModel>, nullptr, SolveChunks<JerkModel>},
};

}  // namespace airsim360::internal::AIRSIM360_ISA

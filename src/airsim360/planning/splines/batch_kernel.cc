// Eight routes in the lanes, or eight overlapping chunks of one route; one forward chain each.
#include "airsim360/planning/splines/spline_kernel.h"
#include "airsim360/planning/splines/spline_lanes.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

#ifdef __AVX512F__
typedef V8 Lanes;
constexpr int kLanes = 8;
AIRSIM360_INLINE Lanes LoadLanes(const double* p) { return Load8(p); }
AIRSIM360_INLINE void StoreRow(Lanes v, double* p) { Store8(v, p); }
AIRSIM360_INLINE void Transpose(Lanes* row) { Transpose8(row); }
#else
typedef V4 Lanes;
constexpr int kLanes = 4;
AIRSIM360_INLINE Lanes LoadLanes(const double* p) { return Load4(p); }
AIRSIM360_INLINE void StoreRow(Lanes v, double* p) { Store4(v, p); }
AIRSIM360_INLINE void Transpose(Lanes* row) { Transpose4(row[0], row[1], row[2], row[3]); }
#endif

/// Puts element i of every lane's array into out(i).
template <class Out>
AIRSIM360_INLINE void LoadTransposed(const double* const* lanes, size_t count, Out&& out) {
  for (size_t at = 0; at + kLanes <= count; at += kLanes) {
    Lanes row[kLanes];
    AIRSIM360_UNROLL
    for (int i = 0; i < kLanes; ++i) row[i] = LoadLanes(lanes[i] + at);
    Transpose(row);
    AIRSIM360_UNROLL
    for (size_t i = 0; i < kLanes; ++i) out(at + i) = row[i];
  }
  for (size_t at = count / kLanes * kLanes; at < count; ++at) {
    double element[kLanes];
    AIRSIM360_UNROLL
    for (int i = 0; i < kLanes; ++i) element[i] = lanes[i][at];
    out(at) = LoadLanes(element);
  }
}

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
        next_waypoints_(first == 0 ? arguments.next_waypoints : 0),
        next_durations_(first == 0 ? arguments.next_durations : 0),
        coefficients_(arguments.coefficients + first),
        knot_(reinterpret_cast<Lanes*>(arguments.workspace)),
        saved_(reinterpret_cast<Saved*>(knot_ + arguments.stride * (arguments.segments + 1))) {}

  AIRSIM360_INLINE void Run() {
    Belief belief = {};  // at rest the mean starts at zero
    Load();
    ForwardStep(0, true, belief);
    for (size_t k = 1; k < segments_; ++k) ForwardStep(k, false, belief);
    Lanes after[3][D] = {};
    EndCostates(belief, after);
    for (size_t k = segments_; k-- > 1;) BackwardStep<false>(k, k, after);
    BackwardStep<true>(0, 0, after);
  }

  /// After Run: whether all lanes are plain. What is not finite anywhere has gone through the costates to the
  /// first segment.
  AIRSIM360_INLINE bool Check(BatchCheck& check, int first) const {
    Lanes least = saved_[0].duration, largest = least;
    for (size_t k = 1; k < segments_; ++k) {
      const Lanes duration = saved_[k].duration;
      least = duration < least ? duration : least;
      largest = duration > largest ? duration : largest;
    }
    StoreRow(least, check.least + first);
    StoreRow(largest, check.largest + first);
    StoreRow(reach_, check.reach + first);
    const auto good =
        (least >= kShortestDuration) & (largest <= kLongestDuration) & (largest <= least * kEvenRatio) & (reach_ - reach_ == Lanes{});
    long long all = -1;
    AIRSIM360_UNROLL
    for (int lane = 0; lane < kLanes; ++lane) all &= good[lane];
    return all != 0;
  }

  /// Chunks: the overlap before a chunk makes the filter forget that it did not start at the route's start,
  /// the one behind it makes the costates forget that the route goes on.
  AIRSIM360_INLINE void RunChunks(size_t overlap, const double* start, const double* end) {
    const size_t first = overlap, last = segments_ - overlap;
    Belief belief = {};
    Load();
    ForwardStep(0, true, belief);
    for (size_t k = 1; k < first; ++k) ForwardStep(k, false, belief);
    if (start != nullptr) StartLane(start, belief);
    for (size_t k = first; k < segments_; ++k) {
      ForwardStep(k, false, belief);
      if (k < last) PrefetchCoefficients(k - first);
    }

    end_ = last;
    Lanes after[3][D] = {};
    for (size_t k = segments_; k-- > last;) SkipBack(k, after);
    if (end != nullptr) EndLane(end, last, after);
    for (size_t k = last; k-- > first;) BackwardStep<false>(k, k - first, after);
  }

 private:
  static constexpr int D = Model::kStates, kPowers = Model::kDegree + 1;
  using Belief = KnotBelief<Lanes, 3, D>;
  struct Saved {
    SegmentRecord<Lanes, 3, D> record;
    Lanes duration, inverse;
  };

  AIRSIM360_INLINE void Load() {
    LoadTransposed(waypoints_, stride_ * (segments_ + 1), [&](size_t i) -> Lanes& { return knot_[i]; });
    LoadTransposed(durations_, segments_, [&](size_t i) -> Lanes& { return saved_[i].duration; });
  }
  AIRSIM360_INLINE Lanes Knot(size_t k, int axis) const { return knot_[stride_ * k + static_cast<size_t>(axis)]; }

  AIRSIM360_INLINE void ForwardStep(size_t k, bool first, Belief& belief) {
    Prefetch(next_waypoints_, 3 * k, 3);
    if (first) Prefetch(next_waypoints_, 3 * segments_, 4);  // 24 (segments + 1) numbers, not aligned
    const Lanes duration = saved_[k].duration, inverse = 1.0 / duration;
    saved_[k].inverse = inverse;
    if (!first) ChangeUnits(duration * saved_[k - 1].inverse, saved_[k - 1].duration * inverse, belief);
    const Lanes delta[3] = {Knot(k + 1, 0) - Knot(k, 0), Knot(k + 1, 1) - Knot(k, 1), Knot(k + 1, 2) - Knot(k, 2)};
    if (first) {
      StepFromRest<Model>(Model::kIsLinear, delta, saved_[k].record, belief);
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
  template <bool kFirst>
  AIRSIM360_INLINE void BackwardStep(size_t k, size_t to, Lanes (*after)[D]) {
    Prefetch(next_durations_, k, 1);
    Lanes scale[kPowers], costate_scale[D];
    PowerScales(saved_[k].inverse, scale);
    if (!kFirst) CostateScales(saved_[k - 1].duration * saved_[k].inverse, costate_scale);
    BackwardAxis<0, kFirst>(k, to, scale, costate_scale, after[0]);
    BackwardAxis<1, kFirst>(k, to, scale, costate_scale, after[1]);
    BackwardAxis<2, kFirst>(k, to, scale, costate_scale, after[2]);
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

  template <int axis, bool kFirst>
  AIRSIM360_INLINE void BackwardAxis(size_t k, size_t to, const Lanes* scale, const Lanes* costate_scale, Lanes* after) {
    const SegmentRecord<Lanes, 3, D>& record = saved_[k].record;
    const Costate<Lanes, D> end = EndCostate(record, axis, after);
    const Costate<Lanes, D> start = StartCostate<double>(end);
    Lanes c[kPowers];
    c[0] = Knot(k, axis);
    if constexpr (kFirst) {
      AIRSIM360_UNROLL
      for (int i = 1; i <= D; ++i) c[i] = Lanes{};
    } else {
      SmoothStart(record.start, axis, start, c + 1);
    }
    HighTerms<double, Model, false>(Model::kIsLinear ? end : start, c + D + 1);
    if (Model::kIsLinear && kFirst) FreeState(Knot(1, axis), c);
    AIRSIM360_UNROLL
    for (int i = 1; i < kPowers; ++i) {
      if (!kFirst || i > D || (Model::kIsLinear && i == D)) c[i] *= scale[i];
    }
    if (k + 1 == end_) {
      CloseGap<kPowers>(saved_[k].duration, saved_[k].inverse, Knot(k + 1, axis), c);
    }
    Store(c, (3 * to + axis) * kPowers);
    if constexpr (kFirst) {
      reach_ += c[kPowers - 1];
      return;
    }
    NextCostate(start, after);
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
    if constexpr (kPowers == kLanes) {
      Lanes row[kLanes];
      AIRSIM360_UNROLL
      for (int i = 0; i < kLanes; ++i) row[i] = c[i];
      Transpose(row);
      AIRSIM360_UNROLL
      for (int i = 0; i < kLanes; ++i) StoreRow(row[i], out[i]);
      return;
    }
    AIRSIM360_UNROLL
    for (int half = 0; half < kLanes / 4; ++half) {
      V4 part[kPowers];
      AIRSIM360_UNROLL
      for (int i = 0; i < kPowers; ++i) part[i] = reinterpret_cast<const V4*>(&c[i])[half];
      StorePowers<kPowers>(part, out + 4 * half, 4);
    }
  }

  /// Of one segment of each lane: the way back will write there.
  AIRSIM360_INLINE void PrefetchCoefficients(size_t segment) const {
    AIRSIM360_UNROLL
    for (int lane = 0; lane < kLanes; ++lane) {
      const char* const at = reinterpret_cast<const char*>(coefficients_[lane] + segment * 3 * kPowers);
      for (size_t i = 0; i < 3 * kPowers * sizeof(double); i += 64) __builtin_prefetch(at + i, 1);
    }
  }

  /// A little at a time: memory takes only so many requests at once.
  AIRSIM360_INLINE static void Prefetch(uintptr_t from, size_t at, size_t lines) {
    if (from == 0) return;
    for (size_t i = 0; i < lines; ++i) __builtin_prefetch(reinterpret_cast<const void*>(from + 64 * (at + i)));
  }

  size_t segments_, stride_;
  size_t end_;  // behind the last segment whose coefficients are wanted
  const double* const* waypoints_;
  const double* const* durations_;
  uintptr_t next_waypoints_, next_durations_;
  double* const* coefficients_;
  Lanes* knot_;  // [segments + 1][stride]
  Saved* saved_;
  Lanes reach_ = {};
};

template <class Model>
void SolveBatch(const BatchArguments& arguments) {
  arguments.check->plain = true;
  for (int first = 0; first < 8; first += kLanes) {
    BatchSolver<Model> solver(arguments, first);
    solver.Run();
    arguments.check->plain &= solver.Check(*arguments.check, first);
  }
}

template <class Model>
void SolveChunks(const ChunkArguments& chunks) {
  for (int first = 0; first < 8; first += kLanes) {
    const bool starts = first == 0 && chunks.has_start, ends = first + kLanes == 8 && chunks.has_end;
    BatchSolver<Model>(chunks.lanes, first).RunChunks(chunks.overlap, starts ? chunks.start : nullptr, ends ? chunks.end : nullptr);
  }
}

}  // namespace

const BatchKernels kBatchKernels = {
    {SolveBatch<SnapModel>, SolveBatch<QuinticModel>, SolveBatch<JerkModel>},
    {SolveChunks<SnapModel>, nullptr, SolveChunks<JerkModel>},
};

}  // namespace airsim360::internal::AIRSIM360_ISA

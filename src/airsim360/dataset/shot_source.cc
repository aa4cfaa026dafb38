#include "airsim360/dataset/shot_source.h"

#include <algorithm>
#include <cmath>

#include "airsim360/sim/traffic/traffic.h"

namespace airsim360::internal {
namespace {

// Whether the shot after this one is of the same take.
bool Follows(const std::vector<Shot>& shots, size_t frame) { return frame + 1 < shots.size() && !shots[frame].last; }

// Where flow leads to: the next frame of the whole flight; from the last one on, as the body moves there, for
// as long as the frame before took.
double NextSeconds(const std::vector<Shot>& shots, size_t frame) {
  constexpr double kLoneFrameSeconds = 0.1;  // a single frame has no interval of its own
  if (Follows(shots, frame)) return static_cast<double>(shots[frame + 1].t_ns - shots[frame].t_ns) * 1e-9;
  return frame > 0 && !shots[frame - 1].last ? static_cast<double>(shots[frame].t_ns - shots[frame - 1].t_ns) * 1e-9 : kLoneFrameSeconds;
}
RigidTransform NextPose(const std::vector<Shot>& shots, size_t frame) {
  if (Follows(shots, frame)) return shots[frame + 1].body.X_WB;
  return Extrapolate(shots[frame].body, NextSeconds(shots, frame));
}

// Gives entities the ids that they have in the dataset.
void Renumber(const CollectInput& input, std::vector<Capture>& captures, FrameLabels& people) {
  if (!input.renumber) return;
  const auto change = [&](EntityId& id) {
    if (id != kNoEntity) id = input.renumber(id);
  };
  for (Capture& capture : captures) {
    for (EntityId& id : capture.frame.entity.pixels()) change(id);
    for (CoveragePixel& pixel : capture.frame.coverage.pixels()) {
      for (EntityId& id : pixel.entity) change(id);
    }
  }
  for (std::vector<PersonLabel>& view : people) {
    for (PersonLabel& person : view) {
      change(person.entity);
      for (KeypointLabel& keypoint : person.keypoints) change(keypoint.occluder);
    }
  }
}

}  // namespace

ShotSource::ShotSource(const CollectInput& input) : input_(input) {
  if (input.people) dynamic_.emplace(input.tracer);
}

std::shared_ptr<const SceneState> ShotSource::Take(size_t frame, const std::vector<View>& views, const Products& products,
                                                   Renderer& renderer, std::vector<Capture>& captures) {
  const std::vector<Shot>& shots = input_.flight.shots;
  const Shot& shot = shots.at(frame);
  const std::shared_ptr<const SceneState> state = StateOf(shot);
  NextTrigger next{NextPose(shots, frame), state};
  if (products.flow) next.state = StateAfter(frame);
  for (size_t v = 0; v < views.size(); ++v) {
    PanoramicRig rig{input_.spec, views[v].camera, views[v].X_BC, products};
    rig.state = state;
    rig.gimbal = views[v].gimbal;
    CaptureRig(rig, shot.body, shot.t_ns, renderer, captures[v], &next);
  }
  return state;
}

FrameLabels ShotSource::TakeForDataset(int64_t frame, const std::vector<View>& views, Renderer& renderer, std::vector<Capture>& captures) {
  const auto i = static_cast<size_t>(frame - input_.first_frame);
  const auto state = Take(i, views, ProductsOf(input_.spec), renderer, captures);
  FrameLabels labels = Label(i, state, views, captures);
  Renumber(input_, captures, labels);
  for (Capture& capture : captures) capture.t_ns += input_.t_offset_ns;
  return labels;
}

FrameLabels ShotSource::Label(size_t frame, const std::shared_ptr<const SceneState>& state, const std::vector<View>& views,
                              const std::vector<Capture>& captures) {
  FrameLabels labels;
  if (!state || !input_.people || !input_.flight.shots.at(frame).people) return labels;
  const PeoplePoses poses = PosesOf(input_.flight.shots.at(frame));
  const std::shared_ptr<const RayTracer> tracer = dynamic_->At(state);
  for (size_t v = 0; v < captures.size(); ++v)
    labels.push_back(LabelPeople({*input_.people, poses, *tracer, views[v].camera, captures[v].X_WC}));
  return labels;
}

// The scene at a shot; nullptr if nothing moves.
std::shared_ptr<const SceneState> ShotSource::StateOf(const Shot& shot) const {
  std::optional<PeoplePoses> poses;
  if (input_.people && shot.people) poses = PosesOf(shot);
  return Shown(poses, input_.traffic ? shot.traffic : nullptr, shot.t_ns, shot);
}

// The scene that flow leads to, with the same levels of detail: the next frame's, after the last one as people and traffic would
// go on.
std::shared_ptr<const SceneState> ShotSource::StateAfter(size_t frame) const {
  const std::vector<Shot>& shots = input_.flight.shots;
  const Shot& shot = shots[frame];
  const bool last = !Follows(shots, frame);
  const int64_t t_ns = last ? shot.t_ns + std::llround(NextSeconds(shots, frame) * 1e9) : shots[frame + 1].t_ns;
  std::optional<PeoplePoses> poses;
  if (input_.people && shot.people && (last || shots[frame + 1].people)) {
    poses = last ? PosesLater(*input_.people, *shot.people, t_ns + input_.people->epoch_ns) : PosesOf(shots[frame + 1]);
    poses->levels = LevelsOf(shot);
  }
  std::shared_ptr<const TrafficState> traffic;
  if (input_.traffic && shot.traffic)
    traffic = last ? TrafficLater(*input_.traffic, shot.traffic, t_ns + input_.traffic->epoch_ns) : shots[frame + 1].traffic;
  return Shown(poses, traffic, t_ns, shot);
}

std::vector<uint8_t> ShotSource::LevelsOf(const Shot& shot) const {
  return LevelsFor(*input_.people, shot.people->crowd.people, shot.body.X_WB.p);
}

PeoplePoses ShotSource::PosesOf(const Shot& shot) const {
  PeoplePoses poses = PosesAt(*input_.people, *shot.people, shot.t_ns + input_.people->epoch_ns);
  poses.levels = LevelsOf(shot);
  return poses;
}

std::shared_ptr<const SceneState> ShotSource::Shown(const std::optional<PeoplePoses>& poses,
                                                    const std::shared_ptr<const TrafficState>& traffic, int64_t t_ns,
                                                    const Shot& seen) const {
  if (!poses && !traffic) return nullptr;
  auto state = std::make_shared<SceneState>();
  state->t_ns = t_ns;
  if (poses) ShowPeople(*input_.people, *poses, *state);
  if (traffic) {
    const int64_t epoch_ns = input_.traffic->epoch_ns;
    ShowTraffic(*input_.traffic, *traffic, t_ns + epoch_ns, *state, {seen.traffic.get(), seen.t_ns + epoch_ns});
  }
  std::ranges::sort(state->moved, {}, &MovedInstance::instance);
  return state;
}

}  // namespace airsim360::internal

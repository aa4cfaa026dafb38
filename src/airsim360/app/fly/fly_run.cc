#include "airsim360/app/fly/fly_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "airsim360/sim/en_route.h"

namespace airsim360 {
namespace {

Shot ShotOf(const SimState& state) {
  return {.t_ns = state.t_ns, .body = state.vehicles[0].motion, .people = state.people, .traffic = state.traffic};
}

constexpr int64_t kRecordPeriodNs = 10'000'000;
constexpr int64_t kLookPeriodNs = 5'000'000;  // how often a task may end; divides the period above
constexpr float kClearanceRange = 50;         // metres: farther is not told

/// Flies one task after the other and notes what happens.
class Pilot {
 public:
  Pilot(const FlyJob& job, FlyResult& result) : job_(job), result_(result), loop_(job.model), pacer_(loop_, job.speed) {
    if (!job.record_note.empty()) loop_.StartRecording(job.record_note);
    Note(*loop_.Snapshot());
    NotePicture();
  }

  /// The world at each sample of the trajectory, if frames are wanted of it.
  const std::vector<Shot>& samples() const { return samples_; }

  void Run() {
    for (const FlyTask& task : job_.tasks) RunTask(task);
    if (job_.mission) RunMission();
    const auto state = loop_.Snapshot();
    result_.pace = pacer_.report();
    result_.hash = HashState(*state);
    result_.steps = state->step;
    result_.charge = state->vehicles[0].drone.charge;
    result_.recording = loop_.StopRecording();
    if (errors_ > 0) {
      result_.tracking_rms = std::sqrt(squares_ / static_cast<double>(errors_));
      result_.tracking_max = largest_;
    }
  }

 private:
  void RunTask(const FlyTask& task) {
    job_.log(task.text);
    loop_.Post({0, FlightCommand{task.command}});
    const int64_t end_ns = loop_.t_ns() + static_cast<int64_t>(task.seconds * 1e9);
    bool done = false;
    while (!done && loop_.t_ns() < end_ns) {
      Advance(std::min(end_ns, (loop_.t_ns() / kLookPeriodNs + 1) * kLookPeriodNs));
      const auto state = loop_.Snapshot();
      Note(*state);
      Compare(task, *state);
      for (const SimEvent& event : loop_.TakeEvents()) {
        const bool finished = event.kind == SimEvent::Kind::kCommandDone;
        done |= task.until_done && (finished || event.kind == SimEvent::Kind::kCommandRefused || event.kind == SimEvent::Kind::kCrash);
        if (!finished) job_.log(DescribeEvent(event, job_.model->tracer->scene()));
        result_.events.push_back(event);
      }
    }
    if (!task.until_done || done) return;
    result_.unfinished.push_back(task.text);
    job_.log("given up: " + task.text);
  }

  void RunMission() {
    const auto pilot = std::make_shared<MissionPilot>(job_.mission);
    loop_.Attach(pilot);
    const int64_t end_ns = loop_.t_ns() + std::llround(job_.longest * 1e9);
    while (!pilot->done() && loop_.t_ns() < end_ns) {
      Advance(std::min(end_ns, (loop_.t_ns() / kLookPeriodNs + 1) * kLookPeriodNs));
      const auto state = loop_.Snapshot();
      Note(*state);
      for (const SimEvent& event : loop_.TakeEvents()) {
        if (event.kind == SimEvent::Kind::kCommandDone) continue;
        job_.log(DescribeEvent(event, job_.model->tracer->scene()));
        result_.events.push_back(event);
      }
    }
    loop_.Detach(pilot.get());
    result_.mission = pilot->progress();
    result_.captures = pilot->CapturesFrom(0);
    for (const std::string& line : result_.mission->log) job_.log(line);
  }

  // Runs on, and stops on the way wherever a picture is due or a sensor has a new reading: looking changes
  // nothing.
  void Advance(int64_t to_ns) {
    while (loop_.t_ns() < to_ns) {
      int64_t next_ns = to_ns;
      if (job_.video_fps > 0) next_ns = std::min(next_ns, PictureNs());
      if (job_.sensors != nullptr) next_ns = std::min(next_ns, job_.sensors->NextDue(loop_.t_ns()));
      pacer_.Run(next_ns);
      if (job_.video_fps > 0 && PictureNs() <= loop_.t_ns()) NotePicture();
      if (job_.sensors != nullptr) job_.sensors->Note(*loop_.Snapshot());
    }
  }
  // When the next picture is due, a whole number of steps.
  int64_t PictureNs() const {
    const int64_t dt_ns = job_.model->dt_ns;
    return std::llround(static_cast<double>(result_.video.size()) * 1e9 / job_.video_fps / static_cast<double>(dt_ns)) * dt_ns;
  }
  void NotePicture() {
    if (job_.video_fps == 0) return;
    const auto state = loop_.Snapshot();
    result_.video.push_back(ShotOf(*state));
  }

  void Note(const SimState& state) {
    const Vehicle& drone = state.vehicles[0];
    if (state.t_ns % kRecordPeriodNs != 0) return;
    result_.flight.trajectory.push_back({state.t_ns, drone.motion, drone.a_WB});
    if (job_.frames > 0) samples_.push_back(ShotOf(state));
    if (!IsEnRoute(drone)) return;
    const float clearance = job_.model->tracer->Clearance(VecCast<float>(drone.motion.X_WB.p), kClearanceRange);
    result_.least_clearance = std::min<double>(result_.least_clearance.value_or(kClearanceRange), clearance);
  }

  // Distance to where a trajectory wants the drone now.
  void Compare(const FlyTask& task, const SimState& state) {
    const auto* command = std::get_if<TrajectoryCommand>(&task.command);
    const AutopilotState& autopilot = state.vehicles[0].autopilot;
    const double t = Seconds(state.t_ns - autopilot.command_start_ns);
    if (command == nullptr || t > command->trajectory->duration()) return;
    const double error = Norm(state.vehicles[0].drone.p_WB - command->trajectory->At(t).p);
    squares_ += error * error;
    largest_ = std::max(largest_, error);
    ++errors_;
  }

  const FlyJob& job_;
  FlyResult& result_;
  std::vector<Shot> samples_;
  SimLoop loop_;
  RealTimePacer pacer_;
  double squares_ = 0, largest_ = 0;
  int64_t errors_ = 0;
};

}  // namespace

FlyResult RunFlight(const FlyJob& job) {
  FlyResult result;
  Pilot pilot(job, result);
  pilot.Run();
  // Frames at samples of the trajectory, evenly spread.
  const auto& trajectory = result.flight.trajectory;
  for (int64_t i = 0; i < job.frames; ++i) {
    const size_t last = trajectory.size() - 1;
    const size_t at = job.frames > 1 ? static_cast<size_t>(i) * last / static_cast<size_t>(job.frames - 1) : last;
    Shot shot = pilot.samples()[at];
    shot.t_ns = trajectory[at].t_ns;
    shot.body = trajectory[at].body;
    result.flight.shots.push_back(std::move(shot));
  }
  return result;
}

std::string DescribeEvent(const SimEvent& event, const Scene& scene) {
  char text[160];
  std::snprintf(text, sizeof(text), "t %.3f s: %s", Seconds(event.t_ns), kSimEventNames[static_cast<size_t>(event.kind)]);
  std::string description = text;
  if (event.collision.count > 0) {
    const EntityId id = event.collision.entity;
    std::snprintf(text, sizeof(text), " at %.2f m/s", event.collision.impact_speed);
    description += " with '" + (id != kNoEntity ? scene.entity(id).name : "another drone") + "'" + text;
  }
  return event.text.empty() ? description : description + ": " + event.text;
}

}  // namespace airsim360

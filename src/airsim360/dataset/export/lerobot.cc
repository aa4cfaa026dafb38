// LeRobot v2.1 (huggingface/lerobot): one episode, its state and actions in Parquet, the panorama as a video.
#include <cmath>
#include <limits>
#include <numbers>

#include "airsim360/dataset/export/export_job.h"
#include "airsim360/dataset/export/parquet_file.h"
#include "airsim360/video/video_writer.h"

namespace airsim360::internal {
namespace {

constexpr const char* kStateNames[] = {"x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz"};
constexpr const char* kActionNames[] = {"forward", "left", "up", "yaw_rate"};
constexpr char kVideoKey[] = "observation.images.pano";

double YawOf(const RigidTransform& X_WC) {
  const Vec3d forward = X_WC.R.column(2);
  return std::atan2(forward.y, forward.x);
}

std::vector<float> StateOf(const NativeFrame& frame, const View& view) {
  const RigidTransform X = frame.X_WC(view);
  const Quaternion q = ToQuaternion(X.R);
  const Vec3d v = frame.v_WB();
  std::vector<float> state;
  for (const double value : {X.p.x, X.p.y, X.p.z, q.w, q.x, q.y, q.z, v.x, v.y, v.z}) state.push_back(static_cast<float>(value));
  return state;
}

// Mean velocity to the next frame in the axes of the heading, m/s, and yaw rate, rad/s: what was done between the two.
std::vector<float> ActionOf(const NativeFrame& frame, const NativeFrame& next, const View& view) {
  const double dt = 1e-9 * static_cast<double>(next.t_ns - frame.t_ns);
  if (dt <= 0) return {0, 0, 0, 0};
  const RigidTransform a = frame.X_WC(view), b = next.X_WC(view);
  const Vec3d v = (b.p - a.p) / dt;
  const double yaw = YawOf(a), turn = std::remainder(YawOf(b) - yaw, 2 * std::numbers::pi);
  const double c = std::cos(yaw), s = std::sin(yaw);
  return {static_cast<float>(c * v.x + s * v.y), static_cast<float>(-s * v.x + c * v.y), static_cast<float>(v.z), static_cast<float>(turn / dt)};
}

// Of the values of one feature, by component.
struct Stats {
  std::vector<double> least, most, sum, squares;
  int64_t count = 0;
  void Add(const std::vector<float>& values) {
    if (count++ == 0) {
      least.assign(values.size(), std::numeric_limits<double>::max());
      most.assign(values.size(), std::numeric_limits<double>::lowest());
      sum.assign(values.size(), 0), squares.assign(values.size(), 0);
    }
    for (size_t i = 0; i < values.size(); ++i) {
      const double v = values[i];
      least[i] = std::min(least[i], v), most[i] = std::max(most[i], v);
      sum[i] += v, squares[i] += v * v;
    }
  }
  Json ToJson() const {
    const auto n = static_cast<double>(count);
    Json mean = Json::array(), deviation = Json::array();
    for (size_t i = 0; i < sum.size(); ++i) {
      mean.push_back(sum[i] / n);
      deviation.push_back(std::sqrt(std::max(0.0, squares[i] / n - sum[i] / n * (sum[i] / n))));
    }
    return {{"min", least}, {"max", most}, {"mean", mean}, {"std", deviation}, {"count", {count}}};
  }
};

// Of colour: one number a channel, as [[[r]], [[g]], [[b]]].
Json PictureStats(const Stats& stats) {
  Json json = stats.ToJson();
  for (const char* key : {"min", "max", "mean", "std"}) {
    for (Json& value : json[key]) value = Json::array({Json::array({value})});
  }
  return json;
}

// Frames a second; InputError where a frame is more than a tenth of a step from its even time (flights are sampled at whole
// steps of the simulation).
double EvenRate(const ExportJob& job) {
  const size_t count = job.data.size();
  job.Need(count > 1, "two frames or more", "--frames N");
  const int64_t first = job.data.Frame(0).t_ns;
  const double step = static_cast<double>(job.data.Frame(count - 1).t_ns - first) / static_cast<double>(count - 1);
  bool even = step > 0;
  for (size_t i = 1; i < count && even; ++i)
    even = std::abs(static_cast<double>(job.data.Frame(i).t_ns - first) - static_cast<double>(i) * step) <= 0.1 * step;
  job.Need(even, "frames evenly apart in time", "--fps N");
  return 1e9 / step;
}

template <size_t kCount>
Json Feature(const char* type, const char* const (&names)[kCount]) {
  return {{"dtype", type}, {"shape", {kCount}}, {"names", names}};
}

Json InfoJson(const ExportJob& job, const View& view, double rate) {
  const Json scalar_float = {{"dtype", "float32"}, {"shape", {1}}, {"names", nullptr}};
  const Json scalar_int = {{"dtype", "int64"}, {"shape", {1}}, {"names", nullptr}};
  const int width = Width(view.camera), height = Height(view.camera);
  const Json video = {{"dtype", "video"},
                      {"shape", {height, width, 3}},
                      {"names", {"height", "width", "channels"}},
                      {"info",
                       {{"video.fps", rate}, {"video.height", height}, {"video.width", width}, {"video.channels", 3}, {"video.codec", "h264"},
                        {"video.pix_fmt", "yuv420p"}, {"video.is_depth_map", false}, {"has_audio", false}}}};
  const Json features = {{"observation.state", Feature("float32", kStateNames)}, {"action", Feature("float32", kActionNames)}, {kVideoKey, video},
                         {"timestamp", scalar_float}, {"frame_index", scalar_int}, {"episode_index", scalar_int}, {"index", scalar_int}, {"task_index", scalar_int}};
  return {{"codebase_version", "v2.1"}, {"robot_type", "drone"}, {"total_episodes", 1}, {"total_frames", job.data.size()}, {"total_tasks", 1},
          {"total_videos", 1}, {"total_chunks", 1}, {"chunks_size", 1000}, {"fps", rate}, {"splits", {{"train", "0:1"}}},
          {"data_path", "data/chunk-{episode_chunk:03d}/episode_{episode_index:06d}.parquet"},
          {"video_path", "videos/chunk-{episode_chunk:03d}/{video_key}/episode_{episode_index:06d}.mp4"}, {"features", features}};
}

std::vector<ParquetFile::Value> Values(const std::vector<float>& floats) { return {floats.begin(), floats.end()}; }

}  // namespace

void ExportLeRobot(ExportJob& job) {
  job.NeedColour();
  const View& view = job.OneView();
  const double rate = EvenRate(job);
  const VideoOptions options{.frame_rate = rate, .spherical = view.projection == Projection::kErp};
  VideoWriter video(job.out.Place("videos/chunk-000/" + std::string(kVideoKey) + "/episode_000000.mp4"), Width(view.camera), Height(view.camera), options);
  using Type = ParquetFile::Type;
  ParquetFile table(job.out, "data/chunk-000/episode_000000.parquet",
                    {{"observation.state", Type::kFloat, true}, {"action", Type::kFloat, true}, {"timestamp", Type::kFloat},
                     {"frame_index", Type::kInt64}, {"episode_index", Type::kInt64}, {"index", Type::kInt64}, {"task_index", Type::kInt64}});
  Stats states, actions, colours;
  const int64_t first = job.data.Frame(0).t_ns;
  job.EachFrame([&](const NativeFrame& frame) { return job.data.Rgb(frame, view); },
                [&](const NativeFrame& frame, const Image<Rgb8>& picture) {
                  const auto i = static_cast<int64_t>(frame.position);
                  // After the last frame nothing is done any more.
                  const NativeFrame next = job.data.Frame(std::min(frame.position + 1, job.data.size() - 1));
                  const std::vector<float> state = StateOf(frame, view), action = ActionOf(frame, next, view);
                  const auto t = static_cast<float>(static_cast<double>(i) / rate);
                  table.AddRow({Values(state), Values(action), {t}, {i}, {int64_t{0}}, {i}, {int64_t{0}}});
                  states.Add(state), actions.Add(action);
                  for (size_t p = 0; p < picture.size(); p += 97)  // a sample of the pixels
                    colours.Add({picture.pixels()[p].r / 255.0f, picture.pixels()[p].g / 255.0f, picture.pixels()[p].b / 255.0f});
                  video.Add(picture, first + std::llround(1e9 * static_cast<double>(i) / rate));
                });
  table.Finish();
  video.Finish();
  const std::string task = "fly through " + job.data.spec().world;
  job.out.Write("meta/info.json", Pretty(InfoJson(job, view, rate)));
  job.out.Write("meta/tasks.jsonl", Dump({{"task_index", 0}, {"task", task}}) + "\n");
  job.out.Write("meta/episodes.jsonl", Dump({{"episode_index", 0}, {"tasks", {task}}, {"length", job.data.size()}}) + "\n");
  const Json stats = {{"observation.state", states.ToJson()}, {"action", actions.ToJson()}, {kVideoKey, PictureStats(colours)}};
  job.out.Write("meta/episodes_stats.jsonl", Dump({{"episode_index", 0}, {"stats", stats}}) + "\n");
}

}  // namespace airsim360::internal

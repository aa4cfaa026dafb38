#include "airsim360/dataset/export/lerobot_writer.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "airsim360/dataset/export/export_job.h"

namespace airsim360::internal {
namespace {

constexpr char kVideoKey[] = "observation.images.pano";
constexpr int64_t kEpisodesOfFolder = 1000;  // episodes of a folder

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

Json Feature(const char* type, const std::vector<std::string>& names) {
  return {{"dtype", type}, {"shape", {names.size()}}, {"names", names}};
}

std::vector<ParquetFile::Value> Values(const std::vector<float>& floats) { return {floats.begin(), floats.end()}; }

// "data/chunk-000/episode_000000.parquet".
std::string Place(const std::string& room, int64_t episode, const std::string& below, const char* suffix) {
  char text[96];
  std::snprintf(text, sizeof(text), "/chunk-%03lld/%sepisode_%06lld%s", static_cast<long long>(episode / kEpisodesOfFolder), below.c_str(),
                static_cast<long long>(episode), suffix);
  return room + text;
}

}  // namespace

struct LeRobotWriter::Impl {
  ExportFolder& folder;
  std::string prefix;
  LeRobotShape shape;
  std::vector<std::string> tasks = {};  // in order of arrival
  std::string episode_lines = {}, stats_lines = {};
  int64_t episodes = 0, frames = 0, pictures = 0;

  // Of the episode that has begun.
  std::string task = {};
  std::unique_ptr<VideoWriter> video = {};
  std::vector<std::pair<std::vector<float>, std::vector<float>>> rows = {};
  Stats colours = {};

  Json Info() const {
    const Json scalar_float = {{"dtype", "float32"}, {"shape", {1}}, {"names", nullptr}};
    const Json scalar_int = {{"dtype", "int64"}, {"shape", {1}}, {"names", nullptr}};
    const Json seen = {{"dtype", "video"},
                       {"shape", {shape.height, shape.width, 3}},
                       {"names", {"height", "width", "channels"}},
                       {"info",
                        {{"video.fps", shape.rate},
                         {"video.height", shape.height},
                         {"video.width", shape.width},
                         {"video.channels", 3},
                         {"video.codec", "h264"},
                         {"video.pix_fmt", "yuv420p"},
                         {"video.is_depth_map", false},
                         {"has_audio", false}}}};
    const Json features = {{"observation.state", Feature("float32", shape.state_names)},
                           {"action", Feature("float32", shape.action_names)},
                           {kVideoKey, seen},
                           {"timestamp", scalar_float},
                           {"frame_index", scalar_int},
                           {"episode_index", scalar_int},
                           {"index", scalar_int},
                           {"task_index", scalar_int}};
    return {{"codebase_version", "v2.1"},
            {"robot_type", "drone"},
            {"total_episodes", episodes},
            {"total_frames", frames},
            {"total_tasks", tasks.size()},
            {"total_videos", episodes},
            {"total_chunks", (episodes + kEpisodesOfFolder - 1) / kEpisodesOfFolder},
            {"chunks_size", kEpisodesOfFolder},
            {"fps", shape.rate},
            {"splits", {{"train", "0:" + std::to_string(episodes)}}},
            {"data_path", "data/chunk-{episode_chunk:03d}/episode_{episode_index:06d}.parquet"},
            {"video_path", "videos/chunk-{episode_chunk:03d}/{video_key}/episode_{episode_index:06d}.mp4"},
            {"features", features}};
  }

  int64_t TaskIndex() {
    for (size_t i = 0; i < tasks.size(); ++i)
      if (tasks[i] == task) return static_cast<int64_t>(i);
    tasks.push_back(task);
    return static_cast<int64_t>(tasks.size()) - 1;
  }

  void WriteRows(int64_t task_index, Stats& states, Stats& actions) {
    using Type = ParquetFile::Type;
    ParquetFile table(folder, prefix + Place("data", episodes, "", ".parquet"),
                      {{"observation.state", Type::kFloat, true},
                       {"action", Type::kFloat, true},
                       {"timestamp", Type::kFloat},
                       {"frame_index", Type::kInt64},
                       {"episode_index", Type::kInt64},
                       {"index", Type::kInt64},
                       {"task_index", Type::kInt64}});
    int64_t i = 0;
    for (const auto& [state, action] : rows) {
      const auto t = static_cast<float>(static_cast<double>(i) / shape.rate);
      table.AddRow({Values(state), Values(action), {t}, {i}, {episodes}, {frames + i}, {task_index}});
      states.Add(state), actions.Add(action);
      ++i;
    }
    table.Finish();
  }
};

LeRobotWriter::LeRobotWriter(ExportFolder& folder, std::string prefix, LeRobotShape shape)
    : impl_(new Impl{folder, std::move(prefix), std::move(shape)}) {}

LeRobotWriter::~LeRobotWriter() = default;

void LeRobotWriter::Begin(const std::string& task) {
  impl_->task = task;
  impl_->rows.clear();
  impl_->colours = {};
  const VideoOptions options{.frame_rate = impl_->shape.rate, .spherical = impl_->shape.spherical};
  const std::string place = impl_->prefix + Place("videos", impl_->episodes, std::string(kVideoKey) + "/", ".mp4");
  impl_->video = std::make_unique<VideoWriter>(impl_->folder.Place(place), impl_->shape.width, impl_->shape.height, options);
}

void LeRobotWriter::AddPicture(const Image<Rgb8>& picture, int64_t t_ns) {
  for (size_t p = 0; p < picture.size(); p += 97)  // a sample of the pixels
    impl_->colours.Add({picture.pixels()[p].r / 255.0f, picture.pixels()[p].g / 255.0f, picture.pixels()[p].b / 255.0f});
  impl_->video->Add(picture, t_ns);
}

void LeRobotWriter::AddRow(const std::vector<float>& state, const std::vector<float>& action) { impl_->rows.emplace_back(state, action); }

void LeRobotWriter::End() {
  Impl& w = *impl_;
  Stats states, actions;
  w.WriteRows(w.TaskIndex(), states, actions);
  w.video->Finish();
  w.video.reset();
  w.episode_lines += Json{{"episode_index", w.episodes}, {"tasks", {w.task}}, {"length", w.rows.size()}}.dump() + "\n";
  const Json stats = {{"observation.state", states.ToJson()}, {"action", actions.ToJson()}, {kVideoKey, PictureStats(w.colours)}};
  w.stats_lines += Json{{"episode_index", w.episodes}, {"stats", stats}}.dump() + "\n";
  w.frames += static_cast<int64_t>(w.rows.size());
  ++w.episodes;
}

void LeRobotWriter::Drop() { impl_->video.reset(); }

void LeRobotWriter::Finish() {
  const Impl& w = *impl_;
  std::string tasks;
  for (size_t i = 0; i < w.tasks.size(); ++i) tasks += Json{{"task_index", i}, {"task", w.tasks[i]}}.dump() + "\n";
  w.folder.Write(w.prefix + "meta/info.json", Pretty(w.Info()));
  w.folder.Write(w.prefix + "meta/tasks.jsonl", tasks);
  w.folder.Write(w.prefix + "meta/episodes.jsonl", w.episode_lines);
  w.folder.Write(w.prefix + "meta/episodes_stats.jsonl", w.stats_lines);
}

}  // namespace airsim360::internal

// Demonstrations as RLDS (Ramos et al. 2021) in the files of TensorFlow Datasets: one tf.train.Example an episode, its steps as lists.
#include <map>

#include "airsim360/image/codecs.h"
#include "airsim360/vln/demos/demo_writer.h"
#include "airsim360/vln/demos/tf_record.h"
#include "airsim360/vln/predicates/query_json.h"

namespace airsim360::internal {
namespace {

constexpr int kQuality = 90;
constexpr const char* kFolder = "rlds/airsim360_vln/1.0.0/";

// ------------------------------------------------------------------------------------------------ features.json

VlnJson Tensor(const char* type, const std::vector<int>& shape) {
  VlnJson dimensions = VlnJson::array();
  for (const int n : shape) dimensions.push_back(std::to_string(n));
  const VlnJson size = shape.empty() ? VlnJson::object() : VlnJson{{"dimensions", dimensions}};
  return {{"pythonClassName",
           shape.empty() ? "tensorflow_datasets.core.features.scalar.Scalar" : "tensorflow_datasets.core.features.tensor_feature.Tensor"},
          {"tensor", {{"shape", size}, {"dtype", type}, {"encoding", "none"}}}};
}
VlnJson Text() { return {{"pythonClassName", "tensorflow_datasets.core.features.text_feature.Text"}, {"text", VlnJson::object()}}; }
VlnJson Dict(const VlnJson& features) {
  return {{"pythonClassName", "tensorflow_datasets.core.features.features_dict.FeaturesDict"}, {"featuresDict", {{"features", features}}}};
}

VlnJson FeaturesJson(const DemoShape& shape) {
  const VlnJson image = {{"pythonClassName", "tensorflow_datasets.core.features.image_feature.Image"},
                         {"image",
                          {{"shape", {{"dimensions", {std::to_string(shape.height), std::to_string(shape.width), "3"}}}},
                           {"dtype", "uint8"},
                           {"encodingFormat", "jpeg"}}}};
  const VlnJson observation =
      Dict({{"image", image}, {"state", Tensor("float32", {13})}, {"rotor_speeds", Tensor("float32", {shape.rotors})}});
  const VlnJson action =
      Dict({{"velocity", Tensor("float32", {4})}, {"waypoint", Tensor("float32", {4})}, {"rotor", Tensor("float32", {shape.rotors})}});
  const VlnJson step = Dict({{"observation", observation},
                             {"action", action},
                             {"reward", Tensor("float32", {})},
                             {"discount", Tensor("float32", {})},
                             {"is_first", Tensor("bool", {})},
                             {"is_last", Tensor("bool", {})},
                             {"is_terminal", Tensor("bool", {})},
                             {"language_instruction", Text()}});
  const VlnJson metadata = Dict({{"id", Text()}, {"world", Text()}, {"weather", Text()}, {"world_seed", Tensor("int64", {})}});
  return Dict({{"steps",
                {{"pythonClassName", "tensorflow_datasets.core.features.dataset_feature.Dataset"},
                 {"sequence", {{"feature", step}, {"length", "-1"}}}}},
               {"episode_metadata", metadata}});
}

// ------------------------------------------------------------------------------------------------ records

// One feature of all steps.
template <class Of>
std::vector<float> Joined(const std::vector<DemoStep>& steps, const Of& of) {
  std::vector<float> all;
  for (const DemoStep& step : steps) {
    const auto& values = of(step);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

std::string ExampleOf(const LanguageEpisode& episode, const std::vector<DemoStep>& steps, const std::vector<std::string>& pictures) {
  const size_t n = steps.size();
  std::vector<int64_t> first(n, 0), last(n, 0);
  std::vector<float> reward(n, 0), discount(n, 1);
  first.at(0) = last.at(n - 1) = 1;
  reward.at(n - 1) = 1;
  discount.at(n - 1) = 0;
  TfExample example;
  example.Bytes("steps/observation/image", pictures);
  example.Floats("steps/observation/state", Joined(steps, [](const DemoStep& s) { return s.State(); }));
  example.Floats("steps/observation/rotor_speeds", Joined(steps, [](const DemoStep& s) { return s.rotor_speeds; }));
  example.Floats("steps/action/velocity", Joined(steps, [](const DemoStep& s) { return s.velocity; }));
  example.Floats("steps/action/waypoint", Joined(steps, [](const DemoStep& s) { return s.waypoint; }));
  example.Floats("steps/action/rotor", Joined(steps, [](const DemoStep& s) { return s.rotor_commands; }));
  example.Floats("steps/reward", reward);
  example.Floats("steps/discount", discount);
  example.Ints("steps/is_first", first);
  example.Ints("steps/is_last", last);
  example.Ints("steps/is_terminal", last);
  example.Bytes("steps/language_instruction", std::vector<std::string>(n, episode.instruction));
  for (const auto& [name, text] : {std::pair("id", episode.id), std::pair("world", episode.world), std::pair("weather", episode.weather)})
    example.Bytes(std::string("episode_metadata/") + name, std::vector<std::string>{text});
  example.Ints("episode_metadata/world_seed", std::vector<int64_t>{static_cast<int64_t>(episode.world_seed)});
  return example.Encode();
}

class RldsDemos : public DemoWriter {
 public:
  RldsDemos(ExportFolder& folder, const DemoShape& shape) : folder_(folder), shape_(shape) {}

  void Begin(const LanguageEpisode&) override { pictures_.clear(); }
  void AddPicture(const Image<Rgb8>& picture, int64_t) override {
    const Bytes jpeg = EncodeJpeg(picture, kQuality);
    pictures_.emplace_back(AsText(jpeg));
  }
  void End(const LanguageEpisode& episode, const std::vector<DemoStep>& steps, bool keep) override {
    if (!keep) return;
    const std::string split = episode.split.empty() ? "train" : episode.split;
    auto& shard = shards_[split];
    if (!shard.file)
      shard.file = std::make_unique<GrowingFile>(folder_, std::string(kFolder) + "airsim360_vln-" + split + ".tfrecord-00000-of-00001");
    shard.file->Append(TfRecord(ExampleOf(episode, steps, pictures_)));
    ++shard.episodes;
  }

  void Finish() override {
    VlnJson splits = VlnJson::array();
    for (auto& [name, shard] : shards_) {
      splits.push_back({{"name", name},
                        {"filepathTemplate", "{DATASET}-{SPLIT}.{FILEFORMAT}-{SHARD_X_OF_Y}"},
                        {"numBytes", std::to_string(shard.file->size())},
                        {"shardLengths", {std::to_string(shard.episodes)}}});
      shard.file->Close();
    }
    const VlnJson info = {{"name", "airsim360_vln"},
                          {"version", "1.0.0"},
                          {"description", "Flights by instructions, made by airsim360 vln demos."},
                          {"fileFormat", "tfrecord"},
                          {"moduleName", "airsim360_vln"},
                          {"splits", splits}};
    folder_.Write(std::string(kFolder) + "dataset_info.json", info.dump(2) + "\n");
    folder_.Write(std::string(kFolder) + "features.json", FeaturesJson(shape_).dump(2) + "\n");
  }

 private:
  struct Shard {
    std::unique_ptr<GrowingFile> file;
    int64_t episodes = 0;
  };
  ExportFolder& folder_;
  DemoShape shape_;
  std::vector<std::string> pictures_;
  std::map<std::string, Shard> shards_;
};

}  // namespace

std::unique_ptr<DemoWriter> MakeRldsDemos(ExportFolder& folder, const DemoShape& shape) {
  return std::make_unique<RldsDemos>(folder, shape);
}

}  // namespace airsim360::internal

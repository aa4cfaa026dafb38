#include <algorithm>
#include <array>

#include "airsim360/app/flags/config_flags.h"
#include "airsim360/app/flags/picture_arguments.h"
#include "airsim360/app/plan/plan_output.h"
#include "airsim360/app/program/help.h"
#include "airsim360/dataset/record/spec.h"
#include "airsim360/flight/drones/catalog.h"
#include "airsim360/scene/environment.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

using std::string_view;

struct FlagGroup {
  string_view name, flags;  // apart by spaces, with a space at both ends
};

constexpr auto kGroups = std::to_array<FlagGroup>({
    {"World",
     " --world --labels --heights --no-fill --recipe --subset --settings --seed --episodes --bbox --centre "
     "--scale --up --offset --ground "},
    {"Drone",
     " --drone --real --file --catalog --words --form --llm --llm-model --llm-key-env --llm-seconds --check "
     "--controller --sensors --wind "},
    {"Route",
     " --waypoints --route --plan --pose --script --mission --longest --from --to --avoid --clearance --area --height --spacing "
     "--heading --center --entity --radius --turns --length --yaw --origin --poses --start "},
    {"Limits",
     " --vmax --amax --axis-vmax --axis-amax --climb --descent --dt --order --minimise --speed --realtime "
     "--lockstep "},
    {"Camera",
     " --projection --cameras --size --fov --pano-frame --lens --look --width --cube --axes --depth-z --nearest "
     "--filter "
     "--ppd --wrap "},
    {"Look", ""},     // what CameraLook names, for --look photo
    {"Quality", ""},  // and what else RenderSettings names
    {"People", " --people --people-warmup --people-level --people-reserve --sockets --overlay "},
    {"Traffic", " --traffic --traffic-warmup "},
    {"Weather", " --weather --clouds --sky-seed --sun --time --place --hdri --environment --latitude --min-sun --rural "},
    {"Measuring",
     " --tiers --seconds --weights --seam --latitude-bands --rolled --classes --ignore --open-world --protocol --type --kind --class-agnostic --max-detections "
     "--min-depth --max-depth --clip --pred-scale --gt-scale --png-scale --h5-key --pred-dir --gt-dir --visible --windows --things --void --bootstrap --force "
     "--worst --sheet "},
    {"Output",
     " --out --frames --fps --shard --products --normal --radiance --format --rgb-format --video --encoder "
     "--quality --record --buildings --csv --count --dataset --routes --worlds --shard-mb --points --method --parallax --bits --model --apply --html --export --json "},
    {"Further", ""},
    {"Machine", " --threads --device --gpu --processes --no-cache --host --port --connect --lease --vehicle --help --version "},
});

constexpr auto kGroupNames = [] {
  std::array<string_view, kGroups.size()> names;
  for (size_t i = 0; i < kGroups.size(); ++i) names[i] = kGroups[i].name;
  return names;
}();

constexpr auto kExamples = std::to_array<CommandExample>({
    {"worlds", "airsim360 worlds", "lists the worlds that are built in"},
    {"worlds", "airsim360 worlds --count city_park --json", "how many triangles, entities and pixels of what one holds"},
    {"world export", "airsim360 world export city_park --out park.glb", "for Blender, and back in with --world park.glb"},
    {"world export", "airsim360 world export new_york_city --seed 7 --out city.glb", "another city of the same kind"},
    {"world import", "airsim360 world import town.osm.pbf", "what a map holds"},
    {"world import", "airsim360 world import town.osm.pbf --heights ground.tif --out town", "with hills, as --world town.yaml"},
    {"world entities", "airsim360 world entities downtown_west", "names, categories and places of everything"},
    {"world entities", "airsim360 world entities downtown_west --csv > entities.csv", "with boxes, for a spreadsheet"},
    {"world rooms", "airsim360 world rooms apartment", "rooms with their sizes, doors with their states"},
    {"world rooms", "airsim360 world rooms mall --json > mall.json", "outlines, heights and doors, for programs"},
    {"world sheet", "airsim360 world sheet city_park --out park.jpg", "the world from 16 places at four heights"},
    {"world sheet", "airsim360 world sheet box_room --poses 4 --heights 1.6,3 --out room.png", "from four, at two"},
    {"world make", "airsim360 world make \"a small coastal town with a church and a marina, 40 ha, narrow streets\" --out town.yaml",
     "a town from words, as --world town.yaml"},
    {"world make", "airsim360 world make \"wooden cabins in a forest by a lake, no cars\" --seed 3 --out cabins.yaml",
     "another draw of another place"},
    {"render", "airsim360 render --world downtown_west --pose -19,0,1.7,45 --out street",
     "a panorama from the street, looking north-east, with range, classes and entities"},
    {"render",
     "airsim360 render --world city_park --projection pinhole --fov 70 --tier high --weather sunset --out "
     "picture",
     "an ordinary picture of higher quality, at sunset"},
    {"collect", "airsim360 collect --world new_york_city --frames 100 --out dataset", "100 labelled panoramas on a way through the city"},
    {"collect",
     "airsim360 collect --world city_park --route route.csv --size 1024x512 --products normal,flow --out "
     "dataset",
     "at the waypoints of a file, with normals and flow; the same line again finishes what was interrupted"},
    {"plan", "airsim360 plan --waypoints points.csv --vmax 8 --amax 4 --out flight.csv",
     "the smoothest flight through points, as samples of time, place, velocity and acceleration"},
    {"plan",
     "airsim360 plan --world downtown_west --from -19,0,2 --to 60,40,10 --vmax 8 --amax 4 --format json,svg "
     "--out flight",
     "a way round everything, and a drawing of it"},
    {"verify", "airsim360 verify dataset", "whether every file of a dataset is there and unharmed"},
    {"verify", "airsim360 verify dataset --json", "the same, for programs"},
    {"dataset plan", "airsim360 dataset plan omni360-mini --out plan.json", "where each of its frames is, under which sky"},
    {"dataset plan", "airsim360 dataset plan plan.json --show 2 --json", "frame 2 of a plan, for programs"},
    {"dataset run", "airsim360 dataset run omni360-mini --out mini", "makes the reference dataset; again after an interruption"},
    {"dataset run", "airsim360 dataset run plan.json --shard 0/8 --out shard0", "the first eighth, for one machine of eight"},
    {"dataset merge", "airsim360 dataset merge shard0 shard1 --out mini", "one dataset of two shards"},
    {"dataset merge", "airsim360 dataset merge shard0 shard1 --out mini --json", "the same, for programs"},
    {"dataset status", "airsim360 dataset status plan.json mini", "how many frames are done"},
    {"dataset status", "airsim360 dataset status plan.json shard0 shard1 --array 2", "which shards are not"},
    {"dataset slurm", "airsim360 dataset slurm plan.json --array 100 --out job.sh", "a script for sbatch"},
    {"dataset slurm", "airsim360 dataset slurm plan.json --array 8 --backend xargs --out local.sh", "eight shards on this machine"},
    {"dataset export", "airsim360 dataset export town --format omni360 --out town_omni360", "in the layout of the AirSim360 release"},
    {"dataset export", "airsim360 dataset export town --format webdataset --shard-mb 500 --out shards", "tar files for training"},
    {"dataset dedupe", "airsim360 dataset dedupe town", "which frames show what an earlier one shows"},
    {"dataset dedupe", "airsim360 dataset dedupe town --parallax 0.05 --apply", "removes them, with a wider net"},
    {"dataset card", "airsim360 dataset card town", "what it holds, as Markdown"},
    {"dataset card", "airsim360 dataset card town --html", "writes town/index.html to look through it"},
    {"video", "airsim360 video dataset --out film.mp4", "the panoramas of a dataset as a 360 degree video"},
    {"video", "airsim360 video dataset --fps 10 --encoder libx264 --out film.mp4", "ten a second, the same bytes on any machine"},
    {"stitch", "airsim360 stitch --cube faces --out panorama.png", "six square pictures become one panorama"},
    {"stitch", "airsim360 stitch --cube depth --depth-z --out range.exr", "planar depth becomes range along the ray"},
    {"eval image", "airsim360 eval image mine.png reference.png", "how much two pictures differ"},
    {"eval image", "airsim360 eval image mine.png reference.png --wrap --json", "of panoramas, for programs"},
    {"eval statistics", "airsim360 eval statistics panorama.png", "figures about one panorama"},
    {"eval statistics", "airsim360 eval statistics first.png second.png --json", "of two, for programs"},
    {"eval depth", "airsim360 eval depth predictions town/range", "errors of predicted ranges, a file a picture"},
    {"eval depth", "airsim360 eval depth predictions town --weights solid_angle --latitude-bands 6 --json",
     "by steradians, and in six bands of latitude"},
    {"eval semantic", "airsim360 eval semantic predictions town --classes town/meta.json", "mIoU of label pictures"},
    {"eval semantic", "airsim360 eval semantic predictions labels --classes classes.txt --bootstrap 1000 --csv classes.csv",
     "with 95 % intervals, and a table of classes"},
    {"eval panoptic", "airsim360 eval panoptic predictions.json town/panoptic.json", "panoptic quality"},
    {"eval panoptic", "airsim360 eval panoptic pred.json gt.json --pred-dir pred --gt-dir gt --json",
     "of pictures elsewhere, for programs"},
    {"eval video", "airsim360 eval video predictions.json town/panoptic.json", "STQ and VPQ of frames that follow each other"},
    {"eval video", "airsim360 eval video pred gt --things 11,13 --json", "of STEP's PNGs"},
    {"eval entity", "airsim360 eval entity results.json instances.json --class-agnostic", "average precision of entities"},
    {"eval entity", "airsim360 eval entity results.json instances.json --max-detections 1,10,300 --json",
     "with up to 300 detections a picture"},
    {"eval keypoints", "airsim360 eval keypoints results.json person_keypoints.json", "average precision by OKS"},
    {"eval keypoints", "airsim360 eval keypoints results.json person_keypoints.json --bootstrap 200 --json", "with 95 % intervals"},
    {"eval boxes", "airsim360 eval boxes results.json boxes.json --kind bfov", "boxes on the sphere, by the unbiased IoU"},
    {"eval boxes", "airsim360 eval boxes results.json boxes.json --wrap --json", "boxes in panoramas whose columns go round"},
    {"eval flow", "airsim360 eval flow predictions town --visible", "end-point error and angle of what stays visible"},
    {"eval flow", "airsim360 eval flow pred.flo gt.flo --json", "of one picture, for programs"},
    {"eval layout", "airsim360 eval layout predictions corners", "IoU, corner and pixel errors of rooms"},
    {"eval layout", "airsim360 eval layout room.json room.txt --size 2048x1024 --json", "of one room, for programs"},
    {"eval mpde", "airsim360 eval mpde predictions.json people.json", "errors of distance and orientation of people"},
    {"eval mpde", "airsim360 eval mpde predictions.jsonl people.jsonl --bootstrap 1000 --json", "with 95 % intervals"},
    {"eval vln", "airsim360 eval vln episodes.jsonl results.jsonl", "scores of navigation by instruction"},
    {"eval vln", "airsim360 eval vln results.json --radius 20 --protocol openfly --json",
     "by another benchmark's rules, of one file that holds both paths"},
    {"mpde train", "airsim360 mpde train human --views kitti --out distance.safetensors",
     "on people of a dataset, seen by cameras like KITTI's"},
    {"mpde train", "airsim360 mpde train human joints.json@0.3 --views kitti --steps 4000 --out distance.safetensors",
     "with real people in three of thirteen samples"},
    {"mpde eval", "airsim360 mpde eval joints.json --networks distance.safetensors", "errors of distance and orientation"},
    {"mpde eval", "airsim360 mpde eval human --views kitti --networks a.safetensors b.safetensors --json",
     "of two networks together, for programs"},
    {"mpde splits", "airsim360 mpde splits human", "whether train and test share anything"},
    {"mpde splits", "airsim360 mpde splits human --json", "the same, for programs"},
    {"mpde table", "airsim360 mpde table human --out table.json", "the paper's four rows, three seeds each"},
    {"mpde table", "airsim360 mpde table human --real kitti=joints.json --seeds 1", "with a real test set, one seed"},
    {"fly", "airsim360 fly --world box_room --script \"takeoff 2; goto 2,2,3; hover 2; return\" --out flight",
     "take off, go somewhere, come back"},
    {"fly",
     "airsim360 fly --world downtown_west --waypoints points.csv --vmax 8 --video flight.mp4 --fps 15 --out "
     "flight",
     "through points, filmed"},
    {"fly", "airsim360 fly --world box_room --mission survey.xml --out survey", "a mission; what it captures becomes datasets"},
    {"serve", "airsim360 serve --world downtown_west", "AirSim's clients connect to port 41451"},
    {"serve", "airsim360 serve --world box_room --settings settings.json --lockstep",
     "with AirSim's settings; time stands still between calls"},
    {"agent", "airsim360 agent --world downtown_west", "episodes at http://127.0.0.1:8361"},
    {"agent", "airsim360 agent --world city_park --port 0 --tier high --weather overcast", "at any free port, with finer pictures"},
    {"vln templates", "airsim360 vln templates", "the paper's instructions, and what they ask for"},
    {"vln templates", "airsim360 vln templates --json", "the same, for programs"},
    {"vln make", "airsim360 vln make --world downtown_west --seeds 3 --out episodes.jsonl", "the paper's instructions in three towns"},
    {"vln make", "airsim360 vln make --world city_park --templates any --out park.jsonl",
     "instructions of the same style for another world"},
    {"vln check", "airsim360 vln check episodes.jsonl", "whether each means one thing and can be reached, by a second method"},
    {"vln check", "airsim360 vln check episodes.jsonl --json", "the same, for programs"},
    {"vln import", "airsim360 vln import val_unseen.json --format aerialvln --world town.glb --out episodes.jsonl",
     "episodes of AerialVLN, flown in a world of yours"},
    {"vln import", "airsim360 vln import uavon.json --format uavon --world downtown_west --out episodes.jsonl --json",
     "of UAV-ON, for programs"},
    {"vln export", "airsim360 vln export episodes.jsonl --format aerialvln --out aerialvln.json", "for code written for AerialVLN"},
    {"vln export", "airsim360 vln export episodes.jsonl --format citynav --out citynav.json", "for code written for CityNav"},
    {"vln run", "airsim360 vln run episodes.jsonl --agent oracle --out oracle.jsonl", "along the reference paths"},
    {"vln run", "airsim360 vln run episodes.jsonl --agent mask --view front --decisions yomo --out front.jsonl",
     "a perfect recogniser behind a camera, that moves once"},
    {"vln demos", "airsim360 vln demos episodes.jsonl --layout jsonl,lerobot --out demos",
     "flights of the oracle with videos, states and actions"},
    {"vln demos", "airsim360 vln demos episodes.jsonl --layout rlds --width 256 --limit 20 --out rlds", "as records of TensorFlow"},
    {"vln report", "airsim360 vln report oracle.jsonl front.jsonl --out report.html", "both side by side"},
    {"vln report", "airsim360 vln report oracle.jsonl --out report.html --json", "of one, for programs"},
    {"vln submit", "airsim360 vln submit episodes.jsonl oracle.jsonl --name oracle --out oracle.json", "one sealed file of a run"},
    {"vln submit", "airsim360 vln submit episodes.jsonl model.jsonl --transcript model.transcript.jsonl --out model.json",
     "of a model's run"},
    {"vln verify", "airsim360 vln verify oracle.json episodes.jsonl", "scores it again"},
    {"vln verify", "airsim360 vln verify oracle.json episodes.jsonl --fly", "flies it again"},
    {"language make", "airsim360 language make --world new_york_city --kind vqa --count 5000 --layout vqa --out vqa.jsonl",
     "questions, each asked with each of its answers"},
    {"language make", "airsim360 language make --world rome --kind refer --count 500 --pictures --out rome/refer.jsonl",
     "expressions that mean one thing, and the pictures"},
    {"language check", "airsim360 language check vqa.jsonl", "whether each has exactly the answer that it gives, by a second method"},
    {"language check", "airsim360 language check vqa.jsonl --json", "the same, for programs"},
    {"learn", "airsim360 learn segment train --out seg", "draws frames of many worlds, learns classes of outdoor pictures"},
    {"learn", "airsim360 learn segment apply photo.jpg --model seg --out labels", "of photographs"},
    {"view", "airsim360 view town", "a dataset, at http://127.0.0.1:8360"},
    {"view", "airsim360 view town --compare other", "two, side by side"},
    {"view", "airsim360 view town --export site", "the same page as files, for any server of files"},
    {"view", "airsim360 view --world downtown_west --record kept", "a world to fly in; frames that are kept become datasets"},
    {"view", "airsim360 view --connect 127.0.0.1:41451", "the world of a running airsim360 serve"},
    {"view", "airsim360 view plan.json", "frames of a plan, drawn when they are looked at"},
    {"people nodes", "airsim360 people nodes --xml > nodes.xml", "the palette, for Groot2"},
    {"people nodes", "airsim360 people nodes --mission", "what missions of drones are made of"},
    {"people trees", "airsim360 people trees --out trees.xml", "the trees of the default crowd, to begin with"},
    {"people trees", "airsim360 people trees survey.xml --mission", "checks a mission and writes it a line a node"},
    {"traffic", "airsim360 traffic --world new_york_city --traffic 200 --people 200",
     "ten minutes of a busy city: standstills, near misses"},
    {"traffic", "airsim360 traffic --traffic 60 --seconds 3600 --json", "an hour, every near miss with names, place and time"},
    {"drone", "airsim360 drone \"a 250 g five-inch racing quad\" --out racer.yaml", "a drone from words, for fly --drone racer.yaml"},
    {"drone", "airsim360 drone --catalog", "the real drones that are known"},
    {"environments sample", "airsim360 environments sample 24 --seed 7", "24 skies of a temperate year, by day"},
    {"environments sample", "airsim360 environments sample 5 --latitude -23 --min-sun 10 --json",
     "of the tropic of Capricorn, with month, hour and kind of sky"},
    {"bench", "airsim360 bench", "milliseconds a panorama by tier, and steps of the simulation a second"},
    {"bench", "airsim360 bench --world new_york_city --people 100 --traffic 100 --json", "of a busy city, for programs"},
    {"doctor", "airsim360 doctor", "what is missing on this machine, and the command that installs it"},
    {"doctor", "airsim360 doctor --json", "the same, for programs"},
    {"completion", "airsim360 completion bash > ~/.local/share/bash-completion/completions/airsim360", "for bash, from the next shell on"},
    {"completion", "airsim360 completion fish > ~/.config/fish/completions/airsim360.fish", "for fish"},
    {"man", "airsim360 man ~/.local/share/man/man1", "then 'man airsim360' and 'man airsim360-render'"},
    {"man", "airsim360 man", "the page of the program, to the terminal"},
    {"help", "airsim360 help", "all commands"},
    {"help", "airsim360 help world export", "flags and examples of one"},
});

bool Holds(string_view list, string_view word) {
  const size_t at = list.find(word);
  return at != string_view::npos && at > 0 && list[at - 1] == ' ' && list[at + word.size()] == ' ';
}

std::vector<std::string> Words(string_view text) {
  std::vector<std::string> words;
  while (!text.empty()) {
    const size_t space = std::min(text.find(' '), text.size());
    words.emplace_back(text.substr(0, space));
    text.remove_prefix(std::min(space + 1, text.size()));
  }
  return words;
}

// Flags whose values are the same in every command.
constexpr std::pair<string_view, string_view> kFixedChoices[] = {
    {"--device", "auto cpu vulkan"},
    {"--projection", "erp cube pinhole fisheye"},
    {"--controller", "simple_flight px4 se3 indi"},
    {"--minimise", "snap jerk"},
    {"--order", "5 7"},
    {"--encoder", "auto libx264 libx265 h264_nvenc hevc_nvenc h264_vaapi hevc_vaapi"},
    {"--filter", "linear nearest"},
    {"--axes", "camera body opengl"},
    {"--dataset", "waypoint"},
    {"--recipe", "omni360-human"},
    {"--weights", "pixel solid_angle"},
    {"--type", "segm bbox"},
    {"--kind", "bbox bfov box3d"},
    {"shell", "bash zsh fish"},
};

}  // namespace

std::span<const CommandExample> CommandExamples() { return kExamples; }

std::span<const string_view> FlagGroups() { return kGroupNames; }

string_view GroupOfFlag(string_view flag) {
  if (flag.starts_with("-h,") || flag.starts_with("-V,")) return "Machine";
  for (const FlagGroup& group : kGroups) {
    if (Holds(group.flags, flag)) return group.name;
  }
  const std::vector<std::string> looks = ConfigFlagNames([](ConfigVisitor& v) { CameraLook().Visit(v); });
  if (std::ranges::count(looks, flag) > 0) return "Look";
  return std::ranges::count(PictureFlagNames(), flag) > 0 ? "Quality" : "Further";
}

std::vector<std::string> ChoicesOf(string_view command, string_view flag) {
  std::vector<std::string> names;
  if (flag == "--world" || flag == "--worlds" || flag == "world" || flag == "--count") {
    for (const WorldInfo& world : ListWorlds()) names.push_back(world.name);
    return names;
  }
  if (flag == "--drone" || flag == "--real") {
    for (const CatalogDrone& drone : DroneCatalog()) names.emplace_back(drone.name);
    return names;
  }
  if (flag == "--weather") return EnvironmentPresetNames();
  if (flag == "--clouds") return CloudPresetNames();
  if (flag == "--format")
    return command == "plan" ? PlanFormats() : Words("native coco video coco_keypoints kitti nuscenes monoloco crops overlay");
  if (flag == "--route") return Words(command == "plan" ? "coverage orbit road random" : "auto");
  if (flag == "--products") {
    for (const ProductInfo& product : kProducts) {
      if (!product.always) names.emplace_back(product.name);
    }
    return names;
  }
  if (command.starts_with("eval") && flag == "--projection") return Words("erp cube tangent");
  if (flag == "--protocol" && command == "eval depth") return Words("unik3d deep360 pano3d");
  if (flag == "--protocol" && command == "eval entity") return Words("coco entityseg");
  if (flag == "--kind" && command == "language make") return Words("caption refer vqa");
  if (flag == "--layout" && command == "language make") return Words("vqa refcoco llava");
  if (flag == "--layout" && command == "vln demos") return Words("jsonl rlds lerobot");
  if (flag == "--protocol" && command == "eval vln") return Words("ours aerialvln openfly citynav-mgp citynav-vlnce traveluav uavon");
  for (const auto& [name, choices] : kFixedChoices) {
    if (name == flag) return Words(choices);
  }
  return ConfigFlagChoices([](ConfigVisitor& v) { DatasetSpec().Visit(v); }, flag);
}

bool TakesFiles(string_view flag) {
  return Holds(
      " --world --labels --heights --recipe --settings --drone --file --sensors --wind --waypoints --route "
      "--plan "
      "--cube --people --sockets --hdri --out --video --classes --sheet --csv --pred-dir --gt-dir world file files first second DIR pred gt episodes results ",
      flag);
}

}  // namespace airsim360

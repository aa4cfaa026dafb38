#include "airsim360/vln/language/lexicon.h"

#include <algorithm>
#include <set>

namespace airsim360 {
namespace {

// Larger ones are many things merged into one, or no thing that one points at, metres.
constexpr float kLargest = 30, kSmallest = 0.25f;

struct Row {
  const char *one, *many;
  std::vector<std::string> categories, alike = {}, names = {};
};

// Entities that are several things or only look like one from far away.
const std::vector<std::string>& Merged() {
  static const std::vector<std::string> kMerged = {"wood of *", "far *", "planting bed*", "similar *"};
  return kMerged;
}

// Longer than a screen because it is a table: a row for each word.
const std::vector<Row>& Rows() {
  static const std::vector<Row> kRows = {
      {"fountain", "fountains", {"construction/fountain"}},
      {"phone booth", "phone booths", {"construction/phone_booth"}},
      {"statue", "statues", {"construction/statue"}},
      {"windmill", "windmills", {"construction/windmill"}, {"construction/tower"}},
      {"well", "wells", {"construction/well"}, {"construction/fountain"}},
      {"scaffold", "scaffolds", {"construction/scaffolding"}},
      {"bed", "beds", {"furniture/bed"}, {"furniture/sofa"}},
      {"sofa", "sofas", {"furniture/sofa"}, {"furniture/bed", "furniture/seating"}},
      {"table", "tables", {"furniture/table"}, {"furniture/desk", "furniture/counter"}},
      {"desk", "desks", {"furniture/desk"}, {"furniture/table"}},
      {"chair", "chairs", {"furniture/seating/chair", "furniture/seating/office_chair"}, {"furniture/sofa", "furniture/seating"}},
      {"armchair", "armchairs", {"furniture/seating/armchair"}, {"furniture/seating/chair", "furniture/sofa"}},
      {"bench", "benches", {"furniture/seating/bench"}, {"furniture/seating/chair", "furniture/sofa"}},
      {"shelf", "shelves", {"furniture/shelf"}, {"furniture/cabinet", "furniture/bookcase", "furniture/rack"}},
      {"bookcase", "bookcases", {"furniture/bookcase"}, {"furniture/shelf", "furniture/cabinet", "furniture/rack"}},
      {"cabinet",
       "cabinets",
       {"furniture/cabinet"},
       {"furniture/shelf", "furniture/wardrobe", "furniture/chest_of_drawers", "furniture/counter"}},
      {"wardrobe", "wardrobes", {"furniture/wardrobe"}, {"furniture/cabinet", "furniture/bookcase"}},
      {"washing machine", "washing machines", {"furniture/electronics/washing_machine"}, {"furniture/kitchen", "furniture/electronics"}},
      {"refrigerator",
       "refrigerators",
       {"furniture/electronics/refrigerator"},
       {"furniture/wardrobe", "furniture/cabinet", "furniture/vending"}},
      {"television", "televisions", {"furniture/electronics/television"}, {"furniture/electronics", "furniture/painting"}},
      {"vending machine", "vending machines", {"furniture/vending/machine"}, {"furniture/electronics/refrigerator"}},
      {"toilet", "toilets", {"furniture/toilet"}},
      {"bathtub", "bathtubs", {"furniture/bathtub"}},
      {"coat rack", "coat racks", {"furniture/coat_rack"}},
      {"whiteboard", "whiteboards", {"furniture/whiteboard"}, {"furniture/painting", "furniture/mirror"}},
      {"radiator", "radiators", {"furniture/radiator"}},
      {"pallet", "pallets", {"furniture/pallet"}},
      {"forklift", "forklifts", {"vehicle/forklift"}},
      {"fire extinguisher", "fire extinguishers", {"construction/service/fire_extinguisher"}},
      {"exit sign", "exit signs", {"signage/exit_sign"}},
      {"painting", "paintings", {"furniture/painting"}, {"furniture/mirror", "signage/poster"}},
      {"mirror", "mirrors", {"furniture/mirror"}, {"furniture/painting"}},
      {"rug", "rugs", {"furniture/rug"}},
      {"vase", "vases", {"furniture/vase"}, {"furniture/planter"}},
      {"lamp", "lamps", {"furniture/lighting/lamp"}},
      {"street lamp",
       "street lamps",
       {"furniture/lighting/lamp_post", "furniture/lighting/street_light"},
       {"construction/mast", "traffic/control/traffic_light"}},
      {"mailbox", "mailboxes", {"furniture/mail/post_box"}, {"furniture/misc", "furniture/utility/electric_box", "furniture/waste"}},
      {"parasol", "parasols", {"furniture/shade/umbrella"}, {"furniture/shade/tarp", "object/umbrella"}},
      {"plant pot", "plant pots", {"furniture/planter"}, {"furniture/vase", "vegetation/flower"}},
      {"playground", "playgrounds", {"furniture/recreation/playground"}},
      {"bus stop", "bus stops", {"furniture/transit/bus_stop"}},
      {"fire hydrant", "fire hydrants", {"furniture/utility/fire_hydrant"}, {"traffic/bollard"}},
      {"parking meter", "parking meters", {"furniture/utility/parking_meter", "traffic/control/parking_meter"}, {"traffic/bollard"}},
      {"hot dog cart", "hot dog carts", {"furniture/vending/hotdog_cart"}, {"furniture/vending/food_cart", "furniture/vending/food_stall"}},
      {"market stall",
       "market stalls",
       {"furniture/vending/food_stall"},
       {"furniture/vending/hotdog_cart", "furniture/vending/food_cart", "furniture/shade"}},
      {"trash can", "trash cans", {"furniture/waste/trash_can"}, {"furniture/waste", "furniture/misc", "furniture/mail"}},
      {"wheelie bin", "wheelie bins", {"furniture/waste/trash"}, {"furniture/waste/recycle_bin", "furniture/waste/trash_can"}},
      {"rock", "rocks", {"nature/rock"}},
      {"billboard", "billboards", {"signage/billboard"}, {"signage/poster", "signage/poster_stand", "signage/shop_sign"}},
      {"flag", "flags", {"signage/flag"}},
      {"poster stand", "poster stands", {"signage/poster_stand"}, {"signage/billboard", "signage/poster"}},
      {"traffic sign", "traffic signs", {"signage/traffic_sign"}, {"signage/poster_stand"}},
      {"concrete block", "concrete blocks", {"traffic/barrier/concrete_block"}, {"traffic/barrier"}},
      {"barricade", "barricades", {"traffic/barrier/metal_barricade"}, {"traffic/barrier", "barrier"}},
      {"bollard",
       "bollards",
       {"traffic/bollard"},
       {"traffic/temporary/tube", "furniture/utility/fire_hydrant", "barrier/rope_bollard", "furniture/lighting/lamp_post"}},
      {"traffic light", "traffic lights", {"traffic/control/traffic_light"}},
      {"traffic cone", "traffic cones", {"traffic/temporary/cone"}, {"traffic/temporary"}},
      {"traffic barrel", "traffic barrels", {"traffic/temporary/traffic_barrel"}, {"traffic/temporary"}},
      {"tree", "trees", {"vegetation/tree"}, {"vegetation/shrub", "vegetation/plant", "vegetation/hedge"}},
      {"bicycle", "bicycles", {"vehicle/bicycle"}, {"vehicle/motorcycle"}},
      {"motorcycle", "motorcycles", {"vehicle/motorcycle"}, {"vehicle/bicycle"}},
      {"boat", "boats", {"vehicle/boat"}},
      {"bus", "buses", {"vehicle/bus"}, {"vehicle/tram", "vehicle/food_truck"}},
      {"cab", "cabs", {"vehicle/car"}, {}, {"taxi"}},
      {"car", "cars", {"vehicle/car"}, {"vehicle/van"}},
      {"van", "vans", {"vehicle/van"}, {"vehicle/truck", "vehicle/food_truck"}},
      {"food truck", "food trucks", {"vehicle/food_truck"}, {"vehicle/truck", "vehicle/van"}},
      {"truck", "trucks", {"vehicle/truck"}, {"vehicle/food_truck", "vehicle/van"}},
      {"tram", "trams", {"vehicle/tram"}, {"vehicle/bus", "vehicle/train"}},
      {"train", "trains", {"vehicle/train"}, {"vehicle/tram"}},
      {"airplane", "airplanes", {"vehicle/airplane"}},
      {"helicopter", "helicopters", {"vehicle/helicopter"}},
      {"box", "boxes", {"furniture/box"}, {"furniture/utility/electric_box"}},
      {"dog", "dogs", {"animal/dog"}},
      {"cat", "cats", {"animal/cat"}},
      {"horse", "horses", {"animal/horse"}},
      {"bird", "birds", {"animal/bird"}}};
  return kRows;
}

bool IsBelow(const std::string& path, const std::vector<std::string>& categories) {
  return std::ranges::any_of(categories, [&](const std::string& c) { return path == c || path.starts_with(c + "/"); });
}

std::string PluralOf(const std::string& word) {
  if (word.ends_with("s") || word.ends_with("x") || word.ends_with("sh") || word.ends_with("ch")) return word + "es";
  const bool consonant_y = word.size() > 1 && word.back() == 'y' && std::string("aeiou").find(word[word.size() - 2]) == std::string::npos;
  return consonant_y ? word.substr(0, word.size() - 1) + "ies" : word + "s";
}

// Words of the scene's own categories: "shop/kiosk" is a kiosk, unless a built-in word is the same.
void AddOwnWords(const Scene& scene, std::vector<Word>& words) {
  std::set<std::string> taken;
  for (const Row& row : Rows()) taken.insert(row.one);
  std::set<std::string> paths;
  for (const Entity& entity : scene.entities)
    if (entity.category >= kFirstCustomId && scene.tree[entity.category].thing) paths.insert(scene.tree[entity.category].path);
  for (const std::string& path : paths) {
    std::string word = path.substr(path.rfind('/') + 1);
    std::ranges::replace(word, '_', ' ');
    const bool built_in = std::ranges::any_of(Rows(), [&](const Row& row) { return IsBelow(path, row.categories); });
    const bool digits = std::ranges::any_of(word, [](char c) { return c >= '0' && c <= '9'; });
    if (built_in || digits || path.starts_with("ground") || path.starts_with("water") || !taken.insert(word).second) continue;
    words.push_back({word, PluralOf(word), {.word = word, .categories = {path}, .without = Merged()}});
  }
}

}  // namespace

std::string WithArticle(const std::string& word) {
  return (std::string("aeio").find(word.empty() ? 'x' : word[0]) != std::string::npos ? "an " : "a ") + word;
}

Lexicon::Lexicon(const Scene& scene) : named_(scene.entities.size() + 1), mistaken_(scene.entities.size() + 1) {
  for (const Row& row : Rows())
    words_.push_back(
        {row.one, row.many, {.word = row.one, .categories = row.categories, .names = row.names, .without = Merged()}, row.alike});
  AddOwnWords(scene, words_);
  std::set<uint16_t> used;
  for (const Entity& entity : scene.entities) {
    if (entity.bounds.empty() || entity.id == scene.sky_entity) continue;
    const std::string& path = scene.tree[entity.category].path;
    const Vec3f size = entity.bounds.size();
    const float largest = std::max({size.x, size.y, size.z});
    for (uint16_t i = 0; i < words_.size(); ++i) {
      const Word& word = words_[i];
      if (Matches(scene, entity, word.noun) && largest <= kLargest && largest >= kSmallest) {
        named_[entity.id].push_back(i);
        used.insert(i);
      } else if (IsBelow(path, word.alike) || (word.noun.names.empty() && IsBelow(path, word.noun.categories))) {
        mistaken_[entity.id].push_back(i);
      }
    }
  }
  in_use_ = used.size();
}

}  // namespace airsim360

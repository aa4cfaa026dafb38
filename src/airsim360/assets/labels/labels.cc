#include "airsim360/assets/labels/labels.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "airsim360/assets/labels/words.h"

namespace airsim360::internal {
namespace {

// Keywords in singular, '|' between those of one category, words of one keyword separated by a blank.
struct Row {
  std::string_view category;
  std::string_view keywords;
};

constexpr Row kWhole[] = {
    {"vehicle/car",
     "car|automobile|sedan|suv|hatchback|coupe|taxi|cab|jeep|convertible|limousine|police car|sport "
     "car|"
     "lamborghini|ferrari|porsche|bmw|audi|mercedes|volkswagen|toyota|honda|ford|tesla|chevrolet|peugeot|renault|fiat|volvo|auto"},
    {"vehicle/van", "van|minivan|minibus|camper|ambulance"},
    {"vehicle/truck",
     "truck|lorry|pickup|dumper|tanker truck|fire truck|firetruck|garbage "
     "truck|tractor|excavator|bulldozer|forklift"},
    {"vehicle/food_truck", "ice cream truck|ice cream van|food truck|foodtruck"},
    {"vehicle/bus", "bus|coach|autobus|school bus"},
    {"vehicle/tram", "tram|streetcar|trolley"},
    {"vehicle/train", "train|locomotive|wagon|railcar"},
    {"vehicle/motorcycle", "motorcycle|motorbike|scooter|moped|vespa"},
    {"vehicle/bicycle", "bicycle|bike|cycle|tricycle"},
    {"vehicle/boat", "boat|ship|yacht|canoe|kayak|ferry|sailboat|rowboat|gondola|barge"},
    {"vehicle/trailer", "trailer|caravan"},
    {"vehicle/airplane", "airplane|aeroplane|aircraft|airliner|glider|jet fighter|fighter jet|jet plane|jet"},
    {"vehicle/helicopter", "helicopter|chopper"},
    {"uav/other", "drone|quadcopter|uav|multicopter|quadrotor"},
    {"human/person",
     "person|people|human|man|woman|men|women|child|boy|girl|pedestrian|character|mannequin|male|female|"
     "soldier|worker|avatar|astronaut|lumberjack|knight"},
    {"human/rider", "rider|cyclist|biker"},
    {"animal", "animal|cow|sheep|pig|goat|chicken|duck|elephant|bear|deer|fox|rabbit|fish"},
    {"animal/dog", "dog|puppy|bulldog"},
    {"animal/cat", "cat|kitten"},
    {"animal/horse", "horse|pony"},
    {"animal/bird", "bird|pigeon|seagull|crow|eagle"},
    {"vegetation/tree/broadleaf/generic",
     "tree|oak|birch|poplar|beech|ash tree|acacia|sycamore|linden|chestnut|cherry tree|apple "
     "tree|arbre|baum|arbol|magnolia"},
    {"vegetation/tree/broadleaf/maple", "maple|acer"},
    {"vegetation/tree/broadleaf/elm", "elm"},
    {"vegetation/tree/broadleaf/weeping_willow", "willow|weeping willow"},
    {"vegetation/tree/conifer/pine", "pine|conifer|fir|spruce|cedar|cypress|larch|pine tree|fir tree|christmas tree"},
    {"vegetation/tree/palm", "palm|palmtree|coconut|palm tree"},
    {"vegetation/shrub/bush", "bush|shrub"},
    {"vegetation/hedge", "hedge"},
    {"vegetation/climber/ivy", "ivy|vine"},
    {"vegetation/flower", "flower|rose|tulip|daisy|sunflower"},
    {"vegetation/plant", "plant|fern|cactus|reed|crop|houseplant|potted plant"},
    {"vegetation/grass_tuft", "grass tuft|grass blade|grass clump"},
    {"ground/grass", "grass|lawn|meadow|turf"},
    {"ground/road", "road|street|asphalt|highway|roadway|lane|junction|intersection|avenue|tarmac|racetrack"},
    {"ground/crosswalk", "crosswalk|zebra|zebra crossing|pedestrian crossing"},
    {"ground/lane_marking", "lane marking|road marking|road line|lane line"},
    {"ground/kerb", "kerb|curb"},
    {"ground/sidewalk", "sidewalk|pavement|footpath|walkway|footway"},
    {"ground/path/park_walkway", "pathway|trail|park path|garden path|foot path"},
    {"ground/parking", "parking|car park|parking lot|carpark"},
    {"ground/manhole", "manhole|manhole cover"},
    {"ground/bike_lane", "bike lane|bicycle lane|cycle lane"},
    {"ground/dirt", "dirt|mud|soil|earth"},
    {"ground/sand", "sand|beach|desert"},
    {"ground/gravel", "gravel|pebble"},
    {"ground/floor", "floor|parquet"},
    {"ground/terrain/landscape", "terrain|landscape|ground|island|field"},
    {"nature/mountain", "mountain|cliff"},
    {"nature/hill", "hill"},
    {"nature/rock", "rock|stone|boulder"},
    {"water/lake", "lake|pond"},
    {"water/river", "river|stream|canal|creek"},
    {"water/sea", "sea|ocean"},
    {"water/pool", "swimming pool|pool"},
    {"water/water_plane", "water"},
    {"sky", "skydome|skybox|skysphere"},
    {"construction/building",
     "brewery|roastery|university|workshop|laboratory|research lab|community center|community centre|power plant|power station|"
     "fire station|police station|gas station|petrol station|train station|railway station|general store|"
     "building|skyscraper|apartment|office "
     "building|library|church|castle|school|hospital|barn|factory|warehouse|shop|store|"
     "hotel|museum|station|temple|mosque|cathedral|palace|garage|hangar|facade|skyscraper|villa "
     "building|stadium|theatre|theater"},
    {"construction/house", "house|home|cottage|hut|cabin|villa|bungalow|mansion|shed|farmhouse"},
    {"construction/tower", "tower|lighthouse|silo|water tower|watertower|pylon|chimney stack"},
    {"construction/windmill", "windmill|wind mill|wind turbine"},
    {"construction/bridge", "bridge|viaduct|overpass|footbridge|aqueduct"},
    {"construction/tunnel", "tunnel"},
    {"construction/wall", "wall"},
    {"construction/ceiling", "ceiling"},
    {"construction/column", "column"},
    {"construction/pillar", "pillar"},
    {"construction/stairs", "stair|staircase|stairway|step|ladder"},
    {"construction/escalator", "escalator"},
    {"construction/fountain", "fountain"},
    {"construction/well", "well|water well"},
    {"construction/statue", "statue|sculpture|monument|bust"},
    {"construction/scaffolding", "scaffold|scaffolding"},
    {"construction/awning", "awning|marquee"},
    {"construction/phone_booth", "phone booth|telephone booth|phonebox"},
    {"construction/rooftop/water_tank", "water tank"},
    {"construction/rooftop/antenna", "antenna|aerial|satellite dish"},
    {"construction/rooftop/solar_panel", "solar panel"},
    {"construction/rooftop/air_conditioner", "air conditioner|aircon|air conditioning"},
    {"barrier/fence", "fence|fencing|picket"},
    {"barrier/railing/rail", "railing|handrail|balustrade|guard rail"},
    {"barrier/wall/guard_rail", "guardrail|crash barrier"},
    {"furniture/seating/bench", "bench|park bench"},
    {"furniture/seating/chair", "chair|stool|seat|armchair|bar stool"},
    {"furniture/sofa", "sofa|couch|settee"},
    {"furniture/table", "table|picnic table|pool table|coffee table|dining table|side table"},
    {"furniture/desk", "desk"},
    {"furniture/bed", "bed|bunk"},
    {"furniture/cabinet", "cabinet|wardrobe|cupboard|drawer|dresser|closet"},
    {"furniture/shelf", "shelf|bookshelf|bookcase|shelve|shelving"},
    {"furniture/curtain", "curtain|blind|drape"},
    {"furniture/rug", "rug|carpet"},
    {"furniture/mirror", "wall mirror"},
    {"furniture/painting", "painting|picture frame|picture"},
    {"furniture/box", "crate|cardboard box|wooden box|wood box|storage box|moving box|gift box|tool box|toolbox|barrel|chest"},
    {"furniture/book", "book"},
    {"furniture/vase", "vase"},
    {"furniture/sink", "sink|washbasin|basin"},
    {"furniture/toilet", "toilet|wc"},
    {"furniture/bathtub", "bathtub|bath"},
    {"furniture/kitchen/oven", "oven|stove|cooker"},
    {"furniture/kitchen/microwave", "microwave"},
    {"furniture/electronics/refrigerator", "refrigerator|fridge|freezer"},
    {"furniture/electronics/television", "tv|television"},
    {"furniture/electronics/computer", "computer|laptop|pc|keyboard|computer monitor"},
    {"furniture/lighting/lamp", "lamp|chandelier|lantern|ceiling light|wall light"},
    {"furniture/lighting/lamp_post", "lamp post|lamppost|light post|lightpost|light pole"},
    {"furniture/lighting/street_light", "street light|streetlight|street lamp|streetlamp"},
    {"furniture/planter/pot", "pot|planter|flowerpot|flower pot|plant pot"},
    {"furniture/waste/trash_can", "trash can|trashcan|dustbin|bin|garbage can|trash bin|litter bin|waste bin|dumpster"},
    {"furniture/waste/recycle_bin", "recycle bin|recycling bin"},
    {"furniture/waste/trash", "trash|garbage|rubbish|litter"},
    {"furniture/mail/post_box", "post box|postbox|mailbox|letter box|letterbox|mail box"},
    {"furniture/utility/fire_hydrant", "hydrant|fire hydrant"},
    {"furniture/utility/electric_box", "electric box|transformer|electrical box"},
    {"furniture/utility/parking_meter", "parking meter"},
    {"furniture/transit/bus_stop", "bus stop|busstop|bus shelter|bus station"},
    {"furniture/shade/umbrella", "umbrella|parasol|sunshade"},
    {"furniture/recreation/playground", "playground|slide|swing|seesaw|sandbox|sandpit|carousel|trampoline"},
    {"furniture/recreation/ferris_wheel", "ferris wheel|ferriswheel|giant wheel|big wheel"},
    {"furniture/vending/food_stall", "stall|food stall|fruit stand|food stand|market stand|kiosk|market stall|booth"},
    {"furniture/vending/food_cart", "food cart"},
    {"furniture/vending/hotdog_cart", "hotdog cart|hot dog cart|hotdog"},
    {"signage/traffic_sign", "traffic sign|road sign|street sign|stop sign|signpost"},
    {"signage/shop_sign", "sign|signboard|shop sign"},
    {"signage/billboard", "billboard|hoarding"},
    {"signage/poster", "poster"},
    {"signage/flag", "flag|banner"},
    {"traffic/control/traffic_light", "traffic light|trafficlight|traffic signal|stoplight"},
    {"traffic/temporary/cone", "traffic cone|road cone|safety cone"},
    {"traffic/barrier/barrier", "barrier|barricade|jersey barrier"},
    {"traffic/bollard/road_column", "bollard"},
};

constexpr Row kParts[] = {
    {"vehicle",
     "wheel|tire|tyre|rim|hubcap|windshield|windsheild|windscreen|bumper|headlight|taillight|axle|exhaust|"
     "steering|license plate|"
     "number plate|engine|rotor|propeller|wing|fuselage|cockpit|landing gear|fender|mudguard|radiator "
     "grille|dashboard|chassi|brake"},
    {"construction/awning", "canopy"},
    {"construction/window", "window|glazing"},
    {"construction/door", "door|gate"},
    {"construction/building/roof", "roof|rooftop|roofing"},
    {"construction/balcony", "balcony|terrace"},
    {"construction/chimney", "chimney"},
    {"vegetation/tree/broadleaf/generic", "leaf|foliage|trunk|branch|bark|twig|crown|canopy leaf"},
};

// Words that mean other things as often.
constexpr std::string_view kWeak =
    "temple|table|bin|auto|cycle|jet|stream|field|earth|step|slide|swing|pc|palm|rose|station|coach|bust|well|picture|crop|"
    "water|ship|store|shop|stage|male|female|book|blind|bed|pool|plant|home|basin|bath|chest|bar|ford|lane|engine|brake|"
    "crown|library|child|exhaust|wing|rim|gate|column|dresser|sign|seat|stall|aerial|field|island|litter|draw|mail|barrier|"
    "canopy|tram|train|cab|duck|crow|sea|turf|soil|trail|hut";

// Phrases that tell nothing of what a thing is.
constexpr std::string_view kNothing =
    "water bottle|car paint|brain stem|boom box|snow man|snowman|snow ball|star field|rocket ship|rose gold|jet black|"
    "hotel room|living room|bed room|bedroom|bath room|bathroom|class room|classroom|room|interior|look up table|"
    "property table|walk cycle|run cycle|sky box|cornell box|light box|bounding box|hit box|box collider";

// Words that leave the meaning of the others as it is.
constexpr std::string_view kNeutral =
    "wood|wooden|metal|glass|plastic|stone|marble|concrete|brick|leather|iron|steel|old|new|big|small|large|medium|little|"
    "mini|tall|low|high|long|short|round|square|rectangular|oval|red|green|blue|yellow|white|black|grey|gray|brown|orange|"
    "pink|purple|dark|light|coffee|dining|kitchen|office|garden|picnic|side|bedside|poly|mesh|model|obj|object|prop|lp|hp|"
    "lod|geo|grp|group|sm|sk|mat|asset|straight|curved|simple|basic|modern|antique|vintage|rusty|broken|toy|main|single|double|"
    "plane|surface|body|base|default|material|clear|deep|shallow|the|a|of|with|and|set|static|diffuse|transmission";

std::string Joined(std::span<const std::string> words) {
  std::string key;
  for (const std::string& word : words) key += (key.empty() ? "" : " ") + word;
  return key;
}

// Keyword -> what it means; a keyword is its words joined by blanks.
const std::map<std::string, KeywordMatch, std::less<>>& Table() {
  static const auto table = [] {
    std::map<std::string, KeywordMatch, std::less<>> out;
    const auto add = [&](std::string_view category, std::string_view keywords, bool part) {
      while (!keywords.empty()) {
        const size_t end = std::min(keywords.find('|'), keywords.size());
        out.try_emplace(Joined(SplitWords(keywords.substr(0, end))), KeywordMatch{category, part});
        keywords.remove_prefix(std::min(end + 1, keywords.size()));
      }
    };
    for (const Row& row : kWhole) add(row.category, row.keywords, false);
    for (const Row& row : kParts) add(row.category, row.keywords, true);
    return out;
  }();
  return table;
}

std::set<std::string, std::less<>> WordSet(std::string_view list) {
  std::set<std::string, std::less<>> out;
  while (!list.empty()) {
    const size_t end = std::min(list.find('|'), list.size());
    out.insert(Joined(SplitWords(list.substr(0, end))));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return out;
}

bool IsWeak(const std::string& keyword) {
  static const auto words = WordSet(kWeak);
  return words.contains(keyword);
}

// Single letters number variants.
bool IsNeutral(const std::string& word) {
  static const auto words = WordSet(kNeutral);
  return word.size() == 1 || words.contains(word);
}

bool SaysNothing(const std::string& phrase) {
  static const auto phrases = WordSet(kNothing);
  return phrases.contains(phrase);
}

}  // namespace

namespace {

// A weak keyword counts where everything else is neutral.
bool Counts(const std::string& keyword, const std::vector<std::string>& words, size_t begin, size_t end, NameKind kind) {
  if (!IsWeak(keyword)) return true;
  if (kind == NameKind::kMaterial) return keyword == "water";
  for (size_t i = 0; i < words.size(); ++i) {
    if (i >= begin && i < end) continue;
    if (IsNeutral(words[i])) continue;
    // "character female": both say the same.
    const auto other = Table().find(words[i]), own = Table().find(keyword);
    if (other == Table().end() || RootOf(other->second.category) != RootOf(own->second.category)) return false;
  }
  return true;
}

// The longest keyword among the words, the last one of equal length; only whole things if `whole`. A phrase that
// says nothing, as long, ends the search.
std::optional<KeywordMatch> LongestKeyword(const std::vector<std::string>& words, bool whole, NameKind kind) {
  constexpr size_t kLongest = 3;
  for (size_t length = kLongest; length > 0; --length) {
    for (size_t end = words.size(); end >= length; --end) {
      const std::string phrase = Joined(std::span(words).subspan(end - length, length));
      if (SaysNothing(phrase)) return std::nullopt;
      const auto it = Table().find(phrase);
      if (it == Table().end() || (whole && it->second.part)) continue;
      if (Counts(phrase, words, end - length, end, kind)) return it->second;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<KeywordMatch> FindKeyword(std::string_view name, NameKind kind) {
  const std::vector<std::string> words = SplitWords(name.substr(0, 200));
  const std::optional<KeywordMatch> match = LongestKeyword(words, false, kind);
  if (!match || !match->part) return match;

  // "car_wheel": the owner stands in the same name.
  const std::optional<KeywordMatch> owner = LongestKeyword(words, true, kind);
  return owner ? KeywordMatch{CategoryOfPart(match->category, owner->category), false} : *match;
}

std::string_view RootOf(std::string_view path) { return path.substr(0, path.find('/')); }

std::string_view CategoryOfPart(std::string_view part, std::string_view owner) {
  if (owner.empty()) return part;
  if (owner.starts_with(part)) return owner;
  return RootOf(part) == RootOf(owner) ? part : owner;
}

}  // namespace airsim360::internal

#include "airsim360/flight/prompt/thing_words.h"

#include <algorithm>
#include <string>
#include <unordered_set>

namespace airsim360::internal {
namespace {

using Words = std::unordered_set<std::string_view>;

Words Split(std::string_view text) {
  Words words;
  while (!text.empty()) {
    const size_t space = std::min(text.find(' '), text.size());
    if (space > 0) words.insert(text.substr(0, space));
    text.remove_prefix(std::min(space + 1, text.size()));
  }
  return words;
}

/// Pronouns, auxiliaries, prepositions, adverbs and verbs that follow or precede a mass without being a thing.
constexpr std::string_view kFunctionWords =
    "you your yours us him who whom what how why here now then always never ever maybe perhaps else even still yet "
    "again back away down off out onto upon across along after before during since within near beside against both "
    "either neither none nothing everything anything everyone all any every few many much more most less lot lots "
    "such same different various several too quite rather pretty almost nearly barely exactly precisely roughly "
    "tops ready done going gone goes go went come comes came coming put puts get gets getting got take takes took "
    "know think thinks guess reckon hope expect expects wish like likes love says said tell tells told see seen "
    "saw show shows help helps work works working try trying use uses used keep keeps let lets seem seems sit sits "
    "run feel feels find finds buy bought sell order ordered built building wants wanted needs needed needing "
    "has had having been being was were did does done am isn aren doesn don won can cannot couldn shouldn wouldn "
    "ppl pls plz thx thanks thank hello hey yes yeah yep lol btw imo imho fyi cheers guys folks everybody nobody "
    "somebody anyone however although though because whether unless except despite via per versus easily safely "
    "thereabouts odd usual usually currently probably possibly hopefully definitely typically normally "
    "per piece max min approx est etc incl excl inc ex bis nicht sehr nur noch auch aber sollte soll muss will "
    "board bord aboard onboard tout compris chacun chaque cada jeder jede kann tres pas mais aussi avec doit peut faut muy pero tambien debe puede tiene quiero quisiera necesito vuele "
    "estoy deve molto anche but itself themselves himself herself";

constexpr std::string_view kAdjectives =
    "light lightweight heavy heavier lighter big bigger small smaller tiny huge large larger long longer short slow "
    "slower fast faster quick quiet silent loud stable agile nimble sturdy rugged tough strong stronger robust rigid "
    "stiff solid foldable folding compact portable slim thin thick wide narrow tall deep flat round square open "
    "closed dry wet empty full loaded naked bare stock custom homemade handmade printed cheap affordable expensive "
    "pricey good better best great nice cool awesome simple easy clean dirty old older new newer young used spare "
    "typical average usual real realistic true correct exact precise gross net target desired wanted required "
    "maximum minimum estimated measured claimed advertised published nominal legal official allowed safe safer "
    "autonomous automatic manual electric digital analog waterproof weatherproof splashproof rainproof windproof "
    "watertight airworthy reliable redundant modular versatile efficient powerful symmetric classic modern vintage "
    "black white red blue green yellow orange grey gray pink purple silver golden coloured matte shiny bright dark "
    "indoor outdoor aerial airborne remote wireless wired legit proper decent capable able suitable similar single "
    "dual triple pure extra additional carbon fibre fiber cf alu aluminium aluminum titanium plywood wood wooden "
    "balsa foam styrofoam plastic composite fibreglass fiberglass glassfibre nylon metal steel brushed smart "
    "high low lower higher sized style type kind class grade spec ultra super mega hyper semi pro plus lite evo hd uhd "
    "fully really very";

constexpr std::string_view kMakers =
    "dji tarot geprc iflight holybro emax betafpv diatone armattan foxeer hglrc flywoo happymodel eachine walkera "
    "yuneec autel parrot syma hubsan freefly xag ehang tbs tmotor hobbywing kde sunnysky racerstar lumenier rotorriot "
    "skystars aurora betaflight inav ardupilot arducopter px4 pixhawk cube kakute matek speedybee elrs crossfire "
    "naza blheli simonk tattu gens gnb cnhl turnigy multistar bonka zippy nubia gemfan hqprop ethix tmount "
    "foxtech gryphon draganfly aurelia acecore vulcan talon impulserc apex mobula meteor cetus tinyhawk nazgul "
    "roma chimera holystone potensic fimi hover xiaomi zerotech wingsland gopro gps rtk gnss imu esc escs bec fc vtx vrx osd pdb "
    "aio rx tx mavlink ros lidarless firmware led leds";

constexpr std::string_view kDroneWords =
    "base rig rigs ours build builds bird birds beast beasts craft crafts thing things toy toys kit kits model models flyer flyers flier "
    "workhorse monster monsters basher ripper whoop whoops racer racers cruiser cruisers lifter lifters sprayer "
    "sprayers platform platforms system systems unit units setup project projects everything vessel one mine "
    "contraption gadget device apparatus prototype testbed demonstrator frame airframe aircraft machine machines "
    "drone drones vehicle quad hexa octo copter multi gerat gerate fluggerat engin appareil aparato equipo nave "
    "bicho apparecchio mezzo hexarotor assembly beginner version variant clone copy replica lookalike chassis shell lot whole "
    "rtf bnf pnp arf cinewhoop toothpick pavo weekender all limit class category ship auw "
    "weight mass tow mtow helper assistant robot scale scales budget goal figure value massa vikt waga vekt berat paino "
    "margin reserve result estimate calculation guess sum plan idea aim ecalc calculator spreadsheet";

constexpr std::string_view kCarryVerbs =
    "carry carries carrying carried haul hauls hauling lift lifts lifting lifted lug lugs lugging deliver delivers "
    "delivering drop drops dropping dropped hoist hoists hoisting transport transports transporting bring brings "
    "bringing tote totes toting ferry ferries ferrying raise raises raising hold holds holding bearing "
    "take takes taking get gets getting send sends sending ship ships shipping put puts drag drags airlift airlifts airlifting shuttle shuttles shuttling heft hefts schlep schleps heave heaves "
    "tow tows towing sling slings slinging dangle dangles support supports supporting handle handles accommodate "
    "accommodates convey conveys conveying move moves moving fly release releases releasing dump dumps dumping "
    "throw throws throwing toss tosses tossing deploy deploys deploying lanza lanzando suelta jette wirft lancia sgancia dispense dispenses spread spreads cart carts carting launch launches mount mounts mounting "
    "mounted swing swings fetch fetches hang hangs hanging lifted host hosts heben hebt tragt tragen tragend "
    "transportiert transportieren schleppt schleppen bringt bringen liefert liefern befordert befordern abwirft "
    "abwerfen porte porter portant transporte transporter souleve soulever emporte emporter emmene emmener livre "
    "livrer larguer lleva llevar llevando carga cargar cargando levanta levantar transporta transportar entrega "
    "entregar soltar lanzar portare trasporta trasportare solleva sollevare consegna consegnare carrega carregar "
    "leva levar 携带 搭载 挂载 运送 运输 吊运 吊 装载 投放 输送 带着";

constexpr std::string_view kArticles =
    "a an the one my our this that his her its their your some each every two three four five six ein eine einen einem "
    "einer mein meine meinen meinem das den dem die der un une le la mon ma notre una uno el los las mi nuestro il lo "
    "mio mia um uma another";

constexpr std::string_view kJoiners =
    "with w for and plus & + including incl inkl includes included featuring having wearing equipped fitted mit und fur plus samt avec et pour "
    "con y para e per com mais 与 和 带";

bool IsOneOf(std::string_view word, const Words& words) { return words.count(word) > 0; }

bool EndsLikeNoThing(std::string_view word) {
  static const Words kThings = Split(
      "string ring wing sling mooring clothing housing rigging king spring wiring casing tubing seed feed bed weed "
      "shed dolly trolley jelly belly family supply table cable harness glass mattress dress fish dish brush bring "
      "wedding pudding painting drawing");
  if (IsOneOf(word, kThings)) return false;
  for (const std::string_view end : {"ly", "able", "ible", "ish", "ing", "ful", "less", "proof"}) {
    if (word.size() > end.size() + 1 && word.ends_with(end)) return true;
  }
  return word.size() > 4 && word.ends_with("ed");
}

}  // namespace

bool IsProductCode(std::string_view word) {
  const auto figure = [](char c) { return c >= '0' && c <= '9'; };
  return word.size() >= 2 && word.size() <= 8 && !figure(word[0]) && std::any_of(word.begin(), word.end(), figure);
}

bool MeansDrone(std::string_view word) {
  static const Words kWords = Split(kDroneWords);
  return IsOneOf(word, kWords);
}

bool IsPartWord(std::string_view word) {
  static const Words kWords = Split(
      "esc escs fc stack vtx rx receiver receivers wiring wires wire harness avionics electronics autopilot pixhawk gps pdb "
      "telemetry hardware screws plates plate legs hub misc rest remainder straps strap wires chassis airframe fuselage "
      "regler elektronik rahmen electronique chassis chasis carcasa electronica telaio elettronica antennas "
      "flight controller controllers skids");
  return IsOneOf(word, kWords) || word == "landing gear";
}

bool NamesWhole(std::string_view word) {
  static const Words kWords =
      Split("kit kits unit units system systems device setup assembly apparatus gadget thing model prototype rig robot lot shell");
  return IsOneOf(word, kWords);
}

bool IsCarryVerb(std::string_view word) {
  static const Words kWords = Split(kCarryVerbs);
  return IsOneOf(word, kWords) || word == "pick up" || word == "picks up" || word == "picking up" || word == "lifts up" ||
         word == "loaded with";
}

bool IsArticle(std::string_view word) {
  static const Words kWords = Split(kArticles);
  return IsOneOf(word, kWords);
}

bool JoinsThing(std::string_view word) {
  static const Words kWords = Split(kJoiners);
  return IsOneOf(word, kWords) || word.starts_with("plus ");
}

bool CanBeThing(std::string_view word) {
  static const Words kNone = [] {
    Words words = Split(kFunctionWords);
    for (const std::string_view more : {kAdjectives, kMakers}) words.merge(Split(more));
    return words;
  }();
  const bool letters = std::all_of(word.begin(), word.end(), [](char c) { return c >= 'a' && c <= 'z'; });
  // "abt", "tot": abbreviations have no vowels.
  const bool vowel = word.find_first_of("aeiouy") != std::string_view::npos;
  return letters && vowel && word.size() >= 3 && !IsOneOf(word, kNone) && !MeansDrone(word) && !IsCarryVerb(word) && !IsArticle(word) &&
         !JoinsThing(word) && !EndsLikeNoThing(word);
}

}  // namespace airsim360::internal

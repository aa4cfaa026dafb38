#include "airsim360/flight/prompt/other_figures.h"

#include <algorithm>
#include <utility>

#include "airsim360/flight/prompt/figure_words.h"
#include "airsim360/flight/prompt/thing_words.h"

namespace airsim360::internal {
namespace {

/// What sensors are and what they are said of.
bool IsSensor(const std::string& text) {
  return StartsAny(text, {"camera",
                          "cam ",
                          "lidar",
                          "gnss",
                          "gps",
                          "rtk",
                          "ppk",
                          "imu",
                          "baro",
                          "magnetom",
                          "radar",
                          "sonar",
                          "ultrason",
                          "rangefind",
                          "altimet",
                          "optical",
                          "stereo",
                          "fisheye",
                          "sensor",
                          "scanner",
                          "uwb",
                          "vicon",
                          "mocap",
                          "motion capture",
                          "optitrack",
                          "lens",
                          "thermal",
                          "flir",
                          "telemetr",
                          "receiver",
                          "video",
                          "footage",
                          "tof",
                          "depth",
                          "gyro",
                          "accelerom",
                          "compass",
                          "laser",
                          "livox",
                          "velodyne",
                          "ouster",
                          "hesai",
                          "realsense",
                          "zed",
                          "photo",
                          "rolling",
                          "global shutter",
                          "anemomet",
                          "spectromet",
                          "antenna",
                          "odometry",
                          "slam",
                          "vio",
                          "flow"}) ||
         IsOneOf(text, {"cam",        "cams",     "mag",     "ins",     "ir",       "rgb",    "eo",     "led",
                        "360 camera", "image",    "images",  "picture", "pictures", "pixel",  "pixels", "antennas",
                        "beams",      "channels", "channel", "kamera",  "kameras",  "camara", "capteur"});
}

/// What is measured or set of a sensor, a place or a flight, and is no figure of the drone.
bool IsMeasure(const std::string& text) {
  return StartsAny(text, {"baseline",    "interval",  "trigger",   "shutter",    "exposure",  "accura",           "precis",
                          "resolution",  "noise",     "sigma",     "drift",      "bias",      "overlap",          "swath",
                          "footprint",   "latency",   "delay",     "timeout",    "lag",       "horizontal error", "deviation",
                          "tolerance",   "repeatab",  "clearance", "separation", "uncertain", "intervall",        "basis",
                          "genauigkeit", "precision", "exactitud", "intervalo"}) ||
         IsOneOf(text, {"base",       "std",      "rms",          "rmse",       "error", "gsd",   "hor",      "vert",
                        "horizontal", "vertical", "horizontally", "vertically", "hz",    "ppm",   "stick",    "selfie stick",
                        "range",      "sampling", "period",       "cycle",      "fov",   "focal", "aperture", "monopod",
                        "strobe",     "flash",    "stroke",       "pixel",      "pixels"});
}

bool IsFigureNoun(const Token& token) {
  if (token.kind == Token::Kind::kModel) return true;
  if (token.kind != Token::Kind::kWord) return false;
  switch (token.word->kind) {
    case WordKind::kDrone:
    case WordKind::kRotors:
    case WordKind::kCoaxial:
    case WordKind::kRotorNoun:
    case WordKind::kMotor:
    case WordKind::kPropeller:
    case WordKind::kBlades:
    case WordKind::kArm:
    case WordKind::kWheelbase:
    case WordKind::kAcross:
    case WordKind::kFrame:
    case WordKind::kSizeNoun:
    case WordKind::kPitch:
    case WordKind::kGuards:
      return true;
    default:
      return false;
  }
}

/// Little words between a label and its figure.
bool IsBetween(const Token& token) {
  return token.kind == Token::Kind::kDash || token.Is(WordKind::kFiller) || token.Is(WordKind::kAtMost) || token.Is(WordKind::kTo) ||
         IsOneOf(token.text, {"maybe", "perhaps", "at", "of", "+", "ca", "every", "about", "=", "with", "and", "for", "in", "from"});
}

class OtherFigures : public FigureWords {
 public:
  using FigureWords::FigureWords;

  std::vector<Token> Run() {
    SetSideNumbersApart(tokens_, apart_);
    for (size_t i = 0; i < tokens_.size(); ++i) {
      const Figure figure = FigureAt(i);
      if (figure.is && (IsOfSensor(figure) || IsOfPlace(figure) || IsSeconds(figure) || IsOfCase(figure) || IsOfPerson(figure) ||
                        IsCompared(figure) || IsOfGround(figure) || IsOfWaiting(figure) || IsOfPowerLine(figure)))
        apart_[i] = true;
    }
    SetPastFiguresApart(tokens_, apart_);
    SetOtherSentencesApart(tokens_, apart_);
    MarkLighterLoads();
    std::vector<Token> out;
    for (size_t i = 0; i < tokens_.size(); ++i) {
      out.push_back(tokens_[i]);
      if (i == load_) {  // "22 min with 3 kg"
        Token payload;
        payload.kind = Token::Kind::kWord;
        payload.text = "payload";
        payload.word = FindWord("payload", false);
        out.push_back(std::move(payload));
      }
      if (!apart_[i]) continue;
      const Figure figure = FigureAt(i);
      Token& merged = out.back();
      merged.kind = Token::Kind::kUnknown;
      for (size_t k = i + 1; k <= figure.unit; ++k) merged.text += (tokens_[k].kind == Token::Kind::kDash ? "-" : " " + tokens_[k].text);
      if (!figure.is) merged.text += " ";  // no thing's name
      i = std::max(i, figure.unit);
    }
    return out;
  }

 private:
  /// Words of the drone's own size beside a figure: right after it, or as its label.
  bool HasFigureNoun(const Figure& figure) const {
    for (size_t k = figure.unit + 1; k < tokens_.size() && k <= figure.unit + 4 && !EndsSegment(k); ++k) {
      if (IsFigureNoun(tokens_[k])) return true;
      if (tokens_[k].kind == Token::Kind::kNumber) break;
    }
    for (size_t k = figure.number; k-- > 0 && figure.number - k <= 5 && !EndsSegment(k);) {
      if (IsFigureNoun(tokens_[k])) return true;
      if (!IsBetween(tokens_[k])) break;
    }
    return false;
  }

  /// A label of measuring beside a figure.
  bool HasMeasure(const Figure& figure) const {
    for (size_t k = figure.unit + 1; k < tokens_.size() && k <= figure.unit + 3 && !EndsSegment(k); ++k) {
      if (IsMeasure(Text(k))) return true;
      if (tokens_[k].Is(WordKind::kBreak) || tokens_[k].kind == Token::Kind::kNumber) break;
    }
    for (size_t k = figure.number; k-- > 0 && figure.number - k <= 5 && !EndsSegment(k);) {
      if (IsMeasure(Text(k))) return true;
      if (!IsBetween(tokens_[k])) break;
    }
    return false;
  }

  /// Whether the nearest noun before a figure, in its phrase or before the parenthesis that it stands in, is a sensor.
  bool FollowsSensor(const Figure& figure) const {
    bool inside = false;
    for (size_t k = figure.number, depth = 0; k-- > 0 && figure.number - k <= kClause;) {
      if (Is(k, {")"})) ++depth;
      if (Is(k, {"("})) {
        if (depth == 0) {
          inside = true;
          continue;
        }
        --depth;
      }
    }
    size_t k = figure.number;
    while (k-- > 0 && figure.number - k <= kClause) {
      if (Is(k, {"("}) && inside) {
        inside = false;
        continue;
      }
      if (EndsSegment(k) && !(inside && Is(k, {","}))) return false;
      if (IsFigureNoun(tokens_[k])) return false;
      if (IsSensor(Text(k))) return true;
    }
    return false;
  }

  bool IsOfSensor(const Figure& figure) const {
    if (!IsMetric(figure) || HasFigureNoun(figure)) return false;
    return HasMeasure(figure) || FollowsSensor(figure);
  }

  /// "1 m above the snow", "20 cm from the wall".
  bool IsOfPlace(const Figure& figure) const {
    if (!IsMetric(figure)) return false;
    const size_t next = figure.unit + 1;
    const bool place = Is(next, {"above", "below", "from", "away", "behind", "off", "ahead", "beyond", "altitude", "agl", "asl", "deep",
                                 "underneath", "beneath", "over", "up", "high", "tall", "thick"});
    if (!place) return false;
    for (size_t k = next; Is(next, {"from"}) && k < tokens_.size() && k <= next + 3; ++k) {
      if (Is(k, {"centre", "center", "middle", "hub", "cog"})) return false;
    }
    for (size_t k = next; k < tokens_.size() && k <= next + 5 && !EndsSegment(k); ++k) {
      if (tokens_[k].Is(WordKind::kMotor) || tokens_[k].Is(WordKind::kRotorNoun) || tokens_[k].Is(WordKind::kPropeller) ||
          tokens_[k].Is(WordKind::kWheelbase) || tokens_[k].Is(WordKind::kArm))
        return false;
    }
    for (size_t k = figure.number; k-- > 0 && figure.number - k <= 6 && !EndsSegment(k);) {
      if (IsFigureNoun(tokens_[k]) && !tokens_[k].Is(WordKind::kDrone) && !tokens_[k].Is(WordKind::kRotors)) return false;
    }
    return true;
  }

  /// "Every 0.8 s", "2 s intervals", "0.7 s": seconds, no cells.
  bool IsSeconds(const Figure& figure) const {
    if (HasUnit(figure, WordKind::kTimeUnit)) {
      const bool seconds = tokens_[figure.unit].word->value == 1;
      return seconds && Value(figure) > 0 && (Value(figure) < 10 || (Value(figure) < 60 && HasMeasure(figure)));
    }
    if (!HasUnit(figure, WordKind::kCells) || Text(figure.unit) != "s") return false;
    const double value = tokens_[figure.number].value;
    if (value != std::floor(value) && tokens_[figure.number].high == 0) return true;
    size_t before = figure.number;
    while (before-- > 0 && tokens_[before].Is(WordKind::kFiller)) {
    }
    if (before < figure.number && Is(before, {"every", "within", "alle", "toutes", "cada", "after"})) return true;
    if (before < figure.number && before > 0 && Is(before, {"at"}) && (Is(before - 1, WordKind::kOtherUnit) || IsSensor(Text(before - 1))))
      return true;  // "12 MP at 2 s"
    if (before < figure.number && value > 24 && Is(before, {"takes", "took", "needs"})) return true;
    return HasMeasure(figure) || Is(figure.unit + 1, {"between", "apart", "later", "after"});
  }

  /// "Goes in a 4 kg case", "arrived in a 22 kg crate".
  bool IsOfCase(const Figure& figure) const {
    if (!HasUnit(figure, WordKind::kMassUnit) && !HasUnit(figure, WordKind::kLengthUnit)) return false;
    const auto is_case = [&](size_t k) {
      return Is(k, {"case",     "crate",  "suitcase", "flightcase", "flight case", "trolley",   "pallet", "trunk",   "backpack",
                    "rucksack", "peli",   "pelican",  "hardcase",   "hard case",   "container", "carton", "toolbox", "koffer",
                    "valise",   "maleta", "bag",      "box",        "luggage",     "duffel",    "van",    "trailer", "packaging"});
    };
    // A case that is named after the figure, or whose figure is its label's.
    for (size_t k = figure.unit + 1; k < tokens_.size() && k <= figure.unit + 3 && !EndsSegment(k); ++k) {
      if (is_case(k)) return IsPutInto(figure.number);
    }
    const size_t noun = figure.unit + 1;
    if (Is(noun, WordKind::kPayload) || Is(noun, WordKind::kMass) || Is(noun, WordKind::kWheelbase))
      return false;  // "transport box, 1.5 kg payload"
    bool boxed = false;
    for (size_t k = figure.number; k-- > 0 && figure.number - k <= 5;) {
      const size_t kind = k > 0 ? k - 1 : 0;
      const bool kinds = Is(kind, {"transport", "shipping", "travel", "carry", "flight", "pelican", "peli", "hard", "storage"});
      // "Case: 70 x 50 x 40 cm, 9 kg"
      if (is_case(k)) return IsPutInto(k) || kinds || (boxed && !IsCarryVerb(Text(kind)) && !IsArticle(Text(kind)));
      const bool box = EndsSegment(k) && k + 1 == figure.number && k > 0 && IsBox(Text(k - 1));
      boxed |= box;
      if (EndsSegment(k) && !Is(k, {"("}) && !box) break;
    }
    return IsShipped(figure);
  }

  /// "Ships in two boxes, 8 kg and 5 kg"
  bool IsShipped(const Figure& figure) const {
    bool boxes = false;
    for (size_t k = figure.number; k-- > 1 && figure.number - k <= kClause && !Is(k, {".", ";", "!"});) {
      boxes |= Is(k, {"boxes", "cases", "crates", "cartons", "box", "case", "crate", "carton", "parcels", "pallet"});
      if (IsDrone(k)) return false;
      const bool put =
          Is(k, {"in"}) && StartsAny(Text(k - 1), {"ship", "packed", "packs", "deliver", "arrive", "travel", "stored", "stows"});
      if (put) return boxes && HasOther(figure);
    }
    return false;
  }

  static bool IsBox(const std::string& text) {
    return !text.empty() && text[0] >= '0' && text[0] <= '9' && text.find('x') != std::string::npos && text.ends_with('m');
  }

  /// "50 minutes on the charger", "setup within 3 minutes", "coffee for 40 minutes": beside another time, which is flown.
  bool IsOfWaiting(const Figure& figure) const {
    if (!HasUnit(figure, WordKind::kTimeUnit) || !HasOther(figure)) return false;
    for (size_t k = figure.unit + 1; k < tokens_.size() && k <= figure.unit + 4 && !EndsSegment(k); ++k) {
      if (IsWaiting(k)) return true;
      if (IsFlown(k)) return false;
      if (tokens_[k].kind == Token::Kind::kNumber) break;
    }
    for (size_t k = figure.number; k-- > 0 && figure.number - k <= kClause && !Is(k, {".", ";", "!", "?", "|"});) {
      if (IsWaiting(k) || (Is(k, {"time", "times"}) && k > 0 && IsWaiting(k - 1))) return true;
      if (IsFlown(k) || Is(k, WordKind::kTimeUnit) || Is(k, WordKind::kCapacityUnit) || Is(k, WordKind::kCells) || IsDrone(k)) return false;
    }
    return false;
  }

  bool IsFlown(size_t k) const {
    return Is(k, WordKind::kFlight) || Is(k, WordKind::kHover) || StartsAny(Text(k), {"fly", "flies", "flew", "flown", "airborne"});
  }

  bool IsWaiting(size_t k) const {
    const size_t before = k > 0 ? k - 1 : 0;
    if (Is(k, {"check", "service", "maintenance", "overhaul"})) return Is(before, {"next", "last", "every", "previous"});
    // "20 min between charges", "one charge lasts 20 min" are flown.
    const bool flown = Is(before, {"between", "before", "until", "one", "a", "per", "each", "every", "single", "full"}) && k > 0;
    if (flown && StartsAny(Text(k), {"charg", "recharg"})) return false;
    return StartsAny(Text(k), {"charg",   "recharg",   "setup",    "set up",    "unpack",   "assembl",   "coffee", "lunch",
                               "driving", "walk",      "briefing", "ladezeit",  "aufladen", "ladedauer", "aufbau", "warm up",
                               "warmup",  "preflight", "cooldown", "cool down", "lesson",   "lecture",   "seminar"});
  }

  /// "Overhead lines (110 kV and 380 kV)", "the 20 kV grid": kilovolts.
  bool IsOfPowerLine(const Figure& figure) const {
    if (!HasUnit(figure, WordKind::kKvUnit)) return false;
    const auto is_line = [&](size_t k) {
      return StartsAny(Text(k), {"overhead", "power line", "powerline", "grid", "substation", "pylon", "high voltage", "transmission line",
                                 "insulator", "conductor", "transformer", "switchgear", "freileitung", "hochspannung"}) ||
             Is(k, {"line", "lines", "mains", "towers"});
    };
    for (size_t k = figure.unit + 1; k < tokens_.size() && k <= figure.unit + 3 && !EndsSegment(k); ++k) {
      if (is_line(k)) return true;
      if (Is(k, WordKind::kMotor)) return false;
    }
    for (size_t k = figure.number; k-- > 0 && figure.number - k <= 8 && (!EndsSegment(k) || Is(k, {"(", ",", "/"}));) {
      if (is_line(k)) return true;
      const bool other_unit = k > 0 && FigureAt(k - 1).is && !Is(k, WordKind::kKvUnit);
      if (Is(k, WordKind::kMotor) || IsDrone(k) || other_unit) return false;
    }
    return false;
  }

  bool IsPutInto(size_t i) const {
    while (i-- > 0 && (IsArticle(Text(i)) || tokens_[i].Is(WordKind::kFiller) || tokens_[i].Is(WordKind::kSize) ||
                       (tokens_[i].kind == Token::Kind::kUnknown && !IsCarryVerb(Text(i))))) {
    }
    return i < tokens_.size() && Is(i, {"in", "into", "inside", "from", "from a", "im", "dans", "en", "out of"});
  }

  /// "I'm 82 kg and no, it is not going to lift me": unless somebody is to be carried.
  bool IsOfPerson(const Figure& figure) const {
    if (!HasUnit(figure, WordKind::kMassUnit) || Value(figure) < 15) return false;
    size_t k = figure.number;
    while (k-- > 0 && Is(k, {"weigh", "weighs", "am", "is", "about", "around", "roughly", "a", "at"})) {
    }
    const bool person =
        k < tokens_.size() && Is(k, {"i", "i m", "i'm", "im", "i am", "pilot", "operator", "man", "woman", "guy", "myself"});
    if (!person) return false;
    for (size_t n = 0; n < tokens_.size(); ++n) {
      const bool object = Is(n, {"me", "myself", "him", "her", "us", "person", "people", "passenger", "pilot", "human"});
      bool verb = false, negated = false;
      for (size_t v = n; object && v-- > 0 && n - v <= 8;) {
        verb |= IsCarryVerb(Text(v));
        negated |= tokens_[v].Is(WordKind::kNegation) || Is(v, {"not", "never", "won", "can t", "cannot"});
      }
      if (verb && !negated) return false;
    }
    return true;
  }

  /// "Bigger than a Mini 4 Pro (that's 249 g)", "unlike the Mavic 3, which weighs 895 g,"
  bool IsCompared(const Figure& figure) const {
    size_t than = figure.number;
    bool apposed = false;
    while (than-- > 0 && figure.number - than <= 9 && !IsThan(than)) {
      if (Is(than, {".", ";", ")", "mine", "ours", "this", "my", "our"})) return false;
      apposed |= Is(than, {"(", "which"});
      if (FigureAt(than).is) return false;
    }
    return apposed && than < tokens_.size() && IsThan(than);
  }

  bool IsThan(size_t k) const { return Text(k).ends_with("than") || Is(k, {"unlike", "versus", "vs", "compared"}); }

  /// "The charger weighs 1.1 kg", "pilot 75 kg", "flies over a 40 kg buoy": what stays on the ground or is only looked at.
  bool IsOfGround(const Figure& figure) const {
    if (!HasUnit(figure, WordKind::kMassUnit) && !IsMetric(figure)) return false;
    const auto stays = [&](size_t k) {
      return StartsAny(Text(k), {"charger", "ground station", "base station", "trailer", "generator", "landing pad", "launch pad", "tripod",
                                 "transmitter", "goggles", "power supply", "ladegerat", "chargeur", "cargador", "pilot", "operator"}) ||
             (Is(k, {"station"}) && k > 0 && Is(k - 1, {"ground", "base", "docking", "control"})) || Is(k, {"gcs", "dock"}) ||
             (Is(k, {"ground"}) && k > 1 && Is(k - 1, {"the"}) && Is(k - 2, {"on"}));
    };
    // "On a 12 kg rover"
    const size_t next = figure.unit + 1;
    const bool vehicle = Is(next, WordKind::kVehicle) || Is(next, {"robot", "rover", "ugv", "usv"});
    if (vehicle && figure.number > 0 && IsArticle(Text(figure.number - 1)) && HasOther(figure)) return true;
    size_t k = figure.number;
    bool article = false;
    while (k-- > 0 && figure.number - k <= 7 && !EndsSegment(k)) {
      if (IsCarryVerb(Text(k))) return false;
      if (stays(k)) return true;
      article |= IsArticle(Text(k));
      const bool looked = (article && Is(k, {"over", "above", "near", "around", "past", "beside", "behind", "along"})) ||
                          Is(k, {"inspect", "inspects", "inspecting", "films", "filming", "follows", "following", "tracks", "tracking",
                                 "monitors", "monitoring", "watches", "watching"});
      const size_t noun = figure.unit + 1;
      if (looked && (article ? k + 2 : k + 1) == figure.number && noun < tokens_.size() && !EndsSegment(noun) &&
          !IsFigureNoun(tokens_[noun]))
        return true;
      if (IsDrone(k) || tokens_[k].kind == Token::Kind::kNumber) return false;
    }
    return false;
  }

  /// "40 min with 2 kg payload, 28 min with 5 kg": of several times with their loads that of the heaviest.
  void MarkLighterLoads() {
    std::vector<std::pair<Figure, Figure>> pairs;
    for (size_t i = 0; i < tokens_.size(); ++i) {
      const Figure time = FigureAt(i);
      if (!time.is || apart_[i] || !HasUnit(time, WordKind::kTimeUnit)) continue;
      size_t k = time.unit + 1;
      bool joined = false;
      for (; k < tokens_.size() && k <= time.unit + 5 && tokens_[k].kind != Token::Kind::kNumber && !EndsSegment(k); ++k)
        joined |= tokens_[k].Is(WordKind::kBreak) || tokens_[k].Is(WordKind::kPayload);
      const Figure load = FigureAt(k);
      if (load.is && HasUnit(load, WordKind::kMassUnit) && (joined || k == time.unit + 1)) pairs.emplace_back(time, load);
    }
    if (pairs.size() < 2) return;
    const auto heaviest =
        std::max_element(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) { return Value(a.second) < Value(b.second); });
    for (auto pair = pairs.begin(); pair != pairs.end(); ++pair) {
      if (pair != heaviest) apart_[pair->first.number] = apart_[pair->second.number] = true;
    }
    const bool said = std::any_of(tokens_.begin(), tokens_.end(), [](const Token& token) {
      return token.Is(WordKind::kPayload) || token.Is(WordKind::kLoad) || token.Is(WordKind::kVolumeUnit);
    });
    if (!said) load_ = heaviest->second.unit;
  }

  size_t load_ = static_cast<size_t>(-1);  ///< the unit of a mass that is carried
};

}  // namespace

std::vector<Token> WithoutOtherFigures(std::vector<Token> tokens) {
  std::vector<bool> apart(tokens.size(), false);
  return OtherFigures(tokens, apart).Run();
}

}  // namespace airsim360::internal

#include "airsim360/flight/prompt/spoken_forms.h"

#include <cmath>
#include <regex>
#include <utility>
#include <vector>

#include "airsim360/flight/prompt/lexicon.h"

namespace airsim360::internal {
namespace {

using Rule = std::pair<std::regex, const char*>;

/// The symbols of papers, and tolerances ("250+-5 g"), which say nothing of a drone.
const std::vector<Rule>& Symbols() {
  static const std::vector<Rule> kRules = {
      {std::regex(R"((\d)\s*\+/?-\s*[\d.]+\s*%?)"), "$1 "},
      {std::regex(R"(\+/?-\s*[\d.]+\s*(%|[a-z]+))"), " "},
      {std::regex(R"((\d)\+\s*(?=(min|h|g|kg|km)\w*\b))"), "$1 "},  // "35+ minutes"
      // "Rotor radius r = 0.06 m": the symbol of what is named before it.
      {std::regex(
           R"((\b(mass|weight|radius|diameter|distance|length|motors|rotors|propellers|props|time|speed|velocity|wheelbase|diagonal|span|payload|endurance|capacity)|\))\s+[a-z](_\{?\w+\}?)?\s*=)"),
       "$1 = "},
      {std::regex(R"(@\s*(?=\d+(\.\d+)? ?(kg|g|lbs?|oz)\b))"), " with "},
      {std::regex(R"(@\s*(?=\d))"), " at "},
      {std::regex(R"(\bm_(p|pl|payload)\s*[=:])"), " payload "},
      {std::regex(R"(\bm_(to|tow|tot|total|auw|take-?off)\s*:)"), " mass "},
      {std::regex(R"(\bm(_\w+)?\s*=)"), " mass "},
      {std::regex(R"(\bd(_\w+)?\s*=)"), " propeller diameter "},
      {std::regex(R"(\br(_\w+)?\s*=)"), " rotor radius "},
      {std::regex(R"(\bl(_\w+)?\s*=)"), " arm length "},
      {std::regex(R"(\bn(_\w+)?\s*=)"), " rotors "},
      {std::regex(R"(\bt_h\w*\s*=)"), " hover time "},
      {std::regex(R"(\bt_(f\w*|end\w*)\s*=)"), " flight time "},
      {std::regex(R"(\bv(_?max|_top)?\s*=)"), " top speed "},
      {std::regex(R"(\brotors?\s*=(.*)\bdiameter\s*=)"), " rotors =$1 propeller diameter "},
  };
  return kRules;
}

/// Numbers written in ways of their own.
const std::vector<Rule>& Numbers() {
  static const std::vector<Rule> kRules = {
      {std::regex(R"((\d)\s*~\s*(?=\d))"), "$1-"},  // "13~15 min"
      {std::regex(R"(\bnot (quite|really|exactly|a) sub[ -]?250\b)"), " "},
      {std::regex(R"(\bsub[ -]?(\d{3})\b(?!\s*-?(g|mm|gr|gram|grams|gramm)\b))"), "under $1 g"},
      {std::regex(R"((\d ?min) (10|15|20|30|40|45|50)\b(?! ?(-|%|"|[a-z]?ah\b|g\b|kg|m\b|mm|cm|in|km|c\b|v\b|w|k|s\b|l\b|minutes|hover)))"),
       "$1 $2 sec"},
      {std::regex(R"(\b(four|five|six|seven|eight|[4-8])[ -]armed\b)"), "$1 rotor"},
      {std::regex(R"(\b(single|one)[ -]cell\b)"), "1 cell"},
      {std::regex(R"(\b(a single|single|just one|one) (\d+(\.\d+)? ?m?ah) (lipo |lihv |li-?ion )?cell\b)"), "1 cell $2"},
      {std::regex(R"(\b(a single|single|just one|one) (18650|20700|21700)\b)"), "1 cell"},
      {std::regex(R"(\b(an?|one) full hour\b)"), "1 hour"},
      {std::regex(R"(\b([4-6] ?x ?(9|[1-4]\d)|7 ?x ?[1-4]\d|8 ?x ?(1[1-9]|[2-4]\d)) (in|inch|inches)(?=[,;.]))"), "$1 inch props"},
      // "7 x 12 inch props": so many of them, for no pitch is so much larger than the diameter.
      {std::regex(
           R"(\b([3-8]) ?x ?((9|[1-4]\d)(\.\d+)?) ?-?(in|inch|inches|") ?(carbon |folding |wooden )?(props?|propellers?|rotors?)\b)"),
       "$1 rotors, $2 inch propellers"},
      {std::regex(R"(\bsingle (propeller|prop|motor)\b)"), "1 $1"},
      {std::regex(R"((\d)-?ish\b)"), "$1 "},
      {std::regex(R"((\d ?(min|mins|minutes?)) ?(and )?([0-5]?[05]) ?s\b(?! *\d))"), "$1 $4 sec"},  // "4 min 30 s"
      {std::regex(R"(\b(\d{1,2}) ?h ?(\d{1,2}) ?m(in|ins)?\b)"), "$1 h $2 min"},                    // "1h10m"
      {std::regex(R"(\b(\d{1,2}(\.\d+)?) x (\d{1,2}\.\d{1,2})\b(?!\s*(x|mm|cm|m|kg|g|in|inch|ah|mah|s|k)\b|\s*\x22))"),
       "$1x$3"},  // "18 x 6.1 carbon"
      {std::regex(R"(\b(propellers?|props?) ?[:=] ?(\d{1,2}(\.\d+)?) x (\d{1,2}(\.\d+)?)(?![\d.]))"), "$1 $2x$4"},
      {std::regex(R"(\b(w/o|without)\s*(?=[).;]|$))"), "without battery "},  // "310 g w/o"
      // "Flight time 4:30", "4:30 min"
      {std::regex(
           R"(\b((time|timed|clocked|logged|flights?|hovers?|endurance|flies|fly|of)[ :~a-z]{0,12})(\d{1,2}):([0-5]\d)( ?min(utes|s)?)?(?![\d:]))"),
       "$1$3 min $4 sec"},
      {std::regex(R"(\b(\d{1,2}):([0-5]\d) ?(min|mins|minutes)\b)"), "$1 min $2 sec"},
      {std::regex(R"((\d)\s*\*\s*(?=\d))"), "$1x"},                                 // "24*7.8"
      {std::regex(R"((\d ?(mm|cm|m)) by (?=\d+(\.\d+)? ?(mm|cm|m)\b))"), "$1 x "},  // a box
      {std::regex(R"(\b(\d{1,2}(\.\d+)?) ?(in|inch|inches|")? (by|x) (\d{1,2}(\.\d+)?) ?(in|inch|inches|")(?![a-z]))"), "$1x$5 inch"},
      // "Shy of 230 g... say 225"
      {std::regex(
           R"((\d+(\.\d+)?)\s*(kg|g|grams|kilos|min|minutes|lbs?)\b([ ,.;-]+)(let s |lets |let's |let us )?(say|call it|make it|make that) (\d+(\.\d+)?)(?![\d.]*\s*[a-z%\x22]))"),
       "$1 $3 , make that $7 $3"},
      {std::regex(R"(每小时\s*(\d+(\.\d+)?)\s*公里)"), "$1 公里每小时"},
      {std::regex(R"(时速\s*(\d+(\.\d+)?)\s*公里)"), "速度 $1 公里每小时"},
      {std::regex(R"(\bfrom (\d{1,2}) ?s to (\d{1,2}) ?s\b)"), "$2s"},  // a battery that is changed
      {std::regex(R"(\b((9|[1-3]\d)(\.\d+)?) x (\d+(\.\d+)?)(?=( [a-z]+)? prop))"), "$1x$4"},
      {std::regex(R"(\b(propellers?|props?) ((9|[1-3]\d)(\.\d+)?) x (\d+(\.\d+)?))"), "$1 $2x$5"},
      {std::regex(R"(\b(propellers|props|rotors)\s*,\s*([\d.]+\s*(cm|mm|m|inch|inches|in|")) each\b)"), "$1 $2"},
  };
  return kRules;
}

/// Turns of phrase whose words would mean something else one by one. Longer than a screen because it is a table.
const std::vector<Rule>& Phrases() {
  static const std::vector<Rule> kRules = {
      {std::regex(R"(\ben charge\b)"), " "},
      // "Landed with 3.5 V per cell": of one cell, whatever the pack has.
      {std::regex(
           R"(\b(at |with |to |until |of |down to )?\d(\.\d+)? ?(v|volts?) ?(per|a|each|/|pro|par|por) ?(cell|c|zelle|element|celda)\b)"),
       " "},
      {std::regex(R"(\bcells? (are |is |was |were )?(at|with|of|to|down to) [2-4](\.\d+)? ?v(olts?)?( each)?\b)"), "cells"},
      // "One charge gives seven minutes"
      {std::regex(
           R"(\b(one|a|each|every|a single|per) (full )?(charge|battery|pack|lipo) (gives|lasts( for)?|yields|allows|brings|is good for|is enough for|keeps it (up|flying)( for)?)( us| me| you| about)?\b)"),
       "flight time "},
      // "Cells (36, 2.5 kg of the total)", "'nine-fours'": what is in the whole, what a propeller is called.
      {std::regex(R"(([,(] ?)\d+(\.\d+)? ?(kg|g|lbs?|oz) of (the|its|that) (total|whole|auw|mtow|tow|weight|mass)\b)"), "$1"},
      {std::regex(
           R"(\b(two|three|four|five|six|seven|eight|nine|ten|eleven|twelve)-(twos|threes|fours|fives|sixes|sevens|eights|nines)\b)"),
       " "},
      // A list's number, a span of years.
      {std::regex(R"(#\s?\d+\b)"), " "},
      {std::regex(R"(\b(19[6-9]\d|20[0-4]\d) ?[-/] ?20[0-4]\d\b(?! ?(kv|mah|g|mm|rpm)\b))"), " "},
      // "Gear up 6 s": how long it takes to fold the legs.
      {std::regex(R"(\b(gear|legs|skids) (up|down|retracts?|retraction)( in| within| time)?:? ?\d+(\.\d+)? ?s(ec|econds)?\b)"), " "},
      // "Should I go with 400 kv or 340 kv?" states neither.
      {std::regex(R"(\b\d+(\.\d+)? ?(kv|inch|in|"|s|mah|kg|g) or \d+(\.\d+)? ?\2\s*\?)"), " ?"},
      // A dive tells nothing of the drone's own thrust.
      {std::regex(R"(\b\d+(\.\d+)? ?(mph|km/h|kmh|kph|m/s|knots|kts?) in (a|the|full) (power )?dives?\b( and| ,|,)?)"), " "},
      {std::regex(R"(\b(\d+(\.\d+)? ?(mph|km/h|kmh|kph|m/s|knots|kts)) level\b)"), "top speed $1"},
      {std::regex(R"((\d) in parallel\b)"), "$1 parallel"},
      {std::regex(
           R"(\b(two|three|four|five|six|[2-6]|twin|dual)( x)? parallel ((\d+ ?s )?[\d.]+ ?m?ah)( lipo| li-?ion)? (batteries|packs|lipos)\b)"),
       "$1 $3 packs in parallel"},
      {std::regex(R"(\b(two|three|four|five|six|[2-6]|twin|dual)( x)? (\d{3,5})s (in )?parallel\b)"), "$1 $3 mah parallel"},
      {std::regex(R"(\b(rotors|propellers|props), (of )?(diameter|dia)\b)"), "$1 diameter"},
      {std::regex(R"(\b\d{2,4} (identical|matching) )"), " "},  // of a fleet
      {std::regex(R"(\b(an? |the )?\d+[ -]?(min|minute) (show|lesson|film|video|clip|talk|briefing|interview)\b)"), " "},
      {std::regex(R"(\breplac(ed|ing) (the|my|our) (old )?[a-z]+ \([^()]*\) (by|with) )"), "with "},
      {std::regex(R"(\b(we ?'?re|we are|it ?'?s|comes? out|ends? up) at ([\d.]+ ?(kilos?|kg|grams|g)\b))"), "all up $2"},
      {std::regex(R"(\blimit(ed|s)?( it| the speed| speed)? (to|at) ([\d.]+ ?(m/s|km/h|kmh|mph)))"), "top speed $4"},
      {std::regex(R"(\b([\d.]+ ?(m/s|km/h|kmh|kph|mph)) (top|max|maximum) speed\b)"), "top speed $1"},
      // "Needed 2 h to reach the hall": of people.
      {std::regex(
           R"(\b(needed|needs?|took|takes) (about )?[\d.]+ ?(h|hours?|min|minutes) to (reach|walk|hike|climb|drive|get|dig|find)\b)"),
       " "},
      {std::regex(R"(\b((stays?|remains?) (on|in|at) the [a-z]+ )\([^()]*\))"), "$1"},
      {std::regex(R"(\b\d+ (pounds|quid)( each)?[, ]*(second[ -]?hand|used|brand new|on ebay|delivered|posted)\b)"), " "},
      {std::regex(R"(\bwith ([\d.]+ ?(kg|g|lbs?|pounds)) of ([a-z]+ ){1,3}(on board|aboard)\b)"), "with $1 payload"},
      {std::regex(R"((\d ?(kg|g|lbs?)) spare (for|capacity)\b)"), "$1 payload $3"},
      // "Fifty kilos, of which 15 is payload"
      {std::regex(R"(\b(kilos?|kg|g|grams|lbs|pounds)\b([^.;:()]{0,30}\bof which )([\d.]+) ((is|are) (the )?(payload|cargo|load)\b))"),
       "$1$2$3 $1 $4"},
      // "1.2 oz lighter than the last model" is a mass of neither.
      {std::regex(
           R"(\b[\d.]+ ?(kg|g|grams?|lbs?|pounds?|oz|ounces?) (lighter|heavier) than (the|my|our|its|his|her) (last|old|previous|first|former|predecessor)\b)"),
       "$2 than $3 $4"},
      // "The box says 51 minutes, I got 46"
      {std::regex(
           R"(\b(box|label|manual|shop|vendor|seller|maker|brochure|spec sheet) (says|claims|promises) [\d.]+ ?min(utes|s)?\b[, ]*(but )?(i|we) (get|got|see|saw|measured) ([\d.]+)\b)"),
       "$7 minutes"},
      {std::regex(R"(\boct(a|o)?[ -]rotors?\b)"), "octorotor"},
      {std::regex(R"(\bhexa?[ -]rotors?\b)"), "hexarotor"},
      // Aeronautical English for a multirotor.
      {std::regex(R"(\b((four|five|six|seven|eight|multi|[4-8])[ -]?rotor) helicopter\b)"), "$1 drone"},
      // "5G WiFi", "2.4G remote": no grams.
      {std::regex(
           R"(\b(2\.4|5\.8|[345])\s?g(hz)?\b(?=[ -]*(wi-?fi|wlan|fpv|lte|network|modem|transmission|signal|link|module|connection|rc|remote|radio|control|transmitter|video|live)))"),
       " "},
      {std::regex(R"(\b(wi-?fi|lte)[ -]?[45]g\b)"), " "},
      {std::regex(R"(\bfor (a|one) (whole|full|entire) day\b)"), "for 24 hours"},
      // "58 g without and 84 g with battery"
      {std::regex(
           R"((\d ?(g|grams?|kg|lbs?|oz)) (without|dry|w/o)\s*(,|and|/|-)?\s*(and )?([\d.]+ ?(g|grams?|kg|lbs?|oz)) (with|w/|incl\.?) (the |a )?(battery|lipo|batt|pack)\b)"),
       "$1 without battery, $6 with battery"},
      {std::regex(
           R"((\d ?(g|grams?|kg|lbs?|oz)) (without|w/o)\s*(,|and|/|-)?\s*(and )?([\d.]+ ?(g|grams?|kg|lbs?|oz)) (with|w/|incl\.?) (the |a )?(payload|load|camera|cargo)\b)"),
       "$1 without payload, $6 total with payload"},
      {std::regex(R"(\bin space\s*([,.;!?]|$))"), "in outer space $1"},
      {std::regex(R"(\bdrone[ -]in[ -]a[ -]box\b)"), "drone"},
      {std::regex(R"(\b24/7\b)"), " "},
      {std::regex(R"(\b360(-| )?((degree|deg)s? )?(?=(camera|cam|video|gopro)\b))"), " "},
      {std::regex(R"(\bin (one|the same|a single) (place|spot|position)\b)"), " "},
      {std::regex(R"(\b(take|bring|carry|stow|pack)( it| them)? )"
                  R"((on|in|into|onto|aboard) (an?|the) (aero|air)?planes?\b)"),
       " "},
      // "Without the GoPro", "minus camera and gimbal"
      {std::regex(R"(\b(without|w/o|minus|excluding|excl\.?|not counting|not including|less)( the| any| a| its)? )"
                  R"((camera|cam|gopro|go pro|gimbal|sensor|lidar|cargo|parcel|package|box|liquid|water|bait|scanner|action cam)s?)"
                  R"(( (and|or|&) (the )?(camera|gimbal|lens|mount|sensor))?\b)"),
       " without payload "},
      // Still air is no wind to withstand.
      {std::regex(R"(\b(in |with |at |under )?(no|zero|without( any)?|w/o|next to no) (wind|gusts|breeze)\b)"), " "},
      {std::regex(R"(\b(in |at |during )?(straight and )?level flight\b)"), " "},
      {std::regex(R"(\bw/(?!\s*o\b)\s*(?=[a-z0-9]))"), "with "},
      // "6 minutes per charge": a charge that is flown takes no time at the plug.
      {std::regex(R"(\b(per|on|from|off|with) (a |an |one |each |every |a single |single )?(full |single )?charge\b)"), " "},
      {std::regex(R"(\bbetween (two )?(re)?charges\b)"), " "},
      // "8 separate arms over coax"
      {std::regex(R"(\b(over|instead of|rather than|not|no|non|without|never|vs)[ -](an? )?(coax|coaxial|coaxials)\b)"), " "},
      {std::regex(R"(\b(fl(y|ies|ying|ys)|hover(s|ing)?|stays? (up|airborne|in the air|aloft)|lasts?|runs?|keeps? (going|flying)))"
                  R"(( on)? (for ?ever|indefinitely|endlessly|eternally|without ever landing|till the end of time))"),
       " endless flight "},
      {std::regex(R"((\d ?(kg|g|grams|lbs?|oz)( (payload|load|cargo|camera|battery|lipo|empty|dry))?)\s*=\s*(?=\d))"),
       "$1 , total "},  // a sum
      {std::regex(R"(\)\s*=\s*(?=\d))"), ") , total "},
      {std::regex(R"(\s=\s?(?=~?\d))"), " is "},
      {std::regex(R"((\d)\s*\[(kg|g|lb|in|inch|mm|cm|m|min|s|h|ah|mah|wh|v|m/s|km/h)\])"), "$1 $2"},  // "1.4 [kg]"
      // "8 to 1": no range, which would rise.
      {std::regex(
           R"(\b([2-9]|1\d)(\.\d+)? ?(to|zu|sur|su) (1|one|eins|un)\b(?!\s*-?\.?(\d|kg|g|h|hour|min|m|inch|in|lb|kilo|pound|hundred|thousand|l|v|s|ah|stunde)\b))"),
       "$1$2:1"},
      // "Hover? 20 min"
      {std::regex(R"(\b(propellers?|props?|battery|hover|time|weight|mass|auw|payload|wheelbase|diagonal|)"
                  R"(speed|cells|rotors|motors|thrust|twr)\s*\?\s+(?=(about|around|roughly|only|just|maybe)?\s*~?\d))"),
       "$1 "},
  };
  return kRules;
}

/// "2 inch props (51 mm)", "20 lbs (9.1 kg)": the same again in another unit says nothing new.
std::string WithoutConversions(const std::string& text) {
  static const std::string kFigure = R"((\d{1,7}(?:\.\d{1,6})?) ?(inch(?:es)?|in|"|lbs?|oz|ft|pounds?|ounces?|mm|cm|m|g|kg))";
  static const std::regex kTwice(kFigure + R"((?: [a-z]+)? ?\((?:=|~|or|about)? ?)" + kFigure + R"(\))");
  constexpr double kRounding = 0.04;
  std::string out;
  size_t at = 0;
  for (std::sregex_iterator twice(text.begin(), text.end(), kTwice), end; twice != end; ++twice) {
    const Word *unit = FindWord(twice->str(2), false), *again = FindWord(twice->str(4), false);
    const double one = std::stod(twice->str(1)) * unit->value, other = std::stod(twice->str(3)) * again->value;
    if (twice->str(2) == twice->str(4) || unit->kind != again->kind || std::abs(one - other) > kRounding * one) continue;
    const size_t open = text.find('(', static_cast<size_t>(twice->position(2)));
    out.append(text, at, open - at);
    at = static_cast<size_t>(twice->position() + twice->length());
  }
  return out.append(text, at, text.size() - at);
}

}  // namespace

std::string SpeltOut(const std::string& plain) {
  std::string text = WithoutConversions(plain);
  for (const auto* rules : {&Symbols(), &Numbers(), &Phrases()}) {
    for (const auto& [pattern, words] : *rules) text = std::regex_replace(text, pattern, words);
  }
  return text;
}

}  // namespace airsim360::internal

// Words of speech, numbers and units.
#include "airsim360/flight/prompt/lexicon.h"

namespace airsim360::internal {
namespace {
using enum WordKind;

constexpr Word kEnglishWords[] = {
    {kFiller, 0, "",
     "a|an|the|of|that|is|its|it|about|around|roughly|approximately|approx|abt|appx|ca|circa|some|has|have|which|can|"
     "i|we|me|"
     "this|these|will|would|should|be|my|our|your|to be|say|total of|as|in total|one that|nominal|rated|up "
     "to|"
     "upto|at least|maximum|max|minimum|least|most|at most|no more than|not more than|no less than|more "
     "than|over|"
     "only|just|each|per|so|or so|ish|please|give me|build|design|make|want|need|there|are|in all|equal "
     "to|by|"
     "do|does|doing|capable of|able to|using|made|type|style|kind|ratio|electric|together|than|"
     "fly|flies|flys|flying|new|nice|like|similar to|something|someone|kindly|also|very|really|must|not|"
     "could|might|may|shall|looking|look|get|get me|got|other|another|one of those|both|own|basic|i d|i m|it "
     "s|"
     "along|plus or minus|overall|they|them|he|she|his|her|if "
     "possible|preferably|preferred|ideally|hoping|say that|altogether|all together|apiece|"
     "tetherless|tether less|untethered|between|measure|measures|measuring"},
    {kBreak, 0, "",
     "with|whose|and|w|for|but|on|at|plus a|while|when|under load|from|using a|where|then|without|into|"
     "through|if|because|having|featuring|including|incl|that has|which has|running|run|runs"},
    {kTo, 0, "", "to|or|until|through to|bis|jusqu|至|到|hasta"},
    {kNumber, 0, "", "zero"},
    {kNumber, 1, "", "one"},
    {kNumber, 2, "", "two|a couple of|a pair of|couple of"},
    {kNumber, 3, "", "three"},
    {kNumber, 4, "", "four"},
    {kNumber, 5, "", "five"},
    {kNumber, 6, "", "six|half a dozen"},
    {kNumber, 7, "", "seven"},
    {kNumber, 8, "", "eight"},
    {kNumber, 9, "", "nine"},
    {kNumber, 10, "", "ten"},
    {kNumber, 11, "", "eleven"},
    {kNumber, 12, "", "twelve|a dozen|dozen"},
    {kNumber, 13, "", "thirteen"},
    {kNumber, 14, "", "fourteen"},
    {kNumber, 15, "", "fifteen"},
    {kNumber, 16, "", "sixteen"},
    {kNumber, 17, "", "seventeen"},
    {kNumber, 18, "", "eighteen"},
    {kNumber, 19, "", "nineteen"},
    {kNumber, 20, "", "twenty"},
    {kNumber, 30, "", "thirty"},
    {kNumber, 40, "", "forty|fourty"},
    {kNumber, 50, "", "fifty"},
    {kNumber, 60, "", "sixty"},
    {kNumber, 70, "", "seventy"},
    {kNumber, 80, "", "eighty"},
    {kNumber, 90, "", "ninety"},
    {kMultiplier, 100, "", "hundred"},
    {kMultiplier, 1000, "", "thousand"},
    {kHalf, 0.5, "", "half|half a|half an|a half|half of a|one half"},
    {kHalf, 0.25, "", "quarter|a quarter of a|a quarter of an|quarter of a|quarter of an|a quarter|quarter of"},
    {kHalf, 0.75, "", "three quarters of a|three quarters of an|three quarter"},
    // Units.
    {kMassUnit, 1e-3, "", "g|gr|gram|grams|gramme|grammes|gm|gms|gf"},
    {kMassUnit, 1, "", "kg|kgs|kilo|kilos|kilogram|kilograms|kilogramme|kilogrammes|kgf"},
    {kMassUnit, 1e-6, "", "mg|milligram|milligrams"},
    {kMassUnit, 1000, "", "ton|tons|tonne|tonnes"},
    {kMassUnit, 0.45359237, "", "lb|lbs|pound|pounds|pounder"},
    {kMassUnit, 0.028349523125, "", "oz|ozs|ounce|ounces"},
    {kMassUnit, 6.35029318, "", "stone|stones"},
    {kLengthUnit, 0.0254, "", "inch|inches|inched|in|incher|inchers|\""},
    {kLengthUnit, 0.3048, "", "ft|foot|feet|footer|'"},
    {kLengthUnit, 0.9144, "", "yard|yards"},
    {kLengthUnit, 1e-3, "", "mm|millimetre|millimetres|millimeter|millimeters|mil"},
    {kLengthUnit, 1e-2, "", "cm|cms|centimetre|centimetres|centimeter|centimeters"},
    {kLengthUnit, 1, "", "m|metre|metres|meter|meters"},
    {kDistanceUnit, 1000, "", "km|kms|kilometre|kilometres|kilometer|kilometers"},
    {kDistanceUnit, 1609.344, "", "mile|miles"},
    {kDistanceUnit, 1852, "", "nautical miles|nm"},
    {kTimeUnit, 60, "", "min|mins|minute|minutes|minuets"},
    {kTimeUnit, 3600, "", "h|hr|hrs|hour|hours"},
    {kTimeUnit, 1, "", "sec|secs|second|seconds"},
    {kSpeedUnit, 1, "",
     "m s|mps|metres per second|meters per second|metre per second|meter per second|metres a "
     "second|meters a second|m sec|ms 1"},
    {kSpeedUnit, 1 / 3.6, "",
     "km h|kmh|kph|kmph|km hr|kilometres per hour|kilometers per hour|kilometres an "
     "hour|kilometers an hour|km per hour|kms per hour|klicks"},
    {kSpeedUnit, 0.44704, "", "mph|miles per hour|miles an hour|mi h"},
    {kSpeedUnit, 1852.0 / 3600, "", "knot|knots|kt|kts|kn"},
    {kSpeedUnit, 0.3048, "", "ft s|fps|feet per second"},
    {kCapacityUnit, 1e-3, "", "mah|milliamp hours|milliamp hour|milliampere hours|ma h|mahr"},
    {kCapacityUnit, 1, "", "ah|amp hours|amp hour|ampere hours|ampere hour"},
    {kEnergyUnit, 1, "", "wh|watt hours|watt hour|w h"},
    {kEnergyUnit, 1000, "", "kwh|kilowatt hours|kilowatt hour"},
    {kVolumeUnit, 1, "", "l|litre|litres|liter|liters|ltr|ltrs"},
    {kVolumeUnit, 1e-3, "", "ml|millilitre|millilitres|milliliter|milliliters"},
    {kVolumeUnit, 3.785411784, "", "gallon|gallons|gal|gals"},
    {kVolumeUnit, 0.473176, "", "pint|pints"},
    {kVoltUnit, 1, "", "v|volt|volts"},
    {kKvUnit, 1, "", "kv|rpm v|rpm volt|rpm per volt"},
    {kCells, 0, "", "s|cell|cells"},
    {kPercent, 0.01, "", "%|percent|per cent"},
    {kOtherUnit, 0, "",
     "mp|megapixel|megapixels|k|p|fps "
     "video|hz|khz|mhz|ghz|w|kw|watt|watts|a|amp|amps|n|newton|newtons|c|degree|"
     "degrees|deg|usd|dollar|dollars|euro|euros|eur|bucks|gbp|axis|axes|people|persons|years|year|days|day|"
     "week|weeks|month|months|week|weeks|month|months|times a "
     "day|hectare|hectares|acre|acres|dof|degrees of freedom|tof|db|lumen|lumens|mm lens|x "
     "zoom|gb|tb|ms|rpm|bit"},
    // Comparing.
    {kAtMost, 0, "",
     "under|below|less than|sub|not heavier than|no heavier than|unter|weniger als|moins de|sous les|menos de|por debajo de|meno di|sotto i|低于|不到|小于|lighter than|smaller than|fewer than|<|shorter than"},
    {kFactor, 2, "", "twice|double|doubled|two times|twofold|doubling"},
    {kFactor, 3, "", "thrice|triple|tripled|three times"},
    {kFactor, 4, "", "quadruple|four times"},
    {kFactor, 0.5, "", "half as|half the|half its|halved|half of the"},
    {kFactor, 1.0 / 3, "", "a third of the|one third the|a third the"},
    {kFactor, 0.25, "", "a quarter of the|quarter the"},
    {kTimes, 0, "", "times|x"},
    {kHeavier, 1, "", "heavier"},
    {kHeavier, -1, "", "lighter"},
    {kHeavier, 0, "", "heavy"},
    {kBigger, 1, "", "bigger|larger|wider"},
    {kBigger, -1, "", "smaller"},
    {kLonger, 1, "", "longer"},
    {kLonger, -1, "", "shorter"},
    {kFaster, 1, "", "faster|quicker"},
    {kFaster, -1, "", "slower"},
    {kCorrection, 0, "",
     "rather|actually|ok|okay|i mean|make that|no wait|correction|or better|scratch that|er|well|call "
     "it|make it|sorry|"
     "nope|let s say|lets say|i meant|change that to|or rather|no sorry|oops|wait|strike that|hmm|hang "
     "on|nah|no no"},
    {kNegation, 0, "", "not a|not an|no|never|isn t a|instead of a|instead of|rather than a|unlike a"},
};

}  // namespace

std::span<const Word> EnglishWords() { return kEnglishWords; }

}  // namespace airsim360::internal

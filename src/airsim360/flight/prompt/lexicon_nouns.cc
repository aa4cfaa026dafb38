// Kinds, sizes, parts of drones, and what is no multirotor.
#include "airsim360/flight/prompt/lexicon.h"

namespace airsim360::internal {
namespace {
using enum WordKind;

constexpr Word kNounWords[] = {
    {kDrone, 0, "",
     "drone|drones|multirotor|multirotors|multicopter|multi rotor|uav|uavs|uas|copter|copters|aircraft|mav|"
     "camera ship|cinema ship|micro aerial vehicle|aerial vehicle|unmanned aerial vehicle|aerial "
     "robot|flying robot|aerial platform|"
     "suas|rpas|flying camera|flying cam|selfie cam|selfie camera|flying selfie cam|machine|vehicle|hexa "
     "machine|quad machine"},
    {kClass, 0, "generic", "generic|ordinary|normal|standard|plain"},
    {kClass, 0, "nano", "nano|palm|palm sized|pocket sized nano"},
    {kClass, 0, "whoop", "whoop|tiny whoop|tinywhoop|micro whoop|toy whoop"},
    {kClass, 0, "racing",
     "racing|race|racer|races|fpv|agile|speed drone|speed quad|speed run|speedrun|racers|drone "
     "racing|interceptor"},
    {kClass, 0, "freestyle", "acrobatic|aerobatic|freestyle|freestyler|bando|toothpick|acro|juicy flicks"},
    {kClass, 0, "cinematic", "cinewhoop|cinematic|cine whoop|cinewhoops"},
    {kClass, 0, "camera",
     "photo|photography|photographing|filming|video|videography|consumer|selfie|aerial "
     "photography|film|films|"
     "cinematography|vlogging|vlog|travel|prosumer|folding camera|foldable "
     "camera|cinema|movie|movies|videos|photos"},
    {kClass, 0, "research", "research|lab|laboratory|experimental|academic|swarm|university"},
    {kClass, 0, "hobby", "hobby|training|trainer|hobbyist|beginner|beginners|toy|kids|educational|education|school"},
    {kClass, 0, "frame_kit", "diy|kit|flamewheel|flame wheel|development|dev|homebuilt|home built|home made"},
    {kClass, 0, "survey",
     "survey|surveying|mapping|surveillance|photogrammetry|scouting|topographic|long range|long ranger|long "
     "endurance|"
     "cruiser|endurance drone|monitoring|patrol"},
    {kClass, 0, "inspection",
     "inspection|inspecting|inspect|enterprise|industrial|matrice|rescue|search and "
     "rescue|police|firefighting|"
     "fire fighting|public safety|commercial|professional"},
    {kClass, 0, "delivery", "delivery|courier|transport|deliveries|deliver|delivers|delivering|logistics|drop"},
    {kClass, 0, "heavy_lift",
     "heavy lift|lifter|cargo|heavy lifter|heavylift|cine lifter|cinelifter|heavy lifting|freight|heavy "
     "duty"},
    {kClass, 0, "agricultural",
     "agricultural|agriculture|spraying|farming|crop|crop spraying|sprayer|spray|sprays|crop "
     "duster|spreading|"
     "spreader|farm|ag|seeding|fertilizing|fertiliser|pesticide|crop dusting"},
    // Sizes.
    {kSize, 0, "tiny", "tiny|micro|miniature|ultra small"},
    {kSize, 0, "small", "mini|small|compact|little|smallish"},
    {kSize, 0, "medium", "medium|mid sized|midsize|medium sized"},
    {kSize, 0, "large", "large|big|biggish|large scale"},
    {kSize, 0, "huge", "huge|giant|enormous|massive|very large|gigantic"},
    // Rotors and their layout.
    {kRotors, 4, "",
     "quad|quadcopter|quadrotor|quads|quadrocopter|quadricopter|quadracopter|quadcopters|quadrotors|four "
     "rotor|"
     "quadrupel|quadri copter|quadropter"},
    {kRotors, 6, "",
     "hexa|hex|hexas|hexrotors|hexarotors|tarot x6|hexacopter|hexarotor|hexrotor|hexcopter|hexicopter|hexacopters|six rotor|hexakopter"},
    {kRotors, 8, "",
     "octo|octos|octorotors|octocopter|octorotor|octa|octacopter|octarotor|octacopters|octocopters|oktocopter|"
     "eight rotor|oktokopter"},
    {kRotors, 3, "", "tricopter|trirotor|tri copter|tri rotor|tricopters|tri|three rotor"},
    {kRotors, 2, "", "bicopter|bi copter|dualcopter|twin rotor"},
    {kRotors, 5, "", "pentacopter|pentarotor|penta|five rotor"},
    {kRotors, 7, "", "heptacopter|heptarotor|septacopter|hepta|seven rotor"},
    {kRotors, 10, "", "decacopter"},
    {kRotors, 12, "", "dodecacopter|dodecarotor"},
    {kCoaxial, 8, "", "x8|octo x8|quad x8|octoquad|octo quad|x8 coaxial|coaxial x8|coax x8"},
    {kCoaxial, 6, "", "y6|y6b|y6 coaxial|coaxial y6"},
    {kLayout, 0, "x", "x frame|x layout|x configuration|x config|x quad|true x|x shaped"},
    {kLayout, 0, "plus", "plus frame|plus layout|plus configuration|plus config|plus shaped|in plus"},
    {kLayout, 0, "h", "h frame|h layout|h quad|h shaped|h configuration"},
    {kLayout, 0, "wide", "wide x|stretched x|squashed x|dead cat|deadcat"},
    {kLayout, 0, "coaxial", "coaxial|coax|co axial|coaxially"},
    {kGuards, 0, "",
     "ducted|guards|guarded|ducts|guard|duct|cage|caged|propeller guard|propeller guards|prop guard|prop "
     "guards|"
     "shrouded|protective cage|collision tolerant|indoor hull|bumpers"},
    {kBrushless, 0, "", "brushless"},
    {kLithiumIon, 0, "", "li ion|liion|lithium ion|18650|21700|li ions|liion pack|li ion pack|18650s|21700s"},
    // Nouns that claim the number beside them.
    {kRotorNoun, 0, "",
     "rotor|rotors|rotored|rotor count|number of rotors|no of rotors|num rotors|rotor number|rotors count|n "
     "rotors|thrusters"},
    {kMotor, 0, "", "motor|motors|engine|engines|motored|motor count|number of motors|no of motors|num motors"},
    {kPropeller, 0, "",
     "propeller|propellers|prop|props|rotor diameter|propeller diameter|prop "
     "diameter|propellor|propellors|airscrew|"
     "prop size|propeller size|rotor blades|rotors diameter|propped|diameter of the propellers|diameter of "
     "the rotors|"
     "diameter of propellers|prop length|propeller length"},
    {kPropeller, 2, "",
     "rotor radius|propeller radius|prop radius|blade radius|radius of the rotors|radius of the "
     "propellers|rotors radius|"
     "blade length|rotor blade length|radius of each rotor|radius of the props"},
    {kBlades, 0, "", "blade|blades|bladed"},
    {kBlades, 3, "", "triblade|tri blade|tri blades|tri bladed|triblades|three bladed"},
    {kBlades, 2, "", "bi blade|bi blades|two bladed|biblade|bi bladed"},
    {kBlades, 4, "", "quad blade|quad blades|four bladed|quadblade"},
    {kArm, 0, "", "arm|arms|arm length|booms|boom"},
    {kWheelbase, 0, "",
     "wheelbase|diagonal|motor to motor|diagonally|motor to motor distance|wheel base|motor spacing|mtm|"
     "diagonal size|diagonal distance|diagonal wheelbase|shaft to shaft|hub to hub|rotor to rotor|rotor to "
     "rotor diagonal|"
     "prop to prop|propeller to propeller|axle to axle|axis to axis|center to center|centre to centre|corner "
     "to corner|"
     "motor shaft to motor shaft|motor centre to motor centre|motor center to motor center|motors "
     "apart|m2m|m to m|"
     "motor to motor diagonal|diag|between opposite motors|across motors|motors diagonal|across the motors|between the motors|between motors|motor motor|opposite motors|opposite rotors|"
     "motor to opposite motor|distance of opposite motors|distance between opposite motors|distance between opposite rotors"},
    {kAcross, 0, "",
     "across|diameter|in diameter|diam|dia|wide|tip to tip|span|from tip to tip|durchmesser|de diametre|"
     "de diametro|diametre|diametro|直径|von durchmesser|im durchmesser"},
    {kFrame, 0, "", "frame|frames|airframe|frame size"},
    {kSizeNoun, 0, "", "class|size|sized"},
    {kPitch, 0, "", "pitch"},
    {kMass, 0, "",
     "takes off at|taking off at|weighing in at|weighs in at|weighing|weighs|weigh|weight|mass|takeoff|take "
     "off|takeoff weight|take off weight|takeoff mass|take off mass|"
     "auw|aum|gtow|togw|wt|wgt|a u w|max tow|ready to go|all up|all up weight|all up mass|mtow|mtom|tow|gross|gross weight|maximum takeoff weight|max "
     "takeoff weight|"
     "maximum take off weight|total|total weight|total mass|flying weight|flight weight|ready to fly|rtf|all "
     "in|"
     "weight with battery|at takeoff|at take off|overall weight|in weight|in mass|tips the scales at|loaded|"
     "fully loaded|including battery|with battery|wet weight|weight including battery|launch weight|heavy|"
     "all up at|auw of|takes off with|lifts off at|lifts off with|leaves the ground at|leaves the ground with"},
    {kEmpty, 0, "",
     "on its own|by itself|before payload|before the payload|before load|empty with battery|"
     "empty weight with battery|empty incl battery|empty including battery|empty|empty weight|without payload|without load|unladen|operating empty weight|bare weight|w o payload|"
     "w o load|without the payload|without any payload|without cargo|no payload|unloaded|"
     "empty mass|oew|oem|operating empty mass|own weight|self weight|own mass|drone itself|quad itself|copter itself|aircraft itself|drone alone|drone only|without it|without them|empty weight incl battery|empty weight including battery|empty weight w battery|weight without payload|lands at|land at|landing weight|landing mass|landing at|with empty tank|empty tank|tank empty|with an empty tank|net weight|net mass|no load"},
    {kBare, 0, "",
     "without battery|without the battery|without batteries|without a battery|without batt|without "
     "lipo|without lipos|"
     "without the lipo|without pack|without the pack|w o battery|w o batteries|w o batt|w o lipo|w o pack|no "
     "battery|"
     "no batt|no lipo|no batteries|minus battery|minus the battery|less battery|battery excluded|excl "
     "battery|"
     "excluding battery|excluding batteries|excluding the battery|excl batteries|excl lipo|excluding lipo|"
     "not counting the battery|before battery|before the battery|battery not included|not including battery|"
     "not including the battery|dry weight|dry mass|dry|dry weight no batt|sans batterie|sans la "
     "batterie|sans lipo|"
     "ohne akku|ohne akkus|ohne batterie|ohne lipo|sin bateria|sin la bateria|senza "
     "batteria|不含电池|无电池|不带电池"},
    {kPayload, 0, "",
     "payload|payloads|carrying|carries|carry|lifting|lifts|lift|useful load|payload capacity|max payload|"
     "maximum "
     "payload|hauling|haul|hauls|lugging|lug|lugs|hoist|hoists|bring|brings|bringing|tote|totes|ferry|"
     "ferries|"
     "ferrying|picking up|pick up|hold|holding|loaded with|load of|load capacity|lifting "
     "capacity|lift capacity|"
     "delivers|deliver|delivering|drops|payload of|cargo of|carrying capacity|holds|takes|lifts up|picks up"},
    {kBattery, 0, "",
     "battery|batteries|batt|batts|pack|packs|capacity|battery capacity|pack capacity|lipo|lipos|lipo pack|battery "
     "pack|accumulator|lihv|li po|hv lipo|lithium"},
    {kHover, 0, "",
     "hover|hovering|hovering for|hovers for|hover for|hovering at|hovers|hover time|hovered|hover "
     "endurance|hovering time|hover flight|loiter"},
    {kFlight, 0, "",
     "time|flight|flights|flies for|fly for|flying for|stays up for|stay up for|airborne for|in the air "
     "for|aloft for|"
     "lasts|lasting|last|stay in the air|stay in the air for|stays in the air|stays in the air "
     "for|endurance|flight time|flying time|fly time|air time|airtime|in the air|aloft|battery life|"
     "stay up|airborne|stays up|runtime|run time|flight duration"},
    {kSpeed, 0, "", "speed|top speed|max speed|maximum speed|velocity|speeds|full speed|flat out|vmax|level speed|top end"},
    {kWind, 0, "",
     "wind|winds|gust|gusts|wind resistance|windy|breeze|cruise|cruising|cruises|cruise speed|cruising speed|"
     "headwind|crosswind|storm"},
    {kThrustRatio, 0, "",
     "twr|t w|thrust to weight|thrust to weight ratio|thrust weight|thrust weight ratio|power to weight|"
     "maximum thrust to weight|maximum thrust to weight ratio|max thrust to weight|max thrust to weight ratio|"
     "power to weight ratio|punch|punch out|t to w|thrust ratio|thrust to mass|thrust margin|thrust reserve"},
    {kThrust, 0, "",
     "thrust|max thrust|maximum thrust|total thrust|max total thrust|maximum total thrust|total max thrust|"
     "static thrust|combined thrust|peak thrust|full "
     "thrust|pull|pulls|pulling|schub|gesamtschub|standschub|poussee|"
     "poussee totale|empuje|empuje total|spinta|spinta totale|推力|总推力|最大推力|拉力|总拉力|最大拉力"},
    {kThing, 0, "",
     "gsd|ground sampling distance|ground sample distance|pixel "
     "size|doorway|doorways|door|gap|gaps|tunnel|manhole|"
     "hatch|opening|backpack|suitcase|case|shelf|drawer|trunk|rucksack|mast|pole|stand "
     "off|standoff|standoffs|"
     "spacing|line spacing|track spacing|hole|holes|mounting|stack|screws|tube|tubes|pipe|pipes|plate|plates|"
     "thickness|tow line|towline|string|gate|gates|hoop|hoops|window|windows|corridor|corridors|room|arena|"
     "volume|stand"},
    {kElse, 0, "",
     "sensor size|inch sensor|cmos|ccd|imager|image sensor|monitor|tv|lcd|oled|oled "
     "screen|barrel|filter|sensor diagonal|screen|display|lens|focal|altitude|ceiling|range "
     "of|distance|radius|"
     "height|tall|resolution|charge|charging|recharge|charges|setup|set "
     "up|assembly|assemble|warmup|limit|limits|"
     "climb|climbs|climbing|ascends|ascend|ascending|descend|descending|sinks|sinking|climb rate|descent|descends|descent rate|ascent|ascends|ascent rate|vertical speed|"
     "part|level|ip|version|mark|gen|generation|field of view|fov|latency|zoom|deep|thick|cable|tether|per "
     "motor|"
     "each motor|landing gear|legs|antenna|goggles|goggle|price|cost|budget|row|swath|temperature|wing "
     "loading|"
     "controller|transmitter|remote|above ground|agl|high|swath width|width"},
    // No multirotors. A drone is lifted by fixed propellers alone.
    {kNoMultirotor, 0, "a fixed wing",
     "fixed wing|glider|sailplane|wingspan|wing span|flying wing|delta wing|airplane|aeroplane|ornithopter|"
     "flapping wing|flapping wings|ebee|scaneagle|scan eagle|raven rq|predator drone|mq 9|reaper "
     "drone|global hawk|"
     "bayraktar|tb2|biplane|seaplane|turboprop|cessna|monoplane|elevons|ailerons|sensefly ebee|parrot "
     "disco|albatross "
     "uav|x8 skywalker|skywalker x8|flying fish wing|paraglider|hang glider|propeller plane|model plane|rc "
     "plane"},
    {kNoMultirotor, 0, "a VTOL with wings",
     "vtol|e vtol|evtol|tail sitter|tailsitter|tilt rotor|tiltrotor|tilt wing|tiltwing|quadplane|quad plane|"
     "wingtraone|wingtra|wingcopter|deltaquad|quantum trinity|trinity f90|convertiplane|songbird "
     "vtol|zipline|"
     "marlyn|foxtech babyshark|transition drone|osprey|v 22"},
    {kNoMultirotor, 0, "a helicopter",
     "helicopter|helicopters|heli|single rotor|tail rotor|collective "
     "pitch|autogyro|gyrocopter|swashplate|chinook|"
     "tandem rotor helicopter|main rotor|gyroplane|flybar|rotorcraft helicopter|black hornet"},
    {kNoMultirotor, 0, "a water craft",
     "submarine|submarines|underwater|under water|rov|submersible|auv|torpedo|torpedoes|diving drone|sub "
     "sea|subsea"},
    {kNoMultirotor, 0, "lighter than air", "blimp|airship|zeppelin|balloon|hot air balloon|weather balloon|dirigible|aerostat|helium"},
    {kNoMultirotor, 0, "a jet or rocket",
     "jet fighter|fighter jet|turbofan|turbofans|turbojet|jet engine|jet engines|jet "
     "powered|afterburner|afterburners|"
     "afterburning|rocket|missile|cruise missile|rocket "
     "powered|scramjet|spaceship|spacecraft|satellite|jetpack|"
     "jet turbine|turbine powered"},
    {kNoMultirotor, 0, "a ground vehicle",
     "ground vehicle|road vehicle|wheeled vehicle|surface vehicle|hovercraft|hoverboard|ground robot|robot "
     "dog|quadruped|ugv|rover drone"},
    {kNoMultirotor, 0, "a place without air to fly in",
     "on the moon|on mars|lunar surface|martian|outer space|in outer space|in vacuum|in a vacuum"},
    {kNoMultirotor, 0, "beyond the speed of sound",
     "supersonic|hypersonic|speed of sound|sound barrier|speed of light|light speed|faster than sound"},
    {kNoMultirotor, 0, "an endless flight",
     "infinite flight time|infinite flight|infinite endurance|infinite battery|infinite battery "
     "life|unlimited flight time|"
     "unlimited endurance|unlimited flight|endless flight|perpetual motion|perpetuum mobile|free energy|overunity|"
     "over unity|never needs charging|never needs a charge|never runs out|self charging props|self recharging|endless flight time|flies forever|fly "
     "forever|hover forever|"
     "hovers forever|never lands|perpetual flight|stays up forever|stay up forever|eternal flight"},
    {kVehicle, 0, "a vehicle",
     "boat|ship|car|rover|truck|bicycle|bike|motorcycle|train|tank "
     "vehicle|yacht|plane|planes|jet|bus|tractor|"
     "tram|scooter|sailboat|bird|kite|frisbee|elevator|wing"},
};

}  // namespace

std::span<const Word> NounWords() { return kNounWords; }

}  // namespace airsim360::internal

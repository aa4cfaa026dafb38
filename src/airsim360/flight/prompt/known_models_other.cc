// Ready-made multirotors of other makers. Figures of the makers' sheets, as remembered.
#include "airsim360/flight/prompt/known_models.h"

namespace airsim360::internal {
namespace {
constexpr RotorLayout X = RotorLayout::kX;
constexpr std::string_view kSheet = "maker's sheet, as remembered";
constexpr std::string_view kFull = "maker's sheet, as remembered; at its largest take-off weight";

constexpr KnownModel kModels[] = {
    // aliases, title, class, rotors, layout, kg, mm, propeller and pitch in, cells, Ah, Wh, flight, hover, m/s
    {"parrot anafi|anafi", "Parrot Anafi", "camera", 4, X, 0.32, 0, 0, 0, 2, 2.7, 0, 25, 0, 15, kSheet},
    {"parrot anafi usa|anafi usa|anafi thermal|parrot anafi thermal", "Parrot Anafi USA", "camera", 4, X, 0.5, 0, 0, 0, 3, 3.4, 0, 32, 0,
     14.7, kSheet},
    {"parrot anafi ai|anafi ai", "Parrot Anafi Ai", "camera", 4, X, 0.898, 0, 0, 0, 0, 0, 0, 32, 0, 16, kSheet},
    {"parrot bebop|bebop|parrot bebop drone|bebop 1|bebop drone", "Parrot Bebop", "camera", 4, X, 0.4, 0, 0, 0, 3, 1.2, 0, 11, 0, 13,
     kSheet},
    {"parrot bebop 2|bebop 2|parrot bebop 2 power", "Parrot Bebop 2", "camera", 4, X, 0.5, 0, 6, 0, 3, 2.7, 0, 25, 0, 16, kSheet},
    {"ar drone|ar drone 2|ar drone 2.0|parrot ar drone|parrot ar drone 2|parrot ar drone 2.0|ardrone",
     "Parrot AR.Drone "
     "2.0",
     "hobby", 4, X, 0.38, 0, 8, 0, 3, 1, 0, 12, 0, 11, kSheet},
    {"parrot mambo|mambo", "Parrot Mambo", "hobby", 4, X, 0.063, 0, 0, 0, 1, 0.66, 0, 8, 0, 8, kSheet},
    {"skydio 2|skydio2|skydio 2 plus|skydio", "Skydio 2", "camera", 4, X, 0.775, 0, 0, 0, 3, 4.28, 0, 23, 0, 16, kSheet},
    {"skydio x2|skydio x2d|skydio x2e", "Skydio X2", "inspection", 4, X, 1.325, 0, 0, 0, 0, 0, 0, 35, 0, 11.4, kSheet},
    {"skydio x10|skydio x10d", "Skydio X10", "inspection", 4, X, 2.11, 0, 0, 0, 0, 0, 0, 40, 0, 20, kSheet},
    {"3dr solo|solo drone|3d robotics solo", "3DR Solo", "camera", 4, X, 1.5, 460, 10, 4.5, 4, 5.2, 0, 25, 0, 24.6, kSheet},
    {"3dr iris|iris|px4 iris|iris plus|3dr iris plus|arducopter iris|iris quad|iris quadcopter", "3DR Iris+", "hobby", 4, X, 1.282, 550,
     9.5, 4.5, 3, 5.1, 0, 18, 0, 0, kSheet},
    {"autel evo|autel evo 1", "Autel EVO", "camera", 4, X, 0.863, 0, 8.3, 0, 3, 4.3, 0, 30, 0, 20, kSheet},
    {"autel evo ii|evo ii|autel evo 2|evo 2|autel robotics evo ii", "Autel EVO II", "camera", 4, X, 1.127, 397, 0, 0, 3, 7.1, 82, 40, 35,
     20, kSheet},
    {"autel evo ii pro|evo ii pro|autel evo 2 pro|evo 2 pro|evo ii dual|autel evo ii dual", "Autel EVO II Pro", "camera", 4, X, 1.191, 397,
     0, 0, 3, 7.1, 82, 40, 35, 20, kSheet},
    {"autel evo lite|evo lite|evo lite plus|autel evo lite plus", "Autel EVO Lite+", "camera", 4, X, 0.835, 0, 0, 0, 3, 6.175, 0, 40, 38,
     18, kSheet},
    {"autel evo nano|evo nano|evo nano plus|autel evo nano plus", "Autel EVO Nano+", "camera", 4, X, 0.249, 0, 0, 0, 2, 2.25, 0, 28, 26, 15,
     kSheet},
    {"autel evo max|evo max|evo max 4t|autel evo max 4t", "Autel EVO Max 4T", "inspection", 4, X, 1.6, 466, 0, 0, 4, 8.07, 0, 42, 38, 23,
     kSheet},
    {"typhoon h|yuneec typhoon h|typhoon h pro|yuneec typhoon h pro|typhoon h plus", "Yuneec Typhoon H", "camera", 6, X, 1.95, 520, 0, 0, 4,
     5.4, 0, 22, 0, 19.4, kSheet},
    {"h520|yuneec h520|typhoon h520|yuneec h520e|h520e", "Yuneec H520", "inspection", 6, X, 1.633, 520, 0, 0, 4, 5.25, 0, 28, 0, 20,
     kSheet},
    {"typhoon q500|yuneec q500|q500|yuneec typhoon q500|typhoon 4k|yuneec typhoon", "Yuneec Typhoon Q500", "camera", 4, X, 1.7, 565, 13, 0,
     3, 5.4, 0, 25, 0, 8, kSheet},
    {"freefly alta 8|alta 8|alta 8 pro|freefly alta 8 pro", "Freefly Alta 8", "heavy_lift", 8, X, 13, 1126, 18, 6, 6, 20, 0, 0, 0, 0,
     "maker's sheet, as remembered; 6.2 kg empty, with batteries and a camera of 3 kg"},
    {"freefly alta 6|alta 6", "Freefly Alta 6", "heavy_lift", 6, X, 10, 1126, 18, 6, 6, 16, 0, 0, 0, 0,
     "maker's sheet, as remembered; 4.5 kg empty, with batteries and a camera of 3 kg"},
    {"freefly alta x|alta x", "Freefly Alta X", "heavy_lift", 4, X, 18.5, 1415, 33, 0, 12, 32, 0, 0, 0, 26,
     "maker's sheet, as remembered; 10.4 kg empty, with two 12S 16 Ah packs"},
    {"freefly astro|astro drone", "Freefly Astro", "survey", 4, X, 7, 930, 21, 7, 0, 0, 0, 30, 0, 15,
     "maker's sheet, as remembered; with batteries and a camera"},
    {"intel falcon 8 plus|falcon 8|intel falcon 8|falcon 8 plus|asctec falcon 8", "Intel Falcon 8+", "inspection", 8, X, 2.8, 0, 8, 0, 3, 8,
     0, 16, 0, 16, kFull},
    {"intel shooting star|shooting star", "Intel Shooting Star", "camera", 4, X, 0.33, 0, 6, 0, 3, 0, 0, 20, 0, 10, kSheet},
    {"asctec hummingbird|hummingbird", "AscTec Hummingbird", "research", 4, X, 0.5, 340, 7.87, 0, 3, 2.1, 0, 20, 0, 15, kSheet},
    {"asctec pelican|pelican quad|pelican quadrotor", "AscTec Pelican", "research", 4, X, 1.65, 420, 10, 0, 3, 6.25, 0, 16, 0, 16, kFull},
    {"asctec firefly|firefly hexacopter|firefly hexa|firefly hex", "AscTec Firefly", "research", 6, X, 1.6, 430, 8, 0, 3, 4.9, 0, 12, 0, 15,
     kFull},
    {"sensefly albris|albris|sensefly exom", "senseFly albris", "inspection", 4, X, 1.8, 0, 0, 0, 3, 8.5, 0, 22, 0, 12, kSheet},
    {"elios 2|flyability elios 2|flyability elios|elios", "Flyability Elios 2", "cinematic", 4, X, 1.45, 0, 5, 0, 6, 5.2, 0, 10, 0, 6.5,
     kSheet},
    {"elios 3|flyability elios 3", "Flyability Elios 3", "cinematic", 4, X, 1.9, 0, 5, 0, 0, 0, 0, 12, 0, 7, kSheet},
    {"gopro karma|karma drone", "GoPro Karma", "camera", 4, X, 1.006, 303, 10, 0, 4, 5.1, 0, 20, 0, 15, kSheet},
    {"sony airpeak|airpeak s1|airpeak|sony airpeak s1", "Sony Airpeak S1", "camera", 4, X, 3.1, 645, 17, 0, 0, 0, 0, 22, 0, 25, kSheet},
    {"fimi x8|fimi x8 se|xiaomi fimi x8", "FIMI X8 SE", "camera", 4, X, 0.765, 0, 0, 0, 3, 4.5, 0, 35, 0, 18, kSheet},
    {"fimi x8 mini|fimi mini", "FIMI X8 Mini", "camera", 4, X, 0.258, 0, 0, 0, 2, 2.2, 0, 30, 0, 16, kSheet},
    {"potensic atom|potensic atom se|potensic", "Potensic Atom", "camera", 4, X, 0.249, 0, 0, 0, 2, 2.5, 0, 32, 0, 16, kSheet},
    {"holy stone hs720|hs720|holystone hs720|holy stone", "Holy Stone HS720", "camera", 4, X, 0.46, 0, 0, 0, 3, 2.8, 0, 26, 0, 0, kSheet},
    {"hubsan zino|zino|hubsan zino pro", "Hubsan Zino", "camera", 4, X, 0.7, 310, 0, 0, 3, 3, 0, 23, 0, 10, kSheet},
    {"hubsan x4|hubsan h107|hubsan x4 h107", "Hubsan X4 H107", "nano", 4, X, 0.03, 0, 2.17, 0, 1, 0.24, 0, 7, 0, 0, kSheet},
    {"syma x5c|syma x5|syma", "Syma X5C", "hobby", 4, X, 0.1, 0, 0, 0, 1, 0.5, 0, 7, 0, 0, kSheet},
    {"hover camera|hover camera passport|hover passport", "Hover Camera Passport", "camera", 4, X, 0.242, 0, 0, 0, 0, 0, 0, 10, 0, 8,
     kSheet},
    {"hoverair x1|hover air x1|hoverair|hover air", "HoverAir X1", "camera", 4, X, 0.125, 0, 0, 0, 2, 1.05, 0, 11, 0, 7, kSheet},
    {"microdrones md4 1000|md4 1000|md4", "microdrones md4-1000", "survey", 4, X, 5.55, 1030, 28, 0, 6, 13, 0, 45, 0, 12, kFull},
    {"black widow|red cat black widow|teal 2|teal drone", "Teal 2", "inspection", 4, X, 1.25, 0, 0, 0, 0, 0, 0, 30, 0, 10, kSheet},
};

}  // namespace

std::span<const KnownModel> OtherModels() { return kModels; }

}  // namespace airsim360::internal

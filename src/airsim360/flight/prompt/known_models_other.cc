// Ready-made multirotors of other makers. Figures of the makers' sheets, as remembered.
#include "airsim360/flight/prompt/known_models.h"

namespace airsim360::internal {
namespace {

using Layout = RotorLayout;

constexpr std::string_view kOtherSheet = "maker's sheet, as remembered";
constexpr std::string_view kOtherFullyLoaded = "maker's sheet, as remembered; at its largest take-off weight";

constexpr KnownModel kOtherModels[] = {
    // aliases, title, class, rotors, layout, kg, mm, propeller and pitch in, cells, Ah, Wh, flight, hover, m/s
    {"parrot anafi|anafi", "Parrot Anafi", "camera", 4, Layout::kX, 0.32, 0, 0, 0, 2, 2.7, 0, 25, 0, 15, kOtherSheet},
    {"parrot anafi usa|anafi usa|anafi thermal|parrot anafi thermal", "Parrot Anafi USA", "camera", 4, Layout::kX, 0.5, 0, 0, 0, 3, 3.4, 0,
     32, 0, 14.7, kOtherSheet},
    {"parrot anafi ai|anafi ai", "Parrot Anafi Ai", "camera", 4, Layout::kX, 0.898, 0, 0, 0, 0, 0, 0, 32, 0, 16, kOtherSheet},
    {"parrot bebop|bebop|parrot bebop drone|bebop 1|bebop drone", "Parrot Bebop", "camera", 4, Layout::kX, 0.4, 0, 0, 0, 3, 1.2, 0, 11, 0,
     13, kOtherSheet},
    {"parrot bebop 2|bebop 2|parrot bebop 2 power", "Parrot Bebop 2", "camera", 4, Layout::kX, 0.5, 0, 6, 0, 3, 2.7, 0, 25, 0, 16,
     kOtherSheet},
    {"ar drone|ar drone 2|ar drone 2.0|parrot ar drone|parrot ar drone 2|parrot ar drone 2.0|ardrone",
     "Parrot AR.Drone "
     "2.0",
     "hobby", 4, Layout::kX, 0.38, 0, 8, 0, 3, 1, 0, 12, 0, 11, kOtherSheet},
    {"parrot mambo|mambo", "Parrot Mambo", "hobby", 4, Layout::kX, 0.063, 0, 0, 0, 1, 0.66, 0, 8, 0, 8, kOtherSheet},
    {"skydio 2|skydio2|skydio 2 plus|skydio", "Skydio 2", "camera", 4, Layout::kX, 0.775, 0, 0, 0, 3, 4.28, 0, 23, 0, 16, kOtherSheet},
    {"skydio x2|skydio x2d|skydio x2e", "Skydio X2", "inspection", 4, Layout::kX, 1.325, 0, 0, 0, 0, 0, 0, 35, 0, 11.4, kOtherSheet},
    {"skydio x10|skydio x10d", "Skydio X10", "inspection", 4, Layout::kX, 2.11, 0, 0, 0, 0, 0, 0, 40, 0, 20, kOtherSheet},
    {"3dr solo|solo drone|3d robotics solo", "3DR Solo", "camera", 4, Layout::kX, 1.5, 460, 10, 4.5, 4, 5.2, 0, 25, 0, 24.6, kOtherSheet},
    {"3dr iris|iris|px4 iris|iris plus|3dr iris plus|arducopter iris|iris quad|iris quadcopter", "3DR Iris+", "hobby", 4, Layout::kX, 1.282,
     550, 9.5, 4.5, 3, 5.1, 0, 18, 0, 0, kOtherSheet},
    {"autel evo|autel evo 1", "Autel EVO", "camera", 4, Layout::kX, 0.863, 0, 8.3, 0, 3, 4.3, 0, 30, 0, 20, kOtherSheet},
    {"autel evo ii|evo ii|autel evo 2|evo 2|autel robotics evo ii", "Autel EVO II", "camera", 4, Layout::kX, 1.127, 397, 0, 0, 3, 7.1, 82,
     40, 35, 20, kOtherSheet},
    {"autel evo ii pro|evo ii pro|autel evo 2 pro|evo 2 pro|evo ii dual|autel evo ii dual", "Autel EVO II Pro", "camera", 4, Layout::kX,
     1.191, 397, 0, 0, 3, 7.1, 82, 40, 35, 20, kOtherSheet},
    {"autel evo lite|evo lite|evo lite plus|autel evo lite plus", "Autel EVO Lite+", "camera", 4, Layout::kX, 0.835, 0, 0, 0, 3, 6.175, 0,
     40, 38, 18, kOtherSheet},
    {"autel evo nano|evo nano|evo nano plus|autel evo nano plus", "Autel EVO Nano+", "camera", 4, Layout::kX, 0.249, 0, 0, 0, 2, 2.25, 0,
     28, 26, 15, kOtherSheet},
    {"autel evo max|evo max|evo max 4t|autel evo max 4t", "Autel EVO Max 4T", "inspection", 4, Layout::kX, 1.6, 466, 0, 0, 4, 8.07, 0, 42,
     38, 23, kOtherSheet},
    {"typhoon h|yuneec typhoon h|typhoon h pro|yuneec typhoon h pro|typhoon h plus", "Yuneec Typhoon H", "camera", 6, Layout::kX, 1.95, 520,
     0, 0, 4, 5.4, 0, 22, 0, 19.4, kOtherSheet},
    {"h520|yuneec h520|typhoon h520|yuneec h520e|h520e", "Yuneec H520", "inspection", 6, Layout::kX, 1.633, 520, 0, 0, 4, 5.25, 0, 28, 0,
     20, kOtherSheet},
    {"typhoon q500|yuneec q500|q500|yuneec typhoon q500|typhoon 4k|yuneec typhoon", "Yuneec Typhoon Q500", "camera", 4, Layout::kX, 1.7,
     565, 13, 0, 3, 5.4, 0, 25, 0, 8, kOtherSheet},
    {"freefly alta 8|alta 8|alta 8 pro|freefly alta 8 pro", "Freefly Alta 8", "heavy_lift", 8, Layout::kX, 13, 1126, 18, 6, 6, 20, 0, 0, 0,
     0, "maker's sheet, as remembered; 6.2 kg empty, with batteries and a camera of 3 kg"},
    {"freefly alta 6|alta 6", "Freefly Alta 6", "heavy_lift", 6, Layout::kX, 10, 1126, 18, 6, 6, 16, 0, 0, 0, 0,
     "maker's sheet, as remembered; 4.5 kg empty, with batteries and a camera of 3 kg"},
    {"freefly alta x|alta x", "Freefly Alta X", "heavy_lift", 4, Layout::kX, 18.5, 1415, 33, 0, 12, 32, 0, 0, 0, 26,
     "maker's sheet, as remembered; 10.4 kg empty, with two 12S 16 Ah packs"},
    {"freefly astro|astro drone", "Freefly Astro", "survey", 4, Layout::kX, 7, 930, 21, 7, 0, 0, 0, 30, 0, 15,
     "maker's sheet, as remembered; with batteries and a camera"},
    {"intel falcon 8 plus|falcon 8|intel falcon 8|falcon 8 plus|asctec falcon 8", "Intel Falcon 8+", "inspection", 8, Layout::kX, 2.8, 0, 8,
     0, 3, 8, 0, 16, 0, 16, kOtherFullyLoaded},
    {"intel shooting star|shooting star", "Intel Shooting Star", "camera", 4, Layout::kX, 0.33, 0, 6, 0, 3, 0, 0, 20, 0, 10, kOtherSheet},
    {"asctec hummingbird|hummingbird", "AscTec Hummingbird", "research", 4, Layout::kX, 0.5, 340, 7.87, 0, 3, 2.1, 0, 20, 0, 15,
     kOtherSheet},
    {"asctec pelican|pelican quad|pelican quadrotor", "AscTec Pelican", "research", 4, Layout::kX, 1.65, 420, 10, 0, 3, 6.25, 0, 16, 0, 16,
     kOtherFullyLoaded},
    {"asctec firefly|firefly hexacopter|firefly hexa|firefly hex", "AscTec Firefly", "research", 6, Layout::kX, 1.6, 430, 8, 0, 3, 4.9, 0,
     12, 0, 15, kOtherFullyLoaded},
    {"sensefly albris|albris|sensefly exom", "senseFly albris", "inspection", 4, Layout::kX, 1.8, 0, 0, 0, 3, 8.5, 0, 22, 0, 12,
     kOtherSheet},
    {"elios 2|flyability elios 2|flyability elios|elios", "Flyability Elios 2", "cinematic", 4, Layout::kX, 1.45, 0, 5, 0, 6, 5.2, 0, 10, 0,
     6.5, kOtherSheet},
    {"elios 3|flyability elios 3", "Flyability Elios 3", "cinematic", 4, Layout::kX, 1.9, 0, 5, 0, 0, 0, 0, 12, 0, 7, kOtherSheet},
    {"gopro karma|karma drone", "GoPro Karma", "camera", 4, Layout::kX, 1.006, 303, 10, 0, 4, 5.1, 0, 20, 0, 15, kOtherSheet},
    {"sony airpeak|airpeak s1|airpeak|sony airpeak s1", "Sony Airpeak S1", "camera", 4, Layout::kX, 3.1, 645, 17, 0, 0, 0, 0, 22, 0, 25,
     kOtherSheet},
    {"fimi x8|fimi x8 se|xiaomi fimi x8", "FIMI X8 SE", "camera", 4, Layout::kX, 0.765, 0, 0, 0, 3, 4.5, 0, 35, 0, 18, kOtherSheet},
    {"fimi x8 mini|fimi mini", "FIMI X8 Mini", "camera", 4, Layout::kX, 0.258, 0, 0, 0, 2, 2.2, 0, 30, 0, 16, kOtherSheet},
    {"potensic atom|potensic atom se|potensic", "Potensic Atom", "camera", 4, Layout::kX, 0.249, 0, 0, 0, 2, 2.5, 0, 32, 0, 16,
     kOtherSheet},
    {"holy stone hs720|hs720|holystone hs720|holy stone", "Holy Stone HS720", "camera", 4, Layout::kX, 0.46, 0, 0, 0, 3, 2.8, 0, 26, 0, 0,
     kOtherSheet},
    {"hubsan zino|zino|hubsan zino pro", "Hubsan Zino", "camera", 4, Layout::kX, 0.7, 310, 0, 0, 3, 3, 0, 23, 0, 10, kOtherSheet},
    {"hubsan x4|hubsan h107|hubsan x4 h107", "Hubsan X4 H107", "nano", 4, Layout::kX, 0.03, 0, 2.17, 0, 1, 0.24, 0, 7, 0, 0, kOtherSheet},
    {"syma x5c|syma x5|syma", "Syma X5C", "hobby", 4, Layout::kX, 0.1, 0, 0, 0, 1, 0.5, 0, 7, 0, 0, kOtherSheet},
    {"hover camera|hover camera passport|hover passport", "Hover Camera Passport", "camera", 4, Layout::kX, 0.242, 0, 0, 0, 0, 0, 0, 10, 0,
     8, kOtherSheet},
    {"hoverair x1|hover air x1|hoverair|hover air", "HoverAir X1", "camera", 4, Layout::kX, 0.125, 0, 0, 0, 2, 1.05, 0, 11, 0, 7,
     kOtherSheet},
    {"microdrones md4 1000|md4 1000|md4", "microdrones md4-1000", "survey", 4, Layout::kX, 5.55, 1030, 28, 0, 6, 13, 0, 45, 0, 12,
     kOtherFullyLoaded},
    {"black widow|red cat black widow|teal 2|teal drone", "Teal 2", "inspection", 4, Layout::kX, 1.25, 0, 0, 0, 0, 0, 0, 30, 0, 10,
     kOtherSheet},
};

}  // namespace

std::span<const KnownModel> OtherModels() { return kOtherModels; }

}  // namespace airsim360::internal

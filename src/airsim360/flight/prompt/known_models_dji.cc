// DJI's multirotors. Figures of the maker's specification pages, as remembered; take-off weights without payload,
// flight times to an empty battery in still air.
#include "airsim360/flight/prompt/known_models.h"

namespace airsim360::internal {
namespace {

using Layout = RotorLayout;

constexpr std::string_view kDjiSheet = "DJI specification, as remembered";
constexpr std::string_view kManual = "DJI manual, as remembered; typical load";
constexpr std::string_view kDjiFullyLoaded = "DJI specification, as remembered; fully loaded";

constexpr KnownModel kDjiModels[] = {
    // aliases, title, class, rotors, layout, kg, mm, propeller and pitch in, cells, Ah, Wh, flight, hover, m/s
    {"dji mavic 3|mavic 3|mavic 3 classic|dji mavic 3 classic|mavic 3 cine|mavic3|dji mavic", "DJI Mavic 3", "camera", 4, Layout::kX, 0.895,
     380.1, 9.4, 5.3, 4, 5, 77, 46, 40, 21, kDjiSheet},
    {"dji mavic 3 pro|mavic 3 pro", "DJI Mavic 3 Pro", "camera", 4, Layout::kX, 0.958, 380.1, 9.4, 5.3, 4, 5, 77, 43, 37, 21, kDjiSheet},
    {"dji mavic 3 enterprise|mavic 3 enterprise|mavic 3e|mavic 3 thermal|mavic 3t|dji mavic 3t|dji mavic 3e|mavic 3m|"
     "mavic 3 multispectral",
     "DJI Mavic 3 Enterprise", "camera", 4, Layout::kX, 0.915, 380.1, 9.4, 5.3, 4, 5, 77, 45, 38, 21, kDjiSheet},
    {"dji mavic 2 pro|mavic 2 pro|dji mavic 2|mavic 2|mavic 2 zoom|dji mavic 2 zoom|mavic 2 enterprise", "DJI Mavic 2 Pro", "camera", 4,
     Layout::kX, 0.907, 354, 8.7, 4.3, 4, 3.85, 59.29, 31, 29, 20, kDjiSheet},
    {"dji mavic pro|mavic pro|mavic 1|mavic", "DJI Mavic Pro", "camera", 4, Layout::kX, 0.734, 335, 8.3, 3, 3, 3.83, 43.6, 27, 24, 18,
     kDjiSheet},
    {"dji mavic air|mavic air", "DJI Mavic Air", "camera", 4, Layout::kX, 0.43, 213, 5.3, 3.2, 3, 2.375, 27.43, 21, 20, 19, kDjiSheet},
    {"dji mavic air 2|mavic air 2|dji air 2|air 2", "DJI Mavic Air 2", "camera", 4, Layout::kX, 0.57, 302, 7.2, 3.8, 3, 3.5, 40.42, 34, 33,
     19, kDjiSheet},
    {"dji air 2s|air 2s|mavic air 2s", "DJI Air 2S", "camera", 4, Layout::kX, 0.595, 302, 7.2, 3.8, 3, 3.5, 40.42, 31, 30, 19, kDjiSheet},
    {"dji air 3|air 3|dji air", "DJI Air 3", "camera", 4, Layout::kX, 0.72, 269, 0, 0, 4, 4.241, 62.6, 46, 42, 21, kDjiSheet},
    {"dji air 3s|air 3s", "DJI Air 3S", "camera", 4, Layout::kX, 0.724, 269, 0, 0, 4, 4.276, 62.5, 45, 41, 21, kDjiSheet},
    {"dji mini 2|mini 2|mavic mini 2|dji mini|dji mini 2 se|mini 2 se", "DJI Mini 2", "camera", 4, Layout::kX, 0.249, 213, 4.7, 2.6, 2,
     2.25, 17.32, 31, 0, 16, kDjiSheet},
    {"dji mini se|mini se", "DJI Mini SE", "camera", 4, Layout::kX, 0.249, 213, 4.7, 2.6, 2, 2.25, 17.32, 30, 0, 13, kDjiSheet},
    {"dji mavic mini|mavic mini|dji mini 1", "DJI Mavic Mini", "camera", 4, Layout::kX, 0.249, 213, 4.7, 2.6, 2, 2.4, 17.28, 30, 0, 13,
     kDjiSheet},
    {"dji mini 3|mini 3", "DJI Mini 3", "camera", 4, Layout::kX, 0.248, 247, 6, 3, 2, 2.453, 18.1, 38, 33, 16, kDjiSheet},
    {"dji mini 3 pro|mini 3 pro", "DJI Mini 3 Pro", "camera", 4, Layout::kX, 0.249, 247, 6, 3, 2, 2.453, 18.1, 34, 30, 16, kDjiSheet},
    {"dji mini 4 pro|mini 4 pro|dji mini 4|mini 4|mini 4k|dji mini 4k", "DJI Mini 4 Pro", "camera", 4, Layout::kX, 0.249, 247, 6, 3, 2,
     2.59, 18.96, 34, 30, 16, kDjiSheet},
    {"spark|dji spark", "DJI Spark", "camera", 4, Layout::kX, 0.3, 170, 4.7, 3, 3, 1.48, 16.87, 16, 15, 13.9, kDjiSheet},
    {"dji neo", "DJI Neo", "camera", 4, Layout::kX, 0.135, 0, 0, 0, 2, 1.435, 10.5, 18, 17, 16, kDjiSheet},
    {"dji flip", "DJI Flip", "camera", 4, Layout::kX, 0.249, 0, 0, 0, 2, 0, 22.3, 31, 28, 12, kDjiSheet},
    {"dji phantom 2|phantom 2|phantom 2 vision|dji phantom 2 vision", "DJI Phantom 2", "camera", 4, Layout::kX, 1.0, 350, 9.4, 5, 3, 5.2,
     57.7, 25, 0, 15, kDjiSheet},
    {"dji phantom 3|phantom 3|phantom 3 pro|phantom 3 standard|phantom 3 advanced|phantom 3 professional", "DJI Phantom 3 Professional",
     "camera", 4, Layout::kX, 1.28, 350, 9.4, 5, 4, 4.48, 68, 23, 0, 16, kDjiSheet},
    {"dji phantom 4|phantom 4|dji phantom|phantom", "DJI Phantom 4", "camera", 4, Layout::kX, 1.38, 350, 9.4, 5, 4, 5.35, 81.3, 28, 0, 20,
     kDjiSheet},
    {"dji phantom 4 pro|phantom 4 pro|phantom 4 pro v2|phantom 4 pro v2.0|phantom 4 rtk|p4p|dji phantom 4 rtk|p4 rtk|"
     "phantom 4 advanced|phantom 4 multispectral",
     "DJI Phantom 4 Pro", "camera", 4, Layout::kX, 1.388, 350, 9.4, 5, 4, 5.87, 89.2, 30, 0, 20, kDjiSheet},
    {"dji inspire 1|inspire 1|inspire 1 pro", "DJI Inspire 1", "camera", 4, Layout::kX, 2.935, 581, 13, 4.5, 6, 4.5, 99.9, 18, 0, 22,
     kDjiSheet},
    {"dji inspire 2|inspire 2", "DJI Inspire 2", "camera", 4, Layout::kX, 3.44, 605, 15, 5, 6, 8.56, 195.2, 27, 0, 26, kDjiSheet},
    {"dji inspire 3|inspire 3|dji inspire", "DJI Inspire 3", "camera", 4, Layout::kX, 3.995, 695, 16, 7.1, 6, 8.56, 197.6, 28, 25, 26,
     kDjiSheet},
    {"dji matrice 100|matrice 100|m100|dji m100", "DJI Matrice 100", "inspection", 4, Layout::kX, 2.355, 650, 13, 4.5, 6, 4.5, 99.9, 0, 22,
     22, kDjiSheet},
    {"dji matrice 200|matrice 200|m200|dji m200|matrice 210|dji matrice 210|m210|dji m210|matrice 210 rtk|m210 rtk", "DJI Matrice 210 V2",
     "inspection", 4, Layout::kX, 4.8, 643, 17, 0, 6, 15.32, 349, 33, 0, 22.5, kDjiSheet},
    {"dji matrice 300|matrice 300|m300|dji m300|matrice 300 rtk|dji matrice 300 rtk|m300 rtk|dji m300 rtk", "DJI Matrice 300 RTK",
     "inspection", 4, Layout::kX, 6.3, 895, 21, 10, 12, 11.87, 548, 55, 0, 23, kDjiSheet},
    {"dji matrice 350|matrice 350|m350|dji m350|matrice 350 rtk|dji matrice 350 rtk|m350 rtk|dji m350 rtk", "DJI Matrice 350 RTK",
     "inspection", 4, Layout::kX, 6.47, 895, 21, 10, 12, 11.76, 526.4, 55, 0, 23, kDjiSheet},
    {"dji matrice 30|matrice 30|m30|m30t|dji m30|dji m30t|matrice 30t|dji matrice 30t", "DJI Matrice 30", "inspection", 4, Layout::kX, 3.77,
     668, 16, 7.1, 6, 11.76, 263.2, 41, 36, 23, kDjiSheet},
    {"dji matrice 4|matrice 4|matrice 4e|matrice 4t|m4t|m4e|dji matrice 4t|dji matrice 4e", "DJI Matrice 4", "inspection", 4, Layout::kX,
     1.219, 438.8, 10.8, 0, 4, 6.741, 99.5, 49, 42, 21, kDjiSheet},
    {"dji matrice 600 pro|matrice 600 pro|m600 pro|dji m600 pro|dji matrice 600|matrice 600|m600|dji m600", "DJI Matrice 600 Pro",
     "heavy_lift", 6, Layout::kX, 9.5, 1133, 21, 7, 6, 27, 599.4, 0, 32, 18, kDjiSheet},
    {"dji s900|s900|spreading wings s900", "DJI S900", "heavy_lift", 6, Layout::kX, 6.8, 900, 15, 5.2, 6, 12, 0, 0, 18, 0, kManual},
    {"dji s1000|s1000|spreading wings s1000|s1000 plus|dji s1000 plus", "DJI S1000", "heavy_lift", 8, Layout::kX, 9.5, 1045, 15, 5.2, 6, 15,
     0, 0, 15, 0, kManual},
    {"dji s800|s800|s800 evo", "DJI S800 EVO", "heavy_lift", 6, Layout::kX, 6, 800, 15, 5.2, 6, 10, 0, 0, 16, 0, kManual},
    {"f450|dji f450|f450 flamewheel|flamewheel f450|flame wheel f450|dji flamewheel f450|dji flame wheel f450", "DJI Flame Wheel F450",
     "frame_kit", 4, Layout::kX, 1.3, 450, 9.4, 5, 3, 0, 0, 0, 0, 0, kManual},
    {"f550|dji f550|f550 flamewheel|flamewheel f550|flame wheel f550|dji flame wheel f550", "DJI Flame Wheel F550", "frame_kit", 6,
     Layout::kX, 2, 550, 9.4, 5, 4, 0, 0, 0, 0, 0, kManual},
    {"f330|dji f330", "DJI Flame Wheel F330", "frame_kit", 4, Layout::kX, 1.0, 330, 8, 4.5, 3, 0, 0, 0, 0, 0, kManual},
    {"dji tello|ryze tello|tello|tello edu|ryze dji tello|robomaster tt", "Ryze Tello", "hobby", 4, Layout::kX, 0.080, 0, 3, 0, 1, 1.1,
     4.18, 13, 0, 8, kDjiSheet},
    {"dji fpv", "DJI FPV", "freestyle", 4, Layout::kX, 0.795, 245, 5.3, 0, 6, 2, 44.4, 20, 16, 39, kDjiSheet},
    {"dji avata|avata|dji avata 1", "DJI Avata", "cinematic", 4, Layout::kX, 0.41, 120, 2.9, 0, 4, 2.42, 35.71, 18, 0, 27, kDjiSheet},
    {"dji avata 2|avata 2", "DJI Avata 2", "cinematic", 4, Layout::kX, 0.377, 120, 3, 0, 4, 2.15, 31.7, 23, 21, 27, kDjiSheet},
    {"dji agras mg 1|agras mg 1|mg 1|mg 1p|agras mg 1p|agras mg1p|dji agras mg 1p|agras mg1", "DJI Agras MG-1P", "agricultural", 8,
     Layout::kX, 23.8, 1515, 21, 7, 12, 12, 0, 0, 9, 15, kDjiFullyLoaded},
    {"dji agras t10|agras t10|t10", "DJI Agras T10", "agricultural", 4, Layout::kX, 26.8, 1480, 0, 0, 12, 9.5, 0, 0, 8.7, 10,
     kDjiFullyLoaded},
    {"dji agras t16|agras t16|t16", "DJI Agras T16", "agricultural", 6, Layout::kX, 40.5, 1883, 33, 9, 14, 17.5, 0, 0, 10, 10,
     kDjiFullyLoaded},
    {"dji agras t20|agras t20|t20", "DJI Agras T20", "agricultural", 6, Layout::kX, 47.5, 1883, 33, 9, 14, 18, 0, 0, 10, 10,
     kDjiFullyLoaded},
    {"dji agras t30|agras t30|t30|dji agras|agras", "DJI Agras T30", "agricultural", 6, Layout::kX, 66.5, 2145, 38, 20, 14, 29, 0, 0, 7.8,
     10, kDjiFullyLoaded},
    {"dji agras t40|agras t40|t40", "DJI Agras T40", "agricultural", 8, Layout::kCoaxial, 90, 2184, 54, 0, 14, 30, 0, 0, 7, 10,
     kDjiFullyLoaded},
    {"dji agras t50|agras t50|t50", "DJI Agras T50", "agricultural", 8, Layout::kCoaxial, 92, 2200, 54, 0, 14, 30, 0, 0, 7, 10,
     kDjiFullyLoaded},
    {"dji flycart 30|flycart 30|flycart|fly cart 30|dji flycart|dji fly cart 30|fly cart", "DJI FlyCart 30", "delivery", 8,
     Layout::kCoaxial, 65, 2200, 54, 0, 14, 76, 3969, 0, 0, 20, kDjiSheet},
};

}  // namespace

std::span<const KnownModel> DjiModels() { return kDjiModels; }

}  // namespace airsim360::internal
